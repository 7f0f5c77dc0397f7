"""Shading networks of USD: UsdPreviewSurface with UsdUVTexture, and OpenPBR with nodes of MaterialX."""

import os

import numpy as np
from pxr import Gf, Sdf, UsdShade

from ._error import Error
from ._networks import MaterialXNodes, Node, texture_of
from ._textures import TILE, Place

OPEN_PBR_ID = "ND_open_pbr_surface_surfaceshader"
_TYPES = Sdf.ValueTypeNames
_TYPE_NAMES = {"float": _TYPES.Float, "vector2": _TYPES.Float2, "vector3": _TYPES.Float3, "vector4": _TYPES.Float4,
               "color3": _TYPES.Color3f, "integer": _TYPES.Int, "string": _TYPES.String}


def value_of(attribute):
    """Returns the value of an attribute as a tuple of floats, or None."""
    if attribute.GetNumTimeSamples() > 1:
        raise Error(f"{attribute.GetName()} changes over time", "input")
    value = attribute.Get()
    return None if value is None else tuple(float(number) for number in np.ravel(value))


def _producer(shader, name):
    """Returns the attribute that gives an input its value. It belongs to the input, to a node graph or
    material around it, or to the output of a node."""
    given = shader.GetInput(name)
    if not given:
        return None
    attributes = UsdShade.Utils.GetValueProducingAttributes(given)
    return attributes[0] if attributes else given.GetAttr()


class _ShaderNode(Node):
    """A shader of a stage."""

    def __init__(self, prim):
        self.shader, self.name = UsdShade.Shader(prim), prim.GetPath()
        identity = (self.shader.GetIdAttr().Get() or "") if self.shader else ""
        words = identity.removeprefix("ND_").split("_")
        count = 2 if words[0] == "gltf" else 1
        self.kind, self.type = "_".join(words[:count]), words[count] if len(words) > count else ""

    def link(self, name):
        attribute = _producer(self.shader, name)
        return _linked(attribute) if attribute and UsdShade.Output.IsOutput(attribute) else None

    def numbers(self, name, otherwise=None):
        attribute = _producer(self.shader, name)
        value = value_of(attribute) if attribute else None
        return otherwise if value is None else value

    def word(self, name, otherwise=None):
        attribute = _producer(self.shader, name)
        value = attribute.Get() if attribute else None
        return otherwise if value is None else str(value)

    def file(self, of):
        attribute = _producer(self.shader, "file")
        asset = attribute.Get() if attribute else None
        if asset is None or not asset.path:
            raise Error(f"{of}: its texture {self.name} has no file", "input")
        path = asset.resolvedPath or asset.path
        if TILE in asset.path and not asset.resolvedPath:
            path = os.path.join(os.path.dirname(attribute.GetPropertyStack()[0].layer.realPath), asset.path)
        space = attribute.GetColorSpace() or "auto"
        return asset.path, path, "sRGB" if "srgb" in space.lower() else "auto" if space == "auto" else "raw"


def _linked(attribute):
    return _ShaderNode(attribute.GetPrim()), attribute.GetBaseName()


def source_of(shader, name, default):
    """Returns the value of an input as a tuple, or its :class:`Texture`. Raises :class:`Procedural` for other
    connections."""
    attribute = _producer(shader, name)
    if attribute is None:
        return default
    if UsdShade.Output.IsOutput(attribute):
        return texture_of(*_linked(attribute), name)
    value = value_of(attribute)
    return default if value is None else value


