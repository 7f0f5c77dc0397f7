"""Runs fuzz targets on their committed inputs, and prints how many lines of the code under test they reach; see
scripts/fuzz.

Usage: fuzz_coverage.py NAME..., in the root of the repository, after a build of the preset `coverage`
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

BUILD = Path("build/coverage")
GOAL = 85.0  # per cent of the lines of all files under test


def readers():
    """Returns the files of each target, as in tests/fuzz/readers.txt. An indented line continues the target before
    it."""
    files = {}
    for line in Path("tests/fuzz/readers.txt").read_text().splitlines():
        if line.startswith("#"):
            continue
        name, _, own = line.partition(":")
        if line.startswith(" "):
            name, own = list(files)[-1], line
        files.setdefault(name, []).extend(own.split())
    return files


def inputs_of(name):
    """Returns the committed inputs, so that everybody measures the same."""
    return sorted((Path("tests/fuzz/corpus") / name).iterdir())


def run(name, inputs, folder):
    """Runs the target on inputs. If an input ends the target, runs each input separately, because a failing run loses
    its profile. Returns the failing inputs."""
    program, profile = BUILD / "bin" / f"{name}_fuzz", folder / f"{name}-%m.profraw"
    environment = dict(os.environ, LLVM_PROFILE_FILE=str(profile))
    options = [f"{program}", "-timeout=60", "-rss_limit_mb=4096", f"-artifact_prefix={folder}/"]
    if subprocess.run(options + inputs, env=environment, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL).returncode == 0:
        return []
    if len(inputs) == 1:
        return inputs
    half = len(inputs) // 2
    return run(name, inputs[:half], folder) + run(name, inputs[half:], folder)


def lines_of(files, programs, profile):
    """Returns how many lines of the source files were run, and how many there are."""
    objects = [word for program in programs[1:] for word in ("-object", program)]
    report = subprocess.run(["llvm-cov", "export", "-summary-only", "-instr-profile", profile, programs[0], *objects,
                             *(str(Path(file).resolve()) for file in files)], check=True, capture_output=True)
    found = [file["summary"]["lines"] for file in json.loads(report.stdout)["data"][0]["files"]]
    return sum(lines["covered"] for lines in found), sum(lines["count"] for lines in found)


def main(names):
    files = readers()
    for name in names:
        if name not in files:
            sys.exit(f"fuzz: {name}: no readers of this target are known (add a line to tests/fuzz/readers.txt)")
    module = next(BUILD.rglob("images.so"), None)
    modules = [str(module)] if module else []
    print(f"{'target':<12}{'inputs':>8}{'lines':>8}{'run':>8}")
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        lost = 0
        for name in names:
            inputs = inputs_of(name)
            ended = run(name, [str(path) for path in inputs], folder)
            lost += len(ended)
            profiles = sorted(str(path) for path in folder.glob(f"{name}-*.profraw"))
            profile = str(folder / f"{name}.profdata")
            subprocess.run(["llvm-profdata", "merge", "-sparse", "-o", profile, *profiles], check=True)
            covered, count = lines_of(files[name], [str(BUILD / "bin" / f"{name}_fuzz"), *modules], profile)
            print(f"{name:<12}{len(inputs):>8}{count:>8}{100 * covered / max(count, 1):>7.1f} %")
            for path in ended:
                print(f"  {path} ended the target: its lines are not counted")
        total = str(folder / "all.profdata")
        subprocess.run(["llvm-profdata", "merge", "-sparse", "-o", total, *sorted(map(str, folder.glob("*.profdata")))], check=True)
        covered, count = lines_of([file for name in names for file in files[name]],
                                  [*(str(BUILD / "bin" / f"{name}_fuzz") for name in names), *modules], total)
    share = 100 * covered / max(count, 1)
    print(f"{'all readers':<20}{count:>8}{share:>7.1f} %  (the goal is {GOAL:.0f} %)")
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
