// Rows that a sweep has finished, kept on disk until the table is whole.
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

#include "error.hpp"
#include "files.hpp"
#include "number_text.hpp"
#include "sweep/sweep.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

constexpr std::string_view kBlockEnd = "end\n";

void append_bytes(const std::filesystem::path& path, const std::string& bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_APPEND);
  std::size_t written = 0;
  bool failed = file < 0;
  while (!failed && written < bytes.size()) {
    const ssize_t count = ::write(file, bytes.data() + written, bytes.size() - written);
    failed = count < 0;
    if (!failed) written += static_cast<std::size_t>(count);
  }
  const std::string reason = std::strerror(errno);
  if (file >= 0) ::close(file);
  if (failed) throw Error(ErrorKind::kOutput, path.string() + ": cannot be written: " + reason);
}

// `index,<row>` lines of whole blocks; what follows the last `end` was cut off and is done again.
void read_blocks(std::string_view text, const std::string& header,
                 std::vector<std::optional<TableRow>>* rows) {
  const std::size_t end = text.rfind(kBlockEnd);
  if (end == std::string_view::npos) return;
  std::string table = header;
  std::vector<std::size_t> samples;
  text = text.substr(0, end);
  while (!text.empty()) {
    const std::size_t line_end = text.find('\n');
    const std::string_view line = text.substr(0, line_end);
    text.remove_prefix(line_end + 1);
    const std::size_t comma = line.find(',');
    const auto index = remap::parse_number(line.substr(0, comma));
    if (comma == std::string_view::npos || !index ||
        !(*index >= 0.0 && *index < static_cast<double>(rows->size())))
      continue;
    samples.push_back(static_cast<std::size_t>(*index));
    table += std::string(line.substr(comma + 1)) + "\n";
  }
  if (samples.empty()) return;
  const Table parsed = parse_table(table, "journal");
  for (std::size_t i = 0; i < samples.size(); ++i) (*rows)[samples[i]] = parsed.rows[i];
}

}  // namespace

SweepJournal::SweepJournal(std::filesystem::path path, const Table& empty_table, std::size_t sample_count,
                           bool resume)
    : path_(std::move(path)), has_diffuse_(empty_table.has_diffuse), rows_(sample_count) {
  if (path_.empty()) return;
  const std::string header = table_text(empty_table);
  const std::string opening = header + std::string(kBlockEnd);
  if (resume && std::filesystem::exists(path_)) {
    const std::string content = remap::read_file(path_);
    if (!content.starts_with(opening))
      throw Error(ErrorKind::kInput, path_.string() +
                                         ": was begun with other options or another version; repeat those, "
                                         "or start again without --resume");
    read_blocks(std::string_view(content).substr(opening.size()), header, &rows_);
    // Drop a block that was cut off, so that what is appended next stands on a line of its own.
    const std::size_t whole = content.rfind(kBlockEnd) + kBlockEnd.size();
    if (whole != content.size()) remap::write_file(path_, std::string_view(content).substr(0, whole));
    return;
  }
  remap::write_file(path_, opening);
}

void SweepJournal::append(const std::vector<std::size_t>& samples, const std::vector<TableRow>& rows) {
  if (path_.empty()) return;
  std::string block;
  for (std::size_t i = 0; i < samples.size(); ++i)
    block += std::to_string(samples[i]) + "," + row_text(rows[i], has_diffuse_) + "\n";
  append_bytes(path_, block + std::string(kBlockEnd));
}

void SweepJournal::remove() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace remapc
