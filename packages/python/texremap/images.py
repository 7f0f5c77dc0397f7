"""Images in files, for the command texremap, by OpenImageIO's Python package (the extra ``images``).

The commands of texremap call an object with the methods of :class:`Images`, which calls
:class:`StoredImage` and :class:`NewImage`. A new image keeps as much of the image that it follows as in the
programs of the C++ build (runtime/texture/openimageio).
"""

import io
import os
import tempfile
import threading

import numpy as np

from ._files import create_new

try:
    import OpenImageIO as oiio
except ImportError as failure:
    raise ImportError(
        f"images cannot be read or written: {failure} (pip install OpenImageIO)"
    ) from failure

# This maps the names of pixel types, which are those of OpenImageIO, to NumPy.
_DTYPES = {
    "uint8": np.uint8, "uint16": np.uint16, "uint": np.uint32, "int8": np.int8, "int16": np.int16, "int": np.int32,
    "half": np.float16, "float": np.float32, "double": np.float64,
}
_WHOLE = {name for name, dtype in _DTYPES.items() if np.issubdtype(dtype, np.integer)}

# These attributes describe the pixel coding, and have another meaning in another format.
_CODING = (
    "Compression", "CompressionQuality", "jpeg:subsampling", "tiff:Compression", "tiff:RowsPerStrip",
    "tiff:ColorSpace", "tiff:zipquality", "tiff:PhotometricInterpretation", "png:compressionLevel",
    "oiio:BitsPerSample",
)
_SUMMARIES = ("oiio:SHA-1", "oiio:ConstantColor", "oiio:AverageColor")
_COLOR_SPACE = ("oiio:ColorSpace", "oiio:Gamma", "Exif:ColorSpace", "png:cicp", "CICP")
_NOTED_COLOR_SPACE = "remap:color_space"
_MOST_PARTS = 4096
MOST_TEXELS = 1 << 30  # of an image that is decoded as a whole
_MOST_BYTES_OF_A_BYTE = 1_000_000  # no format packs more bytes of pixels into a byte of the file
_SMALLEST_PNG = 9
_opening = threading.Lock()


def _first_line(text, otherwise):
    return text.split("\n", 1)[0] or otherwise


def _hints():
    """Stops OpenImageIO from multiplying or dividing colors by alpha, because maps hold data."""
    spec = oiio.ImageSpec()
    spec.attribute("oiio:UnassociatedAlpha", 1)
    return spec


def _text(spec, name):
    value = spec.getattribute(name)
    return value if isinstance(value, str) else ""


def _noted(spec, name):
    if _text(spec, name):
        return _text(spec, name)
    for note in _text(spec, "Software").split(";"):
        key, sign, value = note.strip().partition("=")
        if sign and key == name:
            return value
    return None


def _types(spec):
    """Returns the pixel type of each channel."""
    formats = spec.channelformats or [spec.format] * spec.nchannels
    return [str(kind) for kind in formats]


def _is_mixed(spec):
    return len(set(_types(spec))) > 1


# Each format has the position and the bytes of its mark, the extension by which OpenImageIO chooses its importer, and
# the name that OpenImageIO uses.
_MARKS = (
    (0, b"\x89PNG\r\n\x1a\n", "png", "png"), (0, b"\xff\xd8", "jpg", "jpeg"), (8, b"WEBP", "webp", "webp"),
    (0, b"BM", "bmp", "bmp"), (0, b"II*\0", "tif", "tiff"), (0, b"MM\0*", "tif", "tiff"), (0, b"II+\0", "tif", "tiff"),
    (0, b"MM\0+", "tif", "tiff"), (0, b"\x76\x2f\x31\x01", "exr", "openexr"), (0, b"#?", "hdr", "hdr"),
)
_LONGEST_HEAD = 34
_BMP_HEADERS = (40, 52, 56, 108, 124)  # their sizes; a header of 12 bytes has no compression


