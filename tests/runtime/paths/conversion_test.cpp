// This file tests how names of models become ends of a conversion: prefixes, and which end follows the other.
#include "remap/conversion.hpp"

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "remap/shipped_converters.hpp"

using namespace remap;

namespace {

ConversionChoice choice_of(const std::string& source, const std::string& target) {
  ConversionRequest request;
  request.source = model_named(source);
  request.target = model_named(target);
  return choose_conversion(request, shipped_graph());
}

// Returns the conventions of both ends, such as `plain scaled`, and `?` if they were assumed.
std::string diffuse_of_ends(const std::string& source, const std::string& target) {
  const ConversionChoice choice = choice_of(source, target);
  return std::string(diffuse_convention_name(diffuse_of(*choice.source))) + " " +
         std::string(diffuse_convention_name(diffuse_of(*choice.target))) +
         (choice.assumptions.empty() ? "" : " ?");
}

}  // namespace

TEST_CASE("conversion: an end without a convention follows the other, unless a prefix states one") {
  CHECK(diffuse_of_ends("gltf-specgloss", "gltf") == "scaled scaled");
  CHECK(diffuse_of_ends("plain:gltf-specgloss", "gltf") == "plain scaled");
  CHECK(diffuse_of_ends("gltf-specgloss", "plain:gltf") == "scaled plain");
  CHECK(diffuse_of_ends("gltf-specgloss", "metallic") == "scaled scaled ?");
  CHECK(diffuse_of_ends("gltf-specgloss", "plain:metallic") == "scaled plain");
  CHECK(diffuse_of_ends("plain:gltf-specgloss", "metallic") == "plain plain");
  CHECK(diffuse_of_ends("specular", "gltf") == "scaled scaled ?");
  CHECK(diffuse_of_ends("plain:specular", "gltf") == "plain scaled");
  CHECK(diffuse_of_ends("specular", "metallic") == "plain plain ?");
  CHECK(diffuse_of_ends("specular", "scaled:metallic") == "scaled scaled");
  CHECK(diffuse_of_ends("scaled:specular:mitsuba/ward", "specular:mitsuba/as") == "scaled scaled");
  CHECK(diffuse_of_ends("specular:scaled:mitsuba/ward", "metallic:plain:mitsuba/ggx") == "scaled plain");
}

TEST_CASE("conversion: an assumption names what to type instead") {
  const auto assumed = [](const std::string& source, const std::string& target) {
    return choice_of(source, target).assumptions.at(0);
  };
  CHECK_THAT(assumed("gltf-specgloss", "unreal"), Catch::EndsWith("use target plain:unreal)"));
  CHECK_THAT(assumed("specular:mitsuba/ward", "metallic:mitsuba/ggx"),
             Catch::EndsWith("use source scaled:specular:mitsuba/ward)"));
}

TEST_CASE("conversion: diffuse needs a workflow") {
  CHECK_THROWS_WITH(choice_of("plain:mitsuba/ward", "mitsuba/as"),
                    Catch::Contains("write plain:specular:mitsuba/ward"));
  CHECK_THROWS_AS(choice_of("mitsuba/ward", "scaled:mitsuba/as"), Error);
}
