// This program contains the lines for Blender's OBJ import. Its headers are in no package, so float3 and
// MTLMaterial here have only the members that are used.
#include <algorithm>
#include <cmath>
#include <cstdio>

struct float3 {
  float values[3];
  explicit float3(float all) : values{all, all, all} {}
  float& operator[](int i) { return values[i]; }
  float operator[](int i) const { return values[i]; }
};
struct MTLMaterial {
  float spec_exponent;
  float3 spec_color;
};

int main() {
  const MTLMaterial mtl_mat{96.08f, float3(0.5f)};
  float roughness = 1.0f, ior = 1.5f;
  // lines 0
  std::printf("%.3f %.4f %.2f %.3f\n", roughness, f, ior, 0.64f / (1.0f - f));
}
