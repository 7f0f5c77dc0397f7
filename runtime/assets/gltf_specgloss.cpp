#include "assets/gltf_specgloss.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "assets/gltf_images.hpp"
#include "assets/specgloss_factors.hpp"
#include "assets/specgloss_material.hpp"
#include "assets/specgloss_textures.hpp"
#include "assets/text_edits.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "core/report_text.hpp"

namespace remap {
namespace {

constexpr std::string_view kCoreMember = "pbrMetallicRoughness", kUnlit = "KHR_materials_unlit",
                           kSpecularExtension = "KHR_materials_specular", kIorExtension = "KHR_materials_ior",
                           kPointer = "KHR_animation_pointer";

// Extensions that change what a material reflects. They were ignored beside spec-gloss.
constexpr std::array<std::string_view, 10> kReflecting = {
    "KHR_materials_anisotropy", "KHR_materials_clearcoat", "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion", "KHR_materials_ior",       "KHR_materials_iridescence",
    "KHR_materials_sheen",      "KHR_materials_specular",  "KHR_materials_transmission",
    "KHR_materials_volume"};

// Extensions of Khronos, and those of several vendors, that concern no material, or whose materials stay as
// they are.
constexpr std::array<std::string_view, 23> kKnownExtensions = {"EXT_lights_image_based",
                                                               "EXT_lights_ies",
                                                               "EXT_mesh_gpu_instancing",
                                                               "EXT_mesh_manifold",
                                                               "EXT_meshopt_compression",
                                                               "EXT_texture_avif",
                                                               "EXT_texture_webp",
                                                               "KHR_accessor_float64",
                                                               "KHR_animation_pointer",
                                                               "KHR_draco_mesh_compression",
                                                               "KHR_lights_punctual",
                                                               "KHR_materials_emissive_strength",
                                                               "KHR_materials_pbrSpecularGlossiness",
                                                               "KHR_materials_unlit",
                                                               "KHR_materials_variants",
                                                               "KHR_mesh_quantization",
                                                               "KHR_meshopt_compression",
                                                               "KHR_node_visibility",
                                                               "KHR_texture_basisu",
                                                               "KHR_texture_transform",
                                                               "KHR_xmp_json_ld",
                                                               "MSFT_lod",
                                                               "MSFT_texture_dds"};

bool is_one_of(std::string_view name, const auto& names) {
  return std::ranges::find(names, name) != names.end();
}

[[noreturn]] void fail_material(const std::string& reason) { throw input_error(reason); }

// Reads the factors of one object, and notes those that it clamps.
class FactorReader {
 public:
  FactorReader(SpanValue object, std::vector<std::string>& warnings) : object_(object), warnings_(warnings) {}

  void read(const char* name, FactorText& factor) const {
    if (const SpanValue value = object_.find(name)) factor = read_number(value, name);
  }
  template <std::size_t Count>
  void read(const char* name, std::array<FactorText, Count>& factors) const {
    const SpanValue value = object_.find(name);
    if (!value) return;
    const std::vector<SpanValue> entries = value.children();
    if (!value.is(SpanKind::kList) || entries.size() != Count)
      fail_material(std::string(name) + ": expected a list of " + std::to_string(Count) + " numbers, found " +
                    plain(value.raw(), kExcerptLength));
    for (std::size_t i = 0; i < Count; ++i) factors[i] = read_number(entries[i], name);
  }

 private:
  static constexpr std::size_t kExcerptLength = 40;

  FactorText read_number(SpanValue value, const std::string& name) const {
    const std::optional<double> number = value.number();
    const std::string found = plain(value.raw(), kExcerptLength);
    if (!number) fail_material(name + ": expected a number from 0 to 1, found " + found);
    const double clamped = std::clamp(*number, 0.0, 1.0);
    if (clamped == *number) return {clamped, std::string(value.raw())};
    warnings_.push_back(name + " " + found + " is outside of 0 to 1 and becomes " + number_text(clamped));
    return {clamped, number_text(clamped)};
  }

