// SPDX-License-Identifier: Apache-2.0
#include "report/robot_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "base/quantity.h"

namespace floorproof {
namespace {

constexpr double kDegree = kPi / 180;

// The least tip angle of the edges in each eighth of a turn, by its name.
std::string TipText(const RobotCheck& check) {
  static constexpr const char* kNames[] = {"ahead",  "ahead left",   "left",  "behind left",
                                           "behind", "behind right", "right", "ahead right"};
  std::map<int, double> least;
  for (const SupportEdge& edge : check.stance.edges) {
    const int eighth = (static_cast<int>(std::lround(edge.bearing_rad / (kPi / 4))) + 8) % 8;
    const auto [at, fresh] = least.try_emplace(eighth, edge.tip_rad);
    if (!fresh) at->second = std::min(at->second, edge.tip_rad);
  }
  std::string text;
  for (const auto& [eighth, tip_rad] : least)
    text += fmt::format("{}{} {:.1f}", text.empty() ? "" : ", ", kNames[eighth], tip_rad / kDegree);
  return text + " deg";
}

std::string WheelsText(const RobotSpec& spec) {
  const auto [least, most] =
      std::ranges::minmax(spec.wheels, {}, [](const WheelSpec& wheel) { return wheel.radius_m; });
  const std::string radius = least.radius_m == most.radius_m
                                 ? LengthText(least.radius_m)
                                 : LengthText(least.radius_m) + " to " + LengthText(most.radius_m);
  return fmt::format("{} driven, radius {}", spec.wheels.size(), radius);
}

std::string CastersText(const RobotCheck& check) {
  int number = 0;
  for (const Carrier& carrier : check.stance.carriers) number += !carrier.driven;
  return number == 0 ? "none" : std::to_string(number);
}

// By what planners go: of what robots meet most, measured on the floor of most friction; where
// nothing was measured of steps, the model's own word.
std::string CrossesText(const RobotSpec& spec) {
  const MeasuredLimits& measured = spec.measured;
  const auto by_word = [&] {
    return fmt::format("steps of {}, as its model says", LengthText(spec.step_m));
  };
  if (measured.limits.empty()) return by_word();
  const double friction = measured.frictions.back();
  std::string text;
  for (const char* kind : {"step", "drop", "threshold"})
    if (const auto limit = LimitOn(measured, kind, friction))
      text += fmt::format("{} {}, ", kind, LengthText(std::round(1e4 * *limit) / 1e4));
  const bool steps = LimitOn(measured, "step", friction) || LimitOn(measured, "drop", friction);
  return fmt::format("{}as measured on friction {}{}", text, friction,
                     steps ? "" : "; " + by_word());
}

// How it turns, of a robot that steers; else how far apart its wheels stand.
std::pair<std::string, std::string> TurnFigure(const RobotCheck& check) {
  const RobotSpec& spec = check.spec;
  if (!spec.steering) return {"track", LengthText(check.track_m)};
  const SteeringSpec& fork = *spec.steering;
  return {"steering", fmt::format("{:.0f} to {:.0f} deg, {} rad/s; arcs of {} radius and more",
                                  fork.min_rad / kDegree, fork.max_rad / kDegree,
                                  NumberText(fork.max_rate_radps), LengthText(spec.turn_radius_m))};
}

std::string Millimetres(double m) { return std::to_string(std::lround(1000 * m)); }

// null: the model states no limits. Sizes in m, rad and shares.
nlohmann::ordered_json MeasuredJson(const MeasuredLimits& measured) {
  if (measured.by.empty()) return nullptr;
  nlohmann::ordered_json limits = nlohmann::ordered_json::object();
  for (const MeasuredLimit& limit : measured.limits) limits[limit.kind] = limit.most;
  return {{"by", measured.by},
          {"not_used", measured.why_unused},
          {"frictions", measured.frictions},
          {"limits", limits}};
}

nlohmann::ordered_json Point(const Vec2& p) { return {p.x(), p.y()}; }

nlohmann::ordered_json StanceJson(const RobotStance& stance) {
  nlohmann::ordered_json carriers = nlohmann::ordered_json::array(),
                         edges = nlohmann::ordered_json::array();
  for (const Carrier& carrier : stance.carriers)
    carriers.push_back({{"name", carrier.name},
                        {"driven", carrier.driven},
                        {"x_m", carrier.p_B.x()},
                        {"y_m", carrier.p_B.y()},
                        {"gap_m", carrier.p_B.z()}});
  for (const SupportEdge& edge : stance.edges)
    edges.push_back({{"from_m", Point(edge.a_B)},
                     {"to_m", Point(edge.b_B)},
                     {"bearing_deg", edge.bearing_rad / kDegree},
                     {"tip_deg", edge.tip_rad / kDegree}});
  return {{"carriers", carriers}, {"support_edges", edges}};
}

std::string StandstillText(Standstill standstill) {
  switch (standstill) {
    case Standstill::kBrake:
      return "brakes on its driven wheels";
    case Standstill::kHold:
      return "motors that hold their wheels' positions";
    case Standstill::kFree:
      break;
  }
  return "nothing: its motors give way, on a slope it rolls";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> RobotFigures(const RobotCheck& check) {
  const RobotSpec& spec = check.spec;
  const Vec3& com = spec.p_BCom;
  return {
      {"drive", spec.drive},
      {"wheels", WheelsText(spec)},
      TurnFigure(check),
      {"casters", CastersText(check)},
      {"mass", fmt::format("{} kg, {} of it on the driven wheels", NumberText(spec.mass_kg),
                           PercentText(check.drive.driven_share))},
      {"centre of mass", fmt::format("x {}, y {}, z {} mm", Millimetres(com.x()),
                                     Millimetres(com.y()), Millimetres(com.z()))},
      {"belly clearance", LengthText(spec.clearance_m)},
      {"height; reach", LengthText(spec.height_m) + "; " + LengthText(spec.circumscribed_radius_m)},
      {"static tip", TipText(check)},
      {"motors", fmt::format("{} N at stall, {} N rolling friction",
                             NumberText(check.stall_force_n), NumberText(check.drive.rolling_n))},
      {"stands still by", StandstillText(spec.standstill)},
      {"top speed", fmt::format("{} m/s by the motors, {} m/s allowed, {} m/s cruise",
                                NumberText(check.top_speed_mps), NumberText(spec.max_speed_mps),
                                NumberText(spec.cruise_mps))},
      {"lidar plane",
       check.stance.lidar_z_m ? LengthText(*check.stance.lidar_z_m) + " over the floor" : "none"},
      {"crosses", CrossesText(spec)},
  };
}

void SayRobot(const RobotCheck& check, const Console& console) {
  FactTable figures;
  figures.SetTitle(check.spec.name + ": " + check.spec.model_file);
  for (const auto& [name, value] : RobotFigures(check)) figures.Add({name, value});
  console.Say(figures);
  TextTable drive({{.heading = "Ten seconds", .least = 18},
                   {.heading = "Kinematics", .right = true},
                   {.heading = "Driven", .right = true},
                   {.heading = "Tolerance", .right = true},
                   {.heading = "Unit"},
                   {.heading = "Holds"}});
  for (const LawRow& row : check.drive.rows)
    drive.Add({row.law, NumberText(row.expected), NumberText(row.measured),
               NumberText(row.tolerance, 2), row.unit,
               row.ok() ? TextCell("ok") : TextCell("FAILS", Tone::kBad)});
  if (!drive.empty()) console.Say(drive);
  for (const Finding& finding : check.findings) console.Say(finding.Line());
  if (check.ok()) console.Say("nothing is wrong with it");
}

nlohmann::ordered_json RobotCheckJson(const RobotCheck& check) {
  const RobotSpec& spec = check.spec;
  nlohmann::ordered_json wheels = nlohmann::ordered_json::array(),
                         rows = nlohmann::ordered_json::array(),
                         findings = nlohmann::ordered_json::array();
  for (const WheelSpec& wheel : spec.wheels)
    wheels.push_back({{"name", wheel.name},
                      {"radius_m", wheel.radius_m},
                      {"x_m", wheel.p_BW.x()},
                      {"y_m", wheel.p_BW.y()},
                      {"no_load_radps", wheel.max_speed_radps},
                      {"stall_nm", wheel.max_torque_nm}});
  for (const LawRow& row : check.drive.rows)
    rows.push_back({{"what", row.law},
                    {"expected", row.expected},
                    {"measured", row.measured},
                    {"tolerance", row.tolerance},
                    {"unit", row.unit},
                    {"ok", row.ok()}});
  for (const Finding& finding : check.findings)
    findings.push_back({{"kind", finding.kind == Finding::Kind::kWrong ? "wrong" : "note"},
                        {"what", finding.what},
                        {"mend", finding.mend}});
  nlohmann::ordered_json json = {
      {"robot", spec.name},
      {"file", spec.model_file},
      {"ok", check.ok()},
      {"drive", spec.drive},
      {"wheels", wheels},
      {"track_m", check.track_m},
      {"mass_kg", spec.mass_kg},
      {"driven_share", check.drive.driven_share},
      {"centre_of_mass_m", {spec.p_BCom.x(), spec.p_BCom.y(), spec.p_BCom.z()}},
      {"clearance_m", spec.clearance_m},
      {"standstill", Name(spec.standstill)},
      {"height_m", spec.height_m},
      {"circumscribed_radius_m", spec.circumscribed_radius_m},
      {"static_tip_deg", spec.static_tip_rad / kDegree},
      {"stall_force_n", check.stall_force_n},
      {"rolling_n", check.drive.rolling_n},
      {"top_speed_mps", check.top_speed_mps},
      {"top_yaw_radps", check.top_yaw_radps},
      {"max_speed_mps", spec.max_speed_mps},
      {"cruise_mps", spec.cruise_mps},
      {"lidar_z_m", nullptr}};
  if (spec.steering) json["turn_radius_m"] = spec.turn_radius_m;
  if (check.stance.lidar_z_m) json["lidar_z_m"] = *check.stance.lidar_z_m;
  json["measured"] = MeasuredJson(spec.measured);
  json.update(StanceJson(check.stance));
  json["ten_seconds"] = rows;
  json["findings"] = findings;
  return json;
}

}  // namespace floorproof
