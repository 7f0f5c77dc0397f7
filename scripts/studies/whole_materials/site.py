"""Writes a web page that shows each material as it is, as the translation in use makes it, and as ours does, with the
errors below."""
import html
import json
import pathlib
import struct
import zlib

import numpy as np

import materialx_shaders as shaders
from whole_materials import generator, in_use, judge, pictures, principled

SIDE, SAMPLES = 128, 2
RANDOM = {"open_pbr_surface": 8, "standard_surface": 4, "UsdPreviewSurface": 3, "gltf_pbr": 2, "principled": 3}
NAMES = {"open_pbr_surface": "OpenPBR", "standard_surface": "standard_surface", "gltf_pbr": "glTF PBR",
         "UsdPreviewSurface": "UsdPreviewSurface", "UsdPreviewSurface_specular": "UsdPreviewSurface, specular workflow",
         "principled": "Principled", "gltf_pbr_core": "glTF PBR without extensions"}
MOST_BYTES = 15_000_000


def studio():
    """Returns the lights of the pictures, in sets for one pass each: a soft box, a strip at the right, and dim light
    from all directions.

    Many small lights represent a large light. They are closer together than the width of the highlights of documents.
    """
    box = [((-0.95 + 0.13 * x, 0.3 + 0.13 * y, 1.1), (0.021,) * 3) for x in range(8) for y in range(6)]
    strip = [((1.6, -0.8 + 0.16 * y, 0.3), (0.034, 0.04, 0.05)) for y in range(11)]
    around = [((np.sin(a), np.cos(a), 0.45), (0.025, 0.023, 0.02)) for a in np.arange(13) * 2 * np.pi / 13]
    lights = [shaders.Light(shaders.DIRECTIONAL, tuple(map(float, vector)), tuple(np.pi * np.array(color)))
              for vector, color in box + strip + around]
    return [lights[first:first + shaders.MOST_LIGHTS] for first in range(0, len(lights), shaders.MOST_LIGHTS)]


def filtered(row, above, channels):
    """Returns a row of a PNG file with the filter that gives the smallest differences: none, left, above, or Paeth's
    filter of left and above."""
    left, corner = (np.concatenate([np.zeros(channels, int), one[:-channels]]) for one in (row, above))
    guess = left + above - corner
    near = np.abs(np.stack([guess - one for one in (left, above, corner)])).argmin(axis=0)
    paeth = np.choose(near, (left, above, corner))
    rows = [(number, (row - guess) % 256) for number, guess in ((0, 0), (1, left), (2, above), (4, paeth))]
    number, best = min(rows, key=lambda one: np.minimum(one[1], 256 - one[1]).sum())
    return bytes([number]) + best.astype(np.uint8).tobytes()


def png(pixels):
    """Returns the bytes of a PNG file of 8 bits, with alpha if the pixels have four channels."""
    height, width, channels = pixels.shape
    lines = np.concatenate([np.zeros((1, width * channels), int), pixels.reshape(height, -1).astype(int)])
    rows = b"".join(filtered(row, above, channels) for row, above in zip(lines[1:], lines))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def portrait(stage, shader, values, side=SIDE):
    """Returns the pixels of a sphere in the studio, from 0 to 1: display values, and how much of each pixel the
    sphere covers."""
    linear = sum(shader.render(values, stage.move(lights), side * SAMPLES, stage.camera) for lights in studio())
    covered = pictures.inside(side * SAMPLES).astype(float)[..., None]
    small = [part.reshape(side, SAMPLES, side, SAMPLES, -1).mean(axis=(1, 3)) for part in (linear, covered)]
    return np.concatenate([pictures.display(small[0] / np.maximum(small[1], 1e-6)), small[1]], axis=-1)


def portrait_file(stage, shader, values):
    """Returns the bytes of a PNG file of a sphere on a transparent background."""
    return png(np.round(255 * portrait(stage, shader, values)).astype(np.uint8))


def subjects(examples, seed):
    """Returns kind, name, direction and values of everything on the page, and what is skipped."""
    found, skipped = examples
    found = [("document", name, model, values) for name, model, values in found]
    for model, count in RANDOM.items():
        for number, values in enumerate(generator.materials(model, seed, count)):
            found.append(("random", f"{NAMES[model]} {number + 1}", model, values))
    return [(kind, name, direction, values) for kind, name, model, values in found
            for direction in judge.DIRECTIONS if direction[0] == model], skipped


