// This file tests which model looks most similar, with invented converters of known errors, pictures and
// domains.
#include <algorithm>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "remap/path.hpp"
#include "runtime/convert/named_converters.hpp"

using namespace remap;
using Names = std::vector<std::string>;

namespace {

class RatedConverters : public NamedConverters {
 public:
  void add(const std::string& source, const std::string& target, std::optional<double> image_error,
           std::optional<PictureDifference> pictures = {}, double largest_specular = 1.0) {
    ConverterInfo made = info(source, target, image_error);
    made.specular.max = largest_specular;
    made.pictures = pictures;
    NamedConverters::add(std::move(made));
  }
  ConverterGraph graph() const { return ConverterGraph(pointers(), Detours::kRefused); }
  ConverterPath path(const std::string& source, const std::string& target) const {
    return graph().find_paths({source, target, {}}).front();
  }
  // Returns the model of `renderer` that is closest to `source`.
  std::string closest(const std::string& source, const std::string& renderer) const {
    return target_model(closest_path(graph().paths_to_renderer({source, renderer, {}})));
  }
  // Returns the model that looks more similar than `target`, or `none`.
  std::string closer(const std::string& source, const std::string& target) const {
    const ConverterGraph whole = graph();
    std::vector<ConverterPath> others;
    for (const std::string& model : whole.reachable_from(source)) others.push_back(path(source, model));
    const std::optional<ConverterPath> found = closer_path(path(source, target), others);
    return found ? target_model(*found) : "none";
  }
};

}  // namespace

TEST_CASE("closeness: the renderer of a model is what stands before the first slash") {
  CHECK(renderer_of("cycles-5/ggx") == "cycles-5");
  CHECK(renderer_of("studio/cycles/ggx") == "studio");
  CHECK(renderer_of("metallic").empty());
  RatedConverters converters;
  converters.add("r/a", "r/b", 0.1);
  converters.add("r/a", "r2/c", 0.1);
  converters.add("r/a", "alone", 0.1);
  const ConverterGraph graph = converters.graph();
  CHECK(graph.models_of("r") == Names{"r/a", "r/b"});
  CHECK(graph.models_of("r2") == Names{"r2/c"});
  CHECK(graph.models_of("alone").empty());
  CHECK(graph.models_of("").empty());
  CHECK(graph.has_model("alone"));
  CHECK_FALSE(graph.has_model("r"));
}

TEST_CASE("closeness: paths to a renderer leave out the source, models between, and what is not reached") {
  RatedConverters converters;
  converters.add("r/a", "r/b", 0.1);
  converters.add("r/b", "r/c", 0.1);
  converters.add("r/d", "r/a", 0.1);
  const ConverterGraph graph = converters.graph();
  const auto targets = [&](const PathRequest& request) {
    Names names;
    for (const ConverterPath& path : graph.paths_to_renderer(request)) names.push_back(target_model(path));
    return names;
  };
  CHECK(targets({"r/a", "r", {}}) == Names{"r/b", "r/c"});
  CHECK(targets({"r/a", "r", {"r/b"}}) == Names{"r/c"});
  CHECK(targets({"r/c", "r", {}}).empty());
  CHECK(targets({"r/a", "s", {}}).empty());
  CHECK_THROWS_WITH(targets({"r/x", "r", {}}), Catch::StartsWith("unknown source model 'r/x'"));
}

TEST_CASE("closeness: a renderer in the place of a model is refused with its models") {
  RatedConverters converters;
  converters.add("r/a", "s/b", 0.1);
  converters.add("r/c", "s/b", 0.1);
  const ConverterGraph graph = converters.graph();
  CHECK_THROWS_WITH(graph.find_paths({"r", "s/b", {}}),
                    "r: is a renderer, not a model (choose one of its models: r/a, r/c)");
  CHECK_THROWS_WITH(graph.find_paths({"r/a", "s", {}}),
                    "s: is a renderer, not a model (choose one of its models: s/b)");
  // If no converter starts from a source, the message does not offer it.
  CHECK_THROWS_WITH(graph.find_paths({"s", "r/a", {}}), Catch::StartsWith("unknown source model 's'"));
}

TEST_CASE("closeness: the closest model of a renderer has the least expected error, at any number of steps") {
  RatedConverters converters;
  converters.add("a/source", "b/direct", 0.2);
  converters.add("a/source", "a/hub", 0.05);
  converters.add("a/hub", "b/far", 0.06);
  converters.add("a/source", "c/other", 0.01);
  CHECK(converters.closest("a/source", "b") == "b/far");
}

TEST_CASE("closeness: of models whose errors agree in three digits the first by name is the closest") {
  RatedConverters converters;
  converters.add("a/source", "b/y", 0.05001);
  converters.add("a/source", "b/x", 0.05009);
  CHECK(converters.closest("a/source", "b") == "b/x");
  converters.add("a/source", "b/z", 0.04999);
  CHECK(converters.closest("a/source", "b") == "b/z");
}

