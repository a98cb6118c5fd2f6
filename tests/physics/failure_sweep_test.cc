// SPDX-License-Identifier: Apache-2.0
// Many drives drawn at random: robots, headings, speeds, sizes and places. What is harmless has no
// event; what fails is found, and named, and placed. A mat of a millimetre lies wherever it might
// be blamed. A case is a line of the messages, which drives it again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "base/streams.h"
#include "run/scenario/scenario.h"
#include "tests/physics/one_caster.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

constexpr int kParts = 8, kHarmless = 60, kCases = 12;  // of each kind, in each part

// A straight way over an open floor of 14 x 14 m, from near its middle in any direction.
struct Way {
  std::string robot;
  Vec2 from_W;
  double heading_rad = 0, yaw_rad = 0, speed_mps = 0.2, length_m = 3.2;

  bool IsHtetro() const { return robot == "htetro"; }
  bool IsBeluga() const { return robot == "beluga"; }
  // `along_m` from the start, and to the left of the way.
  Vec2 At(double along_m, double left_m) const {
    return Pose2{from_W.x(), from_W.y(), heading_rad} * Vec2(along_m, left_m);
  }
  Pose2 PoseAt(double along_m) const {
    const Vec2 p_W = At(along_m, 0);
    return {p_W.x(), p_W.y(), yaw_rad};
  }
};

class FailureSweep : public ScenarioTest, public ::testing::WithParamInterface<int> {
 protected:
  static constexpr double kWide_m = 1.6;

  FailureSweep() { Save("one_caster.xml", kOneCaster); }

  // The numbers of this part's cases.
  static std::vector<std::uint64_t> Seeds(int cases) {
    std::vector<std::uint64_t> seeds(static_cast<std::size_t>(cases));
    std::iota(seeds.begin(), seeds.end(), static_cast<std::uint64_t>(GetParam()) * seeds.size());
    return seeds;
  }

  Way DrawWay(Stream& draw) const {
    Way way;
    const double robot = draw.Uniform(0, 1);
    way.robot = robot < 0.4 ? "beluga" : robot < 0.8 ? "htetro" : "one_caster.xml";
    way.from_W = {draw.Uniform(6.5, 7.5), draw.Uniform(6.5, 7.5)};
    way.heading_rad = draw.Uniform(-kPi, kPi);
    way.yaw_rad = way.heading_rad;
    way.speed_mps = draw.Uniform(0.06, 0.33);
    // A Mecanum robot drives any side first.
    if (way.IsHtetro()) way.yaw_rad += kPi / 2 * std::floor(draw.Uniform(0, 4));
    return way;
  }

  // A quadrangle across the way from `from_m` to `to_m` along it; its near edge stands aslant.
  static std::string Across(const Way& way, double from_m, double to_m, double aslant_rad) {
    const double skew_m = kWide_m * std::tan(aslant_rad);
    std::string corners;
    for (const Vec2& p : {way.At(from_m - skew_m, -kWide_m), way.At(to_m - skew_m, -kWide_m),
                          way.At(to_m + skew_m, kWide_m), way.At(from_m + skew_m, kWide_m)})
      corners += fmt::format("{}[{:.6f}, {:.6f}]", corners.empty() ? "" : ", ", p.x(), p.y());
    return "polygon_m: [" + corners + "]";
  }
  static std::string Line(const Way& way, double at_m, double aslant_rad) {
    const double skew_m = kWide_m * std::tan(aslant_rad);
    const Vec2 a = way.At(at_m - skew_m, -kWide_m), b = way.At(at_m + skew_m, kWide_m);
    return fmt::format("line_m: [[{:.6f}, {:.6f}], [{:.6f}, {:.6f}]]", a.x(), a.y(), b.x(), b.y());
  }

  std::string Scenario(const Way& way, const std::vector<std::string>& hazards) const {
    std::string rows = std::string(14, '#') + "\\n";
    for (int i = 0; i < 12; ++i) rows += "#............#\\n";
    rows += std::string(14, '#') + "\\n";
    std::string list;
    for (const std::string& hazard : hazards) list += (list.empty() ? "{" : ", {") + hazard + "}";
    return fmt::format(
        "scenario: 1\nsite: {{site: 1, grid: {{cell_m: 1, rows: \"{}\"}}, start: {{x_m: {:.6f}, "
        "y_m: {:.6f}, yaw_deg: {:.6f}}}, hazards: [{}]}}\nrobot: {}\nplan: {{file: plan.csv}}\n",
        rows, way.from_W.x(), way.from_W.y(), WrapAngle(way.yaw_rad) * 180 / kPi, list, way.robot);
  }

