"""Tests MaterialX documents and glTF files by MaterialX' own validation, Khronos' validator, and closed forms."""

import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys

import numpy as np
import pytest

mx = pytest.importorskip("MaterialX")
oiio = pytest.importorskip("OpenImageIO")

from texremap import Error, materials, mtlx  # noqa: E402
from texremap._gltf import GltfReader  # noqa: E402
from texremap._mtlx import MtlxReader  # noqa: E402

SHARED = pathlib.Path(os.environ.get("REMAP_SHARED_DATA") or pathlib.Path(__file__).resolve().parents[4] / "shared/data")
VALIDATE = """
const {validateBytes} = require('gltf-validator'), fs = require('fs'), path = require('path');
const read = file => new Uint8Array(fs.readFileSync(file));
(async () => {
  for (const file of process.argv.slice(1)) {
    const beside = uri => Promise.resolve(read(path.resolve(path.dirname(file), decodeURIComponent(uri))));
    const report = await validateBytes(read(file), {uri: file, maxIssues: 0, externalResourceFunction: beside});
    for (const {severity, code, message, pointer} of report.issues.messages)
      if (severity < 2) console.log(`${path.basename(file)}: ${code}: ${message} ${pointer}`);
  }
})();
"""


def require_valid_gltf(*files):
    """Runs Khronos' validator, if node and the validator are installed."""
    if shutil.which("node") and subprocess.run(["node", "-e", "require('gltf-validator')"], capture_output=True).returncode == 0:
        done = subprocess.run(["node", "-e", VALIDATE, *map(str, files)], capture_output=True, text=True, check=True)
        assert done.stdout == ""


def png(path, values):
    values = np.ascontiguousarray(values, np.uint8)
    output = oiio.ImageOutput.create(str(path))
    spec = oiio.ImageSpec(values.shape[1], values.shape[0], values.shape[2], "uint8")
    spec.attribute("oiio:UnassociatedAlpha", 1)
    assert output.open(str(path), spec)
    assert output.write_image(values) and output.close()
    return values


def texels(path):
    image = oiio.ImageInput.open(str(path))
    return np.asarray(image.read_image("uint8")).reshape(image.spec().height, image.spec().width, -1)


def linear(values):
    values = values / 255.0
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def document(path, *surfaces, body=""):
    """Returns a MaterialX document. A surface is (name, model, inputs).

    An input is a value, or the output of the graph NG.
    """
    text = ""
    for name, model, inputs in surfaces:
        text += f'<{model} name="{name}_s" type="surfaceshader">'
        for word, value in inputs.items():
            default = materials.MODELS[model].get(word)
            kind = "color3" if isinstance(default, tuple) else "vector3" if default is None else "float"
            given = f'nodegraph="NG" output="{value}"' if isinstance(value, str) else f'value="{", ".join(map(str, np.ravel(value)))}"'
            text += f'<input name="{word}" type="{kind}" {given}/>'
        text += f'</{model}><surfacematerial name="{name}" type="material"><input name="surfaceshader" type="surfaceshader" '
        text += f'nodename="{name}_s"/></surfacematerial>'
    path.write_text(f'<?xml version="1.0"?><materialx version="1.39" colorspace="lin_rec709">{body}{text}</materialx>')
    return path


GRAPH = """<nodegraph name="NG">
<image name="i1" type="color3"><input name="file" type="filename" value="color.png" colorspace="srgb_texture"/></image>
<image name="i2" type="vector3"><input name="file" type="filename" value="orm.png"/></image>
<image name="i3" type="vector3"><input name="file" type="filename" value="normal.png"/></image>
<image name="i4" type="float"><input name="file" type="filename" value="grey.png"/></image>
<separate3 name="s" type="multioutput"><input name="in" type="vector3" nodename="i2"/></separate3>
<normalmap name="n" type="vector3"><input name="in" type="vector3" nodename="i3"/><input name="scale" type="float" value="0.5"/></normalmap>
<multiply name="halved" type="color3"><input name="in1" type="color3" nodename="i1"/><input name="in2" type="float" value="0.5"/></multiply>
<fractal3d name="fractal" type="float"/>
<output name="color" type="color3" nodename="i1"/><output name="half" type="color3" nodename="halved"/>
<output name="rough" type="float" nodename="s" output="outy"/><output name="metal" type="float" nodename="s" output="outz"/>
<output name="normal" type="vector3" nodename="n"/><output name="grey" type="float" nodename="i4"/>
<output name="noise" type="float" nodename="fractal"/></nodegraph>"""


@pytest.fixture
def maps(tmp_path):
    random = np.random.default_rng(5)
    return {name: png(tmp_path / f"{name}.png", random.integers(20, 236, (6, 8, channels)))
            for name, channels in (("color", 3), ("orm", 3), ("normal", 3), ("grey", 1))}


