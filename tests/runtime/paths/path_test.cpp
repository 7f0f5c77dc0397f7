// This file tests paths through graphs of converters that only have descriptions: against every possible
// path, and refusals.
#include "remap/path.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "remap/shipped_converters.hpp"
#include "runtime/convert/named_converters.hpp"
#include "support/error_of.hpp"

using namespace remap;
using Names = std::vector<std::string>;

namespace {

class PathConverters : public NamedConverters {
 public:
  void add(const std::string& source, const std::string& target, std::optional<double> image_error,
           const std::string& suffix = "") {
    ConverterInfo made = info(source, target, image_error);
    made.id += suffix;
    NamedConverters::add(std::move(made));
  }
  ConverterGraph graph() const { return ConverterGraph(pointers()); }
};

Names ids(const ConverterPath& path) {
  Names names;
  for (const Converter* step : path.steps) names.push_back(step->info().id);
  return names;
}

Names least(const PathConverters& converters, const PathRequest& request) {
  return ids(converters.graph().find_paths(request).front());
}

std::string refusal(const PathConverters& converters, const PathRequest& request) {
  return error_of([&] { converters.graph().find_paths(request); }, ErrorKind::kUsage);
}

// Collects every path of `request` by walking on from its start in every allowed direction.
void walk_on(const std::vector<const Converter*>& converters, const PathRequest& request,
             const ConverterPath& beginning, std::vector<ConverterPath>& found) {
  const Names visited = beginning.steps.empty() ? Names{request.source} : path_models(beginning);
  if (visited.back() == request.target) {
    auto from = visited.begin();
    for (const std::string& model : request.via) from = std::find(from, visited.end(), model);
    if (from != visited.end()) found.push_back(beginning);
    return;
  }
  for (const Converter* converter : converters) {
    const ConverterInfo& info = converter->info();
    const bool seen = std::find(visited.begin(), visited.end(), info.target.model) != visited.end();
    if (info.source.model != visited.back() || seen) continue;
    ConverterPath longer = beginning;
    longer.steps.push_back(converter);
    longer.expected_error += expected_error(info);
    walk_on(converters, request, longer, found);
  }
}

}  // namespace

TEST_CASE("path: the least expected error wins over the fewest steps") {
  PathConverters converters;
  converters.add("r/a", "r/c", 0.5);
  converters.add("r/a", "r/b", 0.125);
  converters.add("r/b", "r/c", 0.25);
  const auto paths = converters.graph().find_paths({"r/a", "r/c", {}}, 5);
  REQUIRE(paths.size() == 2);
  CHECK(ids(paths[0]) == Names{"r_a_to_r_b", "r_b_to_r_c"});
  CHECK(paths[0].expected_error == 0.375);
  CHECK(path_models(paths[0]) == Names{"r/a", "r/b", "r/c"});
  CHECK(ids(paths[1]) == Names{"r_a_to_r_c"});
  CHECK(paths[1].expected_error == 0.5);
}

TEST_CASE(
    "path: what is expected of a step holds the errors of its fit, relative to the middle of its domain") {
  ConverterInfo info;
  info.source.roughness = RoughnessEncoding::kRoughness;
  info.roughness = {0.0, 1.0};
  info.specular = {0.0, 0.5};
  info.image_rms_error = 0.06;
  CHECK(expected_error(info) == 0.06);
  info.roughness_rms_error = 0.01;  // 2 % of alpha 0.5
  info.specular_rms_error = 0.005;  // 2 % of specular 0.25
  CHECK(expected_error(info) == Approx(std::sqrt(0.0036 + 0.0008 + 0.0004)));
  info.image_rms_error.reset();
  CHECK(expected_error(info) == Approx(std::sqrt(0.01 + 0.0008 + 0.0004)));
}

TEST_CASE("path: a formula without image error counts with the stated one") {
  PathConverters converters;
  converters.add("r/a", "r/c", {});
  converters.add("r/a", "r/b", 0.04);
  converters.add("r/b", "r/c", 0.04);
  CHECK(least(converters, {"r/a", "r/c", {}}).size() == 2);
  converters.add("r/a", "r/d", 0.07);
  converters.add("r/d", "r/e", 0.04);
  converters.add("r/a", "r/e", {});
  CHECK(least(converters, {"r/a", "r/e", {}}) == Names{"r_a_to_r_e"});
  CHECK(kAssumedImageError == 0.1);
}

TEST_CASE("path: of two converters between the same models the better is taken") {
  PathConverters converters;
  converters.add("r/a", "r/b", {}, "_published");
  converters.add("r/a", "r/b", 0.06);
  const auto paths = converters.graph().find_paths({"r/a", "r/b", {}}, 3);
  REQUIRE(paths.size() == 2);
  CHECK(ids(paths[0]) == Names{"r_a_to_r_b"});
  CHECK(ids(paths[1]) == Names{"r_a_to_r_b_published"});
}

