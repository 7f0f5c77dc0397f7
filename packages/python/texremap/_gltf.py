"""Materials of glTF files: a reader, and a writer. The model is ``gltf_pbr`` of MaterialX, which has the names and defaults of glTF."""

import base64
import binascii
import json
import math
import mmap
import os
import re
import struct
from typing import Dict, NamedTuple, Tuple
from urllib.parse import quote, unquote

import numpy as np

from . import materials
from ._core import __version__
from ._error import Error
from ._files import replacing
from ._networks import turned
from ._surface import Surface
from ._textures import TILE, Place, Texture, png_of, read, resized, write_file

MODEL = "gltf_pbr"
_MOST_JSON = 64 << 20
_MOST_MATERIALS = 10000
_JSON_CHUNK, _BINARY_CHUNK = 0x4E4F534A, 0x004E4942
_WRAP = {10497: "repeat", 33071: "clamp", 33648: "mirror"}
_CODE_OF_WRAP = {word: code for code, word in _WRAP.items()}
_ALPHA_MODES = ("OPAQUE", "MASK", "BLEND")
_SIGNATURES = ((b"\x89PNG\r\n\x1a\n", "png"), (b"\xff\xd8\xff", "jpg"))
_TRANSFORM, _STRENGTH = "KHR_texture_transform", "KHR_materials_emissive_strength"
_PBR = "pbrMetallicRoughness"


class _Slot(NamedTuple):
    """A texture of a material, with the inputs that its channels hold, and their factors."""

    holder: str  # an extension, or a member of the material
    name: str
    inputs: Dict[str, Tuple[str, str]]  # input -> channels, factor
    is_srgb: bool = False


_SLOTS = (
    _Slot(_PBR, "baseColor", {"base_color": ("rgb", "baseColorFactor"), "alpha": ("a", "baseColorFactor")}, True),
    _Slot(_PBR, "metallicRoughness", {"metallic": ("b", "metallicFactor"), "roughness": ("g", "roughnessFactor")}),
    _Slot("", "occlusion", {"occlusion": ("r", "")}),
    _Slot("", "emissive", {"emissive": ("rgb", "emissiveFactor")}, True),
    _Slot("KHR_materials_clearcoat", "clearcoat", {"clearcoat": ("r", "clearcoatFactor")}),
    _Slot("KHR_materials_clearcoat", "clearcoatRoughness", {"clearcoat_roughness": ("g", "clearcoatRoughnessFactor")}),
    _Slot("KHR_materials_sheen", "sheenColor", {"sheen_color": ("rgb", "sheenColorFactor")}, True),
    _Slot("KHR_materials_sheen", "sheenRoughness", {"sheen_roughness": ("a", "sheenRoughnessFactor")}),
    _Slot("KHR_materials_specular", "specular", {"specular": ("a", "specularFactor")}),
    _Slot("KHR_materials_specular", "specularColor", {"specular_color": ("rgb", "specularColorFactor")}, True),
    _Slot("KHR_materials_transmission", "transmission", {"transmission": ("r", "transmissionFactor")}),
    _Slot("KHR_materials_volume", "thickness", {"thickness": ("g", "thicknessFactor")}),
    _Slot("KHR_materials_iridescence", "iridescence", {"iridescence": ("r", "iridescenceFactor")}),
    _Slot("KHR_materials_iridescence", "iridescenceThickness", {"iridescence_thickness": ("g", "")}),
    _Slot("KHR_materials_anisotropy", "anisotropy", {"anisotropy_strength": ("b", "anisotropyStrength")}),
)
# Inputs without a texture: extension, name.
_FACTORS = {
    "ior": ("KHR_materials_ior", "ior"),
    "attenuation_distance": ("KHR_materials_volume", "attenuationDistance"),
    "attenuation_color": ("KHR_materials_volume", "attenuationColor"),
    "iridescence_ior": ("KHR_materials_iridescence", "iridescenceIor"),
    "anisotropy_rotation": ("KHR_materials_anisotropy", "anisotropyRotation"),
    "dispersion": ("KHR_materials_dispersion", "dispersion"),
}
# A lobe without this input shows nothing.
_NEEDED = {"KHR_materials_clearcoat": "clearcoat", "KHR_materials_sheen": "sheen_color", "KHR_materials_transmission": "transmission",
           "KHR_materials_volume": "thickness", "KHR_materials_iridescence": "iridescence",
           "KHR_materials_anisotropy": "anisotropy_strength", "KHR_materials_dispersion": "dispersion"}
