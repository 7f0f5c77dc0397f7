#include "sweep/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "error.hpp"
#include "number_text.hpp"
#include "parallel.hpp"
#include "sweep/match.hpp"
#include "sweep/photographer.hpp"
#include "sweep/target_bank.hpp"
#include "version.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;
using remap::number_text;
using remap::Range;

// Neighbouring widths of the bank. Interpolating the loss over twelve of them is good to 1e-7 in alpha.
constexpr double kBankRatio = 1.05;
// The search reaches this far below the narrowest source width; no pair of the hub differs by more than 2.
constexpr double kNarrowing = 4.0;

// Samples of one source width, as indices into SweepOptions::samples: the unit of work and of the journal.
struct Block {
  double alpha;
  std::vector<std::size_t> samples;
};

std::vector<Block> blocks_of(const std::vector<SamplePoint>& samples) {
  std::map<double, std::vector<std::size_t>> by_alpha;
  for (std::size_t i = 0; i < samples.size(); ++i) by_alpha[samples[i].alpha].push_back(i);
  std::vector<Block> blocks;
  for (auto& [alpha, indices] : by_alpha) blocks.push_back({alpha, std::move(indices)});
  return blocks;
}

// Everything that the blocks of one sweep share.
struct Setup {
  const SweepOptions& options;
  ModelDescription source;
  ModelDescription target;
  Photographer photographer;
  SpecularResponse source_response;
  TargetBank bank;
};

double max_specular(const ModelDescription& model) {
  return model.parameter(ParameterRole::kSpecular).range.max;
}

Range sampled_alphas(const std::vector<SamplePoint>& samples) {
  const auto [low, high] =
      std::minmax_element(samples.begin(), samples.end(),
                          [](const SamplePoint& a, const SamplePoint& b) { return a.alpha < b.alpha; });
  return {low->alpha, high->alpha};
}

void require_samples(const SweepOptions& options, const ModelDescription& source) {
  if (options.samples.empty())
    throw Error(ErrorKind::kUsage, "samples: there are none; expected at least one");
  const Range speculars = source.parameter(ParameterRole::kSpecular).range;
  for (const SamplePoint& sample : options.samples) {
    if (source.alpha.contains(sample.alpha) && speculars.contains(sample.specular)) continue;
    throw Error(ErrorKind::kUsage, source.name + ": sample alpha " + number_text(sample.alpha) +
                                       ", specular " + number_text(sample.specular) +
                                       " is out of range; expected alpha " + number_text(source.alpha.min) +
                                       " to " + number_text(source.alpha.max) + ", specular " +
                                       number_text(speculars.min) + " to " + number_text(speculars.max));
  }
}

TableRow flat_row(const SamplePoint& sample, const ModelDescription& target) {
  const double alpha = std::clamp(sample.alpha, target.alpha.min, target.alpha.max);
  return {sample.alpha, sample.specular, alpha, 0.0, 0.0, RowStatus::kFlat, 0};
}

TableRow matched_row(const SamplePoint& sample, const Match& match) {
  return {sample.alpha, sample.specular, match.alpha, match.specular, match.error, match.status, 0};
}

// Pictures of the source where nothing is known of how they depend on specular: one for each sample.
std::vector<TableRow> match_each(const Setup& setup, const Block& block) {
  std::vector<TableRow> rows;
  std::vector<std::size_t> minima;
  for (const std::size_t index : block.samples) {
    const SamplePoint& sample = setup.options.samples[index];
    auto picture = setup.photographer.take(setup.source, {sample.alpha, sample.specular, 0.0});
    if (sample.specular == 0.0 || *std::max_element(picture.begin(), picture.end()) <= 0.0f) {
      rows.push_back(flat_row(sample, setup.target));
      continue;
    }
    auto weights =
        squared_weights(setup.photographer.objective(), picture, setup.photographer.view_cosines());
    Matcher matcher(setup.bank, {std::move(picture)}, std::move(weights));
    rows.push_back(matched_row(sample, matcher.match({1.0}, &minima)));
  }
  return rows;
}

