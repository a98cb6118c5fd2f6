// SPDX-License-Identifier: Apache-2.0
// Campaigns: in worker processes of this machine, or wherever a Python pool has its workers.

#include "base/interrupt.h"
#include "base/watched_call.h"
#include "python/bindings/host.h"
#include "python/bindings/modules.h"
#include "report/campaign_words.h"
#include "run/campaign/campaign_merge.h"
#include "run/campaign/campaign_store.h"
#include "run/campaign/drive_campaign.h"
#include "run/campaign/episode_maker.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using namespace nb::literals;

class Observer final : public CampaignObserver {
 public:
  Observer(nb::object warn, nb::object progress)
      : warn_(std::move(warn)), progress_(std::move(progress)) {}
  void OnWarning(const std::string& line) override {
    if (!warn_.is_none()) InPython("the warning callback", [&] { Ask(warn_, line); });
  }
  void OnProgress(const CampaignProgress& p) override {
    if (progress_.is_none()) return;
    InPython("the progress callback", [&] { Ask(progress_, p.done, p.total); });
  }

 private:
  nb::object warn_, progress_;
};

// What a Python pool is called with: its run(calls) asks for jobs and hands in answers.
struct Calls {
  Lent<const PoolCallbacks> lent;
};

nb::object Next(const Calls& calls) {
  const std::optional<Job> job = calls.lent->next();
  return job ? nb::object(nb::int_(*job)) : nb::object(nb::none());
}

std::string Text(const nb::bytes& bytes) { return {bytes.c_str(), bytes.size()}; }

// Why it ended; what the command line would say of it, and its exit status.
nb::dict Ended(const CampaignOutcome& outcome, const fs::path& folder) {
  std::vector<std::string> lines;
  SayCampaign(outcome, folder,
              {.listener = [&](const std::string& line) { lines.push_back(line); }});
  nb::dict out;
  out["end"] = std::string(WhyEnded(outcome.run.end));
  out["lines"] = lines;
  out["status"] = CampaignExitStatus(outcome);
  return out;
}

nb::dict RunCampaignInto(const ScenarioFile& file, std::uint64_t n,
                         std::optional<std::pair<std::uint64_t, std::uint64_t>> shard, int jobs,
                         bool resume, bool retry_errors, bool fail_fast,
                         std::optional<double> time_limit_s, const fs::path& folder,
                         nb::object pool, nb::object warn, nb::object progress) {
  CampaignRequest request{.episodes = n,
                          .jobs = jobs,
                          .resume = resume,
                          .retry_errors = retry_errors,
                          .fail_fast = fail_fast,
                          .time_limit_s = time_limit_s};
  if (shard) request.shard = EpisodeRange{shard->first, shard->second};
  if (!pool.is_none())
    request.pool = [&pool](const PoolCallbacks& callbacks) {
      try {
        InPython("the pool", [&] {
          Lend<Calls>(callbacks, [&](const nb::object& calls) { Ask(pool.attr("run"), calls); });
        });
      } catch (const Interruption&) {
        // The campaign asks, too, and ends in good order; then it is raised.
      }
    };
  Observer observer(std::move(warn), std::move(progress));
  std::optional<CampaignOutcome> outcome;
  WithoutGil([&] {
    outcome.emplace(DriveCampaign(file, request, folder, &observer));
    return 0;
  });
  return Ended(*outcome, folder);
}

nb::dict MergeInto(const std::vector<std::string>& shards, const fs::path& out) {
  std::optional<MergeOutcome> outcome;
  WithoutGil([&] {
    outcome.emplace(MergeCampaigns(shards, out));
    return 0;
  });
  return Ended(*outcome, out);
}

// What the database says of its campaign. Throws InputError unless the file passes the check that
// every command makes.
nb::dict CheckedAbout(const fs::path& file) {
  const CampaignAbout about =
      WithoutGil([&] { return CampaignStore::Open(file, /*write=*/false).about(); });
  nb::dict out;
  out["campaign"] = about.id;
  out["scenario"] = about.scenario;
  out["versions"] = about.versions;
  return out;
}

// Drives episodes where they are sent: the scenario as it was packed, and what follows from it.
class Worker {
 public:
  explicit Worker(std::shared_ptr<ScenarioFile> file) : file_(std::move(file)), maker_(*file_) {
    DriveForOthers();
  }
  nb::bytes Answer(Job job) {
    const std::string line = WithoutGil([&] { return maker_.Answer(job); });
    return nb::bytes(line.data(), line.size());
  }

 private:
  std::shared_ptr<ScenarioFile> file_;
  EpisodeMaker maker_;
};

}  // namespace

void BindCampaign(nb::module_& m) {
  nb::class_<Calls>(m, "PoolCalls")
      .def("next", &Next)
      .def(
          "done",
          [](const Calls& c, Job job, const nb::bytes& answer) { c.lent->done(job, Text(answer)); },
          "job"_a, "answer"_a)
      .def(
          "crashed",
          [](const Calls& c, Job job, const std::string& how) { c.lent->crashed(job, how); },
          "job"_a, "how"_a)
      .def(
          "hung", [](const Calls& c, Job job, const std::string& why) { c.lent->hung(job, why); },
          "job"_a, "why"_a)
      .def("stop", [](const Calls& c) { return c.lent->stop(); });
  m.def("drive_campaign", &RunCampaignInto, "file"_a, "n"_a, "shard"_a.none(), "jobs"_a, "resume"_a,
        "retry_errors"_a, "fail_fast"_a, "time_limit_s"_a.none(), "folder"_a, "pool"_a.none(),
        "warn"_a.none(), "progress"_a.none());
  m.attr("MOST_EPISODES") = kMostEpisodes;
  m.def("begin_call", &BeginCall, "until_s"_a, "why"_a);
  m.def("end_call", &EndCall);
  m.def("end_where_overdue", &EndWhereOverdue);
  m.def("merge", &MergeInto, "shards"_a, "out"_a);
  m.def("checked_about", &CheckedAbout, "file"_a);
  nb::class_<Worker>(m, "Worker")
      .def(nb::init<std::shared_ptr<ScenarioFile>>(), "file"_a)
      .def("answer", &Worker::Answer, "job"_a);
}

}  // namespace floorproof
