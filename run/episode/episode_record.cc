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
