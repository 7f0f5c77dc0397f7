// From a manifest to tables, fits, headers, the data of all converters and the report: only what is not there yet.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "build/manifest.hpp"
#include "lower/lower.hpp"
#include "sweep/renderer.hpp"

namespace remapc {

struct BuildFolders {
  std::filesystem::path fits = "fits";  // fits, with tables/ in it; the report is its README.md
  std::filesystem::path generated = "generated";
};

// How a build is carried out. Nothing of it changes what is made.
struct BuildExecution {
  unsigned jobs = 0;                                                // items at once; 0: one a core
  bool force = false;                                               // makes everything anew
  bool prune = false;                                               // removes what vanished items left
  std::function<void(std::size_t done, std::size_t all)> progress;  // called from any thread
  const std::atomic<bool>* cancelled = nullptr;                     // throws kInterrupted; what is made stays
};

// What was made of one item.
struct BuiltItem {
  std::string id;
  bool table = false, fit = false, header = false;
  double seconds = 0.0;
  std::string kept_table;  // why the table is that of an earlier build; empty where that needs no reason
};

struct BuildResult {
  std::vector<BuiltItem> built;     // by id
  std::vector<std::string> pruned;  // ids of items that the manifest no longer has, whose files were removed
};

// Makes every item of `manifest` whose recipe changed, whose inputs changed, or whose files are not those
// that the last build left; then the data of all converters of the folder, and the report. Items are
// independent of each other but for their inputs: each is swept and fitted by one thread. Throws what
// sweeping, fitting and lowering throw, opened by the item's id; what other items made stays. Where a
// renderer is not here, even `force` keeps a table that was made by the same recipe; without one it is an
// error. Pruning removes only files that are as a build left them.
BuildResult build(const Renderer& renderer, const Manifest& manifest, const BuildFolders& folders,
                  const BuildExecution& execution);

// compose() of model/chain.hpp, with the SHA-256 of every step's fit among the comments.
remap::Fit composed_fit(const std::vector<remap::Fit>& steps, const std::string& id);

// Items of earlier builds that the manifest no longer has, and whose fits are still there. By id.
std::vector<std::string> vanished_items(const Manifest& manifest, const BuildFolders& folders);

// What build() would make anew, and why, a line each; empty: nothing. Also vanished items, and fits whose
// table is another one than it was fitted to.
std::vector<std::string> stale(const Manifest& manifest, const BuildFolders& folders);

}  // namespace remapc
