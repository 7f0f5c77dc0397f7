"""A minimal renderer of one sphere with Lambert and Blinn-Phong, used by lambert_worker.py."""
import math


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v], length


def radiance(x, y, distance, lamp, n, specular, diffuse):
    """Returns the radiance along the ray through (x, y) of the image plane at distance 1 from the camera on +z."""
    ray, _ = unit([x, y, -1])
    middle = -ray[2] * distance
    beneath = middle * middle - distance * distance + 1  # negative if the ray misses the unit sphere
    if beneath <= 0:
        return 0.0
    p = [t * (middle - math.sqrt(beneath)) for t in ray]
    p[2] += distance
    light, far = unit([a - b for a, b in zip(lamp, p)])
    cosine = sum(a * b for a, b in zip(light, p))
    if cosine <= 0:
        return 0.0
    half, _ = unit([a - b for a, b in zip(light, ray)])
    lobe = specular * (n + 2) / (2 * math.pi) * max(0.0, sum(a * b for a, b in zip(half, p))) ** n
    return (diffuse / math.pi + lobe) * cosine / far ** 2


def picture(side, grid, half_angle, distance, lamp, exponent, specular, diffuse):
    """Renders a picture, row 0 at the top; a pixel is the mean of the centres of grid x grid squares."""
    extent = math.tan(math.radians(half_angle))
    at = [(2 * (i + 0.5) / (side * grid) - 1) * extent for i in range(side * grid)]
    return [sum(radiance(at[column * grid + u], -at[row * grid + v], distance, lamp, exponent, specular, diffuse)
                for u in range(grid) for v in range(grid)) / grid ** 2
            for row in range(side) for column in range(side)]
