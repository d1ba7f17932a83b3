"""A courtyard, in metres."""

from __future__ import annotations

import random
from math import cos, pi, sin

from models.modelling import Mesh, Vector, corners, inside_out, joined, lathe, rounded_box, surface


def walls() -> dict[str, Mesh]:
    """Its walls, by their colour."""

    def box(x0: float, x1: float, y0: float, y1: float, z0: float, z1: float) -> Mesh:
        return rounded_box((x1 - x0, y1 - y0, z1 - z0), 0.012, 2).moved((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2)

    steps = [box(-0.2 + 0.36 * k, 3.4, 0.19 * k, 0.19 * (k + 1), -3.0, -1.7) for k in range(9)]
    return {
        "pink": joined(
            [
                box(-6, 0.6, -0.1, 3.9, -3.5, -3.0),
                box(2.2, 9, -0.1, 3.9, -3.5, -3.0),
                box(0.59, 2.21, 2.95, 3.9, -3.5, -3.0),
            ]
        ),
        "ochre": box(3.4, 3.9, -0.1, 3.1, -3.0, 1.2),
        "violet": box(-6.0, -2.6, -0.1, 2.4, -0.9, -0.45),
        "white": joined(steps),
        "far": box(-8, 12, -0.1, 2.6, -9.5, -9),
    }


def agave(seed: int, size: float) -> Mesh:
    """A rosette of thick pointed leaves."""
    rng = random.Random(seed)
    mesh = Mesh()
    for k in range(26):
        rise = 78 - 66 * (k / 25) ** 0.8
        length = size * (0.62 + 0.38 * sin(pi * (0.25 + 0.6 * k / 25))) * rng.uniform(0.92, 1.05)

        def place(u: float, v: float, length: float = length) -> Vector:
            v = min(max(v, 0.0), 1.0)
            wide = 0.105 * length * (0.75 + 1.5 * v - 2.25 * v**2.2) + 0.002
            a = 2 * pi * u
            thick = 0.4 * wide * (sin(a) if sin(a) < 0 else 0.25 * sin(a)) + 0.55 * wide * cos(a) ** 2
            return (wide * cos(a), thick + 0.16 * length * v * v * v, 0.03 * size + length * v)

        mesh += inside_out(surface(place, 8, 7)).turned("x", -rise).turned("y", 137.508 * k)
    return mesh


def pot() -> Mesh:
    """A pot for it."""
    outline = [
        (0, 0, 0),
        (0.24, 0, 0.02),
        (0.33, 0.38, 0),
        (0.36, 0.38, 0.015),
        (0.365, 0.46, 0.015),
        (0.31, 0.46, 0.01),
        (0.29, 0.41, 0),
        (0, 0.41, 0),
    ]
    return lathe(corners(outline, 3), 48).moved(-1.35, 0, 0.25)


def meshes() -> dict[str, Mesh]:
    """All of them, by the names of their files."""
    return {
        "court-agave": agave(3, 0.95).moved(-1.35, 0.42, 0.25),
        "court-pot": pot(),
        **{f"court-{name}": wall for name, wall in walls().items()},
    }
