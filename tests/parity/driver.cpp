// Runs generated headers as a user's program would: reads texels, writes what every entry point gives. Built
// by the parity test with each compiler and each set of flags. The test writes headers.hpp, which includes
// the headers under test and defines CONVERTERS(ENTRY) as ENTRY(ID) of each.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "headers.hpp"

namespace {

// The entry points of one header.
struct Converter {
  const char* id;
  bool (*self_test)();
  bool (*in_domain)(float width, float specular);
  void (*texel_of_one)(const float* in, float* out);
  void (*texel_of_three)(const float* in, float* out);
  void (*row_of_one)(const float* in, float* out);  // a row of a single texel of three channels
  std::size_t (*rows_of_three)(std::size_t, const float*, const std::array<const float*, 3>&, float*,
                               const std::array<float*, 3>&);
  std::size_t (*rows_of_one)(std::size_t, const float*, const std::array<const float*, 1>&, float*,
                             const std::array<float*, 1>&);
};

#define ENTRY(ID)                                                                                     \
  {#ID,                                                                                               \
   remap::ID::self_test,                                                                              \
   [](float width, float specular) {                                                                  \
     return remap::ID::in_domain({width, specular});                                                  \
   },                                                                                                 \
   [](const float* in, float* out) {                                                                  \
     const remap::ID::Output texel = remap::ID::evaluate({in[0], in[1]});                             \
     std::memcpy(out, &texel, sizeof texel);                                                          \
   },                                                                                                 \
   [](const float* in, float* out) {                                                                  \
     const remap::ID::OutputTexel<3> texel = remap::ID::evaluate<3>(in[0], {in[1], in[2], in[3]});    \
     std::memcpy(out, &texel, sizeof texel);                                                          \
   },                                                                                                 \
   [](const float* in, float* out) {                                                                  \
     remap::ID::evaluate_batch<3>(1, in, {in + 1, in + 2, in + 3}, out, {out + 1, out + 2, out + 3}); \
   },                                                                                                 \
   remap::ID::evaluate_batch<3>,                                                                      \
   remap::ID::evaluate_batch<1>},
const Converter kConverters[] = {CONVERTERS(ENTRY)};

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

// What the header gives for planar `rows`, and whether its entry points agree. 0 where they do.
int check(const Converter& converter, const std::vector<float>& rows, std::vector<float>& single) {
  if (!converter.self_test()) return fail("self_test failed");
  const std::size_t count = rows.size() / 4;

  // One texel at a time: the definition of correctness.
  single.resize(4 * count);
  std::vector<float> of_one(2 * count);
  std::size_t outside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    bool inside = true;
    for (std::size_t c = 0; c < 3; ++c)
      inside = inside && converter.in_domain(rows[i], rows[(c + 1) * count + i]);
    outside += inside ? 0 : 1;
    const float texel[4] = {rows[i], rows[count + i], rows[2 * count + i], rows[3 * count + i]};
    float by_row[4], together[4], alone[2];
    converter.row_of_one(texel, by_row);
    converter.texel_of_three(texel, together);
    if (!same_bits(by_row, together, 4)) return fail("a texel of three channels differs from a row of one");
    for (std::size_t r = 0; r < 4; ++r) single[r * count + i] = by_row[r];
    converter.texel_of_one(texel, alone);
    for (std::size_t r = 0; r < 2; ++r) of_one[r * count + i] = alone[r];
  }

  // Rows, at every offset that a block can start with.
  for (const std::size_t skip : {std::size_t{0}, std::size_t{1}, std::size_t{37}, std::size_t{130}}) {
    if (skip > count) continue;
    std::vector<float> batch(single);
    const std::size_t found = converter.rows_of_three(
        count - skip, &rows[skip], {&rows[count + skip], &rows[2 * count + skip], &rows[3 * count + skip]},
        &batch[skip], {&batch[count + skip], &batch[2 * count + skip], &batch[3 * count + skip]});
    if (!same_bits(batch, single)) return fail("rows differ from single texels");
    if (skip == 0 && found != outside) return fail("rows count other texels out of domain than in_domain()");
  }

  // In place, all rows and some rows.
  std::vector<float> in_place(rows);
  converter.rows_of_three(count, &in_place[0], {&in_place[count], &in_place[2 * count], &in_place[3 * count]},
                          &in_place[0], {&in_place[count], &in_place[2 * count], &in_place[3 * count]});
  if (!same_bits(in_place, single)) return fail("in place differs");
  std::vector<float> mixed(rows), width_out(count);
  converter.rows_of_one(count, &mixed[0], {&mixed[count]}, &width_out[0], {&mixed[count]});
  if (!same_bits(&mixed[count], &of_one[count], count)) return fail("one channel in place differs");
  if (!same_bits(&width_out[0], &of_one[0], count)) return fail("the width beside it differs");

  single.push_back(static_cast<float>(outside));
  return 0;
}

std::vector<float> read(const std::string& path) {
  std::FILE* input = std::fopen(path.c_str(), "rb");
  std::vector<float> rows;
  float value = 0.0f;
  while (input != nullptr && std::fread(&value, sizeof value, 1, input) == 1) rows.push_back(value);
  if (input != nullptr) std::fclose(input);
  return rows;
}

bool write(const std::string& path, const std::vector<float>& values) {
  std::FILE* output = std::fopen(path.c_str(), "wb");
  if (output == nullptr) return false;
  const bool written = std::fwrite(&values[0], sizeof(float), values.size(), output) == values.size();
  return std::fclose(output) == 0 && written;
}

}  // namespace

// Usage: driver FOLDER. Of each header: planar floats, width and three channels of each texel, from
// FOLDER/ID.in; the same, and as one float the texels out of domain, to FOLDER/ID.out.
int main(int argc, char** argv) {
  if (argc != 2) return fail("usage");
  for (const Converter& converter : kConverters) {
    const std::string path = std::string(argv[1]) + "/" + converter.id;
    std::vector<float> out;
    const int status = check(converter, read(path + ".in"), out);
    if (status != 0) return fail(converter.id);
    if (!write(path + ".out", out)) return fail("cannot write");
  }
  return 0;
}
