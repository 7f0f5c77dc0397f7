"""Draws sheets of spheres for the pages."""
import numpy as np
from PIL import Image, ImageDraw

from offers.pages import ROOT
from offers.spheres import Sphere


def picture(path, rows, columns, sets):
    """Draws each sphere under both sets of lights. `rows` holds (name, source of points, {column: target of points}).
    """
    side, gap, head = 96, 6, 16
    spheres = [Sphere(lights, side) for lights in sets.values()]
    width = len(spheres) * (len(columns) + 1) * (side + gap) + gap
    sheet = Image.new("RGB", (width, head + len(rows) * (side + head)), (40, 40, 40))
    draw = ImageDraw.Draw(sheet)
    for s, (lights, sphere) in enumerate(zip(sets, spheres)):
        for c, column in enumerate(["source", *columns]):
            x = gap + (s * (len(columns) + 1) + c) * (side + gap)
            draw.text((x, 2), f"{column}" + (f" ({lights})" if c == 0 else ""), fill=(230, 230, 230))
            for r, (name, source, targets) in enumerate(rows):
                pixels = np.full((side, side, 3), 40 / 255)
                pixels[sphere.mask] = sphere.source(source(sphere.uv)) if c == 0 else sphere.target(targets[column](sphere.uv))
                y = head + r * (side + head)
                sheet.paste(Image.fromarray((pixels * 255 + 0.5).astype(np.uint8)), (x, y))
                if s == 0 and c == 0:
                    draw.text((x, y + side), name, fill=(230, 230, 230))
    sheet.quantize(256, palette=sheet.quantize(256), dither=Image.Dither.FLOYDSTEINBERG).save(path, optimize=True)
    print(f"{path.relative_to(ROOT)}: {path.stat().st_size} bytes")
