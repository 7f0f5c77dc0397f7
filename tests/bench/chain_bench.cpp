// A path of three headers as texremap runs it, block by block, against a memcpy of the four channels.
#include <memory>

#include "bench/bench.hpp"
#include "bench/builds.hpp"
#include "remap/path.hpp"
#include "stages/stage.hpp"

namespace remap_bench {
namespace {

constexpr const char* kCode = "parametric";
constexpr int kSteps = 3;

// The build of a header as a stage.
class HeaderStage final : public remap::Stage {
 public:
  explicit HeaderStage(Pass pass) : pass_(pass) {}

  bool has_domain() const noexcept override { return true; }

  std::size_t run(remap::Block& block, std::uint8_t*) const override {
    const float* const width = block.row(remap::Parameter::kRoughness);
    const auto specular = block.color(remap::Parameter::kSpecular);
    return pass_(block.size(), width, specular, block.make(remap::Parameter::kRoughness),
                 block.make_color(remap::Parameter::kSpecular));
  }

 private:
  Pass pass_;
};

// A step from the model `number` to the next.
std::unique_ptr<remap::Converter> step(Pass pass, int number) {
  remap::ConverterInfo info;
  info.id = "step_" + std::to_string(number);
  info.source.model = "bench/" + std::to_string(number);
  info.target.model = "bench/" + std::to_string(number + 1);
  info.roughness = {0.005, 1.0};
  info.specular = {0.0, 1.0};
  return std::make_unique<remap::Converter>(std::move(info),
                                            remap::StageList{std::make_shared<HeaderStage>(pass)});
}

struct Chain {
  explicit Chain(Pass pass) {
    std::vector<const remap::Converter*> pointers;
    for (int i = 0; i < kSteps; ++i) {
      steps.push_back(step(pass, i));
      pointers.push_back(steps.back().get());
    }
    chained = remap::make_chained_converter(pointers);
  }
  std::vector<std::unique_ptr<remap::Converter>> steps;
  std::unique_ptr<remap::Converter> chained;
};

void convert(const remap::Converter& converter, Maps& maps) {
  const std::array<const float*, 3> specular = {maps.in[1].data(), maps.in[2].data(), maps.in[3].data()};
  const std::array<float*, 3> specular_out = {maps.out[1].data(), maps.out[2].data(), maps.out[3].data()};
  benchmark::DoNotOptimize(
      converter.convert(maps.texels, maps.in[0].data(), specular, maps.out[0].data(), specular_out));
}

std::string chain_name(const std::string& flags) { return "chain_" + flags; }

}  // namespace

void add_chains() {
  for (const Build<Pass>& build : pass_builds()) {
    if (build.code != kCode || build.flags == "o2") continue;
    const auto chain = std::make_shared<const Chain>(build.function);
    const std::string chained = chain_name(build.flags);
    add_benchmark(chained + "/large", large_maps().texels, 15,
                  [chain] { convert(*chain->chained, large_maps()); });
    add_benchmark(chained + "/small", small_maps().texels, 7,
                  [chain] { convert(*chain->chained, small_maps()); });
  }
}

Section chain_section(const Medians& medians) {
  Section section{"Path of three lowered parametric headers, roughness + RGB, one core", {}};
  for (const Build<Pass>& build : pass_builds()) {
    if (build.code != kCode || build.flags == "o2") continue;
    const std::string flags = flags_text(build.flags);
    section.rows.push_back(
        pass_row(medians, "chained at " + flags + ", 4096 x 4096", chain_name(build.flags), "large"));
    section.rows.push_back(
        pass_row(medians, "chained at " + flags + ", 64 x 64, in cache", chain_name(build.flags), "small"));
  }
  return section;
}

}  // namespace remap_bench
