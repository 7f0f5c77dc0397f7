// The samples that a network is trained on.
#pragma once

#include <cstddef>
#include <vector>

namespace remapc {

// Rows of `input_count` inputs and `output_count` outputs.
struct Samples {
  std::size_t input_count = 0;
  std::size_t output_count = 0;
  std::vector<double> inputs;
  std::vector<double> outputs;
  std::size_t count() const noexcept { return input_count == 0 ? 0 : inputs.size() / input_count; }
};

}  // namespace remapc