_UNBOUNDED = {"specular_color", "thickness", "emissive"}
EXTENSIONS = {_STRENGTH, *_NEEDED, "KHR_materials_specular", "KHR_materials_ior"}


def extension_of(data):
    """The ending of an image that glTF holds, by its first bytes, or an empty word."""
    return next((ending for signature, ending in _SIGNATURES if data.startswith(signature)), "")


# Reading


def _fail(place, what):
    raise Error(f"{place}: {what}", "input")


def _object(holder, name, place):
    value = holder.get(name, {})
    return value if isinstance(value, dict) else _fail(f"{place}.{name}", "is not an object")


def _number(holder, name, otherwise, place):
    value = holder.get(name, otherwise)
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < 1e30
    return float(value) if is_number else _fail(f"{place}.{name}", "is not a number")


def _numbers(holder, name, otherwise, place):
    values = holder.get(name, list(otherwise))
    if not isinstance(values, list) or len(values) != len(otherwise):
        _fail(f"{place}.{name}", f"is not a list of {len(otherwise)} numbers")
    return tuple(_number({name: value}, name, 0, place) for value in values)


def _index(holder, name, place, otherwise=None):
    value = holder.get(name, otherwise)
    is_index = isinstance(value, int) and not isinstance(value, bool) and value >= 0
    return value if is_index else _fail(f"{place}.{name}", "is not an index")


