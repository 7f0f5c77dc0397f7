// What the comments of a table say of how it was made, so that the command can be repeated from them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sweep/photographer.hpp"
#include "sweep/sweep.hpp"

namespace remapc {

using Comments = std::vector<std::pair<std::string, std::string>>;

// One side: the model, its parameters, the law that its specular follows.
void add_side(const std::string& role, const Subject& subject, Comments* comments);

// Who made the pictures, and how they were compared.
void add_comparison(const Renderer& renderer, const PairOptions& options, Comments* comments);

void add_resolution(const PairOptions& options, Comments* comments);

}  // namespace remapc
