"""Converters over NumPy arrays."""

import functools
import os
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._error import Error

_COLORS = {"specular", "diffuse", "base_color", "residual"}
_SURELY_NO_FRACTION = 2  # from here on a value is not a fraction
_LOOKED_AT = 64  # values of each axis of an array
_MEASURES = ("residual", "metallic_uncertainty", "issues")


Map = Union[npt.NDArray[Any], float]
Color = Union[npt.NDArray[Any], float, Tuple[float, float, float], List[float]]


class Model(NamedTuple):
    """A name that ``source`` and ``target`` take."""

    name: str
    kind: str
    """``"brdf"`` (roughness and specular), or a workflow of whole materials: ``"specular"`` or ``"metallic"``."""
    roughness: str
    """What its roughness is: ``"alpha"``, ``"roughness"``, ``"glossiness"``, ``"exponent"`` or ``"squared"``."""
    specular: str
    """``"f0"``, or ``"specular"`` for a plain scale."""
    meaning: str
    aliases: Tuple[str, ...]


class Path(NamedTuple):
    """The converters from one model to another."""

    models: Tuple[str, ...]
    steps: Tuple[str, ...]
    """Ids of the converters; none where both ends share a BRDF."""
    expected_error: float
    """The expected RMS difference of the pictures, relative to the source's."""
    picture_difference: Optional[float]
    """How far pictures differ: RMSE of display values in per cent; None where nobody has compared them."""
    closer: Optional[str]
    """Another model of the target's renderer that looks closer; else None."""


class Counts(NamedTuple):
    """How many texels were unusual; each counts once in every field that applies."""

    texels: int = 0
    out_of_domain: int = 0
    nan: int = 0
    infinite: int = 0
    negative: int = 0
    above_one: int = 0
    clipped: int = 0
    """Values, not texels, that a whole-number result clipped."""
    first_bad: Optional[Tuple[int, ...]] = None
    """The index of the first texel with NaN, an infinity or a negative value."""


class Material(Dict[str, npt.NDArray[Any]]):
    """Results by the names of parameters, also as attributes, and their ``counts``."""

    counts: Counts

    def __getattr__(self, name: str) -> npt.NDArray[Any]:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"the result has no {name} (it has {', '.join(self)})") from None


def models() -> List[Model]:
    """All names that ``source`` and ``target`` take, as a list of :class:`Model`.

    >>> [model.name for model in models() if model.kind == "metallic"][:2]
    ['gltf', 'cycles-5/principled']
    """
    return [Model(*fields) for fields in _core.models()]


def path(source: str, target: str, **options: Any) -> Path:
    """How closely ``target`` can look like ``source``: a :class:`Path`. ``options`` as of :class:`Converter`.

    >>> path("mitsuba/ward", "mitsuba/as").steps
    ('mitsuba_ward_to_mitsuba_as',)
    """
    return Converter(source, target, **options).path


