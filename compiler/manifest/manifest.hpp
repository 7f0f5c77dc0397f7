// The manifest of a folder of fits: what `remapc build` makes, and how.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "fit_file/any_fit.hpp"

namespace remapc {

inline constexpr const char* kManifestName = "manifest.json";
inline constexpr int kManifestVersion = 1;

// How a group of pairs is swept and fitted.
struct SweepRecipe {
  std::string objective = "natural";
  int resolution = 512;
  remap::Range alphas{0.01, 1.0};
  std::size_t roughness_samples = 30;
  std::size_t specular_samples = 30;
  std::map<std::string, remap::Range> speculars;  // of source models, canonical, where not all that they take
};

// One converter. Every kind but the first needs no renderer.
struct SweptItem {  // a pair of models, of the built-in renderer or of real ones
  std::string source, target;
  SweepRecipe recipe;
};
struct InverseItem {  // the way back through another item's fit
  std::string of;
};
struct PublishedItem {  // a formula from a paper; `fit` is complete but for the tool's version
  remap::Fit fit;
};
struct ChainItem {  // other items one after another
  std::vector<std::string> steps;
};

struct WorkflowItem {  // a conversion of whole materials; complete
  remap::WorkflowFit fit;
};

// A network from the specular to the metallic workflow, learned from random metallic materials whose pictures
// are matched by a specular model.
struct NetworkItem {
  remap::WorkflowFit fit;               // without what is learned
  std::string metallic, specular;       // models that are sampled and matched
  std::map<std::string, double> fixed;  // parameters of the metallic model, by name
  std::vector<std::string> varied;      // its parameters without role that vary
  std::size_t count = 20000;
  int resolution = 32;
  std::vector<std::size_t> hidden;  // units of each hidden layer
  remap::Activation activation = remap::Activation::kRelu;
};

struct ManifestItem {
  std::string id;
  std::variant<SweptItem, InverseItem, PublishedItem, ChainItem, WorkflowItem, NetworkItem> kind;
  std::string recipe;      // what it is made from, as text: two items of one recipe are the same
  std::uint64_t seed = 1;  // of its fit, and of random materials
};

// Items in an order in which each comes after those that it is made from.
struct Manifest {
  std::vector<ManifestItem> items;
};

// Throws kInput, opened by `place`, for text that is no manifest of kManifestVersion, an id that stands twice
// or is no identifier, and an inverse or a chain of something that is no item.
Manifest manifest_from_json(std::string_view text, const std::string& place);

// The manifest of a folder. Throws kInput where it has none.
Manifest load_manifest(const std::filesystem::path& fit_folder);

// The items that an item is made from.
std::vector<std::string> inputs_of(const ManifestItem& item);

}  // namespace remapc
