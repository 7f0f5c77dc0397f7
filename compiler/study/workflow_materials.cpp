#include "study/workflow_materials.hpp"

#include <algorithm>
#include <array>
#include <random>

#include "core/files.hpp"
#include "core/json_field.hpp"
#include "core/number_text.hpp"
#include "remap/error.hpp"
#include "renderer/fresnel.hpp"
#include "renderer/image_similarity.hpp"

namespace remap {
namespace {

namespace fs = std::filesystem;

// std::uniform_real_distribution and std::shuffle differ between standard libraries, so they are not used.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : generator_(seed) {}
  double share() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + share() * (high - low); }
  Rgb color(double low, double high) {
    Rgb rgb{};
    for (double& value : rgb) value = between(low, high);
    return rgb;
  }
  // A linear color whose display values are uniform in this range, independently for each channel.
  Rgb display_color(double low, double high) {
    Rgb rgb{};
    for (double& value : rgb) value = linear_of_display(between(low, high));
    return rgb;
  }
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(share() * static_cast<double>(count));
  }
  template <typename Values>
  void shuffle(Values& values) {
    for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[below(i)]);
  }

 private:
  std::mt19937_64 generator_;
};

double largest(const Rgb& rgb) { return std::max({rgb[0], rgb[1], rgb[2]}); }

Rgb dimmed(Rgb rgb, double factor) {
  for (double& value : rgb) value *= factor;
  return rgb;
}

// Scales diffuse to the energy that the specular lobe leaves.
Reflectances reflecting(const Rgb& diffuse, const Rgb& f0) {
  return {dimmed(diffuse, 1.0 - largest(f0)), f0};
}

// Colors are uniform in display values, like colors from a color picker.
Reflectances random_surface(Draw& draw) {
  const Rgb diffuse = draw.display_color(0.0, 0.9);
  return {diffuse, draw.display_color(0.0, 0.9)};
}

Reflectances plastic_surface(Draw& draw) {
  const double f0 = draw.between(0.02, 0.12);
  return reflecting(draw.display_color(0.1, 1.0), {f0, f0, f0});
}

Reflectances paint_surface(Draw& draw) {
  const Rgb diffuse = draw.display_color(0.0, 0.9);
  return reflecting(diffuse, draw.display_color(0.1, 0.6));
}

struct NamedSurface {
  std::string name;
  Reflectances surface;
  bool is_metal = false;
};

// Reads the next `albedo = [R, G, B]` of a line from `from`, and moves `from` behind it.
Rgb next_albedo(const std::string& line, const std::string& place, std::size_t* from) {
  constexpr std::string_view kOpening = "albedo = [";
  const std::size_t open = line.find(kOpening, *from), close = line.find(']', *from);
  std::vector<double> values;
  if (open != std::string::npos && close != std::string::npos && open < close) {
    std::string_view text =
        std::string_view(line).substr(open + kOpening.size(), close - open - kOpening.size());
    while (!text.empty()) {
      std::string_view cell = text.substr(0, text.find(','));
      text.remove_prefix(std::min(text.size(), cell.size() + 1));
      cell.remove_prefix(std::min(cell.size(), cell.find_first_not_of(' ')));
      if (const auto number = parse_number(cell)) values.push_back(std::clamp(*number, 0.0, 1.0));
    }
  }
  if (values.size() != 3)
    throw Error(ErrorKind::kInput,
                place +
                    ": cannot find two albedos of three numbers (the format is NAME = Aggregate(Lambertian("
                    "albedo = [R, G, B]), NganWard(albedo = [R, G, B], ...)))");
  *from = close + 1;
  return {values[0], values[1], values[2]};
}

std::vector<NamedSurface> ngan_surfaces(const fs::path& path) {
  std::vector<NamedSurface> surfaces;
  const std::string text = read_file(path);
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    const std::string place = path.string() + ":" + std::to_string(++number);
    begin = end + 1;
    if (line.empty() || line.front() == '#') continue;
    std::size_t from = 0;
    const Rgb diffuse = next_albedo(line, place, &from);
    const Rgb f0 = next_albedo(line, place, &from);
    surfaces.push_back({line.substr(0, line.find(' ')), {diffuse, f0}});
  }
  return surfaces;
}

Rgb linear_color(const Field& item) {
  for (const Field& entry : item["color"].list(1, [](const Field& each) { return each; }))
    if (entry["colorSpace"].text() == "srgb-linear") {
      Rgb rgb{};
      for (std::size_t c = 0; c < 3; ++c) rgb[c] = std::clamp(entry["color"].at(c, 3).number(), 0.0, 1.0);
      return rgb;
    }
  item["color"].fail("has no entry with color space srgb-linear");
}

