// This file is the workflows study. It compares several conversions from the specular to the metallic
// workflow by pictures under environment maps (Sztrajman et al. 2019, section 8, figures 21 and 22).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lower/fit_file.hpp"
#include "reference/workflow_conversion.hpp"
#include "study/lit_reflectances.hpp"

namespace remap {

// A WorkflowMethod is a conversion with the reflectances of its result.
struct WorkflowMethod {
  std::string name;
  WorkflowConversion conversion;  // converts to metallic; both ends have alpha as width
  MetallicReflection reflection;  // reflectances of the resulting metallic material
};

// A StudyMaterial is a material of the specular workflow. Its diffuse is a reflectance.
struct StudyMaterial {
  std::string name, group;
  Reflectances surface;
  std::size_t alpha = 0;  // index into the alphas of the study
};

// A WorkflowsOptions holds the options. `progress` is called progress_steps() times.
struct WorkflowsOptions : SphereSampling {
  std::vector<StudyMaterial> materials;
  std::vector<double> alphas;
  std::vector<Environment> environments;  // with different names and equal mean luminance
  std::vector<WorkflowFit> learned;
};
std::size_t progress_steps(const WorkflowsOptions& options);

// Reads `materials` and their `alphas` from CSV text with the columns material, group, alpha, diffuse_r,
// diffuse_g, diffuse_b, f0_r, f0_g and f0_b, as scripts/studies/materials writes it. Throws kInput for other
// columns, and for numbers out of range.
void read_materials(const std::string& text, const std::string& name, WorkflowsOptions* options);

// A WorkflowPictures is one material converted by one method.
struct WorkflowPictures {
  MetallicSurface surface;
  std::vector<double> rmse;  // for each light: error of display values, in percent of the display range
  std::vector<double> ssim;  // for each light: similarity of luma
};

// A WorkflowComparison holds all methods in one convention. The last method is kLeastErrorMethod, which is a
// search.
struct WorkflowComparison {
  std::string convention;  // `plain`, `gltf`
  std::vector<WorkflowMethod> methods;
  // [method][material]; lights are the environments, then the headlight
  std::vector<std::vector<WorkflowPictures>> pictures;
};

inline constexpr const char* kLeastErrorMethod = "best (albedo, metallic)";

// Renders every material and the result of each method. The smallest error comes from the best result: either
// of a search under these environments, or of a method with the same F0. So no method has a smaller error.
// Throws kUsage for empty lists, numbers out of range, and an environment with the name of another
// environment or of the headlight. Also throws kInterrupted.
//
// Returns the comparisons for plain diffuse, then for glTF. If `sheets` is not null, it receives one sheet
// with labels for each environment, in display values. Each group has two rows, one for each material. A row
// shows the source, and then the plain methods.
std::vector<WorkflowComparison> study_workflows(const WorkflowsOptions& options,
                                                std::vector<Image>* sheets = nullptr);

// Returns a row for each convention, material, method and light. The last light is the headlight.
std::string workflows_csv(const WorkflowsOptions& options,
                          const std::vector<WorkflowComparison>& comparisons);

// The following tests round trips. Random metallic materials are converted to the specular workflow by
// equation (2), and by each method to the metallic workflow again (Sztrajman et al. 2019, section 8, figure
// 20, in the opposite direction). Both workflows can represent these materials.

// A FamilyKind is the distribution of the materials and the storage of the specular maps.
enum class FamilyKind {
  kExact,    // base color and metallic are uniform floats
  kStored,   // like kExact, stored with 8 bits in sRGB
  kAuthored  // like assets: base color uniform in sRGB, metallic 0 or 1 in four of five; 8 bits
};

// A RoundTripErrors holds RMS errors of one method over one kind of materials. Base color is compared in
// sRGB, over all channels.
struct RoundTripErrors {
  std::string method;
  FamilyKind family = FamilyKind::kExact;
  double metallic = 0.0, base_color = 0.0;
};

// Returns every method with every kind. Each method converts back from specular materials with its F0 and
// convention. Khronos' solver is also tested on plain maps, as `Khronos, plain`. `count` is the number of
// materials of each kind, with uniform alpha. Materials depend only on `seed`. Throws kUsage if `count` is 0.
std::vector<RoundTripErrors> study_round_trips(const std::vector<WorkflowFit>& learned, std::size_t count,
                                               std::uint64_t seed, unsigned jobs);

std::string round_trips_csv(const std::vector<RoundTripErrors>& trips, std::size_t count, std::uint64_t seed);

}  // namespace remap
