// This target reads answers of workers to `describe` and `render`, and makes requests for pictures of the
// models that they describe.
#include "core/json_field.hpp"
#include "fuzz/fuzz.hpp"
#include "worker/protocol.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string line(remap::text_of(data, size));
  remap::read_or_refuse([&] {
    for (const remap::ModelDescription& model :
         remap::read_description(line, 1, "fake", "worker fake").models) {
      remap::Material material{model.name, {}};
      for (const remap::ParameterDescription& parameter : model.parameters)
        material.parameters[parameter.name] = {parameter.range.min};
      const remap::PictureRequest request = remap::picture_request(material, remap::Scene());
      (void)remap::parse_json(remap::render_line(2, request, "picture", "mesh"), "request");
      if (!remap::is_plain_text(request.shown)) std::abort();
    }
  });
  return remap::read_or_refuse([&] { remap::read_answer(line, 1, "worker fake"); });
}
