"""Measures offers to other programs (docs/adopting): how a change of the program affects the pictures of random
materials.

The changes of MaterialX' graphs are lists of nodes on the pages. The Python lines of a page are run unchanged. The
C++ lines of Blender's exporter are repeated here in Python.
"""
import dataclasses
import functools
import pathlib
import re
import tempfile

import numpy as np

import materialx_shaders as shaders
from whole_materials import generator, in_use, judge, pictures

PAGES = pathlib.Path(__file__).resolve().parents[3] / "docs/adopting"
OPEN_PBR, STANDARD, USD, PRINCIPLED = "open_pbr_surface", "standard_surface", "UsdPreviewSurface", "principled"
LINE = re.compile(r"(\w+) +(\w+) +(\w+)\((.*)\)")
INPUTS = {"mix": ("fg", "bg", "mix"), "dot": ("in",), "constant": ("value",), "exp": ("in",)}
LAMP = {"diffuseColor": (0.1, 0.1, 0.1), "emissiveColor": (1.0, 0.6, 0.2)}


@dataclasses.dataclass(frozen=True)
class Change:
    """Describes a row of a page. `before` and `after` return shader and values that show a material. `concerns`
    chooses materials."""
    words: str
    direction: tuple
    before: object
    after: object
    concerns: object = lambda values: True
    materials: tuple = ()  # if given, used instead of random materials


def block(page, name):
    """Returns the code block of a page that follows the comment <!-- applied: NAME -->."""
    found = re.search(rf"<!-- applied: {re.escape(name)} -->\n```\w*\n(.*?)```", (PAGES / page).read_text(), re.DOTALL)
    if not found:
        raise shaders.Unusable(f"docs/adopting/{page}: has no code block below <!-- applied: {name} -->")
    return found[1]


# The following functions change MaterialX' graphs.


def set_argument(graph, node, name, text):
    """Sets an input of a node to a number, an input of the graph, or another node."""
    interface = graph.getNodeDef().getActiveInput(text)
    other = interface or graph.getNode(text)
    if other is None:
        kind = "float" if name in ("mix", "value1", "value2") else node.getType()
        node.addInput(name, kind).setValueString(", ".join([str(float(text))] * (3 if kind == "color3" else 1)))
    elif interface:
        node.addInput(name, other.getType()).setInterfaceName(text)
    else:
        node.addInput(name, other.getType()).setNodeName(text)


def apply_list(graph, text):
    """Applies `NAME TYPE NODE(ARGUMENTS)`, separated by lines or semicolons. It adds a node, or replaces the node of
    that name. `output` connects an output."""
    for line in filter(None, map(str.strip, re.split("[;\n]", text))):
        found = LINE.fullmatch(line)
        if not found:
            raise shaders.Unusable(f"{graph.getName()}: '{line}' is not a node (write NAME TYPE NODE(ARGUMENTS))")
        name, kind, category, arguments = found.groups()
        arguments = [one.strip() for one in arguments.split(",")]
        if category == "output":
            graph.getOutput(name).setNodeName(arguments[0])
            continue
        graph.removeNode(name)
        node = graph.addNode(category, name, kind)
        for place, argument in zip(INPUTS.get(category, ("in1", "in2")), arguments, strict=True):
            set_argument(graph, node, place, argument)


def changed_graph(direction, lists):
    """Returns a document with the official graph of a direction, changed by lists of nodes."""
    name = "_to_".join(direction)
    official, document = shaders.libraries(), shaders.mx.createDocument()
    definition, graph = document.addNodeDef("ND_" + name, "", name), document.addNodeGraph("NG_" + name)
    for copy, source in ((definition, official.getNodeDef("ND_" + name)), (graph, official.getNodeGraph("NG_" + name))):
        copy.copyContentFrom(source)
        copy.setSourceUri("")  # otherwise a file would include the official graph instead
    for text in lists:
        apply_list(graph, text)
    return document


GRAPHS = {"coat": "materialx-coat.md", "anisotropy": "materialx-anisotropy.md", "sheen": "materialx-sheen.md"}


