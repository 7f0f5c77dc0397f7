// This file holds the rules that compare two maps of a material.
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "check/rules.hpp"
#include "core/number_text.hpp"

namespace remap::look {
namespace {

using Plane = std::vector<float>;

std::string place_of(const CheckedMaterial& material, const MaterialUse& use) {
  const std::string& shown = material.maps[use.map].shown;
  return use.channels == Channels::kWhole ? shown
                                          : shown + ":" + std::string(name_of(kChannels, use.channels));
}

// Returns a map as roughness. Its role states whether it holds roughness, gloss or alpha.
std::optional<Plane> roughness_by_role(const CheckedMaterial& material, const MaterialUse& use) {
  const Plane* stored = material.plane(use);
  if (stored == nullptr) return std::nullopt;
  Plane plane = *stored;
  for (float& value : plane) {
    if (use.role == Role::kGlossiness) value = 1.0f - value;
    if (use.role == Role::kGlossinessSquared) value = 1.0f - std::sqrt(std::max(0.0f, value));
    if (use.role == Role::kAlphaWidth) value = std::sqrt(std::max(0.0f, value));
  }
  return plane;
}

double deviation(const Plane& plane) {
  double sum = 0.0, squares = 0.0;
  for (const float value : plane) {
    sum += value;
    squares += static_cast<double>(value) * value;
  }
  const double count = static_cast<double>(plane.size());
  return std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count)));
}

// Returns the root mean square of a - f(b).
template <typename Function>
double distance(const Plane& a, const Plane& b, Function f) {
  double squares = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = static_cast<double>(a[i]) - f(static_cast<double>(b[i]));
    squares += difference * difference;
  }
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, a.size())));
}

// Two maps are related by a function if their RMS difference is at most this. It allows for a few steps of 8
// bits, and for JPEG compression.
constexpr double kSame = 0.02, kVaries = 0.03;

// Calls `judge(a, b, roughness of a, roughness of b)` for pairs of roughness maps in different channels or
// files. b may also be an opacity map, because some people call the width alpha.
template <typename Judge>
void for_width_pairs(const CheckedMaterial& material, Judge judge) {
  const auto is_width = [&](const MaterialUse& use) {
    return is_roughness(use.role) || use.role == Role::kGlossinessSquared || use.role == Role::kOpacity;
  };
  for (std::size_t i = 0; i < material.uses.size(); ++i)
    for (std::size_t k = i + 1; k < material.uses.size(); ++k) {
      const MaterialUse *a = &material.uses[i], *b = &material.uses[k];
      if (!is_width(*a) || !is_width(*b) || !material.same_size(*a, *b)) continue;
      if (a->is_neighbour && b->is_neighbour) continue;
      if (a->role == Role::kOpacity) std::swap(a, b);
      if (a->role == Role::kOpacity || (a->map == b->map && a->channels == b->channels)) continue;
      const auto first = roughness_by_role(material, *a), second = roughness_by_role(material, *b);
      if (first && second && deviation(*first) > kVaries && deviation(*second) > kVaries)
        judge(*a, *b, *first, *second);
    }
}

// Returns options of oiiotool that take a root of a map's roughness. The root comes from `power`, which
// relates the map to the other map. The other map may hold alpha.
std::string root_of(const CheckedMaterial& material, const MaterialUse& use, bool is_other_alpha,
                    double power) {
  const auto raised = [&](double exponent) { return "--powc " + numbers_for(material, use, exponent, 1.0); };
  // the map stays alpha, which is the square of roughness
  if (use.role == Role::kOpacity) return raised(2.0 / power);
  const std::string root = raised((is_other_alpha ? 0.5 : 1.0) / power), turn = inversion_of(material, use);
  if (use.role == Role::kGlossiness) return turn + " " + root + " " + turn;
  if (use.role == Role::kGlossinessSquared)
    return raised(0.5) + " " + turn + " " + root + " " + turn + " " + raised(2.0);
  return root;
}

}  // namespace

