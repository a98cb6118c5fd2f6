// SPDX-License-Identifier: Apache-2.0
#include "run/plan_check/plan_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/quantity.h"
#include "controllers/estimator.h"
#include "env/core/failure_text.h"
#include "run/plan_check/sharp_corners.h"
#include "run/plan_check/unheld_dwells.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;
using Why = UncoveredPocket::Why;

constexpr std::size_t kListed = 5;
constexpr std::array<std::string_view, 5> kWhyNames = {"not_visited", "narrow", "behind_hazard",
                                                       "closed", "other_level"};

// To a millimetre: more is known of nothing here.
std::string Metres(double length_m) { return LengthText(std::round(1000 * length_m) / 1000); }

std::string At(const Vec2& p_W) { return PlaceText(p_W.x(), p_W.y()); }

std::string Line(const HazardMap& floor, const PlanConflict& c) {
  std::string line = fmt::format("  {}, {} m along: ", At(c.p_W), FixedText(c.along_m, 1));
  if (c.gap_m)
    line +=
        fmt::format("a gap {} wide {}, the robot is {} wide", Metres(*c.gap_m),
                    c.other_side == c.obstacle ? "at " + ObstaclePhrase(floor, c.obstacle)
                                               : "between " + ObstaclePhrase(floor, c.obstacle) +
                                                     " and " + ObstaclePhrase(floor, c.other_side),
                    Metres(c.width_m));
  else
    line +=
        fmt::format("overlaps {} by {}", ObstaclePhrase(floor, c.obstacle), Metres(c.overlap_m));
  constexpr double kWorthSaying_m = 0.05;
  if (c.over_m >= kWorthSaying_m)
    line += fmt::format(", along {} of the path", LengthText(std::round(100 * c.over_m) / 100));
  if (c.times > 1) line += fmt::format(", {} times", c.times);
  return line;
}

constexpr std::string_view kBeyondMeasured = "more than the robot was measured to cross";

bool IsBeyondMeasured(const HazardMap& floor, const std::string& id) {
  const auto hazard = std::ranges::find(floor.hazards, id, &Hazard::id);
  return hazard != floor.hazards.end() && hazard->crossable == false;
}

std::string WhyUncovered(const HazardMap& floor, const RobotSpec& robot,
                         const UncoveredPocket& pocket, const PlanResult& plan) {
  const std::string needs = Metres(LeastPassage(plan.clear));
  switch (pocket.why) {
    case Why::kNotVisited:
      return "the tool could reach it, the plan does not go there";
    case Why::kNarrow: {
      // What is wide enough for the shape at its narrowest need not be so at the headings tried.
      const bool turned = plan.clear.kind == Shape2::Kind::kFootprint;
      const std::string clear = fmt::format("the robot keeps {} clear{}", needs,
                                            turned ? ", at the headings that plans hold" : "");
      return pocket.gap_m ? fmt::format("behind a gap about {} wide at {}; {}",
                                        Metres(*pocket.gap_m), At(pocket.gap_W), clear)
                          : fmt::format("about {} wide; {}", Metres(pocket.width_m), clear);
    }
    case Why::kBehind:
      return "cut off by " + ObstaclePhrase(floor, pocket.hazard) +
             ", which the robot must keep off";
    case Why::kClosed:
      return "walls all around";
    case Why::kKeptOff:
      return IsBeyondMeasured(floor, pocket.hazard)
                 ? fmt::format("{}: {}", ObstaclePhrase(floor, pocket.hazard), kBeyondMeasured)
                 : fmt::format("{}; the robot crosses {} at most",
                               ObstaclePhrase(floor, pocket.hazard), Metres(robot.step_m));
  }
  return "";
}

// What the robot may err by across its plan: as its tracker follows it, and as it is localised.
constexpr double kTracks_m = 0.01;  // and less

std::string ErrorPhrase(const std::string& estimator, double estimate_m) {
  if (estimate_m == 0) return "the tracking error";
  return fmt::format("the errors of tracking ({}) and of `{}` ({})", Metres(kTracks_m), estimator,
                     Metres(estimate_m));
}

