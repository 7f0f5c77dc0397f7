#include "assets/obj_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <unordered_map>
#include <utility>

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include "assets/mtl_document.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"
#include "core/report_text.hpp"

namespace remap {
namespace {

// Rewrites an OBJ for the importer, which takes names of materials to end at a space and does not join lines:
// materials become numbers, and lines that are not geometry go.
class ObjText {
 public:
  ObjText(std::string_view text, const std::string& place, ObjScene& scene)
      : text_(text), place_(place), scene_(scene) {
    materials_.push_back({"", false});
    result_.reserve(text.size() + 16);
    result_ += "mtllib materials\n";
  }

  std::string run() {
    constexpr std::string_view kMark = "\xef\xbb\xbf";
    for (std::size_t at = text_.starts_with(kMark) ? kMark.size() : 0; at < text_.size();) at = add_line(at);
    if (dropped_ > 0)
      scene_.warnings.push_back(counted(dropped_, "line") + " of points, lines, curves or surfaces left out");
    if (small_ > 0)
      scene_.warnings.push_back(counted(small_, "face") + " of fewer than three corners left out");
    if (fans_ > 0)
      scene_.warnings.push_back(counted(fans_, "polygon") + " of more than " +
                                std::to_string(kMostClippedCorners) +
                                " corners cut as fans, which is right where they are convex");
    return std::move(result_);
  }

  // By their numbers, of which 0 is that of faces without one.
  const std::vector<ObjMaterialName>& materials() const { return materials_; }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

  // Appends the line as it counts, with lines joined that a backslash joins. Returns where the next begins.
  std::size_t read_line(std::size_t begin) {
    line_.clear();
    for (std::size_t at = begin;;) {
      const std::size_t end = std::min(text_.find_first_of("\r\n", at), text_.size());
      const std::string_view part = text_.substr(at, end - at);
      const bool is_comment = line_.empty() && part.starts_with('#');
      line_ += part;
      at = end;
      if (at < text_.size()) at += text_.substr(at, 2) == "\r\n" ? 2 : 1;
      if (is_comment || end >= text_.size() || !part.ends_with('\\')) return at;
      line_.back() = ' ';
    }
  }

  std::size_t add_line(std::size_t begin) {
    const std::size_t next = read_line(begin);
    // The importer takes a line to end at a NUL.
    std::ranges::replace(line_, '\0', ' ');
    std::size_t first = 0, last = line_.size();
    while (first < last && is_space(line_[first])) ++first;
    while (last > first && is_space(line_[last - 1])) --last;
    const std::string_view line = std::string_view(line_).substr(first, last - first);
    std::size_t word_end = 0;
    while (word_end < line.size() && !is_space(line[word_end])) ++word_end;
    std::size_t rest = word_end;
    while (rest < line.size() && is_space(line[rest])) ++rest;
    add_statement(line, line.substr(0, word_end), line.substr(rest));
    return next;
  }

  void add_statement(std::string_view line, std::string_view word, std::string_view rest) {
    constexpr std::array<std::string_view, 3> kGeometry = {"v", "vn", "vt"};
    constexpr std::array<std::string_view, 6> kDropped = {"p", "l", "curv", "curv2", "surf", "mg"};
    if (std::ranges::find(kGeometry, word) != kGeometry.end()) return pass(bounded(line));
    if (word == "o" || (word == "g" && rest.empty())) return pass("o " + std::string(rest));
    if (word == "g") return pass(line);
    if (word == "f" || word == "fo") return add_face(rest);
    if (word == "usemtl") return pass("usemtl " + std::to_string(number_of(std::string(rest))));
    if (word == "mtllib") scene_.libraries.emplace_back(rest);
    dropped_ += std::ranges::find(kDropped, word) != kDropped.end();
  }

