#!/usr/bin/env python3
"""tables.py READER REMAPC REMAP_STUDY reads every kind of table that the programs write, and the tables that ship,
with other programs and without options.

READER is numpy (genfromtxt), pandas (read_csv) or soffice (LibreOffice Calc). The first line must be the names of the
columns. Every cell with a number must be read as the same number, and the file must contain nothing else. The test is
skipped (77) without the reader.
"""
import csv
import math
import os
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "fits/tables/mitsuba_ward_to_mitsuba_as.csv"
FIT = ROOT / "fits/mitsuba_ward_to_mitsuba_as.json"
COMMANDS = [  # the commands, and what each writes
    (["remapc", "export", TABLE, "-o", "export.csv"], "export.csv"),
    (["remapc", "sweep", "--source", "mitsuba/ward", "--target", "mitsuba/ggx", "--roughness-samples", "3", "--specular-samples", "2",
      "--resolution", "16", "--quiet", "-o", "sweep.csv"], "sweep.csv"),
    (["remapc", "sample", "--source", "mitsuba/ggx-metallic", "--vary", "metallic", "--target", "mitsuba/ggx", "--resolution", "16",
      "--count", "20", "--quiet", "-o", "sample.csv"], "sample.csv"),
    (["remapc", "eval", FIT, "--grid", "4", "-o", "grid.csv"], "grid.csv"),
    (["remap-study", "reach", "mitsuba_ward_to_mitsuba_as", "--fits", ROOT / "fits", "--materials", "2", "--quiet", "-o", "reach"],
     "reach/reach.csv"),
    (["remap-study", "environments", "--pair", "mitsuba/ward:mitsuba/ggx", "--fits", ROOT / "fits", "--resolution", "16", "--samples", "64",
      "--quiet", "-o", "environments"], "environments/environments.csv")]


def number(text):
    """Returns None if the cell is not a number."""
    try:
        return float(text)
    except ValueError:
        return None


def same(value, text):
    """Returns true if a reader has the number of this text, to the digits that all readers keep."""
    expected = number(text)
    return value is None if expected is None else value is not None and math.isclose(value, expected, rel_tol=1e-13, abs_tol=0.0)


def by_numpy(path):
    import numpy
    table = numpy.atleast_1d(numpy.genfromtxt(path, names=True, delimiter=","))
    return list(table.dtype.names), [[None if math.isnan(cell) else cell for cell in row] for row in table.tolist()]


def by_pandas(path):
    import pandas
    table = pandas.read_csv(path)
    return list(table.columns), [[cell if isinstance(cell, (int, float)) and not math.isnan(cell) else None for cell in row]
                                 for row in table.itertuples(index=False)]


def open_in_soffice(paths, folder):
    """Converts each file to a document in a single start, which takes some seconds."""
    folder.mkdir()
    copies = [shutil.copy(path, folder / f"{number}.csv") for number, path in enumerate(paths)]
    subprocess.run(["soffice", f"-env:UserInstallation=file://{folder}/profile", "--headless", "--convert-to", "fods", "--outdir", folder,
                    *copies], check=True, capture_output=True, timeout=250)
    return {path: copy.with_suffix(".fods") for path, copy in zip(paths, copies)}


def by_soffice(file):
    """Returns the cells of such a document. A person who opens the file sees the same."""
    document = xml.etree.ElementTree.parse(file)
    names = {"table": "urn:oasis:names:tc:opendocument:xmlns:table:1.0", "office": "urn:oasis:names:tc:opendocument:xmlns:office:1.0"}

    def attribute(element, space, name):
        return element.get(f"{{{names[space]}}}{name}")

    rows = []
    for row in document.iterfind(".//table:table-row", names):
        cells = []
        for cell in row.iterfind("table:table-cell", names):
            value = attribute(cell, "office", "value") if attribute(cell, "office", "value-type") == "float" else None
            content = "".join(cell.itertext()).strip() if value is None else float(value)
            cells += [content] * int(attribute(cell, "table", "number-columns-repeated") or 1)
        rows += [cells] * int(attribute(row, "table", "number-rows-repeated") or 1)
    return rows[0], [[cell if isinstance(cell, float) else None for cell in row] for row in rows[1:]]


def faults(path, read):
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    names, values = read(path)
    while names and names[-1] == "":
        names.pop()
    if names != header:
        return [f"{path}: columns {names}, in the file {header}"]
    if len(values) != len(rows):
        return [f"{path}: {len(values)} rows, in the file {len(rows)}"]
    return [f"{path}: row {r + 1}, {name}: is {value}, in the file '{text}'"
            for r, (row, read_row) in enumerate(zip(rows, values)) for name, text, value in zip(header, row, read_row)
            if not same(value, text)]


def main():
    reader = sys.argv[1]
    programs = {"remapc": sys.argv[2], "remap-study": sys.argv[3]}
    if reader == "soffice":
        missing = shutil.which("soffice") is None
    else:
        pythons = [python for python in (sys.executable, "/usr/bin/python3")
                   if subprocess.run([python, "-c", f"import {reader}"], capture_output=True).returncode == 0]
        missing = not pythons
        if pythons and pythons[0] != sys.executable:
            os.execv(pythons[0], [pythons[0], *sys.argv])
    if missing:
        print(f"skipped: {reader}: not installed (Debian: {'libreoffice-calc' if reader == 'soffice' else 'python3-' + reader})")
        return 1 if reader in os.environ.get("REMAP_REQUIRE", "").split(",") else 77
    found, count = [], 0
    with tempfile.TemporaryDirectory() as folder:
        paths = [ROOT / "fits/converters.csv", ROOT / "fits/reach.csv"]
        for (program, *words), output in COMMANDS:
            run = subprocess.run([programs[program], *words], cwd=folder, capture_output=True, text=True, timeout=120)
            if run.returncode != 0:
                sys.exit(f"{program} {words[0]}: {run.stderr.strip()}")
            paths += sorted((Path(folder) / output).parent.glob(Path(output).stem + "*.csv"))
        if reader == "soffice":
            documents = open_in_soffice(paths, Path(folder, "documents"))
        read = {"numpy": by_numpy, "pandas": by_pandas, "soffice": lambda path: by_soffice(documents[path])}[reader]
        for path in paths:
            found += faults(path, read)
            count += 1
    print("\n".join(found[:20] + [f"{count} tables, {len(found)} faults"]))
    return 1 if found or count < 8 else 0


if __name__ == "__main__":
    sys.exit(main())
