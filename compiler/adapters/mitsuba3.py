"""Renders Mitsuba 3, variant scalar_rgb: rough conductors without Fresnel, rough plastic, the principled BSDF.

The sampler `stratified` without jitter gives an exact N x N grid, and the box filter does not blur. A conductor has
no diffuse. To add it, both lobes are blended in equal halves under a light twice as bright.
"""
import collections
import math

import drjit
import mitsuba as mi
import numpy as np

from worker_loop import environment_of, grey_or_rgb, has_maps, parameter, serve

mi.set_variant("scalar_rgb")

ALPHA = parameter("alpha", "roughness", 1e-4, 1, convention="alpha")
MODELS = [
    {"name": "mitsuba3/ggx", "textures": True, "parameters": [
        ALPHA, parameter("specular", "specular", 0, 1), parameter("diffuse", "diffuse", 0, 1)]},
    {"name": "mitsuba3/beckmann", "textures": True, "parameters": [
        ALPHA, parameter("specular", "specular", 0, 1), parameter("diffuse", "diffuse", 0, 1)]},
    # This plastic has the exact Fresnel of a dielectric. Its diffuse lobe is below the interface and loses the
    # reflected light.
    {"name": "mitsuba3/plastic", "parameters": [ALPHA, parameter("specular", "specular", 0, 1),
                                                parameter("diffuse", "diffuse", 0, 1),
                                                parameter("ior", "other", 1.01, 4, default=1.5, grey=True)]},
    {"name": "mitsuba3/principled-metal", "textures": True, "parameters": [
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
    return texture(values) if isinstance(values, np.ndarray) else {"type": "rgb", "value": grey_or_rgb(values)}


def number(values):
    return texture(values) if isinstance(values, np.ndarray) else values[0]


def texture(values):
    """Returns a texture whose columns cover the half of the sphere that the camera sees, if AXES turns the sphere. The
    texture repeats on the other half."""
    return {"type": "bitmap", "bitmap": mi.Bitmap(values), "raw": True,
            "to_uv": mi.ScalarTransform4f().translate([0.5, 0, 0]).scale([2, 1, 1])}


# With this transform, the axis of the sphere is +y, and its texture begins at +z.
AXES = mi.ScalarTransform4f(np.array([[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [0, 0, 0, 1]], float))


def bsdf_of(model, values):
    kind = model.split("/")[1]
    if kind in ("ggx", "beckmann"):
        return {"type": "blendbsdf", "weight": 0.5,
                "lobe": {"type": "roughconductor", "distribution": kind, "alpha": number(values["alpha"]),
                         "material": "none", "specular_reflectance": rgb(values["specular"])},
                "paint": {"type": "diffuse", "reflectance": rgb(values["diffuse"])}}
    if kind == "plastic":
        return {"type": "roughplastic", "distribution": "ggx", "alpha": values["alpha"][0],
                "int_ior": values["ior"][0], "ext_ior": 1.0,
                "specular_reflectance": rgb(values["specular"]), "diffuse_reflectance": rgb(values["diffuse"])}
    metal = kind == "principled-metal"
    return {"type": "principled", "roughness": number(values["roughness"]), "metallic": 1.0 if metal else 0.0,
            "specular": values["specular"][0], "base_color": rgb(values["base_color"])}


def shape_of(scene):
    return {"type": "ply", "filename": scene["mesh"]} if "shape" in scene else {"type": "sphere"}


def lamp(scene, power):
    return {"type": "point", "position": scene["light"]["position"], "intensity": rgb([power * scene["light"]["intensity"]])}


def dome(environment, power):
    """Returns an environment. The middle column of Mitsuba's map is +z, not -z."""
    turned = np.roll(environment, environment.shape[1] // 2, axis=1)
    return {"type": "envmap", "bitmap": mi.Bitmap(turned), "scale": power}


def make_scene(model, values, scene, environment=None):
    side, light = scene["resolution"], 2.0 if model in ("mitsuba3/ggx", "mitsuba3/beckmann") else 1.0
    distance = scene["camera"]["distance"]
    return mi.load_dict({
        "type": "scene",
        "integrator": {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0 if environment is None else 1,
                       "hide_emitters": True},
        "sensor": {"type": "perspective", "fov": 2 * scene["camera"]["half_angle"],
                   "to_world": mi.ScalarTransform4f().look_at([0, 0, distance], [0, 0, 0], [0, 1, 0]),
                   "film": {"type": "hdrfilm", "width": side, "height": side, "rfilter": {"type": "box"},
                            "pixel_format": "rgb" if environment is None else "rgba", "component_format": "float32"},
                   "sampler": {"type": "stratified", "sample_count": scene["samples_per_axis"] ** 2, "jitter": False}
                   if environment is None else {"type": "multijitter"}},
        "light": lamp(scene, light) if environment is None else dome(environment, light),
        "ball": {**shape_of(scene), **({"to_world": AXES} if has_maps(values) else {}), "bsdf": bsdf_of(model, values)}})


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
    scene, environment = request["scene"], environment_of(request)
    is_kept = environment is None and not has_maps(values)
    ready = scene_of(request["model"], values, scene) if is_kept else make_scene(request["model"], values, scene, environment)
    samples = scene["samples_per_axis"] ** 2 * scene["light"].get("samples", 1)
    picture = mi.render(ready, spp=samples, seed=request["seed"])
    if environment is None:
        return picture
    # A pixel at the edge of the sphere becomes the mean over its part that shows the sphere.
    picture = np.array(picture)
    return picture[:, :, :3] / np.maximum(picture[:, :, 3:], 1e-6)


serve(describe, render)
