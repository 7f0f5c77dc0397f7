// This file tests the size limits of fits that are read and written.
#include <catch2/catch.hpp>

#include "lower/fit_file.hpp"
#include "remap/error.hpp"
#include "support/example_fit.hpp"

using namespace remap;

namespace {

// Returns the message of oversize() for a fit with this mapping. Checks that writing this fit fails with the
// same message, or succeeds if there is none.
std::string refusal(const MappingKind& mapping) {
  Fit fit = example_fit();
  fit.mapping = mapping;
  const std::string fault = oversize(fit);
  if (fault.empty())
    CHECK(fit_from_json(fit_to_json(fit), "x.json") == fit);
  else
    CHECK_THROWS_WITH(fit_to_json(fit), fit.id + ": " + fault);
  return fault;
}

Parametric parametric(std::size_t rows, std::size_t columns, std::size_t terms) {
  return {std::vector<std::vector<double>>(rows, std::vector<double>(columns, 0.01)),
          std::vector<SpecularTerm>(terms)};
}

Svr svr(std::size_t vectors) {
  const KernelExpansion expansion{
      {{}}, {}, 1.0, 0.0, std::vector<double>(vectors, 0.5), std::vector<double>(vectors, 0.1)};
  return {expansion, expansion};
}

Mlp mlp(std::size_t layers, std::size_t units) {
  Network network{Activation::kTanh, {{}}, {{}}, {}};
  for (std::size_t i = 0, width = 1; i < layers; ++i) {
    const std::size_t own = i + 1 < layers ? units : 1;
    network.layers.push_back({width, std::vector<double>(width * own, 0.1), std::vector<double>(own, 0.1)});
    width = own;
  }
  return {network, network};
}

}  // namespace

TEST_CASE("limits: a fit at its limit is written and read, one beyond it is refused with both numbers") {
  CHECK(refusal(parametric(kMostSpecularPowers, kMostAlphaPowers, kMostTerms)).empty());
  CHECK(refusal(parametric(17, 1, 1)) ==
        "has 17 powers of specular in its roughness; at most 16 are possible");
  CHECK(refusal(parametric(1000, 1000, 1)).starts_with("has 1000 powers of specular"));
  CHECK(refusal(parametric(1, 100'000, 1)) ==
        "has 100000 powers of alpha in its roughness; at most 32 are possible");
  CHECK(refusal(parametric(1, 1, 65)) == "has 65 terms of specular; at most 64 are possible");
  CHECK(refusal(svr(kMostVectors)).empty());
  CHECK(refusal(svr(4097)) == "has 4097 support vectors; at most 4096 are possible");
  CHECK(refusal(mlp(kMostLayers, 60)).empty());
  CHECK(refusal(mlp(3000, 1)) == "has 3000 layers; at most 6 are possible");
  CHECK(refusal(mlp(3, 150)) == "has 23105 numbers in a network; at most 20000 are possible");
  CompactForm form;
  form.alpha.resize(16, {1.0f});
  CHECK(refusal(form).empty());
  form.alpha.resize(17, {1.0f});
  CHECK(refusal(form) == "has 17 powers of t; at most 16 are possible");
  form.alpha = {std::vector<float>(33, 1.0f)};
  CHECK(refusal(form) == "has 33 powers of alpha; at most 32 are possible");
}

TEST_CASE("limits: domains") {
  Fit fit = example_fit();
  fit.domain.specular.max = kLargestDomain;
  CHECK(oversize(fit).empty());
  fit.domain.alpha.max = 1e308;
  CHECK(oversize(fit) == "has a domain to 1e+308; at most 1000 is possible");
}

TEST_CASE("limits: remarks and other lines of a fit file") {
  Fit fit = example_fit();
  const auto message = [&] {
    try {
      fit_from_json(fit_to_json(fit), "x.json");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  fit.remarks = {std::string(10'001, 'x')};
  CHECK(message() == "x.json: remarks[0]: has a text of 10001 bytes, but at most 10000 can be read");
  fit.remarks.assign(1001, "x");
  CHECK(message() == "x.json: remarks: has 1001 entries, but at most 1000 can be read");
  fit = example_fit();
  for (int i = 0; i <= 1000; ++i) fit.method[std::to_string(i)] = "x";
  CHECK(message() == "x.json: method: has 1001 entries, but at most 1000 can be read");
}
