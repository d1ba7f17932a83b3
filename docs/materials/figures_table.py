"""What is in the figures: for each its balls, from left to right, as the material tables of a scene file."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Figure:
    """A row of balls."""

    name: str  # of the file, from docs on
    balls: list[str]  # material tables
    more: str = ""  # textures, materials and shapes besides
    strip: bool = False  # squares behind the balls, for what is clear
    places: int = 0  # how many balls it is wide; as many as there are if 0
    scale: float = 1.0  # factor on its size, which is 120 × 180 pixels a ball
    exposure: float = 0.25
    light: float = 1.0  # factor on the lamps
    sky: float = 0.15  # radiance from everywhere
    paper: float = 0.32  # albedo of what they lie on
    spp: int = 128


def each(text: str, values: Iterable[object]) -> list[str]:
    """The same material with each of the values instead of $."""
    return [text.replace("$", str(value)) for value in values]


def sphere(x: float, radius: float, material: str) -> str:
    """One more sphere in the row."""
    return f'[[shape.sphere]]\ncenter = [{x:.4f}, 0.5, 0]\nradius = {radius}\nmaterial = "{material}"\n'


SIX = (0, 0.2, 0.4, 0.6, 0.8, 1)

# Lamps inside of shades.
FILAMENTS = "[material.filament.emissive]\nradiance = [16, 13.5, 10]\n" + "".join(
    sphere(1.15 * (i - 2.5), 0.1, "filament") for i in range(6)
)

# Blue glass and something red that overlap; the priorities of both.
PAIRS = "".join(
    f"""
[material.blue-{i}.dielectric]
eta = 1.5
transmittance = [0.3, 0.55, 0.8]
transmittance_distance = 0.5
priority = {blue}

