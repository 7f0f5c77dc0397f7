#include "assets/obj/obj_mesh.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <istream>
#include <limits>
#include <map>
#include <streambuf>
#include <system_error>
#include <utility>

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include "assets/document/text_edits.hpp"
#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

// The importer triangulates this many faces at once. It needs a hundred bytes for each.
constexpr std::size_t kMostFacesOfPart = std::size_t{1} << 14;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

// ObjLines reads the lines of an OBJ file in order, in blocks. A line is a word and the rest, without
// surrounding white space. A backslash joins lines.
class ObjLines {
 public:
  ObjLines(const ByteSource& source, const std::string& context) : reader_(source, context) {
    if (source.size() > kLongestObj)
      throw input_error(context + ": has " + std::to_string(source.size()) + " bytes, but at most " +
                        std::to_string(kLongestObj) + " can be read (split it into several files)");
    constexpr std::string_view kMark = "\xef\xbb\xbf";
    if (!is_at_end() && block_.starts_with(kMark)) at_ = kMark.size();
  }

  // Goes to the next line. Returns false at the end.
  bool next() {
    if (is_at_end()) return false;
    joined_.clear();
    while (add_line() && !joined_.starts_with('#') && joined_.ends_with('\\')) joined_.back() = ' ';
    // The importer ends a line at a NUL.
    std::ranges::replace(joined_, '\0', ' ');
    line_ = joined_;
    while (!line_.empty() && is_space(line_.front())) line_.remove_prefix(1);
    while (!line_.empty() && is_space(line_.back())) line_.remove_suffix(1);
    word_ = line_.substr(0, static_cast<std::size_t>(std::ranges::find_if(line_, is_space) - line_.begin()));
    rest_ = line_.substr(word_.size());
    while (!rest_.empty() && is_space(rest_.front())) rest_.remove_prefix(1);
    return true;
  }

  std::string_view line() const noexcept { return line_; }
  std::string_view word() const noexcept { return word_; }
  std::string_view rest() const noexcept { return rest_; }

 private:
  bool is_at_end() {
    if (at_ < block_.size()) return false;
    block_ = reader_.next();
    at_ = 0;
    return block_.empty();
  }

  // Appends the text up to a line ending and skips that ending. Returns true if there was one.
  bool add_line() {
    while (!is_at_end()) {
      const auto begin = block_.begin() + static_cast<std::ptrdiff_t>(at_);
      const auto end = std::find_if(begin, block_.end(), [](char c) { return c == '\n' || c == '\r'; });
      joined_.append(begin, end);
      at_ = static_cast<std::size_t>(end - block_.begin());
      if (end == block_.end()) continue;
      const bool may_be_pair = block_[at_++] == '\r';
      if (may_be_pair && !is_at_end() && block_[at_] == '\n') ++at_;
      return true;
    }
    return false;
  }

  TextReader reader_;
  std::string block_, joined_;
  std::size_t at_ = 0;  // place in the block
  std::string_view line_, word_, rest_;
};

// An ObjStream rewrites an OBJ file for the importer (tinyobjloader), which has two limits. It ends the name
// of a material at a space, and it makes one shape of each whole group. So names of materials and groups
// become numbers, large groups are cut, and lines without geometry are dropped.
class ObjStream final : public std::streambuf {
 public:
  // The stream calls `take` before it makes more lines. `take` can then free results of the importer.
  ObjStream(const ByteSource& source, const std::string& context, ObjScene& scene, std::function<void()> take)
      : lines_(source, context), context_(context), scene_(scene), take_(std::move(take)) {
    materials_.emplace_back();
    groups_.emplace_back();
    begin_group();
  }

  void warn() {
    if (dropped_ > 0)
      scene_.warnings.push_back(
          counted(dropped_, "statement") +
          " skipped (only faces are converted, not points, lines, curves and surfaces)");
    if (small_ > 0)
      scene_.warnings.push_back(counted(small_, "face") + " with fewer than three corners skipped");
    if (fans_ > 0)
      scene_.warnings.push_back(
          counted(fans_, "polygon") + " with more than " + std::to_string(kMostClippedCorners) +
          " corners split into fans of triangles, which is only correct for convex polygons");
  }

