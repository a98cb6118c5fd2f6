// SPDX-License-Identifier: Apache-2.0
// The number of cores available to this process: the default number of workers everywhere.
#pragma once

#include <filesystem>
#include <optional>

namespace floorproof {

// The cores of its CPU affinity (taskset, cpusets), or fewer where a cgroup has a CPU quota (docker
// --cpus, systemd's CPUQuota), rounded up to whole cores. At least 1.
int UsableCores();

// The smallest CPU quota, in cores, of the process's cgroup (version 1 or 2) and those above it;
// none if there is no quota. `root` contains proc/self/cgroup and sys/fs/cgroup. Files that cannot
// be read are ignored.
std::optional<double> CpuQuota(const std::filesystem::path& root);

}  // namespace floorproof
