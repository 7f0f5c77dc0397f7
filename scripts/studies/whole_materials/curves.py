"""Measures the five lobes without a closed form. A search over a single lobe finds the parameters that look most like
another lobe."""
import dataclasses
import json
import pathlib
from collections.abc import Callable

import numpy as np

import materialx_shaders as shaders
from whole_materials import in_use, pictures, search

RECORD = pathlib.Path(__file__).with_name("curves.json")
RESOLUTION = 64
MOVED = 0.02  # a parameter that moves by less is treated as unchanged


@dataclasses.dataclass(frozen=True)
class Curve:
    """Describes one lobe. `source` makes a material from the points. `rest` holds what the target needs to show only
    this lobe."""
    name: str
    direction: tuple
    columns: tuple  # names of a point's numbers
    points: tuple
    source: Callable
    searched: dict  # inputs of the target to search, with their ranges
    rest: dict
    starts: tuple


def fuzz(roughness):
    return {"base_weight": 0, "specular_weight": 0, "fuzz_weight": 1, "fuzz_roughness": roughness}


def sheen(roughness):
    return {"base": 0, "specular": 0, "sheen": 1, "sheen_roughness": roughness}


# At an index of refraction of 1, the specular lobe reflects nothing, and both models dim the lobes below it equally.
def eon(roughness, albedo):
    return {"base_color": (albedo,) * 3, "base_diffuse_roughness": roughness, "specular_ior": 1}


def oren_nayar(roughness, albedo):
    return {"base": 1, "base_color": (albedo,) * 3, "diffuse_roughness": roughness, "specular": 1, "specular_IOR": 1}


def edge(f0, f82):
    return {"base_color": (f0,) * 3, "base_metalness": 1, "specular_color": (f82,) * 3, "specular_roughness": 0.3}


TO_STANDARD, TO_OPEN = ("open_pbr_surface", "standard_surface"), ("standard_surface", "open_pbr_surface")
ROUGHNESSES, TENTHS = (0.2, 0.4, 0.6, 0.8, 1.0), (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)
DIFFUSE_POINTS = tuple((roughness, albedo) for albedo in (0.1, 0.5, 0.95) for roughness in ROUGHNESSES)
CURVES = (
    Curve("fuzz to sheen", TO_STANDARD, ("fuzz_roughness",), tuple((r,) for r in TENTHS[1:]), fuzz,
          {"sheen_roughness": (0.01, 1), "sheen_color": (0, 2)}, {"base": 0, "specular": 0, "sheen": 1},
          ({"sheen_roughness": 0.1, "sheen_color": 0.6}, {"sheen_roughness": 0.4, "sheen_color": 1},
           {"sheen_roughness": 0.9, "sheen_color": 1})),
    Curve("sheen to fuzz", TO_OPEN, ("sheen_roughness",), tuple((r,) for r in TENTHS), sheen,
          {"fuzz_roughness": (0.01, 1), "fuzz_color": (0, 2)}, {"base_weight": 0, "specular_weight": 0, "fuzz_weight": 1},
          ({"fuzz_roughness": 0.5, "fuzz_color": 1}, {"fuzz_roughness": 0.8, "fuzz_color": 0.8})),
    Curve("EON to Oren-Nayar", TO_STANDARD, ("base_diffuse_roughness", "albedo"), DIFFUSE_POINTS, eon,
          {"diffuse_roughness": (0, 1), "base_color": (0, 2)}, {"base": 1, "specular": 1, "specular_IOR": 1},
          ({"diffuse_roughness": 0.3, "base_color": 0.5},)),
    Curve("Oren-Nayar to EON", TO_OPEN, ("diffuse_roughness", "albedo"), DIFFUSE_POINTS, oren_nayar,
          {"base_diffuse_roughness": (0, 1), "base_color": (0, 2)}, {"specular_ior": 1},
          ({"base_diffuse_roughness": 0.3, "base_color": 0.5},)),
    Curve("F82 to artistic edge", TO_STANDARD, ("F0", "F82"),
          tuple((f0, f82) for f0 in (0.3, 0.6, 0.9) for f82 in (0.4, 0.7, 0.9, 1.0)), edge,
          {"specular_color": (0, 1)}, {"base": 1, "metalness": 1, "specular": 1, "specular_roughness": 0.3},
          ({"specular_color": 0.1}, {"specular_color": 0.5}, {"specular_color": 0.8}, {"specular_color": 0.97})),
)


