// The options of `texremap convert`, as the user gave them.
#pragma once

#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "remap/named_values.hpp"

namespace remap {

struct ConvertOptions {
  std::string folder;  // of texture sets; empty where the options name one set
  std::string names;
  bool recursive = false;
  bool dry_run = false;
  bool resume = false;
  bool copy_others = false;
  bool resample = false;
  std::string from;
  std::string to;
  std::string from_workflow;
  std::string to_workflow;
  std::string dielectric_f0;
  std::string diffuse_convention;
  std::string formula;
  std::string prior;
  std::vector<std::string> via;
  std::string fit;
  std::string roughness;
  std::string glossiness;
  std::string specular;
  std::string occlusion;
  std::string metallic;
  std::string diffuse;
  std::string base_color;
  std::string metal_mask;
  std::string layout;
  std::string roughness_factor;
  std::string specular_factor;
  std::string encoding;
  std::string output_encoding;
  std::string color_space;
  std::string output_color_space;
  std::string only;
  std::string bad_texels = "keep";
  std::string mask;
  std::string residual;
  std::string metallic_width;
  std::string doubts;
  std::string output;
  std::string format;
  std::string type;
  std::string instructions;
  int thread_count = 0;
  bool dither = false;
  bool smooth_metallic = false;
  bool force = false;
  bool allow_skips = false;
  bool histograms = false;
  bool json = false;
  bool quiet = false;
};

void add_convert_options(Command& command, ConvertOptions& options);

// Throws kUsage: `option` got `word`, but the `known` names of a `noun` are others.
[[noreturn]] void fail_unknown(const std::string& option, const std::string& noun, const std::string& word,
                               const std::vector<std::string>& known);

// The value that `word` names. Throws as above if it names none.
template <typename Value, std::size_t Count>
Value chosen_value(const NamedValues<Value, Count>& table, const std::string& option, const std::string& noun,
                   const std::string& word) {
  const auto value = value_named(table, word);
  if (!value) fail_unknown(option, noun, word, names_of(table));
  return *value;
}

}  // namespace remap
