// Networks as fitted: a loop over the units of each layer, rows of texels innermost.
#include <algorithm>
#include <cmath>

#include "emit/mapping_code.hpp"
#include "emit/text_template.hpp"

namespace remapc {
namespace {

using remap::Activation;
using remap::Layer;
using remap::Network;
using remap::Scaling;

constexpr std::size_t kCacheFloats = 6144;  // of rows: three quarters of a first-level cache of 32 KB
constexpr std::size_t kUnitsAtOnce = 4;     // hidden units between two layers, `two_layers` below

constexpr std::string_view kTangent = R"(
// tanh(x), error below 5e-7: x P(x^2) / Q(x^2), relative error of the fractions themselves 2.1e-8 (least maximum,
// |x| <= 9); 1 within a float beyond. Bits in place of comparisons, on which compilers would branch.
inline float hyperbolic_tangent(float x) noexcept {
  const std::int32_t nine = static_cast<std::int32_t>(bits(9.0f));
  const std::int32_t below = static_cast<std::int32_t>(bits(x) & 0x7fffffffu) - nine;
  const float size = float_from_bits(static_cast<std::uint32_t>(nine + (below & (below >> 31))));
  const float y = size * size;
  float p = 1.33553556e-8f;
  p = p * y + 2.060978684e-5f;
  p = p * y + 3.495634333e-3f;
  p = p * y + 0.1338106576f;
  p = p * y + 0.9999999798f;
  float q = 7.776937514e-7f;
  q = q * y + 3.285707953e-4f;
  q = q * y + 2.587716169e-2f;
  q = q * y + 0.4671438144f;
  q = q * y + 1.0f;
  return float_from_bits(bits(size * p / q) | (bits(x) & 0x80000000u));
}
)";

constexpr std::string_view kRelu = R"(
inline float activated(float x) noexcept {
  const std::int32_t order = static_cast<std::int32_t>(bits(x));
  return float_from_bits(static_cast<std::uint32_t>(order & ~(order >> 31)));
}
)";
constexpr std::string_view kTanh = R"(
inline float activated(float x) noexcept { return hyperbolic_tangent(x); }
)";
constexpr std::string_view kSilu = R"(
// x / (1 + exp(-x)).
inline float activated(float x) noexcept {
  const float half = 0.5f * x;
  return hyperbolic_tangent(half) * half + half;
}
)";

constexpr std::string_view kLayerHelpers = R"(
// Units are rows of a table: bias, then one weight an input. Below, `first` is the first input of those in `in`.

// Bias and the first products of one unit.
template <int Inputs>
inline void begin_sum(std::size_t count, const float* unit, const float (*in)[kBlock], float* sum) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    float s = unit[0];
    for (int k = 0; k < Inputs; ++k) s = in[k][i] * unit[1 + k] + s;
    sum[i] = s;
  }
}

// Some products more of some units: few enough that sums and inputs stay in registers.
template <int Inputs, int Units, int Width>
inline void add_some_products(std::size_t count, const float (*units)[Width], int first, const float (*in)[kBlock],
                              float (*sums)[kBlock]) noexcept {
  for (std::size_t i = 0; i < count; ++i)
    for (int j = 0; j < Units; ++j) {
      float s = sums[j][i];
      for (int k = 0; k < Inputs; ++k) s = in[k][i] * units[j][1 + first + k] + s;
      sums[j][i] = s;
    }
}

template <int Inputs, int Units, int Width>
inline void add_products(std::size_t count, const float (*units)[Width], int first, const float (*in)[kBlock],
                         float (*sums)[kBlock]) noexcept {
  constexpr int kRest = Units % @at_once@;
  for (int j = 0; j + @at_once@ <= Units; j += @at_once@)
    add_some_products<Inputs, @at_once@>(count, units + j, first, in, sums + j);
  if constexpr (kRest != 0)
    add_some_products<Inputs, kRest>(count, units + (Units - kRest), first, in, sums + (Units - kRest));
}

// One layer.
template <int Inputs, int Units>
inline void layer(std::size_t count, const float (*units)[Inputs + 1], const float (*in)[kBlock],
                  float (*out)[kBlock]) noexcept {
  constexpr int kFirst = Inputs < 8 ? Inputs : 8, kRest = (Inputs - kFirst) % @at_once@;
  for (int j = 0; j < Units; ++j) begin_sum<kFirst>(count, units[j], in, out[j]);
  for (int k = kFirst; k + @at_once@ <= Inputs; k += @at_once@)
    add_products<@at_once@, Units>(count, units, k, in + k, out);
  if constexpr (kRest != 0)
    add_products<kRest, Units>(count, units, Inputs - kRest, in + (Inputs - kRest), out);
}

template <int Units>
inline void activate(std::size_t count, float (*rows)[kBlock]) noexcept {
  for (int j = 0; j < Units; ++j)
    for (std::size_t i = 0; i < count; ++i) rows[j][i] = activated(rows[j][i]);
}

