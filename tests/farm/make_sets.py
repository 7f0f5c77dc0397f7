"""Writes a tree of small texture sets in nested folders, fast and without an image library.

  make_sets.py FOLDER COUNT

Sets are PNG of 8 and 16 bits, TGA and EXR with half floats, each with its own content. They have 16 to 64 texels a
side, but one in 15 has 256. Parts with equal numbers of sets therefore differ in cost.
"""
import pathlib
import struct
import sys
import zlib

import numpy as np


def png(path, texels):
    height, width, channels = texels.shape
    depth = texels.dtype.itemsize
    rows = texels.astype(texels.dtype.newbyteorder(">")).reshape(height, -1).view(np.uint8)
    packed = zlib.compress(np.insert(rows, 0, 0, axis=1).tobytes(), 1)
    kind = struct.pack(">IIBBBBB", width, height, 8 * depth, {1: 0, 3: 2}[channels], 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for name, data in ((b"IHDR", kind), (b"IDAT", packed), (b"IEND", b"")):
            file.write(struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data)))


def tga(path, texels):
    height, width, channels = texels.shape
    header = struct.pack("<BBBHHBHHHHBB", 0, 0, {1: 3, 3: 2}[channels], 0, 0, 0, 0, 0, width, height, 8 * channels, 0x20)
    path.write_bytes(header + np.ascontiguousarray(texels[:, :, ::-1]).tobytes())


def exr(path, texels):
    height, width, channels = texels.shape
    names = {1: "Y", 3: "BGR"}[channels]
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = struct.pack("<II", 20000630, 2)
    for name, kind, value in (
            ("channels", "chlist", b"".join(n.encode() + struct.pack("<xIIII", 1, 0, 1, 1) for n in names) + b"\0"),
            ("compression", "compression", b"\0"), ("dataWindow", "box2i", box), ("displayWindow", "box2i", box),
            ("lineOrder", "lineOrder", b"\0"), ("pixelAspectRatio", "float", struct.pack("<f", 1)),
            ("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)), ("screenWindowWidth", "float", struct.pack("<f", 1))):
        header += name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    header += b"\0"
    row = 2 * channels * width
    table = b"".join(struct.pack("<Q", len(header) + 8 * height + y * (8 + row)) for y in range(height))
    planes = np.ascontiguousarray(texels[:, :, ::-1].transpose(0, 2, 1)).astype("<f2")
    path.write_bytes(header + table + b"".join(struct.pack("<ii", y, row) + planes[y].tobytes() for y in range(height)))


KINDS = ((png, "png", lambda t: (255 * t).astype(np.uint8)), (exr, "exr", lambda t: t.astype(np.float16)),
         (png, "png", lambda t: (65535 * t).astype(np.uint16)), (tga, "tga", lambda t: (255 * t).astype(np.uint8)))


def main(folder, count):
    random = np.random.default_rng(1)
    for i in range(count):
        write, extension, pixels = KINDS[i % 4]
        side = 256 if i % 15 == 5 else 16 + 8 * (i % 7)
        place = folder / f"region{i % 5}" / f"group{i % 17:02}" / f"prop{i:05}"
        place.mkdir(parents=True)
        for role, channels in (("roughness", 1), ("specular", 3)):
            texels = 0.2 + 0.6 * random.random((side, side, channels), np.float32)
            write(place / f"prop{i:05}_{role}.{extension}", pixels(texels))


main(pathlib.Path(sys.argv[1]), int(sys.argv[2]))
