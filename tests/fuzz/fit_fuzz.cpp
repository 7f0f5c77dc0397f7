// This target reads fits as JSON, of every kind, as remapc and texremap do. A fit that is read is written and
// read again. It must not change.
#include "fuzz/fuzz.hpp"
#include "lower/fit_file.hpp"
#include "paths/converter_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  remap::read_or_refuse([&] { remap::fitted_converter_from_json(remap::text_of(data, size), "fit.json"); });
  return remap::read_or_refuse([&] {
    const remap::AnyFit any = remap::any_fit_from_json(remap::text_of(data, size), "fit.json");
    std::visit(
        [](const auto& fit) {
          const std::string text = remap::fit_to_json(fit);
          if (remap::fit_to_json(std::get<std::decay_t<decltype(fit)>>(
                  remap::any_fit_from_json(text, "again.json"))) != text)
            std::abort();
        },
        any);
  });
}
