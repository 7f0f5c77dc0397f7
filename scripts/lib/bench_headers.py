"""This program measures how fast the generated headers of BRDFs convert texels, as a fraction of memcpy's speed, and
how long a compiler takes for one header. `scripts/bench headers` runs it.

Each header is compiled separately, as in an engine, and linked into one library for a compiler and its flags. It
converts four planes of 2^20 floats out of place: widths and three channels, at random over the whole measured range.
Exponents are uniform in the alpha of the same lobe, so that they reach both ends of their range. memcpy copies the
same four planes in the same process, in turns with the header. Both times are the best of the rounds. The rounds are
spread over the whole run, because other programs slow a machine down for seconds at a time.
"""
import argparse
import concurrent.futures
import ctypes
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
STANDARD = "-std=c++17"
FLAGS = ["-O3", "-O3 -march=x86-64-v3"]
TEXELS = 1 << 20
PASSES, ROUNDS = 5, 4  # passes over all headers, and rounds for each header in a pass
COMPILE_FLAGS, COMPILE_ROUNDS, COMPILE_STEP = "-O2", 3, 10  # compiles every tenth header
SLOWEST = 10

CONVERTER = """
#include "%(id)s.hpp"
using C = remap::%(id)s;
extern "C" void domain_%(id)s(float* ends) {
  ends[0] = C::Form::width_min, ends[1] = C::Form::width_max, ends[2] = C::Form::specular_max;
}
extern "C" std::size_t convert_%(id)s(std::size_t count, const float* const* in, float* const* out) {
  return C::evaluate_batch(count, {in[0], {in[1], in[2], in[3]}}, {out[0], {out[1], out[2], out[3]}});
}
"""
ROUNDS_OF_ONE = """
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>
namespace {
constexpr std::size_t kPlanes = 4;
using Planes = std::vector<float>[kPlanes];
Planes uniform, in, out;  // uniform: 0 to 1

template <class Run>
void time_run(double* best, const Run& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  *best = std::min(*best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

float clamped(float value, float low, float high) { return std::min(std::max(value, low), high); }

// n = 2 / alpha^2 - 2
float exponent_between(float low, float high, float share) {
  const float least = std::sqrt(2.0f / (high + 2.0f)), alpha = least + (std::sqrt(2.0f / (low + 2.0f)) - least) * share;
  return clamped(2.0f / (alpha * alpha) - 2.0f, low, high);
}

void make_texels(std::size_t count, const float* ends, bool is_exponent) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> from_0_to_1;
  for (std::size_t p = 0; p < kPlanes; ++p) {
    if (uniform[p].size() != count) {
      uniform[p].resize(count), in[p].resize(count), out[p].resize(count);
      for (float& value : uniform[p]) value = from_0_to_1(random);
    }
    const float low = p == 0 ? ends[0] : 0.0f, high = p == 0 ? ends[1] : ends[2];
    for (std::size_t i = 0; i < count; ++i)
      in[p][i] = p == 0 && is_exponent ? exponent_between(low, high, uniform[p][i])
                                       : clamped(low + (high - low) * uniform[p][i], low, high);
  }
}
}  // namespace

// Lowers both times, in seconds, to those of memcpy and of the header in the best round. Returns how many texels lie out of the
// measured range, which must be none.
extern "C" std::size_t measure(std::size_t (*convert)(std::size_t, const float* const*, float* const*), std::size_t count,
                               const float* ends, bool is_exponent, unsigned rounds, double* seconds) {
  make_texels(count, ends, is_exponent);
  const float* const from[kPlanes] = {in[0].data(), in[1].data(), in[2].data(), in[3].data()};
  float* const to[kPlanes] = {out[0].data(), out[1].data(), out[2].data(), out[3].data()};
  std::size_t outside = 0;
  for (unsigned r = 0; r < rounds; ++r) {
    time_run(seconds, [&] {
      for (std::size_t p = 0; p < kPlanes; ++p) std::memcpy(to[p], from[p], count * sizeof(float));
    });
    time_run(seconds + 1, [&] { outside = convert(count, from, to); });
  }
  return outside;
}
"""
USER = """
#include "%(id)s.hpp"
using C = remap::%(id)s;
C::Texel<3> texel(const C::Texel<3>& in) { return C::evaluate(in); }
std::size_t planes(std::size_t count, const C::Texels<const float>& in, const C::Texels<float>& out) {
  return C::evaluate_batch(count, in, out);
}
"""


def texts():
    """Returns the text of each header of BRDFs, keyed by its id."""
    headers = {path.stem: path.read_text() for path in sorted((ROOT / "generated").glob("*.hpp"))}
    return {identifier: text for identifier, text in headers.items() if "struct Form {" in text}


def note(text):
    print(text, file=sys.stderr, flush=True)


def compile_file(compiler, flags, source, target):
    words = [compiler, STANDARD, *flags.split(), "-fPIC", "-I", ROOT / "generated", "-c", source, "-o", target]
    done = subprocess.run(words, env=dict(os.environ, CCACHE_DISABLE="1"), capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"bench headers: {compiler} {flags}: {source.stem}: {done.stderr[:2000]}")
    return target


def library(compiler, flags, identifiers, folder):
    """Builds one library with all converters, each compiled separately."""
    folder.mkdir()
    sources = {"measure": ROUNDS_OF_ONE, **{identifier: CONVERTER % {"id": identifier} for identifier in identifiers}}
    for name, text in sources.items():
        (folder / f"{name}.cpp").write_text(text)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as workers:
        objects = list(workers.map(
            lambda name: compile_file(compiler, flags, folder / f"{name}.cpp", folder / f"{name}.o"), sources))
    subprocess.run([compiler, "-shared", *objects, "-o", folder / "all.so"], check=True)
    return ctypes.CDLL(str(folder / "all.so"))


