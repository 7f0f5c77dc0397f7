"""Renders materials of MuJoCo: Blinn's half-vector lobe, not normalised, with n = 128 times shininess, as OpenGL 1
lights it.

MuJoCo computes in the values that a display shows, without a transfer curve. The model `material` treats these
numbers as linear. The model `material-linear` is what its windows show on a display of gamma 2.2: specular and
diffuse are linear and are encoded for MuJoCo, and the picture is decoded. MuJoCo's lights do not fall off with the
distance unless a file says so, so this program applies the falloff to the picture.

The framebuffer has 8 bits and clamps to 1. A picture is rendered under brighter and brighter light, and each pixel
comes from the brightest picture that does not clamp it. MuJoCo lights only corners, so the sphere is a grid with
corners as close as pixels. This file must not be named mujoco.py, because it would be imported instead of the
library.
"""
import os

os.environ.setdefault("MUJOCO_GL", "egl")

import mujoco  # noqa: E402
import numpy as np  # noqa: E402

from worker_loop import grey_or_rgb, parameter, serve  # noqa: E402

EXPONENTS = (1.28, 128)  # shininess 0.01 to 1
LOBE = [parameter("exponent", "roughness", *EXPONENTS, convention="exponent"), parameter("specular", "specular", 0, 1)]
# The precision is a step of 8 bits under the brightest light. After decoding, the diffuse light of `material-linear`
# is not Lambertian and does not add to a highlight.
MODELS = [{"name": "mujoco/material", "precision": 2e-3, "parameters": [*LOBE, parameter("diffuse", "diffuse", 0, 1)]},
          {"name": "mujoco/material-linear", "precision": 2e-3, "parameters": [*LOBE, parameter("diffuse", "other", 0, 1, default=0)]}]

STEP, STEPS = 4, 7  # ratio of light between exposures; in the first, white is a quarter
CLAMPED = 250  # a pixel with at least this value, of 255, may be clamped
GRID = 512  # slices and stacks of the sphere
GAMMA = 2.2

SCENE = """<mujoco>
  <visual>
    <global offwidth="{side}" offheight="{side}"/>
    <quality offsamples="0" numslices="{grid}" numstacks="{grid}"/>
    <headlight active="0"/>
    <map znear="0.01"/>
  </visual>
  <asset><material name="skin" reflectance="0" emission="0" specular="1" shininess="1" rgba="1 1 1 1"/></asset>
  <worldbody>
    <light name="lamp" pos="0 0 3" dir="0 0 -1" cutoff="180" exponent="0" attenuation="0 0 1" ambient="0 0 0" castshadow="false"/>
    <camera name="eye" pos="0 0 {distance}" xyaxes="1 0 0 0 1 0" fovy="{fovy}"/>
    <geom type="sphere" size="1" material="skin"/>
  </worldbody>
</mujoco>"""


def describe(_threads):
    return {"renderer": f"MuJoCo {mujoco.__version__}", "models": MODELS}


class Stage:
    """Holds the scene and the window for one size of picture."""

    def __init__(self, side, camera):
        self.model = mujoco.MjModel.from_xml_string(SCENE.format(
            side=side, grid=GRID, distance=camera["distance"], fovy=2 * camera["half_angle"]))
        self.data = mujoco.MjData(self.model)
        self.renderer = mujoco.Renderer(self.model, side, side)

    def close(self):
        self.renderer.close()

    def values(self, light, specular, shininess, rgb):
        """Returns what OpenGL computes under a light of 1, without clamping."""
        self.model.mat_specular[0] = specular
        self.model.mat_shininess[0] = shininess
        self.model.mat_rgba[0] = [*rgb, 1]
        self.model.light_pos[0] = light
        self.model.light_dir[0] = -np.asarray(light) / np.linalg.norm(light)
        best = None
        nearest = np.linalg.norm(light) - 1
        white = nearest ** 2 if self.model.light_attenuation[0][2] else 1
        for step in range(STEPS):
            intensity = white * float(STEP) ** (step - 1)
            self.model.light_diffuse[0] = self.model.light_specular[0] = intensity
            mujoco.mj_forward(self.model, self.data)
            self.renderer.update_scene(self.data, camera="eye")
            pixels = self.renderer.render().astype(np.float64)
            if best is None:
                best = pixels / (255 * intensity)
            clear = (pixels < CLAMPED) & (pixels > 0)
            best[clear] = pixels[clear] / (255 * intensity)
        return best


stages = {}


def stage(side, camera):
    if side not in stages:
        for old in stages.values():
            old.close()
        stages.clear()
        stages[side] = Stage(side, camera)
    return stages[side]


def squared_distances(side, camera, light):
    """Returns the squared distances from the light to the points that pixels show, and 1 for other pixels."""
    half, distance = np.tan(np.radians(camera["half_angle"])), camera["distance"]
    axis = (2 * (np.arange(side) + 0.5) / side - 1) * half
    x, y = np.meshgrid(axis, -axis)
    a = x * x + y * y + 1
    inside = np.maximum(distance ** 2 - a * (distance ** 2 - 1), 0)
    t = (distance - np.sqrt(inside)) / a
    points = np.stack([t * x, t * y, distance - t], axis=-1)
    return np.where(inside > 0, ((points - np.asarray(light)) ** 2).sum(axis=-1), 1)


def render(request, values):
    scene = request["scene"]
    side, samples = scene["resolution"], scene["samples_per_axis"]
    light = scene["light"]
    place = stage(side * samples, scene["camera"])
    specular, rgb = np.asarray(grey_or_rgb(values["specular"])), np.asarray(grey_or_rgb(values["diffuse"]))
    is_linear = request["model"].endswith("-linear")
    place.model.light_attenuation[0] = [1, 0, 0] if is_linear else [0, 0, 1]
    if is_linear:
        specular, rgb = specular ** (1 / GAMMA), rgb ** (1 / GAMMA)
    shininess = values["exponent"][0] / 128
    # MuJoCo's specular is one number, so a color needs one picture per channel.
    if len(set(specular)) == 1:
        picture = place.values(light["position"], specular[0], shininess, rgb)
    else:
        picture = np.stack([place.values(light["position"], specular[c], shininess, rgb)[..., c] for c in range(3)], axis=-1)
    if is_linear:
        picture = picture ** GAMMA / squared_distances(side * samples, scene["camera"], light["position"])[..., None]
    picture *= light["intensity"] / np.pi
    return picture.reshape(side, samples, side, samples, 3).mean(axis=(1, 3))


serve(describe, render)
