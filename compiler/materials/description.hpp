// This file describes whole materials of two models, and the statements that translate one model into the
// other. Translations are written as C++, as a Python module and as node graphs of MaterialX.
//
// A model is a list of inputs with their defaults (descriptions/models.txt). A translation is a file of
// statements, descriptions/FROM_to_TO.txt:
//
//   # A comment says why, and how large the error is.
//   w = source.coat_weight
//   target.coat = w > 0 ? w : 0
//
// A value is a number or a color. Operations with a color work on each channel. Operators are + - * /, ^ with
// an exponent of 2 to 4, and `a > b ? x : y` or `a == b ? x : y` of numbers. Functions are min, max, mix(a,
// b, t), pow, sqrt, exp, largest(color), channel(color, 0), color(number), and the functions that
// descriptions/functions.txt defines: `f0(n) = ...`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formula/expression.hpp"

namespace remap {

struct MaterialInput {
  std::string name;
  ValueType type = ValueType::kNumber;
  std::vector<float> value;  // the default: one number, or three for a color
};

struct MaterialModel {
  std::string id;     // name of the node in MaterialX, such as `open_pbr_surface`, if there is one
  std::string title;  // name and version
  std::vector<MaterialInput> inputs;

  const MaterialInput* find(std::string_view name) const;
};

struct Translation {
  const MaterialModel* from = nullptr;
  const MaterialModel* to = nullptr;
  std::string variant;  // such as `_specular`, if this is a second translation between the same models
  std::string comment;  // the comment at the top of the file
  // The name of a source's input is `source.x`, and the name of a target's input is `target.x`.
  std::vector<Statement> lines;

  std::string id() const { return from->id + "_to_" + to->id + variant; }
  // Returns the inputs of the source that no statement uses.
  std::vector<std::string> ignored() const;
};

struct MaterialLibrary {
  std::vector<MaterialModel> models;
  std::vector<FormulaFunction> functions;
  std::vector<Translation> translations;
};

// These functions throw kInput with the line and what is wrong in it. `name` is the name of the file, for
// messages.
std::vector<MaterialModel> parse_models(std::string_view text, const std::string& name);
std::vector<FormulaFunction> parse_functions(std::string_view text, const std::string& name);
Translation parse_translation(std::string_view text, const std::string& name, const MaterialModel& from,
                              const MaterialModel& to, const std::vector<FormulaFunction>& functions);

// Returns the descriptions that are compiled into the program.
const MaterialLibrary& material_library();

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
