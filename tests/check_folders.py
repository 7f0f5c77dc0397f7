#!/usr/bin/env python3
"""check_folders.py BUILT_TESTS checks that a quick test covers each folder of sources.

BUILT_TESTS is the folder of the tests in the build tree, where discover_tests.cmake and CMake store the labels of
tests. It checks the folders in the list of HACKING.md that contain .cpp files. For each folder without a quick test
it prints a line, and the exit code is 1.
"""
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "scripts/lib"))
from includes import ROOT, listed_folders  # noqa: E402


def quick_folders(built_tests):
    """Returns the folders that are labels of a quick test."""
    folders = set()
    scripts = [*Path(built_tests).rglob("*_tests.cmake"), *Path(built_tests).rglob("CTestTestfile.cmake")]
    for script in scripts:
        for labels in re.findall(r'LABELS (?:\[==\[|")(.*?)(?:\]==\]|")', script.read_text()):
            if "quick" in labels.split(";"):
                folders.update(labels.split(";"))
    return folders


def main(built_tests):
    wanted = [f for f in listed_folders() if any((ROOT / f).glob("*.cpp"))]
    covered = quick_folders(built_tests)
    missing = [f for f in wanted if f not in covered]
    for folder in missing:
        print(f"{folder}: no quick test covers this folder (add one in tests/{folder}, or name the folder in FOLDERS of a program)")
    print(f"{len(wanted) - len(missing)} of {len(wanted)} folders have quick tests")
    sys.exit(1 if missing or not wanted else 0)


main(sys.argv[1])