  // The importer takes exponents of ten digits for whole numbers of 32 bits. No coordinate has six.
  std::string_view bounded(std::string_view line) const {
    constexpr std::size_t kMostDigits = 5;
    std::size_t digits = 0;
    bool is_exponent = false;
    for (const char c : line) {
      const bool is_digit_of_exponent = is_exponent && c >= '0' && c <= '9';
      digits = is_digit_of_exponent ? digits + 1 : 0;
      is_exponent = c == 'e' || c == 'E' || (is_exponent && (is_digit_of_exponent || c == '-' || c == '+'));
      if (digits > kMostDigits)
        throw input_error(place_ + ": " + plain(line, 80) + ": its exponent is too large");
    }
    return line;
  }

  void add_face(std::string_view rest) {
    std::vector<std::string_view> corners;
    for (std::size_t at = 0; at < rest.size();) {
      const std::size_t begin = at;
      while (at < rest.size() && !is_space(rest[at])) ++at;
      corners.push_back(rest.substr(begin, at - begin));
      while (at < rest.size() && is_space(rest[at])) ++at;
    }
    small_ += corners.size() < 3;
    if (corners.size() <= kMostClippedCorners) return pass("f " + std::string(rest));
    ++fans_;
    for (std::size_t i = 2; i < corners.size(); ++i)
      ((((((result_ += "f ") += corners[0]) += ' ') += corners[i - 1]) += ' ') += corners[i]) += '\n';
  }

  void pass(std::string_view line) { (result_ += line) += '\n'; }

  std::size_t number_of(const std::string& name) {
    const auto [entry, is_new] = numbers_.try_emplace(name, materials_.size());
    if (is_new) materials_.push_back({name, true});
    return entry->second;
  }

  std::string_view text_;
  const std::string& place_;
  ObjScene& scene_;
  std::string line_, result_;
  std::size_t dropped_ = 0, small_ = 0, fans_ = 0;
  std::vector<ObjMaterialName> materials_;
  std::map<std::string, std::size_t> numbers_;
};

// Says to the importer that every number is a material.
class NumberedMaterials final : public tinyobj::MaterialReader {
 public:
  explicit NumberedMaterials(std::size_t count) : count_(count) {}
  bool operator()(const std::string&, std::vector<tinyobj::material_t>*, std::map<std::string, int>* numbers,
                  std::string*, std::string*) override {
    for (std::size_t i = 0; i < count_; ++i) numbers->emplace(std::to_string(i), static_cast<int>(i));
    return true;
  }

 private:
  std::size_t count_;
};

// Text in memory, without a copy.
class MemoryBuffer final : public std::streambuf {
 public:
  explicit MemoryBuffer(std::string& text) { setg(text.data(), text.data(), text.data() + text.size()); }
};

struct ObjCorner {
  int position, texcoord, normal;
  bool operator==(const ObjCorner&) const = default;
};
struct ObjCornerHash {
  std::size_t operator()(const ObjCorner& corner) const noexcept {
    std::uint64_t hash = 0;
    for (const int part : {corner.position, corner.texcoord, corner.normal})
      hash = (hash ^ static_cast<std::uint32_t>(part)) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(hash ^ hash >> 32);
  }
};

using Vector = std::array<double, 3>;

Vector vector_at(const std::vector<float>& values, std::size_t index) {
  const float* const first = values.data() + index * 3;
  return {static_cast<double>(first[0]), static_cast<double>(first[1]), static_cast<double>(first[2])};
}

// Triangles of one shape and material.
class PrimitiveBuilder {
 public:
  PrimitiveBuilder(const tinyobj::attrib_t& attributes, std::size_t material) : attributes_(attributes) {
    primitive_.material = material;
  }

  void add(const tinyobj::index_t& index) {
    const ObjCorner corner{index.vertex_index, index.texcoord_index, index.normal_index};
    const auto [entry, is_new] =
        vertices_.try_emplace(corner, static_cast<std::uint32_t>(primitive_.vertex_count()));
    primitive_.indices.push_back(entry->second);
    if (!is_new) return;
    append(attributes_.vertices, corner.position, 3, primitive_.positions);
    if (corner.texcoord >= 0) {
      append(attributes_.texcoords, corner.texcoord, 2, primitive_.texcoords);
      primitive_.texcoords.back() = 1.0f - primitive_.texcoords.back();
      has_texcoords_ = true;
    } else {
      primitive_.texcoords.insert(primitive_.texcoords.end(), 2, 0.0f);
    }
    add_normal(corner.normal);
    if (!attributes_.colors.empty()) {
      append(attributes_.colors, corner.position, 3, primitive_.colors);
      for (std::size_t c = 0; c < 3; ++c) {
        float& value = primitive_.colors[primitive_.colors.size() - 3 + c];
        value = std::clamp(value, 0.0f, 1.0f);
      }
    }
  }