def glb(path):
    data = path.read_bytes()
    magic, version, length, size, _ = struct.unpack_from("<5I", data)
    assert (magic, version, length) == (0x46546C67, 2, len(data))
    return json.loads(data[20:20 + size]), data[28 + size:]


def image_of(path, info, folder):
    """Returns the texels of the image that a texture of a GLB file uses."""
    content, binary = glb(path)
    image = content["images"][content["textures"][info["index"]]["source"]]
    view = content["bufferViews"][image["bufferView"]]
    file = folder / "extracted.png"
    file.write_bytes(binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]])
    return texels(file)


def values_of(reader):
    return {reader.name_of(index): reader.surface(index).sources for index in range(len(reader.materials))}


def reports_of(*words, **options):
    return {report.path: report for report in mtlx.convert(*words, **options)}


def close(found, expected, names=None, tolerance=2e-6):
    for name in names or expected:
        wanted = np.ravel(expected[name])
        assert np.abs(np.ravel(found[name]) - wanted).max() <= tolerance * max(1, np.abs(wanted).max()), (name, found[name], wanted)


def test_values_are_those_of_the_translations(tmp_path):
    given = {"base_color": (0.1, 0.6, 0.9), "coat_weight": 0.7, "coat_roughness": 0.2, "fuzz_weight": 0.5, "fuzz_roughness": 0.6,
             "specular_ior": 1.7, "specular_roughness_anisotropy": 0.5, "emission_luminance": 3.0, "emission_color": (1.0, 0.5, 0.2),
             "transmission_weight": 0.4, "transmission_depth": 2.0, "thin_film_weight": 0.5, "geometry_opacity": 0.5}
    source = document(tmp_path / "paint.mtlx", ("paint", "open_pbr_surface", given), ("plain", "open_pbr_surface", {}))
    mtlx.convert(source, tmp_path / "paint.glb", to="gltf")
    require_valid_gltf(tmp_path / "paint.glb")
    content, _ = glb(tmp_path / "paint.glb")
    assert [material["name"] for material in content["materials"]] == ["paint", "plain"]
    assert {"KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_ior", "KHR_materials_anisotropy", "KHR_materials_volume",
            "KHR_materials_transmission", "KHR_materials_emissive_strength", "KHR_materials_iridescence",
            "KHR_materials_specular"} == set(content["extensionsUsed"])
    assert "extensions" not in content["materials"][1]
    found = values_of(GltfReader(str(tmp_path / "paint.glb"), str(tmp_path)))["paint"]
    expected = materials.TRANSLATIONS["open_pbr_surface", "gltf_pbr"](given)
    glow = [np.ravel(of["emissive"]) * np.ravel(of["emissive_strength"]) for of in (found, expected)]
    assert np.abs(glow[0] - glow[1]).max() < 1e-5
    close(found, expected, [name for name in expected if not name.startswith("emissive")])


def test_round_trip_of_what_both_models_hold(tmp_path):
    surfaces = [("metal", {"base_metalness": 1.0, "base_color": (0.9, 0.5, 0.2), "specular_roughness": 0.4}),
                ("brushed", {"base_metalness": 1.0, "specular_roughness": 0.35, "specular_roughness_anisotropy": 0.6}),
                ("plastic", {"base_color": (0.2, 0.3, 0.4), "specular_ior": 1.7, "specular_roughness": 0.2}),
                ("lamp", {"emission_luminance": 40.0, "emission_color": (1.0, 0.5, 0.25)}),
                ("glass", {"transmission_weight": 1.0, "specular_roughness": 0.1, "specular_ior": 1.4}),
                ("leaf", {"geometry_opacity": 0.25}),
                ("bubble", {"thin_film_weight": 1.0, "thin_film_thickness": 0.3, "thin_film_ior": 1.33})]
    source = document(tmp_path / "in.mtlx", *((name, "open_pbr_surface", values) for name, values in surfaces))
    mtlx.convert(source, tmp_path / "there.gltf", to="gltf")
    reports = mtlx.convert(tmp_path / "there.gltf", tmp_path / "back.mtlx", to="openpbr")
    assert all(report.state == "converted" and not report.lost for report in reports)
    require_valid_gltf(tmp_path / "there.gltf")
    found = values_of(MtlxReader(str(tmp_path / "back.mtlx"), str(tmp_path)))
    for name, values in surfaces:
        shown = {word: found[name][word] for word in materials.MODELS["open_pbr_surface"]
                 if not word.startswith(("coat_", "emission_")) or name == "lamp"}
        # Clear glass has the color of its base.
        ignored = {"coat_ior", "coat_darkening"} | ({"transmission_color"} if name == "glass" else set())
        expected = {**materials.MODELS["open_pbr_surface"], **values}
        if name == "lamp":
            close({"light": np.array(shown["emission_color"]) * shown["emission_luminance"][0]},
                  {"light": np.array(values["emission_color"]) * values["emission_luminance"]}, tolerance=1e-5)
        close(shown, expected, [word for word in shown if word not in ignored and not word.startswith("emission_")], 2e-4)


