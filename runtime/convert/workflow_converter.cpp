#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "convert/workflow_kernel.hpp"
#include "remap/error.hpp"
#include "remap/workflow.hpp"

namespace remap {
namespace {

// Texels converted by all stages before the next; the rows of a block take 60 KB.
constexpr std::size_t kBlock = 512;

using Row = std::array<float, kBlock>;
using ColorRows = std::array<const float*, 3>;

// A material of the specular workflow between two stages: pointers to the source's rows, or to a stage's own.
// `diffuse` is in the convention of the stages (WorkflowConverter::between_).
struct SpecularBlock {
  ColorRows diffuse{}, specular{};
  const float* width = nullptr;
  bool is_grey = false;  // all three rows of specular are one
};

struct Scratch {
  std::array<Row, 3> first_diffuse, first_specular;  // of equation (2)
  std::array<Row, 3> diffuse, specular, scaled;      // after the converter, and scaled for the target
  Row dielectric, mapped_dielectric, width, alpha, ignored, residual, metallic_width, doubts;
  std::array<Row, 3> base_color;
  Row metallic;
};

ColorRows pointers(const std::array<Row, 3>& rows) {
  return {rows[0].data(), rows[1].data(), rows[2].data()};
}

// Grey stands for three equal channels.
ColorRows color(const ParameterRows<const float>& rows, std::size_t start) {
  ColorRows color{};
  for (std::size_t c = 0; c < 3; ++c) color[c] = rows.row[rows.count == 1 ? 0 : c] + start;
  return color;
}

float largest(const ColorRows& specular, std::size_t i) {
  const float most = std::max({specular[0][i], specular[1][i], specular[2][i]});
  return std::clamp(most, 0.0f, 1.0f);
}

// Diffuse that counts what specular leaves, as reflectance, and back. All of the light reflected: black.
void scale_down(std::size_t count, const ColorRows& diffuse, const ColorRows& specular,
                std::array<Row, 3>& out) {
  for (std::size_t i = 0; i < count; ++i) {
    const float left = 1.0f - largest(specular, i);
    for (std::size_t c = 0; c < 3; ++c) out[c][i] = diffuse[c][i] * left;
  }
}
void scale_up(std::size_t count, const ColorRows& diffuse, const ColorRows& specular,
              std::array<Row, 3>& out) {
  for (std::size_t i = 0; i < count; ++i) {
    const float left = 1.0f - largest(specular, i);
    for (std::size_t c = 0; c < 3; ++c) out[c][i] = left > 0.0f ? diffuse[c][i] / left : diffuse[c][i] * left;
  }
}

std::vector<Parameter> targets_of(const WorkflowEnd& end) {
  std::vector<Parameter> targets = parameters_of(end);
  if (kind_of(end) == WorkflowKind::kMetallic)
    targets.insert(targets.end(), {Parameter::kResidual, Parameter::kMetallicWidth, Parameter::kDoubts});
  return targets;
}

// `gltf-specgloss` as part of an id.
std::string id_part(std::string model) {
  std::replace_if(
      model.begin(), model.end(), [](char c) { return c == '-' || c == '/' || c == '.'; }, '_');
  return model;
}

ConverterInfo info_of(const WorkflowStages& stages, InstructionSet set) {
  ConverterInfo info;
  if (stages.brdf != nullptr) {
    info = stages.brdf->info();
    if (info.steps.empty()) info.steps = {info.id};
  } else {
    info.source.roughness = info.target.roughness = stages.width;
    info.roughness = info.specular = {0.0, 1.0};
    info.instructions = set;
  }
  info.id = id_part(model_of(stages.source)) + "_to_" + id_part(model_of(stages.target));
  info.source.model = model_of(stages.source);
  info.target.model = model_of(stages.target);
  info.source.specular = kind_of(stages.source) == WorkflowKind::kSpecular ? "specular" : "base_color";
  info.target.specular = kind_of(stages.target) == WorkflowKind::kSpecular ? "specular" : "base_color";
  return info;
}

bool tells_alpha(RoughnessConvention width) {
  return width == RoughnessConvention::kAlpha || width == RoughnessConvention::kRoughness ||
         width == RoughnessConvention::kGlossiness;
}

class WorkflowConverter final : public Converter {
 public:
  WorkflowConverter(const WorkflowStages& stages, InstructionSet set);

  std::size_t convert_rows(std::size_t count, const MaterialRows<const float>& in,
                           const MaterialRows<float>& out, std::uint8_t* outside) const override;

 private:
  SpecularBlock read(std::size_t count, std::size_t start, const MaterialRows<const float>& in,
                     Scratch& scratch) const;
  std::size_t convert_brdf(std::size_t count, SpecularBlock& block, Scratch& scratch,
                           std::uint8_t* outside) const;
  void keep_dielectrics(std::size_t count, const float* width, const float* metallic, Scratch& scratch) const;
  void write_specular(std::size_t count, std::size_t start, const SpecularBlock& block,
                      const MaterialRows<float>& out, Scratch& scratch) const;
  void write_metallic(std::size_t count, std::size_t start, const SpecularBlock& block,
                      const MaterialRows<const float>& in, const MaterialRows<float>& out,
                      Scratch& scratch) const;

