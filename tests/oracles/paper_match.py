#!/usr/bin/env python3
"""Computes the match of Sztrajman et al. 2019 (headlight, L2 of linear pictures) independently of remapc.

Reads tables of `remapc sweep --objective paper` from mitsuba/ward, renders the same spheres from the published
formulas in NumPy, finds the best width by golden section with the specular in closed form, and compares. The exit
code is 77 without NumPy.

  paper_match.py RESOLUTION TABLE...
"""
import json
import math
import sys

try:
    import numpy as np
except ImportError:
    print("skipped: needs NumPy")
    sys.exit(77)

ALPHA_TOLERANCE, SPECULAR_TOLERANCE, LEAST_ALPHA = 0.002, 0.005, 0.03


def sphere(resolution):
    """Returns cosines at the pixels that show the unit sphere from distance 3, with the light at the camera."""
    half = math.tan(math.asin(1.0 / 3.0))
    axis = (np.arange(resolution) + 0.5) / resolution * 2.0 - 1.0
    x, y = np.meshgrid(axis * half, axis * half)
    direction = np.stack([x, y, -np.ones_like(x)], axis=-1)
    direction /= np.linalg.norm(direction, axis=-1, keepdims=True)
    b = 3.0 * direction[..., 2]
    square = b * b - 8.0
    seen = square > 0.0
    distance = -b[seen] - np.sqrt(square[seen])
    normal = direction[seen] * distance[:, None] + np.array([0.0, 0.0, 3.0])
    cosine = -(normal * direction[seen]).sum(axis=1)
    return cosine, distance


def ward(alpha, cosine):
    tangent2 = (1.0 - cosine**2) / cosine**2
    return np.exp(-tangent2 / alpha**2) / (4.0 * math.pi * alpha**2 * cosine)


def ggx(alpha, cosine):
    tangent2 = (1.0 - cosine**2) / cosine**2
    d = 1.0 / (math.pi * alpha**2 * (cosine**2 * (1.0 + tangent2 / alpha**2)) ** 2)
    g = 2.0 / (1.0 + np.sqrt(1.0 + alpha**2 * tangent2))
    return d * g * g / (4.0 * cosine**2)


def beckmann(alpha, cosine):
    tangent2 = (1.0 - cosine**2) / cosine**2
    d = np.exp(-tangent2 / alpha**2) / (math.pi * alpha**2 * cosine**4)
    a = 1.0 / (alpha * np.sqrt(np.maximum(tangent2, 1e-300)))
    g = np.where(a < 1.6, (3.535 * a + 2.181 * a**2) / (1.0 + 2.276 * a + 2.577 * a**2), 1.0)
    return d * g * g / (4.0 * cosine**2)


def best(picture, model, start, cosine, irradiance):
    """Returns width and F0. Under a headlight the half vector is the view, so Schlick's Fresnel is F0."""

    def fit(log_alpha):
        target = model(math.exp(log_alpha), cosine) * irradiance
        f0 = (picture @ target) / (target @ target)
        return ((picture - f0 * target) ** 2).sum(), f0

    golden = (math.sqrt(5.0) - 1.0) / 2.0
    low, high = math.log(start / 2.5), math.log(min(1.0, start * 1.8))
    for _ in range(40):
        a, b = high - golden * (high - low), low + golden * (high - low)
        if fit(a)[0] < fit(b)[0]:
            high = b
        else:
            low = a
    return math.exp(0.5 * (low + high)), fit(0.5 * (low + high))[1]


def compare(path, resolution):
    with open(path + ".json", encoding="utf-8") as file:
        comments = json.load(file)
    model = {"mitsuba/ggx": ggx, "mitsuba/beckmann": beckmann}[comments["target"]]
    cosine, distance = sphere(resolution)
    irradiance = cosine / distance**2
    worst_alpha = worst_specular = worst_curve = 0.0
    rows = 0
    matches = {}
    for row in np.genfromtxt(path, names=True, delimiter=",", dtype=None, encoding="utf-8"):
        alpha, specular = row["alpha1"], row["specular1"]
        if alpha < LEAST_ALPHA or row["status"] != "ok":
            continue
        if alpha not in matches:
            matches[alpha] = best(ward(alpha, cosine) * irradiance, model, alpha, cosine, irradiance)
        expected_alpha, slope = matches[alpha]
        worst_alpha = max(worst_alpha, abs(row["alpha2"] - expected_alpha))
        worst_specular = max(worst_specular, abs(row["specular2"] / (slope * specular) - 1.0))
        if model is ggx:  # appendix A; its quartic coefficient is misprinted and must be 0.108
            curve = 1.135 * alpha - 0.766 * alpha**2 + 0.102 * alpha**3 + 0.108 * alpha**4
            worst_curve = max(worst_curve, abs(row["alpha2"] - curve))
        rows += 1
    print(f"{comments['target']}: {rows} rows, alpha within {worst_alpha:.2e}, specular within {worst_specular:.2e}"
          + (f", appendix A within {worst_curve:.2e}" if model is ggx else ""))
    return rows > 0 and worst_alpha <= ALPHA_TOLERANCE and worst_specular <= SPECULAR_TOLERANCE and worst_curve <= 0.01


if __name__ == "__main__":
    good = [compare(path, int(sys.argv[1])) for path in sys.argv[2:]]
    sys.exit(0 if all(good) else 1)
