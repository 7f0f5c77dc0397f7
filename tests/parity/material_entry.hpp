// This file declares how a library exports the entry points of a header of whole materials. A test loads the
// library, which a user's compiler has built.
#pragma once

#include <cstddef>

struct MaterialEntry {
  const char* id;  // null after the last entry
  std::size_t input_rows, output_rows;
  bool (*self_test)();
  bool (*in_domain)(const float* in);
  void (*evaluate)(const float* in, float* out);
  std::size_t (*evaluate_batch)(std::size_t count, const float* const* in, float* const* out);
  // Converts texels of three elements (diffuse or base color) and of four (the rest).
  std::size_t (*evaluate_texels)(std::size_t count, const float* color, const float* rest, float* color_out,
                                 float* rest_out);
};
