// This program runs generated headers as a user's program does: it reads texels and writes the results of
// every entry point. The parity test builds it with each compiler and each set of flags. The test writes
// headers.hpp, which includes the headers under test, and defines CONVERTERS(ENTRY) as ENTRY(ID) for each,
// and HEADER_COUNT.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "headers.hpp"

namespace {

// A Half is the upper half of a float. A caller may have such a type.
struct Half {
  explicit Half(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    upper = static_cast<std::uint16_t>(bits >> 16);
  }
  explicit operator float() const {
    const std::uint32_t bits = std::uint32_t{upper} << 16;
    float value = 0.0f;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  std::uint16_t upper;
};

// A Buffers points to the width and to the red channel of texels. Inputs and outputs may be the same.
template <class T>
struct Buffers {
  T *width, *red;
  std::size_t width_stride, stride;
};

// A Converter has the entry points of one header.
struct Converter {
  const char* id;
  bool (*self_test)();
  bool (*in_domain)(float width, float specular);
  void (*texel_of_one)(const float* in, float* out);
  void (*texel_of_three)(const float* in, float* out);
  std::size_t (*rows_of_three)(std::size_t, const float*, const std::array<const float*, 3>&, float*,
                               const std::array<float*, 3>&);
  std::size_t (*rows_of_one)(std::size_t, const float*, const std::array<const float*, 1>&, float*,
                             const std::array<float*, 1>&);
  std::size_t (*texels)(std::size_t, const Buffers<float>&, const Buffers<float>&);
  std::size_t (*halves)(std::size_t, const Buffers<Half>&, const Buffers<Half>&);
};

template <class Header, std::size_t Channels>
std::size_t rows(std::size_t count, const float* width, const std::array<const float*, Channels>& specular,
                 float* width_out, const std::array<float*, Channels>& specular_out) {
  return Header::template evaluate_batch<Channels>(count, {width, specular}, {width_out, specular_out});
}

template <class Header, class T>
std::size_t texels(std::size_t count, const Buffers<T>& in, const Buffers<T>& out) {
  return Header::template evaluate_batch<3, const T>(
      count, {in.width, {in.red, in.red + 1, in.red + 2}, in.width_stride, in.stride},
      {out.width, {out.red, out.red + 1, out.red + 2}, out.width_stride, out.stride});
}

// With optimisation, compilers would need half a minute for two element types of many headers.
#ifdef __OPTIMIZE__
constexpr bool kChecksTexels = HEADER_COUNT == 1;
#else
constexpr bool kChecksTexels = true;
#endif

template <class Header, class T>
constexpr decltype(&texels<Header, T>) texels_to_check() {
  if constexpr (kChecksTexels)
    return texels<Header, T>;
  else
    return nullptr;
}

template <class Header>
Converter entry_of(const char* id) {
  return {id,
          Header::self_test,
          [](float width, float specular) {
            return typename Header::template Texel<1>{width, {specular}}.in_domain();
          },
          [](const float* in, float* out) {
            const auto texel = Header::evaluate({in[0], {in[1]}});
            out[0] = texel.width;
            out[1] = texel.specular[0];
          },
          [](const float* in, float* out) {
            const auto texel = Header::template evaluate<3>({in[0], {in[1], in[2], in[3]}});
            out[0] = texel.width;
            for (std::size_t c = 0; c < 3; ++c) out[c + 1] = texel.specular[c];
          },
          rows<Header, 3>,
          rows<Header, 1>,
          texels_to_check<Header, float>(),
          texels_to_check<Header, Half>()};
}

#define ENTRY(ID) entry_of<remap::ID>(#ID),
const Converter kConverters[] = {CONVERTERS(ENTRY)};

// Compares bit for bit. All NaN are equal, because a product of two NaN may return either. Under fast-math,
// rows may divide in another way than single texels.
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

// A Layout states where the elements of a texel are.
struct Layout {
  std::size_t stride, red, width;
  std::size_t apart;  // elements per texel in a separate buffer of the width; 0: no such buffer
};
constexpr Layout kLayouts[] = {{4, 0, 3, 0}, {4, 1, 0, 0}, {4, 0, 1, 2},
                               {3, 0, 0, 2}, {3, 0, 0, 1}, {5, 1, 4, 0}};

// An Interleaved holds planar rows as texels. Elements that belong to no row are 7.
template <class T>
struct Interleaved {
  Interleaved(const Layout& layout, std::size_t count)
      : own(layout), color(count * layout.stride, T(7.0f)), width(count * layout.apart, T(7.0f)) {}
  Interleaved(const Layout& layout, const std::vector<float>& rows) : Interleaved(layout, rows.size() / 4) {
    const Buffers<T> to = buffers();
    const std::size_t count = rows.size() / 4;
    for (std::size_t i = 0; i < count; ++i) {
      to.width[i * to.width_stride] = T(rows[i]);
      for (std::size_t c = 0; c < 3; ++c) to.red[i * to.stride + c] = T(rows[(c + 1) * count + i]);
    }
  }

