"""Renders Cycles: the Glossy BSDF with all its distributions, and Principled, in the module `bpy` (Blender 5) and
Blender 3.4.

The sphere is a point cloud of one point, which Cycles intersects exactly. Other shapes are meshes. With any filter,
sample 0 of a pixel is its centre, so one sample is exact. An N x N grid is a larger picture that is averaged. The
masking function of GGX and Beckmann changed between 3.4 (separable) and 5.0 (height-correlated), so the prefix
contains the version. This file must not be named cycles.py, because Blender would load it as its own add-on.
"""
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy
import addon_utils  # available only after bpy is loaded
import numpy as np

from worker_loop import environment_of, grey_or_rgb, has_maps, parameter, serve

MODERN = bpy.app.version >= (4, 0, 0)
PREFIX = f"cycles-{bpy.app.version[0]}" if MODERN else "cycles-" + ".".join(map(str, bpy.app.version[:2]))
DISTRIBUTIONS = {"ggx": "GGX", "beckmann": "BECKMANN", "ashikhmin-shirley": "ASHIKHMIN_SHIRLEY",
                 "multiscatter-ggx": "MULTI_GGX"}

# Both versions treat smaller roughness as a mirror.
ROUGHNESS = parameter("roughness", "roughness", 0.02, 1, convention="roughness")
MODELS = [{"name": f"{PREFIX}/{name}", "textures": MODERN, "noise": name == "multiscatter-ggx" and not MODERN,
           "parameters": [ROUGHNESS, parameter("color", "specular", 0, 1), parameter("diffuse", "diffuse", 0, 1)]}
          for name in DISTRIBUTIONS]
MODELS += [
    {"name": f"{PREFIX}/principled-metal", "textures": MODERN, "parameters": [
        ROUGHNESS, parameter("base_color", "specular", 0, 1),
        parameter("specular", "other", 0, 1, default=0.5, grey=True)]},
    {"name": f"{PREFIX}/principled-dielectric", "textures": MODERN, "parameters": [
        ROUGHNESS, parameter("specular", "specular", 0, 1, grey=True),
        parameter("base_color", "diffuse", 0, 1)]},
]


def other(name, least, most, default, **more):
    return parameter(name, "other", least, most, default=default, **more)


# These are the inputs of the whole Principled BSDF with its default distribution, under the names of their sockets.
# Subsurface is missing, because it has noise. Transmission and alpha are missing, because they show what is behind
# the sphere.
if MODERN:
    MODELS.append({"name": f"{PREFIX}/principled-whole", "parameters": [
        ROUGHNESS, parameter("specular_ior_level", "specular", 0, 1, grey=True), parameter("base_color", "diffuse", 0, 1),
        other("metallic", 0, 1, 0, grey=True), other("ior", 1, 4, 1.5, grey=True), other("specular_tint", 0, 1, 1),
        other("diffuse_roughness", 0, 1, 0, grey=True), other("anisotropic", 0, 1, 0, grey=True),
        other("anisotropic_rotation", 0, 1, 0, grey=True), other("coat_weight", 0, 1, 0, grey=True),
        other("coat_roughness", 0, 1, 0.03, grey=True), other("coat_ior", 1, 4, 1.5, grey=True), other("coat_tint", 0, 1, 1),
        other("sheen_weight", 0, 1, 0, grey=True), other("sheen_roughness", 0, 1, 0.5, grey=True), other("sheen_tint", 0, 1, 1),
        other("emission_color", 0, 1, 1), other("emission_strength", 0, 1000, 0, grey=True),
        other("thin_film_thickness", 0, 100000, 0, grey=True), other("thin_film_ior", 1, 4, 1.33, grey=True)]})


def describe(threads):
    make_scene(threads)
    return {"renderer": f"Cycles of Blender {bpy.app.version_string}", "models": MODELS, "meshes": True}


