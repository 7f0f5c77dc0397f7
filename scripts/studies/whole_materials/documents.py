"""Reads materials of MaterialX documents, as values of their models."""
import pathlib


import materialx_shaders as shaders

LINEAR = ("", "lin_rec709", "linear")
LEAST_ROUGHNESS = 0.15  # smoother highlights are smaller than a pixel and would only add noise
NO_HIGHLIGHT = ("diffuse_roughness", "coat_affect_roughness", "transmission_extra_roughness", "sheen_roughness")
SEEN_THROUGH = {"transmission": 0, "transmission_weight": 0, "opacity": 1, "geometry_opacity": 1, "alpha": 1}


def constants(node):
    """Returns the values of a surface node. Raises Unusable for a connected input, because it differs from point to
    point."""
    values = {}
    types = shaders.input_types(node)
    for given in node.getActiveInputs():
        if given.getConnectedNode() or given.getNodeGraphString() or given.getInterfaceName():
            raise shaders.Unusable(f"{given.getName()} is connected")
        if given.getType() == "color3" and given.getActiveColorSpace() not in LINEAR:
            raise shaders.Unusable(f"{given.getName()} has the color space {given.getActiveColorSpace()}")
        if types.get(given.getName()) in ("float", "color3", "boolean", "integer"):
            value = given.getValue()
            values[given.getName()] = tuple(value.asTuple()) if hasattr(value, "asTuple") else float(value)
        elif given.getValueString():
            raise shaders.Unusable(f"{given.getName()} is a {given.getType()}")
    return values


def judged(values, defaults):
    """Returns the values, with every lobe rough enough to be judged. Raises Unusable for transparent materials,
    because nothing is behind them."""
    for name, usual in SEEN_THROUGH.items():
        if name in values and values[name] not in (usual, (usual,) * 3):
            raise shaders.Unusable(f"{name} is not judged, because nothing is behind the sphere")
    widths = [name for name in defaults if name.lower().endswith("roughness") and not name.endswith(NO_HIGHLIGHT)]
    return {**values, **{name: max(values.get(name, defaults[name]), LEAST_ROUGHNESS) for name in widths}}


def materials(path):
    """Returns name, model and values of each material of a document. Also returns what was skipped, with the reason.
    """
    found, skipped = [], []
    document = shaders.read_document(path)  # keeps the document alive, because its nodes do not
    if not shaders.surface_nodes(document):
        raise shaders.Unusable(f"{path}: has no material with a surface shader")
    for name, node in shaders.surface_nodes(document):
        try:
            if node.getCategory() not in shaders.MODELS:
                raise shaders.Unusable(f"no translation from {node.getCategory()}")
            values = judged(constants(node), shaders.model_shader(node.getCategory()).defaults)
            found.append((name, node.getCategory(), values))
        except shaders.Unusable as reason:
            skipped.append(f"{pathlib.Path(path).name}: {name}: {reason}")
    return found, skipped


def examples(place):
    """Returns name, model and values of all materials in a document or in a folder of documents, and the list of what
    is skipped."""
    place = pathlib.Path(place)
    paths = sorted(place.glob("*.mtlx")) if place.is_dir() else [place]
    if not paths:
        raise shaders.Unusable(f"{place}: has no files *.mtlx")
    found, skipped = [], []
    for path in paths:
        some, without = materials(path)
        found += [(path.stem if len(some) == 1 else f"{path.stem}: {name}", model, values) for name, model, values in some]
        skipped += without
    return found, skipped
