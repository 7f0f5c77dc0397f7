#!/usr/bin/env python3
"""Applies the code that docs/adopting offers to the programs themselves, and measures pictures before and after.

Usage:
  tests/oracles/adopting.py [--cache FOLDER] [--record] [--pictures] [PROGRAM ...]
  tests/oracles/adopting.py --constants          # offline: do the pages have the constants of the short formulas?
  tests/oracles/adopting.py --lines [PAGE ...]   # offline: does the C and C++ code compile ($CXX), and give what the
                                                 # pages state?

If a registry has the source of a program (obj2gltf, trimesh, mujoco-usd-converter, urdf-usd-converter), the version
pinned below is installed into a temporary folder (--cache keeps it). The code blocks of the pages are inserted into a
copy, at anchors. A missing anchor is an error. Each program converts real files before and after, and the written
materials are rendered. The other programs are measured by the formula of their rule. --record writes the tables and
the constants into the pages, --pictures writes docs/adopting/*.png. Programs that cannot be installed are listed and
skipped. The exit code is 77 if nothing could be measured.

The picture is a sphere of 64 x 64 pixels, orthographic, under one light at 60 degrees and under 32 lights on a
Fibonacci sphere (brighter above, 15 % of them four times). The source is Blinn's (N.H)^n or Phong's (R.V)^n without
normalisation or cosine, and Kd N.L. A light makes white diffuse 1. The target is GGX as in appendix B of glTF. The
error is the RMSE of sRGB display values in percent, for each set, over pixels and channels. For MuJoCo, the lights
are lamps at 10, 30, 50 and 70 degrees. If a material has maps, 40 texels are rendered, each as a sphere.
"""
import argparse
import collections
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True  # keeps the folder of the sources clean

from offers.pages import PAGES, check_constants, record_table

if "--constants" in sys.argv[1:]:
    sys.exit(1 if check_constants("--record" in sys.argv[1:]) else 0)
if "--lines" in sys.argv[1:]:
    from offers.lines import check_lines
    sys.exit(check_lines(os.environ.get("CXX", "c++"), sys.argv[sys.argv.index("--lines") + 1:]))

try:
    from offers.files import ASSETS, mujoco_file, mujoco_paints, mujoco_source, obj_files
    from offers.materials import POINTS, fbx_material, mtl_source
    from offers.picture import picture
    from offers.programs import MAKERS, VERSIONS, Skip
    from offers.rules import file_table, formula_table
    from offers.spheres import LAMPS, SPHERES, lamp, light_sets, percent, squares
except ImportError as missing:
    print(f"skipped: needs {missing.name} (pip install numpy pillow)")
    sys.exit(77)


def measured(files, convert, variants, source, scratch, sets=SPHERES):
    """Returns the lines of a table: RMSE of each file before and after, and of all files, under each set of lights.
    """
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


def converted(name, cache, objs, scratch):
    """Holds the files of one program, how they are converted and read, and the lines of their table."""
    if objs is None and name != "mujoco-usd-converter":
        raise Skip(f"shared data: {ASSETS / 'mtl'} is not there")
    convert, variants = MAKERS[name](cache)
    if name == "mujoco-usd-converter":
        paints = mujoco_paints()
        path = mujoco_file(scratch, paints)
        lines = []
        for reading, shown in (("as MuJoCo's window shows it", True), ("the same lobe in linear light", False)):
            part = measured([(reading, path, paints)], convert, variants,
                            lambda values, points, shown=shown: mujoco_source(values, shown), scratch, LAMPS)
            lines += part if not lines else part[2:]
        return [("paints", path, paints)], convert, variants, lambda values, points: mujoco_source(values, True), lines
    decode, times = name == "urdf-usd-converter", name != "obj2gltf"
    files = [file for file in objs if name != "urdf-usd-converter" or not any("map_kd" in m for m in file[2].values())]
    source = lambda m, points: mtl_source(m, points, times, decode)  # noqa: E731
    return files, convert, variants, source, measured(files, convert, variants, source, scratch)


def draw(name, files, convert, variants, source, scratch):
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


def measure_formulas(objs, record):
    """Returns tables of the programs that are measured by the formula of their own rule."""
    plain_files = [(label, [(m["ns"], m["kd"], m["ks"]) for m in materials.values()]) for label, _, materials in objs
                   if not any("map_kd" in m for m in materials.values())]
    fbx_files = [("phong_cube.fbx", [fbx_material(ASSETS / "mtl" / "phong_cube" / "phong_cube.fbx")])]
    for page, table, of in (("assimp.md", "assimp, glTF export", plain_files), ("assimp.md", "assimp, FBX import", fbx_files),
                            ("ufbx.md", "ufbx", fbx_files), ("blender-obj.md", "Blender's OBJ import", plain_files)):
        lines = file_table(table, of)
        print(f"{table}, by formula\n" + "\n".join(lines) + "\n")
        if record:
            record_table(page, table, lines)


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
    done = 0
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        cache = (options.cache or scratch / "cache").absolute()
        cache.mkdir(parents=True, exist_ok=True)
        objs = obj_files(scratch) if (ASSETS / "mtl").is_dir() else None
        if objs is not None:
            measure_formulas(objs, options.record)
        for name in options.programs or MAKERS:
            try:
                files, convert, variants, source, lines = converted(name, cache, objs, scratch)
            except Skip as reason:
                print(f"skipped: {name}: {reason}")
                continue
            done += 1
            print(f"{name} {VERSIONS[name]}, RMSE in percent\n" + "\n".join(lines) + "\n")
            if options.record:
                record_table(f"{name}.md", "files", lines)
            if options.pictures:
                draw(name, files, convert, variants, source, scratch)
    return 1 if wrong else 0 if done else 77


if __name__ == "__main__":
    sys.exit(main())
