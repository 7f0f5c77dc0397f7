#include "fit/network/network_batch.hpp"

#include <cmath>
#include <utility>

namespace remap {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// Returns the derivative of the activation at x, where its value is y.
double activation_slope(Activation activation, double x, double y) {
  switch (activation) {
    case Activation::kRelu:
      return x > 0.0 ? 1.0 : 0.0;
    case Activation::kTanh:
      return 1.0 - y * y;
    case Activation::kSilu: {  // with s = 1 / (1 + exp(-x)): s + x s (1 - s) = s + y (1 - s)
      const double s = 0.5 * std::tanh(0.5 * x) + 0.5;
      return s + y * (1.0 - s);
    }
  }
  return 1.0;
}

// Returns the place of each layer in a parameter vector, then the length of the vector.
std::vector<std::size_t> layer_offsets(const NetworkShape& shape) {
  std::vector<std::size_t> offsets = {0};
  for (std::size_t l = 0; l + 1 < shape.sizes.size(); ++l)
    offsets.push_back(offsets.back() + (shape.sizes[l] + 1) * shape.sizes[l + 1]);
  return offsets;
}

}  // namespace

std::size_t NetworkShape::parameter_count() const { return layer_offsets(*this).back(); }

std::vector<Layer> layers_from_parameters(const NetworkShape& shape, const double* parameters) {
  std::vector<Layer> layers;
  for (std::size_t l = 0; l + 1 < shape.sizes.size(); ++l) {
    const std::size_t weight_count = shape.sizes[l] * shape.sizes[l + 1];
    Layer layer;
    layer.input_count = shape.sizes[l];
    layer.weights.assign(parameters, parameters + weight_count);
    parameters += weight_count;
    layer.biases.assign(parameters, parameters + shape.sizes[l + 1]);
    parameters += shape.sizes[l + 1];
    layers.push_back(std::move(layer));
  }
  return layers;
}

Eigen::VectorXd weight_mask(const NetworkShape& shape) {
  Eigen::VectorXd mask = Eigen::VectorXd::Ones(static_cast<Index>(shape.parameter_count()));
  const std::vector<std::size_t> offsets = layer_offsets(shape);
  for (std::size_t l = 0; l + 1 < shape.sizes.size(); ++l) {
    const auto biases = static_cast<Index>(shape.sizes[l + 1]);
    mask.segment(static_cast<Index>(offsets[l + 1]) - biases, biases).setZero();
  }
  return mask;
}

NetworkBatch::NetworkBatch(NetworkShape shape, MatrixXd inputs)
    : shape_(std::move(shape)),
      offsets_(layer_offsets(shape_)),
      values_(shape_.sizes.size()),
      slopes_(shape_.sizes.size()) {
  values_.front() = std::move(inputs);
}

void NetworkBatch::set_inputs(MatrixXd inputs) { values_.front() = std::move(inputs); }

Eigen::Map<const NetworkBatch::RowMajor> NetworkBatch::weights(const double* parameters,
                                                               std::size_t layer) const {
  return {parameters + offsets_[layer], size(layer + 1), size(layer)};
}

const MatrixXd& NetworkBatch::forward(const double* parameters) {
  const std::size_t last = shape_.sizes.size() - 1;
  for (std::size_t l = 0; l < last; ++l) {
    MatrixXd& sums = values_[l + 1];
    const Eigen::Map<const Eigen::VectorXd> biases(
        parameters + offsets_[l] + shape_.sizes[l] * shape_.sizes[l + 1], size(l + 1));
    sums.noalias() = weights(parameters, l) * values_[l];
    sums.colwise() += biases;
    if (l + 1 == last) break;
    MatrixXd& slopes = slopes_[l + 1];
    slopes.resize(sums.rows(), sums.cols());
    for (Index i = 0; i < sums.size(); ++i) {
      const double x = sums.data()[i];
      const double y = activated(shape_.activation, x);
      sums.data()[i] = y;
      slopes.data()[i] = activation_slope(shape_.activation, x, y);
    }
  }
  return values_.back();
}

MatrixXd NetworkBatch::before(const double* parameters, std::size_t layer, const MatrixXd& behind) const {
  return (weights(parameters, layer).transpose() * behind).cwiseProduct(slopes_[layer]);
}

void NetworkBatch::jacobian(const double* parameters, Eigen::Ref<RowMajor> jacobian) const {
  const std::size_t last = shape_.sizes.size() - 1;
  const Index output_count = size(last);
  for (Index k = 0; k < output_count; ++k) {
    MatrixXd deltas = MatrixXd::Zero(output_count, sample_count());
    deltas.row(k).setOnes();
    for (std::size_t l = last; l-- > 0;) {
      const MatrixXd& values = values_[l];
      const Index weight_count = values.rows() * deltas.rows();
      for (Index n = 0; n < sample_count(); ++n) {
        double* row = &jacobian(n * output_count + k, static_cast<Index>(offsets_[l]));
        for (Index i = 0; i < deltas.rows(); ++i)
          for (Index j = 0; j < values.rows(); ++j) row[i * values.rows() + j] = deltas(i, n) * values(j, n);
        for (Index i = 0; i < deltas.rows(); ++i) row[weight_count + i] = deltas(i, n);
      }
      if (l > 0) deltas = before(parameters, l, deltas);
    }
  }
}

void NetworkBatch::gradient(const double* parameters, const MatrixXd& by_outputs, double* gradient) const {
  MatrixXd deltas = by_outputs;
  for (std::size_t l = shape_.sizes.size() - 1; l-- > 0;) {
    Eigen::Map<RowMajor> by_weights(gradient + offsets_[l], size(l + 1), size(l));
    by_weights.noalias() = deltas * values_[l].transpose();
    Eigen::Map<Eigen::VectorXd>(gradient + offsets_[l] + shape_.sizes[l] * shape_.sizes[l + 1], size(l + 1)) =
        deltas.rowwise().sum();
    if (l > 0) deltas = before(parameters, l, deltas);
  }
}

}  // namespace remap
