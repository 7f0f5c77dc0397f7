// The ends of a conversion and their names.
#pragma once

#include <cstddef>
#include <string>

#include "remap/convention.hpp"

namespace remap {

// One end of a conversion: a model and the meaning of its two parameters.
struct ModelSide {
  std::string model;                                            // e.g. "mitsuba/ward"
  RoughnessConvention roughness = RoughnessConvention::kAlpha;  // the model's own width parameter
  std::string specular = "specular";                            // "specular" (plain scale) or "f0"
  bool operator==(const ModelSide&) const = default;
};

// `mitsuba_ward_to_mitsuba_as` for `mitsuba/ward` and `mitsuba/as`: characters that an identifier cannot hold
// become underscores.
std::string converter_id(const std::string& source_model, const std::string& target_model);

// The most letters of an id and of a model: file systems end at 255, of which unfinished files and extensions
// need some.
inline constexpr std::size_t kLongestName = 128;

// What an id must be, for messages.
inline constexpr const char* kIdRule =
    "a C++ identifier of at most 128 letters, without leading or doubled underscore, that C++ does not use "
    "itself";

// Whether `id` can name a namespace and a file: kIdRule. C++ uses keywords, `std` and macros of
// its headers.
bool is_valid_id(const std::string& id);

// Whether `name` can name a model in file names, messages and generated code: letters, digits and `_ - . /`,
// at most kLongestName of them.
bool is_valid_model(const std::string& name);

// Whether `name` can name a specular parameter: an identifier other than the name of a width parameter.
bool is_valid_specular(const std::string& name);

}  // namespace remap
