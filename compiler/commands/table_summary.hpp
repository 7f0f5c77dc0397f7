// What sweep and sample say of the table that they have made.
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
  // A row; `error` is its image error, relative RMS.
  void add(RowStatus status, double error);

  // Rows, rows by status, error, pictures and `seconds`, appended to `json`.
  void append_to(nlohmann::ordered_json* json, const PictureCount& pictures, double seconds) const;
  // The same as one line without its end.
  std::string text(const PictureCount& pictures, double seconds) const;

 private:
  double rms_error() const;

  std::size_t rows_ = 0;
  double square_ = 0.0;  // of errors, summed
  std::map<std::string, std::size_t> statuses_;
};

}  // namespace remapc