def write_graph(folder, direction, names):
    """Writes the official graph of a direction, with some changes of the pages, into a folder. Returns the path."""
    lists = [block(GRAPHS[name], f"{name}, {direction[0]}") for name in names]
    path = pathlib.Path(folder) / f"{'_to_'.join(direction)}-{'-'.join(names)}.mtlx"
    path.parent.mkdir(parents=True, exist_ok=True)
    shaders.mx.writeToXmlFile(changed_graph(direction, lists), str(path))
    return path


@functools.cache
def graph_shader(direction, names):
    with tempfile.TemporaryDirectory() as folder:
        return shaders.chain_shader(direction, str(write_graph(folder, direction, names)))


def with_graph(direction, names):
    def version(values):
        shader = graph_shader(direction, names)
        return shader, {name: value for name, value in values.items() if name in shader.types}
    return version


def in_use_of(direction):
    return lambda values: in_use.shader_and_values(direction, values)


def has(*names):
    return lambda values: any(values.get(name) for name in names)


def without_coat(*names):
    return lambda values: has(*names)(values) and not has("coat", "coat_weight")(values)


def fuzz_on_dielectric(values):
    return without_coat("sheen", "fuzz_weight")(values) and not has("metalness", "base_metalness")(values)


def graph_changes(*names, words, concerns=lambda values: True):
    return [Change(f"{direction[0]} to {direction[1]}{words}", direction, in_use_of(direction), with_graph(direction, names), concerns)
            for direction in ((OPEN_PBR, STANDARD), (STANDARD, OPEN_PBR))]


# The following functions concern Blender's exporter.


def exported(*steps):
    """Returns Blender's export with some changes. A change is a function of the sockets that returns inputs of
    OpenPBR."""
    def version(values):
        shader, inputs = in_use.shader_and_values((PRINCIPLED, OPEN_PBR), values)
        for step in steps:
            inputs = {**inputs, **step({**in_use.PRINCIPLED_DEFAULTS, **values})}
        return shader, inputs
    return version


def no_darkening(sockets):
    return {"coat_darkening": 0.0}


def weight_of_dielectrics(sockets):
    return {"specular_weight": (1 - sockets["metallic"]) * 2 * sockets["specular_ior_level"] + sockets["metallic"]}


def ior_over_coat(sockets):
    weight = sockets["coat_weight"]
    return {"specular_ior": sockets["ior"] / (weight / sockets["coat_ior"] + 1 - weight)}


def metal_of_another_level(values):
    return values["metallic"] > 0 and values["specular_ior_level"] != 0.5


# The following functions concern the migration script of simulation assets.


PREVIEW_DEFAULTS = {"diffuseColor": (0.18,) * 3, "emissiveColor": (0.0,) * 3, "metallic": 0.0, "roughness": 0.5, "clearcoat": 0.0,
                    "clearcoatRoughness": 0.01, "ior": 1.5, "opacity": 1.0}


def migrated(values):
    """Converts like the script, which only reads UsdPreviewSurface. It has no row for clearcoat, and no luminance."""
    names = {new: old for new, old in in_use.OPEN_PBR_OF_USD.items() if not new.startswith("coat")}
    return shaders.model_shader(OPEN_PBR), in_use.copied(names, {**PREVIEW_DEFAULTS, **values})


def migrated_and_changed(values):
    """Runs the lines of the page on the script's result."""
    shader, inputs = migrated(values)
    lines = {}
    exec(block("simready-openpbr.md", "coat_and_emission"), lines)
    return shader, {**inputs, **lines["coat_and_emission"]({**PREVIEW_DEFAULTS, **values})}


def names_copied(values):
    return in_use.shader_and_values((USD, OPEN_PBR), values)


def metallic_workflow(values):
    return not values.get("useSpecularWorkflow")


def coated(values):
    return metallic_workflow(values) and values.get("clearcoat")


