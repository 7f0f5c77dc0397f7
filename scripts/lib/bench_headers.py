"""scripts/bench headers REVISION [--fits REVISION] [--json]: evaluate_batch<3> of the generated headers here against those of another
revision, in its interface of today or in the one before, of five arguments. With --fits those here are what build/release/bin/remapc
makes of the fits of a revision: then code is compared with code, not a fit with another.

Both are built by g++ -O3 for x86-64-v3 and run in turns in one process on random texels: 4096 at a time, which stay in the cache, so
that arithmetic counts. A figure is the best of some rounds.
"""
import argparse
import ctypes
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
FLAGS = ["-std=c++17", "-O3", "-march=x86-64-v3", "-ffp-contract=off", "-shared", "-fPIC"]
PROGRAM = """
#include <chrono>
#include <cstdlib>
#include <vector>
#include "remap/%(id)s.hpp"
// Least and largest width, least and largest specular.
extern "C" void domain(float* ends) {
  const auto [width, specular] = remap::%(id)s::kDomainMin;
  const auto [last_width, last_specular] = remap::%(id)s::kDomainMax;
  ends[0] = width, ends[1] = last_width, ends[2] = specular, ends[3] = last_specular;
}
extern "C" double seconds(const float* ends, std::size_t count, unsigned repeats) {
  std::vector<float> in[4], out[4];
  std::srand(1);
  for (int c = 0; c < 4; ++c) {
    out[c].resize(count);
    const float low = ends[c == 0 ? 0 : 2], high = ends[c == 0 ? 1 : 3];
    for (std::size_t i = 0; i < count; ++i)
      in[c].push_back(low + (high - low) * static_cast<float>(std::rand()) / static_cast<float>(RAND_MAX));
  }
  const auto start = std::chrono::steady_clock::now();
  for (unsigned r = 0; r < repeats; ++r)
    remap::%(id)s::%(call)s;
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
"""
CALL = """evaluate_batch(count, {in[0].data(), {in[1].data(), in[2].data(), in[3].data()}},
                                  {out[0].data(), {out[1].data(), out[2].data(), out[3].data()}})"""
CALL_BEFORE = """evaluate_batch<3>(count, in[0].data(), {in[1].data(), in[2].data(), in[3].data()},
                                     out[0].data(), {out[1].data(), out[2].data(), out[3].data()})"""
TEXELS, ROUNDS, REPEATS = 4096, 15, 24


def git(*words):
    return subprocess.run(["git", *words], cwd=ROOT, check=True, capture_output=True, text=True).stdout


def files_of(revision, folder, suffix):
    """The names of such files in a folder of a revision, without the suffix."""
    listed = git("ls-tree", "--name-only", revision, folder + "/").split()
    return {Path(name).stem for name in listed if name.endswith(suffix)}


def headers_of_fits(revision, only, folder):
    """Headers that the compiler here makes of the fits of a revision."""
    for name in sorted(files_of(revision, "fits", ".json")):
        if re.search(only, name):
            fit = folder / f"{name}.json"
            fit.write_text(git("show", f"{revision}:fits/{name}.json"))
            if '"remap-fit"' in fit.read_text():
                subprocess.run([ROOT / "build/release/bin/remapc", "emit", fit, "-o", folder], check=True, stdout=subprocess.DEVNULL)
    return folder


def identifiers(revision, here):
    """Converters of width and specular that both have."""
    there = files_of(revision, "generated", ".hpp")
    return sorted(path.stem for path in here.glob("*.hpp") if path.stem in there and "kDomainMax" in path.read_text())


def library(folder, identifier, header):
    headers = folder / "remap"
    headers.mkdir(parents=True)
    (headers / f"{identifier}.hpp").write_text(header)
    source = folder / "rows.cpp"
    source.write_text(PROGRAM % {"id": identifier, "call": CALL if "InputRows" in header else CALL_BEFORE})
    subprocess.run(["g++", *FLAGS, "-I", folder, source, "-o", folder / "rows.so"], check=True)
    rows = ctypes.CDLL(str(folder / "rows.so"))
    rows.seconds.restype = ctypes.c_double
    rows.seconds.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_uint]
    return rows


def rates(folder, identifier, revision, headers):
    """Texels a second: of the header of the revision on its domain, of the one here on the same, and on its own."""
    before = library(folder / identifier / "before", identifier, git("show", f"{revision}:generated/{identifier}.hpp"))
    here = library(folder / identifier / "here", identifier, (headers / f"{identifier}.hpp").read_text())
    narrow, whole = (ctypes.c_float * 4)(), (ctypes.c_float * 4)()
    before.domain(narrow)
    here.domain(whole)
    runs = [(before, narrow), (here, narrow), (here, whole)]
    rounds = [[rows.seconds(ends, TEXELS, REPEATS) for rows, ends in runs] for _ in range(ROUNDS)]
    return [TEXELS * REPEATS / min(times) for times in zip(*rounds)]


def main():
    options = argparse.ArgumentParser(prog="scripts/bench headers")
    options.add_argument("revision")
    options.add_argument("--json", action="store_true")
    options.add_argument("--fits", metavar="REVISION", help="whose fits the headers here are made of")
    options.add_argument("--only", default="", metavar="REGEX", help="of the converters' ids")
    given = options.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        headers = headers_of_fits(given.fits, given.only, Path(folder)) if given.fits else ROOT / "generated"
        for identifier in identifiers(given.revision, headers):
            if re.search(given.only, identifier):
                before, here, whole = rates(Path(folder), identifier, given.revision, headers)
                rows.append({"id": identifier, "before": before, "here": here, "here_on_its_domain": whole,
                             "time_ratio": before / here})
                print(f"\r{len(rows)} headers", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    rows.sort(key=lambda row: -row["time_ratio"])
    if given.json:
        print(json.dumps(rows, indent=2))
        return
    print("Mtexel/s before, here on the domain of that, here on its own; time here as a share of that before")
    for row in rows:
        print(f"{row['before'] / 1e6:8.0f} {row['here'] / 1e6:8.0f} {row['here_on_its_domain'] / 1e6:8.0f}   {row['time_ratio']:.2f}  {row['id']}")
    mean = sum(row["time_ratio"] for row in rows) / max(len(rows), 1)
    print(f"mean of {len(rows)}: {mean:.2f}; above 1.15: {sum(row['time_ratio'] > 1.15 for row in rows)}")


main()
