// This file converts random texture sets (roles, encodings, formats, pixel types, naming conventions,
// layouts, workflows, factors) in every way that must agree: as a folder, as single maps, as packed files, as
// numbers, through the library, and by a resumed and a repeated run. It compares all results with closed
// forms that it computes itself, in doubles: equation (2) of Sztrajman et al. 2019 and its inverse on
// dielectrics and metals, and the paper's formula for Ward to GGX (appendix A, with its errata).
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"
#include "lower/fit_file.hpp"
#include "remap/convert_maps.hpp"
#include "remap/workflow.hpp"
#include "support/campaign.hpp"
#include "support/fitted_converter.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

using Color = std::array<double, 3>;

constexpr int kWide = 4, kHigh = 3, kTexels = kWide * kHigh;
constexpr int kSetsABatch = 10;

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(engine_); }
  bool chance(double share) { return between(0.0, 1.0) < share; }
  template <typename T>
  const T& one_of(const std::vector<T>& all) {
    return all[std::uniform_int_distribution<std::size_t>(0, all.size() - 1)(engine_)];
  }

 private:
  std::mt19937_64 engine_;
};

// A Material has the parameters of its workflow. `width` is the value of the map times its factor.
struct Material {
  Color base_color{}, diffuse{}, specular{};
  double metallic = 0.0, width = 0.0;
};

enum class Kind { kBrdf, kMetallic, kSpecular };

struct Model {
  std::string name;
  Kind kind;
  // whether diffuse is scaled by 1 - specular; empty if the model does not define it
  std::optional<bool> scaled;
};

const Model kWard{"mitsuba/ward", Kind::kBrdf, {}};
const std::vector<Model> kModels = {{"gltf", Kind::kMetallic, true},
                                    {"usd-preview-surface", Kind::kMetallic, {}},
                                    {"metallic", Kind::kMetallic, {}},
                                    {"gltf-specgloss", Kind::kSpecular, true},
                                    {"specular", Kind::kSpecular, {}}};
const std::string kPaperFit = REMAP_SOURCE_DIR "/fits/mitsuba_ward_to_mitsuba_ggx_sztrajman_2019.json";

constexpr double kF0 = 0.04;

// A Batch holds what all its sets have in common.
struct Batch {
  Model from, to;
  std::string layout;  // empty: the default
  std::string format, type;
  std::string encoding;  // --roughness-encoding; empty: the model's encoding
  double width_factor = 1.0, specular_factor = 1.0;
  std::optional<bool> output_srgb;  // --output-color-space

  bool is_scaled(const Model& model) const {
    return model.scaled.value_or(from.scaled.value_or(to.scaled.value_or(false)));
  }
  std::string actual_layout() const {
    if (!layout.empty()) return layout;
    return from.kind == to.kind ? "as-inputs" : "separate";
  }
  Words words() const {
    Words all;
    if (from.kind == Kind::kBrdf)
      all = "--converters " + kPaperFit;
    else
      all = "--from " + from.name + " --to " + to.name;
    const auto add = [&](const std::string& option, const std::string& value) {
      if (!value.empty()) all.insert(all.end(), {option, value});
    };
    add("--layout", layout);
    add("--format", format);
    add("--type", type);
    add("--roughness-encoding", encoding);
    if (width_factor != 1.0) add("--factor", "roughness=" + std::to_string(width_factor));
    if (specular_factor != 1.0) add("--factor", "specular=" + std::to_string(specular_factor));
    if (output_srgb) add("--output-color-space", *output_srgb ? "srgb" : "linear");
    return all;
  }
};

// A File is a file of a set: the word of its name, its format, and what each of its channels holds.
struct File {
  std::string word, extension;
  OIIO::TypeDesc type;
  std::vector<std::string> channels, roles;  // "base_color.0", "roughness", "glossiness", "metallic", ...
};

struct Set {
  std::string name;
  std::vector<File> files;
  std::vector<Material> materials;  // values that the files store, linear, before the specular factor
  bool is_glossy = false;
  std::string width_file, width_channel;
};