  SpanValue object_;
  std::vector<std::string>& warnings_;
};

SpecGlossMaterial read_material(SpanValue material, AssetMaterial& report) {
  SpecGlossMaterial read;
  read.material = material;
  const SpanValue extensions = material["extensions"];
  read.extension = extensions[kSpecGlossExtension];
  if (!read.extension.is(SpanKind::kObject))
    fail_material(std::string(kSpecGlossExtension) + ": expected an object");
  if (const SpanValue core = material[kCoreMember]; core && !core.is(SpanKind::kObject))
    fail_material(std::string(kCoreMember) + ": expected an object");
  const FactorReader factors(read.extension, report.warnings);
  factors.read("diffuseFactor", read.diffuse);
  factors.read("specularFactor", read.specular);
  factors.read("glossinessFactor", read.glossiness);
  read.diffuse_texture = read.extension["diffuseTexture"];
  read.specgloss_texture = read.extension["specularGlossinessTexture"];
  read.is_unlit = static_cast<bool>(extensions[kUnlit]);
  return read;
}

// Names what the extension holds and core has no place for, and what beside it takes effect from now on.
void note_extensions(const SpecGlossMaterial& read, AssetMaterial& report) {
  constexpr std::array<std::string_view, 6> kRead = {"diffuseFactor",    "diffuseTexture",
                                                     "specularFactor",   "specularGlossinessTexture",
                                                     "glossinessFactor", "extras"};
  for (const SpanValue& member : read.extension.children()) {
    const std::string name = member.key();
    if (is_one_of(name, kRead)) continue;
    std::string inner;
    if (name == "extensions")
      for (const SpanValue& extension : member.children())
        inner += (inner.empty() ? " (" : ", ") + plain(extension.key());
    report.warnings.push_back("loses " + plain(name) + (inner.empty() ? "" : inner + ")") + " of " +
                              std::string(kSpecGlossExtension));
  }
  for (const SpanValue& extension : read.material["extensions"].children())
    if (const std::string name = extension.key(); is_one_of(name, kReflecting))
      report.warnings.push_back(name + ", ignored beside spec-gloss, takes effect from now on");
}

std::string list_text(const std::vector<std::string>& entries) {
  std::string text;
  for (const std::string& entry : entries) text += (text.empty() ? "" : ",") + entry;
  return "[" + text + "]";
}

// Arithmetic of floats moves a color by less.
constexpr double kSameFactor = 1e-6;

// A channel of base color: the text of diffuse or specular where it is that number.
std::string base_text(float base, const FactorText& diffuse, const FactorText& specular) {
  for (const FactorText* factor : {&diffuse, &specular})
    if (std::fabs(static_cast<double>(base) - factor->value) < kSameFactor) return factor->text;
  return float_text(base);
}

// The texts of a material without textures.
CoreTexts core_texts(const SpecGlossMaterial& read, const MetalRoughFactors& result, bool keeps_diffuse) {
  CoreTexts texts;
  for (std::size_t c = 0; c < 3; ++c)
    texts.base_color[c] = keeps_diffuse ? read.diffuse[c].text
                                        : base_text(result.base_color[c], read.diffuse[c], read.specular[c]);
  texts.base_color[3] = read.diffuse[3].text;
  texts.metallic = float_text(result.metallic);
  texts.roughness = float_text(result.roughness);
  texts.has_metal = result.metallic > 0.0f;
  texts.residual = static_cast<double>(result.residual);
  return texts;
}

std::string becomes_text(const CoreTexts& texts, const SpecGlossMaterial& read, bool is_exact) {
  const bool keeps_texture =
      !texts.base_texture.empty() && read.diffuse_texture && texts.base_texture == read.diffuse_texture.raw();
  std::string text = "base color ";
  if (!texts.base_texture.empty()) text += keeps_texture ? "diffuse map times " : "map times ";
  text += texts.base_color[0] + " " + texts.base_color[1] + " " + texts.base_color[2];
  if (texts.base_color[3] != "1") text += ", alpha " + texts.base_color[3];
  if (read.is_unlit) return text + ", unlit";
  text += ", metallic " + texts.metallic + ", roughness " + texts.roughness;
  if (!texts.metal_rough_texture.empty()) text += is_exact ? " times map" : ", both times map";
  if (is_exact)
    text += std::string(", specular color ") + (texts.specular_texture.empty() ? "" : "map times ") +
            read.specular[0].text + " " + read.specular[1].text + " " + read.specular[2].text;
  return text;
}

// The material of a pointer such as /materials/3/extensions/...; none for other pointers.
std::optional<std::size_t> pointed_material(std::string_view pointer) {
  constexpr std::string_view kStart = "/materials/";
  if (!pointer.starts_with(kStart)) return std::nullopt;
  pointer.remove_prefix(kStart.size());
  std::size_t index = 0;
  const auto [end, failure] = std::from_chars(pointer.data(), pointer.data() + pointer.size(), index);
  if (failure != std::errc()) return std::nullopt;
  const std::string_view rest(end, static_cast<std::size_t>(pointer.data() + pointer.size() - end));
  const std::string extension = "/extensions/" + std::string(kSpecGlossExtension);
  if (!rest.starts_with(extension) && !rest.starts_with("/" + std::string(kCoreMember))) return std::nullopt;
  return index;
}

std::vector<MaterialFactor> factors_of(const MetalRoughFactors& result) {
  std::vector<MaterialFactor> factors = {{"base_color", {}},
                                         {"metallic", {decimal_value(result.metallic)}},
                                         {"roughness", {decimal_value(result.roughness)}}};
  for (const float value : result.base_color) factors.front().values.push_back(decimal_value(value));
  return factors;
}

class SpecGlossEditor {
 public:
  // `asset` may be null: then no material with textures is converted.
  SpecGlossEditor(const SpannedJson& json, const std::string& place, const AssetOptions& options,
                  const AssetParts* asset)
      : json_(json), root_(json.root()), place_(place), options_(options), edits_(json) {
    if (asset == nullptr) return;
    images_.emplace(json, asset->container, asset->source, asset->resources, place_, edits_);
    textures_.emplace(*images_, options.prior, options.instructions, options.enlarges);
  }

