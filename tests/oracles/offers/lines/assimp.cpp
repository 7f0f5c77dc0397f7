// This program contains the lines for assimp's glTF export. assimp reads the material from an MTL file, and
// its types are the input. The output has the members of glTF2Asset.h, which is in no package. There, `vec3`
// and `vec4` are also arrays of float.
#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cmath>
#include <cstdio>

struct MaterialSpecular {
  float specularFactor;
  float specularColorFactor[3];
};
struct PbrMetallicRoughness {
  float baseColorFactor[4];
  float roughnessFactor;
};
struct Material {
  PbrMetallicRoughness pbrMetallicRoughness;
};

int main(int, char** arguments) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(arguments[1], 0);
  if (scene == nullptr) return 1;
  for (unsigned i = 0; i < scene->mNumMaterials; ++i) {
    const aiMaterial& mat = *scene->mMaterials[i];
    aiColor4D specularColor, diffuse;
    float shininess = 0.0f;
    if (mat.Get(AI_MATKEY_COLOR_SPECULAR, specularColor) != AI_SUCCESS ||
        mat.Get(AI_MATKEY_SHININESS, shininess) != AI_SUCCESS ||
        mat.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) != AI_SUCCESS)
      return 1;
    MaterialSpecular specular{};
    Material material{{{diffuse.r, diffuse.g, diffuse.b, 1.0f}, 0.0f}};
    Material* m = &material;
    // lines 0
    if (mat.GetName() == aiString("paint"))
      std::printf("%.3f %.4f %.0f %.3f\n", m->pbrMetallicRoughness.roughnessFactor, specular.specularFactor,
                  specular.specularColorFactor[0], m->pbrMetallicRoughness.baseColorFactor[0]);
  }
}