// --- The closed forms follow.

double to_roughness(const std::string& encoding, double value) {
  if (encoding == "glossiness") return 1.0 - value;
  if (encoding == "alpha") return std::sqrt(value);
  if (encoding == "squared") return std::sqrt(std::sqrt(value));
  return value;
}
double from_roughness(const std::string& encoding, double roughness) {
  if (encoding == "glossiness") return 1.0 - roughness;
  if (encoding == "alpha") return roughness * roughness;
  if (encoding == "squared") return std::pow(roughness, 4.0);
  return roughness;
}

// Returns the encoding of the width maps of a set.
std::string source_encoding(const Batch& batch, const Set& set) {
  if (set.is_glossy) return "glossiness";
  if (!batch.encoding.empty()) return batch.encoding;
  return batch.from.kind == Kind::kBrdf ? "alpha" : "roughness";
}

// Returns the encoding of the results' width maps, which their names must show.
std::string target_encoding(const Batch& batch, const Set& set) {
  const std::string layout = batch.actual_layout();
  if (layout == "specgloss") return "glossiness";
  if (layout == "as-inputs" && set.is_glossy) return "glossiness";
  std::string usual = "roughness";
  if (batch.from.kind == Kind::kBrdf)
    usual = set.is_glossy || !batch.encoding.empty() ? source_encoding(batch, set) : "alpha";
  if (batch.to.name == "gltf-specgloss" && layout == "separate") usual = "glossiness";
  return usual == "glossiness" && layout == "orm" ? "roughness" : usual;
}

double largest(const Color& color) { return *std::max_element(color.begin(), color.end()); }

Material to_metallic(const Material& given, bool source_scaled, bool target_scaled) {
  Material made;
  made.metallic = largest(given.diffuse) == 0.0 ? 1.0 : 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double reflectance = given.diffuse[c] * (source_scaled ? 1.0 - kF0 : 1.0);
    made.base_color[c] =
        made.metallic == 1.0 ? given.specular[c] : reflectance / (target_scaled ? 1.0 - kF0 : 1.0);
  }
  return made;
}

Material to_specular(const Material& given, bool source_scaled, bool target_scaled) {
  Material made;
  const double n = 1.0 - given.metallic;
  for (std::size_t c = 0; c < 3; ++c) made.specular[c] = kF0 * n + given.base_color[c] * given.metallic;
  for (std::size_t c = 0; c < 3; ++c) {
    const double reflectance = given.base_color[c] * n * (source_scaled ? 1.0 - kF0 : 1.0);
    made.diffuse[c] = target_scaled ? reflectance / (1.0 - largest(made.specular)) : reflectance;
  }
  return made;
}

// Converts Ward to GGX by appendix A of Sztrajman et al. 2019.
Material by_paper(const Material& given, double roughness) {
  const double a = std::clamp(roughness * roughness, 0.01, 1.0);
  Material made;
  made.width = std::sqrt(((0.108 * a + 0.102) * a - 0.766) * a * a + 1.135 * a);
  const double k = -944.0 + 944.82 * std::exp(-0.00046 * a) + 0.476 * std::exp(-4.786 * a * a);
  for (std::size_t c = 0; c < 3; ++c) made.specular[c] = k * given.specular[c];
  return made;
}

// Returns the expected result, in linear values. Its `width` is roughness.
Material expected(const Batch& batch, const Set& set, Material given) {
  const double roughness =
      std::clamp(to_roughness(source_encoding(batch, set), given.width * batch.width_factor), 0.0, 1.0);
  for (double& value : given.specular) value *= batch.specular_factor;
  if (batch.from.kind == Kind::kBrdf) return by_paper(given, roughness);
  const bool source = batch.is_scaled(batch.from), target = batch.is_scaled(batch.to);
  Material made = given;
  if (batch.from.kind == Kind::kMetallic && batch.to.kind == Kind::kSpecular)
    made = to_specular(given, source, target);
  if (batch.from.kind == Kind::kSpecular && batch.to.kind == Kind::kMetallic)
    made = to_metallic(given, source, target);
  made.width = roughness;
  return made;
}

