// This file writes the texts of plans for Slurm (see sbatch(1)) and for Open Job Description (template schema
// 2023-09, OpenJobDescription/openjd-specifications).
#include <algorithm>

#include "core/errors.hpp"
#include "core/json.hpp"
#include "core/plain_text.hpp"
#include "texremap/commands/farm_plan.hpp"

namespace remap {
namespace {

using NamedTexts = std::vector<std::pair<std::string, std::string>>;

std::string shell_line(const std::vector<std::string>& words) { return joined(words, " ", shell_word); }

// Returns the #SBATCH line with the log file. sbatch(1) replaces % and reads quotes and backslashes like a
// shell, so they are escaped in `folder`.
std::string log_line(const std::filesystem::path& folder, const std::string& name) {
  std::string text;
  for (const char c : folder.string()) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
    if (c == '%') text += '%';
  }
  return "#SBATCH --output=\"" + text + "/" + name + "\"\n";
}

// Returns the command that converts a part. `part` is the value of --part.
std::vector<std::string> convert_words(const PlannedFarm& farm, const std::string& part) {
  std::vector<std::string> words = {
      farm.program, "convert", farm.tree.string(), "--manifest", farm.manifest.string(), "--part", part};
  words.insert(words.end(), farm.options.begin(), farm.options.end());
  for (const std::string& word :
       {std::string("--threads"), std::to_string(farm.threads), std::string("-o"), farm.output.string()})
    words.push_back(word);
  return words;
}

std::vector<std::string> merge_words(const PlannedFarm& farm) {
  return {farm.program, "merge-reports", farm.output.string(), "-o", farm.report.string(), "--force"};
}

NamedTexts slurm_files(const PlannedFarm& farm) {
  const std::filesystem::path log = farm.folder / "log";
  const std::string threads = std::to_string(farm.threads);
  std::string convert = "#!/bin/sh\n#SBATCH --job-name=texremap\n#SBATCH --array=1-" +
                        std::to_string(farm.parts) + "\n#SBATCH --ntasks=1\n";
  convert += farm.threads == 0 ? "#SBATCH --exclusive\n" : "#SBATCH --cpus-per-task=" + threads + "\n";
  convert +=
      "#SBATCH --mem=" + std::to_string(farm.memory_megabytes) +
      "M\n#SBATCH --time=" + std::to_string(farm.minutes) +
      "\n#SBATCH --requeue\n#SBATCH --open-mode=append\n" + log_line(log, "%a.txt") + "\n" +
      shell_line(convert_words(farm, "auto/" + std::to_string(farm.parts))) +
      "\ncode=$?\n"
      "# 75: a full disk, or storage that did not answer. The part goes on where it ended.\n"
      "if [ \"$code\" = 75 ] && [ \"${SLURM_RESTART_COUNT:-0}\" -lt 3 ]; then\n"
      "  scontrol requeue \"${SLURM_ARRAY_JOB_ID}_${SLURM_ARRAY_TASK_ID}\" && sleep 60  # ended by it\n"
      "fi\n"
      "exit \"$code\"\n";
  const std::string merge = "#!/bin/sh\n#SBATCH --job-name=texremap-merge\n#SBATCH --ntasks=1\n" +
                            log_line(log, "merge.txt") + "\n" + shell_line(merge_words(farm)) + "\n";
  // The script accepts numbers of parts to repeat, as in `submit.sh 3,17`.
  const std::string submit =
      "#!/bin/sh\n# Submits all parts, or the parts of its argument (3,17-19), and after them the merge.\n"
      "set -e\nhere=" +
      shell_word(farm.folder.string()) +
      "\nmkdir -p \"$here/log\"\n"
      "array=$(sbatch --parsable ${1:+--array=\"$1\"} \"$here/convert.sbatch\")\n"
      "merge=$(sbatch --parsable --dependency=afterany:\"${array%%;*}\" \"$here/merge.sbatch\")\n"
      "echo \"parts: job ${array%%;*}, merge: job ${merge%%;*}\"\n";
  return {{"convert.sbatch", convert}, {"merge.sbatch", merge}, {"submit.sh", submit}};
}

NamedTexts commands_files(const PlannedFarm& farm) {
  std::string lines;
  for (std::size_t i = 1; i <= farm.parts; ++i)
    lines += shell_line(convert_words(farm, std::to_string(i) + "/" + std::to_string(farm.parts))) + "\n";
  return {{"commands.txt", lines}, {"merge.sh", "#!/bin/sh\n" + shell_line(merge_words(farm)) + "\n"}};
}

// Returns a template parameter that holds a path. Farms translate such paths for each worker. The value is in
// a file beside the template, because a default in the template must not be absolute.
Json path_parameter(const std::string& name, const std::string& object, const std::string& flow) {
  return {{"name", name}, {"type", "PATH"}, {"objectType", object}, {"dataFlow", flow}};
}

std::string file_uri(const std::filesystem::path& path) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string uri = "file://";
  for (const char c : path.string())
    if (kPlain.find(c) != std::string_view::npos)
      uri += c;
    else
      uri += percent_code(c);
  return uri;
}

