"""A room, in metres: x from -2.4 (the window) to 2.4, y from 0 to 2.7, z from -4 (the back) to 3."""

from __future__ import annotations

import random
from math import cos, pi, sin, sqrt

from models.modelling import Mesh, Vector, corners, curve, inside_out, joined, lathe, pulled, rounded_box, surface, tube


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
            board = pulled(
                corners([(-0.0796, -0.004, 0), (-0.0796, 0, 0.0012), (0.0796, 0, 0.0012), (0.0796, -0.004, 0)], 2), 0, 1
            )
            shift = (rng.uniform(0.2, 2.0), rng.uniform(-3, 3))
            board.uvs = [(p[0] + shift[0], p[2] * (end - start) + shift[1]) for p in board.vertices]
            board.vertices = [(p[0] + x, p[1], start + 0.0006 + p[2] * (end - start - 0.0012)) for p in board.vertices]
            mesh += inside_out(board)
    return mesh


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
    knob = lathe(
        corners([(0.004, 0, 0), (0.004, 0.014, 0), (0.012, 0.014, 0.002), (0.012, 0.024, 0.003), (0, 0.024, 0)], 2), 20
    )
    knobs = [knob.turned("x", 90).moved(x, 0.5, 0.232) for x in (-0.84, -0.26, 0.34)]
    return joined([*legs, *knobs]).moved(-0.45, 0, -3.74)


def vase() -> Mesh:
    """A vase, with its inside."""
    outside = curve(
        [
            (0.0, 0.0),
            (0.05, 0.0),
            (0.058, 0.006),
            (0.085, 0.09),
            (0.078, 0.16),
            (0.034, 0.225),
            (0.028, 0.26),
            (0.038, 0.285),
        ],
        5,
    )
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
            out = lean * length * t**1.7
            path.append(
                (
                    out * cos(turn) + rng.uniform(-1, 1) * 0.008,
                    0.1 + length * t * (1 - 0.18 * t * lean),
                    out * sin(turn),
                )
            )
        wood += tube(path, lambda v: 0.0032 - 0.002 * v, 6)
        for i in range(3, 8):
            for side in (0, 1):
                leaves += (
                    _leaf(rng.uniform(0.07, 0.12))
                    .turned("x", rng.uniform(-35, 10))
                    .turned("y", rng.uniform(0, 360) if side else 90 - turn * 180 / pi + rng.uniform(-60, 60))
                    .moved(*path[i])
                )
    return wood.moved(-0.98, 0.74, -3.72), leaves.moved(-0.98, 0.74, -3.72)


def _leaf(length: float) -> Mesh:
    """A leaf from the origin along z, bent and folded."""

    def place(u: float, v: float) -> Vector:
        wide = 0.30 * length * sqrt(max(0.0, sin(pi * min(max(v, 0.0), 1.0)))) * (1.15 - 0.5 * v)
        x = (2 * u - 1) * wide
        return (x, 0.35 * abs(x) - 0.25 * length * v * v, length * v)

    return inside_out(surface(place, 4, 6))


def shade() -> Mesh:
    """A shade of paper, open above and below."""
    return lathe(corners([(0.155, 0, 0), (0.10, 0.21, 0)]), 48).moved(0.16, 0.98, -3.72)


def lamp_foot() -> Mesh:
    """A turned foot for the lamp."""
    points = [
        (0.0, 0.0),
        (0.072, 0.0),
        (0.076, 0.008),
        (0.05, 0.02),
        (0.03, 0.05),
        (0.055, 0.11),
        (0.062, 0.16),
        (0.03, 0.23),
        (0.011, 0.27),
        (0.009, 0.36),
    ]
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
    skirting = [
        box(-2.4, 2.4, 0, 0.09, -4.0, -3.984),
        box(2.384, 2.4, 0, 0.09, -4, 3),
        box(-2.4, -2.384, 0, 0.09, -4, 3),
    ]
    return joined([*bars, *skirting, box(-2.62, -2.33, 0.465, 0.5, -3.26, -1.14)])


def rail() -> Mesh:
    """The rail of the curtain."""
    ends = [
        lathe(curve([(0.0, 0.0), (0.018, 0.006), (0.02, 0.02), (0.0, 0.036)], 3), 16)
        .turned("x", s)
        .moved(-2.27, 2.52, z)
        for s, z in ((-90, -3.55), (90, -0.55))
    ]
    return joined([tube([(-2.27, 2.52, -3.55), (-2.27, 2.52, -0.55)], lambda v: 0.011, 12), *ends])


def small_table() -> Mesh:
    """A round table beside the chair, and what it stands on."""
    top = lathe(corners([(0, 0.5, 0), (0.24, 0.5, 0.01), (0.24, 0.525, 0.008), (0, 0.525, 0)], 4), 56)
    legs = [
        tube([(0.16 * cos(a), 0.5, 0.16 * sin(a)), (0.21 * cos(a), 0, 0.21 * sin(a))], lambda v: 0.014 - 0.004 * v, 12)
        for a in (0.4, 2.5, 4.6)
    ]
    return joined([top, *legs]).moved(*TABLE)


def cup() -> Mesh:
    """A cup with its handle on a saucer."""
    x, y, z = TABLE[0] - 0.03, 0.525, TABLE[2] + 0.06
    body = curve([(0.0, 0.008), (0.02, 0.008), (0.026, 0.014), (0.036, 0.04), (0.04, 0.062)], 4)
    body += curve([(0.04, 0.062), (0.0385, 0.063), (0.037, 0.061), (0.033, 0.04), (0.022, 0.016), (0.0, 0.013)], 3)
    saucer = curve(
        [
            (0.0, 0.001),
            (0.035, 0.001),
            (0.055, 0.007),
            (0.072, 0.013),
            (0.073, 0.015),
            (0.055, 0.0105),
            (0.035, 0.006),
            (0.0, 0.0055),
        ],
        3,
    )
    handle = tube(
        [(0.036 + 0.02 * sin(a), 0.036 + 0.016 * cos(a), 0.0) for a in (0.0, 0.5, 1.0, 1.6, 2.2, 2.8, 3.3)],
        lambda v: 0.0036,
        8,
    )
    return joined([lathe(body, 36), lathe(saucer, 40), handle]).turned("y", 35).moved(x, y, z)


TABLE = (0.42, 0.0, -2.1)


def meshes() -> dict[str, Mesh]:
    """All of them, by the names of their files."""
    return {
        "room-armchair": armchair(),
        **{f"room-book-{k + 1}": book for k, book in enumerate(books())},
        "room-chair-legs": chair_legs(),
        "room-cup": cup(),
        "room-curtain-1": curtain(-3.45, -2.75, 0.4),
        "room-curtain-2": curtain(-1.55, -0.7, 2.0),
        "room-cushion": cushion(),
        "room-lamp-foot": lamp_foot(),
        "room-leaves": twigs()[1],
        **{f"room-planks-{k + 1}": planks(k) for k in range(3)},
        "room-rail": rail(),
        "room-shade": shade(),
        "room-sideboard": sideboard(),
        "room-sideboard-metal": sideboard_metal(),
        "room-table": small_table(),
        "room-twigs": twigs()[0],
        "room-vase": vase(),
        "room-woodwork": woodwork(),
    }
