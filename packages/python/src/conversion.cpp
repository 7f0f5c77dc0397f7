#include "conversion.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "buffers.hpp"
#include "command_line/command.hpp"
#include "core/errors.hpp"
#include "paths/converter_file.hpp"
#include "remap/error.hpp"
#include "remap/warp.hpp"
#include "stages/stage.hpp"

namespace nb = nanobind;

namespace remap::python {
namespace {

// Returns a member of a dict, or nothing if it is missing or None.
template <typename Value>
std::optional<Value> member(const nb::dict& dict, const char* name) {
  if (!dict.contains(name)) return std::nullopt;
  const nb::object value = dict[name];
  if (value.is_none()) return std::nullopt;
  Value cast{};
  if (!nb::try_cast(value, cast))
    throw usage_error(std::string(name) + ": has the wrong type (see help(texremap.convert))");
  return cast;
}

// Returns one of a table of names.
template <typename Value, std::size_t Count>
std::optional<Value> named_member(const nb::dict& dict, const char* name,
                                  const NamedValues<Value, Count>& table) {
  const auto word = member<std::string>(dict, name);
  if (!word) return std::nullopt;
  return one_of(table, "value").read(name, *word);
}

Parameter parameter_named(const std::string& name) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    known.push_back(plain_name(static_cast<Parameter>(i)));
    if (known.back() == name) return static_cast<Parameter>(i);
  }
  fail_unknown("parameter", "name", name, known);
}

std::string text_of(nb::handle key) { return nb::cast<std::string>(key); }

// A MapSize checks that sizes of arrays agree with the first one.
class MapSize {
 public:
  void hold(const Buffer& buffer, const std::string& name, MapConversion& maps) {
    const std::size_t height = buffer.extent(0), width = buffer.extent(1);
    if (is_known_ && (height != maps.height || width != maps.width))
      throw usage_error(name + ": is " + std::to_string(width) + "x" + std::to_string(height) +
                        ", but others are " + std::to_string(maps.width) + "x" + std::to_string(maps.height));
    is_known_ = true;
    maps.height = height;
    maps.width = width;
  }

 private:
  bool is_known_ = false;
};

// A PreparedMaps is copied from Python, so that the work needs no interpreter lock.
struct PreparedMaps {
  MapConversion maps;
  std::vector<Buffer> held;
  int threads = 1;
};

void add_sources(const nb::dict& sources, const nb::dict& transfers, MapSize& size, PreparedMaps& prepared) {
  for (const auto& [key, value] : sources) {
    const std::string name = text_of(key);
    SourceParameter& source = prepared.maps.sources[parameter_named(name)];
    source.name = name;
    if (nb::isinstance<nb::list>(value)) {
      source.constants = nb::cast<std::vector<float>>(value);
      continue;
    }
    const Buffer& buffer = prepared.held.emplace_back(value, Buffer::Access::kRead, name);
    size.hold(buffer, name, prepared.maps);
    source.channels = buffer.const_channels();
    source.transfer = named_member(transfers, name.c_str(), kTransfers).value_or(Transfer::kLinear);
  }
}

void add_targets(const nb::dict& targets, const nb::dict& transfers, MapSize& size, PreparedMaps& prepared) {
  for (const auto& [key, value] : targets) {
    const std::string name = text_of(key);
    const Buffer& buffer = prepared.held.emplace_back(value, Buffer::Access::kWrite, name);
    size.hold(buffer, name, prepared.maps);
    if (name == "outside") {
      prepared.maps.mask = buffer.channels().at(0);
      continue;
    }
    TargetParameter& target = prepared.maps.targets[parameter_named(name)];
    target.channels = buffer.channels();
    target.transfer = named_member(transfers, name.c_str(), kTransfers).value_or(Transfer::kLinear);
  }
}

nb::object position(const std::optional<TexelPosition>& texel) {
  return texel ? nb::object(nb::make_tuple(texel->y, texel->x)) : nb::none();
}

nb::dict counts_of(const MapStatistics& statistics) {
  nb::dict counts;
  counts["texels"] = statistics.texel_count;
  counts["out_of_domain"] = statistics.out_of_domain_count;
  counts["nan"] = statistics.nan_count;
  counts["infinite"] = statistics.infinite_count;
  counts["negative"] = statistics.negative_count;
  counts["above_one"] = statistics.above_one_count;
  counts["clipped"] = statistics.clipped_count;
  counts["first_bad"] = position(statistics.first_bad);
  return counts;
}

std::vector<std::string> names_of_parameters(const std::vector<Parameter>& parameters) {
  std::vector<std::string> names;
  for (const Parameter parameter : parameters) names.push_back(plain_name(parameter));
  return names;
}

ConversionRequest request_of(const Request& request) {
  ConversionRequest asked;
  asked.source = model_named(member<std::string>(request, "source").value_or(""));
  asked.target = model_named(member<std::string>(request, "target").value_or(""));
  if (asked.source.empty() || asked.target.empty())
    throw usage_error(std::string(asked.source.empty() ? "source" : "target") + " is required");
  asked.via = member<std::vector<std::string>>(request, "via").value_or(std::vector<std::string>{});
  asked.dielectric_f0 = member<double>(request, "dielectric_f0");
  asked.prior = member<double>(request, "metallic_bias").value_or(kCleanPrior);
  asked.words.all_names = "texremap.models()";
  return asked;
}

