// Measured BRDFs of the MERL database.
#include "fuzz/fuzz.hpp"
#include "fuzz/fuzz_file.hpp"
#include "warp/tabulated_set.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return remap::read_or_refuse([&] { remap::read_merl(remap::fuzz_file(data, size)); });
}
