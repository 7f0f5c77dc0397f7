"""The command ``texremap``: the program of the C++ build, over images by OpenImageIO's Python package; and
``texremap usd``, which only this package has."""

import sys
import textwrap

from . import _core
from ._options import USD_SUMMARY, usd_parser

_HELP = ("-h", "--help")


def _run_usd(words):
    try:
        from . import usd
    except ImportError as failure:
        if any(word in _HELP for word in words):
            usd_parser().print_help()
            return 0
        print(f"texremap: {failure}", file=sys.stderr)
        return 1
    return usd.main(words)


def main():
    words = sys.argv[1:]
    if words[:1] == ["usd"]:
        return _run_usd(words[1:])
    status = _core.run(words, True)
    if words[:1] and words[0] in _HELP:
        lines = textwrap.wrap(USD_SUMMARY, 54)
        print("\nOnly in the Python package:\n  usd".ljust(55) + ("\n" + " " * 26).join(lines))
    return status


if __name__ == "__main__":
    sys.exit(main())
