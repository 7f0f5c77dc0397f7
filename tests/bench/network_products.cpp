// This file multiplies matrices of the size of a network by Eigen, without biases and activations. It is
// compiled once for each set of flags. Names and flags come from CMake. Eigen gets its own namespace for the
// reason given in pass.cpp.
#define Eigen BENCH_NAMESPACE
#include <Eigen/Core>
#undef Eigen

#include "bench/builds.hpp"

namespace remap_bench {
namespace {

namespace eigen = BENCH_NAMESPACE;
constexpr int kInputs = 6, kHidden = 300, kOutputs = 4;

// The planar rows of texels are the columns of a matrix of texels x values. With the other order they are the
// rows of its transpose.
template <int Order>
using Matrix = eigen::Matrix<float, eigen::Dynamic, eigen::Dynamic, Order>;
template <int Order>
using Rows = eigen::Map<Matrix<Order>, 0, eigen::OuterStride<>>;
template <int Order>
using ConstRows = eigen::Map<const Matrix<Order>, 0, eigen::OuterStride<>>;

}  // namespace

void BENCH_NAME(const NetworkProducts& products, std::size_t texels, const float* in, float* out) {
  const auto stride = static_cast<eigen::Index>(texels);
  const auto count = static_cast<eigen::Index>(products.batch);
  if (products.texels_innermost) {
    const eigen::Map<const Matrix<eigen::ColMajor>> first(products.hidden_weights, kInputs, kHidden);
    const eigen::Map<const Matrix<eigen::ColMajor>> last(products.output_weights, kHidden, kOutputs);
    Matrix<eigen::ColMajor> hidden(count, kHidden);
    for (std::size_t start = 0; start < texels; start += products.batch) {
      const ConstRows<eigen::ColMajor> from(in + start, count, kInputs, eigen::OuterStride<>(stride));
      Rows<eigen::ColMajor> to(out + start, count, kOutputs, eigen::OuterStride<>(stride));
      hidden.noalias() = from * first;
      to.noalias() = hidden * last;
    }
    return;
  }
  // If a texel is a column, its hidden units are adjacent in memory.
  const eigen::Map<const Matrix<eigen::RowMajor>> first(products.hidden_weights, kHidden, kInputs);
  const eigen::Map<const Matrix<eigen::RowMajor>> last(products.output_weights, kOutputs, kHidden);
  Matrix<eigen::ColMajor> hidden(kHidden, count);
  for (std::size_t start = 0; start < texels; start += products.batch) {
    const ConstRows<eigen::RowMajor> from(in + start, kInputs, count, eigen::OuterStride<>(stride));
    Rows<eigen::RowMajor> to(out + start, kOutputs, count, eigen::OuterStride<>(stride));
    hidden.noalias() = first * from;
    to.noalias() = last * hidden;
  }
}

}  // namespace remap_bench
