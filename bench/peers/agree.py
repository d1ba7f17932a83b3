"""Whether Eyebeam's pictures are those of the references, which another renderer made.

For every scene: ratio of the means, sub-pixel offset, and block means against their standard error, which two pictures of
other seeds and the reference's known noise tell. Run by `make agree-peers`; the exit code is 0 if all agree.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

SCENES = ("A2", "B", "C", "D", "E", "bitterli-cornell")
# Allowed: ratio of the means, offset in pixels.
MEAN, OFFSET = 0.005, 0.02
# This reference lies a quarter of its own pixels lower than Mitsuba's picture of the same file, too.
OFFSETS = {"bitterli-cornell": 0.1}
BLOCK = 16
# Of a reference that says nothing of its noise.
UNKNOWN = {"relmse_noise": 1e-4}


def read_pfm(path):
    with open(path, "rb") as file:
        assert file.readline().strip() == b"PF"
        width, height = map(int, file.readline().split())
        scale = float(file.readline())
        pixels = np.frombuffer(file.read(), "<f4" if scale < 0 else ">f4")
    return pixels.reshape(height, width, 3)[::-1].astype(float)


def offset(image, reference):
    """Least-squares shift of the image in x and y, in pixels."""
    x, r = (np.minimum(i, 2).mean(-1) for i in (image, reference))
    gy, gx = np.gradient(r)
    a = np.stack([-gx, -gy, r], -1)[2:-2, 2:-2].reshape(-1, 3)
    shift, *_ = np.linalg.lstsq(a, (x - r)[2:-2, 2:-2].ravel(), rcond=None)
    return shift[:2]


def blocks(image):
    height, width = (side // BLOCK * BLOCK for side in image.shape[:2])
    grey = image[:height, :width].mean(-1)
    return grey.reshape(height // BLOCK, BLOCK, width // BLOCK, BLOCK).mean((1, 3))


def compare(scene, a, b, reference, info):
    """Prints the scene's row of the table; whether mean and offset are as they should be."""
    mean = (a + b) / 2
    ratio = mean.mean() / reference.mean()
    shift = offset(mean, reference)
    # The variance of a pixel is a mean over its block, of both pictures and of the reference, whose samples are as noisy.
    own = blocks((a - b) ** 2 / 4) / BLOCK**2
    theirs = info["relmse_noise"] * blocks(reference**2 + 0.01) / BLOCK**2
    z = (blocks(mean) - blocks(reference)) / np.sqrt(own + theirs + 1e-12)
    spread, worst = np.sqrt((z**2).mean()), np.abs(z).max()
    print(f"| {scene} | {ratio:.4f} | {shift[0]:+.3f}, {shift[1]:+.3f} | {spread:.2f} | {worst:.1f} |", flush=True)
    return abs(ratio - 1) < MEAN and np.abs(shift).max() < OFFSETS.get(scene, OFFSET)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--renderer", required=True, help="the program eyebeam-bench")
    parser.add_argument("--scenes", type=Path, required=True, help="folder of the scenes' JSON files")
    parser.add_argument("--references", type=Path, required=True, help="folder of the references as plain arrays")
    parser.add_argument("--info", type=Path, required=True, help="what is known of the references' noise, JSON")
    parser.add_argument("--only", nargs="*", default=SCENES)
    parser.add_argument("--spp", type=int, default=512)
    parser.add_argument("--keep", type=Path, help="folder to keep the pictures in")
    args = parser.parse_args()
    info = json.loads(args.info.read_text())
    print(f"| scene | mean / reference | offset, pixels | RMS z of {BLOCK} x {BLOCK} blocks | worst z |")
    print("|---|---|---|---|---|")
    good = True
    with tempfile.TemporaryDirectory() as folder:
        folder = args.keep or Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        for scene in args.only:
            pictures = []
            for seed in (1, 2):
                out = folder / f"{scene}-{seed}.pfm"
                command = [args.renderer, "peer", "--threads", "2", "--scene", args.scenes / f"{scene}.json", "--spp", str(args.spp)]
                subprocess.run([*command, "--seed", str(seed), "--out", out], check=True, stdout=subprocess.DEVNULL)
                pictures.append(read_pfm(out))
            reference = np.load(args.references / f"{scene}.npy").astype(float)
            good &= compare(scene, *pictures, reference, info.get(scene, UNKNOWN))
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
