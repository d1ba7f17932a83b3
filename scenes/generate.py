#!/usr/bin/env python3
"""Writes the meshes of the scenes to scenes/meshes, and the scenes that are long lists.

    python3 scenes/generate.py            # writes them
    python3 scenes/generate.py --check    # says whether what is there is what would be written

Python 3.11, and nothing else. How shapes are made is in modelling.py, what they are for in README.md.
"""

from __future__ import annotations

import random
import sys
from collections.abc import Callable
from math import cos, pi, sin, sqrt
from pathlib import Path

from modelling import Mesh, Vector, corners, curve, joined, lathe, plus, pulled, rounded_box, surface, torus, tube

FOLDER = Path(__file__).resolve().parent


# A bottle of perfume, in metres.

BOTTLE_CORE = (0.020, 0.009)
LEVEL = 0.047


def bottle_glass() -> Mesh:
    """The outside of the bottle: 66 mm wide, 75 mm high, 44 mm deep."""
    outline = corners([(0, 0, 0), (0.013, 0, 0.003), (0.013, 0.075, 0.008), (0, 0.075, 0)], 8)
    return lathe(outline, 48, BOTTLE_CORE)


def bottle_liquid() -> Mesh:
    """Where the liquid touches the glass, seen from the glass."""
    return lathe(corners([(0, 0.013, 0), (0.0085, 0.013, 0.004), (0.0085, LEVEL, 0)], 6), 48, BOTTLE_CORE)


def bottle_level() -> Mesh:
    """The top of the liquid."""
    return lathe([(0.0085, LEVEL, 0.0, 1.0), (0.0, LEVEL, 0.0, 1.0)], 48, BOTTLE_CORE)


def bottle_air() -> Mesh:
    """Where the air above the liquid touches the glass, seen from the glass."""
    return lathe(corners([(0.0085, LEVEL, 0), (0.0085, 0.069, 0.006), (0, 0.069, 0)], 6), 48, BOTTLE_CORE)


def bottle_collar() -> Mesh:
    """A ring below the cap."""
    return lathe(corners([(0.0125, 0.0745, 0), (0.0125, 0.081, 0.0006), (0.009, 0.081, 0)], 3), 64)


def bottle_cap() -> Mesh:
    """A cap with a waist of fine grooves."""
    points = [(0.010, 0.0815, 0), (0.0165, 0.0815, 0.0006)]
    for k in range(4):
        y = 0.0835 + 0.0014 * k
        points += [(0.0165, y, 0.0001), (0.0158, y, 0.0001), (0.0158, y + 0.0006, 0.0001), (0.0165, y + 0.0006, 0.0001)]
    points += [(0.0165, 0.112, 0.0012), (0, 0.112, 0)]
    return lathe(corners(points, 2), 64)


def bottle_emblem() -> Mesh:
    """A ring and a dot on the front of the bottle."""
    ring = torus(0.0092, 0.0005, 64, 10)
    dot = lathe(corners([(0.0022, 0, 0), (0.0022, 0.0006, 0.0003), (0, 0.0006, 0)], 3), 32)
    return (ring + dot).turned("x", 90).moved(0, 0.034, 0.0221)


def backdrop(size: float, height: float = 0.0) -> Mesh:
    """A sheet that runs from a table of this height up a wall: six sizes wide, and bent over 0.6 of it."""
    outline = corners([(1.4, 0, 0), (-0.7, 0, 0.6), (-0.7, 2, 0)], 24)
    outline = [(x * size, y * size + height, nx, ny) for x, y, nx, ny in outline]
    # Pulled along z it runs in x; turned, it runs away from the eye.
    return pulled(outline, -3 * size, 3 * size).turned("y", -90)


def disc() -> Mesh:
    """An upright disc behind the bottle."""
    outline = corners([(0, -0.006, 0), (0.078, -0.006, 0.002), (0.078, 0.006, 0.002), (0, 0.006, 0)], 4)
    return lathe(outline, 96).turned("x", 90).moved(-0.05, 0.078 - 0.024, -0.10)


