#include "texremap/convert_options.hpp"

#include <CLI/CLI.hpp>

#include "remap/error.hpp"
#include "text/nearest_name.hpp"

namespace remap {
namespace {

// Options with a value of this name take a map or numbers; the footer of the command explains it.
constexpr const char* kMap = "MAP";

void add_source_options(CLI::App& command, ConvertOptions& options) {
  command.option_defaults()->group("Source and target");
  command.add_option("DIR", options.folder, "Folder of texture sets, found by the names of their maps")
      ->type_name("");
  command.add_option("--from", options.from, "Source model, e.g. mitsuba/ward")->type_name("MODEL");
  command.add_option("--to", options.to, "Target model, e.g. mitsuba/as")->type_name("MODEL");
  CLI::Option* via =
      command.add_option("--via", options.via, "Model that the path must pass through; repeatable, in order")
          ->allow_extra_args(false)
          ->type_name("MODEL");
  command.add_option("--fit", options.fit, "Convert by this fit (JSON) instead of a compiled converter")
      ->excludes(via)
      ->type_name("FILE");
  command.add_flag("-r,--recursive", options.recursive,
                   "Convert the subfolders of DIR, too; results mirror the tree");
}

void add_map_options(CLI::App& command, ConvertOptions& options) {
  command.option_defaults()->group("Maps");
  CLI::Option* roughness =
      command.add_option("--roughness", options.roughness, "Roughness of the source model")->type_name(kMap);
  command
      .add_option("--glossiness", options.glossiness,
                  "Glossiness, 1 - sqrt(alpha), in place of the roughness")
      ->excludes(roughness)
      ->type_name(kMap);
  command
      .add_option("--specular", options.specular,
                  "Specular color; with DIR, numbers for the sets without a specular map")
      ->type_name(kMap);
  command
      .add_option("--diffuse", options.diffuse,
                  "Diffuse color of a specular workflow; else the file is copied")
      ->type_name(kMap);
  command
      .add_option("--base-color", options.base_color,
                  "Base color of a metallic workflow; else the file is copied")
      ->type_name(kMap);
  command
      .add_option("--metallic", options.metallic,
                  "Metallic of a metallic workflow; else --layout places it unconverted")
      ->type_name(kMap);
  command.add_option("--occlusion", options.occlusion, "Ambient occlusion; --layout places it unconverted")
      ->type_name(kMap);
  command
      .add_option("--roughness-encoding", options.encoding,
                  "What the roughness map holds: alpha, roughness (its square root), squared, glossiness or "
                  "exponent (default: what the source model takes)")
      ->type_name("NAME");
  command
      .add_option("--color-space", options.color_space,
                  "srgb or linear, or per map: specular=linear,diffuse=srgb (default: srgb for integer color "
                  "that the file tags as sRGB, else linear)")
      ->type_name("NAME");
  command.add_flag("--resample", options.resample,
                   "Enlarge smaller maps of a set to the largest size, bilinearly");
  command.add_option("--names", options.names, "More file-name patterns for the maps in DIR (JSON)")
      ->type_name("FILE");
}

void add_output_options(CLI::App& command, ConvertOptions& options) {
  command.option_defaults()->group("Output");
  command.add_option("-o,--output", options.output, "Folder for the results, which keep their input's names")
      ->type_name("DIR");
  command
      .add_option("--layout", options.layout,
                  "Files to write: as-inputs, separate, orm, arm or specgloss (default: as-inputs; separate "
                  "from one workflow to the other)")
      ->type_name("NAME");
  command.add_option("--format", options.format, "File extension of the results: exr, tif, png, ...")
      ->type_name("EXT");
  command.add_option("--type", options.type, "Pixel type of the results: uint8, uint16, half or float")
      ->type_name("NAME");
  command.add_option("--only", options.only, "Write only this parameter, roughness or specular; read both")
      ->type_name("NAME");
  command.add_flag("--copy-others", options.copy_others,
                   "With DIR, also copy the maps that are not converted (normal, height, ...)");
  command.add_flag("--force", options.force,
                   "Overwrite existing results (never an input); accept maps that were already converted");
  command.add_flag("--resume", options.resume,
                   "Skip sets whose results exist and were made from the same inputs and options");
  command.add_flag("--dry-run", options.dry_run, "List the files that would be written; write nothing");
  command.add_flag("--json", options.json, "Print a report with histograms as JSON");
  command.add_flag("--quiet", options.quiet, "Print nothing but errors to standard error");
}

void add_workflow_options(CLI::App& command, ConvertOptions& options) {
  command.option_defaults()->group("Whole materials (metallic and specular workflows)");
  command
      .add_option("--from-workflow", options.from_workflow,
                  "Workflow around the source model: specular (diffuse, specular) or metallic (base color, "
                  "metallic)")
      ->type_name("NAME");
  command.add_option("--to-workflow", options.to_workflow, "Workflow around the target model")
      ->type_name("NAME");
  command
      .add_option("--dielectric-f0", options.dielectric_f0,
                  "F0 of dielectrics: a number, or estimate to derive it from the maps (default: 0.04, or "
                  "what the metallic model has)")
      ->type_name("VALUE");
  command
      .add_option(
          "--diffuse-convention", options.diffuse_convention,
          "Meaning of the source's diffuse: plain (reflectance) or scaled (times 1 - max(specular), as "
          "in glTF; default: what the source model has)")
      ->type_name("NAME");
  command.option_defaults()->group("Rare: how metallic is found");
  command
      .add_option("--formula", options.formula,
                  "projection (default, smallest visible error), equation-3, equation-3-mean or khronos")
      ->type_name("NAME");
  command
      .add_option("--prior", options.prior,
                  "How strongly projection prefers 0 and 1: clean (default), noisy (scans, JPEG) or a number "
                  "from 0 to 1")
      ->type_name("VALUE");
  command
      .add_option("--metal-mask", options.metal_mask,
                  "Map of the metals, which decides between metallic values that look alike")
      ->type_name(kMap);
  command.add_flag("--smooth-metallic", options.smooth_metallic,
                   "Where metallic is undetermined, follow the texels around it; reads the maps twice");
}

void add_encoding_options(CLI::App& command, ConvertOptions& options) {
  command.option_defaults()->group("Rare: encodings and factors");
  command
      .add_option("--output-encoding", options.output_encoding,
                  "What the roughness results hold (default: as the input where that is known, else what the "
                  "target model takes)")
      ->type_name("NAME");
  command
      .add_option("--roughness-factor", options.roughness_factor,
                  "Multiply the roughness or glossiness map before it is decoded")
      ->type_name("NUMBER");
  command
      .add_option("--specular-factor", options.specular_factor,
                  "Multiply linear specular by one number, or by three")
      ->type_name("NUMBERS");
  command.add_flag("--dither", options.dither, "Add repeatable noise of half a step to 8-bit results");
}

void add_diagnosis_options(CLI::App& command, ConvertOptions& options) {
  command.option_defaults()->group("Rare: diagnosis maps");
  command.add_option("--mask", options.mask, "Also write this map: 1 where a texel is outside the domain")
      ->type_name("FILE");
  command
      .add_option("--residual", options.residual,
                  "Also write this map: what metal-rough cannot represent (rendered difference / 0.42)")
      ->type_name("FILE");
  command
      .add_option("--metallic-width", options.metallic_width,
                  "Also write this map: the share of [0, 1] in which metallic may lie; above 0.2 it is "
                  "undetermined")
      ->type_name("FILE");
  command
      .add_option("--doubts", options.doubts,
                  "Also write this map of reasons for doubt, as a sum: 1 clamped, 2 ambiguous, 4 too dark, 8 "
                  "undetermined")
      ->type_name("FILE");
}

void add_technical_options(CLI::App& command, ConvertOptions& options) {
  command.option_defaults()->group("Rare: checks");
  command
      .add_option("--bad-texels", options.bad_texels,
                  "NaN, infinite and negative values: keep, clamp (to the domain) or fail")
      ->capture_default_str()
      ->type_name("NAME");
  command.option_defaults()->group("Rare: speed");
  command.add_option("--threads", options.thread_count, "Number of threads; 0 for one per core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command
      .add_option("--instructions", options.instructions,
                  "baseline, avx2 or avx512; results are identical (default: the widest of this processor)")
      ->type_name("NAME");
}

}  // namespace

void fail_unknown(const std::string& option, const std::string& noun, const std::string& word,
                  const std::vector<std::string>& known) {
  throw Error(ErrorKind::kUsage, option + ": unknown " + noun + " '" + word + "'" + suggestion(word, known));
}

void add_convert_options(CLI::App& command, ConvertOptions& options) {
  add_source_options(command, options);
  add_map_options(command, options);
  add_output_options(command, options);
  add_workflow_options(command, options);
  add_encoding_options(command, options);
  add_diagnosis_options(command, options);
  add_technical_options(command, options);
}

}  // namespace remap
