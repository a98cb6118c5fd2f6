// SPDX-License-Identifier: Apache-2.0
// Steps a second of an episode (control, detectors, coverage, 50 Hz trace in memory) against a bare
// mj_step loop on the same model, from the same state, with the same controls. Both in turn, in one
// run; the ratio is what counts.
// A scenario with `estimator: mcl` shows what sensing and localising cost.
//   bench_episode_steps [SCENARIO] [ROUNDS]
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bench/bare_loop.h"
#include "env/scene/models_folder.h"
#include "run/episode/make_plan.h"
#include "run/scenario/agents.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

int Main(int argc, char** argv) {
  const std::filesystem::path file =
      argc > 1 ? argv[1] : (ModelsFolder() / "scenarios" / "demo_beluga.yaml").string();
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 7;
  Scenario s = ReadScenario(file);
  const PlanResult plan = MakePlan(s);
  const Scene scene = BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start);
  const Scene whole =
      BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start, WallSet::kAll);
  const int steps_a_control =
      static_cast<int>(std::lround(1 / (s.world.physics.timestep_s * s.spec.episode.control_hz)));
  std::vector<double> ratios;
  for (int round = 0; round < rounds; ++round) {
    Notes notes;
    Agents agents = MakeAgents(s.spec);
    const EpisodeRecord record = RunEpisode(s, agents, scene, plan, &notes);
    const double bare_s = BareLoop(whole.model.get(), notes, steps_a_control);
    const auto steps = static_cast<double>(record.steps);
    ratios.push_back(bare_s / notes.seconds());
    fmt::print(
        "{}: episode {:.1f} k steps/s, {:.0f}x real time, bare mj_step {:.1f} k steps/s, ratio "
        "{:.3f} ({})\n",
        file.stem().string(), steps / notes.seconds() / 1000,
        record.metrics.duration_s / notes.seconds(), steps / bare_s / 1000, ratios.back(),
        Name(record.outcome));
  }
  std::ranges::sort(ratios);
  fmt::print("median ratio {:.3f} (min {:.3f}, max {:.3f})\n", ratios[ratios.size() / 2],
             ratios.front(), ratios.back());
  return 0;
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) { return floorproof::Main(argc, argv); }