  // Return the name for a number. Number 0 is for faces without a name.
  const std::optional<std::string>& material(std::size_t number) const { return materials_[number]; }
  const std::string& group(std::size_t number) const { return groups_[number]; }

 protected:
  int_type underflow() override {
    constexpr std::size_t kBlock = std::size_t{1} << 16;
    take_();
    while (made_.size() < kBlock && lines_.next()) add_statement();
    text_.swap(made_);
    made_.clear();
    setg(text_.data(), text_.data(), text_.data() + text_.size());
    return text_.empty() ? traits_type::eof() : traits_type::to_int_type(text_.front());
  }

 private:
  void add_statement() {
    constexpr std::array<std::string_view, 6> kDropped = {"p", "l", "curv", "curv2", "surf", "mg"};
    const std::string_view word = lines_.word(), rest = lines_.rest();
    vertices_ += word == "v" && !rest.empty();
    if (word == "v" || word == "vn" || word == "vt") return pass(bounded(lines_.line()));
    if (word == "o" || word == "g") {
      groups_.push_back(word == "o" ? std::string(rest) : words_of(rest));
      return begin_group();
    }
    if (word == "f" || word == "fo") return add_face(rest);
    if (word == "usemtl") return use_material(std::string(rest));
    if (word == "mtllib") scene_.libraries.emplace_back(rest);
    dropped_ += contains(kDropped, word);
  }

  // Ends the importer's current shape and begins another one. A cut group continues under the same number.
  void begin_group() {
    pass("o " + std::to_string(groups_.size() - 1));
    faces_ = 0;
    farthest_ = 0;
  }

  // Returns the names of several groups, with a space between them.
  static std::string words_of(std::string_view rest) {
    std::string words;
    for (std::size_t at = 0; at < rest.size();) {
      const std::size_t begin = at;
      while (at < rest.size() && rest[at] != ' ' && rest[at] != '\t') ++at;
      (words += words.empty() ? "" : " ") += rest.substr(begin, at - begin);
      while (at < rest.size() && (rest[at] == ' ' || rest[at] == '\t')) ++at;
    }
    return words;
  }

  // Refuses large exponents, because the importer reads their digits into a 32-bit integer. No coordinate
  // needs an exponent of six digits.
  std::string_view bounded(std::string_view line) const {
    constexpr std::size_t kMostDigits = 5;
    std::size_t digits = 0;
    bool is_exponent = false;
    for (const char c : line) {
      const bool is_digit_of_exponent = is_exponent && c >= '0' && c <= '9';
      digits = is_digit_of_exponent ? digits + 1 : 0;
      is_exponent = c == 'e' || c == 'E' || (is_exponent && (is_digit_of_exponent || c == '-' || c == '+'));
      if (digits > kMostDigits)
        throw input_error(context_ + ": " + plain(line, 80) + ": its exponent is too large");
    }
    return line;
  }

  void add_face(std::string_view rest) {
    corners_.clear();
    for (std::size_t at = 0; at < rest.size();) {
      const std::size_t begin = at;
      while (at < rest.size() && !is_space(rest[at])) ++at;
      corners_.push_back(rest.substr(begin, at - begin));
      while (at < rest.size() && is_space(rest[at])) ++at;
    }
    for (const std::string_view corner : corners_) {
      require_indices(corner);
      farthest_ = std::max(farthest_, vertex_of(corner));
    }
    small_ += corners_.size() < 3;
    if (corners_.size() <= kMostClippedCorners) {
      ((made_ += "f ") += rest) += '\n';
    } else {
      ++fans_;
      for (std::size_t i = 2; i < corners_.size(); ++i)
        ((((((made_ += "f ") += corners_[0]) += ' ') += corners_[i - 1]) += ' ') += corners_[i]) += '\n';
    }
    // Cut only if all vertices of the faces are known, because at a cut, the importer triangulates the faces.
    if (++faces_ >= kMostFacesOfPart && farthest_ <= vertices_) begin_group();
  }

