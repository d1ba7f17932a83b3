"""The figures of the page about textures."""

from __future__ import annotations

from figures_table import Figure, sphere


def textured(name: str, textures: list[str], more: str = "", material: str = "lambertian.albedo = $") -> Figure:
    """A row of balls, each with one of the textures, which are the tables below `[texture.NAME]`."""
    tables = "\n".join(f"[texture.t{i}]\n{table}\n" for i, table in enumerate(textures))
    balls = [material.replace("$", f'"t{i}"') for i in range(len(textures))]
    return Figure(f"textures/{name}", balls, more=tables + more, spp=64)


BASE = """
[texture.clouds.noise]
octaves = 6
gain = 0.6
mapping = { space = "object", scale = [5, 5, 5] }

[texture.squares.checker]
even = 0.9
odd = 0.25
mapping = { space = "uv", scale = [16, 8, 1] }

[texture.card.image]
file = "card.png"
filter = "nearest"
mapping = { scale = [4, 2, 1], offset = [0.5, 0.5, 0] }

[texture.cut.ramp]
input = "clouds"
interpolation = "smooth"
stops = [{ at = 0.46, color = 0 }, { at = 0.54, color = 1 }]
"""

UV = 'mapping = { space = "uv", scale'
MIDDLE = "offset = [0.5, 0.5, 0.5]"  # the middle of a picture in front
LOOSE = 'mapping = { space = "object"'


def octahedron(x: float, colors: str) -> str:
    """A mesh whose vertices have colours: right, left, top, bottom, front, back."""
    r = 0.5
    tips = [[x + r, r, 0], [x - r, r, 0], [x, 2 * r, 0], [x, 0, 0], [x, r, r], [x, r, -r]]
    faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    return f'[[shape.mesh]]\nvertices = {tips}\ntriangles = {faces}\ncolors = {colors}\nmaterial = "painted"\n'


PAINTED = """
[texture.painted.vertex-color]
otherwise = [0.1, 0.35, 0.4]

[material.painted.lambertian]
albedo = "painted"
"""
VERTEX_COLORS = PAINTED + sphere(1.15, 0.5, "painted") + octahedron(
    -1.15, "[[0.9, 0.1, 0.1], [0.1, 0.5, 0.8], [0.95, 0.9, 0.3], [0.1, 0.1, 0.5], [0.2, 0.6, 0.2], [0, 0, 0]]"
) + octahedron(0, "[[0.9, 0.9, 0.9], [0.02, 0.02, 0.02], [0.8, 0.1, 0.4], [0.1, 0.3, 0.7], [0.9, 0.6, 0.1], [0, 0, 0]]")

