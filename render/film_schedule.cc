// SPDX-License-Identifier: Apache-2.0
#include "render/film_schedule.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

// The stretches around events, merged where they overlap, of at most budget_s together.
std::vector<FilmPassage> SlowPassages(double begin_s, double end_s,
                                      std::span<const double> events_s, const FilmPace& pace,
                                      double budget_s) {
  std::vector<FilmPassage> slow;
  double used_s = 0;
  for (const double event_s : events_s) {
    FilmPassage p = {std::max(begin_s, event_s - pace.before_s),
                     std::min(end_s, event_s + pace.after_s)};
    if (!slow.empty()) p.begin_s = std::max(p.begin_s, slow.back().end_s);
    if (p.end_s <= p.begin_s) continue;
    if (slow.empty()) p.begin_s = std::max(p.begin_s, p.end_s - budget_s);
    used_s += p.end_s - p.begin_s;
    if (used_s > budget_s + 1e-9) break;
    if (!slow.empty() && slow.back().end_s == p.begin_s) {
      slow.back().end_s = p.end_s;
    } else {
      slow.push_back(p);
    }
  }
  return slow;
}

double LeastSpeedUp(double least) {
  for (double decade = 1;; decade *= 10) {
    for (const double step : {1.0, 1.5, 2.0, 3.0, 5.0, 8.0}) {
      if (decade == 1 && step == 1.5) continue;
      if (decade * step >= least) return decade * step;
    }
  }
}

}  // namespace

std::vector<FilmPassage> PassagesAround(double begin_s, double end_s,
                                        std::span<const double> events_s, const FilmPace& pace) {
  std::vector<FilmPassage> passages;
  for (const double event_s : events_s) {
    // An event may lie a step behind the last state.
    const FilmPassage p = {std::clamp(event_s - pace.before_s, begin_s, end_s),
                           std::clamp(event_s + pace.after_s, begin_s, end_s)};
    if (!passages.empty() && p.begin_s <= passages.back().end_s)
      passages.back().end_s = std::max(passages.back().end_s, p.end_s);
    else
      passages.push_back(p);
  }
  return passages;
}

std::vector<FilmFrame> SchedulePassages(std::span<const FilmPassage> passages,
                                        const FilmPace& pace) {
  const int hold = static_cast<int>(std::lround(pace.hold_s * pace.fps));
  double all_s = 0;
  for (const FilmPassage& p : passages) all_s += p.end_s - p.begin_s;
  // Each passage's last picture stands beside its steps.
  const double room = std::max(1, pace.max_frames - hold - static_cast<int>(passages.size()));
  const double speed_up = std::max(1.0, all_s * pace.fps / room);
  std::vector<FilmFrame> frames;
  for (const FilmPassage& p : passages) {
    const double step_s = speed_up / pace.fps;
    const int steps = static_cast<int>(std::floor((p.end_s - p.begin_s) / step_s - 1e-9));
    for (int i = 0; i <= steps; ++i) frames.push_back({p.begin_s + i * step_s, speed_up});
    frames.push_back({p.end_s, speed_up});
  }
  if (!frames.empty()) frames.insert(frames.end(), hold, frames.back());
  return frames;
}

std::vector<FilmFrame> ScheduleFilm(double begin_s, double end_s, std::span<const double> events_s,
                                    const FilmPace& pace) {
  const int hold = std::min(static_cast<int>(std::lround(pace.hold_s * pace.fps)),
                            std::max(0, pace.max_frames / 4));
  // One frame for the end, and one each time that the pace changes.
  const double room =
      std::max(1, pace.max_frames - hold - 2 -
                      2 * static_cast<int>(std::min(events_s.size(), std::size_t{20})));
  const auto slow = SlowPassages(begin_s, end_s, events_s, pace, 0.5 * room / pace.fps);
  double slow_s = 0;
  for (const FilmPassage& p : slow) slow_s += p.end_s - p.begin_s;
  const double fast_s = std::max(0.0, end_s - begin_s - slow_s);
  const double least = fast_s * pace.fps / std::max(1.0, room - slow_s * pace.fps);
  double speed_up = pace.speed_up;
  if (speed_up <= 0 || speed_up < least) speed_up = LeastSpeedUp(least);
  const double slow_speed_up = std::min(1.0, speed_up);

  std::vector<FilmFrame> frames;
  std::size_t next = 0;  // the first passage that has not ended
  for (double t_s = begin_s;
       t_s < end_s - 1e-6 && static_cast<int>(frames.size()) + hold + 1 < pace.max_frames;) {
    while (next < slow.size() && t_s >= slow[next].end_s - 1e-9) ++next;
    const bool inside = next < slow.size() && t_s >= slow[next].begin_s - 1e-9;
    frames.push_back({t_s, inside ? slow_speed_up : speed_up});
    const double step_s = frames.back().speed_up / pace.fps;
    const bool enters = !inside && next < slow.size() && t_s + step_s > slow[next].begin_s;
    t_s = enters ? slow[next].begin_s : t_s + step_s;
  }
  const double last = frames.empty() ? 1.0 : frames.back().speed_up;
  for (int i = 0; i <= hold; ++i) frames.push_back({end_s, last});
  return frames;
}

}  // namespace floorproof
