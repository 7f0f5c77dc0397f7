"""UsdPreviewSurface materials from the specular workflow to the metallic one, and back.

Needs usd-core (the extra ``usd``); materials with textures also need OpenImageIO (the extra ``images``). The result is a new layer that
sublayers the old one, which stays as it is: ``texremap usd scene.usda --to metallic -o scene_metallic.usda``.
"""

import json
import os
import re
import sys
from typing import List, NamedTuple, Optional, Tuple, Union

import numpy as np

from ._error import Error
from ._files import replacing
from ._usd_options import usd_parser
from .arrays import Converter

try:
    from pxr import Gf, Sdf, Usd, UsdShade
except ImportError as failure:
    raise ImportError(f"USD files cannot be read: {failure} (pip install usd-core)") from failure

# These belong to the stage; a layer does not take them from its sublayers.
_STAGE_METADATA = ("defaultPrim", "upAxis", "metersPerUnit", "kilogramsPerUnit", "timeCodesPerSecond", "framesPerSecond",
                   "startTimeCode", "endTimeCode", "autoPlay", "colorConfiguration", "colorManagementSystem")
_DEFAULTS = {"diffuseColor": (0.18, 0.18, 0.18), "specularColor": (0.0, 0.0, 0.0), "metallic": (0.0,), "ior": (1.5,)}
# These map inputs of the shader to names of the converter.
_SPECULAR = {"diffuseColor": "diffuse", "specularColor": "specular"}
_METALLIC = {"diffuseColor": "base_color", "metallic": "metallic"}
_PNG_LEVEL = 6
_ROUGHNESS = 0.5  # any value: both ends share a BRDF, so roughness stays


class MaterialReport(NamedTuple):
    """What became of a material."""

    path: str
    state: str
    """``"converted"``, ``"left"`` (it has the workflow already, or is no UsdPreviewSurface) or ``"failed"``."""
    reason: str = ""
    textures: Tuple[str, ...] = ()
    """The files that were written for it."""


class _Texture(NamedTuple):
    shader: object
    path: str
    channels: str
    """``"rgb"``, ``"r"``, ``"g"``, ``"b"`` or ``"a"``."""


def _f0(ior):
    return ((1 - ior) / (1 + ior)) ** 2


def _source_of(shader, name):
    """The value of an input as a tuple, or its :class:`_Texture`."""
    given = shader.GetInput(name)
    if not given:
        return _DEFAULTS[name]
    attributes = UsdShade.Utils.GetValueProducingAttributes(given)
    attribute = attributes[0] if attributes else given.GetAttr()
    if attribute.GetNumTimeSamples() > 1:
        raise Error(f"{name} changes over time", "input")
    node = UsdShade.Shader(attribute.GetPrim())
    if UsdShade.Output.IsOutput(attribute):
        if not node or node.GetIdAttr().Get() != "UsdUVTexture":
            raise Error(f"{name} comes from {attribute.GetPath()}, which is no UsdUVTexture", "input")
        return _texture(node, attribute.GetBaseName(), name)
    value = attribute.Get()
    if value is None:
        return _DEFAULTS[name]
    return tuple(float(number) for number in np.ravel(value))


def _texture(node, channels, name):
    file = node.GetInput("file")
    asset = file.Get() if file else None
    if asset is None or not asset.path:
        raise Error(f"{name}: its texture {node.GetPath()} names no file", "input")
    if "<UDIM>" in asset.path:
        raise Error(f"{name}: its texture {node.GetPath()} has tiles (<UDIM>), which are not read", "input")
    path = asset.resolvedPath or asset.path
    if not os.path.isfile(path):
        raise Error(f"{name}: {asset.path}: file not found", "input")
    return _Texture(node, path, channels)


def _shader_value(node, name, otherwise):
    given = node.GetInput(name)
    value = given.Get() if given else None
    return otherwise if value is None else value


