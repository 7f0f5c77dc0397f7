// This file compares the metals of scripts/studies/conductors with the database.
#include <algorithm>
#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "core/files.hpp"
#include "renderer/fresnel.hpp"
#include "support/shared_data.hpp"
#include "support/skip.hpp"

using namespace remap;

namespace {

// Returns the record of a material in the database.
nlohmann::json record(const nlohmann::json& database, const std::string& name) {
  for (const nlohmann::json& item : database.at("data"))
    if (item.at("name") == name) return item;
  FAIL("the database has no " + name);
  return {};
}

bool is_linear_srgb(const nlohmann::json& index) { return index.at("colorSpace") == "srgb-linear"; }

nlohmann::json metals() {
  return nlohmann::json::parse(read_file(REMAP_SOURCE_DIR "/scripts/studies/metals.json")).at("metals");
}

}  // namespace

TEST_CASE("metals: named once, with a source, and physical") {
  std::set<std::string> names;
  for (const nlohmann::json& metal : metals()) {
    CHECK(names.insert(metal["name"]).second);
    CHECK(metal["source"].get<std::string>().size() > 3);
    for (std::size_t c = 0; c < 3; ++c) {
      const double f0 = normal_reflectance({metal["eta"][c], metal["k"][c]});
      CHECK(f0 > 0.1);
      CHECK(f0 <= 1.0);
    }
  }
  CHECK(names.size() == 30);
}

TEST_CASE("metals: values equal those of the database", "[needs]") {
  const auto path = shared_data("materials/physicallybased.json");
  if (path.empty()) return;
  const nlohmann::json database = nlohmann::json::parse(read_file(path));
  for (const nlohmann::json& metal : metals()) {
    const auto item = record(database, metal["name"]);
    const auto& indices = item.at("complexIor");
    CHECK(std::count_if(indices.begin(), indices.end(), is_linear_srgb) == 1);
    for (const nlohmann::json& index : indices) {
      if (!is_linear_srgb(index)) continue;
      CHECK(index.at("n") == metal["eta"]);
      CHECK(index.at("k") == metal["k"]);
    }
  }
}
