// SPDX-License-Identifier: Apache-2.0
// Who gets on is never called stuck, and who is held always is: drawn drives of both robots. Plans
// are random polylines, at speeds from 0.02 m/s to the robot's most, on bare floor and over small
// edges; what holds is a wall, a step, a narrow place, a ledge below the belly, a dead motor, an
// empty battery. A case is reproduced from its number alone.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/streams.h"
#include "run/scenario/override.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

struct Case {
  std::string robot = {}, hazards = {}, plan = {}, more = {};
  bool low_belly = false;
  double speed_mps = 0;
  Vec2 goal = Vec2::Zero();
};

// A rectangle about `centre`, turned.
std::string Box(const Vec2& centre, double length_m, double width_m, double turn_rad) {
  std::string points;
  const Pose2 X_WB{centre.x(), centre.y(), turn_rad};
  for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
    const Vec2 p = X_WB * Vec2(corner.x() * length_m / 2, corner.y() * width_m / 2);
    points += fmt::format("{}[{:.4f}, {:.4f}]", points.empty() ? "" : ", ", p.x(), p.y());
  }
  return "[" + points + "]";
}

std::string Step(const std::string& id, double height_m, const std::string& polygon, bool known) {
  return fmt::format("{{type: step, id: {}, height_m: {:.5f}, known: {}, polygon_m: {}}}", id,
                     height_m, known, polygon);
}

std::string StartAt(const Vec2& p, double yaw_deg) {
  return fmt::format("start: {{x_m: {:.4f}, y_m: {:.4f}, yaw_deg: {:.1f}}}\n", p.x(), p.y(),
                     yaw_deg);
}

double LogUniform(Stream& draw, double low, double high) {
  return low * std::pow(high / low, draw.Uniform());
}

class GettingOn : public ScenarioTest, public ::testing::WithParamInterface<int> {
 protected:
  EpisodeRecord Drive(const Case& c) const {
    Save("plan.csv", c.plan);
    std::vector<Override> overrides = {{"robot", c.robot}};
    if (c.low_belly) overrides.push_back({"robot.clearance_m", "0.005"});
    return ScenarioTest::Drive(Read(RoomScenario(c.hazards, c.more), overrides));
  }
  static const Event* FindStuck(const EpisodeRecord& record) {
    for (const Event& event : record.events)
      if (event.mode == FailureMode::kStuck) return &event;
    return nullptr;
  }
  static double StuckMargin(const EpisodeRecord& record) {
    for (const auto& margin : record.margins)
      if (margin.detector == "stuck") return margin.value;
    return 0;
  }
  static std::string Told(const EpisodeRecord& record) {
    std::string text = fmt::format("{} after {:.1f} s, margin {:.4f}, {}", Name(record.outcome),
                                   record.metrics.duration_s, StuckMargin(record), record.message);
    for (const Event& e : record.events)
      text +=
          fmt::format("; {} {} at {:.1f} s, x {:.3f} y {:.3f} m, '{}', {:.4f} against {:.4f}",
                      Name(e.mode), e.kind, e.t_s, e.x_m, e.y_m, e.hazard, e.value, e.threshold);
    return text;
  }
};

std::string Row(const Vec2& p, std::optional<double> yaw_rad, double speed_mps) {
  return fmt::format("{:.4f},{:.4f},{},{:.4f}\n", p.x(), p.y(),
                     yaw_rad ? fmt::format("{:.4f}", *yaw_rad) : "", speed_mps);
}

// A polyline in the middle of the room, some of its legs as short as 1 cm, with edges that BELUGA
// crosses at any heading and speed.
Case Harmless(const std::string& robot, std::uint64_t k) {
  Stream draw(11, k, "harmless " + robot);
  Case c{.robot = robot};
  c.speed_mps = LogUniform(draw, 0.02, 0.4);
  Vec2 p(draw.Uniform(1.6, 7.4), draw.Uniform(1.6, 3.4));
  const Vec2 start = p;
  const bool beluga = robot == "beluga", yaw_stated = !beluga && draw.Uniform() < 0.5;
  const double held_rad = draw.Uniform(-kPi, kPi);
  double heading_rad = draw.Uniform(-kPi, kPi);
  c.more = StartAt(start, yaw_stated ? held_rad * 180 / kPi : draw.Uniform(-180, 180));
  const auto yaw = [&]() -> std::optional<double> {
    if (!yaw_stated) return std::nullopt;
    return held_rad;
  };
  c.plan = "x_m,y_m,yaw_rad,speed_mps\n" + Row(p, yaw(), c.speed_mps);
  double left_m = std::clamp(12 * c.speed_mps, 1.0, 3.0);
  for (int legs = 0; left_m > 0 && legs < 9;) {
    const double leg_m = legs == 0 ? 0.9 : LogUniform(draw, 0.01, 0.8);
    const Vec2 next = p + leg_m * Vec2(std::cos(heading_rad), std::sin(heading_rad));
    heading_rad = draw.Uniform(-kPi, kPi);
    if (next.x() < 1.2 || next.x() > 7.8 || next.y() < 1.2 || next.y() > 3.8) continue;
    if (legs == 0 && beluga && draw.Uniform() < 0.8)
      c.hazards = Step("edge", draw.Uniform(0.001, 0.003),
                       Box(start + 0.62 * (next - start) / leg_m, 0.3, draw.Uniform(0.1, 0.4),
                           draw.Uniform(-kPi, kPi)),
                       draw.Uniform() < 0.5);
    p = next;
    c.plan += Row(p, yaw(), c.speed_mps);
    left_m -= leg_m;
    ++legs;
  }
  c.goal = p;
  return c;
}

