#!/usr/bin/env python3
"""Writes the meshes of the scenes to scenes/meshes, and the scenes that are long lists.

    python3 scenes/generate.py            # writes them
    python3 scenes/generate.py --check    # says whether what is there is what would be written

Python 3.11, and nothing else. What is made is in models, what for in README.md.
"""

from __future__ import annotations

import sys
from pathlib import Path

from models import chess, courtyard, glass, locomotive, many_lights, materials, product, room
from models.modelling import Mesh

FOLDER = Path(__file__).resolve().parent


def meshes() -> dict[str, Mesh]:
    """All meshes, by the names of their files."""
    modules = (chess, courtyard, glass, materials, product, room)
    return {name: mesh for module in modules for name, mesh in module.meshes().items()}


def files() -> dict[Path, bytes]:
    """Everything that is written, by its place."""
    result = {FOLDER / "meshes" / f"{name}.ply": mesh.ply() for name, mesh in meshes().items()}
    result[FOLDER / "many-lights.toml"] = many_lights.scene().encode()
    result[FOLDER / "locomotive.glb"] = locomotive.model()
    return result


def main(arguments: list[str]) -> int:
    """Writes the files, or compares them."""
    wanted = files()
    if arguments == ["--check"]:
        wrong = [path for path, content in wanted.items() if not path.is_file() or path.read_bytes() != content]
        wrong += set((FOLDER / "meshes").glob("*.ply")) - wanted.keys()
        for path in sorted(wrong):
            print(f"{path.relative_to(FOLDER)} is not what generate.py writes", file=sys.stderr)
        return int(bool(wrong))
    if arguments:
        print(__doc__, file=sys.stderr)
        return 2
    for path, content in wanted.items():
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
