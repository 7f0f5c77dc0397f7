"""Renders VTK's physically based shading of a metal: GGX with Schlick's Fresnel.

To avoid tessellation, each pixel centre is one vertex on the exact sphere, with its normal. Pixels are read from a
float framebuffer, in which VTK encodes radiance with the power 1 / 2.2. This file must not be named vtk.py, because
it would be imported instead of the library.
"""
import math

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

from worker_loop import grey_or_rgb, parameter, serve

# Below 0.07 the shader clamps the distribution, which changes the meaning of roughness.
MODELS = [{"name": "vtk/metal", "precision": 1e-4, "parameters": [
    parameter("roughness", "roughness", 0.07, 1, convention="roughness"),
    parameter("base_color", "specular", 0, 1)]}]


def describe(_threads):
    return {"renderer": f"VTK {vtk.vtkVersion.GetVTKVersion()} PBR", "models": MODELS}


def sphere_points(size, camera):
    """Returns where the rays through pixel centres hit the sphere, row 0 at the bottom."""
    half, distance = math.tan(math.radians(camera["half_angle"])), camera["distance"]
    axis = (2 * (np.arange(size) + 0.5) / size - 1) * half
    x, y = np.meshgrid(axis, axis)
    a = x * x + y * y + 1
    inside = distance ** 2 - a * (distance ** 2 - 1)
    hit = inside > 0
    t = (distance - np.sqrt(inside[hit])) / a[hit]
    return np.stack([t * x[hit], t * y[hit], distance - t], axis=-1)


class Stage:
    """Holds the window, points, camera and lamp for one size of picture."""

    def __init__(self, size, camera):
        points = sphere_points(size, camera)
        cloud = vtk.vtkPolyData()
        places = vtk.vtkPoints()
        places.SetData(numpy_to_vtk(points.astype(np.float64), deep=True))
        cloud.SetPoints(places)
        normals = numpy_to_vtk(points.astype(np.float32), deep=True)
        normals.SetName("Normals")
        cloud.GetPointData().SetNormals(normals)
        cells = vtk.vtkCellArray()
        ids = np.stack([np.ones(len(points), np.int64), np.arange(len(points))], axis=-1).ravel()
        cells.ImportLegacyFormat(numpy_to_vtkIdTypeArray(ids, deep=True))
        cloud.SetVerts(cells)
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputData(cloud)
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        self.skin = actor.GetProperty()
        self.skin.SetInterpolationToPBR()
        self.skin.SetMetallic(1)
        self.skin.SetPointSize(1)
        self.renderer = vtk.vtkRenderer()
        self.renderer.AddActor(actor)
        self.renderer.AutomaticLightCreationOff()
        self.renderer.SetBackground(0, 0, 0)
        self.lamp = vtk.vtkLight()
        self.lamp.SetPositional(True)
        self.lamp.SetConeAngle(180)
        self.lamp.SetAttenuationValues(0, 0, 1)
        self.renderer.AddLight(self.lamp)
        eye = self.renderer.GetActiveCamera()
        eye.SetPosition(0, 0, camera["distance"])
        eye.SetFocalPoint(0, 0, 0)
        eye.SetViewUp(0, 1, 0)
        eye.SetViewAngle(2 * camera["half_angle"])
        self.renderer.ResetCameraClippingRange()
        steps = vtk.vtkRenderStepsPass()
        self.framebuffer = vtk.vtkFramebufferPass()
        self.framebuffer.SetDelegatePass(steps)
        self.framebuffer.SetColorFormat(vtk.vtkTextureObject.Float32)
        self.renderer.SetPass(self.framebuffer)
        self.window = vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetSize(size, size)
        self.window.AddRenderer(self.renderer)
        self.size = size

    def picture(self):
        self.window.Render()
        texture = self.framebuffer.GetColorTexture()
        pixels = np.zeros((self.size, self.size, texture.GetComponents()), np.float32)
        texture.Download().Download2D(vtk.VTK_FLOAT, pixels, (self.size, self.size), texture.GetComponents(), (0, 0))
        return np.maximum(pixels[::-1, :, :3].astype(np.float64), 0) ** 2.2


stages = {}


def stage(size, camera):
    if size not in stages:
        stages.clear()
        stages[size] = Stage(size, camera)
    return stages[size]


def render(request, values):
    scene = request["scene"]
    side, samples = scene["resolution"], scene["samples_per_axis"]
    place = stage(side * samples, scene["camera"])
    place.skin.SetRoughness(values["roughness"][0])
    place.skin.SetColor(*grey_or_rgb(values["base_color"]))
    place.lamp.SetPosition(*scene["light"]["position"])
    place.lamp.SetIntensity(scene["light"]["intensity"])
    return place.picture().reshape(side, samples, side, samples, 3).mean(axis=(1, 3))


serve(describe, render)
