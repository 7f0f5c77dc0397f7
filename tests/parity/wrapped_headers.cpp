// This file has templates of a caller that use headers of each kind. The test of shipped headers compiles it
// with the flags of engines.
#include "cycles_5_ggx_to_mitsuba_ggx.hpp"
#include "gltf_specgloss_to_gltf.hpp"
#include "gltf_specgloss_to_gltf_khronos.hpp"
#include "gltf_to_gltf_specgloss.hpp"
#include "mitsuba_ward_to_mitsuba_as.hpp"
#include "mitsuba_ward_to_mitsuba_as_sztrajman_2019.hpp"
#include "mitsuba_ward_to_mitsuba_ggx.hpp"
#include "specular_to_metallic_mean_sztrajman_2019.hpp"
#include "specular_to_metallic_network_sztrajman_2019.hpp"

namespace {

// Specular is in red, green and blue, the width in alpha.
template <class Converter>
std::size_t convert_brdf(std::size_t count, float* rgba, float* alpha) {
  static_assert(Converter::Form::width_min < Converter::Form::width_max);
  const auto grey = Converter::evaluate({0.3f, {0.5f}});
  const auto color = Converter::template evaluate<3>({0.3f, {0.8f, 0.6f, 0.4f}});
  rgba[0] = grey.width + grey.specular[0] + color.width + color.specular[2];
  const typename Converter::template Texels<> texels{rgba + 3, {rgba, rgba + 1, rgba + 2}, 4, 4};
  return Converter::evaluate_batch(count, texels, texels) +
         Converter::template evaluate_batch<1>(count, {alpha, {alpha}}, {alpha, {rgba}}) +
         (Converter::self_test() ? 0 : 1);
}

template <class Converter>
std::size_t convert_material(std::size_t count, typename Converter::template InputTexels<const float> in,
                             typename Converter::template OutputTexels<> out) {
  const typename Converter::Output one = Converter::evaluate(typename Converter::Input{});
  *out.width = one.width;
  return Converter::evaluate_batch(count, in, out) +
         (Converter::in_domain({}) && Converter::self_test() ? 0 : 1);
}

template <class... Converters>
std::size_t convert_brdfs(float* rgba) {
  return (convert_brdf<Converters>(2, rgba, rgba + 8) + ...);
}

template <class... Converters>
std::size_t convert_materials(float* rows) {
  return (convert_material<Converters>(1,
                                       {{rows, rows + 1, rows + 2}, {rows + 3, rows + 4, rows + 5}, rows + 6},
                                       {{rows, rows + 1, rows + 2}, rows + 3, rows + 4}) +
          ...);
}

}  // namespace

int main() {
  using namespace remap;
  float values[10] = {};
  const std::size_t wrong =
      convert_brdfs<cycles_5_ggx_to_mitsuba_ggx, mitsuba_ward_to_mitsuba_as,
                    mitsuba_ward_to_mitsuba_as_sztrajman_2019, mitsuba_ward_to_mitsuba_ggx>(values) +
      convert_materials<gltf_specgloss_to_gltf, gltf_specgloss_to_gltf_khronos,
                        specular_to_metallic_mean_sztrajman_2019,
                        specular_to_metallic_network_sztrajman_2019>(values) +
      convert_material<gltf_to_gltf_specgloss>(
          1, {{values, values + 1, values + 2}, values + 3, values + 4},
          {{values, values + 1, values + 2}, {values + 3, values + 4, values + 5}, values + 6});
  return wrong < 100 ? 0 : 1;
}
