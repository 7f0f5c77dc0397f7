// This file loads the module of images, the only part that links OpenImageIO.
#include <dlfcn.h>

#include "core/errors.hpp"
#include "core/system.hpp"
#include "remap/version.hpp"
#include "texture/image_library.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// REMAP_IMAGE_MODULE is the path of the module, relative to the folder of the programs. It is the same in the
// build tree and after installation.
fs::path module_file() { return (program_file().parent_path() / REMAP_IMAGE_MODULE).lexically_normal(); }

}  // namespace

const ImageLibrary& load_image_library() {
  const fs::path file = module_file();
  const auto fail = [&](const std::string& what) { throw input_error(file.string() + ": " + what); };
  if (std::error_code ignored; !fs::exists(file, ignored))
    fail("file not found, but the programs need this file for images (install them by cmake --install)");
  // The module is never unloaded, because the program may keep objects of the module until the end.
  void* const module = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (module == nullptr) {
    const char* const reason = ::dlerror();
    fail(std::string("cannot be loaded, so the programs cannot read or write images: ") +
         (reason != nullptr ? reason : "unknown reason") + " (install OpenImageIO)");
  }
  using Entry = const ImageLibrary* (*)(const char*);
  const auto entry = reinterpret_cast<Entry>(::dlsym(module, "remap_image_library"));
  const ImageLibrary* const library = entry != nullptr ? entry(kVersion) : nullptr;
  if (library == nullptr)
    fail("is not of version " + std::string(kVersion) +
         ", like the program (install both by cmake --install)");
  return *library;
}

}  // namespace remap
