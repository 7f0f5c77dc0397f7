"""This is the command ``texremap``: the program of the C++ build, with images by OpenImageIO's Python
package. The commands ``texremap mtlx`` and ``texremap usd`` exist only in this package."""

import importlib
import sys
import textwrap

from . import _core
from ._options import COMMANDS

_HELP = ("-h", "--help")


def _run_own(name, words):
    parser = COMMANDS[name][1]()
    if any(word in _HELP for word in words):
        parser.print_help()
        return 0
    try:
        return importlib.import_module(f".{name}", __package__).main(words)
    except ImportError as failure:
        print(f"texremap: {failure}", file=sys.stderr)
        return 1


def main():
    words = sys.argv[1:]
    if words[:1] and words[0] in COMMANDS:
        return _run_own(words[0], words[1:])
    status = _core.run(words, True)
    if words[:1] and words[0] in _HELP:
        print("\nOnly in the Python package:")
        for name, (summary, _) in COMMANDS.items():
            print(f"  {name}".ljust(26) + ("\n" + " " * 26).join(textwrap.wrap(summary, 54)))
    return status


if __name__ == "__main__":
    sys.exit(main())