// `estimate_m`: see Estimator::error_m.
void AddClearance(const HazardMap& floor, const PlanClearance& c, const std::string& estimator,
                  double estimate_m, std::vector<std::string>& lines) {
  if (c.conflicts.empty()) {
    lines.push_back(
        c.obstacle.empty()
            ? fmt::format("least clearance: more than {}", Metres(PlanClearance::kFarthest_m))
            : fmt::format("least clearance: {} to {}, at {}, {} m along",
                          Metres(std::max(0.0, c.least_m)), ObstaclePhrase(floor, c.obstacle),
                          At(c.p_W), FixedText(c.along_m, 1)));
    if (const double errs_m = kTracks_m + estimate_m; c.least_m < errs_m)
      lines.push_back(fmt::format("warning: the least clearance is below {}, which is within {}",
                                  Metres(errs_m), ErrorPhrase(estimator, estimate_m)));
    return;
  }
  lines.push_back(ConflictsLine(c) + ":");
  for (std::size_t i = 0; i < std::min(kListed, c.conflicts.size()); ++i)
    lines.push_back(Line(floor, c.conflicts[i]));
  if (c.conflicts.size() > kListed)
    lines.push_back(fmt::format("  and {} more", c.conflicts.size() - kListed));
}

void AddDrivenOver(const HazardMap& true_floor, const RobotSpec& robot,
                   const std::vector<DrivenOver>& driven, std::vector<std::string>& lines) {
  for (std::size_t i = 0; i < std::min(kListed, driven.size()); ++i) {
    const Hazard& hazard = true_floor.hazards[driven[i].hazard];
    const bool keeps_off = IsObstacle(hazard, robot.step_m);
    lines.push_back(fmt::format("{} {}{} {}", keeps_off ? "leads into" : "drives over",
                                HazardPhrase(hazard),
                                hazard.known ? "" : ", which the planner is not told of,",
                                CountText(driven[i].times, "time")));
  }
  if (driven.size() > kListed)
    lines.push_back(fmt::format("  and over {} more", driven.size() - kListed));
}

// "crosses 'sill' (step, 4 mm) at x 4.00, y 3.00 m, 2.0 m along: higher than the robot is trusted
// to cross (1 mm)"
std::string Line(const HazardMap& floor, const RobotSpec& robot, const PlanCrossing& c) {
  std::string line = fmt::format("crosses {} at {}, {} m along", ObstaclePhrase(floor, c.hazard),
                                 At(c.p_W), FixedText(c.along_m, 1));
  if (c.times > 1) line += fmt::format(", {} times", c.times);
  if (IsBeyondMeasured(floor, c.hazard)) return fmt::format("{}: {}", line, kBeyondMeasured);
  return line + fmt::format(": {} than the robot is trusted to cross ({})",
                            c.height_m < 0 ? "deeper" : "higher", Metres(robot.step_m));
}

void AddCrossings(const HazardMap& floor, const RobotSpec& robot, const PlanClearance& clearance,
                  std::vector<std::string>& lines) {
  const std::vector<PlanCrossing>& crossings = clearance.crossings;
  for (std::size_t i = 0; i < std::min(kListed, crossings.size()); ++i)
    lines.push_back("warning: the plan " + Line(floor, robot, crossings[i]));
  if (crossings.size() > kListed)
    lines.push_back(fmt::format("  and {} more", crossings.size() - kListed));
}

// What the tool could reach and the plan leaves out.
bool IsGap(const UncoveredPocket& pocket) {
  return pocket.why == UncoveredPocket::Why::kNotVisited;
}

