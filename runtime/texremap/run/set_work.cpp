#include <algorithm>
#include <functional>
#include <memory>

#include "check/rules.hpp"
#include "command_line/progress.hpp"
#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "core/system.hpp"
#include "remap/version.hpp"
#include "texremap/plan/conversion_request.hpp"
#include "texremap/run/run_jobs.hpp"
#include "texture/content_hash.hpp"
#include "texture/material_survey.hpp"
#include "texture/target_plan.hpp"
#include "texture/texture_pass.hpp"

namespace remap {
namespace {

using OpenFiles = std::vector<std::shared_ptr<const InputFile>>;

// Returns the files of the maps, each once. A file with several parts has several maps.
OpenFiles files_of(const TextureSet& set) {
  OpenFiles files;
  for (const ImageReader& map : set.maps)
    if (!contains(files, map.file())) files.push_back(map.file());
  return files;
}

// Returns the open file with the path. Opens the file if it is not in `files`.
std::shared_ptr<const InputFile> file_among(const OpenFiles& files, const std::filesystem::path& path) {
  const auto found = std::ranges::find(files, path, [](const auto& file) { return file->path(); });
  return found != files.end() ? *found : std::make_shared<const InputFile>(path);
}

// Returns a hash of the files of a set, the use of their channels, and the files that are copied with it.
std::string inputs_hash(const OpenFiles& files, const SetWork& set, const OpenFiles& copied) {
  ContentHash hash;
  for (const auto& file : files) hash.add_file(*file);
  const auto add = [&](const std::string& name, const ParameterRequest& asked) {
    hash.add(name);
    if (const auto* map = std::get_if<MapName>(&asked.source)) {
      hash.add(map->file.filename().string());
      for (const std::string& channel : map->channels) hash.add(channel);
    }
  };
  for (const auto& [parameter, asked] : set.request.parameters) add(plain_name(parameter), asked);
  for (const Carried<ParameterRequest>& carried : set.request.carried) add(carried.name, carried.parameter);
  hash.add(set.request.convention ? encoding_name(*set.request.convention) : "");
  for (const auto& file : copied) hash.add_file(*file);
  return hash.hex();
}

Metadata metadata_of(const BuiltConversion& chosen) {
  const ConverterInfo& info = chosen.info();
  return {{"remap:converter", converter_ids(chosen)},
          {"remap:source", info.source.model},
          {"remap:target", info.target.model},
          {"remap:version", kVersion}};
}

// Refuses maps that were converted before to another model than the source of this conversion.
void require_not_converted(const TextureSet& set, const BuiltConversion& chosen, JournalLookup& journals) {
  const std::string& source = chosen.info().source.model;
  const ConversionChoice& workflow = chosen.choice;
  const WorkflowEnd end = workflow.is_material()
                              ? *workflow.source
                              : workflow_over(source, WorkflowKind::kSpecular, RoughnessEncoding::kAlpha).end;
  const std::string& brdf = workflow.is_material() ? workflow.source_brdf : source;
  for (const ImageReader& map : set.maps) {
    std::optional<std::string> model = map.noted_metadata("remap:target");
    if (!model) model = journals.target_of(*map.file());
    if (model && *model != source && !holds_materials_of(*model, end, brdf))
      throw usage_error(map.path().string() + ": was already converted to " + *model +
                        ", but would be read as " + source + " (--force converts it anyway)");
  }
}

std::vector<std::filesystem::path> results_of(const TargetPlan& plan) {
  std::vector<std::filesystem::path> files;
  for (const PlannedFile& map : plan.maps) files.push_back(map.path);
  for (const PlannedFile& copy : plan.copies) files.push_back(copy.path);
  return files;
}

// Records the color spaces in which the set is read and written.
void note_colors(const TextureSet& set, const std::vector<TargetMap>& targets, JobReport& report) {
  for (const auto& [parameter, values] : set.parameters)
    if (is_color(parameter) && values.is_map() &&
        (values.is_whole_numbers || values.transfer_reason != TransferReason::kUsual))
      ++report.colors[{parameter, false, values.transfer, values.transfer_reason}];
  for (const TargetMap& target : targets)
    for (std::size_t p = 0; p < target.parts.size(); ++p) {
      const TargetPart& part = target.parts[p];
      for (std::size_t c = 0; c < part.channels.size(); ++c) {
        const auto* channel = std::get_if<ConvertedChannel>(&part.channels[c]);
        if (channel == nullptr || !is_color(channel->parameter) || channel->index > 0) continue;
        const PixelType type = target.writer->layout(static_cast<int>(p)).channels[c].type;
        const ColorStorage& storage = *part.changes.colors;
        const auto source = set.parameters.find(channel->parameter);
        const bool is_asked =
            source != set.parameters.end() && source->second.transfer_reason == TransferReason::kUser;
        if (!is_integer(type) && !storage.chosen && !is_asked) continue;
        const TransferReason reason = storage.chosen                         ? TransferReason::kUser
                                      : storage.followed && is_integer(type) ? TransferReason::kFile
                                                                             : TransferReason::kUsual;
        ++report.colors[{channel->parameter, true, storage.of(type), reason}];
      }
    }
}

JobReport::Result result_of(const PlannedFile& planned) {
  JobReport::Result result{planned.path, {}, false};
  for (const TargetPart& part : planned.parts)
    for (const TargetChannel& channel : part.channels) {
      if (const auto* converted = std::get_if<ConvertedChannel>(&channel))
        result.parameters.push_back(converted->parameter);
      result.mask |= std::holds_alternative<MaskChannel>(channel);
    }
  return result;
}

class SetWorker {
 public:
  SetWorker(const ConvertPlan& plan, OutputFolder& folder, int threads)
      : plan_(plan),
        sets_(*plan.sets()),
        chosen_(sets_.chosen),
        folder_(folder),
        pass_{sets_.targets.treatment} {
    pass_.thread_count = threads;
    pass_.cancelled = &interruption();
  }
  void run(const Job& job, const std::function<void(double)>& progress, JobReport& report);

