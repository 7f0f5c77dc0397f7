// Conversions on what both workflows can say: random metallic materials to the specular workflow by equation
// (2) and back by each method (Sztrajman et al. 2019, section 8, figure 20, the other way round).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "study/workflows.hpp"

namespace remapc {

// How the materials are drawn, and through what the specular ones are stored.
enum class FamilyKind {
  kExact,    // base color and metallic uniform, floats
  kStored,   // the same through maps of 8 bits in sRGB
  kAuthored  // as assets have them: base color uniform in sRGB, metallic 0 or 1 in four of five; 8 bits
};
inline constexpr std::size_t kFamilyKinds = 3;
// `uniform, exact`, and so on.
std::string family_name(FamilyKind kind);

// Root mean squares over the materials: of metallic, and of base color in sRGB over its channels.
struct FamilyErrors {
  double metallic = 0.0, base_color = 0.0;
};

struct FamilyLine {
  std::string method;
  FamilyErrors errors[kFamilyKinds];
};

// Each method goes back from the specular materials of its own F0 and convention: Khronos' solver, which
// stands for plain maps too, from those too, as `Khronos, plain`. `count` materials of each kind, width
// uniform; the same for the same seed everywhere. Throws kUsage for a count of 0.
std::vector<FamilyLine> study_family(const std::vector<NamedConversion>& learned, std::size_t count,
                                     std::uint64_t seed, unsigned jobs);

}  // namespace remapc
