#include "texremap/plan/converter_text.hpp"

#include <array>
#include <cmath>

#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "remap/version.hpp"
#include "texture/content_hash.hpp"

namespace remap {

std::string range_text(std::string_view name, const Range& range) {
  return std::string(name) + " " + number_text(range.min) + " to " + number_text(range.max);
}

std::string domain_text(const ConverterInfo& info) {
  return range_text(encoding_name(info.source.roughness), info.roughness) + ", " +
         range_text(info.source.specular, info.specular);
}

namespace {

std::string percent_text(double percent) {
  return percent < 0.05 ? "less than 0.1 %" : fixed(percent, 1) + " %";
}

}  // namespace

std::string difference_text(const ConverterPath& path) {
  if (is_copy(path)) {
    const bool is_equal =
        path.steps.front()->info().source.roughness == path.steps.back()->info().target.roughness;
    return std::string("both models have the same lobe, so that ") +
           (is_equal ? "numbers are copied" : "only the encoding of roughness changes");
  }
  const std::optional<PictureDifference> difference = picture_difference(path);
  if (!difference) return "pictures were never compared";
  return std::string("rendered pictures differ by ") + (difference->is_estimate ? "about " : "") +
         percent_text(difference->converted) +
         (difference->copied ? " (" + percent_text(*difference->copied) + " with copied numbers)" : "");
}

std::string models_text(const ConverterPath& path) { return joined(path_models(path), " -> "); }

std::string note_text(const ConverterPath& path, const std::optional<ConverterPath>& closer) {
  if (path.steps.empty()) return "";
  const std::optional<PictureDifference> difference = picture_difference(path);
  const bool is_told = is_copy(path) || (difference && difference->converted >= 100.0 * kVisible);
  if (!is_told && !closer) return "";
  std::string text = path.steps.front()->info().source.model + " to " + target_model(path) + ": ";
  if (is_told) text += difference_text(path);
  if (closer) text += (is_told ? "; " : "") + closer_text(*closer);
  return text;
}

std::string closer_text(const ConverterPath& closer) {
  return target_model(closer) + " matches the highlight more closely";
}

std::string closest_text(const std::string& model) {
  return model + " is the closest model of " + renderer_of(model);
}

std::string conventions_text(const WorkflowEnd& end) {
  std::string text = "diffuse " + std::string(diffuse_convention_name(diffuse_of(end)));
  if (const auto* metallic = std::get_if<MetallicWorkflow>(&end))
    text += ", dielectric F0 " + number_text(metallic->dielectric_f0);
  return text;
}

std::string converter_ids(const BuiltConversion& chosen) {
  const std::string ids =
      joined(chosen.path.steps, " ", [](const Converter* step) { return step->info().id; });
  if (chosen.choice.translation) return chosen.info().id;
  if (!chosen.choice.is_material()) return ids;
  return ids + (ids.empty() ? "" : " ") + chosen.info().id + " (" + conventions_text(*chosen.choice.source) +
         "; " + conventions_text(*chosen.choice.target) +
         (chosen.choice.finds_metallic() ? "; projection)" : ")");
}

Json path_json(const ConverterPath& path) {
  Json ids = Json::list();
  for (const Converter* step : path.steps) ids.push_back(step->info().id);
  return ids;
}

Json pictures_json(const ConverterPath& path, const std::optional<ConverterPath>& closer) {
  Json pictures, model;
  if (const auto difference = picture_difference(path))
    pictures = {{"converted", rounded(difference->converted, 3)},
                {"copied", difference->copied ? Json(*difference->copied) : Json()},
                {"is_estimate", difference->is_estimate}};
  if (closer)
    model = {{"model", target_model(*closer)},
             {"path", path_json(*closer)},
             {"expected_error", closer->expected_error}};
  return {{"pictures", pictures}, {"same_lobe", is_copy(path)}, {"closer_model", model}};
}

namespace {

// The hash of a converter covers its results for this many texels. If a number of the converter changes, the
// hash misses this only if no result for these texels changes.
constexpr std::size_t kProbed = 4096;

// Returns term `index` of the additive recurrence of dimension `row` (Weyl 1916, with roots of primes). The
// terms are evenly spread in [0, 1).
double spread(std::size_t index, std::size_t row) {
  constexpr std::array kPrimes = {2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0};
  const double step = std::sqrt(kPrimes[row % kPrimes.size()]);
  const double value = static_cast<double>(index + 1) * step;
  return value - std::floor(value);
}

// Adds the converter's results for texels all over its domain and slightly beyond. They depend on numbers and
// code.
void add_behaviour(const Converter& converter, ContentHash& hash) {
  const ConverterInfo& info = converter.info();
  std::array<std::vector<float>, 3 * kParameterCount> in, out;
  MaterialRows<const float> sources;
  MaterialRows<float> targets;
  std::size_t row = 0;
  for (const Parameter parameter : converter.sources()) {
    const std::size_t count = is_color(parameter) ? 3 : 1;
    Range range{0.0, 1.0};
    if (parameter == Parameter::kRoughness) range = info.roughness;
    if (parameter == Parameter::kSpecular) range = {0.0, info.specular.max};
    sources[parameter].count = count;
    for (std::size_t c = 0; c < count; ++c, ++row) {
      for (std::size_t i = 0; i < kProbed; ++i)
        in[row].push_back(static_cast<float>(range.min + 1.02 * (range.max - range.min) * spread(i, row)));
      sources[parameter].row[c] = in[row].data();
    }
  }
  row = 0;
  for (const Parameter parameter : converter.targets()) {
    if (is_measure(parameter)) continue;
    targets[parameter].count = converter.target_channels(parameter, 3);
    for (std::size_t c = 0; c < targets[parameter].count; ++c, ++row) {
      out[row].resize(kProbed);
      targets[parameter].row[c] = out[row].data();
    }
  }
  converter.convert(kProbed, sources, targets);
  for (const std::vector<float>& values : out)
    hash.add({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
}

}  // namespace

ConversionNote conversion_note(const std::string& source, const std::string& target, const std::string& ids,
                               const Converter& converter, const std::string& options) {
  ConversionNote note{source, target, "", {}};
  if (!ids.empty()) note.details.emplace_back("converter", ids);
  note.details.emplace_back("options", options);
  note.details.emplace_back("version", kVersion);
  ContentHash hash;
  hash.add(note.source);
  hash.add(note.target);
  for (const auto& [name, value] : note.details) hash.add(value);
  add_behaviour(converter, hash);
  note.hash = hash.hex();
  return note;
}

}  // namespace remap
