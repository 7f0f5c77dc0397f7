// This file previews the conversion of texture sets. It shows the maps on a ball in the source's shading.
// Then it shows the ball in the target's shading, with the same numbers and with converted numbers.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "look/environment.hpp"
#include "look/image.hpp"
#include "look/material_looks.hpp"
#include "report/contact_sheet.hpp"
#include "texremap/plan/convert_plan.hpp"
#include "worker/renderer_set.hpp"

namespace remap {

struct SetPreviewOptions {
  Environment light;
  std::string source, target;  // names above the pictures
  // Names of the workers that show the source and the target; if empty, the built-in renderer shows it.
  std::string renderer_before, renderer_after;
  const RendererSet* renderers = nullptr;  // has these workers
  int resolution = 440;                    // width and height of each ball, pixels
  int directions = 160;                    // samples of the light for each pixel, in the built-in renderer
  int external_directions = 128;           // in workers
  std::size_t most_materials = 4;
  std::function<void(double share)> progress;  // called from any thread with the finished fraction, 0 to 1
};

// A SetFigure compares the pictures of one material with the source's picture.
struct SetFigure {
  std::string name;
  std::optional<PictureError> copied;  // none if source and target have other parameters
  PictureError converted;
  double outside = 0.0;  // MaterialLooks::outside
};

struct SetPreview {
  std::vector<SetFigure> figures;
  std::vector<std::string> notes;  // which models are shown by other models, and what is not shown
  std::string copied_title;        // what the middle column shows
  Image sheet;  // a row for each material; columns: source, numbers copied, numbers converted
  SheetLabels labels;
};

// Previews the first sets of a plan. Their maps are scaled down to the size of the picture. If a renderer
// lacks a model, it shows the model that a shipped converter matches best to it. Opacity is not
// shown. Throws kInput if a map cannot be read or a worker fails. Throws kUsage if the plan has no
// texture set, and for a worker that is unknown or has no model with textures.
SetPreview preview_sets(const ConvertPlan& plan, const SetPreviewOptions& options);

}  // namespace remap