TEST_CASE("path: ties go to fewer steps, then to the first ids, whatever the order of the converters") {
  PathConverters converters;
  converters.add("r/a", "r/z", 0.3);
  converters.add("r/a", "r/b", 0.1);
  converters.add("r/b", "r/z", 0.2);
  converters.add("r/a", "r/c", 0.2);
  converters.add("r/c", "r/z", 0.1);
  std::vector<const Converter*> order = converters.pointers();
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(order.begin(), order.end(), random);
    const auto paths = ConverterGraph(order).find_paths({"r/a", "r/z", {}}, 9);
    REQUIRE(paths.size() == 3);
    CHECK(ids(paths[0]) == Names{"r_a_to_r_z"});
    CHECK(ids(paths[1]) == Names{"r_a_to_r_b", "r_b_to_r_z"});
    CHECK(ids(paths[2]) == Names{"r_a_to_r_c", "r_c_to_r_z"});
  }
}

TEST_CASE("path: the best of a random graph are the best of all there are") {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> model(0, 6), error(0, 8);
  for (int trial = 0; trial < 60; ++trial) {
    PathConverters converters;
    for (int i = 0; i < 16; ++i) {
      const int from = model(random), to = model(random);
      if (from != to)
        converters.add("r/" + std::to_string(from), "r/" + std::to_string(to), error(random) / 8.0,
                       "_" + std::to_string(i));
    }
    const ConverterGraph graph = converters.graph();
    const Names& known = graph.models();
    PathRequest request{known[0], known[known.size() - 1], {}};
    if (trial % 2 == 1) request.via = {known[2]};
    if (trial % 4 == 3) request.via.push_back(known[1]);
    std::vector<ConverterPath> all;
    walk_on(converters.pointers(), request, {}, all);
    std::sort(all.begin(), all.end(), [](const ConverterPath& a, const ConverterPath& b) {
      return std::tuple(a.expected_error, a.steps.size(), ids(a)) <
             std::tuple(b.expected_error, b.steps.size(), ids(b));
    });
    if (all.empty()) {
      CHECK_THROWS_AS(graph.find_paths(request), Error);
      continue;
    }
    const std::vector<ConverterPath> found = graph.find_paths(request, 4);
    REQUIRE(found.size() == std::min<std::size_t>(4, all.size()));
    for (std::size_t i = 0; i < found.size(); ++i) {
      CHECK(ids(found[i]) == ids(all[i]));
      CHECK(found[i].expected_error == all[i].expected_error);
    }
  }
}

TEST_CASE("path: a graph of many models is searched at once, also where no second path exists") {
  PathConverters converters;
  converters.add("r/in", "r/0", 0.1);
  converters.add("r/0", "r/out", 0.1);
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      if (i != j) converters.add("r/" + std::to_string(i), "r/" + std::to_string(j), 0.0);
  CHECK(converters.graph().find_paths({"r/in", "r/out", {}}, 3).size() == 1);
  CHECK_THAT(refusal(converters, {"r/in", "r/out", {"r/7"}}),
             Catch::Contains("r/in -> r/0 -> r/7 -> r/0 -> r/out: visits r/0 twice"));
}

TEST_CASE("path: --via leads through models in their order") {
  PathConverters converters;
  for (const char* from : {"r/a", "r/b", "r/c", "r/d"})
    for (const char* to : {"r/a", "r/b", "r/c", "r/d"})
      if (std::string(from) != to) converters.add(from, to, 0.1);
  CHECK(least(converters, {"r/a", "r/d", {}}) == Names{"r_a_to_r_d"});
  CHECK(least(converters, {"r/a", "r/d", {"r/c"}}) == Names{"r_a_to_r_c", "r_c_to_r_d"});
  CHECK(least(converters, {"r/a", "r/d", {"r/c", "r/b"}}) == Names{"r_a_to_r_c", "r_c_to_r_b", "r_b_to_r_d"});
}

TEST_CASE("path: a model that would be visited twice is wrong usage") {
  PathConverters converters;
  converters.add("r/a", "r/hub", 0.1);
  converters.add("r/hub", "r/a", 0.1);
  converters.add("r/hub", "r/b", 0.1);
  converters.add("r/b", "r/hub", 0.1);
  converters.add("r/hub", "r/c", 0.1);
  const std::string twice = ": the path would use this model twice (choose another model)";
  CHECK(refusal(converters, {"r/a", "r/a", {}}) ==
        "r/a: source and target are the same model (choose another model for one of them)");
  CHECK(refusal(converters, {"r/a", "r/b", {"r/a"}}) == "r/a" + twice);
  CHECK(refusal(converters, {"r/a", "r/b", {"r/b"}}) == "r/b" + twice);
  CHECK(refusal(converters, {"r/a", "r/c", {"r/hub", "r/hub"}}) == "r/hub" + twice);
  CHECK(refusal(converters, {"r/a", "r/c", {"r/b"}}) ==
        "r/a -> r/hub -> r/b -> r/hub -> r/c: visits r/hub twice, as every path through these models does "
        "(choose other models)");
}

