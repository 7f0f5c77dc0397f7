// This file holds the report of a job, or of a set with all its tiles, and the plan that a dry run shows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "assets/document/asset.hpp"
#include "remap/model.hpp"
#include "stages/dielectric_f0.hpp"
#include "texremap/plan/job.hpp"
#include "texture/target_plan.hpp"

namespace remap {

// A PlannedRole is one role of a set. Fields that do not apply are empty.
struct PlannedRole {
  std::string role;      // `roughness`, `base_color`; empty for files without one
  std::string input;     // `rock_arm.png:G`, `0.04`
  std::string encoding;  // encoding of the input: `srgb`, `linear`, `glossiness`
  std::string happens;   // `converted`, `kept`, `read`, `made`, `carried`, `copied`, `left behind`
  std::string output;    // names of the results that hold the role
  bool operator==(const PlannedRole&) const = default;
};

// `own_width` is the encoding of the source if the set does not state one. `width` is the encoding of the
// results.
std::vector<PlannedRole> planned_roles(const TextureSet& set, const TargetPlan& plan,
                                       const TargetChoice& choice, const SetWork& work,
                                       RoughnessEncoding own_width, RoughnessEncoding width);

// Returns the rows in columns, under a heading. Every line begins with two spaces.
std::string plan_table(const std::vector<PlannedRole>& roles);

// A ColorNote is the color space in which maps of a color are read or written, with its reason. The reason is
// the user, the file (its tag, or for a result the map that it follows), or the usual one.
struct ColorNote {
  Parameter color;
  bool is_written;
  Transfer transfer;
  TransferReason reason;
  auto operator<=>(const ColorNote&) const = default;
};
using ColorNotes = std::map<ColorNote, std::size_t>;  // notes with their number of maps

struct JobReport {
  struct Result {
    std::filesystem::path path;
    std::vector<Parameter> parameters;  // parameters in the file
    bool mask = false;
  };
  std::string name;                // empty for the only set of a command line
  std::vector<std::string> tiles;  // converted tiles; empty if the set has no tiles
  std::vector<std::filesystem::path> inputs;
  // After a dry run or a failure, these are the planned results. For an asset, these are the asset and then
  // its new images, or none if nothing was converted and something failed.
  std::vector<Result> results;
  std::vector<std::filesystem::path> copies;  // copied files, also those that are only planned
  std::vector<std::string> warnings;
  std::optional<std::string> failure;
  int failure_code = 0;           // errno of the call that failed, or 0
  bool was_done = false;          // done by the earlier run that this one resumes
  double seconds = 0.0;           // sum over all tiles, even if tiles ran in parallel
  std::uintmax_t bytes_read = 0;  // sizes of the files on disk
  std::uintmax_t bytes_written = 0;

  // The following members are only for texture sets.
  std::vector<std::filesystem::path> left_behind;  // maps of the set that are neither read nor copied
  Transfer specular_transfer = Transfer::kLinear;
  ColorNotes colors;  // for maps of integers, or if a file or the user states the color space
  std::optional<DielectricF0> estimated_f0;  // only from a specular to a metallic workflow
  std::optional<TranslationEffect> effect;   // only for a translation between surfaces
  std::vector<PlannedRole> plan;             // plan of a dry run; for tiles, the first tile's
  bool has_compression_level = false;        // true if any result has one
  MapStatistics statistics;

  std::vector<AssetMaterial> materials;  // materials of assets

  // Returns the report of a job that has not begun.
  static JobReport of(const Job& job);
  // Adds the report of the next tile of the set.
  JobReport& operator+=(const JobReport& other);

  std::size_t count(MaterialState state) const { return count_of(materials, state); }
  // Returns why the job has failed, for example `1 of 3 materials failed`. Returns nothing after success.
  std::optional<std::string> failure_text() const;
};

// Returns an estimated F0 as texremap uses and prints it, with four decimals.
double used_f0(const DielectricF0& estimated);

// Lists all members, so that another process can send them (packed_values.hpp).
template <typename Archive>
void fields(Archive& archive, JobReport::Result& result) {
  archive(result.path, result.parameters, result.mask);
}
template <typename Archive>
void fields(Archive& archive, MapStatistics& statistics) {
  archive(statistics.texel_count, statistics.out_of_domain_count, statistics.nan_count,
          statistics.infinite_count, statistics.negative_count, statistics.clipped_count,
          statistics.masked_count, statistics.above_one_count, statistics.first_bad, statistics.sources,
          statistics.targets, statistics.tints, statistics.metallic);
}
template <typename Archive>
void fields(Archive& archive, PlannedRole& role) {
  archive(role.role, role.input, role.encoding, role.happens, role.output);
}
template <typename Archive>
void fields(Archive& archive, SurfaceValue& value) {
  archive(value.name, value.values);
}
template <typename Archive>
void fields(Archive& archive, TranslationEffect& effect) {
  archive(effect.written, effect.unchanged, effect.wide, effect.values, effect.lost);
}
template <typename Archive>
void fields(Archive& archive, MaterialFactor& factor) {
  archive(factor.name, factor.values);
}
template <typename Archive>
void fields(Archive& archive, AssetMaterial& material) {
  archive(material.index, material.name, material.state, material.factors, material.residual,
          material.becomes, material.warnings, material.failure);
}
template <typename Archive>
void fields(Archive& archive, JobReport& report) {
  archive(report.name, report.tiles, report.inputs, report.results, report.copies, report.warnings,
          report.failure, report.failure_code, report.was_done, report.seconds, report.bytes_read,
          report.bytes_written, report.left_behind, report.specular_transfer, report.colors,
          report.estimated_f0, report.effect, report.plan, report.has_compression_level, report.statistics,
          report.materials);
}

}  // namespace remap
