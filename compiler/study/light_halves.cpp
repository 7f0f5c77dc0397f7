#include "study/light_halves.hpp"

#include <algorithm>

#include "study/study_options.hpp"

namespace remap {

void add_light_halves_option(Command& command, std::vector<std::filesystem::path>& files) {
  command
      .add_option("--environment", files,
                  "Environment map, repeatable: every other one chooses constants, the rest judges with the "
                  "built-in ones; default: the built-in ones, of which the sky chooses")
      ->allow_extra_args(false);
}

void set_light_halves(std::vector<std::filesystem::path> files, ShortFormsOptions& options) {
  std::vector<Environment> built_in = read_environments({});
  if (files.empty()) {
    options.choosing = {built_in[0]};
    options.judging = {built_in[1], built_in[2]};
    return;
  }
  std::ranges::sort(files);
  std::vector<Environment> maps = read_environments({files, 1.0});
  for (std::size_t i = 0; i < maps.size(); ++i)
    (i % 2 == 0 ? options.choosing : options.judging).push_back(std::move(maps[i]));
  for (Environment& environment : built_in) options.judging.push_back(std::move(environment));
}

}  // namespace remap