  Buffers<T> buffers() {
    return {(own.apart != 0 ? width : color).data() + own.width, color.data() + own.red,
            own.apart != 0 ? own.apart : own.stride, own.stride};
  }
  std::vector<float> values() const {
    std::vector<float> all;
    for (const T& value : color) all.push_back(static_cast<float>(value));
    for (const T& value : width) all.push_back(static_cast<float>(value));
    return all;
  }

  Layout own;
  std::vector<T> color, width;
};

// Returns true if texels give the same results as planar rows of the same values.
template <class T>
bool texels_agree(const Converter& converter,
                  std::size_t (*convert)(std::size_t, const Buffers<T>&, const Buffers<T>&),
                  std::vector<float> rows) {
  const std::size_t count = rows.size() / 4;
  for (float& value : rows) value = static_cast<float>(T(value));
  std::vector<float> planar(rows.size());
  const std::size_t outside =
      converter.rows_of_three(count, &rows[0], {&rows[count], &rows[2 * count], &rows[3 * count]}, &planar[0],
                              {&planar[count], &planar[2 * count], &planar[3 * count]});
  for (const Layout& layout : kLayouts) {
    const std::vector<float> expected = Interleaved<T>(layout, planar).values();
    Interleaved<T> in(layout, rows), out(layout, count);
    if (convert(count, in.buffers(), out.buffers()) != outside || !same_bits(out.values(), expected))
      return false;
    convert(count, in.buffers(), in.buffers());
    if (!same_bits(in.values(), expected)) return false;
  }
  return true;
}

// Computes what the header gives for planar `rows`. Returns 0 if its entry points agree.
int check(const Converter& converter, const std::vector<float>& rows, std::vector<float>& single) {
  if (!converter.self_test()) return fail("self_test failed");
  const std::size_t count = rows.size() / 4;

  // Converting one texel at a time defines the correct result.
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
    converter.rows_of_three(1, texel, {texel + 1, texel + 2, texel + 3}, by_row,
                            {by_row + 1, by_row + 2, by_row + 3});
    converter.texel_of_three(texel, together);
    if (!same_bits(by_row, together, 4)) {
      for (std::size_t c = 0; c < 4; ++c)
        std::fprintf(stderr, "%.9g: %.9g by row, %.9g\n", static_cast<double>(texel[c]),
                     static_cast<double>(by_row[c]), static_cast<double>(together[c]));
      return fail("a texel of three channels differs from a row of one");
    }
    for (std::size_t r = 0; r < 4; ++r) single[r * count + i] = by_row[r];
    converter.texel_of_one(texel, alone);
    for (std::size_t r = 0; r < 2; ++r) of_one[r * count + i] = alone[r];
  }

  // Converts rows at every offset at which a block can start.
  for (const std::size_t skip : {std::size_t{0}, std::size_t{1}, std::size_t{37}, std::size_t{130}}) {
    if (skip > count) continue;
    std::vector<float> batch(single);
    const std::size_t found = converter.rows_of_three(
        count - skip, &rows[skip], {&rows[count + skip], &rows[2 * count + skip], &rows[3 * count + skip]},
        &batch[skip], {&batch[count + skip], &batch[2 * count + skip], &batch[3 * count + skip]});
    if (!same_bits(batch, single)) return fail("rows differ from single texels");
    if (skip == 0 && found != outside) return fail("rows count other texels out of domain than in_domain()");
  }

  // Converts in place: all rows, then some rows.
  std::vector<float> in_place(rows);
  converter.rows_of_three(count, &in_place[0], {&in_place[count], &in_place[2 * count], &in_place[3 * count]},
                          &in_place[0], {&in_place[count], &in_place[2 * count], &in_place[3 * count]});
  if (!same_bits(in_place, single)) return fail("in place differs");
  std::vector<float> mixed(rows), width_out(count);
  converter.rows_of_one(count, &mixed[0], {&mixed[count]}, &width_out[0], {&mixed[count]});
  if (!same_bits(&mixed[count], &of_one[count], count)) return fail("one channel in place differs");
  if (!same_bits(&width_out[0], &of_one[0], count)) return fail("the width beside it differs");
  if (converter.texels != nullptr && !texels_agree(converter, converter.texels, rows))
    return fail("interleaved texels differ from rows");
  if (converter.halves != nullptr && !texels_agree(converter, converter.halves, rows))
    return fail("texels of 16 bits differ from rows");

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

// Usage: driver FOLDER. For each header, it reads FOLDER/ID.in: planar floats with the width and three
// channels of each texel. It writes FOLDER/ID.out: the results in the same form, and the number of texels out
// of domain as one float.
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
