// SPDX-License-Identifier: Apache-2.0
#include "base/file_output.h"

#include <signal.h>
#include <sys/resource.h>

#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

class FileOutput : public ScenarioTest {};

TEST_F(FileOutput, AFileIsReplacedWhole) {
  WriteFileWhole(folder_ / "a", "long text");
  WriteFileWhole(folder_ / "a", "short");
  std::ifstream in(folder_ / "a");
  EXPECT_EQ(std::string((std::istreambuf_iterator<char>(in)), {}), "short");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.part"));
}

TEST_F(FileOutput, AFullDiskLeavesNothingThatLooksFinished) {
  // No file may grow beyond 64 kB, as if the disk were full there.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small = {64 << 10, before.rlim_max};
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(WriteFileWhole(folder_ / "a", std::string(1 << 20, 'x')), DiskError);
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, handler);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(FileOutput, AFolderThatIsAFileIsRefused) {
  Save("a", "x");
  EXPECT_THROW(MakeFolder(folder_ / "a"), InputError);
  EXPECT_THROW(WriteFileWhole(folder_ / "nothing" / "b", "x"), InputError);
}

// FIPS 180-2, appendix B.1.
TEST_F(FileOutput, ShaOfAbc) {
  EXPECT_EQ(Sha256OfFile(Save("abc", "abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_THROW(Sha256OfFile(folder_ / "missing"), InputError);
}

}  // namespace
}  // namespace floorproof