def plinth() -> Mesh:
    """A round stone for the bottle: 150 mm across, 24 mm high."""
    return lathe(corners([(0.074, -0.024, 0), (0.075, -0.0235, 0), (0.075, 0, 0.0022), (0, 0, 0)], 5), 96)


# Marbles, in centimetres.


def _vane(twist: float, turn: float, width: float, bend: float) -> Mesh:
    """A ribbon along the y axis in a marble of radius 1: `twist` turns from end to end."""

    def place(u: float, v: float) -> Vector:
        y = 1.62 * (v - 0.5)
        across = width * (2 * u - 1) * sqrt(max(0.02, 1 - (2 * v - 1) ** 2))
        angle = 2 * pi * (twist * (v - 0.5)) + turn + bend * across
        return (across * cos(angle), y, across * sin(angle))

    return surface(place, 8, 36)


def marble_vanes(center: Vector, radius: float, tilt: Vector, vanes: list[Mesh]) -> Mesh:
    """Ribbons within a marble that lies somewhere, turned about the three axes."""
    mesh = joined(vanes).turned("x", tilt[0]).turned("y", tilt[1]).turned("z", tilt[2])
    mesh.vertices = [plus(center, p, radius) for p in mesh.vertices]
    return mesh


def marble(name: str) -> Mesh:
    """The core of one marble of hero-glass.toml."""
    if name == "cat":
        return marble_vanes((0, 1, 0), 1, (18, 30, 62), [_vane(0.35, a * pi / 3, 0.52, 1.1) for a in range(3)])
    if name == "ribbon":
        return marble_vanes((-2.35, 1, -1.0), 1, (-25, 10, -35), [_vane(0.9, 0, 0.62, 0), _vane(0.9, pi / 2, 0.3, 0)])
    if name == "ribbon-edge":
        return marble_vanes((-2.35, 1, -1.0), 1, (-25, 10, -35), [_vane(0.9, 0.12, 0.70, 0), _vane(0.9, pi / 2 + 0.2, 0.36, 0)])
    if name == "leaf":
        return marble_vanes((2.2, 0.85, -0.7), 0.85, (70, 0, 25), [_vane(0.25, a * pi / 2, 0.5, 1.6) for a in range(2)])
    return marble_vanes((0.6, 1, -3.6), 1, (10, 0, 80), [_vane(0.6, a * pi / 3, 0.6, 0.8) for a in range(3)])


# The table of what is written.

MESHES: dict[str, Callable[[], Mesh]] = {
    "backdrop": lambda: backdrop(10),
    "backdrop-small": lambda: backdrop(1, -0.024),
    "bottle-air": bottle_air,
    "bottle-cap": bottle_cap,
    "bottle-collar": bottle_collar,
    "bottle-emblem": bottle_emblem,
    "bottle-glass": bottle_glass,
    "bottle-level": bottle_level,
    "bottle-liquid": bottle_liquid,
    "disc": disc,
    "plinth": plinth,
    **{f"marble-{name}": lambda name=name: marble(name) for name in ("cat", "ribbon", "ribbon-edge", "leaf", "far")},
}


def files() -> dict[Path, bytes]:
    """Everything that is written, by its place."""
    return {FOLDER / "meshes" / f"{name}.ply": make().ply() for name, make in MESHES.items()}


def main(arguments: list[str]) -> int:
    """Writes the files, or compares them."""
    wanted = files()
    if arguments == ["--check"]:
        wrong = [path for path, content in wanted.items() if not path.is_file() or path.read_bytes() != content]
        wrong += set((FOLDER / "meshes").glob("*.ply")) - wanted.keys()
        for path in sorted(wrong):
            print(f"{path.relative_to(FOLDER)} is not what generate.py writes", file=sys.stderr)
        return int(bool(wrong))
    if arguments:
        print(__doc__, file=sys.stderr)
        return 2
    for path, content in wanted.items():
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
