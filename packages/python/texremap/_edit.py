"""Converts a material of one model to another model, for every kind of document.

A reader finds a value or a texture for each input. :class:`Edit` tries the translation, to see which results
depend on which textures. A result is then a value, a texture of the source with a scale and a bias, or a
texture that must be converted.
"""

import os

import numpy as np

from . import materials
from ._error import Error
from ._textures import TILE, Texture, baked, png_of, read, tiles_of, write_file

_PROBES = 16
_SAME = 1e-5  # a smaller difference is not visible in a picture
# A lobe whose weight is 0 shows nothing of its other inputs.
_WEIGHTS = {
    "open_pbr_surface": {"fuzz_": "fuzz_weight", "transmission_": "transmission_weight", "subsurface_": "subsurface_weight",
                         "thin_film_": "thin_film_weight", "coat_": "coat_weight", "emission_": "emission_luminance"},
    "standard_surface": {"sheen_": "sheen", "transmission_": "transmission", "subsurface_": "subsurface", "coat_": "coat",
                         "specular_rotation": "specular_anisotropy", "thin_film_": "thin_film_thickness", "emission_": "emission"},
    "gltf_pbr": {"sheen_": "sheen_color", "clearcoat_": "clearcoat", "iridescence_": "iridescence", "dispersion": "transmission",
                 "attenuation_": "transmission", "thickness": "transmission", "anisotropy_": "anisotropy_strength",
                 "alpha_cutoff": "alpha_mode", "emissive": "emissive_strength"},
    "UsdPreviewSurface": {},
}


def _weight_of(model, name):
    return next((weight for prefix, weight in _WEIGHTS[model].items() if name.startswith(prefix) and name != weight), None)


def losses(model, ignored, sources):
    """Returns the inputs in ``ignored`` that change the look of a material. ``sources`` has a value or a
    texture for each input."""
    defaults, lost = materials.MODELS[model], []
    for name in ignored:
        weight, source = _weight_of(model, name), sources.get(name, defaults[name])
        if isinstance(source, Texture):
            lost.append(name)
            continue
        is_plain = np.allclose(source, np.ravel(defaults[name]))
        lobe = sources.get(weight, defaults[weight]) if weight else 1
        if not is_plain and (isinstance(lobe, Texture) or np.any(lobe)):
            lost.append(name)
    return lost


def _fitted(texture, channels):
    """Returns the texture for an input of ``channels`` numbers. If the input is one number, the red of a
    color texture is used."""
    if channels == 1 and texture.is_color():
        return texture._replace(channels="r", scale=texture.scale[:1], bias=texture.bias[:1])
    return texture


