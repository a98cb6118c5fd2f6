// SPDX-License-Identifier: Apache-2.0
// A scenario's `gate`: the rate of one metric that a campaign must prove to be below a bound.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/params.h"
#include "run/campaign/episode_row.h"
#include "run/campaign/repetition.h"
#include "stats/gate.h"

namespace floorproof {

// The metric of which episodes without a plan are failures, too.
inline constexpr std::string_view kNotSuccess = "not_success";

struct GateParams {
  std::string metric = "any_failure";  // a mode, any_failure, not_success
  double max_rate = 0.05, confidence = 0.95;
  std::string mode = "fixed";
  int min_n = 1;
  std::optional<double> max_n;  // none: the campaign's -n
  void Visit(ParamVisitor& v);
};

// Whether the episode counts in rates of this metric: no error does; one without a plan does in
// not_success alone.
bool CountsBy(std::string_view metric, const EpisodeRow& row);
// Whether the episode fails by this metric: a mode, any_failure or not_success.
bool FailsBy(std::string_view metric, const EpisodeRow& row);

// What the gate says of a prefix of one variant's episodes.
class GateState {
 public:
  GateState(const GateParams& params, const GateSettings& settings)
      : params_(params), gate_(settings), most_(static_cast<std::uint64_t>(settings.max_n)) {}
  // The next episode, and its EpisodeRow::ResultHash. While no two differ they count as one: the
  // first alone is evidence.
  void Add(bool failed, const std::string& result);
  void End();  // no further episode comes
  // No further episode changes the verdict.
  bool decided() const { return gate_.final() || ended_ || repetition_.n() >= most_; }
  GateVerdict verdict() const { return gate_.verdict(); }
  GateReport Report() const;
  const GateParams& params() const { return params_; }

 private:
  GateParams params_;
  Gate gate_;
  std::uint64_t most_;  // episodes that are judged
  Repetition repetition_;
  bool first_failed_ = false, ended_ = false;
  std::uint64_t held_ = 0;  // repetitions of the first, which the gate was not told
};

class CampaignGate {
 public:
  // `node`: the scenario's key `gate`; null: no gate. `n`: the campaign's episodes; `driven`:
  // through physics. Throws InputError, also where not even a campaign without a failure could
  // pass, or where nothing that is driven nowhere could fail.
  static std::optional<CampaignGate> Read(const ConfigNode& node, std::uint64_t n, bool driven);
  // Whether the episode counts: what the tool broke does not, and what has no plan only as no
  // success.
  bool Judges(const EpisodeRow& row) const;
  bool Fails(const EpisodeRow& row) const { return FailsBy(params_.metric, row); }
  bool fixed() const { return settings_.mode == GateMode::kFixed; }
  GateState Start() const { return {params_, settings_}; }

 private:
  GateParams params_;
  GateSettings settings_;
};

// Failed when one is, passed when all are.
GateVerdict Overall(const std::vector<GateState>& gates);

}  // namespace floorproof