class GltfReader:
    """A glTF or GLB file."""

    def __init__(self, path, folder):
        """``folder`` is where images that lie in the file become files of their own."""
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
            self.json = json.loads(bytes(text).decode("utf-8"), parse_constant=lambda word: _fail(path, f"{word} is not JSON"))
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
        if version != 2 or kind != _JSON_CHUNK:
            raise Error(f"{self.path}: is not a GLB file of version 2", "input")
        if length > len(data) or 20 + size > length:
            raise Error(f"{self.path}: is cut off", "input")
        at = 20 + size
        binary = memoryview(b"")
        if at + 8 <= length:
            count, kind = struct.unpack_from("<2I", data, at)
            if kind == _BINARY_CHUNK:
                if at + 8 + count > length:
                    raise Error(f"{self.path}: is cut off", "input")
                binary = data[at + 8:at + 8 + count]
        return data[20:20 + size], binary

    def _list(self, name, kind=dict):
        values = self.json.get(name, [])
        if not isinstance(values, list) or not all(isinstance(value, kind) for value in values):
            _fail(self.path, f"{name} is not a list of {'objects' if kind is dict else 'names'}")
        return values

    def _item(self, name, index, place):
        values = self._list(name)
        return values[index] if index < len(values) else _fail(place, f"{name}[{index}] does not exist")

    def name_of(self, index):
        name = self.materials[index].get("name")
        return name if isinstance(name, str) and name else f"materials[{index}]"

    def reason_to_leave(self, index, read=None):
        """Why a material is not converted, or an empty word. ``read`` has the extensions that the importer of the result reads."""
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
        for slot in _SLOTS:
            if slot.holder in extensions or slot.holder in ("", _PBR):
                self._read_slot(slot, self._holder(material, slot.holder), sources, lost)
        for name, (extension, word) in _FACTORS.items():
            if extension in extensions:
                sources[name] = self._factor(self._holder(material, extension), word, sources[name], extension)
        strength = _number(self._holder(material, _STRENGTH), "emissiveStrength", 1, _STRENGTH)
        mode = material.get("alphaMode", "OPAQUE")
        if mode not in _ALPHA_MODES:
            _fail("alphaMode", f"{mode} is not a mode")
        sources.update(emissive_strength=(strength,), alpha_mode=(float(_ALPHA_MODES.index(mode)),),
                       alpha_cutoff=(_number(material, "alphaCutoff", 0.5, "material"),))
        if mode == "OPAQUE":
            sources["alpha"] = (1.0,)
        lost += [f"{name}: is not known" for name in sorted(extensions) if name not in EXTENSIONS]
        return Surface(MODEL, sources, self._normals(material), lost)

    @staticmethod
    def _holder(material, name):
        if name in ("", _PBR):
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
        texture = self._item("textures", _index(info, "index", place), place)
        file, path = self._image(texture, place)
        sampler = self._item("samplers", _index(texture, "sampler", place), place) if "sampler" in texture else {}
        wrap = tuple(_WRAP.get(sampler.get(f"wrap{axis}", 10497)) or _fail(place, f"wrap{axis} is not a mode") for axis in "ST")
        count = 3 if channels == "rgb" else 1
        return Texture(file, path, channels, "sRGB" if is_srgb and channels == "rgb" else "raw", (1.0,) * count, (0.0,) * count, wrap,
                       self._place(info, place))

    @staticmethod
    def _place(info, place):
        transform = _object(_object(info, "extensions", place), _TRANSFORM, place)
        index = _index(transform, "texCoord", place, _index(info, "texCoord", place, 0))
        primvar = f"st{index}" if index else "st"
        offset, scale = (_numbers(transform, word, plain, place) for word, plain in (("offset", (0.0, 0.0)), ("scale", (1.0, 1.0))))
        rotation = math.degrees(_number(transform, "rotation", 0, place))
        # The v of glTF grows downwards, that of the others upwards: v' = 1 - v.
        moved = turned(rotation, (0.0, -scale[1]))
        translation = (moved[0] + offset[0], moved[1] - offset[1] + 1)
        return Place(primvar, scale, rotation, tuple(round(number, 9) + 0.0 for number in translation))

    def _image(self, texture, place):
        """The file as this document names it, and its path."""
        source = _object(_object(texture, "extensions", place), "EXT_texture_webp", place).get("source", texture.get("source"))
        if source is None:
            _fail(place, "its texture has no PNG, JPEG or WebP image")
        index = _index({"source": source}, "source", place)
        image = self._item("images", index, place)
        uri = image.get("uri")
        if isinstance(uri, str) and not uri.startswith("data:"):
            path = self.beside(uri, place)
            if not os.path.isfile(path):
                _fail(place, f"{uri}: file not found")
            self.image_of_path[os.path.abspath(path)] = index
            return path, path
        data = self._decoded(uri, place) if isinstance(uri, str) else bytes(self._view(_index(image, "bufferView", place), place))
        ending = extension_of(data) or ("webp" if data[:4] == b"RIFF" and data[8:12] == b"WEBP" else "")
        if not ending:
            _fail(place, f"images[{index}] is not a PNG, JPEG or WebP image")
        name = image.get("name")
        words = re.sub(r"[^\w-]+", "_", name)[:60] if isinstance(name, str) and name else "image"
        path = os.path.join(self.folder, f"{words}_{index}.{ending}")
        if not os.path.exists(path):
            write_file(path, data)
        self.image_of_path[path] = index
        return path, path

    def beside(self, uri, place):
        """The path of a file that this document names, which must lie in its folder."""
        root = os.path.realpath(os.path.dirname(os.path.abspath(self.path)))
        name = unquote(uri)
        if re.match(r"[a-zA-Z][a-zA-Z0-9+.-]*:|/|\\", name) or "\0" in name:
            _fail(place, f"{uri}: is not a file beside the document")
        path = os.path.join(root, name)
        if os.path.commonpath([root, os.path.realpath(path)]) != root:
            _fail(place, f"{uri}: leads out of the folder of the document")
        self.files.add(os.path.realpath(path))
        return path

    @staticmethod
    def _decoded(uri, place):
        try:
            return base64.b64decode(uri.split(";base64,", 1)[1], validate=True)
        except (IndexError, binascii.Error):
            _fail(place, "its data URI is not base64")

    def _view(self, index, place):
        view = self._item("bufferViews", index, place)
        data = self.buffer(_index(view, "buffer", place), place)
        begin, count = _index(view, "byteOffset", place, 0), _index(view, "byteLength", place)
        return data[begin:begin + count] if begin + count <= len(data) else _fail(place, f"bufferViews[{index}] is out of its buffer")

    def buffer(self, index, place):
        buffer = self._item("buffers", index, place)
        if index not in self._buffers or "uri" in buffer:
            uri = buffer.get("uri")
            if not isinstance(uri, str):
                _fail(place, f"buffers[{index}] has no data")
            path = "" if uri.startswith("data:") else self.beside(uri, place)
            if path and not os.path.isfile(path):
                _fail(place, f"{uri}: file not found")
            self._buffers[index] = self._mapped(path) if path else memoryview(self._decoded(uri, place))
        return self._buffers[index]


