"""A complete worker (compiler/adapters/PROTOCOL.md) for the renderer of blinn_phong.py. To write your own, replace both."""
import array
import json
import sys

import blinn_phong

MODEL = {"name": "example/blinn-phong", "parameters": [
    {"name": "exponent", "role": "roughness", "convention": "exponent", "range": [0, 10000]},
    {"name": "specular", "role": "specular", "range": [0, 1]}, {"name": "diffuse", "role": "diffuse", "range": [0, 1]}]}


def render(request):
    values, scene, channels = request["parameters"], request["scene"], request["channels"]
    if request["model"] != MODEL["name"]:
        raise ValueError(f"unknown model {request['model']} (choose {MODEL['name']})")
    for p in MODEL["parameters"]:
        if not all(p["range"][0] <= v <= p["range"][1] for v in values[p["name"]]):
            raise ValueError(f"{p['name']} = {values[p['name']]} is out of range ({p['range'][0]} to {p['range'][1]})")
    pictures = [blinn_phong.picture(
        scene["resolution"], scene["samples_per_axis"], scene["camera"]["half_angle"], scene["camera"]["distance"],
        scene["light"]["position"], *(values[p["name"]][c % len(values[p["name"]])] for p in MODEL["parameters"]))
        for c in range(channels)]
    with open(request["image"], "wb") as file:
        array.array("f", (value for pixel in zip(*pictures) for value in pixel)).tofile(file)


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
