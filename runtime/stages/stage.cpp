#include "stages/stage.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace remap {
namespace {

class FunctionStage final : public Stage {
 public:
  explicit FunctionStage(std::function<void(Block& block)> run) : run_(std::move(run)) {}
  std::size_t run(Block& block, std::uint8_t*) const override {
    run_(block);
    return 0;
  }

 private:
  std::function<void(Block& block)> run_;
};

}  // namespace

std::shared_ptr<const Stage> make_stage(std::function<void(Block& block)> run) {
  return std::make_shared<FunctionStage>(std::move(run));
}

template <typename Float>
Block::Parameters Block::parameters_of(const MaterialRows<Float>& rows) {
  Parameters parameters;
  for (std::size_t p = 0; p < kParameterCount; ++p)
    if (const auto parameter = static_cast<Parameter>(p); rows[parameter].count > 0)
      parameters.all[parameters.count++] = parameter;
  return parameters;
}

Block::Block(const MaterialRows<const float>& in, const MaterialRows<float>& out)
    : in_(in), out_(out), sources_(parameters_of(in)), targets_(parameters_of(out)) {}

void Block::begin(std::size_t start, std::size_t size) {
  start_ = start;
  size_ = size;
  is_last_ = true;
  for (const Parameter parameter : sources_.list()) {
    const auto& from = in_[parameter];
    auto& to = rows_[parameter];
    to.count = from.count;
    for (std::size_t c = 0; c < from.count; ++c) to.row[c] = from.row[c] + start;
  }
}

std::array<const float*, 3> Block::color(Parameter parameter) const noexcept {
  const auto& rows = rows_[parameter];
  if (rows.count == 1) return {rows.row[0], rows.row[0], rows.row[0]};
  return rows.row;
}

std::array<float*, 3> Block::make_color(Parameter parameter, std::size_t channels) {
  const auto& target = out_[parameter];
  auto& rows = rows_[parameter];
  rows.count = channels;
  std::array<float*, 3> made{};
  for (std::size_t c = 0; c < channels; ++c) {
    const bool is_in_place = is_last_ && c < target.count;
    made[c] = is_in_place ? target.row[c] + start_ : scratch(static_cast<std::size_t>(parameter), c);
    rows.row[c] = made[c];
  }
  return made;
}

float* Block::scratch(std::size_t parameter, std::size_t channel) {
  if (!scratch_) scratch_.reset(new std::array<std::array<Row, 3>, kParameterCount + 1>);
  return (*scratch_)[parameter][channel].data();
}

void Block::finish() {
  for (const Parameter parameter : targets_.list()) {
    const auto& target = out_[parameter];
    const auto from = color(parameter);
    for (std::size_t c = 0; c < target.count; ++c)
      if (target.row[c] + start_ != from[c]) std::copy_n(from[c], size_, target.row[c] + start_);
  }
}

std::size_t run_stages(std::span<const std::shared_ptr<const Stage>> stages, Block& block,
                       std::uint8_t* outside) {
  std::array<std::uint8_t, kBlockTexels> any, of_stage;
  const auto domains =
      std::count_if(stages.begin(), stages.end(), [](const auto& s) { return s->has_domain(); });
  std::uint8_t* const flags = outside == nullptr && domains > 1 ? any.data() : outside;
  if (domains == 0 && flags != nullptr) std::fill_n(flags, block.size(), std::uint8_t{0});
  std::size_t count = 0;
  bool is_first = true;
  const bool is_last = block.is_last();
  for (const auto& stage : stages) {
    block.set_last(is_last && &stage == &stages.back());
    if (!stage->has_domain()) {
      stage->run(block, nullptr);
    } else if (is_first) {
      count = stage->run(block, flags);
      is_first = false;
    } else if (stage->run(block, of_stage.data()) > 0) {
      for (std::size_t i = 0; i < block.size(); ++i)
        flags[i] = static_cast<std::uint8_t>(flags[i] | of_stage[i]);
      count = std::accumulate(flags, flags + block.size(), std::size_t{0});
    }
  }
  return count;
}

bool self_test(std::span<const std::shared_ptr<const Stage>> stages) {
  return std::ranges::all_of(stages, [](const auto& stage) { return stage->self_test(); });
}

}  // namespace remap
