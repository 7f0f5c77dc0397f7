// How well materials of the specular workflow are said in the metallic one: several conversions of the same
// materials, rendered under environments (Sztrajman et al. 2019, section 8, figures 21 and 22).
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/workflow_least_error.hpp"
#include "study/workflow_materials.hpp"
#include "workflow/conversion.hpp"

namespace remapc {

// A conversion, and how its result is rendered.
struct WorkflowMethod {
  std::string name;
  remap::WorkflowConversion conversion;  // to metallic; width of both ends alpha
  MetallicReflection reflection;         // of the metallic material
};

// Equation (3) by both means with F0 0.03 and 0.04, Khronos' solver, networks, the projection; in this order.
// Diffuse is plain: Khronos' solver gets maps that its convention does not fit, as importers do it.
// `learned`: conversions by networks, named after them; those of other conventions are left out.
struct NamedConversion {
  std::string name;
  remap::WorkflowConversion conversion;
};
std::vector<WorkflowMethod> plain_methods(const std::vector<NamedConversion>& learned);
// The same in the convention of glTF: diffuse counts 1 - max(specular). Khronos' solver is at home here.
std::vector<WorkflowMethod> gltf_methods();

struct WorkflowsOptions {
  std::vector<StudyMaterial> materials;
  std::vector<double> alphas;
  std::vector<Environment> environments;  // names differ; of one mean luminance
  std::vector<NamedConversion> learned;
  int resolution = 128;
  int samples = 1024;                            // directions a pixel
  unsigned jobs = 0;                             // threads; 0: one a core. The figures do not depend on it
  bool sheets = false;                           // keep contact sheets
  std::function<void()> progress;                // one of progress_steps() is done; from any thread
  const std::atomic<bool>* cancelled = nullptr;  // stops soon; throws kInterrupted
};
std::size_t progress_steps(const WorkflowsOptions& options);

// One material by one method.
struct WorkflowPictures {
  MetallicSurface surface;
  std::vector<double> rmse;  // a light: of display values, percent of the display's range
  std::vector<double> ssim;  // a light: structural similarity of luma
};

// Of a method over the materials of one group or all.
struct WorkflowFigures {
  double rmse = 0.0, ssim = 0.0;                      // means over materials and environments
  double worst_ssim = 0.0;                            // mean of the 5 % worst pictures
  double headlight_rmse = 0.0, headlight_ssim = 0.0;  // means under the light at the camera
};

// All methods in one convention; the last is the least error, `best`.
struct WorkflowComparison {
  std::string convention;  // `plain`, `gltf`
  std::vector<std::string> methods;
  std::vector<std::vector<WorkflowPictures>> pictures;  // [method][material]; lights: environments, headlight
};

inline constexpr const char* kLeastErrorMethod = "best (albedo, metallic)";

struct WorkflowsResult {
  std::vector<WorkflowComparison> comparisons;  // plain, then glTF
  // One for each environment, in display values: a row a material, two of each group; the source, then the
  // plain methods.
  std::vector<Image> sheets;
  std::vector<std::string> sheet_materials;  // names of the rows
};

// Renders every material and what each method makes of it. The least error is the best of a search under
// these environments and of all methods of its F0, so that none of them is below it. Throws kUsage for empty
// lists and numbers out of range, kInterrupted.
WorkflowsResult study_workflows(const WorkflowsOptions& options);

// Of one method of a comparison, over the group or, without one, all materials.
WorkflowFigures figures_of(const WorkflowsOptions& options, const WorkflowComparison& comparison,
                           std::size_t method, std::optional<MaterialGroup> group = {});

}  // namespace remapc