def make_scene(threads):
    """Makes what all pictures share: settings, camera, light, the point of the sphere."""
    addon_utils.enable("cycles")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("cycles")
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device, cycles.samples = "CPU", 1
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    # With the default threshold, dim pixels are dropped at random.
    cycles.sample_clamp_direct = cycles.light_sampling_threshold = cycles.blur_glossy = cycles.max_bounces = 0
    cycles.pixel_filter_type, cycles.filter_width = "GAUSSIAN", 0.01
    render = scene.render
    render.use_persistent_data, render.resolution_percentage = True, 100
    # At least two threads are used, because with one thread and persistent data, TBB of Blender 5.0 keeps a core busy
    # between pictures.
    render.threads_mode, render.threads = "FIXED", max(threads, 2)
    image = render.image_settings
    image.file_format, image.color_depth, image.exr_codec = "OPEN_EXR", "32", "NONE"
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.sensor_fit = "HORIZONTAL"
    scene.collection.objects.link(camera)
    scene.camera = camera
    lamp = bpy.data.lights.new("lamp", "POINT")
    lamp.shadow_soft_size = 0
    scene.collection.objects.link(bpy.data.objects.new("lamp", lamp))
    material = bpy.data.materials.new("skin")
    material.use_nodes = True
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    render.film_transparent = True  # the environment lights the sphere, and is not seen beside it
    scene.collection.objects.link(one_point(material))


def one_point(material):
    """Makes a point cloud of one point with radius 1, by geometry nodes."""
    mesh = bpy.data.meshes.new("point")
    mesh.from_pydata([(0, 0, 0)], [], [])
    mesh.materials.append(material)
    ball = bpy.data.objects.new("ball", mesh)
    group = bpy.data.node_groups.new("sphere", "GeometryNodeTree")
    if MODERN:
        group.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
        group.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    else:
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
    start, end = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    point, skin = group.nodes.new("GeometryNodeMeshToPoints"), group.nodes.new("GeometryNodeSetMaterial")
    point.inputs["Radius"].default_value = 1
    skin.inputs["Material"].default_value = material
    group.links.new(start.outputs[0], point.inputs[0])
    group.links.new(point.outputs[0], skin.inputs[0])
    group.links.new(skin.outputs[0], end.inputs[0])
    ball.modifiers.new("sphere", "NODES").node_group = group
    return ball


def read_ply(path):
    """Returns points and triangles of a mesh file of the protocol: positions and normals as floats, then triangles.
    """
    with open(path, "rb") as file:
        head, body = file.read().split(b"end_header\n", 1)
    points, triangles = (int(line.split()[2]) for line in head.decode().splitlines() if line.startswith("element"))
    vertices = np.frombuffer(body, "<f4", points * 6).reshape(points, 6)
    faces = np.frombuffer(body, np.dtype([("count", "u1"), ("points", "<i4", 3)]), triangles, vertices.nbytes)
    return vertices[:, :3], faces["points"]


def show_shape(place):
    """Shows the sphere, or the mesh of another shape instead, with smooth shading."""
    scene = bpy.context.scene
    wanted = place.get("shape", "ball")
    if wanted not in scene.objects:
        points, triangles = read_ply(place["mesh"])
        mesh = bpy.data.meshes.new(wanted)
        mesh.from_pydata(points.tolist(), [], triangles.tolist())
        mesh.polygons.foreach_set("use_smooth", np.ones(len(triangles), bool))
        mesh.materials.append(bpy.data.materials["skin"])
        scene.collection.objects.link(bpy.data.objects.new(wanted, mesh))
    for thing in scene.objects:
        if thing.type == "MESH":
            thing.hide_render = thing.name != wanted


shader_of = {"model": None}


