"""Renders materials under the lights of the judgement, and computes the errors between pictures."""
import functools

import numpy as np

import materialx_shaders as shaders
from whole_materials import principled

RESOLUTION = 128
ANGLES = (0, 30, 60, 90)  # angles of the single lights to the right; a fifth light is 45 degrees above
ENVIRONMENTS, ENVIRONMENT_LIGHTS = 2, 12
ENVIRONMENT_SEED = 68  # environments are the same in every run, because only the materials are random


def single_lights():
    """Returns the five lights, one for each picture."""
    above = shaders.Light(shaders.DIRECTIONAL, (0.0, np.sqrt(0.5), np.sqrt(0.5)))
    return [[shaders.sun(angle)] for angle in ANGLES] + [[above]]


def environments():
    """Returns environments of coloured lights. White paper that faces the camera shows a display value of 1 under each."""
    random = np.random.default_rng(ENVIRONMENT_SEED)
    found = []
    for _ in range(ENVIRONMENTS):
        directions = random.normal(size=(ENVIRONMENT_LIGHTS, 3))
        directions[:, 2] = np.abs(directions[:, 2]) - 0.3
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        colors = random.uniform(0.1, 1, (ENVIRONMENT_LIGHTS, 3)) * random.uniform(0.2, 1, (ENVIRONMENT_LIGHTS, 1))
        colors *= np.pi / (colors * np.maximum(directions[:, 2:], 0)).sum(axis=0)
        found.append([shaders.Light(shaders.DIRECTIONAL, tuple(d), tuple(c)) for d, c in zip(directions.tolist(), colors.tolist())])
    return found


class Stage:
    """Holds camera and lights. Both models of a direction are rendered on the same stage."""

    def __init__(self, camera, move, resolution=RESOLUTION):
        self.camera, self.move, self.resolution = camera, move, resolution
        self.singles = [move(lights) for lights in single_lights()]
        self.environments = [move(lights) for lights in environments()]

    def under_singles(self, shader, values):
        return self.pictures(shader, values, self.singles)

    def under_both(self, shader, values):
        return self.pictures(shader, values, self.singles), self.pictures(shader, values, self.environments)

    def pictures(self, shader, values, light_sets):
        return np.stack([shader.render(values, lights, self.resolution, self.camera) for lights in light_sets])


@functools.cache
def stage(source, resolution=RESOLUTION):
    """Returns the stage for a source model. Cycles' worker only has point lights."""
    if source == "principled":
        return Stage(principled.far_camera(), principled.far_points, resolution)
    return Stage(shaders.Camera(), lambda lights: lights, resolution)


@functools.cache
def shader_of(model):
    """Returns an object that renders a model. For Principled it needs Blender, and otherwise raises Missing."""
    return principled.Principled() if model == "principled" else shaders.model_shader(model)


def relative_error(source, other):
    """Returns the rms of the difference of linear pictures, divided by the rms of the source."""
    return float(np.sqrt(((source - other) ** 2).mean() / max((source ** 2).mean(), 1e-20)))


def display(picture):
    """Returns values of sRGB, clipped to 0 to 1."""
    linear = np.clip(picture, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def display_error(source, other):
    """Returns the rms of the difference of display values, over the pixels of the sphere."""
    return float(np.sqrt(((display(source) - display(other)) ** 2)[:, inside(source.shape[1])].mean()))


def errors(source, other):
    """Returns the two errors of pictures, which are under both kinds of lights."""
    return {"linear": relative_error(source[0], other[0]), "display": display_error(source[1], other[1])}


@functools.cache
def inside(resolution):
    axis = (np.arange(resolution) + 0.5) / resolution * 2 - 1
    return axis[:, None] ** 2 + axis[None] ** 2 <= 1
