// SPDX-License-Identifier: Apache-2.0
#include "base/result_folder.h"

#include <fstream>

#include "base/file_output.h"
#include "tests/run/scenario_text.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

ResultNames Results() {
  return {"drive", [](std::string_view name) { return name == "plan.csv" || name == "video.mp4"; }};
}

class ResultFolderTest : public ScenarioTest {
 protected:
  // One run: begins, writes, ends.
  void Write(const std::string& name, const std::string& text) const {
    ResultFolder dut(folder_, Results(), {});
    dut.Begin();
    WriteFileWhole(folder_ / name, text);
  }
  // What is said about the folder; empty: it is taken.
  std::string Refusal(const std::vector<fs::path>& inputs = {}) const {
    try {
      ResultFolder dut(folder_, Results(), inputs);
      return "";
    } catch (const InputError& e) {
      return e.what();
    }
  }
};

TEST_F(ResultFolderTest, WhatARunWroteTheNextOneReplaces) {
  EXPECT_EQ(Refusal(), "");
  Write("plan.csv", "one");
  EXPECT_EQ(Refusal(), "");
  Write("plan.csv", "two");
  EXPECT_EQ(Slurp(folder_ / "plan.csv"), "two");
}

TEST_F(ResultFolderTest, AFileThatNoRunWroteIsRefusedAndStays) {
  Write("plan.csv", "one");
  Save("video.mp4", "a film of my own");
  EXPECT_THAT(Refusal(), ::testing::HasSubstr("video.mp4: was not written by an earlier run"));
  EXPECT_EQ(Slurp(folder_ / "video.mp4"), "a film of my own");
}

TEST_F(ResultFolderTest, AResultThatWasChangedIsSomebodyElses) {
  Write("plan.csv", "one");
  Save("plan.csv", "edited by hand");
  EXPECT_THAT(Refusal(), ::testing::HasSubstr("plan.csv: has changed since a run wrote it"));
  EXPECT_EQ(Slurp(folder_ / "plan.csv"), "edited by hand");
}

TEST_F(ResultFolderTest, AnInputIsNeverReplacedByWhateverWayItIsNamed) {
  Write("plan.csv", "one");
  fs::create_symlink(folder_ / "plan.csv", folder_ / "link.csv");
  for (const fs::path& input :
       {folder_ / "plan.csv", folder_ / "." / "plan.csv", folder_ / "link.csv"})
    EXPECT_THAT(Refusal({input}), ::testing::HasSubstr("is read")) << input;
  Save("other.csv", "");
  EXPECT_EQ(Refusal({folder_ / "other.csv"}), "");
}

TEST_F(ResultFolderTest, ALinkUnderAResultsNameIsRefused) {
  Save("mine", "mine");
  fs::create_symlink(folder_ / "mine", folder_ / "plan.csv");
  EXPECT_THAT(Refusal(), ::testing::HasSubstr("plan.csv: is no plain file"));
  fs::remove(folder_ / "plan.csv");
  fs::create_symlink(folder_ / "gone", folder_ / "plan.csv");
  EXPECT_THAT(Refusal(), ::testing::HasSubstr("plan.csv: is no plain file"));
}

// As after a kill: the list says that results were being written.
TEST_F(ResultFolderTest, AKilledRunDoesNotShutTheNextOneOut) {
  std::string list;
  {
    ResultFolder dut(folder_, Results(), {});
    dut.Begin();
    list = Slurp(folder_ / "files.sha256");
    WriteFileWhole(folder_ / "plan.csv", "half a run");
  }
  Save("files.sha256", list);
  EXPECT_EQ(Refusal(), "");
  Write("plan.csv", "whole");
  Save("video.mp4", "not its own");
  EXPECT_NE(Refusal(), "");
}

TEST_F(ResultFolderTest, OtherFilesAndOtherResultsAreLeftAlone) {
  Save("notes.txt", "mine");
  Write("plan.csv", "one");
  {
    ResultFolder dut(folder_, {"page", [](std::string_view name) { return name == "page.html"; }},
                     {});
    dut.Begin();
    WriteFileWhole(folder_ / "page.html", "page");
  }
  EXPECT_EQ(Refusal(), "");
  EXPECT_EQ(Slurp(folder_ / "notes.txt"), "mine");
  EXPECT_THAT(Slurp(folder_ / "files.sha256"),
              ::testing::AllOf(::testing::HasSubstr(Sha256("one") + "  plan.csv\n"),
                               ::testing::HasSubstr(Sha256("page") + "  page.html\n"),
                               ::testing::Not(::testing::HasSubstr("being written: "))));
}

TEST_F(ResultFolderTest, AListThatIsNoneIsRefused) {
  Save("files.sha256", "my own sums");
  EXPECT_THAT(Refusal(), ::testing::HasSubstr("is not a list of results"));
  EXPECT_EQ(Slurp(folder_ / "files.sha256"), "my own sums");
}

TEST_F(ResultFolderTest, APlantedPartFileIsNotFollowed) {
  Save("mine", "mine");
  fs::create_symlink(folder_ / "mine", folder_ / ".plan.part.csv");
  WriteFileWhole(folder_ / "plan.csv", "x");
  EXPECT_EQ(Slurp(folder_ / "mine"), "mine");
  EXPECT_EQ(Slurp(folder_ / "plan.csv"), "x");
}

TEST_F(ResultFolderTest, WhatAKilledRunHadBegunToWriteIsRemovedByTheNext) {
  fs::create_directories(folder_);
  for (const char* name : {".plan.part.csv", ".video.part.mp4", ".files.part.sha256",
                           ".other.part.csv", ".part.csv", "plan.part.csv"})
    std::ofstream(folder_ / name) << "half";
  Write("plan.csv", "whole");
  for (const char* gone : {".plan.part.csv", ".video.part.mp4", ".files.part.sha256"})
    EXPECT_FALSE(fs::exists(folder_ / gone)) << gone;
  for (const char* kept : {".other.part.csv", ".part.csv", "plan.part.csv"})
    EXPECT_TRUE(fs::exists(folder_ / kept)) << kept;
}

TEST_F(ResultFolderTest, AFolderThatIsALinkLeadsNowhere) {
  fs::create_directories(folder_ / "elsewhere");
  fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "episodes");
  EXPECT_THROW(RefuseLinks(folder_, folder_ / "episodes" / "default" / "3"), InputError);
  EXPECT_NO_THROW(RefuseLinks(folder_, folder_ / "elsewhere" / "3"));
}

}  // namespace
}  // namespace floorproof
