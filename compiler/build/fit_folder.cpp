#include "build/fit_folder.hpp"

#include <algorithm>

#include "build/manifest.hpp"
#include "error.hpp"
#include "model/fit_json.hpp"
#include "nearest_name.hpp"

namespace remapc {

using remap::Error;
using remap::ErrorKind;

std::vector<remap::Fit> load_fits(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder))
    throw Error(ErrorKind::kInput, folder.string() + ": is no folder; expected one with fits (*.json)");
  std::vector<remap::Fit> fits;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".json" || entry.path().filename() == kManifestName) continue;
    fits.push_back(remap::load_fit(entry.path()));
    if (entry.path().stem() != fits.back().id)
      throw Error(ErrorKind::kInput, entry.path().string() + ": holds the fit " + fits.back().id +
                                         "; expected the file to be named after it");
  }
  std::sort(fits.begin(), fits.end(), [](const remap::Fit& a, const remap::Fit& b) { return a.id < b.id; });
  return fits;
}

remap::Fit find_fit(const std::string& name, const std::filesystem::path& folder) {
  if (std::filesystem::is_regular_file(name)) return remap::load_fit(name);
  if (const auto path = folder / (name + ".json"); std::filesystem::is_regular_file(path))
    return remap::load_fit(path);
  std::vector<std::string> known;
  if (std::filesystem::is_directory(folder))
    for (const remap::Fit& fit : load_fits(folder)) known.push_back(fit.id);
  throw Error(ErrorKind::kUsage,
              name + ": is neither a file nor a fit in " + folder.string() + remap::suggestion(name, known));
}

}  // namespace remapc
