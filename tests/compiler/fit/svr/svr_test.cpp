// This file tests support vector regression on the published table, on unusual tables, and against libsvm
// itself.
#include "fit/svr/svr.hpp"

#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>

#include <catch2/catch.hpp>
#include <libsvm/svm.h>

#include "core/files.hpp"
#include "core/number_text.hpp"
#include "lower/evaluate.hpp"
#include "lower/interpreter.hpp"
#include "remap/error.hpp"
#include "support/campaign.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"
#include "table/regression.hpp"

using namespace remap;

namespace {

// Returns rows of a smooth conversion. With `coupling`, target alpha depends on specular.
std::vector<TableRow> made_rows(int widths = 12, int speculars = 6, double coupling = 0.0) {
  std::vector<TableRow> rows;
  for (int i = 0; i < widths; ++i) {
    for (int j = 0; j < speculars; ++j) {
      const double a = 0.05 + 0.95 * i / std::max(1, widths - 1);
      const double s = 0.05 + 0.45 * j / std::max(1, speculars - 1);
      rows.push_back(
          {a, s, a * (1.0 - 0.3 * a) + coupling * s * a, s * (1.1 - 0.4 * a * a), 0.0, RowStatus::kOk, 0});
    }
  }
  return rows;
}

// Returns hyper-parameters that fit made_rows() well, for tests that need no search.
SvrOptions given() {
  SvrOptions options;
  options.alpha = SvrHyperParameters{10.0, 3.2, 1e-3, 1.0};
  options.specular = SvrHyperParameters{32.0, 1.0, 1e-3, 0.5};
  return options;
}

struct Errors {
  ErrorFigures alpha, specular;
};

Errors errors_of(const MappingKind& mapping, const std::vector<TableRow>& rows) {
  std::vector<double> alpha, specular;
  for (const TableRow& row : rows) {
    const MappedTexel texel = evaluate_mapping(mapping, row.alpha1, row.specular1);
    alpha.push_back(texel.alpha - row.alpha2);
    specular.push_back(texel.specular - row.specular2);
  }
  return {error_figures(alpha), error_figures(specular)};
}

struct ModelDeleter {
  void operator()(svm_model* model) const { svm_free_and_destroy_model(&model); }
};
using Model = std::unique_ptr<svm_model, ModelDeleter>;

// Converts an expansion to a libsvm model through its file format.
Model model_of(const KernelExpansion& expansion) {
  const TemporaryFolder folder;
  std::string text = "svm_type epsilon_svr\nkernel_type rbf\ngamma " + number_text(expansion.gamma) +
                     "\nnr_class 2\ntotal_sv " + std::to_string(expansion.count()) + "\nrho " +
                     number_text(-expansion.bias) + "\nSV\n";
  const std::size_t width = expansion.inputs.size();
  for (std::size_t i = 0; i < expansion.count(); ++i) {
    text += number_text(expansion.weights[i]);
    for (std::size_t j = 0; j < width; ++j)
      text += " " + std::to_string(j + 1) + ":" + number_text(expansion.vectors[i * width + j]);
    text += " \n";
  }
  const std::string path = (folder.path() / "model").string();
  write_file(path, text);
  return Model(svm_load_model(path.c_str()));
}

double predicted(const svm_model& model, const KernelExpansion& expansion, double alpha, double specular) {
  std::vector<svm_node> nodes;
  for (std::size_t j = 0; j < expansion.inputs.size(); ++j)
    nodes.push_back({static_cast<int>(j) + 1, normalised(expansion.inputs[j], j == 0 ? alpha : specular)});
  nodes.push_back({-1, 0.0});
  return svm_predict(&model, nodes.data()) / expansion.output.scale + expansion.output.offset;
}

}  // namespace

TEST_CASE("svr: errors on unseen rows of the published table", "[slow][campaign][needs]") {
  const auto path = shared_data("tables/mitsuba-ward2mitsuba-as.csv");
  if (path.empty()) return;
  const Table table = read_table(path, column_map("sztrajman-2019"));
  const int seeds = is_full_campaign() && !kSlowBuild ? 5 : 1;
  double alpha = 0.0, specular = 0.0, largest = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const RowSplit split = split_rows(table, table_domain(table), static_cast<std::uint64_t>(seed), 0.2);
    const auto start = std::chrono::steady_clock::now();
    SvrOptions options;
    options.seed = static_cast<std::uint64_t>(seed);
    const Regression fit = fit_svr(split.training, options);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const Errors errors = errors_of(fit.mapping, split.held_out);
    const auto& svr = std::get<Svr>(fit.mapping);
    CHECK(svr.alpha.inputs.size() == 1);
    CHECK(svr.specular.inputs.size() == 2);
    std::cout << "published table, seed " << seed << ": " << seconds.count() << " s; alpha rms "
              << errors.alpha.rms << " max " << errors.alpha.max << ", " << svr.alpha.count()
              << " vectors; specular rms " << errors.specular.rms << " max " << errors.specular.max << ", "
              << svr.specular.count() << " vectors\n";
    alpha += errors.alpha.rms / seeds;
    specular += errors.specular.rms / seeds;
    largest += errors.specular.max / seeds;
    // The error of the cross-validation must hold on unseen rows. Folds differ by a factor of two.
    CHECK(errors.specular.rms < 2.0 * *parse_number(fit.method.at("specular.cross_validation_rms")));
  }
  std::cout << "published table, mean of " << seeds << " splits: alpha rms " << alpha << ", specular rms "
            << specular << " max " << largest << "\n";
  // scikit-learn's grid search on other splits gave alpha 3.3e-4, specular 2.9e-4, max 8.5e-4. Here the means
  // over five seeds are 1.2e-4, 1.2e-4, 5.8e-4. A single seed must meet the same bounds.
  CHECK(alpha <= 1.6e-4);
  CHECK(specular <= 1.6e-4);
  CHECK(largest <= 8.5e-4);
}