// --- The random draws follow.

bool holds_color(const std::string& role) {
  return role.starts_with("base_color") || role.starts_with("diffuse") || role.starts_with("specular");
}

double& parameter(Material& material, const std::string& role) {
  const std::size_t c =
      role.back() >= '0' && role.back() <= '2' ? static_cast<std::size_t>(role.back() - '0') : 0;
  if (role.starts_with("base_color")) return material.base_color[c];
  if (role.starts_with("diffuse")) return material.diffuse[c];
  if (role.starts_with("specular")) return material.specular[c];
  return role == "metallic" ? material.metallic : material.width;
}

struct Format {
  std::string extension;
  OIIO::TypeDesc type;
};

Format draw_format(Dice& dice, bool needs_alpha, bool is_grey) {
  std::vector<Format> all = {{"png", OIIO::TypeUInt8}, {"png", OIIO::TypeUInt16}, {"tga", OIIO::TypeUInt8},
                             {"tif", OIIO::TypeUInt8}, {"tif", OIIO::TypeUInt16}, {"tif", OIIO::TypeFloat},
                             {"exr", OIIO::TypeHalf},  {"exr", OIIO::TypeFloat}};
  if (!needs_alpha) all.insert(all.end(), {{"bmp", OIIO::TypeUInt8}, {"jpg", OIIO::TypeUInt8}});
  if (!needs_alpha && !is_grey) all.push_back({"hdr", OIIO::TypeFloat});
  return dice.one_of(all);
}

// Draws the files of a set, named by one of the conventions, and what they hold.
void draw_files(Dice& dice, const Batch& batch, Set& set) {
  const auto add = [&](const std::string& word, const Words& roles, bool needs_alpha = false) {
    Words channels = {"R", "G", "B", "A"};
    channels.resize(roles.size());
    if (roles.size() == 1) channels = {"Y"};
    const Format format = draw_format(dice, needs_alpha, roles.size() == 1);
    set.files.push_back({word, format.extension, format.type, channels, roles});
  };
  const auto color = [](const std::string& name) { return Words{name + ".0", name + ".1", name + ".2"}; };
  const auto with = [](Words words, const std::string& last) {
    words.push_back(last);
    return words;
  };
  const bool keeps_files = batch.actual_layout() == "as-inputs";
  if (batch.from.kind == Kind::kMetallic) {
    add(dice.one_of<std::string>({"BaseColor", "Albedo", "base_color"}), color("base_color"));
    const double way = dice.between(0.0, 1.0);
    if (way < 0.25) {
      add("OcclusionRoughnessMetallic", {"occlusion", "roughness", "metallic"});
    } else if (way < 0.5) {
      add("MetallicSmoothness", {"metallic", "metallic", "metallic", "glossiness"}, true);
    } else if (way < 0.6 && keeps_files) {
      add("MaskMap", {"metallic", "occlusion", "other", "glossiness"}, true);
    } else {
      add(dice.one_of<std::string>({"Metallic", "Metalness"}), {"metallic"});
      const bool glossy = dice.chance(0.5);
      add(glossy ? dice.one_of<std::string>({"Glossiness", "Smoothness", "gloss"})
                 : dice.one_of<std::string>({"Roughness", "rough"}),
          {glossy ? "glossiness" : "roughness"});
    }
  } else {
    if (batch.from.kind == Kind::kSpecular)
      add(dice.one_of<std::string>({"Diffuse", "diff"}), color("diffuse"));
    if (dice.chance(0.4)) {
      add(dice.one_of<std::string>({"SpecularGlossiness", "SpecularSmoothness"}),
          with(color("specular"), "glossiness"), true);
    } else {
      add(dice.one_of<std::string>({"Specular", "spec", "specularColor"}), color("specular"));
      const bool glossy = dice.chance(0.5);
      add(glossy ? dice.one_of<std::string>({"Glossiness", "Smoothness"})
                 : dice.one_of<std::string>({"Roughness", "rough"}),
          {glossy ? "glossiness" : "roughness"});
    }
  }
  for (const File& file : set.files)
    for (std::size_t i = 0; i < file.roles.size(); ++i)
      if (file.roles[i] == "roughness" || file.roles[i] == "glossiness") {
        set.is_glossy = file.roles[i] == "glossiness";
        set.width_file = set.name + "_" + file.word + "." + file.extension;
        set.width_channel = file.channels[i];
      }
}

