// The study of warps on small sets: the registration is nearest to the known answer, outputs hold all
// figures, and sets are read back from files.
#include <algorithm>
#include <ctime>
#include <map>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "renderer/image_file.hpp"
#include "report/shaded_map.hpp"
#include "study/warp_sets.hpp"
#include "study/warps_report.hpp"
#include "support/temporary_folder.hpp"
#include "system/files.hpp"

using namespace remapc;
using Catch::Matchers::Contains;

namespace {

// Of one small set, shared by the cases below.
const WarpsOptions& small_options() {
  static const WarpsOptions options = [] {
    WarpsOptions made;
    made.cases = builtin_warp_cases(64, 2, {"leaf"});
    made.pictures = true;
    return made;
  }();
  return options;
}
const WarpsResult& small_result() {
  static const WarpsResult result = study_warps(small_options());
  return result;
}

WarpSummary summary(WarpGroup group, const std::string& name) {
  return summary_of(small_result(), variant_named(small_result(), group, name));
}

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("study warp: the registration is nearest to the known answer, without folds and tears", "[slow]") {
  const WarpSummary registration = summary(WarpGroup::kMethod, "registration");
  CHECK(registration.figures.mean < 30.0);
  for (const char* other : {"paper", "histogram", "affine", "nearest"}) {
    INFO(other);
    CHECK(registration.figures.mean < summary(WarpGroup::kMethod, other).figures.mean);
  }
  CHECK(registration.figures.tears < 1.0);
  CHECK(registration.figures.used > 80.0);
  REQUIRE(registration.cost.has_value());
  CHECK(registration.cost->folds == 0.0);
  CHECK(registration.cost->compiled.difference < 3.0);
  CHECK(registration.cost->bytes <= 250000.0);
  // Processor time of a part of what this process has done.
  CHECK(registration.cost->seconds > 0.0);
  CHECK(registration.cost->seconds < static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
  REQUIRE(registration.change.has_value());
  CHECK(*registration.change < *summary(WarpGroup::kMethod, "paper").change);
  // One dimension loses information that two keep.
  CHECK(summary(WarpGroup::kDimensions, "1").figures.mean > 2.0 * registration.figures.mean);
  CHECK(summary(WarpGroup::kDimensions, "2").figures.mean == registration.figures.mean);
}

TEST_CASE("study warp: the sampling of the study is that of fits, and finer tables are nearer", "[slow]") {
  CHECK(summary(WarpGroup::kPoints, "350").figures.mean ==
        Approx(summary(WarpGroup::kMethod, "registration").figures.mean).epsilon(1e-9));
  double last = 100.0;
  for (const char* nodes : {"1/8", "1/4", "1/2", "1", "2"}) {
    const double difference = summary(WarpGroup::kNodes, nodes).cost->compiled.difference;
    CHECK(difference < last);
    last = difference;
  }
}

TEST_CASE("study warp: figures of results that are known") {
  const WarpCase& leaf = small_options().cases.front();
  const WarpMeasures measures(leaf);
  const TexelCopy truth = measures.of_truth();
  CHECK(measures.change(truth, truth) == 0.0);
  const WarpFigures best = measures.of_copy(truth, leaf.strokes[0]);
  CHECK(best.mean < 3.0);  // the noise of texels
  CHECK(best.variation == Approx(1.0).margin(0.2));
  // Equal texels: no variation, no tears, one bin; the distance is that of one texel to the spread.
  const WarpFigures flat = measures.of_copy(TexelCopy(truth.size(), truth[0]), leaf.strokes[0]);
  CHECK(flat.variation == 0.0);
  CHECK(flat.tears == 0.0);
  CHECK(flat.used < 2.0);
  CHECK(flat.rms > 70.0);
  // Shuffled texels of the template are unrelated on average, so their squares add.
  TexelCopy mixed(truth.size());
  for (std::size_t i = 0; i < mixed.size(); ++i)
    mixed[i] = static_cast<std::uint32_t>(i * 1627 % mixed.size());
  CHECK(measures.of_copy(mixed, leaf.strokes[0]).rms == Approx(141.0).margin(20.0));
}

TEST_CASE("study warp: tables have all rows, pictures all cells", "[slow]") {
  const WarpsOptions& options = small_options();
  const std::size_t variants = warp_variants().size();
  const StudyReport report = warps_report(options, small_result());
  const std::string& csv = report.tables[0].second;
  CHECK_THAT(csv, Contains("set,stroke_set,group,variant,error,rms,median,p95,strokes,used,tears,variation,"
                           "folds,compiled_error,table_difference,bytes,seconds,dimensions\n"));
  CHECK(line_count(csv) == 5 + 2 * variants);
  for (std::size_t start = csv.find("\nleaf"); start != std::string::npos;
       start = csv.find("\nleaf", start + 1)) {
    const std::string line = csv.substr(start + 1, csv.find('\n', start + 1) - start - 1);
    CHECK(std::count(line.begin(), line.end(), ',') == 17);
  }
  // Two variants are copies without a warp; five variants of nodes share one warp.
  CHECK(line_count(report.tables[1].second) == 5 + variants - 7);
  CHECK_THAT(report.summary, Contains("Sets leaf, 64 x 64 texels, 2 sets of strokes each"));
  CHECK_THAT(report.summary, Contains("Mean error: registration "));
  CHECK_THAT(report.plot_script, Contains("$nodes using 1:2"));
  const auto& sheets = report.sheets;
  REQUIRE(sheets.size() == 3);
  CHECK(sheets[0].first == "warp_methods_leaf.png");
  CHECK(sheets[0].second.width == 7 * 262 + 6);  // pictures of 256 pixels, gaps of 6
  CHECK(sheets[0].second.height == 3 * 262 + 6);
  CHECK(sheets[1].second.width == 6 * 262 + 6);
  CHECK(sheets[2].second.width == 2 * 262 + 6);
  CHECK(sheets[2].second.height == 5 * 262 + 6);
}

TEST_CASE("study warp: sets from files") {
  const remap::TemporaryFolder folder;
  const WarpCase made = builtin_warp_cases(32, 1, {"leaf"}).front();
  const auto write = [&](const std::string& name, int channels, const auto& value) {
    Image image{32, 32, channels, {}};
    for (std::size_t i = 0; i < 32 * 32; ++i)
      for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c)
        image.values.push_back(value(i, c));
    write_exr(folder.path() / "0" / "leaf" / name, image, {});
  };
  const auto write_texels = [&](const std::string& part, const std::vector<remap::WarpTexel>& texels) {
    write(part + "/diffuse.exr", 3, [&](std::size_t i, std::size_t c) { return texels[i][c]; });
    write(part + "/specular.exr", 3, [&](std::size_t i, std::size_t c) { return texels[i][3 + c]; });
    write(part + "/alpha.exr", 1, [&](std::size_t i, std::size_t) { return texels[i][6]; });
  };
  CHECK_THROWS_WITH(read_warp_cases({folder.path() / "0"}), Contains("cannot be read"));
  write_texels("source", made.source.texels);
  write_texels("template", made.target.texels);
  CHECK_THROWS_WITH(read_warp_cases({folder.path() / "0"}), Contains("truth/diffuse.exr"));
  write_texels("truth", made.truth);
  for (std::size_t k = 0; k < made.strokes[0].size(); ++k)
    for (const bool is_source : {true, false}) {
      const StrokePair& stroke = made.strokes[0][k];
      const std::vector<std::uint32_t>& marked = is_source ? stroke.source : stroke.target;
      write(std::string("strokes/") + (is_source ? "source" : "template") + std::to_string(k) + ".exr", 1,
            [&](std::size_t i, std::size_t) {
              return std::count(marked.begin(), marked.end(), i) > 0 ? 1.0f : 0.0f;
            });
    }
  const std::vector<WarpCase> read = read_warp_cases({folder.path() / "0", folder.path() / "0"});
  REQUIRE(read.size() == 1);
  CHECK(read[0].name == "leaf");
  CHECK(read[0].source.texels == made.source.texels);
  CHECK(read[0].target.texels == made.target.texels);
  CHECK(read[0].truth == made.truth);
  REQUIRE(read[0].strokes.size() == 2);
  REQUIRE(read[0].strokes[1].size() == made.strokes[0].size());
  CHECK(read[0].strokes[1][2].target == made.strokes[0][2].target);
}

TEST_CASE("pictures of maps: sizes, and what a pixel shows") {
  const PictureGrid small = picture_grid(4, 2, 8);
  CHECK(small.width == 8);
  CHECK(small.height == 4);
  CHECK(small.samples == 1);
  CHECK(small.texels[0] == small.texels[1]);  // repeated
  const PictureGrid large = picture_grid(4096, 1024, 512);
  CHECK(large.width == 512);
  CHECK(large.height == 128);
  CHECK(large.texels.size() == 9 * 512 * 128);
  CHECK(*std::max_element(large.texels.begin(), large.texels.end()) < 4096u * 1024u);
  // A white diffuse map is brightest where it faces the key light, and no channel is ahead.
  const PictureGrid grid = picture_grid(16, 16, 16);
  const remap::WarpTexel white = {1, 1, 1, 0, 0, 0, 0.5f};
  const Image lit = shaded_map(grid, std::vector<remap::WarpTexel>(256, white), {Brdf::kGgx, Fresnel::kNone});
  CHECK(lit.values[0] == lit.values[2]);
  CHECK(lit.values[0] > lit.values[3 * 255]);
  CHECK(lit.values[0] > 0.9f);
}
