#!/usr/bin/env python3
"""summarize_test.py REMAP_STUDY runs scripts/studies/summarize on small studies, and compares it with figures that
this test computes from the CSV.

The texts are read as people read them. It also tests that a folder and piped input give the same text, that the plots
are SVG if gnuplot is installed, and that wrong inputs are refused with exit code 2 and one line.
"""
import csv
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
STUDY = Path(sys.argv.pop(1)).resolve()
SUMMARIZE, MATERIALS = ROOT / "scripts/studies/summarize", ROOT / "scripts/studies/materials"


def run(*words, **options):
    return subprocess.run(list(map(str, words)), capture_output=True, text=True, cwd=ROOT, **options)


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return [row for row in csv.DictReader(line for line in file if not line.startswith("#"))]


def average(rows, column, size=lambda value: value):
    total = 0.0
    for row in rows:
        total += size(float(row[column]))
    return total / len(rows)


class Summarize(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        fits = cls.folder / "fits"
        fits.mkdir()  # the second pair has no fit
        shutil.copy(ROOT / "fits/mitsuba_ward_to_mitsuba_as.json", fits)
        (cls.folder / "materials.csv").write_text(run(MATERIALS, "--count", "2", "--alphas", "0.2,0.5").stdout)
        size = ["--resolution", "16", "--samples", "16", "--quiet", "--fits", fits]
        cls.words = {
            "environments": ["--pair", "mitsuba/ward:mitsuba/as", "--pair", "mitsuba/ggx:mitsuba/beckmann", "--alphas", "0.3", *size],
            "workflows": [cls.folder / "materials.csv", "--family-count", "20", *size],
            "reach": ["mitsuba_ward_to_mitsuba_as", "mitsuba_beckmann_to_mitsuba_ward", "--materials", "3", "--resolution", "16", "--quiet"]}
        for study, words in cls.words.items():
            made = run(STUDY, study, *words, "-o", cls.folder / study)
            assert made.returncode == 0 and made.stdout == "", made.stderr

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def summary(self, *words, **options):
        result = run(SUMMARIZE, *words, **options)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def figures(self, *words):
        return json.loads(self.summary(*words, "--json"))

    def refused(self, message, *words, **options):
        result = run(SUMMARIZE, *words, **options)
        self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1)
        self.assertIn(message, result.stderr)

    def test_environments(self):
        rows = table(self.folder / "environments/environments.csv")
        text, figures = self.summary(self.folder / "environments"), self.figures(self.folder / "environments")
        copies = {}
        for method in ("copy", "paper", "natural-1", "natural-2", "shipped"):
            for source, target in (("mitsuba/ward", "mitsuba/as"), ("mitsuba/ggx", "mitsuba/beckmann")):
                of_pair = [row for row in rows if (row["method"], row["source"], row["target"]) == (method, source, target)]
                if not of_pair:
                    continue
                means = [average(of_pair, "rmse_percent"), average(of_pair, "ssim"), average(of_pair, "energy_error", abs)]
                line = re.search(rf"^{re.escape(source)} -> {re.escape(target)}  {method} +(\S+) +(\S+) +(\S+)$", text, re.M)
                self.assertEqual(line.groups(), ("%.2f" % means[0], "%.3f" % means[1], "%.1f" % (100 * means[2])))
                entry = next(pair for pair in figures["methods"][method]["pairs"] if (pair["source"], pair["target"]) == (source, target))
                self.assertAlmostEqual(entry["rmse_percent"], means[0], 12)
                copy = copies.setdefault((source, target), means)
                is_worse = means[0] > copy[0] + 0.005 or means[1] < copy[1] - 0.0005
                self.assertEqual({"method": method, "source": source, "target": target} in figures["worse_than_copy"], is_worse)
                verdict = next((line for line in text.split("\n") if line.startswith(f"With `{method}`, ")), "")
                self.assertEqual(f"{source} -> {target} (RMSE {means[0]:.2f} against {copy[0]:.2f}" in verdict, is_worse)
            of_method = [row for row in rows if row["method"] == method]
            self.assertAlmostEqual(figures["methods"][method]["ssim"], average(of_method, "ssim"), 12)
        self.assertIn("\nshipped (1 of 2 pairs) ", text)
        self.assertIn("\nmitsuba/ggx -> mitsuba/beckmann has no fit, so `shipped` is not compared.\n", text)
        self.assertTrue(text.startswith("Spheres under sky, overcast, studio, mean luminance 1; alpha 0.3, specular 0.5, 16 x 16 pixels, "
                                        "sampling noise "), text)
        # the study must give both verdicts
        self.assertTrue(figures["worse_than_copy"] and "no pair is worse than copying" in text)

    def test_workflows(self):
        rows = table(self.folder / "workflows/workflows.csv")
        text, figures = self.summary(self.folder / "workflows"), self.figures(self.folder / "workflows")
        self.assertTrue(text.startswith("6 materials at alpha 0.2, 0.5 under 3 environments, 16 x 16 pixels\n"), text)
        for convention in ("plain", "gltf"):
            for method in {row["method"] for row in rows if row["convention"] == convention}:
                of_method = [row for row in rows if row["convention"] == convention and row["method"] == method]
                head = [row for row in of_method if row["light"] == "headlight"]
                lit = [row for row in of_method if row["light"] != "headlight"]
                similar = sorted(float(row["ssim"]) for row in lit)
                self.assertEqual(len(similar), 18)  # with 6 materials and 3 environments, the worst 5 % are one picture
                entry = figures[convention][method]
                for name, expected in (("rmse_percent", average(lit, "rmse_percent")), ("ssim", average(lit, "ssim")),
                                       ("worst_ssim", similar[0]), ("headlight_rmse_percent", average(head, "rmse_percent")),
                                       ("headlight_ssim", average(head, "ssim"))):
                    self.assertAlmostEqual(entry[name], expected, 12)
                paint = [row for row in lit if row["group"] == "paint"]
                self.assertAlmostEqual(entry["groups"]["paint"]["rmse_percent"], average(paint, "rmse_percent"), 12)
                part = text.split("\n\n")[1 if convention == "plain" else 2]
                line = next(line for line in part.split("\n") if line.startswith(method + " "))
                self.assertEqual(line.split()[-8:], [
                    "%.2f" % average(lit, "rmse_percent"), "%.4f" % average(lit, "ssim"), "%.3f" % similar[0],
                    "%.2f" % average(head, "rmse_percent"), "%.4f" % average(head, "ssim"),
                    *("%.2f" % average([row for row in lit if row["group"] == group], "rmse_percent")
                      for group in ("random", "plastic", "paint"))])
            own, best = (figures[convention][method]["rmse_percent"] for method in ("projection", "best (albedo, metallic)"))
            self.assertIn(f"The RMSE of the projection is {100 * (own / best - 1):.1f} % above the least", text)
        for row in table(self.folder / "workflows/workflows_round_trips.csv"):
            self.assertEqual(figures["family"][row["method"]][row["family"]]["metallic_rms"], float(row["metallic_rms"]))
            line = next(line for line in text.split("round trip, rms")[1].split("\n") if line.startswith(row["method"] + "  "))
            self.assertIn("%.4f  %.4f" % (float(row["metallic_rms"]), float(row["base_color_rms"])), line)
        self.assertIn("\nNote: the group ngan has no materials, because ngan_ward.fit was not found", text)
        self.assertIn("\nNote: the fits contain no network to compare", text)
        trips = self.summary(self.folder / "workflows/workflows_round_trips.csv")
        self.assertIn(trips, text)

    def test_reach(self):
        excess = {}
        for row in table(self.folder / "reach/reach.csv"):
            excess.setdefault(row["fit"], []).append((float(row["error"]) - float(row["least_error"]), row))
        ranked = sorted(excess, key=lambda fit: max(value for value, row in excess[fit]), reverse=True)
        lines = ["excess of the image error over the least that the target can reach, % of the source: mean, largest (its alpha, specular)"]
        means = [sum(value for value, row in excess[fit]) / len(excess[fit]) for fit in ranked]
        for fit, mean in zip(ranked, means):
            largest, row = max(excess[fit], key=lambda entry: entry[0])
            lines.append("%.3f  %.3f  (%.3g, %.3g)  %s" % (100 * mean, 100 * largest, float(row["alpha"]), float(row["specular"]), fit))
        lines.append("mean of all %.3f" % (50 * sum(means)))
        self.assertEqual(self.summary(self.folder / "reach").splitlines(), lines)
        self.assertEqual([fit["id"] for fit in self.figures(self.folder / "reach")["fits"]], ranked)

    def test_pipe(self):
        for study in ("workflows", "reach"):
            piped = run(STUDY, study, *self.words[study]).stdout
            self.assertEqual(self.summary(input=piped), self.summary(self.folder / study / f"{study}.csv"))
        alone = self.folder / "alone.csv"  # a CSV file without its settings
        shutil.copy(self.folder / "environments/environments.csv", alone)
        self.assertIn("specular 0.5, unknown resolution\n", self.summary(alone))

    def test_plots(self):
        for study in ("environments", "workflows"):
            path = self.folder / f"{study}.svg"
            if not shutil.which("gnuplot"):
                self.refused("gnuplot cannot be started", self.folder / study, "--plot", path)
                continue
            self.summary(self.folder / study, "--plot", path)
            drawing = path.read_text(encoding="utf-8")
            self.assertIn("</svg>", drawing)
            self.assertIn("RMSE, % of the display range (lower is better)", drawing)
            self.refused(f"{path}: already exists (--force overwrites)", self.folder / study, "--plot", path)
            self.summary(self.folder / study, "--plot", path, "--force")
        self.refused("has no plot", self.folder / "reach", "--plot", self.folder / "reach.svg")
        self.refused("round trips have no plot", self.folder / "workflows/workflows_round_trips.csv", "--plot", self.folder / "trips.svg")
        self.refused("cannot be written", self.folder / "environments", "--plot", self.folder / "none/environments.svg")

    def test_wrong_inputs(self):
        def file(content, name="wrong.csv"):
            path = self.folder / name
            path.write_bytes(content)
            return path

        good = (self.folder / "reach/reach.csv").read_bytes()
        header, first = good.split(b"\n")[:2]
        self.refused("missing.csv: cannot be read: No such file", self.folder / "missing.csv")
        self.refused("not a table of remap-study: it has the columns (none)", file(b""))
        self.refused("not a table of remap-study: it has the columns converter, fit,", ROOT / "fits/reach.csv")
        self.refused("wrong.csv: the table has no rows", file(header + b"\n"))
        self.refused("wrong.csv:3: 2 cells, but the header has 9 (is the file complete?)", file(b"\n".join([header, first, b"a,b"])))
        self.refused("wrong.csv:2: error: 'x' is not a number", file(b"fit,alpha,specular,error,least_error\na,1,1,x,1\n"))
        self.refused("wrong.csv:3: alpha: 'nan' is not a number", file(b"# tool: x\nfit,alpha,specular,error,least_error\na,nan,1,1,1\n"))
        self.refused("not text in UTF-8", file(b"\xff\xfe\x00"))
        self.refused("standard input: not a table", input="no,table\n1,2\n")
        self.refused("this folder", self.folder / "fits")
        both = self.folder / "both"
        both.mkdir()
        for study in ("reach", "environments"):
            shutil.copy(self.folder / study / f"{study}.csv", both)
        self.refused("has results of several studies (choose one:", both)
        file(b"{", "wrong.csv.json")
        self.refused("wrong.csv.json: not JSON", file(good))
        (self.folder / "wrong.csv.json").write_text("[]")
        self.refused("wrong.csv.json: not the settings of a table", file(good))
        (self.folder / "wrong.csv.json").unlink()
        lines = (self.folder / "workflows/workflows.csv").read_text().split("\n")
        lit = "\n".join(line for line in lines if ",headlight," not in line)
        self.refused("is under a headlight (is the file complete?)", file(lit.encode()))
        result = run(SUMMARIZE, "--plots")
        self.assertEqual(result.returncode, 2)
        self.assertNotIn("Traceback", result.stderr)
        self.assertIn("usage: summarize", self.summary("--help"))

    def test_part_of_a_table(self):
        """Tests a table from which somebody removed rows. The remaining rows are summarised."""
        rows = (self.folder / "environments/environments.csv").read_text().split("\n")
        text = self.summary(input="\n".join(row for row in rows if ",copy," not in row))
        self.assertNotIn("\ncopy ", text)
        self.assertIn("\nnatural-2 ", text)
        self.assertIn(",".join(rows[1].split(",")[:2]).replace(",", " -> "), self.summary(input="\n".join(rows[:2])))


unittest.main()
