"""Networks of nodes in MaterialX and USD.

This module finds the texture that feeds an input, and makes nodes that feed one. The nodes belong to a
MaterialX document or to a USD stage. Both hold textures with a scale and a bias for each channel.
"""

import math
from typing import Optional, Tuple, Union

from ._error import Error
from ._textures import Place, Texture

MOST_NODES = 64  # between an input and its texture
_WRAP_OF_MODE = {"periodic": "repeat", "clamp": "clamp", "mirror": "mirror", "constant": "black"}
_MODE_OF_WRAP = {"repeat": "periodic", "clamp": "clamp", "mirror": "mirror", "black": "constant"}
_INDEX_OF_OUTPUT = {f"out{letter}": index for letters in ("rgba", "xyzw") for index, letter in enumerate(letters)}


class Procedural(Error):
    """Is raised for a connection that is not a texture with a scale and a bias."""

    def __init__(self, message):
        super().__init__(message, "input")

    def words_about(self, name):
        """Returns the message, which begins with the name of the input."""
        return f"{name}: {str(self).removeprefix(name).lstrip(': ')}"


class Node:
    """A node of a document.

    ``kind`` is its category (``"image"``). ``type`` is the type in its name. ``name`` is for messages.
    """

    kind: str
    type: str
    name: str

    def link(self, name: str) -> Optional[Tuple["Node", str]]:
        """Returns the node and the output that an input is connected to."""
        raise NotImplementedError

    def numbers(self, name: str, otherwise=None):
        """Returns the value of an input as a tuple of floats."""
        raise NotImplementedError

    def word(self, name: str, otherwise=None) -> Optional[str]:
        raise NotImplementedError

    def file(self, of: str) -> Tuple[str, str, str]:
        """Returns the file as the document names it, its path, and its color space."""
        raise NotImplementedError


def texture_of(node, output, name, most=MOST_NODES) -> Union[Texture, Tuple[float, ...]]:
    """Returns the texture or the constant that an output of a node gives. Raises :class:`Procedural` for
    others."""
    if most == 0:
        raise Error(f"{name}: its nodes refer to each other in a circle (remove one of the connections)", "input")
    kind = node.kind
    if kind == "UsdUVTexture":
        return _uv_texture(node, output, name)
    if kind in ("image", "tiledimage", "gltf_image", "gltf_colorimage", "gltf_normalmap"):
        return _image(node, output, name)
    if kind == "constant":
        return node.numbers("value", (0.0,))
    if kind in ("dot", "convert"):
        return _input_texture(node, "in", name, most)
    if kind in ("extract", "separate2", "separate3", "separate4"):
        texture = _input_texture(node, "in", name, most)
        index = int(node.numbers("index", (0,))[0]) if kind == "extract" else _INDEX_OF_OUTPUT.get(output, 0)
        if texture.channels != "rgb" or not 0 <= index < 4:
            raise Procedural(f"{name} comes from {node.name}.{output}, which reads a channel of a single channel")
        picks = slice(index, index + 1) if index < 3 else slice(0, 0)
        return texture._replace(channels="rgba"[index], scale=texture.scale[picks] or (1.0,), bias=texture.bias[picks] or (0.0,))
    if kind in ("multiply", "divide", "add", "subtract"):
        return _affine(node, output, name, most)
    if kind == "invert":
        amount = _three(node.numbers("amount", (1.0,)))
        return _input_texture(node, "in", name, most).scaled((-1.0,) * 3, amount)
    if kind == "normalmap":
        strength = _three(node.numbers("scale", (1.0,)))[:2]
        texture = _input_texture(node, "in", name, most)
        return texture.scaled((2 * strength[0], 2 * strength[1], 2.0), (-strength[0], -strength[1], -1.0))
    raise Procedural(f"{name} comes from {node.name}.{output} ({kind or 'a node without an id'}), which is not a texture")


def _three(numbers):
    return (tuple(numbers) * 3)[:3] if len(numbers) == 1 else tuple(numbers)[:3]


def _input_texture(node, name, of, most):
    link = node.link(name)
    found = texture_of(*link, of, most - 1) if link else None
    if not isinstance(found, Texture):
        raise Procedural(f"{of}: {node.name}.{name} is not a texture")
    return found


