// This target reads measured BRDFs of the MERL database. A complete file has 35 MB, and inputs are smaller.
// The bytes after the head of an input are therefore also repeated until the file is complete.
#include <algorithm>
#include <cmath>
#include <string>

#include "fuzz/fuzz.hpp"
#include "fuzz/fuzz_file.hpp"
#include "warp/quadrature.hpp"

namespace {

constexpr std::size_t kHead = 12, kFileBytes = kHead + 3 * 90 * 90 * 180 * sizeof(double);
// these bytes are the counts 90, 90, 180
constexpr std::string_view kCounts("\x5a\0\0\0\x5a\0\0\0\xb4\0\0\0", kHead);

std::string completed(std::string_view input) {
  std::string file(input);
  file.reserve(kFileBytes);
  while (file.size() < kFileBytes)  // repeats the bytes after the head
    file.append(file, kHead, std::min(file.size() - kHead, kFileBytes - file.size()));
  file.resize(kFileBytes);
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input = remap::text_of(data, size);
  remap::read_or_refuse([&] { remap::read_merl(remap::fuzz_file(data, size)); });
  // such a file is refused, because its counts are wrong
  if (size == kHead || !input.starts_with(kCounts)) return 0;
  const std::string file = completed(input);
  bool is_read = false;
  remap::read_or_refuse([&] {
    const auto samples = remap::read_merl(
        remap::fuzz_file(reinterpret_cast<const std::uint8_t*>(file.data()), file.size(), ".binary"));
    is_read =
        std::ranges::all_of(samples, [](float sample) { return std::isfinite(sample) && sample >= 0.0f; });
  });
  if (!is_read) std::abort();
  return 0;
}
