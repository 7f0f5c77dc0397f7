"""Converts materials as people do it today, for each direction: by MaterialX' own graphs or chains of them, by
copying values of the same name, or by Blender's exporter."""
import materialx_shaders as shaders

# These inputs have the same meaning. Each has its name in OpenPBR, then its name in the source.
OPEN_PBR_OF_USD = {"base_color": "diffuseColor", "base_metalness": "metallic", "specular_roughness": "roughness",
                   "specular_ior": "ior", "coat_weight": "clearcoat", "coat_roughness": "clearcoatRoughness",
                   "emission_color": "emissiveColor", "geometry_opacity": "opacity"}
OPEN_PBR_OF_GLTF = {"base_color": "base_color", "base_metalness": "metallic", "specular_roughness": "roughness",
                    "specular_weight": "specular", "specular_color": "specular_color", "specular_ior": "ior",
                    "fuzz_color": "sheen_color", "fuzz_roughness": "sheen_roughness", "coat_weight": "clearcoat",
                    "coat_roughness": "clearcoat_roughness", "specular_roughness_anisotropy": "anisotropy_strength",
                    "geometry_opacity": "alpha"}


def copied(names, values):
    return {new: values[old] for new, old in names.items() if old in values}


def usd_to_open_pbr(values):
    return copied(OPEN_PBR_OF_USD, values)


def gltf_to_open_pbr(values):
    taken = copied(OPEN_PBR_OF_GLTF, values)
    taken["fuzz_weight"] = float(max(values["sheen_color"]) > 0)
    return taken


def gltf_to_core(values):
    """Does what importers do that read no extensions."""
    return {name: values[name] for name in ("base_color", "metallic", "roughness")}


def principled_to_open_pbr(values):
    """Converts like Blender 5.0 when it writes USD files with a MaterialX network. Blender omits coat_darkening, so
    it becomes 1."""
    blender = {**PRINCIPLED_DEFAULTS, **values}
    return {**copied(OPEN_PBR_OF_PRINCIPLED, blender), "specular_weight": 2 * blender["specular_ior_level"],
            "specular_roughness_anisotropy": 0.7 * blender["anisotropic"]}


PRINCIPLED_DEFAULTS = {"base_color": (0.8,) * 3, "metallic": 0.0, "roughness": 0.5, "diffuse_roughness": 0.0, "ior": 1.5,
                       "specular_ior_level": 0.5, "specular_tint": (1.0,) * 3, "anisotropic": 0.0, "coat_weight": 0.0,
                       "coat_roughness": 0.03, "coat_ior": 1.5, "coat_tint": (1.0,) * 3, "sheen_weight": 0.0,
                       "sheen_roughness": 0.5, "sheen_tint": (1.0,) * 3, "emission_color": (1.0,) * 3, "emission_strength": 0.0}
OPEN_PBR_OF_PRINCIPLED = {"base_color": "base_color", "base_metalness": "metallic", "specular_roughness": "roughness",
                          "base_diffuse_roughness": "diffuse_roughness", "specular_ior": "ior", "specular_color": "specular_tint",
                          "coat_weight": "coat_weight", "coat_roughness": "coat_roughness", "coat_ior": "coat_ior",
                          "coat_color": "coat_tint", "fuzz_weight": "sheen_weight", "fuzz_roughness": "sheen_roughness",
                          "fuzz_color": "sheen_tint", "emission_color": "emission_color", "emission_luminance": "emission_strength"}

OFFICIAL = {("open_pbr_surface", "standard_surface"): ("open_pbr_surface", "standard_surface"),
            ("standard_surface", "open_pbr_surface"): ("standard_surface", "open_pbr_surface"),
            ("open_pbr_surface", "gltf_pbr"): ("open_pbr_surface", "standard_surface", "gltf_pbr"),
            ("open_pbr_surface", "UsdPreviewSurface"): ("open_pbr_surface", "standard_surface", "UsdPreviewSurface")}
OFFICIAL["open_pbr_surface", "UsdPreviewSurface_specular"] = OFFICIAL["open_pbr_surface", "UsdPreviewSurface"]
COPIED = {("UsdPreviewSurface", "open_pbr_surface"): usd_to_open_pbr, ("gltf_pbr", "open_pbr_surface"): gltf_to_open_pbr,
          ("principled", "open_pbr_surface"): principled_to_open_pbr, ("gltf_pbr", "gltf_pbr_core"): gltf_to_core}


def shader_and_values(direction, values):
    """Returns the shader that shows the translation in use, and its values."""
    if direction in OFFICIAL:
        shader = shaders.chain_shader(OFFICIAL[direction])
        return shader, {name: value for name, value in values.items() if name in shader.types}
    defaults = {} if direction[0] == "principled" else shaders.model_shader(direction[0]).defaults
    return shaders.model_shader(shaders.model_of(direction[1])), COPIED[direction]({**defaults, **values})


def name_of(direction):
    """Returns what is in use, in words for a table."""
    if direction in OFFICIAL:
        return "official graph" if len(OFFICIAL[direction]) == 2 else "official chain"
    if direction[1] == "gltf_pbr_core":
        return "extensions dropped"
    return "Blender's export" if direction[0] == "principled" else "names copied"
