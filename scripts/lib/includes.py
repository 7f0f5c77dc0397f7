"""Reads the folders of HACKING.md, their files, and what the files include."""
import functools
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
INCLUDE_FOLDERS = ("compiler", "runtime", "runtime/include")
HAND_WRITTEN = (".cpp", ".hpp", ".inc", ".in", ".json", ".py")
ADAPTERS = ROOT / "compiler/adapters"


@functools.cache
def sources():
    return sorted(p for top in ("runtime", "compiler") for p in (ROOT / top).rglob("*") if p.suffix in (".cpp", ".hpp", ".inc"))


def included(path):
    """Returns the paths of the project's own files that `path` includes."""
    for name in re.findall(r'^#include "([^"]+)"', path.read_text(), re.MULTILINE):
        candidates = [path.parent / name] + [ROOT / folder / name for folder in INCLUDE_FOLDERS]
        yield from [c.resolve() for c in candidates if c.is_file()][:1]


@functools.cache
def listed_folders():
    """Returns the folders in the order of HACKING.md, with their descriptions."""
    listed = re.search(r"<!-- folders -->\n```\n(.*?)```", (ROOT / "HACKING.md").read_text(), re.DOTALL)
    rows = [line.split(None, 1) for line in listed.group(1).splitlines() if line.strip()]
    return {name.rstrip("/"): "".join(text).strip() for name, *text in rows}


def folder(path):
    """Returns the deepest folder of the list that contains the file, or the file's own folder."""
    own = path.relative_to(ROOT).parent
    return next((f for f in map(str, [own, *own.parents]) if f in listed_folders()), str(own))


def lines_of(paths):
    return sum(len(p.read_text().splitlines()) for p in paths)


def hand_written(top):
    return [p for p in (ROOT / top).rglob("*") if p.suffix in HAND_WRITTEN and ADAPTERS not in p.parents]
