"""Generates and compiles shaders of MaterialX, and renders them on a sphere without a window (EGL, llvmpipe,
float32).

A `Shader` is one of the four models (`model_shader`), or a surface node of a document. It renders any number of
directional and point lights in one pass: a light, or an environment of up to MOST_LIGHTS lights.

The generated pixel stage gets normals and positions from a vertex stage. Here, it computes them itself for each pixel
of a triangle that covers the picture, so the sphere is exact. fwidth then has neighbours, from which MaterialX
computes the curvature for subsurface.
"""
import dataclasses
import functools
import os
import re

os.environ.setdefault("LIBGL_ALWAYS_SOFTWARE", "1")  # pictures must not depend on the graphics card
os.environ.setdefault("LP_NUM_THREADS", "1")  # llvmpipe uses this many threads; pictures do not depend on them

import MaterialX as mx  # noqa: E402
import MaterialX.PyMaterialXGenGlsl as mx_glsl  # noqa: E402
import MaterialX.PyMaterialXGenShader as mx_shader  # noqa: E402
import moderngl  # noqa: E402
import numpy as np  # noqa: E402

MODELS = ("open_pbr_surface", "standard_surface", "gltf_pbr", "UsdPreviewSurface")
MOST_LIGHTS = 24
DIRECTIONAL, POINT = 1, 2

VERTEX = """#version 400
void main() { gl_Position = vec4(4.0 * float(gl_VertexID == 1) - 1.0, 4.0 * float(gl_VertexID == 2) - 1.0, 0.0, 1.0); }
"""

# This is inserted around the generated main. In it, a ray through the centre of the pixel meets the unit sphere.
SPHERE = """
uniform float remap_side;
uniform float remap_distance;  // of the camera, in radii
uniform float remap_tangent;   // of half the field of view; 0 is an orthographic camera
// Fills vd. Returns how far the ray is from the sphere: negative inside.
float remap_fill()
{
    vec2 place = 2.0 * gl_FragCoord.xy / remap_side - 1.0;
    float inside = 1.0 - dot(place, place);
    vec3 point = vec3(place, sqrt(max(inside, 0.0)));
    if (remap_tangent > 0.0)
    {
        vec3 to = vec3(place * remap_tangent, -1.0);
        float a = dot(to, to);
        inside = remap_distance * remap_distance - a * (remap_distance * remap_distance - 1.0);
        point = vec3(0.0, 0.0, remap_distance) + to * (remap_distance - sqrt(max(inside, 0.0))) / a;
    }
    vec3 normal = normalize(point);
    vec3 tangent = normalize(vec3(normal.z, 0.0, -normal.x));
    vec3 bitangent = cross(normal, tangent);
    vec2 texcoord = vec2(atan(normal.x, normal.z), asin(normal.y)) / vec2(6.28318531, 3.14159265) + 0.5;
    FILL
    return -inside;
}
"""
MAIN = """
void main()
{
    float outside = remap_fill();
    OUT = vec4(0.0);
    if (outside > 16.0 / remap_side) return;  // nothing there takes derivatives from here
    remap_main();
    if (outside > 0.0) OUT = vec4(0.0);
}
"""
FILLS = {"normalWorld": "normal", "normalObject": "normal", "tangentWorld": "tangent", "tangentObject": "tangent",
         "bitangentWorld": "bitangent", "bitangentObject": "bitangent", "positionWorld": "point", "positionObject": "point",
         "texcoord_0": "texcoord"}


class Unusable(Exception):
    """A document or a value cannot be rendered. The text says why."""


@dataclasses.dataclass(frozen=True)
class Light:
    """A light. `vector` is the direction towards a directional light, or the position of a point light."""
    kind: int
    vector: tuple
    color: tuple = (1.0, 1.0, 1.0)


def sun(angle, color=(1.0, 1.0, 1.0)):
    """Returns a directional light, turned by `angle` degrees to the right from the camera."""
    return Light(DIRECTIONAL, (float(np.sin(np.radians(angle))), 0.0, float(np.cos(np.radians(angle)))), color)


@dataclasses.dataclass(frozen=True)
class Camera:
    """A camera on the z axis looks at the origin. With a half angle of 0 degrees it is orthographic, and the sphere
    fills the picture."""
    distance: float = 1e5
    half_angle: float = 0.0


def search_path():
    return mx.getDefaultDataSearchPath()


@functools.cache
def libraries(own=None):
    """Returns the document with the standard libraries of MaterialX. The file `own` is read first, and the first
    definition of a name is kept."""
    document = read_xml(own) if own else mx.createDocument()
    standard = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), search_path(), standard)
    document.importLibrary(standard)
    return validated(document, own) if own else document


