#!/usr/bin/env python3
"""Runs the shell blocks of one page of documentation, in order, as one script in an empty folder.

  run_blocks.py PAGE FOLDER PROGRAM_FOLDER

A block fenced as `sh` must succeed. A block fenced as `sh no-test` or `console` is not run. The line above it must be
an HTML comment that gives the reason, as in <!-- not tested: needs a network -->. Every relative link of the page
must point to a file. FOLDER is emptied. It then has the repository's generated/, examples/, runtime/, compiler/,
scripts/ as links, and fits/ as a copy, so that nothing in the repository changes. The exit code is 0 if everything is
right, otherwise 1.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

FENCE = re.compile(r"^```(.*)$")
REASON = re.compile(r"^<!-- not tested: .+ -->$")
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)\s]*)?\)")


def fail(page, line, message):
    sys.exit(f"{page}:{line}: {message}")


def blocks_of(page):
    """Returns (first line, words of the fence, text) of each fenced block, and the lines outside of blocks."""
    blocks, outside, start = [], [], None
    lines = page.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines, 1):
        fence = FENCE.match(line)
        if fence and start is None:
            start, words, text = number, fence.group(1).split(), []
            above = lines[number - 2] if number > 1 else ""
        elif fence:
            blocks.append((start, words, "\n".join(text), above))
            start = None
        elif start is None:
            outside.append((number, line))
        else:
            text.append(line)
    if start is not None:
        fail(page, start, "the fence has no end (add a line of three backquotes)")
    return blocks, outside


def tested_blocks(page, blocks):
    tested = []
    for line, words, text, above in blocks:
        if words == ["sh"]:
            tested.append((line, text))
        elif words in (["sh", "no-test"], ["console"]):
            if not REASON.match(above):
                fail(page, line, "no reason above the block (write <!-- not tested: REASON -->)")
        elif words[:1] == ["sh"]:
            fail(page, line, f"unknown fence '{' '.join(words)}' (choose sh, or sh no-test)")
    return tested


def check_links(page, outside):
    for number, line in outside:
        for link in LINK.findall(line):
            if "://" not in link and not (page.parent / link).exists():
                fail(page, number, f"link to {link}: no such file")


def prepare(folder, repository):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name in ("generated", "examples", "runtime", "compiler", "scripts"):
        (folder / name).symlink_to(repository / name)
    shutil.copytree(repository / "fits", folder / "fits")


def main():
    page, folder, programs = (pathlib.Path(argument).absolute() for argument in sys.argv[1:4])
    repository = pathlib.Path(__file__).resolve().parents[2]
    blocks, outside = blocks_of(page)
    check_links(page, outside)
    tested = tested_blocks(page, blocks)
    if not tested:
        print(f"{page}: no block to run; links are good")
        return
    prepare(folder, repository)
    script = ["set -euo pipefail"]
    for line, text in tested:
        script += [f"echo '== {page.name}:{line}'", text]
    environment = dict(os.environ, PATH=f"{programs}{os.pathsep}{os.environ['PATH']}",
                       XDG_CACHE_HOME=str(folder / "cache"), LC_ALL="C.UTF-8")
    began = time.monotonic()
    status = subprocess.run(["bash", "-c", "\n".join(script)], cwd=folder, env=environment,
                            stdin=subprocess.DEVNULL).returncode
    print(f"{page.name}: {len(tested)} blocks, {time.monotonic() - began:.1f} s")
    if status != 0:
        sys.exit(f"{page}: the block named last above failed (exit code {status})")


if __name__ == "__main__":
    main()