  // Throws for an index beyond 32 bits, which the importer would read as another index.
  void require_indices(std::string_view corner) const {
    for (std::size_t at = 0; at < corner.size(); at = std::min(corner.find('/', at), corner.size()) + 1) {
      if (corner[at] == '+') ++at;
      int index = 0;
      const auto result = std::from_chars(corner.data() + at, corner.data() + corner.size(), index);
      if (result.ec == std::errc::result_out_of_range)
        throw input_error(context_ + ": " + plain(lines_.line(), 80) + ": an index is too large");
    }
  }

  // Returns the vertex index of a corner, or the largest number if the index is too large. Returns 0 for a
  // negative index, which counts back from the last vertex and so names a vertex that exists already.
  static std::size_t vertex_of(std::string_view corner) {
    std::size_t number = 0;
    const auto result = std::from_chars(corner.data(), corner.data() + corner.size(), number);
    return result.ec == std::errc::result_out_of_range ? std::numeric_limits<std::size_t>::max() : number;
  }

  void use_material(const std::string& name) {
    const auto [entry, is_new] = numbers_.try_emplace(name, std::to_string(materials_.size()));
    if (is_new) {
      materials_.push_back(name);
      pass("mtllib " + entry->second);
    }
    pass("usemtl " + entry->second);
  }

  void pass(std::string_view line) { (made_ += line) += '\n'; }

  ObjLines lines_;
  const std::string& context_;
  ObjScene& scene_;
  std::function<void()> take_;
  std::string made_, text_;  // lines to come, and the lines that the importer is reading
  std::vector<std::string_view> corners_;
  std::size_t dropped_ = 0, small_ = 0, fans_ = 0;
  std::size_t vertices_ = 0, faces_ = 0, farthest_ = 0;  // farthest_: largest vertex index in this part
  std::vector<std::optional<std::string>> materials_;
  std::vector<std::string> groups_;
  std::map<std::string, std::string> numbers_;  // numbers of materials
};

// NumberedMaterials gives the importer a library whose name is a number and whose only material has this
// number.
class NumberedMaterials final : public tinyobj::MaterialReader {
 public:
  bool operator()(const std::string& name, std::vector<tinyobj::material_t>*,
                  std::map<std::string, int>* numbers, std::string*, std::string*) override {
    numbers->emplace(name, std::stoi(name));
    return true;
  }
};

struct ObjCorner {
  int position, texcoord, normal;
  bool operator==(const ObjCorner&) const = default;
};

// A CornerSet numbers corners that do not repeat. Its table takes a fourth of the memory of a
// std::unordered_map.
class CornerSet {
 public:
  // A new corner gets the next number.
  std::uint32_t number_of(const ObjCorner& corner) {
    if (2 * corners_.size() >= slots_.size()) grow();
    std::uint32_t& slot = slot_of(corner);
    if (slot == kFree) {
      slot = static_cast<std::uint32_t>(corners_.size());
      corners_.push_back(corner);
    }
    return slot;
  }
  const std::vector<ObjCorner>& corners() const noexcept { return corners_; }
  // Frees the table, because no corner follows.
  void finish() { slots_ = std::vector<std::uint32_t>(); }

 private:
  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

  static std::size_t hash_of(const ObjCorner& corner) {
    std::uint64_t hash = 0;
    for (const int part : {corner.position, corner.texcoord, corner.normal})
      hash = (hash ^ static_cast<std::uint32_t>(part)) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(hash ^ hash >> 32);
  }

  std::uint32_t& slot_of(const ObjCorner& corner) {
    std::size_t at = hash_of(corner) % slots_.size();
    while (slots_[at] != kFree && corners_[slots_[at]] != corner) at = (at + 1) % slots_.size();
    return slots_[at];
  }

