"""The options of ``texremap usd``, which help and the manual page show where usd-core is not installed."""

import argparse

USD_SUMMARY = "Convert the materials of a USD file between UsdPreviewSurface and OpenPBR, or between workflows"
USD_TARGETS = ("openpbr", "preview", "metallic", "specular")
USAGE = "texremap usd IN -o OUT [options]"
EXAMPLE = "  texremap usd scene.usda --to openpbr -o scene_openpbr.usda"


def usd_parser():
    parser = argparse.ArgumentParser(
        prog="texremap usd", usage=USAGE, description=f"{USD_SUMMARY},\ninto a new layer over it.",
        epilog="Example:\n" + EXAMPLE, formatter_class=argparse.RawDescriptionHelpFormatter, add_help=False)
    parser.add_argument("source", metavar="IN", help="A .usda, .usdc, .usd or .usdz file")
    parser.add_argument("--to", choices=USD_TARGETS, required=True,
                        help="openpbr adds an OpenPBR surface to each UsdPreviewSurface, preview the other way round; metallic "
                             "and specular change the workflow of each UsdPreviewSurface")
    parser.add_argument("-o", "--output", required=True, metavar="OUT", help="The new layer: .usda, .usdc or .usd")
    parser.add_argument("--force", action="store_true", help="Replace an existing layer")
    parser.add_argument("--dry-run", action="store_true", help="Print what would be done, and write nothing")
    parser.add_argument("--json", action="store_true", help="Print a line of JSON for each material")
    parser.add_argument("-h", "--help", action="help", help="Show this help")
    return parser
