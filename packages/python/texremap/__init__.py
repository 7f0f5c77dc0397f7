"""Converts material parameters from one renderer to another, so that both pictures look alike.

>>> import numpy as np, texremap
>>> roughness = np.linspace(0.05, 0.5, 6, dtype=np.float32).reshape(2, 3)
>>> result = texremap.convert(source="mitsuba/ward", target="mitsuba/ggx", roughness=roughness, specular=0.5)
>>> result.roughness.shape, result.roughness.dtype, result.counts.out_of_domain
((2, 3), dtype('float32'), 0)

:func:`convert` converts once, and a :class:`Converter` converts many times. :func:`models` lists the names that
both accept. :func:`path` returns how closely one model can look like another. :func:`read_table` reads a table
of matches. The command ``texremap`` converts files (``pip install OpenImageIO``).
"""

from ._core import __version__
from ._error import Error
from .arrays import Converter, Counts, Material, Model, Path, convert, models, path
from .tables import Table, read_table

__all__ = [
    "Converter", "Counts", "Error", "Material", "Model", "Path", "Table", "__version__", "convert", "models", "path",
    "read_table",
]
