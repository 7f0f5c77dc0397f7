#!/usr/bin/env python3
"""habits_trial.py TEXREMAP writes ten sets with the names of ten tools, and converts each for five targets by one
command.

A set has four patches of known values. The command has no options except --to, -o and, for the files of glTF,
--layout. Its results are compared with closed forms. Engines of the metallic workflow must get the same base color,
metallic and roughness (Unity 1 - roughness) within two steps of 8 bits, or 0.02 if the set is specular-gloss. Cycles
5, another renderer, must get them within 0.04. Prints the table. The exit code is 1 if a result is wrong.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SIDE = 8
PATCHES = [  # base color (linear), metallic, roughness, occlusion of each quarter
    ((0.50, 0.20, 0.10), 0.0, 0.40, 1.0), ((0.90, 0.70, 0.30), 1.0, 0.25, 0.9),
    ((0.20, 0.30, 0.60), 0.0, 0.80, 0.6), ((0.60, 0.60, 0.65), 1.0, 0.60, 0.7)]
F0 = 0.04


def srgb(x):
    return 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055


def linear(x):
    return x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4


VALUES = {  # values of a patch in the form that a map stores
    "base": lambda b, m, r, o: [srgb(c) for c in b], "metallic": lambda b, m, r, o: [m], "rough": lambda b, m, r, o: [r],
    "gloss": lambda b, m, r, o: [1 - r], "ao": lambda b, m, r, o: [o], "normal": lambda b, m, r, o: [0.5, 0.5, 1.0],
    "height": lambda b, m, r, o: [0.5], "orm": lambda b, m, r, o: [o, r, m], "mr": lambda b, m, r, o: [0.0, r, m],
    "unity": lambda b, m, r, o: [m, m, m, 1 - r], "linear base": lambda b, m, r, o: list(b),
    # glTF defines specular-gloss like this: diffuse is multiplied by 1 - max(specular).
    "diffuse": lambda b, m, r, o: [srgb(0.0 if m else c) for c in b],
    "specular": lambda b, m, r, o: [srgb(c if m else F0) for c in b]}

SETS = {
    "Substance 3D": {"Robot_BaseColor.png": "base", "Robot_Metallic.png": "metallic", "Robot_Roughness.png": "rough",
                     "Robot_Normal_OpenGL.png": "normal", "Robot_Height.png": "height"},
    "Quixel": {"sfk_2K_Albedo.png": "base", "sfk_2K_Roughness.png": "rough", "sfk_2K_Gloss.png": "gloss",
               "sfk_2K_Metalness.png": "metallic", "sfk_2K_AO.png": "ao", "sfk_2K_Normal.png": "normal"},
    "Poly Haven": {"rock_diff_2k.png": "base", "rock_rough_2k.png": "rough", "rock_arm_2k.png": "orm",
                   "rock_nor_gl_2k.png": "normal", "rock_disp_2k.png": "height"},
    "ambientCG": {"Metal032_2K-PNG_Color.png": "base", "Metal032_2K-PNG_Roughness.png": "rough",
                  "Metal032_2K-PNG_Metalness.png": "metallic", "Metal032_2K-PNG_NormalGL.png": "normal",
                  "Metal032_2K-PNG_NormalDX.png": "normal"},
    "Unity": {"Robot_BaseMap.png": "base", "Robot_MetallicSmoothness.png": "unity", "Robot_Normal.png": "normal",
              "Robot_Occlusion.png": "ao"},
    "Unreal": {"T_Robot_BC.png": "base", "T_Robot_N.png": "normal", "T_Robot_ORM.png": "orm"},
    "Marmoset": {"robot_Diffuse.png": "diffuse", "robot_Specular.png": "specular", "robot_Gloss.png": "gloss",
                 "robot_Normal.png": "normal"},
    "Blender's bake": {"Robot Base Color.png": "base", "Robot Metallic.png": "metallic", "Robot Roughness.png": "rough",
                       "Robot Normal.png": "normal"},
    "Mari UDIM": {f"robot_{word}.{tile}.exr": kind for tile in (1001, 1002)
                  for word, kind in (("baseColor", "linear base"), ("metalness", "metallic"), ("specRough", "rough"))},
    "glTF export": {"Robot Base Color.png": "base", "Robot Metallic-Robot Roughness.png": "mr", "Robot Normal.png": "normal"}}

TABLES = {"threejs": "mitsuba_ggx_to_threejs_r187_standard_metal.csv", "cycles-5/principled": "mitsuba_ggx_to_cycles_5_principled_metal.csv"}
PACKED = ("occlusion", "roughness", "metallic")
TARGETS = {  # the options, and what the channels hold, by a part of the file name
    "gltf": (["--to", "gltf", "--layout", "gltf"], {"baseColor": ("base",), "occlusionRoughnessMetallic": PACKED}),
    "unity": (["--to", "unity"], {"BaseMap": ("base",), "MetallicSmoothness": ("metallic", "metallic", "metallic", "smoothness")}),
    "unreal": (["--to", "unreal"], {"_BC": ("base",), "_ORM": PACKED}),
    "threejs": (["--to", "threejs"], {"baseColor": ("base",), "_orm": PACKED}),
    "cycles-5/principled": (["--to", "cycles-5/principled"], {})}


def write_sets(folders):
    """Writes maps of four patches by a single call of oiiotool, which takes a quarter of a second to start."""
    command = ["oiiotool"]
    for set_name, folder in folders.items():
        folder.mkdir(parents=True)
        for name, kind in SETS[set_name].items():
            for patch in PATCHES:
                values = VALUES[kind](*patch)
                command += ["--pattern", "constant:color=" + ",".join(f"{v:.6f}" for v in values), f"{SIDE // 2}x{SIDE // 2}",
                            str(len(values))]
            command += ["--mosaic", "2x2", "-d", "half" if name.endswith(".exr") else "uint8", "-o", str(folder / name), "--pop"]
    subprocess.run(command, check=True, capture_output=True)


def patches_in(paths):
    """Returns the values of the four patches of each file, as stored, by a single call of oiiotool."""
    text = subprocess.run(["oiiotool", "--no-autopremult", "--dumpdata", *map(str, paths)], check=True, capture_output=True, text=True).stdout
    patches = []
    for dump in re.split(r"(?m)^\S.*\d channel.*$", text)[1:]:
        values = {}
        # for integers, oiiotool prints the values as fractions in parentheses
        for x, y, line in re.findall(r"Pixel \((\d+), (\d+)\): ([^\n]*)", dump):
            values[int(x), int(y)] = [float(v) for v in re.sub(r".*\(|\)", "", line).split()]
        patches.append([values[place] for place in ((1, 1), (SIDE - 2, 1), (1, SIDE - 2), (SIDE - 2, SIDE - 2))])
    return dict(zip(paths, patches))


def between(rows, key, at):
    """Interpolates linearly between rows, which are lists of values that begin with a rising `key`."""
    below = max((row for row in rows if row[key] <= at), key=lambda row: row[key], default=min(rows, key=lambda row: row[key]))
    above = min((row for row in rows if row[key] >= at), key=lambda row: row[key], default=below)
    share = (at - below[key]) / (above[key] - below[key]) if above[key] > below[key] else 0.0
    return [a + share * (b - a) for a, b in zip(below, above)]


def measured(target, base, metallic, roughness):
    """Returns base color and roughness of a patch in another renderer, by the table of its metals."""
    if target not in TABLES or not metallic:
        return base, roughness
    text = (Path(__file__).resolve().parents[2] / "fits" / "tables" / TABLES[target]).read_text()
    rows = [[float(cell) for cell in line.split(",")[:4]] for line in text.splitlines() if line[:1].isdigit() and line.endswith("ok")]
    alphas = sorted({row[0] for row in rows})
    colors, widths = [], []
    for channel in base:
        row = between([between([r for r in rows if r[0] == alpha], 1, channel) for alpha in alphas], 0, roughness ** 2)
        colors.append(row[3])
        widths.append(row[2])
    return colors, max(widths) ** 0.5


def faults_of(path, patches, contents, tolerance, has_occlusion, target):
    faults, is_linear = [], path.suffix == ".exr"
    for found, (base, metallic, roughness, occlusion) in zip(patches, PATCHES):
        base, roughness = measured(target, base, metallic, roughness)
        expected = {"metallic": [metallic], "roughness": [roughness], "smoothness": [1 - roughness],
                    "occlusion": [occlusion if has_occlusion else 1.0], "base": list(base) if is_linear else [srgb(c) for c in base]}
        wanted = [v for content in contents for v in expected[content]]
        if len(found) < len(wanted) or any(abs(a - b) > tolerance for a, b in zip(found, wanted)):
            faults.append(f"{path.name}: {[round(v, 3) for v in found]}, expected {[round(v, 3) for v in wanted]}")
    return faults[:1]


def convert(texremap, folder, target):
    """Returns what texremap prints if it fails, and the files that it writes."""
    out = folder / "out" / re.sub(r"\W", "_", target)
    run = subprocess.run([texremap, "convert", str(folder), *TARGETS[target][0], "-o", str(out)], capture_output=True, text=True)
    faults = run.stderr.strip().splitlines()[-2:] if run.returncode != 0 else []
    return faults, sorted(path for path in out.rglob("*") if path.suffix in (".png", ".exr"))


def judge(found, patches, name, target):
    files = TARGETS[target][1]
    has_occlusion = any(kind in ("ao", "orm") for kind in SETS[name].values())
    tolerance = 0.04 if target in TABLES else 0.02 if name == "Marmoset" else 2.1 / 255
    if not files:  # results have the names of the inputs, or the names of their parameters
        words = {r"(?i)base.?color|albedo|_diff_|_color|basemap|_bc": ("base",), r"(?i)_?(specRough|roughness|rough)(_2k)?(\.\d+)?\.": ("roughness",)}
        faults = []
        for words_of, contents in words.items():
            matching = [p for p in found if re.search(words_of, p.name) and "Metallic" not in p.name and "_arm" not in p.name]
            if not matching and contents == ("base",):
                faults.append("no base color written")
            for path in matching:
                faults += faults_of(path, patches[path], contents, tolerance, has_occlusion, target)
        return faults
    faults = []
    for word, contents in files.items():
        matching = [p for p in found if word in p.name]
        if not matching:
            faults.append(f"no {word}")
        for path in matching:
            faults += faults_of(path, patches[path], contents, tolerance, has_occlusion, target)
    return faults


def main():
    texremap = sys.argv[1]
    right = 0
    faults = []
    with tempfile.TemporaryDirectory() as made:
        folders = {name: Path(made) / str(number) / "set" for number, name in enumerate(SETS)}
        write_sets(folders)
        runs = {(name, target): convert(texremap, folders[name], target) for name in SETS for target in TARGETS}
        patches = patches_in([path for _, found in runs.values() for path in found])
    print(f"{'set':16}" + "".join(f"{target:22}" for target in TARGETS))
    for name in SETS:
        row = f"{name:16}"
        for target in TARGETS:
            failed, found = runs[name, target]
            wrong = failed or judge(found, patches, name, target)
            right += not wrong
            row += f"{'wrong' if wrong else 'right':22}"
            faults += [f"{name} to {target}: {fault}" for fault in wrong]
        print(row.rstrip())
    print(f"\n{right} of {len(SETS) * len(TARGETS)} right")
    print("\n".join(faults))
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
