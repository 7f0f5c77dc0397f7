// This file holds a fit. It is the mapping from the parameters of one BRDF model to the parameters of
// another, as it was found, and the converter that was made from it. remapc writes fits as JSON
// (fit_file.hpp).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "converter/converter_data.hpp"
#include "lower/mapping.hpp"
#include "remap/model.hpp"

namespace remap {

// A Domain is the range of the table's data. Beyond its edges, target and source have the ratio that they
// have at the edge. Only widths above the domain are clamped.
struct Domain {
  Range alpha;     // range of the source's alpha
  Range specular;  // range of the source's specular in any channel, linear
  bool operator==(const Domain&) const = default;
};

// A Limits holds the largest alpha and specular that a target model accepts.
struct Limits {
  double alpha = 1.0;
  std::optional<double> specular;  // not set if the limit is unknown
  bool operator==(const Limits&) const = default;
};

// A PictureErrors states how much pictures differ from the source's pictures. The fit did not use
// these materials and lights (compiler/lights/pair_pictures.hpp).
struct PictureErrors {
  double rmse = 0.0;      // RMSE of display values under environments, in percent of the display's range
  double relative = 0.0;  // error of linear radiance under a point light, relative to the RMS of the source
  bool operator==(const PictureErrors&) const = default;
};

// An ErrorFigures holds absolute errors of one output over the held-out rows.
struct ErrorFigures {
  double rms = 0.0;
  double p99 = 0.0;  // 99th percentile
  double max = 0.0;
  bool operator==(const ErrorFigures&) const = default;
};

// A Split counts the table's rows: used for training, held out, and not used.
struct Split {
  std::uint64_t seed = 0;
  double held_out_fraction = 0.0;
  std::int64_t trained_rows = 0;
  std::int64_t held_out_rows = 0;
  std::map<std::string, std::int64_t> left_out;  // number of rows for each status
  bool operator==(const Split&) const = default;
};

// A TableRecord describes the table that was fitted.
struct TableRecord {
  std::string name;                             // name of the file, without its folder
  std::string sha256;                           // SHA-256 of its bytes
  std::map<std::string, std::string> comments;  // `# key: value`, which are the options of the sweep
  // Returns the value of a comment, or an empty text if there is no such comment.
  std::string comment(const std::string& key) const {
    const auto found = comments.find(key);
    return found == comments.end() ? "" : found->second;
  }
  bool operator==(const TableRecord&) const = default;
};

// A CandidateRecord is one row of the comparison by which `--model auto` decided
// (compiler/fit/comparison.cpp).
struct CandidateRecord {
  std::string name;              // kind and shape of the candidate
  std::size_t number_count = 0;  // number of coefficients, which measures complexity
  ErrorFigures alpha, specular;  // errors on the held-out rows
  // These are root mean squares on the held-out rows, relative to the value. Values below a fiftieth are
  // treated as a fiftieth.
  double relative_alpha = 0.0, relative_specular = 0.0;
  std::optional<PictureErrors> pictures;  // none if remap cannot render one of the models
  std::string verdict;                    // `chosen`, or why not
  bool operator==(const CandidateRecord&) const = default;
};

struct Fit {
  std::string id;  // `<source>_to_<target>`, a C++ identifier
  ModelSide source;
  ModelSide target;
  Domain domain;
  MappingKind mapping;
  Limits limits;                              // limits of the target
  std::map<std::string, std::string> method;  // how it was found: hyper-parameters, search, starts
  std::vector<CandidateRecord> candidates;    // only with --model auto
  ErrorFigures alpha_error;                   // error of the target's alpha
  ErrorFigures specular_error;                // error of the target's specular
  // The next two state how well the two models can match, from the rows of the table in the domain. They are
  // empty for formulas from publications. The first is the difference of pictures relative to the source's,
  // with the weights of the match. The second is the structural similarity (Wang et al. 2004) of two spheres,
  // source and target at the best parameters, by source alpha, if spheres were compared.
  std::optional<ErrorFigures> image_error;
  std::map<double, double> ssim;
  // These are errors of pictures with converted numbers, and with copied ones. They are unset if the built-in
  // renderer lacks one of the models.
  std::optional<PictureErrors> pictures, copied_pictures;
  std::vector<std::string> remarks;  // lines of the model card: sources, errata, limits of the pair
  Split split;
  TableRecord table;
  std::string tool_version;
  // This is the converter that add_converter() (lower/lower.hpp) makes. It may be missing.
  std::optional<ConverterData> converter;
  // Returns true if the errors are known. Formulas from publications were not compared with rows.
  bool has_errors() const { return alpha_error != ErrorFigures{} || specular_error != ErrorFigures{}; }
  // Returns true if distances to rows are errors of the fit. Rows are matched under one light. A form that
  // was chosen by pictures under many lights need not follow the rows.
  bool follows_rows() const { return has_errors() && !pictures; }
  bool operator==(const Fit&) const = default;
};

// Returns a side as people read it: `mitsuba/ward (alpha, specular)`.
inline std::string side_text(const ModelSide& side) {
  return side.model + " (" + std::string(encoding_name(side.roughness)) + ", " + side.specular + ")";
}

// Returns the mean of the compared spheres' structural similarities, or nothing if no spheres were compared.
inline std::optional<double> mean_ssim(const Fit& fit) {
  if (fit.ssim.empty()) return std::nullopt;
  double sum = 0.0;
  for (const auto& [alpha, ssim] : fit.ssim) sum += ssim;
  return sum / static_cast<double>(fit.ssim.size());
}

}  // namespace remap
