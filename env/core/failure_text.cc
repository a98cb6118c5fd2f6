// SPDX-License-Identifier: Apache-2.0
#include "env/core/failure_text.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/quantity.h"
#include "base/words.h"
#include "env/core/event_evidence.h"
#include "env/core/levels.h"
#include "env/geometry/geometry.h"

namespace floorproof {
namespace {

const Hazard* Find(const HazardMap& map, const std::string& id) {
  const auto hazard = std::ranges::find(map.hazards, id, &Hazard::id);
  return hazard == map.hazards.end() ? nullptr : &*hazard;
}

double Lasted(const Event& event) {
  return event.t_s - Evidence(event, "since_s").value_or(event.t_s);
}

// The words before it and the hazard, empty where none is to blame; other words for what lies below
// the base floor.
std::string Beside(const Event& event, const HazardMap& map, std::string_view up,
                   std::string_view down) {
  if (event.hazard.empty()) return "";
  const Hazard* hazard = Find(map, event.hazard);
  const bool below = hazard != nullptr ? hazard->height_m < 0 : event.hazard == BaseFloorId(map);
  return std::string(below ? down : up) + " " + ObstaclePhrase(map, event.hazard);
}

// Whether the middle of the robot was over it.
bool IsOn(const Event& event, const HazardMap& map) {
  const Hazard* hazard = Find(map, event.hazard);
  return hazard != nullptr && std::ranges::any_of(hazard->footprint, [&](const Polygon& part) {
           return Contains(part, {event.x_m, event.y_m});
         });
}

std::string Is(const Compared& compared, std::string_view rule) {
  return compared.value + ", " + compared.limit + " " + std::string(rule);
}

std::string VeerOffText(const Event& event, const HazardMap& map) {
  std::string text =
      "was off its path by " + Is(ComparedText(event.value, event.threshold, 2, "m"), "is allowed");
  if (const double lasted_s = Lasted(event); lasted_s > 0) text += ", for " + TimeText(lasted_s);
  return text + Beside(event, map, ", after it met", ", after it met");
}

// What its driven wheels did meanwhile: hardly carried it, or ran on the spot.
std::string WheelsText(const Event& event) {
  constexpr double kHardly = 0.25, kSpinning_m = 0.5;
  const auto share = Evidence(event, "driven_share");
  if (share && *share < kHardly)
    return "; its driven wheels carried " + PercentText(*share, 2) + " of its weight";
  const double gained_m = Evidence(event, "gained_m").value_or(event.value);
  if (const auto rim_m = Evidence(event, "rim_m");
      rim_m && Evidence(event, "turning").value_or(0) == 0 && *rim_m > 3 * gained_m + kSpinning_m)
    return "; its wheels slipped: they ran " + FixedText(*rim_m, 2) + " m";
  return "";
}

std::string HeldText(const Event& event, const HazardMap& map) {
  constexpr double kDegree = kPi / 180;
  const double window_s = Evidence(event, "commanded_s").value_or(Lasted(event));
  const double gained_m = Evidence(event, "gained_m").value_or(event.value);
  // Of records without it: it stands where it gains next to nothing.
  const double still_s = Evidence(event, "still_s").value_or(gained_m < 0.02 ? window_s : 0);
  if (event.kind == "high_centred") {
    std::string text = "stood still for " + TimeText(std::max(still_s, window_s / 2));
    text += event.hazard.empty() ? " on its belly"
                                 : " with its belly on " + ObstaclePhrase(map, event.hazard);
    if (const auto load_n = Evidence(event, "belly_load_n"))
      text += ", which carries " + NumberText(*load_n) + " N of its weight";
    return text;
  }
  const std::string_view up = event.hazard == "wall" ? " at" : IsOn(event, map) ? " on" : " before";
  const std::string where = Beside(event, map, up, " in");
  if (still_s >= window_s / 2) return "stood still for " + TimeText(still_s) + where;
  const std::string in = " in " + TimeText(window_s) + where;
  if (Evidence(event, "turning").value_or(0) == 0) {
    constexpr double kNotable_s = 1;
    // The limit is a share of the way commanded, and mostly met by a hair: it says nothing.
    const double commanded_m = Evidence(event, "commanded_m").value_or(4 * event.threshold);
    return "advanced " + FixedText(gained_m, 2) + " m of the " + FixedText(commanded_m, 2) +
           " m commanded" + in +
           (still_s >= kNotable_s ? ", and stood still for " + TimeText(still_s) : "");
  }
  const double turned_rad = Evidence(event, "turn_rad").value_or(0);
  const double least_rad = Evidence(event, "turn_threshold_rad").value_or(0);
  if (turned_rad >= least_rad) return "turned to and fro without getting on" + in;
  return "turned by " +
         Is(ComparedText(turned_rad / kDegree, least_rad / kDegree, 0, "deg"), "was due") + "," +
         in;
}

std::string StuckText(const Event& event, const HazardMap& map) {
  return HeldText(event, map) + WheelsText(event);
}

std::string RollOverText(const Event& event, const HazardMap& map) {
  if (event.kind == "fell") {
    std::string text = "fell";
    if (event.value > event.threshold)  // not so in records of earlier versions
      text += ": a wheel dropped by " +
              Is(ComparedText(1000 * event.value, 1000 * event.threshold, 0, "mm"), "is allowed");
    return text + Beside(event, map, ", off", ", into");
  }
  if (event.kind == "landed")
    return "landed on a wheel with " +
           Is(ComparedText(event.value, event.threshold, 2, "J/kg"), "is allowed") +
           Beside(event, map, ", off", ", into");
  if (event.kind == "tipped") {
    const Compared mm = ComparedText(-1000 * event.value, -1000 * event.threshold, 0, "mm");
    return "tipped: its centre of mass was outside of what its wheels stand on by " +
           Is(mm, "is allowed") + Beside(event, map, ", at", ", in");
  }
  constexpr double kDegree = kPi / 180;
  const Compared deg = ComparedText(event.value / kDegree, event.threshold / kDegree, 0, "deg");
  return "leaned by " + Is(deg, "is allowed") + Beside(event, map, ", at", ", in");
}

std::string BounceBackText(const Event& event, const HazardMap& map) {
  std::string text =
      "hit " + (event.hazard.empty() ? "an obstacle" : ObstaclePhrase(map, event.hazard));
  if (const auto closing_mps = Evidence(event, "closing_mps"))
    text += " at " + FixedText(*closing_mps, 2) + " m/s";
  if (event.kind == "parted")
    return text + " and came off it by " +
           Is(ComparedText(1000 * event.value, 1000 * event.threshold, 1, "mm"), "is allowed");
  return text + " and was thrown back at " +
         Is(ComparedText(event.value, event.threshold, 3, "m/s"), "is allowed");
}

}  // namespace

std::string HazardPhrase(const Hazard& hazard) {
  std::string text = "'" + hazard.id + "' (" + Words(hazard.type);
  const double height_m = hazard.height_m - hazard.floor_m;
  if (height_m > 0) text += ", " + LengthText(height_m);
  if (height_m < 0) text += ", " + LengthText(-height_m) + " deep";
  return text + ")";
}

std::string ObstaclePhrase(const HazardMap& map, const std::string& id) {
  if (const Hazard* hazard = Find(map, id)) return HazardPhrase(*hazard);
  if (id == BaseFloorId(map)) return "the base floor";
  return id == "wall" ? "a wall" : "'" + id + "'";
}

std::string FailureText(const Event& event, const HazardMap& map) {
  switch (event.mode) {
    case FailureMode::kVeerOff:
      return VeerOffText(event, map);
    case FailureMode::kStuck:
      return StuckText(event, map);
    case FailureMode::kRollOver:
      return RollOverText(event, map);
    case FailureMode::kBounceBack:
      return BounceBackText(event, map);
  }
  return "";
}

std::string FailureSentence(const Event& event, const HazardMap& map) {
  return FailureText(event, map) + ", at " + PlaceText(event.x_m, event.y_m);
}

std::string FailureName(const Event& event) {
  const std::string name = Words(Name(event.mode));
  return event.kind.empty() ? name : name + " (" + Words(event.kind) + ")";
}

std::string PlaceText(double x_m, double y_m) {
  return "x " + FixedText(x_m, 2) + ", y " + FixedText(y_m, 2) + " m";
}

}  // namespace floorproof
