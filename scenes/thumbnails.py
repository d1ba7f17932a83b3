#!/usr/bin/env python3
"""Renders every model of a folder with no options but its size, and a page that shows each beside its author's screenshot.

    python3 scenes/thumbnails.py ../shared/scenes/gltf
    python3 scenes/thumbnails.py MODELS --size 480x360 --spp 128 --only Clear,Sheen -o /tmp/thumbnails

Python 3.11, and nothing else but the command `eyebeam` (--eyebeam PATH, or target/release/eyebeam).
"""

from __future__ import annotations

import argparse
import html
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MODELS = {".gltf", ".glb", ".obj", ".ply", ".stl"}
SCREENSHOTS = ("*.png", "*.jpg", "*.jpeg", "*.gif")


@dataclass(frozen=True)
class Result:
    """A model, what came of it, and what the program said."""

    name: str
    picture: Path | None
    screenshot: Path | None
    code: int
    seconds: float
    said: str


def screenshot_of(model: Path, root: Path) -> Path | None:
    """The picture that lies in the folder `screenshot` of the model or of one above it."""
    for folder in model.parents:
        for pattern in SCREENSHOTS:
            for picture in sorted((folder / "screenshot").glob(pattern)):
                return picture
        if folder == root:
            break
    return None


def render(model: Path, root: Path, args: argparse.Namespace) -> Result:
    """One picture."""
    name = str(model.relative_to(root))
    picture = args.output / (name.replace("/", "_").replace(" ", "_") + ".png")
    command = [args.eyebeam, "render", model, "-o", picture, "-r", args.size, "--spp", str(args.spp), "--progress", "none"]
    start = time.monotonic()
    run = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    seconds = time.monotonic() - start
    made = picture if run.returncode == 0 else None
    return Result(name, made, screenshot_of(model, root), run.returncode, seconds, run.stderr.strip())


def page(results: list[Result]) -> str:
    """All pictures beside the screenshots."""
    rows = []
    for result in results:
        images = [f'<img src="{path.resolve().as_uri()}">' if path else "" for path in (result.picture, result.screenshot)]
        said = html.escape(result.said)
        rows.append(
            f"<tr><td>{images[0]}<td>{images[1]}<td><b>{html.escape(result.name)}</b>"
            f"<br>exit {result.code}, {result.seconds:.1f} s<pre>{said}</pre>"
        )
    style = "<style>img{max-width:480px;max-height:360px} pre{white-space:pre-wrap;font-size:11px}</style>"
    return f"<!doctype html><meta charset=utf-8><title>Thumbnails</title>{style}<table>{''.join(rows)}</table>\n"


def main() -> int:
    """Renders all and says which failed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", type=Path, help="a folder; all models in it and below are rendered")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "target" / "thumbnails")
    parser.add_argument("--eyebeam", type=Path, default=ROOT / "target" / "release" / "eyebeam")
    parser.add_argument("--size", default="320x240")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--only", default="", help="parts of names, between commas")
    args = parser.parse_args()
    args.output.mkdir(parents=True, exist_ok=True)
    parts = [part for part in args.only.split(",") if part]
    found = sorted(path for path in args.models.rglob("*") if path.suffix.lower() in MODELS and path.is_file())
    wanted = [path for path in found if not parts or any(part in str(path) for part in parts)]
    results = []
    for model in wanted:
        result = render(model, args.models, args)
        print(f"{result.code} {result.seconds:6.1f} s  {result.name}", flush=True)
        results.append(result)
    (args.output / "index.html").write_text(page(results), encoding="utf-8")
    print(args.output / "index.html")
    return 0 if results and all(result.code in (0, 3) for result in results) else 1


if __name__ == "__main__":
    sys.exit(main())
