"""Tests the layers that are written for UsdPreviewSurface, by USD's own reader and validators."""

import hashlib
import json
import subprocess
import sys

import numpy as np
import pytest

pxr = pytest.importorskip("pxr")
oiio = pytest.importorskip("OpenImageIO")
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade  # noqa: E402

import texremap  # noqa: E402
from texremap import materials, usd  # noqa: E402


def add_material(stage, name, values, textures=()):
    """Adds a material with its shader. `textures` has (input, file, output, color space)."""
    material = UsdShade.Material.Define(stage, f"/World/Looks/{name}")
    shader = UsdShade.Shader.Define(stage, material.GetPath().AppendChild("Surface"))
    shader.CreateIdAttr("UsdPreviewSurface")
    kinds = {"useSpecularWorkflow": Sdf.ValueTypeNames.Int, "diffuseColor": Sdf.ValueTypeNames.Color3f,
             "specularColor": Sdf.ValueTypeNames.Color3f}
    for word, value in values.items():
        shader.CreateInput(word, kinds.get(word, Sdf.ValueTypeNames.Float)).Set(value)
    for word, file, output, space in textures:
        node = UsdShade.Shader.Define(stage, material.GetPath().AppendChild(f"tex_{word}"))
        node.CreateIdAttr("UsdUVTexture")
        node.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(file)
        node.CreateInput("sourceColorSpace", Sdf.ValueTypeNames.Token).Set(space)
        node.CreateInput("wrapS", Sdf.ValueTypeNames.Token).Set("repeat")
        reader = UsdShade.Shader.Define(stage, material.GetPath().AppendChild("st"))
        reader.CreateIdAttr("UsdPrimvarReader_float2")
        reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set("st")
        node.CreateInput("st", Sdf.ValueTypeNames.Float2).ConnectToSource(
            reader.CreateOutput("result", Sdf.ValueTypeNames.Float2))
        kind = Sdf.ValueTypeNames.Float3 if output == "rgb" else Sdf.ValueTypeNames.Float
        shader.CreateInput(word, kinds.get(word, Sdf.ValueTypeNames.Float)).ConnectToSource(node.CreateOutput(output, kind))
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    return material


def png(path, values):
    values = np.ascontiguousarray(values, np.uint8)
    output = oiio.ImageOutput.create(str(path))
    assert output.open(str(path), oiio.ImageSpec(values.shape[1], values.shape[0], values.shape[2], "uint8"))
    assert output.write_image(values) and output.close()


@pytest.fixture
def scene(tmp_path):
    random = np.random.default_rng(2)
    png(tmp_path / "diffuse.png", random.integers(0, 256, (6, 8, 3)))
    png(tmp_path / "specular.png", random.integers(0, 256, (6, 8, 3)))
    png(tmp_path / "small.png", random.integers(0, 256, (2, 2, 3)))
    file = tmp_path / "scene.usda"
    stage = Usd.Stage.CreateNew(str(file))
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/World").GetPrim())
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    specular = {"useSpecularWorkflow": 1, "roughness": 0.3}
    add_material(stage, "gold", {**specular, "diffuseColor": Gf.Vec3f(0), "specularColor": Gf.Vec3f(1.0, 0.77, 0.34)})
    add_material(stage, "plastic", {**specular, "diffuseColor": Gf.Vec3f(0.2, 0.3, 0.4), "specularColor": Gf.Vec3f(0.04)})
    add_material(stage, "maps", specular, [("diffuseColor", "diffuse.png", "rgb", "sRGB"),
                                           ("specularColor", "specular.png", "rgb", "sRGB")])
    add_material(stage, "sizes", specular, [("diffuseColor", "diffuse.png", "rgb", "sRGB"),
                                            ("specularColor", "small.png", "rgb", "sRGB")])
    add_material(stage, "missing", specular, [("diffuseColor", "nowhere.png", "rgb", "sRGB")])
    add_material(stage, "metal", {"metallic": 1.0, "diffuseColor": Gf.Vec3f(0.9, 0.5, 0.2), "roughness": 0.2})
    add_material(stage, "glassy", {"metallic": 0.25, "diffuseColor": Gf.Vec3f(0.6), "ior": 1.8})
    stage.GetRootLayer().Save()
    return file


def surface(stage, name):
    return UsdShade.Material(stage.GetPrimAtPath(f"/World/Looks/{name}")).ComputeSurfaceSource()[0]


