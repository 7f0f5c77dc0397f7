#!/usr/bin/env python3
"""Fills a folder with the inputs of cases.json. Usage: make_inputs.py FOLDER [OIIOTOOL]

PNG files are written here, so that no library decides what is in them; the other formats by oiiotool, where it is given.
"""
import json
import random
import struct
import subprocess
import sys
import zlib
from pathlib import Path

CHANNELS = {1: 0, 2: 4, 3: 2, 4: 6}  # color types of PNG


def png_bytes(width, height, channels, bits, values, tags=()):
    """A PNG of rows without filters; `values` are whole numbers in the order of the file, `tags` names and bytes of chunks."""
    step = bits // 8
    data = b"".join(value.to_bytes(step, "big") for value in values)
    stride = width * channels * step
    rows = b"".join(b"\0" + data[y * stride:(y + 1) * stride] for y in range(height))

    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))

    header = struct.pack(">IIBBBBB", width, height, bits, CHANNELS[channels], 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        chunk(*tag) for tag in ((b"IHDR", header), *tags, (b"IDAT", zlib.compress(rows)), (b"IEND", b"")))


class Inputs:
    def __init__(self, folder):
        self.folder = Path(folder)
        self.random = random.Random(7)

    def path(self, name):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        return path

    def png(self, name, width, height, channels, bits=8, low=0.0, high=1.0, tags=()):
        largest = (1 << bits) - 1
        values = [round((low + (high - low) * self.random.random()) * largest) for _ in range(width * height * channels)]
        data = png_bytes(width, height, channels, bits, values, tags)
        self.path(name).write_bytes(data)
        return data

    def gltf(self):
        """A spec-gloss material with maps, one with factors alone, and one that is not converted; as .gltf and .glb."""
        diffuse, gloss = self.png("asset/diffuse.png", 8, 8, 4), self.png("asset/specgloss.png", 8, 8, 4)
        extension = "KHR_materials_pbrSpecularGlossiness"
        materials = [
            {"name": "maps", "extensions": {extension: {"diffuseTexture": {"index": 0}, "specularGlossinessTexture": {"index": 1}}}},
            {"name": "factors", "extensions": {extension: {
                "diffuseFactor": [0.2, 0.3, 0.4, 1.0], "specularFactor": [0.5, 0.4, 0.1], "glossinessFactor": 0.6}}},
            {"name": "other", "pbrMetallicRoughness": {"roughnessFactor": 0.25}, "extras": {"big": 12345678901234567890}},
        ]
        document = {"asset": {"version": "2.0"}, "extensionsUsed": [extension], "textures": [{"source": 0}, {"source": 1}],
                    "images": [{"uri": "diffuse.png"}, {"uri": "specgloss.png"}], "materials": materials}
        self.path("asset/model.gltf").write_text(json.dumps(document, indent=2))
        views, binary = [], b""
        for data in (diffuse, gloss):
            views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
            binary += data + b"\0" * (-len(data) % 4)
        document.update(buffers=[{"byteLength": len(binary)}], bufferViews=views,
                        images=[{"bufferView": i, "mimeType": "image/png"} for i in range(2)])
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        body = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942) + binary
        self.path("model.glb").write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)

    def mtl(self):
        self.path("model.mtl").write_text("# a remark\nnewmtl shiny\nNs 100\nKd 0.4 0.3 0.2\nKs 0.5 0.5 0.5\nillum 2\n")
        self.path("model.obj").write_text("mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl shiny\nf 1 2 3\n")

    def make(self, oiiotool):
        for name in ("gold", "wood"):
            self.png(f"library/{name}/{name}_roughness.png", 33, 17, 1, high=0.5)
            self.png(f"library/{name}/{name}_specular.png", 33, 17, 3)
        self.png("library/wood/wood_normal.png", 33, 17, 3)
        self.png("deep/deep_roughness.png", 16, 16, 1, bits=16, low=0.05)
        self.png("deep/deep_specular.png", 16, 16, 3, bits=16)
        self.png("specgloss/tin_diffuse.png", 16, 16, 3)
        self.png("specgloss/tin_specular.png", 16, 16, 3)
        self.png("specgloss/tin_glossiness.png", 16, 16, 1)
        # Write the tags of every PNG from picture editors, and of a renderer of linear colors.
        tags = {"srgb": (b"sRGB", b"\0"), "gamma": (b"gAMA", struct.pack(">I", 45455)), "linear": (b"gAMA", struct.pack(">I", 100000))}
        for name, tag in tags.items():
            self.png(f"tagged/{name}/{name}_roughness.png", 16, 16, 1, low=0.1, tags=[tag])
            self.png(f"tagged/{name}/{name}_specular.png", 16, 16, 3, tags=[tag])
        for role, channels in (("MaskMap", 4), ("BaseMap", 3), ("Normal", 3)):
            self.png(f"tagged_unity/brick_{role}.png", 16, 16, channels, tags=[tags["srgb"]])
        self.png("unity/brick_MaskMap.png", 16, 16, 4)
        self.png("unity/brick_BaseMap.png", 16, 16, 3)
        self.gltf()
        self.mtl()
        if not oiiotool:
            return
        def other(name, channels, *words):
            source = self.folder / "library/gold" / ("gold_roughness.png" if channels == 1 else "gold_specular.png")
            subprocess.run([oiiotool, source, *words, "-o", self.path(name)], check=True)
        for extension, kind in (("exr", "half"), ("tif", "uint16"), ("jpg", "uint8"), ("tga", "uint8")):
            for role, channels in (("roughness", 1), ("specular", 3)):
                other(f"{extension}/{extension}_{role}.{extension}", channels, "-d", kind)
        for role, channels in (("roughness", 1), ("specular", 3)):
            other(f"tiled/tiled_{role}.exr", channels, "-d", "float", "--tile", "16", "16", "--attrib", "myStudio:asset", "a7")


if __name__ == "__main__":
    Inputs(sys.argv[1]).make(sys.argv[2] if len(sys.argv) > 2 else None)