def _format(head):
    """Returns the extension of a format and its name in OpenImageIO, from the first bytes of a file, or two
    empty texts."""
    for begin, mark, extension, format in _MARKS:
        if head[begin : begin + len(mark)] == mark and (format != "webp" or head[:4] == b"RIFF"):
            return extension, format
    # Targa files do not begin with a mark, so their 18-byte header must have valid values.
    is_targa = len(head) > 18 and head[1] < 2 and head[2] in (1, 2, 3, 9, 10, 11) and head[16] in (8, 15, 16, 24, 32)
    return ("tga", "targa") if is_targa else ("", "")


def _leading_png_chunks(file):
    """Returns the names of the chunks of a PNG before its pixels, and where the chunks claim to end."""
    chunks, place = [], 8
    while True:
        file.seek(place)
        head = file.read(8)
        if len(head) < 8 or head[4:] == b"IDAT":
            return chunks
        place += int.from_bytes(head[:4], "big") + 12
        chunks.append((head[4:], place))


def _examined(file, fail):
    """Returns extension, format and leading PNG chunks of an image. Calls `fail` if its bytes would harm an
    importer."""
    head = file.read(_LONGEST_HEAD)
    extension, format = _format(head)
    chunks = _leading_png_chunks(file) if format == "png" else []
    size = file.seek(0, os.SEEK_END)
    for name, end in chunks:
        if end > size:  # libpng allocates and fills as much as a chunk claims
            fail(f"is damaged: chunk {name.decode('latin-1')} claims to be longer than the file")
    if format == "bmp":
        header, bits, compression = (int.from_bytes(head[at : at + count], "little") for at, count in ((14, 4), (28, 2), (30, 4)))
        fits = compression == 0 or (compression, bits) in ((1, 8), (2, 4), (3, 16), (3, 32))
        if header != 12 and not (fits and header in _BMP_HEADERS):  # importers would read beyond their memory
            fail(f"is damaged, or of an unknown kind: compression {compression} of {bits} bits")
    return extension, format, chunks


def _open_as(format, path):
    """Opens a file only by the importer of `format`, which must be the format of the extension. Returns None
    if the importer refuses it."""
    with _opening:  # the attribute belongs to the process
        others = oiio.get_int_attribute("try_all_readers", 1)
        oiio.attribute("try_all_readers", 0)
        try:
            image = oiio.ImageInput.open(path, _hints())
        finally:
            oiio.attribute("try_all_readers", others)
    return image if image is not None and image.format_name() == format else None


def _require_plausible(spec, size, fail):
    if spec.image_bytes(True) > _MOST_BYTES_OF_A_BYTE * size:
        fail(f"is damaged: claims {spec.width}x{spec.height} texels in {size} bytes")


def _tells_color_space(spec, format, chunks):
    """Returns whether the file states its color space. If it does not, OpenImageIO assumes sRGB for these
    formats."""
    if format == "png":
        return any(name in (b"sRGB", b"gAMA") for name, _ in chunks)
    if format in ("jpeg", "tiff"):
        return spec.getattribute("Exif:ColorSpace") == 1
    return format != "webp"  # webp has no place for it


def _tagged_transfer(spec):
    noted = _noted(spec, _NOTED_COLOR_SPACE)
    if noted:
        return noted if noted in ("linear", "srgb") else None
    name = _text(spec, "oiio:ColorSpace").lower()
    if not name:
        return None
    return "linear" if name.startswith("lin") or name == "scene_linear" else "srgb"


def _lossy_compression(spec, format):
    if format in ("jpeg", "hdr", "webp"):
        return format
    compression = _text(spec, "Compression")
    lossy = compression.startswith(("dwaa", "dwab", "b44", "pxr24", "jpeg"))
    return compression.split(":", 1)[0] if lossy else ""


def _has_compression_level(spec, format):
    compression = _text(spec, "Compression") or "zip"
    return format == "png" or (format in ("openexr", "tiff") and (compression == "zip" or compression.startswith("zip:")))


