// SPDX-License-Identifier: Apache-2.0
#include "report/sample_marks.h"

#include <string_view>

namespace floorproof {
namespace {

constexpr const char* kOutOfReach = "out of the robot's reach";

std::string Label(std::string_view kind) {
  if (kind == "corner") return "sample near a corner";
  if (kind == "boundary") return "sample near the boundary";
  if (kind == "random") return "random sample";
  return "sample at a place given";
}

}  // namespace

std::vector<std::string> SampleSeries() {
  std::vector<std::string> series;
  for (const char* kind : {"corner", "boundary", "random", "given"}) series.push_back(Label(kind));
  series.push_back(kOutOfReach);
  return series;
}

std::string SampleSeriesOf(const SamplePlace& place) {
  return place.reachable ? Label(Names(place.kinds).front()) : kOutOfReach;
}

}  // namespace floorproof
