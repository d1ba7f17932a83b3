#!/usr/bin/env python3
"""Renders the figures of the pages about materials and textures: a row of balls for each.

    python3 docs/materials/figures.py                     # all, to docs/materials and docs/textures
    python3 docs/materials/figures.py materials/sheen     # this one
    python3 docs/materials/figures.py --quick             # all, tiny and noisy, to a temporary folder that it names

Python 3.11, and nothing else but the command `eyebeam` (--eyebeam PATH, or target/release/eyebeam). What is in the
figures stands in figures_table.py and figures_textures.py, as the text of scene files.
"""

from __future__ import annotations

import argparse
import math
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from figures_pictures import PICTURES
from figures_table import MATERIALS, Figure
from figures_textures import TEXTURES

FIGURES = [*MATERIALS, *TEXTURES]
DOCS = Path(__file__).resolve().parent.parent
LARGEST = 80_000  # bytes of a picture
QUALITIES = (93, 90, 86, 80, 70)
APART = 1.15  # metres between balls
HEIGHT = 1.74  # metres from the bottom to the top of a figure
FAR = 14.0  # metres from the camera to the balls

STAGE = """
[environment.constant]
radiance = {sky}

[material]
stage-sheet.lambertian.albedo = {paper}
stage-top.emissive.radiance = {top}
stage-left.emissive.radiance = {left}
stage-right.emissive.radiance = {right}
stage-strip.lambertian.albedo = "stage-squares"

[texture.stage-squares.checker]
even = "#d8d2c4"
odd = "#3f5d6b"
mapping = {{ scale = [5, 5, 5], offset = [0, 0, 0.5] }}

[[shape.quad]]
corner = [-5, 4.5, -2]
u = [10, 0, 0]
v = [0, 0.7, 2.6]
material = "stage-top"

[[shape.quad]]
corner = [-6.5, 0.3, 4]
u = [-1.6, 0, -3.6]
v = [0, 3.6, 0]
material = "stage-left"

[[shape.quad]]
corner = [6.2, 0.2, 1]
u = [-0.8, 0, 3]
v = [0, 4, 0]
material = "stage-right"
"""

STRIP = """
[[shape.quad]]
corner = [-20, 0, -1.1]
u = [40, 0, 0]
v = [0, 0.8, 0]
material = "stage-strip"
"""


def sheet() -> str:
    """Paper that lies on the floor and runs up the wall without a seam."""
    profile = [(9.0, 0.0, 0.0), (-2.5, 0.0, 0.0)]
    steps, radius = 12, 2.0
    for k in range(1, steps + 1):
        angle = 0.5 * math.pi * k / steps
        profile.append((-2.5 - radius * math.sin(angle), radius * (1 - math.cos(angle)), angle))
    profile.append((-4.5, 12.0, 0.5 * math.pi))
    vertices, normals, triangles = [], [], []
    for z, y, angle in profile:
        for x in (-20.0, 20.0):
            vertices.append([x, round(y, 6), round(z, 6)])
            normals.append([0.0, round(math.cos(angle), 6), round(math.sin(angle), 6)])
    for k in range(0, len(vertices) - 2, 2):
        triangles += [[k, k + 1, k + 3], [k, k + 3, k + 2]]
    lists = f"vertices = {vertices}\nnormals = {normals}\ntriangles = {triangles}"
    return f'[[shape.mesh]]\n{lists}\nmaterial = "stage-sheet"\n'


def scene(figure: Figure) -> str:
    """The scene file of a figure."""
    count = figure.places or len(figure.balls)
    vfov = 2 * math.degrees(math.atan(0.5 * HEIGHT / FAR))
    parts = [
        f"[render]\nspp = {figure.spp}\n",
        f"[camera]\nlook_from = [0, 2.3, {FAR}]\nlook_at = [0, 0.53, 0]\nvfov = {vfov:.4f}\n",
        STAGE.format(
            sky=figure.sky,
            paper=figure.paper,
            top=3.2 * figure.light,
            left=7.5 * figure.light,
            right=3.5 * figure.light,
        ),
        sheet(),
    ]
    if figure.strip:
        parts.append(STRIP)
    parts.append(figure.more)
    for i, ball in enumerate(figure.balls):
        x = round(APART * (i - 0.5 * (count - 1)), 4)
        parts.append(f"[material.ball-{i}]\n{ball}\n")
        parts.append(f'[[shape.sphere]]\ncenter = [{x}, 0.5, 0]\nradius = 0.5\nmaterial = "ball-{i}"\n')
    return "\n".join(parts)


def run(command: list[str], folder: str) -> None:
    """Runs a command in a folder; if it fails, ends with what it said."""
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{done.stderr}")


def render(figure: Figure, eyebeam: str, folder: Path, options: argparse.Namespace) -> None:
    """Renders a figure and makes it small enough."""
    count = figure.places or len(figure.balls)
    width, height = round(120 * count * figure.scale), round(180 * figure.scale)
    if options.quick:
        width, height = width // 20, height // 20
    spp = 2 if options.quick else options.spp or figure.spp
    with tempfile.TemporaryDirectory() as scratch:
        for name, write in PICTURES.items():
            Path(scratch, name).write_bytes(write())
        # Without a folder: pictures carry the name of their scene, which shall be the same on every machine.
        file, linear = "figure.toml", "linear.exr"
        Path(scratch, file).write_text(scene(figure), encoding="utf-8")
        size = ["-r", f"{width}x{height}", "--spp", str(spp)]
        if options.threads:
            size += ["-t", str(options.threads)]
        run([eyebeam, "render", file, "-q", "--strict", "-o", linear, *size], scratch)
        picture = folder / f"{figure.name}.jpg"
        picture.parent.mkdir(parents=True, exist_ok=True)
        for quality in QUALITIES:
            look = ["--view", "agx", "--exposure", str(figure.exposure), "--quality", str(quality)]
            run([eyebeam, "develop", linear, "-q", "-o", str(picture), *look], scratch)
            if picture.stat().st_size <= LARGEST:
                break


def main() -> None:
    """Renders what the arguments say."""
    parser = argparse.ArgumentParser(description="Renders the figures of materials and textures.")
    parser.add_argument("figures", nargs="*", help="names of figures; all if absent")
    parser.add_argument("--quick", action="store_true", help="tiny pictures, to a temporary folder")
    parser.add_argument("--eyebeam", default=str(DOCS.parent / "target/release/eyebeam"), help="the command")
    parser.add_argument("--output", type=Path, help="folder to write to")
    parser.add_argument("--spp", type=int, help="samples per pixel, instead of each figure's own")
    parser.add_argument("--threads", type=int, help="threads; all processors if absent")
    options = parser.parse_args()
    unknown = set(options.figures) - {figure.name for figure in FIGURES}
    if unknown:
        parser.error(f"no such figure: {', '.join(sorted(unknown))}")
    folder = options.output or (Path(tempfile.mkdtemp()) if options.quick else DOCS)
    folder, eyebeam = folder.resolve(), str(Path(shutil.which(options.eyebeam) or options.eyebeam).resolve())
    for figure in FIGURES:
        if not options.figures or figure.name in options.figures:
            print(figure.name, flush=True)
            render(figure, eyebeam, folder, options)
    print(folder)


if __name__ == "__main__":
    main()
