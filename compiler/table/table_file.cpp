#include "table/table_file.hpp"

#include <array>

#include <openssl/evp.h>

#include "core/files.hpp"
#include "core/json_field.hpp"
#include "core/plain_text.hpp"
#include "core/report_text.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

constexpr const char* kDigest = "sha256";  // hash of the whole_text() that was written

std::filesystem::path metadata_of(const std::filesystem::path& table) { return table.string() + ".json"; }

}  // namespace

std::string file_sha256(const std::filesystem::path& path) {
  return std::filesystem::is_regular_file(path) ? sha256(read_file(path)) : std::string();
}

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1)
    throw Error(ErrorKind::kNumeric, "sha256: cannot compute the digest");
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (unsigned i = 0; i < length; ++i) {
    text += kDigits[digest[i] >> 4];
    text += kDigits[digest[i] & 15];
  }
  return text;
}

Comments parse_metadata(std::string_view json, const std::string& context) {
  const Json root = parse_json(json, context);
  const Field fields(root, context);
  fields.require(root.fields() != nullptr && root.size() <= kMostCsvComments, "an object of texts");
  Comments comments;
  for (const auto& [key, value] : *root.fields())
    comments.emplace_back(plain(key, kLongestComment), plain(fields[key].any_text(), kLongestComment));
  return comments;
}

Csv parse_table_file(std::string_view bytes, const std::filesystem::path& path) {
  Csv csv = parse_csv(bytes, path.string());
  const std::filesystem::path metadata = metadata_of(path);
  if (!csv.comments.empty() || !std::filesystem::is_regular_file(metadata)) return csv;
  csv.comments = parse_metadata(read_file(metadata), metadata.string());
  const std::string digest = csv.comment(kDigest);
  std::erase_if(csv.comments, [](const auto& comment) { return comment.first == kDigest; });
  if (!digest.empty() && digest != sha256(whole_text(csv, bytes)))
    csv.remarks.push_back(
        "warning: " + csv.name + ": " + metadata.string() +
        ", which states its models, does not belong to this table: one of them was changed");
  return csv;
}

std::string whole_text(const Csv& csv, std::string_view bytes) {
  return (csv.header.number == 1 ? comment_lines(csv.comments) : "") + std::string(bytes);
}

void require_new_table(const std::filesystem::path& path, bool force) {
  require_new(path, force);
  require_new(metadata_of(path), force);
}

void write_plain_table(const std::filesystem::path& path, std::string_view text) {
  Comments comments;
  while (text.starts_with('#')) {
    add_comment(text.substr(0, text.find('\n')), &comments);
    text.remove_prefix(text.find('\n') + 1);
  }
  write_file(path, text);
  if (comments.empty()) return;
  comments.emplace_back(kDigest, sha256(comment_lines(comments) + std::string(text)));
  Json metadata = Json::object();
  for (const auto& [key, value] : comments) metadata[key] = value;
  write_file(metadata_of(path), metadata.dump(2) + "\n");
}

}  // namespace remap
