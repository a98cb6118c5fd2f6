// SPDX-License-Identifier: Apache-2.0
#include "base/file_output.h"

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
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  // The part file is a link to a device that is always full.
  std::filesystem::create_symlink("/dev/full", folder_ / "a.part");
  EXPECT_THROW(WriteFileWhole(folder_ / "a", std::string(1 << 20, 'x')), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a"));
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
