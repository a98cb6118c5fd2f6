// SPDX-License-Identifier: Apache-2.0
// The ladder's hazards as a site file would state them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validate/ladder.h"
#include "validate/made_hazard.h"

namespace floorproof {
namespace {

constexpr double kFar_m = 3.5;  // across the way and, for a level change, along it
constexpr double kGrooveDepth_m = 0.05, kCoverTop_m = 0.05, kCoverHeight_m = 0.020;
constexpr double kCoverFlank_deg = 30, kRoughLength_m = 0.6;
constexpr double kThresholdTop_m = 0.05, kRampLength_m = 1, kSillGap_m = 0.032, kWetLength_m = 1;

double NoLength(double) { return 0; }

Hazard LevelChange(double height_mm) {
  return MakeHazard("step", fmt::format("height_m: {}", height_mm / 1000),
                    Rectangle({0, -kFar_m}, {kFar_m, kFar_m}));
}
Hazard StepUp(double height_mm, double) { return LevelChange(height_mm); }
Hazard Drop(double depth_mm, double) { return LevelChange(-depth_mm); }

// Along y, beginning at x = 0.
std::vector<Vec2> Line(double width_m) { return {{width_m / 2, -kFar_m}, {width_m / 2, kFar_m}}; }

double GrooveLength(double width_mm) { return width_mm / 1000; }
Hazard Groove(double width_mm, double) {
  return MakeHazard("groove",
                    fmt::format("width_m: {}, depth_m: {}", width_mm / 1000, kGrooveDepth_m),
                    Line(width_mm / 1000));
}

double CoverWidth(double height_m, double flank_deg) {
  return kCoverTop_m + 2 * height_m / std::tan(flank_deg * kPi / 180);
}
Hazard Cover(double height_m, double flank_deg) {
  const double width_m = CoverWidth(height_m, flank_deg);
  return MakeHazard(
      "cable_cover",
      fmt::format("width_m: {}, top_width_m: {}, height_m: {}", width_m, kCoverTop_m, height_m),
      Line(width_m));
}
double FlankLength(double flank_deg) { return CoverWidth(kCoverHeight_m, flank_deg); }
Hazard CoverFlank(double flank_deg, double) { return Cover(kCoverHeight_m, flank_deg); }
double HeightLength(double height_mm) { return CoverWidth(height_mm / 1000, kCoverFlank_deg); }
Hazard CoverHeight(double height_mm, double) { return Cover(height_mm / 1000, kCoverFlank_deg); }

// Lies along the way, whichever that is, so that there are few bumps; their lattice does not turn.
double RoughLength(double) { return kRoughLength_m; }
Hazard Rough(double amplitude_mm, double travel_rad) {
  constexpr double kHalfWidth_m = 0.4;
  Polygon place = Rectangle({0, -kHalfWidth_m}, {kRoughLength_m, kHalfWidth_m});
  for (Vec2& corner : place) corner = Pose2{0, 0, travel_rad}.Rotate(corner);
  return MakeHazard("rough", fmt::format("amplitude_m: {}, wavelength_m: 0.1", amplitude_mm / 1000),
                    place);
}

// As a new door's: upright up to 6.4 mm, from there bevelled 1:2, 50 mm wide on top.
double ThresholdWidth(double height_mm) {
  return kThresholdTop_m + 4 * std::max(0.0, height_mm / 1000 - 0.0064);
}
Hazard Threshold(double height_mm, double) {
  const double width_m = ThresholdWidth(height_mm);
  return MakeHazard("threshold",
                    fmt::format("width_m: {}, height_m: {}", width_m, height_mm / 1000),
                    Line(width_m));
}

// It goes on beyond: the whole robot is on it in the end.
double RampLength(double) { return kRampLength_m; }
Hazard RampOf(double slope_deg) {
  Hazard ramp = MakeHazard("ramp", fmt::format("slope_deg: {}", slope_deg),
                           Rectangle({0, -kFar_m}, {kFar_m, kFar_m}));
  ramp.known = true;  // what leads down a known ramp has not fallen
  return ramp;
}
Hazard RampUp(double slope_deg, double) { return RampOf(slope_deg); }
Hazard RampDown(double slope_deg, double) { return RampOf(-slope_deg); }

Hazard Carpet(double height_mm, double) {
  return MakeHazard("carpet", fmt::format("height_m: {}", height_mm / 1000),
                    Rectangle({0, -kFar_m}, {kFar_m, kFar_m}));
}

// The polygon's first edge, the door, at x = 0.
double SillLength(double) { return kSillGap_m; }
Hazard LiftSill(double level_mm, double) {
  return MakeHazard("lift_sill", fmt::format("gap_m: {}, level_m: {}", kSillGap_m, level_mm / 1000),
                    {{0, kFar_m}, {0, -kFar_m}, {kFar_m, -kFar_m}, {kFar_m, kFar_m}});
}

double WetLength(double) { return kWetLength_m; }
Hazard Wet(double slippery_pct, double) {
  Hazard wet = MakeHazard("wet", "", Rectangle({0, -kFar_m}, {kWetLength_m, kFar_m}));
  wet.material.friction = 1 - slippery_pct / 100;
  return wet;
}

// Rungs of millimetres to a tenth, of a width to one, of an angle to a fifth of a degree.
constexpr Rungs kHeight = {.per_unit = 10, .first = 2, .spacing = 20, .last = 602};
constexpr Rungs kWidth = {.per_unit = 1, .first = 2, .spacing = 10, .last = 502};
constexpr Rungs kAngle = {.per_unit = 5, .first = 10, .spacing = 20, .last = 450};
constexpr Rungs kSlope = {.per_unit = 5, .first = 10, .spacing = 20, .last = 290};
constexpr Rungs kLevel = {.per_unit = 10, .first = 2, .spacing = 20, .last = 402};
constexpr Rungs kShare = {.per_unit = 1, .first = 10, .spacing = 10, .last = 95};

// The most that there is of each length, mm: as its plug-in's keys allow.
constexpr LadderHazard kHazards[] = {
    {"step", "height of a raised floor", "mm", kHeight, 2000, &NoLength, &StepUp},
    {"drop", "depth of a lowered floor", "mm", kHeight, 2000, &NoLength, &Drop},
    {"groove", "width of a groove 50 mm deep", "mm", kWidth, 2000, &GrooveLength, &Groove},
    {"cable_cover", "flanks of a 20 mm cable cover", "deg", kAngle, 0, &FlankLength, &CoverFlank},
    {"cable_cover_height", "height of a cable cover, flanks 30 deg", "mm", kHeight, 500,
     &HeightLength, &CoverHeight},
    {"rough", "highest bump of rough ground", "mm", kHeight, 200, &RoughLength, &Rough},
    {"threshold", "height, bevelled 1:2 above 6.4 mm", "mm", kHeight, 100, &ThresholdWidth,
     &Threshold},
    {"ramp", "slope up", "deg", kSlope, 0, &RampLength, &RampUp},
    {"ramp_down", "slope down", "deg", kSlope, 0, &RampLength, &RampDown},
    {"carpet", "height of a carpet", "mm", kHeight, 100, &NoLength, &Carpet},
    {"lift_sill", "a lift's floor behind a gap of 32 mm", "mm", kLevel, 500, &SillLength,
     &LiftSill},
    {"wet", "friction lost, of 1", "%", kShare, 0, &WetLength, &Wet},
};

}  // namespace

std::span<const LadderHazard> LadderHazards() { return kHazards; }

const LadderHazard& FindLadderHazard(std::string_view name) {
  for (const LadderHazard& hazard : kHazards)
    if (hazard.name == name) return hazard;
  throw InternalError("no such hazard on the ladder: " + std::string(name));
}

}  // namespace floorproof
