"""Materials of USD files: UsdPreviewSurface to OpenPBR and back, and between the metallic and the specular
workflow.

This needs usd-core (the extra ``usd``). Materials with textures also need OpenImageIO (the extra ``images``).
The result is a new layer that sublayers the old one, which does not change:
``texremap usd scene.usda --to openpbr -o scene_openpbr.usda``.
"""

import os
import re
from typing import List, NamedTuple, Optional, Tuple, Union

import numpy as np

from . import materials
from ._edit import Edit, losses
from ._error import Error
from ._files import replacing
from ._networks import Procedural
from ._options import USD_TARGETS as TARGETS, usd_parser
from ._surface import MaterialReport, require_output, run
from ._textures import Texture, tiles_of

try:
    from pxr import Gf, Sdf, Usd, UsdShade
except ImportError as failure:
    raise ImportError(f"USD files cannot be read: {failure} (pip install usd-core)") from failure

from ._usd_networks import OPEN_PBR_ID, PreviewNodes, SurfaceNodes, source_of, value_of

# A layer does not inherit this metadata of the stage from its sublayers.
_STAGE_METADATA = ("defaultPrim", "upAxis", "metersPerUnit", "kilogramsPerUnit", "timeCodesPerSecond", "framesPerSecond",
                   "startTimeCode", "endTimeCode", "autoPlay", "colorConfiguration", "colorManagementSystem")
_PREVIEW, _OPEN_PBR = "UsdPreviewSurface", "open_pbr_surface"
_INTEGERS = {"useSpecularWorkflow", "opacityMode"}
_ROUGHNESS = 0.5  # any: both ends of a workflow share a BRDF, so that roughness stays


class _Direction(NamedTuple):
    """The inputs that a conversion reads and writes."""

    reads: str  # the model
    writes: str
    takes: Tuple[str, ...]  # inputs that are read
    makes: Tuple[str, ...]  # inputs that are written
    lost: Tuple[str, ...]  # inputs that are not converted


def _workflow(takes, makes):
    return _Direction(_PREVIEW, _PREVIEW, takes, makes, ())


_SPECULAR = ("diffuseColor", "specularColor")
_METALLIC = ("diffuseColor", "metallic")
_DIRECTIONS = {
    "openpbr": _Direction(_PREVIEW, _OPEN_PBR, tuple(materials.MODELS[_PREVIEW]), tuple(materials.MODELS[_OPEN_PBR]),
                          materials.IGNORED[_PREVIEW, _OPEN_PBR]),
    "preview": _Direction(_OPEN_PBR, _PREVIEW, tuple(materials.MODELS[_OPEN_PBR]), tuple(materials.MODELS[_PREVIEW]),
                          materials.IGNORED[_OPEN_PBR, _PREVIEW]),
    "metallic": _workflow(_SPECULAR + ("ior",), _METALLIC),
    "specular": _workflow(_METALLIC + ("ior",), _SPECULAR),
}


