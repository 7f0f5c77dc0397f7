// `remap-study short`: chooses the constants of short forms and judges them.
#include <algorithm>
#include <iostream>

#include "build/fit_folder.hpp"
#include "command_line/interruption.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "core/report_text.hpp"
#include "remap/error.hpp"
#include "study/light_halves.hpp"
#include "study/short_forms.hpp"
#include "study/studies.hpp"
#include "study/study_options.hpp"

namespace remap {
namespace {

struct ShortCommand {
  std::vector<std::string> pairs;
  std::vector<std::filesystem::path> environments;
  std::filesystem::path fit_folder, output;
  bool compiled_only = false;
  ShortFormsOptions study;
};

std::string line_of(const ShortForm& form) {
  std::string text = form.id + ":";
  for (const double constant : form.constants) text += " " + number_text(constant);
  if (form.kind == ShortKind::kWidths)
    text += " (" + std::string(name_of(kShortStrengths, form.strength)) + ")";
  const auto figures = [](const ShortFigures& all) {
    return fixed(all.rmse, 2) + " " + fixed(all.ssim, 3) + " " + fixed(all.relative, 3);
  };
  text += "\n  RMSE %, SSIM, relative: form " + figures(form.figures) + "; best " + figures(form.best) +
          "; copied " + figures(form.copied);
  if (form.compiled) text += "; compiled " + figures(*form.compiled);
  return text + "\n";
}

void run(const ShortCommand& command) {
  ShortFormsOptions options = command.study;
  set_light_halves(command.environments, options);
  for (const StudyPair& pair : short_pairs())
    if (command.pairs.empty() ||
        std::ranges::find(command.pairs, pair.source + ":" + pair.target) != command.pairs.end())
      options.pairs.push_back(pair);
  if (options.pairs.empty()) throw Error(ErrorKind::kUsage, "--pair: no such pair of short forms");
  if (const auto folder = fit_folder_of(command.fit_folder); !folder.empty())
    options.fits = load_fits(folder);
  watch_interruptions();
  options.cancelled = &interruption();
  std::vector<ShortForm> forms;
  if (!command.output.empty() && std::filesystem::exists(command.output))
    forms = short_forms_of(read_file(command.output), command.output.string());
  if (command.compiled_only) options.known = forms;
  study_short_forms(options, [&](const ShortForm& form) {
    std::cout << line_of(form) << std::flush;
    std::erase_if(forms, [&](const ShortForm& known) { return known.id == form.id; });
    forms.push_back(form);
    std::ranges::sort(forms, {}, &ShortForm::id);
    if (!command.output.empty()) write_file(command.output, short_forms_json(forms));
  });
}

}  // namespace

void add_short_study(Command& study) {
  Command* command = study.add_subcommand(
      "short",
      "Choose the constants of short forms, one line for each parameter, and judge them by other "
      "materials and lights");
  ShortCommand& options = set_work<ShortCommand>(*command, run);
  options.study.resolution = 32;
  options.study.samples = 512;
  command->add_option("--pair", options.pairs, "SOURCE:TARGET, repeatable; default: all")
      ->allow_extra_args(false);
  add_light_halves_option(*command, options.environments);
  add_sampling_options(*command, options.study);
  command->add_option("--fits", options.fit_folder, "Folder of the fits to compare with");
  command->add_option("--jobs", options.study.jobs, "Number of threads; 0: one per core");
  command->add_option("-o,--output", options.output,
                      "JSON file of short forms; forms of other pairs in it stay, each form is written as it "
                      "is finished");
  command->add_flag("--compiled-only", options.compiled_only,
                    "Judge the compiled converters of the forms in the output file; the rest of them stays");
  command->footer(
      "Example:\n  remap-study short --environment forest.exr --environment city.exr \\\n    -o "
      "fits/short/forms.json");
}

}  // namespace remap