def shader(model):
    """Returns the nodes of a model. They are made again when the model changes."""
    if shader_of["model"] == model:
        return shader_of
    tree = bpy.data.materials["skin"].node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    kind = model.split("/")[1]
    shader_of.update(model=model, lobe=None, paint=None)
    if kind in DISTRIBUTIONS:
        glossy = "ShaderNodeBsdfAnisotropic" if MODERN else "ShaderNodeBsdfGlossy"
        lobe, paint = tree.nodes.new(glossy), tree.nodes.new("ShaderNodeBsdfDiffuse")
        lobe.distribution = DISTRIBUTIONS[kind]
        both = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(lobe.outputs[0], both.inputs[0])
        tree.links.new(paint.outputs[0], both.inputs[1])
        tree.links.new(both.outputs[0], output.inputs["Surface"])
        shader_of.update(lobe=lobe, paint=paint)
    else:
        lobe = tree.nodes.new("ShaderNodeBsdfPrincipled")
        lobe.distribution = "MULTI_GGX" if kind == "principled-whole" else "GGX"
        lobe.inputs["Metallic"].default_value = 1 if kind == "principled-metal" else 0
        tree.links.new(lobe.outputs[0], output.inputs["Surface"])
        shader_of.update(lobe=lobe)
        if kind == "principled-whole":
            link_tangent(tree, lobe)
    return shader_of


def link_tangent(tree, lobe):
    """Makes tangents that run from left to right. A point cloud has none, and anisotropic highlights would be black."""
    normal, cross = tree.nodes.new("ShaderNodeNewGeometry"), tree.nodes.new("ShaderNodeVectorMath")
    cross.operation = "CROSS_PRODUCT"
    cross.inputs[0].default_value = (0, 1, 0)
    tree.links.new(normal.outputs["Normal"], cross.inputs[1])
    tree.links.new(cross.outputs[0], lobe.inputs["Tangent"])


def rgba(values):
    return (*grey_or_rgb(values), 1)


def float_image(name, texels):
    """Makes an image of linear floats. Images of Blender begin with the lowest row."""
    height, width, channels = texels.shape
    image = bpy.data.images.new(name, width, height, float_buffer=True, is_data=True)
    pixels = np.ones((height, width, 4), np.float32)
    pixels[:, :, :3] = texels[::-1] if channels == 3 else np.repeat(texels[::-1], 3, axis=2)
    image.pixels.foreach_set(pixels.ravel())
    return image


def add_math(tree, operation, *inputs):
    """Adds a node that computes with numbers and outputs of other nodes. Returns its output."""
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = operation
    for socket, value in zip(node.inputs, inputs):
        if isinstance(value, (int, float)):
            socket.default_value = value
        else:
            tree.links.new(value, socket)
    return node.outputs[0]


def add_place(tree):
    """Adds the coordinates of the protocol's maps at a point of the sphere. Returns an output with the place in an image.
    """
    point, parts, place = (tree.nodes.new(kind) for kind in ("ShaderNodeNewGeometry", "ShaderNodeSeparateXYZ",
                                                             "ShaderNodeCombineXYZ"))
    tree.links.new(point.outputs["Position"], parts.inputs[0])
    x, y, z = parts.outputs
    across = add_math(tree, "ARCTAN2", x, z)
    up = add_math(tree, "ARCSINE", y)
    for turn, socket in zip((across, up), place.inputs):
        tree.links.new(add_math(tree, "MULTIPLY_ADD", turn, 1 / math.pi, 0.5), socket)
    return place.outputs[0]


def set_socket(socket, value):
    """Sets an input of the shader: a number, a color, or the texels of a map."""
    if not isinstance(value, np.ndarray):
        socket.default_value = rgba(value) if socket.type == "RGBA" else value[0]
        return
    tree = bpy.data.materials["skin"].node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image, node.interpolation, node.extension = float_image("map", value), "Linear", "EXTEND"
    if shader_of.get("place") is None:
        shader_of["place"] = add_place(tree)
    tree.links.new(shader_of["place"], node.inputs["Vector"])
    tree.links.new(node.outputs["Color"], socket)


