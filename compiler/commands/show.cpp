// This file is `remapc show`, which prints one fit.
#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>

#include "build/fit_folder.hpp"
#include "command_line/run_app.hpp"
#include "commands/candidate_table.hpp"
#include "commands/commands.hpp"
#include "commands/option_readers.hpp"
#include "core/number_text.hpp"
#include "lower/chain.hpp"
#include "lower/fit_file.hpp"
#include "lower/interpreter.hpp"
#include "remap/error.hpp"
#include "table/regression.hpp"
#include "table/table.hpp"

namespace remap {
namespace {

struct ShowOptions {
  std::filesystem::path fit_folder;
  std::string fit;
  bool json = false;
};

std::string figures_text(const ErrorFigures& f, const std::string& p99 = "99 %") {
  return "rms " + error_text(f.rms) + ", " + p99 + " " + error_text(f.p99) + ", max " + error_text(f.max);
}

void print_entries(const std::map<std::string, std::string>& entries) {
  for (const auto& [key, value] : entries) std::cout << "  " << key << ": " << value << "\n";
}

void print_remarks(const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) std::cout << "  " << remark << "\n";
}

// Returns ` + c` or ` - c`, or the number itself at the start of a sum.
std::string summand(double coefficient, bool first) {
  if (first) return number_text(coefficient);
  return (coefficient < 0.0 ? " - " : " + ") + number_text(std::fabs(coefficient));
}

std::string specular_power(std::size_t power) {
  if (power == 0) return "";
  return power == 1 ? " s" : " s^" + std::to_string(power);
}

std::string curve_text(const AlphaCurve& curve) {
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

std::string decimal_text(float value) { return number_text(decimal_value(value)); }

std::string factor_text(const FactorTerms& factor) {
  std::string text;
  for (std::size_t j = 0; j < factor.size(); ++j)
    for (std::size_t i = 0; i < factor[j].size(); ++i) {
      const std::string power = (j == 0   ? ""
                                 : j == 1 ? " t"
                                          : " t^" + std::to_string(j)) +
                                (i == 0   ? ""
                                 : i == 1 ? " alpha1"
                                          : " alpha1^" + std::to_string(i));
      text += (text.empty() ? "" : " + ") + decimal_text(factor[j][i]) + power;
    }
  return text;
}

void print_output(const std::string& output, const KernelExpansion& expansion) {
  std::cout << "  " << output << ": " << expansion.count() << " Gaussians of "
            << inputs_text(expansion.inputs.size()) << ", gamma " << number_text(expansion.gamma) << "\n";
}

void print_output(const std::string& output, const Network& network) {
  std::cout << "  " << output << ": a network of " << inputs_text(network.inputs.size()) << ", layers";
  for (const Layer& layer : network.layers) std::cout << " " << layer.output_count();
  std::cout << ", " << activation_name(network.activation) << "\n";
}

// Each print_mapping() prints a mapping as formulas of a = alpha1 and s = specular1.
void print_mapping(const Parametric& form) {
  for (std::size_t j = 0; j < form.alpha.size(); ++j) {
    std::cout << (j == 0 ? "  alpha2 = (" : "\n         + (");
    for (std::size_t i = 0; i < form.alpha[j].size(); ++i)
      std::cout << summand(form.alpha[j][i], i == 0) << " a" << (i == 0 ? "" : "^" + std::to_string(i + 1));
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
void print_mapping(const Svr& svr) {
  print_output("alpha2", svr.alpha);
  print_output("specular2", svr.specular);
}
void print_mapping(const Mlp& mlp) {
  print_output("alpha2", mlp.alpha);
  print_output("specular2", mlp.specular);
}
void print_mapping(const CompactForm& form) {
  std::cout << "  t = specular1 / (specular1 + " << decimal_text(form.pole) << ")\n  alpha2 = alpha1 ("
            << factor_text(form.alpha) << ")\n  specular2 = specular1 (" << factor_text(form.specular)
            << ")\n";
  if (form.specular_limit)
    std::cout << "  above specular2 " << decimal_text(*form.specular_limit) << ", alpha2 changes by alpha1 ("
              << decimal_text(form.hinge.turn) << " + " << decimal_text(form.hinge.turn_by_alpha)
              << " alpha1) x / (1 + " << decimal_text(form.hinge.bend)
              << " x), where x is the fraction that is cut off\n";
  if (form.alpha_limit)
    std::cout << "  above alpha2 " << decimal_text(*form.alpha_limit) << ", specular2 changes by "
              << decimal_text(form.hinge.spread) << " times the fraction that is cut off\n";
}

std::string percent_text(double share) { return number_text(rounded_up(100.0 * share, 2)) + " %"; }

// Returns four fractions of the domain: where the target is at no limit, at the limit of alpha, at the limit
// of specular, and at both.
std::array<double, 4> limit_shares(const Fit& fit) {
  constexpr int kSteps = 100;
  constexpr double kAtLimit = 1.0 - 1e-9;
  std::array<double, 4> shares{};
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const auto middle = [](const Range& range, int step) {
        return range.min + (range.max - range.min) * (step + 0.5) / kSteps;
      };
      const MappedTexel texel =
          evaluate_fit(fit, middle(fit.domain.alpha, i), middle(fit.domain.specular, j));
      const bool is_wide = texel.alpha >= fit.limits.alpha * kAtLimit,
                 is_bright = fit.limits.specular && texel.specular >= *fit.limits.specular * kAtLimit;
      shares[(is_wide ? 1 : 0) + (is_bright ? 2 : 0)] += 1.0 / (kSteps * kSteps);
    }
  return shares;
}

void print_limits(const Fit& fit) {
  const std::array<double, 4> shares = limit_shares(fit);
  if (shares[0] > 1.0 - 1e-9) return;
  std::cout << "At the limits of " << fit.target.model << ", in fractions of the domain\n  neither "
            << percent_text(shares[0]) << "\n  alpha " << number_text(fit.limits.alpha) << ": "
            << percent_text(shares[1]);
  if (fit.limits.specular)
    std::cout << "\n  " << fit.target.specular << " " << number_text(*fit.limits.specular) << ": "
              << percent_text(shares[2]);
  std::cout << "\n  both " << percent_text(shares[3]) << "\n";
}

void print_method(const Fit& fit) {
  if (!fit.method.empty()) std::cout << "Method\n";
  print_entries(fit.method);
  if (!fit.candidates.empty())
    std::cout << "Compared with\n" << candidate_text(fit.candidates, fit.target.specular);
}

std::string rows_text(const Fit& fit) {
  if (fit.split.held_out_rows == 0) return "its steps (errors propagated)";
  return "its table: " + std::to_string(fit.split.held_out_rows) + " rows held out (" +
         std::to_string(fit.split.trained_rows) + " trained, seed " + std::to_string(fit.split.seed) + ")";
}

void print_lowering(const Fit& fit) {
  if (!fit.converter) {
    std::cout << "No header, because the fit could not be lowered (use remapc fit --lower with a larger "
                 "tolerance)\n";
    return;
  }
  std::cout << "Deviation of its header from the fit: alpha within " << error_text(fit.converter->alpha_bound)
            << ", " << fit.target.specular << " within " << error_text(fit.converter->specular_bound)
            << " (proven)\n";
}

// If `folder` has the inverse converter, prints the error of the round trip through it.
void print_round_trip(const Fit& fit, const std::filesystem::path& folder) {
  const auto path = folder / (converter_id(fit.target.model, fit.source.model) + ".json");
  if (!std::filesystem::is_regular_file(path)) return;
  const Fit back = load_fit(path);
  const RoundTrip trip = round_trip(fit, back);
  std::cout << "Round trip through " << back.id << "\n";
  if (trip.share == 0.0) {
    std::cout << "  the domains do not overlap\n";
    return;
  }
  const auto print = [](const std::string& name, double median, double p99) {
    std::cout << "  " << std::left << std::setw(8) << name << "changes by " << percent_text(median)
              << " (median), 99 % within " << percent_text(p99) << "\n";
  };
  print("alpha", trip.alpha_median, trip.alpha_p99);
  print(fit.source.specular, trip.specular_median, trip.specular_p99);
  if (!returns(trip))
    std::cout << "  (!) does not return to the start: the models differ, so each direction has its own best "
                 "match\n";
}

// Prints the three sources of error: between the models, between fit and table, and between header and fit.
void print_trust(const Fit& fit) {
  if (fit.image_error) {
    std::cout << "Difference of the models at the best match\n  picture " << figures_text(*fit.image_error)
              << ", relative to the source picture\n";
    for (const auto& [alpha, ssim] : fit.ssim)
      std::cout << "  sphere  SSIM " << std::fixed << std::setprecision(3) << ssim << " at alpha "
                << std::defaultfloat << number_text(alpha) << "\n";
  } else {
    std::cout << "Difference of the models: unknown (not validated by rendering)\n";
  }
  if (fit.pictures)
    std::cout << "Pictures, with materials and lights that the fit did not use\n  RMSE of display values "
              << fixed(fit.pictures->rmse, 2) << " % (numbers copied " << fixed(fit.copied_pictures->rmse, 2)
              << " %), under one light " << fixed(100.0 * fit.pictures->relative, 0)
              << " % of the picture (copied " << fixed(100.0 * fit.copied_pictures->relative, 0) << " %)\n";
  if (!fit.has_errors()) {
    std::cout << "Deviation of the fit from its table: unknown (no rows held out)\n";
  } else {
    std::cout << "Deviation of the fit from " << rows_text(fit) << "\n  alpha    "
              << figures_text(fit.alpha_error) << "\n  " << std::left << std::setw(9) << fit.target.specular
              << figures_text(fit.specular_error) << "\n";
  }
  print_lowering(fit);
}

void show_card(const Fit& fit, const ShowOptions& options) {
  std::cout << fit.id << "\n"
            << "  from    " << side_text(fit.source) << "\n"
            << "  to      " << side_text(fit.target) << "\n"
            << "  covers  alpha " << range_text(fit.domain.alpha) << ", " << fit.source.specular << " "
            << range_text(fit.domain.specular) << "\n"
            << "  kind    " << kind_name(fit.mapping) << ", by remapc " << fit.tool_version << "\n";
  print_remarks(fit.remarks);
  print_trust(fit);
  print_round_trip(fit, options.fit_folder);
  std::cout << "Mapping\n";
  std::visit([](const auto& kind) { print_mapping(kind); }, fit.mapping);
  print_limits(fit);
  print_method(fit);
  std::cout << (fit.table.name.empty() ? "No table" : "Table " + fit.table.name) << "\n";
  if (!fit.table.sha256.empty()) std::cout << "  sha256 " << fit.table.sha256 << "\n";
  print_entries(fit.table.comments);
}

void print_parameters(const std::string& title, const std::vector<MaterialParameter>& parameters) {
  std::cout << title << "\n";
  for (const MaterialParameter& parameter : parameters)
    std::cout << "  " << std::left << std::setw(11) << parameter.name
              << (parameter.channel_count == 3 ? "RGB, " : "") << parameter.meaning << ", 0 to 1\n";
}

void print_training(const NetworkTraining& training) {
  std::cout << "Errors on " << training.split.held_out_rows << " rows held out of training (seed "
            << training.split.seed << ")\n  base color  " << figures_text(training.base_color, "p99")
            << "\n  metallic     " << figures_text(training.metallic, "p99") << "\nTraining\n";
  print_entries(training.method);
  std::cout << "Table " << training.table.name << ", sha256 " << training.table.sha256 << "\n";
  print_entries(training.table.comments);
}

void show_card(const WorkflowFit& fit, const ShowOptions&) {
  const WorkflowConversion& conversion = fit.conversion;
  std::cout << fit.id << "\n"
            << "  from    " << conversion.source_model() << "\n"
            << "  to      " << conversion.target_model() << "\n"
            << "  kind    " << material_kind(fit) << ", by remapc " << fit.tool_version << "\n"
            << "  F0 of a dielectric " << number_text(conversion.metallic.dielectric_f0) << "; diffuse "
            << diffuse_convention_name(conversion.specular.diffuse) << " in the specular workflow, "
            << diffuse_convention_name(conversion.metallic.diffuse) << " in the metallic one\n";
  print_remarks(fit.remarks);
  print_parameters("Takes", source_parameters(conversion));
  print_parameters("Gives", target_parameters(conversion));
  std::cout << "Mapping\n  " << formula_text(conversion.formula) << "\n";
  if (fit.training) print_training(*fit.training);
}

void show_card(const WarpMapFit& fit, const ShowOptions&) {
  const ParameterTable& table = fit.warp.table;
  std::cout << fit.id << "\n  from    " << fit.source_model << "\n  to      " << fit.template_model
            << "\n  kind    " << kWarpKind << ", by remapc " << fit.tool_version << "\n";
  print_remarks(fit.remarks);
  const bool quadratic = std::holds_alternative<QuadraticTerms>(fit.warp.coordinates.terms),
             copied = std::holds_alternative<CopiedNodes>(table.entries);
  std::cout << "Mapping\n  " << fit.warp.coordinates.dimension << " appearance coordinates, "
            << (quadratic ? "quadratic" : "in closed form") << "; " << table.nodes << " nodes each, "
            << (copied ? "exact" : "blended") << "; " << byte_count(fit.warp) << " bytes\n";
  if (fit.copy_rms_error >= 0.0)
    std::cout << "  " << percent(fit.copy_rms_error)
              << " of the template's spread: difference to an exact copy (RMS)\n";
  std::cout << "Method\n";
  print_entries(fit.method);
}

void warn_of_light(const Fit& fit) {
  const Comments comments(fit.table.comments.begin(), fit.table.comments.end());
  if (const std::string remark = light_remark(light_match(comments)); !remark.empty())
    print_message("remapc", "warning: " + fit.id + ": " + remark);
}
void warn_of_light(const WorkflowFit&) {}
void warn_of_light(const WarpMapFit&) {}

void show(const ShowOptions& options) {
  const AnyFit fit = find_any_fit(options.fit, options.fit_folder);
  std::visit(
      [&](const auto& any) {
        if (options.json)
          std::cout << fit_to_json(any);
        else
          show_card(any, options);
        warn_of_light(any);
      },
      fit);
}

}  // namespace

void add_show_command(Command& app) {
  Command* command =
      app.add_subcommand("show", "Show a fit: models, domain, errors, mapping and its table", kLookStage);
  ShowOptions& options = set_work<ShowOptions>(*command, show);
  command->add_option("fit", options.fit, "Fit: file, or id in the folder of fits")->required();
  command->option_group("Input");
  add_fits_option(*command, options.fit_folder, "Folder where ids are looked up");
  command->option_group("Output");
  command->add_flag("--json", options.json, "Print the fit file itself");
  command->footer("Example:\n  remapc show mitsuba_ward_to_mitsuba_as");
}

}  // namespace remap
