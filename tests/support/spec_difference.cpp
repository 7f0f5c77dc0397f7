#include "support/spec_difference.hpp"

#include <cstring>

namespace remap {
namespace {

const std::string kNothing = "nothing";

std::string type_name(OIIO::TypeDesc type) { return type.c_str(); }

std::string text(const OIIO::ParamValue* value) {
  return value == nullptr ? kNothing : type_name(value->type()) + " " + std::string(value->get_string());
}

// Compares strings by their characters, because they are pointers, and everything else by its bytes.
bool same_value(const OIIO::ParamValue& a, const OIIO::ParamValue& b) {
  if (a.type() != b.type()) return false;
  if (a.type().basetype == OIIO::TypeDesc::STRING) return a.get_string(1 << 20) == b.get_string(1 << 20);
  return a.datasize() == b.datasize() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.datasize())) == 0;
}

const OIIO::ParamValue* find(const OIIO::ImageSpec& spec, const OIIO::ParamValue& value) {
  for (const OIIO::ParamValue& other : spec.extra_attribs)
    if (other.name() == value.name()) return &other;
  return nullptr;
}

std::string text(const OIIO::ROI& window) {
  return std::to_string(window.width()) + " x " + std::to_string(window.height()) + " from " +
         std::to_string(window.xbegin) + ", " + std::to_string(window.ybegin);
}

std::string channels(const OIIO::ImageSpec& spec) {
  std::string all;
  for (int c = 0; c < spec.nchannels; ++c)
    all += (c == 0 ? "" : ", ") + std::string(spec.channel_name(c)) + " " + type_name(spec.channelformat(c));
  return all;
}

std::string roles(const OIIO::ImageSpec& spec) {
  return "alpha " + std::to_string(spec.alpha_channel) + ", z " + std::to_string(spec.z_channel);
}

std::string tiles(const OIIO::ImageSpec& spec) {
  return std::to_string(spec.tile_width) + " x " + std::to_string(spec.tile_height) + " x " +
         std::to_string(spec.tile_depth);
}

}  // namespace

std::vector<SpecDifference> differences(const OIIO::ImageSpec& before, const OIIO::ImageSpec& after) {
  std::vector<SpecDifference> all;
  for (const OIIO::ParamValue& value : before.extra_attribs) {
    const OIIO::ParamValue* other = find(after, value);
    if (other == nullptr || !same_value(value, *other))
      all.push_back({value.name().string(), text(&value), text(other)});
  }
  for (const OIIO::ParamValue& value : after.extra_attribs)
    if (find(before, value) == nullptr) all.push_back({value.name().string(), kNothing, text(&value)});
  const auto compare = [&all](const std::string& name, const std::string& a, const std::string& b) {
    if (a != b) all.push_back({name, a, b});
  };
  compare("data window", text(before.roi()), text(after.roi()));
  compare("display window", text(before.roi_full()), text(after.roi_full()));
  compare("tiles", tiles(before), tiles(after));
  compare("channels", channels(before), channels(after));
  compare("pixel type", type_name(before.format), type_name(after.format));
  compare("roles of channels", roles(before), roles(after));
  compare("deep", before.deep ? "yes" : "no", after.deep ? "yes" : "no");
  return all;
}

}  // namespace remap
