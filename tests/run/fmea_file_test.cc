// SPDX-License-Identifier: Apache-2.0
// The tables that risk is made of as a file, the scenario's key `risk`, and what is written of it.
#include "run/scenario/fmea_file.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "base/file_output.h"
#include "base/input_file.h"
#include "planners/risk/risk_meter.h"
#include "run/episode/make_plan.h"
#include "run/episode/records.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"
#include "tests/places.h"
#include "tests/planners/risk_floors.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::PaperTables;

void ExpectEqual(const FmeaTables& a, const FmeaTables& b) {
  EXPECT_EQ(a.detectability, b.detectability);
  EXPECT_EQ(a.mode_of_class, b.mode_of_class);
  EXPECT_EQ(a.effect_of_mode, b.effect_of_mode);
  EXPECT_EQ(a.severity, b.severity);
}

class FmeaFile : public ScenarioTest {
 protected:
  FmeaFile() {
    Save("plan.csv", "x_m,y_m\n1.5,2.5\n3,2.5\n");
    std::ifstream in(Bundled());
    std::stringstream text;
    text << in.rdbuf();
    text_ = text.str();
  }
  static std::filesystem::path Bundled() { return SourceFile("models/fmea/htetro.yaml"); }
  // The bundled text with one piece of it exchanged.
  std::string With(const std::string& piece, const std::string& other) const {
    const auto at = text_.find(piece);
    EXPECT_NE(at, std::string::npos) << piece;
    EXPECT_EQ(text_.find(piece, at + 1), std::string::npos) << piece << " stands there twice";
    std::string text = text_;
    return text.replace(at, piece.size(), other);
  }
  template <class Reading>
  static std::string RefusalOf(const Reading& reading) {
    try {
      reading();
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }
  std::string Refusal(const std::string& text) const {
    return RefusalOf([&] { ReadFmeaTables(Save("tables.yaml", text)); });
  }
  std::string RefusalWith(const std::string& piece, const std::string& other) const {
    return Refusal(With(piece, other));
  }
  std::string ScenarioRefusal(const std::string& more) const {
    return RefusalOf([&] { Read(RoomScenario("", more)); });
  }
  nlohmann::json ReadJson(const std::string& name) const {
    std::ifstream in(folder_ / name);
    return nlohmann::json::parse(in);
  }
  std::string text_;
};

TEST_F(FmeaFile, TheBundledFileHoldsThePapersTables) {
  const FmeaTables dut = ReadFmeaTables(Bundled());
  ExpectEqual(dut, PaperTables());
  // RF of one hazard cell alone at distance 0: 2 / 20 of its weight.
  EXPECT_NEAR(dut.Weight(HazardClass::kBlindObject) / 10, 0.186, 1e-12);
  EXPECT_NEAR(dut.Weight(HazardClass::kGlass) / 10, 0.372, 1e-12);
  EXPECT_NEAR(dut.Weight(HazardClass::kLevelChange) / 10, 1.1895, 1e-12);
  EXPECT_NEAR(dut.Weight(HazardClass::kTerrain) / 10, 0.958, 1e-12);
}

TEST_F(FmeaFile, AProbabilityOutsideOfItsRangeIsRefused) {
  EXPECT_THAT(RefusalWith("modes: {F1: 0.1, F2: 0.2, F3: 0,   F4: 0.7}}\n  C2",
                          "modes: {F1: 1.1, F2: 0.2, F3: 0,   F4: -0.3}}\n  C2"),
              AllOf(HasSubstr("tables.yaml:8:"),
                    HasSubstr("classes.C1.modes.F1 = 1.1: must be in [0, 1]")));
  EXPECT_THAT(RefusalWith("{E1: 0.75, E2: 0.1, E3: 0.1, E4: 0.05, E5: 0}",
                          "{E1: 0.75, E2: 0.1, E3: 0.2, E4: -0.05, E5: 0}"),
              AllOf(HasSubstr("tables.yaml:13:"),
                    HasSubstr("modes.F1.effects.E4 = -0.05: must be in [0, 1]")));
  EXPECT_THAT(RefusalWith("F1: 0.3, F2: 0.7", "F1: .nan, F2: 0.7"),
              HasSubstr("classes.C4.modes.F1"));
}

TEST_F(FmeaFile, ARowThatDoesNotSumTo1IsNamedWithItsLine) {
  EXPECT_THAT(RefusalWith("F1: 0,   F2: 0.1, F3: 0.8, F4: 0.1", "F1: 0, F2: 0.1, F3: 0.8, F4: 0"),
              AllOf(HasSubstr("tables.yaml:10:"), HasSubstr("classes.C3.modes: must sum to 1"),
                    HasSubstr("F1 to F4 are 0.9")));
  EXPECT_THAT(RefusalWith("E3: 0.3, E4: 0,    E5: 0.7", "E3: 0.3, E4: 0.125, E5: 0.7"),
              AllOf(HasSubstr("tables.yaml:15:"), HasSubstr("modes.F3.effects: must sum to 1"),
                    HasSubstr("E1 to E5 are 1.125")));
  // To a millionth: thirds may be written.
  EXPECT_EQ(RefusalWith("F1: 0.3, F2: 0.7, F3: 0,   F4: 0}",
                        "F1: 0.3333333, F2: 0.3333333, F3: 0, F4: 0.3333333}"),
            "accepted");
  EXPECT_THAT(
      RefusalWith("F1: 0.3, F2: 0.7, F3: 0,   F4: 0}", "F1: 0.333, F2: 0.333, F3: 0, F4: 0.333}"),
      HasSubstr("classes.C4.modes: must sum to 1"));
}

TEST_F(FmeaFile, EveryKeyMustBeThere) {
  EXPECT_THAT(RefusalWith("fmea: 1\n", ""), HasSubstr("fmea: the key is missing"));
  EXPECT_THAT(RefusalWith(", F3: 0.8, F4: 0.1", ", F3: 0.9"),
              HasSubstr("classes.C3.modes.F4: the key is missing"));
  EXPECT_THAT(RefusalWith("detectability: 2, ", ""),
              HasSubstr("classes.C2.detectability: the key is missing"));
  EXPECT_THAT(RefusalWith(", effects: {E1: 0.1,  E2: 0,   E3: 0.9, E4: 0,    E5: 0}", ""),
              HasSubstr("modes.F2.effects: the key is missing"));
  EXPECT_THAT(RefusalWith(", severity: 5", ""),
              HasSubstr("effects.E5.severity: the key is missing"));
  EXPECT_THAT(Refusal(text_.substr(0, text_.find("  E5: {name"))),
              HasSubstr("effects.E5: the key is missing"));
  EXPECT_THAT(Refusal(text_.substr(0, text_.find("effects:  "))),
              HasSubstr("effects: the key is missing"));
}

TEST_F(FmeaFile, ANameMayBeLeftOut) {
  EXPECT_EQ(RefusalWith("name: glass,        ", ""), "accepted");
  EXPECT_EQ(RefusalWith("name: roll over,      ", ""), "accepted");
}

TEST_F(FmeaFile, AnUnknownKeyIsRefusedWithTheNearest) {
  EXPECT_THAT(
      RefusalWith("detectability: 4", "detectabilty: 4"),
      AllOf(HasSubstr("classes.C4.detectabilty"), HasSubstr("did you mean detectability?")));
  EXPECT_THAT(RefusalWith("effects:            # Table 2", "efects:            # Table 2"),
              HasSubstr("efects: unknown key; did you mean effects?"));
  EXPECT_THAT(
      RefusalWith("  E1: {name: \"no damage", "  E6: {severity: 5}\n  E1: {name: \"no damage"),
      HasSubstr("effects.E6: unknown key"));
  EXPECT_THAT(RefusalWith("F1: 0.3, F2: 0.7", "F5: 0, F1: 0.3, F2: 0.7"),
              HasSubstr("classes.C4.modes.F5: unknown key"));
}

TEST_F(FmeaFile, WhatIsOfAnotherKindIsRefused) {
  EXPECT_THAT(RefusalWith("{F1: 0.3, F2: 0.7, F3: 0,   F4: 0}", "[0.3, 0.7, 0, 0]"),
              HasSubstr("classes.C4.modes: must be a map of keys"));
  EXPECT_THAT(RefusalWith("detectability: 3", "detectability: hard"),
              HasSubstr("classes.C3.detectability = hard"));
  EXPECT_THAT(RefusalWith("detectability: 3", "detectability: 0"),
              HasSubstr("classes.C3.detectability = 0"));
  EXPECT_THAT(RefusalWith("severity: 4", "severity: -4"), HasSubstr("effects.E4.severity = -4"));
  EXPECT_THAT(RefusalWith("fmea: 1\n", "fmea: 2\n"),
              HasSubstr("tables.yaml:6: fmea = 2: must be in [1, 1]"));
  EXPECT_THAT(Refusal("- 1\n- 2\n"), HasSubstr("tables.yaml:1: must be a map of keys"));
  EXPECT_THAT(Refusal("tables\n"), HasSubstr("tables.yaml:1: must be a map of keys"));
  EXPECT_THAT(Refusal(""), HasSubstr("must be a map of keys"));
  EXPECT_THAT(Refusal("fmea: 1\nclasses: [\n"), HasSubstr("tables.yaml:"));
  EXPECT_THROW(ReadFmeaTables(folder_ / "none.yaml"), InputError);
}

TEST_F(FmeaFile, AScenarioHasThePapersRiskUnlessItSaysElse) {
  const Scenario dut = Read(RoomScenario(""));
  ExpectEqual(dut.spec.fmea, PaperTables());
  EXPECT_EQ(dut.spec.risk.distance_scale, 1);
  EXPECT_FALSE(dut.spec.risk.walls_are_hazards);
  EXPECT_FALSE(dut.spec.risk.cell_m);
  const Scenario other =
      Read(RoomScenario("", "risk: {tables: htetro, cell_m: 1, walls_are_hazards: true}\n"),
           {{"risk.distance_scale", "20"}});
  EXPECT_EQ(other.spec.risk.distance_scale, 20);
  EXPECT_TRUE(other.spec.risk.walls_are_hazards);
  EXPECT_EQ(other.spec.risk.cell_m, 1);
  EXPECT_EQ(MakePlan(other).risk->grid.frame.cell_m, 1);
  EXPECT_GT(MakePlan(other).risk->rf(4, 2), 0) << "outer walls are all that there is";
  EXPECT_EQ(MakePlan(dut).risk->rf(4, 2), 0);
}

TEST_F(FmeaFile, AScenarioNamesItsOwnTables) {
  // All severities twice as high: all risk is.
  std::string text = text_;
  for (int k = 1; k <= 5; ++k) {
    const std::string piece = "severity: " + std::to_string(k) + "}";
    text.replace(text.find(piece), piece.size(), "severity: " + std::to_string(20 * k) + "}");
  }
  std::filesystem::create_directories(folder_ / "tables");
  Save("tables/mine.yaml", text);
  const std::string step = "{type: step, polygon_m: [[3, 1], [4, 1], [4, 2]], height_m: -0.1}";
  const Scenario paper = Read(RoomScenario(step));
  const Scenario dut = Read(RoomScenario(step, "risk: {tables: tables/mine.yaml}\n"));
  const PlanResult theirs = MakePlan(paper), mine = MakePlan(dut);
  ASSERT_EQ(mine.risk->rf.cells.size(), theirs.risk->rf.cells.size());
  for (std::size_t i = 0; i < mine.risk->rf.cells.size(); ++i) {
    EXPECT_GT(mine.risk->rf.cells[i], 0);
    EXPECT_NEAR(mine.risk->rf.cells[i], 20 * theirs.risk->rf.cells[i], 2e-8);
  }
}

TEST_F(FmeaFile, ARiskThatCannotBeIsRefused) {
  EXPECT_THAT(ScenarioRefusal("risk: {tables: beluga}\n"),
              HasSubstr("risk.tables = beluga: must be htetro, or a .yaml file"));
  EXPECT_THAT(ScenarioRefusal("risk: {tables: none.yaml}\n"),
              AllOf(HasSubstr("risk.tables = none.yaml"), HasSubstr("no such file")));
  EXPECT_THAT(ScenarioRefusal("risk: {tables: [1]}\n"), HasSubstr("risk.tables"));
  EXPECT_THAT(ScenarioRefusal("risk: {table: htetro}\n"),
              HasSubstr("risk.table: unknown key; did you mean tables?"));
  EXPECT_THAT(ScenarioRefusal("risk: htetro\n"), HasSubstr("risk"));
  EXPECT_THAT(ScenarioRefusal("risk: {distance_scale: -0.1}\n"),
              HasSubstr("risk.distance_scale = -0.1: must be >= 0"));
  EXPECT_THAT(ScenarioRefusal("risk: {walls_are_hazards: 2}\n"),
              HasSubstr("risk.walls_are_hazards = 2"));
  // Cells of no width, and so many or so wide that none would end.
  for (const std::string cell_m : {"0", "-1", "0.001", "1000000"})
    EXPECT_THAT(ScenarioRefusal("risk: {cell_m: " + cell_m + "}\n"),
                HasSubstr("risk.cell_m = " + cell_m + ": must be in [0.05, 10]"));
  Save("wrong.yaml", With("detectability: 3", "detectability: 0"));
  EXPECT_THAT(ScenarioRefusal("risk: {tables: wrong.yaml}\n"),
              AllOf(HasSubstr("wrong.yaml:10:"), HasSubstr("classes.C3.detectability")));
}

TEST_F(FmeaFile, ResolvedTwiceIsItself) {
  Save("mine.yaml", With("severity: 5", "severity: 6"));
  const Scenario first = Read(RoomScenario(
      "",
      "risk: {tables: mine.yaml, distance_scale: 2.5, cell_m: 0.75, walls_are_hazards: true}\n"));
  const auto out = folder_ / "out" / "deeper";
  std::filesystem::create_directories(out);
  const std::string once = ResolvedScenario(first, out);
  EXPECT_THAT(once, HasSubstr("tables: \"../../mine.yaml\""));
  WriteFileWhole(out / "scenario.resolved.yaml", once);
  const Scenario second = ReadScenario(out / "scenario.resolved.yaml", {}, Trust::kFull);
  EXPECT_EQ(ResolvedScenario(second, out), once);
  EXPECT_EQ(second.spec.fmea.severity[4], 6);
  EXPECT_EQ(second.spec.risk.distance_scale, 2.5);
  EXPECT_EQ(second.spec.risk.cell_m, 0.75);
  EXPECT_TRUE(second.spec.risk.walls_are_hazards);
  // The file is one of those that the run hangs on.
  Save("mine.yaml", With("severity: 5", "severity: 7"));
  try {
    ReadScenario(out / "scenario.resolved.yaml", {}, Trust::kFull);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("mine.yaml"), HasSubstr("the file has changed since")));
  }
  const std::string bundled = ResolvedScenario(Read(RoomScenario("", "risk: {}\n")), folder_);
  EXPECT_THAT(bundled, HasSubstr("tables: \"htetro\""));
  EXPECT_THAT(bundled, HasSubstr("cell_m: none"));
}