def _read(texture):
    """Linear floats of shape (height, width, channels)."""
    from .images import MOST_TEXELS, Images

    image = Images().open(texture.path, 0)
    layout = image.layout()
    if layout["width"] * layout["height"] > MOST_TEXELS:
        raise Error(f"{texture.path}: {layout['width']}x{layout['height']} texels are more than {MOST_TEXELS}", "input")
    names = [name for name, _ in layout["channels"]]
    kinds = {kind for _, kind in layout["channels"]}
    if len(kinds) > 1:
        raise Error(f"{texture.path}: has channels of several types", "input")
    dtype = np.dtype({"uint8": "u1", "uint16": "u2", "uint": "u4", "half": "f2", "float": "f4"}.get(kinds.pop(), "f4"))
    stored = np.empty((layout["height"], layout["width"], len(names)), dtype)
    image.read_rows(0, layout["height"], memoryview(stored.view(np.uint8)).cast("B"))
    largest = 1 if dtype.kind == "f" else np.iinfo(dtype).max
    values = stored.astype(np.float32) / np.float32(largest)
    is_grey = len(names) < 3
    space = _shader_value(texture.shader, "sourceColorSpace", "auto")
    # `auto` means that 8-bit images of colors are sRGB unless the file states otherwise (UsdPreviewSurface, Texture
    # Reader).
    is_srgb = space == "sRGB" or (space == "auto" and dtype == np.uint8 and not is_grey)
    colors = values[..., :1].repeat(3, axis=-1) if is_grey else values[..., :3]
    alpha = values[..., 3:4] if len(names) > 3 else np.ones_like(values[..., :1])
    if is_srgb:
        low = colors <= 0.04045
        colors = np.where(low, colors / 12.92, ((np.maximum(colors, 0.04045) + 0.055) / 1.055) ** 2.4)  # IEC 61966-2-1
    four = np.concatenate([colors, alpha], axis=-1)
    four = four * np.array(_shader_value(texture.shader, "scale", (1, 1, 1, 1)), np.float32)
    four = four + np.array(_shader_value(texture.shader, "bias", (0, 0, 0, 0)), np.float32)
    places = {"rgb": slice(0, 3), "r": slice(0, 1), "g": slice(1, 2), "b": slice(2, 3), "a": slice(3, 4)}
    return np.ascontiguousarray(four[..., places[texture.channels]], np.float32)


def _write(path, values, is_color):
    """A PNG of 8 bits: colors in sRGB."""
    from .images import Images

    if is_color:
        values = np.where(values <= 0.0031308, values * 12.92,
                          1.055 * np.maximum(values, 0.0031308) ** (1 / 2.4) - 0.055)
    stored = np.round(np.clip(values, 0, 1) * 255).astype(np.uint8)
    height, width, channels = stored.shape
    image = Images().encode_png(width, height, channels, "uint8", stored.tobytes(), _PNG_LEVEL)
    with replacing(path) as unfinished, open(unfinished, "wb") as file:
        file.write(image)


