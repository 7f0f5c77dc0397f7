#!/usr/bin/env python3
"""Applies the lines that docs/adopting offers to the programs themselves, and measures pictures before and after.

Usage: tests/oracles/adopting.py [--cache FOLDER] [--record] [--pictures] [PROGRAM ...]
       tests/oracles/adopting.py --constants          # offline: do the pages have the constants of fits/short/forms.json?

Programs whose registry has their source (obj2gltf, trimesh, mujoco-usd-converter, urdf-usd-converter) are installed at the version
pinned below into a temporary folder (--cache keeps it). The code blocks of the pages are put into a copy of them, at anchors; an
anchor that is gone is an error. Each program converts real files before and after, and the written materials are rendered. The other
programs are measured by the formula of their rule. --record writes the tables and the constants into the pages, --pictures writes
docs/adopting/*.png. What cannot be installed is named, and does not count; exit code 77 where nothing could be measured.

The picture: a sphere of 64 x 64 pixels, orthographic, under one light at 60 degrees and under 32 lights on a Fibonacci sphere
(brighter above, 15 % of them four times). The source is Blinn's (N.H)^n or Phong's (R.V)^n without normalisation or cosine, and
Kd N.L; a light makes white diffuse 1. The target is GGX as in appendix B of glTF. RMSE of sRGB display values in percent, for each set,
over pixels and channels. MuJoCo's are lamps at 10, 30, 50 and 70 degrees. Of a material with maps, 40 texels are rendered, each as a
sphere.
"""
import argparse
import base64
import collections
import io
import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ROOT / "docs" / "adopting"
ASSETS = pathlib.Path(os.environ.get("REMAP_SHARED_DATA", ROOT / ".." / "shared" / "data")) / "assets"
VERSIONS = {"obj2gltf": "3.2.0", "trimesh": "5.2.0", "mujoco-usd-converter": "0.8.0", "urdf-usd-converter": "0.3.4"}
TEXELS = 40

# The constants of the pages ------------------------------------------------------------------------------------------

WIDTH = re.compile(r"(?P<a>\d+\.\d+)(?P<s>f?) / \((?:(?P<t>\d+\.\d+)f? \* )?(?P<n>n|exponent) \+ (?P<b>\d+\.\d+)f?\)")
STRENGTH = re.compile(r"(?P<a>\d+\.\d+)(?P<s>f?) \* (?P<k>[\w.\[\]]+) / "
                      r"\((?:(?P<t>\d+\.\d+)f? \* )?(?P<n>n|exponent) \+ (?P<b>\d+\.\d+)f?\)")


def short_forms():
    forms = {form["id"]: form["constants"] for form in json.loads((ROOT / "fits/short/forms.json").read_text())["forms"]}
    return {"blinn": forms["legacy_blinn_phong_to_mitsuba_ggx"], "phong": forms["legacy_phong_to_mitsuba_ggx"]}


def with_constants(text, forms):
    """The text with every width and strength at the constants of its form: Phong's has a factor before n."""
    def replaced(match, first, second):
        form = forms["phong" if match["t"] else "blinn"]
        number = lambda value: f"{float(f'{value:.3g}')}{match['s']}"  # noqa: E731
        head = number(form[first]) + (f" * {match['k']}" if "k" in match.groupdict() else "")
        times = f"{number(form[4])} * " if match["t"] else ""
        return f"{head} / ({times}{match['n']} + {number(form[second])})"

    text = STRENGTH.sub(lambda match: replaced(match, 2, 3), text)
    return WIDTH.sub(lambda match: replaced(match, 0, 1), text)


def examples(forms):
    """What the test of each page states, as it should be printed."""
    def width(lobe, n):
        return (forms[lobe][0] / (forms[lobe][4] * n + forms[lobe][1])) ** 0.25

    def strength(lobe, n, ks):
        return forms[lobe][2] * ks / (forms[lobe][4] * n + forms[lobe][3])

    def ior(f0):
        return (1 + math.sqrt(f0)) / (1 - math.sqrt(f0))

    ks = ((0.5 + 0.055) / 1.055) ** 2.4  # linear, of the display value 0.5
    f0, phong = strength("blinn", 96.08, 0.5), strength("phong", 96.08, 0.5)
    blinn = [f"{width('blinn', 96.08):.3f}", f"{f0:.4f}", f"{0.64 / (1 - f0):.3f}"]
    return {"assimp.md": [*blinn, f"{width('phong', 96.08):.3f}", f"{phong:.4f}", f"{width('phong', 400):.3f}"],
            "obj2gltf.md": blinn, "ifcopenshell.md": blinn, "trimesh.md": blinn[:2],
            "blender-obj.md": [*blinn, f"{ior(f0):.2f}"],
            "ufbx.md": [f"{width('phong', 96.08):.3f}", f"{phong:.4f}", f"{ior(phong):.2f}"],
            "mujoco-usd-converter.md": [f"{width('blinn', 64):.3f}", f"{(small := strength('blinn', 64, ks)):.4f}", f"{ior(small):.2f}"],
            "urdf-usd-converter.md": [blinn[0], f"{(small := strength('blinn', 96.08, ks)):.4f}", f"{ior(small):.2f}"]}


