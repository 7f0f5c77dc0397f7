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
#include "report/sheet_labels.hpp"
#include "texremap/plan/convert_plan.hpp"

namespace remap {

struct SetPreviewOptions {
  Environment light;
  std::string source, target;  // names above the pictures
  int resolution = 440;        // width and height of each ball, pixels
  int directions = 160;        // samples of the light for each pixel
  std::size_t most_materials = 4;
  std::function<void(double share)> progress;  // receives the finished fraction, 0 to 1; any thread
};

// A SetFigure compares the pictures of one material with the source's picture.
struct SetFigure {
  std::string name;
  std::optional<PictureError> copied;  // none if source and target have other parameters
  PictureError converted;
};

struct SetPreview {
  std::vector<SetFigure> figures;
  std::vector<std::string> notes;  // which models are shown by another built-in model
  std::string copied_title;        // what the middle column shows
  Image sheet;  // a row for each material; columns: source, numbers copied, numbers converted
  SheetLabels labels;
};

// Previews the first sets of a plan. Their maps are scaled down to the size of the picture. If the built-in
// renderer lacks a model, it shows the model that a shipped converter matches best to it. Normal maps and
// opacity are not shown. Throws kInput if a map cannot be read, and kUsage if the plan has no texture set.
SetPreview preview_sets(const ConvertPlan& plan, const SetPreviewOptions& options);

}  // namespace remap