// Draws materials that both models can express. Sets in lossy formats have the same material in all texels.
std::vector<Material> draw_materials(Dice& dice, const Batch& batch, const Set& set) {
  const bool is_flat = std::any_of(set.files.begin(), set.files.end(), [](const File& file) {
    return file.extension == "jpg" || file.extension == "hdr";
  });
  const bool is_to_metallic = batch.to.kind == Kind::kMetallic;
  std::vector<Material> materials;
  for (int i = 0; i < kTexels; ++i) {
    Material material;
    const bool is_metal = dice.chance(0.5);
    material.metallic = is_to_metallic || dice.chance(0.5) ? (is_metal ? 1.0 : 0.0) : dice.between(0.0, 1.0);
    material.width = dice.between(0.15, 0.9);
    for (std::size_t c = 0; c < 3; ++c) {
      material.base_color[c] = dice.between(0.15, 0.9);
      material.diffuse[c] = dice.between(0.15, 0.9);
      material.specular[c] = dice.between(0.1, 0.55);
      if (batch.from.kind == Kind::kSpecular && is_to_metallic) {
        material.diffuse[c] = is_metal ? 0.0 : material.diffuse[c];
        material.specular[c] = is_metal ? dice.between(0.2, 0.9) : kF0;
      }
    }
    materials.push_back(is_flat && i > 0 ? materials.front() : material);
  }
  return materials;
}

// Writes the files, and sets `materials` to the values that they really store.
void write_set(const Session& tree, const std::string& folder, Set& set) {
  fs::create_directories(tree.path(folder));
  for (const File& file : set.files) {
    const fs::path path = tree.path(folder + "/" + set.name + "_" + file.word + "." + file.extension);
    const auto texel = [&](int x, int y, int channel) {
      const std::string& role = file.roles[static_cast<std::size_t>(channel)];
      if (role == "occlusion" || role == "other") return 0.75f;
      const double value = parameter(set.materials[static_cast<std::size_t>(y * kWide + x)], role);
      return static_cast<float>(holds_color(role) && is_whole(file.type) ? linear_to_srgb(value) : value);
    };
    write_image(path, test_spec(kWide, kHigh, file.channels, file.type), texel);
    const TestImage stored = read_image(path);
    for (std::size_t channel = 0; channel < file.roles.size(); ++channel) {
      const std::string& role = file.roles[channel];
      if (role == "occlusion" || role == "other") continue;
      const int read = stored.spec.nchannels == 1 ? 0 : static_cast<int>(channel);
      for (int i = 0; i < kTexels; ++i) {
        const double value = static_cast<double>(stored.at(i % kWide, i / kWide, read));
        parameter(set.materials[static_cast<std::size_t>(i)], role) =
            holds_color(role) && is_whole(file.type) ? srgb_to_linear(value) : value;
      }
    }
  }
}

