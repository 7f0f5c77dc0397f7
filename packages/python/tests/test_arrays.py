"""Tests conversions of arrays against closed forms, and compares every layout of memory with every other."""

import concurrent.futures
import json
import multiprocessing
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import texremap

ROOT = Path(__file__).resolve().parents[3]
WARD_TO_AS = ROOT / "fits/mitsuba_ward_to_mitsuba_as.json"


def maps(shape=(37, 53), dtype=np.float32, seed=3):
    random = np.random.default_rng(seed)
    roughness = random.uniform(0.02, 0.9, shape)
    specular = random.uniform(0.0, 1.0, (*shape, 3))
    if np.dtype(dtype).kind != "f":
        largest = np.iinfo(dtype).max
        return (roughness * largest).astype(dtype), (specular * largest).astype(dtype)
    return roughness.astype(dtype), specular.astype(dtype)


def compact(form, alpha, specular):
    """Returns the results of a fit of the kind `compact` within its domain.

    The formulas are those of runtime/converter/compact_form.hpp.
    """

    def factor(terms, s):
        t = s / (s + form["pole"])
        return sum(c * t**j * alpha**i for j, row in enumerate(terms) for i, c in enumerate(row))

    def excess(value, limit):
        return 0 if limit is None else max(0, value / limit - 1)

    def limited(value, limit):
        return value if limit is None else min(value, limit)

    free_alpha = alpha * factor(form["alpha"], max(specular))
    free = [s * factor(form["specular"], s) for s in specular]
    over = excess(max(free), form["specular_limit"])
    turn = alpha * (form["turn"] + form["turn_by_alpha"] * alpha) * over / (1 + form["bend"] * over)
    spread = 1 + form["spread"] * excess(free_alpha, form["alpha_limit"])
    return limited(free_alpha + turn, form["alpha_limit"]), [limited(s * spread, form["specular_limit"]) for s in free]


@pytest.mark.parametrize("source, target", [("ward", "as"), ("ggx", "beckmann"), ("ggx", "ward"), ("as", "ward-balanced")])
def test_values_are_those_of_the_fit(source, target):
    fit = ROOT / "fits/mitsuba_{}_to_mitsuba_{}.json".format(source, target.replace("-", "_"))
    mapping = json.loads(fit.read_text())["mapping"]
    assert mapping["kind"] == "compact"
    converter = texremap.Converter("mitsuba/" + source, "mitsuba/" + target)
    # The last two reach limits of Ward.
    for alpha, specular in ((0.1, (0.2, 0.5, 0.9)), (0.2, (0.72, 0.48, 0.36)), (0.4, (0.05, 0.05, 0.05)), (0.9, (0.3, 0.2, 0.1)),
                            (0.97, (1.0, 0.9, 0.8))):
        result = converter.convert(roughness=np.array([alpha], np.float64), specular=specular)
        expected_alpha, expected = compact(mapping, alpha, specular)
        assert abs(result.roughness[0] - expected_alpha) < 2e-5
        assert np.abs(result.specular[0] - expected).max() < 2e-5


def test_loaded_fit_equals_shipped():
    roughness, specular = maps()
    shipped = texremap.convert(source="mitsuba/ward", target="mitsuba/as", roughness=roughness, specular=specular)
    loaded = texremap.Converter.load(WARD_TO_AS).convert(roughness=roughness, specular=specular)
    folder = texremap.convert(source="mitsuba/ward", target="mitsuba/as", roughness=roughness, specular=specular,
                              converters=ROOT / "generated/converters.json")
    for result in (loaded, folder):
        assert np.array_equal(result.roughness, shipped.roughness) and np.array_equal(result.specular, shipped.specular)


def test_metallic_to_specular_is_equation_2():
    random = np.random.default_rng(1)
    base, metallic = random.random((20, 30, 3), np.float32), random.random((20, 30), np.float32)
    result = texremap.convert(source="gltf", target="gltf-specgloss", base_color=base, metallic=metallic,
                              roughness=np.full((20, 30), 0.4, np.float32))
    m = metallic[..., None].astype(np.float64)
    f0 = 0.04 * (1 - m) + base * m
    # By glTF 2.0, appendix B, diffuse is base color (1 - metallic). spec-gloss scales it by 1 - max(specular).
    diffuse = base * (1 - m) * (1 - 0.04) / (1 - f0.max(axis=-1, keepdims=True))
    assert np.abs(result.specular - f0).max() < 1e-6
    assert np.abs(result.glossiness - 0.6).max() < 1e-6
    assert np.abs(result.diffuse - np.clip(diffuse, 0, 1)).max() < 0.05


