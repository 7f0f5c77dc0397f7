#include "texremap/plan/workflow_choice.hpp"

#include "core/errors.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

// Returns the words of the command line.
ConversionWords option_words() { return {"--from", "--to", "--via", "--dielectric-f0", "texremap list"}; }

void require_estimable(const ConversionChoice& choice) {
  if (kind_of(*choice.source) == WorkflowKind::kSpecular && choice.is_to_metallic()) return;
  throw Error(ErrorKind::kUsage,
              "--dielectric-f0: estimate requires maps of the specular workflow and a metallic target "
              "(give a number)");
}

// Refuses options that require a workflow, or a target with metallic.
void require_workflow(const ConvertOptions& options, const ConversionChoice& choice) {
  if (choice.is_material())
    refuse(options, kNotWithWorkflow,
           " cannot be used, because this conversion changes the maps of a material together (remove this "
           "option)");
  else
    refuse(
        options, kNeedsWorkflow | kNeedsMetallic,
        " requires a workflow (write one before the model, such as --from specular:mitsuba/ward, or choose a "
        "model of texremap list --workflows)");
  if (choice.translation)
    refuse(options, kNeedsMetallic,
           ": has no effect, because formulas convert every input between these models (remove this option)");
  if (choice.changes_nothing)
    refuse(options, kNeedsMetallic,
           ": has no effect, because source and target have the same material model (remove this option)");
  if (!choice.is_to_metallic())
    refuse(options, kNeedsMetallic,
           " requires a metallic target (choose another --to, such as gltf or metallic:mitsuba/ggx)");
}

}  // namespace

ConversionChoice workflow_choice(const ConvertOptions& options) {
  const auto* const f0 = std::get_if<double>(&options.dielectric_f0);
  ConversionRequest request;
  request.source = options.from;
  request.target = options.to;
  request.via = options.via;
  request.prior = options.prior;
  request.translates_surfaces = true;
  request.words = option_words();
  if (f0 != nullptr) request.dielectric_f0 = *f0;
  ConversionChoice choice = choose_conversion(request, options.converters.graph());
  if (choice.is_material() && options.dielectric_f0 == F0Choice(F0Source::kMaps)) require_estimable(choice);
  require_workflow(options, choice);
  return choice;
}

namespace {

void refuse_with_warp(const ConvertOptions& options, OptionTags tag, const std::string& warp) {
  refuse(options, tag, " cannot be used with the warp " + warp + " (remove this option)");
}

// Handles a warp whose source is only a diffuse map. It has neither specular nor roughness maps.
void choose_diffuse_alone(const ConvertOptions& options, ConversionChoice& choice) {
  const std::string warp = options.converters.path().string();
  refuse_with_warp(options, kNotWithDiffuseWarp, warp + ", which converts only a diffuse map");
  if (kind_of(*choice.source) == WorkflowKind::kMetallic)
    throw usage_error("--from metallic:" + options.from.name + ": " + warp +
                      " converts only a diffuse map (remove this option)");
  std::get<SpecularWorkflow>(*choice.source).width = RoughnessEncoding::kAlpha;
  choice.constants = {{Parameter::kSpecular, {0.0f}}, {Parameter::kRoughness, {1.0f}}};
}

}  // namespace

void require_model_of_fit(const std::string& file, const std::string& option, const std::string& asked,
                          const std::string& own) {
  if (!asked.empty() && asked != own)
    throw usage_error(file + ": " + (option == "--from" ? "source" : "target") + " model is " + own +
                      ", but " + option + " asks for " + asked + " (remove " + option + ")");
}

void refuse_diffuse(const ConvertOptions& options, const std::string& reason) {
  for (const ModelName* model : {&options.from, &options.to})
    if (model->diffuse)
      throw usage_error(prefixes_of(*model) + model->name + ": " + reason + "remove " +
                        std::string(diffuse_convention_name(*model->diffuse)) + ":)");
}

ConversionChoice workflow_of_warp(const ConvertOptions& options, const WarpMapFit& fit) {
  const std::string warp = options.converters.path().string();
  refuse_with_warp(options, kNotWithWarp, warp);
  require_model_of_fit(warp, "--from", options.from.name, fit.source_model);
  require_model_of_fit(warp, "--to", options.to.name, fit.template_model);
  refuse_diffuse(options,
                 "maps of the warp " + warp + " always have plain diffuse (a prefix cannot choose it; ");
  if (options.to.workflow)
    throw usage_error("--to: results of the warp " + warp +
                      " have the specular workflow (remove this option)");
  // The warp was made from maps of roughness.
  const RoughnessEncoding width = options.reads_glossiness()
                                      ? RoughnessEncoding::kGlossiness
                                      : options.roughness_encoding.value_or(RoughnessEncoding::kRoughness);
  // `remapc warp` reads metallic sets in the same way.
  ConversionChoice choice =
      choice_of_warp(fit, options.from.workflow.value_or(WorkflowKind::kSpecular), width);
  if (is_of_diffuse_alone(fit)) choose_diffuse_alone(options, choice);
  require_workflow(options, choice);
  return choice;
}

}  // namespace remap
