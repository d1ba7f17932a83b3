"""A bottle of perfume, what it stands on, and studios. Lengths are metres."""

from __future__ import annotations

from models.modelling import Mesh, corners, lathe, pulled, torus

BOTTLE_CORE = (0.020, 0.009)


def bottle_glass() -> Mesh:
    """The outside of the bottle: 66 mm wide, 75 mm high, 44 mm deep."""
    outline = corners([(0, 0, 0), (0.013, 0, 0.003), (0.013, 0.075, 0.008), (0, 0.075, 0)], 8)
    return lathe(outline, 48, BOTTLE_CORE)


def bottle_air() -> Mesh:
    """The hollow in it."""
    outline = corners([(0, 0.013, 0), (0.0085, 0.013, 0.004), (0.0085, 0.069, 0.006), (0, 0.069, 0)], 6)
    return lathe(outline, 48, BOTTLE_CORE)


def bottle_liquid() -> Mesh:
    """What fills the hollow for the most part; it reaches a little into the glass."""
    outline = corners([(0, 0.0129, 0), (0.0086, 0.0129, 0.004), (0.0086, 0.047, 0), (0, 0.047, 0)], 6)
    return lathe(outline, 48, BOTTLE_CORE)


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


def meshes() -> dict[str, Mesh]:
    """All of them, by the names of their files."""
    return {
        "backdrop": backdrop(10),
        "backdrop-small": backdrop(1, -0.024),
        "bottle-air": bottle_air(),
        "bottle-cap": bottle_cap(),
        "bottle-collar": bottle_collar(),
        "bottle-emblem": bottle_emblem(),
        "bottle-glass": bottle_glass(),
        "bottle-liquid": bottle_liquid(),
        "disc": disc(),
        "plinth": plinth(),
        **{f"metal-disc-{k + 1}": metal_disc(k) for k in range(8)},
    }