  void grow() {
    constexpr std::size_t kLeastSlots = 16;
    slots_.assign(std::max(kLeastSlots, 2 * slots_.size()), kFree);
    for (std::size_t i = 0; i < corners_.size(); ++i) slot_of(corners_[i]) = static_cast<std::uint32_t>(i);
  }

  std::vector<ObjCorner> corners_;
  std::vector<std::uint32_t> slots_;  // numbers of corners, each at the place of its hash or after this place
};

using Vector = std::array<double, 3>;

Vector vector_at(const std::vector<float>& values, std::size_t index) {
  const float* const first = values.data() + index * 3;
  return {static_cast<double>(first[0]), static_cast<double>(first[1]), static_cast<double>(first[2])};
}

// An ObjPart holds triangles of one group and material, as corners that do not repeat.
struct ObjPart {
  std::size_t material = 0;
  CornerSet corners;
  std::vector<std::uint32_t> indices;  // numbers of corners
};
struct ObjGroup {
  std::size_t number = 0;
  std::vector<ObjPart> parts;
};

// A PrimitiveMaker makes a part with the attributes of its corners.
class PrimitiveMaker {
 public:
  PrimitiveMaker(const tinyobj::attrib_t& attributes, ObjPart part) : attributes_(attributes) {
    const std::vector<ObjCorner>& corners = part.corners.corners();
    const std::size_t count = corners.size();
    primitive_.material = part.material;
    primitive_.indices = std::move(part.indices);
    has_texcoords_ =
        std::ranges::any_of(corners, [](const ObjCorner& corner) { return corner.texcoord >= 0; });
    primitive_.positions.reserve(3 * count);
    primitive_.normals.reserve(3 * count);
    if (has_texcoords_) primitive_.texcoords.reserve(2 * count);
    if (!attributes_.colors.empty()) primitive_.colors.reserve(3 * count);
    for (const ObjCorner& corner : corners) add(corner);
    if (lacks_normals()) fill_normals();
    if (!has_normals_) primitive_.normals = std::vector<float>();
  }

  bool lacks_normals() const { return has_normals_ && contains(is_lacking_, true); }
  ObjPrimitive result() { return std::move(primitive_); }