def value(stage, name, word):
    return np.ravel(surface(stage, name).GetInput(word).Get())


def test_to_metallic(scene):
    before = hashlib.sha256(scene.read_bytes()).hexdigest()
    output = scene.with_name("metallic.usda")
    reports = {report.path.rsplit("/", 1)[1]: report for report in usd.convert(scene, output, to="metallic")}
    assert hashlib.sha256(scene.read_bytes()).hexdigest() == before
    assert {name: report.state for name, report in reports.items()} == {
        "gold": "converted", "plastic": "converted", "maps": "converted", "sizes": "converted", "missing": "failed",
        "metal": "left", "glassy": "left"}
    assert "nowhere.png: file not found" in reports["missing"].reason

    layer = Sdf.Layer.FindOrOpen(str(output))
    assert list(layer.subLayerPaths) == ["./scene.usda"] and layer.defaultPrim == "World"
    stage = Usd.Stage.Open(str(output))
    assert UsdGeom.GetStageUpAxis(stage) == "Z" and UsdGeom.GetStageMetersPerUnit(stage) == 0.01
    assert value(stage, "gold", "useSpecularWorkflow") == 0 and value(stage, "gold", "metallic") > 0.99
    assert np.abs(value(stage, "gold", "diffuseColor") - (1.0, 0.77, 0.34)).max() < 1e-3
    assert value(stage, "plastic", "metallic") < 1e-3
    assert np.abs(value(stage, "plastic", "diffuseColor") - (0.2, 0.3, 0.4)).max() < 1e-3
    assert value(stage, "missing", "useSpecularWorkflow") == 1
    assert abs(value(stage, "gold", "roughness") - 0.3) < 1e-6
    # The new layer has opinions only about these inputs.
    touched = set()
    layer.Traverse("/", lambda path: touched.add(path.name) if path.IsPropertyPath() else None)
    assert touched == {"inputs:useSpecularWorkflow", "inputs:diffuseColor", "inputs:metallic", "info:id", "inputs:file",
                       "inputs:sourceColorSpace", "inputs:wrapS", "inputs:st", "inputs:varname", "outputs:rgb", "outputs:r",
                       "outputs:result"}


def test_maps_hold_what_arrays_give(scene):
    output = scene.with_name("metallic.usda")
    usd.convert(scene, output, to="metallic")
    stage = Usd.Stage.Open(str(output))
    node = UsdShade.Shader(surface(stage, "maps").GetInput("metallic").GetConnectedSources()[0][0].source.GetPrim())
    file = node.GetInput("file").Get().resolvedPath
    with open(file, "rb") as opened:
        assert b"sRGB" not in opened.read()  # importers would follow it
    stored = np.round(np.asarray(oiio.ImageInput.open(file).read_image("uint8")))[..., 0]
    read = [np.asarray(oiio.ImageInput.open(str(scene.with_name(name))).read_image("uint8"))
            for name in ("diffuse.png", "specular.png")]
    expected = texremap.convert(source="plain:specular", target="usd-preview-surface", roughness=0.5, diffuse=read[0],
                                specular=read[1], dtype=np.float32)
    assert np.abs(stored / 255 - expected.metallic).max() <= 0.5 / 255 + 1e-6


def test_to_specular_is_exact_and_takes_the_index(scene):
    output = scene.with_name("specular.usda")
    usd.convert(scene, output, to="specular")
    stage = Usd.Stage.Open(str(output))
    assert np.abs(value(stage, "metal", "specularColor") - (0.9, 0.5, 0.2)).max() < 1e-6
    assert np.abs(value(stage, "metal", "diffuseColor")).max() < 1e-6
    f0 = ((1 - 1.8) / (1 + 1.8)) ** 2  # UsdPreviewSurface 2.5: F0 of a dielectric
    assert np.abs(value(stage, "glassy", "specularColor") - (0.75 * f0 + 0.25 * 0.6)).max() < 1e-6
    assert np.abs(value(stage, "glassy", "diffuseColor") - 0.75 * 0.6).max() < 1e-6


