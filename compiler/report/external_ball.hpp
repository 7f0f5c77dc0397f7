// This file renders textured balls by external renderers.
#pragma once

#include <string>
#include <vector>

#include "look/lit_sphere.hpp"
#include "renderer/renderer.hpp"

namespace remap {

// Returns the first of `models` that shows the diffuse part of materials whose own model has none: it has
// maps, and no highlight at specular 0. Returns null if all models lack this.
const ModelDescription* diffuse_model(const std::vector<ModelDescription>& models);

// Adds a note, unless `notes` has it.
void add_note(std::vector<std::string>& notes, std::string note);

// Renders a ball by its external model, lit by the environment of `scene`. Light bounces once, so a model
// without a diffuse part gets the picture of diffuse_model() added. `models` are all models of its renderer.
// Adds what the picture does not show to `notes`, unless they have it. Returns linear RGB like
// render_textured(). Throws like Renderer.
std::vector<float> render_external(const Renderer& renderer, const std::vector<ModelDescription>& models,
                                   const TexturedBall& ball, const Scene& scene,
                                   std::vector<std::string>& notes);

}  // namespace remap
