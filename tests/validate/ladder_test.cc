// SPDX-License-Identifier: Apache-2.0
// The ladder's parts, each by itself, and a few crossings of real robots.
#include "validate/ladder.h"

#include <gmock/gmock.h>

#include <set>

#include "env/core/measured_limits.h"
#include "env/scene/measured_block.h"
#include "env/scene/measured_names.h"
#include "tests/map/temp_folder.h"
#include "tests/places.h"
#include "tests/slurp.h"
#include "validate/ladder_findings.h"
#include "validate/ladder_limits.h"

namespace floorproof {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr Rungs kRungs = {.per_unit = 10, .first = 2, .spacing = 20, .last = 602};

TEST(FindLimit, FindsTheLargestSizeCrossedToTheResolution) {
  for (const double truth : {0.2, 0.3, 2.2, 5.7, 24.4, 59.9}) {
    int tries = 0;
    const auto limit = FindLimit(kRungs, [&](double size) {
      ++tries;
      return size <= truth;
    });
    EXPECT_EQ(limit->size, truth);
    EXPECT_FALSE(limit->above_all);
    EXPECT_LE(tries, 2 + truth / 2 + 5);
  }
}

// Crossed again above a size that holds: what counts is up to where everything is crossed.
TEST(FindLimit, StopsAtTheFirstRungThatFails) {
  const auto limit = FindLimit(kRungs, [](double size) { return size < 7 || size > 9; });
  EXPECT_EQ(limit->size, 6.9);
  EXPECT_FALSE(limit->above_all);
}

TEST(FindLimit, SaysWhenNoneOrAllIsCrossed) {
  const auto none = FindLimit(kRungs, [](double) { return false; });
  EXPECT_EQ(none->size, 0);
  EXPECT_FALSE(none->above_all);
  const auto all = FindLimit(kRungs, [](double) { return true; });
  EXPECT_EQ(all->size, 60.2);
  EXPECT_TRUE(all->above_all);
}

// It begins at the origin and ends where the ladder says, at every rung and whichever the way.
TEST(LadderHazards, LieWhereTheyAreSaidTo) {
  for (const LadderHazard& dut : LadderHazards())
    for (const double travel_rad : {0.0, kPi / 4})
      for (int rung = dut.rungs.first; rung <= dut.rungs.last; rung += dut.rungs.spacing) {
        const double size = static_cast<double>(rung) / dut.rungs.per_unit;
        const Hazard hazard = dut.make(size, travel_rad);
        const double turned_rad = dut.name == "rough" ? travel_rad : 0;
        double low = 1e9, high = -1e9;
        for (const Vec2& corner : hazard.footprint.at(0)) {
          const double x = Pose2{0, 0, -turned_rad}.Rotate(corner).x();
          low = std::min(low, x);
          high = std::max(high, x);
        }
        SCOPED_TRACE(std::string(dut.name) + " " + std::to_string(size));
        EXPECT_NEAR(low, 0, 1e-9);
        const bool goes_on = high > 3;  // farther than any robot drives here
        if (goes_on) {
          EXPECT_LT(dut.length_m(size), 1.5);
        } else {
          EXPECT_NEAR(high, dut.length_m(size), 1e-9);
        }
        // Whoever drives down a ramp that is known has not fallen.
        EXPECT_EQ(hazard.known, std::ranges::any_of(hazard.solids, IsSlope));
      }
}

TEST(LadderCells, AreEveryRobotHazardDirectionSpeedAndFrictionOnce) {
  const auto cells = LadderCells({});
  std::set<std::string> seen;
  int rollers = 0;
  for (const LadderCell& cell : cells) {
    const LadderRow row{cell, 0, false, ""};
    EXPECT_TRUE(seen.insert(LadderCsv({&row, 1})).second) << LadderCsv({&row, 1});
    if (cell.robot != "htetro") {
      EXPECT_NE(cell.direction, Direction::kSideways);
      EXPECT_EQ(cell.wheels, "ideal");
    }
    rollers += cell.wheels == "rollers";
  }
  const std::size_t kinds = LadderHazards().size();
  EXPECT_EQ(cells.size(), kinds * (3 * 2 * 3 * 3 + 3 * 3 * 3 + 3 * 3 * 2));
  EXPECT_EQ(LadderCells({.rollers = false}).size(),
            cells.size() - static_cast<std::size_t>(rollers));
  EXPECT_EQ(SweepCells().size(), kinds * (2 + 2 + 2 + 3) * 6 * 3);
  for (const LadderCell& cell : SweepCells()) {
    EXPECT_EQ(cell.speed_mps, 0.2);
    EXPECT_EQ(cell.friction, 0.8);
  }
}

// At 0, 0.5, 1, 3, 5 and 10 degrees off square, and from farther away.
TEST(LadderCells, AreMetSquareAndAslantToo) {
  const auto cells = ObliqueCells();
  EXPECT_EQ(cells.size(), LadderHazards().size() * (2 + 3 + 2 + 2) * 7);
  std::set<std::string> seen;
  for (const LadderCell& cell : cells) {
    const LadderRow row{cell, 0, false, ""};
    EXPECT_TRUE(seen.insert(ObliqueCsv({&row, 1})).second) << ObliqueCsv({&row, 1});
  }
  for (const LadderCell& cell : LadderCells({})) EXPECT_EQ(cell.oblique_deg, 3);
  for (const LadderCell& cell : SweepCells()) EXPECT_EQ(cell.oblique_deg, 3);
}

// A plan's limits: each hazard as a plan meets it, edges at 45 degrees among them.
TEST(RobotCells, AreEveryHazardAndDirectionAtTwoSpeeds) {
  const std::size_t kinds = LadderHazards().size();
  EXPECT_EQ(RobotCells("beluga").size(), kinds * 2 * 2 * 3);
  EXPECT_EQ(RobotCells("htetro").size(), kinds * 4 * 2 * 3);
  for (const LadderCell& cell : RobotCells("beluga")) {
    EXPECT_TRUE(cell.planned);
    EXPECT_EQ(cell.scale, 1);
    EXPECT_TRUE(cell.speed_mps == 0.25 || cell.speed_mps == 0.125) << cell.speed_mps;
  }
  const RobotSpec robot = ReadRobot(FindRobotFile("htetro", {})).spec;
  const LadderCell oblique{"htetro", "ideal", "step", Direction::kOblique, 0.2, 0.8, {}, 0};
  const CrossingPlan plan = PlanOf(oblique, robot, 10);
  EXPECT_NEAR(plan.travel_rad, kPi / 4, 1e-12);
  EXPECT_NEAR(plan.yaw_rad, kPi / 4, 1e-12) << "it drives along its x";
}

// To either side of square; the other corner first.
TEST(RobotCells, AreTriedOnBothHands) {
  const double degree = kPi / 180;
  for (const char* name : {"beluga", "htetro"}) {
    const RobotSpec robot = ReadRobot(FindRobotFile(name, {})).spec;
    for (const LadderCell& cell : RobotCells(name)) {
      const std::vector<LadderCell> dut = Tries(cell);
      ASSERT_EQ(dut.size(), 2u);
      const CrossingPlan a = PlanOf(dut[0], robot, 5), b = PlanOf(dut[1], robot, 5);
      const bool at_45 = a.travel_rad > 4 * degree;
      EXPECT_NEAR(a.travel_rad, (at_45 ? 48 : 3) * degree, 1e-12);
      EXPECT_NEAR(std::abs(b.travel_rad), (at_45 ? 42 : 3) * degree, 1e-12);
      // The body stands as askew to the way, on the other hand where it is a corner.
      const double turned = a.yaw_rad - a.travel_rad;
      EXPECT_NEAR(b.yaw_rad - b.travel_rad, dut[1].mirrored ? -turned : turned, 1e-12);
    }
  }
  for (const LadderCell& cell : ObliqueCells()) EXPECT_EQ(Tries(cell).size(), 1u);
}

// Longer steps of the search for large wheels, finer ones for small; never what cannot be made.
TEST(ScaledRungs, AreAsLongAsTheWheelsAsk) {
  for (const double radius_m : {0.036, 0.05, 0.07}) EXPECT_EQ(RungScale(radius_m), 1) << radius_m;
  EXPECT_EQ(RungScale(0.165), 4);
  EXPECT_EQ(RungScale(0.033), 0.5);
  EXPECT_EQ(RungScale(0.016), 0.25);
  for (const LadderHazard& hazard : LadderHazards())
    for (const double scale : {0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 16.0}) {
      const Rungs dut = ScaledRungs(hazard, scale);
      SCOPED_TRACE(std::string(hazard.name) + " " + std::to_string(scale));
      EXPECT_NO_THROW(hazard.make(static_cast<double>(dut.first) / dut.per_unit, 0));
      const int rungs = (dut.last - dut.first) / dut.spacing;
      EXPECT_NO_THROW(
          hazard.make(static_cast<double>(dut.first + rungs * dut.spacing) / dut.per_unit, 0));
      if (hazard.unit == "mm" && scale <= 2) {
        EXPECT_NEAR(
            static_cast<double>(dut.last) / dut.per_unit,
            std::min(hazard.most, std::max(1.0, scale) * hazard.rungs.last / hazard.rungs.per_unit),
            0.1);
        EXPECT_NEAR(static_cast<double>(dut.spacing) / dut.per_unit,
                    scale * hazard.rungs.spacing / hazard.rungs.per_unit, 1e-9);
      }
    }
}

// What a hazard says of its size is what the ladder calls it, or nobody would look its limit up.
TEST(LadderHazards, StateTheSizeThatTheLadderGivesThem) {
  for (const LadderHazard& dut : LadderHazards())
    for (const double size : {2.2, 5.0, 10.0, 25.0}) {
      const Hazard hazard = dut.make(size, 0);
      const double unit = dut.unit == "mm" ? 1e-3 : dut.unit == "deg" ? kPi / 180 : 1e-2;
      const auto crossed_up_to = [&](double limit) {
        MeasuredLimits measured;
        measured.frictions = {0.8};
        measured.limits = {{std::string(dut.name), {limit}}};
        for (const char* way_back : {"drop", "step", "ramp", "ramp_down", "cable_cover"})
          if (dut.name != way_back) measured.limits.push_back({way_back, {1e9}});
        if (dut.name == "cable_cover_height") measured.limits.pop_back();
        return Crosses(measured, hazard, 0.8);
      };
      SCOPED_TRACE(std::string(dut.name) + " " + std::to_string(size));
      const double more = dut.name == "rough" ? 1.25 : 1;  // it is turned on
      EXPECT_EQ(crossed_up_to(1.001 * more * size * unit), true);
      if (dut.name == "groove") continue;  // or it is crossed as two steps
      EXPECT_EQ(crossed_up_to(0.999 * more * size * unit), false);
    }
}

// The way is turned against the hazard's edge, the body with it.
TEST(LadderCells, AslantTheyTurnTheWayAndTheBody) {
  for (const char* name : {"htetro", "beluga"})
    for (const Direction direction : {Direction::kForward, Direction::kDiagonal}) {
      const RobotSpec robot = ReadRobot(FindRobotFile(name, {})).spec;
      LadderCell cell{name, "ideal", FindLadderHazard("step").name, direction, 0.2, 0.8, {}, 0};
      const CrossingPlan square = PlanOf(cell, robot, 10);
      cell.oblique_deg = 5;
      const CrossingPlan aslant = PlanOf(cell, robot, 10);
      EXPECT_NEAR(aslant.travel_rad - square.travel_rad, 5 * kPi / 180, 1e-12);
      EXPECT_NEAR(aslant.yaw_rad - square.yaw_rad, 5 * kPi / 180, 1e-12);
      EXPECT_GT(aslant.beyond_m, square.beyond_m);
    }
}

LadderRow Row(const char* robot, const char* wheels, const char* hazard, Direction direction,
              double limit) {
  LadderCell cell{robot, wheels, FindLadderHazard(hazard).name, direction, 0.2, 0.8, {}};
  return {cell, limit, false, ""};
}

using MeasuredElementsTest = TempFolder;

// What is written into a model is read from it as the rows say.
TEST_F(MeasuredElementsTest, StateEachRowByFrictionAndSpeed) {
  std::vector<LadderRow> rows;
  for (const double speed_mps : {0.2, 0.1})
    for (const double friction : {0.4, 0.8}) {
      LadderRow row =
          Row("beluga", "ideal", "wet", Direction::kDiagonal, 100 * friction * speed_mps);
      row.cell.speed_mps = speed_mps;
      row.cell.friction = friction;
      row.above_all = friction == 0.8 && speed_mps == 0.2;
      rows.push_back(row);
    }
  const std::string dut = MeasuredElements(rows, "a test", "abc");
  EXPECT_THAT(dut, HasSubstr("<numeric name=\"measured_frictions\" data=\"0.4 0.8\"/>\n"));
  EXPECT_THAT(dut, HasSubstr("<numeric name=\"measured_speeds_mps\" data=\"0.1 0.2\"/>\n"));
  EXPECT_THAT(dut, HasSubstr("<numeric name=\"measured_wet_diagonal_pct\" data=\"4 8 8 -16\"/>"));

  // With limits of many digits.
  for (LadderRow& row : rows) row.limit /= 3;
  const std::filesystem::path file = Save("own.xml", Slurp(SourceFile("models/beluga.xml")));
  const std::string model = ModelHash(std::vector<std::filesystem::path>{file}, {});
  Save("own.xml", WithMeasured(Slurp(file), MeasuredElements(rows, "a test", model), file));
  const MeasuredLimits read = ReadRobot(file).spec.measured;
  EXPECT_EQ(read.why_unused, "");
  EXPECT_TRUE(read.hashed);
  EXPECT_NEAR(*LimitOn(read, "wet", 0.8), 0.08 / 3, 1e-12) << "of both speeds the lesser";
}

// What the ladder writes is what a model is read by: names, units, no limit too large.
TEST(MeasuredNames, AreTheLaddersHazardsAndDirections) {
  const auto hazards = LadderHazards();
  const auto dut = MeasuredKinds();
  ASSERT_EQ(dut.size(), hazards.size());
  for (std::size_t i = 0; i < dut.size(); ++i) {
    EXPECT_EQ(dut[i].name, hazards[i].name);
    EXPECT_EQ(dut[i].unit.name, hazards[i].unit == "%" ? "pct" : hazards[i].unit);
    for (const double scale : {1.0, 32.0}) {
      const Rungs rungs = ScaledRungs(hazards[i], scale);
      EXPECT_LE(static_cast<double>(rungs.last) / rungs.per_unit, dut[i].unit.most);
    }
  }
  std::vector<std::string_view> directions;
  for (const Direction direction :
       {Direction::kForward, Direction::kSideways, Direction::kDiagonal, Direction::kOblique})
    directions.push_back(Name(direction));
  EXPECT_THAT(MeasuredDirections(), ::testing::ElementsAreArray(directions));
}

TEST(LadderCsv, HasTheColumnsThatOthersReadBy) {
  LadderRow row = Row("htetro", "ideal", "cable_cover", Direction::kSideways, 35.8);
  EXPECT_EQ(LadderCsv({&row, 1}),
            "robot,wheels,hazard,direction,speed_mps,friction,limit,unit\n"
            "htetro,ideal,cable_cover,sideways,0.2,0.8,35.8,deg\n");
  row.cell.changes.clearance_m = 0.022;
  row.cell.changes.mass_kg = 7.7;
  EXPECT_EQ(SweepCsv({&row, 1}),
            "robot,wheels,hazard,direction,speed_mps,friction,limit,unit,clearance_m,mass_kg\n"
            "htetro,ideal,cable_cover,sideways,0.2,0.8,35.8,deg,0.022,7.7\n");
  row.cell.oblique_deg = 0.5;
  row.cell.run_up_m = 0.3;
  EXPECT_EQ(ObliqueCsv({&row, 1}),
            "robot,wheels,hazard,direction,speed_mps,friction,limit,unit,oblique_deg,run_up_m\n"
            "htetro,ideal,cable_cover,sideways,0.2,0.8,35.8,deg,0.5,0.3\n");
  EXPECT_THAT(ObliqueFindings({&row, 1}),
              ElementsAre("htetro cable_cover sideways, deg: 35.8 at 0.5 deg from 0.3 m away"));
}

TEST(Findings, AreReadFromTheRows) {
  const std::vector<LadderRow> rows = {
      Row("htetro", "ideal", "step", Direction::kForward, 24),
      Row("htetro", "ideal", "step", Direction::kSideways, 5.5),
      Row("htetro", "ideal", "drop", Direction::kForward, 26),
      Row("htetro", "ideal", "cable_cover", Direction::kForward, 44),
      Row("htetro", "ideal", "cable_cover", Direction::kSideways, 36),
      Row("htetro", "rollers", "step", Direction::kForward, 23),
      Row("htetro", "rollers", "step", Direction::kSideways, 4),
      Row("beluga", "ideal", "cable_cover", Direction::kForward, 70),
  };
  const auto gaps = CoverGaps(rows);
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(gaps[0].from_deg, 36);
  EXPECT_EQ(gaps[0].to_deg, 44);
  EXPECT_THAT(Sentence(gaps[0]),
              StartsWith("htetro, wheels ideal, 0.2 m/s, friction 0.8: a 20 mm "
                         "cable cover with flanks from 36 to 44 deg is crossed"));
  const auto part = WheelDisagreements(rows, 0.2);
  ASSERT_EQ(part.size(), 1u);
  EXPECT_EQ(part[0].ideal.limit, 5.5);
  EXPECT_EQ(part[0].rollers.limit, 4);
  EXPECT_EQ(TrustedStep(rows, "htetro"), 0.004) << "of both kinds of wheels";
  EXPECT_EQ(TrustedStep(rows, "beluga"), std::nullopt);
  EXPECT_THAT(Findings(rows),
              ElementsAre(Sentence(gaps[0]),
                          "ideal wheels and rollers part by more than 20 %: htetro step sideways "
                          "0.2 m/s, friction 0.8: 5.5 and 4 mm",
                          AllOf(StartsWith("htetro: level changes up to 4.0 mm are crossed"),
                                HasSubstr("80 % of the limit 3.2 mm"))));
}

CrossingResult Meet(const char* robot_name, const char* hazard, Direction direction, double size,
                    bool early = true) {
  const LadderCell cell{robot_name, "ideal", FindLadderHazard(hazard).name, direction, 0.2,
                        0.8,        {}};
  const RobotModel robot = ReadRobot(FindRobotFile(robot_name, {}));
  CrossingPlan plan = PlanOf(cell, robot.spec, size);
  plan.early = early;
  return Cross(robot, FindLadderHazard(hazard).make(size, plan.travel_rad), plan);
}

TEST(Crossing, WhatIsSmallIsCrossedEveryWayWithoutAFailure) {
  for (const Direction direction :
       {Direction::kForward, Direction::kSideways, Direction::kDiagonal})
    EXPECT_EQ(Meet("htetro", "step", direction, 1).held_by, "");
  for (const Direction direction : {Direction::kForward, Direction::kDiagonal})
    EXPECT_EQ(Meet("beluga", "step", direction, 5).held_by, "");
}

// The early decision says what the detectors say later.
TEST(Crossing, AWallOfAStepHoldsAndIsCalledStuck) {
  const CrossingResult early = Meet("beluga", "step", Direction::kForward, 35);
  const CrossingResult late = Meet("beluga", "step", Direction::kForward, 35, false);
  EXPECT_EQ(early.held_by, "no progress");
  EXPECT_THAT(late.held_by, StartsWith("stuck"));
  EXPECT_LT(early.t_s + 4, late.t_s);
  EXPECT_NEAR(early.s_m, late.s_m, 0.01) << "it stands at the edge";
}

TEST(Crossing, ADeepDropIsAFall) {
  EXPECT_EQ(Meet("htetro", "drop", Direction::kForward, 45).held_by, "roll_over/fell");
}

// What the FMEA paper saw, met as the ladder meets it.
TEST(Crossing, ACableCoverCrossedForwardHoldsHtetroSideways) {
  EXPECT_TRUE(Meet("htetro", "cable_cover", Direction::kForward, 37).crossed);
  EXPECT_EQ(Meet("htetro", "cable_cover", Direction::kSideways, 37).held_by, "no progress");
}

TEST(ClimbLadder, GivesTheSameRowsOnAnyNumberOfThreads) {
  std::vector<LadderCell> cells;
  for (const double friction : {0.4, 0.6, 0.8})
    cells.push_back(
        {"beluga", "ideal", FindLadderHazard("step").name, Direction::kForward, 0.3, friction, {}});
  std::vector<std::size_t> done;
  double to_go = -1;
  const auto one = ClimbLadder(cells, 1, [&](const LadderProgress& p) {
    done.push_back(p.done);
    to_go = p.to_go;
  });
  EXPECT_THAT(done, ElementsAre(1u, 2u, 3u));
  EXPECT_EQ(to_go, 0);
  EXPECT_EQ(LadderCsv(one), LadderCsv(ClimbLadder(cells, 3, {})));
  EXPECT_LT(one[0].limit, one[1].limit) << "less friction, lower steps";
  EXPECT_LT(one[1].limit, one[2].limit);
  for (const LadderRow& row : one) EXPECT_NE(row.held_by, "");
}

}  // namespace
}  // namespace floorproof