def changes_of(page, translations):
    """Returns the rows of a page."""
    def ours(direction):
        return lambda values: translations.version(direction, values)

    to_open_pbr, from_open_pbr, blender = (USD, OPEN_PBR), (OPEN_PBR, USD), (PRINCIPLED, OPEN_PBR)
    today, undarkened, both = exported(), exported(no_darkening), exported(no_darkening, weight_of_dielectrics)
    all_three = exported(no_darkening, weight_of_dielectrics, ior_over_coat)
    return {
        "blender-materialx.md": lambda: [
            Change("`coat_darkening` 0, with a coat", blender, today, undarkened, has("coat_weight")),
            Change("`coat_darkening` 0, all materials", blender, today, undarkened),
            Change("then `specular_weight` 1 on metals of another level", blender, undarkened, both, metal_of_another_level),
            Change("then `specular_ior` over the coat, with a coat", blender, both, all_three, has("coat_weight")),
            Change("all three, all materials", blender, today, all_three),
            Change("the full translation, all materials", blender, today, ours(blender))],
        "simready-openpbr.md": lambda: [
            Change("coat: script of today", to_open_pbr, migrated, migrated_and_changed, coated),
            Change("coat: copied by names, without the lines", to_open_pbr, names_copied, migrated_and_changed, coated),
            Change("emission", to_open_pbr, migrated, migrated_and_changed, materials=(LAMP,)),
            Change("metallic workflow", to_open_pbr, migrated, migrated_and_changed, metallic_workflow),
            Change("the full translation, both workflows", to_open_pbr, migrated, ours(to_open_pbr))],
        "materialx-coat.md": lambda: [
            *graph_changes("coat", words=", with a coat", concerns=has("coat", "coat_weight")),
            *graph_changes("coat", "anisotropy", "sheen", words=", all three changes")],
        "materialx-anisotropy.md": lambda: graph_changes(
            "anisotropy", words=", stretched, no coat", concerns=without_coat("specular_anisotropy", "specular_roughness_anisotropy")),
        "materialx-sheen.md": lambda: graph_changes("sheen", words=", with fuzz or sheen, no coat or metal",
                                                   concerns=fuzz_on_dielectric),
        "materialx-usd.md": lambda: [
            Change(f"{one[0]} to {one[1]}", one, in_use_of(one), ours(one))
            for one in (to_open_pbr, from_open_pbr, (OPEN_PBR, USD + "_specular"))]}[page]()


MORE = {"materialx-anisotropy.md": 3, "materialx-sheen.md": 5}  # factor for pages whose rows concern few materials
NAMES = ("blender-materialx.md", "simready-openpbr.md", *GRAPHS.values(), "materialx-usd.md")


def drawn(page, count):
    """Returns how many materials a page draws."""
    return count * MORE.get(page, 1)


class Measurement:
    """Measures the errors of random materials. Each picture is rendered only once."""

    def __init__(self, seed, count):
        self.seed, self.count, self.sources, self.found = seed, count, {}, {}

    def source(self, model, values):
        key = model, repr(values)
        if key not in self.sources:
            self.sources[key] = pictures.stage(model).under_both(pictures.shader_of(model), values)
        return self.sources[key]

    def error(self, direction, version, values):
        key = direction, version, repr(values)
        if key not in self.found:
            other = pictures.stage(direction[0]).under_both(*version(values))
            self.found[key] = pictures.errors(self.source(direction[0], values), other)["linear"]
        return self.found[key]

    def errors(self, change, version):
        """Returns the linear errors of the materials that a change concerns."""
        chosen = change.materials or [one for one in generator.materials(change.direction[0], self.seed, self.count)
                                      if change.concerns(one)]
        return np.array([self.error(change.direction, version, one) for one in chosen])

    def row(self, change):
        before, after = (self.errors(change, version) for version in (change.before, change.after))
        cells = [f"{one.mean():.3f} / {np.median(one):.3f}" for one in (before, after)]
        return f"| {change.words} | {before.size} | {cells[0]} | {cells[1]} |"


def rows_of(page, seed, count, translations):
    """Yields the lines of the table of a page."""
    yield "| change | materials | before | after |"
    yield "|---|---|---|---|"
    measurement = Measurement(seed, drawn(page, count))
    for change in changes_of(page, translations):
        yield measurement.row(change)


def record(page, lines):
    """Writes a table into its page."""
    path = PAGES / page
    text, count = re.subn(r"(<!-- measured: offer -->\n).*?(<!-- end -->)", lambda match: match[1] + "\n".join(lines) + "\n" + match[2],
                          path.read_text(), flags=re.DOTALL)
    if count != 1:
        raise shaders.Unusable(f"docs/adopting/{page}: has {count} places <!-- measured: offer --> ... <!-- end --> instead of one")
    path.write_text(text)
