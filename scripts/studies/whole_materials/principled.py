"""Renders pictures of Blender's Principled BSDF by the worker of Cycles (compiler/adapters/PROTOCOL.md)."""
import json
import math
import os
import pathlib
import subprocess
import tempfile

import numpy as np

import materialx_shaders as shaders

ADAPTERS = pathlib.Path(shaders.__file__).resolve().parent
MODEL = "cycles-5/principled-whole"


class Missing(Exception):
    """Blender's Python module is not installed."""


def python_of_blender():
    """Returns the Python that has bpy: $REMAP_BPY_PYTHON, or the one that scripts/renderers cycles-5 installs."""
    data = pathlib.Path(os.environ.get("XDG_DATA_HOME") or "~/.local/share").expanduser()
    renderers = pathlib.Path(os.environ.get("REMAP_RENDERERS") or data / "remap/renderers")
    return os.environ.get("REMAP_BPY_PYTHON") or str(renderers / "cycles-5/bin/python")


class Principled:
    """Runs a worker process that renders the Principled BSDF. Like a Shader, it has a method `render`."""

    def __init__(self):
        python = python_of_blender()
        if not pathlib.Path(python).exists():
            raise Missing(f"bpy is missing: {python} does not exist (scripts/renderers cycles-5)")
        self.folder = tempfile.TemporaryDirectory(prefix="remap-principled-")
        self.process = subprocess.Popen([python, str(ADAPTERS / "blender_cycles.py")], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, text=True)
        self.number, self.kept = 0, {}
        model = next(one for one in self.ask(request="describe", protocol=1, threads=1)["models"] if one["name"] == MODEL)
        self.parameters = {one["name"]: one for one in model["parameters"]}

    def ask(self, **request):
        self.number += 1
        try:
            self.process.stdin.write(json.dumps({"id": self.number, **request}) + "\n")
            self.process.stdin.flush()
            line = self.process.stdout.readline()
            while line and not line.startswith("{"):  # skips a banner
                line = self.process.stdout.readline()
        except BrokenPipeError:
            line = ""
        if not line:
            raise Missing(f"the worker of Cycles ended (run {self.process.args[0]} {self.process.args[1]} to see why)")
        answer = json.loads(line)
        if "error" in answer:
            raise shaders.Unusable(f"{MODEL}: {answer['error']}")
        return answer

    def one_light(self, values, position, resolution, camera):
        """Returns the picture under a white point light of intensity 1."""
        parameters = {name: [one["default"]] for name, one in self.parameters.items() if "default" in one}
        parameters.update({name: np.ravel(value).tolist() for name, value in values.items()})
        scene = {"resolution": resolution, "samples_per_axis": 1, "light": {"position": list(position), "intensity": 1},
                 "camera": {"distance": camera.distance, "half_angle": camera.half_angle}}
        image = pathlib.Path(self.folder.name) / f"{self.number}.f32"
        self.ask(request="render", model=MODEL, parameters=parameters, scene=scene, seed=0, channels=3, image=str(image))
        picture = np.fromfile(image, np.float32).reshape(resolution, resolution, 3).astype(float)
        image.unlink()
        return picture

    def render(self, values, lights, resolution, camera):
        """Returns the picture under point lights. Light adds up, so this is the sum of pictures with one light each.
        """
        assert all(light.kind == shaders.POINT for light in lights)
        total = np.zeros((resolution, resolution, 3))
        for light in lights:
            total += self.one_light(values, light.vector, resolution, camera) * np.array(light.color)
        return total

    def close(self):
        self.process.stdin.close()
        self.process.wait(timeout=20)


def far_camera():
    """Returns a camera so far away that it is almost orthographic, but close enough for Blender's clipping."""
    return shaders.Camera(50.0, math.degrees(math.asin(1 / 50)))


def far_points(lights, distance=50.0):
    """Returns point lights that light the sphere almost like directional lights."""
    return [shaders.Light(shaders.POINT, tuple(distance * np.asarray(one.vector) / np.linalg.norm(one.vector)),
                          tuple(distance ** 2 * np.asarray(one.color))) for one in lights]
