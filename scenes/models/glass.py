"""Glass: things on a table, and what is in marbles, in centimetres."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

from models.modelling import Mesh, Vector, corners, curve, joined, lathe, plus, surface


def goblet() -> Mesh:
    """A wine glass: its bowl is a shell, its stem and foot are solid."""
    outside = [
        (0.0, 0.0),
        (0.34, 0.0),
        (0.352, 0.016),
        (0.20, 0.045),
        (0.055, 0.11),
        (0.04, 0.30),
        (0.05, 0.66),
        (0.16, 0.76),
        (0.36, 0.98),
    ]
    outside += [(0.41, 1.22), (0.38, 1.48), (0.335, 1.70)]
    inside = [
        (0.335, 1.70),
        (0.327, 1.706),
        (0.318, 1.70),
        (0.362, 1.48),
        (0.392, 1.22),
        (0.34, 0.995),
        (0.15, 0.80),
        (0.0, 0.765),
    ]
    return lathe(curve(outside, 4) + curve(inside, 4), 56)


def wine() -> Mesh:
    """What is in it; it reaches a little into the glass."""
    side = curve([(0.0, 0.757), (0.155, 0.79), (0.348, 0.988), (0.398, 1.16)], 5)
    return lathe([*side, (0.398, 1.16, 0.0, 1.0), (0.0, 1.16, 0.0, 1.0)], 56)


def tumbler() -> Mesh:
    """A heavy tumbler with a thick bottom."""
    outline = [(0, 0, 0), (0.33, 0, 0.05), (0.38, 0.92, 0.015), (0.345, 0.92, 0.015), (0.29, 0.2, 0.08), (0, 0.16, 0)]
    return lathe(corners(outline, 6), 64)


def flask() -> Mesh:
    """A round bottle with a long neck and a lip."""
    outside = [
        (0.0, 0.0),
        (0.30, 0.0),
        (0.36, 0.03),
        (0.52, 0.24),
        (0.56, 0.48),
        (0.45, 0.78),
        (0.22, 0.98),
        (0.125, 1.15),
        (0.11, 1.55),
        (0.15, 1.70),
    ]
    inside = [
        (0.15, 1.70),
        (0.14, 1.715),
        (0.118, 1.70),
        (0.075, 1.55),
        (0.085, 1.15),
        (0.18, 0.95),
        (0.41, 0.75),
        (0.515, 0.48),
        (0.475, 0.26),
    ]
    inside += [(0.33, 0.075), (0.2, 0.06), (0.0, 0.075)]
    return lathe(curve(outside, 4) + curve(inside, 3), 48)


def bowl() -> Mesh:
    """A shallow bowl on a foot."""
    outside = [(0.0, 0.0), (0.22, 0.0), (0.23, 0.02), (0.2, 0.06), (0.42, 0.16), (0.62, 0.36), (0.70, 0.55)]
    inside = [(0.70, 0.55), (0.69, 0.565), (0.672, 0.555), (0.585, 0.37), (0.40, 0.195), (0.15, 0.12), (0.0, 0.115)]
    return lathe(curve(outside, 4) + curve(inside, 4), 56)


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
        return marble_vanes(
            (-2.35, 1, -1.0), 1, (-25, 10, -35), [_vane(0.9, 0.12, 0.70, 0), _vane(0.9, pi / 2 + 0.2, 0.36, 0)]
        )
    if name == "leaf":
        return marble_vanes((2.2, 0.85, -0.7), 0.85, (70, 0, 25), [_vane(0.25, a * pi / 2, 0.5, 1.6) for a in range(2)])
    return marble_vanes((0.6, 1, -3.6), 1, (10, 0, 80), [_vane(0.6, a * pi / 3, 0.6, 0.8) for a in range(3)])


def meshes() -> dict[str, Mesh]:
    """All of them, by the names of their files."""
    return {
        "glass-bowl": bowl().moved(1.55, 0, 0.55),
        "glass-flask": flask().moved(-1.2, 0, -0.35),
        "glass-goblet": goblet().moved(0.35, 0, -0.55),
        "glass-wine": wine().moved(0.35, 0, -0.55),
        "glass-tumbler": tumbler().moved(-0.3, 0, 0.75),
        **{f"marble-{name}": marble(name) for name in ("cat", "ribbon", "ribbon-edge", "leaf", "far")},
    }