def _affine(node, output, name, most):
    """Returns the texture that a node multiplies by a constant, or to which it adds or subtracts one."""
    sides = []
    for side in ("in1", "in2"):
        link = node.link(side)
        neutral = (1.0,) if node.kind in ("multiply", "divide") else (0.0,)
        sides.append(texture_of(*link, name, most - 1) if link else node.numbers(side, neutral))
    is_texture = [isinstance(side, Texture) for side in sides]
    if is_texture.count(True) != 1 or (node.kind == "divide" and is_texture[1]):
        raise Procedural(f"{name}: {node.name}.{output} does not join a texture with a constant")
    texture, constant = sides[is_texture.index(True)], _three(sides[is_texture.index(False)])
    one, zero = (1.0,) * 3, (0.0,) * 3
    if node.kind == "multiply":
        return texture.scaled(constant, zero)
    if node.kind == "divide":
        if 0 in constant:
            raise Error(f"{name}: {node.name} divides by 0", "input")
        return texture.scaled(tuple(1 / number for number in constant), zero)
    if node.kind == "add":
        return texture.scaled(one, constant)
    if is_texture[0]:
        return texture.scaled(one, tuple(-number for number in constant))
    return texture.scaled((-1.0,) * 3, constant)


def _uv_texture(node, channels, name):
    if channels not in ("rgb", "r", "g", "b", "a"):
        raise Procedural(f"{name}: {node.name} does not have the output {channels}")
    file, path, _ = node.file(name)
    picks = slice(0, 3) if channels == "rgb" else slice("rgba".index(channels), "rgba".index(channels) + 1)
    return Texture(file, path, channels, node.word("sourceColorSpace", "auto"), node.numbers("scale", (1.0,) * 4)[picks],
                   node.numbers("bias", (0.0,) * 4)[picks], (node.word("wrapS"), node.word("wrapT")), _place(node, "st", name))


def _image(node, output, name):
    file, path, space = node.file(name)
    channels = "r" if node.type == "float" else "rgb"
    if space == "auto" and node.type in ("float", "vector2", "vector3", "vector4"):
        space = "raw"
    wrap = tuple(_WRAP_OF_MODE.get(node.word(f"{axis}addressmode", "periodic")) for axis in "uv")
    place = _place(node, "texcoord", name)
    if node.kind == "tiledimage":
        tiling = node.numbers("uvtiling", (1.0, 1.0))
        if any(node.numbers("uvoffset", (0.0, 0.0))):
            raise Procedural(f"{name}: {node.name} has a uvoffset, which is not supported for tiles")
        place = place._replace(scale=tuple(float(a * b) for a, b in zip(place.scale, tiling)))
    scale = (1.0,) * (3 if channels == "rgb" else 1)
    if node.kind.startswith("gltf_"):
        place = _gltf_place(node, place, name)
    if node.kind == "gltf_colorimage":
        factor = tuple(a * b for a, b in zip(node.numbers("color", (1.0,) * 4), node.numbers("geomcolor", (1.0,) * 4)))
        channels, scale = ("a", factor[3:]) if output == "outa" else ("rgb", factor[:3])
    texture = Texture(file, path, channels, space, scale, (0.0,) * len(scale), wrap, place)
    return texture.scaled((2.0,) * 3, (-1.0,) * 3) if node.kind == "gltf_normalmap" else texture


def _place(node, name, of):
    link = node.link(name)
    if link is None:
        return Place()
    reader, _ = link
    if reader.kind == "UsdTransform2d":
        inner = _plain_place(reader, "in", of)
        return Place(inner.primvar, reader.numbers("scale", (1.0, 1.0)), reader.numbers("rotation", (0.0,))[0],
                     reader.numbers("translation", (0.0, 0.0)))
    if reader.kind == "place2d":
        inner = _plain_place(reader, "texcoord", of)
        scale = reader.numbers("scale", (1.0, 1.0))
        if 0 in scale:
            raise Error(f"{of}: {reader.name}.scale is 0", "input")
        return _pivoted(inner.primvar, tuple(1 / number for number in scale), -reader.numbers("rotate", (0.0,))[0],
                        tuple(-number for number in reader.numbers("offset", (0.0, 0.0))), reader.numbers("pivot", (0.0, 0.0)),
                        reader.numbers("operationorder", (0,))[0], f"{of}: {reader.name}")
    if reader.kind == "UsdPrimvarReader":
        return Place(reader.word("varname", "st"))
    if reader.kind == "geompropvalue":
        return Place(reader.word("geomprop", "st"))
    if reader.kind == "texcoord":
        index = int(reader.numbers("index", (0,))[0])
        return Place(f"st{index}" if index else "st")
    raise Procedural(f"{of}: coordinates come from {reader.name} ({reader.kind}), which is not known")


def _plain_place(reader, name, of):
    inner = _place(reader, name, of)
    if inner != Place(inner.primvar):
        raise Procedural(f"{of}: {reader.name} transforms coordinates that are already transformed, which is not supported")
    return inner


