// What `texremap convert` says of a conversion that is done, to people and to scripts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command_line/resource_use.hpp"
#include "convert/path.hpp"
#include "texremap/conversion_jobs.hpp"
#include "texture/material_survey.hpp"
#include "texture/texture_pass.hpp"

namespace remap {

// What a run converts with: converters that are compiled in or were made for it, of a fit or of the steps of
// a path, and the workflows around them.
struct ChosenConverter {
  std::unique_ptr<Converter> owned;
  const Converter* brdf = nullptr;  // of width and specular; null where both ends have one BRDF
  ConverterPath path;               // its steps
  WorkflowChoice workflow;
  std::unique_ptr<MaterialConverter> material;  // all of it

  const ConverterInfo& info() const noexcept { return material->info(); }
  // What tells its domain.
  const ConverterInfo& domain() const noexcept { return brdf != nullptr ? brdf->info() : info(); }
};

// The stages of a conversion between workflows.
WorkflowStages stages_of(const ChosenConverter& chosen);
// What results say that they were made by: the ids of the steps, and the formula of a workflow.
std::string converter_ids(const ChosenConverter& chosen);

// What came of one set, of all its tiles.
struct JobReport {
  struct Result {
    std::filesystem::path path;
    std::vector<Parameter> parameters;  // what it holds
    bool mask = false;
  };
  std::string name;                // empty for the one set of a command line
  std::vector<std::string> tiles;  // those that were converted; empty where the set has none
  std::vector<std::filesystem::path> inputs;
  std::vector<Result> results;                // those that would be, in a dry run and after a failure
  std::vector<std::filesystem::path> copies;  // the same, of files that are carried along
  Transfer specular_transfer = Transfer::kLinear;
  std::optional<DielectricF0> estimated_f0;  // of maps of the specular workflow, on their way to metallic
  std::vector<std::string> warnings;
  std::optional<std::string> failure;
  bool was_done = false;  // by an earlier run, which this one resumes
  MapStatistics statistics;
  double seconds = 0.0;           // of all tiles together, whatever ran at once
  std::uintmax_t bytes_read = 0;  // sizes of the files
  std::uintmax_t bytes_written = 0;

  // `other`: of the next tile of the set.
  JobReport& operator+=(const JobReport& other);
};

// All of them.
struct Outcome {
  const ChosenConverter& chosen;
  const JobList& list;
  std::vector<JobReport> reports;  // one a set
  bool dry_run = false;
  double seconds = 0.0;
  ResourceUse used;  // processor time short of seconds times threads was waiting

  std::size_t failed_count() const;  // sets, and what was left out and should not have been
};

// The lines for one set: on standard error, to people.
void print_job(const std::string& program, const Outcome& outcome, const JobReport& report);
// The line for all: sets, texels, time.
void print_summary(const std::string& program, const Outcome& outcome);
void print_json(const Outcome& outcome);

// Of a conversion without maps.
struct ConvertedValues {
  struct Value {
    std::string name;
    std::vector<float> channels;
    bool is_scalar = false;  // a number rather than a list in JSON
  };
  std::vector<Value> values;
  bool in_domain = true;
};
void print_values(const ChosenConverter& chosen, const ConvertedValues& values, bool json);

}  // namespace remap
