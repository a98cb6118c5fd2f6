// SPDX-License-Identifier: Apache-2.0
#include "report/drive_marks.h"

#include <fmt/format.h>

#include <algorithm>

#include "env/core/failure_text.h"

namespace floorproof {

std::vector<HeatFailure> ListedFailures(const std::vector<Event>& events) {
  std::vector<HeatFailure> failures;
  for (const Event& event : events)
    failures.push_back({{event.x_m, event.y_m},
                        std::to_string(failures.size() + 1),
                        fmt::format("{}, {:.1f} s", FailureName(event), event.t_s)});
  return failures;
}

std::vector<std::vector<Vec2>> WayDriven(const std::vector<TraceRow>& trace) {
  constexpr double kJump_m = 0.3, kJump_mps = 3;  // so far, so fast: the robot was carried
  constexpr double kStray_m = 0.005;
  constexpr std::size_t kMostBetween = 200;  // bounds what is looked at again
  std::vector<std::vector<Vec2>> way;
  std::vector<Vec2> between;  // since the last point that is kept
  double last_s = 0;
  for (const TraceRow& row : trace) {
    const Vec2 p(row.x_m, row.y_m);
    const Vec2 last = between.empty() ? (way.empty() ? p : way.back().back()) : between.back();
    const double gone_m = (p - last).norm(), most_m = kJump_mps * (row.t_s - last_s);
    last_s = row.t_s;
    if (way.empty() || gone_m > std::max(kJump_m, most_m)) {
      if (!between.empty()) way.back().push_back(between.back());
      way.push_back({p});
      between.clear();
      continue;
    }
    const bool strays =
        between.size() >= kMostBetween || std::ranges::any_of(between, [&](const Vec2& passed) {
          return DistanceToSegment(way.back().back(), p, passed) > kStray_m;
        });
    if (strays) {
      way.back().push_back(between.back());
      between.clear();
    }
    between.push_back(p);
  }
  if (!between.empty()) way.back().push_back(between.back());
  return way;
}

void ShowDrive(const EpisodeRecord& record, Way way, HeatMapOptions& options) {
  options.failures = ListedFailures(record.events);
  options.failures_by = "failures, as they are listed";
  if (way == Way::kShown) options.driven = WayDriven(record.trace);
}

}  // namespace floorproof
