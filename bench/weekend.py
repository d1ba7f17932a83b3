#!/usr/bin/env python3
"""Writes the cover scene of "Ray Tracing in One Weekend" (Shirley 2020, §13) to standard output.

    python3 bench/weekend.py > scenes/weekend.toml

The book draws its random numbers from the C library's rand(); this scene draws its own from a seed.
"""

import random

SEED = 6
SIDE = 11  # small spheres stand on a grid from -SIDE to SIDE - 1
RADIUS = 0.2

HEADER = """\
#:schema ../docs/formats/scene.schema.json
# The cover scene of Ray Tracing in One Weekend: three large spheres among small ones of matte, metal and glass.
# Written by bench/weekend.py; do not edit.

[render]
width = 800
height = 450
spp = 64
max_depth = 50

[camera]
look_from = [13, 2, 3]
look_at = [0, 0, 0]
vfov = 20
defocus_angle = 0.6
focus_distance = 10
"""


def vector(numbers):
    return "[" + ", ".join(f"{x:.4g}" for x in numbers) + "]"


def small_spheres(rng):
    """Centre, and material as written in a scene, of each."""
    for a in range(-SIDE, SIDE):
        for b in range(-SIDE, SIDE):
            choice = rng.random()
            center = (a + 0.9 * rng.random(), RADIUS, b + 0.9 * rng.random())
            if sum((x - y) ** 2 for x, y in zip(center, (4, RADIUS, 0))) <= 0.9**2:
                continue  # the metal one stands there
            if choice < 0.8:
                albedo = [rng.random() * rng.random() for _ in range(3)]
                yield center, f"lambertian.albedo = {vector(albedo)}"
            elif choice < 0.95:
                albedo, roughness = [rng.uniform(0.5, 1) for _ in range(3)], rng.uniform(0, 0.5)
                yield center, f"metal = {{albedo = {vector(albedo)}, roughness = {roughness:.4g}}}"
            else:
                yield center, None


def main():
    materials = [
        "ground.lambertian.albedo = 0.5",
        "glass.dielectric.eta = 1.5",
        "matte.lambertian.albedo = [0.4, 0.2, 0.1]",
        "mirror.metal.albedo = [0.7, 0.6, 0.5]",
    ]
    spheres = [
        ((0, -1000, 0), 1000, "ground"),
        ((0, 1, 0), 1, "glass"),
        ((-4, 1, 0), 1, "matte"),
        ((4, 1, 0), 1, "mirror"),
    ]
    for index, (center, material) in enumerate(small_spheres(random.Random(SEED))):
        name = "glass" if material is None else f"m{index}"
        spheres.append((center, RADIUS, name))
        if material is not None:
            materials.append(f"{name}.{material}")
    print(HEADER)
    print("[material]", *materials, sep="\n")
    print("\n[shape]\nsphere = [")
    for center, radius, name in spheres:
        print(f'    {{center = {vector(center)}, radius = {radius}, material = "{name}"}},')
    print("]")


main()
