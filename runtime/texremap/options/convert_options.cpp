#include "texremap/options/convert_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "command_line/run_app.hpp"
#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "core/system.hpp"

namespace remap {
namespace {

constexpr NamedValues<WrittenType, 5> kWrittenTypes = {{{WrittenType::kUint8, "uint8"},
                                                        {WrittenType::kDithered, "uint8-dithered"},
                                                        {WrittenType::kUint16, "uint16"},
                                                        {WrittenType::kHalf, "half"},
                                                        {WrittenType::kFloat, "float"}}};
constexpr NamedValues<Parameter, 2> kOnly = {
    {{Parameter::kRoughness, "roughness"}, {Parameter::kSpecular, "specular"}}};

PixelType pixel_type_of(WrittenType type) {
  switch (type) {
    case WrittenType::kUint16:
      return PixelType::kUint16;
    case WrittenType::kHalf:
      return PixelType::kHalf;
    case WrittenType::kFloat:
      return PixelType::kFloat;
    case WrittenType::kUint8:
    case WrittenType::kDithered:
      break;
  }
  return PixelType::kUint8;
}

Reader<MapSource> map_source() {
  return {[](const std::string& option, const std::string& word) { return parameter_source(option, word); },
          {}};
}

ParameterWord<std::string> split_word(const std::string& option, const std::string& word) {
  const std::size_t sign = word.find('=');
  if (sign == std::string::npos || sign + 1 == word.size())
    throw usage_error(option + ": no value in '" + word + "' (write NAME=VALUE, such as coat_weight=0.5)");
  const std::string name = word.substr(0, sign);
  const auto parameter = parameter_named(name);
  if (!parameter) {
    const std::vector<std::string> near = nearest_names(name, parameter_names(), 1);
    throw usage_error(option + ": unknown input '" + name + "' (" +
                      (near.empty() ? "use the name of an input, such as coat_weight, sheen_color or ior"
                                    : "did you mean " + near.front() + "?") +
                      ")");
  }
  return {*parameter, word.substr(sign + 1)};
}

// Reads the encoding of roughness maps. Glossiness is not one of the words, because --glossiness gives such
// maps.
Reader<RoughnessEncoding> map_encoding() {
  Reader<RoughnessEncoding> reader = one_of(kRoughnessEncodings, "encoding");
  std::erase(reader.choices, "glossiness");
  reader.read = [read = reader.read](const std::string& option, const std::string& word) {
    if (word == "glossiness")
      throw usage_error(option +
                        ": glossiness maps have their own option (use --glossiness MAP; for a folder, a "
                        "pattern such as --glossiness '*_gloss.png')");
    return read(option, word);
  };
  return reader;
}

// Returns a reader for `NAME=VALUE`, where `read` reads the value.
template <typename Value>
Reader<ParameterWord<Value>> parameter_word(Value (*read)(std::string_view option, std::string_view text)) {
  return {[read](const std::string& option, const std::string& word) {
            const auto [parameter, value] = split_word(option, word);
            return ParameterWord<Value>{parameter, read(option, value)};
          },
          {}};
}

// Reads `NAME=MAP`. Glossiness is not one of the names, because it would be read as roughness.
Reader<ParameterWord<MapSource>> input_word() {
  Reader<ParameterWord<MapSource>> reader = parameter_word(parameter_source);
  reader.read = [read = reader.read](const std::string& option, const std::string& word) {
    if (word.starts_with("glossiness="))
      throw usage_error(option + " glossiness: has its own option (use --glossiness MAP)");
    return read(option, word);
  };
  return reader;
}

// Reads a level, `jpeg=QUALITY` or both, with a comma between.
Reader<Compression> compression() {
  return {
      [](const std::string& option, const std::string& words) {
        Compression compression;
        for (const std::string& word : parts_between(words, ',')) {
          const bool is_jpeg = word.starts_with("jpeg=");
          const auto number = parse_number(is_jpeg ? word.substr(5) : word);
          if (!number || *number != std::floor(*number) || *number < 1.0 || *number > (is_jpeg ? 100.0 : 9.0))
            throw usage_error(option + ": invalid value '" + word + "' (use 1 to 9, or jpeg=1 to jpeg=100)");
          (is_jpeg ? compression.jpeg_quality : compression.level) = static_cast<int>(*number);
        }
        return compression;
      },
      {}};
}

// Reads an encoding, or `exponent=NUMBER`.
Reader<WrittenRoughness> written_roughness() {
  const Reader<RoughnessEncoding> name = one_of(kRoughnessEncodings, "encoding");
  return {[read = name.read](const std::string& option, const std::string& word) {
            const std::size_t sign = word.find('=');
            WrittenRoughness written{read(option, word.substr(0, sign)), std::nullopt};
            if (sign == std::string::npos) return written;
            written.white = parse_number(word.substr(sign + 1));
            if (written.encoding != RoughnessEncoding::kExponent || !(written.white.value_or(0.0) > 0.0))
              throw usage_error(option + ": invalid value '" + word +
                                "' (use a number above 0, such as exponent=1000; other encodings have none)");
            return written;
          },
          name.choices};
}

Reader<Layout> layout() {
  std::vector<std::string> known;
  for (const NamedLayout& layout : named_layouts()) known.emplace_back(layout.name);
  return {[](const std::string& option, const std::string& word) { return layout_from(option, word); },
          known};
}

// Reads the number from 0 to `highest` in `text`. `allowed` describes the accepted words in messages.
double number_of(const std::string& option, const std::string& text, double highest,
                 const std::string& allowed) {
  const auto number = parse_number(text);
  if (!number || !(*number >= 0.0 && *number <= highest))
    throw usage_error(option + ": invalid value '" + text + "' (use " + allowed + ")");
  return *number;
}

Reader<F0Choice> f0_choice() {
  return {[](const std::string& option, const std::string& word) -> F0Choice {
            if (word == "estimate") return F0Source::kMaps;
            return number_of(option, word, 0.9, "0 to 0.9, or estimate");
          },
          {}};
}

Reader<double> prior() {
  return {[](const std::string& option, const std::string& word) {
            if (word == "clean") return kCleanPrior;
            if (word == "noisy") return kNoisyPrior;
            return number_of(option, word, kLargestPrior, "clean, noisy, or a number from 0 to 1");
          },
          {}};
}

ColorSpaceWord color_space_word(const std::string& option, const std::string& word) {
  const std::size_t sign = word.find('=');
  // Without a sign, npos + 1 is 0, so substr() returns the whole word.
  const Transfer transfer = one_of(kTransfers, "color space").read(option, word.substr(sign + 1));
  if (sign == std::string::npos) return {std::nullopt, transfer};
  const std::string name = word.substr(0, sign);
  const auto parameter = parameter_named(name);
  if (parameter && is_color(*parameter)) return {parameter, transfer};
  std::vector<std::string> known = parameter_names();
  std::erase_if(known, [](const std::string& other) { return !is_color(*parameter_named(other)); });
  fail_unknown(option, "color", name, known);
}

// Reads a list such as `srgb` or `specular=linear,diffuse=srgb`.
Reader<std::vector<ColorSpaceWord>> color_spaces() {
  return list_of(Reader<ColorSpaceWord>{color_space_word, {}});
}

}  // namespace

Reader<ModelName> model_name() {
  return {[](const std::string& option, const std::string& word) {
            ModelName model = model_named(word);
            if (model.empty() && !prefixes_of(model).empty())
              throw usage_error(option + ": no model in '" + word + "' (write " + word + "mitsuba/ggx)");
            return model;
          },
          {}};
}

namespace {

Reader<Part> given_part() {
  return {[](const std::string&, const std::string& word) {
            return part_of(word, [](const char* name) { return std::getenv(name); });
          },
          {}};
}

void add_source_options(Command& command, ConvertOptions& options) {
  command.option_group("Rare: source and target");
  command
      .add_option("DIR", options.folder,
                  "Folder of texture sets, or an asset (a glTF, MTL or OBJ file). If assets follow a folder, "
                  "the folder must contain all their files, and the results get its subfolders")
      ->tag(kOfPlan | kForAssets);
  command.add_option("ASSET", options.more_assets, "More assets")->tag(kNeedsAsset);
  command
      .add_option(
          "--from MODEL", options.from, model_name(),
          "Model of the maps: unity, blender, gltf-specgloss, mitsuba/ward, ... (default: detected "
          "from the maps). Program that wrote the MTL files: blender, blender-2.8, nvdiffrec; or mtl, which "
          "reads them by the specification (default: detected from the file)")
      ->common()
      ->tag(kForAssets);
  command
      .add_option("--to MODEL", options.to, model_name(),
                  "Model of the results: gltf, cycles-5, mitsuba/as, ... With the name of a program (unity, "
                  "unreal, blender, ...), files are packed and named as it expects, too (texremap list)")
      ->common()
      ->tag(kForAssets);
  command
      .add_flag("-r,--recursive", options.recursive,
                "Convert the subfolders of DIR, too; the results get the same subfolders")
      ->common()
      ->tag(kNeedsTree | kForAssets | kNeedsFolder);
  command
      .add_flag("--assets", options.assets,
                "Convert the glTF and MTL files in DIR (with --format glb, its OBJ files) instead of its "
                "texture sets")
      ->tag(kNeedsAsset);
  command
      .add_flag("--follow-links", options.follow_links,
                "Follow links in DIR, or in the folder of an asset, that lead to files elsewhere")
      ->tag(kForAssets | kNeedsFiles);
  Option* manifest =
      command
          .add_option(
              "--manifest FILE", options.manifest,
              "Convert the sets or assets that texremap index has listed; give DIR if their folder was moved")
          ->tag(kOfPlan | kForAssets);
  manifest->excludes(command.option("--recursive"));
  manifest->excludes(command.option("--assets"));
  command
      .add_option(
          "--part I/N", options.part, given_part(),
          "Convert part I of N of the manifest; auto reads I and N from the array job, auto/N reads only I")
      ->needs(manifest)
      ->tag(kOfPlan | kForAssets);
  command
      .add_option("--via MODEL", options.via, "Model that the path must pass through; repeatable, in order")
      ->allow_extra_args(false);
  options.converters.add_option(command)->tag(kIsPath);
  command
      .add_option("--extensions USE", options.extensions, one_of(kDielectricExtensions, "value"),
                  "What to do with KHR_materials_specular and KHR_materials_ior. write: add them, which is "
                  "exact in viewers that read them and wrong in others; fold: replace them by core glTF, for "
                  "viewers that do not read them (default: write only core glTF in converted materials, keep "
                  "other materials unchanged)")
      ->tag(kChangesResults | kNeedsAsset);
  command
      .add_flag("--keep-unused", options.keep_unused,
                "Keep images and textures of a glTF file that only its converted materials used")
      ->tag(kChangesResults | kNeedsAsset | kNeedsGltf);
}

// The footer of the command explains the value MAP.
void add_map_options(Command& command, ConvertOptions& options) {
  using P = Parameter;
  command.option_group("Rare: maps");
  const auto add_map = [&](const std::string& name, P parameter, const std::string& description) {
    return command.add_option(name + " MAP", options.maps[parameter], map_source(), description)
        ->tag(kChangesResults);
  };
  add_map("--roughness", P::kRoughness, "Roughness of the source model")->tag(kNotWithDiffuseWarp);
  command
      .add_option("--glossiness MAP", options.glossiness, map_source(),
                  "Glossiness, 1 - sqrt(alpha), instead of the roughness")
      ->tag(kChangesResults | kNotWithDiffuseWarp)
      ->excludes(command.option("--roughness"));
  add_map("--specular", P::kSpecular, "Specular color")->tag(kNotWithDiffuseWarp);
  add_map("--diffuse", P::kDiffuse,
          "Diffuse color of a specular workflow; without a workflow, texremap copies the file");
  add_map("--base-color", P::kBaseColor,
          "Base color of a metallic workflow; without a workflow, texremap copies the file");
  add_map("--metallic", P::kMetallic,
          "Metallic of a metallic workflow; without a workflow, texremap puts it unchanged into the files of "
          "--layout");
  command
      .add_option("--input NAME=MAP", options.inputs, input_word(),
                  "Another input, such as coat_weight=coat.png or sheen_color=1,0.9,0.8 (for --from or --to "
                  "openpbr and standard-surface), occlusion=ao.png, which texremap puts unchanged into the "
                  "files of --layout, or metal_mask=mask.png, which decides between metallic values that "
                  "look alike; repeatable")
      ->tag(kChangesResults);
  command
      .add_option(
          "--roughness-encoding NAME", options.roughness_encoding, map_encoding(),
          "What roughness maps contain; roughness is the square root of alpha (default: the encoding of "
          "the source model); for glossiness, use --glossiness")
      ->tag(kChangesResults | kNotWithDiffuseWarp)
      ->excludes(command.option("--glossiness"));
  command
      .add_option(
          "--color-space NAME", options.color_spaces, color_spaces(),
          "How color maps are read: srgb or linear, or per map: specular=linear,diffuse=srgb (default: "
          "as the file states; otherwise srgb for integers and linear for half and float)")
      ->tag(kChangesResults | kNeedsFiles);
  command
      .add_flag("--resample", options.resample,
                "Enlarge smaller maps of a set to the largest size, bilinearly; put maps with different "
                "KHR_texture_transform onto one grid")
      ->common()
      ->tag(kForAssets | kChangesResults | kNeedsFiles);
  command
      .add_option("--prefer WORDS", options.prefer,
                  "If several maps fit one parameter, use the map of this role or with this word in its "
                  "name: gloss, arm, 4k, png; comma-separated, the first word that applies is used")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->tag(kChangesResults | kNeedsFolder);
  command.add_option("--names FILE", options.names, "More naming conventions for the maps in DIR (JSON)")
      ->tag(kChangesResults | kNeedsFolder);
}

constexpr std::array<std::pair<const char*, const char*>, 21> kNewNames = {{
    {"--fit", "--converters"},
    {"--occlusion", "--input (for example: --input occlusion=ao.png)"},
    {"--dither", "--type uint8-dithered"},
    {"--preset", "--to (for the packed files of glTF: --to gltf --layout gltf)"},
    {"--fold-specular", "--extensions fold"},
    {"--bake", "--resample"},

    {"--metal-mask", "--input (for example: --input metal_mask=mask.png)"},
    {"--from-workflow", "--from (for example: --from specular:mitsuba/ward)"},
    {"--to-workflow", "--to (for example: --to specular:mitsuba/ward)"},
    {"--mtl-from", "--from (for example: --from blender)"},
    {"--jpeg", "--compression (for example: --compression jpeg=90)"},

    {"--bad-texels", "--nan"},
    {"--prior", "--metallic-bias"},
    {"--output-roughness-factor", "--output-encoding (for example: --output-encoding exponent=1000)"},
    {"--exponent-of-white", "--output-encoding (for example: --output-encoding exponent=1000)"},
    {"--roughness-factor", "--factor (for example: --factor roughness=0.5)"},
    {"--glossiness-factor", "--factor (for example: --factor glossiness=0.5)"},
    {"--specular-factor", "--factor (for example: --factor specular=0.5)"},
    {"--diffuse-factor", "--factor (for example: --factor diffuse=0.5)"},
    {"--base-color-factor", "--factor (for example: --factor base_color=0.5)"},
    {"--metallic-factor", "--factor (for example: --factor metallic=0.5)"},
}};

void add_output_options(Command& command, ConvertOptions& options) {
  command.option_group("Rare: output");
  command
      .add_option(
          "-o,--output DIR", options.output,
          "Folder for the results, which keep the names of the inputs; for one asset, a file can be given")
      ->common()
      ->tag(kForAssets | kNeedsFiles);
  command
      .add_option("--layout NAME", options.layout, layout(),
                  "Files to write: the name of an engine, or a list such as "
                  "'Mask=metallic,occlusion,0,smoothness; Albedo=base_color' (default: as for --to)")
      ->tag(kChangesResults | kNeedsFiles);
  command.add_option("--format EXT", options.format, "File extension of the results: exr, tif, png, ...")
      ->tag(kForAssets | kChangesResults | kNeedsFiles);
  command
      .add_option("--type NAME", options.written_type, one_of(kWrittenTypes, "pixel type"),
                  "Pixel type of the results; uint8-dithered adds repeatable noise of half a step")
      ->tag(kChangesResults | kNeedsFiles);
  command
      .add_option("--compression LEVEL", options.compression, compression(),
                  "1 (fast) to 9 (small), for PNG, and for zip in EXR and TIFF (default: as the inputs, 6 in "
                  "new PNG files, 3 in assets). For glTF files also jpeg=QUALITY, from 1 to 100, or both as "
                  "9,jpeg=90: new color maps become JPEG if the old ones are JPEG without alpha")
      ->tag(kForAssets | kChangesResults | kNeedsFiles);
  command
      .add_option("--output-color-space NAME", options.output_color_spaces, color_spaces(),
                  "How colors are written: srgb or linear, or per map (default: integers like their input "
                  "map, or srgb if there is none; half and float are linear)")
      ->tag(kChangesResults | kNeedsFiles);
  command.add_option("--only NAME", options.only, one_of(kOnly, "parameter"), "Write only this parameter")
      ->tag(kChangesResults | kNeedsFiles | kNotWithWorkflow);
  command
      .add_flag("--only-converted", options.only_converted,
                "Write only converted maps, not normal, height, opacity and others")
      ->common()
      ->tag(kChangesResults | kNeedsFolder);
  command.retire("--compact",
                 "is no longer needed: texremap always removes unused images (remove this option; "
                 "--compression 9 makes new images as small as possible)");
  command.retire(
      "--allow-skips",
      "is no longer needed: texremap skips sets that have nothing to convert (remove this option)");
  command.retire("--resume", "is no longer needed: texremap skips what is done (remove this option)");
  command.retire(
      "--root", "was removed (give the folder before the assets: texremap convert FOLDER chair.gltf -o out)");
  command.retire("--diffuse-convention",
                 "was removed (write plain: or scaled: before the model: --from plain:gltf-specgloss)");
  command.retire("--histograms", "was removed (use --verbose together with --json)");
  command.retire("--instructions",
                 "was removed (set an environment variable instead: REMAP_INSTRUCTIONS=avx2)");
  command.retire("--profile",
                 "was removed (for --profile extensions, use --extensions write; core is the default)");
  for (const auto& [name, now] : kNewNames) command.retire(name, std::string("is now called ") + now);
  command.retire("--copy-others",
                 "is no longer needed: texremap copies all maps of a set (remove this option; "
                 "--only-converted writes only converted maps)");
  command.add_flag("--force", options.force, "Overwrite files that exist; convert again what is done")
      ->common()
      ->tag(kForAssets | kNeedsFiles);
  command.add_flag("--dry-run", options.dry_run, "Show what would happen to each map; write nothing")
      ->common()
      ->tag(kOfPlan | kForAssets | kNeedsFiles);
  command
      .add_flag("--json", options.json, "Print a report as JSON; for several sets or assets, one line each")
      ->common()
      ->tag(kOfPlan | kForAssets);
  command
      .add_option("--report FILE", options.report,
                  "Also write an HTML file that shows the first materials before and after")
      ->common()
      ->tag(kOfPlan | kForAssets | kNeedsFiles);
  Option* quiet = command.add_flag("--quiet", options.quiet, "Print nothing but errors to standard error")
                      ->tag(kForAssets);
  command
      .add_flag(
          "--verbose", options.verbose,
          "Print every warning, the converter, and also measures without a visible effect; with --json also "
          "histograms")
      ->tag(kForAssets | kNeedsFiles)
      ->excludes(quiet);
}

void add_workflow_options(Command& command, ConvertOptions& options) {
  command.option_group("Rare: whole materials (metallic and specular workflows)");
  command
      .add_option("--dielectric-f0 VALUE", options.dielectric_f0, f0_choice(),
                  "F0 of dielectrics: a number, or estimate to derive it from the maps (default: that of the "
                  "metallic model, 0.04)")
      ->tag(kChangesResults | kNeedsWorkflow | kNotWithWarp);
  command.option_group("Rare: how metallic is found");
  command
      .add_option("--metallic-bias VALUE", options.prior, prior(),
                  "How strongly 0 and 1 are preferred: clean (default), noisy (scans, JPEG) or a number "
                  "from 0 to 1")
      ->tag(kForAssets | kChangesResults | kNeedsMetallic);
}

void add_rare_options(Command& command, ConvertOptions& options) {
  command.option_group("Rare: encodings and factors");
  command
      .add_option(
          "--output-encoding NAME", options.output_roughness, written_roughness(),
          "What the roughness results contain (default: the same as the inputs if that is known, otherwise "
          "the parameter of the target model; a file named glossiness contains glossiness). exponent=1000: "
          "white means an exponent of 1000, as in MTL files; OpenGL has 128")
      ->tag(kChangesResults);
  command
      .add_option("--factor NAME=NUMBERS", options.factors, parameter_word(parse_factors),
                  "Multiply this input: roughness or glossiness before it is decoded, colors in linear light "
                  "by one number or three; repeatable")
      ->tag(kChangesResults | kNotWithDiffuseWarp);

  command.option_group("Rare: checks");
  command
      .add_option("--diagnose FOLDER", options.diagnose,
                  "Also write maps that check the result. mask: 1 where values are outside the measured "
                  "range. For metallic results also residual: what metal-rough cannot express (the visible "
                  "difference is 0.42 times this value); metallic_uncertainty: the length of the interval in "
                  "which metallic could lie (above 0.2, metallic is undetermined); issues: the sum of 1 "
                  "clamped, 2 ambiguous, 4 too dark, 8 undetermined")
      ->tag(kIsPath | kNeedsFiles);
  command
      .add_option(
          "--nan NAME", options.bad_texels, one_of(kBadTexels, "value"),
          "What to do with NaN, infinite and negative values; clamp moves all values into the measured range")
      ->default_text("keep")
      ->tag(kChangesResults);
  command.option_group("Rare: speed");
  command.add_option("--threads N", options.thread_count, "Number of threads; 0 for one per core")
      ->range(0, 1024)
      ->tag(kOfPlan | kForAssets);
  add_memory_option(command, options.memory_megabytes)->tag(kForAssets);
}

}  // namespace

std::uint64_t memory_limit(int megabytes) {
  constexpr std::uint64_t kMegabyte = std::uint64_t{1} << 20, kUnknown = std::uint64_t{8} << 30;
  if (megabytes > 0) return static_cast<std::uint64_t>(megabytes) * kMegabyte;
  const std::uint64_t machine = memory_size();
  return (machine > 0 ? machine : kUnknown) / 4;
}

Option* add_memory_option(Command& command, int& megabytes) {
  return command
      .add_option("--memory-limit MB", megabytes, "Memory that images may use at once in all threads")
      ->positive()
      ->default_text("a quarter of this machine's");
}

void choose_files(ConvertOptions& options) {
  const auto is_map = [](const auto& entry) {
    return entry.second && std::holds_alternative<MapName>(*entry.second);
  };
  const bool has_files = !options.folder.empty() || std::ranges::any_of(options.maps, is_map);
  if (options.layout) options.engine = engine_layout(options.layout->name);
  if (options.engine == nullptr && has_files) options.engine = engine_layout_of(options.to.word());
  if (options.engine == nullptr) return;
  if (!options.layout) options.layout = layout_from("--to", std::string(options.engine->name));
  if (options.format.empty()) options.format = options.engine->format;
  if (!options.type) options.type = options.engine->type;
}

std::optional<NormalGreen> normals_of(const ModelName& model) {
  constexpr std::array<std::string_view, 3> kOfNoTool = {"spec-gloss", "specgloss", "specular-glossiness"};
  constexpr std::array<std::string_view, 2> kUpwards = {"filament", "playcanvas"};
  constexpr std::array<std::string_view, 6> kUpwardModels = {"gltf",
                                                             "gltf-specgloss",
                                                             "cycles-5/principled",
                                                             "threejs/standard",
                                                             "usd-preview-surface",
                                                             "usd-preview-surface-specular"};
  if (const NamedLayout* engine = engine_layout_of(model.word())) return engine->normals;
  if (contains(kUpwards, model.word()) ||
      (contains(kUpwardModels, model.name) && !contains(kOfNoTool, model.word())))
    return NormalGreen::kUp;
  return std::nullopt;
}

int ConvertOptions::threads() const {
  return thread_count > 0 ? thread_count
                          : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void note_given(const Command& command, ConvertOptions& options) {
  options.given = command.given();
  constexpr const char* kVariable = "REMAP_INSTRUCTIONS";
  if (const char* name = std::getenv(kVariable))
    options.instructions = instruction_set_from_name(kVariable, name);
  if (options.written_type) options.type = pixel_type_of(*options.written_type);
  if (options.glossiness) options.maps[Parameter::kRoughness] = options.glossiness;
  for (const auto& [parameter, source] : options.inputs) {
    std::optional<MapSource>& map = options.maps[parameter];
    if (map)
      throw usage_error("--input " + plain_name(parameter) + ": is given twice (remove one of the two)");
    map = source;
  }
}

std::vector<float> ConvertOptions::factors_of(Parameter parameter) const {
  const auto found = std::ranges::find(factors, parameter, &ParameterWord<std::vector<float>>::parameter);
  return found == factors.end() ? std::vector<float>{} : found->value;
}

void add_convert_options(Command& command, ConvertOptions& options) {
  add_source_options(command, options);
  add_map_options(command, options);
  add_output_options(command, options);
  add_workflow_options(command, options);
  add_rare_options(command, options);
}

std::optional<MtlMaker> mtl_maker_of(const ConvertOptions& options) {
  return value_named(kMtlMakers, options.from.word());
}

void refuse(const ConvertOptions& options, OptionTags tag, const std::string& reason) {
  for (const GivenOption& option : options.given)
    if ((option.tags & tag) != 0) throw usage_error(option.name + reason);
}

std::string result_options_text(const ConvertOptions& options) {
  std::string text;
  const auto add = [&](const std::string& option) { text += (text.empty() ? "" : " ") + option; };
  for (const GivenOption& option : options.given)
    if ((option.tags & kChangesResults) != 0)
      add(option.name + (option.words.empty() ? "" : " " + joined(option.words, " ")));
  const auto add_workflow = [&](const std::string& option, const ModelName& model) {
    if (const std::string prefixes = prefixes_of(model); !prefixes.empty())
      add(option + " " + prefixes + model.name);
  };
  add_workflow("--from", options.from);
  add_workflow("--to", options.to);
  if (options.engine != nullptr) add("--layout " + std::string(options.engine->name));
  if (mtl_maker_of(options) || (!options.only_converted && normals_of(options.from)))
    add("--from " + std::string(options.from.word()));
  return text;
}

void say(const std::string& text) { print_message("texremap", text); }

}  // namespace remap
