// This file is the module texremap._core: converters of the library over arrays, and the commands of
// texremap.
#include <nanobind/nanobind.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <string>
#include <vector>

#include "command_line/progress.hpp"
#include "conversion.hpp"
#include "core/errors.hpp"
#include "images.hpp"
#include "remap/error.hpp"
#include "remap/version.hpp"
#include "remap/workflow.hpp"
#include "texremap/commands/commands.hpp"

namespace nb = nanobind;

namespace remap::python {
namespace {

// Raises texremap.Error, which is made in Python: a ValueError with the kind as a member.
void raise_error(const Error& error) {
  const nb::object type = nb::module_::import_("texremap._error").attr("Error");
  const nb::object value =
      type(nb::str(error.what()), nb::cast(std::string(name_of(kErrorKinds, error.kind()))));
  PyErr_SetObject(type.ptr(), value.ptr());
}

// Returns every name that a conversion may have, with its meaning.
nb::list models() {
  nb::list all;
  const ConverterGraph graph = shipped_graph();
  const auto add = [&](const std::string& name, const char* kind, const std::string& roughness,
                       const std::string& specular, const std::string& meaning) {
    nb::list aliases;
    for (const ModelAlias& alias : model_aliases())
      if (alias.model == name) aliases.append(std::string(alias.name));
    all.append(nb::make_tuple(name, kind, roughness, specular, meaning, nb::tuple(aliases)));
  };
  for (const std::string& name : graph.models()) {
    const ModelSide side = graph.side_of(name);
    add(name, "brdf", std::string(encoding_name(side.roughness)), side.specular, "");
  }
  for (const WorkflowModel& model : workflow_models())
    add(model_of(model.end), kind_of(model.end) == WorkflowKind::kSpecular ? "specular" : "metallic",
        std::string(encoding_name(width_of(model.end))), "f0", model.reason);
  return all;
}

int run(const std::vector<std::string>& words, bool watches) {
  std::vector<const char*> arguments = {"texremap"};
  for (const std::string& word : words) arguments.push_back(word.c_str());
  const nb::gil_scoped_release released;
  if (watches) watch_interruptions();
  return run_texremap(static_cast<int>(arguments.size()), arguments.data());
}

}  // namespace

NB_MODULE(_core, module) {
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const Error& error) {
      raise_error(error);
    }
  });
  module.attr("__version__") = kVersion;
  module.def("models", &models);
  module.def("run", &run, nb::arg("words"), nb::arg("watches"));
  module.def("use_images", &use_images, nb::arg("images"));
  using C = MaterialConversion;
  nb::class_<C>(module, "Conversion")
      .def(nb::init<const Request&>())
      .def_static("load", &C::load, nb::arg("path"), nb::arg("source_workflow"))
      .def("convert", &C::convert)
      .def("target_channels", &C::target_channels)
      .def("describe", &C::describe);
}

}  // namespace remap::python