  WorkflowStages stages_;
  // Of diffuse between the stages: that of the specular end, so that a conversion without `brdf` is the one
  // of a header, bit for bit; plain where specular changes on the way.
  DiffuseConvention between_ = DiffuseConvention::kPlain;
  std::optional<WorkflowConversion> to_specular_, to_metallic_;
  const WorkflowKernels& kernels_;
  RoughnessConvention width_;  // as the way to metallic reads it
};

WorkflowConverter::WorkflowConverter(const WorkflowStages& stages, InstructionSet set)
    : Converter(info_of(stages, set), parameters_of(stages.source), targets_of(stages.target)),
      stages_(stages),
      kernels_(workflow_kernels(set)),
      width_(tells_alpha(info().target.roughness) ? info().target.roughness : RoughnessConvention::kAlpha) {
  const auto* source_metallic = std::get_if<MetallicWorkflow>(&stages.source);
  const auto* target_metallic = std::get_if<MetallicWorkflow>(&stages.target);
  const bool is_one_way = (source_metallic == nullptr) != (target_metallic == nullptr);
  if (stages.brdf == nullptr && is_one_way)
    between_ = diffuse_of(source_metallic == nullptr ? stages.source : stages.target);
  SpecularWorkflow between;
  between.diffuse = between_;
  between.width = width_;
  const auto conversion = [&](const MetallicWorkflow& metallic, const WorkflowFormula& formula) {
    WorkflowConversion made{between, metallic, formula};
    made.metallic.width = width_;
    require_valid(made, info().id);
    return made;
  };
  if (source_metallic != nullptr) to_specular_ = conversion(*source_metallic, Equation2{});
  if (target_metallic != nullptr) to_metallic_ = conversion(*target_metallic, stages.formula);
}

std::size_t WorkflowConverter::convert_rows(std::size_t count, const MaterialRows<const float>& in,
                                            const MaterialRows<float>& out, std::uint8_t* outside) const {
  const auto scratch = std::make_unique<Scratch>();
  std::size_t outside_count = 0;
  if (outside != nullptr) std::fill_n(outside, count, std::uint8_t{0});
  for (std::size_t start = 0; start < count; start += kBlock) {
    const std::size_t size = std::min(kBlock, count - start);
    SpecularBlock block = read(size, start, in, *scratch);
    if (stages_.brdf != nullptr) {
      const float* const source_width = block.width;
      outside_count += convert_brdf(size, block, *scratch, outside == nullptr ? nullptr : outside + start);
      if (to_specular_ && to_metallic_)
        keep_dielectrics(size, source_width, in[Parameter::kMetallic].row[0] + start, *scratch);
    }
    if (to_metallic_)
      write_metallic(size, start, block, in, out, *scratch);
    else
      write_specular(size, start, block, out, *scratch);
    if (const auto& width = out[Parameter::kWidth]; width.count > 0 && width.row[0] + start != block.width)
      std::copy_n(block.width, size, width.row[0] + start);
  }
  return outside_count;
}

SpecularBlock WorkflowConverter::read(std::size_t count, std::size_t start,
                                      const MaterialRows<const float>& in, Scratch& scratch) const {
  SpecularBlock block;
  block.width = in[Parameter::kWidth].row[0] + start;
  if (!to_specular_) {
    block.diffuse = color(in[Parameter::kDiffuse], start);
    block.specular = color(in[Parameter::kSpecular], start);
    block.is_grey = in[Parameter::kSpecular].count == 1;
    if (diffuse_of(stages_.source) == between_) return block;
    scale_down(count, block.diffuse, block.specular, scratch.first_diffuse);
    block.diffuse = pointers(scratch.first_diffuse);
    return block;
  }
  const ColorRows base = color(in[Parameter::kBaseColor], start);
  auto &diffuse = scratch.first_diffuse, &specular = scratch.first_specular;
  kernels_.to_specular(*to_specular_, count,
                       {base[0], base[1], base[2], in[Parameter::kMetallic].row[0] + start, block.width},
                       {diffuse[0].data(), diffuse[1].data(), diffuse[2].data(), specular[0].data(),
                        specular[1].data(), specular[2].data(), scratch.ignored.data()});
  block.diffuse = pointers(diffuse);
  block.specular = pointers(specular);
  return block;
}

std::size_t WorkflowConverter::convert_brdf(std::size_t count, SpecularBlock& block, Scratch& scratch,
                                            std::uint8_t* outside) const {
  const std::size_t channels = block.is_grey ? 1 : 3;
  auto& mapped = scratch.specular;
  const std::array<float*, 3> out = {mapped[0].data(), mapped[1].data(), mapped[2].data()};
  const std::size_t outside_count =
      stages_.brdf->convert(count, block.width, {block.specular.data(), channels}, scratch.width.data(),
                            {out.data(), channels}, outside);
  block.width = scratch.width.data();
  for (std::size_t c = 0; c < 3; ++c) block.specular[c] = mapped[block.is_grey ? 0 : c].data();
  return outside_count;
}

// Between two metallic workflows the dielectric of one is the dielectric of the other, whose F0 is fixed:
// only the metal's share of specular follows the BRDF. Without this, a dielectric whose F0 the BRDF maps to
// another would become a little metallic. Where the law of specular is affine, metallic comes out as it was.
void WorkflowConverter::keep_dielectrics(std::size_t count, const float* width, const float* metallic,
                                         Scratch& scratch) const {
  const auto f0_of = [](const WorkflowEnd& end) {
    return static_cast<float>(std::get<MetallicWorkflow>(end).dielectric_f0);
  };
  std::fill_n(scratch.dielectric.data(), count, f0_of(stages_.source));
  const std::array<const float*, 1> in = {scratch.dielectric.data()};
  const std::array<float*, 1> out = {scratch.mapped_dielectric.data()};
  stages_.brdf->convert(count, width, in, scratch.ignored.data(), out);
  const float target = f0_of(stages_.target);
  for (Row& specular : scratch.specular)
    for (std::size_t i = 0; i < count; ++i) {
      const float share = 1.0f - std::clamp(metallic[i], 0.0f, 1.0f);
      specular[i] = std::max(specular[i] - share * (scratch.mapped_dielectric[i] - target), 0.0f);
    }
}

void WorkflowConverter::write_specular(std::size_t count, std::size_t start, const SpecularBlock& block,
                                       const MaterialRows<float>& out, Scratch& scratch) const {
  ColorRows diffuse = block.diffuse;
  if (diffuse_of(stages_.target) != between_) {
    scale_up(count, block.diffuse, block.specular, scratch.scaled);
    diffuse = pointers(scratch.scaled);
  }
  // The converter may write where the source's rows lie: from copies, where it has not made some.
  const auto write = [&](Parameter parameter, const ColorRows& rows) {
    for (std::size_t c = 0; c < out[parameter].count; ++c)
      if (out[parameter].row[c] + start != rows[c])
        std::copy_n(rows[c], count, out[parameter].row[c] + start);
  };
  write(Parameter::kDiffuse, diffuse);
  write(Parameter::kSpecular, block.specular);
}

void WorkflowConverter::write_metallic(std::size_t count, std::size_t start, const SpecularBlock& block,
                                       const MaterialRows<const float>& in, const MaterialRows<float>& out,
                                       Scratch& scratch) const {
  const float* width = block.width;
  if (width_ != info().target.roughness) {
    for (std::size_t i = 0; i < count; ++i)
      scratch.alpha[i] =
          static_cast<float>(to_alpha(info().target.roughness, static_cast<double>(block.width[i])));
    width = scratch.alpha.data();
  }
  const SpecularRows<const float> from = {block.diffuse[0],
                                          block.diffuse[1],
                                          block.diffuse[2],
                                          block.specular[0],
                                          block.specular[1],
                                          block.specular[2],
                                          width};
  auto& base = scratch.base_color;
  const MetallicRows<float> to = {base[0].data(), base[1].data(), base[2].data(), scratch.metallic.data(),
                                  scratch.ignored.data()};
  kernels_.to_metallic(*to_metallic_, count, from, to);
  const auto follow = [&](Parameter parameter, FollowedTexels which) {
    const auto& wanted = in[parameter];
    if (wanted.count > 0) kernels_.follow(*to_metallic_, count, from, wanted.row[0] + start, which, to);
  };
  follow(Parameter::kNearbyMetallic, FollowedTexels::kGuesses);
  follow(Parameter::kMetalMask, FollowedTexels::kAll);
  const auto wanted = [&](Parameter parameter) { return out[parameter].count > 0; };
  if (wanted(Parameter::kResidual) || wanted(Parameter::kMetallicWidth) || wanted(Parameter::kDoubts))
    kernels_.diagnose(*to_metallic_, count, from, {to[0], to[1], to[2], to[3], to[4]},
                      {scratch.residual.data(), scratch.metallic_width.data(), scratch.doubts.data()});
  const auto write = [&](Parameter parameter, std::size_t c, const Row& row) {
    if (c < out[parameter].count) std::copy_n(row.data(), count, out[parameter].row[c] + start);
  };
  for (std::size_t c = 0; c < 3; ++c) write(Parameter::kBaseColor, c, base[c]);
  write(Parameter::kMetallic, 0, scratch.metallic);
  write(Parameter::kResidual, 0, scratch.residual);
  write(Parameter::kMetallicWidth, 0, scratch.metallic_width);
  write(Parameter::kDoubts, 0, scratch.doubts);
}

}  // namespace

std::vector<Parameter> parameters_of(const WorkflowEnd& end) {
  if (kind_of(end) == WorkflowKind::kSpecular)
    return {Parameter::kWidth, Parameter::kSpecular, Parameter::kDiffuse};
  return {Parameter::kWidth, Parameter::kBaseColor, Parameter::kMetallic};
}

std::unique_ptr<Converter> make_workflow_converter(const WorkflowStages& stages, InstructionSet set) {
  return std::make_unique<WorkflowConverter>(stages, set);
}

}  // namespace remap