Batch draw_batch(Dice& dice) {
  Batch batch;
  if (dice.chance(0.2)) {
    batch.from = kWard;
    batch.to = {"mitsuba/ggx", Kind::kBrdf, {}};
    batch.layout = dice.one_of<std::string>({"", "as-inputs", "separate", "orm", "specgloss"});
  } else {
    batch.from = dice.one_of(kModels);
    do batch.to = dice.one_of(kModels);
    while (batch.to.name == batch.from.name);
    const std::string packed = batch.to.kind == Kind::kMetallic ? "orm" : "specgloss";
    batch.layout = dice.one_of<std::string>({"", "separate", packed});
  }
  struct Output {
    std::string format, type;
  };
  const std::vector<Output> outputs = {
      {"png", "uint8"}, {"png", "uint16"}, {"tif", "uint8"}, {"tif", "uint16"}, {"tif", "float"},
      {"exr", "half"},  {"exr", "float"},  {"tga", "uint8"}, {"png", ""},       {"tif", ""}};
  // Packed results need alpha, which some formats of the inputs lack.
  if (batch.layout == "orm" || batch.layout == "specgloss" || dice.chance(0.5)) {
    const Output output = dice.one_of(outputs);
    batch.format = output.format;
    // The pixel type is chosen, because the inputs of a packed file may have different types.
    batch.type = output.type;
  }
  if (dice.chance(0.3)) batch.encoding = dice.one_of<std::string>({"roughness", "alpha", "squared"});
  if (dice.chance(0.3)) batch.width_factor = 0.5 + 0.125 * std::floor(dice.between(0.0, 4.0));
  const bool has_specular = batch.from.kind != Kind::kMetallic && batch.to.kind != Kind::kMetallic;
  if (has_specular && dice.chance(0.3)) batch.specular_factor = 0.75;
  if (dice.chance(0.2)) batch.output_srgb = dice.chance(0.5);
  return batch;
}

// --- The checks follow.

// A Place is the file and the channels that hold a target parameter, as the report of a set states.
struct Place {
  TestImage image;
  std::string path;
  std::vector<int> channels;
};

Place place_of(const nlohmann::json& report, const Batch& batch, const Set& set, const std::string& name) {
  Place place;
  REQUIRE(report.at(name).is_string());
  place.path = report.at(name).get<std::string>();
  place.image = read_image(place.path);
  const bool is_width = name == "roughness", is_color_role = name != "roughness" && name != "metallic";
  const std::string layout = batch.actual_layout();
  const auto channel = [&](const std::string& of) { return std::max(place.image.channel(of), 0); };
  if (is_color_role) {
    place.channels = {channel("R"), channel("G"), channel("B")};
    if (place.image.spec.nchannels < 3) place.channels = {0, 0, 0};
  } else if (layout == "orm") {
    place.channels = {channel(is_width ? "G" : "B")};
  } else if (layout == "specgloss") {
    place.channels = {channel("A")};
  } else if (layout == "as-inputs" && is_width) {
    place.channels = {channel(set.width_channel)};
  } else if (layout == "as-inputs") {
    for (const File& file : set.files)
      for (std::size_t c = 0; c < file.roles.size(); ++c)
        if (file.roles[c] == "metallic") place.channels = {channel(file.channels[c])};
  } else {
    place.channels = {0};
  }
  return place;
}

bool is_color_stored_as(const Batch& batch, const Place& place) {
  return batch.output_srgb.value_or(is_whole(place.image.spec.format));
}

// Returns the permitted difference: a step of the file, and the errors of polynomials, projection and
// factors.
double allowed(const Place& place, double expected) {
  const OIIO::TypeDesc type = place.image.spec.format;
  const std::string extension = fs::path(place.path).extension().string();
  if (extension == ".jpg") return 4.0 / 255.0;
  // Three values share an exponent, so a step is 1/256 if the largest value is 0.5 to 1.
  if (extension == ".hdr") return 1.0 / 256.0 + 0.012 * std::max(expected, 0.3);
  const double own = 1.5e-3;
  if (type == OIIO::TypeUInt8) return 1.01 / 255.0 + 0.5 * own;
  if (type == OIIO::TypeUInt16) return 1.01 / 65535.0 + own;
  if (type == OIIO::TypeHalf) return 1e-3 * expected + own;
  return own;
}

void check_value(const Place& place, int channel, int texel, double expected) {
  const double found = static_cast<double>(place.image.at(texel % kWide, texel / kWide, channel));
  const double clipped = is_whole(place.image.spec.format) ? std::clamp(expected, 0.0, 1.0) : expected;
  INFO(place.path << " channel " << channel << " texel " << texel << ": " << found << ", expected "
                  << clipped);
  REQUIRE(std::fabs(found - clipped) <= allowed(place, clipped));
}