def check_constants(record):
    forms, wrong = short_forms(), 0
    for page in sorted(PAGES.glob("*.md")):
        text = page.read_text()
        now = with_constants(text, forms)
        for old, new in zip(text.splitlines(), now.splitlines()):
            if old != new and not record:
                print(f"{page.relative_to(ROOT)}: has '{old.strip()}', the form gives '{new.strip()}' (--record mends it)")
                wrong += 1
        if not (WIDTH.search(text) and STRENGTH.search(text)):
            print(f"{page.relative_to(ROOT)}: no line with the constants of a short form")
            wrong += 1
        stated = re.search(r"\*\*A test\*\*.*", text, re.DOTALL)
        for value in examples(forms).get(page.name, []):
            if not stated or value not in stated[0]:
                print(f"{page.relative_to(ROOT)}: the test of the page does not state {value}")
                wrong += 1
        if record:
            page.write_text(now)
    return wrong


def block(page, name):
    """The code of a page that stands under the comment <!-- applied: NAME -->."""
    found = re.search(rf"<!-- applied: {re.escape(name)} -->\n```\w+\n(.*?)```", (PAGES / page).read_text(), re.DOTALL)
    if not found:
        sys.exit(f"docs/adopting/{page}: no code block under <!-- applied: {name} -->")
    return found[1]


def record_table(page, name, lines):
    path = PAGES / page
    text, count = re.subn(rf"(<!-- measured: {re.escape(name)} -->\n).*?(<!-- end -->)",
                          lambda match: match[1] + "\n".join(lines) + "\n" + match[2], path.read_text(), flags=re.DOTALL)
    if count != 1:
        sys.exit(f"docs/adopting/{page}: {count} places <!-- measured: {name} --> ... <!-- end --> (expected 1)")
    path.write_text(text)


if "--constants" in sys.argv[1:]:
    sys.exit(1 if check_constants("--record" in sys.argv[1:]) else 0)

try:
    import numpy as np
    from PIL import Image, ImageDraw
except ImportError as missing:
    print(f"skipped: needs {missing.name} (pip install numpy pillow)")
    sys.exit(77)

# The renderer --------------------------------------------------------------------------------------------------------

# Values of one material, or of each texel: exponent, linear colors; lobe is "blinn" or "phong". display: the renderer adds up display
# values, as MuJoCo does.
Source = collections.namedtuple("Source", "n kd ks lobe display", defaults=("blinn", False))
Target = collections.namedtuple("Target", "base roughness f0 f90 metallic", defaults=(1.0, 0.0))


def linear(display):
    display = np.asarray(display, float)
    return np.where(display <= 0.04045, display / 12.92, ((display + 0.055) / 1.055) ** 2.4)


def encoded(value):
    value = np.clip(value, 0, 1)
    return np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)


def light_sets():
    """Directions and weights; weights make the brightest point of a white diffuse sphere 1."""
    index = np.arange(32)
    z = 1 - (2 * index + 1) / 32
    angle = index * math.pi * (3 - math.sqrt(5))
    around = np.stack([np.cos(angle) * np.sqrt(1 - z**2), np.sin(angle) * np.sqrt(1 - z**2), z], -1)
    weights = (0.55 + 0.45 * around[:, 1]) * np.where(np.random.default_rng(7).permutation(32) < 5, 4.0, 1.0)
    return {"one light": lamp(60), "32 lights": (around, weights)}


def lamp(degrees):
    angle = math.radians(degrees)
    return np.array([[0.0, math.sin(angle), math.cos(angle)]]), np.ones(1)