class Converter:
    """Converts arrays of ``source`` into arrays of ``target``; see :func:`convert` for the arrays.

    source, target: names of :func:`models`; as target also a renderer (``"cycles-5"``), which stands for the closest of
        its models. ``"specular:mitsuba/ward"`` and ``"metallic:mitsuba/ward"`` are layers over a BRDF model.
    via: models that the path visits, in this order.
    diffuse_convention: ``"plain"`` or ``"scaled"`` (glTF: times 1 - max(specular)), where a model leaves it open.
    dielectric_f0: F0 of dielectrics in metallic workflows, 0 to 0.9; by default the model's own (0.04 for glTF).
    metallic_bias: of the projection to metallic, 0 to 1; 1e-6 for clean maps, 1e-5 for noisy ones.
    converters: a file that ``remapc emit --all`` wrote, a fit, or a folder of fits, in place of the shipped ones.
    instructions: ``"baseline"``, ``"avx2"`` or ``"avx512"``; every set gives the same bits.

    A converter may be used by many threads at a time. Raises :class:`Error`.
    """

    def __init__(self, source: str, target: str, *, via: Optional[Iterable[str]] = None,
                 diffuse_convention: Optional[str] = None, dielectric_f0: Optional[float] = None,
                 metallic_bias: Optional[float] = None, converters: Union[str, "os.PathLike[str]", None] = None,
                 instructions: Optional[str] = None) -> None:
        request = {
            "source": source, "target": target, "via": None if via is None else list(via),
            "diffuse_convention": diffuse_convention, "dielectric_f0": dielectric_f0, "metallic_bias": metallic_bias,
            "converters": None if converters is None else os.fspath(converters), "instructions": instructions,
        }
        self._hold(_core.Conversion(request))

    @classmethod
    def load(cls, file: Union[str, "os.PathLike[str]"], *, source_workflow: Optional[str] = None) -> "Converter":
        """The converter of a fit or a warp in JSON, as ``remapc fit`` and ``remapc warp`` write them.

        A warp takes the specular workflow, or the metallic one if ``source_workflow`` says so.
        """
        converter = cls.__new__(cls)
        converter._hold(_core.Conversion.load(os.fspath(file), source_workflow))
        return converter

    def _hold(self, conversion):
        self._conversion = conversion
        self._about = conversion.describe()

    def __repr__(self) -> str:
        return f"<texremap.Converter {self.source} to {self.target}>"

    @property
    def source(self) -> str:
        """The name of the source."""
        return self._about["source"]

    @property
    def target(self) -> str:
        """The name of the target."""
        return self._about["target"]

    @property
    def sources(self) -> Tuple[str, ...]:
        """The parameters that it takes."""
        return tuple(self._about["sources"])

    @property
    def targets(self) -> Tuple[str, ...]:
        """The parameters that it can make."""
        return tuple(self._about["targets"])

    @property
    def roughness_encoding(self) -> str:
        """What the source's roughness is."""
        return self._about["roughness_encoding"]

    @property
    def output_encoding(self) -> str:
        """What the target's roughness is."""
        return self._about["output_encoding"]

    @property
    def roughness_domain(self) -> Tuple[float, float]:
        """The covered range of the BRDF's own roughness parameter."""
        return self._about["roughness_domain"]

    @property
    def specular_domain(self) -> Tuple[float, float]:
        """The covered range of its specular."""
        return self._about["specular_domain"]

    @property
    def instructions(self) -> str:
        """The instruction set that it runs on."""
        return self._about["instructions"]

    @property
    def notes(self) -> Tuple[str, ...]:
        """What the given names mean."""
        return tuple(self._about["notes"])

    @property
    def assumptions(self) -> Tuple[str, ...]:
        """What had to be assumed."""
        return tuple(self._about["assumptions"])

    @property
    def path(self) -> Path:
        """The :class:`Path` of its BRDF."""
        about = self._about
        return Path(tuple(about["models"]), tuple(about["steps"]), about["expected_error"], about["picture_difference"],
                    about["closer"])

    def convert(self, *, roughness: Optional[Map] = None, glossiness: Optional[Map] = None,
                specular: Optional[Color] = None, diffuse: Optional[Color] = None, base_color: Optional[Color] = None,
                metallic: Optional[Map] = None, metal_mask: Optional[Map] = None,
                roughness_encoding: Optional[str] = None, output_encoding: Optional[str] = None,
                transfer: Union[str, Mapping[str, str], None] = None, dtype: Optional[npt.DTypeLike] = None,
                out: Optional[Mapping[str, npt.NDArray[Any]]] = None, measures: Iterable[str] = (), outside: bool = False,
                bad_texels: str = "keep", dither: bool = False, threads: int = 1) -> Material:
        """As :func:`convert`, without the names of the models."""
        given = {"roughness": roughness, "specular": specular, "diffuse": diffuse, "base_color": base_color,
                 "metallic": metallic, "metal_mask": metal_mask}
        source_encoding = self._width_encoding(given, glossiness, roughness_encoding)
        arrays = {name: value for name, value in given.items() if value is not None}
        self._require(arrays)
        maps = _Maps(arrays, transfer)
        self._require_fractions(maps, source_encoding)
        width_out = output_encoding or self.output_encoding
        result_names = {"roughness": "glossiness" if width_out == "glossiness" else "roughness"}
        result = maps.results(self._made(maps, measures), result_names, dtype, dict(out or {}), transfer)
        mask = np.zeros(maps.shape, np.bool_) if outside else None
        options = {
            "source_transfers": maps.transfers, "target_transfers": result.transfers,
            "roughness_encoding": source_encoding, "output_encoding": width_out, "bad_texels": bad_texels,
            "dither": bool(dither), "threads": _thread_count(threads),
        }
        material = Material((result_names.get(name, name), array) for name, array in result.arrays.items())
        if outside:
            material["outside"] = mask
        material.counts = _run(self._conversion, maps, result, mask, options)
        return material

    def _width_encoding(self, given, glossiness, encoding):
        """The convention of the source's width. ``roughness`` means roughness even for a model that takes glossiness."""
        if glossiness is not None:
            if given["roughness"] is not None or encoding is not None:
                raise Error("glossiness cannot be given with roughness or roughness_encoding")
            given["roughness"] = glossiness
            return "glossiness"
        if encoding is not None:
            return encoding
        return "roughness" if self.roughness_encoding == "glossiness" else self.roughness_encoding

    def _require(self, arrays):
        takes = set(self.sources) | ({"metal_mask"} if "residual" in self.targets else set())
        for name in arrays:
            if name not in takes:
                raise Error(f"{name}: {self.source} has no such parameter (give {', '.join(self.sources)})")
        for name in self.sources:
            if name not in arrays:
                raise Error(f"{name} is required by {self.source} (an array, a number, or three)")

    def _require_fractions(self, maps, width_encoding):
        """Refuses what can only be per cent or 0 to 255; exponents and wide ranges of specular are neither."""
        for name in (*maps.constants, *maps.arrays):
            is_exponent = name == "roughness" and width_encoding == "exponent"
            is_wide = name == "specular" and self.specular_domain[1] > 1
            if is_exponent or is_wide:
                continue
            shown = "glossiness" if name == "roughness" and width_encoding == "glossiness" else name
            if name in maps.constants:
                _require_fraction_numbers(shown, maps.constants[name])
            else:
                _require_fraction_array(shown, maps.arrays[name])

    def _made(self, maps, measures):
        """Each result with its number of channels."""
        for name in measures:
            if name not in _MEASURES or name not in self.targets:
                known = [measure for measure in _MEASURES if measure in self.targets] or ["none"]
                raise Error(f"measures: unknown measure '{name}' (choose {', '.join(known)})")
        channels = maps.channels("specular") or 3
        return {name: self._conversion.target_channels(name, channels) for name in self.targets
                if name not in _MEASURES or name in measures}