# Writing


def _rounded(values):
    return [float(f"{float(value):.7g}") for value in np.ravel(values)]


def _near(values, others):
    return bool(np.allclose(values, others, atol=1e-6))


def _header(path):
    """The ending of an image by its content, and for PNG whether it is grey and whether it has opacity."""
    with open(path, "rb") as file:
        head = file.read(26)
    ending = extension_of(head)
    color = head[25] if ending == "png" and len(head) > 25 else 2
    return ending, color in (0, 4), ending == "png" and color != 2 and color != 0


class GltfWriter:
    """A new glTF or GLB file of materials, or a copy of one with other materials."""

    def __init__(self, output, allowed=frozenset({*EXTENSIONS, _TRANSFORM}), base=None):
        """``allowed`` has the extensions that the result may use, ``base`` is the :class:`GltfReader` whose other contents stay."""
        self._output, self._allowed, self._base = output, allowed, base
        self._is_binary = output.lower().endswith(".glb")
        self._parent = os.path.dirname(os.path.abspath(output))
        self._stem = os.path.splitext(os.path.basename(output))[0]
        self._pieces, self._length, self._files = [], 0, {}
        self._made = {}
        # A library of materials needs no scene, but programs that show the scene of a file do.
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{}]}
        if base:
            self.json = json.loads(json.dumps(base.json))
            self._copy_buffers(base)
            self._copy_images(base)
        self.json["asset"]["generator"] = f"texremap {__version__}"

    def _copy_buffers(self, base):
        if "EXT_meshopt_compression" in self.json.get("extensionsUsed", ()):
            raise Error(f"{base.path}: is compressed by EXT_meshopt_compression (decompress it first)", "input")
        places = [self._append(base.buffer(index, base.path)) for index in range(len(self.json.get("buffers", [])))]
        for view in self.json.get("bufferViews", []):
            index = _index(view, "buffer", f"{base.path}: bufferViews")
            if index >= len(places):
                _fail(base.path, f"buffers[{index}] does not exist")
            view.update(buffer=0, byteOffset=places[index] + _index(view, "byteOffset", f"{base.path}: bufferViews", 0))

    def _copy_images(self, base):
        for index, image in enumerate(self.json.get("images", [])):
            uri = image.get("uri")
            if isinstance(uri, str) and not uri.startswith("data:"):
                path = base.beside(uri, f"{base.path}: images[{index}]")
                if os.path.isfile(path):
                    image.clear()
                    image.update(self._image_of(path))

    def _append(self, data):
        """Adds bytes to the buffer. Returns where they begin."""
        padding = -self._length % 4
        self._pieces += [b"\0" * padding, data]
        begin = self._length + padding
        self._length = begin + len(data)
        return begin

    def _add(self, name, value):
        """Adds an object to a list of the document, once. Returns its index."""
        values = self.json.setdefault(name, [])
        if value not in values:
            values.append(value)
        return values.index(value)

    def _image_of(self, path=None, data=None, name=""):
        """The object of an image in a file, or of new bytes."""
        if self._is_binary:
            if data is None:
                with open(path, "rb") as file:
                    data = file.read()
            kind = "image/jpeg" if extension_of(data) == "jpg" else "image/png" if extension_of(data) else "image/webp"
            begin = self._append(data)
            self.json.setdefault("bufferViews", []).append({"buffer": 0, "byteOffset": begin, "byteLength": len(data)})
            return {"bufferView": len(self.json["bufferViews"]) - 1, "mimeType": kind, **({"name": name} if name else {})}
        if data is None and not self._is_extracted(path):
            return {"uri": quote(os.path.relpath(path, self._parent).replace(os.sep, "/"))}
        file = os.path.join(f"{self._stem}_textures", name + ".png" if data is not None else os.path.basename(path))
        if data is None:
            with open(path, "rb") as source:
                data = source.read()
        self._files[os.path.join(self._parent, file)] = data
        return {"uri": quote(file.replace(os.sep, "/"))}

    def _is_extracted(self, path):
        return self._base is not None and path.startswith(self._base.folder + os.sep)

    def _image(self, key, **given):
        if key not in self._made:
            known = self._base.image_of_path.get(key) if self._base else None
            self.json.setdefault("images", [])
            if known is None:
                image = self._image_of(**given)
                self.json["images"].append(image)
                known = len(self.json["images"]) - 1
            self._made[key] = known
        return self._made[key]

    def add(self, name, edit, normals, index):
        """Adds a material, or replaces one of the base. Returns names of new textures, and inputs that are lost."""
        self._material, self._extensions = {"name": name}, {}
        self._textures, self._losses, self._name = [], [], re.sub(r"[^\w-]+", "_", name)
        for one in (*_FACTORS, "emissive_strength", "alpha_mode", "alpha_cutoff"):
            if edit.settle(one, largest=one == "alpha_mode"):
                self._lost(f"{one}: has no texture in glTF, and becomes its mean")
        old = self.json["materials"][index] if self._base else {}
        self._material.update({key: old[key] for key in ("extras", "doubleSided") if key in old})
        self._is_opaque = edit.values["alpha_mode"][0] == 0
        for slot in _SLOTS:
            if self._is_shown(slot.holder, edit):
                self._write_slot(slot, edit)
        for one, (extension, word) in _FACTORS.items():
            default = materials.MODELS[MODEL][one]
            if self._is_shown(extension, edit) and not _near(edit.values[one], default):
                self._put(extension, word, _rounded(edit.values[one]))
        self._write_alpha(edit)
        for one, (holder, key) in {"normal": ("", "normalTexture"), "coat_normal": ("KHR_materials_clearcoat", "clearcoatNormalTexture")}.items():
            if one in normals and self._is_shown(holder, edit):
                self._write_normal(holder, key, normals[one], one)
        if "KHR_materials_dispersion" in self._extensions and "KHR_materials_volume" not in self._extensions:
            del self._extensions["KHR_materials_dispersion"]
            self._lost("dispersion: needs a thickness")
        if self._extensions:
            self._material["extensions"] = self._extensions
        if self._base:
            self.json["materials"][index] = self._material
        else:
            self.json.setdefault("materials", []).append(self._material)
        return tuple(self._textures), tuple(self._losses)

    def _lost(self, words):
        self._losses.append(words)

    def _is_shown(self, holder, edit):
        """Whether a part of a material shows, and may be written."""
        if holder in ("", _PBR):
            return True
        needed = _NEEDED.get(holder)
        if needed is None:
            return holder in self._allowed
        return holder in self._allowed and (needed not in edit.values or bool(np.any(edit.values[needed])))

    def _put(self, holder, word, value):
        if isinstance(value, list) and len(value) == 1:
            value = value[0]
        members = self._material if not holder else self._extensions.setdefault(holder, {}) if holder != _PBR else \
            self._material.setdefault(_PBR, {})
        members[word] = value

    def _write_slot(self, slot, edit):
        textured = [name for name in slot.inputs if name not in edit.values]
        factors = {name: edit.values[name] for name in slot.inputs if name in edit.values}
        info, biases = None, {}
        if textured:
            info, biases = self._connected(slot, edit, textured, factors) or self._packed(slot, edit, textured, factors)
            self._put(slot.holder, f"{slot.name}Texture", info)
        if slot.name == "baseColor":
            four = [*factors["base_color"], *(factors["alpha"] if not self._is_opaque else (1.0,))]
            if not _near(four, 1):
                self._put(_PBR, "baseColorFactor", _rounded(np.clip(four, 0, 1)))
        elif slot.name == "emissive":
            self._write_emission(np.array(factors["emissive"], float) * edit.values["emissive_strength"][0])
        elif slot.name == "occlusion":
            if info and not _near(factors["occlusion"], 1):
                info["strength"] = _rounded(factors["occlusion"])[0]
        elif slot.name == "iridescenceThickness":
            low = biases.get("iridescence_thickness", (0.0,))[0]
            if info:
                self._put(slot.holder, "iridescenceThicknessMinimum", _rounded(low))
            self._put(slot.holder, "iridescenceThicknessMaximum", _rounded(low + factors["iridescence_thickness"][0]))
        else:
            for name, (_, word) in slot.inputs.items():
                default = 0.0 if slot.holder in _NEEDED else 1.0  # of glTF
                if not _near(factors[name], default):
                    most = np.inf if name in _UNBOUNDED else 1
                    self._put(slot.holder, word, _rounded(np.clip(factors[name], 0, most)))

    def _write_emission(self, light):
        top = float(light.max())
        if top > 1 and _STRENGTH in self._allowed:
            self._put(_STRENGTH, "emissiveStrength", _rounded(top))
        elif top > 1:
            self._lost("emissive: is brighter than 1")
        if top > 0:
            self._put("", "emissiveFactor", _rounded(np.clip(light / max(top, 1), 0, 1)))

    def _write_alpha(self, edit):
        mode = _ALPHA_MODES[int(edit.values["alpha_mode"][0])]
        if mode != "OPAQUE":
            self._put("", "alphaMode", mode)
        if mode == "MASK" and not _near(edit.values["alpha_cutoff"], 0.5):
            self._put("", "alphaCutoff", _rounded(edit.values["alpha_cutoff"]))

    def _connected(self, slot, edit, textured, factors):
        """A texture as it lies in a file, and its biases; or None if a new one has to be packed. Adds to ``factors``."""
        textures = {name: edit.textures[name] for name in textured if name not in edit.baked}
        first = next(iter(textures.values()), None)
        if len(textures) < len(textured) or any((t.path, t.wrap, t.place) != (first.path, first.wrap, first.place) for t in textures.values()):
            return None
        if TILE in first.path:
            raise Error(f"{textured[0]}: glTF has no tiles ({TILE})", "input")
        ending, is_grey, has_alpha = _header(first.path)
        if not ending:
            return None
        for name, value in factors.items():
            is_free = name == "alpha" and (self._is_opaque or not has_alpha)
            if not is_free and not _near(value, 0):
                return None
        biases = {}
        for name, texture in textures.items():
            channels, word = slot.inputs[name]
            is_same = texture.channels == channels or (is_grey and {texture.channels, channels} <= {"r", "g", "b"})
            is_space = texture.channels == "a" or texture.space == ("sRGB" if slot.is_srgb and channels == "rgb" else "raw")
            bias = {"occlusion": 1 - texture.scale[0], "iridescence_thickness": texture.bias[0]}.get(name, 0.0)
            most = np.inf if name in _UNBOUNDED or not word else 1
            if not (is_same and is_space and _near(texture.bias, bias) and min(texture.scale) >= 0 and max(texture.scale) <= most + 1e-6):
                return None
            factors[name], biases[name] = texture.scale, texture.bias
        return self._info(self._image(os.path.abspath(first.path), path=first.path), first.wrap, first.place, slot.name), biases

    def _packed(self, slot, edit, textured, factors):
        """A new texture for a slot, and its biases. Adds to ``factors``."""
        arrays, places, deep, wrap, biases = {}, set(), False, (None, None), {}
        for name in textured:
            if name in edit.baked:
                tiles, (wrap, place) = edit.baked[name], edit.wrap_and_place()
                if "" not in tiles:
                    raise Error(f"{name}: glTF has no tiles ({TILE})", "input")
                arrays[name], more = tiles[""]
            else:
                texture = edit.textures[name]
                arrays[name], more = read(texture, "")
                wrap, place = texture.wrap, texture.place
            places.add(place)
            deep = deep or more
        if len(places) > 1:
            raise Error(f"{' and '.join(textured)}: lie on different coordinates", "input")
        height, width = (max(values.shape[axis] for values in arrays.values()) for axis in (0, 1))
        four = np.ones((height, width, 4), np.float32)
        for name, values in arrays.items():
            channels, word = slot.inputs[name]
            count, low, high = values.shape[-1], 0.0, float(values.max())
            if name == "iridescence_thickness":
                low = float(values.min())
            scale = max(high - low, 1.0) if name in _UNBOUNDED or not word else 1.0
            factors[name], biases[name] = (scale,) * count, (low,) * count
            if name == "occlusion":
                scale = factors[name] = (1.0,)
            place_of = slice(0, 3) if channels == "rgb" else slice("rgba".index(channels), "rgba".index(channels) + 1)
            four[..., place_of] = (resized(np.ascontiguousarray(values, np.float32), height, width) - low) / np.float32(np.max(scale))
        has_alpha = any(slot.inputs[name][0] == "a" for name in textured)
        file = f"{self._name}_{slot.name}"
        data = png_of(four if has_alpha else four[..., :3], slot.is_srgb, deep)
        self._textures.append(file + ".png")
        return self._info(self._image((file, data), data=data, name=file), wrap, places.pop(), slot.name), biases

    def _write_normal(self, holder, key, texture, name):
        if TILE in texture.path:
            raise Error(f"{name}: glTF has no tiles ({TILE})", "input")
        strength = texture.scale[0] / 2
        is_plain = (_near(texture.scale, (2 * strength, 2 * strength, 2)) and _near(texture.bias, (-strength, -strength, -1)) and
                    texture.space != "sRGB" and texture.channels == "rgb" and _header(texture.path)[0])
        if is_plain:
            image = self._image(os.path.abspath(texture.path), path=texture.path)
        else:
            values, deep = read(texture._replace(space="raw"), "")
            data, file, strength = png_of((values + 1) / 2, False, deep), f"{self._name}_{key.removesuffix('Texture')}", 1
            self._textures.append(file + ".png")
            image = self._image((file, data), data=data, name=file)
        info = self._info(image, texture.wrap, texture.place, name)
        if not _near(strength, 1):
            info["scale"] = _rounded(strength)[0]
        self._put(holder, key, info)

    def _info(self, image, wrap, place, name):
        """The object that names a texture in a material."""
        if "black" in wrap:
            self._lost(f"{name}: black around its texture")
        codes = {f"wrap{axis}": _CODE_OF_WRAP.get("clamp" if mode == "black" else mode, 10497) for axis, mode in zip("ST", wrap)}
        texture = {"source": image}
        if set(codes.values()) != {10497}:
            texture["sampler"] = self._add("samplers", codes)
        with_webp = self.json["images"][image].get("mimeType") == "image/webp" or \
            str(self.json["images"][image].get("uri", "")).lower().endswith(".webp")
        if with_webp:
            texture["extensions"] = {"EXT_texture_webp": {"source": texture.pop("source")}}
        info = {"index": self._add("textures", texture)}
        number = re.search(r"(\d+)$", place.primvar)
        if number and int(number[1]) > 0:
            info["texCoord"] = int(number[1])
        if place != Place(place.primvar):
            if _TRANSFORM not in self._allowed:
                self._lost(f"{name}: the transform of its texture")
                return info
            moved = turned(place.rotation, (0.0, -place.scale[1]))
            offset = (place.translation[0] - moved[0], moved[1] + 1 - place.translation[1])
            info["extensions"] = {_TRANSFORM: {"offset": _rounded(offset), "rotation": _rounded(math.radians(place.rotation))[0],
                                               "scale": _rounded(place.scale)}}
        return info

    def _finish(self):
        """The extensions that are used, and the buffer."""
        used, rest = set(), [self.json]
        while rest:
            value = rest.pop()
            if isinstance(value, dict):
                found = value.get("extensions")
                used.update(found if isinstance(found, dict) else ())
                rest += value.values()
            elif isinstance(value, list):
                rest += value
        for word in ("extensionsUsed", "extensionsRequired"):
            kept = [name for name in self.json.pop(word, []) if name in used or name not in (*EXTENSIONS, _TRANSFORM)]
            if word == "extensionsUsed":
                kept += sorted(used - set(kept))
            if word == "extensionsRequired" and "EXT_texture_webp" in used and "EXT_texture_webp" not in kept:
                kept.append("EXT_texture_webp")
            if kept:
                self.json[word] = kept
        self.json.pop("buffers", None)
        if self._length:
            self.json["buffers"] = [{"byteLength": self._length}]
            if not self._is_binary:
                self.json["buffers"][0]["uri"] = quote(f"{self._stem}.bin")

    def save(self, force):
        """Writes the document, after all files that it names."""
        self._finish()
        if self._length and not self._is_binary:
            self._files[os.path.join(self._parent, f"{self._stem}.bin")] = b"".join(self._pieces)
        for path in self._files:
            if self._base and os.path.realpath(path) in self._base.files:
                raise Error(f"{path}: is read by {self._base.path} (choose another name for the result)", "output")
            if os.path.exists(path) and not force:
                raise Error(f"{path}: exists (use --force to replace it)", "output")
        folder = os.path.join(self._parent, f"{self._stem}_textures")
        os.makedirs(folder if any(path.startswith(folder + os.sep) for path in self._files) else self._parent, exist_ok=True)
        for path, data in self._files.items():
            write_file(path, data)
        text = json.dumps(self.json, ensure_ascii=False, allow_nan=False, indent=None if self._is_binary else 1).encode("utf-8")
        with replacing(os.path.abspath(self._output)) as unfinished, open(unfinished, "wb") as file:
            if not self._is_binary:
                file.write(text + b"\n")
                return
            text += b" " * (-len(text) % 4)
            padding = b"\0" * (-self._length % 4)
            binary = 8 + self._length + len(padding) if self._length else 0
            if 20 + len(text) + binary >= 1 << 32:
                raise Error(f"{self._output}: is larger than 4 GB (write a .gltf file)", "output")
            file.write(struct.pack("<5I", 0x46546C67, 2, 20 + len(text) + binary, len(text), _JSON_CHUNK) + text)
            if binary:
                file.write(struct.pack("<2I", self._length + len(padding), _BINARY_CHUNK))
                for piece in (*self._pieces, padding):
                    file.write(piece)
