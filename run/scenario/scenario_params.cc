// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/scenario_params.h"

namespace floorproof {

void VideoParams::Visit(ParamVisitor& v) {
  v("camera", camera, {"auto", "chase", "top", "side"},
    "where the film is taken from; auto: from above in a time lapse, from the side at what holds "
    "the robot, else from behind");
  v("quality", quality, {"auto", "good", "draft"},
    "good: with shadows; draft: without, in half of the time; auto: good, and of what a campaign "
    "films draft");
  v("fps", fps, Between(1, 120), "frames a second of film");
  v("speed_up", speed_up, Positive(),
    "simulated seconds a second of film; none: such that it keeps to max_frames");
  v("max_frames", max_frames, Between(2, 1e6), "most frames of a film");
  v("width", width, Between(64, 1920), "pixels, even");
  v("height", height, Between(64, 1080), "pixels, even");
  v("scan", scan, "of a robot with a lidar: its beams, and where it thinks it is, on the floor");
}

void EpisodeParams::Visit(ParamVisitor& v) {
  v("control_hz", control_hz, Between(1, 2000), "control periods a second");
  v("trace_hz", trace_hz, Between(1, 2000), "rows of trace.csv a second");
  v("on_failure", on_failure, {"stop", "assist", "ignore", "watch"},
    "stop: the first failure ends the episode; assist: after each, a person sets the robot down "
    "farther along its path; ignore: it is logged and the drive goes on; watch: the first is all "
    "that is judged, and the drive goes on while the robot gains way");
  v.Group(
      "success",
      [this](ParamVisitor& g) {
        g("min_coverage", min_coverage, Between(0, 1), "least coverage that counts as success");
        g("arrival_m", arrival_m, Positive(),
          "how far from the plan's end the robot may truly stand at the end, and from the place of "
          "each task while it is done");
        g("max_plan_left", max_plan_left, Between(0, 1),
          "share of the plan's length that the robot may never have come to, within arrival_m; "
          "none: "
          "0.1, or any of a robot that reacts, is supervised or helped");
        g("stop_at_coverage", stop_at_coverage, Between(0, 1),
          "the drive ends when so much is covered, which no robot on an unknown floor can tell; "
          "none: when its planner, or its plan, ends");
      },
      "what counts as success");
  v("time_limit_s", time_limit_s, Positive(),
    "simulated seconds; none: a minute and three times what the plan takes at its own speeds, not "
    "counting waits for help; of a planner of unknown floors three hours");
  v("drive", drive, {"physics", "cells", "none"},
    "physics: drive the plan; cells: an ideal robot from cell to cell, for planners of unknown "
    "floors; none: plan only");
  v("seed", seed, Between(0, 2147483647.0), "of every random stream");
  v("episode", episode, Between(0, 1e8), "of the seed's episodes, the one that `run` drives");
  v("wheels", wheels, {"ideal", "rollers"},
    "Mecanum wheels; ideal: one body each, rollers: a hub and rollers that are bodies");
}

}  // namespace floorproof
