"""Reads materials from files: MTL, glTF, USD and FBX."""
import base64
import io
import json
import re
import struct
import urllib.parse

import numpy as np
from PIL import Image

from offers.spheres import TEXELS, Source, Target, linear

POINTS = np.random.default_rng(43).random((TEXELS, 2))


def image_array(image):
    values = np.asarray(image.convert("RGBA" if image.mode in ("P", "LA", "RGBA") else "RGB"), float) / 255
    return values[..., :3]


def looked_up(image, points):
    height, width = image.shape[:2]
    return image[(points[:, 1] * height).astype(int), (points[:, 0] * width).astype(int)]


def mtl_materials(path):
    materials, current = {}, None
    for line in path.read_text(errors="replace").splitlines():
        words = line.split(None, 1)
        if len(words) < 2:
            continue
        key, rest = words[0].lower(), words[1].strip()
        if key == "newmtl":
            current = materials.setdefault(rest, {"folder": path.parent})
        elif current is not None and key in ("kd", "ks"):
            current[key] = np.array([float(word) for word in rest.split()[:3]])
        elif current is not None and key == "ns":
            current[key] = float(rest)
        elif current is not None and key in ("map_kd", "map_ks", "map_ns"):
            current[key] = image_array(Image.open(path.parent / rest))
    return materials


def mtl_source(material, points, kd_times_map=True, decode=False):
    """Returns Blinn as the MTL means it. Below exponent 1 there is no highlight: programs that do not know the
    exponent write 0."""
    n = material.get("ns", 0.0)
    kd, ks = material.get("kd", np.full(3, 0.8)), material.get("ks", np.zeros(3)) * (n >= 1)
    kd, ks = (linear(kd), linear(ks)) if decode else (kd, ks)
    if "map_kd" in material:
        kd = (kd if kd_times_map else 1.0) * linear(looked_up(material["map_kd"], points))
    if "map_ks" in material:
        ks = ks * linear(looked_up(material["map_ks"], points))
    if "map_ns" in material:
        n = (n * looked_up(material["map_ns"], points)[:, 0])
    return Source(n, kd, ks)


def gltf_parts(path):
    """Returns the JSON of a .gltf or .glb, and a function that returns its images."""
    data, binary = path.read_bytes(), b""
    if data[:4] == b"glTF":
        length = int.from_bytes(data[12:16], "little")
        text, binary = data[20:20 + length], data[20 + length + 8:]
    else:
        text = data
    gltf = json.loads(text)

    def bytes_of(uri):
        return base64.b64decode(uri.split(",", 1)[1]) if uri.startswith("data:") else (path.parent / urllib.parse.unquote(uri)).read_bytes()

    def image(texture):
        found = gltf["images"][gltf["textures"][texture["index"]]["source"]]
        if "uri" in found:
            return image_array(Image.open(io.BytesIO(bytes_of(found["uri"]))))
        view = gltf["bufferViews"][found["bufferView"]]
        buffer = gltf["buffers"][view["buffer"]]
        whole = bytes_of(buffer["uri"]) if "uri" in buffer else binary
        start = view.get("byteOffset", 0)
        return image_array(Image.open(io.BytesIO(whole[start:start + view["byteLength"]])))

    return gltf, image


def gltf_target(material, image, points, extension=True):
    pbr = material.get("pbrMetallicRoughness", {})
    base = np.array(pbr.get("baseColorFactor", [1, 1, 1, 1])[:3], float)
    roughness, metallic = float(pbr.get("roughnessFactor", 1.0)), float(pbr.get("metallicFactor", 1.0))
    if "baseColorTexture" in pbr:
        base = base * linear(looked_up(image(pbr["baseColorTexture"]), points))
    if "metallicRoughnessTexture" in pbr:
        packed = looked_up(image(pbr["metallicRoughnessTexture"]), points)
        roughness, metallic = roughness * packed[:, 1], metallic * packed[:, 2]
    f0, f90 = np.full(3, 0.04), np.ones(3)
    specular = material.get("extensions", {}).get("KHR_materials_specular")
    if specular is not None and extension:
        factor, color = specular.get("specularFactor", 1.0), np.array(specular.get("specularColorFactor", [1, 1, 1]), float)
        if "specularColorTexture" in specular:
            color = color * linear(looked_up(image(specular["specularColorTexture"]), points))
        f0, f90 = np.minimum(0.04 * color, 1) * factor, np.full(3, factor)
    return Target(base, roughness, f0, f90, metallic)


def usd_target(inputs):
    base = np.array(inputs["diffuseColor"], float)
    if inputs.get("useSpecularWorkflow", 0):
        return Target(base, inputs.get("roughness", 0.5), np.array(inputs["specularColor"]), 1.0, 0.0)
    ior = inputs.get("ior", 1.5)
    return Target(base, inputs.get("roughness", 0.5), np.full(3, ((ior - 1) / (ior + 1)) ** 2), 1.0, inputs.get("metallic", 0.0))


def fbx_material(path):
    """Returns (n, Kd, Ks) of the last material of a binary FBX file. Earlier ones are templates."""
    data, found = path.read_bytes(), {}
    for match in re.finditer(rb"S....(DiffuseColor|DiffuseFactor|SpecularColor|SpecularFactor|ShininessExponent)S", data, re.DOTALL):
        position, numbers = match.end() - 1, []
        while data[position:position + 1] in (b"S", b"D"):
            if data[position:position + 1] == b"S":
                position += 5 + int.from_bytes(data[position + 1:position + 5], "little")
            else:
                numbers.append(struct.unpack("<d", data[position + 1:position + 9])[0])
                position += 9
        found[match[1].decode()] = np.array(numbers)
    return (float(found["ShininessExponent"][0]), found["DiffuseColor"] * found["DiffuseFactor"],
            found["SpecularColor"] * found["SpecularFactor"])
