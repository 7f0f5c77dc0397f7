// This is the program texremap for a page. Files are in memory, and JavaScript may run it more than once.
#include <cstdio>
#include <emscripten.h>
#include <iostream>
#include <string>

#include "core/json.hpp"
#include "paths/known_names.hpp"
#include "remap/path.hpp"
#include "texremap/commands/commands.hpp"
#include "texture/layout.hpp"

namespace remap {
namespace {

Json names() {
  Json engines = Json::list(), models = Json::list();
  for (const NamedLayout& engine : engine_layouts())
    if (!engine.words.empty()) engines.push_back(engine.name);  // `--to gltf` names only a material
  const ConverterGraph graph = shipped_graph();
  for (const std::string& name : graph.models()) models.push_back(name);
  return {{"programs", names_json(known_programs())},
          {"formats", names_json(known_formats())},
          {"engines", engines},
          {"models", models}};
}

}  // namespace
}  // namespace remap

// Returns the names for --from and --to, as JSON.
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
