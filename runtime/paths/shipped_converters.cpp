// The assembler includes generated/converters.json, because a string literal would take the compiler seconds.
extern "C" {
extern const char remap_shipped_text_begin[];
extern const char remap_shipped_text_end[];
}

#define REMAP_TEXT_OF(name) #name
#define REMAP_TEXT(name) REMAP_TEXT_OF(name)
// Makes the name that the assembler uses for a C name.
#define REMAP_SYMBOL(name) REMAP_TEXT(__USER_LABEL_PREFIX__) #name
#define REMAP_LABEL(name) ".globl " REMAP_SYMBOL(name) "\n" REMAP_SYMBOL(name) ":\n"
// Linkers for WebAssembly need the size of data.
#define REMAP_SIZE(name, size) ""

#if defined(_WIN32)
#define REMAP_ENTER_CONSTANTS ".section .rdata,\"dr\"\n"
#define REMAP_LEAVE_CONSTANTS ".text\n"
#elif defined(__APPLE__)
#define REMAP_ENTER_CONSTANTS ".const\n"
#define REMAP_LEAVE_CONSTANTS ".text\n"
#elif defined(__wasm__)
#define REMAP_ENTER_CONSTANTS ".section .rodata.remap_shipped_text,\"\",@\n"
#define REMAP_LEAVE_CONSTANTS ".text\n"
#undef REMAP_SIZE
#define REMAP_SIZE(name, size) ".type " #name ",@object\n.size " #name "," size "\n"
#else
#define REMAP_ENTER_CONSTANTS ".pushsection .rodata\n"
#define REMAP_LEAVE_CONSTANTS ".popsection\n"
#endif

// clang-format off
__asm__(REMAP_ENTER_CONSTANTS
        REMAP_LABEL(remap_shipped_text_begin)
        ".incbin \"" REMAP_CONVERTERS_FILE "\"\n"
        REMAP_LABEL(remap_shipped_text_end)
        ".byte 0\n"
        REMAP_SIZE(remap_shipped_text_begin, "remap_shipped_text_end-remap_shipped_text_begin")
        REMAP_SIZE(remap_shipped_text_end, "1")
        REMAP_LEAVE_CONSTANTS);
// clang-format on

#include "remap/shipped_converters.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>

#include "converter/converter_data.hpp"
#include "core/errors.hpp"
#include "core/input_file.hpp"
#include "paths/converter_file.hpp"
#include "stages/stage.hpp"
#include "stages/warp_json.hpp"

namespace remap {
namespace {

namespace fs = std::filesystem;

// Ignores warps and fits of whole materials, which no path contains.
void add_fit(FittedConverter fit, std::vector<ConverterData>* converters) {
  if (auto* data = std::get_if<ConverterData>(&fit)) converters->push_back(std::move(*data));
}

// Returns false for the manifest and the lock of remapc, which are not fits.
bool may_be_fit(const fs::path& path) {
  const std::string name = path.filename().string();
  return path.extension() == ".json" && name != "manifest.json" && name != "lock.json";
}

std::vector<ConverterData> read_data(const fs::path& path) {
  std::vector<ConverterData> converters;
  if (fs::is_directory(path)) {
    for (const auto& entry : fs::directory_iterator(path))
      if (may_be_fit(entry.path())) add_fit(load_fitted_converter(entry.path()), &converters);
    return converters;
  }
  const std::string text = read_file(path);
  if (is_converter_list(text)) return converters_from_json(text, path.string());
  add_fit(fitted_converter_from_json(text, path.string()), &converters);
  return converters;
}

ConverterList make_converters(std::vector<ConverterData> all, InstructionSet set) {
  std::ranges::sort(all, [](const auto& a, const auto& b) { return a.info.id < b.info.id; });
  ConverterList made;
  for (const ConverterData& data : all) made.push_back(make_converter(data, set));
  return made;
}

std::string_view shipped_text() noexcept {
  return {remap_shipped_text_begin,
          static_cast<std::size_t>(remap_shipped_text_end - remap_shipped_text_begin)};
}

ConverterList make_shipped(InstructionSet set) {
  static const std::vector<ConverterData> data = converters_from_json(shipped_text(), "converters.json");
  return make_converters(data, set);
}

}  // namespace

ConverterList read_converters(const fs::path& path, InstructionSet set) {
  if (!fs::exists(path))
    throw input_error(path.string() +
                      ": does not exist (give a file of converters, a fit or a folder of fits)");
  std::vector<ConverterData> data = read_data(path);
  if (data.empty())
    throw input_error(path.string() +
                      ": contains no converter (give the converters.json of `remapc emit --all`, a fit or a "
                      "folder of fits)");
  return make_converters(std::move(data), set);
}

const ConverterList& shipped_converters(InstructionSet set) {
  switch (set) {
    case InstructionSet::kBaseline: {
      static const ConverterList baseline = make_shipped(InstructionSet::kBaseline);
      return baseline;
    }
    case InstructionSet::kAvx2: {
      static const ConverterList avx2 = make_shipped(InstructionSet::kAvx2);
      return avx2;
    }
    case InstructionSet::kAvx512:
      break;
  }
  static const ConverterList avx512 = make_shipped(InstructionSet::kAvx512);
  return avx512;
}

const Converter& find_converter(const std::string& source_model, const std::string& target_model,
                                InstructionSet set) {
  for (const auto& converter : shipped_converters(set)) {
    const ConverterInfo& info = converter->info();
    if (info.source.model == source_model && info.target.model == target_model) return *converter;
  }
  throw usage_error(source_model + " to " + target_model +
                    ": no converter joins these two models directly (search for a path instead)");
}

FittedConverter fitted_converter_from_json(std::string_view text, const std::string& context) {
  const Json json = parse_json(text, context);
  const Field root(json, context);
  require_fit_file(root);
  read_id(root["id"]);
  if (is_of_materials(root)) {
    if (root["mapping"]["kind"].text() == kWarpKind) return read_warp_fit(root);
    return UnusedFit{};
  }
  const std::optional<ConverterData> converter = read_fitted_converter(root);
  if (!converter)
    root["converter"].fail("missing, because the fit could not be lowered (remapc fit --lower)");
  return *converter;
}

bool is_converter_list(std::string_view text) { return text.find("\"remap-converters\"") < 64; }

FittedConverter load_fitted_converter(const std::filesystem::path& path) {
  return fitted_converter_from_json(read_file(path), path.string());
}

WarpMapFit load_warp_fit(const std::filesystem::path& path) {
  FittedConverter fit = load_fitted_converter(path);
  if (auto* warp = std::get_if<WarpMapFit>(&fit)) return std::move(*warp);
  throw input_error(path.string() + ": not the fit of a warp (`remapc warp` makes them)");
}

}  // namespace remap
