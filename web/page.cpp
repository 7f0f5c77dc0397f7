// The program texremap for a page: files are in memory, and JavaScript may run it more than once.
#include <cstdio>
#include <emscripten.h>
#include <iostream>
#include <string>

#include "core/json.hpp"
#include "remap/path.hpp"
#include "remap/workflow.hpp"
#include "texremap/commands/commands.hpp"
#include "texture/layout.hpp"

namespace remap {
namespace {

Json names() {
  Json presets = Json::list(), materials = Json::list(), models = Json::list(), aliases = Json::list();
  for (const Preset& preset : engine_presets())
    presets.push_back({{"name", preset.name}, {"model", preset.model}});
  for (const WorkflowModel& model : workflow_models())
    materials.push_back(
        {{"name", model_of(model.end)}, {"workflow", kind_name(model.end)}, {"brdf", model.brdf}});
  const ConverterGraph graph = shipped_graph();
  for (const std::string& name : graph.models()) models.push_back(name);
  for (const ModelAlias& alias : model_aliases())
    aliases.push_back({{"name", alias.name}, {"model", alias.model}, {"meaning", alias.meaning}});
  return {{"presets", presets}, {"materials", materials}, {"models", models}, {"aliases", aliases}};
}

}  // namespace
}  // namespace remap

// What --from, --to and --preset take, as JSON.
extern "C" EMSCRIPTEN_KEEPALIVE const char* texremap_names() {
  static const std::string text = remap::names().dump();
  return text.c_str();
}

int main(int argc, char** argv) {
  const int status = remap::run_texremap(argc, argv);
  std::cout.flush();
  std::fflush(nullptr);
  return status;
}