def _layout(spec, format, path):
    channels = list(zip(spec.channelnames, _types(spec)))
    for name, kind in channels:
        if kind not in _DTYPES:
            raise ValueError(f"{path}: channel {name} has the unsupported type {kind} "
                             "(use integers of up to 32 bits, half, float or double)")
    return {
        "width": spec.width, "height": spec.height, "x": spec.x, "y": spec.y,
        "channels": channels, "alpha_channel": spec.alpha_channel,
        "tile_height": spec.tile_height if spec.tile_width > 0 else 0,
        "format": format, "lossy_compression": _lossy_compression(spec, format),
        "has_compression_level": _has_compression_level(spec, format),
        "tagged_transfer": _tagged_transfer(spec),
    }


class StoredImage:
    """One part of an image file, open for reading."""

    def __init__(self, path, part):
        self._path, self._file, self._part, self._level = path, path, part, 0
        with open(path, "rb") as file:
            extension, self.format, chunks = _examined(file, self._fail)
        if not extension:
            self._fail("cannot be read as an image: unknown format "
                       "(PNG, JPEG, WebP, BMP, TIFF, Targa, OpenEXR and Radiance HDR are read)")
        if not path.lower().endswith("." + extension):  # the content chooses the reader, not the name
            self._folder = tempfile.TemporaryDirectory(prefix="texremap-")
            self._file = os.path.join(self._folder.name, "image." + extension)
            os.symlink(os.path.abspath(path), self._file)
        self._input = _open_as(self.format, self._file)
        if self._input is None:
            self._fail("cannot be read as an image: " + _first_line(oiio.geterror(), "unknown format"))
        self._input.geterror()
        self._find_planes()
        for level in self.levels:
            _require_plausible(level, os.path.getsize(path), self._fail)
        spec = self.spec
        if spec.deep:
            self._fail("deep images are not supported")
        if spec.depth > 1:
            self._fail("volumes are not supported")
        if spec.width < 1 or spec.height < 1:
            self._fail(f"image is empty ({spec.width}x{spec.height})")
        if not _tells_color_space(spec, self.format, chunks):
            for level in self.levels:
                level.erase_attribute("oiio:ColorSpace")

    def _fail(self, what):
        raise ValueError(f"{self._path}: {what}".replace(self._file, self._path))

    def _find_planes(self):
        most = 1 if self.format == "webp" else _MOST_PARTS
        count = 0
        while count < most and self._input.seek_subimage(count, 0):
            count += 1
        self.part_count = count
        if self._part >= count:
            self._fail(f"part {self._part} not found (number of parts: {count})")
        self.levels = []
        while self._input.seek_subimage(self._part, len(self.levels)):
            self.levels.append(oiio.ImageSpec(self._input.spec()))
        self._input.geterror()
        if not self._input.seek_subimage(self._part, 0):
            self._fail("cannot be read: " + _first_line(self._input.geterror(), "no image in it"))
        self._stored_width = [level.width for level in self.levels]
        self.level_count = len(self.levels)
        self.part_name = _text(self.spec, "oiio:subimagename")

    @property
    def spec(self):
        return self.levels[self._level]

    def layout(self):
        return _layout(self.spec, self.format, self._path)

    def select_level(self, level):
        self._level = level

    def set_followed_size(self, width, height):
        """Sets the size of new images that follow this one."""
        spec = self.levels[0]
        if self.level_count > 1:
            self._fail("cannot be resampled, because it has mip levels")
        if (spec.x, spec.y, spec.width, spec.height) != (spec.full_x, spec.full_y, spec.full_width, spec.full_height):
            self._fail("cannot be resampled, because its data window differs from its display window "
                       "(crop it: oiiotool OLD --croptofull -o NEW)")
        spec.width = spec.full_width = width
        spec.height = spec.full_height = height

    def _read(self, begin, end, first_channel, end_channel, kind):
        spec, place = self.spec, (self._part, self._level)
        width = self._stored_width[self._level]
        if spec.tile_width > 0:
            return self._input.read_tiles(*place, spec.x, spec.x + width, begin, end, spec.z, spec.z + 1,
                                          first_channel, end_channel, kind)
        return self._input.read_scanlines(*place, begin, end, spec.z, first_channel, end_channel, kind)

    def read_rows(self, first_row, row_count, texels):
        """Fills ``texels``, writable memory, with rows as they are stored, interleaved and packed."""
        spec = self.spec
        begin, end = spec.y + first_row, spec.y + first_row + row_count
        types = _types(spec)
        if _is_mixed(spec):
            dtype = np.dtype([(f"c{c}", _DTYPES[kind]) for c, kind in enumerate(types)])
            rows = np.frombuffer(texels, dtype)
            for c, kind in enumerate(types):
                values = self._read(begin, end, c, c + 1, kind)
                if values is not None:
                    rows[f"c{c}"] = values.reshape(-1)
        else:
            values = self._read(begin, end, 0, spec.nchannels, types[0])
            if values is not None:
                np.frombuffer(texels, _DTYPES[types[0]])[:] = values.reshape(-1)
        # Truncated files are read "successfully"; only the message reveals the error.
        message = self._input.geterror()
        if values is None or message:
            self._fail(f"rows {first_row} to {first_row + row_count - 1} cannot be read: "
                       f"{_first_line(message, 'unknown reason')} (the file may be truncated)")

    def noted_metadata(self, name):
        """Returns what an earlier run wrote under ``name``, as an attribute or in the tag Software, or None."""
        return _noted(self.levels[0], name)


