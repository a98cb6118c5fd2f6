// SPDX-License-Identifier: Apache-2.0
// Bad input of any kind: exit status 2; one line that names what is wrong; within a second of CPU
// and 500 MB; and no file that was not there before.
#include "tests/bad_input/bad_input.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "apps/run_floorproof.h"
#include "base/error.h"
#include "base/printable.h"
#include "base/sanitizer.h"
#include "tests/bad_input/child.h"
#include "tests/own_folder.h"
#include "tests/places.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

#ifdef FP_ADDRESS_SANITIZER
constexpr double kMaxCpu_s = 20, kMaxMb = 4000;
#else
constexpr double kMaxCpu_s = 1, kMaxMb = 500;
#endif

class BadInputFolder : public OwnFolderTest {
 protected:
  BadInputFolder() { Write(GoodFiles()); }

  void Write(const Files& files) const {
    for (const auto& [name, content] : files)
      std::ofstream(folder_ / name, std::ios::binary) << content;
  }
  // Every entry below the folder, with the size of files.
  std::set<std::string> Listing() const {
    std::set<std::string> entries;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      const bool file = fs::is_regular_file(entry.symlink_status());
      entries.insert(entry.path().lexically_relative(folder_).string() +
                     (file ? " " + std::to_string(entry.file_size()) : ""));
    }
    return entries;
  }
  ChildResult Run(const std::vector<std::string>& arguments, const ChildLimits& limits = {}) const {
    return RunChild(ProgramFile().string(), arguments, folder_, limits);
  }
  static void ExpectOneLine(const ChildResult& dut) {
    EXPECT_EQ(dut.signal, 0) << "killed";
    EXPECT_EQ(dut.status, 2) << dut.out;
    EXPECT_EQ(std::ranges::count(dut.err, '\n'), 1) << dut.err;
    EXPECT_TRUE(dut.err.starts_with("floorproof: ") && dut.err.ends_with("\n")) << dut.err;
    EXPECT_LE(dut.err.size(), kMaxErrorLine + 40);
    EXPECT_EQ(WhyUnprintable(dut.err), "");
    for (const char* never : {"json.exception", "hunter2"})
      EXPECT_EQ(dut.err.find(never), std::string::npos) << dut.err;
    EXPECT_LE(dut.cpu_s, kMaxCpu_s);
    EXPECT_LE(dut.most_mb, kMaxMb);
  }
};

class BadInputTest : public BadInputFolder, public ::testing::WithParamInterface<BadInput> {
 protected:
  // `run` runs the program with arguments, in the folder.
  void ExpectRefusal(
      const std::function<ChildResult(const std::vector<std::string>& arguments)>& run) const {
    const BadInput& c = GetParam();
    Write(c.files);
    if (c.prepare && !c.prepare(folder_)) GTEST_SKIP() << "cannot be made here";
    const auto before = Listing();
    const ChildResult dut = run(c.arguments);
    ExpectOneLine(dut);
    std::size_t at = 0;
    for (const std::string& word : c.named) {
      at = dut.err.find(word, at);
      ASSERT_NE(at, std::string::npos) << "'" << word << "' is not named in: " << dut.err;
      at += word.size();
    }
    EXPECT_EQ(Listing(), before);
  }
};

// Runs in a forked process, because starting the program takes longer than refusing the input.
TEST_P(BadInputTest, IsOneLine) {
  ExpectRefusal([&](const std::vector<std::string>& arguments) {
    return RunForked(RunFloorproof, arguments, folder_);
  });
}

// The program itself, once a table.
using BadInputOfTheProgramTest = BadInputTest;

TEST_P(BadInputOfTheProgramTest, IsOneLine) {
  ExpectRefusal([&](const std::vector<std::string>& arguments) { return Run(arguments); });
}

std::vector<BadInput> FirstOfEachTable() {
  return {YamlCases().front(),      ScenarioCases().front(), SensingCases().front(),
          SiteCases().front(),      MapCases().front(),      PlanCases().front(),
          RobotCases().front(),     CommandCases().front(),  RecordCases().front(),
          InputLimitCases().front()};
}