def clear_maps():
    """Removes the images and nodes of the last picture with maps."""
    for image in [image for image in bpy.data.images if image.source == "GENERATED"]:
        bpy.data.images.remove(image)
    if shader_of.pop("place", None) is not None:
        shader_of["model"] = None


def set_world(environment):
    """Lights the sphere by an environment, or by nothing but the lamp. The middle column of Blender's map is +x, and its
    top row is +z."""
    world = bpy.context.scene.world
    tree = world.node_tree
    tree.nodes.clear()
    if environment is None:
        return
    here, parts, there, sky, shade, output = (
        tree.nodes.new("ShaderNode" + kind) for kind in ("TexCoord", "SeparateXYZ", "CombineXYZ", "TexEnvironment",
                                                         "Background", "OutputWorld"))
    sky.image = float_image("environment", environment)
    tree.links.new(here.outputs["Generated"], parts.inputs[0])
    for axis, sign, socket in zip("ZXY", (-1, -1, 1), there.inputs):
        tree.links.new(add_math(tree, "MULTIPLY", parts.outputs[axis], sign), socket)
    tree.links.new(there.outputs[0], sky.inputs["Vector"])
    tree.links.new(sky.outputs["Color"], shade.inputs["Color"])
    tree.links.new(shade.outputs[0], output.inputs["Surface"])
    world.cycles.sampling_method, world.cycles.sample_map_resolution = "MANUAL", 2048


def set_material(model, values):
    clear_maps()
    nodes = shader(model)
    inputs = nodes["lobe"].inputs
    if model.endswith("/principled-whole"):
        sockets = {socket.name.lower().replace(" ", "_"): socket for socket in inputs}
        for name, value in values.items():
            set_socket(sockets[name], value)
        return
    set_socket(inputs["Roughness"], values["roughness"])
    if nodes["paint"] is not None:
        set_socket(inputs["Color"], values["color"])
        set_socket(nodes["paint"].inputs["Color"], values["diffuse"])
        return
    set_socket(inputs["Base Color"], values["base_color"])
    set_socket(inputs["Specular IOR Level" if MODERN else "Specular"], values["specular"])


def read_exr(path, side):
    """Returns the picture of a file, row 0 at the top."""
    image = bpy.data.images.load(path)
    image.colorspace_settings.is_data = True
    pixels = np.empty(side * side * 4, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(side, side, 4)[::-1, :, :3]


def render(request, values):
    scene, place = bpy.context.scene, request["scene"]
    set_material(request["model"], values)
    show_shape(place)
    camera, lamp = scene.camera, scene.objects["lamp"]
    camera.location = (0, 0, place["camera"]["distance"])  # an unrotated camera looks along -z with +y up
    camera.data.angle = 2 * math.radians(place["camera"]["half_angle"])
    environment = environment_of(request)
    set_world(environment)
    scene.cycles.samples = place["light"].get("samples", 1)
    # Persistent data would show an old image if a new one has the same address.
    scene.render.use_persistent_data = environment is None and not has_maps(values)
    # Half of the light of an environment is found by one bounce, which cannot hit the sphere again.
    scene.cycles.max_bounces = 0 if environment is None else 1
    lamp.hide_render = environment is not None
    if environment is None:
        lamp.location = place["light"]["position"]
        lamp.data.energy = 4 * math.pi * place["light"]["intensity"]  # watts of a lamp that shines in all directions
    side, samples = place["resolution"], place["samples_per_axis"]
    scene.render.resolution_x = scene.render.resolution_y = side * samples
    scene.cycles.seed = request["seed"]
    path = request["image"] + ".exr"
    scene.render.filepath = path
    try:
        bpy.ops.render.render(write_still=True)
        picture = read_exr(path, side * samples)
    finally:
        if os.path.exists(path):
            os.remove(path)
    return picture.reshape(side, samples, side, samples, 3).mean(axis=(1, 3), dtype=np.float64)


serve(describe, render)
