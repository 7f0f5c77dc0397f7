#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "remap/workflow.hpp"
#include "stages/kernels.hpp"
#include "stages/stage.hpp"
#include "stages/workflow_conventions.hpp"

namespace remap {
namespace {

using Colors = std::array<const float*, 3>;

float clamped(float value) { return std::clamp(value, 0.0f, 1.0f); }

// Applies equation (2) with an F0 for each texel. The equation is linear in F0. `metal` applies it with an F0
// of 0, and makes plain diffuse: a metal over black dielectrics. Then the dielectrics' F0 and their share of
// diffuse are added.
void layer_dielectrics(const Stage& metal, Block& block) {
  std::array<std::array<float, kBlockTexels>, 3> f0;
  std::array<float, kBlockTexels> dielectric;
  const Colors given = block.color(Parameter::kSpecular);
  const float* const metallic = block.row(Parameter::kMetallic);
  for (std::size_t c = 0; c < 3; ++c)
    std::transform(given[c], given[c] + block.size(), f0[c].begin(), clamped);
  for (std::size_t i = 0; i < block.size(); ++i) dielectric[i] = 1.0f - clamped(metallic[i]);
  metal.run(block, nullptr);
  const Colors diffuse = block.color(Parameter::kDiffuse), specular = block.color(Parameter::kSpecular);
  const auto diffuse_out = block.make_color(Parameter::kDiffuse);
  const auto specular_out = block.make_color(Parameter::kSpecular);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < block.size(); ++i) {
      diffuse_out[c][i] = diffuse[c][i] * (1.0f - std::max({f0[0][i], f0[1][i], f0[2][i]}));
      specular_out[c][i] = specular[c][i] + dielectric[i] * f0[c][i];
    }
}

// Converts between plain and scaled diffuse. The result is black if specular reflects all light.
void scale_diffuse(DiffuseConvention to, Block& block) {
  const Colors specular = block.color(Parameter::kSpecular), diffuse = block.color(Parameter::kDiffuse);
  const auto out = block.make_color(Parameter::kDiffuse);
  std::array<float, kBlockTexels> left;
  for (std::size_t i = 0; i < block.size(); ++i)
    left[i] = 1.0f - clamped(std::max({specular[0][i], specular[1][i], specular[2][i]}));
  for (std::size_t c = 3; c-- > 0;)  // red last: grey uses its row, which may be the first of `out`
    for (std::size_t i = 0; i < block.size(); ++i)
      out[c][i] = to == DiffuseConvention::kScaled && left[i] > 0.0f ? diffuse[c][i] / left[i]
                                                                     : diffuse[c][i] * left[i];
}

// KeepDielectrics runs the stages of a BRDF between two metallic workflows. A dielectric becomes a dielectric
// of the target, whose F0 is fixed. So only the specular of metals follows the BRDF. Otherwise, a BRDF that
// changes the F0 of a dielectric would make it slightly metallic. If the formula for specular is affine,
// metallic stays unchanged.
class KeepDielectrics final : public Stage {
 public:
  KeepDielectrics(const StageList& brdf, double source_f0, double target_f0)
      : brdf_(brdf), source_f0_(static_cast<float>(source_f0)), target_f0_(static_cast<float>(target_f0)) {}

  bool has_domain() const noexcept override { return true; }

  std::size_t run(Block& block, std::uint8_t* outside) const override {
    std::array<float, kBlockTexels> dielectric;
    dielectric.fill(source_f0_);
    MaterialRows<const float> in;
    in[Parameter::kRoughness] = {{block.row(Parameter::kRoughness)}, 1};
    in[Parameter::kSpecular] = {{dielectric.data()}, 1};
    const MaterialRows<float> no_target;
    Block mapped(in, no_target);
    mapped.begin(0, block.size());
    run_stages(brdf_, mapped, nullptr);
    const float* const f0 = mapped.row(Parameter::kSpecular);

    const std::size_t count = run_stages(brdf_, block, outside);
    const float* const metallic = block.row(Parameter::kMetallic);
    const Colors specular = block.color(Parameter::kSpecular);
    const auto out = block.make_color(Parameter::kSpecular);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < block.size(); ++i)
        out[c][i] = std::max(specular[c][i] - (1.0f - clamped(metallic[i])) * (f0[i] - target_f0_), 0.0f);
    return count;
  }

