// SPDX-License-Identifier: Apache-2.0
#include "env/scene/engine_files.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "base/error.h"
#include "base/input_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxBytesOfAll = 256u << 20;

}  // namespace

struct EngineFiles::Served {
  Served(const InputFiles& from, const fs::path& main)
      : files(from), model(main), folder(ResolvedPath(main.parent_path())) {
    mj_defaultVFS(&vfs);
  }
  ~Served() { mj_deleteVFS(&vfs); }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  // The engine's callbacks: C, so that nothing is thrown through them.
  static int Open(mjResource* resource) noexcept try {
    auto* served = static_cast<Served*>(resource->provider->data);
    const std::scoped_lock lock(served->mutex);
    const fs::path file(resource->name);
    // Not there, for the engine: of an include's mesh it asks in the robot's folder first and in
    // the include's after that.
    if (served->IsOutOfReach(file)) return 0;
    std::error_code error;
    if (!served->files.HasStandIn(file) && !fs::exists(file, error) && !error) return 0;
    if (const std::string why = served->WhyNot(file); !why.empty()) {
      if (!served->refused) served->refused = {served->NameOf(file), why};
      static std::string nothing;
      resource->data = &nothing;
      return 1;
    }
    resource->data = const_cast<std::string*>(&served->files.Read(file, kMaxBytes));
    // What the engine keeps of a file holds as long as its bytes do.
    std::snprintf(resource->timestamp, sizeof resource->timestamp, "%s",
                  served->files.Sha256(file).c_str());
    if (std::ranges::find(served->opened, file) == served->opened.end()) {
      served->opened.push_back(file);
      served->bytes += served->files.Size(file);
    }
    return 1;
  } catch (const std::exception&) {
    return 0;
  }
  // The same whether the file is there or not.
  bool IsOutOfReach(const fs::path& file) const {
    return file != model && !files.HasStandIn(file) &&
           !EngineFiles::WhyOutOfReach(folder, file).empty();
  }
  // Why the model may not have this file of its own folder; empty when it may.
  std::string WhyNot(const fs::path& file) const {
    const bool again = std::ranges::find(opened, file) != opened.end();
    if (again && file == model) return "is the robot's file itself";
    if (std::string why = files.WhyUnreadable(file, kMaxBytes); !why.empty()) return why;
    if (!again && bytes + files.Size(file) > kMaxBytesOfAll)
      return "with the files before it larger than " + std::to_string(kMaxBytesOfAll >> 20) +
             " MiB";
    return "";
  }
  // As short as it can be written in the model.
  std::string NameOf(const fs::path& file) const {
    const fs::path from = model.parent_path();
    return LiesBelow(from, file) ? file.lexically_relative(from).string() : file.string();
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
  fs::path model, folder;  // the latter without links
  std::vector<fs::path> opened;
  std::uintmax_t bytes = 0;  // of these
  std::optional<std::pair<std::string, std::string>> refused;
  mjpResourceProvider provider{};
  mjVFS vfs{};
};

std::string EngineFiles::WhyOutOfReach(const fs::path& folder, const fs::path& file) {
  const fs::path path = ResolvedPath(file);
  if (!LiesBelow(folder, path)) return "lies outside the folder of the robot's file";
  if (IsHiddenIn(folder, path)) return "is a hidden file of the robot's folder, or in one";
  return "";
}

EngineFiles::EngineFiles(const InputFiles& files, const fs::path& file)
    : served_(std::make_shared<Served>(files, file)) {
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

std::optional<std::pair<std::string, std::string>> EngineFiles::Refused() const {
  return served_->refused;
}

}  // namespace floorproof