def _gltf_place(node, place, name):
    """Returns the place of a glTF image node. It has the transform of KHR_texture_transform, but v grows
    upwards."""
    offset = node.numbers("offset", (0.0, 0.0))
    order = 0 if node.kind == "gltf_colorimage" else node.numbers("operationorder", (1,))[0]
    moved = _pivoted(place.primvar, node.numbers("scale", (1.0, 1.0)), node.numbers("rotate", (0.0,))[0], (offset[0], -offset[1]),
                     node.numbers("pivot", (0.0, 1.0)), order, f"{name}: {node.name}")
    if moved != Place(place.primvar) and place != Place(place.primvar):
        raise Procedural(f"{name}: {node.name} transforms coordinates that are already transformed, which is not supported")
    return place if moved == Place(place.primvar) else moved


def turned(degrees, point):
    """Returns the point after a rotation from u to v."""
    s, c = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    return c * point[0] - s * point[1], s * point[0] + c * point[1]


def _pivoted(primvar, scale, rotation, offset, pivot, order, name):
    """Returns the place after a scale and a rotation about a pivot, then an offset. With ``order`` 1, the
    order is reversed."""
    def scaled(point):
        return scale[0] * point[0], scale[1] * point[1]

    if order == 1:
        if rotation % 360 and scale[0] != scale[1]:
            raise Procedural(f"{name} scales by two different factors after it rotates, which is not supported")
        moved = scaled(turned(rotation, (offset[0] - pivot[0], offset[1] - pivot[1])))
    else:
        moved = turned(rotation, scaled((-pivot[0], -pivot[1])))
        moved = moved[0] + offset[0], moved[1] + offset[1]
    place = Place(primvar, tuple(scale), rotation % 360 if rotation % 360 else 0.0,
                  tuple(round(m + p, 9) + 0.0 for m, p in zip(moved, pivot)))
    return place


class MaterialXNodes:
    """Makes nodes of MaterialX 1.39 that feed textures into a surface. A document or a stage makes the nodes."""

    def node(self, key, name, kind, type, variant=None):
        """Returns the node for this key, and whether it is new. ``variant`` is the type in the name of the
        node."""
        raise NotImplementedError

    def output(self, node, type):
        raise NotImplementedError

    def set(self, node, name, type, value):
        raise NotImplementedError

    def connect(self, node, name, type, output):
        raise NotImplementedError

    def set_file(self, node, texture, is_srgb):
        raise NotImplementedError

    def set_place(self, node, place):
        raise NotImplementedError

    def image(self, texture, type):
        key = (texture.file, texture.place, texture.wrap, texture.space, type)
        node, is_new = self.node(key, "texremap_image", "image", type)
        if is_new:
            is_color = type.startswith("color")
            self.set_file(node, texture, texture.space == "sRGB" or (texture.space == "auto" and is_color))
            for axis, wrap in zip("uv", texture.wrap):
                if wrap in _MODE_OF_WRAP:
                    self.set(node, f"{axis}addressmode", "string", _MODE_OF_WRAP[wrap])
            self.set_place(node, texture.place)
        return self.output(node, type)

    def joined(self, name, operation, type, source, value):
        """Returns the output of a node that multiplies by a constant or adds a constant."""
        node, _ = self.node((name, operation), f"texremap_{name}_{operation}", operation, type)
        self.connect(node, "in1", type, source)
        self.set(node, "in2", type, value)
        return self.output(node, type)

    def scaled(self, name, type, source, scale, bias):
        if any(abs(number - 1) > 1e-6 for number in scale):
            source = self.joined(name, "multiply", type, source, scale)
        return self.joined(name, "add", type, source, bias) if any(abs(number) > 1e-6 for number in bias) else source

    def texture(self, name, texture):
        if texture.is_color():
            return self.scaled(name, "color3", self.image(texture, "color3"), texture.scale, texture.bias)
        if texture.channels == "r":
            output = self.image(texture, "float")
        else:
            type = "vector4" if texture.channels == "a" else "vector3"
            node, _ = self.node((name, "extract"), f"texremap_{name}_channel", "extract", "float", type)
            self.connect(node, "in", type, self.image(texture, type))
            self.set(node, "index", "integer", ("rgba".index(texture.channels),))
            output = self.output(node, "float")
        return self.scaled(name, "float", output, texture.scale, texture.bias)

    def normal(self, name, texture):
        """Returns the output of a normal map node. Normals are -1 to 1 here, but the node needs 0 to 1."""
        image = self.image(texture._replace(space="raw"), "vector3")
        scale, bias = [s / 2 for s in texture.scale], [(b + 1) / 2 for b in texture.bias]
        node, _ = self.node(name, f"texremap_{name}", "normalmap", "vector3", "float")
        self.connect(node, "in", "vector3", self.scaled(name, "vector3", image, scale, bias))
        return self.output(node, "vector3")
