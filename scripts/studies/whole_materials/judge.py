"""Judges one direction: materials as they are, as the translation in use makes them, as ours does, and as close as a
search comes."""
import importlib.util
import pathlib

import numpy as np

import materialx_shaders as shaders
from whole_materials import in_use, pictures, search

IN_USE, OURS, FLOOR = "in use", "ours", "floor"
DIRECTIONS = [("UsdPreviewSurface", "open_pbr_surface"), ("principled", "open_pbr_surface"), ("standard_surface", "open_pbr_surface"),
              ("gltf_pbr", "open_pbr_surface"), ("open_pbr_surface", "UsdPreviewSurface"),
              ("open_pbr_surface", "UsdPreviewSurface_specular"), ("open_pbr_surface", "gltf_pbr"),
              ("open_pbr_surface", "standard_surface"), ("gltf_pbr", "gltf_pbr_core")]


class Module:
    """Holds our translations as functions of an emitted Python module."""

    def __init__(self, path):
        spec = importlib.util.spec_from_file_location("remap_translations", path)
        module = importlib.util.module_from_spec(spec)
        try:
            spec.loader.exec_module(module)
            self.functions = dict(module.TRANSLATIONS)
        except Exception as failure:
            raise shaders.Unusable(f"{path}: is not a module of translations ({type(failure).__name__}: {failure})") from None

    def values(self, direction, values):
        """Returns the inputs of the target, or None if there is no such translation."""
        return plain(self.functions[direction](values)) if direction in self.functions else None

    def version(self, direction, values):
        """Returns the shader that shows the translation and its values, or None."""
        found = self.values(direction, values)
        return found and (shaders.model_shader(shaders.model_of(direction[1])), found)


class Graphs:
    """Holds our translations as node graphs of a MaterialX file. The shader evaluates them."""

    def __init__(self, path):
        self.path = str(path)
        shaders.libraries(self.path)

    def values(self, direction, values):
        return None  # the values exist only in the shader

    def version(self, direction, values):
        if direction[0] == "principled":
            return None
        shader = shaders.chain_shader(direction, self.path)
        return shader, {name: value for name, value in values.items() if name in shader.types}


class Nothing:
    """Holds no translations of ours, so that only the translation in use is judged."""

    def values(self, direction, values):
        return None

    version = values


def read_translations(path):
    """Returns our translations from a Python module or a MaterialX file. Raises Unusable if the file is missing or
    broken."""
    path = pathlib.Path(path)
    if not path.is_file():
        raise shaders.Unusable(f"{path}: no such file (--translations names a Python module or a MaterialX file of translations)")
    return Graphs(path) if path.suffix == ".mtlx" else Module(path)


def plain(values):
    """Returns the results of a translation as floats and tuples."""
    flat = {name: np.ravel(np.asarray(value, float)) for name, value in values.items()}
    for name, value in flat.items():
        if not np.isfinite(value).all():
            raise shaders.Unusable(f"the translation gives {name} = {value.tolist()}")
    return {name: tuple(value.tolist()) if value.size > 1 else float(value[0]) for name, value in flat.items()}


def versions(direction, values, translations):
    """Returns shader and values of the translation in use for a material, and of ours if there is one."""
    found = {IN_USE: in_use.shader_and_values(direction, values)}
    ours = translations.version(direction, values)
    if ours:
        found[OURS] = ours
    return found


def floor(direction, values, ours):
    """Returns shader and values of the closest pictures that a search finds. It starts from our translation, and from
    the starts of the model."""
    model = shaders.model_of(direction[1])
    stage, target = pictures.stage(direction[0], search.RESOLUTION), shaders.model_shader(model)
    source = stage.under_singles(pictures.shader_of(direction[0]), values)
    return target, search.closest(stage, source, target, ours, direction[1])


def judge(direction, values, translations, with_floor=False):
    """Returns the errors of each version of one material."""
    stage = pictures.stage(direction[0])
    source = stage.under_both(pictures.shader_of(direction[0]), values)
    found = versions(direction, values, translations)
    if with_floor:
        ours = translations.values(direction, values)
        found[FLOOR] = floor(direction, values, [ours] if ours else [])
    return {name: pictures.errors(source, stage.under_both(*version)) for name, version in found.items()}


def summary(errors):
    """Returns the entry of a table for the errors of many materials, by version."""
    table = {}
    for name in (IN_USE, OURS, FLOOR):
        linear = np.array([one[name]["linear"] for one in errors if name in one])
        display = np.array([one[name]["display"] for one in errors if name in one])
        if linear.size:
            table[name] = {"mean": float(linear.mean()), "median": float(np.median(linear)), "worst": float(linear.max()),
                           "display": float(display.mean())}
    return table