TEST_CASE("path: a missing link is named from both sides, with the nearest model that is reached") {
  PathConverters converters;
  converters.add("mitsuba/ward", "mitsuba/as", 0.1);
  converters.add("mitsuba/as", "mitsuba/ggx", 0.1);
  converters.add("cycles/beckmann", "cycles/ggx", 0.1);
  CHECK(refusal(converters, {"mitsuba/ward", "cycles/ggx", {}}) ==
        "mitsuba/ward to cycles/ggx: no converters join these models (mitsuba/ward can become mitsuba/as, "
        "mitsuba/ggx; most similar name: mitsuba/ggx; cycles/ggx can be made from cycles/beckmann)");
  CHECK(
      refusal(converters, {"mitsuba/ggx", "mitsuba/ward", {}}) ==
      "mitsuba/ggx to mitsuba/ward: no converters join these models (mitsuba/ggx can become no other model; "
      "no model can become mitsuba/ward)");
  CHECK_THAT(refusal(converters, {"mitsuba/ward", "mitsuba/ggx", {"cycles/ggx"}}),
             Catch::Contains("mitsuba/ward to cycles/ggx: no converters join these models"));
}

TEST_CASE("path: an unknown model is answered with the nearest") {
  PathConverters converters;
  converters.add("mitsuba/ward", "mitsuba/as", 0.1);
  CHECK(refusal(converters, {"mitsuba/wrad", "mitsuba/as", {}}) ==
        "unknown source model 'mitsuba/wrad' (did you mean mitsuba/ward?)");
  CHECK_THAT(refusal(converters, {"mitsuba/ward", "mitsuba/sa", {}}),
             Catch::Contains("unknown target model 'mitsuba/sa'"));
  CHECK_THAT(refusal(converters, {"mitsuba/ward", "mitsuba/as", {"mitsuba/wrd"}}),
             Catch::Contains("unknown model 'mitsuba/wrd' (did you mean mitsuba/ward?)"));
}

TEST_CASE("path: of what ships, one step is what one converter gives") {
  for (const auto& converter : shipped_converters()) {
    const ConverterInfo& info = converter->info();
    const auto paths = shipped_graph().find_paths({info.source.model, info.target.model, {}});
    CHECK(paths.front().steps.size() == 1);
    if (info.image_rms_error) CHECK(paths.front().steps.front()->info().id == info.id);
    CHECK(path_models(paths.front()).front() == info.source.model);
    CHECK(path_models(paths.front()).back() == info.target.model);
  }
}

TEST_CASE("path: without detours no path goes round a converter, but through what it is led through") {
  PathConverters converters;
  converters.add("r/a", "r/c", 0.5);
  converters.add("r/a", "r/b", 0.125);
  converters.add("r/b", "r/c", 0.25);
  converters.add("r/c", "r/d", 0.25);
  converters.add("r/b", "r/d", 0.75);
  const ConverterGraph graph(converters.pointers(), Detours::kRefused);
  const auto paths = graph.find_paths({"r/a", "r/c", {}}, 5);
  REQUIRE(paths.size() == 1);
  CHECK(ids(paths[0]) == Names{"r_a_to_r_c"});
  CHECK(paths[0].expected_error == 0.5);
  // The path by b and c would cost 0.625. Neither of the two remaining paths has a shortcut.
  const auto far = graph.find_paths({"r/a", "r/d", {}}, 5);
  REQUIRE(far.size() == 2);
  CHECK(ids(far[0]) == Names{"r_a_to_r_c", "r_c_to_r_d"});
  CHECK(ids(far[1]) == Names{"r_a_to_r_b", "r_b_to_r_d"});
  CHECK(ids(graph.find_paths({"r/a", "r/c", {"r/b"}}).front()) == Names{"r_a_to_r_b", "r_b_to_r_c"});
}

TEST_CASE("path: between the same models a measured match wins over a formula that nobody compared") {
  PathConverters converters;
  converters.add("r/a", "r/c", 0.5);
  converters.add("r/a", "r/c", std::nullopt, "_published");
  converters.add("r/c", "r/d", std::nullopt);
  const ConverterGraph graph(converters.pointers(), Detours::kRefused);
  const auto paths = graph.find_paths({"r/a", "r/c", {}}, 5);
  REQUIRE(paths.size() == 2);
  CHECK(ids(paths[0]) == Names{"r_a_to_r_c"});
  CHECK(ids(paths[1]) == Names{"r_a_to_r_c_published"});
  CHECK(paths[1].expected_error >= 0.5);
  CHECK(graph.find_paths({"r/a", "r/d", {}}).front().expected_error == Approx(0.5 + kAssumedImageError));
}

TEST_CASE("path: a converter that was composed of others is taken in their place") {
  PathConverters converters;
  converters.add("r/a", "r/b", 0.25);
  converters.add("r/b", "r/c", 0.5);
  converters.add("r/a", "r/c", std::nullopt, "_chain");
  const ConverterGraph graph(converters.pointers(), Detours::kRefused);
  CHECK(ids(graph.find_paths({"r/a", "r/c", {}}).front()) == Names{"r_a_to_r_c_chain"});
}
