"""Materials between MaterialX documents and glTF files: OpenPBR, standard_surface, glTF.

MaterialX documents need MaterialX (the extra ``materialx``). Materials whose textures change also need
OpenImageIO (the extra ``images``): ``texremap mtlx paint.mtlx --to gltf -o paint.glb``.
"""

import os
import tempfile
from typing import List, Optional, Union

from . import materials
from ._edit import Edit, losses
from ._error import Error
from ._gltf import EXTENSIONS, STRENGTH, TRANSFORM, GltfReader
from ._gltf_writer import GltfWriter
from ._options import MTLX_READERS, MTLX_TARGETS, mtlx_parser
from ._surface import MaterialReport, require_output, run
from ._textures import Texture

_HUB, _GLTF = "open_pbr_surface", "gltf_pbr"
_MODELS = dict(zip(MTLX_TARGETS, (_HUB, "standard_surface", _GLTF)))
_GLTF_ENDINGS = (".glb", ".gltf")
# These are the extensions that importers read: none for the core of glTF, two for Godot 4 (modules/gltf/gltf_document.cpp).
_ALLOWED = {"core": frozenset(), "godot": frozenset({STRENGTH, TRANSFORM})}


class _Route:
    """The translations that lead from one model to another."""

    def __init__(self, start, end, fold):
        steps = [start, end] if start == end or _HUB in (start, end) else [start, _HUB, end]
        if start == end:
            steps = [start]
        self._steps = list(zip(steps, steps[1:])) + ([(_GLTF, _GLTF + "_core")] if fold else [])

    def __call__(self, values):
        for step in self._steps:
            values = materials.TRANSLATIONS[step](values)
        return values if self._steps else dict(values)

    def losses(self, sources):
        """Returns the inputs of each step that its translation ignores."""
        lost = []
        for number, step in enumerate(self._steps):
            if number:
                sources = materials.TRANSLATIONS[self._steps[number - 1]]({
                    name: value for name, value in sources.items() if not isinstance(value, Texture)})
            lost += [name for name in losses(step[0], materials.IGNORED[step], sources) if name not in lost]
        return lost


def _reader_of(source, folder):
    ending = os.path.splitext(source)[1].lower()
    if ending in _GLTF_ENDINGS:
        return GltfReader(source, folder)
    if ending != ".mtlx":
        raise Error(f"{source}: is not a .mtlx, .glb or .gltf file (for USD: texremap usd)", "input")
    from ._mtlx import MtlxReader

    return MtlxReader(source, folder)


def _writer_of(output, reader, model, importer):
    if model == _GLTF and output.lower().endswith(_GLTF_ENDINGS):
        allowed = _ALLOWED[importer] if importer else frozenset({*EXTENSIONS, TRANSFORM})
        return GltfWriter(output, allowed, reader if isinstance(reader, GltfReader) else None)
    from ._mtlx import MtlxWriter

    return MtlxWriter(output, model, reader)


def _converted(reader, writer, index, model, importer):
    """Converts one material and gives it to the writer. Returns the report."""
    name = reader.name_of(index)
    try:
        reason = reader.reason_to_leave(index, _ALLOWED.get(importer))
        if reason:
            return MaterialReport(name, "left", reason)
        surface = reader.surface(index)
        route = _Route(surface.model, model, importer)
        lost = [*surface.lost, *route.losses(surface.sources)]
        edit = Edit(surface.model, surface.sources, tuple(materials.MODELS[model]), route, model)
        textures, more = writer.add(name, edit, surface.normals, index)
        return MaterialReport(name, "converted", "", textures, (*lost, *more))
    except (Error, ValueError, ImportError, OSError) as failure:
        return MaterialReport(name, "failed", str(failure))


def convert(source: Union[str, "os.PathLike[str]"], output: Union[str, "os.PathLike[str]"], *, to: str, importer: Optional[str] = None,
            force: bool = False, dry_run: bool = False) -> List[MaterialReport]:
    """Converts the materials of ``source`` into a new document ``output``. Both are .mtlx, .glb or .gltf files.

    to: ``"openpbr"``, ``"standard-surface"`` or ``"gltf"``. A glTF file can only hold ``"gltf"``.
    importer: ``"core"`` or ``"godot"``. Inputs that such an importer of glTF ignores are converted to inputs
        that it reads.

    If a result differs from a texture only by a scale (in MaterialX also by a bias), this texture is used. All
    other textures are written into the GLB file, or into the folder ``STEM_textures`` beside ``output``. From
    glTF to glTF, all other contents are kept. A material that cannot be converted is left out, and the other
    materials are still converted.

    Returns a list of :class:`MaterialReport`. Raises :class:`Error`.
    """
    source, output = os.fspath(source), os.fspath(output)
    if to not in MTLX_TARGETS:
        raise Error(f"to: unknown target '{to}' (choose {', '.join(MTLX_TARGETS[:-1])} or {MTLX_TARGETS[-1]})")
    if importer not in (None, *MTLX_READERS):
        raise Error(f"for: unknown importer '{importer}' (choose {' or '.join(MTLX_READERS)})")
    is_gltf = [path.lower().endswith(_GLTF_ENDINGS) for path in (source, output)]
    if to != "gltf" and is_gltf[1]:
        raise Error(f"{output}: a glTF file cannot hold {to} (use --to gltf, or an output name *.mtlx)", "output")
    if importer and not is_gltf[1]:
        raise Error(f"{output}: --for {importer} applies only to glTF files (use an output name *.glb or *.gltf)", "output")
    require_output(source, output, (".mtlx", ".glb", ".gltf"), force)
    if all(is_gltf) and not importer:
        raise Error(f"{source}: is glTF already (choose --for {' or --for '.join(MTLX_READERS)}, or use an output name *.mtlx)", "output")
    with tempfile.TemporaryDirectory(prefix="texremap-") as folder:
        reader = _reader_of(source, folder)
        if not reader.materials:
            raise Error(f"{source}: has no materials", "input")
        writer = _writer_of(output, reader, _MODELS[to], importer)
        reports = [_converted(reader, writer, index, _MODELS[to], importer) for index in range(len(reader.materials))]
        kept = ("converted", "left") if all(is_gltf) else ("converted",)  # a copy also has what is left
        if not dry_run and any(report.state in kept for report in reports):
            try:
                writer.save(force)
            except OSError as failure:
                raise Error(f"{output}: cannot be written: {failure.strerror}", "output") from None
    return reports


def main(words: Optional[List[str]] = None) -> int:
    options = mtlx_parser().parse_args(words)
    return run(lambda: convert(options.source, options.output, to=options.to, importer=options.importer, force=options.force,
                               dry_run=options.dry_run), options.output, options.json)
