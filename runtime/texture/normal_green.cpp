#include "texture/normal_green.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "texture/image_reader.hpp"

namespace remap {
namespace {

// The first word of each pair means green up, the second green down.
constexpr std::array<std::array<std::string_view, 2>, 7> kGreenWords = {{{"OpenGL", "DirectX"},
                                                                         {"opengl", "directx"},
                                                                         {"Opengl", "Directx"},
                                                                         {"GL", "DX"},
                                                                         {"gl", "dx"},
                                                                         {"OGL", "DX"},
                                                                         {"ogl", "dx"}}};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// Returns true if the `size` letters at `at` are a word, as in x_gl_4k and NormalGL. Returns false in x_glass
// and angl.
bool is_green_word(std::string_view name, std::size_t at, std::size_t size) {
  const std::string_view before = name.substr(0, at), after = name.substr(at + size);
  if (!after.empty() && is_letter(after.front())) return false;
  return size > 3 || before.empty() || !is_letter(before.back()) || before.ends_with("ormal");
}

std::size_t green_channel(const ImageReader& image) {
  const std::vector<Channel>& channels = image.layout().channels;
  const auto named = std::ranges::find(channels, "G", &Channel::name);
  if (named != channels.end()) return static_cast<std::size_t>(named - channels.begin());
  if (channels.size() < 3)
    throw input_error(image.path().string() +
                      ": has no green channel to invert (give a normal map with three channels)");
  return 1;
}

// Calls `work(first_row, row_count, texels)` for bands of rows.
void for_bands(ImageReader& image, const auto& work) {
  constexpr int kRows = 64;
  const ImageLayout& layout = image.layout();
  const int most = layout.tile_height > 0 ? layout.tile_height : kRows;
  std::vector<std::byte> texels(static_cast<std::size_t>(most) * layout.row_bytes());
  for (int first = 0; first < layout.height; first += most) {
    const int count = std::min(most, layout.height - first);
    image.read_rows(first, count, texels.data());
    work(first, count, texels.data());
  }
}

// Calls `work(view, row, values)` for each row of a channel in a band.
void for_values(std::byte* texels, int row_count, const ImageLayout& layout, std::size_t channel,
                const auto& work) {
  const ChannelView view = channel_view(texels, layout, channel);
  std::vector<float> values(static_cast<std::size_t>(layout.width));
  for (std::size_t y = 0; y < static_cast<std::size_t>(row_count); ++y) {
    const Segment row{0, y, values.size()};
    load(view, row, values.data());
    work(view, row, values);
  }
}

bool has_negative(ImageReader& image) {
  bool found = false;
  for_bands(image, [&](int, int count, std::byte* texels) {
    for (std::size_t c = 0; c < image.layout().channels.size(); ++c)
      for_values(texels, count, image.layout(), c,
                 [&](const ChannelView&, const Segment&, const std::vector<float>& values) {
                   found = found || std::ranges::any_of(values, [](float value) { return value < 0.0f; });
                 });
  });
  return found;
}

// Calls `take(words, way, at)` for the first word of a name that states a direction: its row and column in
// kGreenWords, and its place in the name.
void for_green_word(const std::string& name, const auto& take) {
  for (const auto& words : kGreenWords)
    for (const std::size_t way : {0u, 1u})
      for (std::size_t at = name.find(words[way]); at != std::string::npos;
           at = name.find(words[way], at + 1))
        if (is_green_word(name, at, words[way].size())) return take(words, way, at);
}

}  // namespace

std::optional<NormalGreen> stated_green(const std::string& name) {
  std::optional<NormalGreen> green;
  for_green_word(name, [&](const auto&, std::size_t way, std::size_t) {
    green = way == 0 ? NormalGreen::kUp : NormalGreen::kDown;
  });
  return green;
}

std::string turned_name(const std::string& name) {
  std::string turned = name;
  for_green_word(name, [&](const auto& words, std::size_t way, std::size_t at) {
    turned.replace(at, words[way].size(), words[1 - way]);
  });
  return turned;
}

std::unique_ptr<NewImage> turned_copy(const std::shared_ptr<const InputFile>& from,
                                      const std::filesystem::path& to) {
  std::vector<ImageReader> images;
  images.emplace_back(from, 0);
  for (int part = 1; part < images.front().part_count(); ++part) images.emplace_back(from, part);
  std::vector<NewPart> parts;
  for (const ImageReader& image : images) parts.push_back({&image.stored(), {}});
  create_parent(to);
  std::unique_ptr<NewImage> turned = image_library().create(to, parts);
  for (std::size_t part = 0; part < images.size(); ++part) {
    ImageReader& image = images[part];
    const std::size_t green = green_channel(image);
    const float whole = has_negative(image) ? 0.0f : 1.0f;
    for (int level = 0; level < turned->level_count(static_cast<int>(part)); ++level) {
      image.select_level(level);
      turned->select(static_cast<int>(part), level);
      for_bands(image, [&](int first, int count, std::byte* texels) {
        for_values(texels, count, image.layout(), green,
                   [&](const ChannelView& view, const Segment& row, std::vector<float>& values) {
                     for (float& value : values) value = whole - value;
                     store(view, row, values.data());
                   });
        turned->write_rows(first, count, texels);
      });
    }
  }
  turned->finish();
  return turned;
}

}  // namespace remap
