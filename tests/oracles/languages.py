#!/usr/bin/env python3
"""Compares the converters of every language with their C++ headers.

Usage: tests/oracles/languages.py [GENERATED, default generated]

Each function of GENERATED/languages runs on one grid, inside and outside of the measured range. C is compiled by gcc
and clang. Python and JavaScript run unchanged. GLSL and HLSL are compiled as C++ with a small type for vectors, and
checked by glslangValidator if it is installed. MaterialX is evaluated node by node, and validated if its package is
installed. What is not installed is listed and skipped.
"""
import importlib.util
import itertools
import json
import math
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

TOLERANCE = 2e-5  # absolute, or relative for values above 1; floats with sums of several terms
SHARES = [-0.05, 0.0, 0.004, 0.1, 0.35, 0.7, 0.95, 1.0, 1.2]  # positions in the domain of widths, as fractions
COLORS = [(0.0, 0.0, 0.0), (0.04, 0.04, 0.04), (0.9, 0.6, 0.3), (0.02, 0.5, 1.0), (1.2, -0.1, 0.25)]

CPP = """#include <cstdio>
%(includes)s
template <class H> void run(std::FILE* in, std::FILE* out) {
  float texel[4];
  for (int i = 0; i < %(texels)d; ++i) {
    if (std::fread(texel, sizeof texel, 1, in) != 1) return;
    const auto result = H::template evaluate<3>({texel[0], {texel[1], texel[2], texel[3]}});
    std::fwrite(&result, sizeof result, 1, out);
  }
}
int main(int, char** files) {
  std::FILE *in = std::fopen(files[1], "rb"), *out = std::fopen(files[2], "wb");
%(runs)s  return std::fclose(out);
}
"""
C = """#include <stdio.h>
#include "converters.h"
int main(int count, char **files) {
  FILE *in = fopen(files[1], "rb"), *out = fopen(files[count - 1], "wb");
  float texel[4];
%(runs)s  return fclose(out);
}
"""
C_RUN = """  for (int i = 0; i < %(texels)d && fread(texel, sizeof texel, 1, in) == 1; ++i) {
    texel[0] = remap_%(id)s(texel[0], texel + 1);
    fwrite(texel, sizeof texel, 1, out);
  }
"""
SHADER = """#include <cmath>
#include <cstdio>
using std::sqrt;
struct %(color)s { float r, g, b; };
inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }
#define EACH(SIGN) \\
  inline %(color)s operator SIGN(%(color)s a, %(color)s b) { return {a.r SIGN b.r, a.g SIGN b.g, a.b SIGN b.b}; } \\
  inline %(color)s operator SIGN(%(color)s a, float b) { return {a.r SIGN b, a.g SIGN b, a.b SIGN b}; } \\
  inline %(color)s operator SIGN(float a, %(color)s b) { return {a SIGN b.r, a SIGN b.g, a SIGN b.b}; }
EACH(+) EACH(-) EACH(*) EACH(/)
inline %(color)s min(%(color)s a, float b) { return {min(a.r, b), min(a.g, b), min(a.b, b)}; }
inline %(color)s max(%(color)s a, float b) { return {max(a.r, b), max(a.g, b), max(a.b, b)}; }
%(code)s
int main(int, char** files) {
  std::FILE *in = std::fopen(files[1], "rb"), *out = std::fopen(files[2], "wb");
  struct { float width; %(color)s specular; } t;
%(runs)s  return std::fclose(out);
}
"""
SHADER_RUN = """  for (int i = 0; i < %(texels)d && std::fread(&t, sizeof t, 1, in) == 1; ++i) {
    remap_%(id)s(t.width, t.specular);
    std::fwrite(&t, sizeof t, 1, out);
  }
"""


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} failed:\n{(done.stderr + done.stdout)[:3000]}")
    return done.stdout


def floats(data):
    return [value[0] for value in struct.iter_unpack("<f", data)]


def grid(header):
    """Returns texels inside and outside of the domain that a header states. Exponents are spaced evenly in alpha."""
    least, most, color = map(float, re.search(
        r"width_min = ([\d.e+-]+)f, width_max = ([\d.e+-]+)f;.*?specular_max = ([\d.e+-]+)f", header, re.DOTALL).groups())
    if 'kSourceWidth = "exponent"' in header:
        ends = [math.sqrt(2 / (end + 2)) for end in (most, least)]
        widths = [2 / max(1e-3, ends[0] + share * (ends[1] - ends[0])) ** 2 - 2 for share in SHARES]
    else:
        widths = [least + share * (most - least) for share in SHARES]
    return [(width, *(channel * color for channel in rgb)) for width, rgb in itertools.product(widths, COLORS)]


def node_values(graph, texel):
    """Returns the outputs of a nodegraph. A color is a list."""
    values = {"width": texel[0], "specular": list(texel[1:])}

    def of(element):
        for key in ("nodename", "interfacename"):
            if key in element.attrib:
                return values[element.attrib[key]]
        return float(element.attrib["value"])

    def each(function, a, b):
        if not isinstance(a, list):
            return function(a, b)
        return [function(x, y) for x, y in zip(a, b if isinstance(b, list) else [b] * 3)]

    two = {"add": lambda a, b: a + b, "subtract": lambda a, b: a - b, "multiply": lambda a, b: a * b,
           "divide": lambda a, b: a / b, "min": min, "max": max}
    outputs = []
    for node in graph:
        terms = {term.attrib["name"]: of(term) for term in node}
        if node.tag == "output":
            value = of(node)
            outputs += value if isinstance(value, list) else [value]
        elif node.tag == "extract":
            values[node.attrib["name"]] = terms["in"][int(terms["index"])]
        elif node.tag == "sqrt":
            values[node.attrib["name"]] = math.sqrt(terms["in"])
        else:
            values[node.attrib["name"]] = each(two[node.tag], terms["in1"], terms["in2"])
    return outputs


