"""Renders Mitsuba 3, variant scalar_rgb: rough conductors without Fresnel, rough plastic, the principled BSDF.

The sampler `stratified` without jitter gives an exact N x N grid, and the box filter does not blur. A conductor has
no diffuse. To add it, both lobes are blended in equal halves under a light twice as bright.
"""
import collections
import math

import drjit
import mitsuba as mi

from worker_loop import grey_or_rgb, parameter, serve

mi.set_variant("scalar_rgb")

ALPHA = parameter("alpha", "roughness", 1e-4, 1, convention="alpha")
MODELS = [
    {"name": "mitsuba3/ggx", "parameters": [ALPHA, parameter("specular", "specular", 0, 1),
                                            parameter("diffuse", "diffuse", 0, 1)]},
    {"name": "mitsuba3/beckmann", "parameters": [ALPHA, parameter("specular", "specular", 0, 1),
                                                 parameter("diffuse", "diffuse", 0, 1)]},
    # This plastic has the exact Fresnel of a dielectric. Its diffuse lobe is below the interface and loses the
    # reflected light.
    {"name": "mitsuba3/plastic", "parameters": [ALPHA, parameter("specular", "specular", 0, 1),
                                                parameter("diffuse", "diffuse", 0, 1),
                                                parameter("ior", "other", 1.01, 4, default=1.5, grey=True)]},
    {"name": "mitsuba3/principled-metal", "parameters": [
        parameter("roughness", "roughness", 0.0317, 1, convention="roughness"),
        parameter("base_color", "specular", 0, 1),
        parameter("specular", "other", 0, 1, default=0.5, grey=True)]},
    {"name": "mitsuba3/principled-dielectric", "parameters": [
        parameter("roughness", "roughness", 0.0317, 1, convention="roughness"),
        parameter("specular", "specular", 0, 1, grey=True),
        parameter("base_color", "diffuse", 0, 1)]},
]

scenes = collections.OrderedDict()
MOST_SCENES = 8  # each model, resolution and light needs a scene, and a sweep uses few


def describe(threads):
    drjit.set_thread_count(threads)
    return {"renderer": f"Mitsuba {mi.__version__} (scalar_rgb)", "models": MODELS, "meshes": True}


def rgb(values):
    return {"type": "rgb", "value": grey_or_rgb(values)}


def bsdf_of(model, values):
    kind = model.split("/")[1]
    if kind in ("ggx", "beckmann"):
        return {"type": "blendbsdf", "weight": 0.5,
                "lobe": {"type": "roughconductor", "distribution": kind, "alpha": values["alpha"][0],
                         "material": "none", "specular_reflectance": rgb([0.5])},
                "paint": {"type": "diffuse", "reflectance": rgb([0.5])}}
    if kind == "plastic":
        return {"type": "roughplastic", "distribution": "ggx", "alpha": values["alpha"][0],
                "int_ior": values["ior"][0], "ext_ior": 1.0,
                "specular_reflectance": rgb(values["specular"]), "diffuse_reflectance": rgb(values["diffuse"])}
    metal = kind == "principled-metal"
    return {"type": "principled", "roughness": values["roughness"][0], "metallic": 1.0 if metal else 0.0,
            "specular": values["specular"][0], "base_color": rgb(values["base_color"])}


def shape_of(scene):
    return {"type": "ply", "filename": scene["mesh"]} if "shape" in scene else {"type": "sphere"}


def make_scene(model, values, scene):
    side, light = scene["resolution"], 2.0 if model in ("mitsuba3/ggx", "mitsuba3/beckmann") else 1.0
    distance = scene["camera"]["distance"]
    return mi.load_dict({
        "type": "scene",
        "integrator": {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0},
        "sensor": {"type": "perspective", "fov": 2 * scene["camera"]["half_angle"],
                   "to_world": mi.ScalarTransform4f().look_at([0, 0, distance], [0, 0, 0], [0, 1, 0]),
                   "film": {"type": "hdrfilm", "width": side, "height": side, "rfilter": {"type": "box"},
                            "pixel_format": "rgb", "component_format": "float32"},
                   "sampler": {"type": "stratified", "sample_count": scene["samples_per_axis"] ** 2,
                               "jitter": False}},
        "light": {"type": "point", "position": scene["light"]["position"],
                  "intensity": rgb([light * scene["light"]["intensity"]])},
        "ball": {**shape_of(scene), "bsdf": bsdf_of(model, values)}})


def scene_of(model, values, scene):
    """Returns a scene. Scenes of conductors are kept and updated. Other scenes take only a millisecond to make."""
    if model not in ("mitsuba3/ggx", "mitsuba3/beckmann"):
        return make_scene(model, values, scene)
    key = (model, scene["resolution"], scene["samples_per_axis"], tuple(scene["light"]["position"]),
           scene.get("shape"))
    if key not in scenes:
        scenes[key] = make_scene(model, values, scene)
        if len(scenes) > MOST_SCENES:
            scenes.popitem(last=False)
    scenes.move_to_end(key)
    numbers = mi.traverse(scenes[key])
    numbers["ball.bsdf.bsdf_0.alpha.value"] = values["alpha"][0]
    numbers["ball.bsdf.bsdf_0.specular_reflectance.value"] = mi.Color3f(grey_or_rgb(values["specular"]))
    numbers["ball.bsdf.bsdf_1.reflectance.value"] = mi.Color3f(grey_or_rgb(values["diffuse"]))
    numbers.update()
    return scenes[key]


def render(request, values):
    scene = request["scene"]
    samples = scene["samples_per_axis"] ** 2
    return mi.render(scene_of(request["model"], values, scene), spp=samples, seed=request["seed"])


serve(describe, render)
