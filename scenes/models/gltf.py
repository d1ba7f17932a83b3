"""glTF 2.0 in one file (GLB), of meshes with materials, pictures and turning parts."""

from __future__ import annotations

import json
import math
import struct
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from models.modelling import Mesh, Vector, unit

FLOAT, USHORT = 5126, 5123


def png(width: int, height: int, pixel: Callable[[int, int], tuple[int, int, int]]) -> bytes:
    """A picture of 8 bits a channel."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in pixel(x, y)) for y in range(height))
    header = struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)
    # Not compressed: versions of zlib write other bytes.
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 0)) + chunk(b"IEND", b"")


@dataclass
class Glb:
    """A file in the making."""

    document: dict = field(default_factory=lambda: {"asset": {"version": "2.0", "generator": "scenes/generate.py"}})
    data: bytearray = field(default_factory=bytearray)

    def add(self, kind: str, item: dict) -> int:
        """Appends to one of the lists of the document; its number there."""
        items = self.document.setdefault(kind, [])
        items.append(item)
        return len(items) - 1

    def view(self, data: bytes) -> int:
        """Bytes, at a multiple of four."""
        self.data += bytes(-len(self.data) % 4)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)}
        self.data += data
        return self.add("bufferViews", view)

    def numbers(self, rows: Sequence[Sequence[float]], component: int = FLOAT) -> int:
        """An accessor of rows of 1 to 4 numbers."""
        width = len(rows[0])
        # The + 0.0 makes -0.0 positive.
        flat = [round(c, 6) + 0.0 if component == FLOAT else c for row in rows for c in row]
        view = self.view(struct.pack(f"<{len(flat)}{'f' if component == FLOAT else 'H'}", *flat))
        kind = "SCALAR" if width == 1 else f"VEC{width}"
        accessor = {"bufferView": view, "componentType": component, "count": len(rows), "type": kind}
        if component == FLOAT:
            columns = list(zip(*(struct.unpack(f"<{width}f", struct.pack(f"<{width}f", *row)) for row in rows)))
            accessor |= {"min": [round(min(c), 6) for c in columns], "max": [round(max(c), 6) for c in columns]}
        return self.add("accessors", accessor)

    def texture(self, picture: bytes) -> int:
        """A PNG as a texture."""
        source = self.add("images", {"bufferView": self.view(picture), "mimeType": "image/png"})
        return self.add("textures", {"source": source})

    def material(self, name: str, color: Vector, metallic: float, roughness: float, **more: object) -> int:
        """A material; `more` are other properties and extensions (names with an underscore)."""
        pbr = {"baseColorFactor": [*color, 1], "metallicFactor": metallic, "roughnessFactor": roughness}
        material: dict = {"name": name, "pbrMetallicRoughness": pbr}
        for key, value in more.items():
            if key == "baseColorTexture":
                pbr[key] = {"index": value}
            elif "_" in key:
                material.setdefault("extensions", {})[key] = value
                used = self.document.setdefault("extensionsUsed", [])
                used += [key] if key not in used else []
            else:
                material[key] = value
        return self.add("materials", material)

    def mesh(self, name: str, parts: Sequence[tuple[Mesh, int]]) -> int:
        """A mesh of several parts, each of a material; where that has no picture, coordinates are left out."""

        def primitive(mesh: Mesh, material: int) -> dict:
            attributes = {
                "POSITION": self.numbers(mesh.vertices),
                "NORMAL": self.numbers([unit(n) for n in mesh.normals]),
            }
            if "baseColorTexture" in self.document["materials"][material]["pbrMetallicRoughness"]:
                attributes["TEXCOORD_0"] = self.numbers([(u, 1 - v) for u, v in mesh.uvs])
            indices = self.numbers([(i,) for triangle in mesh.triangles for i in triangle], USHORT)
            return {"attributes": attributes, "indices": indices, "material": material}

        return self.add("meshes", {"name": name, "primitives": [primitive(*part) for part in parts]})

    def turning(self, name: str, nodes: Sequence[int], seconds: float) -> None:
        """An animation in which nodes turn once about x."""
        steps = 8
        times = self.numbers([(seconds * k / steps,) for k in range(steps + 1)])
        halves = [math.pi * k / steps for k in range(steps + 1)]
        output = self.numbers([(math.sin(half), 0.0, 0.0, math.cos(half)) for half in halves])
        channels = [{"sampler": 0, "target": {"node": node, "path": "rotation"}} for node in nodes]
        self.add("animations", {"name": name, "channels": channels, "samplers": [{"input": times, "output": output}]})

    def encode(self) -> bytes:
        """The file."""
        self.data += bytes(-len(self.data) % 4)
        document = self.document | {"buffers": [{"byteLength": len(self.data)}]}
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<2I", len(text), 0x4E4F534A) + text
        chunks += struct.pack("<2I", len(self.data), 0x004E4942) + self.data
        return struct.pack("<3I", 0x46546C67, 2, 12 + len(chunks)) + chunks
