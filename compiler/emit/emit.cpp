// This file makes a header from a fit in two steps. describe() returns the data of the header
// (header_data.hpp), and fill() its text.
#include "emit/emit.hpp"

#include <algorithm>

#include "emit/header_data.hpp"
#include "emit/languages.hpp"
#include "materials/description.hpp"

namespace remap {

std::string emit_header(const Fit& fit) { return fill(describe(fit)); }

std::string emit_header(const WorkflowFit& fit) { return fill(describe(fit)); }

std::string emit_header(const WarpMapFit& fit) { return fill(describe(fit)); }

std::vector<EmittedFile> emit_shared_files(std::vector<Fit> fits) {
  std::ranges::sort(fits, {},
                    [](const Fit& fit) -> const std::string& { return require_converter(fit).info.id; });
  std::vector<ConverterData> converters;
  for (const Fit& fit : fits) converters.push_back(require_converter(fit));
  const MaterialLibrary& materials = material_library();
  std::vector<EmittedFile> files = {{"converters.json", converters_to_json(converters)},
                                    {"materials/materials.hpp", materials_header(materials)},
                                    {"materials/materials.py", materials_module(materials)},
                                    {"materialx/remap_translation.mtlx", materials_graphs(materials)}};
  const auto is_lobe = [](const ModelSide& side) {
    return side.model.starts_with("mitsuba/") || side.model.starts_with("legacy/");
  };
  std::erase_if(fits, [&](const Fit& fit) { return !is_lobe(fit.source) || !is_lobe(fit.target); });
  if (fits.empty()) return files;
  for (const auto& language : kLanguages)
    files.push_back({"languages/converters" + extension_of(language.value),
                     emit_functions(fits, language.value, "converters")});
  return files;
}

}  // namespace remap
