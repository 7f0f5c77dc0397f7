// This file reads the manifest of a folder of fits, which describes what `remapc build` makes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lower/fit_file.hpp"
#include "measure/objective.hpp"

namespace remap {

inline constexpr const char* kManifestName = "manifest.json";
inline constexpr int kManifestVersion = 1;

// A ManifestItem is one converter. SweptItem and NetworkItem need a renderer.
struct SweptItem {  // a pair of models, built-in or of real renderers
  std::string source, target;
  Objective objective;
  int resolution = 512;
  Range alphas{0.01, 1.0};
  std::size_t roughness_samples = 30;
  std::size_t specular_samples = 30;
  std::map<std::string, Range> speculars;  // canonical, keyed by source model; if missing: whole range
};
struct DerivedItem {                // made from the fits of other items
  std::vector<std::string> inputs;  // one: the inverse of it; several: a chain of them, one after another
  bool is_inverse() const { return inputs.size() == 1; }
};

// A NetworkItem is a network from the specular to the metallic workflow. It is trained on random metallic
// materials that were matched by a specular model.
struct NetworkItem {
  WorkflowFit fit;                      // the fit without the part that is trained
  std::string metallic, specular;       // the model that is sampled, and the model that is matched
  std::map<std::string, double> fixed;  // parameters of the metallic model, by name
  std::vector<std::string> varied;  // further parameters of the metallic model that vary; they have no role
  std::size_t count = 20000;
  int resolution = 32;
  std::vector<std::size_t> hidden;  // units in each hidden layer
  Activation activation = Activation::kRelu;
};

struct ManifestItem {
  std::string id;
  // An AnyFit is finished: a formula from a paper, or a conversion of whole materials.
  std::variant<SweptItem, DerivedItem, AnyFit, NetworkItem> kind;
  std::string recipe;      // text that defines the item; items with equal recipes are equal
  std::uint64_t seed = 1;  // seed of its fit and of random materials
  // True if a difference between the light of the two models is accepted (table/table.hpp). The list
  // `accepted_light` of the manifest has such items, each with a reason. This is not part of the recipe,
  // because it does not change the table.
  bool accept_light = false;
};

// A Manifest holds the items. Each item comes after its inputs.
using Manifest = std::vector<ManifestItem>;

// Reads the text of a manifest. Throws kInput, beginning with `context`, for text that is not a manifest of
// version kManifestVersion. Also throws it if an id is defined twice or is not an identifier, and for the
// inverse or the chain of an item that is not in the manifest.
Manifest manifest_from_json(std::string_view text, const std::string& context);

// Loads the manifest of a folder. Messages begin with its path. If the folder has no manifest, throws kInput,
// too.
Manifest load_manifest(const std::filesystem::path& fit_folder);

// Returns the ids of the items that an item is made from.
std::vector<std::string> inputs_of(const ManifestItem& item);

}  // namespace remap
