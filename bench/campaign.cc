// SPDX-License-Identifier: Apache-2.0
// A campaign against the engine alone, in one run:
//   speed: steps a second of a campaign on one worker against a bare mj_step loop over the same
//     controls; start-up, storage and statistics as a share of the wall time;
//   scaling: two workers against one, beside the bare loop's own scaling in two processes;
//   memory: the parent's peak after few and after many tiny episodes.
//   bench_campaign [SCENARIO] [EPISODES] [MANY_TINY_EPISODES]
#include "run/campaign/campaign.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "base/interrupt.h"
#include "bench/bare_loop.h"
#include "env/scene/models_folder.h"
#include "run/campaign/campaign_about.h"
#include "run/campaign/campaign_files.h"
#include "run/episode/make_plan.h"
#include "run/scenario/agents.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kRounds = 3;

double Since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

struct Timed {
  double wall_s = 0, drive_s = 0, steps = 0;
};

// All of what the command does but the films.
Timed RunOnce(const ScenarioFile& file, std::uint64_t n, int jobs, const fs::path& folder) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  const auto begin = Clock::now();
  Timed timed;
  CampaignStore store = CampaignStore::Create(folder / "campaign.sqlite", DescribeCampaign(file));
  const auto drive_begin = Clock::now();
  CampaignOptions options;
  options.end = n;
  options.jobs = jobs;
  const CampaignRun run = RunCampaign(file, store, options);
  timed.drive_s = Since(drive_begin);
  WriteSummaryFiles(store, file, run, folder);
  timed.wall_s = Since(begin);
  const double timestep_s = file.Read().world.physics.timestep_s;
  for (const Variant& variant : file.variants())
    store.ForEach(variant.name, [&](const EpisodeRow& row) {
      timed.steps += row.metric(&Metrics::duration_s).value_or(0) / timestep_s;
    });
  return timed;
}

double Median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

// Bare loops in so many processes at once, each so many times; steps a second of all together.
double BareRate(const mjModel* model, const Notes& notes, int steps_a_control, int processes,
                std::uint64_t times) {
  const double steps = static_cast<double>(notes.controls().size()) /
                       static_cast<double>(model->nu) * steps_a_control * processes *
                       static_cast<double>(times);
  const auto begin = Clock::now();
  for (int i = 0; i < processes; ++i)
    if (fork() == 0) {
      for (std::uint64_t k = 0; k < times; ++k) BareLoop(model, notes, steps_a_control);
      _exit(0);
    }
  while (wait(nullptr) > 0) {
  }
  return steps / Since(begin);
}

double PeakMb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

int Main(int argc, char** argv) {
  const fs::path scenario =
      argc > 1 ? argv[1] : (ModelsFolder() / "scenarios" / "demo_beluga.yaml").string();
  const std::uint64_t n = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 10;
  const std::uint64_t many = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 0;
  const fs::path folder = fs::temp_directory_path() / fmt::format("bench_campaign_{}", getpid());
  const HoldInterrupts hold;

  const ScenarioFile file(scenario);
  Scenario s = file.Read();
  const PlanResult plan = MakePlan(s);
  const Scene scene = BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start);
  const Scene whole =
      BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start, WallSet::kAll);
  const auto steps_a_control =
      static_cast<int>(std::lround(1 / (s.world.physics.timestep_s * s.spec.episode.control_hz)));
  Notes notes;
  Agents agents = MakeAgents(s.spec);
  RunEpisode(s, agents, scene, plan, &notes);

  // Taken by turns, so that a machine that slows down slows both.
  std::vector<double> speed, outside, scaling;
  for (int round = 0; round < kRounds; ++round) {
    const double bare_1 = BareRate(whole.model.get(), notes, steps_a_control, 1, n);
    const Timed one = RunOnce(file, n, 1, folder);
    const double bare_2 = BareRate(whole.model.get(), notes, steps_a_control, 2, n / 2);
    const Timed two = RunOnce(file, n, 2, folder);
    const double rate_1 = one.steps / one.wall_s, rate_2 = two.steps / two.wall_s;
    speed.push_back(rate_1 / bare_1);
    outside.push_back(1 - one.drive_s / one.wall_s);
    scaling.push_back(rate_2 / rate_1 / (bare_2 / bare_1));
    fmt::print("  one worker {:.1f} k steps/s, bare mj_step {:.1f}; two x{:.2f}, bare x{:.2f}\n",
               rate_1 / 1e3, bare_1 / 1e3, rate_2 / rate_1, bare_2 / bare_1);
  }
  fmt::print("{} episodes of {}, medians of {} rounds\n", n, scenario.stem().string(), kRounds);
  fmt::print("one worker: {:.3f} of the bare loop; outside the drives {:.1f} %\n", Median(speed),
             100 * Median(outside));
  fmt::print("two workers: {:.3f} of the bare loop's scaling\n", Median(scaling));
  if (many > 0) {
    const ScenarioFile tiny(scenario, {{"drive", "none"}});
    RunOnce(tiny, 1000, 2, folder);
    const double few_mb = PeakMb();
    const Timed timed = RunOnce(tiny, many, 2, folder);
    fmt::print(
        "memory of the parent: {:.0f} MB after 1,000 tiny episodes, {:.0f} MB after {} ({:.0f} a "
        "second)\n",
        few_mb, PeakMb(), many, static_cast<double>(many) / timed.wall_s);
  }
  fs::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) { return floorproof::Main(argc, argv); }
