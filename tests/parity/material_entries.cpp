// This file exports headers of whole materials as a library. The test writes headers.hpp, which includes the
// headers, and defines CONVERTERS(ENTRY) as ENTRY(ID) for each.
#include <cstring>

#include "headers.hpp"
#include "parity/material_entry.hpp"

namespace {

template <class Struct, class Element>
Struct made_of(const Element* elements) {
  Struct made{};
  std::memcpy(&made, elements, sizeof made);
  return made;
}

// Passes rows as planar texels: pointers, and strides of 1.
template <class Texels, std::size_t Rows, class Pointer>
Texels rows_of(const Pointer* rows) {
  Texels made{};
  std::memcpy(static_cast<void*>(&made), rows, Rows * sizeof *rows);
  return made;
}

// Puts diffuse or base color into texels of three elements, and the rest into texels of four, with the width
// last.
template <std::size_t Rows, class T, class Texels>
void place(T* color, T* rest, Texels* texels) {
  T* pointers[Rows];
  std::size_t strides[3] = {3, 4, 4};
  for (std::size_t r = 0; r < Rows; ++r) pointers[r] = r < 3 ? color + r : rest + (r - 3);
  std::memcpy(static_cast<void*>(texels), pointers, sizeof pointers);
  std::memcpy(reinterpret_cast<char*>(texels) + sizeof pointers, strides, sizeof strides);
}

template <class Header>
MaterialEntry entry_of(const char* id) {
  constexpr std::size_t kInputs = sizeof(typename Header::Input) / sizeof(float),
                        kOutputs = sizeof(typename Header::Output) / sizeof(float);
  return {id,
          kInputs,
          kOutputs,
          Header::self_test,
          [](const float* in) { return Header::in_domain(made_of<typename Header::Input>(in)); },
          [](const float* in, float* out) {
            const auto result = Header::evaluate(made_of<typename Header::Input>(in));
            std::memcpy(out, &result, sizeof result);
          },
          [](std::size_t count, const float* const* in, float* const* out) {
            return Header::evaluate_batch(
                count, rows_of<typename Header::template InputTexels<const float>, kInputs>(in),
                rows_of<typename Header::template OutputTexels<>, kOutputs>(out));
          },
          [](std::size_t count, const float* color, const float* rest, float* color_out, float* rest_out) {
            typename Header::template InputTexels<const float> from{};
            typename Header::template OutputTexels<> to{};
            place<kInputs>(color, rest, &from);
            place<kOutputs>(color_out, rest_out, &to);
            return Header::evaluate_batch(count, from, to);
          }};
}

}  // namespace

#define ENTRY(ID) entry_of<remap::ID>(#ID),
extern "C" {
extern const MaterialEntry entries[];
const MaterialEntry entries[] = {CONVERTERS(ENTRY) MaterialEntry{}};
}
