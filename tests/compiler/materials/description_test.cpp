// This file tests descriptions of translations: the meaning of the language, and what it refuses.
// tests/oracles/materials.py evaluates the descriptions that ship.
#include "materials/description.hpp"

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "support/error_of.hpp"

using namespace remap;

namespace {

const std::string kModels =
    "model a A 1\n  color 0.8 0.8 0.8\n  weight 1\n  unused 0.5\n\nmodel b B 2\n  shade 0 0 0\n  power 0\n";

MaterialLibrary library_of(const std::string& statements,
                           const std::string& functions = "f0(n) = ((n - 1) / (n + 1))^2\n") {
  MaterialLibrary library{
      parse_models(kModels, "models.txt"), parse_functions(functions, "functions.txt"), {}};
  library.translations.push_back(
      parse_translation(statements, "a_to_b.txt", library.models[0], library.models[1], library.functions));
  return library;
}

std::string refusal(const std::string& statements, const std::string& functions = "f0(n) = n\n") {
  return error_of([&] { library_of(statements, functions); });
}

}  // namespace

TEST_CASE("materials: a description becomes statements, comments stay, unused inputs are known") {
  const MaterialLibrary library = library_of(
      "# A to B.\n# Lost: nothing.\n\nw = source.weight\n# Twice as bright.\ntarget.shade = source.color\n  "
      "* 2\n"
      "target.power = w > 0.5 ? f0(w) : 0\n");
  const Translation& translation = library.translations[0];
  CHECK(translation.id() == "a_to_b");
  CHECK(translation.comment == "A to B.\nLost: nothing.");
  REQUIRE(translation.lines.size() == 3);
  CHECK(translation.lines[1].comment == "Twice as bright.");
  CHECK(translation.lines[1].type == ValueType::kColor);
  CHECK(translation.ignored() == std::vector<std::string>{"unused"});
  const std::string header = materials_header(library), module = materials_module(library);
  CHECK_THAT(header, Catch::Contains("  // Twice as bright.\n  target.shade = source.color * 2.0f;\n"));
  CHECK_THAT(header, Catch::Contains("  target.power = (w > 0.5f ? f0(w) : 0.0f);\n"));
  CHECK_THAT(module, Catch::Contains("        target.shade = _color(source.color * 2)\n"));
  CHECK_THAT(module, Catch::Contains("    (\"a\", \"b\"): (\"unused\",),\n"));
}

TEST_CASE("materials: equal operations are one node, a function of each type is one definition") {
  const MaterialLibrary library = library_of(
      "target.shade = f0(source.color) * (source.weight + 1)\ntarget.power = f0(source.weight + 1)\n");
  const std::string graphs = materials_graphs(library);
  const auto count = [&](const std::string& text) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = graphs.find(text, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  const std::size_t graph = graphs.find("NG_a_to_b");
  CHECK(count("<nodegraph name=\"NG_remap_f0_") == 2);
  CHECK(graphs.find("<add ", graph) == graphs.rfind("<add "));
}

TEST_CASE("materials: what a description may not say is refused with its line") {
  CHECK(refusal("w = 1\nw = 2\n") == "a_to_b.txt:2: 'w' has a value already");
  CHECK(refusal("target.shade = source.colour\n") == "a_to_b.txt:1: unknown name 'source.colour'");
  CHECK(refusal("target.glow = 1\n") == "a_to_b.txt:1: b does not have the input 'glow'");
  CHECK(refusal("target.power = source.color\n") ==
        "a_to_b.txt:1: target.power is a number, but the value is a color");
  CHECK(refusal("power = 1\n") == "a_to_b.txt:1: 'power' is the name of an input (choose another)");
  CHECK(refusal("w = source.color > 1 ? 1 : 0\n") ==
        "a_to_b.txt:1: colors cannot be compared (compare a channel, or the largest)");
  CHECK(refusal("w = largest(1)\n") == "a_to_b.txt:1: largest of a value that is not a color");
  CHECK(refusal("w = f1(1)\n") == "a_to_b.txt:1: unknown function 'f1'");
  CHECK(refusal("w = f0(1, 2)\n") == "a_to_b.txt:1: f0 has 2 terms instead of 1");
  CHECK(refusal("w = 2^5\n") == "a_to_b.txt:1: the exponent of ^ is not 2, 3 or 4 (use pow)");
  CHECK(refusal("w = (1 + 2\n") == "a_to_b.txt:1: ')' is missing before ''");
  CHECK(refusal("w = 1 2\n") == "a_to_b.txt:1: '2' is left over");
  CHECK(refusal("w\n") == "a_to_b.txt:1: '=' is missing");
  CHECK(refusal("w = 1..2\n") == "a_to_b.txt:1: '1..2' is not a number");
  CHECK(refusal("w = 1\n", "g(n) = m\n") == "functions.txt:1: unknown name 'm'");
}

TEST_CASE("materials: what ships is complete") {
  const MaterialLibrary& library = material_library();
  CHECK(library.models.size() == 5);
  CHECK(library.translations.size() == 9);
  for (const Translation& translation : library.translations) {
    INFO(translation.id());
    CHECK_FALSE(translation.comment.empty());
    // Every model has roughness and a color.
    for (const char* word : {"oughness", "olor"})
      CHECK(std::any_of(translation.lines.begin(), translation.lines.end(), [&](const Statement& line) {
        return line.name.starts_with("target.") && line.name.find(word) != std::string::npos;
      }));
  }
}