def convert(*, source: str, target: str, roughness: Optional[Map] = None, glossiness: Optional[Map] = None,
            specular: Optional[Color] = None, diffuse: Optional[Color] = None, base_color: Optional[Color] = None,
            metallic: Optional[Map] = None, metal_mask: Optional[Map] = None,
            roughness_encoding: Optional[str] = None, output_encoding: Optional[str] = None,
            transfer: Union[str, Mapping[str, str], None] = None, dtype: Optional[npt.DTypeLike] = None,
            out: Optional[Mapping[str, npt.NDArray[Any]]] = None, measures: Iterable[str] = (), outside: bool = False,
            bad_texels: str = "keep", dither: bool = False, threads: int = 1,
            **options: Any) -> Material:
    """Converts the maps of one material; returns a :class:`Material` with an array for each parameter of the target.

    source, target: names of :func:`models`. ``options``: those of :class:`Converter`.
    roughness, metallic, metal_mask: arrays of any shape S, or a number.
    glossiness: in place of roughness, 1 - roughness.
    specular, diffuse, base_color: arrays of shape S (grey) or S + (3,) (RGB), a number, or three in a tuple or list.
        S is the shape of the first parameter without colors that is an array; without one, a last axis of 3 is RGB.
    roughness_encoding, output_encoding: what roughness is, and what the result shall be: ``"alpha"``, ``"roughness"``
        (its square root), ``"glossiness"``, ``"exponent"``, ``"squared"``; by default the model's own, see
        :func:`models`.
    transfer: ``"linear"`` or ``"srgb"``, of all colors, or a dict by parameter. By default whole numbers are sRGB and
        floats linear, as in image files; other parameters are data, which no curve applies to.
    dtype: of the results: whole numbers of 8 to 32 bits (0 to 1 as 0 to the largest), float16, float32, float64; by
        default that of the source's array of the same name, else of its first array, else float32.
    out: arrays to write into, by the names of the results, of shape S or S + (3,); they may be the sources themselves.
    measures: of a metallic target also ``"residual"``, ``"metallic_uncertainty"``, ``"issues"``.
    outside: also a Boolean array ``outside`` of the texels outside of the converter's domain.
    bad_texels: NaN, infinite and negative values: ``"keep"``, ``"clamp"`` to the domain, or ``"fail"``.
    dither: adds noise of half a step to 8-bit results, the same in every run.
    threads: 0 for one per core. The results do not depend on it.

    Arrays are read and written in place: any strides, no copies (but of arrays in the other byte order). The lock of the
    interpreter is released. Raises :class:`Error`, a ValueError.

    >>> import numpy as np
    >>> result = convert(source="gltf-specgloss", target="gltf", glossiness=np.full((4, 4), 0.7, np.float32),
    ...                  diffuse=(0, 0, 0), specular=(1.0, 0.8, 0.3))
    >>> sorted(result), result.base_color.shape, bool((result.metallic > 0.99).all())
    (['base_color', 'metallic', 'roughness'], (4, 4, 3), True)
    """
    converter = _kept_converter(source, target, options)
    return converter.convert(
        roughness=roughness, glossiness=glossiness, specular=specular, diffuse=diffuse, base_color=base_color,
        metallic=metallic, metal_mask=metal_mask, roughness_encoding=roughness_encoding,
        output_encoding=output_encoding, transfer=transfer, dtype=dtype, out=out, measures=measures, outside=outside,
        bad_texels=bad_texels, dither=dither, threads=threads)