def row_of(number, subject, translations, folder):
    """Renders one row of the page into the folder, and returns what it shows."""
    kind, name, direction, values = subject
    stage, source = pictures.stage(direction[0]), pictures.shader_of(direction[0])
    reference = stage.under_both(source, values)
    row = {"kind": kind, "name": name, "from": NAMES[direction[0]], "to": NAMES[direction[1]], "in_use": in_use.name_of(direction),
           "values": described(values), "source": f"{number:03}-source.png"}
    (folder / row["source"]).write_bytes(portrait_file(stage, source, values))
    for who, version in judge.versions(direction, values, translations).items():
        file = f"{number:03}-{who.replace(' ', '-')}.png"
        (folder / file).write_bytes(portrait_file(stage, *version))
        row[who] = {"file": file, **pictures.errors(reference, stage.under_both(*version))}
    return row


def described(values):
    """Returns the inputs as a line of text."""
    words = []
    for name, value in values.items():
        numbers = " ".join(f"{part:.3g}" for part in (value if isinstance(value, tuple) else (value,)))
        words.append(f"{name} {numbers}")
    return ", ".join(words)


def cell(row, who):
    if who not in row:
        return '<td class="none">-</td>'
    one = row[who]
    words = f"{row['name']}, {who if who == judge.OURS else row['in_use']}"
    return (f'<td data-value="{one["linear"]:.6f}"><img loading="lazy" width="{SIDE}" height="{SIDE}" src="pictures/{one["file"]}" '
            f'alt="{html.escape(words)}"><br><b>{one["linear"]:.3f}</b> <span>({one["display"]:.3f})</span></td>')


def line(row):
    name = html.escape(row["name"].replace("_", " "))
    gain = row[judge.IN_USE]["linear"] - row[judge.OURS]["linear"] if judge.OURS in row else 0
    return (f'<tr data-direction="{row["from"]} to {row["to"]}" data-kind="{row["kind"]}"><th scope="row" data-value="{name}">{name}'
            f'<details><summary>inputs</summary>{html.escape(row["values"])}</details></th>'
            f'<td data-value="{row["from"]} to {row["to"]}">{row["from"]}<br>to {row["to"]}<br><span>in use: {row["in_use"]}</span></td>'
            f'<td data-value="{name}"><img loading="lazy" width="{SIDE}" height="{SIDE}" src="pictures/{row["source"]}" '
            f'alt="{name}, source"><br>source</td>{cell(row, judge.IN_USE)}{cell(row, judge.OURS)}'
            f'<td data-value="{gain:.6f}">{gain:+.3f}</td></tr>')


def page(rows, seed, skipped):
    """Returns the text of index.html."""
    text = pathlib.Path(__file__).with_name("site.html").read_text()
    directions = sorted({f"{row['from']} to {row['to']}" for row in rows})
    for mark, words in {"ROWS": "\n".join(map(line, rows)), "SEED": seed, "VERSION": shaders.mx.getVersionString(), "COUNT": len(rows),
                        "SKIPPED": len(skipped), "DIRECTIONS": "".join(f"<option>{one}</option>" for one in directions)}.items():
        text = text.replace("{{" + mark + "}}", str(words))
    return text


def write(folder, examples, seed, translations, say):
    """Writes index.html, pictures and scoreboard.json into a folder. Returns the rows and the size in bytes."""
    folder = pathlib.Path(folder)
    (folder / "pictures").mkdir(parents=True, exist_ok=True)
    wanted, skipped = subjects(examples, seed)
    rows, missing = [], None
    for number, subject in enumerate(wanted):
        try:
            rows.append(row_of(number, subject, translations, folder / "pictures"))
        except principled.Missing as reason:
            missing = reason
    if missing:
        say(f"principled is skipped: {missing}")
    (folder / "index.html").write_text(page(rows, seed, skipped))
    (folder / "scoreboard.json").write_text(json.dumps({"seed": seed, "materialx": shaders.mx.getVersionString(), "rows": rows,
                                                        "skipped": skipped}, indent=1))
    size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
    if size > MOST_BYTES:
        say(f"{folder}: {size / 1e6:.1f} MB are more than {MOST_BYTES / 1e6:.0f} MB")
    return rows, size
