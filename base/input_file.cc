// SPDX-License-Identifier: Apache-2.0
#include "base/input_file.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>

#include "base/config.h"
#include "base/error.h"
#include "base/params.h"

namespace floorproof {

namespace fs = std::filesystem;

namespace {

// Files of /proc and /sys are not a user's: what a process was started with, its memory, devices.
bool IsOfTheKernel(int fd) {
  struct statfs system {};
  return fstatfs(fd, &system) == 0 &&
         (system.f_type == PROC_SUPER_MAGIC || system.f_type == SYSFS_MAGIC);
}
constexpr const char* kOfTheKernel = "is the kernel's (/proc, /sys), not a file";

struct Opened {
  explicit Opened(const fs::path& file)
      : fd(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}
  ~Opened() {
    if (fd >= 0) close(fd);
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  const int fd;
};

}  // namespace

std::string WhyUnreadable(const fs::path& file, std::uintmax_t most_bytes) {
  if (file.native().find('\0') != std::string::npos) return "no such file";
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) return "no such file";
  if (error) return "cannot be read: " + error.message();
  if (fs::is_directory(status)) return "is a folder, not a file";
  if (!fs::is_regular_file(status)) return "is a pipe or a device, not a file";
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) return "cannot be read: " + error.message();
  if (size > most_bytes) return "larger than " + std::to_string(most_bytes >> 20) + " MiB";
  const Opened opened(file);
  if (opened.fd < 0) return std::string("cannot be read: ") + std::strerror(errno);
  return IsOfTheKernel(opened.fd) ? kOfTheKernel : "";
}

namespace {

// At most `count` bytes.
std::string Read(const fs::path& file, std::uintmax_t count, std::uintmax_t most_bytes) {
  const auto refuse = [&](const std::string& why) {
    throw InputError({file.string(), 0}, "", "", why);
  };
  if (const std::string why = WhyUnreadable(file, most_bytes); !why.empty()) refuse(why);
  // What it is now may be something else, and a pipe would wait for a writer.
  const Opened opened(file);
  struct stat status {};
  if (opened.fd < 0 || fstat(opened.fd, &status) != 0)
    refuse(std::string("cannot be read: ") + std::strerror(errno));
  if (!S_ISREG(status.st_mode)) refuse("is a pipe or a device, not a file");
  if (IsOfTheKernel(opened.fd)) refuse(kOfTheKernel);
  std::string bytes;
  bytes.reserve(std::min({count, most_bytes, static_cast<std::uintmax_t>(status.st_size)}));
  // Does not simply read to the end: a file that grows meanwhile must not be read without bound.
  char buffer[1 << 16];
  while (bytes.size() < count && bytes.size() <= most_bytes) {
    const ssize_t n =
        read(opened.fd, buffer, std::min<std::uintmax_t>(sizeof buffer, count - bytes.size()));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) refuse(std::string("cannot be read: ") + std::strerror(errno));
    if (n == 0) break;
    bytes.append(buffer, static_cast<std::size_t>(n));
  }
  if (bytes.size() > most_bytes) refuse("cannot be read to its end");
  return bytes;
}

// The path with the first link in it replaced by where that leads; empty where there is none.
fs::path FollowFirstLink(const fs::path& path) {
  fs::path before;
  for (auto part = path.begin(); part != path.end(); ++part) {
    const fs::path here = before / *part;
    std::error_code error;
    if (fs::path target = fs::read_symlink(here, error); !error) {
      fs::path followed = before / target;
      for (auto rest = std::next(part); rest != path.end(); ++rest) followed /= *rest;
      return followed;
    }
    before = here;
  }
  return {};
}

}  // namespace

std::string ReadInputFile(const fs::path& file, std::uintmax_t most_bytes) {
  return Read(file, std::numeric_limits<std::uintmax_t>::max(), most_bytes);
}

fs::path ResolvedPath(const fs::path& path) {
  constexpr int kMaxLinks = 40;
  const fs::path plain = fs::absolute(path).lexically_normal();
  fs::path resolved = fs::absolute(path);
  for (int links = 0; links <= kMaxLinks; ++links) {
    std::error_code error;
    resolved = fs::weakly_canonical(resolved, error);
    if (error) return plain;  // a loop of links: the reader reports it
    const fs::path followed = FollowFirstLink(resolved);
    if (followed.empty()) return resolved;
    resolved = followed;
  }
  return plain;
}

bool LiesBelow(const fs::path& folder, const fs::path& path) {
  return std::ranges::mismatch(folder, path).in1 == folder.end();
}

bool IsHiddenIn(const fs::path& folder, const fs::path& path) {
  return std::ranges::any_of(path.lexically_relative(folder), [](const fs::path& part) {
    return part.native().starts_with('.') && part != "." && part != "..";
  });
}

bool IsPlainFile(const fs::path& file) {
  std::error_code ignored;
  return fs::symlink_status(file, ignored).type() == fs::file_type::regular;
}

std::string ReadPlainFile(const fs::path& file, std::uintmax_t most_bytes) {
  if (!IsPlainFile(file) || !WhyUnreadable(file, most_bytes).empty()) return "";
  return ReadInputFile(file, most_bytes);
}

std::string ReadStartOfFile(const fs::path& file, std::size_t count, std::uintmax_t most_bytes) {
  return Read(file, count, most_bytes);
}

fs::path PathIn(const fs::path& folder, const ConfigNode& node, const std::string& key) {
  const std::string text = AsString(node, key);
  const fs::path path(text);
  if (text.empty()) throw InputError(node.mark, key, "\"\"", "must name a file");
  if (path.is_absolute()) return path;
  const bool leaves = *path.lexically_normal().begin() == "..";
  if (leaves && !text.starts_with("../"))
    throw InputError(node.mark, key, text,
                     "leaves its folder; begin it with ../ or write it absolute");
  return folder / path;
}

}  // namespace floorproof