TEST_CASE("closeness: a model that covers few materials is not the closest, nor called closer") {
  RatedConverters converters;
  converters.add("a/source", "b/dielectric", 0.01, {}, 0.08);
  converters.add("a/source", "b/metal", 0.2);
  CHECK(converters.closest("a/source", "b") == "b/metal");
  CHECK(converters.closer("a/source", "b/metal") == "none");
  converters.add("a/source", "b/most", 0.05, {}, 0.5);
  CHECK(converters.closest("a/source", "b") == "b/most");
  CHECK(converters.closer("a/source", "b/metal") == "b/most");
  // The source is a dielectric itself, so the range of a dielectric is not too narrow for it.
  converters.add("d/source", "b/dielectric", 0.01, {}, 0.08);
  converters.add("d/source", "b/metal", 0.2, {}, 0.08);
  CHECK(converters.closest("d/source", "b") == "b/dielectric");
  CHECK(converters.closer("d/source", "b/metal") == "b/dielectric");
}

TEST_CASE("closeness: what a later step does not cover counts as not covered") {
  RatedConverters converters;
  converters.add("a/source", "a/hub", 0.0);
  converters.add("a/hub", "b/dielectric", 0.01, {}, 0.08);
  converters.add("a/hub", "b/metal", 0.2);
  CHECK(converters.closest("a/source", "b") == "b/metal");
  CHECK(converters.closer("a/source", "b/metal") == "none");
}

TEST_CASE("closeness: a model of the same renderer with at most half the error looks closer") {
  RatedConverters converters;
  converters.add("a/source", "b/x", 0.25);
  converters.add("a/source", "b/y", 0.126);
  converters.add("a/source", "c/z", 0.01);
  CHECK(converters.closer("a/source", "b/x") == "none");
  converters.add("a/source", "b/half", 0.125);
  CHECK(converters.closer("a/source", "b/x") == "b/half");
  converters.add("a/source", "b/best", 0.08);
  CHECK(converters.closer("a/source", "b/x") == "b/best");
  CHECK(converters.closer("a/source", "b/half") == "none");
  CHECK(converters.closer("a/source", "b/best") == "none");
  CHECK(converters.closer("a/source", "c/z") == "none");
}

TEST_CASE("closeness: names without a renderer have no other models") {
  RatedConverters converters;
  converters.add("a/source", "x", 0.5);
  converters.add("a/source", "y", 0.1);
  CHECK(converters.closer("a/source", "x") == "none");
}

TEST_CASE("closeness: where nobody sees a difference no model is called closer") {
  RatedConverters converters;
  converters.add("a/source", "b/x", kUnseenError);
  converters.add("a/source", "b/y", 0.001);
  CHECK(converters.closer("a/source", "b/x") == "none");
  converters.add("a/source", "b/z", 1.01 * kUnseenError);
  CHECK(converters.closer("a/source", "b/z") == "b/y");
}

TEST_CASE("closeness: pictures that were never compared are not judged") {
  RatedConverters converters;
  converters.add("a/source", "b/formula", {});
  converters.add("a/source", "b/far", 0.5);
  converters.add("a/source", "c/x", 0.01);
  converters.add("a/hub", "c/x", {});
  converters.add("a/hub", "c/y", 0.01);
  CHECK(expected_error(converters.path("a/source", "b/formula").steps.front()->info()) == 0.1);
  CHECK(converters.closer("a/source", "b/far") == "none");
  CHECK(converters.closer("a/hub", "c/x") == "none");
  CHECK_FALSE(is_measured(converters.path("a/source", "b/formula")));
  CHECK(is_measured(converters.path("a/source", "b/far")));
}

TEST_CASE("closeness: differences of pictures are measured, or estimated from image errors") {
  RatedConverters converters;
  converters.add("a/a", "a/b", 0.1, PictureDifference{3.0, 12.0});
  converters.add("a/b", "a/c", 4.0 / kPercentOfImageError);
  converters.add("a/c", "a/d", {});
  const auto measured = picture_difference(converters.path("a/a", "a/b"));
  CHECK(measured->converted == 3.0);
  CHECK(measured->copied == 12.0);
  CHECK_FALSE(measured->is_estimate);
  const auto estimated = picture_difference(converters.path("a/a", "a/c"));
  CHECK(estimated->converted == Approx(5.0));  // the square root of 3^2 + 4^2
  CHECK_FALSE(estimated->copied.has_value());
  CHECK(estimated->is_estimate);
  CHECK(picture_difference(converters.path("a/b", "a/c"))->is_estimate);
  CHECK_FALSE(picture_difference(converters.path("a/a", "a/d")).has_value());
  CHECK(picture_difference({})->converted == 0.0);
  CHECK_FALSE(picture_difference({})->is_estimate);
}