class Sphere:
    """Cosines at the pixels of a sphere that is seen from +z, for one set of lights."""

    def __init__(self, lights, side=64):
        directions, weights = lights
        axis = (np.arange(side) + 0.5) / side * 2 - 1
        x, y = np.meshgrid(axis, -axis)
        self.mask = x**2 + y**2 < 1
        self.side = side
        normal = np.stack([x, y, np.sqrt(np.maximum(0, 1 - x**2 - y**2))], -1)[self.mask]
        view = np.array([0.0, 0, 1])
        half = directions + view
        half /= np.maximum(1e-9, np.linalg.norm(half, axis=1, keepdims=True))
        nl = directions @ normal.T
        mirrored = 2 * nl[..., None] * normal[None] - directions[:, None]
        self.nl, self.nv = np.maximum(nl, 0), normal[:, 2][None]
        self.nh, self.rv = np.maximum(half @ normal.T, 0), np.maximum(mirrored[..., 2], 0)
        self.lit = nl > 0
        weights = weights / (weights[:, None] * self.nl).sum(0).max()
        self.weights = weights[:, None]
        self.rim = (1 - np.clip((half @ view), 0, 1))[:, None] ** 5
        self.uv = np.stack([np.arctan2(normal[:, 0], normal[:, 2]) / math.pi + 0.5, np.arccos(normal[:, 1]) / math.pi], -1)

    def source(self, s):
        """Display values of pixels; values of the material may be one, or one for each pixel."""
        lobe = self.nh if s.lobe == "blinn" else self.rv
        lobe = np.where(self.lit, lobe ** np.maximum(s.n, 1e-6), 0.0)
        color = np.asarray(s.kd) * self.sum(self.nl) + np.asarray(s.ks) * self.sum(lobe)
        return np.clip(color, 0, 1) if s.display else encoded(color)

    def sum(self, values):
        return (self.weights * values).sum(0)[:, None]

    def target(self, t):
        a2 = np.maximum(np.asarray(t.roughness, float) ** 2, 0.0025) ** 2
        distribution = a2 / (math.pi * (self.nh**2 * (a2 - 1) + 1) ** 2)
        visible = 0.5 / np.maximum(1e-9, self.nl * np.sqrt(self.nv**2 * (1 - a2) + a2) + self.nv * np.sqrt(self.nl**2 * (1 - a2) + a2))
        lobe = np.where(self.lit, math.pi * distribution * visible * self.nl, 0.0)
        flat, rim = self.sum(lobe), self.sum(lobe * self.rim)
        base, f0, f90 = (np.clip(np.asarray(value, float), 0, 1) for value in (t.base, t.f0, t.f90))
        f0, f90 = np.broadcast_to(f0, base.shape), np.broadcast_to(f90, base.shape)
        most, edge = f0.max(-1, keepdims=True), f90.max(-1, keepdims=True)
        plain = base * ((1 - most) * self.sum(self.nl) - (edge - most) * self.sum(self.nl * self.rim)) + f0 * (flat - rim) + f90 * rim
        metal = base * (flat - rim) + rim
        metallic = np.asarray(t.metallic, float)
        metallic = metallic[:, None] if metallic.ndim else metallic
        return encoded(plain * (1 - metallic) + metal * metallic)


SPHERES = {name: [Sphere(lights)] for name, lights in light_sets().items()}
# A simulator has lamps, and no light from all around.
LAMPS = {"lamps": [Sphere(lamp(degrees)) for degrees in (10, 30, 50, 70)]}


def at(values, index):
    """One texel of named arrays."""
    return type(values)(*(value[index] if isinstance(value, np.ndarray) and value.shape[0] == TEXELS else value for value in values))


def squares(source, target, sets=SPHERES):
    """Sum of squared differences and their count, for each set of lights."""
    sums = np.zeros((len(sets), 2))
    mapped = any(isinstance(v, np.ndarray) and v.shape and v.shape[0] == TEXELS for v in (*source, *target))
    for index in range(TEXELS) if mapped else [0]:
        one, other = (at(source, index), at(target, index)) if mapped else (source, target)
        for total, spheres in zip(sums, sets.values()):
            for sphere in spheres:
                difference = sphere.source(one) - sphere.target(other)
                total += (difference**2).sum(), difference.size
    return sums


def percent(sums):
    """RMSE under each set of lights, as the cell of a table."""
    return " / ".join(f"{100 * math.sqrt(total / count):.1f}" for total, count in np.sum(sums, axis=0))


# Materials of files --------------------------------------------------------------------------------------------------

POINTS = np.random.default_rng(43).random((TEXELS, 2))


def image_array(image):
    values = np.asarray(image.convert("RGBA" if image.mode in ("P", "LA", "RGBA") else "RGB"), float) / 255
    return values[..., :3]


def looked_up(image, points):
    height, width = image.shape[:2]
    return image[(points[:, 1] * height).astype(int), (points[:, 0] * width).astype(int)]


def mtl_materials(path):
    materials, current = {}, None
    for line in path.read_text(errors="replace").splitlines():
        words = line.split(None, 1)
        if len(words) < 2:
            continue
        key, rest = words[0].lower(), words[1].strip()
        if key == "newmtl":
            current = materials.setdefault(rest, {"folder": path.parent})
        elif current is not None and key in ("kd", "ks"):
            current[key] = np.array([float(word) for word in rest.split()[:3]])
        elif current is not None and key == "ns":
            current[key] = float(rest)
        elif current is not None and key in ("map_kd", "map_ks", "map_ns"):
            current[key] = image_array(Image.open(path.parent / rest))
    return materials


