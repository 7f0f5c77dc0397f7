"""Renders POV-Ray 3.7: its specular (Blinn) and Phong highlights, in one process for each picture.

Both are powers of a cosine, without the cosine of the light, normalisation or Fresnel. POV-Ray's `specular` has
`roughness`. Its inverse, the exponent, is used here, so that both models have the same parameter. POV-Ray's diffuse
lacks the factor 1 / pi, so the factor is applied to the lamp instead. The lamp falls off with the square of the
distance d by `fade_power 2` and a tiny `fade_distance` f, as 2 f^2 / d^2. Pictures are OpenEXR with half floats: 11
bits.
"""
import math
import os
import subprocess

import numpy as np
import OpenEXR

from worker_loop import grey_or_rgb, parameter, serve

FADE = 1e-3
HALF_FLOAT = 5e-4
MODELS = [{"name": f"povray/{name}", "precision": HALF_FLOAT, "parameters": [
    parameter("exponent", "roughness", 0.01, 20000, convention="exponent"),
    parameter("specular", "specular", 0, 1, grey=True), parameter("diffuse", "diffuse", 0, 1)]}
    for name in ("specular", "phong")]
OPTIONS = "+FE -D -A -V -GA File_Gamma=1.0".split()


def describe(threads):
    OPTIONS.append(f"+WT{threads}")
    said = subprocess.run(["povray", "--version"], capture_output=True, text=True, check=True)
    lines = (said.stdout + said.stderr).splitlines()
    return {"renderer": next(line.strip() for line in lines if line.startswith("POV-Ray")), "models": MODELS}


def scene_text(request, values):
    camera, light = request["scene"]["camera"], request["scene"]["light"]
    width = 2 * math.tan(math.radians(camera["half_angle"]))
    x, y, z = light["position"]
    strength = light["intensity"] / math.pi / (2 * FADE ** 2)
    red, green, blue = grey_or_rgb(values["diffuse"])
    specular, exponent = values["specular"][0], values["exponent"][0]
    highlight = (f"specular {specular!r} roughness {1 / exponent!r}" if request["model"] == "povray/specular" else
                 f"phong {specular!r} phong_size {exponent!r}")
    return f"""#version 3.7; global_settings {{ assumed_gamma 1.0 max_trace_level 1 }}
camera {{ perspective location <0, 0, {camera["distance"]!r}> direction <0, 0, -1> up <0, {width!r}, 0>
  right <{width!r}, 0, 0> }}
light_source {{ <{x!r}, {y!r}, {z!r}> rgb {strength!r} fade_distance {FADE} fade_power 2 }}
sphere {{ 0, 1 pigment {{ rgb <{red!r}, {green!r}, {blue!r}> }}
  finish {{ {highlight} diffuse 1 ambient 0 emission 0 }} }}
"""


def render(request, values):
    side, samples = request["scene"]["resolution"], request["scene"]["samples_per_axis"]
    scene, picture = request["image"] + ".pov", request["image"] + ".exr"
    try:
        with open(scene, "w", encoding="ascii") as file:
            file.write(scene_text(request, values))
        size = side * samples
        done = subprocess.run(["povray", f"+I{scene}", f"+O{picture}", f"+W{size}", f"+H{size}", *OPTIONS],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError("povray: " + " ".join(done.stderr.split()[-40:]))
        with OpenEXR.File(picture) as file:
            pixels = np.asarray(file.channels()["RGB"].pixels, np.float32)[:, :, :3]
    finally:
        for path in (scene, picture):
            if os.path.exists(path):
                os.remove(path)
    return pixels.reshape(side, samples, side, samples, 3).mean(axis=(1, 3), dtype=np.float64)


serve(describe, render)