def _stored_type(format, kind):
    """Returns the type in which ``format`` stores values with the least loss, or None for unsupported
    formats."""
    if format == "openexr":
        if kind in ("half", "float", "uint"):
            return kind
        return "half" if kind in ("uint8", "int8") else "float"
    if format == "tiff":
        return "float" if kind == "half" else kind
    if format == "hdr":
        return "float"
    if format == "png":
        return kind if kind == "uint8" else "uint16"
    return "uint8" if format in ("jpeg", "targa", "bmp") else None


def _choose_channels(spec, names):
    spec.set_format(oiio.TypeDesc(_types(spec)[0]))
    spec.channelformats = ()
    spec.nchannels = len(names)
    spec.channelnames = tuple(names)
    spec.alpha_channel = names.index("A") if "A" in names else -1
    if spec.alpha_channel >= 0:
        spec.attribute("oiio:UnassociatedAlpha", 1)
    spec.z_channel = -1
    spec.erase_attribute("ICCProfile.*")
    spec.erase_attribute("tiff:PhotometricInterpretation")


def _leave_coding_behind(spec, output):
    for name in _CODING:
        spec.erase_attribute(name)
    sides_fit = output.format_name() != "tiff" or (spec.tile_width % 16 == 0 and spec.tile_height % 16 == 0)
    if not output.supports("tiles") or not sides_fit:
        spec.tile_width = spec.tile_height = spec.tile_depth = 0


def _suit_format(spec, format):
    # TIFF tags associated alpha and stores it unchanged; the other formats would divide by it.
    if format != "tiff" or spec.alpha_channel < 0:
        spec.attribute("oiio:UnassociatedAlpha", 1)
    # Writers add the time of the run. Equal inputs would then not give equal files.
    if not _text(spec, "DateTime") and format in ("openexr", "tiff"):
        spec.attribute("DateTime", "")
    if format == "openexr":
        spec.attribute("openexr:lineOrder", "increasingY")
        level, compression = spec.getattribute("openexr:dwaCompressionLevel"), _text(spec, "Compression")
        if level and compression.startswith("dwa") and ":" not in compression:
            spec.attribute("Compression", f"{compression}:{round(level)}")
    if format == "tiff":
        if any(value.name.startswith("IPTC:") for value in spec.extra_attribs):
            spec.attribute("tiff:write_iptc", 1)
        if str(spec.format) == "half":
            spec.attribute("tiff:half", 1)
    if format == "jpeg":
        spec.attribute("Compression", "jpeg:100")
        spec.attribute("jpeg:subsampling", "4:4:4")
    if format in ("tiff", "jpeg") and _text(spec, "IPTC:Creator") == _text(spec, "Artist"):
        spec.erase_attribute("IPTC:Creator")
    # OpenImageIO appends its version to the name of the program each time it writes a Targa file.
    own = " " + ".".join(oiio.__version__.split(".")[:2])
    if format == "targa" and _text(spec, "Software").endswith(own):
        spec.attribute("Software", _text(spec, "Software")[: -len(own)])


