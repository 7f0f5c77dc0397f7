#!/usr/bin/env python3
"""Tests scripts/studies/materials: the random numbers of C++, materials that are physically possible, and both files
of measured materials."""
import csv
import json
import runpy
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MATERIALS = ROOT / "scripts/studies/materials"
COLUMNS = ["diffuse_r", "diffuse_g", "diffuse_b", "f0_r", "f0_g", "f0_b"]


class Materials(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)

    def materials(self, *words):
        run = subprocess.run([str(MATERIALS), *map(str, words)], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        return list(csv.DictReader(run.stdout.splitlines())), run.stderr

    def refused(self, message, *words):
        run = subprocess.run([str(MATERIALS), *map(str, words)], capture_output=True, text=True)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertIn(message, run.stderr)
        self.assertNotIn("Traceback", run.stderr)

    def test_generator(self):
        """Checks the number that the C++ standard states: the 10000th of mt19937_64 with the seed 5489 is
        9981545732273789042."""
        draw = runpy.run_path(str(MATERIALS))["Draw"](5489)
        self.assertEqual([draw.share() for i in range(10000)][-1], (9981545732273789042 >> 11) * 2.0 ** -53)

    def test_random(self):
        rows, notes = self.materials("--count", 7, "--alphas", "0.2,0.5")
        self.assertEqual([row["group"] for row in rows], ["random"] * 7 + ["plastic"] * 7 + ["paint"] * 7)
        self.assertEqual([float(row["alpha"]) for row in rows[:3]], [0.2, 0.5, 0.2])
        self.assertEqual(notes.count("has no materials"), 2)
        for row in rows:
            diffuse, f0 = ([float(row[name]) for name in names] for names in (COLUMNS[:3], COLUMNS[3:]))
            self.assertTrue(all(0.0 <= value <= 1.0 for value in diffuse + f0))
            if row["group"] != "random":
                self.assertLessEqual(max(diffuse), 1.0 - max(f0) + 1e-15)
            if row["group"] == "plastic":
                self.assertTrue(0.02 <= f0[0] <= 0.12 and f0[0] == f0[1] == f0[2])
        self.assertEqual(self.materials("--count", 7, "--alphas", "0.2,0.5")[0], rows)
        self.assertNotEqual(self.materials("--count", 7, "--seed", 2)[0][0]["diffuse_r"], rows[0]["diffuse_r"])

    def measured(self, **changes):
        """Makes a folder with three lines of Ngan et al., and ten materials of the database."""
        (self.folder / "ngan_ward.fit").write_text("# comment\n" + "".join(
            f"m{i} = Aggregate(Lambertian(albedo = [0.{i}, 0.2, 0.3]), NganWard(albedo = [0.4, 0.5, 1.5], x = [1]))\n" for i in (1, 2, 3)))
        data = [{"name": f"one, {i}", "metalness": float(i % 2), "ior": 1.5,
                 "color": [{"colorSpace": "acescg", "color": [0, 0, 0]}, {"colorSpace": "srgb-linear", "color": [0.1 * i, 0.5, 1.25]}],
                 **changes} for i in range(10)]
        (self.folder / "physicallybased.json").write_text(json.dumps({"data": data}))
        return self.folder

    def test_measured(self):
        rows, notes = self.materials(self.measured(), "--count", 11, "--alphas", "0.1,0.2")
        self.assertEqual((len(rows), notes), (55, ""))
        ngan = [row for row in rows if row["group"] == "ngan"]
        self.assertEqual({row["material"] for row in ngan}, {"m1", "m2", "m3"})
        self.assertEqual(float(ngan[0]["f0_b"]), 1.0)  # clamped to 1
        # The same materials come again with other alphas.
        self.assertEqual(ngan[0]["material"], ngan[3]["material"])
        self.assertEqual([float(row["alpha"]) for row in ngan[:6]], [0.1, 0.2, 0.1, 0.1, 0.2, 0.1])
        mixed = [row for row in rows if " on " in row["material"]]
        self.assertEqual(len(mixed), 1)
        for row in (row for row in rows if row["group"] == "measured" and row not in mixed):
            self.assertNotIn(",", row["material"])
            diffuse, f0 = ([float(row[name]) for name in names] for names in (COLUMNS[:3], COLUMNS[3:]))
            self.assertTrue(diffuse == [0.0] * 3 if int(row["material"][-1]) % 2 else abs(f0[0] - 0.04) < 1e-12)

    def test_wrong_inputs(self):
        self.refused("--count: 0 is not a number of at least 1", "--count", 0)
        self.refused("--alphas: 0.1,x is out of range", "--alphas", "0.1,x")
        self.refused("none: not a folder", self.folder / "none")
        folder = self.measured(color=[])
        self.refused("physicallybased.json: not the database of physicallybased.info", folder)
        (folder / "physicallybased.json").write_text("{")
        self.refused("physicallybased.json: not the database", folder)
        (folder / "ngan_ward.fit").write_text("# comment\nred = Aggregate(Lambertian(albedo = [0.1, x, 0]))\n")
        self.refused("ngan_ward.fit:2: cannot find two albedos of three numbers", folder)
        (folder / "ngan_ward.fit").write_text("# comment\n")
        self.refused("ngan_ward.fit: contains no material", folder)


unittest.main()
