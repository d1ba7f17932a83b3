"""A toy locomotive on its rails, as a glTF model: what `eyebeam render` makes of a model with no options. Lengths are metres."""

from __future__ import annotations

import math

from models.gltf import Glb, png
from models.modelling import Mesh, Vector, corners, joined, lathe, rounded_box, torus, tube

AXLES = (0.062, 0.0, -0.062)
WHEEL = 0.026
RAIL = 0.016


def box(size: Vector, at: Vector, radius: float = 0.002) -> Mesh:
    """A box with round edges somewhere."""
    return rounded_box(size, radius, 2).moved(*at)


def along(points: list[tuple[float, float, float]], y: float, segments: int = 56) -> Mesh:
    """Turned about an axis along z at this height, from (radius, z, rounding)."""
    return lathe(corners(points, 4), segments).turned("x", 90).moved(0, y, 0)


def upright(points: list[tuple[float, float, float]], z: float) -> Mesh:
    """Turned about an upright axis, from (radius, y, rounding)."""
    return lathe(corners(points, 4), 40).moved(0, 0, z)


def wood(x: int, y: int) -> tuple[int, int, int]:
    """Grain along the picture's height."""
    x, y = 2 * x, 2 * y
    bend = 6 * math.sin(0.011 * y + 0.4) + 3 * math.sin(0.031 * y)
    rings = 0.5 + 0.5 * math.sin(0.42 * (x + bend) + 1.5 * math.sin(0.05 * (x - bend)))
    pores = 1 if (x * 7919 + (y // 9) * 104729) % 53 else 0.72
    shade = (0.82 + 0.18 * rings) * pores
    return (round(196 * shade), round(140 * shade * (0.96 + 0.04 * rings)), round(88 * shade * (0.9 + 0.1 * rings)))


def boiler() -> Mesh:
    """The kettle."""
    return along([(0, -0.07, 0), (0.033, -0.07, 0.002), (0.033, 0.100, 0.003), (0, 0.100, 0)], 0.098)


def bands() -> Mesh:
    """Rings about the kettle, and the rim of its door."""
    rings = [torus(0.0332, 0.0014, 56, 8).turned("x", 90).moved(0, 0.098, z) for z in (-0.03, 0.015, 0.06)]
    return joined([*rings, torus(0.0245, 0.0013, 48, 8).turned("x", 90).moved(0, 0.098, 0.1095)])


def door() -> Mesh:
    """The front of the kettle."""
    return along([(0.031, 0.099, 0), (0.031, 0.106, 0.002), (0.0245, 0.1085, 0.001), (0.018, 0.1115, 0.004), (0, 0.1125, 0)], 0.098)


def chimney() -> Mesh:
    """It widens upwards, and one sees into it."""
    outside = [(0.015, 0.126, 0), (0.0105, 0.133, 0.006), (0.0105, 0.160, 0.006), (0.0175, 0.178, 0.001), (0.0175, 0.183, 0.001)]
    return upright([*outside, (0.014, 0.183, 0.0008), (0.0075, 0.160, 0.004), (0.0075, 0.14, 0)], 0.078)


def dome() -> Mesh:
    """A bell of brass on the kettle."""
    return upright([(0.019, 0.124, 0), (0.0155, 0.134, 0.006), (0.0155, 0.142, 0.008), (0.007, 0.153, 0.006), (0, 0.154, 0)], 0.032)


def whistle() -> Mesh:
    """Beside the dome."""
    return upright([(0.0022, 0.128, 0), (0.0022, 0.141, 0.0005), (0.0042, 0.143, 0.0008), (0.0042, 0.152, 0.002), (0, 0.153, 0)], 0.0)


def cab() -> Mesh:
    """Walls up to the windows, posts, and what is between the front windows."""
    walls = [box((0.086, 0.044, 0.004), (0, 0.091, -0.072)), box((0.086, 0.044, 0.004), (0, 0.091, -0.126))]
    walls += [box((0.004, 0.044, 0.058), (x, 0.091, -0.099)) for x in (-0.041, 0.041)]
    posts = [box((0.006, 0.048, 0.006), (x, 0.133, z)) for x in (-0.04, 0.04) for z in (-0.072, -0.126)]
    return joined([*walls, *posts, box((0.014, 0.046, 0.004), (0, 0.133, -0.072))])


def roof() -> Mesh:
    """Bent, with an edge all around."""
    return joined([box((0.096, 0.006, 0.076), (0, 0.159, -0.099), 0.0028), box((0.066, 0.006, 0.07), (0, 0.1635, -0.099), 0.0028)])


def panes() -> Mesh:
    """Window glass."""
    front = [box((0.028, 0.040, 0.0015), (x, 0.134, -0.072), 0.0006) for x in (-0.0225, 0.0225)]
    return joined([*front, *(box((0.0015, 0.040, 0.045), (x, 0.134, -0.099), 0.0006) for x in (-0.04, 0.04))])


def front() -> Mesh:
    """The beam with its buffers, and steps."""
    beam = box((0.088, 0.020, 0.007), (0, 0.049, 0.125))
    stems = [along([(0, 0.126, 0), (0.0042, 0.126, 0), (0.0042, 0.143, 0)], 0.051, 32).moved(x, 0, 0) for x in (-0.028, 0.028)]
    return joined([beam, *stems])


def buffers() -> Mesh:
    """Their plates."""
    plate = along([(0, 0.142, 0), (0.0105, 0.142, 0.001), (0.0105, 0.1455, 0.0015), (0.004, 0.148, 0.004), (0, 0.1483, 0)], 0.051, 48)
    return joined([plate.moved(x, 0, 0) for x in (-0.028, 0.028)])


def wheel() -> tuple[Mesh, Mesh]:
    """An axle along x with both its wheels: what is painted, and what is of steel."""
    paint, steel = [], []
    for side in (-1, 1):
        x = 0.034 * side
        rim = torus(WHEEL - 0.0045, 0.0026, 40, 8).turned("z", 90).moved(x, 0, 0)
        spokes = []
        for k in range(8):
            a = math.tau * k / 8
            ends = [(x, r * math.cos(a), r * math.sin(a)) for r in (0.004, 0.0115, WHEEL - 0.005)]
            spokes.append(tube(ends, lambda t: 0.0019 - 0.0006 * t, 8))
        hub = lathe(corners([(0, -0.004, 0), (0.0058, -0.004, 0.001), (0.0058, 0.004, 0.001), (0, 0.004, 0)], 3), 32)
        tyre = lathe(
            corners([(WHEEL - 0.003, -0.0045, 0), (WHEEL, -0.0045, 0.0006), (WHEEL, 0.0045, 0.0006), (WHEEL - 0.003, 0.0045, 0), (WHEEL - 0.003, -0.0045, 0)], 2), 48
        )
        paint += [rim, *spokes, hub.turned("z", 90).moved(x, 0, 0)]
        steel.append(tyre.turned("z", 90).moved(x, 0, 0))
    steel.append(tube([(-0.034, 0, 0), (0, 0, 0), (0.034, 0, 0)], lambda _: 0.003, 16))
    return joined(paint), joined(steel)


def rods() -> Mesh:
    """They couple the wheels."""
    parts = []
    for side in (-1, 1):
        x, y = 0.0435 * side, RAIL + WHEEL + 0.011
        parts.append(box((0.003, 0.006, AXLES[0] - AXLES[2]), (x, y, 0), 0.001))
        pin = lathe(corners([(0, -0.0045, 0), (0.0036, -0.0045, 0.0006), (0.0036, 0.0025, 0.0006), (0, 0.0025, 0)], 3), 32)
        parts += [pin.turned("z", 90 * side).moved(x - 0.002 * side, y, z) for z in AXLES]
    return joined(parts)


def track() -> tuple[Mesh, Mesh]:
    """Sleepers and rails."""
    sleepers = [box((0.118, 0.007, 0.017), (0, 0.0035, 0.037 * k), 0.0015) for k in range(-4, 5)]
    rails = [box((0.007, 0.009, 0.345), (x, 0.0115, 0), 0.0012) for x in (-0.034, 0.034)]
    return joined(sleepers), joined(rails)


def model() -> bytes:
    """The file."""
    glb = Glb()
    coat = {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.04}
    green = glb.material("green enamel", (0.012, 0.075, 0.045), 0, 0.5, KHR_materials_clearcoat=coat)
    red = glb.material("red enamel", (0.42, 0.012, 0.01), 0, 0.5, KHR_materials_clearcoat=coat)
    black = glb.material("black iron", (0.018, 0.018, 0.02), 0, 0.38)
    brass = glb.material("brass", (0.89, 0.61, 0.26), 1, 0.16)
    steel = glb.material("steel", (0.62, 0.6, 0.58), 1, 0.28)
    oak = glb.material("oak", (1, 1, 1), 0, 0.6, baseColorTexture=glb.texture(png(64, 192, wood)))
    glass = glb.material("glass", (0.97, 0.99, 0.98), 0, 0, KHR_materials_transmission={"transmissionFactor": 1})
    glow = glb.material("lamp", (1, 0.9, 0.7), 0, 0.3, emissiveFactor=[1, 0.72, 0.36], KHR_materials_emissive_strength={"emissiveStrength": 3})
    lens = lathe(corners([(0.0072, 0, 0), (0.0072, 0.002, 0.001), (0.004, 0.0045, 0.002), (0, 0.005, 0)], 4), 40)
    case = lathe(corners([(0, -0.014, 0), (0.0085, -0.014, 0.003), (0.0092, 0.003, 0.0008), (0.0076, 0.003, 0), (0.0072, 0, 0)], 4), 40)
    at = {"y": 0.136, "z": 0.104}
    sleepers, rails = track()
    engine = [
        (joined([boiler(), cab()]), green),
        (joined([bands(), dome(), whistle(), case.turned("x", 90).moved(**at)]), brass),
        (joined([door(), chimney(), roof(), box((0.05, 0.030, 0.22), (0, 0.055, 0))]), black),
        (joined([front(), box((0.09, 0.005, 0.262), (0, 0.068, -0.003))]), red),
        (joined([rods(), buffers()]), steel),
        (panes(), glass),
        (lens.turned("x", 90).moved(**at), glow),
    ]
    nodes = [
        glb.add("nodes", {"name": "engine", "mesh": glb.mesh("engine", engine)}),
        glb.add("nodes", {"name": "track", "mesh": glb.mesh("track", [(sleepers, oak), (rails, steel)])}),
    ]
    painted, bare = wheel()
    wheels = glb.mesh("wheels", [(painted, red), (bare, steel)])
    height = RAIL + WHEEL
    axles = [glb.add("nodes", {"name": "axle", "mesh": wheels, "translation": [0, height, z]}) for z in AXLES]
    glb.turning("drive", axles, 2.0)
    glb.add("scenes", {"nodes": nodes + axles})
    glb.document["scene"] = 0
    return glb.encode()
