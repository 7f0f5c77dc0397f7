#include "texremap/convert_options.hpp"

#include <CLI/CLI.hpp>

#include "remap/error.hpp"
#include "text/nearest_name.hpp"

namespace remap {
namespace {

void add_input_options(CLI::App& command, ConvertOptions& options) {
  command.add_option("DIR", options.folder, "Folder of texture sets, found by the names of their maps");
  command.add_flag("-r,--recursive", options.recursive,
                   "The folders below DIR, too; results mirror the tree");
  command.add_option("--names", options.names,
                     "Naming habits of your own (JSON), besides those of common tools");
  CLI::Option* roughness =
      command.add_option("--roughness", options.roughness,
                         "Roughness of the source model: a map, FILE:CHANNEL of a packed one, or a number");
  command
      .add_option("--glossiness", options.glossiness,
                  "The same as glossiness, 1 - sqrt(alpha): --roughness with --roughness-encoding glossiness")
      ->excludes(roughness);
  command.add_option(
      "--specular", options.specular,
      "Specular: a map, FILE:CHANNEL or FILE:R,G,B, or linear numbers: 0.5, or 0.9,0.6,0.2; with "
      "DIR for the sets that have no such map");
  command.add_option("--occlusion", options.occlusion,
                     "Ambient occlusion: not converted; goes where --layout has a place for it");
  command.add_option("--metallic", options.metallic,
                     "Metallic of a metallic workflow: a map, FILE:CHANNEL, or a number; else it is not "
                     "converted and goes where --layout has a place for it");
  command.add_option("--diffuse", options.diffuse,
                     "Diffuse of a specular workflow: a map or linear numbers; else the file is copied "
                     "beside the results");
  command.add_option("--base-color", options.base_color,
                     "Base color of a metallic workflow: a map or linear numbers; else the file is copied "
                     "beside the results");
  command.add_option("--roughness-factor", options.roughness_factor,
                     "Multiplies the roughness map (or the glossiness map) before it is read");
  command.add_option("--specular-factor", options.specular_factor,
                     "Multiplies linear specular: one number, or three");
  command.add_option("--roughness-encoding", options.encoding,
                     "What the roughness map holds: alpha, roughness (its square root), squared, glossiness, "
                     "exponent; the default is the source model's own");
  command.add_option(
      "--color-space", options.color_space,
      "Of color maps: srgb or linear, or of one: specular=linear,diffuse=srgb. The default: sRGB for color "
      "in whole numbers that the file says to be sRGB (PNG, JPEG, TGA), else linear");
  command.add_flag("--resample", options.resample,
                   "Bring smaller maps of a set to the size of the largest, linearly between texels");
  command
      .add_option("--bad-texels", options.bad_texels,
                  "NaN, infinite and negative values: keep, clamp to what the converter covers, or fail")
      ->capture_default_str();
}

void add_output_options(CLI::App& command, ConvertOptions& options) {
  command.add_option("-o,--output", options.output, "Folder of the results; their names are the inputs'");
  command.add_option(
      "--layout", options.layout,
      "Files of the results: as-inputs (the default, but between workflows); separate (a file each); orm "
      "or arm (occlusion, roughness, metallic; and the colors); specgloss (specular, and glossiness in "
      "alpha; and diffuse)");
  command.add_option("--only", options.only, "Convert roughness or specular alone, the other one only read");
  command.add_option(
      "--output-encoding", options.output_encoding,
      "What the roughness results hold; the default is what --roughness-encoding or the name of the "
      "map says, else the target model's own");
  command.add_option("--mask", options.mask, "Name of a map to write as well: 1 for texels out of domain");
  command.add_option(
      "--residual", options.residual,
      "Name of a map to write as well: what metallic cannot say of the texel; 0.42 of it is the "
      "difference of the pictures");
  command.add_option(
      "--metallic-width", options.metallic_width,
      "Name of a map to write as well: share of [0, 1] in which metallic could lie; above 0.2 it "
      "is a guess");
  command.add_option(
      "--doubts", options.doubts,
      "Name of a map to write as well: why metallic or base color may not be those that were meant; in 8 "
      "bits the sum of 1 (clamped), 2 (two answers look alike), 4 (too dark to tell), 8 (metallic is a "
      "guess)");
  command.add_option("--format", options.format, "Extension of the results: exr, tif, png, ...");
  command.add_option("--type", options.type, "Pixel type of the results: uint8, uint16, half, float");
  command.add_flag("--dither", options.dither,
                   "Noise of half a step where results have 8 bits; the same in every run");
  command.add_flag("--copy-others", options.copy_others,
                   "With DIR: copy the other maps of each set as well (base color, normal, ...)");
  command.add_flag("--dry-run", options.dry_run, "Say what would be written, and write nothing");
  command.add_flag(
      "--resume", options.resume,
      "Leave out sets whose results are there and were made of the same inputs and options; make "
      "the others");
  command.add_flag("--force", options.force,
                   "Replace results that exist (never an input); convert converted maps");
}

void add_workflow_options(CLI::App& command, ConvertOptions& options) {
  command.add_option(
      "--from-workflow", options.from_workflow,
      "Of a BRDF model: specular (diffuse and specular) or metallic (base color and metallic)");
  command.add_option("--to-workflow", options.to_workflow, "The same of the target");
  command.add_option(
      "--dielectric-f0", options.dielectric_f0,
      "F0 of what is no metal: a number, or estimate from the maps; the default is that of the "
      "metallic model, 0.04");
  command.add_option(
      "--diffuse-convention", options.diffuse_convention,
      "What diffuse of the source means: plain (reflectance) or scaled (times 1 - max(specular), "
      "as in glTF); the default is the model's own");
  command.add_option("--formula", options.formula,
                     "To metallic: projection (the default: the least difference of pictures), equation-3, "
                     "equation-3-mean, khronos");
  command.add_option(
      "--prior", options.prior,
      "How much the projection prefers 0 and 1: clean (the default), noisy (scans, JPEG), or a "
      "number");
  command.add_option("--metal-mask", options.metal_mask,
                     "Map of what is metal: chooses among metallic values that look alike");
  command.add_flag("--smooth-metallic", options.smooth_metallic,
                   "Where metallic is a guess on which the picture does not depend, follow the texels around "
                   "it that can tell; reads the maps twice");
}

}  // namespace

void fail_unknown(const std::string& option, const std::string& word, const std::vector<std::string>& known) {
  throw Error(ErrorKind::kUsage, option + ": is " + word + suggestion(word, known));
}

void add_convert_options(CLI::App& command, ConvertOptions& options) {
  command.add_option("--from", options.from, "Source model, e.g. mitsuba/ward");
  command.add_option("--to", options.to, "Target model, e.g. mitsuba/as");
  CLI::Option* via =
      command
          .add_option("--via", options.via,
                      "Model that the path must go through; give it again for more, in their order")
          ->allow_extra_args(false);
  command.add_option("--fit", options.fit, "Lower this fit (JSON) instead of taking compiled converters")
      ->excludes(via);
  add_workflow_options(command, options);
  add_input_options(command, options);
  add_output_options(command, options);
  command.add_option("--threads", options.thread_count, "Threads; 0, the default, is one a core")
      ->check(CLI::Range(0, 1024));
  command.add_option("--instructions", options.instructions,
                     "baseline, avx2 or avx512; the default is the widest of this processor. The results "
                     "are the same");
  command.add_flag("--json", options.json, "Machine-readable result on standard output, with histograms");
  command.add_flag("--quiet", options.quiet, "Nothing on standard error but failures");
}

}  // namespace remap
