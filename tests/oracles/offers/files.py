"""Prepares the files that are converted: shared OBJ files, and paints for MuJoCo."""
import os
import pathlib
import shutil

import numpy as np

from offers.materials import mtl_materials
from offers.pages import ROOT
from offers.rules import opengl_materials
from offers.spheres import Source, linear

ASSETS = pathlib.Path(os.environ.get("REMAP_SHARED_DATA", ROOT / ".." / "shared" / "data")) / "assets"

QUAD = ("mtllib {mtl}\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nusemtl {name}\n"
        "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n")


def obj_files(scratch):
    """Returns (label, OBJ, materials) of the shared files, copied to a folder that may be written to."""
    files = []
    for name in ("box-multiple-materials", "box", "cube_usemtl", "box-complex-material", "fuze"):
        folder = pathlib.Path(shutil.copytree(ASSETS / "mtl" / name, scratch / name))
        mtl = next(folder.glob("*.mtl"))
        files.append((name, folder / f"{name}.obj", mtl_materials(mtl)))
    nut = scratch / "nut"
    nut.mkdir()
    for image in ("nut-specular.jpg", "nut-diffuse.jpg", "nut-bump.jpg"):
        shutil.copy(ASSETS / "obj" / image, nut)
    # The file has neither Ns nor Ks, so any result of a program would be a guess. These are the old defaults of
    # Blender.
    (nut / "nut.mtl").write_text((ASSETS / "obj" / "nut.mtl").read_text() + "\nNs 96.08\nKs 0.5 0.5 0.5\nKd 1 1 1\n")
    (nut / "nut.obj").write_text(QUAD.format(mtl="nut.mtl", name="Tube1"))
    files.append(("nut, with Ns 96.08, Ks 0.5 added", nut / "nut.obj", mtl_materials(nut / "nut.mtl")))
    return files


MUJOCO = {  # MuJoCo's default, a shiny paint and a dull paint
    "default": ("0.8 0.3 0.2 1", 0.5, 0.5), "glossy": ("0.1 0.3 0.6 1", 0.8, 0.9), "dull": ("0.5 0.5 0.5 1", 0.3, 0.1),
    "dark": ("0.05 0.05 0.05 1", 1.0, 0.3), "no highlight": ("0.6 0.7 0.4 1", 0.0, 0.5)}


def mujoco_paints():
    """Returns MuJoCo's paints and the 24 materials of OpenGL. The specular of the materials is grey here, as in
    MuJoCo."""
    paints = dict(MUJOCO)
    for number, (n, kd, ks) in enumerate(opengl_materials()):
        paints[f"opengl_{number}"] = (" ".join(map(str, kd)) + " 1", round(sum(ks) / 3, 4), n / 128)
    return paints


def mujoco_file(scratch, paints):
    folder = scratch / "mujoco"
    folder.mkdir()
    materials = "".join(f'<material name="{name}" rgba="{rgba}" specular="{specular}" shininess="{shininess}"/>'
                        for name, (rgba, specular, shininess) in paints.items())
    geoms = "".join(f'<geom type="sphere" size="0.4" pos="{i} 0 0" material="{name}"/>' for i, name in enumerate(paints))
    (folder / "paints.xml").write_text(f"<mujoco><asset>{materials}</asset><worldbody>{geoms}</worldbody></mujoco>")
    return folder / "paints.xml"


def mujoco_source(values, shown):
    rgba, specular, shininess = values
    color, ks = np.array([float(word) for word in rgba.split()[:3]]), np.full(3, specular)
    return Source(128 * shininess, color if shown else linear(color), ks if shown else linear(ks), "blinn", shown)