TEST_F(FmeaFile, TablesThatVaryAreFoundFromTheResolvedFilesFolder) {
  Save("mine.yaml", text_);
  const auto out = folder_ / "out" / "deeper";
  std::filesystem::create_directories(out);
  for (const std::string matrix :
       {"{risk.tables: [htetro, mine.yaml]}",
        "{tables: [{label: a, risk: {tables: htetro}}, {label: b, risk: {tables: mine.yaml}}]}"}) {
    const std::string once =
        ResolvedScenario(Read(RoomScenario("", "matrix: " + matrix + "\n")), out);
    const auto at = once.find("matrix:");
    const std::string written = once.substr(at, once.find("files:") - at);
    EXPECT_THAT(written, HasSubstr("../../mine.yaml"));
    EXPECT_EQ(written.find("/htetro"), std::string::npos) << "a name stays a name";
    WriteFileWhole(out / "scenario.resolved.yaml", once);
    EXPECT_EQ(ResolvedScenario(ReadScenario(out / "scenario.resolved.yaml", {}, Trust::kFull), out),
              once);
  }
}

const char kDrop[] =
    "{type: step, id: drop, polygon_m: [[7.5, 3.5], [8.5, 3.5], [8.5, 4.5], [7.5, 4.5]], "
    "height_m: -0.1}, {type: cable_cover, line_m: [[5, 0.5], [5, 4.5]], width_m: 0.13, "
    "top_width_m: 0.05, height_m: 0.01}";

