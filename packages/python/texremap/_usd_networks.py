"""Shading networks of USD: what feeds an input of a surface, and nodes that feed it.

Two networks are known: UsdPreviewSurface with UsdUVTexture, and OpenPBR with nodes of MaterialX. Both hold textures with a scale and a
bias for each channel.
"""

import os

import numpy as np
from pxr import Gf, Sdf, UsdShade

from ._error import Error
from ._usd_textures import Place, Texture

OPEN_PBR_ID = "ND_open_pbr_surface_surfaceshader"
_TYPES = Sdf.ValueTypeNames
_MOST_NODES = 64  # between an input and its texture


class Procedural(Error):
    """A connection that is not a texture with a scale and a bias."""


def value_of(attribute):
    """The value of an attribute as a tuple of floats, or None."""
    if attribute.GetNumTimeSamples() > 1:
        raise Error(f"{attribute.GetName()} changes over time", "input")
    value = attribute.Get()
    return None if value is None else tuple(float(number) for number in np.ravel(value))


def _producer(shader, name):
    """The attribute that gives an input its value: of the input, of a node graph or material around it, or a node's output."""
    given = shader.GetInput(name)
    if not given:
        return None
    attributes = UsdShade.Utils.GetValueProducingAttributes(given)
    return attributes[0] if attributes else given.GetAttr()


def _word(shader, name, otherwise=None):
    attribute = _producer(shader, name)
    value = attribute.Get() if attribute else None
    return otherwise if value is None else value


def source_of(shader, name, default):
    """The value of an input as a tuple, or its :class:`Texture`. Raises :class:`Procedural` for other connections."""
    attribute = _producer(shader, name)
    if attribute is None:
        return default
    if UsdShade.Output.IsOutput(attribute):
        return _texture(attribute, name, _MOST_NODES)
    value = value_of(attribute)
    return default if value is None else value


def _texture(attribute, name, most):
    node, output = UsdShade.Shader(attribute.GetPrim()), attribute.GetBaseName()
    kind = (node.GetIdAttr().Get() or "") if node else ""
    if most == 0:
        raise Error(f"{name}: its nodes form a circle", "input")
    if "UsdUVTexture" in kind:
        return _uv_texture(node, output, name)
    if kind.startswith(("ND_image_", "ND_tiledimage_")):
        return _image(node, kind, name)
    word = kind.split("_")[1] if kind.startswith("ND_") and "_" in kind[3:] else kind
    if word in ("dot", "convert"):
        return _input_texture(node, "in", name, most)
    if word in ("extract", "separate2", "separate3", "separate4"):
        texture = _input_texture(node, "in", name, most)
        index = int(_word(node, "index", 0)) if word == "extract" else {"outr": 0, "outg": 1, "outb": 2, "outa": 3,
                                                                       "outx": 0, "outy": 1, "outz": 2}.get(output, 0)
        if texture.channels != "rgb":
            raise Procedural(f"{name} comes from {attribute.GetPath()}, a channel of a channel", "input")
        letter = "rgba"[index]
        picks = slice(index, index + 1) if index < 3 else slice(0, 0)
        return texture._replace(channels=letter, scale=texture.scale[picks] or (1.0,), bias=texture.bias[picks] or (0.0,))
    if word in ("multiply", "add", "subtract"):
        return _affine(node, word, attribute, name, most)
    if kind.startswith("ND_normalmap"):
        texture = _input_texture(node, "in", name, most)
        return texture.scaled((2.0,) * 3, (-1.0,) * 3)
    raise Procedural(f"{name} comes from {attribute.GetPath()} ({kind or 'a node without an id'}), which is not a texture", "input")


def _input_texture(node, name, of, most):
    attribute = _producer(node, name)
    if attribute is None or not UsdShade.Output.IsOutput(attribute):
        raise Procedural(f"{of}: {node.GetPath()}.{name} is not a texture", "input")
    return _texture(attribute, of, most - 1)


def _affine(node, word, attribute, name, most):
    """A texture under a multiplication, an addition or a subtraction with a constant."""
    sides = [_producer(node, "in1"), _producer(node, "in2")]
    connected = [side is not None and UsdShade.Output.IsOutput(side) for side in sides]
    if connected.count(True) != 1:
        raise Procedural(f"{name}: {attribute.GetPath()} does not join a texture with a constant", "input")
    texture = _texture(sides[connected.index(True)], name, most - 1)
    other = sides[connected.index(False)]
    constant = (value_of(other) if other else None) or ((1.0,) if word == "multiply" else (0.0,))
    constant = (constant * 3)[:3] if len(constant) == 1 else constant[:3]
    one, zero = (1.0,) * 3, (0.0,) * 3
    if word == "multiply":
        return texture.scaled(constant, zero)
    if word == "add":
        return texture.scaled(one, constant)
    if connected[0]:
        return texture.scaled(one, tuple(-number for number in constant))
    return texture.scaled((-1.0,) * 3, constant)


