"""Materials of glTF files: their textures and factors, and a reader. The model is ``gltf_pbr`` of MaterialX."""

import base64
import binascii
import json
import math
import mmap
import os
import re
import struct
from typing import Dict, NamedTuple, Tuple
from urllib.parse import unquote

import numpy as np

from . import materials
from ._error import Error
from ._networks import turned
from ._surface import Surface
from ._textures import Place, Texture, write_file

MODEL = "gltf_pbr"
_MOST_JSON = 64 << 20
_MOST_MATERIALS = 10000
JSON_CHUNK, BINARY_CHUNK = 0x4E4F534A, 0x004E4942
WRAP = {10497: "repeat", 33071: "clamp", 33648: "mirror"}
ALPHA_MODES = ("OPAQUE", "MASK", "BLEND")
_SIGNATURES = ((b"\x89PNG\r\n\x1a\n", "png"), (b"\xff\xd8\xff", "jpg"))
TRANSFORM, STRENGTH = "KHR_texture_transform", "KHR_materials_emissive_strength"
PBR = "pbrMetallicRoughness"


class Slot(NamedTuple):
    """A texture of a material, with the inputs that its channels hold, and their factors."""

    holder: str  # an extension, or a member of the material
    name: str
    inputs: Dict[str, Tuple[str, str]]  # input -> channels, factor
    is_srgb: bool = False


SLOTS = (
    Slot(PBR, "baseColor", {"base_color": ("rgb", "baseColorFactor"), "alpha": ("a", "baseColorFactor")}, True),
    Slot(PBR, "metallicRoughness", {"metallic": ("b", "metallicFactor"), "roughness": ("g", "roughnessFactor")}),
    Slot("", "occlusion", {"occlusion": ("r", "")}),
    Slot("", "emissive", {"emissive": ("rgb", "emissiveFactor")}, True),
    Slot("KHR_materials_clearcoat", "clearcoat", {"clearcoat": ("r", "clearcoatFactor")}),
    Slot("KHR_materials_clearcoat", "clearcoatRoughness", {"clearcoat_roughness": ("g", "clearcoatRoughnessFactor")}),
    Slot("KHR_materials_sheen", "sheenColor", {"sheen_color": ("rgb", "sheenColorFactor")}, True),
    Slot("KHR_materials_sheen", "sheenRoughness", {"sheen_roughness": ("a", "sheenRoughnessFactor")}),
    Slot("KHR_materials_specular", "specular", {"specular": ("a", "specularFactor")}),
    Slot("KHR_materials_specular", "specularColor", {"specular_color": ("rgb", "specularColorFactor")}, True),
    Slot("KHR_materials_transmission", "transmission", {"transmission": ("r", "transmissionFactor")}),
    Slot("KHR_materials_volume", "thickness", {"thickness": ("g", "thicknessFactor")}),
    Slot("KHR_materials_iridescence", "iridescence", {"iridescence": ("r", "iridescenceFactor")}),
    Slot("KHR_materials_iridescence", "iridescenceThickness", {"iridescence_thickness": ("g", "")}),
    Slot("KHR_materials_anisotropy", "anisotropy", {"anisotropy_strength": ("b", "anisotropyStrength")}),
)
# These inputs have no texture. Each has its extension, and its name there.
FACTORS = {
    "ior": ("KHR_materials_ior", "ior"),
    "attenuation_distance": ("KHR_materials_volume", "attenuationDistance"),
    "attenuation_color": ("KHR_materials_volume", "attenuationColor"),
    "iridescence_ior": ("KHR_materials_iridescence", "iridescenceIor"),
    "anisotropy_rotation": ("KHR_materials_anisotropy", "anisotropyRotation"),
    "dispersion": ("KHR_materials_dispersion", "dispersion"),
}
# A lobe without this input shows nothing.
NEEDED = {"KHR_materials_clearcoat": "clearcoat", "KHR_materials_sheen": "sheen_color", "KHR_materials_transmission": "transmission",
           "KHR_materials_volume": "thickness", "KHR_materials_iridescence": "iridescence",
           "KHR_materials_anisotropy": "anisotropy_strength", "KHR_materials_dispersion": "dispersion"}
EXTENSIONS = {STRENGTH, *NEEDED, "KHR_materials_specular", "KHR_materials_ior"}


