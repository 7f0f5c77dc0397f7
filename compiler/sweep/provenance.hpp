// What the comments of a table say of how it was made, so that the command can be repeated from them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "probe/picture_taker.hpp"
#include "renderer/steady_renderer.hpp"
#include "sweep/sweep_options.hpp"

namespace remapc {

using Comments = std::vector<std::pair<std::string, std::string>>;

// One side: the model, its parameters, the law that its specular follows.
void add_side(const std::string& role, const ProbedModel& probed_model, Comments* comments);

// Widths of one side that change its pictures, where not all do.
void add_widths(const std::string& role, const EffectiveWidths& widths, Comments* comments);

// What another seed does to the pictures of one side, and how many are averaged; where that was measured.
void add_noise(const std::string& role, const SteadyRenderer& renderer, const std::string& model,
               Comments* comments);

// Who made the pictures, and how they were compared.
void add_comparison(const Renderer& renderer, const PairOptions& options, Comments* comments);

void add_resolution(const PairOptions& options, Comments* comments);

// Width below which a highlight under the headlight has a radius of less than one pixel sample, so that a
// picture no longer resolves it.
double subpixel_alpha(int resolution, int samples_per_axis);

}  // namespace remapc
