// SPDX-License-Identifier: Apache-2.0
// `suite` from end to end: the same bytes again, what scripts go by, and robots side by side.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/run_program.h"
#include "tests/own_folder.h"
#include "tests/places.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kFiles[] = {"suite.json", "suite.csv", "runs.csv", "junit.xml",
                                  "report.html"};
// Two runs a size.
constexpr const char* kTiny =
    " --methods bump --reliability 0.5 --confidence 0.75 --no-films --quiet";

class SuiteCommand : public OwnFolderTest {
 protected:
  Result Run(const std::string& arguments) const {
    return RunProgram(folder_, "suite " + arguments);
  }
  std::string Load(const std::string& name) const { return Slurp(folder_ / name); }
};

// Whoever reads a gate in CI reads the exit status, or junit.xml.
TEST_F(SuiteCommand, GivesTheSameBytesAgainAndJunitSaysWhatTheExitStatusSays) {
  const std::string tiny = std::string("beluga --require bump=0.01") + kTiny;
  ASSERT_EQ(Run(tiny + " --jobs 1 --out one").status, 0);
  ASSERT_EQ(Run(tiny + " --jobs 2 --out two").status, 0);
  for (const std::string file : kFiles) {
    EXPECT_NE(Load("one/" + file), "") << file;
    EXPECT_EQ(Load("one/" + file), Load("two/" + file)) << file;
  }
  EXPECT_THAT(Load("one/junit.xml"), HasSubstr("failures=\"0\""));
  EXPECT_THAT(Load("one/junit.xml"), Not(HasSubstr("<failure ")));
  const Result missed = Run(std::string("beluga --require bump=0.3 --seed 1 --out other") + kTiny);
  EXPECT_EQ(missed.status, 1) << missed.err;
  EXPECT_EQ(missed.err, "") << "a verdict is no error";
  EXPECT_THAT(Load("other/junit.xml"), HasSubstr("failures=\"1\""));
  EXPECT_THAT(Load("other/junit.xml"), HasSubstr("0.3 m/s is required"));
  EXPECT_NE(Load("one/runs.csv"), Load("other/runs.csv")) << "other draws";
}

// Both meet the same draws: one robot under two names does the same.
TEST_F(SuiteCommand, ARobotBesideItsCopyDoesTheSame) {
  fs::copy_file(SourceFile("models/beluga.xml"), folder_ / "copy.xml");
  const Result dut = Run(std::string("beluga copy.xml --json --out o") + kTiny);
  ASSERT_EQ(dut.status, 0) << dut.err;
  const auto json = nlohmann::json::parse(dut.out);
  EXPECT_EQ(json, nlohmann::json::parse(Load("o/suite.json")));
  ASSERT_EQ(json["robots"].size(), 2u);
  EXPECT_EQ(json["robots"][0]["robot"], "beluga");
  EXPECT_EQ(json["robots"][1]["robot"], "copy");
  EXPECT_EQ(json["robots"][0]["methods"], json["robots"][1]["methods"]);
  EXPECT_GT(json["robots"][0]["methods"][0]["size"], 0);
  EXPECT_THAT(Load("o/report.html"), HasSubstr("<h1>beluga and copy</h1>"));
}

}  // namespace
}  // namespace floorproof