def _asset(node, name):
    attribute = _producer(node, "file")
    asset = attribute.Get() if attribute else None
    if asset is None or not asset.path:
        raise Error(f"{name}: its texture {node.GetPath()} names no file", "input")
    path = asset.resolvedPath or asset.path
    if "<UDIM>" in asset.path and not asset.resolvedPath:
        path = os.path.join(os.path.dirname(attribute.GetPropertyStack()[0].layer.realPath), asset.path)
    return attribute, asset.path, path


def _uv_texture(node, channels, name):
    _, file, path = _asset(node, name)
    scale = tuple(_word(node, "scale", (1.0,) * 4))
    bias = tuple(_word(node, "bias", (0.0,) * 4))
    picks = slice(0, 3) if channels == "rgb" else slice("rgba".index(channels), "rgba".index(channels) + 1)
    return Texture(file, path, channels, str(_word(node, "sourceColorSpace", "auto")), scale[picks], bias[picks],
                   (_word(node, "wrapS"), _word(node, "wrapT")), _place(node, "st", name))


_WRAP_OF_MODE = {"periodic": "repeat", "clamp": "clamp", "mirror": "mirror", "constant": "black"}
_MODE_OF_WRAP = {"repeat": "periodic", "clamp": "clamp", "mirror": "mirror", "black": "constant"}


def _image(node, kind, name):
    attribute, file, path = _asset(node, name)
    space = attribute.GetColorSpace() or "auto"
    space = "sRGB" if "srgb" in space.lower() else "auto" if space == "auto" else "raw"
    channels = "r" if kind.endswith("_float") else "rgb"
    if kind.endswith(("_float", "_vector2", "_vector3", "_vector4")) and space == "auto":
        space = "raw"
    place = _place(node, "texcoord", name)
    if kind.startswith("ND_tiledimage"):
        tiling = _word(node, "uvtiling", (1.0, 1.0))
        place = place._replace(scale=tuple(float(a * b) for a, b in zip(place.scale, tiling)))
    wrap = tuple(_WRAP_OF_MODE.get(str(_word(node, f"{axis}addressmode", "periodic"))) for axis in "uv")
    count = 3 if channels == "rgb" else 1
    return Texture(file, path, channels, space, (1.0,) * count, (0.0,) * count, wrap, place)


def _place(node, name, of):
    attribute = _producer(node, name)
    if attribute is None or not UsdShade.Output.IsOutput(attribute):
        return Place()
    reader = UsdShade.Shader(attribute.GetPrim())
    kind = (reader.GetIdAttr().Get() or "") if reader else ""
    if "UsdTransform2d" in kind:
        inner = _place(reader, "in", of)
        if inner != Place(inner.primvar):
            raise Procedural(f"{of}: {reader.GetPath()} is a transform of a transform", "input")
        return Place(inner.primvar, tuple(_word(reader, "scale", (1.0, 1.0))), float(_word(reader, "rotation", 0.0)),
                     tuple(_word(reader, "translation", (0.0, 0.0))))
    if "PrimvarReader" in kind:
        return Place(str(_word(reader, "varname", "st")))
    if kind.startswith("ND_geompropvalue"):
        return Place(str(_word(reader, "geomprop", "st")))
    if kind.startswith("ND_texcoord"):
        return Place()
    raise Procedural(f"{of}: coordinates come from {reader.GetPath()} ({kind}), which is not known", "input")


