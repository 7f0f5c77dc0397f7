"""Tests images in files and in memory: what is refused before an importer reads it, and what outlives a call."""

import os
import struct
import subprocess
import sys
import zlib

import numpy as np
import pytest

oiio = pytest.importorskip("OpenImageIO")

from texremap import _files, images  # noqa: E402


def chunk(name, data, length=None):
    return struct.pack(">I", len(data) if length is None else length) + name + data + struct.pack(">I", zlib.crc32(name + data))


def png(side, *more):
    header = struct.pack(">IIBBBBB", side, side, 16, 6, 0, 0, 1)
    return b"".join((b"\x89PNG\r\n\x1a\n", chunk(b"IHDR", header), *more, chunk(b"IDAT", b""), chunk(b"IEND", b"")))


def bmp(bits, compression, header=40):
    return b"BM" + struct.pack("<IIIIiiHHI", 200, 0, 54, header, 2, 2, 1, bits, compression) + bytes(120)


def tiff(side):
    """Returns a TIFF file with one strip of no bytes."""
    tags = ((256, side), (257, side), (258, 8), (259, 1), (262, 1), (273, 8), (277, 1), (278, side), (279, 0))
    return b"II*\0\x08\0\0\0" + struct.pack("<H", len(tags)) + b"".join(
        struct.pack("<HHII", tag, 4, 1, value) for tag, value in tags) + bytes(4)


HOSTILE = {
    "png": (png(32768), "claim"),
    "chunk of a png": (png(2, chunk(b"zTXt", b"a", 2**31 - 1)), "chunk zTXt claims to be longer than the file"),
    "bmp of 24 bits": (bmp(24, 1), "compression 1 of 24 bits"),
    "bmp of 8 bits": (bmp(8, 3), "compression 3 of 8 bits"),
    "bmp with high bits": (bmp(24, 0x10000), "compression 65536 of 24 bits"),
    "header of a bmp": (bmp(24, 0, 268), "of an unknown kind"),
    "tiff": (tiff(30000), "claims 30000x30000 texels in 122 bytes"),
    "dpx": (b"SDPX" + bytes(2044), "known format|unknown format"),
    "gif": (b"GIF89a" + bytes(100), "known format|unknown format"),
    "ico": (b"\0\0\1\0\1\0\x10\x10\0\0\1\0\x20\0\x68\4" + bytes(1200), "known format|unknown format"),
    "nothing": (b"", "known format|unknown format"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_refused(name, tmp_path):
    data, message = HOSTILE[name]
    file = tmp_path / "a_roughness.png"
    file.write_bytes(data)
    with pytest.raises(ValueError, match=f"a_roughness.png: .*({message})"):
        images.StoredImage(str(file), 0)
    with pytest.raises(ValueError, match=f"a.gltf: .*({message})"):
        images.Images().decode(data, "a.gltf")


@pytest.mark.parametrize("extension", ["png", "jpg", "webp", "bmp", "tif", "tga", "exr", "hdr"])
def test_content_chooses_the_reader(extension, tmp_path):
    right = str(tmp_path / f"a.{extension}")
    output = oiio.ImageOutput.create(right)
    values = np.arange(8 * 8 * 3, dtype=np.uint8).reshape(8, 8, 3)
    assert output.open(right, oiio.ImageSpec(8, 8, 3, "uint8")) and output.write_image(values) and output.close()
    rows = []
    for path in (right, *map(str, (tmp_path / "b.png", tmp_path / "C.EXR", tmp_path / "d.ico", tmp_path / "e"))):
        if not os.path.exists(path):
            os.link(right, path)
        image = images.StoredImage(path, 0)
        layout = image.layout()
        texel = sum(np.dtype(images._DTYPES[kind]).itemsize for _, kind in layout["channels"])
        rows.append(bytearray(64 * texel))
        image.read_rows(0, 8, rows[-1])
    assert all(row == rows[0] for row in rows) and any(rows[0])


def test_other_users_of_the_library_keep_its_settings(tmp_path):
    assert oiio.get_int_attribute("try_all_readers", 1) == 1
    with pytest.raises(ValueError):
        images.StoredImage(__file__, 0)
    assert oiio.get_int_attribute("try_all_readers", 1) == 1


KEEPING = """
import sys
from texremap import _core, images

kept = []

class Stored(images.StoredImage):
    def read_rows(self, first, count, texels):
        super().read_rows(first, count, texels)
        kept.append((texels, bytes(texels)))

class New(images.NewImage):
    def write_rows(self, first, count, texels):
        super().write_rows(first, count, texels)
        kept.append((texels, bytes(texels)))

class Keeping(images.Images):
    def open(self, path, part):
        return Stored(path, part)
    def create(self, path, unfinished, parts):
        return New(path, unfinished, parts)

_core.use_images(Keeping())
assert _core.run(sys.argv[1:], False) == 0
assert len(kept) > 1 and all(isinstance(memory, (bytes, bytearray)) and bytes(memory) == seen for memory, seen in kept)
"""


def test_memory_may_be_kept(tmp_path):
    for name, channels in (("roughness", 1), ("specular", 3)):
        path = str(tmp_path / f"a_{name}.png")
        output = oiio.ImageOutput.create(path)
        values = np.full((8, 8, channels), 99, np.uint8)
        assert output.open(path, oiio.ImageSpec(8, 8, channels, "uint8")) and output.write_image(values) and output.close()
    words = ("convert", tmp_path, "--from", "mitsuba/ward", "--to", "mitsuba/as", "-o", tmp_path / "out")
    done = subprocess.run([sys.executable, "-c", KEEPING, *map(str, words)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_new_files_follow_no_links(tmp_path):
    other, link, result = tmp_path / "other", tmp_path / "link", tmp_path / "result.png"
    other.write_text("mine")
    link.symlink_to(other)
    with pytest.raises(FileExistsError):
        _files.create_new(link)
    result.symlink_to(other)
    with _files.replacing(str(result)) as first, _files.replacing(str(tmp_path / "second.png")) as second:
        assert first != second and first.endswith(".png")
        for name in (first, second):
            with open(name, "w") as file:
                file.write("new")
    assert other.read_text() == "mine" and result.read_text() == "new" and not result.is_symlink()
    with pytest.raises(RuntimeError):
        with _files.replacing(str(result)) as unfinished:
            raise RuntimeError
    assert not os.path.exists(unfinished) and result.read_text() == "new"
    assert sorted(os.listdir(tmp_path)) == ["link", "other", "result.png", "second.png"]
