"""Draws six pictures for a page. Each shows a material as it is, as the translation in use makes it, and as ours
does, side by side."""
import dataclasses
import pathlib

import numpy as np

from whole_materials import documents, in_use, judge, pictures, site

SIDE, MARGIN = 160, 6
GROUND = 0.94  # display value of the light background
MOST_BYTES = 60_000


@dataclasses.dataclass(frozen=True)
class Subject:
    """Describes a material of the gallery: the name of an example document, or the inputs themselves."""
    name: str
    direction: tuple
    material: object


SUBJECTS = [
    Subject("car-paint", ("UsdPreviewSurface", "open_pbr_surface"), "usd_preview_surface_carpaint"),
    Subject("brushed-aluminium", ("open_pbr_surface", "standard_surface"), "open_pbr_aluminum_brushed"),
    Subject("velvet", ("open_pbr_surface", "gltf_pbr"), "open_pbr_velvet"),
    # This is gold below a lacquer. Many metals of standard_surface get their color in this way.
    Subject("gold", ("standard_surface", "open_pbr_surface"),
            {"base": 1.0, "base_color": (0.944, 0.776, 0.373), "metalness": 1.0, "specular_color": (0.998, 0.981, 0.751),
             "specular_roughness": 0.35, "coat": 1.0, "coat_color": (1.0, 0.62, 0.4), "coat_roughness": 0.15}),
    # This is a matt plastic below a smooth coat.
    Subject("plastic", ("principled", "open_pbr_surface"),
            {**in_use.PRINCIPLED_DEFAULTS, "base_color": (0.7, 0.05, 0.04), "roughness": 0.4, "coat_weight": 1.0, "coat_roughness": 0.15}),
    # This is a rough diffuse surface with a layer of fibres.
    Subject("cloth", ("open_pbr_surface", "standard_surface"),
            {"base_color": (0.08, 0.16, 0.42), "base_diffuse_roughness": 1.0, "specular_roughness": 0.7, "specular_weight": 0.5,
             "fuzz_weight": 0.8, "fuzz_color": (0.7, 0.8, 1.0), "fuzz_roughness": 0.7}),
]


def values_of(subject, folder):
    """Returns the inputs of a material. An example document is read from the folder."""
    if isinstance(subject.material, dict):
        return subject.material
    found, skipped = documents.materials(pathlib.Path(folder) / f"{subject.material}.mtlx")
    return found[0][2]


def strip(balls):
    """Returns the bytes of a PNG file of spheres side by side on a light background."""
    width = len(balls) * SIDE + (len(balls) + 1) * MARGIN
    picture = np.full((SIDE + 2 * MARGIN, width, 3), GROUND)
    for number, ball in enumerate(balls):
        left = MARGIN + number * (SIDE + MARGIN)
        part = picture[MARGIN:MARGIN + SIDE, left:left + SIDE]
        part += (ball[..., :3] - part) * ball[..., 3:]
    return site.png(np.round(255 * picture).astype(np.uint8))


def write(subject, folder, examples, translations):
    """Writes one picture into a folder. Returns the size of the file in bytes, and the errors of each version."""
    values = values_of(subject, examples)
    stage, source = pictures.stage(subject.direction[0]), pictures.shader_of(subject.direction[0])
    versions = judge.versions(subject.direction, values, translations)
    data = strip([site.portrait(stage, *one, SIDE) for one in ((source, values), *versions.values())])
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{subject.name}.png").write_bytes(data)
    reference = stage.under_both(source, values)
    return len(data), {who: pictures.errors(reference, stage.under_both(*version)) for who, version in versions.items()}


def words_of(direction):
    """Returns a direction in words, and what is in use for it."""
    return f"{site.NAMES[direction[0]]} to {site.NAMES[direction[1]]} ({in_use.name_of(direction)})"
