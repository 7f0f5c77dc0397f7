"""The command gives what the C++ program gives: packages/tests/cases.json, value by value and byte by byte.

REMAP_TEXREMAP: the program; without it, and without OpenImageIO, these tests are skipped.
"""

import importlib.metadata
import json
import os
import re
import shutil
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

oiio = pytest.importorskip("OpenImageIO")
PROGRAM = os.environ.get("REMAP_TEXREMAP", "")
pytestmark = pytest.mark.skipif(not PROGRAM, reason="REMAP_TEXREMAP names no program to compare with")
SHARED = Path(__file__).resolve().parents[2] / "tests"
CASES = json.loads((SHARED / "cases.json").read_text())
IMAGES = {".png", ".exr", ".tif", ".jpg", ".tga"}
# These attributes belong to the file, not to the picture, or have another name in another version of OpenImageIO.
OTHER_ATTRIBUTES = ("Software", "oiio:", "openexr:", "png:", "tiff:", "XResolution", "YResolution", "ResolutionUnit", "Exif:",
                    "IPTC:", "planarconfig", "compression", "CICP", "colorInteropID", "targa:", "DateTime", "lineOrder")


@pytest.fixture(scope="session")
def inputs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("inputs")
    tool = shutil.which("oiiotool")
    subprocess.run([sys.executable, SHARED / "make_inputs.py", folder, *([tool] if tool else [])], check=True)
    return folder


def run(words, inputs, folder):
    shutil.copytree(inputs, folder)
    done = subprocess.run([*words[0], *words[1]], cwd=folder, capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def picture(path):
    """Returns values, channel names, types and attributes of every part of an image."""
    parts, config = [], oiio.ImageSpec()
    config.attribute("oiio:UnassociatedAlpha", 1)
    image = oiio.ImageInput.open(str(path), config)
    assert image is not None, f"{path}: {oiio.geterror()}"
    while image.seek_subimage(len(parts), 0):
        spec = image.spec()
        own = {value.name: value.value for value in spec.extra_attribs if not value.name.startswith(OTHER_ATTRIBUTES)}
        values = image.read_image(len(parts), 0, 0, spec.nchannels, str(spec.format))
        parts.append((values, (tuple(spec.channelnames), str(spec.format), spec.tile_width, spec.tile_height), own))
    return parts


def chunks(path):
    """Returns the chunks of a PNG that a picture needs, and the chunks that define how colors are read.

    Returns nothing for other files.
    """
    data, found = path.read_bytes(), {}
    place = 8
    while data.startswith(b"\x89PNG") and place < len(data):
        length, name = struct.unpack_from(">I4s", data, place)
        if name in (b"IHDR", b"PLTE", b"cHRM", b"cICP", b"gAMA", b"iCCP", b"IDAT", b"IEND", b"sRGB"):
            found[name] = data[place + 8 : place + 8 + length] if name not in (b"iCCP", b"IDAT") else "compressed"
        place += 12 + length
    return found


def assert_same_image(ours, theirs):
    assert chunks(ours) == chunks(theirs)
    ours, theirs = picture(ours), picture(theirs)
    assert len(ours) == len(theirs)
    for (values, layout, own), (others, other_layout, other_own) in zip(ours, theirs):
        assert layout == other_layout and own == other_own
        assert np.array_equal(values, others)


def glb_parts(data):
    """Returns the document of a .glb without the numbers that depend on the sizes of images, and its buffer."""
    length = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20 : 20 + length])
    binary = data[20 + length + 8 :]
    return document, binary


def assert_same_glb(ours, theirs, folder):
    (document, binary), (other, other_binary) = glb_parts(ours.read_bytes()), glb_parts(theirs.read_bytes())
    images = {image["bufferView"] for image in document.get("images", []) if "bufferView" in image}
    for number in images:
        files = []
        for name, (text, data) in (("ours", (document, binary)), ("theirs", (other, other_binary))):
            view = text["bufferViews"][number]
            begin = view.get("byteOffset", 0)
            files.append(folder / f"{name}.png")
            files[-1].write_bytes(data[begin : begin + view["byteLength"]])
        assert_same_image(*files)
    for text in (document, other):
        for number, view in enumerate(text.get("bufferViews", [])):
            view["byteOffset"] = 0
            if number in images:
                view["byteLength"] = 0
        for buffer in text.get("buffers", []):
            buffer["byteLength"] = 0
    assert document == other


def without_times(text):
    """Returns the lines of a report without times, in an order that does not depend on threads."""
    text = "\n".join(sorted(text.split("\n")))
    return re.sub(r"[0-9.]+ s\b", "0 s", re.sub(r'"seconds": [0-9.e-]+', '"seconds": 0', text))


@pytest.mark.parametrize("case", CASES, ids=[case["name"] for case in CASES])
def test_case(case, inputs, tmp_path):
    if any(kind != "png" for kind in case["formats"]) and not shutil.which("oiiotool"):
        pytest.skip("oiiotool makes the inputs")
    ours = run(([sys.executable, "-m", "texremap"], case["arguments"]), inputs, tmp_path / "ours")
    theirs = run(([PROGRAM], case["arguments"]), inputs, tmp_path / "theirs")
    assert ours[0] == theirs[0], ours[2]
    assert [without_times(text) for text in ours[1:]] == [without_times(text) for text in theirs[1:]]
    files = sorted(path.relative_to(tmp_path / "theirs") for path in (tmp_path / "theirs").rglob("*") if path.is_file())
    assert files == sorted(path.relative_to(tmp_path / "ours") for path in (tmp_path / "ours").rglob("*") if path.is_file())
    for file in files:
        if file.parts[0] != "out" or file.name == ".texremap.jsonl":  # the journal has hashes of encoded files
            continue
        pair = tmp_path / "ours" / file, tmp_path / "theirs" / file
        if file.suffix in IMAGES:
            assert_same_image(*pair)
        elif file.suffix == ".glb":
            assert_same_glb(*pair, tmp_path)
        else:
            assert pair[0].read_bytes() == pair[1].read_bytes(), file


def test_help_shows_the_commands_of_the_package():
    shown = subprocess.run([sys.executable, "-m", "texremap", "--help"], check=True, capture_output=True, text=True).stdout
    assert shown.startswith("Convert ")
    assert "\nOnly in the Python package:\n  mtlx " in shown and "\n  usd " in shown


def test_manual_pages_and_completion_are_installed():
    installed = {path.as_posix().rpartition("share/")[2]: path for path in importlib.metadata.files("texremap")}
    assert {"man/man1/texremap.1", "man/man1/texremap-convert.1", "man/man1/texremap-mtlx.1", "man/man1/texremap-usd.1",
            "bash-completion/completions/texremap", "zsh/site-functions/_texremap",
            "fish/vendor_completions.d/texremap.fish"} <= installed.keys()
    assert "'usd '*)" in installed["bash-completion/completions/texremap"].read_text()
