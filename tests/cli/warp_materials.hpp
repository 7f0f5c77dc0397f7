// This file makes two materials from the same two parameters, as texture sets with strokes for remapc warp.
// The correct result is therefore known.
#pragma once

#include <cmath>
#include <functional>

#include "cli/remapc_session.hpp"
#include "lower/fit_file.hpp"
#include "support/test_image.hpp"

namespace remap::warp_cli {

inline constexpr int kSize = 96;

// A Latent holds two parameters of a surface, 0 to 1. Their pattern depends on the phase.
struct Latent {
  double u, v;
};
inline Latent latent(double x, double y, double phase) {
  constexpr double kTurn = 6.283185307179586;
  const double u = x / 41.0 + 0.4 * std::sin(kTurn * (y / 67.0 + phase));
  const double v = (x + 2.0 * y) / (59.0 + 30.0 * phase) + phase;
  return {0.5 + 0.5 * std::sin(kTurn * u), 0.5 + 0.5 * std::sin(kTurn * v)};
}

inline WarpTexel source_texel(const Latent& at) {
  const auto u = static_cast<float>(at.u), v = static_cast<float>(at.v);
  return {0.1f + 0.4f * u, 0.1f + 0.1f * u * v, 0.05f, 0.04f, 0.04f, 0.04f, 0.2f + 0.3f * v * v};
}
inline WarpTexel template_texel(const Latent& at) {
  const auto u = static_cast<float>(at.u), v = static_cast<float>(at.v);
  return {0.05f, 0.5f - 0.4f * u, 0.1f + 0.2f * v, 0.05f, 0.05f, 0.05f, 0.5f - 0.3f * v};
}

inline void write_set(const Session& session, const std::string& folder, double phase,
                      const std::function<WarpTexel(const Latent&)>& texel) {
  std::filesystem::create_directories(session.path(folder));
  const auto write = [&](const char* name, const std::vector<std::string>& channels, std::size_t first) {
    write_image(session.path(folder + "/" + name), test_spec(kSize, kSize, channels, OIIO::TypeFloat),
                [&](int x, int y, int c) {
                  const float value = texel(latent(x, y, phase))[first + static_cast<std::size_t>(c)];
                  return first == 6 ? std::sqrt(value) : value;  // roughness is the square root of alpha
                });
  };
  write("skin_diffuse.exr", {"R", "G", "B"}, 0);
  write("skin_specular.exr", {"R", "G", "B"}, 3);
  write("skin_roughness.exr", {"Y"}, 6);
}

// Returns which of the four corners of the pattern a texel is in, or -1.
inline int corner_of(const Latent& at) {
  const int u = at.u < 0.15 ? 0 : at.u > 0.85 ? 1 : -1, v = at.v < 0.15 ? 0 : at.v > 0.85 ? 1 : -1;
  return u < 0 || v < 0 ? -1 : u + 2 * v;
}

// Writes a mask for each corner.
inline void write_strokes(const Session& session, const std::string& folder, double phase) {
  for (int k = 0; k < 4; ++k)
    write_image(session.path(folder + std::to_string(k) + ".png"),
                test_spec(kSize, kSize, {"Y"}, OIIO::TypeUInt8),
                [&](int x, int y, int) { return corner_of(latent(x, y, phase)) == k ? 1.0f : 0.0f; });
}

inline void write_materials(const Session& session) {
  write_set(session, "wood", 0.1, source_texel);
  write_set(session, "stone", 0.37, template_texel);
  write_strokes(session, "wood_", 0.1);
  write_strokes(session, "stone_", 0.37);
}

// Warps wood to stone, into stony.json.
inline ProcessResult run_warp(const Session& session, const Words& more) {
  return session.remapc("warp wood stone --force -o stony.json" + more);
}

// Returns the options for the strokes of the first `pairs` corners.
inline Words mask_words(std::size_t pairs = 4) {
  Words words;
  for (const char k : std::string("0123").substr(0, pairs))
    words += std::string("--stroke wood_") + k + ".png stone_" + k + ".png";
  return words;
}

// Returns the RMS error of the warp of `given` texels, relative to the variation of the template. A constant
// result has 1.
inline double error_of(const WarpMapFit& fit, const std::function<WarpTexel(const Latent&)>& given) {
  double squares = 0.0, spread = 0.0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Latent at = latent(x, y, 0.1);
      const WarpTexel found = evaluate_warp(fit.warp, given(at)), truth = template_texel(at),
                      middle = template_texel({0.5, 0.5});
      for (const std::size_t p : {std::size_t{1}, std::size_t{2}, std::size_t{6}}) {
        squares += std::pow(static_cast<double>(found[p] - truth[p]), 2);
        spread += std::pow(static_cast<double>(truth[p] - middle[p]), 2);
      }
    }
  return std::sqrt(squares / spread);
}

inline WarpMapFit read_warp(const Session& session) {
  AnyFit any = load_any_fit(session.path("stony.json"));
  REQUIRE(std::holds_alternative<WarpMapFit>(any));
  return std::get<WarpMapFit>(std::move(any));
}

}  // namespace remap::warp_cli