@pytest.mark.parametrize("to", ["metallic", "openpbr"])
def test_validators_have_no_new_complaint(scene, to):
    from pxr import UsdValidation

    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert len(validators) > 10
    context = UsdValidation.ValidationContext(validators)

    def complaints(file):
        return sorted((error.GetName(), error.GetMessage().replace(str(file), ""))
                      for error in context.Validate(Usd.Stage.Open(str(file))))

    output = scene.with_name("metallic.usda")
    usd.convert(scene, output, to=to)
    known = complaints(scene)
    # usd-core is built without MaterialX, and knows no node of it.
    new = [complaint for complaint in complaints(output) if complaint not in known and "'ND_" not in complaint[1]]
    assert not new, new


def paint_of(stage, name):
    material = UsdShade.Material(stage.GetPrimAtPath(f"/World/Looks/{name}"))
    return UsdShade.Shader(material.GetSurfaceOutput("mtlx").GetConnectedSources()[0][0].source.GetPrim())


def producer(shader, word):
    return UsdShade.Shader(shader.GetInput(word).GetConnectedSources()[0][0].source.GetPrim())


def test_to_openpbr_adds_a_surface_beside_the_other(scene):
    stage = Usd.Stage.Open(str(scene))
    add_material(stage, "wood", {}, [("diffuseColor", "diffuse.png", "rgb", "sRGB"), ("roughness", "specular.png", "g", "raw"),
                                     ("occlusion", "specular.png", "r", "raw")])
    stage.GetRootLayer().Save()
    output = scene.with_name("openpbr.usda")
    reports = {report.path.rsplit("/", 1)[1]: report for report in usd.convert(scene, output, to="openpbr")}
    assert [name for name, report in reports.items() if report.state != "converted"] == ["missing"]
    assert reports["wood"].lost == ("occlusion",) and reports["wood"].textures == ()
    stage = Usd.Stage.Open(str(output))
    for name, given in (("metal", {"metallic": 1.0, "diffuseColor": (0.9, 0.5, 0.2), "roughness": 0.2}),
                        ("glassy", {"metallic": 0.25, "diffuseColor": (0.6, 0.6, 0.6), "ior": 1.8})):
        expected = materials.TRANSLATIONS["UsdPreviewSurface", "open_pbr_surface"](given)
        paint = paint_of(stage, name)
        assert paint.GetIdAttr().Get() == "ND_open_pbr_surface_surfaceshader"
        for word, default in materials.MODELS["open_pbr_surface"].items():
            authored = paint.GetInput(word)
            found = np.ravel(authored.Get()) if authored else np.ravel(default)
            assert np.abs(found - np.ravel(expected[word])).max() < 1e-5, (name, word)
    assert surface(stage, "metal").GetIdAttr().Get() == "UsdPreviewSurface"
    # If the result equals a texture, the texture is connected, and no new one is written.
    image = producer(paint_of(stage, "wood"), "base_color")
    assert image.GetIdAttr().Get() == "ND_image_color3" and image.GetInput("file").Get().path == "./diffuse.png"
    assert image.GetInput("file").GetAttr().GetColorSpace() == "srgb_texture"
    channel = producer(paint_of(stage, "wood"), "specular_roughness")
    assert channel.GetIdAttr().Get() == "ND_extract_vector3" and channel.GetInput("index").Get() == 1
    assert not scene.with_name("openpbr_textures").exists() or reports["maps"].textures


def test_textures_are_converted_where_a_scale_does_not_do(scene):
    stage = Usd.Stage.Open(str(scene))
    add_material(stage, "coated", {"clearcoat": 1.0, "clearcoatRoughness": 0.2}, [("roughness", "specular.png", "g", "raw")])
    stage.GetRootLayer().Save()
    output = scene.with_name("openpbr.usda")
    reports = {report.path.rsplit("/", 1)[1]: report for report in usd.convert(scene, output, to="openpbr")}
    roughness = np.asarray(oiio.ImageInput.open(str(scene.with_name("specular.png"))).read_image("uint8"))[..., 1:2] / 255.0
    expected = materials.TRANSLATIONS["UsdPreviewSurface", "open_pbr_surface"](
        {"clearcoat": 1.0, "clearcoatRoughness": 0.2, "roughness": roughness})
    written = {file.split("coated_")[1][:-4]: file for file in reports["coated"].textures}
    assert "specular_roughness" in written
    stored = np.asarray(oiio.ImageInput.open(str(scene.parent / written["specular_roughness"])).read_image("uint8"))
    assert np.abs(stored[..., :1] / 255.0 - expected["specular_roughness"]).max() <= 0.5 / 255 + 1e-6
    # The map stores an IOR as a fraction of its range, and nodes compute the IOR from it.
    stage = Usd.Stage.Open(str(output))
    add = producer(paint_of(stage, "coated"), "specular_ior")
    multiply = producer(add, "in1")
    stored = np.asarray(oiio.ImageInput.open(str(scene.parent / written["specular_ior"])).read_image("uint8"))[..., :1] / 255.0
    read = stored * multiply.GetInput("in2").Get() + add.GetInput("in2").Get()
    assert np.abs(read - expected["specular_ior"]).max() <= multiply.GetInput("in2").Get() * 0.5 / 255 + 1e-5