@functools.lru_cache(maxsize=32)
def _made_once(source, target, options):
    return Converter(source, target, **dict(options))


def _kept_converter(source, target, options):
    """One of the last that were used; of files, which may have changed, a new one."""
    if options.get("converters") is None:
        try:
            return _made_once(source, target, tuple(sorted(options.items())))
        except TypeError:  # it cannot be a key
            pass
    return Converter(source, target, **options)


def _thread_count(threads):
    if isinstance(threads, bool) or not isinstance(threads, (int, np.integer)) or not 0 <= threads <= 4096:
        raise Error(f"threads: {threads!r} is not a number of threads (0 for one per core)")
    return int(threads) or os.cpu_count() or 1


def _array(name, value):
    """An array of numbers in the order of this machine; None for what is no array."""
    if isinstance(value, (int, float, tuple, list, np.number)) or (isinstance(value, np.ndarray) and value.ndim == 0):
        return None
    array = np.asarray(value)
    if array.dtype.kind not in "uif" or array.dtype.itemsize > (8 if array.dtype.kind == "f" else 4):
        raise Error(f"{name}: has values of the unsupported type {array.dtype} "
                    "(use integers of up to 32 bits or floats of 16 to 64)")
    return array if array.dtype.isnative else array.astype(array.dtype.newbyteorder("="))


def _constants(name, value):
    try:
        values = [float(number) for number in np.ravel(value)]
    except (TypeError, ValueError):
        raise Error(f"{name}: is neither an array nor numbers: {value!r}") from None
    if len(values) not in ((1, 3) if name in _COLORS else (1,)):
        raise Error(f"{name}: has {len(values)} numbers (give one{' or three' if name in _COLORS else ''}, or an array)")
    return values


def _require_fraction_numbers(name, values):
    if max(values) < _SURELY_NO_FRACTION:
        return
    whole = 100 if len(values) == 1 and values[0] <= 100 else 255
    typed, meant = (", ".join(f"{number:g}" for number in numbers)
                    for numbers in (values, [round(value / whole, 2) for value in values]))
    if len(values) > 1:
        typed, meant = f"({typed})", f"({meant})"
    remedy = f" (write {name}={meant})" if max(values) <= whole else ""
    raise Error(f"{name}={typed}: values lie between 0 and 1{remedy}")


