#include "emit/lookup_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "fit/rows/folds.hpp"
#include "model/interpreter.hpp"
#include "remap/error.hpp"
#include "system/parallel.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;
using remap::number_text;

constexpr std::size_t kStepsOfOneAxis = 16;
constexpr std::size_t kStepsOfTwoAxes = 8;

std::vector<double> even_steps(const remap::Range& range, std::size_t count) {
  std::vector<double> positions;
  for (std::size_t i = 0; i + 1 < count; ++i)
    positions.push_back(range.min +
                        (range.max - range.min) * static_cast<double>(i) / static_cast<double>(count - 1));
  positions.push_back(range.max);
  return positions;
}

void require_sizes(const LookupOptions& options, bool has_specular_axis) {
  const auto require = [](const std::string& name, std::size_t size) {
    if (size < 2 || size > kMostLookupRows)
      throw Error(ErrorKind::kUsage, name + ": " + std::to_string(size) + " samples are out of range (2 to " +
                                         std::to_string(kMostLookupRows) + ")");
  };
  require("size", options.size);
  require("specular size", options.specular_size);
  if (has_specular_axis && options.size > kMostLookupRows / options.specular_size)
    throw Error(ErrorKind::kUsage,
                "size: " + std::to_string(options.size) + " x " + std::to_string(options.specular_size) +
                    " rows are too many (at most " + std::to_string(kMostLookupRows) + ")");
}

// Both outputs at one sample of the source.
struct Values {
  double width, specular;
};

class Sampler {
 public:
  Sampler(const remap::Fit& fit, const LookupOptions& options, const FitProgress& progress)
      : fit_(fit), options_(options), progress_(progress) {
    // The same mapping between models whose own parameter is alpha.
    if (options.canonical) fit_.source.roughness = fit_.target.roughness = remap::RoughnessConvention::kAlpha;
  }

  LookupTable sample() {
    lay_out();
    const std::size_t widths = table_.axes[0].positions.size();
    // Progress counts the widths of the grid, then the cells between them.
    double done = 0.0;
    const auto report = [&] {
      const std::lock_guard lock(mutex_);
      ++done;
      if (progress_) progress_(done / static_cast<double>(2 * widths - 1));
    };
    remap::run_parallel(widths, options_.jobs, [&](std::size_t i) {
      fill(i);
      report();
    });
    std::vector<std::vector<Errors>> errors(widths - 1);
    remap::run_parallel(widths - 1, options_.jobs, [&](std::size_t i) {
      errors[i] = judge_cells(i);
      report();
    });
    put_together(errors);
    return std::move(table_);
  }

 private:
  struct Errors {
    double square_sum = 0.0, max = 0.0;
    std::size_t count = 0;
    void take(double error) {
      square_sum += error * error;
      max = std::max(max, std::fabs(error));
      ++count;
    }
  };

  bool has_two_axes() const { return table_.axes.size() == 2; }
  std::size_t specular_count() const { return has_two_axes() ? table_.axes[1].positions.size() : 1; }

  void lay_out() {
    const bool gives_width = options_.output != LookupOutput::kSpecular;
    const bool gives_specular = options_.output != LookupOutput::kRoughness;
    const bool two_axes = (gives_width && alpha_depends_on_specular(fit_.mapping)) ||
                          (gives_specular && !is_proportional(fit_.mapping)) || reaches_limit(fit_);
    require_sizes(options_, two_axes);
    table_.axes.push_back({"source_" + std::string(convention_name(fit_.source.roughness)),
                           even_steps(own_roughness_range(fit_), options_.size)});
    if (two_axes)
      table_.axes.push_back(
          {"source_" + fit_.source.specular, even_steps(specular_range(fit_), options_.specular_size)});
    const std::size_t count = options_.size * specular_count();
    if (gives_width) add_column(std::string(convention_name(fit_.target.roughness)), &Values::width, count);
    if (gives_specular)
      add_column(fit_.target.specular + (two_axes ? "" : "_factor"), &Values::specular, count);
  }

  void add_column(const std::string& name, double Values::*part, std::size_t count) {
    table_.columns.push_back({"target_" + name, std::vector<double>(count), 0.0, 0.0});
    parts_.push_back(part);
  }

