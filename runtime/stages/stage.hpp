// This file declares the stages of a converter, which run one after another over a block of texels,
// and makes converters of stages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "converter/converter_data.hpp"
#include "remap/converter.hpp"
#include "remap/workflow.hpp"

namespace remap {

// This many texels pass through all stages before the next texels. A row of them has 4 KB, so the rows that
// two stages share stay in the first-level cache.
inline constexpr std::size_t kBlockTexels = 1024;

// A Block knows where the rows of each parameter are. At first, they are the rows of the source. A stage
// reads rows and replaces them by new rows. The last stage writes directly into the rows of the target.
class Block {
 public:
  // `in` and `out` are the arguments of Converter::convert.
  Block(const MaterialRows<const float>& in, const MaterialRows<float>& out);

  // Selects the block of `size` texels, kBlockTexels or less, from `start`.
  void begin(std::size_t start, std::size_t size);
  // Returns true if the current stage is the last one. It then writes into the rows of the target.
  bool is_last() const noexcept { return is_last_; }
  void set_last(bool is_last) noexcept { is_last_ = is_last; }
  // Copies all rows that no stage has written to the target. Grey is copied to all channels.
  void finish();

  std::size_t size() const noexcept { return size_; }
  bool has(Parameter parameter) const noexcept { return rows_[parameter].count > 0; }
  bool is_grey(Parameter parameter) const noexcept { return rows_[parameter].count == 1; }
  // Returns true if the target has rows for the parameter.
  bool is_wanted(Parameter parameter) const noexcept { return out_[parameter].count > 0; }
  const float* row(Parameter parameter) const noexcept { return rows_[parameter].row[0]; }
  // Returns three rows. Grey becomes three equal channels.
  std::array<const float*, 3> color(Parameter parameter) const noexcept;

  // Returns rows for a new value of a parameter. From now on, row() and color() return them. They may be the
  // rows of the old value, so a stage must ask for the old rows first.
  float* make(Parameter parameter) { return make_color(parameter, 1)[0]; }
  std::array<float*, 3> make_color(Parameter parameter, std::size_t channels = 3);
  // Returns a row for values that nobody reads.
  float* make_unused() { return scratch(kParameterCount); }

 private:
  using Row = std::array<float, kBlockTexels>;
  float* scratch(std::size_t parameter, std::size_t channel = 0);

  // Lists the parameters that have rows, so that no loop visits all parameters. Most converters have two.
  struct Parameters {
    std::array<Parameter, kParameterCount> all{};
    std::size_t count = 0;
    std::span<const Parameter> list() const noexcept { return {all.data(), count}; }
  };
  template <typename Float>
  static Parameters parameters_of(const MaterialRows<Float>& rows);

  const MaterialRows<const float>& in_;
  const MaterialRows<float>& out_;
  Parameters sources_, targets_;
  MaterialRows<const float> rows_;
  std::size_t start_ = 0, size_ = 0;
  bool is_last_ = true;
  std::unique_ptr<std::array<std::array<Row, 3>, kParameterCount + 1>> scratch_;  // allocated on demand
};

class Stage {
 public:
  virtual ~Stage() = default;
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // Returns true if texels can be outside the stage's domain.
  virtual bool has_domain() const noexcept { return false; }
  // Replaces rows of the block. A stage with a domain returns the number of texels outside of it. If
  // `outside` is not null, the stage sets it to 1 for each of these texels and to 0 for all others. Many
  // threads may call this.
  virtual std::size_t run(Block& block, std::uint8_t* outside) const = 0;
  // Throws like Converter::self_test.
  virtual bool self_test() const { return true; }

 protected:
  Stage() = default;
};

// Returns a stage that calls `run`. It has neither a domain nor a test. Many threads may call
// it.
std::shared_ptr<const Stage> make_stage(std::function<void(Block& block)> run);

// Runs all stages over the block. Counts and flags the texels that are outside of any domain.
std::size_t run_stages(std::span<const std::shared_ptr<const Stage>> stages, Block& block,
                       std::uint8_t* outside);
// Returns true if all stages pass their tests.
bool self_test(std::span<const std::shared_ptr<const Stage>> stages);

// Makes a converter from `data`. Throws kNumeric if the domain is empty or negative.
std::unique_ptr<Converter> make_converter(const ConverterData& data,
                                          InstructionSet set = best_instruction_set());

// Makes a stage that converts base color and metallic to diffuse and specular by equation (2). The width
// stays unchanged. `diffuse` is the convention of the result, and `width` is the kind of width. Throws
// kInput, beginning with `context`, like require_valid().
std::shared_ptr<const Stage> specular_stage(const MetallicWorkflow& source, DiffuseConvention diffuse,
                                            RoughnessEncoding width, InstructionSet set,
                                            const std::string& context);

// Returns the id, models and encodings of a converter between workflows.
ConverterInfo ends_of(const WorkflowStages& stages, InstructionSet set);

// Makes a converter like make_workflow_converter() without BRDF, from a metallic workflow. Each texel has its
// own F0 of dielectrics, in kSpecular of the source (KHR_materials_specular). The F0 of `stages.source` is
// not used. Diffuse is scaled by 1 - max(F0).
std::unique_ptr<Converter> make_dielectric_converter(const WorkflowStages& stages, InstructionSet set);

}  // namespace remap
