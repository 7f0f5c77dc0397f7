// What `texremap convert` says of a conversion that is done, to people and to scripts.
#pragma once

#include <string>
#include <vector>

#include "convert/path.hpp"
#include "texture/texture_pass.hpp"

namespace remap {

// A converter that is compiled in, or one that was made for this run: of a fit, or of the steps of a path.
struct ChosenConverter {
  std::unique_ptr<Converter> owned;
  const Converter* converter = nullptr;
  ConverterPath path;
};

struct Outcome {
  const ChosenConverter& chosen;
  const TextureSet& set;
  const std::vector<TargetMap>& targets;
  MapStatistics statistics;
  double seconds = 0.0;
};

void print_summary(const std::string& program, const Outcome& outcome);
void print_json(const Outcome& outcome);

// Of a conversion without maps.
struct ConvertedValues {
  float roughness = 0.0f;
  std::vector<float> specular;
  bool in_domain = true;
};
// `roughness_name`: what the width that was asked for is called.
void print_values(const ChosenConverter& chosen, const std::string& roughness_name,
                  const ConvertedValues& values, bool json);

}  // namespace remap