constexpr int kParts = 8, kHarmless = 28, kHeld = 7, kEdges = 4;  // of each robot, in each part
INSTANTIATE_TEST_SUITE_P(Drawn, GettingOn, ::testing::Range(0, kParts));

TEST_P(GettingOn, HarmlessDrivesFailNowhere) {
  for (const std::string robot : {"beluga", "htetro"})
    for (int i = 0; i < kHarmless; ++i) {
      const int k = GetParam() * kHarmless + i;
      const EpisodeRecord dut = Drive(Harmless(robot, static_cast<std::uint64_t>(k)));
      SCOPED_TRACE(fmt::format("{} {}: {}", robot, k, Told(dut)));
      EXPECT_EQ(dut.outcome, Outcome::kSuccess);
      EXPECT_TRUE(dut.events.empty());
      EXPECT_GT(StuckMargin(dut), 0);
      EXPECT_LT(dut.metrics.max_cross_track_m, 0.15);
    }
}

// What holds a robot that drives along x from (2.5, 2.5), and which id it has.
struct Holder {
  std::string hazards, more, id;
  double y_end_m = 2.5;
  bool low_belly = false;
  std::optional<Vec2> normal = std::nullopt;  // of a face that it may slide along
};
Holder DrawHolder(const std::string& robot, Stream& draw) {
  const double turn_rad = draw.Uniform(-0.9, 0.9);
  const Vec2 ahead(4, 2.5);
  switch (static_cast<int>(7 * draw.Uniform())) {
    case 0: {  // the map's wall, straight on or askew
      const double y_m = draw.Uniform() < 0.5 ? 4.9 : 0.1;
      return {"", "", "wall", y_m, false, Vec2(0, 1)};
    }
    case 1:  // too high, whichever way it lies; BELUGA sways at the lower ones
      return {Step("sill", draw.Uniform(robot == "beluga" ? 0.0235 : 0.03, 0.06),
                   Box(ahead, 0.3, 3.5, turn_rad), false),
              "",
              "sill",
              2.5,
              false,
              Vec2(std::cos(turn_rad), std::sin(turn_rad))};
    case 2: {  // a gap that is too narrow
      const double gap_m = robot == "beluga" ? 0.24 : 0.36;
      return {fmt::format(
                  "{{type: blind_object, id: post, height_m: 0.5, known: false, polygon_m: {}}}, "
                  "{{type: blind_object, id: post2, height_m: 0.5, known: false, polygon_m: {}}}",
                  Box({4, 2.5 + gap_m / 2 + 0.1}, 0.2, 0.2, 0),
                  Box({4, 2.5 - gap_m / 2 - 0.1}, 0.2, 0.2, 0)),
              "", "post"};
    }
    case 3:  // in a basin
      return {Step("rim1", 0.04, Box({4, 2.5}, 0.2, 2, 0), false) + ", " +
                  Step("rim2", 0.04, Box({1.5, 2.5}, 0.2, 2, 0), false),
              "", "rim1"};
    case 4:  // a ledge below a low belly
      return {Step("ledge", draw.Uniform(0.016, 0.022), Box(ahead, 0.06, 3.5, 0), false), "",
              "ledge", 2.5, true};
    case 5:  // nothing to drive with
      return {"", "battery: {capacity_wh: 0.02}\n", ""};
    default:  // its motors turn no more, from 4 s on
      return {"", "faults: [{type: weak_motor, torque_share: 0, onset_s: 4}]\n", ""};
  }
}

