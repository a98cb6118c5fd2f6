// SPDX-License-Identifier: Apache-2.0
// Which moments of an episode a film shows, and for how long.
#pragma once

#include <span>
#include <vector>

namespace floorproof {

struct FilmPace {
  double fps = 30;
  // Simulated seconds per second of film. 0: the smallest of 1, 2, 3, 5, 8, 10, 15, 20, 30, 50, 80,
  // 100, .. that fits max_frames. Raised to one of these where the episode is too long for the
  // value given.
  double speed_up = 0;
  int max_frames = 600;
  double before_s = 4, after_s = 2;  // around an event time runs no faster than it does
  double hold_s = 1.5;               // the last picture stands, in seconds of film
};

struct FilmFrame {
  double t_s = 0;       // simulated
  double speed_up = 1;  // at which this frame is passed
};

// A stretch of an episode.
struct FilmPassage {
  double begin_s = 0, end_s = 0;
};

// The seconds around each event, as `pace` has them, cut to what is recorded; ascending, those that
// overlap joined.
std::vector<FilmPassage> PassagesAround(double begin_s, double end_s,
                                        std::span<const double> events_s, const FilmPace& pace);

// From begin_s to end_s, both shown; `events_s` ascending. If the slow passages around events would
// take more than half of the film, the later events are passed at the film's speed.
std::vector<FilmFrame> ScheduleFilm(double begin_s, double end_s, std::span<const double> events_s,
                                    const FilmPace& pace);
// These stretches alone, in real time, the last picture held. Where max_frames is too few, frames
// are left out evenly.
std::vector<FilmFrame> SchedulePassages(std::span<const FilmPassage> passages,
                                        const FilmPace& pace);

}  // namespace floorproof
