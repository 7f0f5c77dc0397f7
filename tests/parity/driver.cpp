// Runs generated headers as a user's program would: reads texels, writes what every entry point gives. Built
// by the parity test with each compiler and each set of flags; the header under test comes in by name.
#include HEADER

#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

namespace converter = NAMESPACE;

namespace {

// Bit for bit; of two NaN operands a product may hand on either, so any NaN is the same. Under fast-math rows
// may divide another way than single texels.
bool same_bits(const float* a, const float* b, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isnan(a[i]) && std::isnan(b[i])) continue;
#ifdef __FAST_MATH__
    if (std::fabs(a[i] - b[i]) <= 1e-5f * (1.0f + std::fabs(a[i]))) continue;
#endif
    if (std::memcmp(a + i, b + i, sizeof(float)) != 0) return false;
  }
  return true;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return same_bits(&a[0], &b[0], a.size());
}

int fail(const char* what) {
  std::fprintf(stderr, "%s\n", what);
  return 1;
}

}  // namespace

// Usage: driver INPUT OUTPUT. Planar floats: width and three channels of each texel in, the same out; then,
// as one float, the texels out of domain.
int main(int argc, char** argv) {
  if (argc != 3) return fail("usage");
  if (!converter::self_test()) return fail("self_test failed");
  std::FILE* input = std::fopen(argv[1], "rb");
  std::vector<float> rows;
  float value = 0.0f;
  while (input != nullptr && std::fread(&value, sizeof value, 1, input) == 1) rows.push_back(value);
  if (input != nullptr) std::fclose(input);
  const std::size_t count = rows.size() / 4;

  // One texel at a time: the definition of correctness.
  std::vector<float> single(4 * count), of_one(2 * count);
  std::size_t outside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    bool inside = true;
    for (std::size_t c = 0; c < 3; ++c)
      inside = inside && converter::in_domain({rows[i], rows[(c + 1) * count + i]});
    outside += inside ? 0 : 1;
    converter::evaluate_batch<3>(1, &rows[i], {&rows[count + i], &rows[2 * count + i], &rows[3 * count + i]},
                                 &single[i],
                                 {&single[count + i], &single[2 * count + i], &single[3 * count + i]});
    const converter::OutputTexel<3> texel =
        converter::evaluate<3>(rows[i], {rows[count + i], rows[2 * count + i], rows[3 * count + i]});
    const float by_texel[4] = {single[i], single[count + i], single[2 * count + i], single[3 * count + i]};
    float together[4];
    std::memcpy(together, &texel, sizeof together);
    if (!same_bits(by_texel, together, 4)) return fail("a texel of three channels differs from a row of one");
    const converter::Output out = converter::evaluate({rows[i], rows[count + i]});
    std::memcpy(&of_one[i], &out, sizeof(float));
    std::memcpy(&of_one[count + i], reinterpret_cast<const char*>(&out) + sizeof(float), sizeof(float));
  }

  // Rows, at every offset that a block can start with.
  for (const std::size_t skip : {std::size_t{0}, std::size_t{1}, std::size_t{37}, std::size_t{130}}) {
    if (skip > count) continue;
    std::vector<float> batch(single);
    const std::size_t found = converter::evaluate_batch<3>(
        count - skip, &rows[skip], {&rows[count + skip], &rows[2 * count + skip], &rows[3 * count + skip]},
        &batch[skip], {&batch[count + skip], &batch[2 * count + skip], &batch[3 * count + skip]});
    if (!same_bits(batch, single)) return fail("rows differ from single texels");
    if (skip == 0 && found != outside) return fail("rows count other texels out of domain than in_domain()");
  }

  // In place, all rows and some rows.
  std::vector<float> in_place(rows);
  converter::evaluate_batch<3>(count, &in_place[0],
                               {&in_place[count], &in_place[2 * count], &in_place[3 * count]}, &in_place[0],
                               {&in_place[count], &in_place[2 * count], &in_place[3 * count]});
  if (!same_bits(in_place, single)) return fail("in place differs");
  std::vector<float> mixed(rows), width_out(count);
  converter::evaluate_batch<1>(count, &mixed[0], {&mixed[count]}, &width_out[0], {&mixed[count]});
  if (!same_bits(&mixed[count], &of_one[count], count)) return fail("one channel in place differs");
  if (!same_bits(&width_out[0], &of_one[0], count)) return fail("the width beside it differs");

  single.push_back(static_cast<float>(outside));
  std::FILE* output = std::fopen(argv[2], "wb");
  if (output == nullptr) return fail("cannot write");
  const bool written = std::fwrite(single.data(), sizeof(float), single.size(), output) == single.size();
  return std::fclose(output) == 0 && written ? 0 : 1;
}