  bool self_test() const override { return remap::self_test(brdf_); }

 private:
  StageList brdf_;
  float source_f0_, target_f0_;
};

// Returns the stage that converts to metallic by the projection, with the requested parts of its diagnosis.
// `width` is the parameter that the block has. With `reads_alpha` the workflows do not know this parameter,
// and `use` has alpha. With `widens`, surfaces without a highlight become rough.
std::shared_ptr<const Stage> projection_stage(const workflow_code::Conventions& use, double prior,
                                              RoughnessEncoding width, bool reads_alpha, bool widens,
                                              InstructionSet set) {
  return make_stage([use, prior = static_cast<float>(prior), width, reads_alpha,
                     writes_width = widens && !reads_alpha, &by_set = kernels(set)](Block& block) {
    const Colors diffuse = block.color(Parameter::kDiffuse), specular = block.color(Parameter::kSpecular);
    const float* row = block.row(Parameter::kRoughness);
    std::array<float, kBlockTexels> alpha;
    if (reads_alpha) {
      for (std::size_t i = 0; i < block.size(); ++i)
        alpha[i] = static_cast<float>(to_alpha(width, static_cast<double>(row[i])));
      row = alpha.data();
    }
    const SpecularRows<const float> from = {diffuse[0],  diffuse[1],  diffuse[2], specular[0],
                                            specular[1], specular[2], row};
    const auto base = block.make_color(Parameter::kBaseColor);
    const MetallicRows<float> to = {base[0], base[1], base[2], block.make(Parameter::kMetallic),
                                    writes_width ? block.make(Parameter::kRoughness) : block.make_unused()};
    by_set.project(use, prior, block.size(), from, to);
    if (block.has(Parameter::kMetalMask))
      by_set.follow(use, block.size(), from, block.row(Parameter::kMetalMask), to);
    if (block.is_wanted(Parameter::kResidual) || block.is_wanted(Parameter::kMetallicUncertainty) ||
        block.is_wanted(Parameter::kMetallicIssues))
      by_set.diagnose(use, block.size(), from, {to[0], to[1], to[2], to[3], to[4]},
                      {block.make(Parameter::kResidual), block.make(Parameter::kMetallicUncertainty),
                       block.make(Parameter::kMetallicIssues)});
  });
}

std::vector<Parameter> targets_of(const WorkflowEnd& end) {
  std::vector<Parameter> targets = parameters_of(end);
  if (kind_of(end) == WorkflowKind::kMetallic)
    targets.insert(targets.end(),
                   {Parameter::kResidual, Parameter::kMetallicUncertainty, Parameter::kMetallicIssues});
  return targets;
}

// Writes a name such as `gltf-specgloss` as part of an id.
std::string id_part(std::string model) {
  std::replace_if(
      model.begin(), model.end(), [](char c) { return c == '-' || c == '/' || c == '.'; }, '_');
  return model;
}

bool encodes_alpha(RoughnessEncoding width) {
  return width == RoughnessEncoding::kAlpha || width == RoughnessEncoding::kRoughness ||
         width == RoughnessEncoding::kGlossiness;
}

// Returns the conventions between a metallic workflow and the specular workflow inside the converter. Both
// use the width parameter of the block.
workflow_code::Conventions conventions_between(MetallicWorkflow metallic, DiffuseConvention diffuse,
                                               RoughnessEncoding width, bool to_metallic,
                                               const std::string& context) {
  metallic.width = width;
  const SpecularWorkflow specular{"specular", diffuse, width};
  require_valid(specular, metallic, context);
  return conventions_of(specular, metallic, to_metallic);
}

// Returns the diffuse convention between the stages. Without a BRDF, it is the convention of the specular
// end, so that results equal a generated header's bit for bit. With a BRDF, it is plain, because specular
// changes in between.
DiffuseConvention diffuse_between(const WorkflowStages& stages) {
  const bool is_one_way = kind_of(stages.source) != kind_of(stages.target);
  if (stages.brdf != nullptr || !is_one_way) return DiffuseConvention::kPlain;
  return diffuse_of(kind_of(stages.source) == WorkflowKind::kSpecular ? stages.source : stages.target);
}

}  // namespace

