// The sweep: every sample of the source's parameters matched, into a table.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sweep/casting.hpp"
#include "sweep/objective.hpp"
#include "sweep/probe.hpp"
#include "sweep/renderer.hpp"
#include "table/table.hpp"

namespace remapc {

struct SamplePoint {
  double alpha = 0.0;
  double specular = 0.0;  // canonical (probe.hpp)
};

// Two models, and how their pictures are compared.
struct PairOptions {
  std::string source;
  std::string target;
  Casting source_casting, target_casting;
  Objective objective;
  std::string objective_name;  // preset, or `custom` where parts of it were changed
  int resolution = 512;
  int samples_per_axis = 1;
  bool match_irradiance = true;
};

// What a sweep computes. Every field is recorded in the table's comments.
struct SweepOptions : PairOptions {
  std::string sampling;              // how the samples were chosen, in words
  std::vector<SamplePoint> samples;  // in the order of the table; specular canonical
  int stages = 2;                    // 1, 2 or 3 (section 3.1)
  double diffuse = 0.0;              // of the source, for every sample
};

// How a sweep is carried out. Nothing of it changes the table.
struct SweepExecution {
  unsigned jobs = 0;                                                // 0: one a core
  std::function<void(std::size_t done, std::size_t all)> progress;  // called from any thread
  const std::atomic<bool>* cancelled = nullptr;                     // stops between rows; throws kInterrupted
};

// Uniform samples: `alpha_count` widths over `alphas`, both ends included, and `specular_count` values over
// `speculars`, the lower end excluded where it is 0 (nothing to match there), rounded to nine digits.
// Section 5.2 takes 30 x 30.
std::vector<SamplePoint> grid_samples(const remap::Range& alphas, std::size_t alpha_count,
                                      const remap::Range& speculars, std::size_t specular_count);

// The same in words, for SweepOptions::sampling.
std::string grid_text(const remap::Range& alphas, std::size_t alpha_count, const remap::Range& speculars,
                      std::size_t specular_count);

// The law of the specular of `model` (probe_specular), from small pictures of widths from 0.1.
SpecularResponse specular_response(const Renderer& renderer, const ModelDescription& model);

// Canonical speculars that `model` takes, by the law that a few small pictures show (probe_specular).
remap::Range canonical_speculars(const Renderer& renderer, const ModelDescription& model);

// Width below which a highlight under the headlight has a radius of less than one pixel sample, so that a
// picture no longer resolves it.
double subpixel_alpha(int resolution, int samples_per_axis);

// The finished rows of a sweep that was interrupted, kept beside the table under `<table>.partial` and
// written a block of rows at a time. Rows of one source width form a block.
class SweepJournal {
 public:
  // Continues the journal at `path` where `resume` is set and it exists; else starts one. Nothing is kept
  // where `path` is empty. Throws kInput where it was made with other options, kOutput where it cannot be
  // written.
  SweepJournal(std::filesystem::path path, const Table& empty_table, std::size_t sample_count, bool resume);

  const std::optional<TableRow>& row(std::size_t sample) const { return rows_[sample]; }
  void append(const std::vector<std::size_t>& samples, const std::vector<TableRow>& rows);
  void remove();

 private:
  std::filesystem::path path_;
  bool has_diffuse_;
  std::vector<std::optional<TableRow>> rows_;
};

// Matches every sample. Stages 2: width and specular from pictures without diffuse, diffuse apart from them.
// Stages 1: width, specular and diffuse at once from kFixedGuess (joint_match.hpp); 3: the same from the
// result of 2. Where the two models' light differs by a factor, the source's pictures are multiplied by it
// first (section 4). The same table for any number of jobs, and whether resumed or not. Throws kUsage for
// unknown models and samples out of range, kNumeric where a search breaks, and what the renderer throws. What
// is finished is kept at `journal` where that is not empty.
Table run_sweep(const Renderer& renderer, const SweepOptions& options, const SweepExecution& execution,
                const std::filesystem::path& journal = {}, bool resume = false);

}  // namespace remapc