@pytest.mark.parametrize("to, model", [("openpbr", "open_pbr_surface"), ("standard-surface", "standard_surface"), ("gltf", "gltf_pbr")])
def test_documents_become_documents(tmp_path, maps, to, model):
    given = {"base_color": "color", "metalness": "metal", "specular_roughness": 0.4, "coat": 0.5, "normal": "normal"}
    source = document(tmp_path / "in.mtlx", ("paint", "standard_surface", given), body=GRAPH)
    [report] = mtlx.convert(source, tmp_path / "out.mtlx", to=to)
    assert report.state == "converted", report.reason
    result = mx.createDocument()
    mx.readFromXmlFile(result, str(tmp_path / "out.mtlx"))
    library = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), library)
    result.setDataLibrary(library)
    valid, reason = result.validate()
    assert valid, reason
    [material] = result.getMaterialNodes()
    [shader] = mx.getShaderNodes(material)
    assert (material.getName(), shader.getCategory()) == ("paint", model)
    reader = MtlxReader(str(tmp_path / "out.mtlx"), str(tmp_path))
    surface = reader.surface(0)
    if to == "standard-surface":
        assert surface == MtlxReader(str(source), str(tmp_path)).surface(0)._replace(lost=surface.lost) and not report.textures
    else:
        hub = materials.TRANSLATIONS["standard_surface", "open_pbr_surface"]
        values = {"coat": 0.5, "specular_roughness": 0.4, "base_color": linear(maps["color"]), "metalness": maps["orm"][..., 2:] / 255}
        expected = hub(values) if to == "openpbr" else materials.TRANSLATIONS["open_pbr_surface", "gltf_pbr"](hub(values))
        for name, source_of in surface.sources.items():
            if hasattr(source_of, "path"):
                found = texels(source_of.path)
                found = (linear(found) if source_of.space == "sRGB" else found / 255)[..., :3]
                first, count = ("rgba".find(source_of.channels), 1) if source_of.channels != "rgb" else (0, 3)
                found = source_of.values_of(found[..., first:first + count])
                assert np.abs(found - expected[name]).max() < 0.01 * max(1, np.max(source_of.scale)), name
    assert np.allclose(surface.normals["normal"].scale, (1, 1, 2)) and np.allclose(surface.normals["normal"].bias, (-0.5, -0.5, -1))


def test_textures_stay_where_gltf_can_say_it(tmp_path, maps):
    given = {"base_color": "half", "base_metalness": "metal", "specular_roughness": "rough", "geometry_normal": "normal"}
    source = document(tmp_path / "in.mtlx", ("paint", "open_pbr_surface", given), body=GRAPH)
    [report] = mtlx.convert(source, tmp_path / "out.gltf", to="gltf")
    assert report.textures == () and report.lost == ()
    require_valid_gltf(tmp_path / "out.gltf")
    content = json.loads((tmp_path / "out.gltf").read_text())
    assert [image["uri"] for image in content["images"]] == ["color.png", "orm.png", "normal.png"]
    [material] = content["materials"]
    assert material["pbrMetallicRoughness"]["baseColorFactor"] == [0.5, 0.5, 0.5, 1] and material["normalTexture"]["scale"] == 0.5
    assert sorted(os.listdir(tmp_path)) == ["color.png", "grey.png", "in.mtlx", "normal.png", "orm.png", "out.gltf"]
    mtlx.convert(source, tmp_path / "out.glb", to="gltf")
    assert (image_of(tmp_path / "out.glb", {"index": 1}, tmp_path) == maps["orm"]).all()
    # Textures outside of the folder of the result are copied into it.
    mtlx.convert(source, tmp_path / "sub" / "out.gltf", to="gltf")
    require_valid_gltf(tmp_path / "sub" / "out.gltf")
    assert sorted(os.listdir(tmp_path / "sub" / "out_textures")) == ["color.png", "normal.png", "orm.png"]
    [report] = mtlx.convert(tmp_path / "sub" / "out.gltf", tmp_path / "sub" / "back.mtlx", to="openpbr")
    assert report.state == "converted" and report.textures == ()