  // A normal that is missing or has no direction becomes that of the faces around it.
  ObjPrimitive result() {
    if (!has_texcoords_) primitive_.texcoords.clear();
    if (!has_normals_)
      primitive_.normals.clear();
    else if (lacks_normals())
      fill_normals();
    return std::move(primitive_);
  }
  bool lacks_normals() const {
    return has_normals_ && std::ranges::find(is_lacking_, true) != is_lacking_.end();
  }

 private:
  static void append(const std::vector<float>& from, int index, std::size_t count, std::vector<float>& to) {
    const float* const first = from.data() + static_cast<std::size_t>(index) * count;
    to.insert(to.end(), first, first + count);
  }

  void add_normal(int index) {
    Vector normal{};
    double length = 0.0;
    if (index >= 0) {
      normal = vector_at(attributes_.normals, static_cast<std::size_t>(index));
      length = std::hypot(normal[0], normal[1], normal[2]);
    }
    const bool is_given = std::isfinite(length) && length > 0.0;
    has_normals_ = has_normals_ || is_given;
    is_lacking_.push_back(!is_given);
    for (const double part : normal)
      primitive_.normals.push_back(is_given ? static_cast<float>(part / length) : 0.0f);
  }

  // Products of edges are as long as triangles are large.
  void fill_normals() {
    std::vector<Vector> sums(primitive_.vertex_count());
    for (std::size_t i = 0; i + 2 < primitive_.indices.size(); i += 3) {
      const std::uint32_t* const corner = primitive_.indices.data() + i;
      const Vector a = vector_at(primitive_.positions, corner[0]),
                   b = vector_at(primitive_.positions, corner[1]),
                   c = vector_at(primitive_.positions, corner[2]);
      const Vector u = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
      const Vector product = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                              u[0] * v[1] - u[1] * v[0]};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) sums[corner[k]][axis] += product[axis];
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (!is_lacking_[i]) continue;
      const double length = std::hypot(sums[i][0], sums[i][1], sums[i][2]);
      const bool has_direction = std::isfinite(length) && length > 0.0;
      const Vector normal = has_direction
                                ? Vector{sums[i][0] / length, sums[i][1] / length, sums[i][2] / length}
                                : Vector{0.0, 0.0, 1.0};
      for (std::size_t axis = 0; axis < 3; ++axis)
        primitive_.normals[3 * i + axis] = static_cast<float>(normal[axis]);
    }
  }