  EpisodeRecord DriveThrough(const std::vector<Pose2>& waypoints, const Way& way,
                             const std::vector<std::string>& hazards) const {
    std::string plan = "x_m,y_m,yaw_rad,speed_mps\n";
    for (const Pose2& X : waypoints)
      plan += fmt::format("{:.6f},{:.6f},{:.6f},{:.4f}\n", X.x_m, X.y_m, X.yaw_rad, way.speed_mps);
    Save("plan.csv", plan);
    return Drive(Read(Scenario(way, hazards)));
  }

  EpisodeRecord DriveOver(const Way& way, const std::vector<std::string>& hazards) const {
    return DriveThrough({way.PoseAt(0), way.PoseAt(way.length_m)}, way, hazards);
  }

  std::string Told(const Way& way, const std::vector<std::string>& hazards,
                   const EpisodeRecord& record) const {
    std::string told =
        fmt::format("{} at {:.3f} m/s: {}", way.robot, way.speed_mps, Name(record.outcome));
    for (const Event& e : record.events) {
      told += fmt::format("\n  {} {} names '{}' at {:.2f} s: {:.4g} against {:.4g};", Name(e.mode),
                          e.kind, e.hazard, e.t_s, e.value, e.threshold);
      for (const auto& [name, value] : e.evidence) told += fmt::format(" {} {:.4g}", name, value);
    }
    return told + "\n" + Scenario(way, hazards);
  }

  // The most that the body's origin goes back, against the way, within 0.5 s.
  static double Retreat_m(const Way& way, const EpisodeRecord& record) {
    const Vec2 ahead(std::cos(way.heading_rad), std::sin(way.heading_rad));
    double most_m = 0;
    for (std::size_t i = 0; i < record.trace.size(); ++i)
      for (std::size_t k = i; k > 0 && record.trace[k].t_s > record.trace[i].t_s - 0.5; --k)
        most_m = std::max(most_m, ahead.dot(Vec2(record.trace[k].x_m - record.trace[i].x_m,
                                                 record.trace[k].y_m - record.trace[i].y_m)));
    return most_m;
  }

  // The first event is of one of these modes, names `hazard`, and lies within `near_m` of where the
  // way meets it.
  void ExpectFailure(const Way& way, const std::vector<std::string>& hazards,
                     const std::vector<FailureMode>& modes, const std::string& hazard, double at_m,
                     double near_m) const {
    const EpisodeRecord record = DriveOver(way, hazards);
    SCOPED_TRACE(Told(way, hazards, record));
    ASSERT_FALSE(record.events.empty());
    const Event& event = record.events.front();
    EXPECT_NE(std::ranges::find(modes, event.mode), modes.end());
    EXPECT_EQ(event.hazard, hazard);
    EXPECT_LT((Vec2(event.x_m, event.y_m) - way.At(at_m, 0)).norm(), near_m);
  }
};

INSTANTIATE_TEST_SUITE_P(Drawn, FailureSweep, ::testing::Range(0, kParts));

std::string Mat(const std::string& polygon) {
  return "type: step, id: mat, height_m: 0.001, " + polygon;
}