def test_other_textures_are_packed(tmp_path, maps):
    given = {"base_color": "color", "specular_roughness": "grey", "base_metalness": 1.0, "coat_weight": 1.0, "coat_roughness": 0.2,
             "fuzz_weight": 0.3, "fuzz_roughness": "grey"}
    source = document(tmp_path / "in.mtlx", ("paint", "open_pbr_surface", given), body=GRAPH)
    [report] = mtlx.convert(source, tmp_path / "out.glb", to="gltf")
    assert report.state == "converted" and report.lost == (), report
    require_valid_gltf(tmp_path / "out.glb")
    grey, color = maps["grey"] / 255, linear(maps["color"])
    expected = materials.TRANSLATIONS["open_pbr_surface", "gltf_pbr"](
        {**{name: value for name, value in given.items() if not isinstance(value, str)}, "base_color": color,
         "specular_roughness": grey, "fuzz_roughness": grey})
    content, _ = glb(tmp_path / "out.glb")
    [material] = content["materials"]
    pbr, sheen = material["pbrMetallicRoughness"], material["extensions"]["KHR_materials_sheen"]
    packed = image_of(tmp_path / "out.glb", pbr["metallicRoughnessTexture"], tmp_path)
    assert np.abs(packed[..., 1:2] / 255 - expected["roughness"]).max() <= 0.5 / 255 + 1e-6 and (packed[..., 2] == 255).all()
    base = image_of(tmp_path / "out.glb", pbr["baseColorTexture"], tmp_path)
    assert np.abs(linear(base) - expected["base_color"]).max() < 0.005
    alpha = image_of(tmp_path / "out.glb", sheen["sheenRoughnessTexture"], tmp_path)
    assert np.abs(alpha[..., 3:] / 255 - expected["sheen_roughness"]).max() <= 0.5 / 255 + 1e-6


