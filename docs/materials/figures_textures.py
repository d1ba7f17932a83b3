"""The figures of the page about textures."""

from __future__ import annotations

from figures_table import Figure, sphere


def textured(name: str, textures: list[str], more: str = "", material: str = "lambertian.albedo = $") -> Figure:
    """A row of balls, each with one of the textures, which are the tables below `[texture.NAME]`."""
    tables = "\n".join(f"[texture.t{i}]\n{table}\n" for i, table in enumerate(textures))
    balls = [material.replace("$", f'"t{i}"') for i in range(len(textures))]
    return Figure(f"textures/{name}", balls, more=tables + more, spp=64)


def laid(space: str, kind: str, fields: str, mapping: str) -> str:
    """A texture table with a mapping."""
    parts = ", ".join(part for part in (f'space = "{space}"', mapping) if part)
    return f"{kind} = {{ " + ", ".join(part for part in (fields, f"mapping = {{ {parts} }}") if part) + " }"


def on_shape(kind: str, fields: str, mapping: str) -> str:
    """One that lies on the ball, 1 × 1 around it."""
    return laid("uv", kind, fields, mapping)


def solid(kind: str, fields: str, mapping: str = "") -> str:
    """One that the ball is cut from."""
    return laid("object", kind, fields, mapping)


def ramp(of: str, interpolation: str, stops: str) -> str:
    """A ramp; its stops are numbers and colours in turn."""
    words = stops.split()
    pairs = ", ".join(f'{{ at = {at}, color = "{color}" }}' for at, color in zip(words[::2], words[1::2], strict=True))
    return f'ramp = {{ input = "{of}", interpolation = "{interpolation}", stops = [{pairs}] }}'


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

MIDDLE = "offset = [0.5, 0.5, 0.5]"  # the middle of a picture in front


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
VERTEX_COLORS = (
    PAINTED
    + sphere(1.15, 0.5, "painted")
    + octahedron(
        -1.15, "[[0.9, 0.1, 0.1], [0.1, 0.5, 0.8], [0.95, 0.9, 0.3], [0.1, 0.1, 0.5], [0.2, 0.6, 0.2], [0, 0, 0]]"
    )
    + octahedron(
        0, "[[0.9, 0.9, 0.9], [0.02, 0.02, 0.02], [0.8, 0.1, 0.4], [0.1, 0.3, 0.7], [0.9, 0.6, 0.1], [0, 0, 0]]"
    )
)

