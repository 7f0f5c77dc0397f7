// This file builds what a manifest describes: tables, fits, headers, the data of all converters, and the
// report. It makes only what is missing or out of date.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "build/freshness.hpp"
#include "build/manifest.hpp"
#include "lower/fit.hpp"
#include "measure/sweep_options.hpp"
#include "remap/error.hpp"
#include "renderer/renderer.hpp"

namespace remap {

// A BuildExecution decides how a build runs. None of this changes its results.
// `jobs` is the number of items at once. If the build is cancelled, finished items stay.
struct BuildExecution : SweepExecution {
  bool force = false;  // makes everything again
  bool prune = false;  // deletes files of vanished items
};

// A BuiltItem holds the files and times of one item. Its seconds say how long the thread of the item worked.
// They are 0 if the item was up to date.
struct BuiltItem {
  std::string id;
  bool table = false, fit = false, header = false;
  double seconds = 0.0;
  double sweep_seconds = 0.0;    // for the table, or the samples of a network; includes waiting for pictures
  double picture_seconds = 0.0;  // the part of `sweep_seconds` spent waiting for the renderer
  double fit_seconds = 0.0;
  double lowering_seconds = 0.0;  // including its proofs
  std::size_t pictures = 0;       // rendered or read from the cache
  std::string kept_table;         // why the table of an earlier build was used, although it is not up to date
};

struct BuildResult {
  std::vector<BuiltItem> built;         // sorted by id
  std::map<std::string, Error> failed;  // by id
  std::vector<std::string> pruned;      // ids of items no longer in the manifest whose files were deleted
};

// Makes every item of `manifest` whose recipe, inputs or files changed since the last build. Then writes the
// data of all converters of the folder, and the report. One thread sweeps and fits each item. If an item
// fails, the other items are still made, but not the data of converters and the report. Finished items stay.
// If a renderer is not installed, a table that was made by the same recipe is used again, even with `force`.
// If there is no such table, the item fails. Pruning deletes only files that nobody changed after the build.
BuildResult build(const Renderer& renderer, const Manifest& manifest, const BuildFolders& folders,
                  const BuildExecution& execution);

// Returns the fit that compose() of lower/chain.hpp makes. Its comments also have the SHA-256 of the fit of
// each step.
Fit composed_fit(const std::vector<Fit>& steps, const std::string& id);

// Returns the items of earlier builds that are no longer in the manifest, but whose fits still exist. Returns
// ids.
std::vector<std::string> vanished_items(const Manifest& manifest, const BuildFolders& folders);

// Returns a line for each item that build() would make, with the reason. Also lists vanished items, and fits
// whose table changed after the fit. It is empty if everything is up to date.
std::vector<std::string> stale(const Manifest& manifest, const BuildFolders& folders);

}  // namespace remap
