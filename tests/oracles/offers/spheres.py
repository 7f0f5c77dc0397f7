"""Renders spheres with the lobe of an exponent as its source defines it, and with GGX as in appendix B of glTF.
Measures their difference."""
import collections
import math

import numpy as np

TEXELS = 40

# A Source holds the values of one material, or of each texel: exponent and linear colors. lobe is "blinn" or "phong".
# display is true if the renderer adds up display values, as MuJoCo does.
Source = collections.namedtuple("Source", "n kd ks lobe display", defaults=("blinn", False))
Target = collections.namedtuple("Target", "base roughness f0 f90 metallic", defaults=(1.0, 0.0))


def linear(display):
    display = np.asarray(display, float)
    return np.where(display <= 0.04045, display / 12.92, ((display + 0.055) / 1.055) ** 2.4)


def encoded(value):
    value = np.clip(value, 0, 1)
    return np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)


def light_sets():
    """Returns directions and weights. The weights make the brightest point of a white diffuse sphere 1."""
    index = np.arange(32)
    z = 1 - (2 * index + 1) / 32
    angle = index * math.pi * (3 - math.sqrt(5))
    around = np.stack([np.cos(angle) * np.sqrt(1 - z**2), np.sin(angle) * np.sqrt(1 - z**2), z], -1)
    weights = (0.55 + 0.45 * around[:, 1]) * np.where(np.random.default_rng(7).permutation(32) < 5, 4.0, 1.0)
    return {"one light": lamp(60), "32 lights": (around, weights)}


def lamp(degrees):
    angle = math.radians(degrees)
    return np.array([[0.0, math.sin(angle), math.cos(angle)]]), np.ones(1)


class Sphere:
    """Holds cosines at the pixels of a sphere that is seen from +z, for one set of lights."""

    def __init__(self, lights, side=64):
        directions, weights = lights
        axis = (np.arange(side) + 0.5) / side * 2 - 1
        x, y = np.meshgrid(axis, -axis)
        self.mask = x**2 + y**2 < 1
        self.side = side
        normal = np.stack([x, y, np.sqrt(np.maximum(0, 1 - x**2 - y**2))], -1)[self.mask]
        view = np.array([0.0, 0, 1])
        half = directions + view
        half /= np.maximum(1e-9, np.linalg.norm(half, axis=1, keepdims=True))
        nl = directions @ normal.T
        mirrored = 2 * nl[..., None] * normal[None] - directions[:, None]
        self.nl, self.nv = np.maximum(nl, 0), normal[:, 2][None]
        self.nh, self.rv = np.maximum(half @ normal.T, 0), np.maximum(mirrored[..., 2], 0)
        self.lit = nl > 0
        weights = weights / (weights[:, None] * self.nl).sum(0).max()
        self.weights = weights[:, None]
        self.rim = (1 - np.clip((half @ view), 0, 1))[:, None] ** 5
        self.uv = np.stack([np.arctan2(normal[:, 0], normal[:, 2]) / math.pi + 0.5, np.arccos(normal[:, 1]) / math.pi], -1)

    def source(self, s):
        """Returns display values of pixels. The material may have one value for all pixels, or one for each."""
        lobe = self.nh if s.lobe == "blinn" else self.rv
        lobe = np.where(self.lit, lobe ** np.maximum(s.n, 1e-6), 0.0)
        color = np.asarray(s.kd) * self.sum(self.nl) + np.asarray(s.ks) * self.sum(lobe)
        return np.clip(color, 0, 1) if s.display else encoded(color)

    def sum(self, values):
        return (self.weights * values).sum(0)[:, None]

    def target(self, t):
        a2 = np.maximum(np.asarray(t.roughness, float) ** 2, 0.0025) ** 2
        distribution = a2 / (math.pi * (self.nh**2 * (a2 - 1) + 1) ** 2)
        visible = 0.5 / np.maximum(1e-9, self.nl * np.sqrt(self.nv**2 * (1 - a2) + a2) + self.nv * np.sqrt(self.nl**2 * (1 - a2) + a2))
        lobe = np.where(self.lit, math.pi * distribution * visible * self.nl, 0.0)
        flat, rim = self.sum(lobe), self.sum(lobe * self.rim)
        base, f0, f90 = (np.clip(np.asarray(value, float), 0, 1) for value in (t.base, t.f0, t.f90))
        f0, f90 = np.broadcast_to(f0, base.shape), np.broadcast_to(f90, base.shape)
        most, edge = f0.max(-1, keepdims=True), f90.max(-1, keepdims=True)
        plain = base * ((1 - most) * self.sum(self.nl) - (edge - most) * self.sum(self.nl * self.rim)) + f0 * (flat - rim) + f90 * rim
        metal = base * (flat - rim) + rim
        metallic = np.asarray(t.metallic, float)
        metallic = metallic[:, None] if metallic.ndim else metallic
        return encoded(plain * (1 - metallic) + metal * metallic)


SPHERES = {name: [Sphere(lights)] for name, lights in light_sets().items()}
# A simulator has lamps, but no light from all directions.
LAMPS = {"lamps": [Sphere(lamp(degrees)) for degrees in (10, 30, 50, 70)]}


def at(values, index):
    """Returns one texel of named arrays."""
    return type(values)(*(value[index] if isinstance(value, np.ndarray) and value.shape[0] == TEXELS else value for value in values))


def squares(source, target, sets=SPHERES):
    """Returns the sum of squared differences and their count, for each set of lights."""
    sums = np.zeros((len(sets), 2))
    mapped = any(isinstance(v, np.ndarray) and v.shape and v.shape[0] == TEXELS for v in (*source, *target))
    for index in range(TEXELS) if mapped else [0]:
        one, other = (at(source, index), at(target, index)) if mapped else (source, target)
        for total, spheres in zip(sums, sets.values()):
            for sphere in spheres:
                difference = sphere.source(one) - sphere.target(other)
                total += (difference**2).sum(), difference.size
    return sums


def percent(sums):
    """Returns the RMSE under each set of lights, as the cell of a table."""
    return " / ".join(f"{100 * math.sqrt(total / count):.1f}" for total, count in np.sum(sums, axis=0))
