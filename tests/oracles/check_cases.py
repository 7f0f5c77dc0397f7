#!/usr/bin/env python3
"""check_cases.py OUT [--size 128] [--seed-offset N] writes texture sets that test `texremap check`.

OUT/faults/NAME/ has one fault each, rebuilt from public bug reports ("own" if no report covers it).
OUT/clean/HABIT_MATERIAL/ has sets without a fault. OUT/cases.json says which rules must find what. Needs NumPy and
oiiotool (for EXR only). Nothing here was made with knowledge of the command: each case follows what its report says
about files. Offset 0 is for choosing thresholds, other offsets are for reporting. The offset changes patterns,
colours and ranges of roughness of every case.
"""
import argparse
import base64
import colorsys
import json
import struct
import subprocess
import tempfile
import zlib
from pathlib import Path

import numpy as np

# ---------------------------------------------------------------------------------------------------------------- files

SRGB = [(b"sRGB", b"\0")]
SRGB_AND_GAMMA = [(b"sRGB", b"\0"), (b"gAMA", struct.pack(">I", 45455))]
GAMMA_22 = [(b"gAMA", struct.pack(">I", 45455))]
GAMMA_1 = [(b"gAMA", struct.pack(">I", 100000))]
exr_queue = []  # pairs (path, array), which oiiotool writes all at once at the end


def encode(x):
    """Converts linear values to sRGB."""
    return np.where(x <= .0031308, 12.92 * x, 1.055 * np.maximum(x, 1e-9) ** (1 / 2.4) - .055)


def decode(x):
    """Converts sRGB values to linear."""
    return np.where(x <= .04045, x / 12.92, ((x + .055) / 1.055) ** 2.4)


def planes(a):
    """Returns the array as height x width x channels."""
    return a if a.ndim == 3 else a[..., None]


def integers(a, bits):
    return np.ascontiguousarray(np.rint(np.clip(a, 0, 1) * (2 ** bits - 1)), ">u2" if bits == 16 else "u1")


