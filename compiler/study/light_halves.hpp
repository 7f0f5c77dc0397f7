// The lights by which constants are chosen, and those that judge them.
#pragma once

#include <filesystem>
#include <vector>

#include "command_line/command.hpp"
#include "study/short_forms.hpp"

namespace remap {

// Adds `--environment`.
void add_light_halves_option(Command& command, std::vector<std::filesystem::path>& files);

// Every other map, by name, chooses. The rest, and the built-in ones, judge. Without maps the built-in sky
// chooses alone.
void set_light_halves(std::vector<std::filesystem::path> files, ShortFormsOptions& options);

}  // namespace remap