def test_to_preview_names_what_it_cannot_show(tmp_path):
    png(tmp_path / "color.png", np.random.default_rng(3).integers(0, 256, (4, 4, 3)))
    stage = Usd.Stage.CreateNew(str(tmp_path / "paint.usda"))
    material = UsdShade.Material.Define(stage, "/World/Looks/paint")
    paint = UsdShade.Shader.Define(stage, "/World/Looks/paint/S")
    paint.CreateIdAttr("ND_open_pbr_surface_surfaceshader")
    paint.CreateInput("fuzz_weight", Sdf.ValueTypeNames.Float).Set(0.5)
    image = UsdShade.Shader.Define(stage, "/World/Looks/paint/image")
    image.CreateIdAttr("ND_image_color3")
    file = image.CreateInput("file", Sdf.ValueTypeNames.Asset)
    file.Set("color.png")
    file.GetAttr().SetColorSpace("srgb_texture")
    half = UsdShade.Shader.Define(stage, "/World/Looks/paint/half")
    half.CreateIdAttr("ND_multiply_color3FA")
    half.CreateInput("in1", Sdf.ValueTypeNames.Color3f).ConnectToSource(image.CreateOutput("out", Sdf.ValueTypeNames.Color3f))
    half.CreateInput("in2", Sdf.ValueTypeNames.Float).Set(0.5)
    paint.CreateInput("base_color", Sdf.ValueTypeNames.Color3f).ConnectToSource(half.CreateOutput("out", Sdf.ValueTypeNames.Color3f))
    noise = UsdShade.Shader.Define(stage, "/World/Looks/paint/noise")
    noise.CreateIdAttr("ND_fractal3d_float")
    paint.CreateInput("specular_roughness", Sdf.ValueTypeNames.Float).ConnectToSource(
        noise.CreateOutput("out", Sdf.ValueTypeNames.Float))
    material.CreateSurfaceOutput("mtlx").ConnectToSource(paint.CreateOutput("out", Sdf.ValueTypeNames.Token))
    stage.GetRootLayer().Save()
    [report] = usd.convert(tmp_path / "paint.usda", tmp_path / "preview.usda", to="preview")
    assert report.state == "converted" and report.lost[1] == "fuzz_weight"
    assert report.lost[0].startswith("specular_roughness: comes from /World/Looks/paint/noise")
    result = Usd.Stage.Open(str(tmp_path / "preview.usda"))
    texture = producer(surface(result, "paint"), "diffuseColor")
    assert texture.GetIdAttr().Get() == "UsdUVTexture" and texture.GetInput("file").Get().path == "./color.png"
    assert np.allclose(texture.GetInput("scale").Get(), (0.5, 0.5, 0.5, 1)) and texture.GetInput("sourceColorSpace").Get() == "sRGB"
    again = usd.convert(tmp_path / "preview.usda", tmp_path / "again.usda", to="preview")
    assert again[0].reason == "it has a UsdPreviewSurface already"


def test_tiles_are_converted_one_by_one(scene, tmp_path):
    random = np.random.default_rng(4)
    for tile in (1001, 1002):
        png(tmp_path / f"rough.{tile}.png", random.integers(0, 256, (4, 4, 1)))
    stage = Usd.Stage.Open(str(scene))
    add_material(stage, "coated", {"clearcoat": 1.0, "clearcoatRoughness": 0.2}, [("roughness", "rough.<UDIM>.png", "r", "raw")])
    stage.GetRootLayer().Save()
    reports = {report.path.rsplit("/", 1)[1]: report for report in usd.convert(scene, tmp_path / "out.usda", to="openpbr")}
    assert reports["coated"].state == "converted", reports["coated"].reason
    names = {file.rsplit("/", 1)[1] for file in reports["coated"].textures}
    assert {"World_Looks_coated_specular_roughness.1001.png", "World_Looks_coated_specular_roughness.1002.png"} <= names
    result = Usd.Stage.Open(str(tmp_path / "out.usda"))
    image = producer(paint_of(result, "coated"), "specular_roughness")
    assert image.GetInput("file").Get().path.endswith("World_Looks_coated_specular_roughness.<UDIM>.png")


