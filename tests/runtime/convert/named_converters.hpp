// This file makes converters that only have descriptions, and graphs of them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "remap/path.hpp"

namespace remap {

// A NamedConverters has converters for width 0 to 1 and specular from 0, without fit errors. Their expected
// error is the image error. They do not change width and specular.
class NamedConverters {
 public:
  // Returns the description of a converter, which can be changed before it is added.
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
