#!/usr/bin/env python3
"""Compares the translations of whole materials in C++, Python and MaterialX on one grid of 10,000 materials.

Usage: tests/oracles/materials.py [GENERATED, default generated]

The header is compiled by g++ and clang++. The Python module runs unchanged. The graphs are evaluated node by node,
for all materials at once. The values may differ by 1e-5, or by this fraction of a value above 1. If the package
MaterialX is installed, the graphs are also validated, found by its ShaderTranslator, and written as GLSL and ESSL,
and glslangValidator compiles the shaders. What is not installed is listed and skipped.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

import numpy as np

MATERIALS, TOLERANCE, MOST_NODES = 10000, 1e-5, 150
# The values of these inputs are not limited to 0 to 1.
RANGES = {"ior": (1.1, 2.2), "thickness": (0, 900), "depth": (0, 2), "distance": (0, 2), "luminance": (0, 50), "strength": (0, 2),
          "abbe": (9, 91), "dispersion": (0, 40), "radius": (0, 2), "scale": (0, 2), "emission": (0, 5)}


def drawn(models, model, random):
    """Returns an array of shape (MATERIALS, 1 or 3) for each input. A third of the values are 0 or 1, and a third are
    the default."""
    values = {}
    for name, default in models[model].items():
        channels = 3 if isinstance(default, tuple) else 1
        low, high = next((ends for word, ends in RANGES.items() if word in name.lower()), (0, 1))
        shape = (MATERIALS, channels)
        value = random.uniform(low, high, shape)
        ends = random.integers(0, 2, (MATERIALS, 1)) * np.ones(shape)
        kind = random.integers(0, 3, (MATERIALS, 1))
        if re.search("ior|abbe", name.lower()):
            kind = np.maximum(kind, 1)  # another test covers an IOR of 0 or 1
        value = np.where(kind == 0, ends, np.where(kind == 1, value, np.asarray(default, float)))
        if re.search("thin_walled|useSpecular|Mode|_mode", name):
            value = np.round(value)
        values[name] = value.astype(np.float32).astype(float)
    return values


def header_values(generated, module, compiler, folder, direction, source):
    """Returns the outputs of the C++ header, from its loop over maps."""
    start, end = direction[0], re.sub("_specular$|_core$", "", direction[1])

    def type_name(model):
        return "".join(part[0].upper() + part[1:] for part in model.split("_"))
    counts = [np.concatenate([np.ravel(1 if not isinstance(v, tuple) else 3) for v in module.MODELS[m].values()]) for m in (start, end)]
    program = f"""#include <cstdio>
