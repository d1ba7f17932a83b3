"""The pictures that lie on balls in the figures, as PNG files: a card that shows where u and v run, and normals."""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Callable

Pixel = tuple[int, int, int]


def png(width: int, height: int, pixel: Callable[[int, int], Pixel]) -> bytes:
    """A PNG of 8 bits per channel; `pixel` tells the colour by column and row from the top left."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in pixel(x, y)) for y in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


# An F, which looks the same neither mirrored nor upside down, on squares.
CARD = (
    "................",
    "................",
    "...##########...",
    "...##########...",
    "...##...........",
    "...##...........",
    "...##...........",
    "...########.....",
    "...########.....",
    "...##...........",
    "...##...........",
    "...##...........",
    "...##...........",
    "...##...........",
    "................",
    "................",
)


def card() -> bytes:
    """An F on squares that get redder along u and greener along v."""

    def pixel(x: int, y: int) -> Pixel:
        if CARD[y][x] == "#":
            return (40, 44, 58)
        dark = 0 if (x // 2 + y // 2) % 2 else 28
        return (150 + 6 * x - dark, 150 + 6 * (15 - y) - dark, 205 - 4 * x - dark)

    return png(16, 16, pixel)


def studs() -> bytes:
    """The normals of a stud, as glTF has them: x along u in red, y along v in green, z in blue."""
    size = 96

    def pixel(x: int, y: int) -> Pixel:
        u, v = 2 * (x + 0.5) / size - 1, 1 - 2 * (y + 0.5) / size
        r = math.hypot(u, v) / 0.75
        if r >= 1:
            return (128, 128, 255)
        # The slopes of a dome that meets the surface without a kink.
        slope = 2.6 * r * (1 - r * r)
        nx, ny = slope * u / max(r * 0.75, 1e-9), slope * v / max(r * 0.75, 1e-9)
        length = math.sqrt(nx * nx + ny * ny + 1)
        return (round(127.5 + 127.5 * nx / length), round(127.5 + 127.5 * ny / length), round(127.5 + 127.5 / length))

    return png(size, size, pixel)


PICTURES = {"card.png": card, "studs.png": studs}
