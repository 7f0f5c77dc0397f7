#include "manifest/lock.hpp"

#include "remap/error.hpp"
#include "system/files.hpp"
#include "text/json_field.hpp"

namespace remapc {
namespace {

constexpr int kLockVersion = 1;

LockedItem read_item(const remap::Field& field) {
  return {field["recipe"].text(), field["table"].text(), field["fit"].text(), field["header"].text()};
}

}  // namespace

Lock load_lock(const std::filesystem::path& fit_folder) {
  const std::filesystem::path path = fit_folder / kLockName;
  if (!std::filesystem::exists(path)) return {};
  try {
    const remap::Json json = remap::parse_json(remap::read_file(path), path.string());
    const remap::Field root(json, path.string());
    if (root["version"].count() != kLockVersion) return {};
    Lock lock;
    lock.items = root["items"].dictionary<LockedItem>(read_item);
    if (root.contains("report")) lock.report = root["report"].text();
    return lock;
  } catch (const remap::Error& error) {
    if (error.kind() != remap::ErrorKind::kInput) throw;
    return {};
  }
}

void save_lock(const std::filesystem::path& fit_folder, const Lock& lock) {
  remap::Json items = remap::Json::object();
  for (const auto& [id, item] : lock.items)
    items[id] = {{"recipe", item.recipe}, {"table", item.table}, {"fit", item.fit}, {"header", item.header}};
  const remap::Json json = {
      {"format", "remap-lock"}, {"version", kLockVersion}, {"report", lock.report}, {"items", items}};
  remap::write_file(fit_folder / kLockName, json.dump(1) + "\n");
}

}  // namespace remapc