[material.red-{i}.dielectric]
eta = 1.33
transmittance = [0.85, 0.3, 0.2]
transmittance_distance = 0.5
priority = {red}
"""
    + sphere(2.3 * (i - 1) - 0.3, 0.5, f"blue-{i}")
    + sphere(2.3 * (i - 1) + 0.3, 0.5, f"red-{i}")
    for i, (blue, red) in enumerate([(0, 0), (2, 1), (1, 2)])
)

MATTE = [
    Figure(
        "materials/lambertian",
        each("lambertian.albedo = $", (0.02, 0.2, 0.5, 0.9, '"#b5432a"', '"#2f6690"')),
    ),
    Figure(
        "materials/oren-nayar",
        each("oren-nayar = { albedo = [0.75, 0.56, 0.42], roughness = $ }", SIX),
        more="[[light.directional]]\ndirection = [0, 0.3, 1]\nirradiance = 2.6\nangle = 4\n",
        light=0.05,
        sky=0.03,
    ),
    Figure(
        "materials/diffuse-transmission",
        each(
            "diffuse-transmission = { reflectance = [0.3, 0.28, 0.24], transmittance = $ }",
            (
                0,
                "[0.14, 0.11, 0.06]",
                "[0.28, 0.22, 0.12]",
                "[0.42, 0.33, 0.18]",
                "[0.56, 0.44, 0.24]",
                "[0.7, 0.55, 0.3]",
            ),
        ),
        more=FILAMENTS,
        light=0.5,
    ),
    Figure(
        "materials/sheen",
        each(
            "sheen = { color = [0.9, 0.45, 0.5], roughness = $, albedo = [0.12, 0.01, 0.03] }", (0.3, 0.45, 0.6, 0.8, 1)
        )
        + ["sheen = { color = 0, albedo = [0.12, 0.01, 0.03] }"],
    ),
]

METALS = [
    Figure("materials/metal", each("metal = { albedo = [0.9, 0.75, 0.4], roughness = $ }", SIX), exposure=-0.1),
    Figure("materials/conductor", each('conductor = { metal = "copper", roughness = $ }', SIX), exposure=-0.1),
    Figure(
        "materials/conductor-anisotropy",
        each('conductor = { metal = "aluminium", roughness = 0.4, anisotropy = $ }', (0, 0.4, 0.8, 1))
        + each('conductor = { metal = "aluminium", roughness = 0.4, anisotropy = 1, rotation = $ }', (45, 90)),
        exposure=-0.1,
    ),
    Figure(
        "materials/conductor-metals",
        each(
            'conductor = { metal = "$", roughness = 0.25 }',
            "aluminium brass chromium copper gold iron nickel platinum silver titanium tungsten".split(),
        ),
        scale=0.6,
        exposure=-0.1,
        spp=160,
    ),
    Figure(
        "materials/conductor-compensation",
        each('conductor = { metal = "gold", roughness = $ }', (0.4, 0.7, 1))
        + each('conductor = { metal = "gold", roughness = $, compensation = false }', (0.4, 0.7, 1)),
        exposure=-0.1,
    ),
]

CLEAR = [
    Figure("materials/dielectric", each("dielectric = { eta = 1.5, roughness = $ }", SIX), strip=True, spp=224),
    Figure(
        "materials/dielectric-eta", each("dielectric.eta = $", (1.05, 1.2, 1.33, 1.5, 1.8, 2.42)), strip=True, spp=160
    ),
    Figure(
        "materials/dielectric-dispersion",
        each("dielectric = { eta = 1.7, abbe_number = $ }", (10000, 60, 30, 15, 8, 4)),
        strip=True,
        spp=320,
    ),
    Figure(
        "materials/thin-dielectric",
        each("thin-dielectric.eta = $", (1.1, 1.33, 1.5, 2.42))
        + each("thin-dielectric = { eta = 1.5, color = $ }", ("[0.9, 0.5, 0.3]", "[0.3, 0.6, 0.8]")),
        strip=True,
    ),
    Figure(
        "materials/fillings",
        each(
            "dielectric = { eta = 1.5, transmittance = [0.25, 0.7, 0.55], transmittance_distance = $ }",
            (8, 4, 2, 1, 0.5, 0.25),
        ),
        strip=True,
        spp=160,
    ),
    Figure(
        "materials/fillings-priority",
        [],
        places=6,
        more=PAIRS,
        strip=True,
        spp=160,
    ),
]

LAYERS = [
    Figure("materials/plastic", each("plastic = { albedo = [0.6, 0.03, 0.02], roughness = $ }", SIX)),
    Figure(
        "materials/plastic-eta", each("plastic = { albedo = [0.05, 0.25, 0.3], eta = $ }", (1, 1.2, 1.35, 1.5, 2, 3))
    ),
    Figure(
        "materials/principled-base",
        each("principled = { base_color = [0.85, 0.5, 0.2], base_metalness = $ }", SIX),
    ),
    Figure(
        "materials/principled-specular",
        each("principled = { base_color = [0.05, 0.2, 0.35], specular_roughness = $ }", SIX),
    ),
    Figure(
        "materials/principled-transmission",
        each(
            "principled = { base_color = [0.2, 0.5, 0.3], transmission_color = [0.75, 0.95, 0.85], "
            "specular_roughness = 0.05, transmission_weight = $ }",
            SIX,
        ),
        strip=True,
        spp=224,
    ),
    Figure(
        "materials/principled-coat",
        each(
            "principled = { base_color = [0.6, 0.08, 0.02], base_metalness = 0.7, specular_roughness = 0.5, "
            "coat_weight = $ }",
            SIX,
        ),
    ),
    Figure(
        "materials/principled-fuzz",
        each(
            "principled = { base_color = [0.03, 0.06, 0.16], specular_weight = 0.2, fuzz_color = [0.7, 0.8, 1], "
            "fuzz_weight = $ }",
            SIX,
        ),
    ),
    Figure(
        "materials/principled-film",
        each(
            "principled = { base_color = 0.04, specular_roughness = 0.15, specular_ior = 2, thin_film_weight = 1, "
            "thin_film_thickness = $ }",
            (0, 0.15, 0.25, 0.35, 0.5, 0.8),
        ),
    ),
    Figure(
        "materials/thin-film",
        each(
            'conductor = { metal = "iron", roughness = 0.2, thin_film = { thickness = $, eta = 2.4 } }',
            (0, 25, 45, 60, 80, 120),
        ),
    ),
    Figure(
        "materials/thin-film-bubble",
        each("dielectric = { eta = 1, thin_film = { thickness = $, eta = 1.33 } }", (0, 100, 200, 300, 450, 700)),
        sky=0.6,
        paper=0.03,
        spp=256,
    ),
]

FLAKES = """
[texture.flakes.noise]
octaves = 6
gain = 0.6
mapping = { space = "object", scale = [5, 5, 5] }

