"""Shapes as triangle meshes: turned, pulled, bent, bevelled, and cloth.

Only the standard library is used, and the same call makes the same bytes: coordinates are rounded far above what the last bits
of a machine's sine could change. Lengths are metres, y points up, angles are degrees. Every mesh has normals (so that round
things look round) and texture coordinates; its triangles run counter-clockwise seen from outside.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

Vector = tuple[float, float, float]
# A point of an outline in a plane, and the normal there, which points to the right of where the outline runs.
OutlinePoint = tuple[float, float, float, float]
Outline = list[OutlinePoint]


def plus(a: Vector, b: Vector, factor: float = 1.0) -> Vector:
    """a + factor · b."""
    return (a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2])


def cross(a: Vector, b: Vector) -> Vector:
    """The cross product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(v: Vector) -> Vector:
    """The vector at length 1, or one upwards if it has none."""
    length = math.hypot(*v)
    return (v[0] / length, v[1] / length, v[2] / length) if length > 1e-12 else (0.0, 1.0, 0.0)


def cos_sin(degrees: float) -> tuple[float, float]:
    """Cosine and sine."""
    return math.cos(math.radians(degrees)), math.sin(math.radians(degrees))


@dataclass
class Mesh:
    """Triangles that share vertices, with a normal and texture coordinates at each."""

    vertices: list[Vector] = field(default_factory=list)
    normals: list[Vector] = field(default_factory=list)
    uvs: list[tuple[float, float]] = field(default_factory=list)
    triangles: list[tuple[int, int, int]] = field(default_factory=list)

    def __add__(self, other: Mesh) -> Mesh:
        """Both in one."""
        first = len(self.vertices)
        more = [(a + first, b + first, c + first) for a, b, c in other.triangles]
        return Mesh(
            self.vertices + other.vertices, self.normals + other.normals, self.uvs + other.uvs, self.triangles + more
        )

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Mesh:
        """Somewhere else."""
        return Mesh([plus(p, (x, y, z)) for p in self.vertices], self.normals, self.uvs, self.triangles)

    def turned(self, axis: str, degrees: float) -> Mesh:
        """Turned about the axis "x", "y" or "z" through the origin, counter-clockwise seen from its tip."""
        c, s = cos_sin(degrees)
        i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]

        def turn(v: Vector) -> Vector:
            w = list(v)
            w[i], w[j] = c * v[i] - s * v[j], s * v[i] + c * v[j]
            return (w[0], w[1], w[2])

        return Mesh([turn(p) for p in self.vertices], [turn(n) for n in self.normals], self.uvs, self.triangles)

    def ply(self) -> bytes:
        """As a binary PLY file."""
        is_small = len(self.vertices) < 1 << 16
        header = (
            "ply\nformat binary_little_endian 1.0\ncomment written by scenes/generate.py; do not edit\n"
            f"element vertex {len(self.vertices)}\n"
            + "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz", "u", "v"))
            + f"element face {len(self.triangles)}\nproperty list uchar {'ushort' if is_small else 'uint'} vertex_indices\n"
            "end_header\n"
        )
        body = bytearray(header.encode("ascii"))
        for p, n, uv in zip(self.vertices, self.normals, self.uvs, strict=True):
            # The + 0.0 makes -0.0 positive.
            body += struct.pack("<8f", *(round(c, 6) + 0.0 for c in (*p, *unit(n), *uv)))
        for triangle in self.triangles:
            body += struct.pack("<B3H" if is_small else "<B3I", 3, *triangle)
        return bytes(body)


def joined(meshes: Sequence[Mesh]) -> Mesh:
    """All in one."""
    result = Mesh()
    for mesh in meshes:
        result = result + mesh
    return result


def inside_out(mesh: Mesh) -> Mesh:
    """With its outside where its inside was."""
    return Mesh(
        mesh.vertices, [(-x, -y, -z) for x, y, z in mesh.normals], mesh.uvs, [(a, c, b) for a, b, c in mesh.triangles]
    )


def grid(points: Sequence[Sequence[tuple[Vector, Vector, tuple[float, float]]]]) -> Mesh:
    """Rows of points, each with its normal and texture coordinates. Along a row × to the next row points inwards."""
    width = len(points[0])
    flat = [point for row in points for point in row]
    mesh = Mesh([p for p, _, _ in flat], [n for _, n, _ in flat], [uv for _, _, uv in flat])
    for i in range(len(points) - 1):
        for j in range(width - 1):
            a, b = i * width + j, (i + 1) * width + j
            for triangle in ((a, b, a + 1), (a + 1, b, b + 1)):
                p, q, r = (mesh.vertices[k] for k in triangle)
                if math.hypot(*cross(plus(q, p, -1), plus(r, p, -1))) > 1e-10:
                    mesh.triangles.append(triangle)
    return mesh


