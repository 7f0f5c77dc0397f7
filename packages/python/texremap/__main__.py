"""The command ``texremap``: the program of the C++ build, over images by OpenImageIO's Python package; and
``texremap usd``, which this package alone has."""

import sys

from . import _core


def main():
    if sys.argv[1:2] == ["usd"]:
        try:
            from . import usd
        except ImportError as failure:
            print(f"texremap: {failure}", file=sys.stderr)
            return 1
        return usd.main(sys.argv[2:])
    return _core.run(sys.argv[1:], True)


if __name__ == "__main__":
    sys.exit(main())
