// The commands of texremap. Each has a file of its own.
#pragma once

namespace CLI {
class App;
}

namespace remap {

void add_convert_command(CLI::App& app);
void add_list_command(CLI::App& app);
void add_path_command(CLI::App& app);

}  // namespace remap
