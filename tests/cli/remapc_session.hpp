// This file holds what the tests of remapc's command line share.
#pragma once

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "core/number_text.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace remap {

class Session : public CommandFolder {
 public:
  ProcessResult remapc(const Words& words, const ProcessLimits& limits = {}) const {
    return run(REMAPC_PROGRAM + words, limits);
  }
  // Runs remap-study.
  ProcessResult study(const Words& words) const { return run(REMAP_STUDY + words); }
  void write(const std::string& name, const std::string& content) const { write_file(path(name), content); }
  std::size_t file_count() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::recursive_directory_iterator(path("")), {}));
  }

  // Returns the command that fits a table with the fastest regression.
  Words fit(const std::string& table, const std::string& folder = "fits") const {
    return "fit " + table + " --model parametric -o " + folder;
  }

  // Returns the command of a small sweep. Fits of ward to as are compared by pictures, fits of models with an
  // index are not.
  Words sweep(const std::string& table, const std::string& source = "mitsuba/ward",
              const std::string& target = "mitsuba/as") const {
    return "sweep --source " + source + " --target " + target +
           " --resolution 64 --roughness-samples 12 --specular-samples 3 -o " + table;
  }
};

inline const std::string kEmptyManifest =
    R"({"format": "remap-manifest", "version": 1, "published": [], "sweeps": [], "inverses": [], "chains": []})";

inline const std::string kHeader = "alpha1,specular1,alpha2,specular2,error,status\n";

// Returns a table of a smooth conversion between two models, with `widths` x `speculars` rows. No renderer
// knows the models, because otherwise a fit would compare pictures, which takes nine seconds.
inline std::string made_table(int widths, int speculars) {
  std::string text = "# source: made/ward\n# target: made/as\n# target_specular: f0\n" + kHeader;
  for (int i = 0; i < widths; ++i)
    for (int j = 1; j <= speculars; ++j) {
      const double alpha = 0.05 + 0.95 * i / (widths > 1 ? widths - 1 : 1), specular = 0.9 * j / speculars;
      for (const double value : {alpha, specular, alpha * (1.0 - 0.3 * alpha),
                                 specular * (0.6 + 0.4 * std::exp(-3.0 * alpha)), 0.0})
        text += number_text(value) + ",";
      text += "ok\n";
    }
  return text;
}

inline void check_failure(const ProcessResult& result, int exit_code, const std::string& message,
                          const std::string& program = "remapc") {
  INFO(result.errors);
  CHECK(result.exit_code == exit_code);
  CHECK(result.last_error().find(message) != std::string::npos);
  CHECK(result.last_error().starts_with(program + ": "));
  CHECK(result.output.find("Segmentation") == std::string::npos);
}

}  // namespace remap
