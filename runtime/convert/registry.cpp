// The converters that were compiled into this program: the generated registry behind the interface.
#include "registry.hpp"

#include <algorithm>
#include <array>

#include "convert/converter.hpp"
#include "error.hpp"
#include "nearest_name.hpp"
#include "number_text.hpp"

namespace remap {
namespace {

ModelSide side(const char* model, const char* roughness, const char* specular) {
  return {model, convention_from_name(roughness).value(), specular};
}

ConverterInfo info_of(const ConverterEntry& entry) {
  return {entry.id,
          side(entry.source_model, entry.source_roughness, entry.source_specular),
          side(entry.target_model, entry.target_roughness, entry.target_specular),
          {decimal_value(entry.roughness_min), decimal_value(entry.roughness_max)},
          {decimal_value(entry.specular_min), decimal_value(entry.specular_max)},
          decimal_value(entry.roughness_rms_error),
          decimal_value(entry.specular_rms_error)};
}

class CompiledConverter final : public Converter {
 public:
  explicit CompiledConverter(const ConverterEntry& entry) : Converter(info_of(entry)), entry_(entry) {}

  std::size_t convert(std::size_t count, const float* roughness, std::span<const float* const> specular,
                      float* roughness_out, std::span<float* const> specular_out) const override {
    if (specular.size() == 1)
      return entry_.evaluate_1(count, roughness, {specular[0]}, roughness_out, {specular_out[0]});
    if (specular.size() == 3)
      return entry_.evaluate_3(count, roughness, {specular[0], specular[1], specular[2]}, roughness_out,
                               {specular_out[0], specular_out[1], specular_out[2]});
    throw Error(ErrorKind::kUsage,
                "converter: got " + std::to_string(specular.size()) + " specular channels; expected 1 or 3");
  }

  bool self_test() const override { return entry_.self_test(); }

 private:
  const ConverterEntry& entry_;
};

// Sorted, each name once.
std::vector<std::string> unique_names(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

void require_known(const std::string& model, const std::vector<std::string>& known, const char* role) {
  if (std::find(known.begin(), known.end(), model) != known.end()) return;
  throw Error(ErrorKind::kUsage, model + ": is no " + role + " of a converter" + suggestion(model, known));
}

}  // namespace

const std::vector<std::unique_ptr<Converter>>& compiled_converters() {
  static const std::vector<std::unique_ptr<Converter>> converters = [] {
    std::vector<std::unique_ptr<Converter>> made;
    for (const ConverterEntry& entry : kConverters)
      made.push_back(std::make_unique<CompiledConverter>(entry));
    std::sort(made.begin(), made.end(),
              [](const auto& a, const auto& b) { return a->info().id < b->info().id; });
    return made;
  }();
  return converters;
}

const Converter& find_converter(const std::string& source_model, const std::string& target_model) {
  std::vector<std::string> sources, targets, targets_of_source;
  for (const auto& converter : compiled_converters()) {
    const ConverterInfo& info = converter->info();
    if (info.source.model == source_model && info.target.model == target_model) return *converter;
    sources.push_back(info.source.model);
    targets.push_back(info.target.model);
    if (info.source.model == source_model) targets_of_source.push_back(info.target.model);
  }
  require_known(source_model, unique_names(sources), "source");
  require_known(target_model, unique_names(targets), "target");
  std::string reachable;
  for (const std::string& name : unique_names(targets_of_source))
    reachable += (reachable.empty() ? "" : ", ") + name;
  throw Error(ErrorKind::kUsage, source_model + " to " + target_model + ": there is no converter; " +
                                     source_model + " converts to " + reachable);
}

}  // namespace remap
