#include "texremap/options/part.hpp"

#include <array>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <vector>

#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

// A Scheduler holds the variables by which a scheduler describes a job of an array. A variable is null if the
// scheduler does not set it.
struct Scheduler {
  const char* name;
  const char* index;
  const char *first, *last, *step, *count;
  std::size_t usual_first;  // number of the first job of an array, by default
};

// The names are from these manuals: Slurm "Job Array Support", AWS Batch "Array jobs", Kubernetes "Indexed
// Job", Grid Engine qsub -t, PBS qsub -J, LSF bsub -J "name[1-N]", GNU parallel {#}.
constexpr std::array<Scheduler, 7> kSchedulers = {{
    {"Slurm", "SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX", "SLURM_ARRAY_TASK_STEP",
     "SLURM_ARRAY_TASK_COUNT", 1},
    {"AWS Batch", "AWS_BATCH_JOB_ARRAY_INDEX", nullptr, nullptr, nullptr, "AWS_BATCH_JOB_ARRAY_SIZE", 0},
    {"Kubernetes", "JOB_COMPLETION_INDEX", nullptr, nullptr, nullptr, nullptr, 0},
    {"Grid Engine", "SGE_TASK_ID", "SGE_TASK_FIRST", "SGE_TASK_LAST", "SGE_TASK_STEPSIZE", nullptr, 1},
    {"PBS", "PBS_ARRAY_INDEX", nullptr, nullptr, nullptr, nullptr, 1},
    {"LSF", "LSB_JOBINDEX", nullptr, "LSB_JOBINDEX_END", "LSB_JOBINDEX_STEP", nullptr, 1},
    {"GNU parallel", "PARALLEL_SEQ", nullptr, nullptr, nullptr, nullptr, 1},
}};

std::optional<std::size_t> number_in(std::string_view text) {
  std::size_t value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

class ArrayJob {
 public:
  using Environment = std::function<const char*(const char*)>;
  ArrayJob(const Scheduler& scheduler, const Environment& environment)
      : scheduler_(scheduler), environment_(environment) {}

  // Returns true if this is a job of an array. Outside of an array, Grid Engine sets "undefined" and LSF 0.
  bool is_one() const {
    const char* text = environment_(scheduler_.index);
    if (text == nullptr || *text == '\0' || std::strcmp(text, "undefined") == 0) return false;
    return std::strcmp(scheduler_.name, "LSF") != 0 || std::strcmp(text, "0") != 0;
  }
  std::string text() const { return std::string(scheduler_.index) + "=" + environment_(scheduler_.index); }
  Part part(std::optional<std::size_t> count) const;

 private:
  std::optional<std::size_t> number(const char* name) const {
    const char* text = name == nullptr ? nullptr : environment_(name);
    if (text == nullptr) return std::nullopt;
    const auto value = number_in(text);
    if (!value)
      throw usage_error("--part auto: " + std::string(name) + "=" + text +
                        " is not a number (give --part I/N)");
    return value;
  }
  // Returns the size of the array, if the environment contains it.
  std::optional<std::size_t> own_count(std::size_t first) const;

  const Scheduler& scheduler_;
  const Environment& environment_;
};

std::optional<std::size_t> ArrayJob::own_count(std::size_t first) const {
  const auto count = number(scheduler_.count), last = number(scheduler_.last);
  if (number(scheduler_.step).value_or(1) != 1)
    throw usage_error(
        "--part auto: the numbers of the job array have steps (submit consecutive numbers, such as 1-4, or "
        "give --part I/N)");
  if (!last) return count;
  const std::size_t all = *last + 1 - first;
  if (count && *count != all)
    throw usage_error("--part auto: the array has only " + std::to_string(*count) + " of the numbers " +
                      std::to_string(first) + " to " + std::to_string(*last) +
                      " (give --part auto/N; N is the number of all parts)");
  return all;
}

Part ArrayJob::part(std::optional<std::size_t> count) const {
  const std::size_t index = *number(scheduler_.index);
  // If the user gives the number of parts, the array may be only some of these parts, for example the failed
  // ones. Then its first number may differ from the first number of the whole array.
  const std::size_t first =
      count ? scheduler_.usual_first : number(scheduler_.first).value_or(scheduler_.usual_first);
  const bool is_given = count.has_value();
  if (!count) count = own_count(first);
  if (!count)
    throw usage_error(
        "--part auto: " + std::string(scheduler_.name) +
        " does not report the size of the array (give --part auto/N; N is the number of all parts)");
  if (index < first || index - first >= *count)
    throw usage_error("--part auto" + (is_given ? "/" + std::to_string(*count) : "") + ": " + text() +
                      " is not between " + std::to_string(first) + " and " +
                      std::to_string(first + *count - 1) + " (give the array only these numbers)");
  const std::size_t own = index - first + 1;
  return {own, *count,
          std::string(scheduler_.name) + ": " + text() + " is part " + std::to_string(own) + " of " +
              std::to_string(*count)};
}

Part part_in(const ArrayJob::Environment& environment, std::optional<std::size_t> count) {
  std::vector<ArrayJob> jobs;
  for (const Scheduler& scheduler : kSchedulers)
    if (const ArrayJob job(scheduler, environment); job.is_one()) jobs.push_back(job);
  if (jobs.empty())
    throw usage_error("--part auto: not running in an array job (none of " +
                      joined(kSchedulers, ", ", &Scheduler::index) + " is set; give --part I/N)");
  if (jobs.size() > 1)
    throw usage_error("--part auto: " + jobs[0].text() + " and " + jobs[1].text() +
                      " are both set (give --part I/N)");
  return jobs.front().part(count);
}

}  // namespace

std::string name_of(const Part& part) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "part-%04zu-of-%04zu", part.index, part.count);
  return text.data();
}

std::optional<Part> part_named(const std::string& name) {
  constexpr std::string_view kBegin = "part-", kMiddle = "-of-";
  const std::size_t middle = name.find(kMiddle);
  if (!name.starts_with(kBegin) || middle == std::string::npos) return std::nullopt;
  const std::string_view text = name;
  const auto index = number_in(text.substr(kBegin.size(), middle - kBegin.size()));
  const auto count = number_in(text.substr(middle + kMiddle.size()));
  if (!index || !count || *index < 1 || *index > *count) return std::nullopt;
  return Part{*index, *count};
}

Part part_of(const std::string& word, const ArrayJob::Environment& environment) {
  const std::string_view text = word;
  const std::size_t slash = text.find('/');
  const auto count = slash == std::string_view::npos ? std::nullopt : number_in(text.substr(slash + 1));
  const std::string_view first = text.substr(0, slash);
  if (first == "auto" && slash == std::string_view::npos) return part_in(environment, std::nullopt);
  if (first == "auto" && count && *count > 0) return part_in(environment, count);
  const auto index = number_in(first);
  if (!index || !count || *index < 1 || *index > *count)
    throw usage_error("--part: invalid value '" + word +
                      "' (for four parts, use 1/4 to 4/4, auto or auto/4)");
  return {*index, *count};
}

}  // namespace remap