def _workflow_translation(to):
    """Returns the conversion between workflows as a translation: a function of a dict of arrays."""
    from .arrays import Converter

    names = {"specular": {"diffuseColor": "diffuse", "specularColor": "specular"},
             "metallic": {"diffuseColor": "base_color", "metallic": "metallic"}}
    start = "specular" if to == "metallic" else "metallic"
    ends = (("plain:specular", "plain:usd-preview-surface") if to == "metallic"
            else ("plain:usd-preview-surface", "plain:specular"))

    def translate(given):
        f0 = ((1 - float(np.ravel(given["ior"])[0])) / (1 + float(np.ravel(given["ior"])[0]))) ** 2
        converter = Converter(*ends, dielectric_f0=min(f0, 0.9))
        count = max(np.size(given[name]) // (1 if name == "metallic" else 3) for name in names[start])
        arrays = {}
        for name, word in names[start].items():
            channels = 1 if name == "metallic" else 3
            values = np.broadcast_to(np.asarray(given[name], np.float32), (count, channels))
            arrays[word] = np.ascontiguousarray(values[:, 0] if channels == 1 else values)
        result = converter.convert(roughness=_ROUGHNESS, **arrays)
        return {name: np.asarray(result[word]).reshape(count, -1) for name, word in names[to].items()}

    return translate


class _MaterialEdit:
    """The conversion of one material of the source."""

    def __init__(self, material, shader, to, translate, folder):
        self._material, self._shader, self._to, self._folder = material, shader, to, folder
        self._direction, self._normals, self.lost = _DIRECTIONS[to], {}, []
        sources = self._sources()
        if self._direction.writes != self._direction.reads:
            self._find_normals()
            self.lost += losses(self._direction.reads, self._direction.lost, sources)
            if to == "preview" and shader.GetInput("geometry_coat_normal"):
                self.lost.append("geometry_coat_normal")
        self._edit = Edit(self._direction.reads, sources, self._direction.makes, translate)
        words = str(material.GetPath()).strip("/").replace("/", "_")
        self._edit.put_into_files(lambda name: os.path.join(folder, f"{words}_{name}.png"))

    def _sources(self):
        sources, defaults = {}, materials.MODELS[self._direction.reads]
        for name in self._direction.takes:
            default = defaults[name] if isinstance(defaults[name], tuple) else (defaults[name],)
            try:
                sources[name] = source_of(self._shader, name, default)
            except Procedural as failure:
                if self._direction.reads == self._direction.writes:
                    raise
                self.lost.append(failure.words_about(name))
                sources[name] = default
            if isinstance(sources[name], Texture) and name == "ior":
                raise Error("ior has a texture, but must be a number", "input")
        return sources

    def _find_normals(self):
        names = {"openpbr": {"normal": ("geometry_normal", "geometry_coat_normal")},
                 "preview": {"geometry_normal": ("normal",)}}[self._to]
        for name, targets in names.items():
            try:
                source = source_of(self._shader, name, None)
            except Procedural as failure:
                self.lost.append(failure.words_about(name))
                continue
            if isinstance(source, Texture):
                tiles_of(source.path, name)
                for target in targets:
                    self._normals[target] = source

    def textures(self):
        return [os.path.relpath(path) if not os.path.isabs(self._folder) else path for path, *_ in self._edit.files()]

    def write_textures(self):
        self._edit.write_files()

    def author(self, stage):
        """Writes the material into the edit target of ``stage``."""
        nodes = (SurfaceNodes if self._direction.writes == _OPEN_PBR else PreviewNodes)(stage, self._material)
        shader = self._target_shader(stage, nodes)
        for name in self._direction.makes:
            kind = self._type_of(name)
            if name in self._edit.textures:
                shader.CreateInput(name, kind).ConnectToSource(nodes.texture(name, self._edit.textures[name]))
            elif name in self._edit.values:
                self._set(shader, name, kind, self._edit.values[name])
        for name, texture in self._normals.items():
            kind = Sdf.ValueTypeNames.Normal3f if self._direction.writes == _PREVIEW else Sdf.ValueTypeNames.Float3
            shader.CreateInput(name, kind).ConnectToSource(nodes.normal("normal", texture))
        if self._direction.reads == self._direction.writes:
            self._set(shader, "useSpecularWorkflow", Sdf.ValueTypeNames.Int, [0 if self._to == "metallic" else 1])

    def _target_shader(self, stage, nodes):
        material = UsdShade.Material(stage.OverridePrim(self._material.GetPath()))
        if self._direction.reads == self._direction.writes:
            return UsdShade.Shader(stage.GetPrimAtPath(self._shader.GetPath()))
        if self._direction.writes == _OPEN_PBR:
            shader, _ = nodes.shader("surface", "OpenPBR", OPEN_PBR_ID)
            # The schema is not in every build of USD.
            material.GetPrim().AddAppliedSchema("MaterialXConfigAPI")
            version = material.GetPrim().CreateAttribute("config:mtlx:version", Sdf.ValueTypeNames.String, False)
            version.Set("1.39")
            surface = material.CreateSurfaceOutput("mtlx")
        else:
            shader, _ = nodes.shader("surface", "PreviewSurface", "UsdPreviewSurface")
            surface = material.CreateSurfaceOutput()
        word = "out" if self._direction.writes == _OPEN_PBR else "surface"
        surface.ConnectToSource(shader.CreateOutput(word, Sdf.ValueTypeNames.Token))
        return shader

    def _type_of(self, name):
        default = materials.MODELS[self._direction.writes][name]
        if isinstance(default, tuple):
            return Sdf.ValueTypeNames.Color3f
        if name == "geometry_thin_walled":
            return Sdf.ValueTypeNames.Bool
        return Sdf.ValueTypeNames.Int if name in _INTEGERS else Sdf.ValueTypeNames.Float

    def _set(self, shader, name, kind, values):
        numbers = [float(f"{float(number):.7g}") for number in values]
        default = np.ravel(materials.MODELS[self._direction.writes][name])
        is_new = self._direction.reads != self._direction.writes
        if is_new and np.allclose(numbers, default, atol=1e-7):
            return
        given = shader.CreateInput(name, kind)
        if not is_new:
            given.GetAttr().SetConnections([])
        if kind == Sdf.ValueTypeNames.Color3f:
            given.Set(Gf.Vec3f(*(numbers * 3)[:3]))
        else:
            given.Set({Sdf.ValueTypeNames.Int: int, Sdf.ValueTypeNames.Bool: bool}.get(kind, float)(numbers[0]))


def _surface(material, context, identity):
    """Returns the shader of a render context if its identifier is ``identity``, otherwise None."""
    output = material.GetSurfaceOutput(context) if context else material.GetSurfaceOutput()
    if not output:
        return None
    attributes = UsdShade.Utils.GetValueProducingAttributes(output)
    shader = UsdShade.Shader(attributes[0].GetPrim()) if attributes else None
    return shader if shader and shader.GetIdAttr().Get() == identity else None


def _reason_to_leave(prim, to):
    """Returns the shader to convert, and the reason why it is not converted, or an empty text."""
    material = UsdShade.Material(prim)
    preview, paint = _surface(material, "", _PREVIEW), _surface(material, "mtlx", OPEN_PBR_ID)
    if to == "openpbr" and material.GetSurfaceOutput("mtlx"):
        return None, "it has a surface of MaterialX already"
    if to == "preview":
        return paint, "it has a UsdPreviewSurface already" if preview else "" if paint else "its surface is not an OpenPBR of MaterialX"
    if preview is None:
        return None, "its surface is not a UsdPreviewSurface"
    if to == "openpbr":
        return preview, ""
    given = preview.GetInput("useSpecularWorkflow")
    attributes = UsdShade.Utils.GetValueProducingAttributes(given) if given else []
    is_specular = bool((value_of(attributes[0]) or (0,))[0]) if attributes else False
    return preview, "" if is_specular == (to == "metallic") else "it has that workflow already"


def _plan(stage, to, folder):
    """Yields an edit or a :class:`MaterialReport` for each material."""
    translate = (materials.TRANSLATIONS[_DIRECTIONS[to].reads, _DIRECTIONS[to].writes] if to in ("openpbr", "preview")
                 else _workflow_translation(to))
    for prim in Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies()):
        if not prim.IsA(UsdShade.Material):
            continue
        path = str(prim.GetPath())
        try:
            shader, reason = _reason_to_leave(prim, to)
            if reason:
                yield MaterialReport(path, "left", reason)
            elif prim.IsInstanceProxy():
                yield MaterialReport(path, "failed", "it lies in an instance, which a layer cannot change")
            else:
                yield path, _MaterialEdit(UsdShade.Material(prim), shader, to, translate, folder)
        except (Error, ValueError, ImportError) as failure:
            yield MaterialReport(path, "failed", str(failure))