def test_transforms_of_textures_are_those_of_the_specification(tmp_path, maps):
    offset, rotation, scale = (0.3, -0.2), 0.7, (2.0, 3.0)
    transform = {"offset": offset, "rotation": rotation, "scale": scale, "texCoord": 1}
    content = {"asset": {"version": "2.0"}, "images": [{"uri": "color.png"}], "samplers": [{"wrapS": 33071, "wrapT": 33648}],
               "textures": [{"source": 0, "sampler": 0}], "extensionsUsed": ["KHR_texture_transform"],
               "materials": [{"pbrMetallicRoughness": {
                   "baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform": transform}}, "metallicFactor": 0}}]}
    (tmp_path / "in.gltf").write_text(json.dumps(content))
    mtlx.convert(tmp_path / "in.gltf", tmp_path / "out.mtlx", to="openpbr")
    texture = MtlxReader(str(tmp_path / "out.mtlx"), str(tmp_path)).surface(0).sources["base_color"]
    assert texture.wrap == ("clamp", "mirror") and texture.place.primvar == "st1"
    # KHR_texture_transform is translation * rotation * scale, with v downwards. UsdTransform2d scales, rotates and
    # translates, with v upwards.
    c, s = math.cos(rotation), math.sin(rotation)
    for u, v in np.random.default_rng(1).random((5, 2)):
        x, y = u * scale[0], v * scale[1]
        expected = (c * x + s * y + offset[0], -s * x + c * y + offset[1])
        c2, s2 = math.cos(math.radians(texture.place.rotation)), math.sin(math.radians(texture.place.rotation))
        x, y = u * texture.place.scale[0], (1 - v) * texture.place.scale[1]
        found = (c2 * x - s2 * y + texture.place.translation[0], s2 * x + c2 * y + texture.place.translation[1])
        assert np.allclose((found[0], 1 - found[1]), expected, atol=1e-5)
    mtlx.convert(tmp_path / "out.mtlx", tmp_path / "again.gltf", to="gltf")
    require_valid_gltf(tmp_path / "again.gltf")
    again = json.loads((tmp_path / "again.gltf").read_text())
    info = again["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]
    assert info["texCoord"] == 1 and again["samplers"] == content["samplers"]
    for word, value in info["extensions"]["KHR_texture_transform"].items():
        assert np.allclose(value, transform[word], atol=1e-6), word


def test_nodes_of_gltf_images_have_the_same_transforms(tmp_path, maps):
    """MaterialX' own node of glTF images, and what texremap reads from glTF."""
    body = """<gltf_colorimage name="image" type="multioutput">
<input name="file" type="filename" value="color.png" colorspace="srgb_texture"/><input name="scale" type="vector2" value="2, 3"/><input name="rotate" type="float" value="40"/>
<input name="offset" type="vector2" value="0.3, -0.2"/><input name="color" type="color4" value="0.5, 0.5, 1, 0.25"/></gltf_colorimage>
<gltf_pbr name="s" type="surfaceshader"><input name="base_color" type="color3" nodename="image" output="outcolor"/>
<input name="alpha" type="float" nodename="image" output="outa"/><input name="alpha_mode" type="integer" value="2"/></gltf_pbr>
<surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>"""
    source = document(tmp_path / "in.mtlx", body=body)
    mtlx.convert(source, tmp_path / "out.gltf", to="gltf")
    pbr = json.loads((tmp_path / "out.gltf").read_text())["materials"][0]["pbrMetallicRoughness"]
    transform = pbr["baseColorTexture"]["extensions"]["KHR_texture_transform"]
    assert np.allclose(transform["offset"], (0.3, -0.2)) and np.allclose(transform["scale"], (2, 3))
    assert math.isclose(transform["rotation"], math.radians(40), rel_tol=1e-6) and pbr["baseColorFactor"] == [0.5, 0.5, 1, 0.25]


def test_place2d_is_that_of_material_x(tmp_path, maps):
    """NG_place2d_vector2: subtract the pivot, divide by the scale, rotate clockwise, subtract the offset, add the pivot."""
    body = """<texcoord name="t" type="vector2"/><place2d name="p" type="vector2"><input name="texcoord" type="vector2" nodename="t"/>
<input name="pivot" type="vector2" value="0.5, 0.25"/><input name="scale" type="vector2" value="0.5, 2"/>
<input name="rotate" type="float" value="30"/><input name="offset" type="vector2" value="0.1, -0.3"/></place2d>
<image name="i" type="color3"><input name="file" type="filename" value="color.png"/>
<input name="texcoord" type="vector2" nodename="p"/></image>
<open_pbr_surface name="s" type="surfaceshader"><input name="base_color" type="color3" nodename="i"/></open_pbr_surface>"""
    place = MtlxReader(str(document(tmp_path / "in.mtlx", body=body)), str(tmp_path)).surface(0).sources["base_color"].place
    pivot, c, s = np.array((0.5, 0.25)), math.cos(math.radians(30)), math.sin(math.radians(30))
    c2, s2 = math.cos(math.radians(place.rotation)), math.sin(math.radians(place.rotation))
    for uv in np.random.default_rng(1).random((5, 2)):
        expected = np.array([[c, s], [-s, c]]) @ ((uv - pivot) / (0.5, 2)) - (0.1, -0.3) + pivot
        found = np.array([[c2, -s2], [s2, c2]]) @ (uv * place.scale) + place.translation
        assert np.allclose(found, expected, atol=1e-6)


def test_looks_are_kept(tmp_path):
    look = '<look name="all"><materialassign name="a" geom="/cup" material="paint"/></look>'
    source = document(tmp_path / "in.mtlx", ("paint", "open_pbr_surface", {}), body=look)
    mtlx.convert(source, tmp_path / "out.mtlx", to="standard-surface")
    [assign] = MtlxReader(str(tmp_path / "out.mtlx"), str(tmp_path)).document.getLook("all").getMaterialAssigns()
    assert (assign.getMaterial(), assign.getGeom()) == ("paint", "/cup")


def test_images_of_glb_files_become_files(tmp_path, maps):
    source = document(tmp_path / "in.mtlx", ("paint", "open_pbr_surface", {"base_color": "color", "coat_weight": "grey"}), body=GRAPH)
    mtlx.convert(source, tmp_path / "there.glb", to="gltf")
    (tmp_path / "sub").mkdir()
    [report] = mtlx.convert(tmp_path / "there.glb", tmp_path / "sub" / "out.mtlx", to="openpbr")
    assert report.state == "converted"
    surface = MtlxReader(str(tmp_path / "sub" / "out.mtlx"), str(tmp_path)).surface(0)
    for name in ("base_color", "coat_weight"):
        assert os.path.realpath(surface.sources[name].path).startswith(str(tmp_path / "sub" / "out_textures")), name
        assert os.path.isfile(surface.sources[name].path)
    assert not list(tmp_path.rglob(".unfinished*"))


def test_losses_are_named(tmp_path, maps):
    given = {"base_color": "color", "specular_roughness": "noise", "base_diffuse_roughness": 0.5, "subsurface_weight": 0.5,
             "subsurface_radius": 0.1, "transmission_scatter": (0.1, 0.1, 0.1), "specular_ior": "grey"}
    source = document(tmp_path / "in.mtlx", ("paint", "open_pbr_surface", given), body=GRAPH)
    [report] = mtlx.convert(source, tmp_path / "out.glb", to="gltf")
    lost = {words.split(":")[0] for words in report.lost}
    assert lost == {"specular_roughness", "base_diffuse_roughness", "subsurface_radius", "ior"}
    assert any(words.startswith("specular_roughness: comes from NG/fractal.out (fractal3d)") for words in report.lost)
    # The second step, from OpenPBR to glTF, loses base_diffuse_roughness.
    source = document(tmp_path / "two.mtlx", ("cloth", "standard_surface", {"diffuse_roughness": 0.5, "specular_rotation": 0.2}))
    [report] = mtlx.convert(source, tmp_path / "two.glb", to="gltf")
    assert report.lost == ("base_diffuse_roughness",)


def triangle(material, **more):
    """Returns a glTF document with a triangle."""
    data = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32).tobytes()
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}], "materials": [material],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "mesh.bin"}], **more}, data