def mtl_source(material, points, kd_times_map=True, decode=False):
    """Blinn as the MTL says. Below exponent 1 there is no highlight: programs that do not know it write 0."""
    n = material.get("ns", 0.0)
    kd, ks = material.get("kd", np.full(3, 0.8)), material.get("ks", np.zeros(3)) * (n >= 1)
    kd, ks = (linear(kd), linear(ks)) if decode else (kd, ks)
    if "map_kd" in material:
        kd = (kd if kd_times_map else 1.0) * linear(looked_up(material["map_kd"], points))
    if "map_ks" in material:
        ks = ks * linear(looked_up(material["map_ks"], points))
    if "map_ns" in material:
        n = (n * looked_up(material["map_ns"], points)[:, 0])
    return Source(n, kd, ks)


def gltf_parts(path):
    """JSON of a .gltf or .glb, and a function that gives its images."""
    data, binary = path.read_bytes(), b""
    if data[:4] == b"glTF":
        length = int.from_bytes(data[12:16], "little")
        text, binary = data[20:20 + length], data[20 + length + 8:]
    else:
        text = data
    gltf = json.loads(text)

    def bytes_of(uri):
        return base64.b64decode(uri.split(",", 1)[1]) if uri.startswith("data:") else (path.parent / urllib.parse.unquote(uri)).read_bytes()

    def image(texture):
        found = gltf["images"][gltf["textures"][texture["index"]]["source"]]
        if "uri" in found:
            return image_array(Image.open(io.BytesIO(bytes_of(found["uri"]))))
        view = gltf["bufferViews"][found["bufferView"]]
        buffer = gltf["buffers"][view["buffer"]]
        whole = bytes_of(buffer["uri"]) if "uri" in buffer else binary
        start = view.get("byteOffset", 0)
        return image_array(Image.open(io.BytesIO(whole[start:start + view["byteLength"]])))

    return gltf, image


def gltf_target(material, image, points, extension=True):
    pbr = material.get("pbrMetallicRoughness", {})
    base = np.array(pbr.get("baseColorFactor", [1, 1, 1, 1])[:3], float)
    roughness, metallic = float(pbr.get("roughnessFactor", 1.0)), float(pbr.get("metallicFactor", 1.0))
    if "baseColorTexture" in pbr:
        base = base * linear(looked_up(image(pbr["baseColorTexture"]), points))
    if "metallicRoughnessTexture" in pbr:
        packed = looked_up(image(pbr["metallicRoughnessTexture"]), points)
        roughness, metallic = roughness * packed[:, 1], metallic * packed[:, 2]
    f0, f90 = np.full(3, 0.04), np.ones(3)
    specular = material.get("extensions", {}).get("KHR_materials_specular")
    if specular is not None and extension:
        factor, color = specular.get("specularFactor", 1.0), np.array(specular.get("specularColorFactor", [1, 1, 1]), float)
        if "specularColorTexture" in specular:
            color = color * linear(looked_up(image(specular["specularColorTexture"]), points))
        f0, f90 = np.minimum(0.04 * color, 1) * factor, np.full(3, factor)
    return Target(base, roughness, f0, f90, metallic)


def usd_target(inputs):
    base = np.array(inputs["diffuseColor"], float)
    if inputs.get("useSpecularWorkflow", 0):
        return Target(base, inputs.get("roughness", 0.5), np.array(inputs["specularColor"]), 1.0, 0.0)
    ior = inputs.get("ior", 1.5)
    return Target(base, inputs.get("roughness", 0.5), np.full(3, ((ior - 1) / (ior + 1)) ** 2), 1.0, inputs.get("metallic", 0.0))


# Programs from registries --------------------------------------------------------------------------------------------

class Skip(Exception):
    pass


