"""Seconds to read a model and to build its hierarchy, beside other renderers on the same machine.

DamagedHelmet as glTF (for Mitsuba, which reads none, as PLY and PNG that `eyebeam convert` writes), and a PLY of 1.3 million triangles that is
made here. Every renderer loads each in turn, round by round; medians are told. One that is not installed is left out with a message.
Run by `make bench-load`.
"""

import argparse
import json
import re
import statistics
import struct
import subprocess
import sys
import time
from pathlib import Path

SIDE = 806


def write_waves(path):
    """A sheet of waves: 806 x 806 quads, with normals, as most scanners write it."""
    from math import cos, sin

    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {(SIDE + 1) ** 2}\n"
        + "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
        + f"element face {2 * SIDE * SIDE}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    body = bytearray(header.encode())
    for i in range(SIDE + 1):
        for k in range(SIDE + 1):
            x, z = 4 * i / SIDE - 2, 4 * k / SIDE - 2
            dx, dz = 0.8 * cos(8 * x) * cos(7 * z), -0.7 * sin(8 * x) * sin(7 * z)
            length = (1 + dx * dx + dz * dz) ** 0.5
            body += struct.pack("<6f", x, 0.1 * sin(8 * x) * cos(7 * z), z, -dx / length, 1 / length, -dz / length)
    for i in range(SIDE):
        for k in range(SIDE):
            a, b = i * (SIDE + 1) + k, (i + 1) * (SIDE + 1) + k
            body += struct.pack("<B3iB3i", 3, a, a + 1, b, 3, a + 1, b + 1, b)
    path.write_bytes(body)


MITSUBA = """
import sys, time, json
import mitsuba as mi
mi.set_variant("llvm_ad_rgb")
scene = {"type": "scene", "integrator": {"type": "path"}, "light": {"type": "constant"}}
mi.load_dict({"type": "scene", "a": {"type": "sphere"}})
start = time.perf_counter()
for i, name in enumerate(json.loads(sys.argv[1])):
    if name.endswith(".ply"):
        scene[f"mesh{i}"] = {"type": "ply", "filename": name}
    else:
        texture = {"type": "bitmap", "filename": name}
        scene[f"map{i}"] = {"type": "principled", "base_color": texture}
mi.load_dict(scene)
print("RESULT", time.perf_counter() - start)
"""

CYCLES = """
import sys, time, json
import bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.cycles.samples = 1
scene.cycles.use_denoising = False
scene.render.resolution_x = scene.render.resolution_y = 8
scene.render.filepath = sys.argv[2]
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location = (0, 0, 9)
scene.collection.objects.link(camera)
scene.camera = camera
bpy.ops.render.render(write_still=True)
start = time.perf_counter()
name = json.loads(sys.argv[1])[0]
bpy.ops.wm.ply_import(filepath=name) if name.endswith(".ply") else bpy.ops.import_scene.gltf(filepath=name)
bpy.ops.render.render(write_still=True)
print("RESULT", time.perf_counter() - start)
"""


def own(eyebeam, model):
    """Of loading and building."""
    picture = Path(model).parent / "load.png"
    command = [eyebeam, "render", model, "-q", "-r", "8x8", "--spp", "1", "-o", picture, "--stats", "-"]
    seconds = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)["seconds"]
    return seconds["load"] + seconds["build"]


def peer(python, script, files, scratch):
    """Seconds that the script measures itself; none if it fails."""
    command = [str(python), "-c", script, json.dumps([str(file) for file in files]), str(scratch / "load")]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    found = re.search(r"RESULT ([0-9.]+)", run.stdout)
    if found is None:
        print((run.stdout + run.stderr)[-300:], file=sys.stderr)
        return None
    return float(found[1])


def main():
    """Prints a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--eyebeam", default="target/release/eyebeam")
    parser.add_argument("--helmet", type=Path, required=True)
    parser.add_argument("--scratch", type=Path, required=True)
    parser.add_argument("--rounds", type=int, default=5)
    args = parser.parse_args()
    args.scratch.mkdir(parents=True, exist_ok=True)
    waves, helmet = args.scratch / "waves.ply", args.scratch / "helmet.glb"
    if not waves.exists():
        write_waves(waves)
    helmet.write_bytes(args.helmet.read_bytes())
    scene = args.scratch / "helmet.toml"
    subprocess.run([args.eyebeam, "convert", helmet, scene, "--force", "-q"], check=True)
    parts = sorted(p for p in (args.scratch / "helmet-assets").iterdir() if p.suffix in (".ply", ".png"))
    pythons = {name: args.scratch / name / "bin" / "python" for name in ("mi", "blender")}
    print("| model | renderer | seconds | of ours |\n|---|---|---|---|")
    for name, model, files in (("DamagedHelmet", helmet, parts), ("1.3 M triangles", waves, [waves])):
        ways = {"eyebeam": lambda m=model: own(args.eyebeam, m)}
        if pythons["mi"].exists():
            ways["Mitsuba 3, llvm"] = lambda f=files: peer(pythons["mi"], MITSUBA, f, args.scratch)
        if pythons["blender"].exists():
            ways["Cycles"] = lambda m=model: peer(pythons["blender"], CYCLES, [m], args.scratch)
        taken = {way: [] for way in ways}
        for _ in range(args.rounds):
            for way, run in ways.items():
                seconds = run()
                taken[way] += [] if seconds is None else [seconds]
                time.sleep(0.1)
        ours = statistics.median(taken["eyebeam"])
        for way, all_seconds in taken.items():
            if all_seconds:
                median = statistics.median(all_seconds)
                print(f"| {name} | {way} | {median:.2f} | {median / ours:.2f} |")


if __name__ == "__main__":
    main()