def png(a, bits=8, chunks=()):
    """Returns the bytes of a PNG file. Chunks about colour come between IHDR and IDAT."""
    h, w, c = a.shape
    raw = integers(a, bits).reshape(h, -1).view("u1").reshape(h, -1)
    raw = np.concatenate([np.zeros((h, 1), "u1"), raw], 1).tobytes()
    header = struct.pack(">IIBBBBB", w, h, bits, {1: 0, 2: 4, 3: 2, 4: 6}[c], 0, 0, 0)
    parts = [(b"IHDR", header), *chunks, (b"IDAT", zlib.compress(raw, 3)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(struct.pack(">I", len(d)) + t + d + struct.pack(">I", zlib.crc32(t + d)) for t, d in parts)


def tga(a):
    """Returns the bytes of an uncompressed TGA file, rows from the top."""
    h, w, c = a.shape
    order = [0] if c == 1 else [2, 1, 0, 3][:c]
    return struct.pack("<BBBHHBHHHHBB", 0, 0, 3 if c == 1 else 2, 0, 0, 0, 0, 0, w, h, 8 * c, 0x20 | (8 if c == 4 else 0)) + \
        integers(a, 8)[..., order].tobytes()


def tiff(a, srgb=False, floats=False):
    """Returns the bytes of an uncompressed TIFF, 8-bit or float. `srgb` adds an Exif directory whose ColorSpace is 1,
    sRGB."""
    h, w, c = a.shape
    data = (a.astype("<f4") if floats else integers(a, 8)).tobytes()
    bits, kind = (32, 3) if floats else (8, 1)
    tags = [(256, 4, [w]), (257, 4, [h]), (258, 3, [bits] * c), (259, 3, [1]), (262, 3, [2 if c >= 3 else 1]), (273, 4, [8]), (277, 3, [c]),
            (278, 4, [h]), (279, 4, [len(data)]), (284, 3, [1])] + ([(338, 3, [2] if c in (2, 4) else [0])] if c in (2, 4) else []) + \
           [(339, 3, [kind] * c)] + ([(34665, 4, [0])] if srgb else [])
    start = 8 + len(data) + (len(data) & 1)
    extra_at = start + 2 + 12 * len(tags) + 4
    extra, entries = b"", b""
    exif = struct.pack("<H", 1) + struct.pack("<HHIHH", 0xA001, 3, 1, 1, 0) + struct.pack("<I", 0)
    for tag, type_, values in tags:
        packed = struct.pack(f"<{len(values)}{'I' if type_ == 4 else 'H'}", *values)
        if tag == 34665:
            packed, extra = struct.pack("<I", extra_at + len(extra)), extra + exif
        elif len(packed) > 4:
            packed, extra = struct.pack("<I", extra_at + len(extra)), extra + packed
        entries += struct.pack("<HHI", tag, type_, len(values)) + packed.ljust(4, b"\0")
    return struct.pack("<2sHI", b"II", 42, start) + data + b"\0" * (len(data) & 1) + struct.pack("<H", len(tags)) + entries + b"\0" * 4 + extra


def save(path, a, bits=8, chunks=(), color=False, srgb_tag=False):
    """Writes an array of 0..1 in the format of the path's suffix. `color` means sRGB values, which EXR stores as
    linear."""
    a, suffix = planes(np.asarray(a, float)), path.suffix
    if suffix == ".exr":
        exr_queue.append((path, decode(a) if color else a))
    else:
        path.write_bytes({".png": lambda: png(a, bits, chunks), ".tga": lambda: tga(a), ".tif": lambda: tiff(a, srgb_tag)}[suffix]())


def write_exrs():
    """Writes the queued EXR files as half floats, in batches."""
    with tempfile.TemporaryDirectory() as folder:
        for first in range(0, len(exr_queue), 30):
            command = ["oiiotool", "--nosoftwareattrib", "--compression", "zip"]
            for i, (path, a) in enumerate(exr_queue[first:first + 30]):
                source = Path(folder, f"{i}.tif")
                source.write_bytes(tiff(a, floats=True))
                command += [str(source), "--attrib", "DateTime", "2024:01:01 00:00:00", "-d", "half", "-o", str(path)]
            subprocess.run(command, check=True)
    exr_queue.clear()


# ------------------------------------------------------------------------------------------------------------ materials


def noise(rng, n, beta=2.4, stretch=(1, 1)):
    """Returns tileable noise of all octaves with the power spectrum f^-beta, 0..1, median .5."""
    f = np.fft.fftfreq(n) * n
    radius = np.hypot(f[:, None] * stretch[0], f[None] * stretch[1])
    radius[0, 0] = 1
    x = np.fft.ifft2(np.fft.fft2(rng.standard_normal((n, n))) * radius ** (-beta / 2) * (radius > 0)).real
    return .5 + .5 * np.tanh(.75 * (x - x.mean()) / x.std())


def soften(x, times=1):
    """Blurs by 1 2 1 along both axes, which gives a mask antialiased edges."""
    for _ in range(times):
        for axis in (0, 1):
            x = (np.roll(x, 1, axis) + 2 * x + np.roll(x, -1, axis)) / 4
    return x


def mask(x, share):
    """Returns a binary mask of about the given fraction of texels, with antialiased edges one to two texels wide."""
    x = soften(x, 2)
    slope = np.hypot(np.roll(x, -1, 0) - np.roll(x, 1, 0), np.roll(x, -1, 1) - np.roll(x, 1, 1)) / 2
    return np.clip((x - np.quantile(x, 1 - share)) / np.maximum(slope, 1e-4) + .5, 0, 1)


def tint(rng, hue, saturation, value, detail, depth=.15):
    """Returns an sRGB colour close to the given hue, modulated by a scalar map."""
    rgb = np.array(colorsys.hsv_to_rgb((hue + rng.uniform(-.03, .03)) % 1, np.clip(saturation + rng.uniform(-.1, .1), 0, 1), value))
    return np.clip(rgb * (1 + depth * (2 * detail[..., None] - 1)), 0, 1)


def blend(a, b, t):
    return a + (b - a) * (t[..., None] if np.ndim(a) == 3 else t)


def normals(height, strength):
    """Returns the tangent-space normals of a height map in OpenGL's orientation (green up, while rows go down)."""
    dx = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) * strength
    dy = (np.roll(height, 1, 0) - np.roll(height, -1, 0)) * strength
    v = np.stack([-dx, -dy, np.ones_like(dx)], -1)
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def material(kind, seed, n):
    """Returns the maps of a material by name: base, rough, metal, ao, height, normal, normaldx, gloss, spec, diff
    (colours in sRGB)."""
    rng = np.random.default_rng([seed, zlib.crc32(kind.encode())])
    a, b, fine = noise(rng, n), noise(rng, n, 2), noise(rng, n, .9)
    y, x = np.mgrid[0:n, 0:n] / n
    u = rng.uniform
    if kind in ("rust", "chrome"):  # bare metal with rust, from polished to coarse
        low, high = (u(.05, .07), u(.11, .15)) if kind == "chrome" else (u(.6, .66), u(.8, .85)) if u() < .4 else (u(.15, .25), u(.35, .5))
        rusty = mask(noise(rng, n, 3), u(.02, .08) if kind == "chrome" else u(.2, .5))
        metal = 1 - rusty
        rough = blend(low + (high - low) * (.6 * b + .4 * fine), u(.72, .8) + .15 * fine, rusty)
        base = blend(tint(rng, .08, .1, u(.78, .9), fine, .04), tint(rng, .05, .7, u(.35, .5), b, .4), rusty)
        height = .3 * a * rusty + .1 * fine
    elif kind == "plastic":  # with fingerprints
        prints = np.zeros((n, n))
        for _ in range(4):
            cy, cx, turn = u(.2, .8), u(.2, .8), u(0, 3.14)
            dy, dx = (y - cy) * np.cos(turn) + (x - cx) * np.sin(turn), (x - cx) * np.cos(turn) - (y - cy) * np.sin(turn)
            r = np.hypot(dy / 1.5, dx)
            prints = np.maximum(prints, (.6 + .4 * np.sin(220 * r + 5 * a)) * np.clip((.13 - r) * 25, 0, 1))
        low = u(.12, .4)
        rough = low + .15 * b + .06 * fine + u(.15, .25) * prints * (.5 + .5 * fine)
        metal, base = np.zeros((n, n)), tint(rng, u(0, 1), .55, u(.35, .75), b, .06)
        height = .05 * fine + .1 * b
    elif kind == "wood":  # varnished, worn in places
        streak = noise(rng, n, 1.8, (1, 9))
        rings = .5 + .5 * np.sin(2 * np.pi * (u(5, 9) * x + 1.5 * a))
        worn = soften((b > np.quantile(b, .8)).astype(float), 6)
        rough = blend(u(.14, .25) + .1 * streak + .05 * fine, u(.45, .55) + .2 * streak, worn)
        metal = np.zeros((n, n))
        base = blend(tint(rng, .07, .6, u(.3, .45), streak, .3), tint(rng, .09, .5, u(.5, .7), streak, .2), .6 * rings + .4 * streak)
        height = .2 * rings + .15 * streak
    elif kind == "painted":  # paint on steel, worn at the edges of panels
        edge = np.minimum(np.abs((x * 3) % 1 - .5), np.abs((y * 2) % 1 - .5))
        metal = mask(.8 * a + .2 * fine - 2.2 * edge, u(.15, .35))
        rough = blend(u(.38, .6) + .12 * b + .05 * fine, u(.18, .28) + .15 * fine, metal)
        base = blend(tint(rng, u(0, 1), .7, u(.35, .7), b, .1), tint(rng, .6, .05, u(.75, .85), fine, .05), metal)
        height = .25 * (1 - soften(metal, 2)) + .04 * fine + .2 * np.clip(edge * 12, 0, 1)
    else:  # fabric
        k = 2 * np.pi * n / 8
        weave = .5 + .25 * np.sin(k * x + a) * np.sin(k * y) + .25 * np.sign(np.sin(k * x / 2)) * np.cos(k * y)
        weave = soften(np.clip(weave + .3 * (fine - .5), 0, 1))
        rough = u(.68, .75) + .12 * weave + .1 * b
        metal, base = np.zeros((n, n)), tint(rng, u(0, 1), .45, u(.35, .65), .7 * weave + .3 * b, .35)
        height = .4 * weave + .2 * b
    rough = np.clip(rough, .02, .97)
    v = normals(height, u(1.5, 3) * n / 64)
    linear = decode(base)
    m = dict(base=base, rough=rough, metal=metal, height=height, gloss=1 - rough, normal=.5 + .5 * v, normaldx=.5 + .5 * v * [1, -1, 1])
    m["ao"] = np.clip(.9 + .9 * (height - soften(height, 12)) + .15 * (a - .5), .2, 1)
    m["spec"] = encode(.04 * (1 - metal[..., None]) * (.95 + .1 * b[..., None]) + linear * metal[..., None])
    m["diff"] = encode(linear * (1 - metal[..., None]))
    return m


def build(m, spec):
    """Returns the array for "base+1" or "ao|rough|metal": maps and constants, one after the other as channels."""
    shape = m["rough"].shape
    parts = [np.full(shape, float(p)) if p.replace(".", "").isdigit() else m[p] for p in spec.replace("+", "|").split("|")]
    return np.concatenate([planes(p) for p in parts], -1)


def write(folder, m, maps, bits=8, chunks=SRGB):
    """Writes {file name: channels}. Colour files get the chunks (and 8 bits), data files get none."""
    for name, spec in maps.items():
        color = spec.split("+")[0] in ("base", "diff", "spec")
        save(folder / name, build(m, spec), 8 if color or spec.startswith("normal") else bits, chunks if color else (), color)


# --------------------------------------------------------------------------------------------------------- asset files

TRIANGLE = struct.pack("<24f", 0, 0, 0, 1, 0, 0, 0, 1, 0, *[0, 0, 1] * 3, 0, 1, 1, 1, 0, 0)


def gltf(path, mat, required=()):
    """Writes a .gltf of one triangle. Values {"file": name} in the material become textures, and its extensions are
    declared."""
    files, used = [], sorted(mat.get("extensions", {}))

    def walk(x):
        if isinstance(x, dict) and "file" in x:
            if x["file"] not in files:
                files.append(x["file"])
            return {"index": files.index(x["file"]), **{k: v for k, v in x.items() if k != "file"}}
        return {k: walk(v) for k, v in x.items()} if isinstance(x, dict) else x

    views = [{"buffer": 0, "byteOffset": o, "byteLength": s} for o, s in ((0, 36), (36, 36), (72, 24))]
    accessors = [{"bufferView": i, "componentType": 5126, "count": 3, "type": t} for i, t in enumerate(("VEC3", "VEC3", "VEC2"))]
    accessors[0].update(min=[0, 0, 0], max=[1, 1, 0])
    attributes = {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": attributes, "material": 0}]}], "materials": [walk(mat)],
                "textures": [{"source": i, "sampler": 0} for i in range(len(files))], "images": [{"uri": f} for f in files],
                "samplers": [{"magFilter": 9729, "minFilter": 9987}], "accessors": accessors, "bufferViews": views,
                "buffers": [{"byteLength": 96, "uri": "data:application/octet-stream;base64," + base64.b64encode(TRIANGLE).decode()}]}
    document |= ({"extensionsUsed": used} if used else {}) | ({"extensionsRequired": sorted(required)} if required else {})
    path.write_text(json.dumps(document, indent=1) + "\n")
    return path.name


def asset(folder, m, name="Robot", mr="1|rough|metal", extensions=None, required=(), **pbr):
    """Writes a glTF export: three textures (two without `mr`) and their .gltf. Keywords are fields of
    pbrMetallicRoughness."""
    base, rough, normal = f"{name}_baseColor.png", f"{name}_metallicRoughness.png", f"{name}_normal.png"
    write(folder, m, {base: "base", normal: "normal"} | ({rough: mr} if mr else {}))
    pbr = {"baseColorTexture": {"file": base}, "metallicRoughnessTexture": {"file": rough}, **pbr}
    mat = {"name": name, "pbrMetallicRoughness": pbr, "normalTexture": {"file": normal}}
    mat |= {"occlusionTexture": {"file": rough}} if mr and mr.startswith("ao") else {}
    mat |= {"extensions": {f"KHR_materials_{k}": v for k, v in extensions.items()}} if extensions else {}
    return gltf(folder / f"{name}.gltf", mat, [f"KHR_materials_{k}" for k in required])


def spec_gloss(folder, m, texture, required=False):
    """Writes a glTF with a specular-glossiness material whose texture has the given channels."""
    write(folder, m, {"Robot_diffuse.png": "diff", "Robot_normal.png": "normal"})
    save(folder / "Robot_specularGlossiness.png", texture)
    ext = {"diffuseTexture": {"file": "Robot_diffuse.png"}, "specularGlossinessTexture": {"file": "Robot_specularGlossiness.png"}}
    name = "KHR_materials_pbrSpecularGlossiness"
    mat = {"name": "Robot", "extensions": {name: ext}, "normalTexture": {"file": "Robot_normal.png"}}
    return gltf(folder / "Robot.gltf", mat, [name] if required else ())


def painter(folder, m, name="Robot", suffix=".png", **other):
    """Writes a metal-rough export of four maps. Keywords replace a map's channels (None: no such map), or are (array,
    bits, chunks)."""
    for role, spec in ({"BaseColor": "base", "Metallic": "metal", "Roughness": "rough", "Normal": "normal"} | other).items():
        path = folder / f"{name}_{role}{suffix}"
        if isinstance(spec, str):
            write(folder, m, {path.name: spec})
        elif spec:
            save(path, *spec)


def mtl(path, materials):
    """Writes an .mtl of [(name, {statement: value})]."""
    path.write_text("# Materials\n" + "".join(f"\nnewmtl {n}\n" + "".join(f"{k} {v}\n" for k, v in s.items()) for n, s in materials))
    return path.name


# --------------------------------------------------------------------------------- clean sets: 12 naming conventions


def painter_clean(d, m, i):
    """Writes a set of Substance 3D Painter, metal-rough. Wood has the usual constant metallic map. Plastic and fabric
    have none."""
    dx = i == 3
    write(d, m, {"Robot_BaseColor.png": "base", "Robot_Roughness.png": "rough" if i % 2 else "rough|rough|rough",
                 "Robot_Normal_DirectX.png" if dx else "Robot_Normal.png": "normaldx" if dx else "normal"}
          | ({} if i in (1, 4) else {"Robot_Metallic.png": "metal"}), 8, SRGB if i % 2 else ())


def megascans(d, m, i):
    maps = {"sfk_2K_Albedo.png": "diff", "sfk_2K_Specular.png": "spec", "sfk_2K_AO.png": "ao", "sfk_2K_Displacement.png": "height"}
    maps |= {"sfk_2K_Roughness.png": "rough|rough|rough"} if i != 3 else {}
    write(d, m, maps | ({"sfk_2K_Gloss.png": "gloss|gloss|gloss"} if i in (2, 3) else {}), 16 if i == 0 else 8, ())


def poly_haven(d, m, i):
    """Writes a packed map that repeats the separate map, as downloads of this site do. Some have roughness as EXR."""
    e = "exr" if i % 2 else "png"
    write(d, m, {"rock_diff_2k.png": "base", f"rock_rough_2k.{e}": "rough", f"rock_nor_gl_2k.{e}": "normal", "rock_arm_2k.png": "ao|rough|metal",
                 "rock_disp_2k.png": "height"}, 16 if i == 4 else 8, SRGB_AND_GAMMA if i % 2 else ())


def ambient_cg(d, m, i):
    name = f"{'Metal Plastic Wood Metal Fabric'.split()[i]}0{i + 1}_2K{'-PNG' if i % 2 else ''}"
    write(d, m, {f"{name}_Color.png": "base", f"{name}_Roughness.png": "rough", f"{name}_NormalGL.png": "normal",
                 f"{name}_NormalDX.png": "normaldx", f"{name}_Displacement.png": "height"}
          | ({f"{name}_Metalness.png": "metal"} if i in (0, 2, 3) else {}), 16 if i == 0 else 8, GAMMA_22 if i == 2 else ())


def unity_urp(d, m, i):
    e = "tga" if i == 3 else "png"
    write(d, m, {f"Robot_BaseMap.{e}": "base+1" if i % 2 else "base", f"Robot_MetallicSmoothness.{e}": "metal|metal|metal|gloss" if i % 2 else
                 "metal|0|0|gloss", f"Robot_Normal.{e}": "normal", f"Robot_Occlusion.{e}": "ao"}, 8, ())


def unity_hdrp(d, m, i):
    m = m | {"detail": np.clip(.5 + .5 * (m["height"] - m["height"].mean()), 0, 1)}
    mask_map = {"Robot_MaskMap.png": "metal|ao|detail|gloss" if i % 2 else "metal|ao|0|gloss"}
    write(d, m, {"Robot_BaseMap.png": "base", "Robot_Normal.png": "normal"} | mask_map, 8, SRGB if i % 2 else ())


def unreal(d, m, i):
    """Writes a set for Unreal, which reads normal maps in DirectX's orientation. The prefix T_ is Unreal's."""
    e = "tga" if i % 2 else "png"
    write(d, m, {f"T_Robot_BC.{e}": "base+1" if i == 1 else "base", f"T_Robot_N.{e}": "normaldx", f"T_Robot_ORM.{e}": "ao|rough|metal"}, 8, ())


def marmoset(d, m, i):
    maps = {"Robot_Diffuse.png": "diff", "Robot_Specular.png": "spec", "Robot_Gloss.png": "gloss" if i % 2 else "gloss|gloss|gloss"}
    write(d, m, maps | {"Robot_Normal.png": "normal"}, 16 if i == 3 else 8, SRGB if i % 2 else ())


def blender_bake(d, m, i):
    write(d, m, {"Robot Base Color.png": "base+1", "Robot Roughness.png": "rough|rough|rough+1", "Robot Normal.png": "normal+1"}
          | ({} if i in (1, 4) else {"Robot Metallic.png": "metal|metal|metal+1"}), 16 if i == 2 else 8, SRGB)


def mari_udim(d, m, i):
    for tile, t in ((1001, m), (1002, m["again"])):
        maps = {f"robot_baseColor.{tile}.exr": "base", f"robot_roughness.{tile}.exr": "rough", f"robot_normal.{tile}.exr": "normal"}
        write(d, t, maps | ({} if i in (1, 4) else {f"robot_metallic.{tile}.exr": "metal"}))


def gltf_export(d, m, i):
    """Writes valid glTF with factors next to maps (no reader is given), or with a dielectric of index 1.45."""
    factors = [{}, {"roughnessFactor": .9}, {"baseColorFactor": [.9, .9, .9, 1]}, {}, {"metallicFactor": 0}][i]
    return asset(d, m, mr="ao|rough|metal" if i % 2 else "1|rough|metal", extensions={"ior": {"ior": 1.45}} if i == 1 else None, **factors)


def mtl_maps(d, m, i):
    maps = {"map_Kd": ("robot_diffuse.png", "base"), "norm": ("robot_normal.png", "normal")}
    maps |= {"map_Ns": ("robot_gloss.png", "gloss")} if i in (1, 4) else {"map_Pr": ("robot_roughness.png", "rough"),
                                                                         "map_Pm": ("robot_metallic.png", "metal")}
    write(d, m, dict(maps.values()))
    plain = {"Kd": "0.640000 0.640000 0.640000", "Ks": "0.500000 0.500000 0.500000", "Ni": "1.450000", "d": "1.000000", "illum": 2}
    shine = [323.999994, 250, 96.078431, 400, 25.5]
    return mtl(d / "robot.mtl", [("Robot", {"Ns": shine[i]} | plain | {k: f for k, (f, _) in maps.items()}),
                                 ("Rubber", {"Ns": "12.156863"} | plain), ("Chrome", {"Ns": "900.000000"} | plain)])


HABITS = dict(painter=painter_clean, megascans=megascans, polyhaven=poly_haven, ambientcg=ambient_cg, urp=unity_urp, hdrp=unity_hdrp,
              unreal=unreal, marmoset=marmoset, blender=blender_bake, mari=mari_udim, gltf=gltf_export, mtl=mtl_maps)
MATERIALS = ["rust", "plastic", "wood", "painted", "fabric"]

# ------------------------------------------------------------------------------------------------------------- faults

FACTOR = r"factor.{0,80}(\b1\b|\bone\b|remov|delet|bak)|(set|remov|delet|drop|bak|fold|multipl|appl).{0,80}factor"
LINEAR = r"linear|\braw\b|non-?colou?r|re-?tag|colou?r[- ]?space|(remov|delet|strip|drop).{0,40}(sRGB|gAMA|chunk|tag|profile)"
ROOT = r"sqrt|\broot|\^ ?0?\.5|alpha"
INVERT = r"invert|inver[st]|1 ?[-−] ?|complement|\bgloss|smooth"
IOR = r"\bior\b|index of refraction|specular_?(color_?)?factor|\b1\.5\b"
DROP = r"bak|remov|delet|drop|convert|fold|replac|rewrit|re-?export|metal.?rough|\bset\b|instead"
EXPONENT = r"1000|\bNs\b|exponent|percent|scal|multipl|range"
ORDER = r"channel|swap|reorder|order|re-?pack|blue|\bB\b"
SLOT = r"(point|assign|us|set|replac|swap|connect|put|mov|giv|writ)\w*.{0,80}(texture|image|map|slot|index)|(roughness|colou?r)_?texture"
FOUR = r"alpha|gloss|channel|RGBA|four"
PACK = r"factor|pack|re-?export|re-?bak|remov|replac|green|\bG\b|drop|constant|value|scalar"
FLIP = r"flip|invert|negat|green|\bG\b|\bY\b|direct ?x|opengl|rename|1 ?[-−]"


def world_normals(m):
    """Returns world-space normals of a sphere with the material's detail."""
    n = len(m["rough"])
    y, x = (np.mgrid[0:n, 0:n] + .5) / n
    theta, phi = 2 * np.pi * x, np.pi * (.5 - y)
    frame = np.stack([[-np.sin(theta), 0 * x, np.cos(theta)], [-np.sin(phi) * np.cos(theta), np.cos(phi), -np.sin(phi) * np.sin(theta)],
                      [np.cos(phi) * np.cos(theta), np.sin(phi), np.cos(phi) * np.sin(theta)]])
    return .5 + .5 * np.einsum("kcyx,yxk->yxc", frame, 2 * m["normal"] - 1)


def water_bottle(d, m):
    write(d, m, {"WaterBottle_BaseColor.png": "base", "WaterBottle_Normal.png": "normal"})
    save(d / "WaterBottle_OcclusionRoughnessMetallic.tif", build(m, "ao|rough|metal"), srgb_tag=True)


def iridescent(d, m):
    save(d / "Robot_iridescence.png", m["rough"])
    iridescence = {"iridescenceFactor": 1, "iridescenceIor": 1.3, "iridescenceTexture": {"file": "Robot_iridescence.png"}}
    return asset(d, m, extensions={"iridescence": iridescence, "dispersion": {"dispersion": .3}})


def chair(d, m):
    m = m | {"metal": mask(m["height"], .12)}  # brass inlays, so that metallic is not constant
    asset(d, m, "Chair", mr="1|gloss|metal")
    write(d, m, {"Chair_MetallicSmoothness.png": "metal|0|0|gloss"})


def all_white(d, m):
    save(d / "Robot_Roughness.png", m["rough"])
    return asset(d, m, mr="1|1|1")


def half_metal(m):
    return .3 + .4 * noise(np.random.default_rng(zlib.crc32(m["rough"].tobytes())), len(m["rough"]))


def bands(m):
    """Returns roughness that changes smoothly from .01 to .05, below the rust. 8 bits have about ten levels there,
    and each is a visible band."""
    y, x = np.mgrid[0:len(m["rough"]), 0:len(m["rough"])] / len(m["rough"])
    return blend(.01 + .04 * (.7 * x + .3 * y), m["rough"], 1 - m["metal"])


def not_finite(m):
    rough = m["rough"].copy()
    rough[len(rough) // 3, 10:15], rough[-9, 20] = np.nan, np.inf
    return rough


def exponents(d, m, **shininess):
    """Writes an .mtl of plain materials with the given exponents (a trailing _P in a name means %), the first with a
    diffuse map."""
    write(d, m, {"body_diffuse.png": "base"})
    rest = {"Kd": "0.640000 0.640000 0.640000", "Ks": "0.500000 0.500000 0.500000", "illum": 2}
    return mtl(d / "robot.mtl", [(n.replace("_P", "%"), {"Ns": ns} | rest | ({} if i else {"map_Kd": "body_diffuse.png"}))
                                 for i, (n, ns) in enumerate(shininess.items())])


# The fields are: name | report | rules | expression for the fix | reader | material | function that writes the files
# and returns the asset (None: the folder).
FAULTS = [
    # Smoothness 1 became roughnessFactor 0, so the content of the map is lost.
    ("full-smoothness-times-map", "glTFast 795", "factor-zero", FACTOR, None, "painted", lambda d, m: asset(d, m, roughnessFactor=0)),
    ("scalar-beside-map", "glTFast 796", "factor-ignored", FACTOR, "unity", "rust",
     lambda d, m: asset(d, m, roughnessFactor=.75, metallicFactor=.9)),
    # The converter put metallic into R, and B stayed 0.
    ("metallic-in-red", "trimesh 2195", "channel-order", ORDER, None, "rust", lambda d, m: asset(d, m, mr="metal|rough|0")),
    # The roughness is tagged sRGB, the other data maps are not.
    ("roughness-png-tagged-srgb", "usd-wg assets 98", "srgb-data", LINEAR, None, "painted",
     lambda d, m: painter(d, m, Roughness=(m["rough"], 8, SRGB_AND_GAMMA))),
    # The packed map of the water bottle is read as sRGB, here because of its Exif ColorSpace.
    ("orm-tiff-tagged-srgb", "OpenUSD 1174", "srgb-data", LINEAR, None, "rust", water_bottle),
    ("world-space-normals", "MaterialX 2729", "normal-space", r"tangent|object|world|re-?bak", None, "painted",
     lambda d, m: painter(d, m, Normal=(world_normals(m),))),
    # The shader squares again: the roughness map is the square of alpha, r^4, while the gloss map is 1 - r.
    ("sheen-roughness-squared-twice", "MaterialX 2642", "alpha-as-roughness", ROOT, None, "fabric",
     lambda d, m: painter(d, m, "Velvet", ".exr", Metallic=None, Roughness=(m["rough"] ** 4,), Gloss="gloss")),
    # The inputs without counterpart include iridescence and dispersion, which UsdPreviewSurface lacks.
    ("inputs-dropped-by-preview-surface", "MaterialX 2578", "ignored-by-reader", DROP, "usd", "plastic", iridescent),
    # The exporter wrote gloss instead of roughness. The source's gloss map is still there, pixel for pixel.
    ("gloss-written-as-roughness", "playcanvas 8248", "gloss-as-roughness duplicate-map", INVERT, None, "painted",
     lambda d, m: painter(d, m, Roughness="gloss", Gloss="gloss")),
    # G of metallicRoughness holds the smoothness of Unity's map. The whole folder is checked, because it has the
    # asset and the source map.
    ("smoothness-in-green", "UnityGLTF 546", "gloss-as-roughness", INVERT, None, "wood", chair),
    # Only a roughness texture was connected, and the exported metallicRoughness texture is all white. The source map
    # is in the same folder.
    ("exported-texture-all-white", "glTF-Blender-IO 2228", "constant-map", PACK, None, "plastic", all_white),
    # Specular 0 is intended. An index of 1 removes the reflection a second time, and the refraction, too.
    ("no-specular-by-two-ways", "glTF-Blender-IO 2322", "ior", IOR, None, "plastic",
     lambda d, m: asset(d, m, extensions={"specular": {"specularFactor": 0}, "ior": {"ior": 1}})),
    # The factor is IOR level .8 times two, as the report proposes. The range of the extension ends at 1. Only the
    # colour may exceed 1.
    ("specular-factor-above-one", "glTF-Blender-IO 2745", "ior", IOR, None, "plastic",
     lambda d, m: asset(d, m, extensions={"specular": {"specularFactor": 1.6}})),
    ("specular-for-godot", "godot 83320", "ignored-by-reader", DROP, "godot", "plastic",
     lambda d, m: asset(d, m, extensions={"specular": {"specularFactor": .2}})),
    # The report is about Unreal, which reads the extension by now. Godot still does not.
    ("specular-and-ior-for-godot", "glTF 2433", "ignored-by-reader", DROP, "godot", "wood",
     lambda d, m: asset(d, m, extensions={"specular": {"specularFactor": 0, "specularColorFactor": [1, .9, .8]}, "ior": {"ior": 1.33}})),
    # The add-on squares, and the renderer squares again: the alpha map is r^4, but the roughness map needs r^2.
    ("alpha-squared-twice", "mitsuba-blender 151", "alpha-as-roughness", ROOT, None, "rust", lambda d, m: painter(d, m, Alpha=(m["rough"] ** 4,))),
    ("alpha-named-roughness", "mitsuba-blender 122", "alpha-as-roughness", ROOT, None, "painted",
     lambda d, m: painter(d, m, Roughness=(m["rough"] ** 2,), Glossiness="gloss")),
    # The packed texture had no separate type, so an exporter mistook it for the base colour.
    ("base-color-as-metallic-roughness", "assimp 5968", "wrong-texture", SLOT, None, "rust",
     lambda d, m: asset(d, m, mr=None, metallicRoughnessTexture={"file": "Robot_baseColor.png"})),
    ("zero-times-map", "UniVRM 212", "factor-zero", FACTOR, None, "rust",
     lambda d, m: asset(d, m, mr="ao|rough|metal", roughnessFactor=0.0, metallicFactor=1.0)),
    ("specgloss-of-three-channels", "trimesh 1980", "specgloss-channels", FOUR, None, "painted", lambda d, m: spec_gloss(d, m, m["spec"])),
    # Metallic of .3 to .7 comes from a reflection map, which makes skin half metal.
    ("metallic-from-reflection", "FBX2glTF 255", "metallic-greys", r"threshold|binar|\b0 (or|and) 1\b|metal|specular", None, "plastic",
     lambda d, m: painter(d, m, "Skin", Metallic=(half_metal(m),))),
    # A very large index makes F0 almost 1. The exporter should have set metallic instead.
    ("ior-1000-for-metal", "glTF 1719", "ior", IOR + "|metallic", None, "rust",
     lambda d, m: asset(d, m, mr="1|rough|0", extensions={"ior": {"ior": 1000}})),
    ("specgloss-used-for-threejs", "mesh-viewer 56", "ignored-by-reader", DROP, "threejs", "painted",
     lambda d, m: spec_gloss(d, m, build(m, "spec+gloss"))),
    # The materials are white, because the file *requires* specular and ior, which the reader does not know.
    ("required-extensions", "flutter_3d_controller 83", "ignored-by-reader", DROP, "godot", "plastic",
     lambda d, m: asset(d, m, extensions={"specular": {"specularFactor": .8}, "ior": {"ior": 1.4}}, required=("specular", "ior"))),
    # Shininess from 0 to 100, as in FBX, is written as exponents.
    ("exponent-in-percent", "assimp 4573", "exponent-range", EXPONENT, None, "painted", lambda d, m: exponents(
        d, m, Paint_Shininess_30_P=30, Rubber_Shininess_5_P=5, Plastic_Shininess_60_P=60, Glass_Shininess_95_P=95, Chrome_Shininess_100_P=100)),
    # The report asks how to convert an .mtl. A tool can only see that all exponents lie within 0 to 1.
    ("exponent-of-0-to-1", "IsaacLab 4378", "exponent-range", EXPONENT, None, "painted",
     lambda d, m: exponents(d, m, Paint=.3, Rubber=.05, Plastic=.62, Glass=.95, Chrome=1.0, Wood=.4)),

    ("base-color-tagged-linear", "own", "linear-color", r"sRGB|re-?tag|colou?r[- ]?space|gAMA|chunk", None, "painted",
     lambda d, m: painter(d, m, BaseColor=(m["base"], 8, GAMMA_1))),
    # The separate roughness is encoded as sRGB, but the roughness of the packed map is not. No file has a tag.
    ("roughness-stored-srgb", "own", "srgb-data", LINEAR, None, "rust",
     lambda d, m: write(d, m | {"encoded": encode(m["rough"])},
                        {"rock_diff_2k.png": "base", "rock_rough_2k.png": "encoded", "rock_arm_2k.png": "ao|rough|metal"})),
    ("roughness-of-other-aspect", "own", "sizes", r"siz|resampl|scale|resolution|aspect|\d+ ?[x×] ?\d+", None, "painted",
     lambda d, m: painter(d, m, suffix=".tga", Roughness=(m["rough"][::2],))),
    ("orm-with-metallic-in-green", "own", "channel-order", ORDER, None, "rust",
     lambda d, m: write(d, m, {"T_Robot_BC.png": "base", "T_Robot_N.png": "normaldx", "T_Robot_ORM.png": "ao|metal|rough"})),
    ("directx-named-gl", "own", "normal-orientation", FLIP, None, "wood", lambda d, m: write(
        d, m, {"rock_diff_2k.png": "base", "rock_rough_2k.png": "rough", "rock_nor_gl_2k.png": "normaldx", "rock_disp_2k.png": "height"})),
    # The map has a single grey value, although it is used as a texture. A number would do the same.
    ("roughness-of-one-value", "own", "constant-map", PACK, None, "wood", lambda d, m: painter(d, m, Metallic=None, Roughness="0.5")),
    ("bands-in-polished-chrome", "own", "banding", r"16|half|float|EXR|dither|bit", None, "chrome",
     lambda d, m: painter(d, m, "Chrome", Roughness=(bands(m),))),
    ("nan-in-exr", "own", "bad-values", r"nan|not a number|infin|finite|clamp|fix|replac|re-?bak|clean", None, "painted",
     lambda d, m: painter(d, m, suffix=".exr", Roughness=(not_finite(m),))),
    # The map was sharpened or filtered, and has negative values and values above 1.
    ("roughness-outside-0-to-1", "own", "bad-values", r"clamp|clip|range|0\.\.1|negativ|\b1\b", None, "wood", lambda d, m: painter(
        d, m, suffix=".exr", Metallic=None, Roughness=(.5 + .35 * (m["rough"] - m["rough"].mean()) / m["rough"].std(),))),
    ("occlusion-is-roughness", "own", "duplicate-map", r"duplicat|same|cop(y|ies)|wrong|remov|re-?bak|replac|re-?export", None, "painted",
     lambda d, m: painter(d, m, AO="rough")),
    ("black-factor-times-base-color", "own", "factor-zero", FACTOR, None, "wood", lambda d, m: asset(d, m, baseColorFactor=[0, 0, 0, 1])),
    ("normal-map-as-base-color", "own", "wrong-texture", SLOT, None, "painted",
     lambda d, m: asset(d, m, baseColorTexture={"file": "Robot_normal.png"})),
    ("specgloss-of-one-channel", "own", "specgloss-channels", FOUR, None, "painted", lambda d, m: spec_gloss(d, m, m["spec"].mean(-1))),
    ("specgloss-required-for-threejs", "own", "ignored-by-reader", DROP, "threejs", "rust",
     lambda d, m: spec_gloss(d, m, build(m, "spec+gloss"), required=True)),
    # Blender's IOR level .5 changes nothing, like specularFactor 1. If .5 is written as the factor, it halves the
    # reflection. The glTF is valid, so this is a weak case.
    ("ior-level-written-as-factor", "own", "ior", IOR, None, "plastic",
     lambda d, m: asset(d, m, extensions={"specular": {"specularFactor": .5}, "ior": {"ior": 1.5}})),
]

# ----------------------------------------------------------------------------------------------------------------- main


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--seed-offset", type=int, default=0)
    args = parser.parse_args()
    cases = []

    def add(kind, name, report, rules, fix, reader, make):
        folder = args.out / kind / name
        folder.mkdir(parents=True, exist_ok=True)
        path = f"{kind}/{name}" + (f"/{file}" if (file := make(folder)) else "")
        cases.append({"name": name, "report": report, "path": path, "for": reader, "rules": rules, "fix": fix})

    def seeded(kind, name):
        return material(kind, zlib.crc32(name.encode()) + args.seed_offset, args.size)

    for name, report, rules, fix, reader, kind, make in FAULTS:
        add("faults", name, report, rules.split(), fix, reader, lambda d: make(d, seeded(kind, name)))
    for h, (habit, make) in enumerate(HABITS.items()):
        for i, kind in enumerate(MATERIALS):
            name = f"{habit}_{kind}"
            kind = "chrome" if kind == "rust" and h % 3 == 0 else kind
            m = seeded(kind, name) | {"again": seeded(kind, name + " 2")}
            add("clean", name, "clean", [], "", None, lambda d: make(d, m, i))
    write_exrs()
    (args.out / "cases.json").write_text(json.dumps(cases, indent=1) + "\n")


if __name__ == "__main__":
    main()