TEST_P(GettingOn, WhoIsHeldIsFoundBlamedAndPlaced) {
  for (const std::string robot : {"beluga", "htetro"})
    for (int i = 0; i < kHeld; ++i) {
      const int k = GetParam() * kHeld + i;
      Stream draw(12, static_cast<std::uint64_t>(k), "held " + robot);
      const Holder holder = DrawHolder(robot, draw);
      Case c{.robot = robot, .hazards = holder.hazards, .low_belly = holder.low_belly};
      c.speed_mps = LogUniform(draw, 0.05, 0.3);
      const double yaw_deg = draw.Uniform() < 0.5 ? 0 : draw.Uniform(-20, 20);
      c.plan = "x_m,y_m,yaw_rad,speed_mps\n" + Row({2.5, 2.5}, std::nullopt, c.speed_mps) +
               Row({holder.y_end_m == 2.5 ? 6.5 : 5.0, holder.y_end_m}, std::nullopt, c.speed_mps);
      // Time to come to it, and to be judged.
      c.more = StartAt({2.5, 2.5}, yaw_deg) + holder.more +
               fmt::format("on_failure: ignore\ntime_limit_s: {:.0f}\n", 3 / c.speed_mps + 35);
      const EpisodeRecord dut = Drive(c);
      SCOPED_TRACE(fmt::format("{} {} {}: {}", robot, k, c.hazards + c.more, Told(dut)));
      const Event* stuck = FindStuck(dut);
      ASSERT_NE(stuck, nullptr);
      EXPECT_THAT(stuck->hazard, ::testing::StartsWith(holder.id));
      EXPECT_EQ(stuck->hazard.empty(), holder.id.empty());
      const TraceRow& end = dut.trace.back();
      // Wheels that roll sideways may draw it along a face, no farther over it.
      const Vec2 since = Vec2(end.x_m, end.y_m) - Vec2(stuck->x_m, stuck->y_m);
      EXPECT_LT(holder.normal ? std::abs(since.dot(*holder.normal)) : since.norm(), 0.3);
      // It was held from when it first came near where it stayed.
      const auto held = std::ranges::find_if(dut.trace, [&](const TraceRow& row) {
        return std::hypot(row.x_m - stuck->x_m, row.y_m - stuck->y_m) < 0.1;
      });
      EXPECT_LT(stuck->t_s - held->t_s, 15);
    }
}

// hTetro over edges of 1 to 3 mm, square on to nearly along: who gets there in good time, along its
// way, was not stuck, and who never gets there was, at the edge.
TEST_P(GettingOn, TheVerdictAtAnEdgeIsWhatBecomesOfTheDrive) {
  for (int i = 0; i < kEdges; ++i) {
    const int k = GetParam() * kEdges + i;
    Stream draw(13, static_cast<std::uint64_t>(k), "edge");
    Case c{.robot = "htetro"};
    c.speed_mps = LogUniform(draw, 0.02, 0.2);
    const double askew_rad = draw.Uniform(0, 80) * kPi / 180;
    c.hazards = Step("edge", draw.Uniform(0.001, 0.003), Box({4, 2.5}, 0.2, 3, askew_rad), true);
    c.goal = {4, 2.5};
    // Its foremost corner is met within 0.2 m of the start.
    const Vec2 start(4 - 0.1 / std::cos(askew_rad) - 0.25 * (1 + std::tan(askew_rad)) - 0.1, 2.5);
    // A stuck robot covers less than a quarter of the commanded way for 10 s: it loses 7.5 s.
    const double way_s = (c.goal - start).norm() / c.speed_mps, fair_s = way_s + 7;
    c.plan =
        "x_m,y_m,yaw_rad,speed_mps\n" + Row(start, 0, c.speed_mps) + Row(c.goal, 0, c.speed_mps);
    c.more = StartAt(start, 0) +
             fmt::format("on_failure: ignore\ntime_limit_s: {:.0f}\n", 1.5 * way_s + 50);
    const EpisodeRecord dut = Drive(c);
    SCOPED_TRACE(fmt::format("{}: {:.0f} deg, {}", k, askew_rad * 180 / kPi, Told(dut)));
    const TraceRow& end = dut.trace.back();
    const bool arrived = (Vec2(end.x_m, end.y_m) - c.goal).norm() < 0.03;
    const Event* stuck = FindStuck(dut);
    const bool strayed = std::ranges::any_of(
        dut.events, [](const Event& event) { return event.mode == FailureMode::kVeerOff; });
    if (arrived && !strayed && dut.metrics.duration_s < fair_s) {
      EXPECT_EQ(stuck, nullptr);
    } else if (!arrived) {
      ASSERT_NE(stuck, nullptr);
      EXPECT_EQ(stuck->hazard, "edge");
    }
  }
}

}  // namespace
}  // namespace floorproof