def measure_once(converters, identifier, is_exponent, seconds):
    """Runs some rounds of memcpy and of the header. `seconds` holds their best times so far."""
    ends = (ctypes.c_float * 3)()
    getattr(converters, f"domain_{identifier}")(ends)
    converters.measure.restype = ctypes.c_size_t
    outside = converters.measure(getattr(converters, f"convert_{identifier}"), ctypes.c_size_t(TEXELS), ends,
                                 ctypes.c_bool(is_exponent), ctypes.c_uint(ROUNDS), seconds)
    if outside != 0:
        sys.exit(f"bench headers: {identifier}: {outside} texels of the measured range are reported as out of it")


def measure_speeds(builds, headers):
    """Returns a result for each compiler and its flags."""
    with tempfile.TemporaryDirectory() as folder:
        libraries = []
        for compiler, flags in builds:
            note(f"compile {len(headers)} headers: {compiler} {flags}")
            libraries.append(library(compiler, flags, headers, Path(folder) / str(len(libraries))))
        best = [{identifier: (ctypes.c_double * 2)(1e9, 1e9) for identifier in headers} for _ in builds]
        for number in range(PASSES):
            note(f"pass {number + 1} of {PASSES}")
            for converters, times in zip(libraries, best):
                for identifier, text in headers.items():
                    measure_once(converters, identifier, 'kSourceWidth = "exponent"' in text, times[identifier])
    return [speeds(compiler, flags, times) for (compiler, flags), times in zip(builds, best)]


def speeds(compiler, flags, times):
    rows = [{"id": identifier, "share_of_memcpy": copy / convert, "texels_per_second": TEXELS / convert}
            for identifier, (copy, convert) in times.items()]
    rows.sort(key=lambda row: row["share_of_memcpy"])
    return {"compiler": compiler, "flags": flags, "median": statistics.median(row["share_of_memcpy"] for row in rows),
            "headers": rows}


def compile_seconds(compiler, source):
    best = float("inf")
    for _ in range(COMPILE_ROUNDS):
        start = time.monotonic()
        compile_file(compiler, COMPILE_FLAGS, source, source.with_suffix(".o"))
        best = min(best, time.monotonic() - start)
    return best


def measure_compiling(compiler, identifiers):
    """Returns the seconds that a file with one header takes, minus the seconds of an empty file."""
    note(f"time {compiler} {COMPILE_FLAGS}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "empty.cpp").write_text("")
        empty = compile_seconds(compiler, folder / "empty.cpp")
        rows = []
        for identifier in identifiers:
            source = folder / f"{identifier}.cpp"
            source.write_text(USER % {"id": identifier})
            rows.append({"id": identifier, "seconds": compile_seconds(compiler, source) - empty})
    rows.sort(key=lambda row: -row["seconds"])
    return {"compiler": compiler, "flags": COMPILE_FLAGS, "median": statistics.median(row["seconds"] for row in rows),
            "headers": rows}


def print_speeds(result):
    rows = result["headers"]
    print(f"{result['compiler']} {STANDARD} {result['flags']}: {len(rows)} headers, median {result['median']:.2f} of memcpy's speed, "
          f"{rows[0]['share_of_memcpy']:.2f} to {rows[-1]['share_of_memcpy']:.2f}; the slowest:")
    for row in rows[:SLOWEST]:
        print(f"  {row['share_of_memcpy']:5.2f} {row['texels_per_second'] / 1e6:6.0f} Mtexel/s  {row['id']}")


def print_compiling(result):
    largest = result["headers"][0]
    print(f"{result['compiler']} {STANDARD} {result['flags']}: {len(result['headers'])} headers compiled alone, median "
          f"{result['median']:.2f} s, largest {largest['seconds']:.2f} s ({largest['id']})")


def joined(words):
    """Returns the command line with `--flags=-O2` instead of `--flags -O2`, because argparse reads a separate -O2 as
    an option."""
    words = list(words)
    while "--flags" in words[:-1]:
        at = words.index("--flags")
        words[at:at + 2] = [f"--flags={words[at + 1]}"]
    return words


def main():
    options = argparse.ArgumentParser(prog="scripts/bench headers")
    options.add_argument("--json", action="store_true", help="print all figures as JSON")
    options.add_argument("--only", default="", metavar="REGEX", help="measure only headers whose id matches")
    options.add_argument("--compiler", nargs="+", default=["g++", "clang++"],
                         help="default: g++ and clang++, if installed")
    options.add_argument("--flags", action="append", metavar='"..."',
                         help=f"flags besides {STANDARD}; may be repeated (default: {' and '.join(FLAGS)})")
    given = options.parse_args(joined(sys.argv[1:]))
    compilers = [compiler for compiler in given.compiler if shutil.which(compiler)]
    headers = {identifier: text for identifier, text in texts().items() if re.search(given.only, identifier)}
    if not compilers or not headers:
        sys.exit("bench headers: " + ("no such header" if compilers else f"not installed: {', '.join(given.compiler)}"))
    builds = [(compiler, flags) for compiler in compilers for flags in given.flags or FLAGS]
    result = {"texels": TEXELS, "rounds": PASSES * ROUNDS, "speed": measure_speeds(builds, headers),
              "compile": [measure_compiling(compiler, list(headers)[::COMPILE_STEP]) for compiler in compilers]}
    if given.json:
        print(json.dumps(result, indent=2))
        return
    print(f"generated headers against memcpy: four planes of {TEXELS} floats, out of place, best of {PASSES * ROUNDS} rounds each")
    for row in result["speed"]:
        print_speeds(row)
    for row in result["compile"]:
        print_compiling(row)


main()
