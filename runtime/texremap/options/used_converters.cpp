#include "texremap/options/used_converters.hpp"

namespace remap {

Option* UsedConverters::add_option(Command& command) {
  return command
      .add_option(
          "--converters PATH", path_,
          "Use these converters instead of the shipped ones: a converters.json of `remapc emit --all`, a "
          "fit, or a folder of fits")
      ->environment("REMAP_CONVERTERS");
}

ConverterGraph UsedConverters::graph(InstructionSet set) const {
  if (path_.empty()) return shipped_graph(set);
  std::shared_ptr<const ConverterList>& list = read_[set];
  if (!list) list = std::make_shared<const ConverterList>(read_converters(path_, set));
  return graph_of(*list);
}

}  // namespace remap