 private:
  void add(const ObjCorner& corner) {
    append(attributes_.vertices, corner.position, 3, primitive_.positions);
    if (corner.texcoord >= 0) {
      append(attributes_.texcoords, corner.texcoord, 2, primitive_.texcoords);
      primitive_.texcoords.back() = 1.0f - primitive_.texcoords.back();
    } else if (has_texcoords_) {
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

  // Replaces a missing or zero normal by the mean normal of the faces around it. The weight of a face is its
  // area, because products of edges are proportional to it.
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
  std::vector<bool> is_lacking_;  // vertices that lack a normal
  bool has_texcoords_ = false, has_normals_ = false;
};

class ObjReader {
 public:
  ObjReader(const ByteSource& source, const std::string& context)
      : context_(context), stream_(source, context, scene_, [this] { take_shapes(); }) {}

  ObjScene scene() {
    load();
    std::size_t filled = 0;
    for (ObjGroup& group : groups_) {
      ObjShape& shape = scene_.shapes.emplace_back();
      shape.name = stream_.group(group.number);
      for (ObjPart& part : group.parts) {
        for (const ObjCorner& corner : part.corners.corners()) require_there(corner, shape.name);
        PrimitiveMaker maker(attributes_, std::move(part));
        filled += maker.lacks_normals();
        shape.primitives.push_back(maker.result());
      }
    }
    stream_.warn();
    if (filled > 0)
      scene_.warnings.push_back(
          "normals that are missing or have length 0 become the normals of the faces (" +
          counted(filled, "mesh part") + ")");
    return std::move(scene_);
  }

 private:
  void load() {
    std::istream stream(&stream_);
    stream.exceptions(std::ios::badbit);  // otherwise, the stream would ignore exceptions while it reads
    NumberedMaterials materials;
    std::vector<tinyobj::material_t> none;
    std::string warning, fault;
    const bool is_read =
        tinyobj::LoadObj(&attributes_, &shapes_, &none, &warning, &fault, &stream, &materials, true, false);
    if (!is_read)
      throw input_error(context_ + ": a face cannot be read (its indices must be integers other than 0)");
    if (warning.find("invalid vertex index") != std::string::npos ||
        warning.find("out of bounds") != std::string::npos)
      throw input_error(context_ +
                        ": a face refers to a vertex, normal or texture coordinate that does not exist "
                        "(export the file again)");
    for (const auto* values : {&attributes_.vertices, &attributes_.texcoords, &attributes_.colors})
      if (!std::ranges::all_of(*values, [](float value) { return std::isfinite(value); }))
        throw input_error(context_ + ": a coordinate is too large for a number of 32 bits");
    take_shapes();
    finish_group();
  }

  // Takes the importer's results so far.
  void take_shapes() {
    for (const tinyobj::shape_t& shape : shapes_) add_shape(shape);
    shapes_.clear();
  }

  void add_shape(const tinyobj::shape_t& shape) {
    const std::size_t group = std::stoul(shape.name);
    const std::vector<tinyobj::index_t>& indices = shape.mesh.indices;
    if (indices.empty()) return;
    if (groups_.empty() || groups_.back().number != group) {
      finish_group();
      groups_.push_back({group, {}});
    }
    for (std::size_t i = 0; i < indices.size(); ++i)
      add_corner({indices[i].vertex_index, indices[i].texcoord_index, indices[i].normal_index},
                 std::max(shape.mesh.material_ids[i / 3], 0));
  }

  void add_corner(const ObjCorner& corner, int material) {
    std::vector<ObjPart>& parts = groups_.back().parts;
    const auto [number, is_new_part] = part_of_.try_emplace(material, parts.size());
    if (is_new_part) parts.push_back({used_material(material), {}, {}});
    ObjPart& part = parts[number->second];
    part.indices.push_back(part.corners.number_of(corner));
  }

  void finish_group() {
    part_of_.clear();
    if (groups_.empty()) return;
    for (ObjPart& part : groups_.back().parts) part.corners.finish();
  }

  // Returns the number of a material in the scene. Adds the material if no face has used it before.
  std::size_t used_material(int number) {
    const auto [entry, is_new] = used_.try_emplace(number, scene_.materials.size());
    if (is_new) scene_.materials.push_back(stream_.material(static_cast<std::size_t>(number)));
    return entry->second;
  }

  void require_there(const ObjCorner& corner, const std::string& shape) const {
    require_within(corner.position, attributes_.vertices.size() / 3, false, "vertex", shape);
    require_within(corner.normal, attributes_.normals.size() / 3, true, "normal", shape);
    require_within(corner.texcoord, attributes_.texcoords.size() / 2, true, "texture coordinate", shape);
  }

  void require_within(int index, std::size_t count, bool may_be_missing, const char* name,
                      const std::string& shape) const {
    if (index >= 0 ? static_cast<std::size_t>(index) < count : may_be_missing && index == -1) return;
    throw input_error(context_ + ": a face" + (shape.empty() ? "" : " of \"" + plain(shape, 80) + "\"") +
                      " refers to a " + name + " that does not exist; there are " + std::to_string(count));
  }

  const std::string& context_;
  ObjScene scene_;
  std::map<int, std::size_t> used_;  // keyed by the file's number of a material
  tinyobj::attrib_t attributes_;
  std::vector<tinyobj::shape_t> shapes_;
  std::vector<ObjGroup> groups_;
  std::map<int, std::size_t> part_of_;  // parts of the last group, keyed by the number of its material
  ObjStream stream_;
};

}  // namespace

std::vector<std::string> obj_libraries(const ByteSource& source, const std::string& context) {
  std::vector<std::string> libraries;
  for (ObjLines lines(source, context); lines.next();)
    if (lines.word() == "mtllib" && !lines.rest().empty()) libraries.emplace_back(lines.rest());
  return libraries;
}

ObjScene read_obj(const ByteSource& source, const std::string& context) {
  return ObjReader(source, context).scene();
}

}  // namespace remap