@pytest.mark.parametrize("importer", ["core", "godot"])
@pytest.mark.parametrize("ending", ["glb", "gltf"])
def test_what_an_importer_ignores_is_folded(tmp_path, importer, ending):
    given = {"name": "paint", "doubleSided": True, "extras": {"id": 7}, "emissiveFactor": [1, 0.5, 0],
             "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.1, 0.1, 1], "metallicFactor": 0, "roughnessFactor": 0.6},
             "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.2},
                            "KHR_materials_emissive_strength": {"emissiveStrength": 5}}}
    content, data = triangle(given, extensionsUsed=["KHR_materials_clearcoat", "KHR_materials_emissive_strength"])
    (tmp_path / "in.gltf").write_text(json.dumps(content))
    (tmp_path / "mesh.bin").write_bytes(data)
    output = tmp_path / f"out.{ending}"
    [report] = mtlx.convert(tmp_path / "in.gltf", output, to="gltf", importer=importer)
    require_valid_gltf(output)
    result = glb(output)[0] if ending == "glb" else json.loads(output.read_text())
    assert result["meshes"] == content["meshes"] and result["accessors"] == content["accessors"]
    if ending == "glb":
        assert glb(output)[1][:36] == data
    [material] = result["materials"]
    assert material["doubleSided"] and material["extras"] == {"id": 7} and material["name"] == "paint"
    used = {"KHR_materials_emissive_strength"} if importer == "godot" else set()
    assert set(result.get("extensionsUsed", ())) == used == set(material.get("extensions", {}))
    assert report.lost == (() if importer == "godot" else ("emissive: is brighter than 1",))
    expected = materials.TRANSLATIONS["gltf_pbr", "gltf_pbr_core"]({
        "base_color": (0.5, 0.1, 0.1), "metallic": 0, "roughness": 0.6, "clearcoat": 1, "clearcoat_roughness": 0.2})
    pbr = material["pbrMetallicRoughness"]
    assert np.allclose(pbr["baseColorFactor"][:3], expected["base_color"], atol=1e-6)
    assert math.isclose(pbr["roughnessFactor"], expected["roughness"], rel_tol=1e-6)


