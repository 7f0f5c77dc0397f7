"""What a reader of documents finds in a material, and what the commands report about it."""

import json
import os
import sys
from typing import Dict, List, NamedTuple, Tuple, Union

from ._error import Error
from ._textures import Texture


class Surface(NamedTuple):
    """The surface of a material."""

    model: str
    sources: Dict[str, Union[Tuple[float, ...], Texture]]
    """What feeds each input of the model."""
    normals: Dict[str, Texture]
    """``"normal"`` and ``"coat_normal"``, with values from -1 to 1."""
    lost: List[str]
    """Inputs that the reader passes over, each with a reason."""


class MaterialReport(NamedTuple):
    """The result of the conversion of one material."""

    path: str
    state: str
    """``"converted"``, ``"left"`` (there is nothing to convert) or ``"failed"``."""
    reason: str = ""
    textures: Tuple[str, ...] = ()
    """The files that were written for it."""
    lost: Tuple[str, ...] = ()
    """Inputs that the result does not show, each with a reason behind a colon, or without one where the target lacks the input."""


def require_output(source, output, endings, force):
    """Raises :class:`Error` if ``output`` has an unsuitable extension, is the input, or exists."""
    if os.path.splitext(output)[1].lower() not in endings:
        raise Error(f"{output}: the file name must end with {', '.join(endings[:-1])} or {endings[-1]}", "output")
    if os.path.exists(output) and os.path.exists(source) and os.path.samefile(source, output):
        raise Error(f"{output}: is the input (choose another name)", "output")
    if os.path.exists(output) and not force:
        raise Error(f"{output}: exists (use --force to replace it)", "output")


def _line_of(report):
    if report.state != "converted":
        return f"{report.state}: {report.reason}"
    lost = f"; not converted: {', '.join(report.lost)}" if report.lost else ""
    return "converted" + "".join(f", {file}" for file in report.textures) + lost


def run(convert, output, as_json):
    """Prints the reports of ``convert()``. Returns the exit code."""
    try:
        reports = convert()
    except Error as failure:
        print(f"texremap: {failure}", file=sys.stderr)
        return 2 if failure.kind == "usage" else 1
    for report in reports:
        if as_json:
            print(json.dumps(report._asdict()))
        else:
            print(f"texremap: {report.path}: {_line_of(report)}", file=sys.stderr)
    counts = [sum(report.state == state for report in reports) for state in ("converted", "left", "failed")]
    if not as_json:
        print("texremap: {}: {} converted, {} left unchanged, {} failed".format(output, *counts), file=sys.stderr)
    return 1 if counts[2] else 0