TEST_F(FmeaFile, RiskCsvHasTheTopRowFirst) {
  const Scenario scenario = Read(RoomScenario(kDrop, "risk: {}\n"));
  const PlanResult plan = MakePlan(scenario);
  WritePlanFiles(scenario, plan, folder_);
  std::ifstream in(folder_ / "risk.csv");
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  const Grid<double>& rf = plan.risk->rf;
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(rf.height));
  for (int iy = 0; iy < rf.height; ++iy) {
    const auto& row = rows[static_cast<std::size_t>(rf.height - 1 - iy)];
    ASSERT_EQ(row.size(), static_cast<std::size_t>(rf.width));
    for (int ix = 0; ix < rf.width; ++ix)
      EXPECT_EQ(row[static_cast<std::size_t>(ix)], rf(ix, iy)) << "read back to the bit";
  }
  // The drop is up on the right.
  EXPECT_GT(rows[1][16], rows[8][16]);
  EXPECT_GT(rows[1][16], rows[1][1]);
}

TEST_F(FmeaFile, PlanJsonMeasuresTheRiskOfThePath) {
  for (const std::string planner : {"path_transform", "fmea_path_transform"}) {
    const Scenario scenario = Read(RoomScenario(kDrop), {{"plan", planner}});
    const PlanResult plan = MakePlan(scenario);
    ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
    WritePlanFiles(scenario, plan, folder_);
    const nlohmann::json json = ReadJson("plan.json");
    const RiskOfPath expected = MeasureRisk(*plan.risk, plan.path);
    EXPECT_GT(expected.cumulative_risk, 0);
    EXPECT_EQ(json["planner"], planner);
    EXPECT_EQ(json["cumulative_risk"], expected.cumulative_risk);
    EXPECT_EQ(json["risk_of_cells_once"], expected.each_cell_once);
    EXPECT_EQ(json["cells_visited"], expected.cells);
    EXPECT_EQ(json["cell_visits"], expected.visits);
    EXPECT_EQ(json["hazard_free_coverage"], expected.coverage);
    EXPECT_EQ(json["terrain_crossings"], expected.terrain_crossings);
    EXPECT_GE(json["terrain_crossings"], 1);
    ASSERT_EQ(json["visits_by_risk"].size(), 10u);
    int visits = 0;
    for (const auto& range : json["visits_by_risk"]) visits += range["visits"].get<int>();
    EXPECT_EQ(visits, expected.visits);
    EXPECT_LT(json["visits_by_risk"][0]["rf_from"], json["visits_by_risk"][0]["rf_to"]);
    EXPECT_TRUE(json.contains("dead_ends"));
  }
}