std::string TestName(const ::testing::TestParamInfo<BadInput>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Tables, BadInputOfTheProgramTest, ::testing::ValuesIn(FirstOfEachTable()));
INSTANTIATE_TEST_SUITE_P(Yaml, BadInputTest, ::testing::ValuesIn(YamlCases()), TestName);
INSTANTIATE_TEST_SUITE_P(Scenario, BadInputTest, ::testing::ValuesIn(ScenarioCases()), TestName);
INSTANTIATE_TEST_SUITE_P(Sensing, BadInputTest, ::testing::ValuesIn(SensingCases()), TestName);
INSTANTIATE_TEST_SUITE_P(Site, BadInputTest, ::testing::ValuesIn(SiteCases()), TestName);
INSTANTIATE_TEST_SUITE_P(Map, BadInputTest, ::testing::ValuesIn(MapCases()), TestName);
INSTANTIATE_TEST_SUITE_P(Plan, BadInputTest, ::testing::ValuesIn(PlanCases()), TestName);
INSTANTIATE_TEST_SUITE_P(Robot, BadInputTest, ::testing::ValuesIn(RobotCases()), TestName);
INSTANTIATE_TEST_SUITE_P(Command, BadInputTest, ::testing::ValuesIn(CommandCases()), TestName);
INSTANTIATE_TEST_SUITE_P(Record, BadInputTest, ::testing::ValuesIn(RecordCases()), TestName);
INSTANTIATE_TEST_SUITE_P(Limit, BadInputTest, ::testing::ValuesIn(InputLimitCases()), TestName);

// What every case begins with is good: what the program refuses is what the case broke.
using GoodInputTest = BadInputFolder;

TEST_F(GoodInputTest, IsTaken) {
  for (const char* scenario : {"scenario.yaml", "drawn.yaml"}) {
    const ChildResult dut = Run({"run", scenario, "--set", "drive=none", "--out", "o"});
    EXPECT_EQ(dut.status, 0) << dut.err;
    EXPECT_EQ(dut.err, "");
  }
  for (const char* image : {"map.png", "map.bmp"}) {
    Write({{"map.yaml", Replaced(GoodFiles().at("map.yaml"), "map.pgm", image)}});
    EXPECT_EQ(Run({"plan", "scenario.yaml", "--out", "o"}).status, 0) << image;
  }
}

// Windows line ends and byte order marks are no fault.
TEST_F(GoodInputTest, MayComeFromWindows) {
  for (const char* name : {"scenario.yaml", "site.yaml", "map.yaml", "plan.csv"}) {
    std::string text = "\xEF\xBB\xBF";
    for (const char c : GoodFiles().at(name))
      text += c == '\n' ? std::string("\r\n") : std::string(1, c);
    Write({{name, text}});
  }
  const ChildResult dut = Run({"plan", "scenario.yaml", "--out", "o"});
  EXPECT_EQ(dut.status, 0) << dut.err;
}

// Output on the terminal is printable, whatever folders, files and parts of a robot are called.
TEST_F(GoodInputTest, MayHaveNamesThatTurnAndColourText) {
  const std::string odd = "a\u202egnp\x1b[31m\u009b\u2028b";
  std::string robot = Slurp(SourceFile("models/beluga.xml"));
  robot = Replaced(robot, "model=\"", "model=\"a&#x202e;&#x9b;&#x2028;");
  fs::create_directory(folder_ / odd);
  Write({{odd + "/drawn.yaml",
          Replaced(GoodFiles().at("drawn.yaml"), "name: beluga", "name: robot.xml")},
         {odd + "/robot.xml", robot}});
  const std::string out = odd + "/o";
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"run", odd + "/drawn.yaml", "--out", out},
        {"replay", out},
        {"report", out},
        {"robot", odd + "/robot.xml"},
        {"scene", odd + "/drawn.yaml", "--out", odd + "/scene.xml"},
        {"campaign", odd + "/drawn.yaml", "-n", "1", "--jobs", "1", "--out", odd + "/c"},
        {"report", odd + "/c"},
        {"--json", "plan", odd + "/drawn.yaml", "--out", odd + "/p"},
        {"run", odd + "/no.yaml"}}) {
    const ChildResult dut = Run(command, {.cpu_s = 60, .wall_s = 100});
    EXPECT_EQ(WhyUnprintable(dut.out), "") << command[0];
    EXPECT_EQ(WhyUnprintable(dut.err), "") << command[0];
    EXPECT_NE(dut.out + dut.err, "") << command[0];
    EXPECT_EQ(dut.status, command.back().ends_with("no.yaml") ? 2 : 0) << dut.err;
  }
}

