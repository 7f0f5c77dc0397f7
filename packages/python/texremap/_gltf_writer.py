"""A writer of glTF files of materials, or of copies of glTF files with other materials."""

import json
import math
import os
import re
import struct
from urllib.parse import quote

import numpy as np

from . import materials
from ._core import __version__
from ._error import Error
from ._files import replacing
from ._gltf import (ALPHA_MODES, BINARY_CHUNK, EXTENSIONS, FACTORS, JSON_CHUNK, MODEL, NEEDED, PBR, SLOTS, STRENGTH, TRANSFORM, WRAP,
                    extension_of, fail, index_of)
from ._networks import turned
from ._textures import TILE, Place, png_of, read, resized, write_file

_CODE_OF_WRAP = {word: code for code, word in WRAP.items()}
_UNBOUNDED = {"specular_color", "thickness", "emissive"}  # inputs that may be above 1


def _rounded(values):
    return [float(f"{float(value):.7g}") for value in np.ravel(values)]


def _near(values, others):
    return bool(np.allclose(values, others, atol=1e-6))


def _header(path):
    """Returns the extension of an image by its content, and for PNG whether it is grey and whether it has
    opacity."""
    with open(path, "rb") as file:
        head = file.read(26)
    ending = extension_of(head)
    color = head[25] if ending == "png" and len(head) > 25 else 2
    return ending, color in (0, 4), ending == "png" and color != 2 and color != 0


