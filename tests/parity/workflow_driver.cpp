// This program runs headers of workflow conversions over texels from files. The test writes headers.hpp,
// which includes them, and entries.inc, with a line ENTRY(ID) for each. It prints to standard error if a
// header contradicts itself.
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "headers.hpp"

namespace {

using Rows = std::vector<std::vector<float>>;

// A Converter has the entry points of one header.
struct Converter {
  const char* id;
  std::size_t input_rows, output_rows;
  bool (*self_test)();
  bool (*in_domain)(const float* in);
  void (*evaluate)(const float* in, float* out);
  std::size_t (*evaluate_batch)(std::size_t count, const float* const* in, float* const* out);
  std::size_t (*evaluate_texels)(std::size_t count, const float* color, const float* rest, float* color_out,
                                 float* rest_out);
};

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
Converter entry_of(const char* id) {
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

#define ENTRY(ID) entry_of<remap::ID>(#ID),
const Converter kConverters[] = {CONVERTERS(ENTRY)};

int fail(const char* what) {
  std::fprintf(stderr, "%s\n", what);
  return 1;
}

std::size_t run(const Converter& converter, const Rows& in, Rows& out, std::size_t first, std::size_t count) {
  std::vector<const float*> from;
  std::vector<float*> to;
  for (std::size_t r = 0; r < converter.input_rows; ++r) from.push_back(in[r].data() + first);
  for (std::size_t r = 0; r < converter.output_rows; ++r) to.push_back(out[r].data() + first);
  return converter.evaluate_batch(count, from.data(), to.data());
}

// Compares only the rows that the header writes.
bool same(const Rows& a, const Rows& b) {
  for (std::size_t r = 0; r < a.size() && r < b.size(); ++r)
    if (std::memcmp(a[r].data(), b[r].data(), a[r].size() * sizeof(float)) != 0) return false;
  return true;
}

// Converts rows to texels of three and of four elements, and back.
struct Interleaved {
  explicit Interleaved(std::size_t count) : color(3 * count), rest(4 * count) {}
  float& element(std::size_t row, std::size_t i) {
    return row < 3 ? color[3 * i + row] : rest[4 * i + row - 3];
  }
  std::vector<float> color, rest;
};

bool texels_agree(const Converter& converter, const Rows& in, const Rows& all, std::size_t outside) {
  const std::size_t count = in[0].size();
  Interleaved from(count), to(count);
  for (std::size_t r = 0; r < in.size(); ++r)
    for (std::size_t i = 0; i < count; ++i) from.element(r, i) = in[r][i];
  const auto gives_all = [&](Interleaved& out) {
    const std::size_t found = converter.evaluate_texels(count, from.color.data(), from.rest.data(),
                                                        out.color.data(), out.rest.data());
    Rows rows = all;
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (std::size_t i = 0; i < count; ++i) rows[r][i] = out.element(r, i);
    return found == outside && same(rows, all);
  };
  return gives_all(to) && gives_all(from);  // the second call works in place
}

// Converts `in` to `all`. Returns 0 if the entry points agree.
int check(const Converter& converter, const Rows& in, Rows& all, std::size_t& outside) {
  const std::size_t count = in[0].size(), in_rows = converter.input_rows, out_rows = converter.output_rows;
  all.assign(out_rows, std::vector<float>(count));
  Rows parts = all, single = all;
  if (!converter.self_test()) return fail("self-test failed");
  outside = run(converter, in, all, 0, count);
  std::size_t sum = 0, outside_one = 0;
  for (std::size_t first = 0, size = 1; first < count; first += size, size = size % 37 + 1)
    sum += run(converter, in, parts, first, size < count - first ? size : count - first);
  if (sum != outside) return fail("parts count other texels outside");
  if (!same(parts, all)) return fail("parts differ from the whole");
  std::vector<float> from(in_rows), to(out_rows);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t r = 0; r < in_rows; ++r) from[r] = in[r][i];
    converter.evaluate(from.data(), to.data());
    for (std::size_t r = 0; r < out_rows; ++r) single[r][i] = to[r];
    outside_one += converter.in_domain(from.data()) ? 0u : 1u;
  }
  if (!same(single, all)) return fail("single texels differ from rows");
  if (outside_one != outside) return fail("in_domain disagrees with rows");

  if (!texels_agree(converter, in, all, outside)) return fail("interleaved texels differ from rows");
  Rows in_place = in;
  if (in_place.size() < out_rows) in_place.resize(out_rows, std::vector<float>(count));
  run(converter, in_place, in_place, 0, count);
  return same(in_place, all) ? 0 : fail("in place differs");
}

Rows read(const std::string& path, std::size_t row_count) {
  std::vector<float> texels;
  std::FILE* input = std::fopen(path.c_str(), "rb");
  for (float value = 0.0f; input != nullptr && std::fread(&value, sizeof value, 1, input) == 1;)
    texels.push_back(value);
  if (input != nullptr) std::fclose(input);
  const std::size_t count = texels.size() / row_count;
  Rows rows(row_count);
  for (std::size_t r = 0; r < row_count; ++r) rows[r].assign(&texels[r * count], &texels[r * count] + count);
  return rows;
}

// Writes the rows one after the other, then the number of texels outside.
bool write(const std::string& path, const Rows& rows, std::size_t outside) {
  std::FILE* output = std::fopen(path.c_str(), "wb");
  if (output == nullptr) return false;
  bool written = true;
  for (const auto& row : rows)
    written = written && std::fwrite(row.data(), sizeof(float), row.size(), output) == row.size();
  const float number = static_cast<float>(outside);
  written = written && std::fwrite(&number, sizeof number, 1, output) == 1;
  return std::fclose(output) == 0 && written;
}

}  // namespace

// Usage: workflow_driver FOLDER. For each header, it converts FOLDER/ID.in to FOLDER/ID.out.
int main(int argc, char** argv) {
  if (argc != 2) return fail("usage");
  for (const Converter& converter : kConverters) {
    const std::string path = std::string(argv[1]) + "/" + converter.id;
    Rows all;
    std::size_t outside = 0;
    if (check(converter, read(path + ".in", converter.input_rows), all, outside) != 0)
      return fail(converter.id);
    if (!write(path + ".out", all, outside)) return fail("cannot write");
  }
  return 0;
}
