// `remapc list` and `remapc show`: what there is, and the card of one fit.
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "commands/candidate_table.hpp"
#include "commands/commands.hpp"
#include "commands/fit_folder.hpp"
#include "fit/split.hpp"
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
  const std::vector<remap::Fit> fits = load_fits(options.fit_folder);
  if (fits.empty()) std::cerr << options.fit_folder.string() << ": holds no fits (*.json)\n";
  for (const remap::Fit& fit : fits) {
    list.push_back({{"id", fit.id},
                    {"source", fit.source.model},
                    {"target", fit.target.model},
                    {"kind", kind_name(fit.mapping)},
                    {"alpha_rms_error", fit.roughness_error.rms},
                    {"specular_rms_error", fit.specular_error.rms}});
    if (!options.json)
      std::cout << std::left << std::setw(40) << fit.id << " " << std::setw(11) << kind_name(fit.mapping)
                << errors_text(fit, "held out") << "\n";
  }
  if (options.json) std::cout << list.dump(2) << "\n";
}

std::string side_text(const remap::ModelSide& side) {
  return side.model + " (" + std::string(remap::convention_name(side.roughness)) + ", " + side.specular + ")";
}

std::string figures_text(const remap::ErrorFigures& f) {
  return "rms " + error_text(f.rms) + ", 99 % " + error_text(f.p99) + ", max " + error_text(f.max);
}

// ` + c` or ` - c`, or the number itself at the front of a sum.
std::string summand(double coefficient, bool first) {
  if (first) return number_text(coefficient);
  return (coefficient < 0.0 ? " - " : " + ") + number_text(std::fabs(coefficient));
}

std::string specular_power(std::size_t power) {
  if (power == 0) return "";
  return power == 1 ? " s" : " s^" + std::to_string(power);
}

std::string curve_text(const remap::AlphaCurve& curve) {
  std::string text = curve.start == 0.0 ? "" : summand(curve.start, true);
  const auto add = [&](double coefficient, const std::string& function) {
    if (coefficient != 0.0) text += summand(coefficient, text.empty()) + " " + function;
  };
  add(curve.ramp, "phi(" + number_text(curve.ramp_rate) + ", a)");
  add(curve.bump, "phi(" + number_text(curve.bump_rate) + ", a^2)");
  add(curve.pole, "/ a");
  return text.empty() ? "0" : text;
}

std::string inputs_text(std::size_t count) { return count == 1 ? "alpha" : "alpha and specular"; }

// How a mapping is read, with a = alpha1, s = specular1.
struct PrintMapping {
  void operator()(const remap::Parametric& form) const {
    for (std::size_t j = 0; j < form.roughness.size(); ++j) {
      std::cout << (j == 0 ? "  alpha2 = (" : "\n         + (");
      for (std::size_t i = 0; i < form.roughness[j].size(); ++i)
        std::cout << summand(form.roughness[j][i], i == 0) << " a"
                  << (i == 0 ? "" : "^" + std::to_string(i + 1));
      std::cout << ")" << specular_power(j);
    }
    std::cout << "\n";
    for (std::size_t t = 0; t < form.specular.size(); ++t) {
      const auto& [power, factor] = form.specular[t];
      std::cout << (t == 0 ? "  specular2 = (" : "            + (") << curve_text(factor) << ")"
                << specular_power(static_cast<std::size_t>(power)) << "\n";
    }
    std::cout << "  phi(c, x) = (1 - exp(-c x)) / c\n";
  }
  void operator()(const remap::Svr& svr) const {
    print("alpha2", svr.alpha);
    print("specular2", svr.specular);
  }
  void operator()(const remap::Mlp& mlp) const {
    print("alpha2", mlp.alpha);
    print("specular2", mlp.specular);
  }

 private:
  static void print(const std::string& output, const remap::KernelExpansion& expansion) {
    std::cout << "  " << output << ": " << expansion.count() << " Gaussians of "
              << inputs_text(expansion.inputs.size()) << ", gamma " << number_text(expansion.gamma) << "\n";
  }
  static void print(const std::string& output, const remap::Network& network) {
    std::cout << "  " << output << ": a network of " << inputs_text(network.inputs.size()) << ", layers";
    for (const remap::Layer& layer : network.layers) std::cout << " " << layer.output_count();
    std::cout << ", " << activation_name(network.activation) << "\n";
  }
};

void print_method(const remap::Fit& fit) {
  if (!fit.method.empty()) std::cout << "Method\n";
  for (const auto& [key, value] : fit.method) std::cout << "  " << key << ": " << value << "\n";
  if (!fit.candidates.empty())
    std::cout << "Compared with\n" << candidate_text(fit.candidates, fit.target.specular);
}

void print_errors(const remap::Fit& fit) {
  if (fit.split.held_out_rows == 0) {
    std::cout << "Errors unknown: no rows were held out\n";
    return;
  }
  std::cout << "Error on " << fit.split.held_out_rows << " rows "
            << (fit.split.trained_rows == 0 ? "(trained elsewhere)"
                                            : "held out (" + std::to_string(fit.split.trained_rows) +
                                                  " trained, seed " + std::to_string(fit.split.seed) + ")")
            << "\n  alpha   " << figures_text(fit.roughness_error) << "\n  " << std::left << std::setw(8)
            << fit.target.specular << figures_text(fit.specular_error) << "\n";
}

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
            << "  kind    " << kind_name(fit.mapping) << ", by remapc " << fit.tool_version << "\n";
  print_errors(fit);
  std::cout << "Mapping\n";
  std::visit(PrintMapping{}, fit.mapping);
  print_method(fit);
  std::cout << "Table " << fit.table.name << "\n";
  if (!fit.table.sha256.empty()) std::cout << "  sha256 " << fit.table.sha256 << "\n";
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
