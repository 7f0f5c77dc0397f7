// Parses the text of a libsvm model into a sum of Gaussians.
#include "fit/svr/svm_model_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "model/limits.hpp"
#include "system/files.hpp"
#include "text/errors.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

std::string excerpt(std::string_view text) {
  std::string shown(text.substr(0, 40));
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > '~') c = '?';
  return "\"" + shown + (text.size() > 40 ? "...\"" : "\"");
}

std::string_view take_word(std::string_view& line) {
  constexpr std::string_view kBlanks = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

class ModelText {
 public:
  ModelText(std::string_view text, const std::string& place) : rest_(text), place_(place) {}

  // The next line without its line break; none after the last line.
  std::optional<std::string_view> next() {
    ++line_;
    if (rest_.empty()) return std::nullopt;
    const auto end = rest_.find('\n');
    if (end == std::string_view::npos) fail("the last line is incomplete");
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return line;
  }
  double number(std::string_view text, const std::string& what) const {
    const auto value = remap::parse_number(text);
    if (!value || !std::isfinite(*value)) fail(what + " is not a finite number: " + excerpt(text));
    return *value;
  }
  std::size_t count(std::string_view text, const std::string& what, std::size_t largest) const {
    std::size_t value = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc() || end != text.data() + text.size() || value > largest)
      fail(what + " is not an integer from 0 to " + std::to_string(largest) + ": " + excerpt(text));
    return value;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw input_error(place_ + ":" + std::to_string(line_) + ": " + what);
  }

 private:
  std::string_view rest_;
  const std::string& place_;
  std::size_t line_ = 0;
};

struct Header {
  double gamma = 0.0;
  double rho = 0.0;
  std::size_t vector_count = 0;
};

void require_value(const ModelText& text, const std::string& key, std::string_view value) {
  if (key == "svm_type" && value != "epsilon_svr" && value != "nu_svr")
    text.fail("unsupported svm_type " + excerpt(value) + " (use epsilon_svr or nu_svr)");
  if (key == "kernel_type" && value != "rbf")
    text.fail("unsupported kernel_type " + excerpt(value) + " (only rbf can be compiled)");
  if (key == "nr_class" && value != "2") text.fail("nr_class is " + excerpt(value) + " (a regression has 2)");
}

// Reads the header: lines `key value` in any order, up to and including the line `SV`.
Header read_header(ModelText& text) {
  std::map<std::string, std::string> values;
  for (;;) {
    const auto line = text.next();
    if (!line) text.fail("the header does not end with a line SV");
    std::string_view rest = *line;
    const std::string key(take_word(rest));
    if (key == "SV") break;
    const std::string_view value = take_word(rest);
    // probA belongs to probability estimates; degree and coef0 belong to kernels that are refused below.
    constexpr std::array<std::string_view, 8> kKeys = {"svm_type", "kernel_type", "gamma", "nr_class",
                                                       "total_sv", "rho",         "probA", "degree"};
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end() && key != "coef0")
      text.fail("unknown header line " + excerpt(*line));
    if (value.empty() || !take_word(rest).empty())
      text.fail("header line " + excerpt(*line) + " must have one value");
    if (!values.try_emplace(key, value).second) text.fail("repeated header line " + key);
    require_value(text, key, value);
    if (key == "gamma" && !(text.number(value, key) > 0.0))
      text.fail("gamma must be above 0, not " + excerpt(value));
    if (key == "rho") text.number(value, key);
    if (key == "total_sv") text.count(value, key, remap::kMostVectors);
  }
  for (const char* key : {"svm_type", "kernel_type", "gamma", "total_sv", "rho"})
    if (!values.contains(key)) text.fail(std::string("the header has no line ") + key);
  return {text.number(values["gamma"], "gamma"), text.number(values["rho"], "rho"),
          text.count(values["total_sv"], "total_sv", remap::kMostVectors)};
}

// Reads a line `weight index:value index:value ...` with indices from 1 in increasing order.
void read_vector(const ModelText& text, std::string_view line, remap::KernelExpansion& expansion) {
  const std::size_t input_count = expansion.inputs.size();
  const std::size_t begin = expansion.vectors.size();
  expansion.weights.push_back(text.number(take_word(line), "the weight"));
  expansion.vectors.resize(begin + input_count, 0.0);
  std::size_t last = 0;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
    const auto colon = word.find(':');
    if (colon == std::string_view::npos) text.fail(excerpt(word) + " is not of the form index:value");
    const std::size_t index = text.count(word.substr(0, colon), "an index", input_count);
    if (index <= last) text.fail("index " + std::to_string(index) + " is out of order");
    expansion.vectors[begin + index - 1] = text.number(word.substr(colon + 1), "a value");
    last = index;
  }
}

}  // namespace

remap::KernelExpansion expansion_from_svm_model(std::string_view content, std::size_t input_count,
                                                const std::string& place) {
  ModelText text(content, place);
  const Header header = read_header(text);
  remap::KernelExpansion expansion;
  expansion.inputs.resize(input_count);
  expansion.gamma = header.gamma;
  expansion.bias = -header.rho;
  while (const auto line = text.next()) {
    if (expansion.count() == header.vector_count)
      text.fail("more vectors than total_sv (" + std::to_string(header.vector_count) + ")");
    read_vector(text, *line, expansion);
  }
  if (expansion.count() != header.vector_count)
    text.fail("the file has " + std::to_string(expansion.count()) + " vectors, but total_sv is " +
              std::to_string(header.vector_count));
  return expansion;
}

remap::KernelExpansion read_svm_model(const std::filesystem::path& path, std::size_t input_count) {
  return expansion_from_svm_model(remap::read_file(path), input_count, path.string());
}

}  // namespace remapc