#include <vector>
#include "materials/materials.hpp"
using namespace remap::materials;
int main() {{
  const int takes[] = {{{', '.join(map(str, counts[0]))}}}, makes[] = {{{', '.join(map(str, counts[1]))}}};
  std::vector<std::vector<float>> maps, results;
  std::vector<MapRow> in; std::vector<ResultRow> out;
  for (int n : takes) {{
    maps.emplace_back({MATERIALS} * n);
    if (std::fread(maps.back().data(), sizeof(float), maps.back().size(), stdin) != maps.back().size()) return 1;
    in.push_back({{maps.back().data(), static_cast<std::size_t>(n)}});
  }}
  for (int n : makes) {{
    results.emplace_back({MATERIALS} * n);
    out.push_back({{results.back().data(), static_cast<std::size_t>(n)}});
  }}
  translate_texels({module.TRANSLATIONS[direction].__name__}, {MATERIALS}, in.data(), out.data());
  for (const auto& result : results) std::fwrite(result.data(), sizeof(float), result.size(), stdout);
}}
"""
    text, binary = folder / "program.cpp", folder / "program"
    text.write_text(program)
    subprocess.run([compiler, "-std=c++17", "-O1", "-Wall", "-Wextra", "-Wconversion", "-Wshadow", "-Werror", f"-I{generated}",
                    str(text), "-o", str(binary)], check=True)
    data = b"".join(value.astype(np.float32).tobytes() for value in source.values())
    numbers = np.frombuffer(subprocess.run([binary], input=data, stdout=subprocess.PIPE, check=True).stdout, np.float32)
    values, at = {}, 0
    for name, channels in zip(module.MODELS[end], counts[1]):
        values[name] = numbers[at:at + MATERIALS * channels].reshape(MATERIALS, channels)
        at += MATERIALS * channels
    return values


class Graph:
    """A node graph of MaterialX, evaluated for all materials at once."""

    def __init__(self, library, name):
        self.library = library
        self.graph = library.find(f"nodegraph[@nodedef='ND_{name}']")
        self.nodes = {node.get("name"): node for node in self.graph if node.tag != "output"}

    def outputs(self, inputs):
        self.inputs, self.known = inputs, {}
        return {output.get("name"): self.of(output) for output in self.graph if output.tag == "output"}

    def of(self, element):
        if element.get("value") is not None:
            words = element.get("value").split(",")
            return np.array([float({"true": 1, "false": 0}.get(word, word)) for word in words])
        if element.get("interfacename"):
            return self.inputs[element.get("interfacename")]
        name = element.get("nodename")
        if name not in self.known:
            self.known[name] = self.node(self.nodes[name])
        return self.known[name]

    def node(self, node):
        terms = {i.get("name"): self.of(i) for i in node}
        a, b = terms.get("in1"), terms.get("in2")
        simple = {"add": np.add, "subtract": np.subtract, "multiply": np.multiply, "divide": np.divide, "min": np.minimum,
                  "max": np.maximum, "power": np.power}
        if node.tag in simple:
            value = simple[node.tag](a, b)
        elif node.tag.startswith("remap_"):
            value = Graph(self.library, node.tag).outputs(terms)["out"]
        else:
            value = {"dot": lambda: terms["in"], "constant": lambda: terms["value"], "convert": lambda: terms["in"],
                     "sqrt": lambda: np.sqrt(terms["in"]), "exp": lambda: np.exp(terms["in"]),
                     "mix": lambda: terms["bg"] + (terms["fg"] - terms["bg"]) * terms["mix"],
                     "extract": lambda: terms["in"][..., int(terms["index"][0]):][..., :1],
                     "ifgreater": lambda: np.where(terms["value1"] > terms["value2"], a, b),
                     "ifequal": lambda: np.where(terms["value1"] == terms["value2"], a, b)}[node.tag]()
        return value * np.ones(3) if node.get("type") == "color3" else value


def worst_difference(values, expected):
    """Returns the largest difference, as a fraction of values above 1, and its input."""
    worst, where = 0.0, ""
    for name, value in values.items():
        other = expected[name] * np.ones_like(value)
        difference = np.abs(value - other) / np.maximum(1, np.abs(other))
        if not np.isfinite(value).all() or difference.max() > worst:
            worst, where = (np.inf if not np.isfinite(value).all() else float(difference.max())), name
    return worst, where


def check_graphs_in_material_x(generated):
    """Validates the graphs, finds them, and writes them as shaders. Returns what is missing."""
    try:
        import MaterialX as mx
        import MaterialX.PyMaterialXGenGlsl as glsl
        import MaterialX.PyMaterialXGenShader as gen
    except ImportError:
        return ["MaterialX (pip install MaterialX)"]
    missing = []

    def library_first():
        """Returns a document that contains our library before the standard ones."""
        document = mx.createDocument()
        ours = mx.createDocument()
        mx.readFromXmlFile(ours, str(generated / "materialx" / "remap_translation.mtlx"))
        document.importLibrary(ours)
        mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), document)
        return document
    library = library_first()
    valid, problems = library.validate()
    assert valid, problems
    # MaterialX' official translation of the same name lacks this output. So this checks that the project's own is found.
    assert library.getNodeDef("ND_open_pbr_surface_to_standard_surface").getOutput("coat_affect_color_out")
    for name in re.findall('nodedef name="ND_([^"]*_to_[^"]*)"', (generated / "materialx/remap_translation.mtlx").read_text()):
        source, target = name.split("_to_")
        if target.endswith(("_specular", "_core")):
            continue
        document = mx.createDocument()
        document.setDataLibrary(library)
        node = document.addNode(source, "paint", "surfaceshader")
        document.addMaterialNode("material", node)
        gen.ShaderTranslator.create().translateAllMaterials(document, target)
        valid, problems = document.validate()
        assert valid, (name, problems)
        used = [n for n in document.getNodes() if n.getCategory() == name]
        graphs = [n for g in document.getNodeGraphs() for n in g.getNodes() if n.getCategory() == name]
        assert used or graphs, f"ShaderTranslator does not use {name}"
        shader = next(n for n in document.getNodes() if n.getCategory() == target)
        for generator, kind in ((glsl.GlslShaderGenerator.create(), "frag"), (glsl.EsslShaderGenerator.create(), "frag")):
            context = gen.GenContext(generator)
            context.registerSourceCodeSearchPath(mx.getDefaultDataSearchPath())
            text = generator.generate("shader", shader, context).getSourceCode("pixel")
            if shutil.which("glslangValidator"):
                with tempfile.NamedTemporaryFile("w", suffix="." + kind) as file:
                    file.write(text)
                    file.flush()
                    subprocess.run(["glslangValidator", file.name], check=True, stdout=subprocess.DEVNULL)
            else:
                missing.append("glslangValidator")
    return sorted(set(missing))


def main():
    generated = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "generated").resolve()
    sys.path.insert(0, str(generated / "materials"))
    sys.dont_write_bytecode = True
    import materials as module
    library = xml.parse(generated / "materialx" / "remap_translation.mtlx").getroot()
    random = np.random.default_rng(68)
    missing, worst = [], 0.0
    np.seterr(all="ignore")
    for direction, translation in module.TRANSLATIONS.items():
        source = drawn(module.MODELS, direction[0], random)
        expected = translation(source)
        found = {}
        for compiler in ("g++", "clang++"):
            if shutil.which(compiler):
                with tempfile.TemporaryDirectory() as folder:
                    found[compiler] = header_values(generated, module, compiler, pathlib.Path(folder), direction, source)
            else:
                missing.append(compiler)
        if library.find(f"nodedef[@name='ND_{translation.__name__}']") is not None:
            graph = Graph(library, translation.__name__)
            assert len(graph.nodes) < MOST_NODES, f"{translation.__name__} has {len(graph.nodes)} nodes"
            found["MaterialX"] = {name[:-4]: value for name, value in graph.outputs(source).items()}
        for language, values in found.items():
            difference, name = worst_difference(values, expected)
            assert difference <= TOLERANCE, f"{translation.__name__}, {language}: {name} differs by {difference:.1e} from Python"
            worst = max(worst, difference)
    missing += check_graphs_in_material_x(generated)
    print(f"{len(module.TRANSLATIONS)} translations of {MATERIALS} materials agree within {worst:.1e}"
          + (f"; not installed: {', '.join(sorted(set(missing)))}" if missing else ""))


if __name__ == "__main__":
    main()