def _tag_colors(spec, format, kind, follows, changes, metadata):
    is_whole, is_color = kind in _WHOLE, changes["is_color"]
    transfer = changes["transfer_of_whole" if is_whole else "transfer_of_floats"] if is_color else None
    if is_color and follows and (not is_whole or transfer == changes["followed_transfer"]):
        return
    # Data never has a tag, even if the file that it follows has one.
    for name in _COLOR_SPACE:
        spec.erase_attribute(name)
    if not is_color:
        return
    spec.attribute("oiio:ColorSpace", "sRGB" if transfer == "srgb" else "Linear")
    is_usual = transfer == ("srgb" if is_whole else "linear")
    if not is_usual and format != "png":
        metadata.append((_NOTED_COLOR_SPACE, transfer))


def _output_spec(model, model_format, output, changes, path):
    """Returns the description of a new file that equals ``model`` except for ``changes``, as far as its
    format allows."""
    format = output.format_name()

    def fail(what):
        raise ValueError(f"{path}: format {format} {what}")

    spec = oiio.ImageSpec(model)
    for name in _SUMMARIES:
        spec.erase_attribute(name)
    if changes["channels"] is not None:
        _choose_channels(spec, changes["channels"])
    if not output.supports("nchannels"):
        has_alpha = spec.alpha_channel >= 0
        if spec.nchannels - has_alpha not in (1, 3) or (has_alpha and not output.supports("alpha")):
            fail(f"cannot hold the {spec.nchannels} channels of the source (use --format exr or --format tif)")
    if not output.supports("channelformats"):
        spec.channelformats = ()
    if _is_mixed(spec) and not changes["type"]:
        fail("with channels of several types can only be written by the C++ program (use --type)")
    kind = changes["type"] or _types(spec)[0]
    keeps_half = format == "tiff" and model_format == format and str(model.format) == "half" == kind
    stored = kind if keeps_half else _stored_type(format, kind)
    if stored is None:
        fail("is not supported for writing (use --format exr, tif or png)")
    if changes["type"] and stored != changes["type"]:
        fail(f"cannot hold {kind} pixels (use --type {stored})")
    if stored != str(model.format):
        spec.erase_attribute("oiio:BitsPerSample")
    spec.set_format(oiio.TypeDesc(stored))
    spec.channelformats = ()

    is_whole = str(model.format) in _WHOLE
    follows = format == model_format and changes["channels"] is None and is_whole == (stored in _WHOLE)
    metadata = list(changes["metadata"])
    _tag_colors(spec, format, stored, follows, changes, metadata)
    if format != model_format:
        _leave_coding_behind(spec, output)
    _suit_format(spec, format)
    level = changes["compression_level"]
    if level is not None and _has_compression_level(spec, format):
        if format == "png":
            spec.attribute("png:compressionLevel", level)
        else:
            spec.attribute("Compression", f"zip:{level}")
    for name, value in metadata:
        spec.attribute(name, value)
    # TIFF and JPEG have no custom attributes, so the tag for the writing program holds them.
    if metadata and format in ("tiff", "jpeg"):
        spec.attribute("Software", "; ".join(f"{name}={value}" for name, value in metadata))
    return spec


def _for_writer(spec, format):
    """Returns ``spec``, always with a color space. Otherwise OpenImageIO would tag every PNG as sRGB, even
    data."""
    if format != "png" or _text(spec, "oiio:ColorSpace"):
        return spec
    spec = oiio.ImageSpec(spec)
    spec.attribute("oiio:ColorSpace", "unknown")
    return spec


