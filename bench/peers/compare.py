"""Seconds times relative squared error, beside other renderers on the same machine: lower is better.

Every renderer draws every scene in turn, round by round, each round with another seed, so that a busy machine slows all of
them. A renderer that is not installed is left out with a message. Run by `make bench-peers`.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

import numpy as np

SCENES = ("A2", "B", "C", "D", "E")
TIMEOUT = 900


def renderers(eyebeam, shared, scratch):
    """Name: command, to which the driver's arguments are added."""

    def peer(environment, driver, *options):
        return [scratch / environment / "bin" / "python", shared / driver, *options]

    llvm = ("--variant", "llvm_ad_rgb")
    return {
        "eyebeam": [eyebeam, "peer"],
        "eyebeam, independent": [eyebeam, "peer", "--sampler", "independent"],
        "eyebeam, weekend": [eyebeam, "peer", "--integrator", "weekend", "--sampler", "independent"],
        "mitsuba llvm": peer("mi", "drive_mitsuba.py", *llvm),
        "mitsuba llvm, multijitter": peer("mi", "drive_mitsuba.py", *llvm, "--sampler", "multijitter"),
        "cycles": peer("blender", "drive_cycles.py"),
        "luxcore": peer("lux", "drive_lux.py"),
    }


def render(command, scene, spp, seed, out, scratch):
    """What the driver says of its run; None if it failed."""
    arguments = ["--scene", scratch / "scenes" / f"{scene}.json", "--spp", spp, "--threads", 2, "--seed", seed, "--out", out]
    environment = dict(os.environ, PEERS_TMP=str(scratch), HOME=str(scratch / "home"))
    (scratch / "home").mkdir(exist_ok=True)
    done = subprocess.run(
        [str(word) for word in [*command, *arguments]],
        capture_output=True, text=True, timeout=TIMEOUT, env=environment, check=False,
    )
    results = [line for line in done.stdout.splitlines() if line.startswith("RESULT ")]
    if not results:
        print((done.stdout + done.stderr)[-300:], file=sys.stderr)
        return None
    return json.loads(results[-1].removeprefix("RESULT "))


def error(image, reference, noise):
    """Relative squared error, without that of the reference."""
    return ((image - reference) ** 2 / (reference**2 + 0.01)).mean() - noise


def measure(scene, commands, args, read_image, info):
    """Seconds and errors of all rounds, by renderer."""
    runs = {name: [] for name in commands}
    reference = np.load(args.scratch / "ref" / f"{scene}.npy").astype(float)
    samples = reference[..., 0].size * args.spp
    for seed in range(1, args.rounds + 1):
        for name, command in commands.items():
            out = args.scratch / "out" / f"{name.replace(', ', '-').replace(' ', '-')}-{scene}-{seed}.exr"
            result = render(command, scene, args.spp, seed, out, args.scratch)
            if result is None:
                print(f"{name} failed on {scene}", file=sys.stderr)
                continue
            image = read_image(str(out)).astype(float)
            relative = error(image, reference, info[scene]["relmse_noise"])
            runs[name].append((result["render_s"], relative, samples / result["render_s"] * 1e-6))
    return {name: run for name, run in runs.items() if run}


def table(scene, spp, runs):
    """Rows of one scene; the ratio is to the best of the others."""
    median = {name: [statistics.median(column) for column in zip(*run)] for name, run in runs.items()}
    cost = {name: seconds * relative for name, (seconds, relative, _) in median.items()}
    best = min((c for name, c in cost.items() if not name.startswith("eyebeam")), default=float("nan"))
    for name, (seconds, relative, rate) in median.items():
        print(
            f"| {scene} | {name} | {spp} | {seconds:.2f} | {rate:.2f} | {relative:.3g} | {cost[name]:.3g} "
            f"| {cost[name] / best:.2f} |",
            flush=True,
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--eyebeam", type=Path, required=True, help="the program eyebeam-bench")
    parser.add_argument("--shared", type=Path, required=True, help="folder of the drivers and references")
    parser.add_argument("--scratch", type=Path, required=True, help="folder of the installed renderers and the scenes")
    parser.add_argument("--scenes", nargs="*", default=SCENES)
    parser.add_argument("--only", nargs="*", help="names of the renderers")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--rounds", type=int, default=3)
    args = parser.parse_args()
    sys.path.insert(0, str(args.shared))
    from imageio_lite import read_image

    (args.scratch / "out").mkdir(exist_ok=True)
    info = json.loads((args.shared / "ref" / "info.json").read_text())
    commands = renderers(args.eyebeam.resolve(), args.shared.resolve(), args.scratch.resolve())
    for name, command in list(commands.items()):
        if args.only and name not in args.only:
            del commands[name]
        elif not Path(command[0]).exists():
            print(f"{name} is not installed: left out", file=sys.stderr)
            del commands[name]
    print("| scene | renderer | spp | seconds | Msamples/s | relMSE | seconds · relMSE | to the best peer |")
    print("|---|---|---|---|---|---|---|---|")
    for scene in args.scenes:
        table(scene, args.spp, measure(scene, commands, args, read_image, info))


if __name__ == "__main__":
    main()
