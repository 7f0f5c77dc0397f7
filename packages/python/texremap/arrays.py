"""Converters over NumPy arrays."""

import functools
import os
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._error import Error

_COLORS = {"specular", "diffuse", "base_color", "residual"}
_SURELY_NO_FRACTION = 2  # values from 2 on cannot be fractions
_LOOKED_AT = 64  # values of each axis of an array
_MEASURES = ("residual", "metallic_uncertainty", "issues")


Map = Union[npt.NDArray[Any], float]
Color = Union[npt.NDArray[Any], float, Tuple[float, float, float], List[float]]


class Model(NamedTuple):
    """A model that ``source`` and ``target`` can name."""

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
    """The numbers of unusual texels. A texel counts once in every field that applies."""

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
    """The results by the names of parameters, which are also attributes, and their ``counts``."""

    counts: Counts

    def __getattr__(self, name: str) -> npt.NDArray[Any]:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"the result has no {name} (it has {', '.join(self)})") from None


def models() -> List[Model]:
    """Returns all names that ``source`` and ``target`` accept, as a list of :class:`Model`.

    >>> [model.name for model in models() if model.kind == "metallic"][:2]
    ['gltf', 'cycles-5/principled']
    """
    return [Model(*fields) for fields in _core.models()]


def path(source: str, target: str, **options: Any) -> Path:
    """Returns how closely ``target`` can look like ``source``, as a :class:`Path`.

    ``options`` are the options of :class:`Converter`.

    >>> path("mitsuba/ward", "mitsuba/as").steps
    ('mitsuba_ward_to_mitsuba_as',)
    """
    return Converter(source, target, **options).path