[texture.cut.ramp]
input = "flakes"
interpolation = "smooth"
stops = [{ at = 0.48, color = 0 }, { at = 0.52, color = 1 }]

[texture.squares.checker]
even = 0
odd = 1
mapping = { space = "uv", scale = [16, 8, 1] }

[texture.stripes.checker]
even = 0
odd = 1
mapping = { space = "uv", scale = [24, 0, 1] }
"""

PARTS = """
[material.paint.lambertian]
albedo = "#276b7d"

[material.bare.conductor]
metal = "copper"
roughness = 0.35

[material.clay.lambertian]
albedo = "#c8673f"

[material.nothing.null]

[material.polished.conductor]
metal = "copper"
roughness = 0.25

[material.enamel.plastic]
albedo = [0.04, 0.13, 0.3]
"""

OTHERS = [
    Figure(
        "materials/emissive",
        each("emissive.radiance = $", ("[0.1, 0.08, 0.05]", "[0.4, 0.3, 0.18]", "[1.5, 1.1, 0.7]", "[5, 3.8, 2.4]"))
        + ['emissive.radiance = "bands"', "emissive = { radiance = [0.05, 0.15, 0.6], albedo = 0.5 }"],
        more="""
[texture.bands.checker]
even = [0.05, 1.2, 0.7]
odd = 0.02
mapping = { space = "uv", scale = [0, 12, 1] }
""",
        light=0.12,
        sky=0.03,
        exposure=1.0,
    ),
    Figure(
        "materials/null",
        ["lambertian.albedo = '#c8673f'", "null = {}"]
        + each('mix = { a = "clay", b = "nothing", share = $ }', (0.3, 0.6, '"squares"', '"cut"')),
        more=FLAKES + PARTS,
    ),
    Figure(
        "materials/mix",
        each('mix = { a = "paint", b = "bare", share = $ }', (0, 0.33, 0.67, 1, '"squares"', '"cut"')),
        more=FLAKES + PARTS,
    ),
    Figure(
        "materials/mask",
        each('mask = { of = "clay", opacity = $ }', (0.1, 0.4, 0.8, '"stripes"', '"squares"', '"cut"')),
        more=FLAKES + PARTS,
    ),
    Figure(
        "materials/normal-map",
        [
            f'normal-map = {{ of = "{of}", map = "studs", strength = {strength} }}'
            for of, strength in [
                ("enamel", 0.3),
                ("enamel", 1),
                ("enamel", -1),
                ("polished", 0.3),
                ("polished", 1),
                ("polished", -1),
            ]
        ],
        more=PARTS
        + '[texture.studs.image]\nfile = "studs.png"\nencoding = "linear"\nmapping = { scale = [16, 8, 1] }\n',
    ),
    Figure(
        "materials/bump",
        [
            f'bump = {{ of = "{of}", height = "{height}", scale = {scale} }}'
            for of, height, scale in [
                ("enamel", "flakes", 0.02),
                ("enamel", "flakes", 0.08),
                ("enamel", "cut", 0.01),
                ("polished", "flakes", 0.02),
                ("polished", "flakes", 0.08),
                ("polished", "ribs", 0.02),
            ]
        ],
        more=FLAKES
        + PARTS
        + """
[texture.ribs.marble]
dark = 0
light = 1
distortion = 0
sharpness = 1
mapping = { space = "object", rotation = 90, scale = [8, 8, 8] }
""",
    ),
]

MATERIALS = [*MATTE, *METALS, *CLEAR, *LAYERS, *OTHERS]
