"""The Cornell box of Benedikt Bitterli's collection as a scene of the comparison, and the picture of it by his renderer as
a reference, four times smaller.

Usage: bitterli.py FOLDER-OF-THE-SCENE SCRATCH (needs the module mitsuba to read OpenEXR).
"""

import json
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import numpy as np

NAME, SHRINK = "bitterli-cornell", 4


def numbers(text):
    return [float(word) for word in text.replace(",", " ").split()]


def quads(shape):
    """Corner, u and v of a rectangle, or of the six sides of a cube."""
    matrix = np.array(numbers(shape.find("transform/matrix").get("value"))).reshape(4, 4)
    axes, origin = matrix[:3, :3].T, matrix[:3, 3]
    if shape.get("type") == "rectangle":
        x, y, _ = axes
        return [(origin - x - y, 2 * x, 2 * y)]
    sides = []
    for axis in range(3):
        for sign in (-1, 1):
            u, v = axes[(axis + 1) % 3], axes[(axis + 2) % 3]
            u, v = (u, v) if sign > 0 else (v, u)
            sides.append((origin + sign * axes[axis] - u - v, 2 * u, 2 * v))
    return sides


def convert(root):
    materials = {}
    for bsdf in root.findall("bsdf"):
        albedo = numbers(bsdf.find("bsdf/rgb").get("value"))
        materials[bsdf.get("id")] = {"type": "lambertian", "albedo": albedo}
    shapes = []
    for shape in root.findall("shape"):
        for corner, u, v in quads(shape):
            quad = {"type": "quad", "corner": list(corner), "u": list(u), "v": list(v), "material": shape.find("ref").get("id")}
            if (radiance := shape.find("emitter/rgb")) is not None:
                quad["emission"] = numbers(radiance.get("value"))
            shapes.append(quad)
    view = np.array(numbers(root.find("sensor/transform/matrix").get("value"))).reshape(4, 4)
    eye, ahead, up = view[:3, 3], view[:3, 2], view[:3, 1]
    camera = {
        "from": list(eye), "at": list(eye + ahead), "up": list(up), "defocus_angle": 0, "focus_dist": 1,
        "vfov": float(root.find("sensor/float[@name='fov']").get("value")),
    }
    side = int(root.find("default[@name='resx']").get("value")) // SHRINK
    depth = int(root.find("default[@name='max_depth']").get("value"))
    return {
        "name": NAME, "width": side, "height": side, "max_depth": depth, "camera": camera,
        "environment": None, "materials": materials, "shapes": shapes,
    }


def main(folder, scratch):
    import mitsuba

    mitsuba.set_variant("scalar_rgb")
    scene = convert(xml.parse(folder / "scene_v3.xml").getroot())
    (scratch / "scenes" / f"{NAME}.json").write_text(json.dumps(scene))
    picture = np.array(mitsuba.Bitmap(str(folder / "TungstenRender.exr"))).astype(float)[..., :3]
    side = scene["width"]
    np.save(scratch / "ref" / NAME, picture.reshape(side, SHRINK, side, SHRINK, 3).mean((1, 3)).astype(np.float32))


main(Path(sys.argv[1]), Path(sys.argv[2]))
