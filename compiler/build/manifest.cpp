#include "build/manifest.hpp"

#include <algorithm>
#include <string_view>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json_field.hpp"
#include "core/plain_text.hpp"
#include "lower/fit_fields.hpp"
#include "remap/version.hpp"

namespace remap {
namespace {

std::string read_text(const Field& field) { return field.text(); }

std::size_t read_count(const Field& field) {
  field.require(field.count() >= 2 && field.count() <= 1000, "a number from 2 to 1000");
  return static_cast<std::size_t>(field.count());
}

constexpr std::int64_t kLargestResolution = 8192;   // pictures of 268 MB
constexpr std::int64_t kMostMaterials = 1'000'000;  // the limit of remapc sample
// These limit the models of a group, which become pairs, and all items, which become files.
constexpr std::size_t kMostModels = 100, kMostItems = 10'000;

int read_resolution(const Field& field) {
  field.require(field.count() >= 1 && field.count() <= kLargestResolution,
                "a number from 1 to " + std::to_string(kLargestResolution));
  return static_cast<int>(field.count());
}

// Returns the ordered pairs of a group. These are all pairs of its `models`, or its `pairs`, in both
// directions if it is not `one_way`.
std::vector<std::pair<std::string, std::string>> read_pairs(const Field& group) {
  std::vector<std::pair<std::string, std::string>> pairs;
  if (group.contains("pairs")) {
    const bool is_one_way = group.flag("one_way");
    group["pairs"].list(1, [&](const Field& entry) {
      const std::vector<std::string> models = entry.list(2, read_text);
      entry.require(models.size() == 2, "two models");
      pairs.emplace_back(models[0], models[1]);
      if (!is_one_way) pairs.emplace_back(models[1], models[0]);
      return 0;
    });
    return pairs;
  }
  const std::vector<std::string> models = group["models"].list(2, read_text, kMostModels);
  for (const std::string& source : models)
    for (const std::string& target : models)
      if (source != target) pairs.emplace_back(source, target);
  return pairs;
}

void read_sweeps(const Field& group, std::vector<ManifestItem>* items) {
  SweptItem item;
  item.objective = recorded_objective(group["objective"].text());
  item.resolution = read_resolution(group["resolution"]);
  item.alphas = read_range(group["alpha"]);
  item.roughness_samples = read_count(group["roughness_samples"]);
  item.specular_samples = read_count(group["specular_samples"]);
  if (group.contains("speculars")) item.speculars = group["speculars"].dictionary<Range>(read_range);
  const auto seed = static_cast<std::uint64_t>(group["seed"].count());
  for (const auto& [source, target] : read_pairs(group)) {
    Json text = group.json();
    text.erase("pairs");
    text.erase("one_way");
    text["models"] = {source, target};
    if (text.contains("speculars"))  // only the range of this source matters
      text["speculars"] = group["speculars"].contains(source) ? group["speculars"][source].json() : Json();
    item.source = source;
    item.target = target;
    items->push_back({converter_id(source, target), item, text.dump(), seed});
  }
}

// Reads coefficients as printed in the paper (Sztrajman et al. 2019, section 7 and appendix A):
// c0 + c1 exp(-c2 alpha) + c3 exp(-c4 alpha^2) + c5 / alpha.
AlphaCurve read_slope(const Field& field) {
  const double c1 = field["c1"].number(), c2 = field["c2"].number();
  const double c3 = field["c3"].number(), c4 = field["c4"].number();
  field.require(c2 >= 0.0 && c4 >= 0.0, "rates c2 and c4 from 0");
  return {field["c0"].number() + c1 + c3, -c1 * c2, c2, -c3 * c4, c4, field["c5"].number()};
}

void read_published(const Field& field, std::vector<ManifestItem>* items) {
  Fit fit;
  fit.id = field["id"].text();
  fit.source = read_side(field["source"]);
  fit.target = read_side(field["target"]);
  fit.domain = {read_range(field["domain"]["alpha"]), read_range(field["domain"]["specular"])};
  fit.mapping = Parametric{{field["roughness"].numbers(1)}, {{1, read_slope(field["slope"])}}};
  fit.method["form"] = "paper";
  fit.method["source"] = field["from"].text();
  fit.remarks = field["remarks"].list(0, read_text);
  fit.remarks.insert(fit.remarks.begin(), "Published in " + fit.method["source"] + ".");
  fit.tool_version = kVersion;
  items->push_back({fit.id, AnyFit(fit), field.json().dump(), 0});
}

void read_workflow_item(const Field& field, std::vector<ManifestItem>* items) {
  WorkflowFit fit{field["id"].text(), read_conversion(field), std::nullopt,
                  field["remarks"].list(0, read_text), kVersion};
  items->push_back({fit.id, AnyFit(fit), field.json().dump(), 0});
}

void read_network_item(const Field& field, std::vector<ManifestItem>* items) {
  NetworkItem item;
  item.fit.id = field["id"].text();
  item.fit.conversion.specular = read_specular_workflow(field["source"]);
  item.fit.conversion.metallic = read_metallic_workflow(field["target"]);
  item.fit.remarks = field["remarks"].list(0, read_text);
  item.fit.tool_version = kVersion;
  const Field samples = field["samples"];
  item.metallic = samples["metallic"].text();
  item.specular = samples["specular"].text();
  item.fixed = samples["fixed"].dictionary<double>([](const Field& value) { return value.number(); });
  item.varied = samples["vary"].list(0, read_text);
  samples["count"].require(samples["count"].count() <= kMostMaterials,
                           "at most " + std::to_string(kMostMaterials));
  item.count = static_cast<std::size_t>(samples["count"].count());
  item.resolution = read_resolution(samples["resolution"]);
  item.hidden =
      field["hidden"].list(0, [](const Field& units) { return static_cast<std::size_t>(units.count()); });
  item.activation = field["activation"].named(kActivations, "relu, tanh or silu");
  items->push_back(
      {item.fit.id, item, field.json().dump(), static_cast<std::uint64_t>(field["seed"].count())});
}

std::string read_id(const Field& field, const std::vector<ManifestItem>& items) {
  std::vector<std::string> known;
  for (const ManifestItem& item : items) known.push_back(item.id);
  const std::string id = field.text();
  if (std::ranges::find(known, id) == known.end())
    field.fail("no item before this one has the id " + id + suggestion(id, known));
  return id;
}

// Reads the items whose diffuse lobes differ on purpose.
void read_accepted(const Field& list, std::vector<ManifestItem>* items) {
  list.list(0, [&](const Field& entry) {
    const std::string id = read_id(entry["id"], *items);
    entry["reason"].require(!entry["reason"].text().empty(), "a reason");
    std::ranges::find(*items, id, &ManifestItem::id)->accept_light = true;
    return 0;
  });
}

void require_unique(const std::vector<ManifestItem>& items, const std::string& context) {
  std::vector<std::string> ids;
  for (const ManifestItem& item : items) ids.push_back(item.id);
  std::ranges::sort(ids);
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end())
    throw input_error(context + ": " + *twice + " is defined twice (remove one definition)");
  for (const std::string& id : ids)
    if (!is_valid_id(id))
      throw input_error(context + ": id \"" + id + "\" is not valid (use " + kIdRule + ")");
}

}  // namespace

