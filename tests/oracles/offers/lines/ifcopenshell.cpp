// This program contains the lines for IfcOpenShell, whose serializer builds its file as nlohmann::json.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

int main() {
  const double exponent = 96.08;
  const std::array<double, 3> ks{0.5, 0.5, 0.5};
  std::array<double, 3> base{0.64, 0.64, 0.64};
  nlohmann::json material;
  // lines 0
  const nlohmann::json specular = material.at("extensions").at("KHR_materials_specular");
  std::printf("%.3f %.4f %.0f %.3f\n",
              material.at("pbrMetallicRoughness").at("roughnessFactor").get<double>(),
              specular.at("specularFactor").get<double>(),
              specular.at("specularColorFactor").at(2).get<double>(), base[0]);
}
