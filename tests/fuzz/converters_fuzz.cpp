// This target reads files for --converters: many converters, or the fit of one converter. Each converter that
// is read converts a texel. It is then written and read again, and must not change.
#include "converter/converter_data.hpp"
#include "fuzz/fuzz.hpp"
#include "fuzz/fuzz_file.hpp"
#include "remap/shipped_converters.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = remap::fuzz_file(data, size);
  remap::read_or_refuse([&] {
    for (const auto& converter : remap::read_converters(file, remap::InstructionSet::kBaseline))
      (void)converter->self_test();
  });
  return remap::read_or_refuse([&] {
    const std::string text =
        remap::converters_to_json(remap::converters_from_json(remap::text_of(data, size), "converters.json"));
    if (remap::converters_to_json(remap::converters_from_json(text, "again.json")) != text) std::abort();
  });
}