def run(command, install=False, **options):
    """Standard output. What fails to install is skipped; what fails to convert is an error."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=600, **options)
    if done.returncode != 0:
        message = f"{' '.join(map(str, command[:2]))} failed: {(done.stderr or done.stdout).strip()[-600:]}"
        if install:
            raise Skip(message)
        sys.exit(message)
    return done.stdout


def edit(path, anchor, text, how):
    """Puts text before, after or in place of the only line that has the anchor, or at the end of the file if it has the anchor."""
    lines = path.read_text().splitlines()
    found = [number for number, line in enumerate(lines) if anchor in line]
    if how == "append" and found:
        lines += ["", *text.splitlines()]
    elif len(found) == 1:
        indent = re.match(r"\s*", lines[found[0]])[0]
        new = lines[found[0]].replace(anchor, text) if how == "in place" else "\n".join(indent + line for line in text.splitlines())
        start, end = {"before": (0, 0), "after": (1, 1), "in place": (0, 1)}[how]
        lines[found[0] + start:found[0] + end] = new.splitlines()
    else:
        sys.exit(f"{path}: '{anchor}' is on {len(found)} lines (expected 1): the program has changed, and its page must follow")
    path.write_text("\n".join(lines) + "\n")


def python_of(cache, name, packages):
    """The Python of an environment that has the packages."""
    python = cache / name / "bin" / "python"
    if not python.exists():
        run([sys.executable, "-m", "venv", cache / name], install=True)
        run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *packages], install=True)
    return python


def packages_of(python, package):
    return pathlib.Path(run([python, "-c", f"import {package}, os; print(os.path.dirname({package}.__path__[0]))"]).strip())


class PythonProgram:
    """A package of PyPI. Each variant is a copy that stands first in PYTHONPATH."""

    def __init__(self, cache, name, package, variants):
        self.python = python_of(cache, name, [f"{name}=={VERSIONS[name]}", *(["pillow"] if name == "trimesh" else [])])
        self.folders = {}
        for variant, edits in variants.items():
            self.folders[variant] = folder = cache / f"{name}-{variant}"
            shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(packages_of(self.python, package) / package, folder / package)
            for file, anchor, text, how in edits:
                edit(folder / package / file, anchor, text, how)

    def __call__(self, variant, code, *arguments):
        environment = dict(os.environ, PYTHONPATH=str(self.folders[variant]), PYTHONDONTWRITEBYTECODE="1")
        return json.loads(run([self.python, "-c", code, *arguments], env=environment).splitlines()[-1])


def trimesh_program(cache):
    page = "trimesh.md"
    program = PythonProgram(cache, "trimesh", "trimesh", {
        "before": [],
        "metallic 0": [("visual/material.py", "roughnessFactor=roughness,", "roughnessFactor=roughness, metallicFactor=0.0,", "in place")],
        "after": [("visual/material.py", "class SimpleMaterial", block(page, "to_pbr") + "\n\nSimpleMaterial.to_pbr = to_pbr\n", "append"),
                  ("exchange/gltf/__init__.py", "# if alphaMode is defined, export", block(page, "gltf"), "before")]})
    code = ("import sys, json, trimesh\nfrom trimesh.exchange.gltf import export_glb\nfound = []\n"
            "for number, mesh in enumerate(trimesh.load(sys.argv[1], force='scene').geometry.values()):\n"
            "    if not hasattr(mesh.visual, 'material'): continue\n"
            "    path = f'{sys.argv[2]}/{number}.glb'\n    open(path, 'wb').write(export_glb(mesh))\n"
            "    found.append([mesh.visual.material.name, path])\nprint(json.dumps(found))")

    def convert(variant, path, scratch, points):
        targets = {}
        for name, written in program(variant.split(",")[0], code, path, scratch):
            gltf, image = gltf_parts(pathlib.Path(written))
            targets[name] = gltf_target(gltf["materials"][0], image, points, variant != "after, core viewer")
        return targets
    return convert, ["before", "metallic 0", "after", "after, core viewer"]


def obj2gltf_program(cache):
    if shutil.which("npm") is None:
        raise Skip("npm is not installed")
    folder = cache / "obj2gltf"
    if not (folder / "node_modules").exists():
        folder.mkdir(parents=True, exist_ok=True)
        run(["npm", "install", "--no-audit", "--no-fund", "--prefix", folder, f"obj2gltf@{VERSIONS['obj2gltf']}"], install=True)
    modules = folder / "node_modules"
    shutil.rmtree(modules / "obj2gltf-after", ignore_errors=True)
    shutil.copytree(modules / "obj2gltf", modules / "obj2gltf-after")
    lib = modules / "obj2gltf-after" / "lib"
    edit(lib / "loadMtl.js", "function convertTraditionalToMetallicRoughness(", block("obj2gltf.md", "loadMtl.js"), "append")
    edit(lib / "loadMtl.js", "  convertTraditionalToMetallicRoughness(material);", "  return convertTraditional(material, options);",
         "in place")
    edit(lib / "createGltf.js", "  return gltf;", block("obj2gltf.md", "createGltf.js"), "before")

    def convert(variant, path, scratch, points):
        program = modules / ("obj2gltf-after" if variant.startswith("after") else "obj2gltf")
        written = pathlib.Path(scratch) / "out.gltf"
        run(["node", program / "bin" / "obj2gltf.js", "-i", path, "-o", written])
        gltf, image = gltf_parts(written)
        return {m["name"]: gltf_target(m, image, points, variant != "after, core viewer") for m in gltf["materials"]}
    return convert, ["before", "after", "after, core viewer"]


USD_MATERIALS = ("import glob\nfrom pxr import Usd, UsdShade\nfound = {}\n"
                 "for file in glob.glob(out + '/Payload/MaterialsLibrary.usdc'):\n"
                 "    stage = Usd.Stage.Open(file)\n    for prim in stage.TraverseAll():\n"
                 "        if not prim.IsA(UsdShade.Material): continue\n"
                 "        inputs = {i.GetBaseName(): i.Get() for i in UsdShade.Material(prim).GetInputs()}\n"
                 "        found[prim.GetDisplayName() or prim.GetName()] = {k: (list(v) if hasattr(v, '__len__') else v)\n"
                 "            for k, v in inputs.items() if isinstance(v, (int, float)) or k.endswith('Color')}\n"
                 "print(json.dumps(found))")


def older_python():
    if not (3, 10) <= sys.version_info < (3, 13):
        raise Skip("needs Python 3.10 to 3.12")


def mujoco_program(cache):
    older_python()
    page, file = "mujoco-usd-converter.md", "_impl/material.py"
    program = PythonProgram(cache, "mujoco-usd-converter", "mujoco_usd_converter", {"before": [], "after": [
        (file, "def convert_materials(", block(page, "short_form"), "append"),
        (file, "from pxr import", "import math\nfrom pxr import Gf", "before"),
        (file, "color = usdex.core.sRgbToLinear(color)", block(page, "call"), "after"),
        (file, '"color": color,', '"color": base,', "in place"),
        (file, "1.0 - material.shininess", "roughness", "in place"),
        (file, "emission_scalar = material.emission", block(page, "ior"), "before")]})
    code = ("import sys, json\nout = sys.argv[2]\nimport mujoco_usd_converter\n"
            "mujoco_usd_converter.Converter().convert(sys.argv[1], out)\n" + USD_MATERIALS)

    def convert(variant, path, scratch, points):
        return {name: usd_target(inputs) for name, inputs in program(variant, code, path, scratch).items()}
    return convert, ["before", "after"]


def urdf_program(cache):
    older_python()
    page, file = "urdf-usd-converter.md", "_impl/material.py"
    program = PythonProgram(cache, "urdf-usd-converter", "urdf_usd_converter", {"before": [], "after": [
        (file, "def convert_materials(", block(page, "short_form"), "append"),
        (file, "import shutil", "import math", "before"),
        (file, "# If the normal texture is not specified, use the bump texture.", block(page, "call"), "before")]})
    code = ("import sys, json\nout = sys.argv[2]\nimport urdf_usd_converter\n"
            "urdf_usd_converter.Converter().convert(sys.argv[1], out)\n" + USD_MATERIALS)

    def convert(variant, path, scratch, points):
        robot = path.with_suffix(".urdf")
        mesh = f'<geometry><mesh filename="{path.name}"/></geometry>'
        robot.write_text(f'<robot name="r"><link name="l"><visual>{mesh}</visual></link></robot>')
        return {name: usd_target(inputs) for name, inputs in program(variant, code, robot, scratch).items()}
    return convert, ["before", "after"]


# Files ---------------------------------------------------------------------------------------------------------------

QUAD = ("mtllib {mtl}\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nusemtl {name}\n"
        "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n")


def obj_files(scratch):
    """(label, OBJ, materials) of the shared files, copied to a folder that may be written to."""
    files = []
    for name in ("box-multiple-materials", "box", "cube_usemtl", "box-complex-material", "fuze"):
        folder = pathlib.Path(shutil.copytree(ASSETS / "mtl" / name, scratch / name))
        mtl = next(folder.glob("*.mtl"))
        files.append((name, folder / f"{name}.obj", mtl_materials(mtl)))
    nut = scratch / "nut"
    nut.mkdir()
    for image in ("nut-specular.jpg", "nut-diffuse.jpg", "nut-bump.jpg"):
        shutil.copy(ASSETS / "obj" / image, nut)
    # The file has neither Ns nor Ks: what any program makes of that is a guess. These are Blender's defaults of old.
    (nut / "nut.mtl").write_text((ASSETS / "obj" / "nut.mtl").read_text() + "\nNs 96.08\nKs 0.5 0.5 0.5\nKd 1 1 1\n")
    (nut / "nut.obj").write_text(QUAD.format(mtl="nut.mtl", name="Tube1"))
    files.append(("nut, with Ns 96.08, Ks 0.5 added", nut / "nut.obj", mtl_materials(nut / "nut.mtl")))
    return files


MUJOCO = {  # of MuJoCo's default, and shiny and dull paint
    "default": ("0.8 0.3 0.2 1", 0.5, 0.5), "glossy": ("0.1 0.3 0.6 1", 0.8, 0.9), "dull": ("0.5 0.5 0.5 1", 0.3, 0.1),
    "dark": ("0.05 0.05 0.05 1", 1.0, 0.3), "no highlight": ("0.6 0.7 0.4 1", 0.0, 0.5)}


def mujoco_paints():
    """The paints above, and the 24 materials of OpenGL, whose specular is grey here as MuJoCo's is."""
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


