// This file writes the comments of a table that record how it was made, so that anybody can make it again.
#pragma once

#include <string>

#include "measure/picture_taker.hpp"
#include "measure/sweep_options.hpp"
#include "renderer/steady_renderer.hpp"
#include "table/light.hpp"
#include "table/table.hpp"

namespace remap {

// Adds one side: the model, its parameters and the law of its specular.
void add_side(const std::string& role, const ProbedModel& probed_model, Comments* comments);

// Adds the limits of the target, which must be known.
void add_limits(const Limits& limits, Comments* comments);

// Adds the widths of one side that change its pictures, `effective`, if some of the widths `all` do not.
void add_widths(const std::string& role, const Range& all, const Range& effective, Comments* comments);

// Adds the noise of one side and the number of pictures that are averaged, if the noise was measured.
void add_noise(const std::string& role, const SteadyRenderer& renderer, const std::string& model,
               Comments* comments);

// Adds the renderer's version and how pictures were compared.
void add_comparison(const Renderer& renderer, const PairOptions& options, Comments* comments);

// Adds the factor between the lights. If a user had to accept it, adds this, too.
void add_light_scale(const LightMatch& match, Comments* comments);

void add_resolution(const PairOptions& options, Comments* comments);

// Returns the alpha below which the highlight of a headlight has a radius of less than one pixel sample, so
// that the picture no longer resolves it.
double subpixel_alpha(int resolution, int samples_per_axis);

}  // namespace remap
