"""Writes the scenes that renderers are compared on, and the references as plain arrays, to a scratch folder.

The descriptions come from the folder of the comparison, which is not part of this repository.
"""

import json
import sys
from pathlib import Path

import numpy as np


def main(shared, scratch):
    sys.path.insert(0, str(shared))
    import scenes

    out = scratch / "scenes"
    out.mkdir(parents=True, exist_ok=True)
    scenes.OUT = str(out)
    made = [scenes.weekend_five(True), scenes.weekend_final(), scenes.cornell(False), scenes.cornell(True), scenes.env_mesh()]
    for scene in made:
        (out / f"{scene['name']}.json").write_text(json.dumps(scene))
    references = scratch / "ref"
    references.mkdir(exist_ok=True)
    for file in (shared / "ref").glob("*.npz"):
        np.save(references / file.stem, np.load(file)["img"].astype(np.float32))


main(Path(sys.argv[1]), Path(sys.argv[2]))