class _MaterialEdit:
    """What one material of the source becomes."""

    def __init__(self, material, shader, is_to_metallic, folder):
        self._shader, self._folder = shader, folder
        self._material = material
        self._takes, self._makes = (_SPECULAR, _METALLIC) if is_to_metallic else (_METALLIC, _SPECULAR)
        self._is_to_metallic = is_to_metallic
        self._converted = None

    def convert(self):
        """Computes everything, before anything is written."""
        sources = {name: _source_of(self._shader, name) for name in self._takes}
        ior = _source_of(self._shader, "ior")
        if isinstance(ior, _Texture):
            raise Error("ior has a texture", "input")
        given, self._model_texture = {}, None
        sizes = {}
        for name, source in sources.items():
            if isinstance(source, _Texture):
                values = _read(source)
                sizes[name] = values.shape[:2]
                self._model_texture = self._model_texture or source
                given[self._takes[name]] = values if name != "metallic" else values[..., 0]
            else:
                given[self._takes[name]] = source if len(source) > 1 else source[0]
        if len(set(sizes.values())) > 1:
            shown = ", ".join(f"{name} {width}x{height}" for name, (height, width) in sizes.items())
            raise Error(f"its textures differ in size: {shown}", "input")
        for name, values in list(given.items()):  # a map of colors beside a grey one
            if isinstance(values, np.ndarray) and name != "metallic" and values.shape[-1] == 1:
                given[name] = np.ascontiguousarray(values.repeat(3, axis=-1))
        ends = ("specular", "usd-preview-surface") if self._is_to_metallic else ("usd-preview-surface", "specular")
        converter = Converter(*ends, diffuse_convention="plain", dielectric_f0=min(_f0(ior[0]), 0.9))
        result = converter.convert(roughness=_ROUGHNESS, **given)
        self._converted = {name: np.atleast_3d(result[parameter]) if sizes else np.ravel(result[parameter])
                           for name, parameter in self._makes.items()}
        return self

    def _file(self, name):
        words = str(self._material.GetPath()).strip("/").replace("/", "_")
        return os.path.join(self._folder, f"{words}_{name}.png")

    def textures(self):
        return [self._file(name) for name, values in self._converted.items() if self._is_map(values)]

    @staticmethod
    def _is_map(values):
        return values.ndim == 3 and not (values == values[:1, :1]).all()

    def author(self, stage):
        """Writes it into the edit target of ``stage``."""
        shader = UsdShade.Shader(stage.GetPrimAtPath(self._shader.GetPath()))
        for name, values in self._converted.items():
            is_color = name != "metallic"
            kind = Sdf.ValueTypeNames.Color3f if is_color else Sdf.ValueTypeNames.Float
            target = shader.CreateInput(name, kind)
            if self._is_map(values):
                target.ConnectToSource(self._texture_output(stage, name, values, is_color))
                continue
            constant = values.reshape(-1, values.shape[-1])[0] if values.ndim == 3 else values
            numbers = [float(number) for number in constant]
            target.GetAttr().SetConnections([])
            target.Set(Gf.Vec3f(*(numbers * 3)[:3]) if is_color else numbers[0])
        workflow = shader.CreateInput("useSpecularWorkflow", Sdf.ValueTypeNames.Int)
        workflow.GetAttr().SetConnections([])
        workflow.Set(0 if self._is_to_metallic else 1)

    def _texture_output(self, stage, name, values, is_color):
        file = self._file(name)
        _write(file, values if is_color else values[..., :1], is_color)
        path = self._material.GetPath().AppendChild(f"texremap_{name}")
        node = UsdShade.Shader.Define(stage, path)
        node.CreateIdAttr("UsdUVTexture")
        layer = os.path.dirname(stage.GetEditTarget().GetLayer().realPath)
        relative = os.path.relpath(file, layer).replace(os.sep, "/")
        node.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(Sdf.AssetPath("./" + relative))
        node.CreateInput("sourceColorSpace", Sdf.ValueTypeNames.Token).Set("sRGB" if is_color else "raw")
        for word, kind in (("wrapS", Sdf.ValueTypeNames.Token), ("wrapT", Sdf.ValueTypeNames.Token)):
            value = _shader_value(self._model_texture.shader, word, None)
            if value is not None:
                node.CreateInput(word, kind).Set(value)
        place = self._model_texture.shader.GetInput("st")
        if place and place.HasConnectedSource():
            node.CreateInput("st", Sdf.ValueTypeNames.Float2).ConnectToSource(place.GetConnectedSources()[0][0])
        kind = Sdf.ValueTypeNames.Float3 if is_color else Sdf.ValueTypeNames.Float
        return node.CreateOutput("rgb" if is_color else "r", kind)


def _surface_of(material):
    shader, *_ = material.ComputeSurfaceSource()
    return shader if shader and shader.GetIdAttr().Get() == "UsdPreviewSurface" else None


def _plan(stage, is_to_metallic, folder):
    """An edit or a :class:`MaterialReport` for each material."""
    for prim in Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies()):
        if not prim.IsA(UsdShade.Material):
            continue
        path, material = str(prim.GetPath()), UsdShade.Material(prim)
        shader = _surface_of(material)
        if shader is None:
            yield MaterialReport(path, "left", "its surface is no UsdPreviewSurface")
            continue
        try:
            given = shader.GetInput("useSpecularWorkflow")
            attributes = UsdShade.Utils.GetValueProducingAttributes(given) if given else []
            is_specular = bool(attributes[0].Get()) if attributes else False
            if is_specular != is_to_metallic:
                yield MaterialReport(path, "left", "has that workflow already")
            elif prim.IsInstanceProxy():
                yield MaterialReport(path, "failed", "lies in an instance, where a layer has no say")
            else:
                yield path, _MaterialEdit(material, shader, is_to_metallic, folder).convert()
        except (Error, ValueError, ImportError) as failure:
            yield MaterialReport(path, "failed", str(failure))


