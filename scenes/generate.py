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

from modelling import Mesh, Vector, corners, curve, joined, lathe, number, plus, pulled, rounded_box, surface, torus, tube

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


def metal_disc(k: int) -> Mesh:
    """What the k-th ball of metals.toml lies on: four in front, four behind."""
    outline = corners([(0.60, 0, 0), (0.62, 0.01, 0.008), (0.62, 0.10, 0.02), (0.36, 0.10, 0.01), (0.30, 0.045, 0)], 3)
    return lathe(outline, 64).moved(1.5 * (k % 4) - 2.25 + 0.75 * (k // 4) - 0.375, 0, 0.7 - 1.5 * (k // 4))


# Glass on a table.


def goblet() -> Mesh:
    """A wine glass: its bowl is a shell, its stem and foot are solid."""
    outside = [(0.0, 0.0), (0.34, 0.0), (0.352, 0.016), (0.20, 0.045), (0.055, 0.11), (0.04, 0.30), (0.05, 0.66), (0.16, 0.76), (0.36, 0.98)]
    outside += [(0.41, 1.22), (0.38, 1.48), (0.335, 1.70)]
    inside = [(0.335, 1.70), (0.327, 1.706), (0.318, 1.70), (0.362, 1.48), (0.392, 1.22), (0.34, 0.995), (0.15, 0.80), (0.0, 0.765)]
    return lathe(curve(outside, 4) + curve(inside, 4), 56)


def tumbler() -> Mesh:
    """A heavy tumbler with a thick bottom."""
    outline = [(0, 0, 0), (0.33, 0, 0.05), (0.38, 0.92, 0.015), (0.345, 0.92, 0.015), (0.29, 0.2, 0.08), (0, 0.16, 0)]
    return lathe(corners(outline, 6), 64)


def flask() -> Mesh:
    """A round bottle with a long neck and a lip."""
    outside = [(0.0, 0.0), (0.30, 0.0), (0.36, 0.03), (0.52, 0.24), (0.56, 0.48), (0.45, 0.78), (0.22, 0.98), (0.125, 1.15), (0.11, 1.55), (0.15, 1.70)]
    inside = [(0.15, 1.70), (0.14, 1.715), (0.118, 1.70), (0.075, 1.55), (0.085, 1.15), (0.18, 0.95), (0.41, 0.75), (0.515, 0.48), (0.475, 0.26)]
    inside += [(0.33, 0.075), (0.2, 0.06), (0.0, 0.075)]
    return lathe(curve(outside, 4) + curve(inside, 3), 48)


def bowl() -> Mesh:
    """A shallow bowl on a foot."""
    outside = [(0.0, 0.0), (0.22, 0.0), (0.23, 0.02), (0.2, 0.06), (0.42, 0.16), (0.62, 0.36), (0.70, 0.55)]
    inside = [(0.70, 0.55), (0.69, 0.565), (0.672, 0.555), (0.585, 0.37), (0.40, 0.195), (0.15, 0.12), (0.0, 0.115)]
    return lathe(curve(outside, 4) + curve(inside, 4), 56)


# Chess, the side of a square being 1.

PAWN = [(0.0, 0.0), (0.30, 0.0), (0.315, 0.04), (0.29, 0.11), (0.235, 0.15), (0.21, 0.20), (0.125, 0.34), (0.095, 0.54), (0.18, 0.59), (0.10, 0.63)]
PAWN_HEAD = (0.76, 0.175)
BISHOP = [(0.0, 0.0), (0.34, 0.0), (0.355, 0.045), (0.33, 0.12), (0.26, 0.17), (0.23, 0.23), (0.13, 0.42), (0.10, 0.80), (0.21, 0.86), (0.12, 0.91)]
BISHOP += [(0.19, 1.02), (0.17, 1.18), (0.07, 1.33), (0.045, 1.36), (0.06, 1.41), (0.0, 1.46)]
QUEEN = [(0.0, 0.0), (0.37, 0.0), (0.385, 0.05), (0.36, 0.13), (0.28, 0.19), (0.25, 0.26), (0.145, 0.5), (0.11, 1.05), (0.24, 1.12), (0.13, 1.18)]
QUEEN += [(0.17, 1.36), (0.25, 1.58), (0.20, 1.56), (0.10, 1.60), (0.05, 1.64), (0.065, 1.70), (0.0, 1.75)]
KING = QUEEN[:10] + [(0.16, 1.36), (0.22, 1.60), (0.18, 1.65), (0.06, 1.70), (0.0, 1.72)]


def pawn() -> Mesh:
    """A pawn."""
    y, radius = PAWN_HEAD
    head = []
    for k in range(9):
        a = -0.86 + (pi / 2 + 0.86) * k / 8
        head.append((radius * cos(a) if k < 8 else 0.0, y + radius * sin(a), cos(a), sin(a)))
    return lathe(curve(PAWN, 2) + head, 28)


def king() -> Mesh:
    """A king with his cross."""
    cross_bars = [rounded_box((0.055, 0.24, 0.055), 0.012, 2).moved(0, 1.82, 0), rounded_box((0.17, 0.055, 0.055), 0.012, 2).moved(0, 1.84, 0)]
    return joined([lathe(curve(KING, 2), 28), *cross_bars])


def chess(pieces: dict[str, list[tuple[float, float]]]) -> Mesh:
    """Pieces at places x, z."""
    makes = {"pawn": pawn, "king": king, "bishop": lambda: lathe(curve(BISHOP, 2), 28), "queen": lambda: lathe(curve(QUEEN, 2), 28)}
    return joined([makes[name]().moved(x, 0, z) for name, places in pieces.items() for x, z in places])


LIGHT = {"pawn": [(-0.5, 1.5), (-2.5, -1.5), (1.5, -0.5)], "king": [(-1.5, 0.5)], "bishop": [(0.5, -2.5)]}
DARK = {"pawn": [(0.5, 0.5), (2.5, -2.5), (-1.5, -3.5)], "queen": [(-0.5, -1.5)], "bishop": [(-3.5, -2.5)], "king": [(1.5, -3.5)]}


# A courtyard, in metres.


def walls() -> dict[str, Mesh]:
    """Its walls, by their colour."""

    def box(x0: float, x1: float, y0: float, y1: float, z0: float, z1: float) -> Mesh:
        return rounded_box((x1 - x0, y1 - y0, z1 - z0), 0.012, 2).moved((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2)

    steps = [box(-0.2 + 0.36 * k, 3.4, 0.19 * k, 0.19 * (k + 1), -3.0, -1.7) for k in range(9)]
    return {
        "pink": joined([box(-6, 0.6, -0.1, 3.9, -3.5, -3.0), box(2.2, 9, -0.1, 3.9, -3.5, -3.0), box(0.59, 2.21, 2.95, 3.9, -3.5, -3.0)]),
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

        mesh += _inside_out(surface(place, 8, 7)).turned("x", -rise).turned("y", 137.508 * k)
    return mesh


def pot() -> Mesh:
    """A pot for it."""
    outline = [(0, 0, 0), (0.24, 0, 0.02), (0.33, 0.38, 0), (0.36, 0.38, 0.015), (0.365, 0.46, 0.015), (0.31, 0.46, 0.01), (0.29, 0.41, 0), (0, 0.41, 0)]
    return lathe(corners(outline, 3), 48).moved(-1.35, 0, 0.25)


# The grid of materials.

GRID = (7, 4)  # columns, rows
STEP = (1.2, 0.96, 1.0)  # to the next column; up and back to the next row
LOWEST = 0.34


def grid_place(k: int) -> Vector:
    """Where the k-th material stands: from left to right, and from below to above."""
    column, row = k % GRID[0], k // GRID[0]
    return ((column - (GRID[0] - 1) / 2) * STEP[0], LOWEST + row * STEP[1], -row * STEP[2])


def grid_steps() -> Mesh:
    """The steps that materials stand on."""
    width = GRID[0] * STEP[0] + 0.5
    boxes = []
    for row in range(GRID[1]):
        y, z = LOWEST + row * STEP[1], -row * STEP[2]
        boxes.append(rounded_box((width, 3, STEP[2] + 0.4), 0.02, 3).moved(0, y - 1.5, z - 0.2 - 0.05))
    return joined(boxes)


def grid_labels() -> Mesh:
    """Their numbers, on the fronts of the steps."""
    labels = []
    for k in range(GRID[0] * GRID[1]):
        x, y, z = grid_place(k)
        labels.append(number(str(k + 1), 0.17).moved(x, y - 0.17, z + STEP[2] / 2 - 0.049))
    return joined(labels)


def grid_cube(k: int) -> Mesh:
    """The small cube in front of the k-th ball."""
    x, y, z = grid_place(k)
    return rounded_box((0.24, 0.24, 0.24), 0.028, 2).turned("y", 28).moved(x + 0.37, y + 0.12, z + 0.25)


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


# A room, in metres: x from -2.4 (the window) to 2.4, y from 0 to 2.7, z from -4 (the back) to 3.


def planks(which: int) -> Mesh:
    """A third of the boards of the floor. Their texture coordinates are metres across and along, elsewhere in the trunk each."""
    rng = random.Random(which)
    mesh = Mesh()
    width = 0.16
    for column in range(30):
        ends = [-4.0 - 1.3 * ((column * 0.618) % 1)]
        while ends[-1] < 3:
            ends.append(ends[-1] + 1.3 + 0.5 * ((column * 7 + len(ends) * 3) % 5) / 4)
        for row, (start, end) in enumerate(zip(ends, ends[1:])):
            if (column + 2 * row + column // 4) % 3 != which:
                continue
            x = -2.4 + (column + 0.5) * width
            board = pulled(corners([(-0.0796, -0.004, 0), (-0.0796, 0, 0.0012), (0.0796, 0, 0.0012), (0.0796, -0.004, 0)], 2), 0, 1)
            shift = (rng.uniform(0.2, 2.0), rng.uniform(-3, 3))
            board.uvs = [(p[0] + shift[0], p[2] * (end - start) + shift[1]) for p in board.vertices]
            board.vertices = [(p[0] + x, p[1], start + 0.0006 + p[2] * (end - start - 0.0012)) for p in board.vertices]
            mesh += _inside_out(board)
    return mesh


def _inside_out(mesh: Mesh) -> Mesh:
    """With its outside where its inside was."""
    return Mesh(
        mesh.vertices, [(-x, -y, -z) for x, y, z in mesh.normals], mesh.uvs, [(a, c, b) for a, b, c in mesh.triangles]
    )


def curtain(z0: float, z1: float, phase: float) -> Mesh:
    """A curtain before the window: folds that are tight above and swing out below."""

    def place(u: float, v: float) -> Vector:
        wave = 2 * pi * 9 * (u + 0.02 * sin(2 * pi * 2 * u + phase)) + phase
        depth = 0.022 + 0.026 * v + 0.008 * sin(5 * u + phase)
        z = z0 + (z1 - z0) * u * (1 + 0.06 * v) + 0.012 * sin(2 * wave) * v
        return (-2.27 + depth * sin(wave) + 0.03 * v * sin(3 * u + phase), 2.5 - 2.47 * v, z)

    return surface(place, 108, 6)


def armchair() -> Mesh:
    """The soft parts of an armchair that looks along +z: a seat, a back and two arms."""
    seat = rounded_box((0.56, 0.17, 0.62), 0.055, 5).moved(0, 0.40, 0.02)
    back = rounded_box((0.58, 0.50, 0.15), 0.06, 5).turned("x", -14).moved(0, 0.66, -0.31)
    base = rounded_box((0.72, 0.09, 0.70), 0.03, 4).moved(0, 0.27, -0.02)
    arms = [rounded_box((0.11, 0.32, 0.70), 0.05, 5).moved(side * 0.335, 0.44, -0.02) for side in (-1, 1)]
    return _at_chair(joined([seat, back, base, *arms]))


def chair_legs() -> Mesh:
    """Its wooden legs, which taper and stand apart."""
    legs = []
    for x, z in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        path = [(x * (0.30 + 0.03 * t), 0.25 * (1 - t), -0.02 + z * (0.28 + 0.03 * t)) for t in (0.0, 0.5, 1.0)]
        legs.append(tube(path, lambda v: 0.022 - 0.009 * v, 14))
    return _at_chair(joined(legs))


def cushion() -> Mesh:
    """A cushion that leans in the chair."""
    half = 0.2

    def place(u: float, v: float) -> Vector:
        # A pillow: two sheets that meet at the rim, as one closed surface around u.
        x, y = 2 * abs((2 * u) % 2 - 1) - 1, 2 * v - 1
        side = 1 if (u % 1) < 0.5 else -1
        bulge = 0.075 * sqrt(max(0.0, (1 - x**4) * (1 - y**4)))
        pinch = 1 - 0.07 * (1 - x * x) * y**6
        return (half * x * pinch * (1 - 0.06 * (1 - y * y)), half * y * (1 - 0.06 * (1 - x * x)), side * bulge)

    return _at_chair(surface(place, 40, 20).turned("z", 4).turned("x", -22).moved(0.03, 0.66, -0.15))


def _at_chair(mesh: Mesh) -> Mesh:
    return mesh.turned("y", -38).moved(1.22, 0, -2.35)


def sideboard() -> Mesh:
    """A low cupboard at the back wall: a body, and three doors that stand off it by a gap."""
    body = rounded_box((1.8, 0.46, 0.42), 0.006, 2).moved(0, 0.43, 0)
    doors = [rounded_box((0.588, 0.43, 0.02), 0.004, 2).moved(0.596 * k, 0.43, 0.222) for k in (-1, 0, 1)]
    return joined([body, *doors]).moved(-0.45, 0, -3.74)


def sideboard_metal() -> Mesh:
    """Its legs and knobs."""
    legs = [tube([(x, 0.21, z), (x, 0.0, z)], lambda v: 0.012, 12) for x in (-0.78, 0.78) for z in (-0.15, 0.15)]
    knob = lathe(corners([(0.004, 0, 0), (0.004, 0.014, 0), (0.012, 0.014, 0.002), (0.012, 0.024, 0.003), (0, 0.024, 0)], 2), 20)
    knobs = [knob.turned("x", 90).moved(x, 0.5, 0.232) for x in (-0.84, -0.26, 0.34)]
    return joined([*legs, *knobs]).moved(-0.45, 0, -3.74)


def vase() -> Mesh:
    """A vase, with its inside."""
    outside = curve([(0.0, 0.0), (0.05, 0.0), (0.058, 0.006), (0.085, 0.09), (0.078, 0.16), (0.034, 0.225), (0.028, 0.26), (0.038, 0.285)], 5)
    inside = curve([(0.038, 0.285), (0.034, 0.285), (0.024, 0.26), (0.03, 0.22), (0.06, 0.16)], 4)
    return lathe(outside + inside, 40).moved(-0.98, 0.66, -3.72)


def twigs() -> tuple[Mesh, Mesh]:
    """Branches in the vase, and their leaves."""
    rng = random.Random(4)
    wood, leaves = Mesh(), Mesh()
    for k in range(7):
        turn, lean, length = 2 * pi * k / 7 + rng.uniform(-0.4, 0.4), rng.uniform(0.25, 0.75), rng.uniform(0.45, 0.7)
        path = [(0.0, 0.1, 0.0)]
        for step in range(1, 8):
            t = step / 7
            out = lean * length * t ** 1.7
            path.append((out * cos(turn) + rng.uniform(-1, 1) * 0.008, 0.1 + length * t * (1 - 0.18 * t * lean), out * sin(turn)))
        wood += tube(path, lambda v: 0.0032 - 0.002 * v, 6)
        for i in range(3, 8):
            for side in (0, 1):
                leaves += _leaf(rng.uniform(0.07, 0.12)).turned("x", rng.uniform(-35, 10)).turned(
                    "y", rng.uniform(0, 360) if side else 90 - turn * 180 / pi + rng.uniform(-60, 60)
                ).moved(*path[i])
    return wood.moved(-0.98, 0.74, -3.72), leaves.moved(-0.98, 0.74, -3.72)


def _leaf(length: float) -> Mesh:
    """A leaf from the origin along z, bent and folded."""

    def place(u: float, v: float) -> Vector:
        wide = 0.30 * length * sqrt(max(0.0, sin(pi * min(max(v, 0.0), 1.0)))) * (1.15 - 0.5 * v)
        x = (2 * u - 1) * wide
        return (x, 0.35 * abs(x) - 0.25 * length * v * v, length * v)

    return _inside_out(surface(place, 4, 6))


def shade() -> Mesh:
    """A shade of paper, open above and below."""
    return lathe(corners([(0.155, 0, 0), (0.10, 0.21, 0)]), 48).moved(0.16, 0.98, -3.72)


def lamp_foot() -> Mesh:
    """A turned foot for the lamp."""
    points = [(0.0, 0.0), (0.072, 0.0), (0.076, 0.008), (0.05, 0.02), (0.03, 0.05), (0.055, 0.11), (0.062, 0.16), (0.03, 0.23), (0.011, 0.27), (0.009, 0.36)]
    return lathe(curve(points, 4), 40).moved(0.16, 0.66, -3.72)


def books() -> tuple[Mesh, Mesh, Mesh]:
    """Three books that lie on each other."""
    sizes = ((0.25, 0.035, 0.18, 8), (0.22, 0.028, 0.165, -7), (0.19, 0.022, 0.14, 14))
    y, result = 0.66, []
    for x, height, z, turn in sizes:
        result.append(rounded_box((x, height, z), 0.004, 2).turned("y", turn).moved(-0.42, y + height / 2, -3.7))
        y += height
    return result[0], result[1], result[2]


def woodwork() -> Mesh:
    """The frame of the window, its sill, and the skirting."""
    def box(x0: float, x1: float, y0: float, y1: float, z0: float, z1: float) -> Mesh:
        return rounded_box((x1 - x0, y1 - y0, z1 - z0), 0.006, 2).moved((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2)

    bars = [box(-2.54, -2.48, 0.5, 2.4, z - 0.025, z + 0.025) for z in (-3.175, -2.2, -1.225)]
    bars += [box(-2.54, -2.48, y - 0.025, y + 0.025, -3.2, -1.2) for y in (0.525, 1.75, 2.375)]
    skirting = [box(-2.4, 2.4, 0, 0.09, -4.0, -3.984), box(2.384, 2.4, 0, 0.09, -4, 3), box(-2.4, -2.384, 0, 0.09, -4, 3)]
    return joined([*bars, *skirting, box(-2.62, -2.33, 0.465, 0.5, -3.26, -1.14)])


def rail() -> Mesh:
    """The rail of the curtain."""
    ends = [lathe(curve([(0.0, 0.0), (0.018, 0.006), (0.02, 0.02), (0.0, 0.036)], 3), 16).turned("x", s).moved(-2.27, 2.52, z) for s, z in ((-90, -3.55), (90, -0.55))]
    return joined([tube([(-2.27, 2.52, -3.55), (-2.27, 2.52, -0.55)], lambda v: 0.011, 12), *ends])


def small_table() -> Mesh:
    """A round table beside the chair, and what it stands on."""
    top = lathe(corners([(0, 0.5, 0), (0.24, 0.5, 0.01), (0.24, 0.525, 0.008), (0, 0.525, 0)], 4), 56)
    legs = [tube([(0.16 * cos(a), 0.5, 0.16 * sin(a)), (0.21 * cos(a), 0, 0.21 * sin(a))], lambda v: 0.014 - 0.004 * v, 12) for a in (0.4, 2.5, 4.6)]
    return joined([top, *legs]).moved(*TABLE)


def cup() -> Mesh:
    """A cup with its handle on a saucer."""
    x, y, z = TABLE[0] - 0.03, 0.525, TABLE[2] + 0.06
    body = curve([(0.0, 0.008), (0.02, 0.008), (0.026, 0.014), (0.036, 0.04), (0.04, 0.062)], 4)
    body += curve([(0.04, 0.062), (0.0385, 0.063), (0.037, 0.061), (0.033, 0.04), (0.022, 0.016), (0.0, 0.013)], 3)
    saucer = curve([(0.0, 0.001), (0.035, 0.001), (0.055, 0.007), (0.072, 0.013), (0.073, 0.015), (0.055, 0.0105), (0.035, 0.006), (0.0, 0.0055)], 3)
    handle = tube([(0.036 + 0.02 * sin(a), 0.036 + 0.016 * cos(a), 0.0) for a in (0.0, 0.5, 1.0, 1.6, 2.2, 2.8, 3.3)], lambda v: 0.0036, 8)
    return joined([lathe(body, 36), lathe(saucer, 40), handle]).turned("y", 35).moved(x, y, z)


TABLE = (0.42, 0.0, -2.1)

# Scenes that are long lists.

MANY_LIGHTS = """\
#:schema ../docs/formats/scene.schema.json
# 640 lamps as small as cherries around three balls. Whoever lights a point asks one of them, chosen by what it can give there.
# Written by generate.py; do not edit.

[render]
width = 960
height = 480
spp = 256

[camera]
look_from = [0, 2.0, 8.0]
look_at = [0, 0.52, 0]
vfov = 21
aperture = 0.04
focus_distance = 7.2

[environment.gradient]
bottom = [0.002, 0.002, 0.004]
top = [0.006, 0.010, 0.024]

[material]
floor.oren-nayar = { albedo = 0.55, roughness = 0.3 }
chalk.lambertian.albedo = 0.8
mirror.conductor = { metal = "silver", roughness = 0.06 }
satin.conductor = { metal = "silver", roughness = 0.35 }
"""


def many_lights() -> str:
    """Lamps as the seeds of a sunflower, coloured around the circle."""
    hues, count = 12, 640
    lines = [MANY_LIGHTS.rstrip()]
    for k in range(hues):
        channels = [max(0.0, 0.5 + 0.5 * cos(2 * pi * (k / hues - third / 3))) ** 1.8 for third in range(3)]
        lines.append(f"lamp-{k + 1}.emissive.radiance = [{', '.join(f'{3.2 * c + 0.05:.2f}' for c in channels)}]")
    lines += ["", "[[shape.quad]]", "corner = [-60, 0, 60]", "u = [120, 0, 0]", "v = [0, 0, -120]", 'material = "floor"']
    lines += ["", "[shape]", "sphere = ["]
    balls = ((-1.0, 0.1, 0.62, "chalk"), (0.45, -0.35, 0.85, "mirror"), (1.25, 0.85, 0.38, "satin"))
    for x, z, radius, name in balls:
        lines.append(f'  {{ center = [{x}, {radius}, {z}], radius = {radius}, material = "{name}" }},')
    for i in range(count):
        turn, far = 0.381966 * i, 0.17 * sqrt(i + 6)
        x, z = far * cos(2 * pi * turn), far * sin(2 * pi * turn)
        if any((x - bx) ** 2 + (z - bz) ** 2 < (radius * 0.8 + 0.08) ** 2 for bx, bz, radius, _ in balls):
            continue
        hue = int((0.5 + 0.5 * sin(2 * pi * (0.16 * far + 0.5 * (x / 9)))) * (hues - 1) + 0.5)
        lines.append(f'  {{ center = [{x:.3f}, 0.036, {z:.3f}], radius = 0.036, material = "lamp-{hue + 1}" }},')
    return "\n".join([*lines, "]", ""])


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
    "chess-frame": lambda: rounded_box((8.9, 0.34, 8.9), 0.05, 4).moved(0, -0.171, 0),
    "chess-dark": lambda: chess(DARK),
    "chess-light": lambda: chess(LIGHT),
    "court-agave": lambda: agave(3, 0.95).moved(-1.35, 0.42, 0.25),
    "court-pot": pot,
    **{f"court-{name}": lambda name=name: walls()[name] for name in ("pink", "ochre", "violet", "white", "far")},
    "disc": disc,
    "glass-bowl": lambda: bowl().moved(1.55, 0, 0.55),
    "glass-flask": lambda: flask().moved(-1.2, 0, -0.35),
    "glass-goblet": lambda: goblet().moved(0.35, 0, -0.55),
    "glass-tumbler": lambda: tumbler().moved(-0.3, 0, 0.75),
    "grid-labels": grid_labels,
    "grid-steps": grid_steps,
    **{f"grid-cube-{k + 1}": lambda k=k: grid_cube(k) for k in range(GRID[0] * GRID[1])},
    "room-armchair": armchair,
    "room-book-1": lambda: books()[0],
    "room-book-2": lambda: books()[1],
    "room-book-3": lambda: books()[2],
    "room-chair-legs": chair_legs,
    "room-cup": cup,
    "room-curtain-1": lambda: curtain(-3.45, -2.75, 0.4),
    "room-curtain-2": lambda: curtain(-1.55, -0.7, 2.0),
    "room-cushion": cushion,
    "room-lamp-foot": lamp_foot,
    "room-leaves": lambda: twigs()[1],
    "room-planks-1": lambda: planks(0),
    "room-planks-2": lambda: planks(1),
    "room-planks-3": lambda: planks(2),
    "room-rail": rail,
    "room-shade": shade,
    "room-sideboard": sideboard,
    "room-sideboard-metal": sideboard_metal,
    "room-table": small_table,
    "room-twigs": lambda: twigs()[0],
    "room-vase": vase,
    "room-woodwork": woodwork,
    "plinth": plinth,
    **{f"metal-disc-{k + 1}": lambda k=k: metal_disc(k) for k in range(8)},
    **{f"marble-{name}": lambda name=name: marble(name) for name in ("cat", "ribbon", "ribbon-edge", "leaf", "far")},
}


def files() -> dict[Path, bytes]:
    """Everything that is written, by its place."""
    result = {FOLDER / "meshes" / f"{name}.ply": make().ply() for name, make in MESHES.items()}
    result[FOLDER / "many-lights.toml"] = many_lights().encode()
    return result


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
