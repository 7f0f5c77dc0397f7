"""Materials of MaterialX documents: a reader, and a writer."""

import os

import numpy as np

from . import materials
from ._error import Error
from ._files import replacing
from ._networks import MOST_NODES, MaterialXNodes, Node, Procedural, texture_of
from ._surface import Surface
from ._textures import Place, Texture, linear, tiles_of, write_file

try:
    import MaterialX as mx
except ImportError as failure:
    raise ImportError(f"MaterialX documents cannot be read: {failure} (pip install MaterialX)") from failure

_MOST_BYTES = 64 << 20
_LINEAR, _SRGB = ("", "none", "lin_rec709", "linear", "raw"), ("srgb_texture", "sRGB")
# These inputs are the normals of the base, then the normals of the coat.
NORMALS = {"open_pbr_surface": ("geometry_normal", "geometry_coat_normal"), "standard_surface": ("normal", "coat_normal"),
           "gltf_pbr": ("normal", "clearcoat_normal"), "UsdPreviewSurface": ("normal",)}
_TYPES = {"geometry_thin_walled": "boolean", "thin_walled": "boolean", "alpha_mode": "integer", "useSpecularWorkflow": "integer",
          "opacityMode": "integer"}


def _end_of(given, name):
    """Returns the element that holds the value of an input, or the node and the output that the input is
    connected to."""
    for _ in range(MOST_NODES):
        if given.getInterfaceName():
            inner = given.getInterfaceInput() if isinstance(given, mx.Input) else None
        elif given.getNodeGraphString():
            inner = given.getConnectedOutput()
        elif given.getNodeName():
            node = given.getConnectedNode()
            if node is None:
                raise Error(f"{name}: is connected to {given.getNodeName()}, which does not exist", "input")
            return _DocumentNode(node), given.getOutputString() or "out"
        else:
            return given
        if inner is None:
            raise Error(f"{name}: is connected to nothing", "input")
        given = inner
    raise Error(f"{name}: its nodes refer to each other in a circle (remove one of the connections)", "input")


def _numbers_of(given, name):
    """Returns the value of an input as a tuple of floats, with colors in linear Rec. 709. Returns None if it
    has no value."""
    if not given.getValueString():
        return None
    value = given.getValue()
    if value is None or isinstance(value, str):
        raise Error(f"{name}: '{given.getValueString()}' is not a {given.getType()}", "input")
    numbers = tuple(float(number) for number in (value.asTuple() if hasattr(value, "asTuple") else (value,)))
    space = given.getActiveColorSpace()
    if given.getType() not in ("color3", "color4") or space in _LINEAR:
        return numbers
    if space not in _SRGB:
        raise Error(f"{name}: the color space {space} is not known", "input")
    return (*linear(np.array(numbers[:3])).tolist(), *numbers[3:])


class _DocumentNode(Node):
    """A node of a document."""

    def __init__(self, node):
        self.node, self.kind, self.type, self.name = node, node.getCategory(), node.getType(), node.getNamePath()
        if self.kind == "UsdPrimvarReader":
            self.type = "vector2"

    def _end(self, name):
        given = self.node.getInput(name)
        return None if given is None else _end_of(given, f"{self.name}.{name}")

    def link(self, name):
        end = self._end(name)
        if not isinstance(end, tuple):
            return None
        node, output = end
        return node, "rgb" if node.kind == "UsdUVTexture" and output == "out" else output

    def numbers(self, name, otherwise=None):
        end = self._end(name)
        if isinstance(end, tuple):
            raise Procedural(f"{self.name}.{name} comes from {end[0].name}, which is not a constant")
        value = None if end is None else _numbers_of(end, f"{self.name}.{name}")
        return otherwise if value is None else value

    def word(self, name, otherwise=None):
        end = self._end(name)
        return otherwise if end is None or isinstance(end, tuple) else end.getValueString() or otherwise

    def file(self, of):
        end = self._end("file")
        name = "" if end is None or isinstance(end, tuple) else end.getResolvedValueString()
        if not name:
            raise Error(f"{of}: its texture {self.name} has no file", "input")
        folder = os.path.dirname(self.node.getDocument().getSourceUri())
        path = os.path.join(folder, os.path.dirname(end.getActiveSourceUri()), name)  # the path of an included document is relative
        space = end.getActiveColorSpace()
        is_color = self.type in ("color3", "color4") or self.kind == "gltf_colorimage"
        if is_color and space not in (*_LINEAR, *_SRGB):
            raise Error(f"{of}: the color space {space} of {name} is not known", "input")
        return name, path, "sRGB" if space in _SRGB and is_color else "raw"