Words targets_of(const Model& model) {
  if (model.kind == Kind::kMetallic) return {"roughness", "base_color", "metallic"};
  if (model.kind == Kind::kSpecular) return {"roughness", "specular", "diffuse"};
  return {"roughness", "specular"};
}

void check_set(const nlohmann::json& report, const Batch& batch, const Set& set) {
  const std::string encoding = target_encoding(batch, set);
  for (const std::string& name : targets_of(batch.to)) {
    const Place place = place_of(report, batch, set, name);
    const std::string extension = fs::path(place.path).extension().string();
    const bool is_color_role = name != "roughness" && name != "metallic";
    // glTF viewers expect a PNG without a gamma of 1.
    if (extension == ".png" && !(batch.output_srgb && !*batch.output_srgb))
      CHECK(place.image.spec.get_string_attribute("oiio:ColorSpace") != "Linear");
    if (name == "roughness" && batch.actual_layout() == "separate")
      CHECK(fs::path(place.path).stem().string() ==
            set.name + (encoding == "glossiness" ? "_glossiness" : "_roughness"));
    for (int i = 0; i < kTexels; ++i) {
      Material wanted = expected(batch, set, set.materials[static_cast<std::size_t>(i)]);
      if (!is_color_role) {
        const double value = name == "metallic" ? wanted.metallic : from_roughness(encoding, wanted.width);
        check_value(place, place.channels.front(), i, value);
        continue;
      }
      for (std::size_t c = 0; c < 3; ++c) {
        const double linear = parameter(wanted, name + "." + std::to_string(c));
        check_value(place, place.channels[c], i,
                    is_color_stored_as(batch, place) ? linear_to_srgb(linear) : linear);
      }
    }
  }
}

// --- The ways to convert follow.

ProcessResult run_batch(const Session& tree, const Batch& batch, const std::string& out,
                        const Words& more = {}) {
  return require_success(tree.texremap("convert in --json -o " + tree.path(out) + batch.words() + more));
}

// Converts the maps of a set as single options.
void check_single(const Session& tree, const Batch& batch, const Set& set, const nlohmann::json& report) {
  Words words = "convert --json -o " + tree.path("single") + batch.words();
  std::map<std::string, std::string> maps;  // keyed by role
  for (const File& file : set.files) {
    const std::string path = tree.path("in/" + set.name + "_" + file.word + "." + file.extension);
    for (std::size_t c = 0; c < file.roles.size(); ++c) {
      const std::string role = file.roles[c].substr(0, file.roles[c].find('.'));
      const bool is_whole_file = file.roles.size() == 1 || (holds_color(role) && file.roles.size() == 3);
      std::string& map = maps[role];
      if (is_whole_file || (role == "metallic" && file.roles.size() == 4))
        map = is_whole_file ? path : path + ":R,G,B";
      else if (holds_color(role))
        map = path;
      else
        map = path + ":" + file.channels[c];
    }
  }
  if (set.files.back().word == "MaskMap") maps["metallic"] = tree.path("in/" + set.width_file) + ":R";
  maps.erase("other");
  if (batch.actual_layout() == "as-inputs") maps.erase("occlusion");
  for (const auto& [role, map] : maps) {
    if (role == "occlusion")
      words.insert(words.end(), {"--input", "occlusion=" + map});
    else
      words.insert(words.end(), {role == "base_color" ? "--base-color" : "--" + role, map});
  }
  if (set.is_glossy) {  // this option is only for maps of roughness
    const auto encoding = std::find(words.begin(), words.end(), "--roughness-encoding");
    if (encoding != words.end()) words.erase(encoding, encoding + 2);
  }
  const ProcessResult result = require_success(tree.texremap(words));
  const auto single = nlohmann::json::parse(result.output);
  for (const std::string& name : targets_of(batch.to)) {
    const TestImage a = read_image(single.at(name).get<std::string>()),
                    b = read_image(report.at(name).get<std::string>());
    INFO(single.at(name) << " and " << report.at(name));
    CHECK(a.bytes == b.bytes);
  }
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}
std::string numbers(const Color& color) {
  return number(color[0]) + "," + number(color[1]) + "," + number(color[2]);
}

