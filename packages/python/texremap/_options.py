"""The options of the commands that only this package has. They are separate, because help and manual pages
also show them on machines without the libraries of these commands."""

import argparse

USD_SUMMARY = "Convert the materials of a USD file between UsdPreviewSurface and OpenPBR, or between workflows"
USD_TARGETS = ("openpbr", "preview", "metallic", "specular")
MTLX_SUMMARY = "Convert the materials of MaterialX and glTF files: OpenPBR, standard_surface, glTF"
MTLX_TARGETS = ("openpbr", "standard-surface", "gltf")
MTLX_READERS = ("core", "godot")


def _parser(name, summary, example):
    return argparse.ArgumentParser(
        prog=f"texremap {name}", usage=f"texremap {name} IN -o OUT [options]", description=summary, epilog="Example:\n  " + example,
        formatter_class=argparse.RawDescriptionHelpFormatter, add_help=False)


def _add_common(parser, output, unit):
    parser.add_argument("-o", "--output", required=True, metavar="OUT", help=output)
    parser.add_argument("--force", action="store_true", help=f"Replace an existing {unit}")
    parser.add_argument("--dry-run", action="store_true", help="Print what would be done, and write nothing")
    parser.add_argument("--json", action="store_true", help="Print a line of JSON for each material")
    parser.add_argument("-h", "--help", action="help", help="Show this help")
    return parser


def usd_parser():
    parser = _parser("usd", f"{USD_SUMMARY},\ninto a new layer over it.", "texremap usd scene.usda --to openpbr -o scene_openpbr.usda")
    parser.add_argument("source", metavar="IN", help="A .usda, .usdc, .usd or .usdz file")
    parser.add_argument("--to", choices=USD_TARGETS, required=True,
                        help="openpbr adds an OpenPBR surface to each UsdPreviewSurface, preview the other way round; metallic "
                             "and specular change the workflow of each UsdPreviewSurface")
    return _add_common(parser, "The new layer: .usda, .usdc or .usd", "layer")


def mtlx_parser():
    parser = _parser("mtlx", f"{MTLX_SUMMARY}.", "texremap mtlx paint.mtlx --to gltf -o paint.glb")
    parser.add_argument("source", metavar="IN", help="A .mtlx, .glb or .gltf file")
    parser.add_argument("--to", choices=MTLX_TARGETS, required=True, help="The model of the new materials; glTF files hold only gltf")
    parser.add_argument("--for", dest="importer", choices=MTLX_READERS,
                        help="Put what this importer of glTF ignores into what it reads: core reads no extensions, godot is Godot 4")
    return _add_common(parser, "The new file: .mtlx, .glb or .gltf", "file")


# Each command has its summary and the function that makes its parser.
COMMANDS = {"mtlx": (MTLX_SUMMARY, mtlx_parser), "usd": (USD_SUMMARY, usd_parser)}
