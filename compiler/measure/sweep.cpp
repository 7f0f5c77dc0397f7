#include "measure/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/parallel.hpp"
#include "look/image.hpp"
#include "measure/block_match.hpp"
#include "measure/match.hpp"
#include "measure/picture_taker.hpp"
#include "measure/probe.hpp"
#include "measure/sweep_options.hpp"
#include "measure/target_pictures.hpp"
#include "remap/error.hpp"
#include "remap/version.hpp"
#include "table/regression.hpp"

namespace remap {
namespace {

// This is half of the rows that a table may have when it is read, because rows at the ends of regimes are
// added.
constexpr std::size_t kMostSweepSamples = kMostCsvRows / 2;
// This resolution suffices, because the law of specular shows in any picture that resolves the highlight.
constexpr int kProbeResolution = 64;
// smallest probed alpha, or the model's least alpha if that is larger
constexpr double kLeastProbedAlpha = 0.1;
// The spheres of this many widths of a table are compared. For each of these widths, the row is used whose
// specular1 is closest to half of the source's range.
constexpr std::size_t kComparedSpheres = 8;

std::vector<SampleBlock> blocks_of(const std::vector<MappedTexel>& samples) {
  std::map<double, std::vector<std::size_t>> by_alpha;
  for (std::size_t i = 0; i < samples.size(); ++i) by_alpha[samples[i].alpha].push_back(i);
  std::vector<SampleBlock> blocks;
  for (auto& [alpha, indices] : by_alpha) blocks.push_back(std::move(indices));
  return blocks;
}

Range sampled_alphas(const std::vector<MappedTexel>& samples) {
  const auto [low, high] = std::ranges::minmax_element(samples, {}, &MappedTexel::alpha);
  return {low->alpha, high->alpha};
}

void require_options(const SweepOptions& options, const ModelDescription& source,
                     const ModelDescription& target) {
  if (options.samples.empty()) throw usage_error("samples: at least one is needed");
  if (options.samples.size() > kMostSweepSamples)
    throw usage_error("samples: " + std::to_string(options.samples.size()) + " are too many (at most " +
                      std::to_string(kMostSweepSamples) + ")");
  if (options.stages < 1 || options.stages > 3)
    throw usage_error("stages: " + std::to_string(options.stages) + " is out of range (choose 1, 2 or 3)");
  if (!has_diffuse(options)) return;
  target.parameter(ParameterRole::kDiffuse);  // throws if the target has none to match
  // A source without a diffuse parameter may still have diffuse light, if one base color sets both lobes.
  if (options.stages == 1 && options.diffuse == 0.0 && !source.has(ParameterRole::kDiffuse)) return;
  const Range diffuses = source.parameter(ParameterRole::kDiffuse).range;
  if (!diffuses.contains(options.diffuse))
    throw usage_error(source.name + ": diffuse " + number_text(options.diffuse) + " is out of range (" +
                      range_text(diffuses) + ")");
}

void require_alphas(const SweepOptions& options, const ModelDescription& source) {
  for (const MappedTexel& sample : options.samples)
    if (!source.alpha.contains(sample.alpha))
      throw Error(
          ErrorKind::kUsage,
          source.name + ": alpha " + number_text(sample.alpha) +
              " of a sample is out of range (choose --roughness-range or --samples-of with alphas from " +
              range_text(source.alpha) + ")");
}

void require_speculars(const SweepOptions& options, const ProbedModel& source) {
  const Range speculars = source.specular_range();
  for (const MappedTexel& sample : options.samples)
    if (!speculars.contains(sample.specular))
      throw Error(
          ErrorKind::kUsage,
          source.model.name + ": specular " + number_text(sample.specular) +
              " of a sample is out of range (choose --specular-range or --samples-of with speculars from " +
              range_text(speculars) + ")");
}

// Pictures are floats, so digits after the ninth have no meaning.
double rounded_ratio(double ratio) { return ratio >= 1e-3 ? std::round(ratio * 1e9) / 1e9 : ratio; }

// Matches are accurate to about 1e-7, so more digits would only enlarge the table.
std::vector<TableRow> rounded(std::vector<TableRow> rows) {
  constexpr int kDigits = 10, kErrorDigits = 6;
  for (TableRow& row : rows) {
    for (double* value : {&row.alpha2, &row.specular2, &row.diffuse2})
      *value = remap::rounded(*value, kDigits);
    row.error = remap::rounded(row.error, kErrorDigits);
  }
  return rows;
}

// Returns the content of the columns of a side.
ModelSide column_side(const ProbedModel& probed_model) {
  ModelSide side = model_side(probed_model.model);
  if (probed_model.response.law == SpecularLaw::kIor) side.specular = "f0";
  return side;
}

void add_stages(const SweepSetup& setup, Table* table) {
  const SweepOptions& options = setup.options;
  auto& comments = table->comments;
  comments.emplace_back("stages", std::to_string(options.stages));
  if (options.stages == 1) {
    comments.emplace_back(
        "initial_guess", number_text(kFixedGuess.alpha) + "," + number_text(kFixedGuess.specular) + "," +
                             number_text(kFixedGuess.diffuse) + " of the ranges of alpha, specular, diffuse");
  }
  if (table->has_diffuse) comments.emplace_back("diffuse", number_text(options.diffuse));
  for (const ModelDescription* model : {&setup.source.model, &setup.target.model})
    if (!model->has(ParameterRole::kDiffuse))
      comments.emplace_back("irradiance", "taken to be the same: " + model->name + " has no diffuse");
  LightMatch light = setup.light();
  light.scale = rounded_ratio(light.scale);
  add_light_scale(light, &comments);
  comments.emplace_back("diffuse_scale", number_text(rounded_ratio(setup.diffuse.scale)));
  comments.emplace_back(kDiffuseErrorComment, number_text(rounded_up(setup.diffuse.error, 2)));
}

Table empty_table(const SteadyRenderer& renderer, const SweepSetup& setup) {
  const SweepOptions& options = setup.options;
  Table table;
  table.source = column_side(setup.source);
  table.target = column_side(setup.target);
  table.has_diffuse = has_diffuse(options);
  table.comments = {{"tool", std::string("remapc ") + kVersion}};
  add_side("source", setup.source, &table.comments);
  add_widths("source", sampled_alphas(options.samples), setup.source_widths, &table.comments);
  add_noise("source", renderer, options.source, &table.comments);
  add_side("target", setup.target, &table.comments);
  add_limits(setup.limits(), &table.comments);
  add_widths("target", setup.wanted_widths, setup.target_widths, &table.comments);
  add_noise("target", renderer, options.target, &table.comments);
  add_comparison(renderer, options, &table.comments);
  add_stages(setup, &table);
  add_resolution(options, &table.comments);
  table.comments.emplace_back("samples", options.sampling);
  return table;
}

// Probes both models, matches their light, and prepares the data that the blocks share.
SweepSetup make_setup(const SweepOptions& options, const PictureTaker& picture_taker,
                      const ModelDescription& source, const ModelDescription& target) {
  const Range alphas = probe_widths(picture_taker, source, sampled_alphas(options.samples));
  const Range wanted = searched_widths(target, alphas.min);
  const Range searched = probe_widths(picture_taker, target, wanted);
  ModelDescription responsive = target;  // restricted to the widths that change its pictures
  if (searched.min > wanted.min) responsive.alpha.min = searched.min;
  if (searched.max < wanted.max) responsive.alpha.max = searched.max;
  const Range probed{std::max(searched.min, alphas.min), searched.max};
  // These are not computed inside the aggregate. If a later member throws, gcc 12 destroys earlier members
  // twice.
  const SpecularResponse source_law = probe_specular(picture_taker, source, alphas);
  const SpecularResponse target_law = probe_specular(picture_taker, target, probed);
  const DiffuseMatch diffuse =
      light_matched(source, target) ? match_diffuse(picture_taker, source, target) : DiffuseMatch{};
  SweepSetup setup{options,  picture_taker, {source, source_law}, {}, 1.0, diffuse, nullptr, alphas,
                   searched, wanted};
  if (options.match_irradiance) {
    setup.irradiance_scale = setup.source.exposure = 1.0 / setup.diffuse.scale;
    setup.diffuse.scale = 1.0;
  }
  require_light(setup.light(), options.source + " to " + options.target);
  if (!setup.source.response.affine()) setup.source.curve = probe_family(picture_taker, source, alphas);
  setup.target =
      match_target(picture_taker, {responsive, target_law}, searched, probed, has_diffuse(options));
  if (!setup.target.bank) setup.grid = std::make_unique<TargetGrid>(picture_taker, setup.target, searched);
  return setup;
}

// Returns, for each width, the usable row whose specular is closest to `specular`.
std::map<double, const TableRow*> middle_rows(const std::vector<TableRow>& rows, double specular) {
  std::map<double, const TableRow*> middle;
  for (const TableRow& row : rows) {
    if (row.status != RowStatus::kOk) continue;
    const TableRow*& chosen = middle[row.alpha1];
    if (chosen == nullptr || std::fabs(row.specular1 - specular) < std::fabs(chosen->specular1 - specular))
      chosen = &row;
  }
  return middle;
}

std::vector<const TableRow*> compared_rows(const SweepSetup& setup, const std::vector<TableRow>& rows) {
  const Range range = setup.source.linear_range();
  std::vector<const TableRow*> all, spread;
  for (const auto& [alpha, row] : middle_rows(rows, 0.5 * (range.min + range.max))) all.push_back(row);
  const std::size_t count = std::min(all.size(), kComparedSpheres);
  for (std::size_t i = 0; i < count; ++i)
    spread.push_back(all[count == 1 ? 0 : i * (all.size() - 1) / (count - 1)]);
  return spread;
}

// Returns the exposure that makes the brightest point of a white diffuse sphere 1. Without diffuse, computes
// it for an albedo of 1 that is lit at right angles from the distance of the light.
double white_exposure(const SweepSetup& setup) {
  if (!setup.target.model.has(ParameterRole::kDiffuse)) {
    const double distance = setup.options.objective.lights.front().distance - 1.0;
    return std::numbers::pi * distance * distance;
  }
  const double alpha = std::sqrt(setup.target.model.alpha.min * setup.target.model.alpha.max);
  const double black = setup.target.specular_range().min;
  const double white = setup.target.model.parameter(ParameterRole::kDiffuse).range.max;
  const auto lit = setup.picture_taker.take(setup.target, {alpha, black, white});
  const auto dark = setup.picture_taker.take(setup.target, {alpha, black, 0.0});
  float brightest = 0.0f;
  for (std::size_t i = 0; i < setup.picture_taker.pixel_count(); ++i)
    brightest = std::max(brightest, lit[i] - dark[i]);
  return brightest > 0.0f ? 1.0 / static_cast<double>(brightest) : 1.0;
}

// Returns the comment kSpheresComment of a table, by rising width: `0.1 0.998, 0.5 0.97`. It holds the
// structural similarity between the source's sphere and the matched sphere, as a display shows them. The
// first light of the objective lights both. They have no diffuse, and the exposure of white_exposure().
std::string spheres_text(const SweepSetup& setup, const std::vector<TableRow>& rows) {
  const double exposure = white_exposure(setup);
  const int side = setup.options.resolution;
  const auto displayed = [&](const ProbedModel& probed_model, double alpha, double specular) {
    std::vector<float> square =
        setup.picture_taker.square_picture(setup.picture_taker.take(probed_model, {alpha, specular, 0.0}));
    for (float& value : square) value = display_value(exposure * static_cast<double>(value));
    return square;
  };
  std::string text;
  for (const TableRow* row : compared_rows(setup, rows)) {
    const auto source = displayed(setup.source, row->alpha1, row->specular1);
    const auto target = displayed(setup.target, row->alpha2, row->specular2);
    const double ssim = structural_similarity(source, target, side, side);
    text += (text.empty() ? "" : ", ") + number_text(row->alpha1) + " " +
            number_text(std::round(ssim * 1e4) / 1e4);
  }
  return text;
}

}  // namespace

std::vector<MappedTexel> grid_samples(const Range& alphas, std::size_t alpha_count, const Range& speculars,
                                      std::size_t specular_count) {
  const auto value = [](const Range& range, std::size_t i, std::size_t count, bool open) {
    const double share = open         ? static_cast<double>(i + 1) / static_cast<double>(count)
                         : count == 1 ? 1.0
                                      : static_cast<double>(i) / static_cast<double>(count - 1);
    return range.min + share * (range.max - range.min);
  };
  std::vector<MappedTexel> samples;
  for (std::size_t i = 0; i < alpha_count; ++i)
    for (std::size_t j = 0; j < specular_count; ++j)
      samples.push_back({rounded(value(alphas, i, alpha_count, false), kSampleDigits),
                         rounded(value(speculars, j, specular_count, speculars.min == 0.0), kSampleDigits)});
  return samples;
}

std::string grid_text(const Range& alphas, std::size_t alpha_count, const Range& speculars,
                      std::size_t specular_count) {
  return std::to_string(alpha_count) + " alpha " + range_text(alphas) + " x " +
         std::to_string(specular_count) + " specular " + range_text(speculars);
}

SpecularResponse specular_response(const Renderer& renderer, const ModelDescription& model) {
  const PictureTaker picture_taker(renderer, objective_preset("natural-1"), kProbeResolution, 1);
  return probe_specular(picture_taker, model,
                        {std::max(kLeastProbedAlpha, model.alpha.min), model.alpha.max});
}

Range canonical_speculars(const Renderer& renderer, const ModelDescription& model) {
  return ProbedModel{model, specular_response(renderer, model)}.specular_range();
}

Table run_sweep(const Renderer& any_renderer, const SweepOptions& options, const SweepExecution& execution) {
  const SteadyRenderer renderer(any_renderer, {options.source, options.target},
                                options.objective.lights.front());
  const ModelDescription source = recast(renderer.model(options.source), options.source_roles);
  const ModelDescription target = recast(renderer.model(options.target), options.target_roles);
  require_options(options, source, target);
  require_alphas(options, source);
  const PictureTaker picture_taker(renderer, options.objective, options.resolution, options.samples_per_axis);
  const SweepSetup setup = make_setup(options, picture_taker, source, target);
  require_speculars(options, setup.source);

  Table table = empty_table(renderer, setup);
  table.rows.resize(options.samples.size());
  const std::vector<SampleBlock> blocks = blocks_of(options.samples);
  std::mutex mutex;
  std::size_t done = 0;
  std::vector<std::vector<TableRow>> boundaries(blocks.size());
  run_parallel(blocks.size(), execution.jobs, [&](std::size_t b) {
    const SampleBlock& block = blocks[b];
    if (execution.cancelled != nullptr && *execution.cancelled)
      throw Error(ErrorKind::kInterrupted, "sweep: interrupted");
    const std::vector<TableRow> rows = rounded(match_block(setup, block));
    const std::lock_guard lock(mutex);
    for (std::size_t i = 0; i < block.size(); ++i) table.rows[block[i]] = rows[i];
    boundaries[b].assign(rows.begin() + static_cast<std::ptrdiff_t>(block.size()), rows.end());
    done += block.size();
    if (execution.progress) execution.progress(done, options.samples.size());
  });
  table.comments.emplace_back(kSpheresComment, spheres_text(setup, table.rows));
  for (const auto& rows : boundaries) table.rows.insert(table.rows.end(), rows.begin(), rows.end());
  find_limits(&table);
  return table;
}

}  // namespace remap
