#include "sets/folder_walk.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <set>
#include <string_view>
#include <system_error>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"
#include "core/system.hpp"
#include "sets/naming.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::string_view, 11> kExtensions = {"exr", "tif", "tiff", "png", "jpg", "jpeg",
                                                          "tga", "bmp", "hdr",  "tx",  "webp"};

// Returns the extension without the dot, in lower case, or an empty text.
std::string extension_of(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos || dot == 0 ? "" : lower(name.substr(dot + 1));
}

class Walker {
 public:
  Walker(const fs::path& root, const WalkOptions& options)
      : root_(root), recursive_(options.recursive), also_(options.also) {
    for (const fs::path& folder : options.excluded)
      if (const auto found = facts_of(folder)) visited_.insert(found->identity);
    // The root is searched even if it is also the folder for results.
    if (const auto found = facts_of(root)) visited_.erase(found->identity);
  }

  Walk run() {
    visit(fs::path());
    if (!walk_.problems.empty() && !root_was_read_) throw input_error(walk_.problems.front().message);
    // Links come last, so that a folder below the root is found under its own name.
    while (!folders_.empty() || !links_.empty()) {
      std::set<std::string>& next = folders_.empty() ? links_ : folders_;
      const fs::path folder = *next.begin();
      next.erase(next.begin());
      visit(folder);
    }
    return std::move(walk_);
  }

 private:
  void visit(const fs::path& relative) {
    const fs::path folder = relative.empty() ? root_ : root_ / relative;
    const std::optional<FileFacts> found = facts_of(folder);
    if (!found) {
      add_problem(relative, std::generic_category().message(errno));
      return;
    }
    if (found->type != fs::file_type::directory) {
      add_problem(relative, "not a folder");
      return;
    }
    if (!visited_.insert(found->identity).second) return;

    std::vector<std::string> images;
    std::error_code failure;
    for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
         entry.increment(failure))
      add_entry(*entry, relative, images);
    if (failure)
      add_problem(relative, failure.message());
    else
      root_was_read_ = true;
    if (images.empty()) return;
    std::ranges::sort(images);
    walk_.images.emplace(relative, std::move(images));
  }

  void add_entry(const fs::directory_entry& entry, const fs::path& folder, std::vector<std::string>& images) {
    const std::string name = entry.path().filename().string();
    if (name.front() == '.') return;
    const fs::path relative = folder / name;
    std::error_code failure;
    const bool link = entry.is_symlink(failure);
    const fs::file_status status = entry.status(failure);
    if (fs::is_directory(status)) {
      if (recursive_) (link ? links_ : folders_).insert(relative.string());
    } else if (const std::string extension = extension_of(name);
               contains(kExtensions, extension) || contains(also_, extension)) {
      if (fs::is_regular_file(status) && contains(kExtensions, extension))
        images.push_back(name);
      else if (fs::is_regular_file(status))
        walk_.others.push_back(relative);
      else if (failure || !fs::exists(status))
        add_problem(relative, failure ? failure.message() : "the link has no target");
      else
        add_problem(relative, "not a file");
    }
  }

  void add_problem(const fs::path& relative, const std::string& reason) {
    const fs::path place = relative.empty() ? root_ : root_ / relative;
    walk_.problems.push_back({relative, display_path(place) + ": cannot be read: " + reason});
  }

  fs::path root_;
  bool recursive_ = true;
  const std::vector<std::string>& also_;
  bool root_was_read_ = false;
  std::set<decltype(FileFacts::identity)> visited_;
  std::set<std::string> folders_;  // not yet visited
  std::set<std::string> links_;
  Walk walk_;
};

}  // namespace

std::string display_path(const std::filesystem::path& path) {
  return plain(path.string(), std::numeric_limits<std::size_t>::max());
}

Walk walk_images(const fs::path& root, const WalkOptions& options) { return Walker(root, options).run(); }

}  // namespace remap
