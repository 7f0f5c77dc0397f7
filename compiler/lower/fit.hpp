// A fit: the mapping from the parameters of one BRDF model to those of another, as it was found, and the
// converter that it was lowered to. remapc writes it as JSON (fit_file.hpp).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "converter/converter_data.hpp"
#include "lower/mapping.hpp"
#include "lower/regimes.hpp"
#include "remap/model.hpp"

namespace remap {

// The range of the table's data. Outside, alpha is clamped and specular is extrapolated in proportion.
struct Domain {
  Range alpha;     // of the source
  Range specular;  // of the source, linear, any channel
  bool operator==(const Domain&) const = default;
};

// Absolute errors of one output over the held-out rows.
struct ErrorFigures {
  double rms = 0.0;
  double p99 = 0.0;  // 99th percentile
  double max = 0.0;
  bool operator==(const ErrorFigures&) const = default;
};

// The rows of the table that trained, that were held out for the figures, and that were not used.
struct Split {
  std::uint64_t seed = 0;
  double held_out_fraction = 0.0;
  std::int64_t trained_rows = 0;
  std::int64_t held_out_rows = 0;
  std::map<std::string, std::int64_t> left_out;  // status -> rows
  bool operator==(const Split&) const = default;
};

// The table that was fitted.
struct TableRecord {
  std::string name;                             // of the file, without folder
  std::string sha256;                           // of its bytes
  std::map<std::string, std::string> comments;  // `# key: value`: the options of the sweep
  bool operator==(const TableRecord&) const = default;
};

// Errors relative to the value, or to a fiftieth of 1 where that is more: what pictures show. Over the rows
// that each fold of cross-validation holds out.
struct RelativeError {
  double rms = 0.0;
  double standard_error = 0.0;  // over the folds
  bool operator==(const RelativeError&) const = default;
};

// One row of the comparison by which `--model auto` decided (compiler/fit/comparison.hpp).
struct CandidateRecord {
  std::string name;                                 // kind, or named form of it
  std::size_t number_count = 0;                     // of its coefficients: its complexity
  ErrorFigures alpha, specular;                     // of cross-validation, all folds
  RelativeError relative_alpha, relative_specular;  // by which candidates are compared
  double edge_alpha_rms = 0.0;  // on the outermost rows, fitted without them, with the domain rule
  double edge_specular_rms = 0.0;
  double raw_edge_alpha_rms = 0.0;  // the same without the domain rule
  double raw_edge_specular_rms = 0.0;
  double chroma_shift = 0.0;  // largest change of chromaticity beyond the domain, without the domain rule
  std::string verdict;        // `chosen`, or the reason against it
  bool operator==(const CandidateRecord&) const = default;
};

// The structural similarity (Wang et al. 2004) of two spheres side by side, source and target at the best
// parameters, at one source width.
struct SphereSimilarity {
  double alpha = 0.0;
  double ssim = 0.0;
  bool operator==(const SphereSimilarity&) const = default;
};

// How well the two models can match, independent of the fit: over the rows of the table in the domain.
struct ImageSimilarity {
  ErrorFigures image_error;  // difference of the pictures relative to the source's, as the match weighs them
  std::vector<SphereSimilarity> ssim;  // by rising alpha; empty where no spheres were compared
  bool operator==(const ImageSimilarity&) const = default;
};

struct Fit {
  std::string id;  // `<source>_to_<target>`, a C++ identifier
  ModelSide source;
  ModelSide target;
  Domain domain;
  MappingKind mapping;                              // inside the target's range
  Regimes regimes;                                  // at its limits
  std::map<std::string, std::string> method;        // of the regression: hyper-parameters, search, starts
  std::vector<CandidateRecord> candidates;          // of `auto`; else empty
  ErrorFigures alpha_error;                         // of the target's alpha
  ErrorFigures specular_error;                      // of the target's specular
  std::optional<ImageSimilarity> image_similarity;  // none for published formulas, without pictures
  std::vector<std::string> remarks;                 // lines of the card: sources, errata, limits of the pair
  Split split;
  TableRecord table;
  std::string tool_version;
  // What add_converter() (lower/lower.hpp) makes of the fit; none before that, and where it cannot be made.
  std::optional<ConverterData> converter;
  // Whether the errors are known. Formulas from publications were not compared with rows.
  bool has_errors() const { return alpha_error != ErrorFigures{} || specular_error != ErrorFigures{}; }
  bool operator==(const Fit&) const = default;
};

// The mean of the compared spheres' structural similarities; none where no spheres were compared.
std::optional<double> mean_ssim(const Fit& fit);

}  // namespace remap