class NewImage:
    """An image that is written to ``unfinished``. The caller gives the finished file its name ``path``.

    ``parts`` has for each part the :class:`StoredImage` that it follows, and the changes.
    """

    def __init__(self, path, unfinished, parts):
        self._path, self._unfinished = path, unfinished
        self._output = oiio.ImageOutput.create(path)
        if self._output is None:
            oiio.geterror()
            self._fail("unknown image format (use .exr, .tif, .png, ...)")
        output = self._output
        self._format = output.format_name()
        if len(parts) > 1 and not output.supports("multiimage"):
            self._fail(f"format {self._format} cannot hold {len(parts)} parts (use --format exr or --format tif)")
        model_format = parts[0][0].format
        self._specs = []
        for model, changes in parts:
            levels = []
            for spec in model.levels:
                levels.append(_output_spec(spec, model_format, output, changes, path))
                has_levels = output.supports("mipmap") or (
                    model_format == self._format and output.supports("multiimage") and len(parts) == 1)
                if levels[-1].tile_width == 0 or not has_levels:
                    break
            self._specs.append(levels)
        self._plane, self._is_open, self._plane_is_open = (0, 0), False, False
        try:
            create_new(unfinished)
        except OSError as failure:
            self._fail(f"cannot be written: {failure.strerror}")

    def _fail(self, what):
        raise ValueError(f"{self._path}: {what}".replace(self._unfinished, self._path))

    def _check(self, done):
        message = self._output.geterror()
        if not done:
            self._fail("cannot be written: " + _first_line(message, "unknown reason"))

    def level_count(self, part):
        return len(self._specs[part])

    def layout(self, part, level):
        return _layout(self._specs[part][level], self._format, self._path)

    def select(self, part, level):
        """Selects the next plane: all levels of a part in order, then the next part."""
        self._plane, self._plane_is_open = (part, level), False

    def _open_plane(self):
        part, level = self._plane
        spec = _for_writer(self._specs[part][level], self._format)
        if not self._is_open:
            firsts = tuple(levels[0] for levels in self._specs)
            if len(firsts) > 1 and self._format == "openexr":  # needs all parts at once
                self._check(self._output.open(self._unfinished, firsts))
            else:
                self._check(self._output.open(self._unfinished, spec))
            self._is_open = True
        else:
            is_level = level > 0 and self._output.supports("mipmap")
            self._check(self._output.open(self._unfinished, spec, "AppendMIPLevel" if is_level else "AppendSubimage"))
        if _types(self._output.spec()) != _types(spec):
            self._fail(f"cannot be written: format {self._format} would change the pixel type (use exr or tif)")
        self._plane_is_open = True

    def write_rows(self, first_row, row_count, texels):
        """Writes the next rows from the top: ``texels``, memory with interleaved and packed values."""
        if not self._plane_is_open:
            self._open_plane()
        part, level = self._plane
        spec = self._specs[part][level]
        begin, end = spec.y + first_row, spec.y + first_row + row_count
        values = np.frombuffer(texels, _DTYPES[str(spec.format)]).reshape(row_count, spec.width, spec.nchannels)
        if spec.tile_width > 0:
            done = self._output.write_tiles(spec.x, spec.x + spec.width, begin, end, spec.z, spec.z + 1, values)
        else:
            done = self._output.write_scanlines(begin, end, spec.z, values)
        self._check(done)

    def finish(self):
        """Closes the file and reads it back, to check that all rows of the last plane exist."""
        self._check(self._output.close())
        self._output = None
        part, level = self._plane
        spec = self._specs[part][level]
        image = oiio.ImageInput.open(self._unfinished, _hints())
        is_whole = image is not None and image.seek_subimage(part, level)
        if is_whole:
            found = image.spec()
            is_whole = (found.width, found.height, _types(found)) == (spec.width, spec.height, _types(spec))
        if is_whole and self._format == "tiff":
            unit = max(spec.tile_height, 1)
            first = (spec.height - 1) // unit * unit
            place = (part, level)
            if spec.tile_width > 0:
                rows = image.read_tiles(*place, spec.x, spec.x + spec.width, spec.y + first, spec.y + spec.height,
                                        spec.z, spec.z + 1, 0, spec.nchannels, str(spec.format))
            else:
                rows = image.read_scanlines(*place, spec.y + first, spec.y + spec.height, spec.z, 0, spec.nchannels,
                                            str(spec.format))
            is_whole = rows is not None and not image.geterror()
        if not is_whole:
            self._fail("cannot be written completely (check the free space)")

    def abandon(self):
        self._output = None


