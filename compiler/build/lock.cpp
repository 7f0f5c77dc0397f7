#include "build/lock.hpp"

#include "core/files.hpp"
#include "core/json_field.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

constexpr int kLockVersion = 1;

LockedItem read_item(const Field& field) {
  return {field["recipe"].text(), field["table"].text(), field["fit"].text(), field["header"].text()};
}

}  // namespace

Lock load_lock(const std::filesystem::path& fit_folder) {
  const std::filesystem::path path = fit_folder / kLockName;
  if (!std::filesystem::exists(path)) return {};
  try {
    const Json json = parse_json(read_file(path), path.string());
    const Field root(json, path.string());
    if (root["version"].count() != kLockVersion) return {};
    Lock lock;
    lock.items = root["items"].dictionary<LockedItem>(read_item);
    if (root.contains("report")) lock.report = root["report"].text();
    return lock;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    return {};
  }
}

void save_lock(const std::filesystem::path& fit_folder, const Lock& lock) {
  Json items = Json::object();
  for (const auto& [id, item] : lock.items)
    items[id] = {{"recipe", item.recipe}, {"table", item.table}, {"fit", item.fit}, {"header", item.header}};
  const Json json = {
      {"format", "remap-lock"}, {"version", kLockVersion}, {"report", lock.report}, {"items", items}};
  write_file(fit_folder / kLockName, json.dump(1) + "\n");
}

}  // namespace remap
