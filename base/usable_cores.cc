// SPDX-License-Identifier: Apache-2.0
#include "base/usable_cores.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// Where a controller's tree is mounted, and the group's path in it.
struct Group {
  fs::path mount, path;
  bool is_version_2 = false;
};

// Of a line of proc/self/cgroup, the cgroup if it can limit CPU time: "0::/path" in version 2,
// "4:cpu,cpuacct:/path" in version 1.
std::optional<Group> CpuGroup(const fs::path& mounts, const std::string& line) {
  const auto first = line.find(':'), second = line.find(':', first + 1);
  if (first == std::string::npos || second == std::string::npos) return std::nullopt;
  const std::string controllers = line.substr(first + 1, second - first - 1);
  const fs::path path = fs::path(line.substr(second + 1)).relative_path();
  if (controllers.empty()) return Group{mounts, path, true};
  std::istringstream names(controllers);
  for (std::string name; std::getline(names, name, ',');)
    if (name == "cpu")  // its mount may name the controllers in another order
      return Group{fs::exists(mounts / "cpu") ? mounts / "cpu" : mounts / controllers, path, false};
  return std::nullopt;
}

// The quota in one cgroup's folder, in cores.
std::optional<double> QuotaIn(const fs::path& folder, bool is_version_2) {
  double quota_us = 0, period_us = 0;
  if (is_version_2) {  // "150000 100000", or "max 100000" for none
    std::ifstream(folder / "cpu.max") >> quota_us >> period_us;
  } else {  // -1 for none
    std::ifstream(folder / "cpu.cfs_quota_us") >> quota_us;
    std::ifstream(folder / "cpu.cfs_period_us") >> period_us;
  }
  if (!(quota_us > 0) || !(period_us > 0)) return std::nullopt;
  return quota_us / period_us;
}

int CoresOfAffinity() {
  // sched_getaffinity() fails if the set is smaller than the kernel's own.
  for (int cores = 1024; cores <= 1 << 20; cores *= 2) {
    const std::unique_ptr<cpu_set_t, void (*)(cpu_set_t*)> set(
        CPU_ALLOC(static_cast<std::size_t>(cores)), [](cpu_set_t* s) { CPU_FREE(s); });
    const std::size_t size = CPU_ALLOC_SIZE(static_cast<std::size_t>(cores));
    if (sched_getaffinity(0, size, set.get()) == 0) return CPU_COUNT_S(size, set.get());
  }
  return static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
}

}  // namespace

std::optional<double> CpuQuota(const fs::path& root) {
  std::optional<double> least;
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::optional<Group> group = CpuGroup(root / "sys/fs/cgroup", line);
    if (!group) continue;
    // In a container the mount may be the group itself, and its path name a folder that is not
    // there.
    for (fs::path path = group->path;; path = path.parent_path()) {
      const auto quota = QuotaIn(group->mount / path, group->is_version_2);
      if (quota) least = std::min(*quota, least.value_or(*quota));
      if (path.empty()) break;
    }
  }
  return least;
}

int UsableCores() {
  const int cores = std::max(1, CoresOfAffinity());
  const std::optional<double> quota = CpuQuota("/");
  return quota ? std::clamp(static_cast<int>(std::ceil(std::min(*quota, 1e6))), 1, cores) : cores;
}

}  // namespace floorproof
