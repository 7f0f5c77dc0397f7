// This file measures a rival that could convert the same maps: a 3-D table by OpenColorIO.
#include "bench/bench.hpp"
#include "bench/builds.hpp"

#ifdef REMAP_BENCH_OPENCOLORIO
#include <OpenColorIO/OpenColorIO.h>
#endif

namespace remap_bench {
namespace {

#ifdef REMAP_BENCH_OPENCOLORIO
namespace ocio = OCIO_NAMESPACE;

// A Colors holds an RGB image with as many texels as the large maps, and a table that changes colors. Three
// and four floats per texel are both measured, in the form that OpenColorIO's optimized processor accepts on
// one thread.
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

constexpr unsigned long kTableSize = 32;

ocio::ConstCPUProcessorRcPtr table_processor() {
  const auto table = ocio::Lut3DTransform::Create(kTableSize);
  table->setInterpolation(ocio::INTERP_TETRAHEDRAL);
  const auto value = [](unsigned long i) {
    return static_cast<float>(i) / static_cast<float>(kTableSize - 1);
  };
  for (unsigned long r = 0; r < kTableSize; ++r)
    for (unsigned long g = 0; g < kTableSize; ++g)
      for (unsigned long b = 0; b < kTableSize; ++b) {
        const float red = value(r), green = value(g), blue = value(b);
        table->setValue(r, g, b, red * red, 0.5f * (green + red), blue * green);
      }
  const auto config = ocio::Config::CreateRaw();
  return config->getProcessor(table)->getOptimizedCPUProcessor(ocio::BIT_DEPTH_F32, ocio::BIT_DEPTH_F32,
                                                               ocio::OPTIMIZATION_DEFAULT);
}
#endif

std::string table_name(long channels) { return "ocio/" + std::to_string(channels); }

// Returns the layout that is faster with OpenColorIO.
std::string faster_table(const Medians& medians) {
  const auto seconds = [&](long channels) { return medians.seconds(table_name(channels)).value_or(1e300); };
  return table_name(seconds(3) < seconds(4) ? 3 : 4);
}

}  // namespace

void add_rivals() {
#ifdef REMAP_BENCH_OPENCOLORIO
  const auto processor = table_processor();
  for (const long channels : {3, 4}) {
    const auto colors = [channels]() -> Colors& {
      static Colors three(3), four(4);
      return channels == 3 ? three : four;
    };
    add_benchmark(table_name(channels), large_maps().texels, 3,
                  [processor, colors] { colors().convert(*processor); });
  }
#endif
}

Section rival_section(const Medians& medians) {
  Section section{"A header of BRDFs against OpenColorIO's 3-D table, one core (the speed is the rival's)",
                  {}};
#ifndef REMAP_BENCH_OPENCOLORIO
  section.title += "; skipped: libopencolorio-dev was not found";
#endif
  const std::string rival = faster_table(medians);
  for (const Build<Pass>& build : pass_builds()) {
    if (build.code != kLargeHeader || (build.flags != "o3" && build.flags != "avx2")) continue;
    section.rows.push_back(
        {"header at " + flags_text(build.flags) + " (4096 x 4096)", mega_items(medians, rival), "Mtexel/s",
         speed_ratio(medians, build.code + "_" + build.flags + "/large", rival), "OpenColorIO tetrahedral 32",
         build.flags == "avx2" ? std::optional(5.0) : std::nullopt});
  }
  return section;
}

}  // namespace remap_bench