// Some units of a hidden layer, handed on to the sums of the next before the others are computed: however wide the
// layer is, its rows stay in the first-level cache.
template <int Inputs, int Units, int Next, int Width>
inline void hand_on(std::size_t count, const float (*units)[Inputs + 1], const float (*next)[Width], int first,
                    const float (*in)[kBlock], float (*sums)[kBlock]) noexcept {
  float rows[Units][kBlock];
  layer<Inputs, Units>(count, units, in, rows);
  activate<Units>(count, rows);
  add_products<Units, Next>(count, next, first, rows, sums);
}

// A hidden layer and the one after it.
template <int Inputs, int Hidden, int Next>
inline void two_layers(std::size_t count, const float (&units)[Hidden][Inputs + 1], const float (&next)[Next][Hidden + 1],
                       const float (*in)[kBlock], float (*sums)[kBlock]) noexcept {
  constexpr int kRest = Hidden % @at_once@;
  for (int m = 0; m < Next; ++m)
    for (std::size_t i = 0; i < count; ++i) sums[m][i] = next[m][0];
  for (int j = 0; j + @at_once@ <= Hidden; j += @at_once@)
    hand_on<Inputs, @at_once@, Next>(count, units + j, next, j, in, sums);
  if constexpr (kRest != 0)
    hand_on<Inputs, kRest, Next>(count, units + (Hidden - kRest), next, Hidden - kRest, in, sums);
}
)";

constexpr std::string_view kFunction = R"(
@tables@

// Inputs are normalised in the first layer, outputs scaled back in the last.
inline void @name@(std::size_t count, const float* const* in, float* const* out) noexcept {
  float x0[@inputs@][kBlock];
  for (std::size_t k = 0; k < @inputs@; ++k)
    for (std::size_t i = 0; i < count; ++i) x0[k][i] = in[k][i];
  @poles@
  @layers@
  for (std::size_t m = 0; m < @outputs@; ++m)
    for (std::size_t i = 0; i < count; ++i) out[m][i] = @last@[m][i];
}
)";

// Weights and biases with the scalings folded in: the first layer takes raw inputs, the last gives raw
// outputs.
std::vector<Layer> folded(const Network& network) {
  std::vector<Layer> layers = network.layers;
  Layer& first = layers.front();
  for (std::size_t j = 0; j < first.output_count(); ++j)
    for (std::size_t k = 0; k < first.input_count; ++k) {
      double& weight = first.weights[j * first.input_count + k];
      first.biases[j] -= weight * network.inputs[k].scale * network.inputs[k].offset;
      weight *= network.inputs[k].scale;
    }
  Layer& last = layers.back();
  for (std::size_t j = 0; j < last.output_count(); ++j) {
    const double range = 1.0 / network.outputs[j].scale;
    for (std::size_t k = 0; k < last.input_count; ++k) last.weights[j * last.input_count + k] *= range;
    last.biases[j] = last.biases[j] * range + network.outputs[j].offset;
  }
  return layers;
}

std::string layer_table(const std::string& name, const Layer& layer) {
  std::string text = "inline constexpr float " + name + "[" + std::to_string(layer.output_count()) + "][" +
                     std::to_string(layer.input_count + 1) + "] = {\n";
  for (std::size_t j = 0; j < layer.output_count(); ++j) {
    text += "    {" + literal(layer.biases[j]);
    for (std::size_t k = 0; k < layer.input_count; ++k)
      text += ", " + literal(layer.weights[j * layer.input_count + k]);
    text += "},\n";
  }
  return text + "};\n";
}

int block_of(const std::vector<const Network*>& networks) {
  std::size_t rows = 1;
  for (const Network* network : networks) {
    std::size_t own = network->inputs.size() + kUnitsAtOnce;
    for (std::size_t l = 1; l < network->layers.size(); ++l) own += network->layers[l].output_count();
    rows = std::max(rows, own);
  }
  std::size_t block = 128;
  while (block > 16 && block * rows > kCacheFloats) block /= 2;
  return static_cast<int>(block);
}

