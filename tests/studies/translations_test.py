#!/usr/bin/env python3
"""Tests scripts/studies/translations: three materials per direction against fixed bounds, what it refuses, and its
page in a browser.

It runs with the Python of the renderer (scripts/renderers materialx-1.39.5), or with this Python if it has MaterialX.
"""
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("XDG_DATA_HOME") or "~/.local/share").expanduser()
OWN = Path(os.environ.get("REMAP_RENDERERS") or DATA / "remap/renderers") / "materialx-1.39.5/bin/python"
PYTHON = next((str(one) for one in (OWN,) if one.exists()), sys.executable)
MODULE = Path(os.environ.get("REMAP_TRANSLATIONS") or ROOT / "generated/materials/materials.py")
GRAPHS = MODULE.parents[1] / "materialx/remap_translation.mtlx"
SEED = 5  # a seed that development may use
# These bound the mean error of three materials. They are about 1.5 times the errors that the translations had when
# the bound was set.
BOUNDS = {"UsdPreviewSurface:open_pbr_surface": 0.05, "principled:open_pbr_surface": 0.1, "standard_surface:open_pbr_surface": 0.03,
          "gltf_pbr:open_pbr_surface": 0.02, "open_pbr_surface:UsdPreviewSurface": 0.35,
          "open_pbr_surface:UsdPreviewSurface_specular": 0.18, "open_pbr_surface:gltf_pbr": 0.12,
          "open_pbr_surface:standard_surface": 0.04}
CHROMIUM = next((one for one in ("chromium-headless-shell", "chromium") if shutil.which(one)), None)


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


if PYTHON == sys.executable and not all(map(importlib.util.find_spec, ("MaterialX", "moderngl", "numpy"))):
    skip("MaterialX is not installed (scripts/renderers materialx-1.39.5)")


def run(*words):
    return subprocess.run([PYTHON, str(ROOT / "scripts/studies/translations"), *map(str, words)], capture_output=True, text=True)


