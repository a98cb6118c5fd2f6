// SPDX-License-Identifier: Apache-2.0
// Parameters of a scenario that belong to no plug-in: of the episode and of its film.
#pragma once

#include <optional>
#include <string>

#include "base/params.h"

namespace floorproof {

struct VideoParams {
  std::string camera = "auto";
  std::string quality = "auto";  // draft of what a campaign films, else good
  int fps = 30;
  std::optional<double> speed_up;  // none: such that the film keeps to max_frames
  int max_frames = 600;
  int width = 960, height = 540;
  bool scan = true;
  void Visit(ParamVisitor& v);
};

// Scalars that stand at the top of the file.
struct EpisodeParams {
  int control_hz = 50, trace_hz = 50;
  // stop: the first failure ends the episode; assist: a person helps (intervention.h); ignore: it
  // is logged.
  std::string on_failure = "stop";
  double min_coverage = 0;
  double arrival_m = 0.25;  // Nav2's tolerance of a goal
  // none: a tenth, or of a robot that reacts, is supervised or helped all: what it goes around is
  // left
  std::optional<double> max_plan_left;
  std::optional<double> stop_at_coverage;  // none: the planner, or the plan's end, says when
  // none: three times the plan's own time, and a minute; of an online planner hours (time_limit.h)
  std::optional<double> time_limit_s;
  std::string drive = "physics";  // cells: an ideal robot on cells; none: the plan only
  int seed = 0;
  int episode = 0;               // that `run` drives: of a campaign's resolved episode its own
  std::string wheels = "ideal";  // of Mecanum robots: ideal, or rollers that are bodies
  void Visit(ParamVisitor& v);
};

}  // namespace floorproof
