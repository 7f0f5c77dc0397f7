// This file holds what `remapc sweep` and `remapc sample` share: two models, their pictures, and the table.
#pragma once

#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "command_line/progress.hpp"
#include "core/json.hpp"
#include "core/system.hpp"
#include "measure/sweep_options.hpp"
#include "table/table.hpp"
#include "worker/renderer_set.hpp"

namespace remap {

struct MeasurementOptions {
  PairOptions pair;  // set when the command runs; its objective comes from the next members
  std::string objective = "natural";
  std::optional<std::vector<double>> lights;  // angles; if unset, the angles of the objective
  std::optional<Weighting> weighting;
  double distance = 3.0;
  bool keep_irradiance = false;
  std::filesystem::path output;
  bool force = false, json = false, quiet = false;
  unsigned jobs = 0;
  RendererOptions renderers;

  // These functions add options to `app`. They are for the models and the table, for pictures and how they
  // are compared, and for threads and renderers.
  void add_table_options(Command& app, const std::string& table);
  void add_picture_options(Command& app);
  void add_execution_options(Command& app);
  PairOptions chosen_pair() const;
};

// A Measurement is one run of a command: its clock, its renderers and its progress.
class Measurement {
 public:
  // Keeps a reference to `options`, which must outlive this object.
  explicit Measurement(const MeasurementOptions& options);

  const RendererSet& renderer() const { return *renderer_; }
  // Throws kOutput if the table exists or its folder cannot be made. Until write(), shows the progress of
  // `rows` rows with the text `label`.
  SweepExecution start(const std::string& label, std::size_t rows);
  // Writes the table with its comments, and prints remarks about its light and the renderers.
  void write(const std::string& table, const Comments& comments);
  // Prints a summary of the rows as a line. With --json, prints JSON instead: the name of the table, the
  // fields of `json`, and the summary.
  template <typename Row>
  void report(const std::vector<Row>& rows, const Json& json = nullptr) const {
    std::map<std::string, std::size_t> statuses;
    double square = 0.0;
    for (const Row& row : rows) {
      ++statuses[std::string(status_name(row.status))];
      square += row.error * row.error;
    }
    report(statuses, std::sqrt(square / static_cast<double>(rows.size())), json);
  }

 private:
  void report(const std::map<std::string, std::size_t>& statuses, double rms_error, const Json& fields) const;
  void show_progress(const std::string& models);
  // Estimates the time for all rows. If no terminal shows progress, prints the first estimate.
  void estimate(const std::string& models, std::size_t done, std::size_t rows);

  const MeasurementOptions& options_;
  Stopwatch stopwatch_;
  std::optional<Progress> progress_;  // counts rows; its label also counts the pictures of workers
  std::mutex mutex_;
  std::string estimate_;  // estimated time for all rows; empty if unknown
  std::unique_ptr<RendererSet> renderer_;
  LightMatch light_;
};

}  // namespace remap