def test_packages_keep_their_textures(scene, tmp_path):
    from pxr import UsdUtils

    stage = Usd.Stage.CreateNew(str(tmp_path / "small.usda"))
    add_material(stage, "plain", {}, [("diffuseColor", "diffuse.png", "rgb", "sRGB")])
    add_material(stage, "coated", {"clearcoat": 1.0, "clearcoatRoughness": 0.2}, [("roughness", "specular.png", "g", "raw")])
    stage.GetRootLayer().Save()
    assert UsdUtils.CreateNewUsdzPackage(str(tmp_path / "small.usda"), str(tmp_path / "small.usdz"))
    (tmp_path / "sub").mkdir()
    reports = {report.path.rsplit("/", 1)[1]: report
               for report in usd.convert(tmp_path / "small.usdz", tmp_path / "sub" / "out.usda", to="openpbr")}
    assert reports["plain"].state == "converted" and "is in a USDZ package" in reports["coated"].reason
    result = Usd.Stage.Open(str(tmp_path / "sub" / "out.usda"))
    image = producer(paint_of(result, "plain"), "base_color")
    assert image.GetInput("file").Get().resolvedPath == str(tmp_path / "small.usdz[0/diffuse.png]")


def test_numbers_that_are_not_finite_fail_their_material(scene, tmp_path):
    stage = Usd.Stage.Open(str(scene))
    add_material(stage, "odd", {"roughness": float("nan")})
    stage.GetRootLayer().Save()
    reports = {report.path.rsplit("/", 1)[1]: report for report in usd.convert(scene, tmp_path / "out.usda", to="openpbr")}
    assert reports["odd"].state == "failed" and reports["odd"].reason == "roughness is not a finite number"


def test_links_that_others_planted_are_not_followed(scene, tmp_path):
    other, folder = tmp_path / "other", tmp_path / "metallic_textures"
    other.write_text("mine")
    folder.mkdir()
    texture = folder / "World_Looks_maps_metallic.png"
    for link in (texture, folder / f".{texture.name}.unfinished.png", tmp_path / ".metallic.unfinished.usda"):
        link.symlink_to(other)
    usd.convert(scene, tmp_path / "metallic.usda", to="metallic")
    assert other.read_text() == "mine" and not texture.is_symlink()
    assert len(list(tmp_path.rglob(".*unfinished*"))) == 2


def test_command_and_bad_input(scene, tmp_path):
    def run(*words):
        command = [sys.executable, "-m", "texremap", "usd", "--to", "metallic", *map(str, words)]
        return subprocess.run(command, capture_output=True, text=True)

    dry = run(scene, "-o", tmp_path / "out.usda", "--dry-run", "--json")
    assert dry.returncode == 1 and len([json.loads(line) for line in dry.stdout.splitlines()]) == 7
    assert not (tmp_path / "out.usda").exists() and not (tmp_path / "out_textures").exists()
    for words, message in (
        ((tmp_path / "none.usda", "-o", tmp_path / "out.usda"), "none.usda: cannot be read: file not found"),
        ((scene, "-o", scene), "is the input"),
        ((scene, "-o", tmp_path / "out.glb"), "the file name must end with .usda"),
    ):
        refused = run(*words)
        assert refused.returncode == 1 and message in refused.stderr, refused.stderr
    (tmp_path / "broken.usda").write_text("#usda 1.0\n(((")
    assert "broken.usda:2:2: cannot be read: Expected ) at '(('" in run(tmp_path / "broken.usda", "-o", tmp_path / "out.usda").stderr
    (tmp_path / "text.usda").write_text("hello")
    refused = run(tmp_path / "text.usda", "-o", tmp_path / "out.usda").stderr
    assert "text.usda: cannot be read: <" in refused and "not a valid usda layer" in refused and "pxr" not in refused
    assert run(scene, "-o", tmp_path / "out.usda").returncode == 1  # a material failed
    assert "exists" in run(scene, "-o", tmp_path / "out.usda").stderr
    assert not list(tmp_path.glob(".*unfinished*"))
