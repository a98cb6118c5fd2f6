// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/replay_shelf.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "tests/own_folder.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

class ReplayShelfTest : public OwnFolderTest {
 protected:
  static EpisodeRow Failed(std::uint64_t episode) {
    EpisodeRow row;
    row.variant = "default";
    row.episode = episode;
    row.outcome = "failure";
    row.replay = "replay of " + std::to_string(episode);
    return row;
  }
  bool Has(std::uint64_t episode) const {
    return fs::exists(EpisodeFolder(folder_, "default", episode) / "replay.bin");
  }
};

TEST_F(ReplayShelfTest, TheLowestNumbersStayWhateverTheOrder) {
  constexpr std::uint64_t kAll = ReplayShelf::kMost + 20;
  {
    ReplayShelf dut(folder_);
    for (std::uint64_t i = 0; i < kAll / 2; ++i) dut.Take(Failed(2 * i + 1));
  }
  ReplayShelf dut(folder_);  // a campaign that goes on
  for (std::uint64_t i = kAll / 2; i-- > 0;) dut.Take(Failed(2 * i));
  for (std::uint64_t i = 0; i < kAll; ++i) EXPECT_EQ(Has(i), i < ReplayShelf::kMost) << i;
  EXPECT_EQ(Slurp(EpisodeFolder(folder_, "default", 7) / "replay.bin"), "replay of 7");
  EXPECT_FALSE(fs::exists(EpisodeFolder(folder_, "default", kAll - 1))) << "no empty folders";
}

TEST_F(ReplayShelfTest, ASuccessIsNotKept) {
  ReplayShelf dut(folder_);
  EpisodeRow row = Failed(1);
  row.outcome = "success";
  dut.Take(row);
  EXPECT_FALSE(Has(1));
  row.events_of[0] = 1;  // with a failure on its way
  dut.Take(row);
  EXPECT_TRUE(Has(1));
}

TEST_F(ReplayShelfTest, AnEpisodeThatWasDrivenAgainStaysWhole) {
  ReplayShelf dut(folder_);
  dut.Take(Failed(1000));
  std::ofstream(EpisodeFolder(folder_, "default", 1000) / "result.json") << "{}";
  for (std::uint64_t i = 0; i <= ReplayShelf::kMost; ++i) dut.Take(Failed(i));
  EXPECT_TRUE(Has(1000));
}

TEST_F(ReplayShelfTest, AFileOfSomebodyElsesIsNotReplaced) {
  fs::create_directories(EpisodeFolder(folder_, "default", 3));
  std::ofstream(EpisodeFolder(folder_, "default", 3) / "replay.bin") << "mine";
  ReplayShelf dut(folder_);
  EXPECT_THROW(dut.Take(Failed(3)), InputError);
  EXPECT_EQ(Slurp(EpisodeFolder(folder_, "default", 3) / "replay.bin"), "mine");
}

TEST_F(ReplayShelfTest, NothingIsWrittenThroughALink) {
  const fs::path elsewhere = folder_ / "elsewhere";
  fs::create_directories(elsewhere);
  fs::create_directory_symlink(elsewhere, folder_ / "episodes");
  ReplayShelf dut(folder_);
  EXPECT_THROW(dut.Take(Failed(3)), InputError);
  EXPECT_TRUE(fs::is_empty(elsewhere));
}

}  // namespace
}  // namespace floorproof
