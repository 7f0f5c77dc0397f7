// `texremap list`: the converters that were compiled in, and whether they still compute what they should.
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "convert/converter.hpp"
#include "error.hpp"
#include "number_text.hpp"

namespace remap {
namespace {

using Json = nlohmann::ordered_json;

struct ListOptions {
  bool json = false;
};

Json side_json(const ModelSide& side) {
  return {{"model", side.model},
          {"roughness", std::string(convention_name(side.roughness))},
          {"specular", side.specular}};
}

Json converter_json(const Converter& converter) {
  const ConverterInfo& info = converter.info();
  return {{"id", info.id},
          {"source", side_json(info.source)},
          {"target", side_json(info.target)},
          {"domain",
           {{"roughness", {info.roughness.min, info.roughness.max}},
            {"specular", {info.specular.min, info.specular.max}}}},
          {"rms_error", {{"roughness", info.roughness_rms_error}, {"specular", info.specular_rms_error}}},
          {"instructions", std::string(instruction_set_name(info.instructions))},
          {"self_test", converter.self_test()}};
}

std::string range_text(std::string_view name, const Range& range) {
  return std::string(name) + " " + number_text(range.min) + " to " + number_text(range.max);
}

void print_converter(const Converter& converter) {
  const ConverterInfo& info = converter.info();
  std::cout << info.id << '\n'
            << "  from   " << info.source.model << ", "
            << range_text(convention_name(info.source.roughness), info.roughness) << ", "
            << range_text(info.source.specular, info.specular) << '\n'
            << "  to     " << info.target.model << ", " << convention_name(info.target.roughness) << " and "
            << info.target.specular << '\n'
            << "  error  rms " << number_text(info.roughness_rms_error) << " in alpha, "
            << number_text(info.specular_rms_error) << " in " << info.target.specular << '\n'
            << "  test   " << (converter.self_test() ? "passed" : "FAILED") << " with "
            << instruction_set_name(info.instructions) << " instructions\n";
}

void list(const ListOptions& options) {
  Json all = Json::array();
  std::string failed;
  for (const auto& converter : compiled_converters()) {
    if (options.json)
      all.push_back(converter_json(*converter));
    else
      print_converter(*converter);
    if (!converter->self_test()) failed += (failed.empty() ? "" : ", ") + converter->info().id;
  }
  if (options.json) std::cout << all.dump(2) << '\n';
  if (!failed.empty())
    throw Error(ErrorKind::kNumeric, failed + ": fails its self-test; expected the values it was made with");
}

}  // namespace

void add_list_command(CLI::App& app) {
  auto options = std::make_shared<ListOptions>();
  CLI::App* command = app.add_subcommand("list", "List the converters that are compiled in");
  command->add_flag("--json", options->json, "Machine-readable result on standard output");
  command->footer("Example:\n  texremap list --json");
  command->callback([options] { list(*options); });
}

}  // namespace remap
