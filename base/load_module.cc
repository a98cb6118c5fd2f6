// SPDX-License-Identifier: Apache-2.0
#include "base/load_module.h"

#include <dlfcn.h>

#include <filesystem>
#include <vector>

#include "base/error.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// Folders that may hold a module: the program's own, and that of the shared library this code was
// linked into, which is the same thing for a plain program.
std::vector<fs::path> ModuleFolders() {
  std::vector<fs::path> folders;
  std::error_code ignored;
  if (const fs::path exe = fs::read_symlink("/proc/self/exe", ignored); !exe.empty())
    folders.push_back(exe.parent_path());
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&LoadModule), &info) != 0 && info.dli_fname != nullptr)
    if (const fs::path own = fs::weakly_canonical(info.dli_fname, ignored).parent_path();
        !own.empty() && (folders.empty() || folders.back() != own))
      folders.push_back(own);
  return folders;
}

}  // namespace

void* LoadModule(const char* file, const char* symbol, const std::string& what) {
  std::string tried;
  for (const fs::path& folder : ModuleFolders()) {
    void* module = dlopen((folder / file).c_str(), RTLD_NOW | RTLD_LOCAL);
    void* found = module == nullptr ? nullptr : dlsym(module, symbol);
    if (found != nullptr) return found;
    tried += std::string(tried.empty() ? "" : "; ") + dlerror();
  }
  throw InternalError("cannot load " + what + ": " + tried);
}

}  // namespace floorproof
