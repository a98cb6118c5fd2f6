// SPDX-License-Identifier: Apache-2.0
#include "env/scene/engine_files.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <set>
#include <string>

#include "base/error.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxBytes = 64u << 20;  // as CheckMjcf allows

}  // namespace

struct EngineFiles::Served {
  explicit Served(const InputFiles& from) : files(from) { mj_defaultVFS(&vfs); }
  ~Served() { mj_deleteVFS(&vfs); }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  // The engine's callbacks: C, so that nothing is thrown through them.
  static int Open(mjResource* resource) noexcept try {
    auto* served = static_cast<Served*>(resource->provider->data);
    const std::scoped_lock lock(served->mutex);
    const fs::path file(resource->name);
    resource->data = const_cast<std::string*>(&served->files.Read(file, kMaxBytes));
    // What the engine keeps of a file holds as long as its bytes do.
    std::snprintf(resource->timestamp, sizeof resource->timestamp, "%s",
                  served->files.Sha256(file).c_str());
    if (std::ranges::find(served->opened, file) == served->opened.end())
      served->opened.push_back(file);
    return 1;
  } catch (const std::exception&) {
    return 0;
  }
  static int Read(mjResource* resource, const void** buffer) {
    const auto* bytes = static_cast<const std::string*>(resource->data);
    *buffer = bytes->data();
    return static_cast<int>(bytes->size());
  }
  static void Close(mjResource* resource) { resource->data = nullptr; }
  static int Mount(mjResource*) { return 1; }
  static int Modified(const mjResource* resource, const char* timestamp) {
    return std::strcmp(resource->timestamp, timestamp) == 0 ? 0 : 1;
  }

  std::mutex mutex;  // laws compile a robot on several threads
  InputFiles files;
  std::vector<fs::path> opened;
  mjpResourceProvider provider{};
  mjVFS vfs{};
};

EngineFiles::EngineFiles(const InputFiles& files, const fs::path& file)
    : served_(std::make_shared<Served>(files)) {
  mjpResourceProvider& provider = served_->provider;
  provider.prefix = "inputs";
  provider.open = Served::Open;
  provider.read = Served::Read;
  provider.close = Served::Close;
  provider.mount = Served::Mount;
  provider.unmount = Served::Mount;
  provider.modified = Served::Modified;
  provider.data = served_.get();
  std::set<fs::path> folders;
  const auto add = [&](const fs::path& path) {
    if (std::distance(path.begin(), path.end()) > 1)
      folders.insert(path.root_path() / *std::next(path.begin()));
  };
  add(file);
  for (const fs::path& named : files.StoodIn()) add(fs::absolute(named).lexically_normal());
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(file.root_path(), ignored)) add(entry.path());
  for (const fs::path& folder : folders)
    if (mj_mountVFS(&served_->vfs, folder.c_str(), &provider) != 0)
      throw InternalError("MuJoCo: cannot mount " + folder.string());
  vfs_ = {served_, &served_->vfs};
}

std::vector<fs::path> EngineFiles::Opened() const { return served_->opened; }

}  // namespace floorproof