TEST_P(FailureSweep, WhatIsSmallHasNoEvent) {
  for (const std::uint64_t seed : Seeds(kHarmless)) {
    Stream draw(seed, 0, "harmless");
    const Way way = DrawWay(draw);
    // What each robot may be trusted with: hTetro sideways is the least.
    const double size = draw.Uniform(0, 1);
    const double aslant_rad = way.IsHtetro() ? 0 : draw.Uniform(-0.4, 0.4);
    const double most_step_m = way.IsBeluga() ? 0.010 : 0.003;
    std::string hazard;
    switch (seed % 6) {
      case 0:
        hazard = fmt::format("type: step, height_m: {:.4f}, ", 0.0005 + size * most_step_m) +
                 Across(way, 1.2, 2.0, aslant_rad);
        break;
      case 1:
        hazard = fmt::format("type: step, height_m: {:.4f}, ", -0.0005 - size * most_step_m) +
                 Across(way, 1.2, 2.0, aslant_rad);
        break;
      case 2: {
        const double height_m = (way.robot == "one_caster.xml" ? 0.3 : 1) * (0.004 + size * 0.016),
                     flank_rad = draw.Uniform(0.1, 0.25);
        hazard =
            fmt::format("type: cable_cover, height_m: {:.4f}, top_width_m: 0.05, width_m: {:.4f}, ",
                        height_m, 0.05 + 2 * height_m / std::tan(flank_rad));
        hazard += Line(way, 1.5, aslant_rad);
        break;
      }
      case 3:
        hazard = fmt::format("type: groove, depth_m: 0.05, width_m: {:.4f}, ",
                             0.002 + size * (way.IsHtetro() ? 0.06 : 0.012)) +
                 Line(way, 1.5, aslant_rad);
        break;
      case 4:
        hazard = fmt::format("type: rough, wavelength_m: 0.2, amplitude_m: {:.4f}, ",
                             0.0005 + size * 0.001) +
                 Across(way, 1.2, 2.0, 0);
        break;
      default:
        hazard = Mat(Across(way, 1.2, 2.0, aslant_rad));
    }
    const std::vector<std::string> hazards = {"known: false, " + hazard};
    const EpisodeRecord record = DriveOver(way, hazards);
    EXPECT_TRUE(record.outcome == Outcome::kSuccess && record.events.empty())
        << Told(way, hazards, record);
  }
}

// Its wheels and casters swing over edges, or along them, as it turns where it stands.
TEST_P(FailureSweep, TurningOverWhatIsSmallHasNoEvent) {
  for (const std::uint64_t seed : Seeds(kHarmless)) {
    Stream draw(seed, 0, "turning");
    const Way way = DrawWay(draw);
    const double size = draw.Uniform(0, 1), corner_m = 1.2;
    const double edge_m = corner_m + draw.Uniform(-0.3, 0.3);
    const double aslant_rad = way.IsHtetro() ? 0 : draw.Uniform(-0.4, 0.4);
    double most_step_m = 0.002;
    if (way.IsHtetro()) most_step_m = 0.001;
    if (way.IsBeluga()) most_step_m = 0.008;
    std::string hazard;
    // A cover that hTetro meets aslant may hold it: docs/validation.md.
    if (seed % 3 < 2 || way.IsHtetro()) {
      const double height_m = 0.0005 + size * (most_step_m - 0.0005);
      hazard = fmt::format("type: step, height_m: {:.4f}, ", seed % 2 == 0 ? height_m : -height_m) +
               Across(way, edge_m, edge_m + draw.Uniform(0.05, 0.5), aslant_rad);
    } else {
      hazard =
          fmt::format("type: cable_cover, height_m: {:.4f}, top_width_m: 0.05, width_m: 0.15, ",
                      0.001 + size * (way.IsBeluga() ? 0.008 : 0.002)) +
          Line(way, edge_m, aslant_rad);
    }
    const double turn_rad = (draw.Uniform(0, 1) < 0.5 ? 1 : -1) * draw.Uniform(0.3, kPi);
    const Pose2 X_WCorner = way.PoseAt(corner_m);
    Pose2 X_WTurned = X_WCorner;
    X_WTurned.yaw_rad = WrapAngle(way.yaw_rad + turn_rad);
    // It leaves the corner with the same side first.
    const Vec2 end_W =
        Pose2{X_WCorner.x_m, X_WCorner.y_m, way.heading_rad + turn_rad} * Vec2(0.9, 0);
    const std::vector<std::string> hazards = {"known: false, " + hazard};
    const EpisodeRecord record = DriveThrough(
        {way.PoseAt(0), X_WCorner, X_WTurned, {end_W.x(), end_W.y(), X_WTurned.yaw_rad}}, way,
        hazards);
    EXPECT_TRUE(record.outcome == Outcome::kSuccess && record.events.empty())
        << "turns by " << turn_rad << " at " << X_WCorner.x_m << ", " << X_WCorner.y_m << "; "
        << Told(way, hazards, record);
  }
}

TEST_P(FailureSweep, WhatHoldsItIsNamed) {
  for (const std::uint64_t seed : Seeds(kCases)) {
    Stream draw(seed, 0, "held");
    const Way way = DrawWay(draw);
    const double aslant_rad = draw.Uniform(-0.3, 0.3), at_m = draw.Uniform(1.0, 1.6);
    const double height_m = seed % 2 == 0 ? draw.Uniform(0.3, 1) : draw.Uniform(0.045, 0.08);
    const std::string it =
        fmt::format("type: step, id: it, known: false, height_m: {:.4f}, ", height_m) +
        Across(way, at_m, at_m + 0.5, aslant_rad);
    ExpectFailure(way, {Mat(Across(way, draw.Uniform(0.55, 0.9), at_m, 0)), it},
                  {FailureMode::kStuck, FailureMode::kVeerOff}, "it", at_m, 0.8);
  }
}