  const tinyobj::attrib_t& attributes_;
  ObjPrimitive primitive_;
  std::unordered_map<ObjCorner, std::uint32_t, ObjCornerHash> vertices_;
  std::vector<bool> is_lacking_;  // a normal, by vertex
  bool has_texcoords_ = false, has_normals_ = false;
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& place) : place_(place) {
    if (is_utf16(text)) throw input_error(place + ": is UTF-16 text (save it as UTF-8)");
    if (text.size() > kLongestObj)
      throw input_error(place + ": has " + std::to_string(text.size()) + " bytes; at most " +
                        std::to_string(kLongestObj) + " are read");
    ObjText prepared(text, place, scene_);
    std::string geometry = prepared.run();
    names_ = prepared.materials();
    load(geometry);
  }

  ObjScene scene() {
    for (const tinyobj::shape_t& shape : shapes_) add_shape(shape);
    if (filled_ > 0)
      scene_.warnings.push_back("normals of " + counted(filled_, "mesh part") +
                                " that are missing or have length 0 become those of its faces");
    return std::move(scene_);
  }

 private:
  void load(std::string& geometry) {
    MemoryBuffer buffer(geometry);
    std::istream stream(&buffer);
    NumberedMaterials materials(names_.size());
    std::vector<tinyobj::material_t> none;
    std::string warning, fault;
    const bool is_read =
        tinyobj::LoadObj(&attributes_, &shapes_, &none, &warning, &fault, &stream, &materials, true, false);
    if (!is_read)
      throw input_error(place_ + ": a face cannot be read (its indices must be whole numbers other than 0)");
    if (warning.find("invalid vertex index") != std::string::npos ||
        warning.find("out of bounds") != std::string::npos)
      throw input_error(place_ + ": a face names a vertex, normal or texture coordinate that is not there");
    for (const auto* values : {&attributes_.vertices, &attributes_.texcoords, &attributes_.colors})
      if (!std::ranges::all_of(*values, [](float value) { return std::isfinite(value); }))
        throw input_error(place_ + ": a coordinate is too large for a number of 32 bits");
  }

  void require_within(int index, std::size_t count, bool may_be_missing, const char* name,
                      const std::string& shape) const {
    if (index >= 0 ? static_cast<std::size_t>(index) < count : may_be_missing && index == -1) return;
    throw input_error(place_ + ": a face" + (shape.empty() ? "" : " of \"" + plain(shape, 80) + "\"") +
                      " names a " + name + " that is not there; there are " + std::to_string(count));
  }

  void add_shape(const tinyobj::shape_t& shape) {
    std::map<int, PrimitiveBuilder> builders;
    std::vector<int> order;
    const std::vector<tinyobj::index_t>& indices = shape.mesh.indices;
    for (std::size_t i = 0; i < indices.size(); ++i) {
      require_within(indices[i].vertex_index, attributes_.vertices.size() / 3, false, "vertex", shape.name);
      require_within(indices[i].normal_index, attributes_.normals.size() / 3, true, "normal", shape.name);
      require_within(indices[i].texcoord_index, attributes_.texcoords.size() / 2, true, "texture coordinate",
                     shape.name);
      const int material = std::max(shape.mesh.material_ids[i / 3], 0);
      auto builder = builders.find(material);
      if (builder == builders.end()) {
        builder = builders.try_emplace(material, attributes_, used_material(material)).first;
        order.push_back(material);
      }
      builder->second.add(indices[i]);
    }
    if (order.empty()) return;
    ObjShape& added = scene_.shapes.emplace_back();
    added.name = shape.name;
    for (const int material : order) {
      PrimitiveBuilder& builder = builders.at(material);
      filled_ += builder.lacks_normals();
      added.primitives.push_back(builder.result());
    }
  }

  // Numbers those that faces use.
  std::size_t used_material(int number) {
    const auto [entry, is_new] = used_.try_emplace(number, scene_.materials.size());
    if (is_new) scene_.materials.push_back(names_[static_cast<std::size_t>(number)]);
    return entry->second;
  }

  const std::string& place_;
  ObjScene scene_;
  std::vector<ObjMaterialName> names_;
  std::map<int, std::size_t> used_;
  tinyobj::attrib_t attributes_;
  std::vector<tinyobj::shape_t> shapes_;
  std::size_t filled_ = 0;
};

}  // namespace

std::vector<std::string> obj_libraries(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf", kWord = "mtllib", kSpace = " \t\v\f";
  std::vector<std::string> libraries;
  for (std::size_t at = 0; (at = text.find(kWord, at)) != std::string_view::npos;) {
    std::size_t line = at;
    while (line > 0 && kSpace.find(text[line - 1]) != std::string_view::npos) --line;
    const bool is_first = line == 0 || text[line - 1] == '\n' || text[line - 1] == '\r' ||
                          (line == kMark.size() && text.starts_with(kMark));
    at += kWord.size();
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    std::string_view rest = text.substr(at, end - at);
    if (!is_first || rest.empty() || kSpace.find(rest.front()) == std::string_view::npos) continue;
    rest.remove_prefix(std::min(rest.find_first_not_of(kSpace), rest.size()));
    libraries.emplace_back(rest.substr(0, rest.find_last_not_of(kSpace) + 1));
  }
  return libraries;
}

ObjScene read_obj(std::string_view text, const std::string& place) { return ObjReader(text, place).scene(); }

}  // namespace remap
