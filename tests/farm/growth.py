#!/usr/bin/env python3
"""Measures how a conversion scales: the figures of docs/farm.md, and of large assets.

Prints time and memory of the index of a tree of sets and of a tree of assets, what a part costs besides its sets, how
many files a set opens and renames (if strace is installed), sets per second against the number of simultaneous parts,
and what one large set needs. With --assets, it prints processor time and memory for an OBJ file of 150 MB instead.

Usage: tests/farm/growth.py TEXREMAP [--sets 100000] [--small 512] [--assets]
"""
import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import zlib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

CONVERSION = ["--from", "mitsuba/ward", "--to", "mitsuba/ggx"]


def png(width, height, channels, seed):
    """Returns a PNG of 8 bits with smooth noise."""
    rows = b"".join(
        b"\0" + bytes((seed * 31 + x * 7 + y * 13 + c * 50) % 200 + 20 for x in range(width) for c in range(channels))
        for y in range(height))

    def chunk(name, data):
        return len(data).to_bytes(4, "big") + name + data + zlib.crc32(name + data).to_bytes(4, "big")

    head = width.to_bytes(4, "big") + height.to_bytes(4, "big") + bytes([8, 2 if channels == 3 else 0, 0, 0, 0])
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def make_tree(root, sets, size):
    """Writes sets of three maps, 100 per folder. Files are links to a few images, so that 300,000 are made in
    seconds."""
    root.mkdir(parents=True)
    images = []
    for seed in range(4):
        maps = {}
        for word, channels in (("Roughness", 1), ("Specular", 3), ("Normal", 3)):
            maps[word] = root.parent / f"image{seed}_{word}.png"
            maps[word].write_bytes(png(size, size, channels, seed))
        images.append(maps)
    for i in range(sets):
        folder = root / f"library{i // 10000:03}" / f"folder{i // 100 % 100:03}"
        if i % 100 == 0:
            folder.mkdir(parents=True)
        for word, image in images[i % 4].items():
            target = folder / f"asset{i:06}_{word}.png"
            try:
                os.link(image, target)
            except OSError:  # one file has as many links as possible
                shutil.copy(image, target)


