// This file tests networks and their training: derivatives against finite differences, outputs against the
// interpreter's formula, a known function of six inputs and four outputs, determinism, and samples that must
// be refused.
#include <array>
#include <cmath>
#include <iostream>
#include <random>
#include <vector>

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "fit/network/fit_network.hpp"
#include "fit/network/network_optimisers.hpp"
#include "lower/evaluate.hpp"
#include "support/build_speed.hpp"
#include "support/skip.hpp"

using namespace remap;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::array<Activation, 3> kTestedActivations = {Activation::kRelu, Activation::kTanh,
                                                          Activation::kSilu};

// Uniform returns numbers in [low, high), the same with every standard library.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : random_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 random_;
};

MatrixXd uniform_matrix(Uniform& uniform, Index rows, Index columns, double reach) {
  MatrixXd matrix(rows, columns);
  for (Index i = 0; i < matrix.size(); ++i) matrix.data()[i] = uniform(-reach, reach);
  return matrix;
}

// Returns samples of the inverse of equation (2) of Sztrajman et al. (2019): from diffuse and specular color
// (6) to base color and metallic (4). Base colors differ by at least 0.2 from the reflectance of dielectrics,
// where the inverse is not unique.
Samples metallic_samples(std::size_t count, std::uint64_t seed) {
  Uniform uniform(seed);
  Samples samples{6, 4, {}, {}};
  for (std::size_t n = 0; n < count; ++n) {
    const double metallic = uniform(0.0, 0.9);
    std::array<double, 3> base{};
    for (double& channel : base) channel = uniform(0.23, 1.0);
    for (const double channel : base) samples.inputs.push_back(channel * (1.0 - metallic));
    for (const double channel : base) samples.inputs.push_back(0.03 + (channel - 0.03) * metallic);
    samples.outputs.insert(samples.outputs.end(), base.begin(), base.end());
    samples.outputs.push_back(metallic);
  }
  return samples;
}

double unseen_rms(const Network& network, const Samples& samples) {
  double sum = 0.0;
  for (std::size_t n = 0; n < samples.count(); ++n) {
    const auto from = samples.inputs.begin() + static_cast<std::ptrdiff_t>(n * samples.input_count);
    const std::vector<double> found = network_outputs(
        network, std::vector<double>(from, from + static_cast<std::ptrdiff_t>(samples.input_count)));
    for (std::size_t k = 0; k < found.size(); ++k) {
      const double error = found[k] - samples.outputs[n * samples.output_count + k];
      sum += error * error;
    }
  }
  return std::sqrt(sum / static_cast<double>(samples.outputs.size()));
}

}  // namespace

TEST_CASE("network batch: Jacobian and gradient agree with finite differences for every activation") {
  for (const Activation activation : kTestedActivations) {
    CAPTURE(activation_name(activation));
    const NetworkShape shape{activation, {3, 5, 4, 2}};
    const auto count = static_cast<Index>(shape.parameter_count());
    REQUIRE(count == 3 * 5 + 5 + 5 * 4 + 4 + 4 * 2 + 2);
    Uniform uniform(7);
    NetworkBatch batch(shape, uniform_matrix(uniform, 3, 6, 1.0));
    const VectorXd parameters = uniform_matrix(uniform, count, 1, 0.9);
    const MatrixXd by_outputs = uniform_matrix(uniform, 2, 6, 1.0);

    batch.forward(parameters.data());
    NetworkBatch::RowMajor jacobian(12, count);
    batch.jacobian(parameters.data(), jacobian);
    VectorXd gradient(count);
    batch.gradient(parameters.data(), by_outputs, gradient.data());
    for (Index p = 0; p < count; ++p) {
      constexpr double kStep = 1e-6;  // its error is about step^2 + 1e-16 / step
      VectorXd moved = parameters;
      moved[p] += kStep;
      const MatrixXd ahead = batch.forward(moved.data());
      moved[p] -= 2.0 * kStep;
      const MatrixXd behind = batch.forward(moved.data());
      const MatrixXd slope = (ahead - behind) / (2.0 * kStep);
      for (Index n = 0; n < 6; ++n)
        for (Index k = 0; k < 2; ++k) CHECK(jacobian(n * 2 + k, p) == Approx(slope(k, n)).margin(1e-8));
      CHECK(gradient[p] == Approx(slope.cwiseProduct(by_outputs).sum()).margin(1e-8));
    }
  }
}

