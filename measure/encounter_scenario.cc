// SPDX-License-Identifier: Apache-2.0
#include "measure/encounter_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/config.h"
#include "controllers/drive.h"
#include "env/core/passages.h"
#include "env/hazards/hazard_type.h"
#include "env/map/crossing_site.h"
#include "env/scene/robot_stance.h"
#include "measure/hazard_classes.h"
#include "planners/risk/path_rates.h"

namespace floorproof {
namespace {

// A key and the values it takes, as a line of `randomise`.
std::string Line(const std::string& key, const std::string& distribution) {
  return fmt::format("  {}: {{{}}}\n", key, distribution);
}
// To four digits: nobody reads more, and what is laid out follows from what is written.
std::string Range(double low, double high) { return fmt::format("[{:.4g}, {:.4g}]", low, high); }
std::string Uniform(double low, double high) { return "uniform: " + Range(low, high); }

// About what the robot is, with a share of it as deviation.
std::string Normal(double mean, double share) { return "normal: " + Range(mean, share * mean); }

std::string Uniform(const std::vector<std::pair<double, double>>& spans) {
  if (spans.size() == 1) return Uniform(spans[0].first, spans[0].second);
  std::string text;
  for (const auto& [low, high] : spans) text += (text.empty() ? "" : ", ") + Range(low, high);
  return "uniform: [" + text + "]";
}

// Of the edge against the way, from along it to along it; two thirds are square on, as ways along
// walls meet what lies across them. What is most often met is to be known best.
std::string Angles() {
  std::string values;
  for (int deg = -90; deg <= 90; deg += 10) values += fmt::format("{}, 0, 0, ", deg);
  return "choice: [" + values.substr(0, values.size() - 2) + "]";
}

// The side that leads, of robots that drive every way. Plans lead with one of four sides, and a
// robot's wheels hold otherwise askew: two thirds are along its axes.
std::string Leads() {
  std::string values;
  for (int deg = -165; deg < 180; deg += 15)
    if (deg % 90 != 0)
      values += fmt::format("{}, {}, {}, ", deg, deg < 0 ? -90 : 0, deg < 0 ? 180 : 90);
  return "choice: [" + values.substr(0, values.size() - 2) + "]";
}

// Of the first of two corners between lanes. Two in three are as plans have them: two right angles,
// or about turns where they stand. The others make two unlike halves.
std::string Corners() {
  std::string values;
  for (const int deg : {20, 40, 60, 70, 80, 100, 110}) values += fmt::format("90, {}, ", deg);
  return "choice: [" + values + "180, 90, 180, 90, 180, 90, 90]";
}

// From one lane to the next: half as far as lanes of the tool's width are apart.
std::string Asides(const RobotSpec& robot) {
  constexpr int kOthers = 8;
  constexpr double kMost_m = 0.6;  // else the crossing grows
  const double width_m = 2 * robot.circumscribed_radius_m;
  const double least_m = 0.1 * width_m, most_m = std::min(kMost_m, 1.5 * width_m);
  const double lane_m = std::clamp(robot.tool_width_m, least_m, most_m);
  std::string values;
  for (int i = 0; i < kOthers; ++i) {
    const double other_m = least_m + (most_m - least_m) * i / (kOthers - 1);
    values += fmt::format("{}{:.4g}, {:.4g}", i == 0 ? "" : ", ", lane_m, other_m);
  }
  return "choice: [" + values + "]";
}

std::string Meetings() {
  const std::map<std::string, HazardClass> classes = ClassOfType();
  std::string lines;
  const auto add = [&](std::string_view type, const char* passage, const char* estimator) {
    lines += fmt::format(
        "    - {{label: {} {}, site.generate.hazard: {}, site.generate.passage: {}, "
        "estimator.name: {}}}\n",
        type, passage, type, passage, estimator);
  };
  // What is passed at a gap is met only by a robot that is wrong about its place. Over a hazard
  // such a robot would take wheels that spin for way, and end before its failure shows.
  for (const auto& entry : HazardTypes()) {
    const HazardClass is = classes.at(std::string(entry.name));
    // What stands in the way is never driven over.
    if (is != HazardClass::kBlindObject && is != HazardClass::kGlass)
      add(entry.name, "over", "truth");
    add(entry.name, "beside", "odometry");
  }
  return lines;
}

std::string Outline(const RobotSpec& robot) {
  if (robot.clear.kind == Shape2::Kind::kCircle)
    return fmt::format("radius_m: {:.4g}", robot.clear.radius_m);
  std::string points;
  for (const Vec2& p : ConvexHull(robot.clear.footprint_B))
    points += fmt::format("{}[{:.4g}, {:.4g}]", points.empty() ? "" : ", ", p.x(), p.y());
  return "outline_m: [" + points + "]";
}

// How the hazard is met, then by what robot, on what floor. The first coordinates of a Sobol
// sequence are its most even ones.
std::string MetBy(const RobotSpec& robot) {
  // Two thirds each know their place, and their heading, as plans take it that robots do; the
  // others are as one that has driven a while without looking where it is.
  const std::string aside =
      "choice: [0, 0, -0.09, -0.02, 0, 0, 0, 0, 0.02, 0.09, 0, 0, -0.05, 0, 0, 0, 0, 0.05]";
  const std::string astray = "choice: [0, -4, 0, 0, 4, 0, 0, -2, 0, 0, 2, 0, 0, -1, 0, 0, 1, 0]";
  constexpr double kWheels = 3, kShortest_m = 0.3, kLonger_m = 1;
  // Measured across the edge, however it lies, it is still longer than its types ask for.
  const double wheel_m = std::ranges::max(robot.wheels, {}, &WheelSpec::radius_m).radius_m;
  const double length_m = std::max(kShortest_m, kWheels * wheel_m / kCrossingLeastCos);
  std::string lines = Line("site.generate.angle_deg", Angles());
  lines += Line("plan.speed_mps",
                Uniform(kLeastMeasuredSpeed * robot.max_speed_mps, robot.max_speed_mps));
  lines += Line("site.floor.friction", Uniform(0.3, 1));
  if (IsHolonomic(robot)) lines += Line("site.generate.lead_deg", Leads());
  lines += Line("site.generate.share", Uniform(0.2, 1.8));     // all of the width in half of them
  lines += Line("site.generate.gap_m", Uniform(0, kReach_m));  // what is farther is not met
  lines += Line("site.generate.length_m", Uniform(length_m, length_m + kLonger_m));
  lines += Line("site.generate.wall_m", Uniform(0.01, 1.1));  // beyond 1 m it counts as far
  lines += Line("site.generate.side", "choice: [left, right]");
  lines += Line("estimator.start_error_y_m", aside);
  lines += Line("estimator.start_error_yaw_deg", astray);
  if (robot.turn_radius_m == 0) {  // a corner is no arc
    // Most plans cross straight on: so do half of the drives, with those that turn elsewhere.
    lines += Line("plan.lanes", "choice: [one, one, one, aside, back, thrice, thrice]");
    lines += Line("plan.turn_at", Uniform(0.25, 0.95));  // from before the hazard to behind it
    lines += Line("plan.turn_deg", Corners());
    lines += Line("plan.aside_m", Asides(robot));
  }
  lines += Line("robot.clearance_m", Normal(robot.clearance_m, 0.08));
  lines += Line("robot.mass_kg", Normal(robot.mass_kg, 0.1));
  return lines;
}

// What grows is drawn more densely where it is small: plans are led over what a robot hardly ever
// fails at, many times, and how rarely is hard to learn from what stops it. Half of it lies in the
// mildest three tenths.
std::string Grown(const std::vector<std::pair<double, double>>& spans) {
  constexpr int kSizes = 24;
  constexpr double kPower = 1.8;
  std::string values;
  for (const auto& [low, high] : spans)
    for (int i = 0; i < kSizes; ++i) {
      // From the mildest end of the span to the other; of a span below 0 that is its upper end.
      const double share = std::pow(i / (kSizes - 1.0), kPower);
      const double from = low < 0 ? high : low, to = low < 0 ? low : high;
      values += fmt::format("{}{:.4g}", values.empty() ? "" : ", ", from + share * (to - from));
    }
  return "choice: [" + values + "]";
}

std::string Sizes(const RobotSpec& robot) {
  std::string lines;
  for (const auto& entry : HazardTypes())
    for (const KeyRange& range : entry.make()->Ranges(robot))
      lines += Line(fmt::format("site.generate.sizes.{}.{}", entry.name, range.key),
                    range.grows ? Grown(range.spans) : Uniform(range.spans));
  return lines;
}

// Until it drives at its top speed: its wheels reach it some 0.1 s late.
double RunUp(const RobotSpec& robot) {
  constexpr double kLag_s = 0.15, kAtSpeed_m = 0.05;
  const double v = robot.max_speed_mps;
  return v * v / (2 * robot.max_accel_mps2) + kLag_s * v + kAtSpeed_m;
}

}  // namespace

std::vector<std::string> EncounterSensors(const RobotModel& robot) {
  if (StanceOf(robot).lidar_z_m.has_value()) return {"lidar", "cliff"};
  return {"cliff"};
}

std::string EncounterScenario(const std::string& robot, const RobotSpec& spec,
                              const std::vector<std::string>& sensors) {
  constexpr double kRunOut_m = 0.4;     // it has left the hazard, though it ends a little aside
  constexpr double kTimeLimit_s = 180;  // nothing moves so slowly: it is held, and not quite still
  return fmt::format(
      "# Single encounters with hazards, drawn evenly: what `floorproof measure` drives.\n"
      "scenario: 1\n"
      "name: {}\n"
      "robot: {{name: {}}}\n"
      "site:\n"
      "  site: 1\n"
      "  name: crossing\n"
      "  generate: {{kind: crossing, run_up_m: {:.4g}, run_out_m: {:.4g}, {}}}\n"
      "plan: {{planner: straight, cross_obstacles: true}}\n"
      "sensors: {{{}: {{}}}}\n"
      "on_failure: watch\n"
      "time_limit_s: {}\n"
      "sampling: low_discrepancy\n"
      "randomise:\n{}{}"
      "matrix:\n"
      "  meeting:\n{}",
      QuotedYaml("encounters of " + spec.name), QuotedYaml(robot), RunUp(spec), kRunOut_m,
      Outline(spec), fmt::join(sensors, ": {}, "), kTimeLimit_s, MetBy(spec), Sizes(spec),
      Meetings());
}

}  // namespace floorproof