void AddUncovered(const HazardMap& floor, const RobotSpec& robot, const PlanResult& plan,
                  const UncoveredFloor& u, std::vector<std::string>& lines) {
  const double left_m2 = u.floor_m2 - u.covered_m2;
  lines.push_back(
      fmt::format("uncovered: {} of {} m2 of free floor ({}), {} m2 of it along walls, "
                  "in corners and between rows",
                  NumberText(left_m2), NumberText(u.floor_m2),
                  PercentText(u.floor_m2 > 0 ? left_m2 / u.floor_m2 : 0), NumberText(u.edges_m2)));
  double more_m2 = 0;
  for (std::size_t i = 0; i < u.pockets.size(); ++i) {
    const UncoveredPocket& pocket = u.pockets[i];
    if (i >= kListed)
      more_m2 += pocket.area_m2;
    else
      lines.push_back(fmt::format("  {} m2 around {}: {}", NumberText(pocket.area_m2),
                                  At(pocket.p_W), WhyUncovered(floor, robot, pocket, plan)));
  }
  if (u.pockets.size() <= kListed) return;
  lines.push_back(
      fmt::format("  and {} more, {} m2", u.pockets.size() - kListed, NumberText(more_m2)));
  const std::span<const UncoveredPocket> rest = std::span(u.pockets).subspan(kListed);
  const auto gap = std::ranges::find_if(rest, IsGap);
  if (gap == rest.end()) return;
  const auto gaps = std::ranges::count_if(rest, IsGap);
  lines.back() +=
      fmt::format(", {} of them within reach of the tool{}: {} m2 around {}",
                  gaps == 1 ? "one" : std::to_string(gaps), gaps == 1 ? "" : ", the largest",
                  NumberText(gap->area_m2), At(gap->p_W));
}

// Of an audit: how long its tour is against the shortest there can be, and which places it lacks.
void AddSamples(const PlanResult& plan, std::vector<std::string>& lines) {
  const auto figure = [&](std::string_view name) {
    const auto found = std::ranges::find(plan.figures, name, [](const auto& f) { return f.first; });
    return found == plan.figures.end() ? std::optional<double>() : found->second;
  };
  constexpr double kProven = 1e-6;  // of the length: the bound's own rounding is less
  if (const auto bound_m = figure("tour_bound_m")) {
    const double gap = figure("tour_gap").value_or(0);
    lines.push_back(gap < kProven
                        ? "no order of these places is shorter"
                        : fmt::format("no order of these places is shorter than {} m: the "
                                      "tour is at most {} longer",
                                      FixedText(*bound_m, 1), PercentText(gap)));
  }
  std::vector<Vec2> missed;
  for (const SamplePlace& sample : plan.samples)
    if (!sample.reachable) missed.push_back(sample.p_W);
  if (missed.empty()) return;
  std::string line = CountText(missed.size(), "sample") + " out of the robot's reach: ";
  for (std::size_t i = 0; i < std::min(kListed, missed.size()); ++i)
    line += (i > 0 ? "; " : "") + At(missed[i]);
  if (missed.size() > kListed)
    line += fmt::format("; and {} more (plan.json lists them)", missed.size() - kListed);
  lines.push_back(line);
}

Json PlaceJson(const Vec2& p_W) { return {{"x_m", p_W.x()}, {"y_m", p_W.y()}}; }

}  // namespace

std::string PlannedText(const PlanResult& plan) {
  return fmt::format("planned: {}, {} m, {}", CountText(plan.path.size(), "waypoint"),
                     FixedText(Length(plan.path), 1), CountText(CountTurns(plan.path), "turn"));
}

std::string SweptText(const PlanResult& plan, const Json& json) {
  return fmt::format("{}, covers {:.1f} % of {} m2 in reach", PlannedText(plan),
                     100 * json["coverage"].get<double>(),
                     NumberText(json["sweepable_m2"].get<double>()));
}

PlanCheck CheckPlan(const Scenario& s, const PlanResult& plan) {
  const SweepArea area = ComputeSweepArea(KnownFloor(s.world), s.world.robot.spec, plan.clear,
                                          plan.tool, s.world.start);
  return {CheckClearance(s.world, plan), FindDrivenOver(s.world, plan),
          FindUncovered(s.world, plan, area), EstimateBudget(s, plan),
          CountSharpCorners(plan.path, s.world.robot.spec)};
}

std::string ConflictsLine(const PlanClearance& clearance) {
  if (clearance.conflicts.empty()) return "";
  return "warning: the plan leads the robot into obstacles at " +
         CountText(clearance.conflicts.size(), "place");
}