// A bound on what float arithmetic leaves, first order: every unit errs by its terms' roundings and hands on
// what it was given through its weights. Activations have slopes of at most 1.1.
double error_of(const Network& network, const remap::Domain& domain) {
  constexpr double kFloatUnit = 6e-8;
  const std::vector<Layer> layers = folded(network);
  std::vector<double> magnitude = {1.0, domain.specular.max}, error = {0.0, 0.0};
  magnitude[0] = network.inputs[0].pole == 0.0 ? domain.alpha.max : 1.0;
  if (network.inputs[0].pole != 0.0) error[0] = 2.0 * kFloatUnit;
  for (std::size_t l = 0; l < layers.size(); ++l) {
    std::vector<double> next_magnitude, next_error;
    const bool last = l + 1 == layers.size();
    for (std::size_t j = 0; j < layers[l].output_count(); ++j) {
      double sum = std::fabs(layers[l].biases[j]), handed = 0.0;
      for (std::size_t k = 0; k < layers[l].input_count; ++k) {
        const double weight = std::fabs(layers[l].weights[j * layers[l].input_count + k]);
        sum += weight * magnitude[k];
        handed += weight * error[k];
      }
      const bool bounded = !last && network.activation == Activation::kTanh;
      next_magnitude.push_back(bounded ? 1.0 : sum);
      next_error.push_back(1.1 *
                               (handed + kFloatUnit * static_cast<double>(layers[l].input_count + 1) * sum) +
                           (last ? 0.0 : 5e-7 * next_magnitude.back()));
    }
    magnitude = next_magnitude;
    error = next_error;
  }
  return *std::max_element(error.begin(), error.end()) + 1e-6;
}

std::string activation_code(Activation activation) {
  if (activation == Activation::kRelu) return std::string(kRelu);
  return std::string(kTangent) + std::string(activation == Activation::kTanh ? kTanh : kSilu);
}

// The rows of both inputs behind the signature that the layout calls.
std::string rows_wrapper(const std::string& name, const std::string& network) {
  return "\ninline void " + name +
         "(std::size_t count, const float* alpha, const float* specular, float* out) noexcept {\n"
         "  const float* const in[] = {alpha, specular};\n  " +
         network + "(count, in, &out);\n}\n";
}

}  // namespace

std::string network_helpers(Activation activation) {
  return activation_code(activation) +
         fill_template(kLayerHelpers, {{"at_once", std::to_string(kUnitsAtOnce)}});
}

std::string network_function(const std::string& name, const Network& network) {
  const std::vector<Layer> layers = folded(network);
  std::string tables, calls, poles, in = "x0";
  for (std::size_t k = 0; k < network.inputs.size(); ++k) {
    if (network.inputs[k].pole == 0.0) continue;
    const std::string row = "x0[" + std::to_string(k) + "][i]";
    poles += "for (std::size_t i = 0; i < count; ++i) " + row + " = " + row + " / (" + row + " + " +
             literal(network.inputs[k].pole) + ");\n";
  }
  const auto table = [&](std::size_t l) { return "k_" + name + "_" + std::to_string(l); };
  const auto units = [&](std::size_t l) { return std::to_string(layers[l].output_count()); };
  for (std::size_t l = 0; l < layers.size(); ++l) tables += layer_table(table(l), layers[l]);
  const std::string inputs = std::to_string(network.inputs.size());
  for (std::size_t l = layers.size() == 1 ? 0 : 1; l < layers.size(); ++l) {
    const std::string out = "x" + std::to_string(l + 1);
    calls += "float " + out + "[" + units(l) + "][kBlock];\n";
    if (l == 1) {
      calls += "two_layers<" + inputs + ", " + units(0) + ", " + units(1) + ">(count, " + table(0) + ", " +
               table(1) + ", x0, " + out + ");\n";
    } else {
      if (l > 1) calls += "activate<" + units(l - 1) + ">(count, " + in + ");\n";
      calls += "layer<" + std::to_string(layers[l].input_count) + ", " + units(l) + ">(count, " + table(l) +
               ", " + in + ", " + out + ");\n";
    }
    in = out;
  }
  return fill_template(kFunction, {{"tables", tables},
                                   {"name", name},
                                   {"inputs", std::to_string(network.inputs.size())},
                                   {"outputs", std::to_string(network.outputs.size())},
                                   {"poles", poles},
                                   {"layers", calls},
                                   {"last", in}});
}

int network_block(const Network& network) { return block_of({&network}); }

MappingCode exact_code(const remap::Mlp& mlp, const remap::Domain& domain) {
  MappingCode code;
  code.form = CodeForm::kRows;
  code.block = block_of({&mlp.alpha, &mlp.specular});
  const auto sizes = [](const Network& network) {
    std::string text = std::to_string(network.inputs.size());
    for (const Layer& layer : network.layers) text += " x " + std::to_string(layer.output_count());
    return text;
  };
  code.description = "As fitted: networks of " + sizes(mlp.alpha) + " and " + sizes(mlp.specular) + " (" +
                     std::string(activation_name(mlp.specular.activation)) + "), in single precision.";
  code.functions = network_helpers(mlp.specular.activation) + network_function("alpha_network", mlp.alpha) +
                   network_function("specular_network", mlp.specular) +
                   rows_wrapper("target_alpha_rows", "alpha_network") +
                   rows_wrapper("target_specular_rows", "specular_network");
  code.alpha_error = error_of(mlp.alpha, domain);
  code.specular_error = error_of(mlp.specular, domain);
  return code;
}

}  // namespace remapc
