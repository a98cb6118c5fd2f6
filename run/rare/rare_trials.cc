// SPDX-License-Identifier: Apache-2.0
#include "run/rare/rare_trials.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "base/interrupt.h"
#include "run/campaign/worker_pool.h"
#include "run/episode/records.h"

namespace floorproof {

const Variant& RareTrials::TrialVariant() {
  static const Variant kTrial{"trial", {}};
  return kTrial;
}

RareTrials::RareTrials(EpisodeMaker& maker, const RareCoordinates& coordinates,
                       const RareScore& score, CampaignStore& store, int jobs,
                       std::function<void(const RareProgress&)> progress)
    : maker_(maker),
      coordinates_(coordinates),
      score_(score),
      store_(store),
      jobs_(jobs),
      progress_(std::move(progress)) {
  store_.ForEach(TrialVariant().name,
                 [&](const EpisodeRow& row) { known_[row.episode] = Brief(row); });
}

RareTrials::Known RareTrials::Brief(const EpisodeRow& row) const {
  return {score_.Of(row), row.drawn, !row.counts(), row.message};
}

std::string RareTrials::DrawnText(const Trial& trial) const {
  return DrawnJson(coordinates_.AsSet(trial)).dump();
}

EpisodeRow RareTrials::RowOf(const Trial& trial) const {
  const std::string drawn = DrawnText(trial);
  for (const auto& [number, known] : known_)
    if (known.drawn == drawn && number < next_)
      if (auto row = store_.Find(TrialVariant().name, number)) return *std::move(row);
  throw InternalError("a trial that was driven has no row: " + drawn);
}

void RareTrials::Keep() {
  try {
    store_.Add(batch_);
  } catch (const std::runtime_error& e) {
    throw InternalError(std::string(e.what()) +
                        "; missing: rare.json, and drives that are not in trials.sqlite; --resume "
                        "goes on");
  }
  batch_.clear();
}

// In processes that are forked for this batch alone: they know its trials, and the plan that this
// process has made.
void RareTrials::Drive(std::span<const Trial> trials, std::span<const std::string> drawn,
                       const std::vector<std::size_t>& missing) {
  using Clock = std::chrono::steady_clock;
  constexpr double kBatch_s = 0.5;
  auto kept = Clock::now();
  std::size_t next = 0;
  const auto take = [&](Job job, EpisodeRow row) {
    row.variant = TrialVariant().name;
    row.episode = next_ + job;
    row.drawn = drawn[job];
    const Known& known = known_[row.episode] = Brief(row);
    ++shown_.done;
    ++shown_.driven;
    shown_.failures += known.result.failed;
    batch_.push_back(std::move(row));
  };
  const auto refuse = [&](Job job, const std::string& why) {
    take(job, maker_.Refused(TrialVariant(), 0, coordinates_.DrawnAt(trials[job].u), why));
  };
  PoolCallbacks callbacks;
  callbacks.work = [&](Job job) {
    const Trial& trial = trials[job];
    return ToLine(maker_.RunDrawn(TrialVariant(), trial.noise, coordinates_.DrawnAt(trial.u)));
  };
  callbacks.next = [&]() -> std::optional<Job> {
    if (next == missing.size()) return std::nullopt;
    return missing[next++];
  };
  callbacks.done = [&](Job job, const std::string& answer) { take(job, FromLine(answer)); };
  callbacks.crashed = [&](Job job, const std::string& how) { refuse(job, "crashed: " + how); };
  callbacks.hung = refuse;
  callbacks.stop = [&] {
    if (std::chrono::duration<double>(Clock::now() - kept).count() > kBatch_s) {
      Keep();
      kept = Clock::now();
      progress_(shown_);
    }
    return Interrupted();
  };
  RunInWorkers(std::min(jobs_, static_cast<int>(missing.size())), callbacks);
  Keep();
  progress_(shown_);
  if (Interrupted()) {
    store_.Settle();
    throw Interruption();
  }
}

std::vector<TrialResult> RareTrials::Evaluate(std::span<const Trial> trials) {
  std::vector<std::string> drawn;
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    drawn.push_back(DrawnText(trials[i]));
    if (const auto known = known_.find(next_ + i); known == known_.end())
      missing.push_back(i);
    else
      shown_.failures += known->second.result.failed;
  }
  shown_.done = next_ + trials.size() - missing.size();
  if (!missing.empty()) Drive(trials, drawn, missing);
  std::vector<TrialResult> results;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const Known& known = known_.at(next_ + i);
    if (known.drawn != drawn[i])
      throw InternalError(
          fmt::format("trial {} was driven with other draws than its seed gives here: it was begun "
                      "on another type of machine, or the file was changed",
                      next_ + i));
    results.push_back(known.result);
    if (known.error && errors_++ == 0) first_error_ = known.message;
  }
  next_ += trials.size();
  return results;
}

}  // namespace floorproof
