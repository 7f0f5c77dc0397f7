// This target reads manifests of texremap, of sets and of assets. It makes files of the names in the
// manifest, writes the manifest again, and reads it once more.
#include <cstdlib>
#include <unistd.h>

#include "core/files.hpp"
#include "fuzz/fuzz.hpp"
#include "fuzz/fuzz_file.hpp"
#include "texremap/plan/manifest.hpp"

namespace fs = std::filesystem;

namespace {

void write_again(const fs::path& file) {
  static const fs::path root = "/dev/shm/remap-fuzz-listing-" + std::to_string(::getpid());
  constexpr std::size_t kMostFiles = 16;
  fs::remove_all(root);
  remap::TreeManifest read = remap::read_manifest(file, {1, 1});
  const auto place_of = [](const fs::path& name) { return (root / "tree" / name).lexically_normal(); };
  const auto placed = [&](const remap::ListedSizes& sizes) {
    remap::ListedSizes all;
    for (const auto& [name, size] : sizes) all[place_of(name)] = size;
    return all;
  };
  const remap::ListedSizes sizes = placed(read.found.sizes);
  for (const auto& [name, size] : sizes)
    // the name leads out of the tree
    if (name.lexically_relative(root / "tree").string().starts_with("..")) std::abort();
  if (sizes.size() > kMostFiles) return;                            // making them all would take too long
  remap::read_or_refuse([&] { remap::require_as_listed(sizes); });  // none of the files exists yet
  for (const auto& [name, size] : sizes) remap::write_file(name, "x", remap::Flush::kNo);
  remap::read_or_refuse([&] { remap::require_as_listed(sizes); });
  const std::size_t problems = read.found.problems.size();
  const remap::ManifestHead head = remap::write_manifest(root / "m.jsonl", root / "tree", "", read);
  const remap::TreeManifest again = remap::read_manifest(root / "m.jsonl", {1, 1});
  if (again.costs.size() != head.count || again.found.problems.size() < problems) std::abort();
  remap::require_as_listed(placed(again.found.sizes));
  fs::remove_all(root);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fs::path file = remap::fuzz_file(data, size);
  return remap::read_or_refuse([&] {
    remap::read_manifest(file, {1, 2});
    write_again(file);
  });
}
