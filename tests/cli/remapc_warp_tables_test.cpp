// This file tests remapc warp on tables (scattering profiles in lists and maps, measured BRDFs), and exact
// copies of maps. OpenImageIO reads the files back.
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "cli/remapc_session.hpp"
#include "support/test_image.hpp"

using namespace remap;

namespace {

constexpr int kEdge = 24;
constexpr int kRadii = 40;
constexpr double kStep = 0.1;

// Returns one of the two parameters of a wax, which vary along rows and columns.
double share(int place) { return static_cast<double>(place) / (kEdge - 1); }

// Returns albedo * exp(-r / length) / (2 pi length^2).
double profile(double albedo, double length, int radius) {
  return albedo * std::exp(-kStep * (radius + 1) / length) / (2.0 * std::numbers::pi * length * length);
}
double blue_wax(int x, int y, int radius) {
  return profile(0.3 + 0.5 * share(x), 0.5 + 0.3 * share(y), radius);
}
double yellow_wax(int x, int y, int radius) {
  return profile(0.9 - 0.4 * share(x), 0.4 + 0.35 * share(y) * share(y), radius);
}

std::vector<std::string> radius_names(const std::string& colors) {
  std::vector<std::string> names;
  for (const char color : colors)
    for (int radius = 0; radius < kRadii; ++radius)
      names.push_back(std::string(1, color) + "@" +
                      number_text(std::round(10.0 * kStep * (radius + 1)) / 10.0));
  return names;
}

// Writes a list with one grey profile per row, and the map of their numbers.
template <typename Profile>
void write_list(const Session& session, const std::string& folder, const Profile& value) {
  std::string text;
  for (const std::string& name : radius_names("Y")) text += (text.empty() ? "" : ",") + name;
  text += "\n";
  for (int y = 0; y < kEdge; ++y)
    for (int x = 0; x < kEdge; ++x)
      for (int radius = 0; radius < kRadii; ++radius)
        text += number_text(value(x, y, radius)) + (radius + 1 < kRadii ? "," : "\n");
  session.write(folder + "/profiles.csv", text);
  write_image(session.path(folder + "/index.png"), test_spec(kEdge, kEdge, {"Y"}, OIIO::TypeUInt16),
              [](int x, int y, int) { return static_cast<float>(y * kEdge + x) / 65535.0f; });
}

template <typename Profile>
void write_map(const Session& session, const std::string& folder, const Profile& value) {
  std::filesystem::create_directories(session.path(folder));
  write_image(session.path(folder + "/profiles.exr"),
              test_spec(kEdge, kEdge, radius_names("RGB"), OIIO::TypeFloat),
              [&](int x, int y, int c) { return static_cast<float>(value(x, y, c % kRadii)); });
}

// These boxes mark the four corners, which correspond to each other.
const std::string kCorners =
    " --box 0,0,6,6 0,0,6,6 --box 18,0,24,6 18,0,24,6 --box 0,18,6,24 0,18,6,24 --box 18,18,24,24 "
    "18,18,24,24";

ProcessResult warp(const Session& session, const std::string& source, const std::string& target,
                   const Words& more) {
  return session.remapc("warp " + source + " " + target + kCorners + more);
}

// Returns the RMS distance between the position of a texel and the position that it was copied from, relative
// to the width of the map. The correct distance is 0.
double place_error(const TestImage& places) {
  const int column = places.channel("X"), row = places.channel("Y");
  double sum = 0.0;
  for (int y = 0; y < kEdge; ++y)
    for (int x = 0; x < kEdge; ++x)
      sum += std::pow(places.at(x, y, column) - static_cast<float>(x), 2) +
             std::pow(places.at(x, y, row) - static_cast<float>(y), 2);
  return std::sqrt(sum / (kEdge * kEdge)) / kEdge;
}

}  // namespace

TEST_CASE("remapc warp: profiles of a list are replaced by those of another list", "[slow]") {
  const Session session;
  write_list(session, "blue", blue_wax);
  write_list(session, "yellow", yellow_wax);
  const ProcessResult result = require_success(warp(session, "blue", "yellow", "--copy copied --json"));
  const auto json = nlohmann::json::parse(result.output);
  CHECK(json["diagnostics"]["dimensions"] == 2);
  CHECK(json["files"].size() == 3);
  const TestImage index = read_image(session.path("copied/index.exr")),
                  places = read_image(session.path("copied/template_texel.exr"));
  REQUIRE(index.spec.width == kEdge);
  const int column = places.channel("X"), row = places.channel("Y");
  for (int y = 0; y < kEdge; ++y)
    for (int x = 0; x < kEdge; ++x)
      CHECK(index.at(x, y, 0) == places.at(x, y, row) * kEdge + places.at(x, y, column));
  CHECK(place_error(places) < 0.15);  // unrelated positions would give 0.58
  CHECK(session.content("copied/profiles.csv") == session.content("yellow/profiles.csv"));
  // The copy is a valid set, which can be warped back.
  CHECK(warp(session, "copied", "blue", "--copy back").exit_code == 0);
}

TEST_CASE("remapc warp: a map of profiles is replaced by profiles of a list, and the reverse", "[slow]") {
  const Session session;
  write_map(session, "blue", blue_wax);
  write_list(session, "yellow", yellow_wax);
  const ProcessResult there = require_success(warp(session, "blue", "yellow", "--copy there"));
  CHECK(place_error(read_image(session.path("there/template_texel.exr"))) < 0.15);
  const ProcessResult back = require_success(warp(session, "yellow", "blue", "--copy back"));
  const TestImage profiles = read_image(session.path("back/profiles.exr")),
                  places = read_image(session.path("back/template_texel.exr"));
  CHECK(place_error(places) < 0.15);
  const int first = profiles.channel("G@0.1");
  REQUIRE(first >= 0);
  const int x = static_cast<int>(places.at(5, 7, places.channel("X"))),
            y = static_cast<int>(places.at(5, 7, places.channel("Y")));
  CHECK(profiles.at(5, 7, first) == static_cast<float>(blue_wax(x, y, 0)));
}
