// Headers of workflow conversions: how fast, and how exact on the materials that both workflows can say.
#include <cmath>
#include <cstring>
#include <random>

#include "bench/bench.hpp"
#include "bench/builds.hpp"
#include "runtime/stages/materials.hpp"

namespace remap_bench {
namespace {

constexpr std::size_t kLargeTexels = 2048 * 2048;  // beyond every cache
constexpr std::size_t kSmallTexels = 4096;

template <typename Value, typename Rows>
auto pointers(Rows& rows) {
  std::array<Value*, std::tuple_size_v<Rows>> all{};
  for (std::size_t r = 0; r < rows.size(); ++r) all[r] = rows[r].data();
  return all;
}

// Rows of a metallic material, of the specular one that it is, and of what comes back.
struct MaterialMaps {
  std::array<std::vector<float>, 5> metallic, back;
  std::array<std::vector<float>, 7> specular;

  MaterialMaps() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    for (auto& row : metallic) {
      row.resize(kLargeTexels);
      for (float& value : row) value = share(random);
    }
    for (auto& row : back) row.assign(kLargeTexels, 1.0f);
    for (auto& row : specular) row.assign(kLargeTexels, 1.0f);
    const auto there = workflow_test::plain(remap::Equation2{});
    const auto in = pointers<const float>(metallic);
    const auto out = pointers<float>(specular);
    remap::convert_workflow(there, kLargeTexels, in, out);
  }
};

MaterialMaps& maps() {
  static MaterialMaps all;
  return all;
}

bool is_to_metallic(const std::string& code) { return code.starts_with("specular_to_metallic"); }
bool is_network(const std::string& code) { return code == kNetworkHeader; }

void convert(const Build<MaterialPass>& build, std::size_t texels) {
  MaterialMaps& m = maps();
  const auto metallic = pointers<const float>(m.metallic);
  const auto specular_in = pointers<const float>(m.specular);
  const auto specular_out = pointers<float>(m.specular);
  const auto back = pointers<float>(m.back);
  if (is_to_metallic(build.code))
    benchmark::DoNotOptimize(build.function(texels, specular_in.data(), back.data()));
  else
    benchmark::DoNotOptimize(build.function(texels, metallic.data(), specular_out.data()));
}

// As many bytes read and written as by a conversion: six rows.
void copy_rows() {
  MaterialMaps& m = maps();
  for (std::size_t r = 0; r < 5; ++r)
    std::memcpy(m.back[r].data(), m.metallic[r].data(), kLargeTexels * sizeof(float));
  std::memcpy(m.back[0].data(), m.specular[6].data(), kLargeTexels * sizeof(float));
}

std::optional<double> speed_goal(const std::string& code, const std::string& flags) {
  if (flags != "avx2") return std::nullopt;
  return is_to_metallic(code) ? 50.0 : 0.8;
}

struct FamilyError {
  double metallic = 0.0, base_color = 0.0;
};

// Uniform random metallic materials to 8-bit specular maps and back.
FamilyError family_error(const remap::WorkflowConversion& there, const remap::WorkflowConversion& back) {
  constexpr int kCount = 100000;
  std::mt19937 random(2);
  FamilyError sum;
  for (int i = 0; i < kCount; ++i) {
    const remap::MetallicMaterial truth = workflow_test::random_metallic(random);
    remap::SpecularMaterial stored = to_specular(there, truth);
    for (float& value : stored.diffuse) value = static_cast<float>(workflow_test::in_8_bits(value));
    for (float& value : stored.specular) value = static_cast<float>(workflow_test::in_8_bits(value));
    const remap::MetallicMaterial result = to_metallic(back, stored);
    sum.metallic += std::pow(result.metallic - truth.metallic, 2) / kCount;
    for (std::size_t c = 0; c < 3; ++c)
      sum.base_color +=
          std::pow(remap::linear_to_srgb(result.base_color[c]) - remap::linear_to_srgb(truth.base_color[c]),
                   2) /
          (3.0 * kCount);
  }
  return {std::sqrt(sum.metallic), std::sqrt(sum.base_color)};
}

void add_errors(Section* section, const std::string& name, const FamilyError& error, bool has_goal) {
  const auto add = [&](const std::string& what, double value, double goal) {
    Row row;
    row.what = name + ": " + what;
    row.value = value;
    row.unit = "rms";
    row.goal_is_ratio = false;
    if (has_goal) row.goal = goal;
    section->rows.push_back(row);
  };
  add("metallic", error.metallic, 0.002);
  add("base color, sRGB", error.base_color, 0.0015);
}

}  // namespace

void add_workflows() {
  add_benchmark("memcpy/materials", kLargeTexels, 15, copy_rows);
  for (const Build<MaterialPass>& build : material_builds()) {
    const std::string name = build.code + "_" + build.flags;
    add_benchmark(name + "/small", kSmallTexels, 7, [build] { convert(build, kSmallTexels); });
    if (is_network(build.code)) continue;  // in network_section(), beside what it is compared with
    add_benchmark(name + "/materials", kLargeTexels, 15, [build] { convert(build, kLargeTexels); });
  }
}

Section workflow_section(const Medians& medians) {
  Section section{"Whole materials between workflows, 12 rows, one core", {}};
  section.rows.push_back(pass_row(medians, "memcpy of 6 rows, 2048 x 2048", "memcpy", "materials"));
  section.rows.back().ratio.reset();
  for (const Build<MaterialPass>& build : material_builds()) {
    if (is_network(build.code)) continue;
    const std::string name = build.code + "_" + build.flags,
                      what = build.code + " at " + flags_text(build.flags);
    section.rows.push_back(pass_row(medians, what + ", 2048 x 2048", name, "materials"));
    if (is_to_metallic(build.code)) section.rows.back().ratio.reset();
    section.rows.back().goal = speed_goal(build.code, build.flags);
    section.rows.back().goal_is_ratio = !is_to_metallic(build.code);
    section.rows.push_back(pass_row(medians, what + ", 64 x 64, in cache", name, "small"));
    section.rows.back().ratio.reset();
  }
  return section;
}

Section workflow_error_section(const Medians& medians) {
  Section section{"Metallic materials as 8-bit specular maps and back, 100 000 uniform ones", {}};
  if (!medians.seconds("memcpy/materials")) return section;  // filtered out
  using namespace remap;
  const auto plain = [](const WorkflowFormula& formula) { return workflow_test::plain(formula); };
  const auto gltf = [](const WorkflowFormula& formula) { return workflow_test::gltf(formula); };
  const auto there = plain(Equation2{}), there_gltf = gltf(Equation2{});
  add_errors(&section, "projection", family_error(there, plain(Projection{kCleanPrior})), true);
  add_errors(&section, "equation (3), weighted", family_error(there, plain(Equation3{MetallicMean::kAlbedo})),
             false);
  add_errors(&section, "glTF, projection", family_error(there_gltf, gltf(Projection{kCleanPrior})), false);
  return section;
}

}  // namespace remap_bench
