// SPDX-License-Identifier: Apache-2.0
// Default numbers of workers count what the process may use, not what the machine has.
#include "base/usable_cores.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "tests/own_folder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

TEST(UsableCores, FollowTheAffinity) {
  const pid_t child = fork();
  if (child == 0) {  // bound to the core that it runs on
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<std::size_t>(sched_getcpu()), &one);
    _exit(sched_setaffinity(0, sizeof one, &one) == 0 ? UsableCores() : 99);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 1);
}

// What the kernel shows of control groups, below a folder of the test's own.
class CpuQuotaTest : public OwnFolderTest {
 protected:
  void Write(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }
};

TEST_F(CpuQuotaTest, AContainerOfVersion2HasItsOwnAtTheRoot) {
  Write("proc/self/cgroup", "0::/\n");
  EXPECT_EQ(CpuQuota(folder_), std::nullopt);
  Write("sys/fs/cgroup/cpu.max", "max 100000\n");
  EXPECT_EQ(CpuQuota(folder_), std::nullopt);
  Write("sys/fs/cgroup/cpu.max", "150000 100000\n");
  EXPECT_EQ(CpuQuota(folder_), 1.5);
}

TEST_F(CpuQuotaTest, AGroupIsLimitedByThoseAboveIt) {
  Write("proc/self/cgroup", "0::/ci.slice/job.scope\n");
  Write("sys/fs/cgroup/ci.slice/job.scope/cpu.max", "400000 100000\n");
  EXPECT_EQ(CpuQuota(folder_), 4);
  Write("sys/fs/cgroup/ci.slice/cpu.max", "200000 100000\n");
  EXPECT_EQ(CpuQuota(folder_), 2);
}

TEST_F(CpuQuotaTest, Version1NamesTheControllerAndMayShowAnotherPath) {
  Write("proc/self/cgroup", "5:cpuset:/docker/1f\n4:cpu,cpuacct:/docker/1f\n0::/\n");
  Write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "-1\n");
  Write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(CpuQuota(folder_), std::nullopt);
  Write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "100000\n");
  EXPECT_EQ(CpuQuota(folder_), 1);
}

TEST_F(CpuQuotaTest, NonsenseSetsNoLimit) {
  for (const char* text : {"", "max", "0 0", "-1 100000", "nan nan", "100000"}) {
    Write("proc/self/cgroup", "0::/\nno line of its kind\n");
    Write("sys/fs/cgroup/cpu.max", text);
    EXPECT_EQ(CpuQuota(folder_), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace floorproof