class _Nodes:
    """Makes nodes below a material. For each key, it makes only one node."""

    def __init__(self, stage, material):
        self.stage, self.material, self.made = stage, material, {}
        self.layer = os.path.dirname(stage.GetEditTarget().GetLayer().realPath)

    def shader(self, key, name, identity):
        """Returns the shader for this key, and whether it is new."""
        if key in self.made:
            return self.made[key], False
        path, number = self.material.GetPath().AppendChild(name), 1
        while self.stage.GetPrimAtPath(path):
            number += 1
            path = self.material.GetPath().AppendChild(f"{name}_{number}")
        shader = UsdShade.Shader.Define(self.stage, path)
        shader.CreateIdAttr(identity)
        self.made[key] = shader
        return shader, True

    def asset(self, texture):
        """Returns the path of the file relative to the new layer."""
        file = texture.file if not os.path.isabs(texture.path) else os.path.relpath(texture.path, self.layer).replace(os.sep, "/")
        return Sdf.AssetPath(file if file.startswith(("../", "/")) or ":" in file else "./" + file.removeprefix("./"))

    def place(self, place):
        """Returns the output of the nodes that give a texture its coordinates."""
        name, kind, word = self._READER
        reader, is_new = self.shader(("reader", place.primvar), name, kind)
        if is_new:
            reader.CreateInput(word, _TYPES.String).Set(place.primvar)
        output = reader.CreateOutput(self._RESULT, _TYPES.Float2)
        if place == Place(place.primvar):
            return output
        transform, is_new = self.shader(place, *self._TRANSFORM)
        if is_new:
            transform.CreateInput("in", _TYPES.Float2).ConnectToSource(output)
            transform.CreateInput("scale", _TYPES.Float2).Set(Gf.Vec2f(*place.scale))
            transform.CreateInput("rotation", _TYPES.Float).Set(place.rotation)
            transform.CreateInput("translation", _TYPES.Float2).Set(Gf.Vec2f(*place.translation))
        return transform.CreateOutput(self._RESULT, _TYPES.Float2)


class PreviewNodes(_Nodes):
    """Nodes of UsdPreviewSurface."""

    _READER = ("texremap_st", "UsdPrimvarReader_float2", "varname")
    _TRANSFORM = ("texremap_transform", "UsdTransform2d")
    _RESULT = "result"

    def texture(self, name, texture):
        node, _ = self.shader(("texture", name), f"texremap_{name}", "UsdUVTexture")
        node.CreateInput("file", _TYPES.Asset).Set(self.asset(texture))
        node.CreateInput("sourceColorSpace", _TYPES.Token).Set(texture.space)
        for word, value in zip(("wrapS", "wrapT"), texture.wrap):
            if value is not None:
                node.CreateInput(word, _TYPES.Token).Set(value)
        four = []
        for given, rest in ((texture.scale, 1.0), (texture.bias, 0.0)):
            values = [rest] * 4
            first = 0 if texture.is_color() else "rgba".index(texture.channels)
            values[first:first + len(given)] = given
            four.append(values)
        for word, values, plain in (("scale", four[0], [1.0] * 4), ("bias", four[1], [0.0] * 4)):
            if values != plain:
                node.CreateInput(word, _TYPES.Float4).Set(Gf.Vec4f(*values))
        node.CreateInput("st", _TYPES.Float2).ConnectToSource(self.place(texture.place))
        return node.CreateOutput(texture.channels, _TYPES.Float3 if texture.is_color() else _TYPES.Float)

    def normal(self, _, texture):
        return self.texture("normal", texture)


class SurfaceNodes(_Nodes, MaterialXNodes):
    """Nodes of MaterialX."""

    _READER = ("texremap_uv", "ND_geompropvalue_vector2", "geomprop")
    _TRANSFORM = ("texremap_uv_transform", "ND_UsdTransform2d")
    _RESULT = "out"

    def node(self, key, name, kind, type, variant=None):
        return self.shader(key, name, f"ND_{kind}_{variant or type}")

    def output(self, node, type):
        return node.CreateOutput("out", _TYPE_NAMES[type])

    def set(self, node, name, type, value):
        number = value if type == "string" else value[0] if len(value) == 1 else Gf.Vec3f(*value)
        node.CreateInput(name, _TYPE_NAMES[type]).Set(number)

    def connect(self, node, name, type, output):
        node.CreateInput(name, _TYPE_NAMES[type]).ConnectToSource(output)

    def set_file(self, node, texture, is_srgb):
        file = node.CreateInput("file", _TYPES.Asset)
        file.Set(self.asset(texture))
        file.GetAttr().SetColorSpace("srgb_texture" if is_srgb else "raw")

    def set_place(self, node, place):
        self.connect(node, "texcoord", "vector2", self.place(place))