std::vector<NamedSurface> database_surfaces(const fs::path& path) {
  const Json json = parse_json(read_file(path), path.string());
  return Field(json, path.string())["data"].list(1, [](const Field& item) {
    const std::string name = item["name"].text();
    const Rgb color = linear_color(item);
    if (item["metalness"].number() > 0.5) return NamedSurface{name, {{}, color}, true};
    const double f0 = normal_reflectance(item["ior"].number());
    return NamedSurface{name, {color, {f0, f0, f0}}, false};
  });
}

// A surface that is partly metal, for example dusty or worn metal, or paint with metal flakes.
NamedSurface mixture(const NamedSurface& dielectric, const NamedSurface& metal, double share) {
  NamedSurface mixed{dielectric.name + " on " + metal.name, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    mixed.surface.diffuse[c] = (1.0 - share) * dielectric.surface.diffuse[c];
    mixed.surface.f0[c] = (1.0 - share) * dielectric.surface.f0[c] + share * metal.surface.f0[c];
  }
  return mixed;
}

std::vector<NamedSurface> with_mixtures(std::vector<NamedSurface> all, Draw& draw) {
  draw.shuffle(all);
  std::vector<NamedSurface> dielectrics, metals, mixed;
  for (const NamedSurface& one : all) (one.is_metal ? metals : dielectrics).push_back(one);
  if (dielectrics.empty() || metals.empty()) return all;
  constexpr std::size_t kMixtureEvery = 8;
  for (std::size_t i = 0; i < all.size(); ++i) {
    mixed.push_back(all[i]);
    if (i % kMixtureEvery == kMixtureEvery - 1)
      mixed.push_back(mixture(dielectrics[draw.below(dielectrics.size())], metals[draw.below(metals.size())],
                              draw.share()));
  }
  return mixed;
}

class SetBuilder {
 public:
  explicit SetBuilder(const MaterialSetOptions& options) : options_(options), draw_(options.seed) {}

  MaterialSet build() {
    add_drawn(MaterialGroup::kRandom, random_surface);
    add_drawn(MaterialGroup::kPlastic, plastic_surface);
    add_drawn(MaterialGroup::kPaint, paint_surface);
    add_file(MaterialGroup::kNgan, "ngan_ward.fit", [&](const fs::path& path) {
      std::vector<NamedSurface> all = ngan_surfaces(path);
      draw_.shuffle(all);
      return all;
    });
    add_file(MaterialGroup::kMeasured, "physicallybased.json",
             [&](const fs::path& path) { return with_mixtures(database_surfaces(path), draw_); });
    return std::move(set_);
  }

 private:
  void add(MaterialGroup group, const std::string& name, const Reflectances& surface, std::size_t place) {
    set_.materials.push_back({name, group, surface, place % options_.alpha_count});
  }

  template <typename Surface>
  void add_drawn(MaterialGroup group, const Surface& surface) {
    for (std::size_t i = 0; i < options_.group_count; ++i)
      add(group, group_name(group) + " " + std::to_string(i + 1), surface(draw_), i);
  }

  template <typename Read>
  void add_file(MaterialGroup group, const char* name, const Read& read) {
    const fs::path path = options_.folder / name;
    if (options_.folder.empty() || !fs::is_regular_file(path)) {
      set_.remarks.push_back("the group " + group_name(group) + " has no materials, because " + name +
                             " was not found (--materials FOLDER)");
      return;
    }
    const std::vector<NamedSurface> all = read(path);
    if (all.empty()) throw Error(ErrorKind::kInput, path.string() + ": contains no material");
    for (std::size_t i = 0; i < options_.group_count; ++i)
      add(group, all[i % all.size()].name, all[i % all.size()].surface, i + i / all.size());
  }

  const MaterialSetOptions& options_;
  Draw draw_;
  MaterialSet set_;
};

}  // namespace

std::string group_name(MaterialGroup group) {
  constexpr std::array<const char*, kMaterialGroups> kNames = {"random", "plastic", "paint", "ngan",
                                                               "measured"};
  return kNames[static_cast<std::size_t>(group)];
}

MaterialSet study_materials(const MaterialSetOptions& options) {
  if (options.group_count == 0 || options.alpha_count == 0)
    throw Error(ErrorKind::kUsage, "materials: at least one material per group and one alpha are required");
  return SetBuilder(options).build();
}

}  // namespace remap