class Translations(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def refused(self, message, *words):
        got = run(*words)
        self.assertEqual((got.returncode, got.stdout), (2, ""), got.stderr)
        self.assertIn(message, got.stderr.splitlines()[-1])
        self.assertNotIn("Traceback", got.stderr)

    def document(self, text):
        path = self.folder / "material.mtlx"
        path.write_text(text)
        return path

    def test_bounds(self):
        if not MODULE.exists():
            self.skipTest(f"{MODULE} does not exist")
        got = run("judge", "--materials", 3, "--seed", SEED, "--documents", "none", "--json", "--translations", MODULE)
        self.assertEqual(got.returncode, 0, got.stderr)
        for row in json.loads(got.stdout)["directions"]:
            direction = f"{row['from']}:{row['to']}"
            with self.subTest(direction):
                self.assertLess(row["ours"]["mean"], BOUNDS[direction])
                self.assertLess(row["ours"]["mean"], row["in use"]["mean"])

    def test_graphs_are_the_module(self):
        """Checks that the node graphs, evaluated in shaders, give the errors of the Python module."""
        if not MODULE.exists() or not GRAPHS.exists():
            self.skipTest(f"{GRAPHS} or {MODULE} does not exist")
        found = []
        for file in (MODULE, GRAPHS):
            got = run("judge", "--materials", 2, "--seed", SEED, "--documents", "none", "--json", "--translations", file)
            self.assertEqual(got.returncode, 0, got.stderr)
            found.append({(row["from"], row["to"]): row["ours"] for row in json.loads(got.stdout)["directions"] if "ours" in row})
        self.assertGreaterEqual(len(found[1]), 6)
        for direction, ours in found[1].items():
            self.assertAlmostEqual(ours["worst"], found[0][direction]["worst"], delta=1e-3, msg=direction)

    def test_same_seed_gives_the_same_errors(self):
        words = ("judge", "--materials", 1, "--seed", SEED, "--documents", "none", "--json", "--directions", "gltf_pbr:open_pbr_surface")
        self.assertEqual(run(*words).stdout, run(*words).stdout)

    def test_refusals(self):
        self.refused("is not a direction", "judge", "--directions", "open_pbr_surface:paint")
        self.refused("no such file", "judge", "--documents", self.folder / "missing.mtlx")
        self.refused("no such file", "judge", "--translations", self.folder / "missing.py")
        self.refused("has no files *.mtlx", "judge", "--documents", self.folder)
        self.refused("not an integer", "judge", "--seed", "-1")
        self.refused("cannot be read", "judge", "--documents", self.document("<materialx"))
        self.refused("is not valid", "judge", "--documents", self.document(
            '<?xml version="1.0"?><materialx version="1.39"><gltf_pbr name="a" type="surfaceshader">'
            '<input name="roughness" type="color3" value="1, 1, 1"/></gltf_pbr>'
            '<surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="a"/></surfacematerial>'
            '</materialx>'))
        broken = self.folder / "broken.py"
        broken.write_text("TRANSLATIONS = {}\n1 / 0\n")
        self.refused("is not a module of translations", "judge", "--translations", broken)
        broken.write_text("nan = lambda values: {'base_color': (float('nan'),) * 3}\n"
                          "TRANSLATIONS = {('gltf_pbr', 'open_pbr_surface'): nan}\n")
        self.refused("base_color = [nan, nan, nan]", "judge", "--translations", broken, "--json", "--materials", 1, "--documents", "none",
                     "--directions", "gltf_pbr:open_pbr_surface")

    def test_files_of_pictures(self):
        """Checks that a PNG file has the pixels that were written, by undoing its filters. The pictures of the page
        are small."""
        code = ("import sys; sys.path[:0] = ['compiler/adapters', 'scripts/studies']\n"
                "import numpy\nfrom whole_materials import site\n"
                "pixels = numpy.random.default_rng(1).integers(0, 256, (9, 7, 4)).astype(numpy.uint8)\n"
                "pixels[3:, :, 1] = numpy.arange(7) * 9\npixels[5:] = pixels[4]\n"
                "print(pixels.tobytes().hex(), site.png(pixels).hex())")
        got = subprocess.run([PYTHON, "-c", code], capture_output=True, text=True, cwd=ROOT)
        self.assertEqual(got.returncode, 0, got.stderr)
        written, file = map(bytes.fromhex, got.stdout.split())
        start = file.index(b"IDAT")
        data = zlib.decompress(file[start + 4:start + 4 + int.from_bytes(file[start - 4:start], "big")])
        above, kinds = bytes(28), set()
        for row in range(9):
            kind, *line = data[29 * row:29 * row + 29]
            kinds.add(kind)
            for i in range(28):
                left, corner = (line[i - 4], above[i - 4]) if i >= 4 else (0, 0)
                guess = left + above[i] - corner
                paeth = min((left, above[i], corner), key=lambda one: abs(guess - one))
                line[i] = (line[i] + {0: 0, 1: left, 2: above[i], 4: paeth}[kind]) % 256
            self.assertEqual(bytes(line), written[28 * row:28 * row + 28])
            above = line
        self.assertGreater(len(kinds), 1)
        page = (ROOT / "docs/materials.md").read_text()
        pictures = list((ROOT / "docs/materials").glob("*.png"))
        self.assertEqual(len(pictures), 6)
        for picture in pictures:
            self.assertIn(f"(materials/{picture.name})", page)
            self.assertLess(picture.stat().st_size, 60_000, picture)

    def test_changed_graphs(self):
        """Checks that the lists of nodes on the pages make valid graphs, which the judge accepts instead of the
        official ones."""
        got = run("offers", "--graphs", self.folder / "changed")
        self.assertEqual(got.returncode, 0, got.stderr)
        files = sorted((self.folder / "changed").iterdir())
        self.assertEqual(len(files), 6)
        for file in files:
            self.assertNotIn("include", file.read_text(), file)
        got = run("judge", "--materials", 1, "--seed", SEED, "--documents", "none", "--json", "--directions",
                  "open_pbr_surface:standard_surface", "--translations", files[1])
        self.assertEqual(got.returncode, 0, got.stderr)
        self.refused("is not a page of an offer", "offers", "paint.md")

    @unittest.skipUnless(CHROMIUM, "Chromium is not installed")
    def test_page(self):
        """Checks that a click and the keyboard sort, and that the filter works."""
        code = ("import sys; sys.path[:0] = ['compiler/adapters', 'scripts/studies']\n"
                "from whole_materials import site\n"
                "def row(name, kind, ours): return {'kind': kind, 'name': name, 'from': 'OpenPBR', 'to': name, 'in_use': 'names copied',"
                " 'values': '', 'source': 's.png', 'in use': {'file': 'u.png', 'linear': 0.5, 'display': 0.1},"
                " 'ours': {'file': 'o.png', 'linear': ours, 'display': 0.1}}\n"
                "print(site.page([row('B', 'random', 0.1), row('A', 'document', 0.3), row('C', 'random', 0.2)], 1, []))")
        page = subprocess.run([PYTHON, "-c", code], capture_output=True, text=True, cwd=ROOT)
        self.assertEqual(page.returncode, 0, page.stderr)
        script = """<script>{
const shown = () => [...document.querySelectorAll("tbody tr:not([hidden]) th")].map(one => one.dataset.value).join("");
const found = [shown()], buttons = [...document.querySelectorAll("thead button")];
for (const button of [buttons[0], buttons[0], buttons[3]]) { button.focus(); button.click(); found.push(shown()); }
found.push(document.activeElement === buttons[3], document.querySelectorAll("th[aria-sort]").length);
document.querySelector("#kind").value = "random";
document.querySelector("#kind").dispatchEvent(new Event("change"));
found.push(shown(), document.querySelector("#mean").textContent);
document.body.textContent = found.join("|");
}</script></body>"""
        path = self.folder / "index.html"
        path.write_text(page.stdout.replace("</body>", script))  # removes everything from the page except what it found
        words = ["--headless", "--disable-gpu", "--dump-dom", *(["--no-sandbox"] if os.getuid() == 0 else []), path.as_uri()]
        got = subprocess.run([CHROMIUM, *words], capture_output=True, text=True, timeout=60)
        self.assertIn("BAC|ABC|CBA|ACB|true|1|CB|2 rows, mean error: in use 0.500, ours 0.150",
                      got.stdout.partition("<body>")[2])


unittest.main()
