// This program makes a texture set for trying texremap: brushed copper with scratches and patina. It writes a
// roughness map (one channel, alpha) and a specular map (RGB, linear) as half-float EXR. The maps tile, and
// every run writes the same bytes.
//   scratched_metal FOLDER [SIZE]
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace {

struct Rgb {
  float red, green, blue;
};

Rgb mix(Rgb a, Rgb b, float t) {
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green), a.blue + t * (b.blue - a.blue)};
}

float mix(float a, float b, float t) { return a + t * (b - a); }

float smooth_step(float edge0, float edge1, float x) {
  const float t = std::clamp((x - edge0) / (edge1 - edge0), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// Hashes integers to [0, 1) by the finaliser of MurmurHash3 (Appleby, 2011).
float random_at(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
  std::uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ seed * 0xc2b2ae3du;
  h = (h ^ h >> 16) * 0x85ebca6bu;
  h = (h ^ h >> 13) * 0xc2b2ae35u;
  return static_cast<float>((h ^ h >> 16) >> 8) * 0x1p-24f;
}

// A Noise is periodic value noise over the unit square with `columns` x `rows` lattice cells.
struct Noise {
  std::uint32_t columns, rows, seed;

  float operator()(float u, float v) const {
    const float x = u * static_cast<float>(columns), y = v * static_cast<float>(rows);
    const auto left = static_cast<std::uint32_t>(x), top = static_cast<std::uint32_t>(y);
    const float s = smooth_step(0.0f, 1.0f, x - std::floor(x)),
                t = smooth_step(0.0f, 1.0f, y - std::floor(y));
    const auto corner = [&](std::uint32_t i, std::uint32_t j) {
      return random_at((left + i) % columns, (top + j) % rows, seed);
    };
    return mix(mix(corner(0, 0), corner(1, 0), s), mix(corner(0, 1), corner(1, 1), s), t);
  }
};

// Sums octaves of noise, each twice as fine and half as strong as the one before.
float cloud(float u, float v, std::uint32_t cells, std::uint32_t seed) {
  float sum = 0.0f, weight = 0.5f;
  for (std::uint32_t octave = 0; octave < 6; ++octave, cells *= 2, weight *= 0.5f)
    sum += weight * Noise{cells, cells, seed + octave}(u, v);
  return sum;
}

// A Scratches is a square map of the depth of the scratches, 0 to 1.
class Scratches {
 public:
  Scratches(int size, std::uint32_t count)
      : size_(size), depth_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {
    for (std::uint32_t i = 0; i < count; ++i) draw(i);
  }
  float at(int x, int y) const { return depth_[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    const auto wrap = [this](int i) { return static_cast<std::size_t>(((i % size_) + size_) % size_); };
    return wrap(y) * static_cast<std::size_t>(size_) + wrap(x);
  }

  // Draws a slightly bent line that fades towards its ends. Most lines are short and fine.
  void draw(std::uint32_t number) {
    const auto random = [&](std::uint32_t property) { return random_at(number, property, 77); };
    const float scale = static_cast<float>(size_);
    const float length = scale * (0.03f + 0.6f * std::pow(random(0), 4.0f));
    const float width = scale / 2048.0f * (0.7f + 2.5f * std::pow(random(1), 3.0f));
    const float strength = 0.3f + 0.7f * random(2);
    const float bend = 0.6f * (random(3) - 0.5f) / length;
    float angle = 6.2831853f * random(4), x = scale * random(5), y = scale * random(6);
    for (float walked = 0.0f; walked < length; walked += 0.5f) {
      x += 0.5f * std::cos(angle);
      y += 0.5f * std::sin(angle);
      angle += 0.5f * bend;
      stamp(x, y, width, strength * std::sin(3.14159265f * walked / length));
    }
  }

  void stamp(float x, float y, float width, float strength) {
    const int reach = static_cast<int>(std::ceil(2.0f * width));
    const int middle_x = static_cast<int>(std::floor(x)), middle_y = static_cast<int>(std::floor(y));
    for (int j = middle_y - reach; j <= middle_y + reach; ++j)
      for (int i = middle_x - reach; i <= middle_x + reach; ++i) {
        const float dx = static_cast<float>(i) + 0.5f - x, dy = static_cast<float>(j) + 0.5f - y;
        float& depth = depth_[index(i, j)];
        depth = std::max(depth, strength * std::exp(-(dx * dx + dy * dy) / (width * width)));
      }
  }

  int size_;
  std::vector<float> depth_;
};

struct Texel {
  float alpha;
  Rgb specular;
};

Texel metal_at(float u, float v, float scratch) {
  constexpr Rgb kCopper{0.93f, 0.62f, 0.50f}, kGold{0.98f, 0.76f, 0.36f}, kPatina{0.11f, 0.20f, 0.16f};
  // Brush marks run along u, so the noise has few cells along u and many across.
  const float brush = 0.6f * Noise{6, 700, 1}(u, v) + 0.4f * Noise{17, 1500, 2}(u, v);
  const float hue = smooth_step(0.35f, 0.65f, cloud(u, v, 2, 10));
  const float patina =
      smooth_step(0.57f, 0.64f, cloud(u, v, 4, 30)) * (1.0f - smooth_step(0.25f, 0.6f, scratch));

  const float bare_alpha = 0.05f + 0.22f * brush + 0.12f * cloud(u, v, 5, 50) + 0.35f * scratch;
  const float patina_alpha = 0.5f + 0.4f * cloud(u, v, 24, 70);
  Rgb bare = mix(kCopper, kGold, hue);
  bare = mix(bare, {0.0f, 0.0f, 0.0f}, 0.12f * brush + 0.25f * scratch);
  return {std::clamp(mix(bare_alpha, patina_alpha, patina), 0.03f, 0.9f), mix(bare, kPatina, patina)};
}

bool write_map(const std::string& path, int size, std::vector<std::string> channels,
               const std::vector<float>& texels) {
  OIIO::ImageSpec spec(size, size, static_cast<int>(channels.size()), OIIO::TypeDesc::HALF);
  spec.channelnames = std::move(channels);
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  const auto output = OIIO::ImageOutput::create(path);
  const bool written = output && output->open(path, spec) &&
                       output->write_image(OIIO::TypeDesc::FLOAT, texels.data()) && output->close();
  if (!written)
    std::fprintf(stderr, "scratched_metal: %s: cannot be written: %s\n", path.c_str(),
                 output ? output->geterror().c_str() : OIIO::geterror().c_str());
  return written;
}

}  // namespace

int main(int argc, char** argv) {
  const int size = argc > 2 ? std::atoi(argv[2]) : 2048;
  if (argc < 2 || argc > 3 || size < 1 || size > 16384) {
    std::fprintf(stderr, "Usage: scratched_metal FOLDER [SIZE, 1 to 16384]\n");
    return 2;
  }
  const Scratches scratches(size, 420);
  std::vector<float> roughness, specular;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(size);
      const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(size);
      const Texel texel = metal_at(u, v, scratches.at(x, y));
      roughness.push_back(texel.alpha);
      specular.insert(specular.end(), {texel.specular.red, texel.specular.green, texel.specular.blue});
    }
  const std::string folder = argv[1];
  const bool written = write_map(folder + "/roughness.exr", size, {"Y"}, roughness) &&
                       write_map(folder + "/specular.exr", size, {"R", "G", "B"}, specular);
  return written ? 0 : 1;
}
