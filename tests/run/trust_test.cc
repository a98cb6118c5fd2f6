// SPDX-License-Identifier: Apache-2.0
// What a scenario from elsewhere may make the program read and start.
#include "run/scenario/trust.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include "run/episode/make_plan.h"
#include "run/scenario/scenario_file.h"
#include "tests/places.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// A scenario in `in`, and beside that folder a plan outside its reach.
class TrustTest : public ScenarioTest {
 protected:
  TrustTest() {
    fs::create_directories(folder_ / "in/.hidden");
    for (const char* file : {"in/plan.csv", "in/.hidden/plan.csv", "out.csv"})
      Save(file, "x_m,y_m\n1.5,2.5\n3,2.5\n");
    Write("plan.csv");
  }
  void Write(const std::string& plan) const {
    std::string text = RoomScenario("");
    const std::string from = "{file: plan.csv}";
    text.replace(text.find(from), from.size(),
                 plan.starts_with('{') ? plan : "{file: " + plan + "}");
    Save("in/s.yaml", text);
  }
  std::string Refusal(const std::vector<Override>& overrides = {},
                      Trust trust = Trust::kNone) const {
    try {
      MakePlan(ReadScenario(folder_ / "in/s.yaml", overrides, trust));
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  static auto IsOutside() {
    return AllOf(HasSubstr("lies outside the scenario's folder"), HasSubstr("--trust"));
  }
};

TEST_F(TrustTest, ItsOwnFolderIsRead) { EXPECT_EQ(Refusal(), ""); }

TEST_F(TrustTest, WhatLiesOutsideIsNot) {
  for (const std::string& plan : {std::string("../out.csv"), (folder_ / "out.csv").string(),
                                  std::string("/etc/passwd"), std::string("/no/such/file")}) {
    Write(plan);
    EXPECT_THAT(Refusal(), IsOutside()) << plan;  // whether it is there or not
  }
  Write("../out.csv");
  EXPECT_EQ(Refusal({}, Trust::kFull), "");
}

TEST_F(TrustTest, NorWhereALinkLeadsThere) {
  fs::create_symlink(folder_ / "out.csv", folder_ / "in/link.csv");
  fs::create_directory_symlink(folder_, folder_ / "in/up");
  // Whether something is there or not.
  fs::create_symlink(folder_ / "none.csv", folder_ / "in/dangling.csv");
  fs::create_symlink("up", folder_ / "in/again");
  for (const char* plan :
       {"link.csv", "up/out.csv", "dangling.csv", "up/none.csv", "again/none.csv"}) {
    Write(plan);
    EXPECT_THAT(Refusal(), IsOutside()) << plan;
  }
}

TEST_F(TrustTest, NorHiddenFiles) {
  Write(".hidden/plan.csv");
  EXPECT_THAT(Refusal(), HasSubstr("hidden"));
  EXPECT_EQ(Refusal({}, Trust::kFull), "");
}

// A robot or a site that the user typed opens its folder, and not what is hidden there.
TEST_F(TrustTest, NorHiddenFilesBesideWhatWasTyped) {
  fs::copy_file(SourceFile("models/beluga.xml"), folder_ / "in/mine.xml");
  Write(".hidden/plan.csv");
  EXPECT_THAT(Refusal({{"robot", (folder_ / "in/mine.xml").string()}}), HasSubstr("hidden"));
}

TEST_F(TrustTest, SettingsOfResultsReadTheirFolderAlone) {
  fs::create_directory(folder_ / ".git");
  Write("../out.csv");
  EXPECT_EQ(Refusal(), "");
  fs::copy_file(folder_ / "in/s.yaml", folder_ / "in/scenario.resolved.yaml");
  EXPECT_THROW(ReadScenario(folder_ / "in/scenario.resolved.yaml"), InputError);
}

TEST_F(TrustTest, NorFilesOfTheKernelAtAll) {
  Write("/proc/self/environ");
  EXPECT_THAT(Refusal(), IsOutside());
  EXPECT_THAT(Refusal({}, Trust::kFull), HasSubstr("/proc"));
  EXPECT_THAT(Refusal({{"plan.file", "/proc/self/environ"}}), HasSubstr("/proc"));
}

TEST_F(TrustTest, WhatTheUserTypedIsRead) {
  EXPECT_EQ(Refusal({{"plan.file", (folder_ / "out.csv").string()}}), "");
  EXPECT_EQ(Refusal({{"plan", "{file: " + (folder_ / "out.csv").string() + "}"}}), "");
  // That file, and no other.
  Write("../out.csv");
  EXPECT_THAT(Refusal({{"risk.tables", (folder_ / "out.yaml").string()}}), IsOutside());
}

TEST_F(TrustTest, AWorkingTreeIsReadWhole) {
  fs::create_directory(folder_ / ".git");
  Save(".git/config", "x_m,y_m\n1.5,2.5\n3,2.5\n");
  EXPECT_EQ(ProjectFolder(folder_ / "in/s.yaml"), fs::canonical(folder_));
  Write("../out.csv");
  EXPECT_EQ(Refusal(), "");
  Write("../.git/config");
  EXPECT_THAT(Refusal(), HasSubstr("hidden"));
  if (geteuid() != 0) return;  // only root can give a folder away
  ASSERT_EQ(chown((folder_ / ".git").c_str(), 65534, 65534), 0);
  EXPECT_EQ(ProjectFolder(folder_ / "in/s.yaml"), fs::canonical(folder_ / "in"))
      << "another user's .git widens nothing";
}

TEST_F(TrustTest, AMapReadsItsFolderOrWorkingTree) {
  const InputFiles files;
  ConfineMap(folder_ / "in/map.yaml", files);
  EXPECT_EQ(files.WhyUnreadable(folder_ / "in/plan.csv", 1 << 20), "");
  EXPECT_THAT(files.WhyUnreadable(folder_ / "out.csv", 1 << 20),
              AllOf(HasSubstr("lies outside the map's folder"), HasSubstr("--trust")));
  fs::create_directory(folder_ / ".git");
  const InputFiles of_tree;
  ConfineMap(folder_ / "in/map.yaml", of_tree);
  EXPECT_EQ(of_tree.WhyUnreadable(folder_ / "out.csv", 1 << 20), "");
}

TEST_F(TrustTest, BundledScenariosAreTheProgramsOwn) {
  EXPECT_NO_THROW(ReadScenario(SourceFile("models/scenarios/demo_beluga.yaml")));
}

class TrustedPrograms : public TrustTest {
 protected:
  TrustedPrograms() {
    fs::permissions(Save("in/plan.sh",
                         "#!/bin/sh\ntouch ran\n"
                         "printf 'x_m,y_m\\n1.5,2.5\\n3,2.5\\n' > \"$1\"/plan.csv\n"),
                    fs::perms::owner_all);
  }
  bool Ran() const { return fs::remove(folder_ / "in/ran"); }
};

// Interpreters too: the scenario decides what they do.
TEST_F(TrustedPrograms, OfAScenarioAreNotStarted) {
  for (const char* command : {"[./plan.sh]", "[sh, plan.sh]", "[sh, -c, 'touch ran']"}) {
    Write("{command: " + std::string(command) + "}");
    EXPECT_THAT(Refusal(), AllOf(HasSubstr("s.yaml:"), HasSubstr("plan.command = "),
                                 HasSubstr("--trust runs it")));
    EXPECT_FALSE(Ran()) << command;
  }
  Write("{command: [./plan.sh]}");
  EXPECT_EQ(Refusal({}, Trust::kFull), "");
  EXPECT_TRUE(Ran());
}

TEST_F(TrustedPrograms, NorWhereAVariantOrACleanerNamesThem) {
  std::string text =
      RoomScenario("", "matrix: {planner: [{label: a, plan: {command: [./plan.sh]}}]}\n");
  Save("in/s.yaml", text);
  const ScenarioFile file(folder_ / "in/s.yaml");
  EXPECT_THROW(MakePlan(file.Read(0, file.variants().at(0))), InputError);
  EXPECT_FALSE(Ran());
}

TEST_F(TrustedPrograms, OfTheUserAre) {
  EXPECT_EQ(Refusal({{"plan.command", "[./plan.sh]"}}), "");
  EXPECT_TRUE(Ran());
}

}  // namespace
}  // namespace floorproof
