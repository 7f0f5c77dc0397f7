#include "build/fit_folder.hpp"

#include <algorithm>
#include <array>

#include "build/manifest.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/input_file.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "lower/fit_file.hpp"
#include "table/csv.hpp"
#include "table/table.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

constexpr std::array kReachColumns = {"converter",      "fit",   "materials", "mean_excess",
                                      "largest_excess", "alpha", "specular"};

}  // namespace

ReachRecords read_reach(const fs::path& folder) {
  const fs::path path = folder / kReachName;
  ReachRecords records;
  if (!fs::exists(path)) return records;
  const std::string text = read_file(path);
  const Csv csv = parse_csv(text, path.string());
  for (std::size_t c = 0; c < kReachColumns.size(); ++c)
    if (c >= csv.header.cells.size() || csv.header.cells[c].text != kReachColumns[c])
      csv.fail(csv.header.number, 1, std::string("column ") + kReachColumns[c] + " is missing");
  for (const CsvLine& line : csv.lines) {
    const auto number = [&](std::size_t c) { return csv.number(line, line.cells[c], kReachColumns[c]); };
    records[std::string(line.cells[0].text)] = {std::string(line.cells[1].text),
                                                static_cast<std::size_t>(number(2)),
                                                number(3),
                                                number(4),
                                                number(5),
                                                number(6)};
  }
  return records;
}

ReachRecords current_reach(const fs::path& folder) {
  ReachRecords records = read_reach(folder);
  std::erase_if(records, [&](const auto& entry) {
    return file_sha256(folder / (entry.first + ".json")) != entry.second.fit;
  });
  return records;
}

void write_reach(const fs::path& folder, const ReachRecords& records) {
  std::string text;
  for (const char* column : kReachColumns) text += (text.empty() ? "" : ",") + std::string(column);
  text += "\n";
  for (const auto& [id, record] : records) {
    text += id + "," + record.fit + "," + std::to_string(record.materials);
    for (const double value : {record.mean_excess, record.largest_excess, record.alpha, record.specular})
      text += "," + number_text(rounded(value, 3));
    text += "\n";
  }
  write_file(folder / kReachName, text);
}

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
  std::ranges::sort(loaded.fits, by_id);
  std::ranges::sort(loaded.warps, by_id);
  std::ranges::sort(loaded.workflows, by_id);
  loaded.reach = current_reach(folder);
  return loaded;
}

std::vector<Fit> load_fits(const std::filesystem::path& folder) { return load_fit_folder(folder).fits; }

AnyFit find_any_fit(const std::string& name, const std::filesystem::path& folder) {
  if (std::filesystem::is_regular_file(name)) return load_any_fit(name);
  if (const auto path = folder / (name + ".json"); std::filesystem::is_regular_file(path))
    return load_any_fit(path);
  if (!std::filesystem::is_directory(folder) && folder == default_fit_folder())
    throw usage_error(name + ": is not a file, and the folder " + folder.string() +
                      ", where remapc looks for fits, does not exist here (run remapc in your clone of "
                      "remap, or add --fits CLONE/fits)");
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