TEST_CASE("network batch: outputs are those of the interpreter's formula") {
  for (const Activation activation : kTestedActivations) {
    const NetworkShape shape{activation, {6, 9, 7, 4}};
    Uniform uniform(3);
    const VectorXd parameters = uniform_matrix(uniform, static_cast<Index>(shape.parameter_count()), 1, 1.5);
    const MatrixXd inputs = uniform_matrix(uniform, 6, 50, 2.0);
    NetworkBatch batch(shape, inputs);
    const MatrixXd outputs = batch.forward(parameters.data());
    Network network{activation, std::vector<Scaling>(6), std::vector<Scaling>(4),
                    layers_from_parameters(shape, parameters.data())};
    for (Index n = 0; n < inputs.cols(); ++n) {
      const VectorXd column = inputs.col(n);
      const auto expected = network_outputs(network, std::vector<double>(column.begin(), column.end()));
      // The margin allows sums of up to 9 products in another order.
      for (Index k = 0; k < 4; ++k)
        CHECK(outputs(k, n) == Approx(expected[static_cast<std::size_t>(k)]).margin(1e-12));
    }
  }
}

TEST_CASE("network training: reported errors are those of the stored network") {
  const Samples samples = metallic_samples(60, 1);
  for (const Activation activation : kTestedActivations) {
    TrainingOptions options;
    options.hidden = {6};
    options.activation = activation;
    options.starts = 2;
    const TrainedNetwork trained = train_network(samples, options);
    CHECK(trained.rows == 60);
    // All rows are trained in the end, so the reported figure is the error over all of them, in normalised
    // units.
    double sum = 0.0;
    for (std::size_t n = 0; n < samples.count(); ++n) {
      const auto from = samples.inputs.begin() + static_cast<std::ptrdiff_t>(6 * n);
      const auto found = network_outputs(trained.network, std::vector<double>(from, from + 6));
      for (std::size_t k = 0; k < 4; ++k) {
        const double error = (found[k] - samples.outputs[4 * n + k]) * trained.network.outputs[k].scale;
        sum += error * error;
      }
    }
    CHECK(std::sqrt(sum / 240.0) == Approx(trained.training_rms).margin(1e-12));
  }
}

TEST_CASE("network training: six inputs and four outputs are learned by both optimisers", "[needs][slow]") {
  const Samples seen = metallic_samples(kSlowBuild ? 400 : 1500, 1), unseen = metallic_samples(500, 2);
  for (const std::size_t units : {std::size_t{12}, std::size_t{60}}) {
    if (kSlowBuild && units > 12) {
      skip("speed", "the large network trains too slowly under a sanitizer");
      continue;
    }
    TrainingOptions options;
    options.hidden = {units};
    options.starts = 2;
    TrainedNetwork trained;
    const double seconds = seconds_of([&] { trained = train_network(seen, options); });
    const double rms = unseen_rms(trained.network, unseen);
    std::cout << "metallic: " << trained.method << "; rms on unseen rows " << rms << ", " << seconds
              << " s\n";
    CHECK(rms < 0.004);  // one step of 8 bits
  }
}

TEST_CASE("network training: large networks do not depend on the number of threads") {
  const Samples samples = metallic_samples(40, 1);
  TrainingOptions options;
  options.hidden = {60};
  options.starts = 3;
  options.jobs = 1;
  const TrainedNetwork one = train_network(samples, options);
  CHECK_THAT(one.method, Catch::Contains("Adam"));
  options.jobs = 2;
  CHECK(train_network(samples, options).network == one.network);
}

TEST_CASE("network training: samples and options that do not fit together are refused") {
  Samples samples = metallic_samples(20, 1);
  TrainingOptions options;
  options.validation_fraction = 0.6;
  CHECK_THROWS_WITH(train_network(samples, options), Catch::Contains("validation share 0.6"));
  samples.outputs.pop_back();
  CHECK_THROWS_WITH(train_network(samples, {}), Catch::Contains("do not form equally many whole rows"));
  CHECK_THROWS_WITH(train_network({}, {}), Catch::Contains("do not form equally many whole rows"));
}