def make_assets(root, assets):
    """Writes glTF files with five materials and a buffer, 100 per folder, without images."""
    materials = [{"name": f"m{i}", "extensions": {"KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0.1 * i, 0.3, 0.5, 1], "specularFactor": [0.04, 0.04, 0.04], "glossinessFactor": 0.5}}}
        for i in range(5)]
    text = json.dumps({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_pbrSpecularGlossiness"],
                       "materials": materials, "buffers": [{"uri": "b.bin", "byteLength": 16}]})
    for i in range(assets):
        folder = root / f"library{i // 10000:03}" / f"folder{i // 100 % 100:03}"
        if i % 100 == 0:
            folder.mkdir(parents=True)
            (folder / "b.bin").write_bytes(bytes(16))
        (folder / f"asset{i:06}.gltf").write_text(text)


def make_large_set(root):
    """Writes a set of 4096 x 4096 half floats with smooth noise, in EXR with ZIP."""
    root.mkdir()
    for word, channels, seed in (("Roughness", 1, 1), ("Specular", 3, 2)):
        subprocess.run(["oiiotool", "--pattern", f"noise:type=uniform:min=0.1:max=0.9:seed={seed}", "1024x1024", str(channels),
                        "--resize", "4096x4096", "-d", "half", "--compression", "zip", "-o", root / f"rock_{word}.exr"], check=True)


def make_obj(path, side):
    """Writes a wavy grid of side x side vertices, with normals and texture coordinates, as triangles."""
    with open(path, "w", encoding="ascii") as file:
        for y in range(side):
            for x in range(side):
                file.write(f"v {x * 0.001:.6f} {y * 0.001:.6f} {x * y % 97 * 0.0001:.6f}\nvn {x % 7 * 0.01:.6f} {y % 5 * 0.01:.6f} 0.990000\n"
                           f"vt {x / side:.6f} {y / side:.6f}\n")
        for y in range(side - 1):
            for x in range(side - 1):
                a = y * side + x + 1
                b, c, d = a + 1, a + side, a + side + 1
                file.write(f"f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}\nf {b}/{b}/{b} {d}/{d}/{d} {c}/{c}/{c}\n")


def bytes_in(folder):
    return sum(path.stat().st_size for path in folder.rglob("*.exr"))


def run(*words):
    """Returns the seconds of a command, the resources that it used, and what it prints."""
    begin = time.monotonic()
    process = subprocess.Popen([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"growth: failed: {' '.join(map(str, words))}")
    return time.monotonic() - begin, usage, output


def measured(*words):
    """Returns the seconds and the peak memory of a command, and what it prints."""
    seconds, usage, output = run(*words)
    return seconds, usage.ru_maxrss / 1000, output


def system_calls(texremap, manifest, output, sets):
    """Returns how many files of the tree are opened and renamed per set."""
    if shutil.which("strace") is None:
        return "strace is not installed"
    log = output.parent / "strace.txt"
    subprocess.run(["strace", "-f", "-e", "trace=openat,rename,renameat,renameat2,fsync,fdatasync", "-o", log, texremap, "convert",
                    "--manifest", manifest, *CONVERSION, "-o", output, "--threads", "1", "--quiet"], check=True)
    text = log.read_text()
    inputs = len(re.findall(r'openat\([^)]*/tree/[^"]*\.png', text))
    outputs = len(re.findall(r'openat\([^)]*/traced/[^"]*\.png', text))
    renames, syncs = len(re.findall(r"rename\w*\(", text)), len(re.findall(r"f(?:data)?sync\(", text))
    return (f"opens of inputs {inputs / sets:.1f}, of results {outputs / sets:.1f}, renames {renames / sets:.1f}, "
            f"waits for the disk {syncs / sets:.1f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("texremap")
    parser.add_argument("--sets", type=int, default=100_000, help="of the tree that is indexed")
    parser.add_argument("--small", type=int, default=512, help="sets that are converted")
    parser.add_argument("--assets", action="store_true", help="large assets instead")
    options = parser.parse_args()
    scratch = Path(tempfile.mkdtemp(prefix="remap-growth-"))
    try:
        if options.assets:
            report_assets(Path(options.texremap).resolve(), scratch)
        else:
            report(Path(options.texremap).resolve(), scratch, options)
    finally:
        shutil.rmtree(scratch)


def report_assets(texremap, scratch):
    def convert(name, file, result):
        _, usage, _ = run(texremap, "convert", file, "--to", "gltf", "-o", scratch / "result" / result, "--threads", "1", "--quiet",
                          "--force")
        print(f"{name}: {usage.ru_utime + usage.ru_stime:.2f} s of processor, {usage.ru_maxrss / 1000:.0f} MB")

    make_obj(scratch / "grid.obj", 850)
    convert("an OBJ file of 150 MB to .glb", scratch / "grid.obj", "grid.glb")
    convert("an OBJ file of 150 MB to .gltf", scratch / "grid.obj", "grid.gltf")


def report(texremap, scratch, options):
    tree = scratch / "large/tree"
    make_tree(tree, options.sets, 16)
    manifest = scratch / "large.jsonl"
    seconds, memory, _ = measured(texremap, "index", tree, "-o", manifest, "--quiet")
    print(f"index of {options.sets} sets, {3 * options.sets} files: {seconds:.1f} s, {memory:.0f} MB, "
          f"{manifest.stat().st_size / 1e6:.0f} MB on disk")
    # A part without sets only reads the manifest and its converter, and writes its report.
    part = f"1/{50 * options.sets}"
    seconds, memory, _ = measured(texremap, "convert", "--manifest", manifest, "--part", part, *CONVERSION, "-o",
                                  scratch / "empty", "--quiet")
    print(f"a part without sets of {options.sets}: {seconds:.2f} s, {memory:.0f} MB")
    shutil.rmtree(scratch / "large")
    make_assets(scratch / "assets", options.sets)
    manifest = scratch / "assets.jsonl"
    seconds, memory, _ = measured(texremap, "index", scratch / "assets", "--assets", "-o", manifest, "--quiet")
    print(f"index of {options.sets} glTF files, each with a buffer: {seconds:.1f} s, {memory:.0f} MB, "
          f"{manifest.stat().st_size / 1e6:.0f} MB on disk")
    begin = time.monotonic()
    measured(texremap, "convert", "--manifest", manifest, "--part", "1/20", "--to", "gltf", "-o", scratch / "converted",
             "--threads", "1", "--quiet")
    print(f"glTF files of five factor materials, one thread: {options.sets / 20 / (time.monotonic() - begin):.0f} a second")
    shutil.rmtree(scratch / "assets")

    tree, manifest, sets = scratch / "small/tree", scratch / "small.jsonl", options.small
    make_tree(tree, sets, 64)
    measured(texremap, "index", tree, "-o", manifest, "--quiet")
    seconds, _, _ = measured(texremap, "convert", "--manifest", manifest, "--part", f"1/{50 * sets}", *CONVERSION, "-o",
                             scratch / "empty2", "--quiet")
    print(f"a part without sets of {sets}: {seconds:.2f} s")
    print("a set of two maps:", system_calls(texremap, manifest, scratch / "traced", sets))
    for count in (1, 2, 4):
        output = scratch / f"parts{count}"

        def convert(i):
            return measured(texremap, "convert", "--manifest", manifest, "--part", f"{i + 1}/{count}", *CONVERSION, "-o", output,
                            "--threads", "1", "--quiet")

        begin = time.monotonic()
        with ThreadPoolExecutor(count) as pool:
            list(pool.map(convert, range(count)))
        seconds = time.monotonic() - begin
        merged = measured(texremap, "merge-reports", output, "--json", "--quiet")[2].splitlines()[-1]
        assert json.loads(merged)["summary"]["converted"] == sets
        print(f"{count} parts at once, a thread each: {sets / seconds:.0f} sets a second")
    if shutil.which("oiiotool") is None:
        return
    make_large_set(scratch / "rock")
    seconds, memory, output = measured(texremap, "convert", scratch / "rock", *CONVERSION, "-o", scratch / "rock2", "--threads", "1",
                                       "--json", "--quiet")
    processor = json.loads(output.splitlines()[-1])["summary"]["processor_seconds"]
    print(f"a set of 4096 x 4096 halfs, {bytes_in(scratch / 'rock') / 1e6:.0f} MB in, {bytes_in(scratch / 'rock2') / 1e6:.0f} MB out, "
          f"one thread: {seconds:.1f} s, {processor:.1f} s of processor, {memory:.0f} MB")


if __name__ == "__main__":
    main()
