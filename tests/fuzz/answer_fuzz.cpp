// Answers of workers: to describe, and to render.
#include "fuzz/fuzz.hpp"
#include "worker/protocol.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string line(remap::text_of(data, size));
  remap::read_or_refuse([&] { remap::read_description(line, 1, "fake", "worker fake"); });
  return remap::read_or_refuse([&] { remap::read_answer(line, 1, "worker fake"); });
}
