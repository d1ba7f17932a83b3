//! Speed of the renderer.