class GltfWriter:
    """A new glTF or GLB file of materials, or a copy of one with other materials."""

    def __init__(self, output, allowed=frozenset({*EXTENSIONS, TRANSFORM}), base=None):
        """Begins a document. ``allowed`` has the extensions that the result may use.

        If ``base`` is given, the other contents of this :class:`GltfReader` are kept.
        """
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
            index = index_of(view, "buffer", f"{base.path}: bufferViews")
            if index >= len(places):
                fail(base.path, f"buffers[{index}] does not exist")
            view.update(buffer=0, byteOffset=places[index] + index_of(view, "byteOffset", f"{base.path}: bufferViews", 0))

    def _copy_images(self, base):
        for index, image in enumerate(self.json.get("images", [])):
            uri = image.get("uri")
            if isinstance(uri, str) and not uri.startswith("data:"):
                path = base.beside(uri, f"{base.path}: images[{index}]")
                if os.path.isfile(path):
                    name = {"name": image["name"]} if "name" in image else {}
                    image.clear()
                    image.update({**name, **self._image_of(path)})

    def _append(self, data):
        """Adds bytes to the buffer. Returns where they begin."""
        padding = -self._length % 4
        self._pieces += [b"\0" * padding, data]
        begin = self._length + padding
        self._length = begin + len(data)
        return begin

    def _add(self, name, value):
        """Adds an object to a list of the document, unless an equal object is in it. Returns its index."""
        values = self.json.setdefault(name, [])
        if value not in values:
            values.append(value)
        return values.index(value)

    def _image_of(self, path=None, data=None, name=""):
        """Returns the image object for the file ``path``, or for the new image ``data``."""
        if self._is_binary:
            if data is None:
                with open(path, "rb") as file:
                    data = file.read()
            kind = "image/jpeg" if extension_of(data) == "jpg" else "image/png" if extension_of(data) else "image/webp"
            begin = self._append(data)
            self.json.setdefault("bufferViews", []).append({"buffer": 0, "byteOffset": begin, "byteLength": len(data)})
            return {"bufferView": len(self.json["bufferViews"]) - 1, "mimeType": kind, **({"name": name} if name else {})}
        if data is None and not self._is_extracted(path):
            relative = os.path.relpath(os.path.realpath(os.path.dirname(path)), os.path.realpath(self._parent))
            # Many programs do not read files outside of the folder of a document, so such files are copied.
            if relative.split(os.sep)[0] != "..":
                file = os.path.normpath(os.path.join(relative, os.path.basename(path)))
                return {"uri": quote(file.replace(os.sep, "/"))}
        stem, ending = os.path.splitext(name + ".png" if data is not None else os.path.basename(path))
        taken, file, number = {os.path.basename(known).lower() for known in self._files}, stem + ending, 1
        while file.lower() in taken:
            number += 1
            file = f"{stem}_{number}{ending}"
        if data is None:
            with open(path, "rb") as source:
                data = source.read()
        self._files[os.path.join(self._parent, f"{self._stem}_textures", file)] = data
        return {"uri": quote(f"{self._stem}_textures/{file}")}

    def _is_extracted(self, path):
        return self._base is not None and path.startswith(self._base.folder + os.sep)

    def _image(self, key, **given):
        """Returns the index of the image with this key. Adds the image at the first call."""
        if key not in self._made and self._base and key in self._base.image_of_path:
            self._made[key] = self._base.image_of_path[key]
        elif key not in self._made:
            self.json.setdefault("images", []).append(self._image_of(**given))
            self._made[key] = len(self.json["images"]) - 1
        return self._made[key]

    def add(self, name, edit, normals, index):
        """Adds a material, or replaces one of the base. Returns the names of new textures, and the inputs
        that are lost."""
        self._material, self._extensions = {"name": name}, {}
        self._textures, self._losses, self._name = [], [], re.sub(r"[^\w-]+", "_", name)[:80]
        for one in (*FACTORS, "emissive_strength", "alpha_mode", "alpha_cutoff"):
            if edit.settle(one, largest=one == "alpha_mode"):
                self._lost(f"{one}: has no texture in glTF, and becomes a constant")
        old = self.json["materials"][index] if self._base else {}
        if old:
            self._material = {key: old[key] for key in ("name", "extras", "doubleSided") if key in old}
        self._is_opaque = edit.values["alpha_mode"][0] == 0
        for slot in SLOTS:
            if self._is_shown(slot.holder, edit):
                self._write_slot(slot, edit)
        for one, (extension, word) in FACTORS.items():
            default = materials.MODELS[MODEL][one]
            if self._is_shown(extension, edit) and not _near(edit.values[one], default):
                self._put(extension, word, _rounded(edit.values[one]))
        self._write_alpha(edit)
        for one, holder, key in (("normal", "", "normalTexture"),
                                 ("coat_normal", "KHR_materials_clearcoat", "clearcoatNormalTexture")):
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
        """Returns whether a part of a material may be written and has a visible effect."""
        if holder in ("", PBR):
            return True
        needed = NEEDED.get(holder)
        if needed is None:
            return holder in self._allowed
        return holder in self._allowed and (needed not in edit.values or bool(np.any(edit.values[needed])))

    def _put(self, holder, word, value):
        if isinstance(value, list) and len(value) == 1:
            value = value[0]
        members = self._material if not holder else self._extensions.setdefault(holder, {}) if holder != PBR else \
            self._material.setdefault(PBR, {})
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
                self._put(PBR, "baseColorFactor", _rounded(np.clip(four, 0, 1)))
        elif slot.name == "emissive":
            self._write_emission(np.array(factors["emissive"], float) * edit.values["emissive_strength"][0])
        elif slot.name == "occlusion":
            if info and not _near(factors["occlusion"], 1):
                info["strength"] = _rounded(factors["occlusion"])[0]
            elif not info and not _near(factors["occlusion"], 1):
                self._lost("occlusion: has no factor in glTF")
        elif slot.name == "iridescenceThickness":
            low = biases.get("iridescence_thickness", (0.0,))[0]
            if info:
                self._put(slot.holder, "iridescenceThicknessMinimum", _rounded(low))
            self._put(slot.holder, "iridescenceThicknessMaximum", _rounded(low + factors["iridescence_thickness"][0]))
        else:
            for name, (_, word) in slot.inputs.items():
                default = 0.0 if slot.holder in NEEDED else 1.0  # of glTF
                if not _near(factors[name], default):
                    most = np.inf if name in _UNBOUNDED else 1
                    self._put(slot.holder, word, _rounded(np.clip(factors[name], 0, most)))

    def _write_emission(self, light):
        top = float(light.max())
        if top > 1 and STRENGTH in self._allowed:
            self._put(STRENGTH, "emissiveStrength", _rounded(top))
        elif top > 1:
            self._lost("emissive: is brighter than 1")
        if top > 0:
            self._put("", "emissiveFactor", _rounded(np.clip(light / max(top, 1), 0, 1)))

    def _write_alpha(self, edit):
        mode = ALPHA_MODES[int(edit.values["alpha_mode"][0])]
        if mode != "OPAQUE":
            self._put("", "alphaMode", mode)
        if mode == "MASK" and not _near(edit.values["alpha_cutoff"], 0.5):
            self._put("", "alphaCutoff", _rounded(edit.values["alpha_cutoff"]))

    def _connected(self, slot, edit, textured, factors):
        """Returns the texture info for an existing file and its biases, or None if a new texture must be
        packed. Adds to ``factors``."""
        textures = {name: edit.textures[name] for name in textured if name not in edit.baked}
        first = next(iter(textures.values()), None)
        if len(textures) < len(textured) or len({(t.path, t.wrap, t.place) for t in textures.values()}) > 1:
            return None
        if TILE in first.path:
            raise Error(f"{textured[0]}: glTF has no tiles ({TILE}; join the tiles to one image)", "input")
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
        """Packs a new texture for a slot. Returns its texture info and its biases. Adds to ``factors``."""
        arrays, places, deep, wrap, biases = {}, set(), False, (None, None), {}
        for name in textured:
            if name in edit.baked:
                tiles, (wrap, place) = edit.baked[name], edit.wrap_and_place()
                if "" not in tiles:
                    raise Error(f"{name}: glTF has no tiles ({TILE}; join the tiles to one image)", "input")
                arrays[name], more = tiles[""]
            else:
                texture = edit.textures[name]
                arrays[name], more = read(texture, "")
                wrap, place = texture.wrap, texture.place
            places.add(place)
            deep = deep or more
        if len(places) > 1:
            raise Error(f"{' and '.join(textured)}: use different texture coordinates (give all of them one set of UVs)", "input")
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
        return self._info(self._image(data, data=data, name=file), wrap, places.pop(), slot.name), biases

    def _write_normal(self, holder, key, texture, name):
        if TILE in texture.path:
            raise Error(f"{name}: glTF has no tiles ({TILE}; join the tiles to one image)", "input")
        strength = texture.scale[0] / 2
        is_plain = (_near(texture.scale, (2 * strength, 2 * strength, 2)) and _near(texture.bias, (-strength, -strength, -1)) and
                    texture.space != "sRGB" and texture.channels == "rgb" and _header(texture.path)[0])
        if is_plain:
            image = self._image(os.path.abspath(texture.path), path=texture.path)
        else:
            values, deep = read(texture._replace(space="raw"), "")
            data, file, strength = png_of((values + 1) / 2, False, deep), f"{self._name}_{key.removesuffix('Texture')}", 1
            self._textures.append(file + ".png")
            image = self._image(data, data=data, name=file)
        info = self._info(image, texture.wrap, texture.place, name)
        if not _near(strength, 1):
            info["scale"] = _rounded(strength)[0]
        self._put(holder, key, info)

    def _info(self, image, wrap, place, name):
        """Returns the texture info by which a material refers to an image."""
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
            if TRANSFORM not in self._allowed:
                self._lost(f"{name}: the transform of its texture")
                return info
            moved = turned(place.rotation, (0.0, -place.scale[1]))
            offset = (place.translation[0] - moved[0], moved[1] + 1 - place.translation[1])
            info["extensions"] = {TRANSFORM: {"offset": _rounded(offset), "rotation": _rounded(math.radians(place.rotation))[0],
                                               "scale": _rounded(place.scale)}}
        return info

    def _finish(self):
        """Lists the extensions that are used, and describes the buffer."""
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
            kept = [name for name in self.json.pop(word, []) if name in used or name not in (*EXTENSIONS, TRANSFORM)]
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
        """Writes the document, after all files that it refers to."""
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
            file.write(struct.pack("<5I", 0x46546C67, 2, 20 + len(text) + binary, len(text), JSON_CHUNK) + text)
            if binary:
                file.write(struct.pack("<2I", self._length + len(padding), BINARY_CHUNK))
                for piece in (*self._pieces, padding):
                    file.write(piece)
