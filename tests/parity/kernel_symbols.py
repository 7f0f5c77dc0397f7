#!/usr/bin/env python3
"""Checks that the objects of kernels define no function that a linker could confuse with a function of another file.

  kernel_symbols.py NM OBJECT...

Objects that are compiled for wider instruction sets must keep their functions to themselves. The reason is that a
linker keeps only one copy of an inline function, which every processor then runs.
"""
import subprocess
import sys

nm, *objects = sys.argv[1:]
kernels = [path for path in objects if "/kernels_" in path]
if not kernels:
    sys.exit("kernel_symbols: no object of kernels among " + ", ".join(objects))
shared = []
for path in kernels:
    for line in subprocess.run([nm, "-C", path], check=True, capture_output=True, text=True).stdout.splitlines():
        kind, name = line[17:].split(" ", 1)
        # T is a function that other files call. W and u are functions that other files may define, too. Sanitizers
        # add their own functions.
        if kind in "TWu" and ("remap::" in name or "std::" in name):
            shared.append(f"{path}: {kind} {name}")
if shared:
    sys.exit("functions that are not internal:\n  " + "\n  ".join(shared))
print(f"{len(kernels)} objects of kernels share no function")