TEST_F(FmeaFile, AUsersOwnPlanIsMeasuredToo) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n7.25,2.5\n7.25,1.5\n");
  const Scenario scenario = Read(RoomScenario(kDrop, "risk: {}\n"));
  WritePlanFiles(scenario, MakePlan(scenario), folder_);
  EXPECT_EQ(ReadJson("plan.json")["terrain_crossings"], 1);
  EXPECT_GT(ReadJson("plan.json")["cumulative_risk"], 0);
}

// Of risk nothing is said where nobody asks: no file, no figure, no metric; and what an earlier
// plan left of it goes.
TEST_F(FmeaFile, RiskIsSpokenOfWhereItIsAskedFor) {
  Save("plan.csv", "x_m,y_m\n1.5,2.5\n3,2.5\n");
  const auto asks = [&](const std::string& more, const std::vector<Override>& overrides) {
    Scenario scenario = Read(RoomScenario("", more), overrides);
    const Execution execution = Execute(scenario);
    WritePlanFiles(scenario, execution.plan, folder_);
    const bool file = std::filesystem::exists(folder_ / "risk.csv");
    EXPECT_EQ(AsksForRisk(scenario.spec), file);
    EXPECT_EQ(ReadJson("plan.json").contains("cumulative_risk"), file);
    EXPECT_EQ(execution.record.metrics.cumulative_risk.has_value(), file);
    EXPECT_EQ(ResolvedScenario(scenario, folder_).find("\nrisk:") != std::string::npos, file);
    return file;
  };
  const std::vector<Override> none = {{"time_limit_s", "0.1"}};
  const std::vector<Override> lanes = {{"plan", "boustrophedon"}, none[0]};
  const std::vector<Override> cells = {{"plan", "path_transform"}, none[0]};
  EXPECT_TRUE(asks("", cells));
  EXPECT_FALSE(asks("", none));
  EXPECT_TRUE(asks("risk: {}\n", none));
  EXPECT_FALSE(asks("", lanes));
  EXPECT_TRUE(asks("risk: {distance_scale: 2}\n", lanes));
}