@pytest.mark.parametrize("dtype", ["float16", "float32", "float64", "uint8", "uint16"])
def test_types(dtype):
    roughness, specular = maps(dtype=dtype)
    result = texremap.convert(source="mitsuba/ward", target="mitsuba/as", roughness=roughness, specular=specular,
                              transfer="linear", dtype=np.float32)
    scale = 1 if np.dtype(dtype).kind == "f" else np.iinfo(dtype).max
    floats = texremap.convert(source="mitsuba/ward", target="mitsuba/as", roughness=(roughness / scale).astype(np.float32),
                              specular=(specular / scale).astype(np.float32))
    assert np.abs(result.roughness - floats.roughness).max() < 1e-6
    same = texremap.convert(source="mitsuba/ward", target="mitsuba/as", roughness=roughness, specular=specular)
    assert same.roughness.dtype == same.specular.dtype == np.dtype(dtype)


def test_whole_numbers_are_srgb_unless_told():
    grey = np.array([[[0, 128, 255]]], np.uint8)
    converter = texremap.Converter("mitsuba/ward", "mitsuba/as")
    usual = converter.convert(roughness=0.3, specular=grey, dtype=np.float32)
    stored = np.array([0, 128 / 255, 1])
    linear = np.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)  # IEC 61966-2-1
    by_hand = converter.convert(roughness=0.3, specular=linear.astype(np.float32)[None, None])
    assert np.abs(usual.specular - by_hand.specular).max() < 1e-6
    told = converter.convert(roughness=0.3, specular=grey, dtype=np.float32, transfer={"specular": "linear"})
    assert told.specular[0, 0, 1] > usual.specular[0, 0, 1]


def layouts(array):
    """Returns the same values in different layouts of memory."""
    yield "Fortran", np.asfortranarray(array)
    yield "transposed", np.ascontiguousarray(array.swapaxes(0, 1)).swapaxes(0, 1)
    yield "upside down", array[::-1].copy()[::-1]
    yield "mirrored", array[:, ::-1].copy()[:, ::-1]
    wide = np.zeros((array.shape[0] * 2, array.shape[1] * 3, *array.shape[2:]), array.dtype)
    wide[::2, ::3] = array
    yield "every second", wide[::2, ::3]
    odd = np.zeros(array.nbytes + 1, np.uint8)[1:]
    unaligned = odd.view(array.dtype).reshape(array.shape)
    unaligned[...] = array
    yield "unaligned", unaligned
    fields = np.zeros(array.shape, [("pad", np.uint8), ("value", array.dtype)])
    fields["value"] = array
    yield "a field of records", fields["value"]
    yield "the other byte order", array.astype(array.dtype.newbyteorder())


def test_strides():
    roughness, specular = maps()
    converter = texremap.Converter("mitsuba/ward", "cycles-5/ggx")
    expected = converter.convert(roughness=roughness, specular=specular)
    for (name, r), (_, s) in zip(layouts(roughness), layouts(specular)):
        found = converter.convert(roughness=r, specular=s)
        assert np.array_equal(found.roughness, expected.roughness), name
        assert np.array_equal(found.specular, expected.specular), name
    planar = np.ascontiguousarray(np.moveaxis(specular, -1, 0))
    out = {"roughness": np.zeros_like(roughness)[::-1], "specular": np.moveaxis(np.zeros_like(planar), 0, -1)}
    found = converter.convert(roughness=roughness, specular=np.moveaxis(planar, 0, -1), out=out)
    assert found.specular is out["specular"] and np.array_equal(out["specular"], expected.specular)
    assert np.array_equal(out["roughness"], expected.roughness)


@pytest.mark.parametrize("shape", [(), (1,), (5,), (3,), (4, 3), (2, 3, 4), (2, 1, 3, 5)])
def test_shapes(shape):
    random = np.random.default_rng(5)
    roughness, specular = random.uniform(0.1, 0.5, shape), random.random((*shape, 3))
    result = texremap.convert(source="mitsuba/ward", target="mitsuba/as", roughness=roughness, specular=specular)
    assert result.roughness.shape == shape and result.specular.shape == (*shape, 3)
    flat = texremap.convert(source="mitsuba/ward", target="mitsuba/as", roughness=np.reshape(roughness, -1),
                            specular=specular.reshape(-1, 3))
    assert np.array_equal(result.roughness.reshape(-1), flat.roughness)
    assert result.counts.texels == max(int(np.prod(shape)), 1)


def test_grey_stays_grey_and_numbers_spread():
    result = texremap.convert(source="mitsuba/ward", target="mitsuba/as", roughness=np.full((2, 4), 0.2), specular=0.5)
    assert result.specular.shape == (2, 4)
    result = texremap.convert(source="mitsuba/ward", target="mitsuba/as", roughness=0.2, specular=np.full((2, 4, 3), 0.5))
    assert result.roughness.shape == (2, 4)


def test_in_place_and_overlapping():
    roughness, specular = maps()
    converter = texremap.Converter("mitsuba/ward", "mitsuba/as")
    expected = converter.convert(roughness=roughness, specular=specular)
    r, s = roughness.copy(), specular.copy()
    converter.convert(roughness=r, specular=s, out={"roughness": r, "specular": s})
    assert np.array_equal(r, expected.roughness) and np.array_equal(s, expected.specular)
    memory = np.concatenate([specular, specular[:1]])
    memory[:-1] = specular
    converter.convert(roughness=roughness, specular=memory[:-1], out={"specular": memory[1:]})
    assert np.array_equal(memory[1:], expected.specular)


