"""Tables of matches, as ``remapc sweep`` writes them."""

import os
from typing import Any, Dict, NamedTuple, Union

import numpy as np
import numpy.typing as npt

from ._error import Error


class Table(NamedTuple):
    """The rows of a table, and the comments of its file."""

    rows: npt.NDArray[Any]
    """A structured array: a field for each column, by its name in the file; float64, or a text such as ``status``."""
    notes: Dict[str, str]
    """``# name: value`` of the head, as texts: ``tool``, ``source``, ``target``, ``source_roughness``, ..."""


def _column(cells):
    """Returns a column as float64, with NaN for an empty cell. If a cell is not a number, returns the texts."""
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells)


def read_table(path: Union[str, "os.PathLike[str]"]) -> Table:
    """Reads a table of matches. This is CSV that begins with comments (docs/formats of the project).

    Returns a :class:`Table`. Raises :class:`Error` of kind ``"input"`` if the file is not such a table.
    """

    def refuse(what):
        raise Error(f"{path}: {what}", "input")

    notes, lines = {}, []
    try:
        with open(path, encoding="utf-8") as file:
            for line in file:
                if not line.startswith("#"):
                    lines.append(line)
                elif ":" in line:
                    name, _, value = line[1:].partition(":")
                    notes[name.strip()] = value.strip()
    except OSError as failure:
        refuse(f"cannot be read: {failure.strerror}")
    except UnicodeDecodeError:
        refuse("is no text")
    if not lines:
        refuse("has no line of column names")
    names = lines[0].strip().split(",")
    if "alpha1" not in names:
        refuse("has no column alpha1, so it is not a table of matches")
    if len(set(names)) != len(names) or not all(names):
        refuse("the first line without # must contain each column name once")
    cells = [line.strip().split(",") for line in lines[1:]]
    for i, row in enumerate(cells):
        if len(row) != len(names):
            refuse(f"row {i + 1} has {len(row)} cells, the head {len(names)}")
    columns = [_column(texts) for texts in zip(*cells)] if cells else [np.zeros(0)] * len(names)
    rows = np.zeros(len(cells), [(name, column.dtype) for name, column in zip(names, columns)])
    for name, column in zip(names, columns):
        rows[name] = column
    return Table(rows, notes)