TEST_F(FmeaFile, APlanThatIsRefusedLeavesItsRiskAllTheSame) {
  const Scenario scenario =
      Read(RoomScenario(kDrop, "goal: {x_m: 8, y_m: 4}\n"), {{"plan", "path_transform"}});
  const PlanResult plan = MakePlan(scenario);
  ASSERT_EQ(plan.status, PlanStatus::kGoalUnreachable);
  WritePlanFiles(scenario, plan, folder_);
  const nlohmann::json json = ReadJson("plan.json");
  EXPECT_EQ(json["status"], "goal_unreachable");
  EXPECT_THAT(json["message"].get<std::string>(), HasSubstr("(C3)"));
  EXPECT_EQ(json["cumulative_risk"], 0);
  EXPECT_EQ(json["hazard_free_coverage"], 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "risk.csv"));
}

TEST_F(FmeaFile, UnknownHazardsAreNoRiskToThePlanner) {
  const Scenario scenario = Read(RoomScenario(
      "{type: step, polygon_m: [[7.5, 3.5], [8.5, 3.5], [8.5, 4.5]], height_m: -0.1, known: "
      "false}"));
  const PlanResult plan = MakePlan(scenario);
  for (const double rf : plan.risk->rf.cells) EXPECT_EQ(rf, 0);
}

}  // namespace
}  // namespace floorproof