def _reason_of(source, text):
    """Returns a message with the place in the file. Each of USD's errors is `Error in FUNCTION at LINE in
    SOURCE : 'WHAT'`."""
    if not os.path.exists(source):
        return f"{source}: cannot be read: file not found"
    first = re.search(r" : '([^\n]*)", text)
    what = first[1].rstrip("'") if first else text.strip().split("\n")[0] or "unknown reason"
    what = re.sub(r"\bpxrInternal_\w+::(\w+::)*", "", what)
    at = re.match(re.escape(os.path.abspath(source)) + r"(:\d+:\d+): (.*)", what)
    return f"{source}{at[1]}: cannot be read: {at[2]}" if at else f"{source}: cannot be read: {what}"


def convert(source: Union[str, "os.PathLike[str]"], output: Union[str, "os.PathLike[str]"], *, to: str,
            force: bool = False, dry_run: bool = False) -> List[MaterialReport]:
    """Converts the materials of ``source`` into a new layer ``output``, which sublayers ``source``.

    to: ``"openpbr"`` adds an OpenPBR surface of MaterialX to each UsdPreviewSurface. ``"preview"`` adds a
        UsdPreviewSurface to each OpenPBR surface. ``"metallic"`` and ``"specular"`` change the workflow of each
        UsdPreviewSurface.

    If a result differs from a texture only by a scale and a bias, this texture is used. All other textures are
    written into the folder ``STEM_textures`` beside ``output``. A result that is the same everywhere becomes a
    value. A material that cannot be converted does not change and is reported, and the other materials are
    still converted.

    Returns a list of :class:`MaterialReport`. Raises :class:`Error`.
    """
    source, output = os.fspath(source), os.fspath(output)
    if to not in TARGETS:
        raise Error(f"to: unknown target '{to}' (choose {', '.join(TARGETS[:-1])} or {TARGETS[-1]})")
    require_output(source, output, (".usda", ".usdc", ".usd"), force)
    try:
        stage = Usd.Stage.Open(source)
    except Exception as failure:  # Tf.ErrorException
        raise Error(_reason_of(source, str(failure)), "input") from None

    folder = os.path.splitext(output)[0] + "_textures"
    reports, edits = [], []
    for found in _plan(stage, to, folder):
        if isinstance(found, MaterialReport):
            reports.append(found)
        else:
            path, edit = found
            edits.append(edit)
            reports.append(MaterialReport(path, "converted", "", tuple(edit.textures()), tuple(edit.lost)))
    if dry_run:
        return reports
    _write_layer(stage.GetRootLayer(), edits, output, folder)
    return reports


def _write_layer(root, edits, output, folder):
    """Writes the edits into a new file, which becomes ``output``."""
    parent = os.path.dirname(os.path.abspath(output))
    try:
        os.makedirs(folder if any(edit.textures() for edit in edits) else parent, exist_ok=True)
        for edit in edits:
            edit.write_textures()
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
    return run(lambda: convert(options.source, options.output, to=options.to, force=options.force, dry_run=options.dry_run),
               options.output, options.json)