def corners(points: Sequence[tuple[float, float, float]], steps: int = 4) -> Outline:
    """An outline of straight lines, from (x, y, radius) to (x, y, radius); each corner is rounded by its radius, 0 is sharp."""
    result: Outline = []
    for i, (x, y, radius) in enumerate(points):
        directions = []
        for p, q in zip(points[max(i - 1, 0) : i + 1], points[max(i - 1, 0) + 1 : i + 2]):
            length = math.hypot(q[0] - p[0], q[1] - p[1])
            directions.append(((q[0] - p[0]) / length, (q[1] - p[1]) / length))
        (ax, ay), (bx, by) = directions[0], directions[-1]
        turn = math.atan2(ax * by - ay * bx, ax * bx + ay * by)
        if len(directions) == 1:
            result.append((x, y, ay, -ax))
        elif radius == 0:
            result += [(x, y, ay, -ax), (x, y, by, -bx)]
        else:
            cut = radius * math.tan(abs(turn) / 2)
            side = math.copysign(radius, turn)
            center = (x - cut * ax - side * ay, y - cut * ay + side * ax)
            for k in range(steps + 1):
                c, s = math.cos(turn * k / steps), math.sin(turn * k / steps)
                nx, ny = c * ay + s * ax, s * ay - c * ax
                result.append((center[0] + side * nx, center[1] + side * ny, nx, ny))
    return result


def curve(points: Sequence[tuple[float, float]], steps: int = 6) -> Outline:
    """A smooth outline through all points: Catmull & Rom 1974, doi:10.1016/B978-0-12-079050-0.50020-5."""
    first, last = points[0], points[-1]
    ends = [
        (2 * first[0] - points[1][0], 2 * first[1] - points[1][1]),
        (2 * last[0] - points[-2][0], 2 * last[1] - points[-2][1]),
    ]
    padded = [ends[0], *points, ends[1]]
    result: Outline = []
    for i in range(len(points) - 1):
        p = padded[i : i + 4]
        for k in range(steps + (i == len(points) - 2)):
            t = k / steps
            at = [0.0, 0.0]
            along = [0.0, 0.0]
            for c in (0, 1):
                a = -p[0][c] + 3 * p[1][c] - 3 * p[2][c] + p[3][c]
                b = 2 * p[0][c] - 5 * p[1][c] + 4 * p[2][c] - p[3][c]
                d = p[2][c] - p[0][c]
                at[c] = (((a * t + b) * t + d) * t + 2 * p[1][c]) / 2
                along[c] = ((3 * a * t + 2 * b) * t + d) / 2
            length = math.hypot(*along) or 1.0
            result.append((at[0], at[1], along[1] / length, -along[0] / length))
    return result


def shares(outline: Outline) -> list[float]:
    """How far along the outline each point is, from 0 to 1."""
    lengths = [0.0]
    for p, q in zip(outline, outline[1:]):
        lengths.append(lengths[-1] + math.hypot(q[0] - p[0], q[1] - p[1]))
    return [length / lengths[-1] for length in lengths]


