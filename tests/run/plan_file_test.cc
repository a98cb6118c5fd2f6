// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/plan_file.h"

#include <gmock/gmock.h>

#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

const GridFrame kMap{20, 20, 0.5, {}};

class PlanFile : public ScenarioTest {
 protected:
  std::string Refusal(const std::string& text) const {
    try {
      ReadPlan(Save("plan.csv", text), kMap);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }
};

TEST_F(PlanFile, WhatIsWrittenReadsBackTheSame) {
  Path path(3);
  path[0].p_W = {0.1 + 0.2, 1.0 / 3};
  path[1] = {{2, 3}, 0.5, "O", 0.25, 12};
  path[2].p_W = {4, 5};
  const Path read = ReadPlan(Save("plan.csv", PlanCsv(path)), kMap);
  ASSERT_EQ(read.size(), 3u);
  EXPECT_EQ(read[0].p_W, path[0].p_W);
  EXPECT_FALSE(read[0].yaw_rad);
  EXPECT_EQ(read[1].yaw_rad, 0.5);
  EXPECT_EQ(read[1].shape, "O");
  EXPECT_EQ(read[1].speed_mps, 0.25);
  EXPECT_EQ(read[1].dwell_s, 12);
  EXPECT_EQ(PlanCsv(read), PlanCsv(path));
}

TEST_F(PlanFile, ColumnsMayComeInAnyOrderAndMayBeMissing) {
  const Path read = ReadPlan(Save("plan.csv", "y_m, x_m\r\n1, 2\r\n\r\n# a comment\n3,4\n"), kMap);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].p_W, Vec2(2, 1));
  EXPECT_EQ(read[1].p_W, Vec2(4, 3));
}

// Each alone may be as long as all together.
TEST_F(PlanFile, DwellsAreBoundedTogether) {
  EXPECT_EQ(Refusal("x_m,y_m,dwell_s\n1,1,60000\n2,2,40000\n"), "accepted");
  EXPECT_THAT(Refusal("x_m,y_m,dwell_s\n1,1,60000\n2,2,40000\n3,3,0.001\n"),
              HasSubstr("plan.csv:4: dwell_s = 0.001: makes more than 100000 s"));
}

TEST_F(PlanFile, ARefusalNamesLineColumnAndRule) {
  EXPECT_THAT(Refusal("x_m,y_m\n1,2\n1,two\n"),
              HasSubstr("plan.csv:3: y_m = two: must be a number"));
  EXPECT_THAT(Refusal("x_m,y_m\n1\n"), HasSubstr("plan.csv:2: has 1 columns, the first row 2"));
  EXPECT_THAT(Refusal("x_m,y\n1,2\n"), HasSubstr("y: unknown column; did you mean y_m?"));
  EXPECT_THAT(Refusal("x_m\n1\n"), HasSubstr("y_m: the column is missing"));
  EXPECT_THAT(Refusal("x_m,y_m\n1,nan\n"), HasSubstr("must be a"));
  EXPECT_THAT(Refusal("x_m,y_m,speed_mps\n1,2,-1\n"), HasSubstr("speed_mps = -1: must be >= 0"));
  EXPECT_THAT(Refusal("x_m,y_m\n4.4e19,2\n"), HasSubstr("lies off the map"));
  EXPECT_THAT(Refusal("x_m,y_m\n100,2\n"), HasSubstr("100, 2: lies off the map"));
  EXPECT_THAT(Refusal("x_m,y_m\n"), HasSubstr("holds no waypoint"));
  EXPECT_THAT(Refusal(""), HasSubstr("holds no waypoint"));
}

class PlacesFile : public PlanFile {
 protected:
  std::string Refusal(const std::string& text) const {
    try {
      ReadPlaces(Save("points.csv", text), kMap);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }
};

TEST_F(PlacesFile, HoldsPlacesInTheirOrder) {
  const std::vector<Vec2> read = ReadPlaces(Save("points.csv", "y_m,x_m\n2,1\n4,3\n"), kMap);
  EXPECT_EQ(read, (std::vector<Vec2>{{1, 2}, {3, 4}}));
}

TEST_F(PlacesFile, TwoInOneCellAreRefusedWithTheLinesOfBoth) {
  const std::string why = Refusal("x_m,y_m\n1.01,2.01\n3,4\n1.04,2.03\n");
  EXPECT_THAT(why, HasSubstr("points.csv:4"));
  EXPECT_THAT(why, HasSubstr("lies in the same cell of 0.05 m as the place in line 2"));
  EXPECT_EQ(Refusal("x_m,y_m\n1.01,2.01\n3,4\n1.06,2.03\n"), "accepted");
}

TEST_F(PlacesFile, RefusesWhatIsNoPlace) {
  EXPECT_THAT(Refusal("x_m,y_m\n"), HasSubstr("holds no place"));
  EXPECT_THAT(Refusal("x_m,y_m,dwell_s\n1,2,3\n"), HasSubstr("unknown column"));
  EXPECT_THAT(Refusal("x_m,y_m\n1,99\n"), HasSubstr("lies off the map"));
}

class AuditScenario : public ScenarioTest {
 protected:
  static std::string With(const std::string& plan) {
    return R"(
scenario: 1
site:
  site: 1
  name: room
  grid:
    cell_m: 0.5
    rows: |
      ######
      #....#
      #....#
      #....#
      ######
robot: beluga
start: {x_m: 1, y_m: 1}
plan: )" + plan +
           "\n";
  }
};

TEST_F(AuditScenario, PlacesOfTheUsersStandInForThoseFound) {
  Save("points.csv", "x_m,y_m\n1,2\n2,1\n");
  const Scenario s = Read(With("{planner: audit, samples: {file: points.csv}}"));
  EXPECT_EQ(s.spec.places, (std::vector<Vec2>{{1, 2}, {2, 1}}));
  const std::vector<std::filesystem::path> files = FilesRead(s);
  EXPECT_TRUE(std::ranges::find(files, s.spec.places_file) != files.end());
  const std::string resolved = ResolvedScenario(s, folder_);
  EXPECT_THAT(resolved, HasSubstr("points.csv"));
  const Scenario again = Read(resolved);
  EXPECT_EQ(again.spec.places, s.spec.places);
  EXPECT_EQ(ResolvedScenario(again, folder_), resolved);
}

TEST_F(AuditScenario, AFileThatTheMatrixSetsIsReadBackFromTheResolvedScenario) {
  Save("points.csv", "x_m,y_m\n1,2\n2,1\n");
  Save("more.csv", "x_m,y_m\n1,2\n2,1\n2,2\n");
  const std::string text =
      With("{planner: audit}") + "matrix: {plan.samples.file: [points.csv, more.csv]}\n";
  const ScenarioFile first(Save("scenario.yaml", text));
  const std::string resolved = ResolvedScenario(first.Read(0, first.variants()[0]), folder_);
  const ScenarioFile again(Save("scenario.yaml", resolved));
  ASSERT_EQ(again.variants().size(), 2u);
  EXPECT_EQ(again.Read(0, again.variants()[0]).spec.places.size(), 2u);
  EXPECT_EQ(again.Read(0, again.variants()[1]).spec.places.size(), 3u);
}

TEST_F(AuditScenario, WhatStandsBesideThatFileIsRefused) {
  Save("points.csv", "x_m,y_m\n1,2\n2,1\n");
  try {
    Read(With("{planner: audit, samples: {file: points.csv, du_m: 1}}"));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("plan.samples.du_m"));
    EXPECT_THAT(e.what(), HasSubstr("stands beside plan.samples.file"));
  }
}

}  // namespace
}  // namespace floorproof
