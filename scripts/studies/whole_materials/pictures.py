"""Pictures of materials under the lights of the judgement, and the errors between them."""
import functools

import numpy as np

import materialx_shaders as shaders

RESOLUTION = 128
ANGLES = (0, 30, 60, 90)  # of single lights, to the right; a fifth one stands 45 degrees above
ENVIRONMENTS, ENVIRONMENT_LIGHTS = 2, 12
ENVIRONMENT_SEED = 68  # environments are the same in every run, because materials are what is drawn


@functools.cache
def single_lights():
    """Returns the five lights, one for each picture."""
    above = shaders.Light(shaders.DIRECTIONAL, (0.0, np.sqrt(0.5), np.sqrt(0.5)))
    return [[shaders.sun(angle)] for angle in ANGLES] + [[above]]


@functools.cache
def environments():
    """Returns environments of coloured lights from all directions in front and beside, with an irradiance of about pi in front."""
    random = np.random.default_rng(ENVIRONMENT_SEED)
    found = []
    for _ in range(ENVIRONMENTS):
        directions = random.normal(size=(ENVIRONMENT_LIGHTS, 3))
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        directions[:, 2] = np.abs(directions[:, 2]) - 0.3
        colors = random.uniform(0.1, 1, (ENVIRONMENT_LIGHTS, 3)) * random.uniform(0.2, 1, (ENVIRONMENT_LIGHTS, 1))
        colors *= np.pi / (colors * np.maximum(directions[:, 2:], 0)).sum(axis=0)
        found.append([shaders.Light(shaders.DIRECTIONAL, tuple(d), tuple(c)) for d, c in zip(directions.tolist(), colors.tolist())])
    return found


def pictures(shader, values, light_sets, resolution=RESOLUTION):
    return np.stack([shader.render(values, lights, resolution) for lights in light_sets])


def relative_error(source, other):
    """Returns the rms of the difference of linear pictures, divided by the rms of the source."""
    return float(np.sqrt(((source - other) ** 2).mean() / np.maximum((source ** 2).mean(), 1e-20)))


def display(picture):
    """Returns values of sRGB, clipped to 0 to 1."""
    linear = np.clip(picture, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def display_error(source, other):
    """Returns the rms of the difference of display values, over the pixels of the sphere."""
    inside = sphere_mask(source.shape[-2])
    return float(np.sqrt(((display(source) - display(other)) ** 2)[:, inside].mean()))


@functools.cache
def sphere_mask(resolution):
    axis = (np.arange(resolution) + 0.5) / resolution * 2 - 1
    return axis[:, None] ** 2 + axis[None] ** 2 <= 1