def extension_of(data):
    """Returns the file extension of an image that glTF allows, by its first bytes, or an empty text."""
    return next((ending for signature, ending in _SIGNATURES if data.startswith(signature)), "")



def fail(place, what):
    raise Error(f"{place}: {what}", "input")


def _object(holder, name, place):
    value = holder.get(name, {})
    return value if isinstance(value, dict) else fail(f"{place}.{name}", "is not an object")


def _number(holder, name, otherwise, place):
    value = holder.get(name, otherwise)
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < 1e30
    return float(value) if is_number else fail(f"{place}.{name}", "is not a number")


def _numbers(holder, name, otherwise, place):
    values = holder.get(name, list(otherwise))
    if not isinstance(values, list) or len(values) != len(otherwise):
        fail(f"{place}.{name}", f"is not a list of {len(otherwise)} numbers")
    return tuple(_number({name: value}, name, 0, place) for value in values)


def index_of(holder, name, place, otherwise=None):
    value = holder.get(name, otherwise)
    is_index = isinstance(value, int) and not isinstance(value, bool) and value >= 0
    return value if is_index else fail(f"{place}.{name}", "is not an index")


class GltfReader:
    """A glTF or GLB file."""

    def __init__(self, path, folder):
        """Opens the file at ``path``. Images that are embedded in it are extracted to ``folder``."""
        self.path, self.folder = path, folder
        self.image_of_path, self._buffers, self.files = {}, {}, set()
        try:
            if not os.path.isfile(path):
                raise Error(f"{path}: cannot be read: file not found", "input")
            data = self._mapped(path)
            text = data
            if bytes(data[:4]) == b"glTF":
                text, self._buffers[0] = self._chunks(data)
            if len(text) > _MOST_JSON:
                raise Error(f"{path}: its JSON has more than {_MOST_JSON} bytes", "input")
            self.json = json.loads(bytes(text).decode("utf-8"), parse_constant=lambda word: fail(path, f"{word} is not JSON"))
        except (OSError, ValueError, RecursionError) as failure:
            if isinstance(failure, Error):
                raise
            reason = "its JSON is too deep" if isinstance(failure, RecursionError) else getattr(failure, "strerror", None) or failure
            raise Error(f"{path}: cannot be read: {reason}", "input") from None
        if not isinstance(self.json, dict) or not str(_object(self.json, "asset", path).get("version", "")).startswith("2."):
            raise Error(f"{path}: is not glTF 2.0", "input")
        for name in ("textures", "images", "samplers", "bufferViews", "buffers"):
            self._list(name)
        for name in ("extensionsUsed", "extensionsRequired"):
            self._list(name, str)
        self.materials = self._list("materials")
        if len(self.materials) > _MOST_MATERIALS:
            raise Error(f"{path}: has more than {_MOST_MATERIALS} materials", "input")

    @staticmethod
    def _mapped(path):
        if os.path.getsize(path) == 0:
            return memoryview(b"")
        with open(path, "rb") as file:
            return memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))

    def _chunks(self, data):
        if len(data) < 20:
            raise Error(f"{self.path}: is cut off", "input")
        _, version, length, size, kind = struct.unpack_from("<5I", data)
        if version != 2 or kind != JSON_CHUNK:
            raise Error(f"{self.path}: is not a GLB file of version 2", "input")
        if length > len(data) or 20 + size > length:
            raise Error(f"{self.path}: is cut off", "input")
        at = 20 + size
        binary = memoryview(b"")
        if at + 8 <= length:
            count, kind = struct.unpack_from("<2I", data, at)
            if kind == BINARY_CHUNK:
                if at + 8 + count > length:
                    raise Error(f"{self.path}: is cut off", "input")
                binary = data[at + 8:at + 8 + count]
        return data[20:20 + size], binary

    def _list(self, name, kind=dict):
        values = self.json.get(name, [])
        if not isinstance(values, list) or not all(isinstance(value, kind) for value in values):
            fail(self.path, f"{name} is not a list of {'objects' if kind is dict else 'names'}")
        return values

    def _item(self, name, index, place):
        values = self._list(name)
        return values[index] if index < len(values) else fail(place, f"{name}[{index}] does not exist")

    def name_of(self, index):
        name = self.materials[index].get("name")
        return name if isinstance(name, str) and name else f"materials[{index}]"

    def reason_to_leave(self, index, read=None):
        """Returns why a material is not converted, or an empty text. ``read`` has the extensions that the
        importer of the result reads."""
        extensions = _object(self.materials[index], "extensions", "material")
        if "KHR_materials_unlit" in extensions:
            return "it is unlit"
        if "KHR_materials_pbrSpecularGlossiness" in extensions:
            return "it is in the spec-gloss workflow (first: texremap convert --to gltf)"
        if read is not None and not EXTENSIONS.intersection(extensions).difference(read):
            return "the importer reads all of it"
        return ""

    def surface(self, index):
        material, sources, lost = self.materials[index], {}, []
        extensions = _object(material, "extensions", "material")
        for name, default in materials.MODELS[MODEL].items():
            sources[name] = tuple(np.ravel(default).tolist())
        for slot in SLOTS:
            if slot.holder in extensions or slot.holder in ("", PBR):
                self._read_slot(slot, self._holder(material, slot.holder), sources, lost)
        for name, (extension, word) in FACTORS.items():
            if extension in extensions:
                sources[name] = self._factor(self._holder(material, extension), word, sources[name], extension)
        strength = _number(self._holder(material, STRENGTH), "emissiveStrength", 1, STRENGTH)
        mode = material.get("alphaMode", "OPAQUE")
        if mode not in ALPHA_MODES:
            fail("alphaMode", f"{mode} is not a mode")
        sources.update(emissive_strength=(strength,), alpha_mode=(float(ALPHA_MODES.index(mode)),),
                       alpha_cutoff=(_number(material, "alphaCutoff", 0.5, "material"),))
        if mode == "OPAQUE":
            sources["alpha"] = (1.0,)
        lost += [f"{name}: is not known" for name in sorted(extensions) if name not in EXTENSIONS]
        return Surface(MODEL, sources, self._normals(material), lost)

    @staticmethod
    def _holder(material, name):
        if name in ("", PBR):
            return _object(material, name, "material") if name else material
        return _object(_object(material, "extensions", "material"), name, "extensions")

    @staticmethod
    def _factor(holder, word, otherwise, place):
        if len(otherwise) == 1:
            return (_number(holder, word, otherwise[0], place),)
        return _numbers(holder, word, otherwise, place)

    def _read_slot(self, slot, holder, sources, lost):
        place, key = slot.holder or "material", f"{slot.name}Texture"
        info = _object(holder, key, place) if key in holder else None
        factors, biases = {}, {}
        if slot.name == "baseColor":
            four = _numbers(holder, "baseColorFactor", (1.0,) * 4, place)
            factors = {"base_color": four[:3], "alpha": four[3:]}
        elif slot.name == "iridescenceThickness":
            low = _number(holder, "iridescenceThicknessMinimum", 100, place) if info is not None else 0.0
            factors["iridescence_thickness"] = (_number(holder, "iridescenceThicknessMaximum", 400, place) - low,)
            biases["iridescence_thickness"] = (low,)
        elif slot.name == "occlusion":
            factors["occlusion"] = (_number(info or {}, "strength", 1, key),)
            biases["occlusion"] = (1 - factors["occlusion"][0],)
        else:
            factors = {name: self._factor(holder, factor, sources[name], place) for name, (_, factor) in slot.inputs.items()}
        for name, (channels, _) in slot.inputs.items():
            sources[name] = factors[name]
            if info is not None:
                texture = self._texture(info, key, channels, slot.is_srgb)
                sources[name] = texture.scaled(factors[name], biases.get(name, (0.0,) * 3))
        if slot.name == "anisotropy" and info is not None:
            lost.append("anisotropy_rotation: the directions of its texture are passed over")

    def _normals(self, material):
        coat = self._holder(material, "KHR_materials_clearcoat")
        found = {}
        for name, holder, key in (("normal", material, "normalTexture"), ("coat_normal", coat, "clearcoatNormalTexture")):
            if key in holder:
                info = _object(holder, key, "material")
                strength = _number(info, "scale", 1, key)
                texture = self._texture(info, key, "rgb", False)
                found[name] = texture.scaled((2 * strength, 2 * strength, 2.0), (-strength, -strength, -1.0))
        return found

    def _texture(self, info, place, channels, is_srgb):
        texture = self._item("textures", index_of(info, "index", place), place)
        file, path = self._image(texture, place)
        sampler = self._item("samplers", index_of(texture, "sampler", place), place) if "sampler" in texture else {}
        wrap = tuple(WRAP.get(sampler.get(f"wrap{axis}", 10497)) or fail(place, f"wrap{axis} is not a mode") for axis in "ST")
        count = 3 if channels == "rgb" else 1
        return Texture(file, path, channels, "sRGB" if is_srgb and channels == "rgb" else "raw", (1.0,) * count, (0.0,) * count, wrap,
                       self._place(info, place))

    @staticmethod
    def _place(info, place):
        transform = _object(_object(info, "extensions", place), TRANSFORM, place)
        index = index_of(transform, "texCoord", place, index_of(info, "texCoord", place, 0))
        primvar = f"st{index}" if index else "st"
        offset, scale = (_numbers(transform, word, plain, place) for word, plain in (("offset", (0.0, 0.0)), ("scale", (1.0, 1.0))))
        rotation = math.degrees(_number(transform, "rotation", 0, place))
        # glTF counts v from the top, the other formats from the bottom: v' = 1 - v.
        moved = turned(rotation, (0.0, -scale[1]))
        translation = (moved[0] + offset[0], moved[1] - offset[1] + 1)
        return Place(primvar, scale, rotation, tuple(round(number, 9) + 0.0 for number in translation))

    def _image(self, texture, place):
        """Returns the image file of a texture, as this document names it, and its path. Extracts embedded
        images."""
        source = _object(_object(texture, "extensions", place), "EXT_texture_webp", place).get("source", texture.get("source"))
        if source is None:
            fail(place, "its texture has no PNG, JPEG or WebP image")
        index = index_of({"source": source}, "source", place)
        image = self._item("images", index, place)
        uri = image.get("uri")
        if isinstance(uri, str) and not uri.startswith("data:"):
            path = self.beside(uri, place)
            if not os.path.isfile(path):
                fail(place, f"{uri}: file not found")
            self.image_of_path[os.path.abspath(path)] = index
            return path, path
        data = self._decoded(uri, place) if isinstance(uri, str) else bytes(self._view(index_of(image, "bufferView", place), place))
        ending = extension_of(data) or ("webp" if data[:4] == b"RIFF" and data[8:12] == b"WEBP" else "")
        if not ending:
            fail(place, f"images[{index}] is not a PNG, JPEG or WebP image")
        name = image.get("name")
        words = re.sub(r"[^\w-]+", "_", name)[:60] if isinstance(name, str) and name else "image"
        path = os.path.join(self.folder, f"{words}_{index}.{ending}")
        if not os.path.exists(path):
            write_file(path, data)
        self.image_of_path[path] = index
        return path, path

    def beside(self, uri, place):
        """Returns the path of a file that this document names. The file must lie in the folder of the
        document."""
        root = os.path.realpath(os.path.dirname(os.path.abspath(self.path)))
        name = unquote(uri)
        if re.match(r"[a-zA-Z][a-zA-Z0-9+.-]*:|/|\\", name) or "\0" in name:
            fail(place, f"{uri}: is not a file beside the document")
        path = os.path.join(root, name)
        if os.path.commonpath([root, os.path.realpath(path)]) != root:
            fail(place, f"{uri}: leads out of the folder of the document")
        self.files.add(os.path.realpath(path))
        return path

    @staticmethod
    def _decoded(uri, place):
        try:
            return base64.b64decode(uri.split(";base64,", 1)[1], validate=True)
        except (IndexError, binascii.Error):
            fail(place, "its data URI is not base64")

    def _view(self, index, place):
        view = self._item("bufferViews", index, place)
        data = self.buffer(index_of(view, "buffer", place), place)
        begin, count = index_of(view, "byteOffset", place, 0), index_of(view, "byteLength", place)
        return data[begin:begin + count] if begin + count <= len(data) else fail(place, f"bufferViews[{index}] is out of its buffer")

    def buffer(self, index, place):
        buffer = self._item("buffers", index, place)
        if index not in self._buffers or "uri" in buffer:
            uri = buffer.get("uri")
            if not isinstance(uri, str):
                fail(place, f"buffers[{index}] has no data")
            path = "" if uri.startswith("data:") else self.beside(uri, place)
            if path and not os.path.isfile(path):
                fail(place, f"{uri}: file not found")
            self._buffers[index] = self._mapped(path) if path else memoryview(self._decoded(uri, place))
        return self._buffers[index]
