// SPDX-License-Identifier: Apache-2.0
#include "media/codecs.h"

#include <dlfcn.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// Folders that may hold the module: the program's own, and that of the shared library this code was
// linked into (a Python package, say), which is the same thing for a plain program.
std::vector<fs::path> ModuleFolders() {
  std::vector<fs::path> folders;
  std::error_code ignored;
  if (const fs::path exe = fs::read_symlink("/proc/self/exe", ignored); !exe.empty())
    folders.push_back(exe.parent_path());
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&Codecs), &info) != 0 && info.dli_fname != nullptr)
    if (const fs::path own = fs::weakly_canonical(info.dli_fname, ignored).parent_path();
        !own.empty() && (folders.empty() || folders.back() != own))
      folders.push_back(own);
  return folders;
}

const CodecApi* Load() {
  std::string tried;
  for (const fs::path& folder : ModuleFolders()) {
    const fs::path file = folder / kCodecModule;
    // Never closed: OpenCV's libraries keep threads and tables that must not be unmapped.
    void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) {
      tried += std::string(tried.empty() ? "" : "; ") + dlerror();
      continue;
    }
    using Entry = const CodecApi* (*)();
    const auto entry = reinterpret_cast<Entry>(dlsym(module, kCodecSymbol));
    const CodecApi* api = entry == nullptr ? nullptr : entry();
    if (api != nullptr && api->version == kCodecApiVersion) return api;
    tried += file.string() + " is of another version";
  }
  throw InternalError("cannot load the image and video codecs: " + tried);
}

}  // namespace

const CodecApi& Codecs() {
  static const CodecApi* api = Load();  // a failed load is tried again at the next call
  return *api;
}

}  // namespace floorproof
