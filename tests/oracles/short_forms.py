#!/usr/bin/env python3
"""Compares the short forms of every language with each other.

Usage: tests/oracles/short_forms.py [FOLDER, default generated/short]

C by gcc and clang, C++, Python and JavaScript are run on a grid of every function, and compared with the formula of the table,
which this script reads by its own rules. MaterialX is evaluated node by node, and validated where its package is installed. What
is not installed is named, and does not count.
"""
import csv
import importlib.util
import itertools
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

GRIDS = {"n": [0.5, 1, 10, 96.08, 1000], "f": [0, 0.04, 0.5, 1], "roughness": [0.2, 0.5, 1], "alpha": [0.05, 0.3, 1],
         "metallic": [0, 0.3, 1]}
COLORS = [0, 0.04, 0.5, 1]
TOLERANCE = 2e-5  # of floats, relative


def formula_value(text, inputs):
    """The value of `min(1, 5.94 ks / (n + 1.8))`: a blank between two terms multiplies."""
    text = re.sub(r"(?<=[\w.)]) (?=[\w(])", " * ", text.replace("^", "**"))
    text = re.sub(r"\* (max|min)", r"* \1", text)
    return eval(text, {"min": min, "max": max}, dict(inputs))  # the text of this repository


def nodes_value(graph, inputs):
    """The output of a nodegraph for scalars."""
    values = {}

    def of(element):
        if "nodename" in element.attrib:
            return values[element.attrib["nodename"]]
        if "interfacename" in element.attrib:
            return inputs[element.attrib["interfacename"]]
        return float(element.attrib["value"])

    operations = {"add": lambda a, b: a + b, "subtract": lambda a, b: a - b, "multiply": lambda a, b: a * b,
                  "divide": lambda a, b: a / b, "min": min, "max": max, "power": lambda a, b: a ** b}
    for node in graph:
        if node.tag == "output":
            return of(node)
        terms = {term.attrib["name"]: of(term) for term in node}
        values[node.attrib["name"]] = operations[node.tag](terms["in1"], terms["in2"])
    raise ValueError(graph.attrib["name"])


def run(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} failed:\n{done.stderr[:2000]}")
    return done.stdout


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "generated/short").resolve()
    spec = importlib.util.spec_from_file_location("short_forms", folder / "short_forms.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    cases = []  # name of the function, inputs in order, expected value
    for row in csv.DictReader((folder / "short_forms.csv").open()):
        for line in row["form"].split("; "):
            output, formula = line.split(" = ", 1)
            function = getattr(module, f"{row['id']}_{output}")
            names = function.__code__.co_varnames[:function.__code__.co_argcount]
            for values in itertools.product(*(GRIDS.get(name, COLORS) for name in names)):
                cases.append((f"{row['id']}_{output}", names, values, formula_value(formula, zip(names, values))))
    calls = [f"{name}({', '.join(map(repr, values))})" for name, _, values, _ in cases]
    found = {"Python": [getattr(module, name)(*values) for name, _, values, _ in cases]}
    graphs = {graph.attrib["nodedef"]: graph
              for graph in xml.parse(folder / "short_forms.mtlx").getroot().iter("nodegraph")}
    found["MaterialX, by nodes"] = [nodes_value(graphs["ND_remap_" + name], dict(zip(names, values)))
                                    for name, names, values, _ in cases]
    skipped = []
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        in_c = [re.sub(r"(\d+(?:\.\d+)?)(?=[,)])", lambda m: repr(float(m.group(1))) + "f", call) for call in calls]
        (scratch / "c.c").write_text('#include "short_forms.h"\n#include <stdio.h>\nint main(void) {\n' + "".join(
            f'  printf("%.9g\\n", (double)remap_{call});\n' for call in in_c) + "  return 0;\n}\n")
        (scratch / "cpp.cpp").write_text('#include "short_forms.hpp"\n#include <cstdio>\nusing namespace remap::short_forms;\n'
                                         "int main() {\n" + "".join(
            f'  std::printf("%.9g\\n", static_cast<double>({call}));\n' for call in in_c) + "}\n")
        warnings = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror", "-I", str(folder)]
        for compiler, source, standard in [("gcc", "c.c", "c99"), ("clang", "c.c", "c99"), ("g++", "cpp.cpp", "c++17"),
                                           ("clang++", "cpp.cpp", "c++17")]:
            if shutil.which(compiler) is None:
                skipped.append(compiler)
                continue
            quiet = ["-Wno-unused-function"] if source == "c.c" else []
            run([compiler, f"-std={standard}", *warnings, *quiet, str(scratch / source), "-o", str(scratch / "a"), "-lm"])
            found[compiler] = [float(line) for line in run([str(scratch / "a")]).split()]
        if shutil.which("node"):
            script = f"import * as f from {json.dumps((folder / 'short_forms.mjs').as_uri())};\n" + "".join(
                f"console.log(f.{call});\n" for call in calls)
            (scratch / "calls.mjs").write_text(script)
            found["JavaScript"] = [float(line) for line in run(["node", str(scratch / "calls.mjs")]).split()]
        else:
            skipped.append("node")
    wrong = 0
    for language, values in found.items():
        for value, (name, names, inputs, expected) in zip(values, cases, strict=True):
            if not math.isclose(value, expected, rel_tol=TOLERANCE, abs_tol=TOLERANCE):
                wrong += 1
                if wrong <= 20:
                    print(f"{language}: {name}{dict(zip(names, inputs))} is {value}, the formula gives {expected}")
    try:
        import MaterialX
        document = MaterialX.createDocument()
        MaterialX.readFromXmlFile(document, str(folder / "short_forms.mtlx"))
        valid, message = document.validate()
        if not valid:
            wrong += 1
            print("MaterialX: " + message)
        found["MaterialX, validated"] = []
    except ImportError:
        skipped.append("MaterialX (pip install MaterialX)")
    print(f"{len(cases)} values of {len({case[0] for case in cases})} functions in {', '.join(found)}: "
          f"{wrong} wrong" + (f"; not installed: {', '.join(skipped)}" if skipped else ""))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