// What a plan or a robot cannot do is an outcome, not bad input.
TEST_F(GoodInputTest, MayHaveNoPlan) {
  const ChildResult dut = Run({"plan", "drawn.yaml", "--out", "o", "--set", "plan.radius_m=1.5"});
  EXPECT_EQ(dut.status, 1) << dut.err;
  EXPECT_TRUE(fs::exists(folder_ / "o" / "plan.json"));
}

// A disk that is full, wherever that is met: what was written before stays, no piece of a file is
// left, and a verdict that was reached was said, with what is missing; the status is 3.
using FullDiskTest = BadInputFolder;

TEST_F(FullDiskTest, LeavesWholeFilesOnly) {
  bool some_driven = false, some_not = false;
  for (const std::size_t room : {0, 100, 1500, 5000, 20000}) {
    fs::remove_all(folder_ / "o");
    const ChildResult dut = Run({"run", "drawn.yaml", "--out", "o"}, {.file_bytes = room});
    EXPECT_EQ(std::ranges::count(dut.err, '\n'), 1) << dut.err;
    EXPECT_NE(dut.err.find("cannot be written: "), std::string::npos) << dut.err;
    for (const auto& entry : fs::directory_iterator(folder_ / "o")) {
      EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
      EXPECT_LE(entry.file_size(), room) << entry.path();
      EXPECT_NE(entry.path().filename(), "result.json") << "says that the rest is whole";
    }
    bool driven = true;
    for (const char* before : {"/files.sha256", "/inputs/", "/scenario.resolved.yaml", "/plan.csv",
                               "/plan.json", "/risk.csv"})
      driven = driven && dut.err.find(before) == std::string::npos;
    EXPECT_EQ(dut.status, 3) << dut.err;
    EXPECT_EQ(dut.err.find("; missing: ") != std::string::npos, driven) << dut.err;
    EXPECT_EQ(dut.out.find("  Verdict             success\n") != std::string::npos, driven)
        << dut.out << dut.err;
    some_driven |= driven, some_not |= !driven;
  }
  EXPECT_TRUE(some_driven && some_not) << "the disk was full before the drive, and behind it";
}

TEST_F(FullDiskTest, IsNoBadInputOfAnyCommand) {
  const std::vector<std::vector<std::string>> commands = {
      {"plan", "drawn.yaml", "--out", "o"},
      {"campaign", "drawn.yaml", "-n", "2", "--jobs", "1", "--set", "gate=none", "--out", "o"},
      {"scene", "drawn.yaml", "--out", "scene.xml"},
      {"init", "map.yaml", "--out", "o"},
      {"robot", "beluga", "--out", "o/beluga.xml"},
      {"suite", "beluga", "--methods", "step", "--out", "o"},
      {"validate", "--out", "o"}};
  for (const std::vector<std::string>& command : commands)
    for (const std::size_t room : {0, 40}) {
      fs::remove_all(folder_ / "o");
      const ChildResult dut = Run(command, {.file_bytes = room});
      EXPECT_EQ(dut.status, 3) << command[0] << ": " << dut.err;
      EXPECT_EQ(std::ranges::count(dut.err, '\n'), 1) << dut.err;
      EXPECT_NE(dut.err.find("cannot be written: "), std::string::npos) << dut.err;
    }
  if (!fs::is_character_file("/dev/full")) return;
  const ChildResult dut = Run({"scene", "drawn.yaml", "--out", "/dev/full"});
  EXPECT_EQ(dut.status, 3);
  EXPECT_NE(dut.err.find("/dev/full: cannot be written: No space left on device"),
            std::string::npos);
}

}  // namespace
}  // namespace floorproof