Manifest manifest_from_json(std::string_view text, const std::string& context) {
  const Json json = parse_json(text, context);
  const Field root(json, context);
  root["format"].require(root["format"].text() == "remap-manifest", "\"remap-manifest\"");
  root["version"].require(root["version"].count() == kManifestVersion,
                          "version " + std::to_string(kManifestVersion));
  Manifest items;
  const auto each = [&](const std::string& key, const auto& read) {
    root[key].list(0, [&](const Field& entry) {
      read(entry);
      if (items.size() > kMostItems)
        root.fail("has more than " + std::to_string(kMostItems) + " items, which is the limit");
      return 0;
    });
  };
  each("published", [&](const Field& entry) { read_published(entry, &items); });
  each("sweeps", [&](const Field& entry) { read_sweeps(entry, &items); });
  each("inverses", [&](const Field& entry) {
    const std::string of = read_id(entry["of"], items);
    items.push_back({entry["id"].text(), DerivedItem{{of}}, entry.json().dump(),
                     static_cast<std::uint64_t>(entry["seed"].count())});
  });
  each("chains", [&](const Field& entry) {
    DerivedItem chain{entry["steps"].list(2, [&](const Field& step) { return read_id(step, items); })};
    items.push_back({entry["id"].text(), chain, entry.json().dump(), 0});
  });
  // Manifests of earlier versions do not have these sections.
  if (json.contains("workflows"))
    each("workflows", [&](const Field& entry) { read_workflow_item(entry, &items); });
  if (json.contains("networks"))
    each("networks", [&](const Field& entry) { read_network_item(entry, &items); });
  if (json.contains("accepted_light")) read_accepted(root["accepted_light"], &items);
  require_unique(items, context);
  return items;
}

Manifest load_manifest(const std::filesystem::path& fit_folder) {
  const std::filesystem::path path = fit_folder / kManifestName;
  return manifest_from_json(read_file(path), path.string());
}

std::vector<std::string> inputs_of(const ManifestItem& item) {
  const auto* derived = std::get_if<DerivedItem>(&item.kind);
  return derived == nullptr ? std::vector<std::string>{} : derived->inputs;
}

}  // namespace remap
