// Stages of a converter, which run one after another over a block of texels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "remap/converter.hpp"

namespace remap {

// Texels that pass through all stages before the next: the rows that two stages share, 2 KB each, stay in the
// first-level cache.
inline constexpr std::size_t kBlockTexels = 1024;

// Where the rows of each parameter of a block are. At first in the source; a stage finds rows and makes
// others in their place. The last one makes those of the target itself.
class Block {
 public:
  // `in` and `out` as in Converter::convert.
  Block(const MaterialRows<const float>& in, const MaterialRows<float>& out);

  // The block of `size` texels, kBlockTexels or less, from `start`.
  void begin(std::size_t start, std::size_t size);
  // Whether what runs now is the last that runs: it makes rows of the target in place.
  bool is_last() const noexcept { return is_last_; }
  void set_last(bool is_last) noexcept { is_last_ = is_last; }
  // Copies to the target what is in other rows. Grey is copied to all channels.
  void finish();

  std::size_t size() const noexcept { return size_; }
  bool has(Parameter parameter) const noexcept { return rows_[parameter].count > 0; }
  bool is_grey(Parameter parameter) const noexcept { return rows_[parameter].count == 1; }
  // Whether the target has rows for it.
  bool is_wanted(Parameter parameter) const noexcept { return out_[parameter].count > 0; }
  const float* row(Parameter parameter) const noexcept { return rows_[parameter].row[0]; }
  // Grey stands for three equal channels.
  std::array<const float*, 3> color(Parameter parameter) const noexcept;

  // Rows for a new value of a parameter, where row() and color() find it from now on. They may be exactly the
  // rows of its old value, so a stage asks for those first.
  float* make(Parameter parameter) { return make_color(parameter, 1)[0]; }
  std::array<float*, 3> make_color(Parameter parameter, std::size_t channels = 3);
  // A row for what nobody reads.
  float* make_unused() { return scratch(kParameterCount); }

 private:
  using Row = std::array<float, kBlockTexels>;
  float* scratch(std::size_t parameter, std::size_t channel = 0);

  // The parameters that have rows: a block is short, and most converters have two.
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
  std::unique_ptr<std::array<std::array<Row, 3>, kParameterCount + 1>> scratch_;  // when a stage asks for it
};

class Stage {
 public:
  virtual ~Stage() = default;
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // Whether texels can be outside of what it covers.
  virtual bool has_domain() const noexcept { return false; }
  // Replaces rows of the block. With a domain: returns the number of texels outside, and sets `outside`, if
  // not null, to 1 for each of them and to 0 for each other. Can be called from many threads.
  virtual std::size_t run(Block& block, std::uint8_t* outside) const = 0;
  // Throws as Converter::self_test.
  virtual bool self_test() const { return true; }

 protected:
  Stage() = default;
};

// Runs all stages over the block. Counts and flags the texels that are outside for any of them.
std::size_t run_stages(std::span<const std::shared_ptr<const Stage>> stages, Block& block,
                       std::uint8_t* outside);
// Whether all stages pass their tests.
bool self_test(std::span<const std::shared_ptr<const Stage>> stages);

}  // namespace remap