class _Nodes:
    """Makes nodes below a material, each once."""

    def __init__(self, stage, material):
        self.stage, self.material, self.made = stage, material, {}
        self.layer = os.path.dirname(stage.GetEditTarget().GetLayer().realPath)

    def node(self, key, name, kind):
        """A new shader, or the one that was made for this key. Returns it, and whether it is new."""
        if key in self.made:
            return self.made[key], False
        path, number = self.material.GetPath().AppendChild(name), 1
        while self.stage.GetPrimAtPath(path):
            number += 1
            path = self.material.GetPath().AppendChild(f"{name}_{number}")
        shader = UsdShade.Shader.Define(self.stage, path)
        shader.CreateIdAttr(kind)
        self.made[key] = shader
        return shader, True

    def asset(self, texture):
        """The file as the new layer finds it."""
        file = texture.file if not os.path.isabs(texture.path) else os.path.relpath(texture.path, self.layer).replace(os.sep, "/")
        return Sdf.AssetPath(file if file.startswith(("../", "/")) or ":" in file else "./" + file.removeprefix("./"))

    def place(self, place):
        """The output of the nodes that give a texture its coordinates."""
        name, kind, word = self._READER
        reader, is_new = self.node(("reader", place.primvar), name, kind)
        if is_new:
            reader.CreateInput(word, _TYPES.String).Set(place.primvar)
        output = reader.CreateOutput(self._RESULT, _TYPES.Float2)
        if place == Place(place.primvar):
            return output
        transform, is_new = self.node(place, *self._TRANSFORM)
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
        node, _ = self.node(("texture", name), f"texremap_{name}", "UsdUVTexture")
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

    def normal(self, texture):
        return self.texture("normal", texture)


class MaterialXNodes(_Nodes):
    """Nodes of MaterialX 1.39."""

    _READER = ("texremap_uv", "ND_geompropvalue_vector2", "geomprop")
    _TRANSFORM = ("texremap_uv_transform", "ND_UsdTransform2d")
    _RESULT = "out"

    def image(self, texture, kind, usd_type):
        key = (texture.file, texture.place, texture.wrap, texture.space, kind)
        node, is_new = self.node(key, "texremap_image", f"ND_image_{kind}")
        if is_new:
            file = node.CreateInput("file", _TYPES.Asset)
            file.Set(self.asset(texture))
            is_srgb = texture.space == "sRGB" or (texture.space == "auto" and kind.startswith("color"))
            file.GetAttr().SetColorSpace("srgb_texture" if is_srgb else "raw")
            for axis, wrap in zip("uv", texture.wrap):
                if wrap in _MODE_OF_WRAP:
                    node.CreateInput(f"{axis}addressmode", _TYPES.String).Set(_MODE_OF_WRAP[wrap])
            node.CreateInput("texcoord", _TYPES.Float2).ConnectToSource(self.place(texture.place))
        return node.CreateOutput("out", usd_type)

    def joined(self, name, operation, kind, source, value):
        """The output of a node that multiplies or adds a constant."""
        usd_type = {"float": _TYPES.Float, "color3": _TYPES.Color3f, "vector3": _TYPES.Float3}[kind]
        node, _ = self.node((name, operation), f"texremap_{name}_{operation}", f"ND_{operation}_{kind}")
        node.CreateInput("in1", usd_type).ConnectToSource(source)
        node.CreateInput("in2", usd_type).Set(value[0] if kind == "float" else Gf.Vec3f(*value))
        return node.CreateOutput("out", usd_type)

    def scaled(self, name, kind, source, scale, bias):
        if any(abs(number - 1) > 1e-6 for number in scale):
            source = self.joined(name, "multiply", kind, source, scale)
        return self.joined(name, "add", kind, source, bias) if any(abs(number) > 1e-6 for number in bias) else source

    def texture(self, name, texture):
        if texture.is_color():
            return self.scaled(name, "color3", self.image(texture, "color3", _TYPES.Color3f), texture.scale, texture.bias)
        if texture.channels == "r":
            output = self.image(texture, "float", _TYPES.Float)
        else:
            kind = "vector4" if texture.channels == "a" else "vector3"
            usd_type = _TYPES.Float4 if kind == "vector4" else _TYPES.Float3
            node, _ = self.node((name, "extract"), f"texremap_{name}_channel", f"ND_extract_{kind}")
            node.CreateInput("in", usd_type).ConnectToSource(self.image(texture, kind, usd_type))
            node.CreateInput("index", _TYPES.Int).Set("rgba".index(texture.channels))
            output = node.CreateOutput("out", _TYPES.Float)
        return self.scaled(name, "float", output, texture.scale, texture.bias)

    def normal(self, texture):
        """The texture of UsdPreviewSurface has values from -1 to 1, the node of MaterialX takes 0 to 1."""
        image = self.image(texture._replace(space="raw"), "vector3", _TYPES.Float3)
        scale, bias = [s / 2 for s in texture.scale], [(b + 1) / 2 for b in texture.bias]
        node, _ = self.node("normal", "texremap_normal", "ND_normalmap_float")
        node.CreateInput("in", _TYPES.Float3).ConnectToSource(self.scaled("normal", "vector3", image, scale, bias))
        return node.CreateOutput("out", _TYPES.Float3)
