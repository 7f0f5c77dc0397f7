// `remap-study exponents`: ranks the rules by which programs turn exponents into roughness.
#include <cmath>
#include <iostream>

#include "build/fit_folder.hpp"
#include "command_line/interruption.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "core/report_text.hpp"
#include "lower/short_form.hpp"
#include "report/gnuplot.hpp"
#include "study/exponent_ranking.hpp"
#include "study/light_halves.hpp"
#include "study/studies.hpp"
#include "study/study_options.hpp"

namespace remap {
namespace {

struct ExponentsCommand {
  std::vector<std::filesystem::path> environments;
  std::filesystem::path fit_folder;
  OutputOptions output;
  ShortFormsOptions study;
};

constexpr int kSheetResolution = 128;

std::string ranking_text(const LobeRanking& ranking) {
  std::string text = "\n" + ranking.lobe +
                     " to mitsuba/ggx: RMSE % (environments), SSIM, error (light); RMSE from n = 1, 10, 100, "
                     "1000; OpenGL materials\n";
  for (const RankedRule& rule : ranking.rules) {
    text += "  " + padded(rule.name, 26) + fixed(rule.all.rmse, 2) + "  " + fixed(rule.all.ssim, 3) + "  " +
            fixed(rule.all.relative, 3) + "  |";
    for (const double rmse : rule.rmse) text += " " + fixed(rmse, 1);
    text += " |" + (std::isnan(rule.opengl) ? std::string(" -") : " " + fixed(rule.opengl, 1)) + "  " +
            rule.formula + "\n";
  }
  return text;
}

std::string ranking_csv(const std::vector<LobeRanking>& rankings) {
  std::string text =
      "lobe,rule,formula,rmse,ssim,relative,rmse_1,rmse_10,rmse_100,rmse_1000,relative_1,relative_10,"
      "relative_100,relative_1000,rmse_opengl\n";
  for (const LobeRanking& ranking : rankings)
    for (const RankedRule& rule : ranking.rules) {
      text += ranking.lobe + ",\"" + rule.name + "\",\"" + rule.formula + "\"";
      std::vector<double> numbers = {rule.all.rmse, rule.all.ssim, rule.all.relative};
      numbers.insert(numbers.end(), rule.rmse.begin(), rule.rmse.end());
      numbers.insert(numbers.end(), rule.relative.begin(), rule.relative.end());
      for (const double number : numbers) text += "," + number_text(rounded(number, 4));
      text += "," + (std::isnan(rule.opengl) ? "" : number_text(rounded(rule.opengl, 4))) + "\n";
    }
  return text;
}

// A curve a rule for the lobe of MTL files, over the decades of the exponent.
std::string ranking_plot(const LobeRanking& ranking) {
  std::string blocks, curves;
  for (std::size_t r = 0; r < ranking.rules.size(); ++r) {
    const RankedRule& rule = ranking.rules[r];
    const std::string block = "$rule" + std::to_string(r);
    blocks += block + " << EOD\n";
    for (std::size_t d = 0; d < kDecades; ++d)
      blocks += std::to_string(d) + " " + number_text(rule.rmse[d]) + "\n";
    blocks += "EOD\n";
    const bool is_own = rule.name.starts_with("short form") || rule.name.starts_with("converter"),
               is_best = rule.name.starts_with("best possible");
    const std::string color = is_best  ? "black"
                              : is_own ? kPlotColors[r % 2 == 0 ? 0 : 2]
                                       : kPlotColors[1 + r % (kPlotColors.size() - 1)];
    curves += (curves.empty() ? "plot " : ", ") + block + " using 1:2 with linespoints linewidth " +
              (is_own || is_best ? "3" : "1") + " pointtype " + std::to_string(1 + r % 12) +
              " linecolor rgb '" + color + "' title " + gnuplot_text(rule.name) + " noenhanced";
  }
  return blocks + plot_style(1200, 640) + "set title " +
         gnuplot_text(ranking.lobe + " as GGX: RMSE, % of the display range (lower is better)") +
         " noenhanced\n"
         "set xlabel 'exponent'\nset xrange [-0.1:3.1]\nset yrange [0:*]\nset key outside right\n"
         "set xtics ('1 to 10' 0, '10 to 100' 1, '100 to 1000' 2, 'above' 3)\n" +
         curves + "\n";
}

Json ranking_json(const std::vector<LobeRanking>& rankings) {
  Json lobes = Json::object();
  for (const LobeRanking& ranking : rankings) {
    Json rules = Json::list();
    for (const RankedRule& rule : ranking.rules)
      rules.push_back({{"rule", rule.name},
                       {"formula", rule.formula},
                       {"rmse", rounded(rule.all.rmse, 4)},
                       {"ssim", rounded(rule.all.ssim, 4)},
                       {"relative", rounded(rule.all.relative, 4)},
                       {"rmse_by_decade", rule.rmse},
                       {"relative_by_decade", rule.relative},
                       {"rmse_opengl", std::isnan(rule.opengl) ? Json() : Json(rule.opengl)}});
    lobes[ranking.lobe] = rules;
  }
  return lobes;
}

void run(const ExponentsCommand& command) {
  ShortFormsOptions options = command.study;
  set_light_halves(command.environments, options);
  require_folder_for_pictures(command.output);
  prepare_folder(command.output, "exponents");
  const std::filesystem::path folder = fit_folder_of(command.fit_folder), file = folder / kShortFormsName;
  const std::vector<ShortForm> forms = short_forms_of(read_file(file), file.string());
  options.fits = load_fits(folder);
  watch_interruptions();
  options.cancelled = &interruption();
  const std::vector<LobeRanking> rankings = rank_exponent_rules(options, forms);
  StudyReport report{"", ranking_json(rankings), {{"exponents.csv", ranking_csv(rankings)}}, {}, {}};
  for (const LobeRanking& ranking : rankings) {
    report.summary += ranking_text(ranking);
    if (ranking.lobe == "legacy/blinn-phong") report.plots = {{"exponents.svg", ranking_plot(ranking)}};
  }
  SphereSampling sampling = options;
  sampling.resolution = kSheetResolution;
  if (command.output.pictures)
    for (const ShortForm& form : forms)
      if (form.source == "legacy/blinn-phong")
        report.sheets.emplace_back("spheres_exponents.png",
                                   exponent_sheet(options.judging.back(), sampling, form));
  show_report(command.output, report);
}

}  // namespace

void add_exponents_study(Command& study) {
  Command* command = study.add_subcommand(
      "exponents",
      "Rank the rules by which programs turn exponents of Phong and Blinn lobes into roughness, by pictures");
  ExponentsCommand& options = set_work<ExponentsCommand>(*command, run);
  options.study.resolution = 32;
  options.study.samples = 512;
  add_light_halves_option(*command, options.environments);
  add_sampling_options(*command, options.study);
  command->add_option("--fits", options.fit_folder, "Folder of fits, with the short forms");
  add_output_options(
      *command, options.output, options.study.jobs,
      {"Write exponents.csv and exponents.svg (needs gnuplot) to this folder",
       "Also write spheres_exponents.png: four materials of OpenGL by the source and seven rules",
       "Results do not depend on it", "Print the ranking as JSON"});
  command->footer("Example:\n  remap-study exponents -o study --pictures");
}

}  // namespace remap
