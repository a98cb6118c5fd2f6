// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign.h"

#include <algorithm>

#include "base/interrupt.h"
#include "run/campaign/episode_maker.h"
#include "run/campaign/worker_pool.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kBatch = 256;  // rows, or what half a second brings
constexpr double kBatch_s = 0.5;
constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// What the prefix needs of a row that came early.
struct Brief {
  bool counts = false, error = false, any_failure = false;
  std::optional<bool> gated;  // whether the gate counts it as a failure; none: it does not count
  std::array<bool, kNumFailureModes> failed{};
  std::string result;  // its hash
};

// One variant's ids: which are done, and what the prefix says.
class PrefixTally {
 public:
  PrefixTally(std::uint64_t begin, const std::optional<CampaignGate>& gate) : gate_(gate) {
    progress_.prefix = begin;
    if (gate) progress_.gate = gate->Start();
  }

  void Add(const EpisodeRow& row) {
    Brief brief;
    brief.counts = row.counts();
    brief.error = row.outcome == "error";
    for (std::size_t m = 0; m < brief.failed.size(); ++m) brief.failed[m] = row.events_of[m] > 0;
    brief.any_failure = row.any_failure();
    if (gate_ && gate_->Judges(row)) brief.gated = gate_->Fails(row);
    if (!brief.error) brief.result = row.ResultHash();
    early_.emplace(row.episode, brief);
    // A decision is the prefix's, whatever comes later.
    for (auto next = early_.find(progress_.prefix); next != early_.end() && !decided();
         next = early_.find(progress_.prefix)) {
      Take(next->second);
      early_.erase(next);
    }
  }

  // All ids are done: there is nothing to wait for.
  void End() {
    if (progress_.gate) progress_.gate->End();
  }

  bool decided() const { return progress_.gate && progress_.gate->decided(); }
  const VariantProgress& progress() const { return progress_; }
  // The prefix's first that failed: one beyond it may be there by chance alone.
  std::optional<std::uint64_t> first_failure() const { return first_failure_; }

 private:
  void Take(const Brief& brief) {
    ++progress_.prefix;
    progress_.errors += brief.error;
    if (brief.gated) progress_.gate->Add(*brief.gated, brief.result);
    if (!brief.error) progress_.repetition.Add(brief.result);
    if (!brief.counts) return;
    ++progress_.n;
    for (std::size_t m = 0; m < brief.failed.size(); ++m) progress_.failures[m] += brief.failed[m];
    progress_.any_failure += brief.any_failure;
    if (brief.any_failure && !first_failure_) first_failure_ = progress_.prefix - 1;
  }

  const std::optional<CampaignGate>& gate_;
  VariantProgress progress_;
  std::optional<std::uint64_t> first_failure_;
  std::map<std::uint64_t, Brief> early_;  // done, beyond the prefix
};

// The campaign while it is driven.
class CampaignDrive {
 public:
  CampaignDrive(const ScenarioFile& file, CampaignStore& store, const CampaignOptions& options,
                CampaignObserver* observer)
      : file_(file),
        store_(store),
        options_(options),
        observer_(observer),
        maker_(file, options.replays != nullptr) {
    const auto& variants = file.variants();
    total_ = variants.size() * (options.end - options.begin);
    for (const Variant& variant : variants) {
      tallies_.emplace_back(options.begin, options.gate);
      there_.push_back(store.Episodes(variant.name));
    }
    job_ = options.begin * variants.size();
  }

  CampaignRun Run() {
    // Rows of earlier runs, judged as if they had just come.
    for (std::size_t v = 0; v < tallies_.size(); ++v) {
      store_.SetExtraFrom(file_.variants()[v].name, options_.end);
      store_.ForEach(file_.variants()[v].name, [&](const EpisodeRow& row) {
        if (row.episode < options_.begin) return;
        ++done_;
        Judge(v, row);
      });
    }
    PoolCallbacks callbacks;
    callbacks.work = [this](Job job) { return maker_.Answer(job); };
    callbacks.next = [this] { return Next(); };
    callbacks.done = [this](Job, std::string answer) {
      EpisodeRow row = FromLine(answer);
      if (options_.replays) options_.replays->Take(row);
      row.replay.clear();
      Take(row);
    };
    callbacks.crashed = [this](Job job, const std::string& how) { Refuse(job, "crashed: " + how); };
    callbacks.hung = [this](Job job, const std::string& why) { Refuse(job, why); };
    callbacks.stop = [this] { return Stop(); };
    if (options_.pool)
      options_.pool(callbacks);
    else
      RunInWorkers(options_.jobs, callbacks);
    Flush();
    return Finish();
  }

 private:
  // The next id that is not there; all variants of an episode together.
  std::optional<Job> Next() {
    if (ended_) return std::nullopt;
    for (; job_ < options_.end * tallies_.size(); ++job_) {
      const std::size_t v = job_ % tallies_.size();
      const std::uint64_t episode = job_ / tallies_.size();
      if (tallies_[v].decided()) continue;
      if (episode > fail_at_) return std::nullopt;
      if (std::ranges::binary_search(there_[v], episode)) continue;
      return job_++;
    }
    return std::nullopt;
  }

