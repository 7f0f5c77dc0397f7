#!/usr/bin/env python3
"""Measures the speed of the Python package: python_speed.py MAP_SPEED [SIDE].

It prints the speed as a fraction of one core of the C++ library. MAP_SPEED is the program of the library
(tests/bits/map_speed.cpp), which converts 2048 x 2048 floats. Both convert the same maps and must give the same bits.
For maps of SIDE x SIDE (default 4096), it also compares with NumPy, which evaluates the same polynomials on one
thread. Times are processor times of the fastest of several passes.
"""

import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import texremap

CONVERTERS = Path(__file__).resolve().parents[2] / "generated/converters.json"
PASSES = 5


def values(count):
    """Returns the Weyl sequence of 24 bits that MAP_SPEED uses."""
    return ((np.arange(count, dtype=np.uint32) * np.uint32(0x9E3779B1)) >> 8).astype(np.float32) * np.float32(2**-24)


def checksum(arrays):
    total = 0
    for array in arrays:
        bits = np.ascontiguousarray(array).view(np.uint32).ravel()
        for block in np.split(bits, range(1 << 16, bits.size, 1 << 16)):
            powers = np.ones(block.size, np.uint32)
            powers[1:] = 31
            powers = np.multiply.accumulate(powers)
            part = int((block * powers[::-1]).sum(dtype=np.uint32))
            total = (total * pow(31, block.size, 1 << 32) + part) % (1 << 32)
    return f"{total:08x}"


def fastest(work):
    best = float("inf")
    for _ in range(PASSES):
        start = time.process_time()
        work()
        best = min(best, time.process_time() - start)
    return best


def maps(side):
    return values(side * side).reshape(side, side), values(3 * side * side).reshape(side, side, 3)


def polynomial(form, alpha, specular):
    """Evaluates sums of c[j][i] (alpha - start)^i (specular - middle)^j by Horner's rule over whole arrays, in place.
    """
    x, y = alpha - np.float32(form["start"]), specular - np.float32(form["middle"])
    total = np.zeros_like(specular)
    row = np.empty_like(alpha)
    for coefficients in reversed(form["coefficients"]):
        row.fill(np.float32(coefficients[-1]))
        for c in reversed(coefficients[:-1]):
            np.multiply(row, x, out=row)
            np.add(row, np.float32(c), out=row)
        np.multiply(total, y, out=total)
        np.add(total, row, out=total)
    return total


def by_numpy(form, roughness, specular):
    out = np.empty_like(specular)
    for c in range(3):
        out[..., c] = np.maximum(polynomial(form["specular"], roughness, np.ascontiguousarray(specular[..., c])), 0)
    return polynomial(form["alpha"], roughness, specular.max(axis=-1)), out


def against_numpy(side):
    converters = json.loads(CONVERTERS.read_text())["converters"]
    form = next(entry for entry in converters if entry["id"] == "mitsuba_ward_to_mitsuba_as")
    roughness, specular = maps(side)
    roughness = np.clip(roughness, 0.01, 1)
    converter = texremap.Converter("mitsuba/ward", "mitsuba/as")
    out = {"roughness": np.empty_like(roughness), "specular": np.empty_like(specular)}
    planes = np.moveaxis(np.ascontiguousarray(np.moveaxis(specular, -1, 0)), 0, -1)
    planar_out = {"roughness": out["roughness"], "specular": np.moveaxis(np.empty((3, side, side), np.float32), 0, -1)}
    seconds = {
        "interleaved": fastest(lambda: converter.convert(roughness=roughness, specular=specular, out=out)),
        "planar": fastest(lambda: converter.convert(roughness=roughness, specular=planes, out=planar_out)),
    }
    start = time.process_time()
    alpha, f0 = by_numpy(form, roughness, specular)
    numpy_seconds = time.process_time() - start
    difference = max(np.abs(alpha - out["roughness"]).max(), np.abs(f0 - out["specular"]).max())
    print(f"NumPy {np.__version__}: {side * side / numpy_seconds / 1e6:.1f} Mtexel/s, the same values within {difference:.1e}")
    for name, own in seconds.items():
        print(f"texremap, {name} RGB: {side * side / own / 1e6:.1f} Mtexel/s, {numpy_seconds / own:.1f} times as fast")
    return difference < 1e-5


def against_cpp(program):
    roughness, specular = maps(2048)
    is_equal = True
    print(f"{'converter':<42} {'C++':>6} {'Python':>6} {'ratio':>6} (Mtexel/s)")
    for line in subprocess.run([program], capture_output=True, text=True, check=True).stdout.splitlines():
        source, target, speed, expected = line.split()
        converter = texremap.Converter(source, target)
        out = {"roughness": np.empty_like(roughness), "specular": np.empty_like(specular)}
        seconds = fastest(lambda: converter.convert(roughness=roughness, specular=specular, out=out))
        is_same = checksum([out["roughness"], out["specular"]]) == expected
        is_equal = is_equal and is_same
        own = roughness.size / seconds / 1e6
        print(f"{source + ' to ' + target:<42} {float(speed):6.1f} {own:6.1f} {own / float(speed):6.2f}"
              + ("" if is_same else " OTHER BITS"))
    return is_equal


if __name__ == "__main__":
    is_good = against_cpp(sys.argv[1])
    sys.exit(0 if against_numpy(int(sys.argv[2]) if len(sys.argv) > 2 else 4096) and is_good else 1)
