// Translations of whole materials as C++, as a Python module and as node graphs of MaterialX.
#pragma once

#include <string>

#include "materials/description.hpp"

namespace remap {

// A header of C++17: a struct for each model, a function for each translation, and rows of maps.
std::string materials_header(const MaterialLibrary& library);

// A module that needs NumPy only: MODELS, TRANSLATIONS, IGNORED, and a function for each translation.
std::string materials_module(const MaterialLibrary& library);

// Node definitions that MaterialX' ShaderTranslator finds by the names of their nodes. Translations to or
// from models without a node of their own (Blender's) are left out.
std::string materials_graphs(const MaterialLibrary& library);

// The lines of a comment in a language whose comments begin with `mark`.
std::string commented(const std::string& comment, const std::string& indent, const std::string& mark);

}  // namespace remap