  SpecGlossResult result() {
    require_gltf();
    const SpanValue list = root_["materials"];
    if (list && !list.is(SpanKind::kList)) throw input_error(place_ + ": materials: expected a list");
    find_animated();
    read_materials(list.children());
    if (!materials_.empty()) {
      convert_factors();
      count_colored();
      for (Planned& planned : materials_) write(planned, result_.asset.materials[planned.index]);
      update_extension_lists();
    }
    if (images_) {
      images_->finish();
      result_.appended = images_->appended();
      result_.asset.files = std::move(images_->files());
    }
    result_.asset.changed = !edits_.empty();
    result_.asset.touched = edits_.touched();
    result_.asset.text = edits_.result();
    return std::move(result_);
  }

 private:
  // A material that is converted.
  struct Planned {
    std::size_t index = 0;
    SpecGlossMaterial read;
    std::optional<CoreTexts> texts;  // none before convert_factors()
  };

  void require_gltf() {
    const SpanValue version = root_["asset"]["version"];
    const std::optional<std::string> text = version.text();
    if (!text) throw input_error(place_ + ": has no asset.version (it is not a glTF file)");
    if (!text->starts_with("2."))
      throw input_error(place_ + ": is glTF " + plain(*text, 20) + "; version 2 is read");
    for (const SpanValue& entry : root_["extensionsRequired"].children())
      if (const std::string name = entry.text().value_or(""); !is_known(name))
        result_.asset.warnings.push_back(
            "requires " + plain(name) +
            ", which is unknown here: it is kept, and its meaning for materials is not");
  }

  static bool is_known(const std::string& name) {
    return is_one_of(name, kKnownExtensions) || is_one_of(name, kReflecting);
  }

  // Materials of which an animation changes what the conversion replaces.
  void find_animated() {
    for (const SpanValue& animation : root_["animations"].children())
      for (const SpanValue& channel : animation["channels"].children()) {
        const SpanValue target = channel["target"]["extensions"][kPointer]["pointer"];
        if (const auto index = pointed_material(target.text().value_or(""))) animated_.insert(*index);
      }
  }

  void read_materials(const std::vector<SpanValue>& all) {
    result_.asset.materials.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      AssetMaterial& report = result_.asset.materials[i];
      report.index = i;
      report.name = all[i]["name"].text().value_or("");
      if (!all[i]["extensions"][kSpecGlossExtension]) continue;
      try {
        Planned planned{i, read_material(all[i], report), {}};
        require_convertible(planned.read, i);
        convert_textures(planned, report);
        materials_.push_back(std::move(planned));
        report.state = MaterialState::kConverted;
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::kInput) throw;
        report.state = MaterialState::kFailed;
        report.failure = plain(error.what(), 500);
      }
    }
  }

  void require_convertible(const SpecGlossMaterial& read, std::size_t index) const {
    if (animated_.contains(index))
      fail_material("an animation changes it by " + std::string(kPointer) +
                    ", which would lose its target (remove that channel)");
    const SpanValue extensions = read.material["extensions"];
    if (options_.profile == MaterialProfile::kExtensions && !read.is_unlit)
      for (const std::string_view name : {kSpecularExtension, kIorExtension})
        if (extensions[name])
          fail_material("has " + std::string(name) +
                        " already, which the exact form needs (use --profile core)");
  }

  void convert_textures(Planned& planned, AssetMaterial& report) {
    SpecGlossMaterial& read = planned.read;
    if (read.is_unlit || (!read.diffuse_texture && !read.specgloss_texture)) return;
    if (!textures_) fail_material("has textures, and no library of images is given");
    planned.texts = is_exact(read) ? textures_->exact(read) : textures_->core(read, report.warnings);
  }

