#include "texremap/convert_options.hpp"

#include <initializer_list>
#include <variant>

#include "command_line/command.hpp"
#include "remap/error.hpp"
#include "texremap/commands.hpp"
#include "text/nearest_name.hpp"

namespace remap {
namespace {

// An option with a value, or a flag.
struct Entry {
  const char* names;
  std::variant<std::string ConvertOptions::*, bool ConvertOptions::*> member;
  const char* value;  // name of the value in the help; unused for a flag
  const char* description;
};

// Adds options under a heading of the help. `--help` hides groups whose names begin with "Rare".
void add_group(Command& command, ConvertOptions& options, const char* group,
               std::initializer_list<Entry> entries) {
  command.option_group(group);
  for (const Entry& entry : entries) {
    if (const auto* text = std::get_if<std::string ConvertOptions::*>(&entry.member))
      command.add_option(entry.names, options.*(*text), entry.description)->type_name(entry.value);
    else
      command.add_flag(entry.names, options.*std::get<bool ConvertOptions::*>(entry.member),
                       entry.description);
  }
}

void add_source_options(Command& command, ConvertOptions& options) {
  using O = ConvertOptions;
  add_group(
      command, options, "Source and target",
      {{"DIR", &O::folder, "", "Folder of texture sets, found by the names of their maps"},
       {"--from", &O::from, "MODEL", "Source model, e.g. mitsuba/ward"},
       {"--to", &O::to, "MODEL",
        "Target model, e.g. mitsuba/as, or a renderer, e.g. cycles-5, for the closest of its models"},
       {"--fit", &O::fit, "FILE", "Convert by this fit (JSON) instead of a shipped converter"},
       {"-r,--recursive", &O::recursive, "", "Convert the subfolders of DIR, too; results mirror the tree"}});
  command.add_option("--via", options.via, "Model that the path must pass through; repeatable, in order")
      ->allow_extra_args(false)
      ->excludes(command.option("--fit"))
      ->type_name("MODEL");
  add_converters_option(command);
  command.option("--converters")->excludes(command.option("--fit"));
}

// The footer of the command explains the value MAP.
void add_map_options(Command& command, ConvertOptions& options) {
  using O = ConvertOptions;
  add_group(
      command, options, "Maps",
      {{"--roughness", &O::roughness, "MAP", "Roughness of the source model"},
       {"--glossiness", &O::glossiness, "MAP", "Glossiness, 1 - sqrt(alpha), in place of the roughness"},
       {"--specular", &O::specular, "MAP",
        "Specular color; with DIR, numbers for sets without a specular map"},
       {"--diffuse", &O::diffuse, "MAP", "Diffuse color of a specular workflow; else the file is copied"},
       {"--base-color", &O::base_color, "MAP", "Base color of a metallic workflow; else the file is copied"},
       {"--metallic", &O::metallic, "MAP",
        "Metallic of a metallic workflow; else --layout places it unconverted"},
       {"--occlusion", &O::occlusion, "MAP", "Ambient occlusion; --layout places it unconverted"},
       {"--roughness-encoding", &O::encoding, "NAME",
        "What roughness maps hold: alpha, roughness (its square root), squared, glossiness or exponent "
        "(default: what the source model takes); maps named glossiness or smoothness hold that"},
       {"--color-space", &O::color_space, "NAME",
        "How color maps are read: srgb or linear, or per map: specular=linear,diffuse=srgb (default: as the "
        "file says, else srgb for whole numbers and linear for half and float)"},
       {"--resample", &O::resample, "", "Enlarge smaller maps of a set to the largest size, bilinearly"},
       {"--names", &O::names, "FILE", "More file-name habits for the maps in DIR (JSON)"}});
  command.option("--glossiness")->excludes(command.option("--roughness"));
}

void add_output_options(Command& command, ConvertOptions& options) {
  using O = ConvertOptions;
  add_group(
      command, options, "Output",
      {{"-o,--output", &O::output, "DIR", "Folder for the results, which keep the names of the inputs"},
       {"--layout", &O::layout, "NAME",
        "Files to write: as-inputs, separate, orm, arm or specgloss (default: as-inputs; separate "
        "between workflows)"},
       {"--format", &O::format, "EXT", "File extension of the results: exr, tif, png, ..."},
       {"--type", &O::type, "NAME", "Pixel type of the results: uint8, uint16, half or float"},
       {"--output-color-space", &O::output_color_space, "NAME",
        "How colors are written: srgb or linear, or per map (default: whole numbers as the map that they "
        "follow, else srgb; half and float linear)"},
       {"--only", &O::only, "NAME", "Write only roughness or only specular"},
       {"--copy-others", &O::copy_others, "",
        "With DIR, also copy the maps that are not converted (normal, height, ...)"},
       {"--force", &O::force, "",
        "Overwrite existing results (never an input); accept maps that were already converted and a folder "
        "of "
        "another conversion"},
       {"--resume", &O::resume, "",
        "Skip sets that are done; make anew those whose inputs, options, converter or results changed"},
       {"--allow-skips", &O::allow_skips, "",
        "With DIR, sets that are found and not converted do not make the exit code 1"},
       {"--dry-run", &O::dry_run, "", "List the files that would be written; write nothing"},
       {"--json", &O::json, "",
        "Print a report as JSON; of a folder a line for each set as it is finished, then a summary"},
       {"--histograms", &O::histograms, "", "With --json, also histograms of the values"},
       {"--quiet", &O::quiet, "", "Print nothing but errors to standard error"}});
}

void add_workflow_options(Command& command, ConvertOptions& options) {
  using O = ConvertOptions;
  add_group(
      command, options, "Whole materials (metallic and specular workflows)",
      {{"--from-workflow", &O::from_workflow, "NAME",
        "Workflow around the source model: specular (diffuse, specular) or metallic (base color, metallic)"},
       {"--to-workflow", &O::to_workflow, "NAME", "Workflow around the target model"},
       {"--dielectric-f0", &O::dielectric_f0, "VALUE",
        "F0 of dielectrics: a number, or estimate to derive it from the maps (default: that of the metallic "
        "model, 0.04)"},
       {"--diffuse-convention", &O::diffuse_convention, "NAME",
        "Meaning of the source's diffuse: plain (reflectance) or scaled (times 1 - max(specular), as in "
        "glTF; "
        "default: that of the source model)"}});
  add_group(
      command, options, "Rare: how metallic is found",
      {{"--formula", &O::formula, "NAME",
        "projection (default, smallest visible error), equation-3, equation-3-mean or khronos"},
       {"--prior", &O::prior, "VALUE",
        "How strongly projection prefers 0 and 1: clean (default), noisy (scans, JPEG) or a number from "
        "0 to 1"},
       {"--metal-mask", &O::metal_mask, "MAP",
        "Map of the metals, which decides between metallic values that look alike"},
       {"--smooth-metallic", &O::smooth_metallic, "",
        "Where metallic is undetermined, follow the texels around it; reads the maps twice"}});
}

void add_rare_options(Command& command, ConvertOptions& options) {
  using O = ConvertOptions;
  add_group(command, options, "Rare: encodings and factors",
            {{"--output-encoding", &O::output_encoding, "NAME",
              "What the roughness results hold (default: as the inputs where that is known, else what the "
              "target model takes; a file named glossiness holds glossiness)"},
             {"--roughness-factor", &O::roughness_factor, "NUMBER",
              "Multiply the roughness or glossiness map before it is decoded"},
             {"--specular-factor", &O::specular_factor, "NUMBERS",
              "Multiply linear specular by one number, or by three"},
             {"--dither", &O::dither, "", "Add repeatable noise of half a step to 8-bit results"}});
  add_group(
      command, options, "Rare: diagnosis maps",
      {{"--mask", &O::mask, "FILE", "Also write this map: 1 where a texel is outside the domain"},
       {"--residual", &O::residual, "FILE",
        "Also write this map: what metal-rough cannot represent; rendered pictures differ by 0.42 of it"},
       {"--metallic-width", &O::metallic_width, "FILE",
        "Also write this map: the share of [0, 1] in which metallic may lie; above 0.2 it is "
        "undetermined"},
       {"--doubts", &O::doubts, "FILE",
        "Also write this map of doubts, a sum: 1 clamped, 2 ambiguous, 4 too dark, 8 undetermined"}});
  add_group(command, options, "Rare: checks",
            {{"--bad-texels", &O::bad_texels, "NAME",
              "NaN, infinite and negative values: keep, clamp (all values to the domain) or fail"}});
  command.option("--bad-texels")->capture_default_str();
  add_group(command, options, "Rare: speed",
            {{"--instructions", &O::instructions, "NAME",
              "baseline, avx2 or avx512; results are identical (default: the widest of this processor)"}});
  command.add_option("--threads", options.thread_count, "Number of threads; 0 for one per core")
      ->range(0, 1024)
      ->capture_default_str();
}

}  // namespace

void fail_unknown(const std::string& option, const std::string& noun, const std::string& word,
                  const std::vector<std::string>& known) {
  throw Error(ErrorKind::kUsage, option + ": unknown " + noun + " '" + word + "'" + suggestion(word, known));
}

void add_convert_options(Command& command, ConvertOptions& options) {
  add_source_options(command, options);
  add_map_options(command, options);
  add_output_options(command, options);
  add_workflow_options(command, options);
  add_rare_options(command, options);
}

}  // namespace remap
