// This file builds what a manifest describes: tables, fits, headers, the data of all converters and the
// report. It makes only what is missing or out of date.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "build/freshness.hpp"
#include "build/manifest.hpp"
#include "lower/fit.hpp"
#include "remap/error.hpp"
#include "renderer/renderer.hpp"

namespace remap {

// A BuildExecution decides how a build runs. None of this changes its results.
struct BuildExecution {
  unsigned jobs = 0;                                                // items at once; 0: one for each core
  bool force = false;                                               // remakes everything
  bool prune = false;                                               // deletes files of vanished items
  std::function<void(std::size_t done, std::size_t all)> progress;  // called from any thread
  const std::atomic<bool>* cancelled = nullptr;  // throws kInterrupted; finished items stay
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
  std::string kept_table;  // why the table of an earlier build was reused; empty if it was up to date or made
};

struct FailedItem {
  std::string id, why;
  ErrorKind kind = ErrorKind::kInput;
};

struct BuildResult {
  std::vector<BuiltItem> built;     // sorted by id
  std::vector<FailedItem> failed;   // sorted by id
  std::vector<std::string> pruned;  // ids of items no longer in the manifest whose files were deleted
};

// Makes every item of `manifest` whose recipe, inputs or files changed since the last build. It then writes
// the data of all converters of the folder, and the report. One thread sweeps and fits each item. If an item
// fails, the other items are still made, but the data of converters and the report are not. Finished items
// stay. If a renderer is not installed, even `force` reuses a table made by the same recipe. Without such a
// table, the item fails. Pruning deletes only files that nobody changed after the build.
BuildResult build(const Renderer& renderer, const Manifest& manifest, const BuildFolders& folders,
                  const BuildExecution& execution);

// Returns compose() of lower/chain.hpp with the SHA-256 of every step's fit in the comments.
Fit composed_fit(const std::vector<Fit>& steps, const std::string& id);

// Returns the items of earlier builds that are no longer in the manifest and whose fits still exist, by id.
std::vector<std::string> vanished_items(const Manifest& manifest, const BuildFolders& folders);

// Returns a line for each item that build() would make, with the reason. It also lists vanished items, and
// fits whose table was changed after the fit. It is empty if everything is up to date.
std::vector<std::string> stale(const Manifest& manifest, const BuildFolders& folders);

}  // namespace remap
