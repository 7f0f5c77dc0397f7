// This file tests the rule about the light of two renderers.
#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "table/check.hpp"
#include "table/table.hpp"

using namespace remap;

TEST_CASE("light: nothing is said within 1 %, a remark beyond it, an error beyond 5 % that nobody accepted") {
  for (const LightMatch& same : {LightMatch{}, LightMatch{1.009, 0.009}, LightMatch{0.991, 0.0}})
    CHECK(light_remark(same).empty());
  for (const LightMatch& said : {LightMatch{1.011, 0.0}, LightMatch{1.0, 0.011}, LightMatch{1.049, 0.3},
                                 LightMatch{0.951, 0.3}, LightMatch{1.3, 0.03, true}}) {
    CHECK_FALSE(light_remark(said).empty());
    CHECK_FALSE(is_wrong_light(said));
    CHECK_NOTHROW(require_light(said, "t.csv"));
  }
  for (const LightMatch& wrong : {LightMatch{1.051, 0.0}, LightMatch{0.949, 0.0}, LightMatch{1.3, 0.03}}) {
    CHECK_FALSE(light_remark(wrong).empty());
    CHECK(is_wrong_light(wrong));
    CHECK_THROWS_WITH(
        require_light(wrong, "t.csv"),
        Catch::StartsWith("t.csv: diffuse matches only if the light of the source is multiplied"));
  }
  CHECK(light_remark({1.1863, 0.031}) ==
        "diffuse matches only if the light of the source is multiplied by 1.186 (the diffuse pictures differ "
        "by 3.1 % after that). Therefore, specular2 is 19 % larger, which is right only if the two renderers "
        "have different light (check the diffuse of both models; --no-irradiance-matching keeps the light "
        "unchanged, --accept-light continues anyway)");
}

TEST_CASE("light: a table is checked by what its comments record") {
  std::string rows;
  for (const char* alpha : {"0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"})
    for (const char* specular : {"0.2", "0.4"})
      rows += std::string(alpha) + "," + specular + "," + alpha + "," + specular + "\n";
  const auto findings = [&](const std::string& comments, bool accept_light) {
    const Table table = parse_table(comments + "alpha1,specular1,alpha2,specular2\n" + rows, "t.csv");
    return check_table(table, accept_light);
  };
  const std::string rescaled = "# irradiance_scale: 1.262\n# diffuse_error: 0.03\n";
  CHECK(findings("# irradiance_scale: 1\n# diffuse_error: 1e-07\n", false).empty());
  REQUIRE(findings(rescaled, false).size() == 1);
  CHECK(findings(rescaled, false)[0].kind == "light");
  CHECK(findings(rescaled, false)[0].severity == Severity::kError);
  CHECK(findings(rescaled, true)[0].severity == Severity::kWarning);
  CHECK(findings(rescaled + "# light_accepted: yes\n", false)[0].severity == Severity::kWarning);
}