// Finds data maps that are encoded as sRGB, either by the tag of the file, or because another map of the set
// has the same values in linear form.
void srgb_data(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
               std::vector<MaterialFinding>& findings) {
  std::set<std::filesystem::path> seen;
  const auto add = [&](const MaterialMap& map, Confidence confidence, const std::string& what,
                       const Fix& fix) {
    if (seen.insert(map.file).second) findings.push_back({rule.name, confidence, map.shown, "", what, fix});
  };
  for (const MaterialUse& use : material.uses) {
    const MaterialMap& map = material.maps[use.map];
    const bool holds_color = std::ranges::any_of(material.uses, [&](const MaterialUse& other) {
      return other.map == use.map && is_color_role(other.role);
    });
    if (use.is_neighbour || map.texels == nullptr || !is_data_role(use.role) || holds_color ||
        map.texels->layout.tagged_transfer != Transfer::kSrgb)
      continue;
    add(map, Confidence::kLikely,
        "holds " + std::string(role_name(use.role)) +
            ", which is data, but its file is tagged sRGB: programs that follow the tag change its values",
        image_fix(material, map, "read it as raw (non-color), or remove the tag",
                  "--attrib oiio:ColorSpace Linear --eraseattrib Exif:ColorSpace "
                  "--eraseattrib remap:color_space"));
  }
  for_width_pairs(material, [&](const MaterialUse& a, const MaterialUse& b, const Plane&, const Plane&) {
    const Plane &first = *material.plane(a), &second = *material.plane(b);
    if (a.role != b.role || distance(first, second, [](double value) { return value; }) < kSame) return;
    for (const bool is_second : {false, true}) {
      const Plane &encoded = is_second ? second : first, &data = is_second ? first : second;
      Plane decoded = encoded;
      to_linear(Transfer::kSrgb, decoded);
      if (distance(decoded, data, [](double value) { return value; }) >= kSame) continue;
      const MaterialMap& map = material.maps[(is_second ? b : a).map];
      add(map, Confidence::kCertain,
          "has the values of " + place_of(material, is_second ? a : b) +
              ", encoded as sRGB: it was exported as a color",
          image_fix(material, map, "export it again as linear (raw, non-color), or decode it",
                    "--colorconvert sRGB linear"));
    }
  });
}

void gloss_as_roughness(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                        std::vector<MaterialFinding>& findings) {
  for_width_pairs(
      material, [&](const MaterialUse& a, const MaterialUse& b, const Plane& first, const Plane& second) {
        const bool inverted = distance(first, second, [](double value) { return 1.0 - value; }) < kSame;
        const bool same = distance(first, second, [](double value) { return value; }) < kSame;
        if (!inverted || same || b.role == Role::kOpacity) return;
        const MaterialUse& wrong =
            b.role == Role::kRoughness && !b.is_neighbour && a.role != Role::kRoughness ? b : a;
        const MaterialUse& other = &wrong == &a ? b : a;
        findings.push_back({rule.name, Confidence::kCertain, place_of(material, wrong), "",
                            "is read as " + std::string(role_name(wrong.role)) + ", but " +
                                place_of(material, other) + " (" + std::string(role_name(other.role)) +
                                ") is the opposite in every texel: one of the two is inverted",
                            image_fix(material, material.maps[wrong.map],
                                      "keep the correct map; if that is the other map, invert this map",
                                      inversion_of(material, wrong))});
      });
}

