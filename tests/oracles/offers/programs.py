"""Installs programs of npm and PyPI, changes them by the code blocks of the pages, and runs them."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

from offers.materials import gltf_parts, gltf_target, usd_target
from offers.pages import block

VERSIONS = {"obj2gltf": "3.2.0", "trimesh": "5.2.0", "mujoco-usd-converter": "0.8.0", "urdf-usd-converter": "0.3.4"}


class Skip(Exception):
    pass


def run(command, install=False, **options):
    """Returns the standard output. A failing installation is skipped, a failing conversion is an error."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=600, **options)
    if done.returncode != 0:
        message = f"{' '.join(map(str, command[:2]))} failed: {(done.stderr or done.stdout).strip()[-600:]}"
        if install:
            raise Skip(message)
        sys.exit(message)
    return done.stdout


def edit(path, anchor, text, how):
    """Puts text before or after the only line that has the anchor, or replaces the anchor by it. With `append`, it
    puts the text at the end of a file that has the anchor."""
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
    """Returns the Python of an environment that has the packages."""
    python = cache / name / "bin" / "python"
    if not python.exists():
        run([sys.executable, "-m", "venv", cache / name], install=True)
        run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *packages], install=True)
    return python


def packages_of(python, package):
    return pathlib.Path(run([python, "-c", f"import {package}, os; print(os.path.dirname({package}.__path__[0]))"]).strip())


class PythonProgram:
    """Holds a package of PyPI. Each variant is a copy that comes first in PYTHONPATH."""

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


MAKERS = {"trimesh": trimesh_program, "obj2gltf": obj2gltf_program, "mujoco-usd-converter": mujoco_program,
          "urdf-usd-converter": urdf_program}