class MtlxReader:
    """A MaterialX document."""

    def __init__(self, path, folder):
        self.path = path
        if not os.path.isfile(path):
            raise Error(f"{path}: cannot be read: file not found", "input")
        if os.path.getsize(path) > _MOST_BYTES:
            raise Error(f"{path}: has more than {_MOST_BYTES} bytes", "input")
        self.document = mx.createDocument()
        try:
            mx.readFromXmlFile(self.document, os.path.abspath(path), mx.FileSearchPath())
            library = mx.createDocument()
            mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), library)
            self.document.setDataLibrary(library)
            is_valid, reason = self.document.validate()
        except Exception as failure:  # MaterialX has several
            raise Error(f"{path}: cannot be read: {_first_line(failure)}", "input") from None
        if not is_valid:
            raise Error(f"{path}: is not valid MaterialX: {_first_line(reason)}", "input")
        self.materials = list(self.document.getMaterialNodes()) or [
            node for node in self.document.getNodes() if node.getType() == "surfaceshader"]

    def name_of(self, index):
        return self.materials[index].getName()

    def reason_to_leave(self, index, read=None):
        return ""

    def surface(self, index):
        material = self.materials[index]
        shader = material
        if material.getType() != "surfaceshader":
            end = _end_of(material.getInput("surfaceshader"), "surfaceshader") if material.getInput("surfaceshader") else None
            if not isinstance(end, tuple):
                raise Error("has no surface", "input")
            shader = end[0].node
        model = shader.getCategory()
        if model not in NORMALS:
            raise Error(f"its surface is a {model} (known are {', '.join(NORMALS)})", "input")
        sources, normals, lost = {}, {}, []
        for name, default in materials.MODELS[model].items():
            sources[name] = self._source(shader, name, tuple(np.ravel(default).tolist()), lost)
        for name, word in zip(NORMALS[model], ("normal", "coat_normal")):
            source = self._source(shader, name, None, lost)
            if isinstance(source, Texture):
                tiles_of(source.path, name)
                normals[word] = source
        known = {*materials.MODELS[model], *NORMALS[model], "surfaceshader"}
        lost += [given.getName() for given in (*shader.getInputs(), *(material.getInputs() if material is not shader else ()))
                 if given.getName() not in known and given.getConnectedNode()]
        if model == "UsdPreviewSurface" and "normal" in normals:
            normals["coat_normal"] = normals["normal"]
        return Surface(model, sources, normals, lost)

    @staticmethod
    def _source(shader, name, default, lost):
        given = shader.getInput(name)
        end = None if given is None else _end_of(given, name)
        if end is None:
            return default
        try:
            if isinstance(end, tuple):
                node, output = end
                return texture_of(node, "rgb" if node.kind == "UsdUVTexture" and output == "out" else output, name)
        except Procedural as failure:
            lost.append(failure.words_about(name))
            return default
        value = _numbers_of(end, name) if default is not None else None
        return default if value is None else value


def _first_line(text):
    return (str(text).strip().split("\n") or [""])[0] or "unknown reason"


class _GraphNodes(MaterialXNodes):
    """Makes nodes in the graph of a material."""

    def __init__(self, graph, file_of):
        self.graph, self._file_of, self._made = graph, file_of, {}

    def node(self, key, name, kind, type, variant=None):
        if key in self._made:
            return self._made[key], False
        node = self.graph.addNode(kind, self.graph.createValidChildName(name.removeprefix("texremap_")), type)
        self._made[key] = node
        return node, True

    def output(self, node, type):
        return node

    def set(self, node, name, type, value):
        if value != "periodic":  # the default
            _set(node.addInput(name, type), value)

    def connect(self, node, name, type, output):
        node.addInput(name, type).setConnectedNode(output)

    def set_file(self, node, texture, is_srgb):
        file = node.addInput("file", "filename")
        file.setValueString(self._file_of(texture))
        if is_srgb:
            file.setColorSpace("srgb_texture")
        elif node.getType().startswith("color"):
            file.setColorSpace("lin_rec709")

    def set_place(self, node, place):
        if place == Place():
            return
        reader = None
        if place.primvar != "st":
            number = place.primvar.removeprefix("st")
            kind = "texcoord" if number.isdigit() else "geompropvalue"
            reader, is_new = self.node(("reader", place.primvar), "uv", kind, "vector2")
            if is_new and kind == "texcoord":
                self.set(reader, "index", "integer", (int(number),))
            elif is_new:
                self.set(reader, "geomprop", "string", place.primvar)
        if place == Place(place.primvar):
            self.connect(node, "texcoord", "vector2", reader)
            return
        transform, is_new = self.node(place, "uv_transform", "UsdTransform2d", "vector2")
        if is_new:
            if reader is None:
                reader, _ = self.node(("reader", place.primvar), "uv", "texcoord", "vector2")
            self.connect(transform, "in", "vector2", reader)
            self.set(transform, "scale", "vector2", place.scale)
            self.set(transform, "rotation", "float", (place.rotation,))
            self.set(transform, "translation", "vector2", place.translation)
        self.connect(node, "texcoord", "vector2", transform)