// Returns a command that runs without a shell, so each word is one argument. A stopped command has time to
// clean up.
Json script_json(const std::vector<std::string>& words) {
  const std::vector<std::string> arguments(words.begin() + 1, words.end());
  return {{"actions",
           {{"onRun",
             {{"command", words.front()},
              {"args", arguments},
              {"cancelation", {{"mode", "NOTIFY_THEN_TERMINATE"}, {"notifyPeriodInSeconds", 30}}}}}}}};
}

NamedTexts openjd_files(const PlannedFarm& farm) {
  PlannedFarm shared = farm;  // with the parameters of the template instead of the paths
  shared.program = "{{Param.Program}}";
  shared.manifest = "{{Param.Manifest}}";
  shared.tree = "{{Param.Tree}}";
  shared.output = "{{Param.Output}}";
  shared.report = "{{Param.Report}}";
  Json needs = {{"amounts", Json::list()}};
  if (farm.threads > 0) needs["amounts"].push_back({{"name", "amount.worker.vcpu"}, {"min", farm.threads}});
  needs["amounts"].push_back({{"name", "amount.worker.memory"}, {"min", farm.memory_megabytes}});
  const Json convert = {
      {"name", "Convert"},
      {"hostRequirements", needs},
      {"parameterSpace",
       {{"taskParameterDefinitions",
         Json::list({{{"name", "Part"}, {"type", "INT"}, {"range", "1-" + std::to_string(farm.parts)}}})}}},
      {"script", script_json(convert_words(shared, "{{Task.Param.Part}}/" + std::to_string(farm.parts)))}};
  const Json merge = {{"name", "Merge"},
                      {"dependencies", Json::list({{{"dependsOn", "Convert"}}})},
                      {"script", script_json(merge_words(shared))}};
  const Json json = {{"specificationVersion", "jobtemplate-2023-09"},
                     {"name", "texremap"},
                     {"parameterDefinitions",
                      Json::list({{{"name", "Program"}, {"type", "STRING"}, {"default", farm.program}},
                                  path_parameter("Manifest", "FILE", "IN"),
                                  path_parameter("Tree", "DIRECTORY", "IN"),
                                  path_parameter("Output", "DIRECTORY", "INOUT"),
                                  path_parameter("Report", "FILE", "OUT")})},
                     {"steps", Json::list({convert, merge})}};
  const Json values = {{"Manifest", farm.manifest.string()},
                       {"Tree", farm.tree.string()},
                       {"Output", farm.output.string()},
                       {"Report", farm.report.string()}};
  return {{"template.json", json.dump(2) + "\n"}, {"parameters.json", values.dump(2) + "\n"}};
}

}  // namespace

void require_writable(PlanKind kind, const PlannedFarm& farm) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7f'; };
  const auto refuse = [](const std::string& word, const std::string& what) {
    throw usage_error(plain(word) + ": " + what + " (rename the file or folder)");
  };
  std::vector<std::string> words = farm.options;
  for (const auto& path : {farm.manifest, farm.tree, farm.output, farm.folder})
    words.push_back(path.string());
  words.push_back(farm.program);
  for (const std::string& word : words) {
    if (std::ranges::any_of(word, is_control))
      refuse(word, "contains a line break or another control character, which a plan cannot contain");
    if (kind == PlanKind::kOpenJd && !is_utf8(word))
      refuse(word, "is not UTF-8, as an OpenJD template must be");
  }
  for (const std::string& option : farm.options)
    if (kind == PlanKind::kOpenJd &&
        (option.find("{{") != std::string::npos || option.find("}}") != std::string::npos))
      refuse(option, "contains {{ or }}, which an OpenJD template cannot contain");
  // Refuse backslashes: sbatch would then not replace the number of a part in the rest of the name.
  if (kind == PlanKind::kSlurm && farm.folder.string().find('\\') != std::string::npos)
    refuse(farm.folder.string(), "has a backslash in its name, so sbatch cannot write logs there");
}

NamedTexts plan_files(PlanKind kind, const PlannedFarm& farm) {
  switch (kind) {
    case PlanKind::kSlurm:
      return slurm_files(farm);
    case PlanKind::kOpenJd:
      return openjd_files(farm);
    case PlanKind::kCommands:
      return commands_files(farm);
  }
  return {};
}

std::string submit_command(PlanKind kind, const PlannedFarm& farm) {
  const auto file = [&](const char* name) { return shell_word((farm.folder / name).string()); };
  switch (kind) {
    case PlanKind::kSlurm:
      return "sh " + file("submit.sh");
    case PlanKind::kOpenJd:
      return "openjd run " + file("template.json") + " --job-param " +
             shell_word(file_uri(farm.folder / "parameters.json"));
    case PlanKind::kCommands:
      return "parallel --retries 3 < " + file("commands.txt") + "; sh " + file("merge.sh");
  }
  return "";
}

}  // namespace remap