  Values evaluate(double width, double specular) const {
    const std::array<double, 1> in = {specular};
    std::array<double, 1> out{};
    const double target_width = evaluate_texel(fit_, width, in, out);
    if (!std::isfinite(target_width) || !std::isfinite(out[0]))
      throw Error(ErrorKind::kNumeric, fit_.id + ": gives " + number_text(target_width) + " and " +
                                           number_text(out[0]) + " at " + table_.axes[0].name + " " +
                                           number_text(width) + ", specular " + number_text(specular) +
                                           " (not finite)");
    return {target_width, out[0]};
  }

  double specular_at(std::size_t j) const { return has_two_axes() ? table_.axes[1].positions[j] : 1.0; }

  // All grid points of one width.
  void fill(std::size_t i) {
    for (std::size_t j = 0; j < specular_count(); ++j) {
      const Values values = evaluate(table_.axes[0].positions[i], specular_at(j));
      for (std::size_t c = 0; c < parts_.size(); ++c)
        table_.columns[c].values[i * specular_count() + j] = values.*parts_[c];
    }
  }

  // Errors of each column in the cells between width i and the next.
  std::vector<Errors> judge_cells(std::size_t i) const {
    // One axis counts as one cell of specular with one step, at a specular of 1.
    const bool two = has_two_axes();
    const std::size_t steps = two ? kStepsOfTwoAxes : kStepsOfOneAxis, specular_steps = two ? steps : 1,
                      specular_cells = two ? specular_count() - 1 : 1;
    const std::vector<double>& widths = table_.axes[0].positions;
    std::vector<Errors> errors(parts_.size());
    for (std::size_t step = 0; step < steps; ++step) {
      const double t = static_cast<double>(step) / static_cast<double>(steps);
      const double width = widths[i] + t * (widths[i + 1] - widths[i]);
      for (std::size_t j = 0; j < specular_cells; ++j)
        for (std::size_t k = 0; k < specular_steps; ++k) {
          const double u = static_cast<double>(k) / static_cast<double>(steps);
          judge(width, specular_at(j) + u * (specular_at(j + 1) - specular_at(j)), {i, j, t, u}, errors);
        }
    }
    return errors;
  }

  // A grid cell, and a place in it from 0 to 1.
  struct Place {
    std::size_t i, j;
    double t, u;
  };

  void judge(double width, double specular, const Place& place, std::vector<Errors>& errors) const {
    const Values values = evaluate(width, specular);
    for (std::size_t c = 0; c < parts_.size(); ++c)
      errors[c].take(looked_up(table_.columns[c].values, place) - values.*parts_[c]);
  }

  double looked_up(const std::vector<double>& values, const Place& place) const {
    const std::size_t row = specular_count();
    const auto along_specular = [&](std::size_t i) {
      const double* at = &values[i * row + place.j];
      return has_two_axes() ? at[0] + place.u * (at[1] - at[0]) : at[0];
    };
    const double low = along_specular(place.i), high = along_specular(place.i + 1);
    return low + place.t * (high - low);
  }

  void put_together(const std::vector<std::vector<Errors>>& errors) {
    for (std::size_t c = 0; c < parts_.size(); ++c) {
      Errors all;
      for (const std::vector<Errors>& cells : errors) {
        all.square_sum += cells[c].square_sum;
        all.max = std::max(all.max, cells[c].max);
        all.count += cells[c].count;
      }
      table_.columns[c].rms_error = std::sqrt(all.square_sum / static_cast<double>(all.count));
      table_.columns[c].max_error = all.max;
      table_.judged_count = all.count;
    }
  }

  remap::Fit fit_;
  const LookupOptions& options_;
  const FitProgress& progress_;
  LookupTable table_;
  std::vector<double Values::*> parts_;  // what each column holds
  std::mutex mutex_;
};

}  // namespace

LookupTable sample_fit(const remap::Fit& fit, const LookupOptions& options, const FitProgress& progress) {
  return Sampler(fit, options, progress).sample();
}

}  // namespace remapc