  void Take(const EpisodeRow& row) {
    const auto& variants = file_.variants();
    const auto v = static_cast<std::size_t>(
        std::ranges::find(variants, row.variant, &Variant::name) - variants.begin());
    batch_.push_back(row);
    ++done_;
    ++done_now_;
    Judge(v, row);
    if (batch_.size() >= kBatch) Flush();
  }

  void Refuse(Job job, const std::string& why) {
    const auto [variant, episode] = maker_.Of(job);
    Take(maker_.Refused(variant, episode, why));
  }

  // Whether this row ends the campaign, once all before it are done.
  void Judge(std::size_t v, const EpisodeRow& row) {
    tallies_[v].Add(row);
    if (!options_.fail_fast) return;
    fail_at_ = std::min(fail_at_, tallies_[v].first_failure().value_or(kNone));
  }

  // Asked between answers.
  bool Stop() {
    if (Since(flushed_) > kBatch_s) {
      Flush();
      if (observer_) observer_->OnProgress(Progress());
    }
    if (Interrupted()) ended_ = CampaignEnd::kInterrupted;
    if (options_.time_limit_s && Since(start_) > *options_.time_limit_s)
      ended_ = CampaignEnd::kTimeLimit;
    const auto all = [&](auto&& is) { return std::ranges::all_of(tallies_, is); };
    if (all([](const PrefixTally& t) { return t.decided(); })) ended_ = CampaignEnd::kGateDecided;
    if (fail_at_ != kNone &&
        all([&](const PrefixTally& t) { return t.decided() || t.progress().prefix > fail_at_; }))
      ended_ = CampaignEnd::kFailFast;
    return ended_.has_value();
  }

  void Flush() {
    store_.Add(batch_);
    batch_.clear();
    flushed_ = Clock::now();
  }

  CampaignProgress Progress() {
    shown_.clear();
    for (const PrefixTally& tally : tallies_) shown_.push_back(tally.progress());
    return {shown_, done_, total_, done_now_, Since(start_)};
  }

  CampaignRun Finish() {
    Stop();
    CampaignRun run;
    // Neither a limit nor Ctrl-C ends what is done.
    bool complete = true;
    for (PrefixTally& tally : tallies_) {
      if (tally.progress().prefix >= options_.end) tally.End();
      complete &= tally.decided() || tally.progress().prefix >= options_.end;
    }
    const bool cut = ended_ == CampaignEnd::kTimeLimit || ended_ == CampaignEnd::kInterrupted;
    if (ended_ && !(cut && complete)) run.end = *ended_;
    if (!ended_ && !complete) run.end = CampaignEnd::kMissing;
    for (std::size_t v = 0; v < tallies_.size(); ++v) {
      // What lies beyond is kept and not judged: early arrivals would bias it.
      std::uint64_t from = tallies_[v].progress().prefix;
      if (run.end == CampaignEnd::kFailFast) from = std::min(from, fail_at_ + 1);
      const std::string& name = file_.variants()[v].name;
      store_.SetExtraFrom(name, from);
      run.variants.push_back(tallies_[v].progress());
      if (run.end != CampaignEnd::kFailFast) continue;
      // What is reported is what stays: a variant may have been ahead of the one that failed.
      PrefixTally kept(options_.begin, options_.gate);
      store_.ForEach(name, [&](const EpisodeRow& row) { kept.Add(row); });
      run.variants.back() = kept.progress();
    }
    store_.Settle();
    if (observer_) observer_->OnProgress(Progress());
    return run;
  }

  const ScenarioFile& file_;
  CampaignStore& store_;
  const CampaignOptions& options_;
  CampaignObserver* observer_;
  EpisodeMaker maker_;
  std::vector<PrefixTally> tallies_;
  std::vector<std::vector<std::uint64_t>> there_;
  std::vector<EpisodeRow> batch_;
  std::vector<VariantProgress> shown_;
  Job job_ = 0;
  std::uint64_t done_ = 0, done_now_ = 0, total_ = 0;
  std::uint64_t fail_at_ = kNone;
  std::optional<CampaignEnd> ended_;
  Clock::time_point start_ = Clock::now(), flushed_ = Clock::now();
};

}  // namespace

std::string_view WhyEnded(CampaignEnd end) {
  switch (end) {
    case CampaignEnd::kComplete:
      return "all episodes are done";
    case CampaignEnd::kGateDecided:
      return "more episodes would not change the gate's verdict";
    case CampaignEnd::kFailFast:
      return "an episode failed (--fail-fast)";
    case CampaignEnd::kTimeLimit:
      return "the time limit is reached (--resume goes on)";
    case CampaignEnd::kInterrupted:
      return "interrupted (--resume goes on)";
    case CampaignEnd::kMissing:
      return "episodes are missing";
  }
  return "?";
}

CampaignRun RunCampaign(const ScenarioFile& file, CampaignStore& store,
                        const CampaignOptions& options, CampaignObserver* observer) {
  return CampaignDrive(file, store, options, observer).Run();
}

}  // namespace floorproof
