"""What people use today for each direction: MaterialX' own graphs or chains of them, names that are copied, Blender's exporter."""
import materialx_shaders as shaders

SAME = object()

# Inputs of the same meaning by their names. A weight that the source does not have is that of a colour above 0.
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
    taken["fuzz_weight"] = float(max(values.get("sheen_color", (0,))) > 0)
    return taken


OFFICIAL = {("open_pbr_surface", "standard_surface"): ("open_pbr_surface", "standard_surface"),
            ("standard_surface", "open_pbr_surface"): ("standard_surface", "open_pbr_surface"),
            ("open_pbr_surface", "gltf_pbr"): ("open_pbr_surface", "standard_surface", "gltf_pbr"),
            ("open_pbr_surface", "UsdPreviewSurface"): ("open_pbr_surface", "standard_surface", "UsdPreviewSurface")}
COPIED = {("UsdPreviewSurface", "open_pbr_surface"): usd_to_open_pbr, ("gltf_pbr", "open_pbr_surface"): gltf_to_open_pbr}


def render_in_use(direction, values, render):
    """Returns what `render(shader, values)` gives for the translation in use of a material."""
    if direction in OFFICIAL:
        shader = shaders.chain_shader(OFFICIAL[direction])
        return render(shader, {name: value for name, value in values.items() if name in shader.types})
    return render(shaders.model_shader(direction[1]), COPIED[direction](values))


def name_in_use(direction):
    if direction in OFFICIAL:
        steps = len(OFFICIAL[direction]) - 1
        return "official graph" if steps == 1 else "official chain"
    return "names copied" if direction in COPIED else "Blender's exporter"
