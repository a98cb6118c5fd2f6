// SPDX-License-Identifier: Apache-2.0
// How many cores this process may keep busy: what every default number of workers is.
#pragma once

#include <filesystem>
#include <optional>

namespace floorproof {

// The cores of its CPU affinity (taskset, cpusets), or fewer where a control group has a CPU quota
// (docker --cpus, systemd's CPUQuota); a part of a core counts as one. At least 1.
int UsableCores();

// The smallest CPU quota of the process's control group and those above it, versions 1 and 2, in
// cores; none where there is none. `root` has proc/self/cgroup and sys/fs/cgroup below it; files
// that cannot be read set no limit.
std::optional<double> CpuQuota(const std::filesystem::path& root);

}  // namespace floorproof
