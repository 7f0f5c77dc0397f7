// Round trips of materials that both workflows can represent: random metallic materials are converted to the
// specular workflow by equation (2) and back by each method (Sztrajman et al. 2019, section 8, figure 20, in
// the opposite direction).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "study/workflows.hpp"

namespace remapc {

// The distribution of the materials and the storage of the specular maps.
enum class FamilyKind {
  kExact,    // base color and metallic uniform; floats
  kStored,   // as kExact, stored with 8 bits in sRGB
  kAuthored  // like assets: base color uniform in sRGB, metallic 0 or 1 in four of five; 8 bits
};
inline constexpr std::size_t kFamilyKinds = 3;
// For example `uniform, exact`.
std::string family_name(FamilyKind kind);

// RMS errors over the materials, of metallic and of base color (sRGB, all channels).
struct FamilyErrors {
  double metallic = 0.0, base_color = 0.0;
};

struct FamilyLine {
  std::string method;
  FamilyErrors errors[kFamilyKinds];
};

// Each method converts back from specular materials of its own F0 and convention. Khronos' solver is also
// tested on plain maps, as `Khronos, plain`. `count`: materials of each kind, with uniform alpha. Materials
// depend only on `seed`. Throws kUsage if `count` is 0.
std::vector<FamilyLine> study_family(const std::vector<NamedConversion>& learned, std::size_t count,
                                     std::uint64_t seed, unsigned jobs);

}  // namespace remapc
