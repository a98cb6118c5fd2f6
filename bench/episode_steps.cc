// SPDX-License-Identifier: Apache-2.0
// Steps a second of an episode (control, detectors, coverage, 50 Hz trace in memory) against a bare
// mj_step loop on the same model, from the same state, with the same controls. Both in turn, in one
// run; the ratio is what counts.
//   bench_episode_steps [SCENARIO] [ROUNDS]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "env/run/episode.h"

namespace floorproof {
namespace {

using Clock = std::chrono::steady_clock;

// Notes the state at the first control period, the controls of each, and the time of the loop.
class Notes : public EpisodeObserver {
 public:
  bool OnControl(Simulation& simulation, double, double) override {
    const mjModel* m = simulation.model();
    mjData* d = simulation.data();
    if (controls_.empty()) {
      state_.resize(static_cast<std::size_t>(mj_stateSize(m, mjSTATE_INTEGRATION)));
      mj_getState(m, d, state_.data(), mjSTATE_INTEGRATION);
      controls_.reserve(1 << 22);
      begin_ = Clock::now();
    }
    controls_.insert(controls_.end(), d->ctrl, d->ctrl + m->nu);
    end_ = Clock::now();
    return true;
  }
  double seconds() const { return std::chrono::duration<double>(end_ - begin_).count(); }
  const std::vector<double>& controls() const { return controls_; }
  const std::vector<mjtNum>& state() const { return state_; }

 private:
  std::vector<double> controls_;
  std::vector<mjtNum> state_;
  Clock::time_point begin_, end_;
};

double BareLoop(const mjModel* m, const Notes& notes, int steps_a_control) {
  const DataPtr data = MakeData(m);
  mj_setState(m, data.get(), notes.state().data(), mjSTATE_INTEGRATION);
  const auto begin = Clock::now();
  for (std::size_t i = 0; i + static_cast<std::size_t>(m->nu) < notes.controls().size();
       i += static_cast<std::size_t>(m->nu)) {
    std::copy_n(notes.controls().data() + i, m->nu, data->ctrl);
    for (int k = 0; k < steps_a_control; ++k) mj_step(m, data.get());
  }
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

int Main(int argc, char** argv) {
  const std::filesystem::path file =
      argc > 1 ? argv[1] : (ModelsFolder() / "scenarios" / "demo_beluga.yaml").string();
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 7;
  Scenario s = ReadScenario(file);
  const PlanResult plan = MakePlan(s);
  const Scene scene = BuildScene(s.site.map, s.robot, s.physics, s.start);
  const Scene whole = BuildScene(s.site.map, s.robot, s.physics, s.start, WallSet::kAll);
  const int steps_a_control =
      static_cast<int>(std::lround(1 / (s.physics.timestep_s * s.episode.control_hz)));
  std::vector<double> ratios;
  for (int round = 0; round < rounds; ++round) {
    Notes notes;
    const EpisodeRecord record = RunEpisode(s, scene, plan, &notes);
    const double bare_s = BareLoop(whole.model.get(), notes, steps_a_control);
    const auto steps = static_cast<double>(record.steps);
    ratios.push_back(bare_s / notes.seconds());
    fmt::print("{}: episode {:.1f} k steps/s, bare mj_step {:.1f} k steps/s, ratio {:.3f} ({})\n",
               file.stem().string(), steps / notes.seconds() / 1000, steps / bare_s / 1000,
               ratios.back(), Name(record.outcome));
  }
  std::ranges::sort(ratios);
  fmt::print("median ratio {:.3f} (min {:.3f}, max {:.3f})\n", ratios[ratios.size() / 2],
             ratios.front(), ratios.back());
  return 0;
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) { return floorproof::Main(argc, argv); }
