// This file fits a table. It splits the rows, fits them, computes errors on the held-out rows, and records
// how the fit was made.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fit/comparison.hpp"
#include "fit/kinds.hpp"
#include "lower/fit.hpp"
#include "table/table.hpp"

namespace remap {

// Fits `table`. `bytes` is its file, whose SHA-256 the fit records. Throws kInput if the table does not name
// its models or cannot be fitted (require_fittable), kUsage for an invalid id, and the errors of the
// regression. The result does not depend on the number of jobs. If forms are compared, `compared` receives
// their fits (compare_forms).
Fit fit_table(const Table& table, std::string_view bytes, const FitOptions& options,
              const FitProgress& progress = {}, std::vector<Fit>* compared = nullptr);

}  // namespace remap
