"""The judgement: materials of one direction, rendered as they are, as the translation in use makes them, as ours does, and as a search can."""
import importlib.util
import pathlib

import numpy as np

import materialx_shaders as shaders
from whole_materials import in_use, pictures, search

IN_USE, OURS, FLOOR = "in use", "ours", "floor"
DIRECTIONS = [("UsdPreviewSurface", "open_pbr_surface"), ("principled", "open_pbr_surface"), ("standard_surface", "open_pbr_surface"),
              ("gltf_pbr", "open_pbr_surface"), ("open_pbr_surface", "UsdPreviewSurface"), ("open_pbr_surface", "gltf_pbr"),
              ("open_pbr_surface", "standard_surface")]


def read_translations(path):
    """Returns the functions by direction of an emitted module. A file that is missing or broken is Unusable."""
    if not pathlib.Path(path).is_file():
        raise shaders.Unusable(f"{path}: no such file (--translations names the module of translations)")
    spec = importlib.util.spec_from_file_location("remap_translations", path)
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
        return dict(module.TRANSLATIONS)
    except Exception as failure:
        raise shaders.Unusable(f"{path}: is not a module of translations ({type(failure).__name__}: {failure})") from None


def plain(values):
    """Returns the results of a translation as floats and tuples."""
    flat = {name: np.ravel(np.asarray(value, float)) for name, value in values.items()}
    for name, value in flat.items():
        if not np.isfinite(value).all():
            raise shaders.Unusable(f"the translation gives {name} = {value.tolist()}")
    return {name: tuple(value.tolist()) if value.size > 1 else float(value[0]) for name, value in flat.items()}


def versions(direction, values, translations, stage, source, with_floor=False):
    """Returns shader and values of each version of a material in the target model."""
    found = {IN_USE: in_use.shader_and_values(direction, values)}
    target = shaders.model_shader(direction[1])
    if direction in translations:
        found[OURS] = target, plain(translations[direction](values))
    if with_floor:
        start = found[OURS][1] if OURS in found else {}
        found[FLOOR] = target, search.floor(stage, source, target, [start])
    return found


def judge(direction, values, translations, with_floor=False):
    """Returns the errors of each version of one material, and the values of each in the target model where they are known."""
    stage = pictures.stage(direction[0])
    source = stage.under_both(pictures.shader_of(direction[0]), values)
    small = None
    if with_floor:
        small = pictures.stage(direction[0], search.RESOLUTION)
        small_source = small.under_singles(pictures.shader_of(direction[0]), values)
    found = versions(direction, values, translations, small, small_source if small else None, with_floor)
    return {name: pictures.errors(source, stage.under_both(*version)) for name, version in found.items()}


def summary(errors):
    """Returns what a table says about the errors of many materials, by version."""
    table = {}
    for name in (IN_USE, OURS, FLOOR):
        linear = np.array([one[name]["linear"] for one in errors if name in one])
        display = np.array([one[name]["display"] for one in errors if name in one])
        if linear.size:
            table[name] = {"mean": float(linear.mean()), "median": float(np.median(linear)), "worst": float(linear.max()),
                           "display": float(display.mean())}
    return table
