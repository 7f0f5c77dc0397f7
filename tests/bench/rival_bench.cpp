// What else could convert the same maps: libsvm's own prediction, the support vectors as a compiled loop, a
// 3-D table by OpenColorIO.
#include <memory>

#include <libsvm/svm.h>

#include "bench/bench.hpp"
#include "bench/builds.hpp"
#include "model/interpreter.hpp"
#include "remap/fit_file.hpp"

#ifdef REMAP_BENCH_OPENCOLORIO
#include <OpenColorIO/OpenColorIO.h>
#endif

namespace remap_bench {
namespace {

// One expansion as the model that libsvm trained.
class Predictor {
 public:
  explicit Predictor(const remap::KernelExpansion& expansion)
      : inputs_(expansion.inputs),
        output_(expansion.output),
        weights_(expansion.weights),
        minus_bias_(-expansion.bias) {
    const std::size_t width = inputs_.size();
    for (std::size_t i = 0; i < expansion.count(); ++i) {
      for (std::size_t k = 0; k < width; ++k)
        nodes_.push_back({static_cast<int>(k) + 1, expansion.vectors[i * width + k]});
      nodes_.push_back({-1, 0.0});
    }
    for (std::size_t i = 0; i < expansion.count(); ++i) vectors_.push_back(&nodes_[i * (width + 1)]);
    weight_row_ = weights_.data();
    model_.param.svm_type = EPSILON_SVR;
    model_.param.kernel_type = RBF;
    model_.param.gamma = expansion.gamma;
    model_.nr_class = 2;
    model_.l = static_cast<int>(expansion.count());
    model_.SV = vectors_.data();
    model_.sv_coef = &weight_row_;
    model_.rho = &minus_bias_;
  }
  Predictor(const Predictor&) = delete;
  Predictor& operator=(const Predictor&) = delete;

  double operator()(double alpha, double specular) const {
    svm_node inputs[3] = {{1, normalised(0, alpha)}, {-1, 0.0}, {-1, 0.0}};
    if (inputs_.size() == 2) inputs[1] = {2, normalised(1, specular)};
    return svm_predict(&model_, inputs) / output_.scale + output_.offset;
  }

 private:
  double normalised(std::size_t k, double value) const {
    const remap::Scaling& scaling = inputs_[k];
    const double t = scaling.pole == 0.0 ? value : value / (value + scaling.pole);
    return (t - scaling.offset) * scaling.scale;
  }