def read_xml(path):
    document = mx.createDocument()
    if not os.path.isfile(path):
        raise Unusable(f"{path}: no such file")
    try:
        mx.readFromXmlFile(document, mx.FilePath(str(path)))
    except Exception as failure:
        raise Unusable(f"{path}: cannot be read ({str(failure).strip()})") from None
    return document


def validated(document, path):
    valid, problem = document.validate()
    if not valid:
        raise Unusable(f"{path}: is not valid ({problem.strip().splitlines()[0]})")
    return document


def read_document(path):
    """Returns the document of a file, followed by the standard libraries. Raises Unusable if the file is missing or
    not valid."""
    document = read_xml(path)
    document.setDataLibrary(libraries())
    return validated(document, path)


def surface_nodes(document):
    """Returns pairs of a material's name and its surface shader node, for every material of the document."""
    pairs = []
    for material in document.getMaterialNodes():
        pairs += [(material.getName(), node) for node in mx.getShaderNodes(material, "surfaceshader")]
    return pairs


@functools.cache
def gl():
    try:
        return moderngl.create_context(standalone=True, backend="egl", require=400, libgl="libGL.so.1", libegl="libEGL.so.1")
    except Exception as failure:
        raise Unusable(f"OpenGL 4 by EGL is missing: {failure} (install libegl1 and libgl1)") from None


@functools.cache
def target(side):
    """Returns a framebuffer of `side` x `side` float pixels."""
    return gl().framebuffer([gl().texture((side, side), 4, dtype="f4")])


def generate(node):
    """Returns the GLSL pixel stage of a surface shader node."""
    document = node.getDocument()
    generator = mx_glsl.GlslShaderGenerator.create()
    context = mx_shader.GenContext(generator)
    context.registerSourceCodeSearchPath(search_path())
    options = context.getOptions()
    options.shaderInterfaceType = mx_shader.ShaderInterfaceType.SHADER_INTERFACE_COMPLETE
    options.hwSpecularEnvironmentMethod = mx_shader.HwSpecularEnvironmentMethod.SPECULAR_ENVIRONMENT_NONE
    options.hwMaxActiveLightSources = MOST_LIGHTS
    for number, light in ((DIRECTIONAL, "ND_directional_light"), (POINT, "ND_point_light")):
        mx_shader.HwShaderGenerator.bindLightShader(document.getNodeDef(light), number, context)
    try:
        return generator.generate("shader", node, context).getSourceCode("pixel")
    except Exception as failure:
        raise Unusable(f"{node.getNamePath()}: MaterialX generates no shader ({str(failure).strip()})") from None


def replace_once(text, old, new):
    """Replaces the only place that matches `old`. Raises Unusable if there is not exactly one, because another
    generator may write something else."""
    text, count = re.subn(old, lambda _: new, text, flags=re.DOTALL)
    if count != 1:
        raise Unusable(f"the generated shader has {count} places of `{old}` instead of one (another version of MaterialX?)")
    return text


def on_a_sphere(pixel_stage):
    """Returns the pixel stage with its own sphere, and with point lights that fall off with the square of the
    distance."""
    members = re.search(r"in VertexData\s*\{(.*?)\}\s*vd;", pixel_stage, re.DOTALL)[1]
    names = re.findall(r"(\w+);", members)
    unknown = [name for name in names if name not in FILLS]
    if unknown:
        raise Unusable(f"the shader needs {', '.join(unknown)}, which the sphere does not have")
    output = re.search(r"out vec4 (\w+);", pixel_stage)[1]
    text = replace_once(pixel_stage, r"in VertexData\s*\{.*?\}\s*vd;", f"struct VertexData {{{members}}};\nVertexData vd;")
    text = replace_once(text, r"float attenuation = pow\([^;]*;", "float attenuation = distance * distance;")
    if "u_refractionTwoSided" in text:
        text = text.replace("struct VertexData", "const bool u_refractionTwoSided = false;\nstruct VertexData", 1)
    fill = " ".join(f"vd.{name} = {FILLS[name]};" for name in names)
    text = replace_once(text, r"void main\(\)", SPHERE.replace("FILL", fill) + "void remap_main()")
    return text + MAIN.replace("OUT", output)


def definition_of(node):
    definition = node.getNodeDef()
    if definition is None:
        raise Unusable(f"{node.getNamePath()}: {node.getCategory()} is not a node that MaterialX knows")
    return definition


def input_types(node):
    return {one.getName(): one.getType() for one in definition_of(node).getActiveInputs()}


