"""Compiles the C and C++ code that the pages offer, inside small programs, and compares the output with what the
pages state."""
import concurrent.futures
import pathlib
import re
import shlex
import subprocess
import tempfile

from offers.pages import PAGES, SHORT_FORMS, examples

PROGRAMS = pathlib.Path(__file__).parent / "lines"
FLAGS = ["-Wall", "-Wextra", "-Werror"]
# Each case has the page, the program, the required header (and its package), libraries, and the values that the
# program must print.
CASES = [("assimp.md", "assimp.cpp", "assimp/scene.h", "libassimp-dev", ["-lassimp"], slice(0, 3)),
         ("assimp.md", "assimp_fbx.cpp", "assimp/material.h", "libassimp-dev", ["-lassimp"], slice(3, 6)),
         ("blender-obj.md", "blender-obj.cpp", None, None, [], slice(0, 4)),
         ("ifcopenshell.md", "ifcopenshell.cpp", "nlohmann/json.hpp", "nlohmann-json3-dev", [], slice(0, 3)),
         ("ufbx.md", "ufbx.c", None, None, ["-lm"], slice(0, 3))]
MATERIAL = "newmtl paint\nNs 96.08\nKs 0.5 0.5 0.5\nKd 0.64 0.64 0.64\n"
OBJECT = "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n"


def blocks_of(page):
    return re.findall(r"```c(?:pp)?\n(.*?)```", (PAGES / page).read_text(), re.DOTALL)


def with_lines(program, blocks):
    """Returns the program with a code block instead of each comment `lines NUMBER`, which formatting keeps."""
    return re.sub(r"(?m)^ *(?:// lines (\d)|/\* lines (\d) \*/)$", lambda match: blocks[int(match[1] or match[2])], program)


def check(case, compiler, folder):
    """Returns what is wrong, and what is missing."""
    page, name, header, package, libraries, wanted = case
    language = ["-x", "c", "-std=c99"] if name.endswith(".c") else ["-x", "c++", "-std=c++17"]
    if header is not None:
        probe = subprocess.run([*compiler, *language, "-E", "-", "-o", "/dev/null"], input=f"#include <{header}>\n", text=True,
                               capture_output=True)
        if probe.returncode != 0:
            return [], [f"{name}: {header} is not installed (Debian: {package})"]
    source, program = folder / name, folder / (name + ".program")
    source.write_text(with_lines((PROGRAMS / name).read_text(), blocks_of(page)))
    built = subprocess.run([*compiler, *language, *FLAGS, str(source), "-x", "none", "-o", str(program), *libraries], text=True,
                           capture_output=True)
    if built.returncode != 0:
        return [f"docs/adopting/{page}: the lines do not compile in {name}:\n{built.stderr[:2000]}"], []
    ran = subprocess.run([program, folder / "paint.obj"], text=True, capture_output=True)
    if ran.returncode != 0:
        return [f"docs/adopting/{page}: {name} ends with {ran.returncode}"], []
    stated = examples(SHORT_FORMS)[page][wanted]
    return [f"docs/adopting/{page}: {name} prints '{ran.stdout.strip()}', without the {value} of the page"
            for value in stated if value not in ran.stdout.split()], []


def check_lines(compiler, pages):
    """Returns 1 if something is wrong, 77 if only a package is missing, otherwise 0."""
    cases = [case for case in CASES if case[0] in pages] if pages else CASES
    if not cases:
        print(f"{' '.join(pages)}: no such page with lines in C or C++")
        return 1
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor() as pool:
        folder = pathlib.Path(folder)
        (folder / "paint.mtl").write_text(MATERIAL)
        (folder / "paint.obj").write_text(OBJECT)
        results = list(pool.map(lambda case: check(case, shlex.split(compiler), folder), cases))
    wrong, missing = ([text for result in results for text in result[i]] for i in (0, 1))
    for text in wrong:
        print(text)
    for text in missing:
        print(f"skipped: {text}")
    print(f"{len(cases) - len(missing)} of {len(cases)} programs compiled")
    return 1 if wrong else 77 if missing else 0