def closest(curve, stage, source, target, fixed):
    """Returns the numbers of the searched inputs with the closest pictures. Each input is one number, because the lobes are grey."""
    low, high = (np.array(ends, float) for ends in zip(*curve.searched.values()))

    def values(x):
        return {**fixed, **dict(zip(curve.searched, x.tolist()))}

    def residuals(x):
        return (stage.under_singles(target, values(x)) - source).ravel()

    starts = [np.array([start[name] for name in curve.searched], float) for start in curve.starts]
    found = [search.minimise(residuals, start, low, high, 30) for start in starts]
    return values(min(found, key=lambda x: (residuals(x) ** 2).sum()))


def shown(curve, values):
    """Returns the searched inputs, multiplied by their weights, because only the product is visible."""
    weights = {"sheen_color": "sheen", "fuzz_color": "fuzz_weight"}
    if curve.name.startswith(("EON", "Oren")):
        weights["base_color"] = "base" if curve.direction == TO_STANDARD else "base_weight"
    return {name: float(np.mean(values[name])) * float(values.get(weights.get(name), 1)) for name in curve.searched}


def measure(curve, translations):
    """Returns a row for each point: the closest parameters, what the translation uses, and the errors of both and of
    the translation in use."""
    stage, target = pictures.stage(curve.direction[0], RESOLUTION), shaders.model_shader(curve.direction[1])
    rows = []
    for point in curve.points:
        values = curve.source(*point)
        source = stage.under_singles(shaders.model_shader(curve.direction[0]), values)

        def error(shader, other):
            return pictures.relative_error(source, stage.under_singles(shader, other))

        fixed = {**curve.rest, **({"base_color": values["base_color"]} if curve.source is edge else {})}
        found = closest(curve, stage, source, target, fixed)
        row = {"point": list(point), "closest": shown(curve, found), "error": error(target, found),
               "error_in_use": error(*in_use.shader_and_values(curve.direction, values))}
        ours = translations.values(curve.direction, values)
        if ours:
            row.update(ours=shown(curve, ours), error_ours=error(target, ours))
        rows.append(row)
    return rows


def recorded():
    """Returns the recorded measurement, or an empty one."""
    return json.loads(RECORD.read_text()) if RECORD.exists() else {"materialx": None, "curves": {}}


def record(measured):
    kept = {name: [{part: rounded(row[part]) for part in ("point", "closest", "error")} for row in rows] for name, rows in measured.items()}
    lines = [f"  {json.dumps(name)}: [\n    " + ",\n    ".join(map(json.dumps, rows)) + "]" for name, rows in kept.items()]
    RECORD.write_text(f'{{"materialx": "{shaders.mx.getVersionString()}", "curves": {{\n' + ",\n".join(lines) + "}}\n")


def rounded(part):
    if isinstance(part, dict):
        return {name: round(value, 4) for name, value in part.items()}
    return part if isinstance(part, list) else round(part, 4)


def moved(rows, before):
    """Returns the points of a curve whose closest parameters or whose error differ from the record."""
    old = {tuple(row["point"]): row for row in before}
    found = []
    for row in rows:
        was = old.get(tuple(row["point"]))
        if was is None or abs(row["error"] - was["error"]) > MOVED or any(
                abs(value - was["closest"].get(name, 9)) > MOVED for name, value in row["closest"].items()):
            found.append(row["point"])
    return found
