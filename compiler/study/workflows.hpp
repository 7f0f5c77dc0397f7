// The workflows study: compares several conversions from the specular to the metallic workflow by pictures
// under environment maps (Sztrajman et al. 2019, section 8, figures 21 and 22).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/workflow_conversion.hpp"
#include "study/lit_reflectances.hpp"
#include "study/workflow_materials.hpp"

namespace remap {

// A conversion and the reflectances of its result.
struct WorkflowMethod {
  std::string name;
  WorkflowConversion conversion;  // to metallic; both ends hold alpha
  MetallicReflection reflection;  // of the metallic material
};

// Returns equation (3) by both means with F0 0.03 and 0.04, Khronos' solver, the networks of `learned` and
// the projection, in this order. Diffuse is plain; Khronos' solver is applied to such maps although its
// convention differs, because importers do so. Networks of other conventions are skipped.
struct NamedConversion {
  std::string name;
  WorkflowConversion conversion;
};
std::vector<WorkflowMethod> plain_methods(const std::vector<NamedConversion>& learned);
// The methods for the glTF convention, in which diffuse is scaled by 1 - max(specular). Khronos' solver is
// made for this convention.
std::vector<WorkflowMethod> gltf_methods();

// `progress` is called progress_steps() times.
struct WorkflowsOptions : SphereSampling {
  std::vector<StudyMaterial> materials;
  std::vector<double> alphas;
  std::vector<Environment> environments;  // of different names and equal mean luminance
  std::vector<NamedConversion> learned;
  bool sheets = false;  // draw contact sheets
};
std::size_t progress_steps(const WorkflowsOptions& options);

// One material converted by one method.
struct WorkflowPictures {
  MetallicSurface surface;
  std::vector<double> rmse;  // for each light: of display values, percent of the display range
  std::vector<double> ssim;  // for each light: of luma
};

// Figures of one method over the materials of one group or all groups.
struct WorkflowFigures {
  double rmse = 0.0, ssim = 0.0;                      // means over materials and environments
  double worst_ssim = 0.0;                            // mean over the worst 5 % of the pictures
  double headlight_rmse = 0.0, headlight_ssim = 0.0;  // means under the headlight
};

// All methods in one convention. The last is kLeastErrorMethod.
struct WorkflowComparison {
  std::string convention;  // `plain`, `gltf`
  std::vector<std::string> methods;
  std::vector<std::vector<WorkflowPictures>> pictures;  // [method][material]; lights: environments, headlight
};

inline constexpr const char* kLeastErrorMethod = "best (albedo, metallic)";

struct WorkflowsResult {
  std::vector<WorkflowComparison> comparisons;  // plain, then glTF
  // One sheet for each environment, in display values: one row for each of two materials per group; the
  // source, then the plain methods.
  std::vector<Image> sheets;
  std::vector<std::string> sheet_materials;  // names of the rows
};

// Renders every material and the result of each method. The least error is the best of a search under these
// environments and of all methods with its F0, so that none of them has a smaller error. Throws kUsage for
// empty lists and numbers out of range, and kInterrupted.
WorkflowsResult study_workflows(const WorkflowsOptions& options);

// Figures of one method of a comparison over `group`, or over all materials without a group.
WorkflowFigures figures_of(const WorkflowsOptions& options, const WorkflowComparison& comparison,
                           std::size_t method, std::optional<MaterialGroup> group = {});

// Round trips of materials that both workflows can represent: random metallic materials are converted to the
// specular workflow by equation (2) and back by each method (Sztrajman et al. 2019, section 8, figure 20, in
// the opposite direction).

// The distribution of the materials and the storage of the specular maps.
enum class FamilyKind {
  kExact,    // base color and metallic uniform; floats
  kStored,   // as kExact, stored with 8 bits in sRGB
  kAuthored  // like assets: base color uniform in sRGB, metallic 0 or 1 in four of five; 8 bits
};
inline constexpr std::size_t kFamilyKinds = 3;
// For example `uniform, exact`.
std::string family_name(FamilyKind kind);

// RMS errors over the materials, of metallic and of base color (sRGB, all channels).
struct FamilyErrors {
  double metallic = 0.0, base_color = 0.0;
};

struct FamilyLine {
  std::string method;
  FamilyErrors errors[kFamilyKinds];
};

// Each method converts back from specular materials of its own F0 and convention. Khronos' solver is also
// tested on plain maps, as `Khronos, plain`. `count`: materials of each kind, with uniform alpha. Materials
// depend only on `seed`. Throws kUsage if `count` is 0.
std::vector<FamilyLine> study_family(const std::vector<NamedConversion>& learned, std::size_t count,
                                     std::uint64_t seed, unsigned jobs);

}  // namespace remap