def lathe(outline: Outline, segments: int = 48, core: tuple[float, float] = (0.0, 0.0)) -> Mesh:
    """An outline of (distance from the axis, height) turned about the y axis; what is to its right is outside.

    With a core, the axis is a rectangle of these half sides in x and z, so that a round thing becomes a box with round edges;
    an outline that starts or ends at distance 0 closes it there.
    """
    if core == (0.0, 0.0):
        columns = [(j / segments, 0.0, 0.0) for j in range(segments + 1)]
    else:
        quarter = segments // 4
        sides = ((1, 1), (-1, 1), (-1, -1), (1, -1))
        columns = [
            ((i + j / quarter) / 4, x * core[0], z * core[1])
            for i, (x, z) in enumerate(sides)
            for j in range(quarter + 1)
        ]
        columns.append((1.0, *core))
    turned = [(u, *cos_sin(360 * u), x, z) for u, x, z in columns]
    mesh = grid(
        [
            [((r * c + x, y, r * s + z), (nr * c, ny, nr * s), (u, v)) for u, c, s, x, z in turned]
            for (r, y, nr, ny), v in zip(outline, shares(outline))
        ]
    )
    if core != (0.0, 0.0):
        for row, is_end in ((0, False), (len(outline) - 1, True)):
            if outline[row][0] == 0:
                first = row * len(columns)
                a, b, c, d = (first + k * (segments // 4 + 1) for k in range(4))
                mesh.triangles += [(a, c, b), (a, d, c)] if is_end else [(a, b, c), (a, c, d)]
    return mesh


def pulled(outline: Outline, z0: float, z1: float) -> Mesh:
    """An outline in x and y, pulled along z; what is to its right is outside."""
    return grid(
        [
            [((x, y, z), (nx, ny, 0.0), (u, v)) for u, z in ((0.0, z0), (1.0, z1))]
            for (x, y, nx, ny), v in zip(outline, shares(outline))
        ]
    )


def surface(place: Callable[[float, float], Vector], columns: int, rows: int) -> Mesh:
    """Any surface over u, v in 0..1. Its normal is d/dv × d/du."""
    step = 1e-4

    def point(u: float, v: float) -> tuple[Vector, Vector, tuple[float, float]]:
        du = plus(place(u + step, v), place(u - step, v), -1)
        dv = plus(place(u, v + step), place(u, v - step), -1)
        return place(u, v), unit(cross(dv, du)), (u, v)

    return grid([[point(j / columns, i / rows) for j in range(columns + 1)] for i in range(rows + 1)])


def torus(ring: float, thickness: float, segments: int = 48, around: int = 16) -> Mesh:
    """A ring of this radius about the y axis, of a round cross section of radius `thickness`."""
    outline: Outline = []
    for k in range(around + 1):
        c, s = cos_sin(360 * k / around)
        outline.append((ring + thickness * c, thickness * s, c, s))
    return lathe(outline, segments)


def tube(path: Sequence[Vector], radius: Callable[[float], float], around: int = 12) -> Mesh:
    """A round rod along a path; its radius may change from 0 (start) to 1 (end). Its ends are open."""
    tangents = [unit(plus(path[min(i + 1, len(path) - 1)], path[max(i - 1, 0)], -1)) for i in range(len(path))]
    across = unit(cross(tangents[0], (0.3, 0.2, 0.93)))
    rows = []
    for i, (p, tangent) in enumerate(zip(path, tangents)):
        # The frame is carried along, turned as little as it can be.
        across = unit(plus(across, tangent, -sum(a * b for a, b in zip(across, tangent))))
        other = cross(across, tangent)
        v = i / (len(path) - 1)
        row = []
        for k in range(around + 1):
            c, s = cos_sin(360 * k / around)
            normal = plus((c * across[0], c * across[1], c * across[2]), other, s)
            row.append((plus(p, normal, radius(v)), normal, (k / around, v)))
        rows.append(row)
    return grid(rows)


def rounded_box(size: Vector, radius: float, steps: int = 3) -> Mesh:
    """A box about the origin with round edges."""
    height = size[1] / 2
    outline = corners([(0, -height, 0), (radius, -height, radius), (radius, height, radius), (0, height, 0)], steps)
    mesh = lathe(outline, 4 * steps, (size[0] / 2 - radius, size[2] / 2 - radius))
    x, y, z = size
    mesh.uvs = [
        (p[2] / z + 0.5, p[1] / y + 0.5)
        if abs(n[0]) > max(abs(n[1]), abs(n[2]))
        else (p[0] / x + 0.5, (p[2] / z if abs(n[1]) > abs(n[2]) else p[1] / y) + 0.5)
        for p, n in zip(mesh.vertices, mesh.normals)
    ]
    return mesh


# The bars of a digit as on a pocket calculator: start, end, in widths of half a digit; and which of them each digit lights.
BARS = {
    "a": ((0, 2), (1, 2)), "b": ((1, 2), (1, 1)), "c": ((1, 1), (1, 0)), "d": ((0, 0), (1, 0)),
    "e": ((0, 1), (0, 0)), "f": ((0, 2), (0, 1)), "g": ((0, 1), (1, 1)),
}  # fmt: skip
DIGITS = ("abcdef", "bc", "abged", "abgcd", "fgbc", "afgcd", "afgedc", "abc", "abcdefg", "abfgcd")


def number(text: str, height: float, thickness: float = 0.16) -> Mesh:
    """Digits that stand in the xy plane and look along z, about the origin."""
    half = height / 2
    mesh = Mesh()
    for index, digit in enumerate(text):
        left = (1.55 * index - (1.55 * len(text) - 0.55) / 2) * half
        for bar in DIGITS[int(digit)]:
            (x0, y0), (x1, y1) = BARS[bar]
            mesh += _bar((left + x0 * half, (y0 - 1) * half), (left + x1 * half, (y1 - 1) * half), thickness * half)
    return mesh


def _bar(start: tuple[float, float], end: tuple[float, float], width: float) -> Mesh:
    """A flat stroke with pointed ends."""
    length = math.hypot(end[0] - start[0], end[1] - start[1])
    dx, dy = (end[0] - start[0]) / length, (end[1] - start[1]) / length
    points = []
    for along, across in (
        (0, 0),
        (1, -1),
        (length / width - 1, -1),
        (length / width, 0),
        (length / width - 1, 1),
        (1, 1),
    ):
        points.append(
            (start[0] + (along * dx - across * dy) * width, start[1] + (along * dy + across * dx) * width, 0.0)
        )
    return Mesh(points, [(0.0, 0.0, 1.0)] * 6, [(0.0, 0.0)] * 6, [(0, k, k + 1) for k in range(1, 5)])