// Converts the numbers of one texel instead of maps.
void check_numbers(const Session& tree, const Batch& batch, const Set& set) {
  const Material& given = set.materials.front();
  Words words = "convert --json";
  if (batch.from.kind == Kind::kBrdf)
    words += "--converters " + kPaperFit;
  else
    words += "--from " + batch.from.name + " --to " + batch.to.name;
  words.insert(words.end(),
               {set.is_glossy ? "--glossiness" : "--roughness", number(given.width * batch.width_factor)});
  if (!set.is_glossy && !batch.encoding.empty()) words += "--roughness-encoding " + batch.encoding;
  if (batch.from.kind == Kind::kMetallic)
    words += "--base-color " + numbers(given.base_color) + " --metallic " + number(given.metallic);
  else
    words += "--specular " + numbers(given.specular) + " --factor specular=" + number(batch.specular_factor);
  if (batch.from.kind == Kind::kSpecular) words += "--diffuse " + numbers(given.diffuse);
  const ProcessResult result = require_success(tree.texremap(words));
  const auto values = nlohmann::json::parse(result.output).at("values");
  Material wanted = expected(batch, set, given);
  for (const std::string& name : targets_of(batch.to)) {
    if (name == "roughness") continue;  // its encoding depends on the name that is printed
    if (name == "metallic") {
      CHECK(values.at(name).get<double>() == Approx(wanted.metallic).margin(2e-3));
      continue;
    }
    const std::string printed = values.contains(name) ? name : "f0";
    for (std::size_t c = 0; c < 3; ++c)
      CHECK(values.at(printed).at(c).get<double>() ==
            Approx(parameter(wanted, name + "." + std::to_string(c))).margin(2e-3));
  }
  for (const char* encoding : {"roughness", "glossiness", "alpha", "squared"})
    if (values.contains(encoding))
      CHECK(values.at(encoding).get<double>() == Approx(from_roughness(encoding, wanted.width)).margin(2e-3));
}

WorkflowEnd end_of(const Batch& batch, const Model& model) {
  WorkflowEnd end = find_workflow_model(model.name)->end;
  const DiffuseConvention diffuse =
      batch.is_scaled(model) ? DiffuseConvention::kScaled : DiffuseConvention::kPlain;
  std::visit([&](auto& workflow) { workflow.diffuse = diffuse; }, end);
  return end;
}

// Converts by the library, on floats in memory.
void check_library(const Batch& batch, const Set& set) {
  static const std::unique_ptr<Converter> paper = make_lowered_converter(load_fit(kPaperFit));
  std::unique_ptr<Converter> workflow;
  if (batch.from.kind != Kind::kBrdf)
    workflow = make_workflow_converter({end_of(batch, batch.from), end_of(batch, batch.to)});
  const Converter& converter = workflow ? *workflow : *paper;
  std::map<std::string, std::vector<float>> rows;
  MapConversion maps;
  maps.width = kTexels;
  maps.height = 1;
  const std::map<Parameter, std::string> names = {{Parameter::kRoughness, "width"},
                                                  {Parameter::kSpecular, "specular"},
                                                  {Parameter::kDiffuse, "diffuse"},
                                                  {Parameter::kBaseColor, "base_color"},
                                                  {Parameter::kMetallic, "metallic"}};
  const auto row_name = [&](Parameter p, std::size_t c) {
    return names.at(p) + (is_color(p) ? "." + std::to_string(c) : "");
  };
  for (const Parameter p : converter.sources())
    for (std::size_t c = 0; c < (is_color(p) ? 3u : 1u); ++c) {
      std::vector<float>& row = rows["in " + row_name(p, c)];
      for (Material material : set.materials)
        row.push_back(static_cast<float>(parameter(material, row_name(p, c))));
      maps.sources[p].channels.push_back(float_channel(std::as_const(row).data(), kTexels));
      if (p == Parameter::kRoughness) maps.sources[p].factors = {static_cast<float>(batch.width_factor)};
      if (p == Parameter::kSpecular) maps.sources[p].factors = {static_cast<float>(batch.specular_factor)};
    }
  for (const Parameter p : converter.targets()) {
    if (!names.contains(p)) continue;
    for (std::size_t c = 0; c < (is_color(p) ? 3u : 1u); ++c) {
      std::vector<float>& row = rows["out " + row_name(p, c)];
      row.resize(kTexels);
      maps.targets[p].channels.push_back(float_channel(row.data(), kTexels));
    }
  }
  maps.source_convention = encoding_from_name(source_encoding(batch, set));
  maps.target_convention = RoughnessEncoding::kRoughness;
  convert_maps(converter, maps);
  for (const Parameter p : converter.targets()) {
    if (!names.contains(p)) continue;
    for (std::size_t c = 0; c < (is_color(p) ? 3u : 1u); ++c)
      for (int i = 0; i < kTexels; ++i) {
        Material wanted = expected(batch, set, set.materials[static_cast<std::size_t>(i)]);
        CHECK(rows["out " + row_name(p, c)][static_cast<std::size_t>(i)] ==
              Approx(parameter(wanted, row_name(p, c))).margin(2e-3));
      }
  }
}

