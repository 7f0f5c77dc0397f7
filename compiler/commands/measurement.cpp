#include "commands/measurement.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "command_line/progress.hpp"
#include "command_line/run_app.hpp"
#include "commands/option_readers.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "table/csv.hpp"

namespace remap {
namespace {

std::string one_decimal(double value) { return number_text(std::round(10.0 * value) / 10.0); }

// Returns `, 12 pictures rendered and 30 from the cache, 1 worker lost`, or nothing without workers.
std::string pictures_text(const PictureCount& pictures) {
  if (pictures.rendered + pictures.cached == 0) return "";
  const std::size_t lost = pictures.lost_workers;
  return ", " + std::to_string(pictures.rendered) + " pictures rendered and " +
         std::to_string(pictures.cached) + " from the cache" +
         (lost == 0 ? "" : ", " + counted(lost, "worker") + " lost");
}

// Returns `about 12:30 in all`. Returns an empty text before some rows and ten pictures are done, and after
// the end.
std::string estimate_text(double seconds, const PictureCount& pictures, std::size_t done, std::size_t rows) {
  constexpr std::size_t kEnoughPictures = 10;
  if (pictures.rendered + pictures.cached < kEnoughPictures || done == 0 || done == rows) return "";
  return "about " + clock_text(seconds * static_cast<double>(rows) / static_cast<double>(done)) + " in all";
}

// Adds the options that choose which parameters of a model are roughness, specular and diffuse.
void add_role_options(Command& app, const std::string& side, ParameterRoles& roles) {
  const std::string prefix = "--" + side;
  const auto roughness = [&roles](const std::string& option, const std::string& word) {
    ParameterRoles changed = roles;
    const std::size_t colon = word.find(':');
    changed.roughness = word.substr(0, colon);
    if (colon != std::string::npos)
      changed.convention = one_of(kRoughnessEncodings, "convention").read(option, word.substr(colon + 1));
    return changed;
  };
  app.add_option(prefix + "-roughness NAME[:CONVENTION]", roles, Reader<ParameterRoles>{roughness, {}},
                 "Parameter of the " + side + " to use as roughness (default: the model's roughness)");
  app.add_option(prefix + "-specular NAME", roles.specular, "Parameter to use as specular");
  app.add_option(prefix + "-diffuse NAME", roles.diffuse, "Parameter to use as diffuse");
  const auto value = [](const ParameterSetting& setting) {
    if (setting.values.size() != 1)
      setting.fail(std::to_string(setting.values.size()) +
                   " values given (give one: materials of a sweep are grey)");
    return setting.values.front();
  };
  add_settings<double>(app, prefix + "-set NAME=VALUE", roles.fixed, value,
                       "Fixed value of another parameter; may be repeated");
}

Reader<std::string> objective_name() {
  return {[](const std::string& option, const std::string& word) {
            if (std::ranges::find(kObjectives, word) == kObjectives.end())
              fail_unknown(option, "objective", word, kObjectives);
            return word;
          },
          {}};
}

}  // namespace

void MeasurementOptions::add_table_options(Command& app, const std::string& table) {
  app.option_group("Models");
  app.add_option("--source,--from MODEL", pair.source, "Model to convert from")->required();
  app.add_option("--target,--to MODEL", pair.target, "Model to convert to")->required();
  app.option_group("Output");
  app.add_option("-o,--output FILE", output, table)->required();
  add_force_flag(app, force);
  app.add_flag("--json", json, "Print a summary as JSON to standard output");
  app.add_flag("--quiet", quiet, "Print no progress and no summary");
}

void MeasurementOptions::add_picture_options(Command& app) {
  app.option_group("Pictures and how they are compared");
  app.add_option("--objective NAME", objective, objective_name(),
                 "natural: light at 65 degrees, relative weights, and the mean; natural-1: light at 60 "
                 "degrees, relative weights; paper: headlight, uniform weights")
      ->default_text("natural, now natural-2");
  app.add_option("--light LIGHTS", lights, list_of(light_angle()),
                 "Lights, comma-separated: headlight, or degrees from the camera (overrides --objective)");
  app.add_option("--weighting NAME", weighting, one_of(kWeightings, "weighting"),
                 "Weights of the pixels, overriding --objective");
  app.add_option("--resolution", pair.resolution, "Width and height in pixels");
  app.add_option("--pixel-samples", pair.samples_per_axis, "N x N samples per pixel; 1: the pixel center");
  app.option_group(kRareOptions);
  app.add_option("--distance", distance, "Distance of the lights, in sphere radii");
  app.add_flag("--no-irradiance-matching", keep_irradiance,
               "Do not correct for a constant factor between the lights of two renderers");
  add_accept_light_flag(app, pair.accept_light);
  app.option_group("Rare: parameters of models (remapc list --models, remapc renderers)");
  add_role_options(app, "source", pair.source_roles);
  add_role_options(app, "target", pair.target_roles);
}

void MeasurementOptions::add_execution_options(Command& app) {
  app.option_group(kRareOptions);
  app.add_option("--jobs", jobs, "Threads, 0: one per core; the table does not depend on it");
  add_renderer_options(app, renderers);
}

PairOptions MeasurementOptions::chosen_pair() const {
  PairOptions chosen = pair;
  const Objective preset = objective_preset(objective);
  chosen.objective = preset;
  if (lights) {
    chosen.objective.lights.clear();
    for (const double angle : *lights) chosen.objective.lights.push_back({angle, distance});
  }
  for (Light& light : chosen.objective.lights) light.distance = distance;
  chosen.objective.weighting = weighting.value_or(preset.weighting);
  if (chosen.objective != preset) chosen.objective.name = "custom";
  chosen.match_irradiance = !keep_irradiance;
  return chosen;
}

Measurement::Measurement(const MeasurementOptions& options) : options_(options) {
  watch_interruptions();
  renderer_ = make_renderers(options.renderers);
}

SweepExecution Measurement::start(const std::string& label, std::size_t rows) {
  require_new_table(options_.output, options_.force);
  create_parent(options_.output);
  const std::string models = label + " " + options_.pair.source + " -> " + options_.pair.target;
  progress_.emplace(models, rows, !options_.quiet);
  renderer_->watch([this, models](const PictureCount&) { show_progress(models); });
  return {options_.jobs,
          [this, models](std::size_t done, std::size_t all) {
            progress_->advance_to(done);
            estimate(models, done, all);
            show_progress(models);
          },
          &interruption()};
}

void Measurement::show_progress(const std::string& models) {
  const std::lock_guard lock(mutex_);
  progress_->relabel(models + pictures_text(renderer_->pictures()) +
                     (estimate_.empty() ? "" : ", " + estimate_));
}

void Measurement::estimate(const std::string& models, std::size_t done, std::size_t rows) {
  const std::lock_guard lock(mutex_);
  const std::string text = estimate_text(stopwatch_.seconds(), renderer_->pictures(), done, rows);
  if (text.empty()) return;
  if (estimate_.empty() && !options_.quiet && !terminal_watches_errors())
    print_message("remapc", models + ": " + text);
  estimate_ = text;
}

void Measurement::write(const std::string& table, const Comments& comments) {
  renderer_->watch(nullptr);
  progress_.reset();
  write_plain_table(options_.output, table);
  light_ = light_match(comments);
  if (const std::string remark = light_remark(light_); !remark.empty())
    print_message("remapc", "warning: " + options_.output.string() + ": " + remark);
  for (const std::string& remark : renderer_->remarks()) std::cerr << "remapc: " << remark << "\n";
}

void Measurement::report(const std::map<std::string, std::size_t>& statuses, double rms_error,
                         const Json& fields) const {
  const std::string table = options_.output.string();
  const double seconds = stopwatch_.seconds();
  const PictureCount pictures = renderer_->pictures();
  std::size_t rows = 0;
  std::string counts;
  for (const auto& [status, count] : statuses) {
    rows += count;
    counts += (counts.empty() ? "" : ", ") + std::to_string(count) + " " + status;
  }
  if (options_.json) {
    const std::string remark = light_remark(light_);
    Json json = {{"table", table}};
    if (fields.fields() != nullptr) json.update(fields);
    json.update({{"rows", rows},
                 {"status", statuses},
                 {"rms_image_error", rms_error},
                 {kLightScaleComment, light_.scale},
                 {kDiffuseErrorComment, light_.diffuse_error},
                 {"light_warning", remark.empty() ? nullptr : Json(remark)},
                 {"pictures_rendered", pictures.rendered},
                 {"pictures_cached", pictures.cached},
                 {"workers_lost", pictures.lost_workers},
                 {"seconds", seconds}});
    std::cout << json.dump(2) << "\n";
  } else if (!options_.quiet) {
    std::cerr << table << ": " << rows << " rows (" << counts << "), image error "
              << one_decimal(100.0 * rms_error) << " % rms" << pictures_text(pictures) << ", "
              << one_decimal(seconds) << " s\n";
  }
}

}  // namespace remap
