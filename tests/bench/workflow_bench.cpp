// This file measures how fast headers of workflow conversions are.
#include <cstring>
#include <random>

#include "bench/bench.hpp"
#include "bench/builds.hpp"
#include "runtime/stages/materials.hpp"

namespace remap_bench {
namespace {

constexpr std::size_t kLargeTexels = 2048 * 2048;  // more than any cache holds
constexpr std::size_t kSmallTexels = 4096;

template <typename Value, typename Rows>
auto pointers(Rows& rows) {
  std::array<Value*, std::tuple_size_v<Rows>> all{};
  for (std::size_t r = 0; r < rows.size(); ++r) all[r] = rows[r].data();
  return all;
}

// A MaterialMaps holds rows of a metallic material, rows of the equivalent specular material, and rows for
// the result of converting it back.
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
    const auto there = workflow_test::plain(remap::ClosedFormula::kEquation2);
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

// Copies as many bytes as a conversion reads and writes: six rows.
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

// Compares a benchmark of rows of texels with memcpy of the large rows.
Row pass_row(const Medians& medians, const std::string& what, const std::string& name,
             const std::string& maps) {
  return {what,       mega_items(medians, name + "/" + maps),
          "Mtexel/s", speed_ratio(medians, name + "/" + maps, "memcpy/" + maps),
          "memcpy",   {}};
}

}  // namespace

void add_workflows() {
  add_benchmark("memcpy/materials", kLargeTexels, 15, copy_rows);
  for (const Build<MaterialPass>& build : material_builds()) {
    const std::string name = build.code + "_" + build.flags;
    add_benchmark(name + "/small", kSmallTexels, 7, [build] { convert(build, kSmallTexels); });
    add_benchmark(name + "/materials", kLargeTexels, 15, [build] { convert(build, kLargeTexels); });
  }
}

Section workflow_section(const Medians& medians) {
  Section section{"Whole materials between workflows, 12 rows, one core", {}};
  section.rows.push_back(pass_row(medians, "memcpy of 6 rows, 2048 x 2048", "memcpy", "materials"));
  section.rows.back().ratio.reset();
  for (const Build<MaterialPass>& build : material_builds()) {
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

}  // namespace remap_bench