  bool is_exact(const SpecGlossMaterial& read) const {
    return options_.profile == MaterialProfile::kExtensions && !read.is_unlit;
  }
  // Whether base color is diffuse as it stands.
  bool keeps_diffuse(const SpecGlossMaterial& read) const { return is_exact(read) || read.is_unlit; }

  // Materials without textures, all at once.
  void convert_factors() {
    std::vector<Planned*> planned;
    std::vector<SpecGlossFactors> sources;
    for (Planned& material : materials_)
      if (!material.texts) {
        planned.push_back(&material);
        sources.push_back(material.read.factors());
      }
    std::vector<MetalRoughFactors> results = projected(sources, options_.prior, options_.instructions);
    for (std::size_t i = 0; i < planned.size(); ++i) {
      const SpecGlossMaterial& read = planned[i]->read;
      if (keeps_diffuse(read)) {
        for (std::size_t c = 0; c < 3; ++c)
          results[i].base_color[c] = static_cast<float>(sources[i].diffuse[c]);
        results[i].metallic = results[i].residual = 0.0f;
      }
      planned[i]->texts = core_texts(read, results[i], keeps_diffuse(read));
      if (read.is_unlit && read.diffuse_texture)
        planned[i]->texts->base_texture = std::string(read.diffuse_texture.raw());
      AssetMaterial& report = result_.asset.materials[planned[i]->index];
      report.factors = factors_of(results[i]);
    }
  }

  // COLOR_0 multiplies diffuse alone before, and of a metal its reflectance after.
  void count_colored() {
    std::vector<std::size_t> counts(result_.asset.materials.size());
    for (const SpanValue& mesh : root_["meshes"].children())
      for (const SpanValue& primitive : mesh["primitives"].children())
        if (primitive["attributes"]["COLOR_0"]) count_uses(primitive, counts);
    for (const Planned& planned : materials_)
      if (const std::size_t count = counts[planned.index]; count > 0 && planned.texts->has_metal)
        result_.asset.materials[planned.index].warnings.push_back(
            "vertex colors of " + counted(count, "primitive") +
            " tinted its diffuse color and now tint its reflection, too");
  }

  static void count_uses(SpanValue primitive, std::vector<std::size_t>& counts) {
    std::set<std::size_t> used;
    const auto use = [&](SpanValue material) {
      const std::optional<std::size_t> index = material.whole();
      if (index && *index < counts.size()) used.insert(*index);
    };
    use(primitive["material"]);
    for (const SpanValue& mapping : primitive["extensions"]["KHR_materials_variants"]["mappings"].children())
      use(mapping["material"]);
    for (const std::size_t index : used) ++counts[index];
  }

  void write(const Planned& planned, AssetMaterial& report) {
    const SpecGlossMaterial& read = planned.read;
    report.becomes = becomes_text(*planned.texts, read, is_exact(read));
    report.residual = planned.texts->residual;
    note_extensions(read, report);
    write_core(read, *planned.texts, report);
    write_extensions(read, *planned.texts);
  }

  // Members of core in their order; those with empty texts go.
  using CoreMembers = std::array<std::pair<std::string_view, std::string>, 5>;

  // Replaces the fallback's textures and factors, and keeps what else it holds.
  void write_core(const SpecGlossMaterial& read, const CoreTexts& texts, AssetMaterial& report) {
    const CoreMembers members = {
        {{"baseColorFactor", list_text({texts.base_color.begin(), texts.base_color.end()})},
         {"baseColorTexture", texts.base_texture},
         {"metallicFactor", texts.metallic},
         {"roughnessFactor", texts.roughness},
         {"metallicRoughnessTexture", texts.metal_rough_texture}}};
    const SpanValue extras = read.extension["extras"];
    if (const SpanValue core = read.material[kCoreMember]) {
      for (const auto& [name, text] : members) put(core, name, text);
      if (extras) carry_extras(extras, core, report);
      return;
    }
    std::string object;
    for (const auto& [name, text] : members)
      if (!text.empty()) object += (object.empty() ? "" : ",") + quoted_json(name) + ":" + text;
    if (extras) object += ",\"extras\":" + std::string(extras.raw());
    edits_.append_member(read.material, kCoreMember, "{" + object + "}");
  }

  void put(SpanValue core, std::string_view name, const std::string& text) {
    if (text.empty())
      edits_.remove_members(core, name);
    else
      edits_.set_member(core, name, text);
  }

