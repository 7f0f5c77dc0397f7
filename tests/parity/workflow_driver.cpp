// Runs one header of a workflow conversion over texels from a file: HEADER and CONVERTER come from the
// command line of the compiler. Says on standard error where the header contradicts itself; writes its rows,
// then the number of texels outside.
#include HEADER

#include <cstdio>
#include <vector>

namespace converter = remap::CONVERTER;

namespace {

constexpr std::size_t kIn = converter::kInputRows, kOut = converter::kOutputRows;
using Rows = std::vector<std::vector<float>>;

int fail(const char* what) {
  std::fprintf(stderr, "%s\n", what);
  return 1;
}

std::size_t run(const Rows& in, Rows& out, std::size_t first, std::size_t count) {
  std::array<const float*, kIn> from{};
  std::array<float*, kOut> to{};
  for (std::size_t r = 0; r < kIn; ++r) from[r] = in[r].data() + first;
  for (std::size_t r = 0; r < kOut; ++r) to[r] = out[r].data() + first;
  return converter::evaluate_rows(count, from, to);
}

bool same(const Rows& a, const Rows& b) {
  for (std::size_t r = 0; r < kOut; ++r)
    if (std::memcmp(a[r].data(), b[r].data(), a[r].size() * sizeof(float)) != 0) return false;
  return true;
}

}  // namespace

int main(int, char** argv) {
  static_assert(sizeof(converter::Input) == kIn * sizeof(float));
  static_assert(sizeof(converter::Output) == kOut * sizeof(float));
  std::vector<float> texels;
  std::FILE* input = std::fopen(argv[1], "rb");
  if (input == nullptr) return fail("cannot read");
  for (float value = 0.0f; std::fread(&value, sizeof value, 1, input) == 1;) texels.push_back(value);
  std::fclose(input);
  const std::size_t count = texels.size() / kIn;
  Rows in(kIn), all(kOut), parts(kOut), single(kOut);
  for (std::size_t r = 0; r < kIn; ++r) in[r].assign(&texels[r * count], &texels[r * count] + count);
  for (Rows* rows : {&all, &parts, &single}) rows->assign(kOut, std::vector<float>(count));

  if (!converter::self_test()) return fail("self-test failed");
  const std::size_t outside = run(in, all, 0, count);
  std::size_t sum = 0, outside_one = 0;
  for (std::size_t first = 0, size = 1; first < count; first += size, size = size % 37 + 1)
    sum += run(in, parts, first, size < count - first ? size : count - first);
  if (sum != outside) return fail("parts count other texels outside");
  if (!same(parts, all)) return fail("parts differ from the whole");
  for (std::size_t i = 0; i < count; ++i) {
    float from[kIn], to[kOut];
    for (std::size_t r = 0; r < kIn; ++r) from[r] = in[r][i];
    converter::Input texel{};
    std::memcpy(&texel, from, sizeof texel);
    const converter::Output result = converter::evaluate(texel);
    std::memcpy(to, &result, sizeof result);
    for (std::size_t r = 0; r < kOut; ++r) single[r][i] = to[r];
    outside_one += converter::in_domain(texel) ? 0 : 1;
  }
  if (!same(single, all)) return fail("single texels differ from rows");
  if (outside_one != outside) return fail("in_domain disagrees with rows");

  Rows in_place = in;
  in_place.resize(kIn > kOut ? kIn : kOut, std::vector<float>(count));
  run(in_place, in_place, 0, count);
  in_place.resize(kOut);
  if (!same(in_place, all)) return fail("in place differs");

  std::FILE* output = std::fopen(argv[2], "wb");
  if (output == nullptr) return fail("cannot write");
  bool written = true;
  for (const auto& row : all)
    written = written && std::fwrite(row.data(), sizeof(float), count, output) == count;
  const float number = static_cast<float>(outside);
  written = written && std::fwrite(&number, sizeof number, 1, output) == 1;
  return std::fclose(output) == 0 && written ? 0 : 1;
}
