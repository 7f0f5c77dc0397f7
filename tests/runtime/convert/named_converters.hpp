// Converters that only say what they are, and graphs of them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "remap/path.hpp"

namespace remap {

// Converters of width 0 to 1 and specular from 0, without fit errors: what is expected of each is its image
// error. They keep width and specular.
class NamedConverters {
 public:
  // What a converter says of itself, to be added as it is or with changes.
  static ConverterInfo info(const std::string& source, const std::string& target,
                            std::optional<double> image_error) {
    ConverterInfo made;
    made.id = converter_id(source, target);
    made.source.model = source;
    made.target.model = target;
    made.roughness = made.specular = {0.0, 1.0};
    made.image_rms_error = image_error;
    return made;
  }
  void add(ConverterInfo made) { all_.push_back(std::make_unique<Converter>(std::move(made), StageList{})); }
  std::vector<const Converter*> pointers() const {
    std::vector<const Converter*> pointers;
    for (const auto& converter : all_) pointers.push_back(converter.get());
    return pointers;
  }

 private:
  std::vector<std::unique_ptr<Converter>> all_;
};

}  // namespace remap