# Rules measured by their formula -------------------------------------------------------------------------------------

LUMA = np.array([0.2125, 0.7154, 0.0721])


def plain(roughness, f0=0.04, f90=1.0):
    return lambda n, kd, ks: Target(kd, min(1.0, max(0.0, roughness(n, ks))), np.full(3, f0(ks) if callable(f0) else f0), f90)


def short_target(n, kd, ks, lobe="blinn", f90=None):
    a, b, c, d, times = short_forms()[lobe]
    f0 = np.minimum(1, c * ks / (times * n + d)) if n >= 1 else np.zeros(3)
    f = f0.max()
    return Target(np.minimum(1, kd / max(0.02, 1 - f)), (a / (times * n + b)) ** 0.25 if n >= 1 else 1.0, f0, f if f90 is None else f90)


def core_target(n, kd, ks, lobe="blinn"):
    t = short_target(n, kd, ks, lobe)
    d, s = kd.mean(), t.f0.mean()
    share = min(1.0, 2 * d / max(1e-9, s + d + math.sqrt(max(0.0, (s + d) ** 2 - 0.16 * d))))
    return Target(np.clip(kd + t.f0 - 0.04 * share, 0, 1), t.roughness, np.full(3, 0.04), 1.0, 1 - share)


FORMULAS = {  # page: lobe, [(label, rule)]
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


def opengl_materials():
    """(n, Kd, Ks) of the 24 materials of the OpenGL courses, from the table of `remap-study exponents`."""
    text = (ROOT / "compiler/study/exponent_rules.cpp").read_text()
    rows = re.findall(r"\{\{([\d., ]+)\}, \{([\d., ]+)\}, ([\d.]+)\}", text)
    if len(rows) != 24:
        sys.exit(f"compiler/study/exponent_rules.cpp: {len(rows)} rows of materials (expected 24)")
    values = lambda words: tuple(float(word) for word in words.split(","))  # noqa: E731
    return [(128 * float(shininess), values(kd), values(ks)) for kd, ks, shininess in rows]


def offers(lobe):
    """The short form as it can be written: in KHR_materials_specular, with a rim, and in core glTF."""
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
    """Materials without maps of real files, by the formula of the page's program."""
    lobe, rule = FORMULAS[page]
    lines = ["| file | materials | today | short form | F90 = 1 | core glTF |", "|---|---|---|---|---|---|"]
    for label, materials in files:
        cells = [percent([squares(Source(n, kd, ks, lobe), make(n, kd, ks)) for n, kd, ks in materials])
                 for make in (rule, *offers(lobe).values())]
        lines.append(f"| {label} | {len(materials)} | " + " | ".join(cells) + " |")
    return lines


def fbx_material(path):
    """(n, Kd, Ks) of the last material of a binary FBX file; the ones before are templates."""
    data, found = path.read_bytes(), {}
    for match in re.finditer(rb"S....(DiffuseColor|DiffuseFactor|SpecularColor|SpecularFactor|ShininessExponent)S", data, re.DOTALL):
        position, numbers = match.end() - 1, []
        while data[position:position + 1] in (b"S", b"D"):
            if data[position:position + 1] == b"S":
                position += 5 + int.from_bytes(data[position + 1:position + 5], "little")
            else:
                numbers.append(struct.unpack("<d", data[position + 1:position + 9])[0])
                position += 9
        found[match[1].decode()] = np.array(numbers)
    return (float(found["ShininessExponent"][0]), found["DiffuseColor"] * found["DiffuseFactor"],
            found["SpecularColor"] * found["SpecularFactor"])


# Pictures ------------------------------------------------------------------------------------------------------------

def picture(path, rows, columns, sets):
    """rows: (name, source of points, {column: target of points}). Each sphere under both sets of lights."""
    side, gap, head = 96, 6, 16
    spheres = [Sphere(lights, side) for lights in sets.values()]
    width = len(spheres) * (len(columns) + 1) * (side + gap) + gap
    sheet = Image.new("RGB", (width, head + len(rows) * (side + head)), (40, 40, 40))
    draw = ImageDraw.Draw(sheet)
    for s, (lights, sphere) in enumerate(zip(sets, spheres)):
        for c, column in enumerate(["source", *columns]):
            x = gap + (s * (len(columns) + 1) + c) * (side + gap)
            draw.text((x, 2), f"{column}" + (f" ({lights})" if c == 0 else ""), fill=(230, 230, 230))
            for r, (name, source, targets) in enumerate(rows):
                pixels = np.full((side, side, 3), 40 / 255)
                pixels[sphere.mask] = sphere.source(source(sphere.uv)) if c == 0 else sphere.target(targets[column](sphere.uv))
                y = head + r * (side + head)
                sheet.paste(Image.fromarray((pixels * 255 + 0.5).astype(np.uint8)), (x, y))
                if s == 0 and c == 0:
                    draw.text((x, y + side), name, fill=(230, 230, 230))
    sheet.quantize(256, palette=sheet.quantize(256), dither=Image.Dither.FLOYDSTEINBERG).save(path, optimize=True)
    print(f"{path.relative_to(ROOT)}: {path.stat().st_size} bytes")


# The run -------------------------------------------------------------------------------------------------------------

def measured(files, convert, variants, source, scratch, sets=SPHERES):
    """Lines of a table: RMSE of each file before and after, and of all, under each set of lights."""
    lines = ["| file | materials | " + " | ".join(variants) + " |", "|---|---|" + "---|" * len(variants)]
    everything = collections.defaultdict(list)
    for label, path, materials in files:
        cells = []
        for number, variant in enumerate(variants):
            out = pathlib.Path(tempfile.mkdtemp(dir=scratch))
            targets = convert(variant, path, out, POINTS)
            common = [name for name in materials if name in targets]
            sums = [squares(source(materials[name], POINTS), targets[name], sets) for name in common]
            everything[variant] += sums
            cells.append(percent(sums))
        lines.append(f"| {label} | {len(common)} | " + " | ".join(cells) + " |")
    if len(files) > 1:
        lines.append("| all | | " + " | ".join(percent(everything[variant]) for variant in variants) + " |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cache", type=pathlib.Path)
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--pictures", action="store_true")
    parser.add_argument("programs", nargs="*")
    options = parser.parse_args()
    wrong = check_constants(options.record)
    table = formula_table()
    print("By formula, RMSE in percent\n" + "\n".join(table) + "\n")
    if options.record:
        record_table("README.md", "formulas", table)
    makers = {"trimesh": trimesh_program, "obj2gltf": obj2gltf_program, "mujoco-usd-converter": mujoco_program,
              "urdf-usd-converter": urdf_program}
    done = 0
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        cache = (options.cache or scratch / "cache").absolute()
        cache.mkdir(parents=True, exist_ok=True)
        objs = obj_files(scratch) if (ASSETS / "mtl").is_dir() else None
        if objs is not None:
            plain_files = [(label, [(m["ns"], m["kd"], m["ks"]) for m in materials.values()]) for label, _, materials in objs
                           if not any("map_kd" in m for m in materials.values())]
            fbx_files = [("phong_cube.fbx", [fbx_material(ASSETS / "mtl" / "phong_cube" / "phong_cube.fbx")])]
            for page, table, of in (("assimp.md", "assimp, glTF export", plain_files), ("assimp.md", "assimp, FBX import", fbx_files),
                                    ("ufbx.md", "ufbx", fbx_files), ("blender-obj.md", "Blender's OBJ import", plain_files)):
                lines = file_table(table, of)
                print(f"{table}, by formula\n" + "\n".join(lines) + "\n")
                if options.record:
                    record_table(page, table, lines)
        for name in options.programs or makers:
            try:
                if objs is None and name != "mujoco-usd-converter":
                    raise Skip(f"shared data: {ASSETS / 'mtl'} is not there")
                convert, variants = makers[name](cache)
                if name == "mujoco-usd-converter":
                    paints = mujoco_paints()
                    path = mujoco_file(scratch, paints)
                    lines = []
                    for reading, shown in (("as MuJoCo's window shows it", True), ("the same lobe in linear light", False)):
                        part = measured([(reading, path, paints)], convert, variants,
                                        lambda values, points, shown=shown: mujoco_source(values, shown), scratch, LAMPS)
                        lines += part if not lines else part[2:]
                    files, source = [("paints", path, paints)], lambda values, points: mujoco_source(values, True)
                else:
                    decode, times = name == "urdf-usd-converter", name != "obj2gltf"
                    files = [file for file in objs if name != "urdf-usd-converter" or not any("map_kd" in m for m in file[2].values())]
                    source = lambda m, points, t=times, d=decode: mtl_source(m, points, t, d)  # noqa: E731
                    lines = measured(files, convert, variants, source, scratch)
            except Skip as reason:
                print(f"skipped: {name}: {reason}")
                continue
            done += 1
            print(f"{name} {VERSIONS[name]}, RMSE in percent\n" + "\n".join(lines) + "\n")
            if options.record:
                record_table(f"{name}.md", "files", lines)
            if options.pictures:
                shown = [variant for variant in variants if variant in ("before", "after")]
                rows = []
                for label, path, materials in files:
                    if label not in ("paints", "box-multiple-materials", "box", "box-complex-material"):
                        continue
                    for material in list(materials)[:3 if label == "paints" else 1]:
                        made = {}
                        for variant in shown:
                            def target(points, variant=variant, path=path, material=material):
                                return convert(variant, path, pathlib.Path(tempfile.mkdtemp(dir=scratch)), points)[material]
                            made[variant] = target
                        title = material if name == "mujoco-usd-converter" else label
                        rows.append((title, lambda points, m=materials[material]: source(m, points), made))
                lamps = {f"lamp at {angle}": lamp(angle) for angle in (60, 10)}
                picture(PAGES / f"{name}.png", rows, shown, lamps if name == "mujoco-usd-converter" else light_sets())
    return 1 if wrong else 0 if done else 77


if __name__ == "__main__":
    sys.exit(main())
