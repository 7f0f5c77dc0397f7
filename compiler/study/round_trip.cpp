#include "study/round_trip.hpp"

#include <array>
#include <cmath>
#include <random>

#include "remap/error.hpp"
#include "renderer/image_similarity.hpp"
#include "system/parallel.hpp"

namespace remapc {
namespace {

using remap::MetallicMaterial;
using remap::SpecularMaterial;

float stored(float linear) {
  const double steps = std::round(255.0 * static_cast<double>(display_value(static_cast<double>(linear))));
  return static_cast<float>(linear_of_display(steps / 255.0));
}

MetallicMaterial drawn(FamilyKind kind, std::mt19937_64& generator) {
  const auto share = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  const bool authored = kind == FamilyKind::kAuthored;
  MetallicMaterial material;
  for (float& channel : material.base_color)
    channel = static_cast<float>(authored ? linear_of_display(share()) : share());
  const double metallic = share(), pure = share();
  material.metallic = static_cast<float>(authored && pure < 0.8 ? std::round(metallic) : metallic);
  material.width = static_cast<float>(share());
  return material;
}

// One tested method: `there` is equation (2); `back` is the conversion under test.
struct FamilyTrip {
  std::string name;
  remap::WorkflowConversion there, back;
};

FamilyTrip trip_of(const WorkflowMethod& method, const std::string& addition = "") {
  FamilyTrip trip{method.name + addition, method.conversion, method.conversion};
  trip.there.formula = remap::Equation2{};
  return trip;
}

FamilyErrors errors_of(const FamilyTrip& trip, FamilyKind kind, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  double metallic = 0.0, color = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const MetallicMaterial truth = drawn(kind, generator);
    SpecularMaterial material = to_specular(trip.there, truth);
    if (kind != FamilyKind::kExact)
      for (auto* channels : {&material.diffuse, &material.specular})
        for (float& channel : *channels) channel = stored(channel);
    const MetallicMaterial result = to_metallic(trip.back, material);
    metallic += std::pow(static_cast<double>(result.metallic - truth.metallic), 2);
    for (std::size_t c = 0; c < 3; ++c)
      color += std::pow(static_cast<double>(display_value(static_cast<double>(result.base_color[c])) -
                                            display_value(static_cast<double>(truth.base_color[c]))),
                        2) /
               3.0;
  }
  const auto all = static_cast<double>(count);
  return {std::sqrt(metallic / all), std::sqrt(color / all)};
}

}  // namespace

std::string family_name(FamilyKind kind) {
  constexpr std::array<const char*, kFamilyKinds> kNames = {"uniform, exact", "uniform, 8-bit",
                                                            "authored, 8-bit"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::vector<FamilyLine> study_family(const std::vector<NamedConversion>& learned, std::size_t count,
                                     std::uint64_t seed, unsigned jobs) {
  if (count == 0) throw remap::Error(remap::ErrorKind::kUsage, "--family-count must be at least 1");
  std::vector<FamilyTrip> trips;
  for (const WorkflowMethod& method : plain_methods(learned)) {
    const bool is_khronos = std::holds_alternative<remap::KhronosSolver>(method.conversion.formula);
    FamilyTrip& trip = trips.emplace_back(trip_of(method, is_khronos ? ", plain" : ""));
    // The solver is also tested on maps of the other convention.
    if (is_khronos)
      trip.there.specular.diffuse = trip.there.metallic.diffuse = remap::DiffuseConvention::kPlain;
  }
  for (const WorkflowMethod& method : gltf_methods()) trips.push_back(trip_of(method, ", glTF"));
  std::vector<FamilyLine> lines;
  for (const FamilyTrip& trip : trips) lines.push_back({trip.name, {}});
  remap::run_parallel(lines.size() * kFamilyKinds, jobs, [&](std::size_t i) {
    const std::size_t line = i / kFamilyKinds, kind = i % kFamilyKinds;
    lines[line].errors[kind] = errors_of(trips[line], static_cast<FamilyKind>(kind), count, seed);
  });
  return lines;
}

}  // namespace remapc
