// Samples that a network learns from.
#pragma once

#include <cstddef>
#include <vector>

namespace remapc {

// Rows of samples: `input_count` numbers a row, `output_count` numbers a row.
struct Samples {
  std::size_t input_count = 0;
  std::size_t output_count = 0;
  std::vector<double> inputs;
  std::vector<double> outputs;
  std::size_t count() const noexcept { return input_count == 0 ? 0 : inputs.size() / input_count; }
};

}  // namespace remapc
