"""Tests that every input gives a result or an exception with a message, and never ends the process."""

import pickle

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some

import texremap

GOOD = {"source": "mitsuba/ward", "target": "mitsuba/as", "roughness": np.full((2, 2), 0.2), "specular": 0.5}

REFUSED = [
    ({"source": "mitsuba/wrd"}, "source: unknown model 'mitsuba/wrd'"),
    ({"target": ""}, "target is required"),
    ({"source": 7}, "source: has the wrong type"),
    ({"roughness": None}, "roughness is required by mitsuba/ward"),
    ({"diffuse": 0.1}, "diffuse: mitsuba/ward has no such parameter"),
    ({"specular": np.zeros((2, 3))}, "specular: has the shape"),
    ({"specular": np.zeros((2, 2, 4))}, "specular: has the shape"),
    ({"specular": (1, 2)}, "specular: has 2 numbers"),
    ({"specular": "red"}, "specular: "),
    ({"roughness": np.zeros((2, 2), complex)}, "roughness: has values of the unsupported type complex128"),
    ({"roughness": np.zeros((2, 2), bool)}, "roughness: has values of the unsupported type bool"),
    ({"roughness": np.zeros((2, 2), "U3")}, "roughness: has values of the unsupported type"),
    ({"roughness": np.zeros((2, 2), np.int64)}, "roughness: has values of the unsupported type int64"),
    ({"roughness": object()}, "roughness: "),
    ({"dtype": complex}, "dtype: "),
    ({"dtype": "no type"}, "dtype: "),
    ({"out": {"metallic": np.zeros((2, 2))}}, "out: the target has no metallic"),
    ({"out": {"roughness": np.zeros((3, 2))}}, "out: roughness has the shape"),
    ({"out": {"roughness": [0, 0]}}, "out: roughness is not a NumPy array"),
    ({"out": {"roughness": np.broadcast_to(np.zeros(1), (2, 2))}}, "out: roughness cannot be written"),
    ({"transfer": "gamma"}, "specular: unknown value 'gamma'"),
    ({"transfer": {"roughness": "srgb"}}, "transfer: roughness is not a color"),
    ({"roughness_encoding": "shiny"}, "roughness_encoding: unknown value 'shiny'"),
    ({"bad_texels": "ignore"}, "bad_texels: unknown value 'ignore'"),
    ({"threads": -1}, "threads: -1"),
    ({"threads": 1.5}, "threads: 1.5"),
    ({"threads": 10**9}, "threads: "),
    ({"measures": ["residual"]}, "measures: unknown measure 'residual'"),
    ({"dielectric_f0": "high"}, "dielectric_f0: has the wrong type"),
    ({"via": ["nowhere/model"]}, "nowhere/model"),
    ({"converters": "missing.json"}, "missing.json"),
    ({"instructions": "sse9"}, "instructions: "),
    ({"glossiness": 0.5}, "glossiness cannot be given with roughness"),
    ({"roughness": 30}, "roughness=30: values lie between 0 and 1 (write roughness=0.3)"),
    ({"roughness": None, "glossiness": 130}, "glossiness=130: values lie between 0 and 1 (write glossiness=0.51)"),
    ({"specular": (80, 40, 20)}, "specular=(80, 40, 20): values lie between 0 and 1 (write specular=(0.31, 0.16, 0.08))"),
    ({"specular": 1e6}, "specular=1e+06: values lie between 0 and 1"),
    ({"roughness": np.full((2, 2), 30.0)}, "roughness: half of the values are above 30, but they lie between 0 and 1 (divide them by 255"),
    ({"roughness": np.full((2, 2), 3e4)}, "roughness.astype(np.uint16)"),
]


@pytest.mark.parametrize("changes, message", REFUSED, ids=[f"{list(c)[0]} {i}" for i, (c, _) in enumerate(REFUSED)])
def test_refused(changes, message):
    arguments = {**GOOD, **changes}
    if "transfer" in changes:
        arguments["specular"] = np.zeros((2, 2, 3))
    with pytest.raises(texremap.Error) as raised:
        texremap.convert(**arguments)
    assert message in str(raised.value)
    assert "\n" not in str(raised.value)


def test_bright_values_that_are_meant():
    texremap.convert(source="mitsuba/phong", target="mitsuba/as", roughness=30, specular=0.5)
    texremap.convert(source="mitsuba/phong", target="mitsuba/as", roughness=np.full((2, 2), 300.0), specular=0.5)
    texremap.convert(**{**GOOD, "roughness": 30, "roughness_encoding": "exponent"})
    few = np.full((200, 200), 0.5)
    few[:40] = 8.0
    texremap.convert(**{**GOOD, "roughness": 0.2, "specular": few})
    texremap.convert(**{**GOOD, "roughness": np.full((2, 2), 200, np.uint8), "specular": 1.2})


def test_error_can_be_sent_to_another_process():
    error = pickle.loads(pickle.dumps(texremap.Error("place: wrong", "input")))
    assert (str(error), error.kind) == ("place: wrong", "input")


@pytest.mark.parametrize("text", ["", "{", "[]", '{"format": 1}', "\0\1", '{"id": "a"}' * 3])
def test_files_that_are_no_fits(text, tmp_path):
    file = tmp_path / "fit.json"
    file.write_text(text)
    with pytest.raises(texremap.Error):
        texremap.Converter.load(file)
    with pytest.raises(texremap.Error):
        texremap.read_table(file)
    with pytest.raises(texremap.Error):
        texremap.Converter.load(tmp_path)


dtypes = some.sampled_from(["f2", "f4", "f8", ">f4", "u1", "u2", "u4", "i1", "i2", "i4", "i8", "?", "c8", "O", "S3", "M8[s]"])
shapes = some.lists(some.integers(0, 4), max_size=4).map(tuple)


@some.composite
def arrays(draw):
    shape, dtype = draw(shapes), np.dtype(draw(dtypes))
    count = int(np.prod(shape)) * dtype.itemsize
    if dtype.kind in "OM":
        return np.zeros(shape, dtype)
    array = np.frombuffer(draw(some.binary(min_size=count, max_size=count)), dtype).reshape(shape)
    if array.ndim and draw(some.booleans()):
        array = array[:: draw(some.sampled_from([-1, 2, -2]))]
    return array if draw(some.booleans()) else array.copy()


values = some.one_of(arrays(), some.none(), some.floats(), some.integers(-3, 300), some.text(max_size=3),
                     some.tuples(some.floats(), some.floats(), some.floats()), some.lists(some.floats(width=32), max_size=4))
names = some.sampled_from(["mitsuba/ward", "mitsuba/ggx", "gltf", "gltf-specgloss", "cycles-5", "legacy/phong", "", "x", "é\0"])


@settings(max_examples=400, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(source=names, target=names, roughness=values, specular=values, diffuse=values, base_color=values, metallic=values,
       dtype=some.one_of(some.none(), dtypes), out=some.dictionaries(some.sampled_from(["roughness", "specular"]), values),
       threads=some.sampled_from([1, 2, 0]), outside=some.booleans())
def test_anything(**arguments):
    try:
        result = texremap.convert(**arguments)
    except texremap.Error as error:
        assert str(error)
        return
    assert isinstance(result.counts.texels, int)
