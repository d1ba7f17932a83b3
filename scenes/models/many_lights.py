"""The scene of many lights, which is a long list."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

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
look_at = [0, 0.42, 0]
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


def scene() -> str:
    """Lamps as the seeds of a sunflower, coloured around the circle."""
    hues, count = 12, 640
    lines = [MANY_LIGHTS.rstrip()]
    for k in range(hues):
        channels = [max(0.0, 0.5 + 0.5 * cos(2 * pi * (k / hues - third / 3))) ** 1.8 for third in range(3)]
        lines.append(f"lamp-{k + 1}.emissive.radiance = [{', '.join(f'{3.2 * c + 0.05:.2f}' for c in channels)}]")
    lines += [
        "",
        "[[shape.quad]]",
        "corner = [-60, 0, 60]",
        "u = [120, 0, 0]",
        "v = [0, 0, -120]",
        'material = "floor"',
    ]
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