class Shader:
    """A compiled surface shader. Its values are the inputs of its node. For a chain of nodes they are the inputs
    of `entry`, the first node."""

    def __init__(self, node, entry=None):
        self.name = (entry or node).getCategory()
        self.definition = definition_of(entry or node)
        self.types = input_types(entry or node)
        self.prefix = entry.getName() + "_" if entry else ""
        try:
            self.program = gl().program(vertex_shader=VERTEX, fragment_shader=on_a_sphere(generate(node)))
        except moderngl.Error as failure:
            raise Unusable(f"{node.getNamePath()}: the shader does not compile: {failure}") from None
        self.vertices = gl().vertex_array(self.program, [])
        self.defaults = {name: self.program[self.prefix + name].value for name in self.types
                         if self.prefix + name in self.program}

    def set(self, name, value):
        if name in self.program:
            self.program[name].value = value

    def set_values(self, values):
        """Sets the inputs. Inputs that `values` lacks get the values of the node again."""
        unknown = set(values) - set(self.types)
        if unknown:
            raise Unusable(f"{self.name} has no input {', '.join(sorted(unknown))}")
        for name, default in self.defaults.items():
            self.set(self.prefix + name, uniform(self.types[name], values[name]) if name in values else default)

    def set_lights(self, lights):
        if len(lights) > MOST_LIGHTS:
            raise Unusable(f"{len(lights)} lights are too many (at most {MOST_LIGHTS})")
        self.set("u_numActiveLightSources", len(lights))
        for i, light in enumerate(lights):
            vector = np.asarray(light.vector, float)
            self.set(f"u_lightData[{i}].type", light.kind)
            self.set(f"u_lightData[{i}].intensity", 1.0)
            self.set(f"u_lightData[{i}].color", tuple(map(float, light.color)))
            if light.kind == DIRECTIONAL:
                self.set(f"u_lightData[{i}].direction", tuple((-vector / np.linalg.norm(vector)).tolist()))
            else:
                self.set(f"u_lightData[{i}].position", tuple(vector.tolist()))

    def render(self, values, lights, resolution, camera=Camera()):
        """Returns the linear radiance, resolution x resolution x 3, top row first. Pixels beside the sphere are 0."""
        self.set_values(values)
        self.set_lights(lights)
        self.set("u_viewPosition", (0.0, 0.0, float(camera.distance)))
        self.set("remap_side", float(resolution))
        self.set("remap_distance", float(camera.distance))
        self.set("remap_tangent", float(np.tan(np.radians(camera.half_angle))))
        frame = target(resolution)
        frame.use()
        self.vertices.render(moderngl.TRIANGLES, vertices=3)
        pixels = np.frombuffer(frame.read(components=3, dtype="f4"), np.float32)
        return pixels.reshape(resolution, resolution, 3)[::-1].astype(float)


def uniform(kind, value):
    """Returns a value of an input in the form that OpenGL needs."""
    if kind in ("color3", "vector3"):
        return tuple(np.broadcast_to(np.asarray(value, float), 3).tolist())
    number = float(np.asarray(value, float).reshape(()))
    return {"integer": int, "boolean": bool}.get(kind, float)(number)


@functools.cache
def model_shader(model):
    """Returns the shader of one of MODELS, with its defaults."""
    document = mx.createDocument()
    document.setDataLibrary(libraries())
    return Shader(document.addNode(model, "model", "surfaceshader"))


@functools.cache
def chain_shader(models, own=None):
    """Returns a shader that has the inputs of the first of `models` and shows the last one, by translations of
    MaterialX.

    Translations in the file `own` are preferred to the official ones.
    """
    document = mx.createDocument()
    document.setDataLibrary(libraries(own))
    nodes = []
    for source, model in zip(models, models[1:]):
        node = document.addNode(f"{source}_to_{model}", f"to_{model}", "multioutput")
        if node.getNodeDef() is None:
            raise Unusable(f"{own or 'MaterialX'} has no translation from {source} to {model}")
        connect(nodes[-1:], node)
        nodes.append(node)
    shader = document.addNode(model_of(models[-1]), "model", "surfaceshader")
    connect(nodes[-1:], shader)
    return Shader(shader, nodes[0])


def model_of(name):
    """Returns the model of a target. A translation may have a second form, such as UsdPreviewSurface_specular."""
    return name.removesuffix("_specular").removesuffix("_core")


def connect(sources, node):
    """Connects the outputs of a translation, NAME_out, to the inputs NAME of the next node."""
    for source in sources:
        outputs = {one.getName() for one in source.getNodeDef().getActiveOutputs()}
        for wanted in node.getNodeDef().getActiveInputs():
            if wanted.getName() + "_out" in outputs:
                taken = node.addInput(wanted.getName(), wanted.getType())
                taken.setNodeName(source.getName())
                taken.setOutputString(wanted.getName() + "_out")