// Pictures of an affine source are combinations of two. Where the weights do not depend on specular either
// (uniform, or relative to a picture that only scales), one set of inner products serves the whole block.
std::vector<TableRow> match_together(const Setup& setup, const Block& block) {
  const double full = max_specular(setup.source);
  auto base = setup.photographer.take(setup.source, {block.alpha, 0.0, 0.0});
  auto slope = setup.photographer.take(setup.source, {block.alpha, full, 0.0});
  auto weights = squared_weights(setup.photographer.objective(), slope, setup.photographer.view_cosines());
  for (std::size_t i = 0; i < slope.size(); ++i)
    slope[i] = static_cast<float>((static_cast<double>(slope[i]) - base[i]) / full);
  const bool proportional = setup.source_response.proportional;
  std::vector<std::vector<float>> basis;
  basis.push_back(std::move(slope));
  if (!proportional) basis.push_back(std::move(base));
  Matcher matcher(setup.bank, std::move(basis), std::move(weights));

  std::vector<TableRow> rows;
  for (const std::size_t index : block.samples) {
    const SamplePoint& sample = setup.options.samples[index];
    std::vector<std::size_t> minima;  // products are shared, so every material can search the whole bank
    std::vector<double> coefficients = {sample.specular};
    if (!proportional) coefficients.push_back(1.0);
    rows.push_back(sample.specular == 0.0 ? flat_row(sample, setup.target)
                                          : matched_row(sample, matcher.match(coefficients, &minima)));
  }
  return rows;
}

std::vector<TableRow> match_block(const Setup& setup, const Block& block) {
  const bool uniform = setup.options.objective.weighting == Weighting::kUniform;
  const SpecularResponse& source = setup.source_response;
  return source.proportional || (source.affine && uniform) ? match_together(setup, block)
                                                           : match_each(setup, block);
}

std::string yes_no(bool value) { return value ? "yes" : "no"; }

std::string lights_text(const std::vector<Light>& lights) {
  std::string text;
  for (const Light& light : lights) text += (text.empty() ? "" : ",") + light_name(light);
  return text;
}

Table empty_table(const Renderer& renderer, const Setup& setup, const SpecularResponse& target_response) {
  const SweepOptions& options = setup.options;
  const DiffuseMatch diffuse = match_diffuse(setup.photographer, setup.source, setup.target);
  const remap::ModelSide source = model_side(setup.source), target = model_side(setup.target);
  Table table;
  table.source = source;
  table.target = target;
  table.comments = {
      {"tool", std::string("remapc ") + remap::kVersion},
      {"source", source.model},
      {"source_roughness", std::string(remap::convention_name(source.roughness))},
      {"source_specular", source.specular},
      {"source_specular_proportional", yes_no(setup.source_response.proportional)},
      {"target", target.model},
      {"target_roughness", std::string(remap::convention_name(target.roughness))},
      {"target_specular", target.specular},
      {"target_specular_proportional", yes_no(target_response.proportional)},
      {"renderer", renderer.version()},
      {"objective", options.objective_name},
      {"lights", lights_text(options.objective.lights)},
      {"weighting", weighting_name(options.objective.weighting)},
  };
  if (options.objective.weighting == Weighting::kRelative)
    table.comments.emplace_back("weighting_floor", number_text(options.objective.floor));
  table.comments.emplace_back("stages", "2");
  table.comments.emplace_back("diffuse_scale", number_text(std::round(diffuse.scale * 1e9) / 1e9));
  table.comments.emplace_back("diffuse_error", number_text(remap::rounded_up(diffuse.error, 2)));
  table.comments.emplace_back("resolution", std::to_string(options.resolution));
  table.comments.emplace_back("pixel_samples", std::to_string(options.samples_per_axis) + "x" +
                                                   std::to_string(options.samples_per_axis));
  table.comments.emplace_back("subpixel_alpha",
                              number_text(subpixel_alpha(options.resolution, options.samples_per_axis)));
  table.comments.emplace_back("samples", options.sampling);
  return table;
}

}  // namespace