def _reason_of(source, text):
    """A message with the place in the file, from USD's errors, each of which is `Error in FUNCTION at LINE in SOURCE : 'WHAT'`."""
    if not os.path.exists(source):
        return f"{source}: cannot be read: file not found"
    first = re.search(r" : '([^\n]*)", text)
    what = first[1].rstrip("'") if first else text.strip().split("\n")[0] or "unknown reason"
    what = re.sub(r"\bpxrInternal_\w+::(\w+::)*", "", what)
    at = re.match(re.escape(os.path.abspath(source)) + r"(:\d+:\d+): (.*)", what)
    return f"{source}{at[1]}: cannot be read: {at[2]}" if at else f"{source}: cannot be read: {what}"


def convert(source: Union[str, "os.PathLike[str]"], output: Union[str, "os.PathLike[str]"], *, to: str = "metallic",
            force: bool = False, dry_run: bool = False) -> List[MaterialReport]:
    """Converts every UsdPreviewSurface of ``source`` into a new layer ``output``, which sublayers ``source``.

    to: ``"metallic"`` or ``"specular"``. Textures are written into the folder ``STEM_textures`` beside ``output``; a
    result that is the same everywhere becomes a value. Roughness, opacity and all else stay. A material that cannot be
    converted stays as it is and is named; others go on.

    Returns a list of :class:`MaterialReport`. Raises :class:`Error`.
    """
    source, output = os.fspath(source), os.fspath(output)
    if to not in ("metallic", "specular"):
        raise Error(f"to: unknown workflow '{to}' (choose metallic or specular)")
    if os.path.splitext(output)[1] not in (".usda", ".usdc", ".usd"):
        raise Error(f"{output}: a layer is .usda, .usdc or .usd", "output")
    if os.path.exists(output) and os.path.exists(source) and os.path.samefile(source, output):
        raise Error(f"{output}: is the input (choose another name)", "output")
    if os.path.exists(output) and not force:
        raise Error(f"{output}: exists (use --force to replace it)", "output")
    try:
        stage = Usd.Stage.Open(source)
    except Exception as failure:  # Tf.ErrorException
        raise Error(_reason_of(source, str(failure)), "input") from None

    folder = os.path.splitext(output)[0] + "_textures"
    reports, edits = [], []
    for found in _plan(stage, to == "metallic", folder):
        if isinstance(found, MaterialReport):
            reports.append(found)
        else:
            path, edit = found
            edits.append(edit)
            reports.append(MaterialReport(path, "converted", "", tuple(edit.textures())))
    if dry_run:
        return reports
    _write_layer(stage.GetRootLayer(), edits, output, folder)
    return reports


def _write_layer(root, edits, output, folder):
    """Authors the edits into a new file, which becomes ``output``."""
    parent = os.path.dirname(os.path.abspath(output))
    try:
        os.makedirs(folder if any(edit.textures() for edit in edits) else parent, exist_ok=True)
        with replacing(os.path.abspath(output)) as unfinished:
            saved = Sdf.Layer.CreateNew(unfinished)
            relative = os.path.relpath(root.realPath, parent).replace(os.sep, "/")
            saved.subLayerPaths[:] = [relative if relative.startswith("../") else "./" + relative]
            for name in _STAGE_METADATA:
                if root.pseudoRoot.HasInfo(name):
                    saved.pseudoRoot.SetInfo(name, root.pseudoRoot.GetInfo(name))
            target = Usd.Stage.Open(saved)
            for edit in edits:
                edit.author(target)
            saved.Save()
    except OSError as failure:
        raise Error(f"{output}: cannot be written: {failure.strerror}", "output") from None


def main(words: Optional[List[str]] = None) -> int:
    options = usd_parser().parse_args(words)
    try:
        reports = convert(options.source, options.output, to=options.to, force=options.force, dry_run=options.dry_run)
    except Error as failure:
        print(f"texremap: {failure}", file=sys.stderr)
        return 2 if failure.kind == "usage" else 1
    for report in reports:
        if options.json:
            print(json.dumps(report._asdict()))
        else:
            more = f": {report.reason}" if report.reason else "".join(f", {file}" for file in report.textures)
            print(f"texremap: {report.path}: {report.state}{more}", file=sys.stderr)
    counts = [sum(report.state == state for report in reports) for state in ("converted", "left", "failed")]
    if not options.json:
        print("texremap: {}: {} converted, {} left, {} failed".format(options.output, *counts), file=sys.stderr)
    return 1 if counts[2] else 0
