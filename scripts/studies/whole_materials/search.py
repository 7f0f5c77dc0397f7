"""Finds the parameters of the target that give the closest pictures, by Levenberg and Marquardt's method. No
translation can be better."""
import numpy as np

RESOLUTION, STEPS, DIFFERENCE = 48, 12, 2e-3

# These inputs are searched, with their ranges. Colours have three values each.
INPUTS = {
    "open_pbr_surface": {
        "base_color": (0, 1), "base_metalness": (0, 1), "base_diffuse_roughness": (0, 1), "specular_weight": (0, 1),
        "specular_color": (0, 1), "specular_roughness": (0.05, 1), "specular_ior": (1, 3),
        "specular_roughness_anisotropy": (0, 0.95), "fuzz_weight": (0, 1), "fuzz_color": (0, 1), "fuzz_roughness": (0.05, 1),
        "coat_weight": (0, 1), "coat_color": (0, 1), "coat_roughness": (0.05, 1), "coat_ior": (1, 3), "coat_darkening": (0, 1)},
    "standard_surface": {
        "base_color": (0, 1), "metalness": (0, 1), "diffuse_roughness": (0, 1), "specular": (0, 1), "specular_color": (0, 1),
        "specular_roughness": (0.05, 1), "specular_IOR": (1, 3), "specular_anisotropy": (0, 0.95), "sheen": (0, 1),
        "sheen_color": (0, 1), "sheen_roughness": (0.05, 1), "coat": (0, 1), "coat_color": (0, 1), "coat_roughness": (0.05, 1),
        "coat_IOR": (1, 3), "coat_affect_color": (0, 1)},
    "gltf_pbr": {
        "base_color": (0, 1), "metallic": (0, 1), "roughness": (0.05, 1), "specular": (0, 1), "specular_color": (0, 1),
        "ior": (1, 3), "anisotropy_strength": (0, 1), "sheen_color": (0, 1), "sheen_roughness": (0.05, 1), "clearcoat": (0, 1),
        "clearcoat_roughness": (0.05, 1)},
    "gltf_pbr_core": {"base_color": (0, 1), "metallic": (0, 1), "roughness": (0.05, 1)},
    "UsdPreviewSurface": {
        "diffuseColor": (0, 1), "metallic": (0, 1), "specularColor": (0, 1), "roughness": (0.05, 1), "clearcoat": (0, 1),
        "clearcoatRoughness": (0.05, 1), "ior": (1, 3)},
}


# At weight 0, the derivatives by the other inputs of a lobe are 0. A search therefore also starts where every lobe
# has a small weight.
STARTS = {
    "open_pbr_surface": [{"base_metalness": 0.4, "coat_weight": 0.3, "coat_roughness": 0.3, "fuzz_weight": 0.2, "fuzz_roughness": 0.7,
                          "specular_roughness": 0.5, "base_diffuse_roughness": 0.2}],
    "standard_surface": [{"metalness": 0.4, "coat": 0.3, "coat_roughness": 0.3, "sheen": 0.2, "sheen_roughness": 0.4,
                          "specular_roughness": 0.5, "diffuse_roughness": 0.2}],
    "gltf_pbr": [{"base_color": (0.5,) * 3, "metallic": 0.4, "clearcoat": 0.3, "clearcoat_roughness": 0.3, "roughness": 0.5,
                  "sheen_color": (0.1,) * 3, "sheen_roughness": 0.5}],
    "gltf_pbr_core": [{"base_color": (0.5,) * 3, "metallic": 0.3, "roughness": 0.5}],
    "UsdPreviewSurface": [{"metallic": 0.4, "clearcoat": 0.3, "clearcoatRoughness": 0.3, "roughness": 0.5},
                          {"useSpecularWorkflow": 1.0, "specularColor": (0.3,) * 3, "clearcoat": 0.3, "clearcoatRoughness": 0.3}],
}


class Vector:
    """Packs inputs of a shader into one vector of numbers."""

    def __init__(self, inputs, types):
        self.inputs, self.types = inputs, types
        sizes = [3 if types[name] == "color3" else 1 for name in inputs]
        self.low = np.concatenate([np.full(n, range_[0], float) for n, range_ in zip(sizes, inputs.values())])
        self.high = np.concatenate([np.full(n, range_[1], float) for n, range_ in zip(sizes, inputs.values())])

    def of(self, values):
        parts = [np.broadcast_to(values[name], 3 if self.types[name] == "color3" else 1) for name in self.inputs]
        return np.clip(np.concatenate(parts).astype(float), self.low, self.high)

    def values(self, vector):
        found, place = {}, 0
        for name in self.inputs:
            size = 3 if self.types[name] == "color3" else 1
            found[name] = tuple(vector[place:place + 3].tolist()) if size == 3 else float(vector[place])
            place += size
        return found


def minimise(residuals, start, low, high, steps=STEPS):
    """Returns the vector with the least sum of squared residuals. The search steps from `start` and stays inside the
    range."""
    x, damping = start, 1e-3
    now = residuals(x)
    for _ in range(steps):
        slopes = np.empty((len(x), now.size))
        for i in range(len(x)):
            step = DIFFERENCE if x[i] + DIFFERENCE <= high[i] else -DIFFERENCE
            moved = x.copy()
            moved[i] += step
            slopes[i] = (residuals(moved) - now) / step
        square, gradient = slopes @ slopes.T, slopes @ now
        better = False
        while damping < 1e6 and not better:
            scale = damping * (np.diag(square) + 1e-9 * np.trace(square) + 1e-12)
            moved = np.clip(x - np.linalg.solve(square + np.diag(scale), gradient), low, high)
            then = residuals(moved)
            better = then @ then < now @ now
            damping = damping / 5 if better else damping * 5
        if not better:
            break
        gain = 1 - (then @ then) / max(now @ now, 1e-30)
        x, now = moved, then
        if gain < 1e-4:
            break
    return x


def closest(stage, source, shader, starts, target):
    """Returns the values with the closest pictures to `source`, the pictures of the stage, from the best of the starts.

    `target` is the name of the direction's end. A model has starts of its own.

    Inputs that are not searched, such as the workflow of UsdPreviewSurface, stay as each start has them.
    """
    name = target if target in INPUTS else shader.name
    vector = Vector(INPUTS[name], shader.types)
    found = []
    for start in starts + STARTS[name]:
        def residuals(x, start=start):
            return (stage.under_singles(shader, {**start, **vector.values(x)}) - source).ravel()

        x = minimise(residuals, vector.of({**shader.defaults, **start}), vector.low, vector.high)
        found.append(((residuals(x) ** 2).sum(), {**start, **vector.values(x)}))
    return min(found, key=lambda one: one[0])[1]