def test_files_that_the_source_reads_are_not_replaced(tmp_path):
    coated = {"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}}}
    content, data = triangle(coated, extensionsUsed=["KHR_materials_clearcoat"])
    (tmp_path / "in.gltf").write_text(json.dumps(content))
    (tmp_path / "mesh.bin").write_bytes(data)
    (tmp_path / "other.bin").write_bytes(b"mine")
    for name, force, message in (("mesh", True, "is read by"), ("other", False, "exists")):
        with pytest.raises(Error, match=message):
            mtlx.convert(tmp_path / "in.gltf", tmp_path / f"{name}.gltf", to="gltf", importer="core", force=force)
    assert (tmp_path / "mesh.bin").read_bytes() == data and (tmp_path / "other.bin").read_bytes() == b"mine"
    assert len(os.listdir(tmp_path)) == 3


def test_materials_that_an_importer_reads_stay(tmp_path):
    content, data = triangle({"name": "plain", "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2}}})
    (tmp_path / "in.gltf").write_text(json.dumps(content))
    (tmp_path / "mesh.bin").write_bytes(data)
    [report] = mtlx.convert(tmp_path / "in.gltf", tmp_path / "out.glb", to="gltf", importer="godot")
    assert (report.state, report.reason) == ("left", "the importer reads all of it")
    assert glb(tmp_path / "out.glb")[0]["materials"] == content["materials"]


def test_core_materials_stay_as_they_are():
    fold = materials.TRANSLATIONS["gltf_pbr", "gltf_pbr_core"]
    random = np.random.default_rng(3)
    for metallic in (0.0, 0.3, 1.0):
        given = {"base_color": random.uniform(0, 1, (50, 3)) ** 2, "metallic": np.full((50, 1), metallic),
                 "roughness": random.uniform(0.05, 1, (50, 1))}
        found = fold(given)
        for name, value in given.items():
            assert np.abs(found[name] - value).max() < 1e-9, name


EXAMPLES = sorted((SHARED / "materialx").glob("*.mtlx"))


@pytest.mark.skipif(not EXAMPLES, reason="the example documents of MaterialX are not there (REMAP_SHARED_DATA)")
def test_example_documents(tmp_path):
    made = []
    for file in EXAMPLES:
        reports = mtlx.convert(file, tmp_path / f"{file.stem}.glb", to="gltf")
        for report in reports:
            # The images of the examples are not part of them.
            assert report.state == "converted" or "disney_principled" in report.reason or "file not found" in report.reason, report
        if any(report.state == "converted" for report in reports):
            made.append(tmp_path / f"{file.stem}.glb")
            back = mtlx.convert(made[-1], tmp_path / f"{file.stem}_back.mtlx", to="openpbr")
            assert all(report.state == "converted" for report in back)
            MtlxReader(str(tmp_path / f"{file.stem}_back.mtlx"), str(tmp_path))  # validates
    assert len(made) > 30
    require_valid_gltf(*made)


def bad_gltf(**changes):
    return json.dumps({"asset": {"version": "2.0"}, "materials": [{"name": "paint", **changes}]})


TEXTURED = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}


@pytest.mark.parametrize("name, text, message", [
    ("a.mtlx", "hello", "a.mtlx: cannot be read: "),
    ("a.mtlx", '<?xml version="1.0"?><materialx version="1.39"><foo name="x" type="surfaceshader"><input name="y" type="float" '
     'nodename="z"/></foo></materialx>', "a.mtlx: is not valid MaterialX: "),
    ("a.mtlx", '<?xml version="1.0"?><materialx version="1.39"><open_pbr_surface name="x" type="surfaceshader"><input '
     'name="coat_weight" type="float" value="nan"/></open_pbr_surface></materialx>', "a.mtlx: is not valid MaterialX: "),
    ("a.mtlx", '<?xml version="1.0"?><materialx version="1.39"></materialx>', "a.mtlx: has no materials"),
    ("a.mtlx", '<?xml version="1.0"?><materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href="a.mtlx"/>'
     "</materialx>", "a.mtlx: cannot be read: "),
    ("a.gltf", "hello", "a.gltf: cannot be read: "),
    ("a.gltf", "", "a.gltf: cannot be read: "),
    ("a.gltf", "[" * 100000, "a.gltf: cannot be read: "),
    ("a.gltf", "[]", "a.gltf: is not glTF 2.0"),
    ("a.gltf", '{"asset": {"version": "1.0"}}', "a.gltf: is not glTF 2.0"),
    ("a.gltf", '{"asset": {"version": "2.0"}, "materials": 5}', "a.gltf: materials is not a list"),
    ("a.gltf", '{"asset": {"version": "2.0"}, "x": NaN}', "a.gltf: NaN is not JSON"),
    ("a.gltf", '{"asset": {"version": "2.0"}, "materials": [{}], "textures": [5]}', "a.gltf: textures is not a list of objects"),
    ("a.gltf", '{"asset": {"version": "2.0"}, "materials": [{}], "extensionsUsed": [[]]}', "a.gltf: extensionsUsed is not a list of names"),
    ("a.glb", "glTF", "a.glb: is cut off"),
    ("a.png", "hello", "a.png: is not a .mtlx, .glb or .gltf file"),
])
def test_files_that_cannot_be_read_are_refused(tmp_path, name, text, message):
    (tmp_path / name).write_text(text)
    with pytest.raises(Error) as failure:
        mtlx.convert(tmp_path / name, tmp_path / "out.mtlx", to="openpbr")
    assert message in str(failure.value) and "\n" not in str(failure.value)
    assert os.listdir(tmp_path) == [name]


@pytest.mark.parametrize("text, message", [
    (bad_gltf(pbrMetallicRoughness={"metallicFactor": "1"}), "pbrMetallicRoughness.metallicFactor: is not a number"),
    (bad_gltf(pbrMetallicRoughness={"baseColorFactor": [1, 1]}), "baseColorFactor: is not a list of 4 numbers"),
    (bad_gltf(pbrMetallicRoughness={"metallicFactor": 1e300}), "metallicFactor: is not a number"),
    (bad_gltf(**TEXTURED), "baseColorTexture: textures[0] does not exist"),
    (bad_gltf(alphaMode="SOME"), "alphaMode: SOME is not a mode"),
    (json.dumps({**json.loads(bad_gltf(**TEXTURED)), "textures": [{"source": 0}], "images": [{"uri": "none.png"}]}),
     "baseColorTexture: none.png: file not found"),
    (json.dumps({**json.loads(bad_gltf(**TEXTURED)), "textures": [{"source": 0}], "images": [{"uri": "../color.png"}]}),
     "baseColorTexture: ../color.png: leads out of the folder"),
    (json.dumps({**json.loads(bad_gltf(**TEXTURED)), "textures": [{"source": 0}], "images": [{"uri": "%2e%2e/color.png"}]}),
     "leads out of the folder"),
    (json.dumps({**json.loads(bad_gltf(**TEXTURED)), "textures": [{"source": 0}], "images": [{"uri": "link.png"}]}),
     "leads out of the folder"),
    (json.dumps({**json.loads(bad_gltf(**TEXTURED)), "textures": [{"source": 0}], "images": [{"uri": "file:///etc/hostname"}]}),
     "is not a file beside the document"),
    (json.dumps({**json.loads(bad_gltf(**TEXTURED)), "textures": [{"source": 0}], "images": [{"bufferView": 0}],
                 "bufferViews": [{"buffer": 0, "byteLength": 9, "byteOffset": 1 << 60}], "buffers": [{"uri": "data:;base64,AAAA"}]}),
     "bufferViews[0] is out of its buffer"),
    (json.dumps({**json.loads(bad_gltf(**TEXTURED)), "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,AAAA"}]}),
     "images[0] is not a PNG, JPEG or WebP image"),
])
def test_faults_of_gltf_files_fail_their_material(tmp_path, maps, text, message):
    folder = tmp_path / "in"
    folder.mkdir()
    (folder / "link.png").symlink_to(tmp_path / "color.png")
    (folder / "a.gltf").write_text(text)
    [report] = mtlx.convert(folder / "a.gltf", tmp_path / "out.mtlx", to="openpbr")
    assert (report.path, report.state) == ("paint", "failed") and message in report.reason, report
    assert not (tmp_path / "out.mtlx").exists() and not (tmp_path / "out_textures").exists()


