#!/usr/bin/env python3
"""Runs commands that must be refused and compares what a terminal then shows with the committed text.

Usage: tests/cli/errors.py [--record] [--programs FOLDER, default build/release/bin]
                           [FILE..., default tests/cli/errors/*.txt]

  # a remark
  > command      runs once, before all others, and makes more inputs
  $ command      must fail. The lines below it are what it prints, without empty lines, up to a remark, an
                 empty line or the next command. The exit code stands before the first line if it is not 1.

Each command runs in sh, in its own folder: a copy of tests/cli/inputs, with fits/ of the repository as a link named
shipped. It must not change, add or remove any file there. Empty folders are ignored. In the output, $PWD stands for
that folder, times are 0.00 s, and unfinished files have no number. --record writes the current output into the files.
"""
import argparse
import concurrent.futures
import difflib
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
INPUTS, CASES = ROOT / "tests/cli/inputs", ROOT / "tests/cli/errors"
SECONDS = 120


def run_shell(command, folder, programs):
    """Returns the exit code, and the output followed by the errors. Both go to files, because `ulimit -f` limits only
    files."""
    environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}", LC_ALL="C", PWD=str(folder))
    with tempfile.TemporaryFile() as output, tempfile.TemporaryFile() as errors:
        run = subprocess.run(["/bin/sh", "-c", command], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                             stdout=output, stderr=errors, timeout=SECONDS)
        for stream in (output, errors):
            stream.seek(0)
        return run.returncode, (output.read() + errors.read()).decode(errors="replace")


def copy(folder, to):
    subprocess.run(["cp", "-a", f"{folder}/.", to], check=True)  # copies pipes and links, which are inputs, too


def contents(folder):
    """Maps each path to the content of its file, or to None for a link or a pipe."""
    paths = [Path(place) / name for place, folders, names in os.walk(folder) for name in names + folders]
    return {p.relative_to(folder): p.read_bytes() if p.is_file() and not p.is_symlink() else None
            for p in paths if p.is_symlink() or not p.is_dir()}


def parse(text):
    """Returns the parts of a file in order: lines of text unchanged, and [command, lines shown] for each command."""
    parts, case = [], None
    for line in text.splitlines():
        if line.startswith("$ "):
            case = [line[2:], []]
            parts.append(case)
        elif not line or line[:2] in ("# ", "> "):
            case = None
            parts.append(line)
        elif case:
            case[1].append(line)
        else:
            sys.exit(f"{line}: neither a remark nor below a command")
    return parts


def unparsed(parts):
    lines = []
    for part in parts:
        lines += [part] if isinstance(part, str) else [f"$ {part[0]}", *part[1]]
    return "\n".join(lines) + "\n"


def shown(command, inputs, programs):
    """Returns the lines that a terminal shows after the command, and a list of what else is wrong."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        copy(inputs, folder)
        before = contents(folder)
        code, text = run_shell(command, folder, programs)
        after = contents(folder)
    text = text.replace(str(folder), "$PWD")
    text = re.sub(r"\b\d+\.\d\d? s\b", "0.00 s", text)
    text = re.sub(r"unfinished-[\da-f]+-\d+", "unfinished", text)
    lines = [line for line in text.splitlines() if line.strip()] or ["(nothing)"]
    if code != 1:
        lines[0] = f"{code} {lines[0]}"
    faults = ["was not refused"] if code == 0 else ["did not end by itself"] if not 0 < code < 126 else []
    faults += [f"left {path}" for path in sorted(after.keys() - before.keys())]
    faults += [f"changed {path}" for path in sorted(before) if after.get(path, "gone") != before[path]]
    return lines, faults


def check(path, programs, record):
    """Runs the cases of a file. Returns the number of cases and the number of differing cases."""
    parts = parse(path.read_text())
    cases = [part for part in parts if not isinstance(part, str)]
    failed = 0
    with tempfile.TemporaryDirectory() as inputs, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        copy(INPUTS, inputs)
        (Path(inputs) / "shipped").symlink_to(ROOT / "fits")
        for part in parts:
            if isinstance(part, str) and part.startswith("> "):
                code, text = run_shell(part[2:], Path(inputs), programs)
                if code != 0:
                    sys.exit(f"{path}: {part}: exit code {code}: {text}")
        results = pool.map(lambda case: shown(case[0], inputs, programs), cases)
        for case, (lines, faults) in zip(cases, results):
            if record and not faults:
                case[1] = lines
            elif lines != case[1]:
                faults += difflib.unified_diff(case[1], lines, "committed", "today", lineterm="", n=0)
            if faults:
                failed += 1
                print(f"{path.name}: $ {case[0]}", *faults, sep="\n  ", flush=True)
    if record:
        path.write_text(unparsed(parts))
    return len(cases), failed


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--record", action="store_true")
    arguments.add_argument("--programs", type=Path, default=ROOT / "build/release/bin")
    arguments.add_argument("files", type=Path, nargs="*", default=sorted(CASES.glob("*.txt")))
    given = arguments.parse_args()
    counts = [check(path, given.programs.resolve(), given.record) for path in given.files]
    count, failed = (sum(numbers) for numbers in zip(*counts))
    remedy = " (if the new texts are right: tests/cli/errors.py --record)" if failed else ""
    print(f"{count} refusals, {failed} not as committed{remedy}")
    sys.exit(1 if failed or not count else 0)


main()
