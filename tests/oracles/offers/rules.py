"""Holds the current rules of programs and the short form as formulas, and makes tables of their errors."""
import math
import re
import sys

import numpy as np

from offers.pages import SHORT_FORMS
from offers.spheres import Source, Target, percent, squares

LUMA = np.array([0.2125, 0.7154, 0.0721])


def plain(roughness, f0=0.04, f90=1.0):
    return lambda n, kd, ks: Target(kd, min(1.0, max(0.0, roughness(n, ks))), np.full(3, f0(ks) if callable(f0) else f0), f90)


def short_target(n, kd, ks, lobe="blinn", f90=None):
    a, b, c, d, times = SHORT_FORMS[lobe]
    f0 = np.minimum(1, c * ks / (times * n + d)) if n >= 1 else np.zeros(3)
    f = f0.max()
    return Target(np.minimum(1, kd / max(0.02, 1 - f)), (a / (times * n + b)) ** 0.25 if n >= 1 else 1.0, f0, f if f90 is None else f90)


def core_target(n, kd, ks, lobe="blinn"):
    t = short_target(n, kd, ks, lobe)
    d, s = kd.mean(), t.f0.mean()
    share = min(1.0, 2 * d / max(1e-9, s + d + math.sqrt(max(0.0, (s + d) ** 2 - 0.16 * d))))
    return Target(np.clip(kd + t.f0 - 0.04 * share, 0, 1), t.roughness, np.full(3, 0.04), 1.0, 1 - share)


FORMULAS = {  # for each page: the lobe and [(label, rule)]
    "assimp, glTF export": ("blinn", plain(lambda n, ks: 1 - (ks @ LUMA) * min(1, math.sqrt(n / 1000)))),
    "assimp, FBX import": ("phong", plain(lambda n, ks: 1 - math.sqrt(n) / 10)),
    "trimesh": ("blinn", lambda n, kd, ks: Target(kd, (2 / (n + 2)) ** 0.25, np.full(3, 0.04), 1.0, 1.0)),
    "ufbx": ("phong", plain(lambda n, ks: 1 - 0.1 * math.sqrt(n))),
    "obj2gltf": ("blinn", plain(lambda n, ks: (1 - n / 1000) * (1 - ks @ LUMA if ks @ LUMA < 0.1 else 1))),
    "IfcOpenShell": ("blinn", plain(lambda n, ks: 1 / n if n > 1 else 1.0)),
    "mujoco-usd-converter": ("blinn", plain(lambda n, ks: 1 - n / 128)),
    "urdf-usd-converter": ("blinn", plain(lambda n, ks: 0.5, f0=0.0)),
    "Blender's OBJ import": ("blinn", plain(lambda n, ks: 1 - math.sqrt(min(n, 1000) / 1000), f0=lambda ks: 0.08 * ks.mean())),
}
REFERENCE = (96.08, np.full(3, 0.64), np.full(3, 0.5))


# These are Kd, Ks and shininess (the exponent / 128) of the 24 materials of the OpenGL courses (teapots.c of the
# OpenGL Programming Guide): emerald, jade, obsidian, pearl, ruby, turquoise; brass, bronze, chrome, copper, gold,
# silver; plastics and rubbers in black, cyan, green, red, white and yellow.
OPENGL = [
    ((0.07568, 0.61424, 0.07568), (0.633, 0.727811, 0.633), 0.6),
    ((0.54, 0.89, 0.63), (0.316228, 0.316228, 0.316228), 0.1),
    ((0.18275, 0.17, 0.22525), (0.332741, 0.328634, 0.346435), 0.3),
    ((1.0, 0.829, 0.829), (0.296648, 0.296648, 0.296648), 0.088),
    ((0.61424, 0.04136, 0.04136), (0.727811, 0.626959, 0.626959), 0.6),
    ((0.396, 0.74151, 0.69102), (0.297254, 0.30829, 0.306678), 0.1),
    ((0.780392, 0.568627, 0.113725), (0.992157, 0.941176, 0.807843), 0.21794872),
    ((0.714, 0.4284, 0.18144), (0.393548, 0.271906, 0.166721), 0.2),
    ((0.4, 0.4, 0.4), (0.774597, 0.774597, 0.774597), 0.6),
    ((0.7038, 0.27048, 0.0828), (0.256777, 0.137622, 0.086014), 0.1),
    ((0.75164, 0.60648, 0.22648), (0.628281, 0.555802, 0.366065), 0.4),
    ((0.50754, 0.50754, 0.50754), (0.508273, 0.508273, 0.508273), 0.4),
    ((0.01, 0.01, 0.01), (0.5, 0.5, 0.5), 0.25),
    ((0.0, 0.50980392, 0.50980392), (0.50196078, 0.50196078, 0.50196078), 0.25),
    ((0.1, 0.35, 0.1), (0.45, 0.55, 0.45), 0.25),
    ((0.5, 0.0, 0.0), (0.7, 0.6, 0.6), 0.25),
    ((0.55, 0.55, 0.55), (0.7, 0.7, 0.7), 0.25),
    ((0.5, 0.5, 0.0), (0.6, 0.6, 0.5), 0.25),
    ((0.01, 0.01, 0.01), (0.4, 0.4, 0.4), 0.078125),
    ((0.4, 0.5, 0.5), (0.04, 0.7, 0.7), 0.078125),
    ((0.4, 0.5, 0.4), (0.04, 0.7, 0.04), 0.078125),
    ((0.5, 0.4, 0.4), (0.7, 0.04, 0.04), 0.078125),
    ((0.5, 0.5, 0.5), (0.7, 0.7, 0.7), 0.078125),
    ((0.5, 0.5, 0.4), (0.7, 0.7, 0.04), 0.078125),
]


def opengl_materials():
    """Returns (n, Kd, Ks)."""
    return [(128 * shininess, kd, ks) for kd, ks, shininess in OPENGL]


def offers(lobe):
    """Returns the short form as it can be written: in KHR_materials_specular, with a rim, and in core glTF."""
    return {"short form, constant reflectance": lambda *m: short_target(*m, lobe),
            "short form, F90 = 1": lambda *m: short_target(*m, lobe, f90=1.0),
            "short form, core glTF": lambda *m: core_target(*m, lobe)}


def formula_table():
    lines = ["| lobe | rule | one material | 24 materials |", "|---|---|---|---|"]
    sets = [[REFERENCE], [(n, np.array(kd), np.array(ks)) for n, kd, ks in opengl_materials()]]
    for lobe, title in (("blinn", "N.H"), ("phong", "R.V")):
        rules = {name: rule for name, (of, rule) in FORMULAS.items() if of == lobe}
        for name, rule in {**rules, **offers(lobe)}.items():
            cells = [percent([squares(Source(n, kd, ks, lobe), rule(n, kd, ks)) for n, kd, ks in materials]) for materials in sets]
            bold = "**" if name.startswith("short form, constant") else ""
            lines.append(f"| {title} | {bold}{name}{bold} | " + " | ".join(f"{bold}{cell}{bold}" for cell in cells) + " |")
    return lines


def file_table(page, files):
    """Returns materials without maps of real files, by the formula of the page's program."""
    lobe, rule = FORMULAS[page]
    lines = ["| file | materials | today | short form | F90 = 1 | core glTF |", "|---|---|---|---|---|---|"]
    for label, materials in files:
        cells = [percent([squares(Source(n, kd, ks, lobe), make(n, kd, ks)) for n, kd, ks in materials])
                 for make in (rule, *offers(lobe).values())]
        lines.append(f"| {label} | {len(materials)} | " + " | ".join(cells) + " |")
    return lines
