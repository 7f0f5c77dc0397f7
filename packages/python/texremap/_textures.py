"""Textures of whole materials: their texels, and new ones."""

import glob
import os
import re
from typing import NamedTuple, Optional, Tuple

import numpy as np

from ._error import Error
from ._files import replacing

_PNG_LEVEL = 6
_BAND = 1 << 18  # texels that are converted at once
TILE = "<UDIM>"
_PACKED = ".usdz["  # in the path of a texture inside of a package


class Place(NamedTuple):
    """The position of a texture on a surface."""

    primvar: str = "st"
    scale: Tuple[float, float] = (1.0, 1.0)
    rotation: float = 0.0  # degrees
    translation: Tuple[float, float] = (0.0, 0.0)


class Texture(NamedTuple):
    """A value that is ``scale * texel + bias`` for each channel."""

    file: str  # as the layer has it
    path: str  # on this disk
    channels: str  # "rgb", "r", "g", "b" or "a"
    space: str = "auto"  # "sRGB", "raw" or "auto"
    scale: Tuple[float, ...] = (1.0, 1.0, 1.0)
    bias: Tuple[float, ...] = (0.0, 0.0, 0.0)
    wrap: Tuple[Optional[str], Optional[str]] = (None, None)
    place: Place = Place()

    def is_color(self):
        return self.channels == "rgb"

    def scaled(self, scale, bias):
        """Returns the texture with the value ``scale * value + bias``."""
        return self._replace(scale=tuple(float(s * k) for s, k in zip(self.scale, scale)),
                             bias=tuple(float(b * k + c) for b, k, c in zip(self.bias, scale, bias)))

    def values_of(self, texels):
        channels = 3 if self.is_color() else 1
        return texels * np.array(self.scale[:channels], np.float32) + np.array(self.bias[:channels], np.float32)


def tiles_of(path, name):
    """Returns the numbers that replace ``<UDIM>`` in the files that exist, or one empty text for a path
    without it."""
    if TILE not in path:
        if not os.path.isfile(path.split("[", 1)[0] if _PACKED in path else path):
            raise Error(f"{name}: {path}: file not found", "input")
        return ("",)
    start, end = path.split(TILE, 1)
    pattern = re.compile(re.escape(start) + r"(1\d\d\d)" + re.escape(end))
    found = [pattern.fullmatch(file) for file in sorted(glob.glob(glob.escape(start) + "1[0-9][0-9][0-9]" + glob.escape(end)))]
    tiles = tuple(match[1] for match in found if match)
    if not tiles:
        raise Error(f"{name}: {path}: no tile found", "input")
    return tiles


def linear(values):
    low = values <= 0.04045
    return np.where(low, values / 12.92, ((np.maximum(values, 0.04045) + 0.055) / 1.055) ** 2.4)  # IEC 61966-2-1


def _srgb(values):
    return np.where(values <= 0.0031308, values * 12.92, 1.055 * np.maximum(values, 0.0031308) ** (1 / 2.4) - 0.055)


def read(texture, tile):
    """Returns linear values of shape (height, width, 1 or 3), and whether the file has more than 8 bits."""
    from .images import MOST_TEXELS, Images

    path = texture.path.replace(TILE, tile)
    if _PACKED in path:
        raise Error(f"{path}: must be converted, but is in a USDZ package (unpack the package first, for example with unzip)", "input")
    image = Images().open(path, 0)
    layout = image.layout()
    if layout["width"] * layout["height"] > MOST_TEXELS:
        raise Error(f"{path}: {layout['width']}x{layout['height']} texels are more than {MOST_TEXELS}", "input")
    kinds = {kind for _, kind in layout["channels"]}
    if len(kinds) > 1:
        raise Error(f"{path}: has channels of several types", "input")
    dtype = np.dtype({"uint8": "u1", "uint16": "u2", "uint": "u4", "half": "f2", "float": "f4"}.get(kinds.pop(), "f4"))
    count = len(layout["channels"])
    stored = np.empty((layout["height"], layout["width"], count), dtype)
    image.read_rows(0, layout["height"], memoryview(stored.view(np.uint8)).cast("B"))
    values = stored.astype(np.float32) / np.float32(1 if dtype.kind == "f" else np.iinfo(dtype).max)
    if not np.isfinite(values).all():
        raise Error(f"{path}: has texels that are not finite numbers", "input")
    colors = values[..., :1].repeat(3, axis=-1) if count < 3 else values[..., :3]
    # `auto`: 8-bit images of colors are sRGB unless the file says something else (UsdPreviewSurface, Texture Reader).
    if texture.space == "sRGB" or (texture.space == "auto" and dtype == np.uint8 and count >= 3):
        colors = linear(colors)
    alpha = values[..., 3:4] if count > 3 else values[..., 1:2] if count == 2 else np.ones_like(values[..., :1])
    four = np.concatenate([colors, alpha], axis=-1)
    place = {"rgb": slice(0, 3), "r": slice(0, 1), "g": slice(1, 2), "b": slice(2, 3), "a": slice(3, 4)}[texture.channels]
    return texture.values_of(four[..., place]).astype(np.float32), dtype != np.uint8


def resized(values, height, width):
    import OpenImageIO as oiio

    if values.shape[:2] == (height, width):
        return values
    small = oiio.ImageBuf(np.ascontiguousarray(values))
    return oiio.ImageBufAlgo.resize(small, roi=oiio.ROI(0, width, 0, height)).get_pixels(oiio.FLOAT).reshape(height, width, -1)


def baked(translate, constants, textures, wanted):
    """Returns an array for each output in ``wanted``, by tile: ``{tile: (arrays, is_deep)}``.

    Smaller textures are enlarged to the largest. ``translate`` converts dicts of arrays.
    """
    tiles = None
    for name, texture in textures.items():
        found = tiles_of(texture.path, name)
        if tiles not in (None, found):
            raise Error("its textures have different tiles (<UDIM>)", "input")
        tiles = found
    results = {}
    for tile in tiles:
        maps, deep = {}, False
        for name, texture in textures.items():
            maps[name], more = read(texture, tile)
            deep = deep or more
        height = max(values.shape[0] for values in maps.values())
        width = max(values.shape[1] for values in maps.values())
        flat = {name: resized(values, height, width).reshape(height * width, -1) for name, values in maps.items()}
        parts = {name: [] for name in wanted}
        for begin in range(0, height * width, _BAND):
            result = translate({**constants, **{name: values[begin:begin + _BAND] for name, values in flat.items()}})
            for name in wanted:
                parts[name].append(np.asarray(result[name], np.float32))
        results[tile] = {name: np.concatenate(arrays).reshape(height, width, -1) for name, arrays in parts.items()}, deep
    return results


def png_of(values, is_color, deep):
    """Returns the bytes of a PNG. Colors are in sRGB. The PNG has 16 bits if a source has more than 8."""
    from .images import Images

    if is_color:
        values = np.concatenate([_srgb(values[..., :3]), values[..., 3:]], axis=-1)
    most = 65535 if deep else 255
    stored = np.ascontiguousarray(np.round(np.clip(values, 0, 1) * most), np.uint16 if deep else np.uint8)
    height, width, channels = stored.shape
    return Images().encode_png(width, height, channels, str(stored.dtype), stored.tobytes(), _PNG_LEVEL)


def write_file(path, data):
    with replacing(path) as unfinished, open(unfinished, "wb") as file:
        file.write(data)
