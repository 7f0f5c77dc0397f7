// This file is `texremap index`. It lists the texture sets of a tree, or its assets, in a manifest. Many
// processes can then share one conversion.
#include <iostream>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "core/number_text.hpp"
#include "core/system.hpp"
#include "texremap/commands/commands.hpp"
#include "texremap/plan/job.hpp"
#include "texremap/plan/manifest.hpp"
#include "texture/content_hash.hpp"

namespace remap {
namespace {

struct IndexOptions {
  std::filesystem::path folder, output;
  std::string names, format;
  bool assets = false, force = false, json = false, quiet = false;
};

TreeManifest tree_of_sets(const IndexOptions& options) {
  const Naming naming = options.names.empty() ? built_in_naming() : read_naming(options.names);
  TreeManifest tree;
  tree.found = find_sets(options.folder, {}, naming);
  // Refuses the second of two sets whose names differ only in case, because parts would write the same file.
  WrittenNames names;
  std::erase_if(tree.found.sets, [&](const FoundSet& set) {
    const std::filesystem::path place = options.folder / set.folder / set.name;
    const std::string other = names.take(place, display_path(options.folder / set.maps.front().path));
    if (!other.empty())
      tree.found.problems.push_back(
          {set.folder / set.name, display_path(options.folder / set.maps.front().path) +
                                      ": belongs to a set with the same name as the set of " + other +
                                      " (rename one of the sets; A and a are the same letter here)"});
    return !other.empty();
  });
  if (tree.found.sets.empty() && tree.found.problems.empty())
    throw usage_error(options.folder.string() +
                      ": no texture set found by file names (use --names FILE for other names, or --assets "
                      "for glTF and MTL files)");
  return tree;
}

void index(const IndexOptions& options) {
  const Stopwatch stopwatch;
  require_new(options.output, options.force);
  TreeManifest tree = options.assets ? tree_of_assets(options.folder, options.format) : tree_of_sets(options);
  const std::size_t unrecognised = tree.found.unrecognised.size();
  if (!options.quiet)
    for (const WalkProblem& problem : tree.found.problems) say("failed: " + problem.message);
  const ManifestHead head =
      write_manifest(options.output, options.folder, options.names.empty() ? "" : hash_of_file(options.names),
                     std::move(tree));
  if (options.json) {
    Json json = {{"manifest", options.output.string()},
                 {std::string(name_of(kListedKinds, head.kind)), head.count},
                 {"files", head.file_count},
                 {"bytes", head.bytes},
                 {"cost", head.cost}};
    if (head.kind == ListedKind::kSets) json["unrecognised_images"] = unrecognised;
    json["hash"] = head.hash;
    json["seconds"] = stopwatch.seconds();
    std::cout << json.dump(2) << '\n';
  }
  if (options.quiet) return;
  if (unrecognised > 0)
    say(counted(unrecognised, "image") +
        " skipped, because no naming convention fits (--names FILE adds one)");
  say(counted(head.count, noun_of(head.kind)) + " of " + counted(head.file_count, "file") + ", " +
      fixed(static_cast<double>(head.bytes) * 1e-9, 2) + " GB, in " + fixed(stopwatch.seconds(), 1) + " s");
}

}  // namespace

void add_index_command(Command& app) {
  Command* command =
      app.add_subcommand("index", "List the texture sets or assets of a folder, for conversions in parts");
  IndexOptions& options = set_work<IndexOptions>(*command, index);
  command->add_option("DIR", options.folder, "Folder of texture sets or assets, with its subfolders")
      ->required();
  command
      ->add_option("-o,--output FILE", options.output,
                   "Manifest to write: JSON, one line for each set or asset")
      ->required();
  Option* assets = command->add_flag(
      "--assets", options.assets,
      "List the glTF and MTL files in DIR (with --format, its OBJ files) instead of its texture sets");
  command->add_option("--format EXT", options.format, "Format that OBJ files are converted to: glb or gltf")
      ->needs(assets);
  command->add_option("--names FILE", options.names, "More naming conventions (JSON)")->excludes(assets);
  command->add_flag("--force", options.force, "Overwrite an existing manifest");
  command->add_flag("--json", options.json, "Print what was found as JSON");
  command->add_flag("--quiet", options.quiet, "Print nothing but errors to standard error");
  command->footer(
      "Example:\n"
      "  texremap index assets -o sets\n"
      "  texremap convert --manifest sets --part 1/4 --from unity --to gltf -o out\n"
      "  texremap merge-reports out");
}

}  // namespace remap
