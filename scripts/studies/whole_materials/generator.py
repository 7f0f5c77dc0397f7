"""Makes random whole materials of each model.

Half have a coat. Half are dielectric, a quarter are metal, and a quarter are mixed. Three in ten have fuzz or sheen.
Every lobe has at least roughness .2, because smaller highlights than a pixel would only add noise. There is no
emission, transmission, subsurface scattering or thin film.
"""
import numpy as np

LEAST_ROUGHNESS = 0.2


class Draw:
    """Draws random numbers for one material, in the units of materials."""

    def __init__(self, *seeds):
        self.random = np.random.default_rng(seeds)

    def between(self, low, high):
        return float(self.random.uniform(low, high))

    def happens(self, chance):
        return bool(self.random.random() < chance)

    def mostly(self, usual, chance, low, high):
        """Returns `usual`, or with the given chance a number of the range."""
        return self.between(low, high) if self.happens(chance) else float(usual)

    def color(self, low, high):
        """Returns a linear color whose display values are uniform in the range, like those of a color picker."""
        shown = self.random.uniform(low, high, 3)
        return tuple(np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4).tolist())

    def tint(self, chance):
        """Returns white, or with the given chance a light color."""
        return self.color(0.5, 1) if self.happens(chance) else (1.0, 1.0, 1.0)

    def roughness(self, most=0.9):
        return self.between(LEAST_ROUGHNESS, most)

    def metalness(self):
        kind = self.random.random()
        return 0.0 if kind < 0.5 else 1.0 if kind < 0.75 else self.between(0.1, 0.9)

    def weight(self, chance):
        """Returns 0, or with the given chance a weight, which is 1 in half of the cases."""
        return self.mostly(1, 0.5, 0.2, 1) if self.happens(chance) else 0.0


def open_pbr(d):
    values = {"base_weight": d.mostly(1, 0.3, 0.5, 1), "base_color": d.color(0.1, 0.95), "base_metalness": d.metalness(),
              "base_diffuse_roughness": d.mostly(0, 0.4, 0.1, 1), "specular_weight": d.mostly(1, 0.3, 0.3, 1),
              "specular_color": d.tint(0.3), "specular_roughness": d.roughness(), "specular_ior": d.between(1.3, 1.8),
              "specular_roughness_anisotropy": d.mostly(0, 0.25, 0.1, 0.8)}
    coat, fuzz = d.weight(0.5), d.weight(0.3)
    if coat:
        values.update(coat_weight=coat, coat_color=d.tint(0.5), coat_roughness=d.roughness(0.6), coat_ior=d.between(1.3, 1.8),
                      coat_darkening=d.mostly(1, 0.3, 0, 1))
    if fuzz:
        values.update(fuzz_weight=fuzz, fuzz_color=d.color(0.3, 1), fuzz_roughness=d.between(0.3, 1))
    return values


def standard_surface(d):
    values = {"base": d.mostly(1, 0.3, 0.5, 1), "base_color": d.color(0.1, 0.95), "metalness": d.metalness(),
              "diffuse_roughness": d.mostly(0, 0.4, 0.1, 1), "specular": d.mostly(1, 0.3, 0.3, 1),
              "specular_color": d.tint(0.3), "specular_roughness": d.roughness(), "specular_IOR": d.between(1.3, 1.8),
              "specular_anisotropy": d.mostly(0, 0.25, 0.1, 0.8)}
    coat, sheen = d.weight(0.5), d.weight(0.3)
    if coat:
        values.update(coat=coat, coat_color=d.tint(0.5), coat_roughness=d.roughness(0.6), coat_IOR=d.between(1.3, 1.8),
                      coat_affect_color=d.mostly(0, 0.3, 0, 1), coat_affect_roughness=d.mostly(0, 0.3, 0, 1))
    if sheen:
        values.update(sheen=sheen, sheen_color=d.color(0.3, 1), sheen_roughness=d.between(0.2, 1))
    return values


def gltf_pbr(d):
    values = {"base_color": d.color(0.1, 0.95), "metallic": d.metalness(), "roughness": d.roughness(),
              "specular": d.mostly(1, 0.3, 0.3, 1), "specular_color": d.tint(0.3), "ior": d.mostly(1.5, 0.5, 1.3, 1.8),
              "anisotropy_strength": d.mostly(0, 0.25, 0.1, 0.8)}
    coat, sheen = d.weight(0.5), d.weight(0.3)
    if coat:
        values.update(clearcoat=coat, clearcoat_roughness=d.roughness(0.6))
    if sheen:
        values.update(sheen_color=tuple(sheen * channel for channel in d.color(0.3, 1)), sheen_roughness=d.between(0.3, 1))
    return values


def usd_preview_surface(d):
    values = {"diffuseColor": d.color(0.1, 0.95), "metallic": d.metalness(), "roughness": d.roughness(),
              "ior": d.mostly(1.5, 0.5, 1.3, 1.8)}
    if d.happens(0.2):
        values.update(useSpecularWorkflow=1.0, specularColor=d.color(0.1, 0.9))
    coat = d.weight(0.5)
    if coat:
        values.update(clearcoat=coat, clearcoatRoughness=d.roughness(0.6))
    return values


def principled(d):
    values = {"base_color": d.color(0.1, 0.95), "metallic": d.metalness(), "roughness": d.roughness(),
              "diffuse_roughness": d.mostly(0, 0.4, 0.1, 1), "ior": d.between(1.3, 1.8),
              "specular_ior_level": d.mostly(0.5, 0.3, 0.1, 0.9), "specular_tint": d.tint(0.3),
              "anisotropic": d.mostly(0, 0.25, 0.1, 0.8)}
    coat, sheen = d.weight(0.5), d.weight(0.3)
    if coat:
        values.update(coat_weight=coat, coat_tint=d.tint(0.5), coat_roughness=d.roughness(0.6), coat_ior=d.between(1.3, 1.8))
    if sheen:
        values.update(sheen_weight=sheen, sheen_tint=d.color(0.3, 1), sheen_roughness=d.between(0.3, 1))
    return values


GENERATORS = {"open_pbr_surface": open_pbr, "standard_surface": standard_surface, "gltf_pbr": gltf_pbr,
              "UsdPreviewSurface": usd_preview_surface, "principled": principled}


def materials(model, seed, count):
    """Returns `count` random materials, each a dict of the inputs that are not at their defaults."""
    place = list(GENERATORS).index(model)
    return [GENERATORS[model](Draw(seed, place, number)) for number in range(count)]
