"""Renders MaterialX: OpenPBR, standard_surface, glTF PBR and UsdPreviewSurface, as shaders that MaterialX generates
for OpenGL.

Prefix and name of a model contain the versions of MaterialX and of the definition, because both change pictures.
Nothing but the lights is bright, so what is seen through a transparent surface is black. The tangent of anisotropy
runs from left to right. This file must not be named materialx.py, because on some systems it would be imported
instead of the library.
"""
import os

import materialx_shaders as shaders
from worker_loop import Refused, grey_or_rgb, parameter, serve

PREFIX = f"materialx-{shaders.mx.getVersionString()}"

# These inputs have the roles roughness, specular and diffuse. OpenPBR and UsdPreviewSurface have no diffuse here.
# Their diffuse lobes lose light at grazing angles even if nothing is reflected, so they cannot be used to match
# light.
ROLES = {"open_pbr_surface": ("specular_roughness", "specular_weight"),
         "standard_surface": ("specular_roughness", "specular", "base_color"),
         "gltf_pbr": ("roughness", "specular", "base_color"),
         "UsdPreviewSurface": ("roughness", "specularColor")}
# These defaults differ from the definition, so that each model starts as a highlight of a dielectric, without
# diffuse.
STARTS = {"open_pbr_surface": {"base_color": 0}, "gltf_pbr": {"metallic": 0},
          "UsdPreviewSurface": {"useSpecularWorkflow": 1, "diffuseColor": 0}}
SHORT = {"open_pbr_surface": "open_pbr", "UsdPreviewSurface": "usd_preview_surface"}

LEAST_ROUGHNESS = 0.02  # the highlight of a smoother lobe is smaller than a pixel of most pictures
MOST = 1000  # limit of inputs whose definition has no upper end: depths, distances, strengths
# inputs whose integer is one of several choices, with the largest integer
CHOICES = {"alpha_mode": 2, "opacityMode": 1}
KINDS = ("float", "color3", "integer", "boolean")
UNUSED = ("displacement",)  # displacement moves vertices, which this sphere does not have


def range_of(given):
    """Returns the range of an input in its definition. For an index of refraction or an Abbe number, it prefers the
    range that user interfaces suggest."""
    ends = []
    for hard, soft in (("uimin", "uisoftmin"), ("uimax", "uisoftmax")):
        first, second = (soft, hard) if given.getName().lower().endswith(("ior", "abbe_number")) else (hard, soft)
        word = given.getAttribute(first) or given.getAttribute(second)
        ends.append(float(word.split(",")[0]) if word else None)
    least, most = ends
    if most is None:
        most = 1 if given.getType() == "boolean" else CHOICES.get(given.getName(), MOST)
    return least or 0, most


def decimal(default):
    """Returns a default with the digits that people write, because OpenGL stores it as a float."""
    return float(f"{default[0] if isinstance(default, tuple) else default:.6g}")


def described(given, role, default):
    """Returns the parameter of an input. A default color that is not grey becomes its first channel."""
    least, most = range_of(given)
    grey = {} if given.getType() == "color3" else {"grey": True}
    if role == "roughness":
        return parameter(given.getName(), role, LEAST_ROUGHNESS, most, convention="roughness")
    if role != "other":
        return parameter(given.getName(), role, least, most, **grey)
    return parameter(given.getName(), role, least, most, default=decimal(default), **grey)


def parameters_of(model):
    """Returns the parameters of a model: all inputs except vectors, which are normals and tangents."""
    shader = shaders.model_shader(model)
    defaults = {**shader.defaults, **STARTS.get(model, {})}
    roles = dict(zip(ROLES[model], ("roughness", "specular", "diffuse")))
    inputs = [one for one in shader.definition.getActiveInputs() if one.getType() in KINDS and one.getName() not in UNUSED]
    return [described(one, roles.get(one.getName(), "other"), defaults.get(one.getName(), 0)) for one in inputs]


models = {}  # names of models in MaterialX, by their names in the protocol


def describe(threads):
    os.environ["LP_NUM_THREADS"] = str(threads)
    for model in shaders.MODELS:
        version = shaders.model_shader(model).definition.getVersionString()
        models[f"{PREFIX}/{SHORT.get(model, model)}-{version}"] = model
    driver = shaders.gl().info
    return {"renderer": f"MaterialX {shaders.mx.getVersionString()} ({driver['GL_RENDERER']}, {driver['GL_VERSION']})",
            "models": [{"name": name, "parameters": parameters_of(model)} for name, model in models.items()]}


def input_values(shader, values):
    """Returns values in the types of the inputs. Refuses a number between two choices."""
    for name, kind in shader.types.items():
        if kind in ("integer", "boolean") and name in values and values[name][0] != int(values[name][0]):
            raise Refused(f"{name} = {values[name][0]} is not an integer")
    return {name: tuple(grey_or_rgb(value)) if shader.types[name] == "color3" else value[0] for name, value in values.items()}


def render(request, values):
    scene = request["scene"]
    side, samples = scene["resolution"], scene["samples_per_axis"]
    shader = shaders.model_shader(models[request["model"]])
    light = shaders.Light(shaders.POINT, tuple(scene["light"]["position"]), (scene["light"]["intensity"],) * 3)
    camera = shaders.Camera(scene["camera"]["distance"], scene["camera"]["half_angle"])
    picture = shader.render(input_values(shader, values), [light], side * samples, camera)
    return picture.reshape(side, samples, side, samples, 3).mean(axis=(1, 3))


serve(describe, render)
