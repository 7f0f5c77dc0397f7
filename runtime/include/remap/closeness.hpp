// How closely the target of a path can look like its source, and which other model of the same renderer would
// look closer. Judged by expected errors (path.hpp) and by the structural similarity of spheres.
#pragma once

#include <optional>
#include <vector>

#include "remap/path.hpp"

namespace remap {

// Above this expected error, a tenth of the picture, a conversion will look different. Below it all shipped
// converters have a mean SSIM of at least 0.96 (fits/converters.csv).
inline constexpr double kLooksDifferent = 0.1;

// Another model looks closer if its expected error is at most this share. Expected errors are estimates, and
// those of two models are of different domains: a smaller gain may be none.
inline constexpr double kCloserShare = 0.5;

// Up to this expected error no other model is named, because nobody would see the difference: all shipped
// converters below it have a mean SSIM of at least 0.996.
inline constexpr double kUnseenError = 0.03;

// A path is left out of a comparison if it covers less than this share of the alphas and speculars that the
// other one covers: its error says nothing about the other materials. Models of dielectrics, whose F0 ends at
// 0.04 or 0.08, cover at most 0.11 of what models of conductors do.
inline constexpr double kLeastCoverage = 0.15;

// The least SSIM of the steps whose pictures were compared; none if no step's were. Similarities of steps do
// not compose: that of the whole path may be lower.
std::optional<double> worst_step_ssim(const ConverterPath& path);

// Whether the pictures of every step were compared.
bool is_measured(const ConverterPath& path);

// The path of least expected error among `paths`, which start at one source and of which there must be one
// or more. Errors that agree when rounded up to three digits are equal, and the first of equal paths is
// taken. Paths that cover less than kLeastCoverage of what the widest covers are left out.
const ConverterPath& closest_path(const std::vector<ConverterPath>& paths);

struct Closeness {
  // Whether the steps whose pictures were compared have an expected error above kLooksDifferent together.
  bool looks_different = false;
  // A path to another model of the target's renderer that looks closer; none if there is none, or if one of
  // the two paths is not measured.
  std::optional<ConverterPath> closer;
};

// Judges `path` against `others`: paths from the same source, of which only those to other models of the same
// renderer count.
Closeness closeness_of(const ConverterPath& path, const std::vector<ConverterPath>& others);

}  // namespace remap