class Edit:
    """The inputs of a new surface.

    ``values`` has the constant inputs. ``textures`` has the inputs that are a texture of the source with a
    scale and a bias. ``baked`` has all other inputs: ``{input: {tile: (array, is_deep)}}``.
    """

    def __init__(self, model, sources, makes, translate, target=None):
        """Computes the inputs ``makes`` of the result from ``sources``.

        ``sources`` has a tuple of numbers or a :class:`Texture` for inputs of ``model``. If the model
        ``target`` of the result is given, lobes that are not visible have the defaults of this model.
        """
        self._defaults, self._makes, self._translate = materials.MODELS[model], makes, translate
        self.values, self.textures, self.baked = {}, {}, {}
        self._bakes, self._constants, self._given = {}, {}, {}
        for name, source in sources.items():
            channels = np.size(self._defaults[name])
            if isinstance(source, Texture):
                self._given[name] = _fitted(source, channels)
                continue
            self._constants[name] = np.array((tuple(source) * channels)[:channels], float)
            if not np.isfinite(self._constants[name]).all():
                raise Error(f"{name} is not a finite number", "input")
        results, moves = self._probe()
        for name in makes:
            found, weight = moves[name], _weight_of(target, name) if target else None
            if weight and not moves[weight] and not results[weight][0].any():
                self.values[name] = np.ravel(np.array(materials.MODELS[target][name], float))
            elif not found:
                self.values[name] = results[name][0]
            elif len(found) == 1 and self._connect(name, found[0], results):
                tiles_of(self._given[found[0]].path, found[0])
            else:
                self._bakes[name] = found
        self._bake()

    def _probe(self):
        """Returns the outputs for random values of the textures, and which textures move each output."""
        random = np.random.default_rng(1)
        self._probed = {name: texture.values_of(random.random((_PROBES, 3 if texture.is_color() else 1)))
                        for name, texture in self._given.items()}
        given = {name: np.broadcast_to(value, (_PROBES, value.size)) for name, value in self._constants.items()}
        given.update({name: np.broadcast_to(value, (_PROBES, np.size(self._defaults[name])))
                      for name, value in self._probed.items()})

        def translated(values):
            result = self._translate(values)
            rows = {name: np.atleast_2d(np.asarray(result[name], float)) for name in self._makes}
            return {name: np.broadcast_to(row, (_PROBES, row.shape[1])) for name, row in rows.items()}

        results = translated(given)
        moves = {name: [] for name in self._makes}
        for texture in self._given:
            held = {name: value if name == texture else np.broadcast_to(value[:1], value.shape) for name, value in given.items()}
            for name, values in translated(held).items():
                if np.ptp(values, axis=0).max() > _SAME:
                    moves[name].append(texture)
        return results, moves

    def _connect(self, name, source, results):
        """Keeps the source texture for an output that differs from it only by a scale and a bias. Returns
        whether this was possible."""
        texture, given, made = self._given[source], self._probed[source], results[name]
        if given.shape[1] != made.shape[1]:
            return False
        scales, biases = [], []
        for channel in range(made.shape[1]):
            matrix = np.stack([given[:, channel], np.ones(len(given))], axis=1)
            (scale, bias), *_ = np.linalg.lstsq(matrix, made[:, channel], rcond=None)
            if np.abs(matrix @ (scale, bias) - made[:, channel]).max() > _SAME:
                return False
            scales.append(round(float(scale), 6))
            biases.append(round(float(bias), 6))
        self.textures[name] = texture.scaled(scales, biases)
        return True

    def _bake(self):
        """Converts the textures of the outputs that depend on more than a scale and a bias."""
        needed = sorted({source for sources in self._bakes.values() for source in sources})
        if not needed:
            return
        if len({self._given[name].place for name in needed}) > 1:
            raise Error("its textures use different texture coordinates (give all of them one set of UVs)", "input")
        rest = {name: np.zeros(np.size(self._defaults[name])) for name in self._given if name not in needed}
        given = {name: self._given[name] for name in needed}
        self._model = self._given[needed[0]]
        for tile, (arrays, deep) in baked(self._translate, {**self._constants, **rest}, given, self._bakes).items():
            for name, values in arrays.items():
                self.baked.setdefault(name, {})[tile] = values, deep
        for name, tiles in list(self.baked.items()):
            values = [tile_values for tile_values, _ in tiles.values()]
            first = values[0][0, 0]
            if all((tile == first).all() for tile in values):
                self.values[name] = first
                del self.baked[name]

    def settle(self, name, largest=False):
        """Makes a single value of an input that has no texture in the target: the mean, or the largest value.
        Returns whether it varied."""
        if name in self.values:
            return False
        if name in self.baked:
            texels = [values for values, _ in self.baked.pop(name).values()]
        else:
            texture = self.textures.pop(name)
            texels = [read(texture, tile)[0] for tile in tiles_of(texture.path, name)]
        rows = np.concatenate([values.reshape(-1, values.shape[-1]) for values in texels])
        self.values[name] = rows.max(axis=0) if largest else rows.mean(axis=0)
        return True

    def wrap_and_place(self):
        """Returns how the converted textures are wrapped, and where they lie on the surface."""
        return self._model.wrap, self._model.place

    def put_into_files(self, file_of):
        """Connects the converted textures as PNG files. ``file_of`` returns the path for an input.
        ``write_files`` writes the files."""
        for name, tiles in self.baked.items():
            count = next(iter(tiles.values()))[0].shape[-1]
            scale, bias = self._fit_into_file(name)
            file = file_of(name) if "" in tiles else file_of(name).replace(".png", f".{TILE}.png")
            self.textures[name] = Texture(file, os.path.abspath(file), "rgb" if count == 3 else "r", "sRGB" if count == 3 else "raw",
                                          (scale,) * count, (bias,) * count, *self.wrap_and_place())

    def _fit_into_file(self, name):
        """Brings values into the range of a PNG. Returns the scale and the bias that bring them back."""
        tiles = self.baked[name]
        low = min(float(values.min()) for values, _ in tiles.values())
        high = max(float(values.max()) for values, _ in tiles.values())
        if low >= 0 and high <= 1:
            return 1.0, 0.0
        self.baked[name] = {tile: ((values - low) / (high - low), deep) for tile, (values, deep) in tiles.items()}
        return high - low, low

    def files(self):
        """Returns for each converted texture its path, its texels, and whether it has more than 8 bits."""
        return [(self.textures[name].path.replace(TILE, tile), values, deep)
                for name, tiles in self.baked.items() for tile, (values, deep) in tiles.items()]

    def write_files(self):
        for path, values, deep in self.files():
            write_file(path, png_of(values, values.shape[-1] == 3, deep))