// Into the room's own wall, along a mat that reaches it.
TEST_P(FailureSweep, AWallIsNamed) {
  for (const std::uint64_t seed : Seeds(kCases)) {
    Stream draw(seed, 0, "wall");
    Way way = DrawWay(draw);
    const double turn_rad = kPi / 2 * std::floor(draw.Uniform(0, 4)) + draw.Uniform(-0.3, 0.3);
    way.yaw_rad += turn_rad - way.heading_rad;
    way.heading_rad = turn_rad;
    const Vec2 ahead(std::cos(turn_rad), std::sin(turn_rad));
    const double wall_m =  // along the way: the walls' faces are at 1 and 13 m
        std::min((ahead.x() > 0 ? 13 - way.from_W.x() : 1 - way.from_W.x()) / ahead.x(),
                 (ahead.y() > 0 ? 13 - way.from_W.y() : 1 - way.from_W.y()) / ahead.y());
    way.from_W = way.At(wall_m - 1.2, 0);
    way.length_m = 2.0;  // into it
    ExpectFailure(way, {Mat(Across(way, draw.Uniform(0.55, 0.9), 1.5, 0))},
                  {FailureMode::kStuck, FailureMode::kVeerOff}, "wall", 1.2, 0.8);
  }
}

TEST_P(FailureSweep, WhatDropsItIsNamed) {
  for (const std::uint64_t seed : Seeds(kCases)) {
    Stream draw(seed, 0, "dropped");
    Way way = DrawWay(draw);
    if (way.IsHtetro()) way.yaw_rad = draw.Uniform(-kPi, kPi);
    const double aslant_rad = draw.Uniform(-0.4, 0.4), at_m = draw.Uniform(1.0, 1.6);
    const std::string it = fmt::format("type: step, id: it, known: false, height_m: -{:.4f}, ",
                                       draw.Uniform(0.05, 0.25)) +
                           Across(way, at_m, at_m + 1.2, aslant_rad);
    ExpectFailure(way, {Mat(Across(way, draw.Uniform(0.55, 0.9), at_m, aslant_rad)), it},
                  {FailureMode::kRollOver, FailureMode::kStuck}, "it", at_m, 0.5);
  }
}

TEST_P(FailureSweep, WhatThrowsItBackIsNamed) {
  int thrown = 0;
  for (const std::uint64_t seed : Seeds(kCases)) {
    Stream draw(seed, 0, "thrown back");
    Way way = DrawWay(draw);
    if (!way.IsHtetro()) way.robot = "beluga";
    way.yaw_rad = way.heading_rad;
    way.speed_mps = draw.Uniform(0.22, 0.4);
    const double at_m = draw.Uniform(1.0, 1.6);
    const double height_m = seed % 2 == 0 ? draw.Uniform(0.3, 1) : draw.Uniform(0.045, 0.08);
    const std::string it =
        fmt::format("type: step, id: it, known: false, restitution: {:.3f}, height_m: {:.4f}, ",
                    draw.Uniform(0.5, 0.9), height_m) +
        Across(way, at_m, at_m + 0.5, draw.Uniform(-0.15, 0.15));
    const std::vector<std::string> hazards = {Mat(Across(way, draw.Uniform(0.55, 0.9), at_m, 0)),
                                              it};
    const EpisodeRecord record = DriveOver(way, hazards);
    SCOPED_TRACE(Told(way, hazards, record));
    ASSERT_FALSE(record.events.empty());
    const Event& event = record.events.front();
    // Met at a corner it is turned and pushes on. The whole of it goes no farther back than out
    // of a soft contact, and down again where its wheels rubbed up the face.
    if (event.mode == FailureMode::kStuck) {
      EXPECT_LT(Retreat_m(way, record), way.IsHtetro() ? 0.009 : 0.005);
    } else {
      EXPECT_EQ(event.mode, FailureMode::kBounceBack);
      ++thrown;
    }
    EXPECT_EQ(event.hazard, "it");
    EXPECT_LT((Vec2(event.x_m, event.y_m) - way.At(at_m, 0)).norm(), 0.8);
  }
  EXPECT_GE(thrown, kCases / 2);
}

}  // namespace
}  // namespace floorproof
