// `remapc warp` for tables, and the functions that it shares with texture sets.
#include <iostream>

#include "command_line/run_app.hpp"
#include "commands/warp_command.hpp"
#include "remap/error.hpp"
#include "text/report_text.hpp"
#include "warp/input/copied_set.hpp"
#include "warp/input/stroke_colors.hpp"
#include "warp/input/stroke_masks.hpp"
#include "warp/input/tabulated_set.hpp"
#include "warp/input/texture_material.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

// A texture set or a table.
using MaterialSet = std::variant<TextureMaterial, TabulatedSet>;

MaterialSet read_material_set(const std::string& folder, const std::string& model) {
  if (is_tabulated_folder(folder)) return read_tabulated_set(folder);
  return read_texture_material(folder, model);
}

MaterialRef ref_of(const MaterialSet& set) {
  return std::visit([](const auto& kind) { return MaterialRef(kind.material); }, set);
}

MapFrame frame_of(const MaterialSet& set) {
  return std::visit([](const auto& kind) { return kind.frame(); }, set);
}

void require_copy_alone(const WarpCommand& command) {
  const std::string table = is_tabulated_folder(command.source) ? command.source : command.target;
  if (!command.output.empty() || command.copy.empty())
    throw Error(ErrorKind::kUsage,
                table + ": a table cannot be fitted (use --copy FOLDER instead of --output)");
  if (!command.report.empty())
    throw Error(ErrorKind::kUsage,
                "--report: not available for tables such as " + table + " (remove this option)");
}

}  // namespace

std::vector<StrokePair> strokes_of(const WarpCommand& command, const MapFrame& source,
                                   const MapFrame& target) {
  std::vector<StrokePair> strokes;
  for (std::size_t i = 0; i + 1 < command.masks.size(); i += 2)
    strokes.push_back({read_stroke(command.masks[i], source), read_stroke(command.masks[i + 1], target)});
  for (std::size_t i = 0; i + 1 < command.boxes.size(); i += 2)
    strokes.push_back({box_stroke(command.boxes[i], source), box_stroke(command.boxes[i + 1], target)});
  for (std::size_t i = 0; i + 1 < command.paintings.size(); i += 2)
    for (StrokePair& pair :
         read_color_strokes(command.paintings[i], source, command.paintings[i + 1], target))
      strokes.push_back(std::move(pair));
  if (strokes.empty())
    throw Error(
        ErrorKind::kUsage,
        "no strokes given (use --strokes SOURCE_IMAGE TEMPLATE_IMAGE, --stroke SOURCE_MASK TEMPLATE_MASK, "
        "or --box SOURCE_BOX TEMPLATE_BOX)");
  return strokes;
}

WarpOptions options_of(const WarpCommand& command, AppearanceDistance usual) {
  WarpOptions options;
  options.method = *method_from_name(command.method);
  options.distance = distance_from_name(command.distance).value_or(usual);
  options.dimensions = command.dimensions;
  options.exact = command.exact;
  return options;
}

nlohmann::ordered_json report_of(const WarpDiagnostics& found) {
  return {{"dimensions", found.dimensions},
          {"source_dimensions", found.source_dimensions},
          {"template_dimensions", found.target_dimensions},
          {"source_stress", found.source_stress},
          {"template_stress", found.target_stress},
          {"fixed_directions", found.fixed_directions},
          {"fold_share", found.fold_share},
          {"template_used", found.coverage},
          {"stroke_distance", found.stroke_distance},
          {"stroke_distance_affine", found.stroke_contradiction},
          {"strokes", found.strokes},
          {"worst_stroke", found.worst_stroke + 1},
          {"largest_overlap", found.shared.overlap.share},
          {"source_texels_left_out", found.source_left_out},
          {"template_texels_left_out", found.target_left_out}};
}

std::string summary_of(const WarpDiagnostics& found) {
  return "warp in " + std::to_string(found.dimensions) + " dimensions from " +
         std::to_string(found.strokes.size()) + " stroke pairs\n  template used " + percent(found.coverage) +
         ", folds " + percent(found.fold_share) + ", distance of strokes " + percent(found.stroke_distance) +
         " of the template's spread\n";
}

void warp_tables(const WarpCommand& command) {
  require_copy_alone(command);
  const MaterialSet source = read_material_set(command.source, command.source_model),
                    target = read_material_set(command.target, command.target_model);
  const MaterialRef from = ref_of(source), to = ref_of(target);
  const AppearanceDistance usual =
      from.is_profiles() ? AppearanceDistance::kPlain : AppearanceDistance::kRelative;
  const AppearanceMatch match = match_appearances(
      from, to, strokes_of(command, frame_of(source), frame_of(target)), options_of(command, usual));
  const auto* table = std::get_if<TabulatedSet>(&target);
  const auto files =
      write_copied_set(command.copy, copy_exactly(match, from, to), frame_of(source),
                       {to, frame_of(target), table != nullptr ? table->table : std::filesystem::path()});
  const std::vector<std::string> warnings = warnings_of(match.diagnostics);
  if (command.json) {
    nlohmann::ordered_json json = {{"diagnostics", report_of(match.diagnostics)}, {"warnings", warnings}};
    for (const std::filesystem::path& file : files) json["files"].push_back(file.string());
    std::cout << json.dump(2) << "\n";
    return;
  }
  std::cerr << command.copy.string() << ": " << summary_of(match.diagnostics);
  for (const std::string& warning : warnings) remap::print_message("remapc", "warning: " + warning);
}

}  // namespace remapc