def test_empty():
    result = texremap.convert(source="mitsuba/ward", target="mitsuba/as", roughness=np.zeros((0, 4)), specular=0.5)
    assert result.roughness.shape == (0, 4) and result.counts.texels == 0


def test_counts_and_bad_texels():
    roughness = np.full((2, 3, 4), 0.3, np.float32)
    roughness[1, 2, 3] = np.nan
    roughness[0, 1, 2] = -1
    converter = texremap.Converter("mitsuba/ward", "mitsuba/as")
    kept = converter.convert(roughness=roughness, specular=0.5, outside=True)
    assert kept.counts.nan == 1 and kept.counts.negative == 1 and kept.counts.first_bad == (0, 1, 2)
    assert np.isnan(kept.roughness[1, 2, 3]) and kept.outside.dtype == bool and kept.outside[0, 1, 2]
    clamped = converter.convert(roughness=roughness, specular=0.5, bad_texels="clamp")
    assert not np.isnan(clamped.roughness).any()
    with pytest.raises(texremap.Error, match="nan|negative|-1"):
        converter.convert(roughness=roughness, specular=0.5, bad_texels="fail")


def test_encodings():
    alpha = np.linspace(0.1, 0.5, 9)
    converter = texremap.Converter("mitsuba/ward", "mitsuba/ggx")
    expected = converter.convert(roughness=alpha, specular=0.5)
    for encoding, stored in (("roughness", np.sqrt(alpha)), ("squared", alpha**2), ("exponent", 2 / alpha**2 - 2)):
        found = converter.convert(roughness=stored, specular=0.5, roughness_encoding=encoding)
        assert np.abs(found.roughness - expected.roughness).max() < 1e-5
    gloss = converter.convert(glossiness=1 - np.sqrt(alpha), specular=0.5, output_encoding="glossiness")
    assert np.abs((1 - gloss.glossiness) ** 2 - expected.roughness).max() < 1e-5


def test_threads_and_sets_of_instructions_give_the_same_bits():
    roughness, specular = maps((256, 311))
    expected = texremap.Converter("mitsuba/ward", "threejs/standard", instructions="baseline").convert(
        roughness=roughness, specular=specular, diffuse=0.2)
    for threads in (0, 1, 3, 8):
        found = texremap.convert(source="mitsuba/ward", target="threejs/standard", roughness=roughness, specular=specular,
                                 diffuse=0.2, threads=threads)
        for name, array in expected.items():
            assert np.array_equal(found[name], array)


def test_lock_of_the_interpreter_is_released():
    roughness, specular = maps((2048, 2048))
    converter = texremap.Converter("mitsuba/ward", "threejs/standard")
    done, steps = threading.Event(), []

    def count():
        while not done.is_set():
            steps.append(1)
            time.sleep(0)

    thread = threading.Thread(target=count)
    thread.start()
    time.sleep(0.05)
    before = len(steps)
    converter.convert(roughness=roughness, specular=specular, diffuse=0.1)
    during = len(steps) - before
    done.set()
    thread.join()
    assert during > 100


def _converted(seed):
    roughness, specular = maps(seed=seed)
    return texremap.convert(source="mitsuba/ward", target="mitsuba/as", roughness=roughness, specular=specular,
                            threads=2).specular.sum(dtype=np.float64)


def test_many_threads_and_processes():
    expected = [_converted(seed) for seed in range(6)]
    with concurrent.futures.ThreadPoolExecutor(6) as pool:
        assert list(pool.map(_converted, range(6))) == expected
    with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context("fork")) as pool:
        assert list(pool.map(_converted, range(6))) == expected


def test_names():
    names = {model.name for model in texremap.models()}
    assert {"mitsuba/ward", "gltf", "cycles-5/principled"} <= names
    assert texremap.Converter("Spec-Gloss", "glTF").path.steps == ()
    path = texremap.path("mitsuba/ward", "cycles-5")
    assert path.models[0] == "mitsuba/ward" and path.models[-1].startswith("cycles-5/")
    assert 0 < path.expected_error < 1
    assert texremap.Converter("mitsuba/ward", "mitsuba/as").assumptions == ()


def test_table():
    table = texremap.read_table(ROOT / "fits/tables/mitsuba_ward_to_mitsuba_as.csv")
    assert table.notes["source"] == "mitsuba/ward"
    assert table.rows["alpha1"].dtype == np.float64 and set(table.rows["status"]) >= {"ok"}
    result = texremap.convert(source="mitsuba/ward", target="mitsuba/as", roughness=table.rows["alpha1"],
                              specular=table.rows["specular1"])
    inside = (table.rows["status"] == "ok") & (table.rows["alpha1"] > 0.05) & (table.rows["alpha1"] < 0.5)
    assert np.abs(result.roughness - table.rows["alpha2"])[inside].max() < 0.02


def test_doctests():
    import doctest

    from texremap import arrays

    for module in (texremap, arrays):
        assert doctest.testmod(module).failed == 0
