// SPDX-License-Identifier: Apache-2.0
// What a robot's model calls what was measured of it (measured_block.h), and the hash by which an
// edited figure shows.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

namespace floorproof {

// `measured_by` is what measured; `measured_model` the ModelHash of the model that was measured;
// `measured_figures` the FiguresHash of all the others. Each limit is a number
// measured_KIND_DIRECTION_UNIT, as LadderRow has it: by friction, for each by speed; below 0: that
// much or more, all that was tried was crossed.
inline constexpr std::string_view kMeasuredPrefix = "measured_";
inline constexpr const char* kMeasuredBy = "measured_by";
inline constexpr const char* kMeasuredModel = "measured_model";
inline constexpr const char* kMeasuredFigures = "measured_figures";
inline constexpr const char* kMeasuredHow = "measured_how";
inline constexpr const char* kMeasuredFrictions = "measured_frictions";
inline constexpr const char* kMeasuredSpeeds = "measured_speeds_mps";

struct MeasuredUnit {
  std::string_view name;
  double si = 0;    // what one of it is in m, rad or as a share
  double most = 0;  // no limit is larger
};
struct MeasuredKind {
  std::string_view name;  // the ladder's hazard
  MeasuredUnit unit;
};
std::span<const MeasuredKind> MeasuredKinds();
// The ladder's directions.
std::span<const std::string_view> MeasuredDirections();

// Numbers as they are written, a space between.
std::string FiguresText(std::span<const double> values);
// SHA-256 of what is said, by name: texts as they are, numbers as FiguresText. `measured_figures`
// itself does not count.
std::string FiguresHash(const std::map<std::string, std::string>& said);

}  // namespace floorproof
