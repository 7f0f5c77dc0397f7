#include "build/fit_folder.hpp"

#include <algorithm>

#include "build/manifest.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/nearest_name.hpp"
#include "lower/fit_file.hpp"

namespace remap {

void FitFolder::add(AnyFit fit) {
  if (auto* workflow = std::get_if<WorkflowFit>(&fit))
    workflows.push_back(std::move(*workflow));
  else if (auto* warp = std::get_if<WarpMapFit>(&fit))
    warps.push_back(std::move(*warp));
  else
    fits.push_back(std::move(std::get<Fit>(fit)));
}

namespace {

// A folder called `fits` is used only if it contains a fit.
bool holds_fits(const std::filesystem::path& folder) {
  std::error_code failure;
  const std::filesystem::directory_iterator entries(folder, failure);
  return !failure && std::any_of(begin(entries), end(entries),
                                 [](const auto& entry) { return entry.path().extension() == ".json"; });
}

// Returns what is wrong with a folder that does not exist. Nobody typed the default, so its message must
// explain more.
std::string missing_text(const std::filesystem::path& folder) {
  if (folder != default_fit_folder()) return "not a folder (give a folder with fits, *.json)";
  return "this folder does not exist here (run remapc in your clone of remap, or add --fits CLONE/fits)";
}

}  // namespace

std::filesystem::path default_fit_folder() {
  const std::filesystem::path own = "fits";
  const std::filesystem::path shipped = holds_fits(own) ? own : installed(REMAP_INSTALLED_FITS);
  return shipped.empty() ? own : shipped;
}

FitFolder load_fit_folder(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder))
    throw input_error(folder.string() + ": " + missing_text(folder));
  FitFolder loaded;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".json" || entry.path().filename() == kManifestName ||
        entry.path().stem().extension() == ".csv")
      continue;
    AnyFit fit = load_any_fit(entry.path());
    if (entry.path().stem() != fit_id(fit))
      throw input_error(entry.path().string() + ": contains the fit " + fit_id(fit) +
                        " (rename the file to " + fit_id(fit) + ".json)");
    loaded.add(std::move(fit));
  }
  const auto by_id = [](const auto& a, const auto& b) { return a.id < b.id; };
  std::sort(loaded.fits.begin(), loaded.fits.end(), by_id);
  std::sort(loaded.warps.begin(), loaded.warps.end(), by_id);
  std::sort(loaded.workflows.begin(), loaded.workflows.end(), by_id);
  loaded.reach = current_reach(folder);
  return loaded;
}

std::vector<Fit> load_fits(const std::filesystem::path& folder) { return load_fit_folder(folder).fits; }

AnyFit find_any_fit(const std::string& name, const std::filesystem::path& folder) {
  if (std::filesystem::is_regular_file(name)) return load_any_fit(name);
  if (const auto path = folder / (name + ".json"); std::filesystem::is_regular_file(path))
    return load_any_fit(path);
  if (!std::filesystem::is_directory(folder) && folder == default_fit_folder())
    throw usage_error(
        name + ": is not a file, and the folder " + folder.string() +
        ", where remapc looks for fits, does not exist here (run remapc in your clone of remap, "
        "or add --fits CLONE/fits)");
  std::vector<std::string> known;
  if (std::filesystem::is_directory(folder)) {
    const FitFolder loaded = load_fit_folder(folder);
    for (const Fit& fit : loaded.fits) known.push_back(fit.id);
    for (const WorkflowFit& fit : loaded.workflows) known.push_back(fit.id);
    for (const WarpMapFit& fit : loaded.warps) known.push_back(fit.id);
  }
  throw usage_error(name + ": is not a file, and not a fit in " + folder.string() + suggestion(name, known));
}

Fit find_fit(const std::string& name, const std::filesystem::path& folder) {
  return require_width_and_specular(find_any_fit(name, folder), ErrorKind::kUsage, name);
}

}  // namespace remap
