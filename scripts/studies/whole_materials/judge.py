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


def versions(direction, values, translations):
    """Returns shader and values of the translation in use of a material, and of ours where there is one."""
    found = {IN_USE: in_use.shader_and_values(direction, values)}
    if direction in translations:
        found[OURS] = shaders.model_shader(direction[1]), plain(translations[direction](values))
    return found


def floor(direction, values, ours):
    """Returns shader and values of the closest pictures that a search finds from ours, and from the starts of the model."""
    stage, target = pictures.stage(direction[0], search.RESOLUTION), shaders.model_shader(direction[1])
    source = stage.under_singles(pictures.shader_of(direction[0]), values)
    return target, search.closest(stage, source, target, ours + search.STARTS[direction[1]])


def judge(direction, values, translations, with_floor=False):
    """Returns the errors of each version of one material."""
    stage = pictures.stage(direction[0])
    source = stage.under_both(pictures.shader_of(direction[0]), values)
    found = versions(direction, values, translations)
    if with_floor:
        found[FLOOR] = floor(direction, values, [found[OURS][1]] if OURS in found else [])
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
