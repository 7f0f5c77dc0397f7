#include "texremap/report/job_looks.hpp"

#include <algorithm>
#include <iterator>

#include "look/material_looks.hpp"
#include "sets/folder_walk.hpp"
#include "texremap/plan/asset_files.hpp"
#include "texremap/plan/asset_formats.hpp"

namespace remap {
namespace {

// A ResultResources gives the new images of a conversion that was not written, and all other files of its
// asset.
class ResultResources final : public AssetResources {
 public:
  ResultResources(const AssetResources& files, const AssetConversion& conversion)
      : files_(files), conversion_(conversion) {}
  std::unique_ptr<ByteSource> open(const std::string& path) const override {
    const auto found = std::ranges::find(conversion_.files, path, &NewResource::path);
    if (found == conversion_.files.end()) return files_.open(path);
    return std::make_unique<MemorySource>(found->bytes);
  }
  const ImageCodec& codec() const override { return files_.codec(); }
  ImagePixels enlarged(const ImagePixels& pixels, std::size_t width, std::size_t height) const override {
    return files_.enlarged(pixels, width, height);
  }

 private:
  const AssetResources& files_;
  const AssetConversion& conversion_;
};

std::string bytes_of(const AssetConversion& conversion, const ByteSource& source) {
  std::string bytes;
  for (const AssetPiece& piece : conversion.pieces)
    bytes += piece.bytes.empty() ? source.read(piece.begin, static_cast<std::size_t>(piece.end - piece.begin))
                                 : piece.bytes;
  return bytes;
}

constexpr const char* kGltfBrdf = "mitsuba/ggx";

std::string source_brdf(const ConvertPlan& plan) {
  return plan.sets() != nullptr ? plan.sets()->chosen.choice.source_brdf : kGltfBrdf;
}
std::string target_brdf(const ConvertPlan& plan) {
  return plan.sets() != nullptr ? plan.sets()->chosen.choice.target_brdf : kGltfBrdf;
}

// Returns the converters of the plan, and all shipped ones, because a renderer may need others to show a
// model.
ConverterGraph shown_graph(const ConvertPlan& plan) {
  const ConverterGraph shipped = shipped_graph();
  if (plan.sets() == nullptr) return shipped;
  std::vector<const Converter*> converters = plan.sets()->converters.graph().converters();
  const auto is_new = [&](const Converter* converter) {
    return std::ranges::none_of(converters,
                                [&](const Converter* own) { return own->info().id == converter->info().id; });
  };
  std::vector<const Converter*> others;
  std::ranges::copy_if(shipped.converters(), std::back_inserter(others), is_new);
  converters.insert(converters.end(), others.begin(), others.end());
  return ConverterGraph(std::move(converters), Detours::kRefused);
}

bool has_same_parameters(const ConversionChoice& workflow) {
  const auto &source = workflow.source, &target = workflow.target;
  return source.has_value() == target.has_value() && (!source || kind_of(*source) == kind_of(*target));
}

}  // namespace

JobLooks::JobLooks(const ConvertPlan& plan, const ModelTest& before, const ModelTest& after)
    : plan_(plan),
      graph_(shown_graph(plan)),
      source_(source_brdf(plan), graph_, before),
      target_(target_brdf(plan), graph_, after) {
  const auto note = [&](const std::string& model, const ShownModel& shown) {
    const std::string of = is_linear_lobe(shown.name()) ? "the closest built-in model"
                                                        : "the closest model of " + renderer_of(shown.name());
    const std::string text = model + " is shown as " + shown.name() + ", " + of;
    if (model != shown.name() && (notes_.empty() || notes_.back() != text)) notes_.push_back(text);
  };
  note(source_brdf(plan), source_);
  note(target_brdf(plan), target_);
  if (plan.sets() != nullptr && plan.sets()->chosen.choice.translation)
    notes_.emplace_back("layers over the base, such as coats and sheen, are not shown");
}

std::string JobLooks::copied_title() const {
  return plan_.sets() != nullptr ? "numbers copied" : "without conversion";
}

std::vector<MaterialLooks> JobLooks::of(const Job& job, int side, std::size_t most) const {
  if (const auto* asset = std::get_if<AssetWork>(&job.work)) return of_asset(*asset, side, most);
  return {of_set(job, side)};
}

MaterialLooks JobLooks::of_set(const Job& job, int side) const {
  const BuiltConversion& chosen = plan_.sets()->chosen;
  const ConversionChoice& workflow = chosen.choice;
  const auto& work = std::get<SetWork>(job.work);
  TextureSetRequest request = work.request;
  if (!work.diffuse.file.empty()) {  // of a BRDF model, whose converter does not read it
    request.parameters[Parameter::kDiffuse] = {work.diffuse, {}, {}};
    request.resample = true;
  }
  TextureSet set = open_texture_set(request);
  MaterialLooks looks;
  looks.name = job.name.empty() ? "maps" : display_path(std::filesystem::path(job.name).filename());
  if (!job.tile.empty()) looks.name += " " + job.tile;
  if (!work.normals.empty()) looks.normals = read_normals(work.normals, work.green, side);
  looks.before = scaled_maps(set, chosen.info().source.roughness, side);
  looks.after = converted(chosen.converter(), looks.before, &looks.outside);
  if (!work.diffuse.file.empty())
    looks.after.rows[Parameter::kDiffuse] = looks.before.rows.at(Parameter::kDiffuse);
  looks.source = source_.ball(workflow.source, looks.before);
  looks.converted = target_.ball(workflow.target, looks.after);
  if (has_same_parameters(workflow)) looks.copied = target_.ball(workflow.target, looks.before);
  return looks;
}

std::vector<MaterialLooks> JobLooks::of_asset(const AssetWork& asset, int side, std::size_t most) const {
  const std::string context = display_path(asset.input);
  const FileSource source(asset.input);
  const FolderResources files(asset);
  const auto& options = std::get<AssetOptions>(plan_.work);
  const AssetConversion conversion = convert_asset(source, asset.input, asset.output, options, files);
  if (!conversion.changed) return {};
  const ResultResources result_files(files, conversion);
  const MemorySource bytes(bytes_of(conversion, source));
  const auto reader = [&](const AssetFile& file, const std::filesystem::path& path) {
    return is_gltf_name(path) ? gltf_reader(file) : mtl_reader(file, options.mtl_maker, is_obj_name(path));
  };
  const auto before = reader({source, context, files}, asset.input),
             after = reader({bytes, context, result_files}, asset.output);
  std::vector<MaterialLooks> looks;
  for (const AssetMaterial& material : conversion.materials) {
    if (material.state != MaterialState::kConverted || looks.size() == most) continue;
    MaterialLooks& shown = looks.emplace_back();
    shown.name = material.name.empty() ? "material " + std::to_string(material.index) : material.name;
    shown.normals = before->normals(material, side);
    shown.before = before->maps(material, side);
    shown.after = after->maps(material, side);
    shown.source = before->ball(material, source_, shown.before);
    shown.converted = after->ball(material, target_, shown.after);
    shown.copied = before->without_extensions(material, target_, side);
  }
  return looks;
}

}  // namespace remap