  // The extras of spec-gloss go to those of core, of which none is replaced.
  void carry_extras(SpanValue extras, SpanValue core, AssetMaterial& report) {
    const SpanValue kept = core["extras"];
    if (!kept) return edits_.append_member(core, "extras", std::string(extras.raw()));
    const bool can_join = extras.is(SpanKind::kObject) && kept.is(SpanKind::kObject);
    if (!can_join) {
      report.warnings.push_back("loses extras of " + std::string(kSpecGlossExtension) +
                                ", because those of " + std::string(kCoreMember) + " stay");
      return;
    }
    for (const SpanValue& member : extras.children())
      if (kept.find(member.key()))
        report.warnings.push_back("loses extras." + plain(member.key()) + " of " +
                                  std::string(kSpecGlossExtension) + ", because that of " +
                                  std::string(kCoreMember) + " stays");
      else
        edits_.append_member(kept, member.key(), std::string(member.raw()));
  }

  void write_extensions(const SpecGlossMaterial& read, const CoreTexts& texts) {
    const SpanValue extensions = read.material["extensions"];
    converted_.insert(read.extension.index());
    std::size_t repeated = 0;
    for (const SpanValue& member : extensions.children()) {
      if (!member.has_key(kSpecGlossExtension)) continue;
      converted_.insert(member.index());
      ++repeated;
    }
    const bool is_last = extensions.size() == repeated;
    if (!is_exact(read)) {
      if (is_last)
        edits_.remove_members(read.material, "extensions");
      else
        edits_.remove_members(extensions, kSpecGlossExtension);
      return;
    }
    edits_.remove_members(extensions, kSpecGlossExtension);
    const std::string color =
        list_text({read.specular[0].text, read.specular[1].text, read.specular[2].text});
    const std::string texture =
        texts.specular_texture.empty() ? "" : ",\"specularColorTexture\":" + texts.specular_texture;
    edits_.append_member(extensions, kSpecularExtension, "{\"specularColorFactor\":" + color + texture + "}");
    // An index of 0 means an F0 of 1, which the color then multiplies (KHR_materials_ior).
    edits_.append_member(extensions, kIorExtension, "{\"ior\":0}");
    adds_extensions_ = true;
  }

  // Whether something other than a converted material still holds spec-gloss.
  bool is_still_used() const {
    for (std::size_t i = 1; i < json_.value_count(); ++i) {
      const SpanValue value = json_.value(i);
      if (value.has_key(kSpecGlossExtension) && !converted_.contains(i) &&
          value.parent().has_key("extensions"))
        return true;
    }
    return false;
  }

  void update_extension_lists() {
    std::vector<std::string> added;
    if (adds_extensions_) added = {std::string(kSpecularExtension), std::string(kIorExtension)};
    const bool is_unused = !is_still_used();
    update_list("extensionsUsed", is_unused, added);
    update_list("extensionsRequired", is_unused, {});
  }

  void update_list(std::string_view name, bool removes, std::vector<std::string> added) {
    const SpanValue list = root_[name];
    if (list && !list.is(SpanKind::kList))
      throw input_error(place_ + ": " + std::string(name) + ": expected a list");
    std::vector<SpanValue> removed;
    for (const SpanValue& entry : list.children()) {
      const std::string text = entry.text().value_or("");
      std::erase(added, text);
      if (removes && text == kSpecGlossExtension) removed.push_back(entry);
    }
    if (!list) {
      std::vector<std::string> quoted;
      for (const std::string& text : added) quoted.push_back(quoted_json(text));
      if (!added.empty()) edits_.append_member(root_, name, list_text(quoted));
      return;
    }
    if (added.empty() && removed.size() == list.size()) return edits_.remove_members(root_, name);
    for (const SpanValue& entry : removed) edits_.remove(entry);
    for (const std::string& text : added) edits_.append_entry(list, quoted_json(text));
  }

  const SpannedJson& json_;
  SpanValue root_;
  const std::string& place_;
  const AssetOptions& options_;
  TextEdits edits_;
  SpecGlossResult result_;
  std::optional<GltfImages> images_;
  std::optional<SpecGlossTextures> textures_;
  std::vector<Planned> materials_;
  std::set<std::size_t> animated_;   // indices of materials
  std::set<std::size_t> converted_;  // values of spec-gloss that go
  bool adds_extensions_ = false;
};

}  // namespace

SpecGlossResult convert_specgloss(const SpannedJson& json, const std::string& place,
                                  const AssetOptions& options, const AssetParts* asset) {
  return SpecGlossEditor(json, place, options, asset).result();
}

}  // namespace remap