def _require_fraction_array(name, array):
    """Looks at some of the values: maps of some bright texels are usual, whole maps of them are not."""
    if array.dtype.kind != "f":
        return
    some = array[tuple(slice(None, None, 1 + size // _LOOKED_AT) for size in array.shape)]
    if 2 * np.count_nonzero(some > 1) <= some.size:
        return
    median = float(np.nanmedian(some))
    whole = next((whole for whole in (255, 65535) if median <= whole), None)
    remedy = f" (divide them by {whole}, or give integers: {name}.astype(np.uint{8 if whole == 255 else 16}))" if whole else ""
    raise Error(f"{name}: half of the values are above {median:.3g}, but they lie between 0 and 1{remedy}")


def _transfer_of(transfer, name, dtype):
    """``"linear"`` or ``"srgb"`` of a color."""
    if name not in _COLORS or name == "residual":
        return "linear"
    asked = transfer.get(name) if isinstance(transfer, dict) else transfer
    return asked or ("linear" if dtype.kind == "f" else "srgb")


class _Maps:
    """The sources of one conversion: constants, and arrays of shape S + (channels,)."""

    def __init__(self, given, transfer):
        if isinstance(transfer, dict):
            for name in transfer:
                if name not in _COLORS:
                    raise Error(f"transfer: {name} is not a color")
        arrays = {name: _array(name, value) for name, value in given.items()}
        self.constants = {name: _constants(name, given[name]) for name, array in arrays.items() if array is None}
        arrays = {name: array for name, array in arrays.items() if array is not None}
        self.shape = self._shape_of(arrays)
        self.arrays = {name: _with_channels(name, array, self.shape) for name, array in arrays.items()}
        self.transfers = {name: _transfer_of(transfer, name, array.dtype) for name, array in arrays.items()
                          if name in _COLORS}

    @staticmethod
    def _shape_of(arrays):
        for name, array in arrays.items():
            if name not in _COLORS:
                return array.shape
        for array in arrays.values():
            return array.shape[:-1] if array.shape[-1] == 3 else array.shape
        return ()

    def channels(self, name):
        if name in self.constants:
            return len(self.constants[name])
        return self.arrays[name].shape[-1] if name in self.arrays else 0

    def results(self, made, names, dtype, out, transfer):
        """Arrays for what is made, with ``out`` among them."""
        wanted = None if dtype is None else _result_dtype(dtype)
        arrays = {}
        for name, channels in made.items():
            shown = names.get(name, name)
            shape = self.shape + ((channels,) if channels > 1 else ())
            if shown in out:
                arrays[name] = _result_array(shown, out.pop(shown), shape, self.shape)
                continue
            like = self.arrays.get(name, next(iter(self.arrays.values()), None))
            arrays[name] = np.empty(shape, wanted or (np.dtype(np.float32) if like is None else like.dtype))
        if out:
            raise Error(f"out: the target has no {sorted(out)[0]} (it has {', '.join(names.get(n, n) for n in made)})")
        return _Results(arrays, self.shape, transfer)


class _Results:
    def __init__(self, arrays, shape, transfer):
        self.arrays = arrays
        self.views = {name: _with_channels(name, array, shape) for name, array in arrays.items()}
        self.transfers = {name: _transfer_of(transfer, name, array.dtype) for name, array in arrays.items()
                          if name in _COLORS}


def _result_dtype(dtype):
    try:
        wanted = np.dtype(dtype)
    except TypeError:
        raise Error(f"dtype: {dtype!r} is not a number type") from None
    _array("dtype", np.empty(1, wanted))
    return wanted.newbyteorder("=")


def _result_array(name, array, shape, grey_shape):
    if not isinstance(array, np.ndarray):
        raise Error(f"out: {name} is not a NumPy array")
    if not array.dtype.isnative or _array(f"out: {name}", array) is None:
        raise Error(f"out: {name} is in the other byte order")
    if not array.flags.writeable:
        raise Error(f"out: {name} cannot be written")
    fits = array.shape == shape or (name in _COLORS and array.shape == grey_shape + (3,))
    if not fits:
        raise Error(f"out: {name} has the shape {array.shape}, not {shape}")
    return array


def _with_channels(name, array, shape):
    if array.shape == shape:
        return array[..., np.newaxis]
    if name in _COLORS and array.shape == shape + (3,):
        return array
    raise Error(f"{name}: has the shape {array.shape}, but others make the map {shape}"
                + (f" (give {shape} or {shape + (3,)})" if name in _COLORS else ""))


def _apart(source, views):
    """``source``, as a copy where a result lies over another part of its memory."""
    for view in views:
        same = (source.shape[:-1] == view.shape[:-1] and source.strides == view.strides
                and source.__array_interface__["data"][0] == view.__array_interface__["data"][0])
        if not same and np.may_share_memory(source, view):
            return source.copy()
    return source


def _planes(array, shape):
    """(height, width, channels) views of an array, without copies: one, or one for each index before the last two axes."""
    if len(shape) == 2:
        return [array]
    if len(shape) < 2:
        return [array.reshape((1,) * (2 - len(shape)) + array.shape) if array.size else array]
    return [array[index] for index in np.ndindex(*shape[:-2])]


def _run(conversion, maps, result, mask, options):
    """Converts plane by plane, and adds up the counts."""
    shape = maps.shape
    if 0 in shape:
        return Counts()
    views = list(result.views.values())
    sources = {name: _planes(_apart(array, views), shape) for name, array in maps.arrays.items()}
    targets = {name: _planes(view, shape) for name, view in result.views.items()}
    if mask is not None:
        targets["outside"] = _planes(mask.view(np.uint8)[..., np.newaxis], shape)
    total, first_bad = None, None
    for i, index in enumerate(np.ndindex(*shape[:-2])):
        counts = conversion.convert(
            {**maps.constants, **{name: planes[i] for name, planes in sources.items()}},
            {name: planes[i] for name, planes in targets.items()}, options)
        bad = counts.pop("first_bad")
        if bad is not None and first_bad is None:
            first_bad = (index + bad)[-len(shape):] if shape else ()
        total = counts if total is None else {name: total[name] + count for name, count in counts.items()}
    return Counts(first_bad=first_bad, **total)
