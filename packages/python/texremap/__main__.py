"""The command ``texremap``: the program of the C++ build, over images by OpenImageIO's Python package."""

import sys

from . import _core


def main():
    return _core.run(sys.argv[1:], True)


if __name__ == "__main__":
    sys.exit(main())
