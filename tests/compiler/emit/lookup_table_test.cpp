// Lookup tables: an independent reader of the file against the interpreter.
#include "emit/lookup_table.hpp"

#include <cmath>
#include <map>
#include <random>
#include <sstream>

#include <catch2/catch.hpp>

#include "model/interpreter.hpp"
#include "remap/error.hpp"
#include "text/number_text.hpp"

using namespace remapc;
using remap::Fit;
using remap::Parametric;
using remap::RoughnessConvention;

namespace {

const remap::AlphaCurve kSlope{1.02, -0.4, 1.7, -1.1, 3.3, 0.0};
const remap::AlphaCurve kOffset{0.01, 0.002, 0.5, 0.0, 0.0, 0.0};
const std::vector<double> kQuartic = {1.04, -0.388, -0.332, 0.25};

Fit fit_of(const remap::MappingKind& mapping) {
  Fit fit;
  fit.id = "a_to_b";
  fit.source = {"a/ward", RoughnessConvention::kRoughness, "specular"};
  fit.target = {"b/ggx", RoughnessConvention::kAlpha, "f0"};
  fit.domain = {{0.05, 1.0}, {0.0, 0.6}};
  fit.mapping = mapping;
  return fit;
}

// Target alpha from alpha alone, target specular in proportion.
const Parametric kPaper{{kQuartic}, {{1, kSlope}}};
// Target specular with an offset.
const Parametric kAffine{{kQuartic}, {{0, kOffset}, {1, kSlope}}};
// Both from both.
const Parametric kLeaning{{kQuartic, {-0.01, 0.2, 0.01}}, {{1, kSlope}, {2, kOffset}}};

// One Gaussian an output, with inputs scaled.
remap::Svr some_svr() {
  const remap::KernelExpansion alpha{{{0.05, 1.0}}, {0.1, 2.0}, 1.5, 0.2, {0.0, 0.9}, {-0.3, 1.2}};
  const remap::KernelExpansion specular{{{0.05, 1.0}, {0.0, 1.7}}, {0.0, 1.5}, 0.8, 0.3,
                                        {0.0, 0.0, 0.5, 1.0},      {-0.4, 0.9}};
  return {alpha, specular};
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> cells;
  std::istringstream stream(text);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

std::vector<double> numbers(const std::string& text) {
  std::vector<double> values;
  for (const std::string& cell : split(text)) values.push_back(remap::parse_number(cell).value());
  return values;
}

// A reader as a tool would have it: head, sizes, domain, linear lookup between even steps.
class Reader {
 public:
  explicit Reader(const std::string& text) {
    std::istringstream stream(text);
    std::string line;
    while (std::getline(stream, line) && line.starts_with("# ")) {
      const std::size_t colon = line.find(": ");
      head_[line.substr(2, colon - 2)] = line.substr(colon + 2);
    }
    names_ = split(line);
    while (std::getline(stream, line)) rows_.push_back(numbers(line));
    for (const double size : numbers(head("size"))) sizes_.push_back(static_cast<std::size_t>(size));
  }

  const std::string& head(const std::string& key) const { return head_.at(key); }
  bool has(const std::string& key) const { return head_.contains(key); }
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<std::vector<double>>& rows() const { return rows_; }
  const std::vector<std::size_t>& sizes() const { return sizes_; }

  // Column `column` of the columns behind the axes.
  double look_up(std::size_t column, const std::vector<double>& position) const {
    const std::vector<double> low = numbers(head("domain_min")), high = numbers(head("domain_max"));
    double sum = 0.0;
    for (std::size_t corner = 0; corner < (std::size_t{1} << sizes_.size()); ++corner) {
      double weight = 1.0;
      std::size_t row = 0;
      for (std::size_t axis = 0; axis < sizes_.size(); ++axis) {
        const double steps = static_cast<double>(sizes_[axis] - 1);
        const double t = (position[axis] - low[axis]) / (high[axis] - low[axis]) * steps;
        const double cell = std::min(std::floor(t), steps - 1.0);
        const bool upper = (corner >> axis & 1) != 0;
        weight *= upper ? t - cell : 1.0 - (t - cell);
        row = row * sizes_[axis] + static_cast<std::size_t>(cell) + (upper ? 1 : 0);
      }
      sum += weight * rows_[row][sizes_.size() + column];
    }
    return sum;
  }

 private:
  std::map<std::string, std::string> head_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> rows_;
  std::vector<std::size_t> sizes_;
};

struct Texel {
  double width, specular;
};

Texel interpreted(const Fit& fit, double width, double specular) {
  const std::array<double, 1> in = {specular};
  std::array<double, 1> out{};
  const double target = evaluate_texel(fit, width, in, out);
  return {target, out[0]};
}

Reader exported(const Fit& fit, const LookupOptions& options) {
  return Reader(lookup_text(fit, sample_fit(fit, options)));
}

LookupOptions small(LookupOutput output = LookupOutput::kBoth) {
  LookupOptions options;
  options.size = 9;
  options.specular_size = 5;
  options.output = output;
  return options;
}

}  // namespace

TEST_CASE("lookup: a proportional fit that depends on alpha only has one axis and the factor to specular") {
  const Fit fit = fit_of(kPaper);
  const Reader table = exported(fit, small());
  CHECK(table.names() == std::vector<std::string>{"source_roughness", "target_alpha", "target_f0_factor"});
  REQUIRE(table.rows().size() == 9);
  CHECK(table.head("interpolation") == "linear");
  CHECK(table.head("factor") == "f0 of the target = factor * specular of the source, for each channel");
  const remap::Range range = own_roughness_range(fit);
  CHECK(table.rows().front()[0] == range.min);
  CHECK(table.rows().back()[0] == range.max);
  for (const auto& row : table.rows()) {
    CHECK(row[1] == interpreted(fit, row[0], 0.3).width);
    CHECK(row[2] == Approx(interpreted(fit, row[0], 0.3).specular / 0.3).epsilon(1e-14));
    CHECK(row[2] == Approx(interpreted(fit, row[0], 7.0).specular / 7.0).epsilon(1e-14));
  }
}

TEST_CASE("lookup: outputs that depend on specular have two axes, with the interpreter's values") {
  for (const remap::MappingKind& mapping :
       {remap::MappingKind(kAffine), remap::MappingKind(kLeaning), remap::MappingKind(some_svr())}) {
    CAPTURE(mapping.index());
    const Fit fit = fit_of(mapping);
    const Reader table = exported(fit, small());
    CHECK(table.names() ==
          std::vector<std::string>{"source_roughness", "source_specular", "target_alpha", "target_f0"});
    CHECK(table.head("interpolation") == "bilinear");
    CHECK(table.sizes() == std::vector<std::size_t>{9, 5});
    REQUIRE(table.rows().size() == 45);
    CHECK(table.rows()[44][1] == specular_range(fit).max);
    CHECK(table.rows()[1][0] == table.rows()[0][0]);  // the last axis varies fastest
    for (const auto& row : table.rows()) {
      CHECK(row[2] == interpreted(fit, row[0], row[1]).width);
      CHECK(row[3] == interpreted(fit, row[0], row[1]).specular);
    }
  }
}

TEST_CASE("lookup: a reader gets the fit within the stated error, which is tight") {
  std::mt19937_64 random(5);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (const remap::MappingKind& mapping : {remap::MappingKind(kPaper), remap::MappingKind(kAffine),
                                            remap::MappingKind(kLeaning), remap::MappingKind(some_svr())}) {
    CAPTURE(mapping.index());
    const Fit fit = fit_of(mapping);
    const Reader table = exported(fit, small());
    const bool is_factor = table.sizes().size() == 1;
    const std::vector<double> stated = numbers(table.head("lookup_error_max"));
    const remap::Range widths = own_roughness_range(fit), speculars = specular_range(fit);
    double worst[2] = {0.0, 0.0};
    for (int i = 0; i < 20000; ++i) {
      const double width = uniform(widths.min, widths.max);
      const double specular = is_factor ? 1.0 : uniform(speculars.min, speculars.max);
      const Texel texel = interpreted(fit, width, specular);
      worst[0] = std::max(worst[0], std::fabs(table.look_up(0, {width, specular}) - texel.width));
      worst[1] = std::max(worst[1], std::fabs(table.look_up(1, {width, specular}) - texel.specular));
    }
    for (std::size_t c = 0; c < 2; ++c) {
      // The stated figure is that of a dense sample, rounded up to two digits.
      CHECK(worst[c] <= 1.02 * stated[c]);
      CHECK(worst[c] >= 0.8 * stated[c]);
    }
  }
}

TEST_CASE("lookup: the error falls with the square of the size") {
  const Fit fit = fit_of(kPaper);
  LookupOptions options = small();
  const double coarse = sample_fit(fit, options).columns[1].max_error;
  options.size = 33;
  CHECK(sample_fit(fit, options).columns[1].max_error < coarse / 8.0);  // 16 in the limit
}

TEST_CASE("lookup: a single output has only the axes that it needs") {
  const Fit affine = fit_of(kAffine), leaning = fit_of(kLeaning);
  CHECK(exported(affine, small(LookupOutput::kRoughness)).names() ==
        std::vector<std::string>{"source_roughness", "target_alpha"});
  CHECK(exported(affine, small(LookupOutput::kSpecular)).names() ==
        std::vector<std::string>{"source_roughness", "source_specular", "target_f0"});
  CHECK(exported(leaning, small(LookupOutput::kRoughness)).names() ==
        std::vector<std::string>{"source_roughness", "source_specular", "target_alpha"});
}

TEST_CASE("lookup: canonical tables hold alpha, and state how the models' parameters convert to it") {
  Fit fit = fit_of(kPaper);
  fit.source.roughness = RoughnessConvention::kExponent;
  LookupOptions options = small();
  const double own_error = sample_fit(fit, options).columns[0].max_error;
  options.canonical = true;
  const Reader table = exported(fit, options);
  CHECK(table.names()[0] == "source_alpha");
  CHECK(table.head("source_alpha") == "sqrt(2 / (exponent + 2))");
  CHECK(table.head("source_roughness") == "exponent");
  CHECK_FALSE(table.has("target_alpha"));
  for (const auto& row : table.rows())
    CHECK(row[1] == Approx(interpreted(fit, from_alpha(RoughnessConvention::kExponent, row[0]), 0.3).width));
  // Even steps of an exponent hardly sample rough materials.
  CHECK(own_error > 20.0 * sample_fit(fit, options).columns[0].max_error);
}

TEST_CASE("lookup: the table does not depend on the number of threads, and progress rises to 1") {
  const Fit fit = fit_of(some_svr());
  LookupOptions options = small();
  options.jobs = 1;
  double last = 0.0;
  const std::string one = lookup_text(fit, sample_fit(fit, options, [&](double share) {
                                        CHECK(share > last);
                                        last = share;
                                      }));
  CHECK(last == 1.0);
  options.jobs = 3;
  CHECK(lookup_text(fit, sample_fit(fit, options)) == one);
}

TEST_CASE("lookup: invalid sizes and fits are refused") {
  LookupOptions options = small();
  options.size = 1;
  CHECK_THROWS_WITH(sample_fit(fit_of(kPaper), options),
                    Catch::Contains("size: 1 samples are out of range (2 to"));
  options.size = kMostLookupRows;
  CHECK_THROWS_WITH(sample_fit(fit_of(kAffine), options),
                    Catch::Contains("1048576 x 5 rows are too many (at most"));
  Fit fit = fit_of(kPaper);
  fit.mapping = Parametric{{{-1.0}}, {{1, kSlope}}};
  fit.target.roughness = RoughnessConvention::kRoughness;  // the root of a negative alpha
  CHECK_THROWS_WITH(sample_fit(fit, small()), Catch::Contains("(not finite)"));
}
