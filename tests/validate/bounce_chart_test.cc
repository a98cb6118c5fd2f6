// SPDX-License-Identifier: Apache-2.0
// A livelier pane throws a robot back faster, and so does a faster approach, but never faster than
// it came. A dead pane never throws it back.
#include "validate/bounce_chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "env/failures/detector.h"
#include "validate/rig.h"

namespace floorproof {
namespace {

TEST(BounceChart, MovesWithRestitutionAndSpeed) {
  const auto rows = BounceChart(1);
  ASSERT_FALSE(rows.empty());
  int dead_reported = 0;
  for (const BounceRow& row : rows) {
    const auto like = [&](double restitution, double speed_mps) {
      for (const BounceRow& other : rows)
        if (other.robot == row.robot && other.mass_kg == row.mass_kg &&
            other.restitution == restitution && other.speed_mps == speed_mps)
          return other.rebound_mps;
      ADD_FAILURE() << "no such row";
      return 0.0;
    };
    SCOPED_TRACE(BounceCsv({&row, 1}));
    EXPECT_NEAR(row.closing_mps, row.speed_mps, 0.02);
    dead_reported += row.restitution == 0 && row.bounce_back;
    // Slower ones are stopped by their own wheels before they have come off the pane.
    if (row.restitution >= 0.5 && row.speed_mps > 0.1) {
      EXPECT_TRUE(row.bounce_back);
    }
    if (row.restitution >= 0.5 && row.speed_mps > 0.1) {  // slower ones pitch at the pane
      EXPECT_GT(row.rebound_mps, like(0.1, row.speed_mps));
    }
    if (row.restitution >= 0.5 && row.speed_mps > 0.3) {
      EXPECT_GT(row.rebound_mps, like(row.restitution, 0.1));
    }
    // Of the origin, on the floor: a tall robot that pitches at the pane swings it back.
    const bool tall = ReadRobot(FindRobotFile(row.robot, {})).spec.height_m > 0.5;
    if (!tall || row.speed_mps > 0.1) {
      EXPECT_LT(row.rebound_mps, row.closing_mps);
    }
  }
  EXPECT_EQ(dead_reported, 0) << "a dead pane throws nothing back";
}

// Whether this face, met at so many degrees off square, throws the robot back.
bool ThrowsBack(const std::string& robot, double height_m, double restitution, double aslant_deg,
                double speed_mps, double friction) {
  const double c = std::cos(aslant_deg * kPi / 180), s = std::sin(aslant_deg * kPi / 180);
  Polygon face;
  for (const Vec2& p : {Vec2(0, -2), Vec2(1, -2), Vec2(1, 2), Vec2(0, 2)})
    face.emplace_back(0.4 + c * p.x() - s * p.y(), s * p.x() + c * p.y());
  RigOptions options;
  options.friction = friction;
  options.hazards = {Prism("face", face, {}, height_m)};
  options.hazards.front().material.restitution = restitution;
  Rig rig(robot, std::move(options));
  const auto dut = MakePlugin(Detectors(), "bounce_back", "detector");
  dut->Start({rig.map(), rig.robot(), rig.sim().model()->opt.timestep});
  Sample sample;
  sample.command.twist = {speed_mps, 0, 0};
  rig.Command(sample.command.twist);
  for (double met_s = 1e9; rig.truth().t_s < std::min(met_s + 1.1, 10.0);) {
    rig.Step();
    static_cast<Truth&>(sample) = rig.truth();
    if (sample.num_contacts > 0) met_s = std::min(met_s, sample.t_s);
    if (dut->Update(sample)) return true;
  }
  return false;
}

// Walls, kerbs that the body meets, kerbs that the wheels meet; square and aslant.
TEST(BounceChart, DeadFacesThrowNothingBackAndLivelyOnesDo) {
  int dead_reported = 0, lively = 0, lively_reported = 0;
  for (const std::string& robot : {std::string("beluga"), std::string("htetro")})
    for (const double height_m : {1.0, 0.06, 0.04})
      for (const double friction : {0.4, 0.8})
        for (const double speed_mps : {0.06, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4}) {
          for (const double aslant_deg : {0.0, 10.0})
            dead_reported += ThrowsBack(robot, height_m, 0, aslant_deg, speed_mps, friction);
          if (speed_mps < 0.2) continue;
          ++lively;
          lively_reported += ThrowsBack(robot, height_m, 0.7, 0, speed_mps, friction);
        }
  EXPECT_EQ(dead_reported, 0);
  EXPECT_EQ(lively_reported, lively);
}

}  // namespace
}  // namespace floorproof
