#include "emit/text_template.hpp"

#include <set>
#include <stdexcept>

namespace remapc {
namespace {

// Fills the holes of one line; values of several lines continue at the indentation of the line.
std::string fill_line(std::string_view line, const std::map<std::string, std::string>& values,
                      std::set<std::string>* used) {
  const std::string indentation(line.substr(0, line.find_first_not_of(' ')));
  std::string filled;
  bool vanishes = false;
  while (!line.empty()) {
    const std::size_t start = line.find('@');
    filled += line.substr(0, start);
    if (start == std::string_view::npos) break;
    const std::size_t end = line.find('@', start + 1);
    if (end == std::string_view::npos) throw std::logic_error("template: an @ without partner");
    const std::string name(line.substr(start + 1, end - start - 1));
    const auto value = values.find(name);
    if (value == values.end()) throw std::logic_error("template: no value for @" + name + "@");
    used->insert(name);
    const bool alone = filled == indentation && end + 1 == line.size();
    vanishes = alone && value->second.empty();
    std::string_view text = value->second;
    if (alone && text.ends_with('\n')) text.remove_suffix(1);  // the line brings its own end
    for (std::size_t i = 0; i < text.size(); ++i) {
      filled += text[i];
      const bool more = text[i] == '\n' && i + 1 < text.size() && text[i + 1] != '\n';
      if (more) filled += indentation;
    }
    line.remove_prefix(end + 1);
  }
  return vanishes ? "" : filled + "\n";
}

}  // namespace

std::string fill_template(std::string_view text, const std::map<std::string, std::string>& values) {
  std::string filled;
  std::set<std::string> used;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    filled += fill_line(text.substr(0, end), values, &used);
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  for (const auto& [name, value] : values)
    if (!used.contains(name)) throw std::logic_error("template: no hole for @" + name + "@");
  return filled;
}

}  // namespace remapc
