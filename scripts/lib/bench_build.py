"""Times a fresh build without ccache, each object of it, and two incremental builds. `scripts/bench build` runs it.
"""
import argparse
import collections
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = SOURCE / "build" / "bench-build"


def timed(*words):
    start = time.monotonic()
    environment = dict(os.environ, CCACHE_DISABLE="1")
    done = subprocess.run(words, cwd=SOURCE, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"bench build: {words[0]} failed:\n{done.stdout.decode()[-3000:]}")
    return round(time.monotonic() - start, 1)


def objects():
    """Returns the seconds of each compiled source and precompiled header, from the last run in ninja's log
    (milliseconds)."""
    found = {}
    for line in (BUILD / ".ninja_log").read_text().splitlines()[1:]:
        start, end, _, output, _ = line.split("\t")
        if output.endswith((".o", ".gch", ".pch")):
            parts = [part for part in output.split("/") if part != "CMakeFiles"]
            found["/".join(parts).replace(".dir/", ":")] = (int(end) - int(start)) / 1000
    return sorted(found.items(), key=lambda item: -item[1])


def changed_command(jobs):
    (SOURCE / "compiler" / "commands" / "list.cpp").touch()
    return timed("ninja", "-C", BUILD, f"-j{jobs}", "remapc")


def changed_fit():
    """Times how texremap runs fits as data: from reading a file to the first conversion."""
    fit = SOURCE / "fits" / "mitsuba_ward_to_mitsuba_as.json"
    return timed(BUILD / "bin" / "texremap", "convert", "--converters", fit, "--from", "mitsuba/ward", "--to", "mitsuba/as",
                 "--roughness", "0.3", "--specular", "0.5")


def measure(jobs):
    shutil.rmtree(BUILD, ignore_errors=True)
    times = {"configure": timed("cmake", "-S", SOURCE, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                                "-DCMAKE_CXX_COMPILER_LAUNCHER=")}
    times["remapc and texremap (what the demo needs)"] = timed("ninja", "-C", BUILD, f"-j{jobs}", "remapc", "texremap",
                                                               "scratched_metal", "convert_maps_by_header")
    times["everything else"] = timed("ninja", "-C", BUILD, f"-j{jobs}")
    compiled = objects()
    times["a changed command to a linked remapc"] = changed_command(jobs)
    times["a changed fit to a texremap that has it"] = changed_fit()
    folders = collections.Counter()
    for name, seconds in compiled:
        folders[name.split(":")[0] if ":" in name else name.rpartition("/")[0]] += seconds
    return {"seconds": times, "objects": dict(compiled), "folders": dict(folders.most_common())}


def main():
    parser = argparse.ArgumentParser(prog="scripts/bench build", description=__doc__)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    report = measure(arguments.jobs)
    if arguments.json:
        return print(json.dumps(report, indent=2))
    for title, key in (("Build", "seconds"), ("Targets: all objects", "folders"), ("Slowest objects", "objects")):
        rows = list(report[key].items())[:30]
        print(title + "\n" + "".join(f"  {seconds:8.1f} s  {name}\n" for name, seconds in rows))
    print(f"{len(report['objects'])} objects, {sum(report['objects'].values()):.0f} s")


main()
