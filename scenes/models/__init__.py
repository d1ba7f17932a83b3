"""What the scenes are made of: a module for each, and how shapes are made in modelling.py."""
