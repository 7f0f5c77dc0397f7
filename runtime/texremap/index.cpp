// `texremap index`: lists the texture sets of a tree in a manifest, by which many processes share one
// conversion.
#include <iostream>

#include "command_line/run_app.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "core/number_text.hpp"
#include "core/report_text.hpp"
#include "core/stopwatch.hpp"
#include "texremap/commands.hpp"
#include "texremap/manifest.hpp"
#include "texture/content_hash.hpp"

namespace remap {
namespace {

struct IndexOptions {
  std::filesystem::path folder, output;
  std::string names;
  bool force = false, json = false, quiet = false;
};

void index(const IndexOptions& options) {
  const Stopwatch stopwatch;
  require_new(options.output, options.force);
  const Naming naming = options.names.empty() ? built_in_naming() : read_naming(options.names);
  DiscoveryOptions discovery;
  discovery.naming = &naming;
  Discovery found = find_sets(options.folder, discovery);
  if (found.sets.empty() && found.problems.empty())
    throw usage_error(options.folder.string() +
                      ": no texture set found by file names (use --names FILE for other names)");
  const std::size_t unrecognised = found.unrecognised.size();
  if (!options.quiet)
    for (const WalkProblem& problem : found.problems) print_message(kProgram, "failed: " + problem.message);
  const ManifestHead head =
      write_manifest(options.output, options.folder, options.names.empty() ? "" : hash_of_file(options.names),
                     std::move(found));
  if (options.json)
    std::cout << Json({{"manifest", options.output.string()},
                       {"sets", head.set_count},
                       {"files", head.file_count},
                       {"bytes", head.bytes},
                       {"cost", head.cost},
                       {"unrecognised_images", unrecognised},
                       {"hash", head.hash},
                       {"seconds", stopwatch.seconds()}})
                     .dump(2)
              << '\n';
  if (options.quiet) return;
  if (unrecognised > 0)
    print_message(kProgram, counted(unrecognised, "image") +
                                " left out, because no habit knows the name (--names FILE teaches one)");
  print_message(kProgram, counted(head.set_count, "set") + " of " + counted(head.file_count, "file") + ", " +
                              fixed(static_cast<double>(head.bytes) * 1e-9, 2) + " GB, in " +
                              fixed(stopwatch.seconds(), 1) + " s");
}

}  // namespace

void add_index_command(Command& app) {
  Command* command = app.add_subcommand("index", "List the texture sets of a tree, for conversions in parts");
  IndexOptions& options = set_work<IndexOptions>(*command, index);
  command->add_option("DIR", options.folder, "Folder of texture sets, with its subfolders")->required();
  command->add_option("-o,--output FILE", options.output, "The manifest: JSON, a set a line")->required();
  command->add_option("--names FILE", options.names, "More file-name habits (JSON)");
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
