// The header of a converter of whole materials: its code, and around it what every generated header offers:
// one texel, rows of texels, domain, self-test.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "remap/workflow.hpp"

namespace remapc {

using MaterialParameters = std::vector<remap::MaterialParameter>;

// Source or target.
struct MaterialEnd {
  std::string model, workflow, diffuse;  // `mitsuba/ggx`, `specular`, `plain`
  MaterialParameters parameters;         // the last is the width, named by its convention
};

// Inputs and what they give, a row a channel; all values of inputs in 0 to 1.
struct GoldenRows {
  std::vector<std::vector<float>> in, out;
};

struct MaterialHeader {
  std::string id, formula;
  std::string provenance;  // lines of comments
  MaterialEnd source, target;
  std::string constants;  // definitions beside those of the ends
  std::string code;       // for namespace detail
  std::string block;      // its number of texels that are converted together
  std::string call;       // converts a block: rows `from` to rows `to`
  std::string within;     // of golden values, a float literal
  GoldenRows golden;
};

// Files of code one after another, each with its empty line before it.
std::string code_text(std::initializer_list<std::string_view> files);

// Channels of all parameters.
std::size_t row_count(const MaterialParameters& parameters);

std::string material_header(const MaterialHeader& header);

}  // namespace remapc
