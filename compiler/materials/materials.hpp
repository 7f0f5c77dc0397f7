// This file writes translations of whole materials as C++, as a Python module and as node graphs of
// MaterialX.
#pragma once

#include <string>

#include "materials/description.hpp"

namespace remap {

// Returns a C++17 header: a struct for each model, a function for each translation, and translate_texels()
// for rows of maps.
std::string materials_header(const MaterialLibrary& library);

// Returns a Python module that needs only NumPy: MODELS, TRANSLATIONS, IGNORED, and a function for each
// translation.
std::string materials_module(const MaterialLibrary& library);

// Returns node definitions. MaterialX' ShaderTranslator finds them by the names of their nodes. Models
// without a node in MaterialX (Blender's) are left out.
std::string materials_graphs(const MaterialLibrary& library);

// Returns the lines of a comment in a language whose comments begin with `mark`.
std::string commented(const std::string& comment, const std::string& indent, const std::string& mark);

}  // namespace remap
