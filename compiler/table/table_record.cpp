#include "table/table_record.hpp"

#include <array>

#include <openssl/evp.h>

#include "remap/error.hpp"

namespace remapc {

using remap::Error;
using remap::ErrorKind;

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

remap::TableRecord table_record(const std::filesystem::path& path, std::string_view bytes,
                                const std::vector<std::pair<std::string, std::string>>& comments) {
  remap::TableRecord record{path.filename().string(), sha256(bytes), {}};
  for (const auto& [key, value] : comments) record.comments[key] = value;
  return record;
}

}  // namespace remapc