 private:
  void commit(const Job& job, const TargetPlan& targets, const OpenFiles& files, const std::string& inputs,
              std::vector<TargetMap>& finished);
  std::unique_ptr<Converter> survey(TextureSet& set, JobReport& report) const;
  void note_issues(const TextureSet& set, const std::vector<TargetMap>& targets, JobReport& report) const;
  // Returns the encoding of roughness results if neither a name nor an option gives it. With a workflow, it
  // is the target model's. Otherwise, it is the encoding of the inputs, or the target model's if that is
  // unknown.
  RoughnessEncoding usual_width(const TextureSet& set) const {
    if (chosen_.choice.is_material()) return width_of(*chosen_.choice.target);
    return set.convention.value_or(chosen_.info().target.roughness);
  }

  const ConvertPlan& plan_;
  const SetPlan& sets_;
  const BuiltConversion& chosen_;
  OutputFolder& folder_;
  PassOptions pass_;
  JournalLookup journals_;  // journals of the inputs
};

// Reports wrong colors in the same way as `texremap check`.
void note_colors(const MaterialSample& sample, const TextureSet& set, JobReport& report) {
  constexpr std::array kColors = {std::pair(Parameter::kSpecular, Role::kSpecular),
                                  std::pair(Parameter::kDiffuse, Role::kDiffuse),
                                  std::pair(Parameter::kBaseColor, Role::kBaseColor)};
  for (const auto& [parameter, role] : kColors) {
    const SetParameter* const map = set.map_of(parameter);
    if (map == nullptr) continue;
    const auto issue = color_issue(role, map->transfer, sample.at(parameter));
    if (!issue) continue;
    std::string text = set.maps[map->channels.front().map].path().string() + ": " + plain_name(parameter) +
                       ", " + issue->text;
    if (issue->transfer)
      text += " (use --color-space " + plain_name(parameter) + "=" +
              std::string(name_of(kTransfers, *issue->transfer)) + " in that case)";
    report.warnings.push_back(text);
  }
}

// Samples the maps of a workflow and adds warnings. Returns a converter only for this set if its dielectric
// F0 is estimated from the maps.
std::unique_ptr<Converter> SetWorker::survey(TextureSet& set, JobReport& report) const {
  const ConversionChoice& workflow = chosen_.choice;
  if (!workflow.is_material()) return nullptr;
  const MaterialSample sample = sample_materials(set);
  note_colors(sample, set, report);
  if (!workflow.is_to_metallic() || kind_of(*workflow.source) != WorkflowKind::kSpecular) return nullptr;
  WorkflowStages stages = stages_of(chosen_.choice, chosen_.brdf);
  const RoughnessEncoding width = set.convention.value_or(chosen_.info().source.roughness);
  if (!std::holds_alternative<double>(sets_.dielectric_f0))
    report.estimated_f0 = estimated_f0(sample, stages, width);
  if (sets_.dielectric_f0 != F0Choice(F0Source::kMaps)) return nullptr;
  if (!report.estimated_f0 || !report.estimated_f0->is_certain) {
    report.warnings.push_back(report.inputs.front().string() +
                              ": too few texels to estimate the dielectric F0; the default is used "
                              "(--dielectric-f0 VALUE sets it)");
    return nullptr;
  }
  std::get<MetallicWorkflow>(stages.target).dielectric_f0 = used_f0(*report.estimated_f0);
  return make_workflow_converter(stages, chosen_.info().instructions);
}

// Reports maps of one value that have visible traces of color.
void note_tints(const TextureSet& set, JobReport& report) {
  constexpr float kVisibleTint = 0.01f;
  for (const auto& [parameter, tint] : report.statistics.tints) {
    const SetParameter* parameter_map = set.map_of(parameter);
    if (parameter_map == nullptr || tint <= kVisibleTint) continue;
    const ChannelPlace used = parameter_map->channels.front();
    const ImageReader& map = set.maps[used.map];
    report.warnings.push_back(map.path().string() + ": is not exactly grey: the channels differ from " +
                              map.layout().channels[used.channel].name + ", which is used, by at most " +
                              fixed(255.0 * static_cast<double>(tint), 0) + " of 255");
  }
}

void SetWorker::note_issues(const TextureSet& set, const std::vector<TargetMap>& targets,
                            JobReport& report) const {
  for (const std::string& remark : remarks(set)) report.warnings.push_back(remark);
  // In packed layouts, the first file with a constant is the file that lacks a map.
  const auto has_constant = [](const TargetMap& target) {
    const auto is_constant = [](const TargetChannel& channel) {
      return std::holds_alternative<float>(channel);
    };
    return std::ranges::any_of(target.parts.front().channels, is_constant);
  };
  const auto packed = std::ranges::find_if(targets, has_constant);
  if (packed != targets.end() && sets_.targets.layout.file_with(Parameter::kMetallic) != nullptr) {
    const auto note = [&](const std::string& name, const std::string& value) {
      const auto has_name = [&](const Carried<SetParameter>& carried) { return carried.name == name; };
      if (sets_.targets.layout.has_place_for(name) && std::ranges::none_of(set.carried, has_name))
        report.warnings.push_back(packed->writer->path().string() + ": no " + name + " map; " + name +
                                  " is set to " + value);
    };
    note("occlusion", "1");
    if (!chosen_.choice.is_to_metallic()) note("metallic", "0");
  }
  for (const TargetMap& target : targets) {
    if (const std::string& lossy = target.writer->layout().lossy_compression; !lossy.empty())
      report.warnings.push_back(target.writer->path().string() + ": " + lossy +
                                " compression changes values (--format png or exr keeps them)");
  }
}

// Makes a finished copy without a final name, and appends the function that gives it the name. The copy is
// removed with this function if it never gets a name.
FinishedFile finished_copy(const PlannedFile& copy, const std::shared_ptr<const InputFile>& source,
                           std::vector<std::function<void()>>& renames) {
  if (copy.turns_green) {
    const std::shared_ptr<NewImage> image = turned_copy(source, copy.path);
    renames.push_back([image] { image->commit(Flush::kNo); });
    return finished_file(*image);
  }
  const auto file = std::make_shared<NewFile>(copy.path);
  renames.push_back([file] { file->commit(Flush::kNo); });
  add_copy(*source, *file);
  file->finish();
  return finished_file(*file);
}

// Gives the finished results and copies of a set their final names.
void SetWorker::commit(const Job& job, const TargetPlan& targets, const OpenFiles& files,
                       const std::string& inputs, std::vector<TargetMap>& finished) {
  folder_.begin(results_of(targets));
  std::vector<FinishedFile> results;
  for (const TargetMap& target : finished) results.push_back(finished_file(*target.writer));
  std::vector<std::function<void()>> renames;
  for (const PlannedFile& copy : targets.copies)
    results.push_back(finished_copy(copy, file_among(files, copy.source), renames));
  folder_.commit(job.name + (job.tile.empty() ? "" : " " + job.tile), inputs, results, [&] {
    for (TargetMap& target : finished) target.writer->commit(Flush::kNo);
    for (const auto& rename : renames) rename();
  });
}

void SetWorker::run(const Job& job, const std::function<void(double)>& progress, JobReport& report) {
  const Stopwatch stopwatch;
  const auto& work = std::get<SetWork>(job.work);
  TextureSet set = open_texture_set(work.request);
  require_scale(set, set.convention.value_or(chosen_.info().source.roughness));
  const OpenFiles files = files_of(set);
  for (const auto& file : files) report.inputs.push_back(file->path());
  report.left_behind = work.left_behind;
  if (const SetParameter* specular = set.map_of(Parameter::kSpecular))
    report.specular_transfer = specular->transfer;
  if (!plan_.force) require_not_converted(set, chosen_, journals_);

  TargetChoice choice = sets_.targets;
  choice.folder = work.folder;
  choice.diagnosis_folder = work.diagnosis_folder;
  choice.names = work.names;
  choice.metadata = metadata_of(chosen_);
  choice.copies = work.copies;
  if (work.effect) {
    report.effect = work.effect;
    apply(*work.effect, choice);
    if (work.effect->written.empty())
      throw usage_error(report.inputs.front().string() + ": does not change any input of " +
                        chosen_.info().target.model +
                        ", so texremap would write no map (give only numbers to print the result)");
  }
  if (pass_.bad_texels != BadTexels::kKeep) choice.unchanged.clear();
  const RoughnessEncoding width = written_width(choice, set, usual_width(set));
  const bool is_exponent = width == RoughnessEncoding::kExponent;
  choice.width_name = width == RoughnessEncoding::kGlossiness ? "glossiness"
                      : is_exponent                           ? "exponent"
                                                              : "roughness";
  if (sets_.scales_exponents || width != set.convention.value_or(chosen_.info().source.roughness))
    std::erase(choice.unchanged, Parameter::kRoughness);
  const TargetPlan targets = plan_targets(set, choice);
  if (is_exponent && !sets_.scales_exponents) require_target_scale(set, targets);
  for (const PlannedFile& map : targets.maps) report.results.push_back(result_of(map));
  for (const PlannedFile& copy : targets.copies)
    if (copy.parts.empty())
      report.copies.push_back(copy.path);
    else
      report.results.push_back(result_of(copy));
  const std::vector<std::filesystem::path> results = results_of(targets);
  for (const std::filesystem::path& file : results) folder_.take(file, job.owner);
  report.warnings = work.notes;
  report.warnings.insert(report.warnings.end(), targets.unplaced.begin(), targets.unplaced.end());
  const bool needs_hash = !plan_.dry_run || folder_.may_be_done(results);
  OpenFiles all = files, copied;
  if (needs_hash)
    for (const CopiedFile& copy : work.copies) {
      copied.push_back(file_among(all, copy.source));
      all.push_back(copied.back());
    }
  const std::string inputs = needs_hash ? inputs_hash(files, work, copied) : "";
  report.was_done = folder_.is_done(inputs, results);
  if (report.was_done) return;
  for (const std::filesystem::path& file : results) folder_.require_free(file);
  if (plan_.dry_run) {
    report.plan = planned_roles(set, targets, choice, work, chosen_.info().source.roughness, width);
    return;
  }

  const std::unique_ptr<Converter> own = survey(set, report);
  std::vector<TargetMap> maps = open_targets(set, targets);
  note_issues(set, maps, report);
  note_colors(set, maps, report);
  for (const TargetMap& map : maps)
    report.has_compression_level |= map.writer->layout().has_compression_level;
  if (!plan_.list.has_several) require_effect(plan_, {report});
  PassOptions pass = pass_;
  pass.target_convention = width;
  pass.progress = progress;
  pass.commit = [&](std::vector<TargetMap>& finished) { commit(job, targets, all, inputs, finished); };
  report.statistics = run_texture_pass(set, maps, own ? *own : chosen_.converter(), pass);
  note_tints(set, report);
  report.bytes_read = size_of(report.inputs);
  for (const JobReport::Result& result : report.results) report.bytes_written += size_of({result.path});
  report.seconds = stopwatch.seconds();
}

}  // namespace

JobWorker set_worker(const ConvertPlan& plan, OutputFolder& folder, int threads) {
  const auto worker = std::make_shared<SetWorker>(plan, folder, threads);
  return [worker](const Job& job, const std::function<void(double)>& progress, JobReport& report) {
    worker->run(job, progress, report);
  };
}

void require_effect(const ConvertPlan& plan, const std::vector<JobReport>& reports) {
  if (plan.sets() == nullptr || plan.dry_run || plan.part) return;
  const auto converted = [](const JobReport& report) { return !report.failure && !report.was_done; };
  if (std::ranges::none_of(reports, converted)) return;
  if (plan.sets()->targets.compression_level &&
      std::ranges::none_of(reports, &JobReport::has_compression_level))
    throw usage_error(
        "--compression: has no effect, because it applies only to PNG, and to EXR and TIFF with zip "
        "compression (remove this option)");
}

std::uintmax_t size_of(const std::vector<std::filesystem::path>& files) {
  std::uintmax_t bytes = 0;
  for (const std::filesystem::path& file : files) {
    std::error_code failure;
    const std::uintmax_t size = std::filesystem::file_size(file, failure);
    if (!failure) bytes += size;
  }
  return bytes;
}

}  // namespace remap
