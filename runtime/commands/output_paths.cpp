#include "commands/output_paths.hpp"

#include <algorithm>
#include <array>
#include <system_error>
#include <variant>

#include "error.hpp"
#include "files.hpp"
#include "nearest_name.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

void require_known_extension(const std::string& extension) {
  static const std::array<std::string, 8> kExtensions = {"exr", "tif",  "tiff", "png",
                                                         "jpg", "jpeg", "tga",  "bmp"};
  if (std::find(kExtensions.begin(), kExtensions.end(), extension) == kExtensions.end())
    throw Error(ErrorKind::kUsage, "--format: is " + extension + suggestion(extension, kExtensions));
}

fs::path result_path(fs::path name, const OutputChoice& choice) {
  if (!choice.extension.empty()) name.replace_extension(choice.extension);
  return choice.folder / name;
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  if (fs::equivalent(a, b, ignored)) return true;
  const fs::path canonical_a = fs::weakly_canonical(a, ignored),
                 canonical_b = fs::weakly_canonical(b, ignored);
  return !canonical_a.empty() && canonical_a == canonical_b;
}

void require_safe(const fs::path& output, const fs::path& input) {
  if (same_file(output, input))
    throw Error(ErrorKind::kUsage,
                output.string() + ": is the input " + input.string() + "; expected another folder");
}

void require_free(const fs::path& output, bool force) {
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(output, ignored);
  if (!fs::exists(status)) return;
  if (fs::is_directory(output, ignored))
    throw Error(ErrorKind::kOutput, output.string() + ": is a folder; expected a name that is free");
  if (!force)
    throw Error(ErrorKind::kOutput, output.string() + ": exists; expected a name that is free, or --force");
}

}  // namespace

OutputPaths output_paths(const TextureSetRequest& request, const OutputChoice& choice) {
  if (!choice.extension.empty()) require_known_extension(choice.extension);
  std::error_code ignored;
  if (fs::exists(choice.folder, ignored) && !fs::is_directory(choice.folder, ignored))
    throw Error(ErrorKind::kOutput, choice.folder.string() + ": is a file; expected a folder");
  const auto* specular = std::get_if<fs::path>(&request.specular);
  const fs::path specular_name = specular != nullptr
                                     ? specular->filename()
                                     : fs::path("specular").replace_extension(request.roughness.extension());
  const OutputPaths paths{result_path(request.roughness.filename(), choice),
                          result_path(specular_name, choice)};
  if (paths.roughness == paths.specular)
    throw Error(ErrorKind::kUsage, paths.roughness.string() +
                                       ": would be the name of both results; expected inputs with two names");
  for (const fs::path& output : {paths.roughness, paths.specular}) {
    require_safe(output, request.roughness);
    if (specular != nullptr) require_safe(output, *specular);
    require_free(output, choice.force);
  }
  return paths;
}

void create_output_folder(const fs::path& folder) { create_parent(folder / "any file"); }

}  // namespace remap
