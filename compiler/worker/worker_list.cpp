#include "worker/worker_list.hpp"

#include <map>

#include "remap/error.hpp"
#include "system/files.hpp"
#include "text/json_field.hpp"
#include "worker/folders.hpp"

namespace remapc {
namespace {

namespace fs = std::filesystem;
using remap::Error;
using remap::ErrorKind;
using remap::Field;

bool is_name(const std::string& name) {
  return !name.empty() && name.find_first_of("/ \t") == std::string::npos;
}

WorkerEntry read_entry(const Field& field, const fs::path& folder) {
  WorkerEntry entry{field["name"].text(), field["command"].text(), folder.string(), ""};
  field["name"].require(is_name(entry.name), "a name without / and spaces");
  field["command"].require(!entry.command.empty(), "a command");
  if (field.json().contains("install")) entry.install = field["install"].text();
  return entry;
}

}  // namespace

std::vector<WorkerEntry> read_worker_list(const fs::path& path) {
  const auto json = remap::parse_json(remap::read_file(path), path.string());
  const fs::path folder = fs::absolute(path).parent_path();
  return Field(json, path.string())["workers"].list(
      0, [&](const Field& field) { return read_entry(field, folder); });
}

WorkerEntry parse_worker(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || !is_name(text.substr(0, equals)) || equals + 1 == text.size())
    throw Error(ErrorKind::kUsage, "--worker " + text + ": cannot be read as NAME=COMMAND");
  return {text.substr(0, equals), text.substr(equals + 1), fs::current_path().string(), ""};
}

std::vector<WorkerEntry> known_workers(const std::vector<std::string>& given) {
  std::map<std::string, WorkerEntry> entries;
  for (const std::string& text : given) {
    WorkerEntry entry = parse_worker(text);
    if (!entries.emplace(entry.name, entry).second)
      throw Error(ErrorKind::kUsage, "--worker " + text + ": " + entry.name + " was given twice");
  }
  for (const fs::path& list : {own_worker_list(), shipped_worker_list()}) {
    if (!fs::exists(list)) continue;
    for (WorkerEntry& entry : read_worker_list(list)) entries.emplace(entry.name, entry);
  }
  std::vector<WorkerEntry> workers;
  for (auto& [name, entry] : entries) workers.push_back(std::move(entry));
  return workers;
}

}  // namespace remapc
