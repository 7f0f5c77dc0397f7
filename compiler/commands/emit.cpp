// `remapc emit` writes the headers of fits, or checks that committed headers are current.
#include "emit/emit.hpp"

#include <algorithm>
#include <iostream>

#include "build/fit_folder.hpp"
#include "command_line/command.hpp"
#include "commands/commands.hpp"
#include "core/files.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

struct EmitCommand {
  std::vector<std::string> fits;  // files or ids
  std::filesystem::path fit_folder = "fits";
  std::filesystem::path output = "generated";
  bool all = false, check = false;
};

struct GeneratedFile {
  std::filesystem::path path;
  std::string content;
};

FitFolder chosen_fits(const EmitCommand& options) {
  if (options.all) return load_fit_folder(options.fit_folder);
  FitFolder chosen;
  for (const std::string& name : options.fits) chosen.add(find_any_fit(name, options.fit_folder));
  return chosen;
}

std::vector<GeneratedFile> generate(const EmitCommand& options) {
  const FitFolder chosen = chosen_fits(options);
  std::vector<GeneratedFile> files;
  const auto add_header = [&](const auto& fit, std::string text) {
    files.push_back({options.output / (fit.id + ".hpp"), std::move(text)});
  };
  for (const Fit& fit : chosen.fits) add_header(fit, emit_header(fit));
  for (const WorkflowFit& fit : chosen.workflows) add_header(fit, emit_header(fit));
  for (const WarpMapFit& fit : chosen.warps) add_header(fit, emit_header(fit));
  if (options.all) files.push_back({options.output / kConverterListName, emit_converter_list(chosen.fits)});
  return files;
}

// A line for every file that is missing or differs from what its fit gives, and for every header without a
// fit.
std::vector<std::string> differences(const EmitCommand& options, const std::vector<GeneratedFile>& files) {
  std::vector<std::string> found;
  for (const GeneratedFile& file : files) {
    if (!std::filesystem::exists(file.path))
      found.push_back(file.path.string() + ": missing");
    else if (read_file(file.path) != file.content)
      found.push_back(file.path.string() + ": differs from its fit");
  }
  if (!options.all || !std::filesystem::is_directory(options.output)) return found;
  for (const auto& entry : std::filesystem::directory_iterator(options.output)) {
    if (entry.path().extension() != ".hpp") continue;
    const bool known = std::any_of(files.begin(), files.end(), [&](const GeneratedFile& file) {
      return file.path.filename() == entry.path().filename();
    });
    if (!known)
      found.push_back(entry.path().string() + ": no fit of this name in " + options.fit_folder.string());
  }
  return found;
}

void run(const EmitCommand& options) {
  if (options.all == !options.fits.empty())
    throw Error(ErrorKind::kUsage, options.all ? "--all cannot be used with named fits"
                                               : "no fits given (name fits, or use --all)");
  const std::vector<GeneratedFile> files = generate(options);
  if (!options.check) {
    for (const GeneratedFile& file : files) {
      write_file(file.path, file.content);
      std::cerr << file.path.string() << "\n";
    }
    return;
  }
  const std::vector<std::string> found = differences(options, files);
  for (const std::string& difference : found) std::cout << difference << "\n";
  if (!found.empty())
    throw Error(ErrorKind::kInput, options.output.string() + ": " + std::to_string(found.size()) +
                                       " files are out of date (run `remapc emit --all`)");
}

}  // namespace

void add_emit_command(Command& app) {
  Command* command = app.add_subcommand(
      "emit", "Write the C++ headers of fits, or of all fits together with the data of texremap",
      kCompileStage);
  EmitCommand& options = set_work<EmitCommand>(*command, run);
  command->add_option("fits", options.fits, "Fits: files, or ids in the folder of fits");
  command->option_group("Input");
  command->add_flag("--all", options.all, "Emit every fit of the folder, and converters.json");
  command->add_option("--fits FOLDER", options.fit_folder, "Folder of fits");
  command->option_group("Output");
  command->add_option("-o,--output FOLDER", options.output, "Folder for the headers");
  command->add_flag(
      "--check", options.check,
      "Write nothing; exit code 1 if a header, or with --all converters.json, is missing or differs "
      "from what the fits give");
  command->footer(
      "Example:\n"
      "  remapc emit fits/mitsuba_ward_to_mitsuba_as.json -o generated\n"
      "  remapc emit --all --check");
}

}  // namespace remap