def main():
    generated = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "generated").resolve()
    folder = generated / "languages"
    spec = importlib.util.spec_from_file_location("converters", folder / "converters.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    ids = [name for name in vars(module) if "_to_" in name]
    texels = {name: [struct.unpack("<4f", struct.pack("<4f", *texel)) for texel in grid((generated / f"{name}.hpp").read_text())]
              for name in ids}
    count = len(SHARES) * len(COLORS)
    found, skipped = {}, []
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        (scratch / "in").write_bytes(b"".join(struct.pack("<4f", *texel) for name in ids for texel in texels[name]))

        def compiled(language, source, text, *command):
            if shutil.which(command[0]) is None:
                skipped.append(command[0])
                return
            (scratch / source).write_text(text)
            run(*command, "-Wall", "-Wextra", "-Werror", "-ffp-contract=off", scratch / source, "-o", scratch / "a", "-lm")
            run(scratch / "a", scratch / "in", scratch / "out")
            found[language] = floats((scratch / "out").read_bytes())

        each = lambda text: "".join(text % {"id": name, "texels": count} for name in ids)  # noqa: E731
        compiled("C++", "a.cpp", CPP % {"texels": count, "includes": each('#include "%(id)s.hpp"\n'),
                                        "runs": each("  run<remap::%(id)s>(in, out);\n")}, "g++", "-std=c++17", "-I", generated)
        for compiler in ("gcc", "clang"):
            compiled(f"C99, {compiler}", "a.c", C % {"runs": each(C_RUN)}, compiler, "-std=c99", "-Wpedantic", "-Wconversion",
                     "-I", folder)
        for language, color in (("glsl", "vec3"), ("hlsl", "float3")):
            code = (folder / f"converters.{language}").read_text()
            compiled(language.upper(), f"{language}.cpp", SHADER % {
                "color": color, "code": re.sub(r"inout (\w+) (\w+)", r"\1& \2", code), "runs": each(SHADER_RUN)}, "g++", "-std=c++17")
            if shutil.which("glslangValidator"):
                head = {"glsl": "#version 450\n", "hlsl": ""}[language]
                body = {"glsl": "void main() {}\n", "hlsl": "float4 main() : SV_Target { return 0; }\n"}[language]
                (scratch / "shader.frag").write_text(head + code + body)
                run("glslangValidator", *(["-D", "-e", "main", "-V"] if language == "hlsl" else []), "-S", "frag",
                    scratch / "shader.frag", *(["-o", scratch / "shader.spv"] if language == "hlsl" else []))
            else:
                skipped.append("glslangValidator")
        if shutil.which("node"):
            (scratch / "calls.mjs").write_text(
                f"import * as all from {json.dumps((folder / 'converters.mjs').as_uri())};\n"
                f"for (const [id, texels] of Object.entries({json.dumps(texels)}))\n"
                "  for (const [width, ...specular] of texels) {\n    const target = all[id](width, specular);\n"
                "    console.log(target.width, ...target.specular);\n  }\n")
            found["JavaScript"] = [float(word) for word in run("node", scratch / "calls.mjs").split()]
        else:
            skipped.append("node")
    found["Python"] = [value for name in ids for texel in texels[name]
                       for width, specular in [getattr(module, name)(texel[0], texel[1:])] for value in (width, *specular)]
    graphs = {graph.attrib["name"]: graph for graph in xml.parse(folder / "converters.mtlx").getroot().iter("nodegraph")}
    found["MaterialX, by nodes"] = [value for name in ids for texel in texels[name]
                                    for value in node_values(graphs["NG_remap_" + name], texel)]
    wrong = 0
    expected = found.pop("C++")
    if len(expected) != 4 * count * len(ids):
        sys.exit(f"C++: {len(expected)} values of {len(ids)} headers and {count} texels each")
    for language, values in found.items():
        if len(values) != len(expected):
            sys.exit(f"{language}: {len(values)} values, the headers give {len(expected)}")
        for i, (value, right) in enumerate(zip(values, expected)):
            if not math.isclose(value, right, rel_tol=TOLERANCE, abs_tol=TOLERANCE):
                wrong += 1
                if wrong <= 20:
                    name = ids[i // (4 * count)]
                    print(f"{language}: {name}{texels[name][i // 4 % count]} gives {value}, the header {right}")
    try:
        import MaterialX
        document = MaterialX.createDocument()
        MaterialX.readFromXmlFile(document, str(folder / "converters.mtlx"))
        valid, message = document.validate()
        if not valid:
            wrong += 1
            print("MaterialX: " + message)
        found["MaterialX, validated"] = []
    except ImportError:
        skipped.append("MaterialX (pip install MaterialX)")
    print(f"{len(expected)} values of {len(ids)} converters in {', '.join(found)}: {wrong} wrong"
          + (f"; not installed: {', '.join(sorted(set(skipped)))}" if skipped else ""))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
