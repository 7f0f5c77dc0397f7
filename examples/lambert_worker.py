"""A whole worker (compiler/workers/PROTOCOL.md): Lambert and Blinn-Phong, traced here. Yours calls a renderer."""
import array
import json
import math
import sys

MODEL = {"name": "example/blinn-phong", "parameters": [
    {"name": "exponent", "role": "roughness", "convention": "exponent", "range": [0, 10000]},
    {"name": "specular", "role": "specular", "range": [0, 1]},
    {"name": "diffuse", "role": "diffuse", "range": [0, 1]}]}


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v], length


def radiance(x, y, scene, n, specular, diffuse):
    d = scene["camera"]["distance"]
    ray, _ = unit([x, y, -1])
    middle = -ray[2] * d
    beneath = middle * middle - d * d + 1  # the ray against the unit sphere
    if beneath <= 0:
        return 0.0
    p = [t * (middle - math.sqrt(beneath)) for t in ray]
    p[2] += d
    light, distance = unit([a - b for a, b in zip(scene["light"]["position"], p)])
    cosine = sum(a * b for a, b in zip(light, p))
    if cosine <= 0:
        return 0.0
    half, _ = unit([a - b for a, b in zip(light, ray)])
    lobe = specular * (n + 2) / (2 * math.pi) * max(0.0, sum(a * b for a, b in zip(half, p))) ** n
    return (diffuse / math.pi + lobe) * cosine / distance ** 2


def render(request):
    values, scene, channels = request["parameters"], request["scene"], request["channels"]
    for p in MODEL["parameters"]:
        if not all(p["range"][0] <= v <= p["range"][1] for v in values[p["name"]]):
            raise ValueError(f"{p['name']} is {values[p['name']]}; expected {p['range'][0]} to {p['range'][1]}")
    if request["model"] != MODEL["name"]:
        raise ValueError(f"{request['model']} is no model; expected {MODEL['name']}")
    side, grid = scene["resolution"], scene["samples_per_axis"]
    extent = math.tan(math.radians(scene["camera"]["half_angle"]))
    place = [(2 * (i + 0.5) / (side * grid) - 1) * extent for i in range(side * grid)]
    pick = lambda name, c: values[name][c if len(values[name]) == 3 else 0]
    pixels = array.array("f")
    for row in range(side):
        for column in range(side):
            for c in range(channels):
                pixels.append(sum(radiance(place[column * grid + u], -place[row * grid + v], scene,
                                           values["exponent"][0], pick("specular", c), pick("diffuse", c))
                                  for u in range(grid) for v in range(grid)) / grid ** 2)
    with open(request["image"], "wb") as file:
        pixels.tofile(file)


for line in sys.stdin:
    request = json.loads(line)
    answer = {"id": request["id"]}
    try:
        if request["request"] == "quit":
            break
        if request["request"] == "describe":
            answer.update(protocol=1, renderer="example 1.0", models=[MODEL])
        else:
            render(request)
    except Exception as failure:
        answer["error"] = str(failure)
    print(json.dumps(answer), flush=True)