TEXTURES = [
    textured(
        "image",
        [
            f'image = {{ file = "card.png", {UV} = [4, 2, 1], {MIDDLE} }} }}',
            f'image = {{ file = "card.png", filter = "nearest", {UV} = [4, 2, 1], {MIDDLE} }} }}',
            f'image = {{ file = "card.png", filter = "nearest", wrap = "mirror", {UV} = [8, 4, 1], {MIDDLE} }} }}',
            f'image = {{ file = "card.png", filter = "nearest", wrap = "clamp", {UV} = [4, 2, 1], offset = [-0.5, -0.5, 0] }} }}',
            f'image = {{ file = "card.png", filter = "nearest", {UV} = [8, 4, 1], rotation = 20, {MIDDLE} }} }}',
            f'image = {{ file = "card.png", filter = "nearest", triplanar = true, {LOOSE}, scale = [2, 2, 2], {MIDDLE} }} }}',
        ],
    ),
    textured(
        "checker",
        [
            f'checker = {{ {UV} = [8, 4, 1] }} }}',
            f'checker = {{ {UV} = [24, 12, 1] }} }}',
            f'checker = {{ even = "#e76f51", odd = "#fdf0d5", {UV} = [12, 0, 1] }} }}',
            f'checker = {{ even = "#e76f51", odd = "#fdf0d5", {UV} = [0, 10, 1] }} }}',
            f'checker = {{ even = "#2a9d8f", odd = "#264653", {LOOSE}, scale = [4, 4, 4] }} }}',
            f'checker = {{ even = "clouds", odd = "#7a1f1f", {LOOSE}, scale = [3, 3, 3], rotation = 45 }} }}',
        ],
        BASE,
    ),
    textured(
        "gradient",
        [
            f'gradient = {{ from = "#3a2b66", to = "#f4a259", {LOOSE}, offset = [0.5, 0, 0] }} }}',
            f'gradient = {{ from = "#3a2b66", to = "#f4a259", {LOOSE}, rotation = -90, offset = [0.5, 0, 0] }} }}',
            f'gradient = {{ from = "#3a2b66", to = "#f4a259", {LOOSE}, rotation = -45, scale = [3, 3, 3], offset = [0.5, 0, 0] }} }}',
            f'gradient = {{ from = "#fdf0d5", to = "#c1121f", radial = true, {LOOSE}, offset = [0.2, -0.3, -0.4] }} }}',
            f'gradient = {{ from = "#fdf0d5", to = "#c1121f", radial = true, {LOOSE}, scale = [3, 3, 3], offset = [0.6, -0.9, -1.2] }} }}',
            f'gradient = {{ from = "squares", to = "#123b5d", {LOOSE}, rotation = -90, scale = [2, 2, 2], offset = [0.5, 0, 0] }} }}',
        ],
        BASE,
    ),
    textured(
        "noise",
        [
            f'noise = {{ octaves = 1, {LOOSE}, scale = [5, 5, 5] }} }}',
            f'noise = {{ octaves = 3, {LOOSE}, scale = [5, 5, 5] }} }}',
            f'noise = {{ octaves = 8, {LOOSE}, scale = [5, 5, 5] }} }}',
            f'noise = {{ octaves = 8, gain = 0.8, {LOOSE}, scale = [5, 5, 5] }} }}',
            f'noise = {{ dark = "#e9c46a", light = "#7a2e12", octaves = 7, turbulence = true, {LOOSE}, scale = [4, 4, 4] }} }}',
            f'noise = {{ dark = "#2f5d8a", light = "#f4f6f7", octaves = 7, {LOOSE}, scale = [2, 8, 2] }} }}',
        ],
    ),
    textured(
        "marble",
        [
            f'marble = {{ distortion = 0, sharpness = 1, {LOOSE}, scale = [4, 4, 4] }} }}',
            f'marble = {{ distortion = 0.5, {LOOSE}, scale = [4, 4, 4] }} }}',
            f'marble = {{ distortion = 1.5, {LOOSE}, scale = [2, 2, 2] }} }}',
            f'marble = {{ distortion = 4, {LOOSE}, scale = [2, 2, 2] }} }}',
            f'marble = {{ distortion = 3, sharpness = 8, octaves = 9, {LOOSE}, scale = [1.5, 1.5, 1.5] }} }}',
            f'marble = {{ dark = "#1d2b27", light = "#5f8f7c", distortion = 2.2, sharpness = 2.5, {LOOSE}, rotation = 35, scale = [2, 2, 2] }} }}',
        ],
    ),
    textured(
        "wood",
        [
            f'wood = {{ distortion = 0, {LOOSE} }} }}',
            f'wood = {{ {LOOSE}, offset = [0.2, 0.1, 0] }} }}',
            f'wood = {{ distortion = 2.5, {LOOSE}, offset = [0.2, 0.1, 0] }} }}',
            f'wood = {{ rings = 16, {LOOSE}, offset = [0.6, 0.3, 0] }} }}',
            f'wood = {{ dark = "#7a4a22", light = "#c99a5b", rings = 10, {LOOSE}, offset = [1.5, 0.4, 0] }} }}',
            f'wood = {{ dark = "#33241a", light = "#6d5238", rings = 14, distortion = 1.5, {LOOSE}, offset = [0, -0.9, 0] }} }}',
        ],
    ),
    textured(
        "ramp",
        [
            'ramp = { input = "clouds" }',
            'ramp = { input = "clouds", stops = [{ at = 0.3, color = "#1d3557" }, { at = 0.7, color = "#f1faee" }] }',
            'ramp = { input = "clouds", interpolation = "smooth", stops = [{ at = 0.45, color = "#1d3557" }, { at = 0.55, color = "#e63946" }] }',
            'ramp = { input = "clouds", interpolation = "constant", stops = [{ at = 0, color = "#264653" }, { at = 0.43, color = "#2a9d8f" }, '
            '{ at = 0.5, color = "#e9c46a" }, { at = 0.57, color = "#e76f51" }] }',
            'ramp = { input = "clouds", stops = [{ at = 0.3, color = "#12355b" }, { at = 0.5, color = "#2f7ea8" }, { at = 0.51, color = "#e3d3a1" }, '
            '{ at = 0.55, color = "#5d8a45" }, { at = 0.65, color = "#6f5b45" }, { at = 0.75, color = "#ffffff" }] }',
            'ramp = { input = "upwards", interpolation = "constant", stops = [{ at = 0, color = "#582f0e" }, { at = 0.2, color = "#a68a64" }, '
            '{ at = 0.45, color = "#b6ad90" }, { at = 0.6, color = "#656d4a" }, { at = 0.8, color = "#333d29" }] }',
        ],
        BASE + f'[texture.upwards.gradient]\n{LOOSE}, rotation = -90, offset = [0.5, 0, 0] }}\n',
    ),
    textured(
        "combined",
        [
            'mix = { a = "#5b6770", b = "#b5622f", share = 0.5 }',
            'mix = { a = "#4f7386", b = "#b5622f", share = "cut" }',
            'multiply = { a = "squares", b = "clouds" }',
            'multiply = { a = "card", b = "#ffb47a" }',
            'invert = { input = "card" }',
            'channel = { input = "card", channel = "red" }',
        ],
        BASE,
    ),
    textured(
        "mapping",
        [
            f'checker = {{ {UV} = [10, 5, 1] }} }}',
            'checker = { mapping = { space = "world", scale = [4, 4, 4] } }',
            f'checker = {{ {LOOSE}, scale = [4, 4, 4] }} }}',
            f'checker = {{ {LOOSE}, scale = [4, 4, 4], rotation = 30 }} }}',
            f'checker = {{ {LOOSE}, scale = [4, 12, 4] }} }}',
            f'checker = {{ {LOOSE}, scale = [4, 4, 4], offset = [0.5, 0.5, 0.5] }} }}',
        ],
    ),
    Figure(
        "textures/vertex-color",
        [],
        places=3,
        more=VERTEX_COLORS,
        spp=64,
    ),
    Figure(
        "textures/numbers",
        [
            'conductor = { metal = "copper", roughness = "clouds" }',
            'conductor = { metal = "copper", roughness = "squares" }',
            'plastic = { albedo = [0.04, 0.13, 0.3], roughness = "clouds" }',
            'principled = { base_color = [0.85, 0.5, 0.2], base_metalness = "cut" }',
            'principled = { base_color = [0.6, 0.08, 0.02], specular_roughness = 0.5, coat_weight = "squares" }',
            'sheen = { color = "squares", albedo = [0.02, 0.05, 0.15] }',
        ],
        more=BASE,
        spp=96,
    ),
]
