#include "paths/converter_file.hpp"

#include <utility>

#include "converter/converter_fields.hpp"
#include "core/input_file.hpp"
#include "remap/error.hpp"
#include "stages/warp_json.hpp"

namespace remap {

FittedConverter fitted_converter_from_json(std::string_view text, const std::string& context) {
  const Json json = parse_json(text, context);
  const Field root(json, context);
  require_fit_file(root);
  read_id(root["id"]);
  if (is_of_materials(root)) {
    if (root["mapping"]["kind"].text() == kWarpKind) return read_warp_fit(root);
    return UnusedFit{};
  }
  const std::optional<ConverterData> converter = read_fitted_converter(root);
  if (!converter)
    root["converter"].fail("missing, because the fit could not be lowered (remapc fit --lower)");
  return *converter;
}

bool is_converter_list(std::string_view text) { return text.find("\"remap-converters\"") < 64; }

FittedConverter load_fitted_converter(const std::filesystem::path& path) {
  return fitted_converter_from_json(read_file(path), path.string());
}

WarpMapFit load_warp_fit(const std::filesystem::path& path) {
  FittedConverter fit = load_fitted_converter(path);
  if (auto* warp = std::get_if<WarpMapFit>(&fit)) return std::move(*warp);
  throw Error(ErrorKind::kInput, path.string() + ": not the fit of a warp (`remapc warp` makes them)");
}

}  // namespace remap