TEXTURES = [
    textured(
        "image",
        [
            on_shape("image", 'file = "card.png"', "scale = [4, 2, 1], " + MIDDLE),
            on_shape("image", 'file = "card.png", filter = "nearest"', "scale = [4, 2, 1], " + MIDDLE),
            on_shape("image", 'file = "card.png", filter = "nearest", wrap = "mirror"', "scale = [8, 4, 1], " + MIDDLE),
            on_shape(
                "image",
                'file = "card.png", filter = "nearest", wrap = "clamp"',
                "scale = [4, 2, 1], offset = [-0.5, -0.5, 0]",
            ),
            on_shape("image", 'file = "card.png", filter = "nearest"', "scale = [8, 4, 1], rotation = 20, " + MIDDLE),
            solid("image", 'file = "card.png", filter = "nearest", triplanar = true', "scale = [2, 2, 2], " + MIDDLE),
        ],
    ),
    textured(
        "checker",
        [
            on_shape("checker", "", "scale = [8, 4, 1]"),
            on_shape("checker", "", "scale = [24, 12, 1]"),
            on_shape("checker", 'even = "#e76f51", odd = "#fdf0d5"', "scale = [12, 0, 1]"),
            on_shape("checker", 'even = "#e76f51", odd = "#fdf0d5"', "scale = [0, 10, 1]"),
            solid("checker", 'even = "#2a9d8f", odd = "#264653"', "scale = [4, 4, 4]"),
            solid("checker", 'even = "clouds", odd = "#7a1f1f"', "scale = [3, 3, 3], rotation = 45"),
        ],
        BASE,
    ),
    textured(
        "gradient",
        [
            solid("gradient", 'from = "#3a2b66", to = "#f4a259"', "offset = [0.5, 0, 0]"),
            solid("gradient", 'from = "#3a2b66", to = "#f4a259"', "rotation = -90, offset = [0.5, 0, 0]"),
            solid(
                "gradient",
                'from = "#3a2b66", to = "#f4a259"',
                "rotation = -45, scale = [3, 3, 3], offset = [0.5, 0, 0]",
            ),
            solid("gradient", 'from = "#fdf0d5", to = "#c1121f", radial = true', "offset = [0.2, -0.3, -0.4]"),
            solid(
                "gradient",
                'from = "#fdf0d5", to = "#c1121f", radial = true',
                "scale = [3, 3, 3], offset = [0.6, -0.9, -1.2]",
            ),
            solid(
                "gradient",
                'from = "squares", to = "#123b5d"',
                "rotation = -90, scale = [2, 2, 2], offset = [0.5, 0, 0]",
            ),
        ],
        BASE,
    ),
    textured(
        "noise",
        [
            solid("noise", "octaves = 1", "scale = [5, 5, 5]"),
            solid("noise", "octaves = 3", "scale = [5, 5, 5]"),
            solid("noise", "octaves = 8", "scale = [5, 5, 5]"),
            solid("noise", "octaves = 8, gain = 0.8", "scale = [5, 5, 5]"),
            solid("noise", 'dark = "#e9c46a", light = "#7a2e12", octaves = 7, turbulence = true', "scale = [4, 4, 4]"),
            solid("noise", 'dark = "#2f5d8a", light = "#f4f6f7", octaves = 7', "scale = [2, 8, 2]"),
        ],
    ),
    textured(
        "marble",
        [
            solid("marble", "distortion = 0, sharpness = 1", "scale = [4, 4, 4]"),
            solid("marble", "distortion = 0.5", "scale = [4, 4, 4]"),
            solid("marble", "distortion = 1.5", "scale = [2, 2, 2]"),
            solid("marble", "distortion = 4", "scale = [2, 2, 2]"),
            solid("marble", "distortion = 3, sharpness = 8, octaves = 9", "scale = [1.5, 1.5, 1.5]"),
            solid(
                "marble",
                'dark = "#1d2b27", light = "#5f8f7c", distortion = 2.2, sharpness = 2.5',
                "rotation = 35, scale = [2, 2, 2]",
            ),
        ],
    ),
    textured(
        "wood",
        [
            solid("wood", "distortion = 0", ""),
            solid("wood", "", "offset = [0.2, 0.1, 0]"),
            solid("wood", "distortion = 2.5", "offset = [0.2, 0.1, 0]"),
            solid("wood", "rings = 16", "offset = [0.6, 0.3, 0]"),
            solid("wood", 'dark = "#7a4a22", light = "#c99a5b", rings = 10', "offset = [1.5, 0.4, 0]"),
            solid("wood", 'dark = "#33241a", light = "#6d5238", rings = 14, distortion = 1.5', "offset = [0, -0.9, 0]"),
        ],
    ),
    textured(
        "ramp",
        [
            'ramp = { input = "clouds" }',
            ramp("clouds", "linear", "0.3 #1d3557 0.7 #f1faee"),
            ramp("clouds", "smooth", "0.45 #1d3557 0.55 #e63946"),
            ramp("clouds", "constant", "0 #264653 0.43 #2a9d8f 0.5 #e9c46a 0.57 #e76f51"),
            ramp("clouds", "linear", "0.3 #12355b 0.5 #2f7ea8 0.51 #e3d3a1 0.55 #5d8a45 0.65 #6f5b45 0.75 #ffffff"),
            ramp("upwards", "constant", "0 #582f0e 0.2 #a68a64 0.45 #b6ad90 0.6 #656d4a 0.8 #333d29"),
        ],
        BASE + f"[texture.upwards]\n{solid('gradient', '', 'rotation = -90, offset = [0.5, 0, 0]')}\n",
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
            on_shape("checker", "", "scale = [10, 5, 1]"),
            'checker = { mapping = { space = "world", scale = [4, 4, 4] } }',
            solid("checker", "", "scale = [4, 4, 4]"),
            solid("checker", "", "scale = [4, 4, 4], rotation = 30"),
            solid("checker", "", "scale = [4, 12, 4]"),
            solid("checker", "", "scale = [4, 4, 4], offset = [0.5, 0.5, 0.5]"),
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