InstructionSet instructions_of(const Request& request) {
  const auto name = member<std::string>(request, "instructions");
  return name ? instruction_set_from_name("instructions", *name) : best_instruction_set();
}

}  // namespace

MaterialConversion::MaterialConversion(const Request& request) {
  const ConversionRequest asked = request_of(request);
  const InstructionSet set = instructions_of(request);
  const auto file = member<std::string>(request, "converters");
  if (file) read_ = std::make_shared<const ConverterList>(read_converters(*file, set));
  const ConverterGraph graph = read_ ? graph_of(*read_) : shipped_graph(set);
  built_ = std::make_shared<const BuiltConversion>(
      build_conversion(choose_conversion(asked, graph), asked.via, graph, set));
}

MaterialConversion MaterialConversion::load(const std::string& path,
                                            const std::optional<std::string>& source_workflow) {
  const FittedConverter fit = load_fitted_converter(path);
  MaterialConversion conversion;
  BuiltConversion built;
  if (const auto* data = std::get_if<ConverterData>(&fit)) {
    built.choice.source_brdf = data->info.source.model;
    built.choice.target_brdf = data->info.target.model;
    ConverterList list;
    list.push_back(make_converter(*data));
    conversion.read_ = std::make_shared<const ConverterList>(std::move(list));
    built = build_conversion(std::move(built.choice), {}, graph_of(*conversion.read_));
  } else if (const auto* warp = std::get_if<WarpMapFit>(&fit)) {
    const WorkflowKind source =
        source_workflow == "metallic" ? WorkflowKind::kMetallic : WorkflowKind::kSpecular;
    built.choice = choice_of_warp(*warp, source, RoughnessEncoding::kRoughness);
    built.material = make_warp_converter(*warp, *built.choice.source, best_instruction_set());
  } else {
    throw input_error(path +
                      ": converts between workflows, which need no fit (give their names as source "
                      "and target)");
  }
  conversion.built_ = std::make_shared<const BuiltConversion>(std::move(built));
  return conversion;
}

nb::dict MaterialConversion::convert(const nb::dict& sources, const nb::dict& targets,
                                     const nb::dict& options) const {
  PreparedMaps prepared;
  MapConversion& maps = prepared.maps;
  MapSize size;
  const auto transfers = [&](const char* name) {
    return options.contains(name) ? nb::cast<nb::dict>(options[name]) : nb::dict();
  };
  add_sources(sources, transfers("source_transfers"), size, prepared);
  add_targets(targets, transfers("target_transfers"), size, prepared);
  maps.source_convention = named_member(options, "roughness_encoding", kRoughnessEncodings);
  maps.target_convention = named_member(options, "output_encoding", kRoughnessEncodings);
  maps.bad_texels = named_member(options, "bad_texels", kBadTexels).value_or(BadTexels::kKeep);
  maps.dither = member<bool>(options, "dither").value_or(false);
  prepared.threads = member<int>(options, "threads").value_or(1);
  MapStatistics statistics;
  {
    const nb::gil_scoped_release released;
    statistics = convert_maps(built_->converter(), maps, prepared.threads);
  }
  return counts_of(statistics);
}

std::size_t MaterialConversion::target_channels(const std::string& parameter,
                                                std::size_t specular_channels) const {
  return built_->converter().target_channels(parameter_named(parameter), specular_channels);
}

nb::dict MaterialConversion::describe() const {
  const Converter& converter = built_->converter();
  const ConverterInfo &info = converter.info(), &domain = built_->domain();
  const ConversionChoice& choice = built_->choice;
  const auto range = [](const Range& covered) { return nb::make_tuple(covered.min, covered.max); };
  nb::dict text;
  text["id"] = info.id;
  text["source"] = choice.is_material() ? model_of(*choice.source) : info.source.model;
  text["target"] = choice.is_material() ? model_of(*choice.target) : info.target.model;
  text["source_brdf"] = choice.source_brdf;
  text["target_brdf"] = choice.target_brdf;
  text["is_material"] = choice.is_material();
  text["sources"] = names_of_parameters(converter.sources());
  text["targets"] = names_of_parameters(converter.targets());
  text["roughness_encoding"] = std::string(encoding_name(built_->source_width()));
  text["output_encoding"] = std::string(encoding_name(built_->target_width()));
  text["roughness_domain"] = range(domain.roughness);
  text["specular_domain"] = range(domain.specular);
  text["models"] = built_->path.steps.empty() ? std::vector<std::string>{} : path_models(built_->path);
  std::vector<std::string> steps;
  for (const Converter* step : built_->path.steps) steps.push_back(step->info().id);
  text["steps"] = steps;
  text["expected_error"] = built_->path.expected_error;
  const auto difference = picture_difference(built_->path);
  text["picture_difference"] = difference ? nb::object(nb::cast(difference->converted)) : nb::none();
  text["closer"] = built_->closer ? nb::object(nb::cast(target_model(*built_->closer))) : nb::none();
  text["notes"] = choice.notes;
  text["assumptions"] = choice.assumptions;
  text["instructions"] = std::string(instruction_set_name(info.instructions));
  return text;
}

}  // namespace remap::python
