#include "texremap/options/used_converters.hpp"

#include "core/input_file.hpp"
#include "remap/shipped_converters.hpp"

namespace remap {

Option* UsedConverters::add_option(Command& command) {
  return command
      .add_option("--converters PATH", path_,
                  "Use these converters instead of the shipped ones: a fit, a folder of fits, or a "
                  "converters.json of `remapc emit --all`")
      ->environment("REMAP_CONVERTERS");
}

ConverterGraph UsedConverters::graph(InstructionSet set) const {
  if (path_.empty()) return shipped_graph(set);
  std::shared_ptr<const ConverterList>& list = read_[set];
  if (!list) list = std::make_shared<const ConverterList>(read_converters(path_, set));
  return graph_of(*list);
}

std::optional<FittedConverter> UsedConverters::fit() const {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path_, ignored)) return std::nullopt;
  const std::string text = read_file(path_);
  if (is_converter_list(text)) return std::nullopt;
  return fitted_converter_from_json(text, path_.string());
}

}  // namespace remap