def test_faults_of_documents_fail_their_material(tmp_path, maps):
    files = "".join(f'<image name="{name}" type="color3"><input name="file" type="filename" value="{file}" colorspace="{space}"/></image>'
                    for name, file, space in (("missing", "nowhere.png", "srgb_texture"), ("wide", "color.png", "acescg"),
                                              ("tiles", "t.<UDIM>.png", "srgb_texture"), ("empty", "", "srgb_texture")))
    outputs = "".join(f'<output name="{name}_out" type="color3" nodename="{name}"/>' for name in ("missing", "wide", "tiles", "empty"))
    png(tmp_path / "t.1001.png", np.full((2, 2, 3), 9))
    good = ("good", "open_pbr_surface", {})
    source = document(tmp_path / "in.mtlx", *((name, "open_pbr_surface", {"base_color": f"{name}_out"}) for name in
                                              ("missing", "wide", "tiles", "empty")),
                      good,
                      body=f'<nodegraph name="NG">{files}{outputs}</nodegraph>')
    reports = reports_of(source, tmp_path / "out.glb", to="gltf")
    assert {name for name, report in reports.items() if report.state == "converted"} == {"good"}
    for name, words in (("missing", "base_color: "), ("missing", "nowhere.png: file not found"),
                        ("wide", "base_color: the color space acescg of color.png is not known"),
                        ("tiles", "base_color: glTF has no tiles"), ("empty", "base_color: its texture NG/empty has no file")):
        assert words in reports[name].reason, reports[name]
    content, _ = glb(tmp_path / "out.glb")
    assert [material["name"] for material in content["materials"]] == ["good"]
    require_valid_gltf(tmp_path / "out.glb")


def test_command(tmp_path, maps):
    def run(*words):
        return subprocess.run([sys.executable, "-m", "texremap", "mtlx", *map(str, words)], capture_output=True, text=True)

    source = document(tmp_path / "in.mtlx", ("paint", "open_pbr_surface", {"base_color": "color", "coat_weight": 1.0}), body=GRAPH)
    dry = run(source, "--to", "gltf", "-o", tmp_path / "out.gltf", "--dry-run", "--json")
    [line] = dry.stdout.splitlines()
    assert dry.returncode == 0 and json.loads(line)["state"] == "converted" and not (tmp_path / "out.gltf").exists()
    assert not (tmp_path / "out_textures").exists()
    done = run(source, "--to", "gltf", "-o", tmp_path / "out.gltf")
    assert done.returncode == 0 and "paint: converted, " in done.stderr and "1 converted, 0 left unchanged, 0 failed" in done.stderr
    require_valid_gltf(tmp_path / "out.gltf")
    for words, message in (
        ((source, "--to", "gltf", "-o", tmp_path / "out.gltf"), "exists (use --force"),
        ((source, "--to", "openpbr", "-o", tmp_path / "new.glb"), "a glTF file cannot hold openpbr"),
        ((source, "--to", "gltf", "--for", "core", "-o", tmp_path / "new.mtlx"), "--for core applies only to glTF files"),
        ((source, "--to", "gltf", "-o", source), "is the input"),
        ((tmp_path / "out.gltf", "--to", "gltf", "-o", tmp_path / "new.gltf"), "is glTF already"),
        ((tmp_path / "none.mtlx", "--to", "gltf", "-o", tmp_path / "new.gltf"), "none.mtlx: cannot be read: file not found"),
        ((source, "--to", "gltf", "-o", tmp_path / "new.usda"), "the file name must end with .mtlx, .glb or .gltf"),
    ):
        refused = run(*words)
        assert refused.returncode == 1 and message in refused.stderr, refused.stderr
    assert not list(tmp_path.rglob("new.*")) and not list(tmp_path.rglob(".unfinished*"))