_UNREAD = ((0, b"\xabKTX", "KTX2"), (4, b"ftypavif", "AVIF"), (0, b"DDS ", "DDS"))


class Images:
    """Opens and creates images in files, and decodes and encodes those that assets embed."""

    def set_thread_count(self, count):
        oiio.attribute("threads", count)
        oiio.attribute("exr_threads", -1 if count == 1 else count)

    def open(self, path, part):
        return StoredImage(path, part)

    def create(self, path, unfinished, parts):
        return NewImage(path, unfinished, parts)

    def decode(self, data, place):
        """Returns (width, height, channels, pixel type, bytes) of an image in memory. The type is uint8 or
        uint16. Colors are not multiplied by alpha."""
        def fail(what):
            raise ValueError(f"{place}: {what}")

        extension, format, _ = _examined(io.BytesIO(data), fail)
        for begin, mark, name in _UNREAD:
            if data[begin : begin + len(mark)] == mark:
                fail(f"is {name}, which is not read (convert it to PNG)")
        if extension in ("", "exr", "hdr"):
            fail("is not an image of a known format (PNG, JPEG, WebP, BMP, TIFF, Targa)")

        def refuse(reason):
            fail(f"cannot be read: {_first_line(reason, 'the image is damaged')}")

        with tempfile.TemporaryDirectory(prefix="texremap-") as folder:  # its Python package only reads files
            path = os.path.join(folder, "image." + extension)
            with open(path, "wb") as file:
                file.write(data)
            image = _open_as(format, path)
            if image is None:
                refuse(oiio.geterror())
            _require_plausible(image.spec(), len(data), fail)
            return self._decoded(image, refuse)

    @staticmethod
    def _decoded(image, refuse):
        spec = image.spec()
        if not (0 < spec.width and 0 < spec.height and spec.width * spec.height <= MOST_TEXELS and 1 <= spec.nchannels <= 4):
            refuse("its size or its number of channels is none of an image of an asset")
        kind = "uint16" if np.dtype(_DTYPES.get(str(spec.format), np.uint8)).itemsize > 1 else "uint8"
        values = image.read_image(0, 0, 0, spec.nchannels, kind)
        message = image.geterror()
        image.close()
        if values is None or message:
            refuse(message)
        return spec.width, spec.height, spec.nchannels, kind, values.tobytes()

    def _encoded(self, extension, width, height, channels, kind, texels, settings):
        spec = oiio.ImageSpec(width, height, channels, kind)
        spec.attribute("oiio:UnassociatedAlpha", 1)
        for name, value in settings.items():
            spec.attribute(name, value)
        values = np.frombuffer(texels, _DTYPES[kind]).reshape(height, width, channels)
        with tempfile.TemporaryDirectory(prefix="texremap-") as folder:
            path = os.path.join(folder, "image." + extension)
            output = oiio.ImageOutput.create(path)
            if not (output.open(path, _for_writer(spec, output.format_name())) and output.write_image(values) and output.close()):
                raise ValueError(f"{extension} image: cannot be encoded: {output.geterror()}")
            with open(path, "rb") as file:
                return file.read()

    def encode_png(self, width, height, channels, kind, texels, level):
        image = (width, height, channels, kind, texels)
        if level < _SMALLEST_PNG:
            return self._encoded("png", *image, {"png:compressionLevel": level})
        # Images of few values are smaller without filters.
        tries = ({}, {"png:filter": 8})
        return min((self._encoded("png", *image, {"png:compressionLevel": level, **more}) for more in tries),
                   key=len)

    def encode_jpeg(self, width, height, channels, kind, texels, quality):
        return self._encoded("jpg", width, height, channels, kind, texels, {"CompressionQuality": quality})
