"""Runs the protocol (PROTOCOL.md) of a worker, for a renderer module with a description and a function that renders.

Standard output of the renderer is redirected to standard error, so that standard output holds answers only.
"""
import json
import math
import os
import sys

import numpy as np


class Refused(Exception):
    """A request that cannot be met. The worker answers with this error and continues."""


def parameter(name, role, least, most, **more):
    return {"name": name, "role": role, "range": [least, most], **more}


def check_material(models, request):
    """Checks names and ranges of the request and returns its values."""
    model = next((m for m in models if m["name"] == request["model"]), None)
    if model is None:
        raise Refused(f"unknown model {request['model']} (choose {', '.join(m['name'] for m in models)})")
    values = request["parameters"]
    for described in model["parameters"]:
        name, (least, most) = described["name"], described["range"]
        if name not in values:
            raise Refused(f"{name} has no value")
        if isinstance(values[name], dict):
            values[name] = read_map(model, described, values[name])
            continue
        if described.get("grey") and len(values[name]) != 1:
            raise Refused(f"{name} has {len(values[name])} values, but takes one")
        for value in values[name]:
            if not least <= value <= most:
                raise Refused(f"{name} = {value} is out of range ({least} to {most})")
    return values


def read_map(model, described, place):
    """Returns the map of a parameter as an array of rows x columns x channels, row 0 at the top."""
    name, (least, most) = described["name"], described["range"]
    if not model.get("textures") or described["role"] == "other":
        raise Refused(f"{name} accepts no map (send a list of numbers)")
    texels = read_floats(place["map"], place["height"], place["width"], place["channels"])
    if place["channels"] != 1 and (described.get("grey") or described["role"] == "roughness"):
        raise Refused(f"the map of {name} has {place['channels']} channels, but {name} takes one")
    if not (least <= texels.min() and texels.max() <= most):
        raise Refused(f"the map of {name} has values from {texels.min()} to {texels.max()}, but the range is {least} to {most}")
    return texels


def read_floats(path, *shape):
    texels = np.fromfile(path, np.float32)
    if texels.size != math.prod(shape):
        raise Refused(f"{path} has {texels.size} values, not {math.prod(shape)}")
    return texels.reshape(shape)


def environment_of(request):
    """Returns the radiance of the environment, rows x columns x 3, or None if a point light shines."""
    light = request["scene"]["light"]
    return read_floats(light["environment"], light["height"], light["width"], 3) if "environment" in light else None


def has_maps(values):
    return any(isinstance(value, np.ndarray) for value in values.values())


def grey_or_rgb(values):
    """Returns three numbers for a parameter with one or three."""
    return list(values) * 3 if len(values) == 1 else list(values)


def write_picture(request, picture):
    """Writes `picture`, rows x columns x 3, or rows x columns if all channels are equal."""
    picture = np.asarray(picture, np.float32)
    if picture.ndim == 2:
        picture = np.repeat(picture[:, :, None], 3, axis=2)
    if request["channels"] == 1:
        picture = picture[:, :, 1]
    np.ascontiguousarray(picture, np.float32).tofile(request["image"])


def serve(describe, render):
    """Answers requests. `describe(threads)` returns renderer and models. `render(request, values)` returns a picture,
    top row first."""
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)

    def answer(**fields):
        answers.write(json.dumps(fields) + "\n")
        answers.flush()

    described = None
    for line in sys.stdin:
        request = json.loads(line)
        number = request.get("id")
        try:
            if request["request"] == "quit":
                break
            if request["request"] == "describe":
                if request["protocol"] != 1:
                    raise Refused(f"protocol version {request['protocol']} is not supported (this worker speaks 1)")
                described = describe(request.get("threads", 1))
                answer(id=number, protocol=1, **described)
            elif request["request"] == "render" and described is not None:
                values = check_material(described["models"], request)
                write_picture(request, render(request, values))
                answer(id=number)
            else:
                raise Refused(f"unexpected request {request['request']} (send describe first, then render or quit)")
        except Refused as refused:
            answer(id=number, error=str(refused))
        except Exception as failure:  # errors of the renderer become answers
            answer(id=number, error=f"{type(failure).__name__}: {failure}".replace("\n", " "))
    sys.stderr.flush()
    os._exit(0)  # some renderers abort during the shutdown of the interpreter