ConverterInfo ends_of(const WorkflowStages& stages, InstructionSet set) {
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

std::vector<Parameter> parameters_of(const WorkflowEnd& end) {
  if (kind_of(end) == WorkflowKind::kSpecular)
    return {Parameter::kRoughness, Parameter::kSpecular, Parameter::kDiffuse};
  return {Parameter::kRoughness, Parameter::kBaseColor, Parameter::kMetallic};
}

std::shared_ptr<const Stage> specular_stage(const MetallicWorkflow& source, DiffuseConvention diffuse,
                                            RoughnessEncoding width, InstructionSet set,
                                            const std::string& context) {
  return make_stage([use = conventions_between(source, diffuse, width, false, context),
                     kernel = kernels(set).to_specular](Block& block) {
    const Colors base = block.color(Parameter::kBaseColor);
    const auto diffuse_out = block.make_color(Parameter::kDiffuse);
    const auto specular = block.make_color(Parameter::kSpecular);
    kernel(use, block.size(),
           {base[0], base[1], base[2], block.row(Parameter::kMetallic), block.row(Parameter::kRoughness)},
           {diffuse_out[0], diffuse_out[1], diffuse_out[2], specular[0], specular[1], specular[2],
            block.make_unused()});
  });
}

std::unique_ptr<Converter> make_dielectric_converter(const WorkflowStages& stages, InstructionSet set) {
  const MetallicWorkflow black{model_of(stages.source), 0.0, DiffuseConvention::kPlain, stages.width};
  const SpecularWorkflow between{"specular", DiffuseConvention::kPlain, stages.width};
  WorkflowStages rest = stages;
  rest.source = between;
  const std::unique_ptr<Converter> converter = make_workflow_converter(rest, set);
  StageList list = {make_stage(
      [metal = specular_stage(black, DiffuseConvention::kPlain, stages.width, set, converter->info().id)](
          Block& block) { layer_dielectrics(*metal, block); })};
  list.insert(list.end(), converter->stages().begin(), converter->stages().end());
  std::vector<Parameter> sources = {Parameter::kRoughness, Parameter::kSpecular, Parameter::kBaseColor,
                                    Parameter::kMetallic};
  return std::make_unique<Converter>(converter->info(), std::move(sources), converter->targets(),
                                     std::move(list));
}

std::unique_ptr<Converter> make_workflow_converter(const WorkflowStages& stages, InstructionSet set) {
  ConverterInfo info = ends_of(stages, set);
  const RoughnessEncoding target_width = info.target.roughness;
  const RoughnessEncoding width = encodes_alpha(target_width) ? target_width : RoughnessEncoding::kAlpha;
  const DiffuseConvention between = diffuse_between(stages);
  const auto* source = std::get_if<MetallicWorkflow>(&stages.source);
  const auto* target = std::get_if<MetallicWorkflow>(&stages.target);
  StageList list;
  if (stages.brdf == nullptr && is_same_material(stages.source, stages.target))
    return std::make_unique<Converter>(std::move(info), parameters_of(stages.source),
                                       parameters_of(stages.target), std::move(list));
  if (source != nullptr)
    list.push_back(specular_stage(*source, between, width, set, info.id));
  else if (diffuse_of(stages.source) != between)
    list.push_back(make_stage([between](Block& block) { scale_diffuse(between, block); }));
  const StageList brdf = stages.brdf == nullptr ? StageList{} : stages.brdf->stages();
  if (!brdf.empty() && source != nullptr && target != nullptr)
    list.push_back(std::make_shared<KeepDielectrics>(brdf, source->dielectric_f0, target->dielectric_f0));
  else
    list.insert(list.end(), brdf.begin(), brdf.end());
  if (target != nullptr) {
    require_prior(stages.prior, info.id);
    list.push_back(projection_stage(conventions_between(*target, between, width, true, info.id), stages.prior,
                                    target_width, width != target_width, source == nullptr, set));
  } else if (diffuse_of(stages.target) != between) {
    list.push_back(make_stage([to = diffuse_of(stages.target)](Block& block) { scale_diffuse(to, block); }));
  }
  return std::make_unique<Converter>(std::move(info), parameters_of(stages.source), targets_of(stages.target),
                                     std::move(list));
}

}  // namespace remap
