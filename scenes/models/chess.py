"""Chess pieces; the side of a square is 1."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi, sin

from models.modelling import Mesh, curve, joined, lathe, rounded_box

PAWN = [
    (0.0, 0.0),
    (0.30, 0.0),
    (0.315, 0.04),
    (0.29, 0.11),
    (0.235, 0.15),
    (0.21, 0.20),
    (0.125, 0.34),
    (0.095, 0.54),
    (0.18, 0.59),
    (0.10, 0.63),
]
PAWN_HEAD = (0.76, 0.175)
BISHOP = [
    (0.0, 0.0),
    (0.34, 0.0),
    (0.355, 0.045),
    (0.33, 0.12),
    (0.26, 0.17),
    (0.23, 0.23),
    (0.13, 0.42),
    (0.10, 0.80),
    (0.21, 0.86),
    (0.12, 0.91),
]
BISHOP += [(0.19, 1.02), (0.17, 1.18), (0.07, 1.33), (0.045, 1.36), (0.06, 1.41), (0.0, 1.46)]
QUEEN = [
    (0.0, 0.0),
    (0.37, 0.0),
    (0.385, 0.05),
    (0.36, 0.13),
    (0.28, 0.19),
    (0.25, 0.26),
    (0.145, 0.5),
    (0.11, 1.05),
    (0.24, 1.12),
    (0.13, 1.18),
]
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
    cross_bars = [
        rounded_box((0.055, 0.24, 0.055), 0.012, 2).moved(0, 1.82, 0),
        rounded_box((0.17, 0.055, 0.055), 0.012, 2).moved(0, 1.84, 0),
    ]
    return joined([lathe(curve(KING, 2), 28), *cross_bars])


def chess(pieces: dict[str, list[tuple[float, float]]]) -> Mesh:
    """Pieces at places x, z."""
    makes: dict[str, Callable[[], Mesh]] = {
        "pawn": pawn,
        "king": king,
        "bishop": lambda: lathe(curve(BISHOP, 2), 28),
        "queen": lambda: lathe(curve(QUEEN, 2), 28),
    }
    return joined([makes[name]().moved(x, 0, z) for name, places in pieces.items() for x, z in places])


LIGHT = {"pawn": [(-0.5, 1.5), (-2.5, -1.5), (1.5, -0.5)], "king": [(-1.5, 0.5)], "bishop": [(0.5, -2.5)]}
DARK = {
    "pawn": [(0.5, 0.5), (2.5, -2.5), (-1.5, -3.5)],
    "queen": [(-0.5, -1.5)],
    "bishop": [(-3.5, -2.5)],
    "king": [(1.5, -3.5)],
}


def meshes() -> dict[str, Mesh]:
    """All of them, by the names of their files."""
    return {
        "chess-dark": chess(DARK),
        "chess-frame": rounded_box((8.9, 0.34, 8.9), 0.05, 4).moved(0, -0.171, 0),
        "chess-light": chess(LIGHT),
    }