std::string SharpCornersLine(const RobotSpec& robot, int sharp_corners) {
  if (sharp_corners == 0) return "";
  return fmt::format(
      "warning: the plan has {} too sharp for the robot, which turns on arcs of {} radius at "
      "least: it passes beside them",
      CountText(sharp_corners, "corner"), Metres(robot.turn_radius_m));
}

std::string UnheldDwellLine(const World& world, const PlanResult& plan) {
  const auto dwell = FindUnheldDwell(world, plan);
  if (!dwell) return "";
  const std::string where = fmt::format(
      "warning: the plan dwells at {} on a slope of {:.1f} deg, where the robot rolls away: ",
      At(dwell->p_W), dwell->slope_rad * 180 / kPi);
  if (world.robot.spec.standstill == Standstill::kFree)
    return where + "its wheels turn freely (`standstill` in its model)";
  return where + fmt::format("its motors hold {} N, but its weight pulls {} N down the slope",
                             NumberText(dwell->holds_n), NumberText(dwell->pulls_n));
}

std::vector<std::string> CrossingLines(const World& world, const PlanClearance& clearance) {
  std::vector<std::string> lines;
  AddCrossings(KnownFloor(world), world.robot.spec, clearance, lines);
  return lines;
}

std::vector<std::string> PlanLines(const Scenario& s, const PlanResult& plan,
                                   const PlanCheck& check) {
  std::vector<std::string> lines;
  std::string takes = fmt::format("expected: {}, {}", TimeText(check.budget.time_s),
                                  EnergyText(check.budget.energy_j));
  if (check.budget.battery_share) {
    takes += fmt::format(", {} of the battery", PercentText(*check.budget.battery_share));
    if (*check.budget.battery_share > 1) lines.push_back("warning: the battery does not last");
  }
  lines.insert(lines.begin(), takes);
  if (constexpr double kWorthSaying_m = 0.5; plan.lead_in_m > kWorthSaying_m)
    lines.push_back(fmt::format(
        "the plan begins {} from the start at {}: the robot is led there straight, by a first leg "
        "that is not in it (start.x_m, start.y_m)",
        LengthText(plan.lead_in_m), At(s.world.start.p())));
  const HazardMap floor = KnownFloor(s.world);
  const auto estimator = MakePlugin(Estimators(), s.spec.estimator, "estimator");
  AddClearance(floor, check.clearance, s.spec.estimator.name,
               estimator->error_m(floor, Length(plan.path)), lines);
  if (const auto sharp = SharpCornersLine(s.world.robot.spec, check.sharp_corners); !sharp.empty())
    lines.push_back(sharp);
  if (auto unheld = UnheldDwellLine(s.world, plan); !unheld.empty())
    lines.push_back(std::move(unheld));
  AddCrossings(floor, s.world.robot.spec, check.clearance, lines);
  AddDrivenOver(TrueFloor(s.world), s.world.robot.spec, check.driven_over, lines);
  if (plan.samples.empty())
    AddUncovered(floor, s.world.robot.spec, plan, check.uncovered, lines);
  else
    AddSamples(plan, lines);
  return lines;
}

namespace {

// A plan of the user's own is taken for one that covers, unless `success` says otherwise.
bool IsToCover(const Scenario& s) {
  if (s.spec.episode.min_coverage > 0) return true;
  if (s.spec.plan_by == PlanBy::kPlanner)
    return s.spec.promises.covers != PlannerPromises::Covers::kNothing;
  return !s.spec.written.contains("success");
}

// Every plan leaves a corner here and there.
bool LeavesTooMuch(const UncoveredFloor& u) {
  constexpr double kMostAtOnce_m2 = 1, kMostOfFloor = 0.01;
  double all_m2 = 0, largest_m2 = 0;
  for (const UncoveredPocket& pocket : u.pockets)
    if (IsGap(pocket)) all_m2 += pocket.area_m2, largest_m2 = std::max(largest_m2, pocket.area_m2);
  return largest_m2 > kMostAtOnce_m2 || all_m2 > kMostOfFloor * u.floor_m2;
}

}  // namespace

