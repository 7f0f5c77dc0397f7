// The summary that sweep and sample print of their table.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "table/table.hpp"
#include "worker/renderer_set.hpp"

namespace remapc {

class TableSummary {
 public:
  // Adds a row with its image error (relative RMS).
  void add(RowStatus status, double error);

  // Appends to `json`: rows, rows by status, error, pictures and `seconds`.
  void append_to(nlohmann::ordered_json* json, const PictureCount& pictures, double seconds) const;
  // The same as one line without a line break.
  std::string text(const PictureCount& pictures, double seconds) const;

 private:
  double rms_error() const;

  std::size_t rows_ = 0;
  double square_ = 0.0;  // sum of squared errors
  std::map<std::string, std::size_t> statuses_;
};

}  // namespace remapc