class Converter:
    """Converts arrays of ``source`` into arrays of ``target``. :func:`convert` describes the arrays.

    source, target: names from :func:`models`. The target can also be a renderer (``"cycles-5"``), which means
        the closest of its models. ``"specular:mitsuba/ward"`` and ``"metallic:mitsuba/ward"`` are workflows
        around a BRDF model. ``plain:`` or ``scaled:`` before a workflow states what diffuse means: the reflectance, or
        the reflectance times 1 - max(specular), as in glTF.
    via: models that the path must visit, in this order.
    dielectric_f0: F0 of dielectrics in metallic workflows, 0 to 0.9 (default: the model's own, 0.04 for glTF).
    metallic_bias: how strongly a conversion to metallic prefers 0 and 1. It is 0 to 1: 1e-6 for clean maps, 1e-5
        for noisy maps.
    converters: a file that ``remapc emit --all`` wrote, a fit, or a folder of fits. They replace the shipped
        converters.
    instructions: ``"baseline"``, ``"avx2"`` or ``"avx512"``. The results do not depend on it.

    Many threads may use a converter at a time. Raises :class:`Error`.
    """

    def __init__(self, source: str, target: str, *, via: Optional[Iterable[str]] = None,
                 dielectric_f0: Optional[float] = None, metallic_bias: Optional[float] = None,
                 converters: Union[str, "os.PathLike[str]", None] = None,
                 instructions: Optional[str] = None) -> None:
        request = {
            "source": source, "target": target, "via": None if via is None else list(via),
            "dielectric_f0": dielectric_f0, "metallic_bias": metallic_bias,
            "converters": None if converters is None else os.fspath(converters), "instructions": instructions,
        }
        self._hold(_core.Conversion(request))

    @classmethod
    def load(cls, file: Union[str, "os.PathLike[str]"], *, source_workflow: Optional[str] = None) -> "Converter":
        """Returns the converter of a fit or a warp in JSON, as ``remapc fit`` and ``remapc warp`` write them.

        A warp reads the specular workflow, or the metallic workflow if ``source_workflow`` is ``"metallic"``.
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
        """The parameters that the converter reads."""
        return tuple(self._about["sources"])

    @property
    def targets(self) -> Tuple[str, ...]:
        """The parameters that the converter can make."""
        return tuple(self._about["targets"])

    @property
    def roughness_encoding(self) -> str:
        """The encoding of the source's roughness."""
        return self._about["roughness_encoding"]

    @property
    def output_encoding(self) -> str:
        """The encoding of the target's roughness."""
        return self._about["output_encoding"]

    @property
    def roughness_domain(self) -> Tuple[float, float]:
        """The measured range of the BRDF's own roughness parameter."""
        return self._about["roughness_domain"]

    @property
    def specular_domain(self) -> Tuple[float, float]:
        """The measured range of the BRDF's specular."""
        return self._about["specular_domain"]

    @property
    def instructions(self) -> str:
        """The instruction set that the converter uses."""
        return self._about["instructions"]

    @property
    def notes(self) -> Tuple[str, ...]:
        """The meanings of the given names."""
        return tuple(self._about["notes"])

    @property
    def assumptions(self) -> Tuple[str, ...]:
        """The assumptions that the converter makes."""
        return tuple(self._about["assumptions"])

    @property
    def path(self) -> Path:
        """The :class:`Path` of the BRDF."""
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
        """Converts the maps of one material from ``source`` to ``target``. The arguments and the result are
        those of :func:`convert`."""
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
        """Returns the encoding of the source's width. ``roughness`` means roughness even if the model uses
        glossiness."""
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
        """Refuses values that can only be per cent or 0 to 255. Skips exponents and wide ranges of specular."""
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
        """Returns the number of channels of each result."""
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
    """Converts the maps of one material. Returns a :class:`Material` with an array for each target parameter.

    source, target: names from :func:`models`. ``options`` are the options of :class:`Converter`.
    roughness, metallic, metal_mask: arrays of any shape S, or a number.
    glossiness: 1 - roughness. It can be given instead of roughness.
    specular, diffuse, base_color: arrays of shape S (grey) or S + (3,) (RGB), a number, or three numbers in a
        tuple or list. S is the shape of the first array of a parameter that is not a color. If there is no such
        array, a last axis of 3 is RGB.
    roughness_encoding, output_encoding: the meaning of roughness in the source and in the result: ``"alpha"``,
        ``"roughness"`` (the square root of alpha), ``"glossiness"``, ``"exponent"`` or ``"squared"``. The
        default is the model's own encoding (see :func:`models`).
    transfer: ``"linear"`` or ``"srgb"`` for all colors, or a dict by parameter. By default integers are sRGB and
        floats are linear, as in image files. Other parameters are data, which have no curve.
    dtype: the type of the results: integers of 8 to 32 bits (the largest integer means 1), float16, float32 or
        float64. The default is the type of the source array with the same name. If there is none, it is the
        type of the first source array, or float32.
    out: arrays to write into, keyed by the names of the results, of shape S or S + (3,). They may be the
        sources themselves.
    measures: additional results for a metallic target: ``"residual"``, ``"metallic_uncertainty"``, ``"issues"``.
    outside: if true, also returns a Boolean array ``outside``, which marks texels outside the measured range.
    bad_texels: how to treat NaN, infinite and negative values: ``"keep"``, ``"clamp"`` (to the measured range) or
        ``"fail"``.
    dither: adds noise of half a step to 8-bit results. The noise is the same in every run.
    threads: number of threads, or 0 for one per core. The results do not depend on it.

    Arrays may have any strides. They are read and written in place, without copies, unless they have the other
    byte order. The interpreter lock is released. Raises :class:`Error`, which is a ValueError.

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
    """Returns a converter that was made before with the same arguments, or a new one. Files may have changed,
    so their converters are always new."""
    if options.get("converters") is None:
        try:
            return _made_once(source, target, tuple(sorted(options.items())))
        except TypeError:  # an option that cannot be hashed
            pass
    return Converter(source, target, **options)


def _thread_count(threads):
    if isinstance(threads, bool) or not isinstance(threads, (int, np.integer)) or not 0 <= threads <= 4096:
        raise Error(f"threads: {threads!r} is not a number of threads (0 for one per core)")
    return int(threads) or os.cpu_count() or 1


def _array(name, value):
    """Returns an array in the byte order of this machine, or None for a number or a list of numbers."""
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
    """Looks at some of the values. A few bright texels are common in maps, but not whole maps of them."""
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
    """Returns ``"linear"`` or ``"srgb"``, the transfer curve of a parameter."""
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
        """Returns arrays for the results, some of which ``out`` may contain."""
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
    """Returns ``source``, or a copy of it if a result would overwrite values that are still needed."""
    for view in views:
        same = (source.shape[:-1] == view.shape[:-1] and source.strides == view.strides
                and source.__array_interface__["data"][0] == view.__array_interface__["data"][0])
        if not same and np.may_share_memory(source, view):
            return source.copy()
    return source


def _planes(array, shape):
    """Returns views (height, width, channels) of an array, without copies. There is one view for each index
    before the last two axes."""
    if len(shape) == 2:
        return [array]
    if len(shape) < 2:
        return [array.reshape((1,) * (2 - len(shape)) + array.shape) if array.size else array]
    return [array[index] for index in np.ndindex(*shape[:-2])]


def _run(conversion, maps, result, mask, options):
    """Converts plane by plane. Returns the sum of the counts."""
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
