#include "remap/converter.hpp"

#include <algorithm>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "stages/stage.hpp"

namespace remap {
namespace {

void require_channels(std::size_t count) {
  if (count != 1 && count != 3)
    throw usage_error("converter: got " + std::to_string(count) +
                      " specular channels (1 or 3 are supported)");
}

}  // namespace

bool Converter::has_source(Parameter parameter) const noexcept { return contains(sources_, parameter); }

bool Converter::has_target(Parameter parameter) const noexcept { return contains(targets_, parameter); }

std::size_t Converter::target_channels(Parameter parameter, std::size_t specular_channels) const noexcept {
  if (!is_color(parameter)) return 1;
  return converts_brdf_only() ? specular_channels : 3;
}

std::size_t Converter::convert(std::size_t count, const MaterialRows<const float>& in,
                               const MaterialRows<float>& out, std::uint8_t* outside) const {
  if (has_source(Parameter::kSpecular)) require_channels(in[Parameter::kSpecular].count);
  Block block(in, out);
  std::size_t outside_count = 0;
  for (std::size_t start = 0; start < count; start += kBlockTexels) {
    block.begin(start, std::min(kBlockTexels, count - start));
    outside_count += run_stages(stages_, block, outside == nullptr ? nullptr : outside + start);
    block.finish();
  }
  return outside_count;
}

std::size_t Converter::convert(std::size_t count, const float* width, std::span<const float* const> specular,
                               float* width_out, std::span<float* const> specular_out,
                               std::uint8_t* outside) const {
  require_channels(specular.size());  // check before specular is copied
  MaterialRows<const float> in;
  MaterialRows<float> out;
  in[Parameter::kRoughness] = {{width}, 1};
  out[Parameter::kRoughness] = {{width_out}, 1};
  in[Parameter::kSpecular].count = out[Parameter::kSpecular].count = specular.size();
  std::ranges::copy(specular, in[Parameter::kSpecular].row.begin());
  std::ranges::copy(specular_out, out[Parameter::kSpecular].row.begin());
  return convert(count, in, out, outside);
}

bool Converter::self_test() const { return remap::self_test(stages_); }

}  // namespace remap
