// `remapc list` and `remapc show`: what there is, and the card of one fit.
#include <iomanip>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "commands/fit_folder.hpp"
#include "model/fit_json.hpp"
#include "number_text.hpp"
#include "sweep/renderer.hpp"

namespace remapc {
namespace {

using remap::number_text;

struct ListOptions {
  std::filesystem::path fit_folder = "fits";
  std::string fit;  // of show
  bool models = false, json = false;
};

std::string digits(double value) { return number_text(remap::rounded_up(value, 2)); }

std::string range_text(const remap::Range& range) {
  return number_text(range.min) + " to " + number_text(range.max);
}

void list_models(bool json) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ModelDescription& model : make_builtin_renderer()->models()) {
    nlohmann::ordered_json parameters;
    std::string text;
    for (const ParameterDescription& parameter : model.parameters) {
      parameters[parameter.name] = {parameter.range.min, parameter.range.max};
      text += "  " + parameter.name + " " + range_text(parameter.range);
    }
    list.push_back({{"model", model.name},
                    {"roughness", remap::convention_name(model.roughness)},
                    {"parameters", parameters}});
    if (!json) std::cout << std::left << std::setw(26) << model.name << text << "\n";
  }
  if (json) std::cout << list.dump(2) << "\n";
}

void list_fits(const ListOptions& options) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const remap::Fit& fit : load_fits(options.fit_folder)) {
    list.push_back({{"id", fit.id},
                    {"source", fit.source.model},
                    {"target", fit.target.model},
                    {"kind", kind_name(fit.mapping)},
                    {"alpha_rms_error", fit.roughness_error.rms},
                    {"specular_rms_error", fit.specular_error.rms}});
    if (!options.json)
      std::cout << std::left << std::setw(40) << fit.id << " " << kind_name(fit.mapping) << "  alpha rms "
                << digits(fit.roughness_error.rms) << "  " << fit.target.specular << " rms "
                << digits(fit.specular_error.rms) << "\n";
  }
  if (options.json) std::cout << list.dump(2) << "\n";
}

std::string side_text(const remap::ModelSide& side) {
  return side.model + " (" + std::string(remap::convention_name(side.roughness)) + ", " + side.specular + ")";
}

std::string figures_text(const remap::ErrorFigures& f) {
  return "rms " + digits(f.rms) + ", 99 % " + digits(f.p99) + ", max " + digits(f.max);
}

struct PrintMapping {
  void operator()(const remap::Parametric& form) const {
    const auto& r = form.roughness;
    std::cout << "  alpha2 = " << r[0] << " a + " << r[1] << " a^2 + " << r[2] << " a^3 + " << r[3]
              << " a^4\n"
              << "  specular2 = specular1 (" << form.start << " + " << form.ramp << " phi(" << form.ramp_rate
              << ", a) + " << form.bump << " phi(" << form.bump_rate
              << ", a^2)),  phi(c, x) = (1 - exp(-c x)) / c\n";
  }
};

void show(const ListOptions& options) {
  const remap::Fit fit = find_fit(options.fit, options.fit_folder);
  if (options.json) {
    std::cout << fit_to_json(fit);
    return;
  }
  std::cout << fit.id << "\n"
            << "  from    " << side_text(fit.source) << "\n"
            << "  to      " << side_text(fit.target) << "\n"
            << "  covers  alpha " << range_text(fit.domain.alpha) << ", " << fit.source.specular << " "
            << range_text(fit.domain.specular) << "\n"
            << "  kind    " << kind_name(fit.mapping) << ", by remapc " << fit.tool_version << "\n"
            << "Error on " << fit.split.held_out_rows << " rows held out (" << fit.split.trained_rows
            << " trained, seed " << fit.split.seed << ")\n"
            << "  alpha   " << figures_text(fit.roughness_error) << "\n"
            << "  " << std::left << std::setw(8) << fit.target.specular << figures_text(fit.specular_error)
            << "\n"
            << "Mapping\n";
  std::visit(PrintMapping{}, fit.mapping);
  std::cout << "Table " << fit.table.name << "\n  sha256 " << fit.table.sha256 << "\n";
  for (const auto& [key, value] : fit.table.comments) std::cout << "  " << key << ": " << value << "\n";
}

}  // namespace

void add_list_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("list", "List the fits of a folder, or the models that can be swept");
  auto options = std::make_shared<ListOptions>();
  command->add_flag("--models", options->models, "Models of the built-in renderer, with their parameters");
  command->add_option("--fits", options->fit_folder, "Folder of fits")->capture_default_str();
  command->add_flag("--json", options->json, "As JSON on standard output");
  command->footer("Example:\n  remapc list --models");
  command->callback([options] { options->models ? list_models(options->json) : list_fits(*options); });
}

void add_show_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("show", "Show the card of a fit: models, domain, errors, mapping, table");
  auto options = std::make_shared<ListOptions>();
  command->add_option("fit", options->fit, "Fit: file, or id in the folder of fits")->required();
  command->add_option("--fits", options->fit_folder, "Folder of fits")->capture_default_str();
  command->add_flag("--json", options->json, "The fit file itself");
  command->footer("Example:\n  remapc show mitsuba_ward_to_mitsuba_as");
  command->callback([options] { show(*options); });
}

}  // namespace remapc