std::vector<std::string> PlanFaults(const Scenario& s, const PlanResult& plan,
                                    const PlanCheck& check, std::span<const std::string> lines) {
  const auto is_missed = [](const SamplePlace& place) { return !place.reachable; };
  const std::string overlaps = ConflictsLine(check.clearance);
  const auto warns = [&](const std::string& line) {
    return line.starts_with("warning: ") && (overlaps.empty() || !line.starts_with(overlaps));
  };
  std::vector<std::string> faults;
  if (!overlaps.empty()) faults.emplace_back(kPlanFaults[0]);
  if (plan.samples.empty() ? IsToCover(s) && LeavesTooMuch(check.uncovered)
                           : std::ranges::any_of(plan.samples, is_missed))
    faults.emplace_back(kPlanFaults[1]);
  if (std::ranges::any_of(lines, warns)) faults.emplace_back(kPlanFaults[2]);
  return faults;
}

Json PlanCheckJson(const World& world, const PlanCheck& check) {
  const PlanClearance& c = check.clearance;
  Json conflicts = Json::array();
  for (const PlanConflict& conflict : c.conflicts) {
    Json json = PlaceJson(conflict.p_W);
    json.update({{"along_m", conflict.along_m},
                 {"obstacle", conflict.obstacle},
                 {"overlap_m", conflict.overlap_m},
                 {"over_m", conflict.over_m},
                 {"times", conflict.times},
                 {"robot_width_m", conflict.width_m},
                 {"gap_m", conflict.gap_m ? Json(*conflict.gap_m) : Json(nullptr)},
                 {"gap_other_side", conflict.gap_m ? Json(conflict.other_side) : Json(nullptr)}});
    conflicts.push_back(std::move(json));
  }
  Json crossings = Json::array();
  for (const PlanCrossing& crossing : c.crossings) {
    Json json = PlaceJson(crossing.p_W);
    json.update({{"along_m", crossing.along_m},
                 {"hazard", crossing.hazard},
                 {"height_m", crossing.height_m},
                 {"times", crossing.times}});
    crossings.push_back(std::move(json));
  }
  const HazardMap true_floor = TrueFloor(world);
  Json over = Json::array();
  for (const DrivenOver& driven : check.driven_over) {
    const Hazard& hazard = true_floor.hazards[driven.hazard];
    over.push_back({{"hazard", hazard.id},
                    {"known", hazard.known},
                    {"times", driven.times},
                    {"over_m", driven.over_m}});
  }
  Json pockets = Json::array();
  for (const UncoveredPocket& pocket : check.uncovered.pockets) {
    Json json = PlaceJson(pocket.p_W);
    json.update({{"area_m2", pocket.area_m2},
                 {"width_m", pocket.width_m},
                 {"why", kWhyNames[static_cast<std::size_t>(pocket.why)]},
                 {"hazard", pocket.hazard},
                 {"gap", nullptr}});
    if (pocket.gap_m) {
      json["gap"] = PlaceJson(pocket.gap_W);
      json["gap"]["width_m"] = *pocket.gap_m;
    }
    pockets.push_back(std::move(json));
  }
  Json least = PlaceJson(c.p_W);
  least.update({{"along_m", c.along_m}, {"obstacle", c.obstacle}, {"clearance_m", c.least_m}});
  Json json = {{"least_clearance", c.obstacle.empty() ? Json(nullptr) : std::move(least)},
               {"conflicts", std::move(conflicts)},
               {"crossings", std::move(crossings)},
               {"driven_over", std::move(over)},
               {"free_floor_m2", check.uncovered.floor_m2},
               {"covered_m2", check.uncovered.covered_m2},
               {"uncovered_edges_m2", check.uncovered.edges_m2},
               {"uncovered_pockets", std::move(pockets)},
               {"expected_s", check.budget.time_s},
               {"expected_energy_j", check.budget.energy_j},
               {"expected_battery_share",
                check.budget.battery_share ? Json(*check.budget.battery_share) : Json(nullptr)}};
  if (world.robot.spec.turn_radius_m > 0) json["sharp_corners"] = check.sharp_corners;
  return json;
}

}  // namespace floorproof
