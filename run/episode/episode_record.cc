// SPDX-License-Identifier: Apache-2.0
#include "run/episode/episode_record.h"

#include <fmt/format.h>

#include "base/quantity.h"
#include "env/core/failure_text.h"

namespace floorproof {

std::string_view Name(Outcome outcome) {
  switch (outcome) {
    case Outcome::kSuccess:
      return "success";
    case Outcome::kFailure:
      return "failure";
    case Outcome::kTimeout:
      return "timeout";
    case Outcome::kAborted:
      return "aborted";
    case Outcome::kNotPlanned:
      return "not_planned";
    case Outcome::kError:
      return "error";
    case Outcome::kInterrupted:
      return "interrupted";
  }
  return "?";
}

void EpisodeRecord::RequireCoverage(double least) {
  if (outcome != Outcome::kSuccess || metrics.coverage >= least) return;
  outcome = Outcome::kFailure;
  message = fmt::format("coverage {:.2f} % is below success.min_coverage, {:.2f} %",
                        100 * metrics.coverage, 100 * least);
}

void EpisodeRecord::RequireArrival(const Arrival& how, double max_plan_left) {
  arrival = how;
  metrics.end_off_m = how.off_m;
  metrics.plan_left_m = how.left_m;
  if (outcome != Outcome::kSuccess) return;
  const std::string_view believed = how.believed ? "believed that it had arrived, but " : "";
  if (how.off_m && *how.off_m > how.most_off_m) {
    const Compared m = ComparedText(*how.off_m, how.most_off_m, 2, "m");
    message =
        fmt::format("the robot {}stands {} from the plan's end at {}; success.arrival_m allows {}",
                    believed, m.value, PlaceText(how.end_W.x(), how.end_W.y()), m.limit);
  } else if (!how.at_rest) {
    message =
        fmt::format("the robot {}did not come to rest within {:g} s: {:.2f} m/s, {:.1f} deg/s",
                    believed, RestWatch::kPatience_s, how.speed_mps, how.turn_radps * 180 / kPi);
  } else if (how.tasks_missed > 0) {
    message = fmt::format("the robot {}did {} away from {}, the first due at {}", believed,
                          CountText(how.tasks_missed, "task"),
                          how.tasks_missed == 1 ? "its place" : "their places",
                          PlaceText(how.first_missed_W->x(), how.first_missed_W->y()));
  } else if (how.left_m && *how.left_m > max_plan_left * how.plan_m) {
    message = fmt::format(
        "the robot {}left out {:.2f} m of the plan's {:.2f} m; success.max_plan_left allows {}",
        believed, *how.left_m, how.plan_m, PercentText(max_plan_left));
  } else {
    return;
  }
  outcome = Outcome::kFailure;
}

void EpisodeRecord::TakeMissed(const MissedStops& missed) {
  metrics.stops_missed = missed.count;
  if (missed.count == 0) return;
  const std::string place = PlaceText(missed.first_W.x(), missed.first_W.y());
  const int stops = missed.count - missed.end;
  std::string text = stops == 0 ? "the plan's end at " + place
                                : fmt::format("{} of the plan{} at {}", CountText(stops, "stop"),
                                              stops > 1 ? ", the first" : "", place);
  if (stops > 0 && missed.end) text += ", and its end";
  message += (message.empty() ? "" : "; ") + ("passed beside " + text);
  if (missed.end && outcome == Outcome::kSuccess) outcome = Outcome::kFailure;
}

}  // namespace floorproof