TEST_CASE("svr: a fit equals libsvm's prediction with its vectors") {
  // Only the order of operations rounds differently. The sums have some dozens of Gaussians with weights up
  // to C.
  for (const double coupling : {0.0, 0.2}) {
    const Regression fit = fit_svr(made_rows(12, 6, coupling), given());
    const auto& svr = std::get<Svr>(fit.mapping);
    CHECK(svr.alpha.inputs.size() == (coupling == 0.0 ? 1 : 2));
    for (const KernelExpansion* expansion : {&svr.alpha, &svr.specular}) {
      const Model model = model_of(*expansion);
      REQUIRE(model != nullptr);
      for (double a = 0.0; a <= 1.1; a += 0.1)
        for (double s = 0.0; s <= 0.6; s += 0.1)
          CHECK(std::fabs(expansion_value(*expansion, a, s) - predicted(*model, *expansion, a, s)) < 1e-12);
    }
  }
}

TEST_CASE("svr: a smooth table is fitted to the width of the tube", "[slow]") {
  SvrOptions options;
  const Regression fit = fit_svr(made_rows(12, 6, 0.2), options);
  const Errors errors = errors_of(fit.mapping, made_rows(23, 11, 0.2));
  CHECK(errors.alpha.rms < 1e-3);
  CHECK(errors.specular.rms < 1e-3);
  CHECK(fit.method.at("alpha.inputs") == "alpha, specular");
  for (const std::string output : {"alpha", "specular"})
    for (const std::string key : {"C", "gamma", "epsilon", "specular_span", "vectors", "folds", "candidates",
                                  "cross_validation_rms", "search_samples", "trained_samples"})
      CHECK(fit.method.contains(output + "." + key));
}

TEST_CASE("svr: other rows are fitted again with the same hyper-parameters, and recorded ones are exact") {
  SvrOptions options = given();
  options.alpha->cost = 31.622776601683793;
  options.alpha->gamma = 1.0 / 3.0;
  options.specular->epsilon = 1e-3 / 7.0;
  options.specular->specular_span = 0.1 + 0.2;
  const Regression fit = fit_svr(made_rows(), options);
  CHECK(std::stod(fit.method.at("alpha.C")) == options.alpha->cost);
  CHECK(std::stod(fit.method.at("specular.specular_span")) == options.specular->specular_span);
  CHECK(fit_svr(made_rows(), options).mapping == fit.mapping);
}

TEST_CASE("svr: duplicated rows give the same fit as once, bit for bit") {
  const std::vector<TableRow> rows = made_rows(8, 4);
  std::vector<TableRow> twice = rows;
  twice.insert(twice.end(), rows.begin(), rows.end());
  const Regression two = fit_svr(twice, given()), one = fit_svr(rows, given());
  CHECK(std::get<Svr>(two.mapping).specular == std::get<Svr>(one.mapping).specular);
}

TEST_CASE("svr: hyper-parameters that are not positive numbers are refused") {
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    SvrOptions options = given();
    options.specular->gamma = wrong;
    CHECK_THROWS_WITH(fit_svr(made_rows(), options), Catch::Contains("svr specular:"));
  }
}

TEST_CASE("svr: 2000 of 100000 rows train, and the record says so") {
  SvrOptions options = given();
  const Regression fit = fit_svr(made_rows(400, 250), options);
  CHECK(fit.method.at("alpha.trained_samples") == "400");
  CHECK(fit.method.at("specular.trained_samples") == "2000");
  CHECK(errors_of(fit.mapping, made_rows(37, 23)).specular.rms < 1e-3);
}

TEST_CASE("svr: one sample is drawn from each interval") {
  Samples samples{1, 1, {}, {}};
  for (int i = 0; i < 1000; ++i) {
    samples.inputs.push_back(i);
    samples.outputs.push_back(-i);
  }
  const Samples drawn = draw_evenly(samples, 30, 7);
  REQUIRE(drawn.count() == 30);
  for (std::size_t k = 0; k < 30; ++k) {
    CHECK(std::floor(drawn.inputs[k] * 30.0 / 1000.0) == Approx(static_cast<double>(k)).margin(1.0));
    CHECK(drawn.outputs[k] == -drawn.inputs[k]);
  }
  CHECK(draw_evenly(samples, 1000, 7).inputs == samples.inputs);
}