def _set(given, value):
    if isinstance(value, str):
        given.setValueString(value)
    elif given.getType() == "boolean":
        given.setValueString("true" if value[0] else "false")
    elif given.getType() == "integer":
        given.setValueString(str(int(value[0])))
    else:
        given.setValueString(", ".join(f"{float(number):.7g}" for number in value))


class MtlxWriter:
    """A new document of materials."""

    def __init__(self, output, model, reader):
        self._output, self._model, self._extracted = output, model, getattr(reader, "folder", None)
        self._parent, self._stem = os.path.dirname(os.path.abspath(output)), os.path.splitext(os.path.basename(output))[0]
        self._textures = os.path.join(os.path.dirname(output), f"{self._stem}_textures")
        self._document, self._edits, self._copies, self._names = mx.createDocument(), [], {}, {}
        self._looks = reader.document.getLooks() if isinstance(reader, MtlxReader) else ()
        self._document.setColorSpace("lin_rec709")

    def _file_of(self, texture):
        path = texture.path
        if self._extracted and path.startswith(self._extracted + os.sep):
            name = os.path.basename(path)
            self._copies[os.path.join(self._textures, name)] = path
            return f"{self._stem}_textures/{name}"
        return os.path.relpath(path, self._parent).replace(os.sep, "/")

    def add(self, name, edit, normals, _):
        """Adds a material. Returns the files of new textures, and the inputs that are lost."""
        lost = [f"{one}: has no texture, and becomes a constant" for one in _TYPES
                if one in materials.MODELS[self._model] and edit.settle(one, largest=True)]
        unique = self._document.createValidChildName(name)
        edit.put_into_files(lambda one: os.path.join(self._textures, f"{unique}_{one}.png"))
        self._edits.append(edit)
        self._names[name] = unique
        nodes = None
        shader = self._document.addNode(self._model, self._document.createValidChildName(f"{unique}_surface"), "surfaceshader")
        surface = self._document.addNode("surfacematerial", unique, "material")
        surface.addInput("surfaceshader", "surfaceshader").setConnectedNode(shader)

        def graph():
            nonlocal nodes
            if nodes is None:
                place = self._document.createValidChildName(f"{unique}_textures")
                nodes = _GraphNodes(self._document.addNodeGraph(place), self._file_of)
            return nodes

        def connect(one, type, node):
            output = graph().graph.addOutput(f"{one}_out", type)
            output.setConnectedNode(node)
            shader.addInput(one, type).setConnectedOutput(output)

        for one, default in materials.MODELS[self._model].items():
            type = "color3" if isinstance(default, tuple) else _TYPES.get(one, "float")
            if one in edit.textures:
                connect(one, type, graph().texture(one, edit.textures[one]))
            elif not np.allclose(edit.values[one], default, atol=1e-7):
                _set(shader.addInput(one, type), edit.values[one])
        words = dict(zip(("normal", "coat_normal"), NORMALS[self._model]))
        for one, texture in normals.items():
            if one in words:
                connect(words[one], "vector3", graph().normal(words[one], texture))
            elif texture != normals.get("normal"):
                lost.append(one)
        return tuple(path if os.path.isabs(self._output) else os.path.relpath(path) for path, *_ in edit.files()), tuple(lost)

    def save(self, _):
        """Writes the document, after all files that it refers to."""
        for look in self._looks:
            copy = self._document.addLook(look.getName())
            for given in look.getMaterialAssigns():
                if given.getMaterial() in self._names and not given.getCollectionString():
                    copy.addMaterialAssign(given.getName(), self._names[given.getMaterial()]).setGeom(given.getGeom())
        has_files = self._copies or any(edit.files() for edit in self._edits)
        os.makedirs(os.path.abspath(self._textures) if has_files else self._parent, exist_ok=True)
        for edit in self._edits:
            edit.write_files()
        for path, source in self._copies.items():
            with open(source, "rb") as file:
                write_file(os.path.abspath(path), file.read())
        with replacing(os.path.abspath(self._output)) as unfinished, open(unfinished, "w", encoding="utf-8") as file:
            file.write(mx.writeToXmlString(self._document))
