"""Reads and writes the pages of docs/adopting: the constants in their code, their code blocks, their tables."""
import math
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
PAGES = ROOT / "docs" / "adopting"

WIDTH = re.compile(r"(?P<a>\d+\.\d+)(?P<s>f?) / \((?:(?P<t>\d+\.\d+)f? \* )?(?P<n>n|exponent) \+ (?P<b>\d+\.\d+)f?\)")
STRENGTH = re.compile(r"(?P<a>\d+\.\d+)(?P<s>f?) \* (?P<k>[\w.\[\]]+) / "
                      r"\((?:(?P<t>\d+\.\d+)f? \* )?(?P<n>n|exponent) \+ (?P<b>\d+\.\d+)f?\)")


# [a, b, c, d, e] stands for roughness = (a / (e n + b))^(1/4), F0 = min(1, c Ks / (e n + d))
# (docs/decisions/060-short-forms.md).
SHORT_FORMS = {"blinn": [1.55, 4.17, 6.02, 1.86, 1.0], "phong": [1.44, 4.26, 6.06, 2.46, 2.83]}


# Pages about whole materials have no short form. Their numbers must be those in the descriptions of the translations.
DESCRIPTIONS = ROOT / "compiler" / "materials" / "descriptions"
SHEEN = ["1.95", "0.385", "1.1", "8.3", "0.8", "0.745", "0.28", "0.855", "0.21"]
# For each page: the names of its descriptions, texts in the descriptions, and texts in the page.
WHOLE = {"blender-materialx.md": ("principled_to_open_pbr_surface", ["coat_darkening = 0", "0.9"], ["coat_darkening", "0.9"]),
         "simready-openpbr.md": ("UsdPreviewSurface_to_open_pbr_surface", ["coat_darkening = 0", "n / (w / new_coat_ior + 1 - w)"],
                                 ['"coat_darkening": 0.0', "ior / (weight / ior + 1 - weight)"]),
         "materialx-coat.md": ("functions", ["r^4 + 2 * rc^4", "r^4 - 2 * rc^4", "1.189207"],
                               ["coatRough4Twice", "uncoatedRough4", "1.19"]),
         "materialx-anisotropy.md": ("functions", ["(1 + b^2) / (2 * b)", "0.98"], ["(1 + (1 - a)^2) / (2 (1 - a))", "0.98"]),
         "materialx-sheen.md": (("open_pbr_surface_to_standard_surface", "standard_surface_to_open_pbr_surface"),
                                SHEEN, SHEEN),
         "materialx-usd.md": ("UsdPreviewSurface_to_open_pbr_surface", ["n / (w / new_coat_ior + 1 - w)"], ["n / (w / c + 1 - w)"])}


def check_whole(page, text):
    """Returns what is missing in a page about whole materials, and what its description no longer contains."""
    files, described, stated = WHOLE[page]
    source = "".join((DESCRIPTIONS / f"{name}.txt").read_text() for name in ([files] if isinstance(files, str) else files))
    return ([f"the description no longer has '{words}' (change the page as well)" for words in described if words not in source]
            + [f"no '{words}'" for words in stated if words not in text]
            + [f"no {part}" for part in ("**The rule of today**", "**What it gives**", "**A test**", "**Open**") if part not in text])


def with_constants(text, forms):
    """Returns the text with the constants of each form in its widths and strengths. Phong's form has a factor before
    n."""
    def replaced(match, first, second):
        form = forms["phong" if match["t"] else "blinn"]
        number = lambda value: f"{float(f'{value:.3g}')}{match['s']}"  # noqa: E731
        head = number(form[first]) + (f" * {match['k']}" if "k" in match.groupdict() else "")
        times = f"{number(form[4])} * " if match["t"] else ""
        return f"{head} / ({times}{match['n']} + {number(form[second])})"

    text = STRENGTH.sub(lambda match: replaced(match, 2, 3), text)
    return WIDTH.sub(lambda match: replaced(match, 0, 1), text)


def examples(forms):
    """Returns the values that each page states for its test, in the form in which the test must print them."""
    def width(lobe, n):
        return (forms[lobe][0] / (forms[lobe][4] * n + forms[lobe][1])) ** 0.25

    def strength(lobe, n, ks):
        return forms[lobe][2] * ks / (forms[lobe][4] * n + forms[lobe][3])

    def ior(f0):
        return (1 + math.sqrt(f0)) / (1 - math.sqrt(f0))

    ks = ((0.5 + 0.055) / 1.055) ** 2.4  # linear value of the display value 0.5
    f0, phong = strength("blinn", 96.08, 0.5), strength("phong", 96.08, 0.5)
    blinn = [f"{width('blinn', 96.08):.3f}", f"{f0:.4f}", f"{0.64 / (1 - f0):.3f}"]
    return {"assimp.md": [*blinn, f"{width('phong', 96.08):.3f}", f"{phong:.4f}", f"{width('phong', 400):.3f}"],
            "obj2gltf.md": blinn, "ifcopenshell.md": blinn, "trimesh.md": blinn[:2],
            "blender-obj.md": [*blinn, f"{ior(f0):.2f}"],
            "ufbx.md": [f"{width('phong', 96.08):.3f}", f"{phong:.4f}", f"{ior(phong):.2f}"],
            "mujoco-usd-converter.md": [f"{width('blinn', 64):.3f}", f"{(small := strength('blinn', 64, ks)):.4f}", f"{ior(small):.2f}"],
            "urdf-usd-converter.md": [blinn[0], f"{(small := strength('blinn', 96.08, ks)):.4f}", f"{ior(small):.2f}"]}


def check_constants(record):
    forms, wrong = SHORT_FORMS, 0
    for page in sorted(PAGES.glob("*.md")):
        text = page.read_text()
        if page.name in WHOLE:
            for words in check_whole(page.name, text):
                print(f"{page.relative_to(ROOT)}: {words}")
                wrong += 1
            continue
        now = with_constants(text, forms)
        for old, new in zip(text.splitlines(), now.splitlines()):
            if old != new and not record:
                print(f"{page.relative_to(ROOT)}: has '{old.strip()}', the form gives '{new.strip()}' (--record mends it)")
                wrong += 1
        if not (WIDTH.search(text) and STRENGTH.search(text)):
            print(f"{page.relative_to(ROOT)}: no line with the constants of a short form")
            wrong += 1
        stated = re.search(r"\*\*A test\*\*.*", text, re.DOTALL)
        for value in examples(forms).get(page.name, []):
            if not stated or value not in stated[0]:
                print(f"{page.relative_to(ROOT)}: the test of the page does not state {value}")
                wrong += 1
        if record:
            page.write_text(now)
    return wrong


def block(page, name):
    """Returns the code block of a page that follows the comment <!-- applied: NAME -->."""
    found = re.search(rf"<!-- applied: {re.escape(name)} -->\n```\w+\n(.*?)```", (PAGES / page).read_text(), re.DOTALL)
    if not found:
        sys.exit(f"docs/adopting/{page}: no code block under <!-- applied: {name} -->")
    return found[1]


def record_table(page, name, lines):
    path = PAGES / page
    text, count = re.subn(rf"(<!-- measured: {re.escape(name)} -->\n).*?(<!-- end -->)",
                          lambda match: match[1] + "\n".join(lines) + "\n" + match[2], path.read_text(), flags=re.DOTALL)
    if count != 1:
        sys.exit(f"docs/adopting/{page}: {count} places <!-- measured: {name} --> ... <!-- end --> (expected 1)")
    path.write_text(text)
