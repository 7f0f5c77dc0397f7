// The commands of texremap, one file each.
#pragma once

namespace CLI {
class App;
}

namespace remap {

void add_convert_command(CLI::App& app);
void add_list_command(CLI::App& app);
void add_path_command(CLI::App& app);

}  // namespace remap
