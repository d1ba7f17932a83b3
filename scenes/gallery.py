#!/usr/bin/env python3
"""Renders the gallery: every picture of the table below, and a page that shows them.

    python3 scenes/gallery.py                     # all, to docs/gallery
    python3 scenes/gallery.py hero-glass metals   # these, and the page anew
    python3 scenes/gallery.py --quick             # all, tiny and noisy, to a temporary folder that it names

Python 3.11, and nothing else but the command `eyebeam` (--eyebeam PATH, or target/release/eyebeam).
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

SCENES = Path(__file__).resolve().parent
ROOT = SCENES.parent
LARGEST = 250_000  # bytes of a picture
QUALITIES = (93, 90, 86, 80, 72, 60)


@dataclass(frozen=True)
class Picture:
    """What is rendered, how, and what is said below it."""

    scene: str
    size: tuple[int, int]
    spp: int
    exposure: float
    caption: str
    look: str = ""

    def options(self) -> str:
        """The options of its look."""
        return f"{self.look} --exposure {self.exposure}".strip()


PICTURES = [
    Picture("hero-glass", (960, 540), 360, 0.3, "Marbles on black acrylic, and lamps out of focus."),
    Picture("hero-product", (640, 800), 260, 0.3, "A bottle of perfume on marble, in the light of three softboxes."),
    Picture("hero-interior", (660, 440), 300, 0.45, "A room on a late morning."),
    Picture("depth-of-field", (900, 600), 160, 1.0, "Chess, through an aperture of six blades."),
    Picture("sun-sky", (900, 600), 96, -0.3, "A courtyard, lit by a computed sun and sky."),
    Picture("glass", (840, 520), 160, 0.0, "Glass, and the light that it gathers."),
    Picture(
        "materials",
        (1000, 720),
        96,
        0.6,
        "Every material; [scenes](../../scenes/README.md#materials) tells the numbers.",
    ),
    Picture(
        "metals",
        (960, 420),
        96,
        0.3,
        "Gold, silver, copper and aluminium; behind them iron, titanium, chromium and brass.",
    ),
    Picture("motion-blur", (960, 480), 144, 0.3, "A pinwheel, a thrown ball and a rolling marble, while the shutter is open."),
    Picture("many-lights", (960, 480), 112, 0.7, "Six hundred small lamps."),
    Picture("cornell-glass", (480, 480), 192, 0.6, "A mirror and a ball of glass in a box."),
    Picture(
        "cornell-blocks",
        (480, 480),
        192,
        1.9,
        "The Cornell box as it was measured.",
        "--view agx-base --contrast 1.05 --white-balance 4300",
    ),
    Picture("layers", (960, 217), 128, 0.3, "Coats, fuzz and thin films."),
    Picture("roughness-conductor", (960, 270), 112, 0.5, "Copper, from a mirror to completely rough."),
    Picture("roughness-dielectric", (960, 270), 144, 1.0, "Glass, from polished to frosted."),
    Picture("roughness-matte", (960, 270), 80, 0.5, "What is matte: lambertian, rougher, and cloth."),
]


def run(command: list[str]) -> None:
    """Runs a command; if it fails, ends with what it said."""
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{done.stderr}")


def render(picture: Picture, eyebeam: str, folder: Path, is_quick: bool) -> dict[str, float]:
    """Renders a picture and makes it small enough; what was measured."""
    width, height = (32, 18) if is_quick else picture.size
    with tempfile.TemporaryDirectory() as scratch:
        linear, stats = f"{scratch}/linear.exr", f"{scratch}/stats.json"
        # From the repository: pictures carry the name of their scene, which shall be the same on every machine.
        scene, size = f"scenes/{picture.scene}.toml", f"{width}x{height}"
        spp = 2 if is_quick else picture.spp
        run([eyebeam, "render", scene, "-q", "--strict", "-o", linear, "--stats", stats, "-r", size, "--spp", str(spp)])
        file = folder / f"{picture.scene}.jpg"
        for quality in QUALITIES:
            run(
                [
                    eyebeam,
                    "develop",
                    linear,
                    "-q",
                    "-o",
                    str(file),
                    "--quality",
                    str(quality),
                    *picture.options().split(),
                ]
            )
            if file.stat().st_size <= LARGEST:
                break
        measured = json.loads(Path(stats).read_text())
    return {
        "width": width,
        "height": height,
        "spp": spp,
        "seconds": round(measured["seconds"]["render"], 1),
        "threads": measured["threads"],
        "error": round(measured["error"]["mean"], 4),
    }


def page(measured: dict[str, dict[str, float]]) -> str:
    """The page: each picture with its caption and what was measured."""
    lines = [
        "# Gallery",
        "",
        "Rendered by `make gallery` from the [scenes](../../scenes/README.md) of this repository. The error is the estimated "
        "standard deviation of a pixel in parts of its brightness, the mean over the picture; nothing is denoised.",
        "",
    ]
    for picture in PICTURES:
        if picture.scene not in measured:
            continue
        m = measured[picture.scene]
        threads = "1 thread" if m["threads"] == 1 else f"{m['threads']} threads"
        lines += [
            f"![{picture.scene}]({picture.scene}.jpg)",
            "",
            f"**{picture.caption}** [{picture.scene}.toml](../../scenes/{picture.scene}.toml), {m['width']} × {m['height']}, "
            f"{m['spp']} samples per pixel, {m['seconds']:.0f} s on {threads}, error {100 * m['error']:.1f} %. "
            f"`{picture.options()}`",
            "",
        ]
    return "\n".join(lines)


def main() -> None:
    """Renders what the arguments say."""
    parser = argparse.ArgumentParser(description="Renders the gallery.")
    parser.add_argument("scenes", nargs="*", help="names of scenes; all if absent")
    parser.add_argument("--quick", action="store_true", help="tiny pictures, to a temporary folder")
    parser.add_argument("--eyebeam", default=str(ROOT / "target/release/eyebeam"), help="the command")
    parser.add_argument("--output", type=Path, help="folder to write to")
    arguments = parser.parse_args()
    unknown = set(arguments.scenes) - {p.scene for p in PICTURES}
    if unknown:
        parser.error(f"no such picture: {', '.join(sorted(unknown))}")
    folder = arguments.output or (Path(tempfile.mkdtemp()) if arguments.quick else ROOT / "docs/gallery")
    folder, eyebeam = folder.resolve(), str(Path(shutil.which(arguments.eyebeam) or arguments.eyebeam).resolve())
    folder.mkdir(parents=True, exist_ok=True)
    numbers = folder / "measured.json"
    measured = json.loads(numbers.read_text()) if numbers.is_file() else {}
    for picture in PICTURES:
        if not arguments.scenes or picture.scene in arguments.scenes:
            print(picture.scene, flush=True)
            measured[picture.scene] = render(picture, eyebeam, folder, arguments.quick)
            numbers.write_text(json.dumps(measured, indent=2) + "\n")
    (folder / "index.md").write_text(page(measured), encoding="utf-8")
    print(folder / "index.md")


if __name__ == "__main__":
    main()
