// SPDX-License-Identifier: Apache-2.0
// Control periods a second of an episode that is commanded from outside: one twist, a circle to go,
// no observation made. What Python adds to it is bench/gym_steps.py's to say, which calls this.
//   bench_stepped_episode SCENARIO PERIODS VX WZ [KEY=VALUE ...]
#include <fmt/format.h>

#include <cstdlib>
#include <vector>

#include "bench/cpu_time.h"
#include "controllers/twist_tracker.h"
#include "run/episode/episode.h"
#include "run/episode/free_navigator.h"
#include "run/episode/make_plan.h"
#include "run/scenario/agents.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

class Circling final : public TwistTracker {
 public:
  explicit Circling(const BodyTwist& twist) : TwistTracker(true), twist_(twist) {}

 private:
  BodyTwist Twist(const Situation&) override { return twist_; }
  BodyTwist twist_;
};

int Main(int argc, char** argv) {
  if (argc < 5) return 2;
  std::vector<Override> overrides;
  for (int i = 5; i < argc; ++i) {
    const std::string set = argv[i];
    const auto equals = set.find('=');
    overrides.push_back({set.substr(0, equals), set.substr(equals + 1)});
  }
  const Scenario s = ReadScenario(argv[1], overrides);
  const int periods = std::atoi(argv[2]);
  Agents agents = MakeAgents(s.spec);
  agents.tracker = std::make_unique<Circling>(BodyTwist{std::atof(argv[3]), 0, std::atof(argv[4])});
  const PlanResult plan = MakePlan(s);
  const Scene scene = BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start);
  SteppedEpisode episode(s, std::move(agents), scene, plan,
                         std::make_unique<FreeNavigator>(s.world.start));
  const double begin_s = CpuSeconds();
  for (int i = 0; i < periods; ++i)
    if (const auto ended = episode.Advance()) {
      fmt::print(stderr, "ended after {} periods: {}\n", i, Name(*ended));
      return 1;
    }
  const Pose2 X_WB = episode.view().sample.X_WB();
  fmt::print("{:.9f} {} {}\n", CpuSeconds() - begin_s, X_WB.x_m, X_WB.y_m);
  return 0;
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) { return floorproof::Main(argc, argv); }
