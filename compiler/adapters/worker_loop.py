"""The conversation of a worker (PROTOCOL.md): a renderer module gives a description and a function that renders.

What a renderer prints on standard output goes to standard error, so that only answers stand there.
"""
import json
import os
import sys

import numpy as np


class Refused(Exception):
    """A request that cannot be met: becomes the answer, and the worker lives on."""


def parameter(name, role, least, most, **more):
    return {"name": name, "role": role, "range": [least, most], **more}


def check_material(models, request):
    """The values of the request, after a check of names and ranges."""
    model = next((m for m in models if m["name"] == request["model"]), None)
    if model is None:
        raise Refused(f"{request['model']} is no model; expected one of {', '.join(m['name'] for m in models)}")
    values = request["parameters"]
    for described in model["parameters"]:
        name, (least, most) = described["name"], described["range"]
        if name not in values:
            raise Refused(f"{name} is missing")
        if described.get("grey") and len(values[name]) != 1:
            raise Refused(f"{name} has {len(values[name])} values; expected one: the model has no color in it")
        for value in values[name]:
            if not least <= value <= most:
                raise Refused(f"{name} is {value}; expected {least} to {most}")
    return values


def grey_or_rgb(values):
    """Three numbers of a parameter that has one or three."""
    return list(values) * 3 if len(values) == 1 else list(values)


def write_picture(request, picture):
    """`picture`: rows x columns x 3, or rows x columns where every channel is the same."""
    picture = np.asarray(picture, np.float32)
    if picture.ndim == 2:
        picture = np.repeat(picture[:, :, None], 3, axis=2)
    if request["channels"] == 1:
        picture = picture[:, :, 1]
    np.ascontiguousarray(picture, np.float32).tofile(request["image"])


def serve(describe, render):
    """`describe(threads)` gives renderer and models; `render(request, values)` the picture, row 0 at the top."""
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
                    raise Refused(f"protocol is {request['protocol']}; expected 1")
                described = describe(request.get("threads", 1))
                answer(id=number, protocol=1, **described)
            elif request["request"] == "render" and described is not None:
                values = check_material(described["models"], request)
                write_picture(request, render(request, values))
                answer(id=number)
            else:
                raise Refused(f"{request['request']} is not known here; expected describe, then render or quit")
        except Refused as refused:
            answer(id=number, error=str(refused))
        except Exception as failure:  # whatever a renderer throws is the answer to this request
            answer(id=number, error=f"{type(failure).__name__}: {failure}".replace("\n", " "))
    sys.stderr.flush()
    os._exit(0)  # some renderers abort when the interpreter takes them down