// A resumed run changes nothing except damaged results and results of changed inputs, which it makes again.
void check_resumed(const Session& tree, const Batch& batch, std::vector<Set>& sets, Dice& dice) {
  const auto resumed = [&] { return run_batch(tree, batch, "out", "").output; };
  const auto before = tree.contents("out");
  CHECK(set_states(resumed()) == std::string(sets.size(), 'd'));
  CHECK(tree.contents("out") == before);

  const auto& damaged =
      std::next(before.begin(),
                static_cast<std::ptrdiff_t>(dice.between(0.0, 0.999) * static_cast<double>(before.size())))
          ->first;
  fs::resize_file(tree.path("out/" + damaged), fs::file_size(tree.path("out/" + damaged)) / 2);
  Set& changed = sets.back();
  changed.materials = draw_materials(dice, batch, changed);
  write_set(tree, "in", changed);
  const std::string letters = set_states(resumed());
  CHECK(letters.back() == 'c');
  CHECK(std::count(letters.begin(), letters.end(), 'c') == (damaged.starts_with(changed.name + "_") ? 1 : 2));
  run_batch(tree, batch, "fresh");
  CHECK(tree.contents("out") == tree.contents("fresh"));
}

void check_batch(std::uint64_t seed) {
  Dice dice(seed);
  const Batch batch = draw_batch(dice);
  const Session tree;
  std::vector<Set> sets;
  for (int i = 0; i < kSetsABatch; ++i) {
    Set set;
    set.name = std::string("set") + static_cast<char>('a' + i);
    draw_files(dice, batch, set);
    set.materials = draw_materials(dice, batch, set);
    write_set(tree, "in", set);
    sets.push_back(std::move(set));
  }
  // If all sets are glossy, no map has roughness, so texremap would refuse --roughness-encoding.
  Batch used = batch;
  if (std::all_of(sets.begin(), sets.end(), [](const Set& set) { return set.is_glossy; }))
    used.encoding.clear();
  std::string words;
  for (const std::string& word : used.words()) words += word + " ";
  INFO("seed " << seed << ": " << words);
  const auto report = tree_report(run_batch(tree, used, "out").output);
  REQUIRE(report["sets"].size() == sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    check_set(report["sets"][i], used, sets[i]);
    check_library(used, sets[i]);
  }
  const std::size_t one = static_cast<std::size_t>(dice.between(0.0, kSetsABatch - 0.001));
  check_single(tree, used, sets[one], report["sets"][one]);
  check_numbers(tree, used, sets[one]);
  check_resumed(tree, used, sets, dice);
}

}  // namespace

TEST_CASE("texremap properties: random sets by every path give what closed forms give", "[slow][campaign]") {
  const int batches = is_full_campaign() && !kSlowBuild ? 1000 : kSlowBuild ? 5 : 30;
  for (int i = 0; i < batches; ++i) check_batch(static_cast<std::uint64_t>(i) + 1);
}
