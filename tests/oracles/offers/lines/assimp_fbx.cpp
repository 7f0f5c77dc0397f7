// This program contains the lines for assimp's FBX import. The numbers come from an aiMaterial, as the
// converter writes them.
#include <algorithm>
#include <assimp/material.h>
#include <cmath>
#include <cstdio>

int main() {
  for (const float exponent : {96.08f, 400.0f}) {
    aiMaterial material;
    const aiColor3D color(0.5f, 0.5f, 0.5f);
    material.AddProperty(&color, 1, AI_MATKEY_COLOR_SPECULAR);
    material.AddProperty(&exponent, 1, AI_MATKEY_SHININESS);
    aiColor3D read;
    ai_real ShininessExponent = 0;
    if (material.Get(AI_MATKEY_COLOR_SPECULAR, read) != AI_SUCCESS ||
        material.Get(AI_MATKEY_SHININESS, ShininessExponent) != AI_SUCCESS)
      return 1;
    const ai_real ks = read.r;
    // lines 1
    std::printf("%.3f ", roughness);
    if (exponent == 96.08f) std::printf("%.4f ", f0);
  }
}
