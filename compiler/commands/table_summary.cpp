#include "commands/table_summary.hpp"

#include <cmath>

#include "commands/renderer_options.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

std::string one_decimal(double value) { return remap::number_text(std::round(10.0 * value) / 10.0); }

}  // namespace

void TableSummary::add(RowStatus status, double error) {
  ++rows_;
  ++statuses_[std::string(status_name(status))];
  square_ += error * error;
}

double TableSummary::rms_error() const { return std::sqrt(square_ / static_cast<double>(rows_)); }

void TableSummary::append_to(nlohmann::ordered_json* json, const PictureCount& pictures,
                             double seconds) const {
  (*json)["rows"] = rows_;
  (*json)["status"] = statuses_;
  (*json)["rms_image_error"] = rms_error();
  (*json)["pictures_rendered"] = pictures.rendered;
  (*json)["pictures_cached"] = pictures.cached;
  (*json)["seconds"] = seconds;
}

std::string TableSummary::text(const PictureCount& pictures, double seconds) const {
  std::string counts;
  for (const auto& [status, count] : statuses_)
    counts += (counts.empty() ? "" : ", ") + std::to_string(count) + " " + status;
  return std::to_string(rows_) + " rows (" + counts + "), image error " + one_decimal(100.0 * rms_error()) +
         " % rms" + pictures_text(pictures) + ", " + one_decimal(seconds) + " s";
}

}  // namespace remapc