void alpha_as_roughness(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                        std::vector<MaterialFinding>& findings) {
  for_width_pairs(
      material, [&](const MaterialUse& a, const MaterialUse& b, const Plane& first, const Plane& second) {
        if (distance(first, second, [](double value) { return value; }) < kSame) return;
        // A map named alpha may hold opacity or a width.
        for (const double power : {2.0, 0.5, 4.0, 0.25}) {
          if (distance(first, second, [&](double value) { return std::pow(std::max(0.0, value), power); }) >=
              kSame)
            continue;
          if (b.role == Role::kOpacity && power == 0.5) return;  // alpha next to its root is correct
          const bool second_is_wrong = power < 1.0;
          const MaterialUse &wrong = second_is_wrong ? b : a, &other = second_is_wrong ? a : b;
          const double squared = second_is_wrong ? 1.0 / power : power;
          findings.push_back(
              {rule.name, Confidence::kCertain, place_of(material, wrong), "",
               "is read as " + std::string(role_name(wrong.role)) + ", but is the " +
                   (squared == 2.0 ? "square" : "fourth power") + " of " + place_of(material, other) + " (" +
                   std::string(role_name(other.role)) +
                   "): " + (squared == 2.0 ? "one of them holds alpha" : "it was squared twice"),
               image_fix(material, material.maps[wrong.map],
                         "keep the other map, or take the root of this map (which is then roughness)",
                         root_of(material, wrong, other.role == Role::kOpacity, squared))});
          return;
        }
      });
}

void sizes(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
           std::vector<MaterialFinding>& findings) {
  if (material.kind != MaterialKind::kFolder) return;  // textures of assets may have different sizes
  const auto area = [](const MaterialMap& map) {
    return map.texels == nullptr
               ? 0LL
               : static_cast<long long>(map.texels->layout.width) * map.texels->layout.height;
  };
  for (const MaterialMap& map : material.maps) {
    // Tiles may differ in size.
    const MaterialMap* largest = nullptr;
    for (const MaterialMap& other : material.maps)
      if (other.tile == map.tile && (largest == nullptr || area(other) > area(*largest))) largest = &other;
    if (map.texels == nullptr) continue;
    const ImageLayout &a = largest->texels->layout, &b = map.texels->layout;
    if (a.width == b.width && a.height == b.height) continue;
    const bool other_shape =
        static_cast<long long>(a.width) * b.height != static_cast<long long>(b.width) * a.height;
    const auto text = [](const ImageLayout& layout) {
      return std::to_string(layout.width) + "x" + std::to_string(layout.height);
    };
    findings.push_back(
        {rule.name, other_shape ? Confidence::kCertain : Confidence::kLikely, map.shown, "",
         "is " + text(b) + ", but " + largest->shown + " is " + text(a) +
             (other_shape ? ", of another shape" : ""),
         image_fix(material, map, "export it again in this size, or resample it", "--resize " + text(a))});
  }
}

void duplicate_map(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                   std::vector<MaterialFinding>& findings) {
  const auto is_color = [](Role role) { return role == Role::kBaseColor || role == Role::kDiffuse; };
  for (std::size_t i = 0; i < material.uses.size(); ++i)
    for (std::size_t k = i + 1; k < material.uses.size(); ++k) {
      const MaterialUse &a = material.uses[i], &b = material.uses[k];
      const bool one_file = material.maps[a.map].file == material.maps[b.map].file;
      if (a.map == b.map || (one_file && material.channel(a) != material.channel(b)) || a.role == b.role ||
          a.is_neighbour || b.is_neighbour || !material.same_size(a, b))
        continue;
      if (is_color(a.role) && is_color(b.role)) continue;
      const Plane *first = material.plane(a), *second = material.plane(b);
      if (first == nullptr || second == nullptr || *first != *second) continue;
      if (deviation(*first) < kVaries) continue;
      // The rule gloss-as-roughness reports these pairs.
      if (is_roughness(a.role) && is_roughness(b.role)) continue;
      findings.push_back({rule.name, Confidence::kLikely, place_of(material, a), "",
                          "has the same texels as " + place_of(material, b) + ": " +
                              std::string(role_name(a.role)) + " and " + std::string(role_name(b.role)) +
                              " are rarely the same map",
                          "export both maps again: one of them was written twice"});
    }
}

}  // namespace remap::look