  std::vector<remap::Scaling> inputs_;
  remap::Scaling output_;
  std::vector<double> weights_;
  double minus_bias_;
  std::vector<svm_node> nodes_;
  std::vector<svm_node*> vectors_;
  double* weight_row_ = nullptr;
  svm_model model_{};
};

constexpr std::size_t kPredictedTexels = 512;  // of the small maps

// Target alpha, and target specular of each channel.
void predict(const Predictor& alpha, const Predictor& specular) {
  Maps& maps = small_maps();
  for (std::size_t i = 0; i < kPredictedTexels; ++i) {
    const double width = maps.in[0][i];
    maps.out[0][i] = static_cast<float>(alpha(width, maps.in[1][i]));
    for (std::size_t c = 1; c < 4; ++c) maps.out[c][i] = static_cast<float>(specular(width, maps.in[c][i]));
  }
}

#ifdef REMAP_BENCH_OPENCOLORIO
namespace ocio = OCIO_NAMESPACE;

// An RGB image of as many texels as the large maps, and a table that is no identity. Three floats a texel and
// four are both measured, as the optimized processor of one thread takes them.
struct Colors {
  explicit Colors(long channel_count) : channels(channel_count) {
    const Maps& maps = large_maps();
    in.resize(maps.texels * static_cast<std::size_t>(channels));
    for (std::size_t i = 0; i < in.size(); ++i) in[i] = maps.in[0][i % maps.texels];
    out.assign(in.size(), 1.0f);
  }
  void convert(const ocio::CPUProcessor& processor) {
    const ocio::PackedImageDesc from(in.data(), 4096, 4096, channels);
    ocio::PackedImageDesc to(out.data(), 4096, 4096, channels);
    processor.apply(from, to);
  }
  long channels;
  std::vector<float> in, out;
};

ocio::ConstCPUProcessorRcPtr table_processor(unsigned long size, ocio::Interpolation interpolation) {
  const auto table = ocio::Lut3DTransform::Create(size);
  table->setInterpolation(interpolation);
  const auto value = [size](unsigned long i) { return static_cast<float>(i) / static_cast<float>(size - 1); };
  for (unsigned long r = 0; r < size; ++r)
    for (unsigned long g = 0; g < size; ++g)
      for (unsigned long b = 0; b < size; ++b) {
        const float red = value(r), green = value(g), blue = value(b);
        table->setValue(r, g, b, red * red, 0.5f * (green + red), blue * green);
      }
  const auto config = ocio::Config::CreateRaw();
  return config->getProcessor(table)->getOptimizedCPUProcessor(ocio::BIT_DEPTH_F32, ocio::BIT_DEPTH_F32,
                                                               ocio::OPTIMIZATION_DEFAULT);
}

void add_color_tables() {
  struct Table {
    const char* name;
    unsigned long size;
    ocio::Interpolation interpolation;
  };
  for (const Table& table : {Table{"ocio tetrahedral 32", 32, ocio::INTERP_TETRAHEDRAL},
                             Table{"ocio trilinear 32", 32, ocio::INTERP_LINEAR},
                             Table{"ocio tetrahedral 64", 64, ocio::INTERP_TETRAHEDRAL}}) {
    const auto processor = table_processor(table.size, table.interpolation);
    for (const long channels : {3, 4}) {
      const auto colors = [channels]() -> Colors& {
        static Colors three(3), four(4);
        return channels == 3 ? three : four;
      };
      add_benchmark(std::string(table.name) + "/" + std::to_string(channels), large_maps().texels, 3,
                    [processor, colors] { colors().convert(*processor); });
    }
  }
}
#endif

Row rival_row(const Medians& medians, const std::string& flags, const std::string& rival,
              const std::string& text, std::optional<double> goal) {
  Row row;
  row.what = "lowered SVR at " + flags_text(flags) + " (4096 x 4096)";
  row.value = mega_items(medians, rival);
  row.unit = "Mtexel/s";
  row.ratio = speed_ratio(medians, "svr_" + flags + "/large", rival);
  row.rival = text;
  row.goal = goal;
  return row;
}

std::string faster(const Medians& medians, const std::string& a, const std::string& b) {
  return medians.seconds(a).value_or(1e300) < medians.seconds(b).value_or(1e300) ? a : b;
}

}  // namespace

void add_rivals() {
  const remap::Fit fit = remap::load_fit(REMAP_BENCH_FOLDER "/svr.json");
  const remap::Svr& svr = std::get<remap::Svr>(fit.mapping);
  const auto alpha = std::make_shared<Predictor>(svr.alpha),
             specular = std::make_shared<Predictor>(svr.specular);
  add_benchmark("libsvm", kPredictedTexels, 5, [alpha, specular] { predict(*alpha, *specular); });
#ifdef REMAP_BENCH_OPENCOLORIO
  add_color_tables();
#endif
}

Section rival_section(const Medians& medians) {
  Section section{"Lowered SVR against other ways to the same texels, one core (the speed is the rival's)",
                  {}};
  bool has_avx2 = false;
  for (const Build<Pass>& build : pass_builds()) has_avx2 = has_avx2 || build.flags == "avx2";
  const std::string best = has_avx2 ? "avx2" : "o3";
  std::vector<std::string> all = {"o3"};
  if (has_avx2) all.insert(all.begin(), "avx2");
  for (const std::string& flags : all) {
    const auto goal = [&](double value) { return flags == best ? std::optional(value) : std::nullopt; };
    section.rows.push_back(rival_row(medians, flags, "libsvm", "svm_predict", goal(2000.0)));
    section.rows.push_back(
        rival_row(medians, flags, "svr_double_" + flags + "/small", "loop, double, same flags", goal(60.0)));
    section.rows.push_back(
        rival_row(medians, flags, "svr_float_" + flags + "/small", "loop, float, same flags", std::nullopt));
    for (const char* table : {"tetrahedral 32", "trilinear 32", "tetrahedral 64"}) {
      const std::string name = "ocio " + std::string(table);
      const bool judged = std::string(table) == "tetrahedral 32";
      section.rows.push_back(rival_row(medians, flags, faster(medians, name + "/3", name + "/4"),
                                       "OpenColorIO " + std::string(table),
                                       judged ? goal(5.0) : std::nullopt));
    }
  }
#ifndef REMAP_BENCH_OPENCOLORIO
  section.title += "; OpenColorIO skipped: libopencolorio-dev was not found";
#endif
  return section;
}

}  // namespace remap_bench
