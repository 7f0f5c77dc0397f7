// The materials by which short forms and rules for exponents are chosen and judged, and the pictures of their
// lobes.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "study/rule_judge.hpp"

namespace remap {

// Lobes of an exponent are the built-in models `legacy/...`.
bool has_exponent(const std::string& model);
// Whether the lobe is about the mirrored light, not about the half vector.
bool is_mirrored(const std::string& model);
bool is_normalised(const std::string& model);

// The half that chooses has even indices, the other judges.
enum class Half { kChoosing, kJudging };

// Materials with the widths of half of the pictures of `model`; each half has materials of its own.
// Of exponents: plastics, tinted highlights and the colors of metals, judged from n = 1.
std::vector<LobeMaterial> exponent_materials(const std::string& model, Half half);
// Lobes alone, with the speculars of dielectrics and the greys of metals; from alpha 0.05.
std::vector<LobeMaterial> width_materials(const std::string& model, Half half);
// Core glTF: half dielectrics, half metals; from alpha 0.05.
std::vector<LobeMaterial> core_materials(const std::string& model, Half half);

// Pictures of lobes under some lights, rendered when they are asked for.
class LobeBank {
 public:
  LobeBank(std::vector<Environment> environments, const SphereSampling& sampling)
      : lights_(std::move(environments), sampling) {}

  const StudyLights& lights() const { return lights_; }
  const LobePictures& of(const std::string& model);
  // Its widths in all pictures, ascending.
  static std::vector<double> alphas(const std::string& model);

 private:
  StudyLights lights_;
  std::map<std::string, std::unique_ptr<LobePictures>> pictures_;
};

}  // namespace remap