std::vector<SamplePoint> grid_samples(const Range& alphas, std::size_t alpha_count, const Range& speculars,
                                      std::size_t specular_count) {
  const auto value = [](const Range& range, std::size_t i, std::size_t count, bool open) {
    const double share = open         ? static_cast<double>(i + 1) / static_cast<double>(count)
                         : count == 1 ? 1.0
                                      : static_cast<double>(i) / static_cast<double>(count - 1);
    return range.min + share * (range.max - range.min);
  };
  std::vector<SamplePoint> samples;
  for (std::size_t i = 0; i < alpha_count; ++i)
    for (std::size_t j = 0; j < specular_count; ++j)
      samples.push_back(
          {value(alphas, i, alpha_count, false), value(speculars, j, specular_count, speculars.min == 0.0)});
  return samples;
}

std::string grid_text(const Range& alphas, std::size_t alpha_count, const Range& speculars,
                      std::size_t specular_count) {
  const auto text = [](const Range& range) {
    return number_text(range.min) + " to " + number_text(range.max);
  };
  return std::to_string(alpha_count) + " alpha " + text(alphas) + " x " + std::to_string(specular_count) +
         " specular " + text(speculars);
}

double subpixel_alpha(int resolution, int samples_per_axis) {
  // The sphere's radius is resolution / 2 pixels; at a camera distance of 3 the half vector turns by 1.5
  // times the angle of the normal near the middle of the picture.
  return 1.5 / (0.5 * resolution * samples_per_axis);
}

Table run_sweep(const Renderer& renderer, const SweepOptions& options, const SweepExecution& execution,
                const std::filesystem::path& journal_path, bool resume) {
  const ModelDescription source = find_model(renderer, options.source);
  const ModelDescription target = find_model(renderer, options.target);
  require_samples(options, source);
  const Photographer photographer(renderer, options.objective, options.resolution, options.samples_per_axis);
  const Range alphas = sampled_alphas(options.samples);
  const Range target_alphas{std::max(target.alpha.min, alphas.min / kNarrowing), target.alpha.max};
  const SpecularResponse target_response = probe_specular(
      photographer, target, {std::max(target.alpha.min, alphas.min), target.alpha.max}, max_specular(target));
  if (!target_response.affine)
    throw Error(ErrorKind::kNumeric, target.name + ": pictures deviate by " +
                                         number_text(target_response.residual) + " from affine in " +
                                         model_side(target).specular +
                                         "; this version matches targets that are affine in it");
  const Setup setup{options,
                    source,
                    target,
                    photographer,
                    probe_specular(photographer, source, alphas, max_specular(source)),
                    TargetBank(photographer, target, target_alphas, kBankRatio)};

  Table table = empty_table(renderer, setup, target_response);
  SweepJournal journal(journal_path, table, options.samples.size(), resume);
  table.rows.resize(options.samples.size());
  const std::vector<Block> blocks = blocks_of(options.samples);
  std::mutex mutex;
  std::size_t done = 0;
  remap::run_parallel(blocks.size(), execution.jobs, [&](std::size_t b) {
    const Block& block = blocks[b];
    const bool known = std::all_of(block.samples.begin(), block.samples.end(),
                                   [&](std::size_t sample) { return journal.row(sample).has_value(); });
    if (!known && execution.cancelled != nullptr && *execution.cancelled)
      throw Error(ErrorKind::kInterrupted, "sweep: interrupted; continue it with --resume");
    std::vector<TableRow> rows;
    if (!known) rows = match_block(setup, block);
    const std::lock_guard lock(mutex);
    if (!known) journal.append(block.samples, rows);
    for (std::size_t i = 0; i < block.samples.size(); ++i)
      table.rows[block.samples[i]] = known ? *journal.row(block.samples[i]) : rows[i];
    done += block.samples.size();
    if (execution.progress) execution.progress(done, options.samples.size());
  });
  return table;
}

}  // namespace remapc
