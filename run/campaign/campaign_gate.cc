// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "run/scenario/chance.h"

namespace floorproof {

void GateParams::Visit(ParamVisitor& v) {
  v("metric", metric,
    {"any_failure", "veer_off", "stuck", "roll_over", "bounce_back", "not_success"},
    "episodes counted: with a failure of that mode, with any, or that are no success (timeouts "
    "and episodes without a plan too)");
  v("max_rate", max_rate, Between(0, 1), "the rate that must be proved to be below this");
  v("confidence", confidence, Between(0.5, 1), "of either verdict, one-sided");
  v("mode", mode, {"fixed", "sequential", "rare"},
    "fixed: judged once, at the last episode; sequential: as soon as the evidence is enough; rare: "
    "by floorproof rare, whose verdict rests on its sampler");
  v("min_n", min_n, Between(1, 1e8), "sequential: fewest episodes that a verdict stands on");
  v("max_n", max_n, Between(1, 1e8), "most episodes judged; none: the campaign's -n");
}

void GateState::Add(bool failed, const std::string& result) {
  if (decided()) return;
  repetition_.Add(result);
  if (repetition_.n() == 1) first_failed_ = failed;
  if (repetition_.repeated()) {
    ++held_;
    return;
  }
  for (; held_ > 0; --held_) gate_.Add(first_failed_);
  gate_.Add(failed);
}

void GateState::End() {
  ended_ = true;
  if (!repetition_.repeated()) gate_.End();
}

GateReport GateState::Report() const {
  GateReport report = gate_.Report();
  if (!repetition_.repeated() || report.verdict != GateVerdict::kUndecided) return report;
  report.final = decided();
  report.text = fmt::format(
      "{} episodes came out the same, to the last bit: one episode, repeated, which says nothing "
      "of how often; {}",
      repetition_.n(), kHowToDiffer);
  return report;
}

std::optional<CampaignGate> CampaignGate::Read(const ConfigNode& node, std::uint64_t n,
                                               bool driven) {
  if (node.IsNull()) return std::nullopt;
  CampaignGate gate;
  ReadParams(node, "gate.", [&](ParamVisitor& v) { gate.params_.Visit(v); });
  const GateParams& p = gate.params_;
  if (!driven && p.metric != "not_success")
    throw InputError(node.mark, "gate.metric", p.metric,
                     "must be not_success: without physics (drive: none) nothing can fail");
  if (p.mode == "rare")
    throw InputError(node.mark, "gate.mode", p.mode,
                     "is judged by floorproof rare; a campaign's is fixed or sequential (--set "
                     "gate.mode=fixed, or gate=none)");
  if (p.max_n && *p.max_n != std::floor(*p.max_n))
    throw InputError(node.mark, "gate.max_n", FormatDouble(*p.max_n), "must be a whole number");
  const double most = std::min(p.max_n.value_or(1e8), static_cast<double>(n));
  gate.settings_ = {p.mode == "fixed" ? GateMode::kFixed : GateMode::kSequential, p.max_rate,
                    p.confidence, p.mode == "fixed" ? 1 : p.min_n, static_cast<int>(most)};
  try {
    CheckGate(gate.settings_);
  } catch (const InputError& e) {
    std::string why = e.what();
    if (!p.max_n && why.starts_with("max_n")) {  // not written: it is the command line's
      why.replace(0, 5, "-n");
      why += "; for rates without a verdict: --set gate=none";
    }
    throw InputError(node.mark, "gate", "", why);
  }
  return gate;
}

bool CampaignGate::Judges(const EpisodeRow& row) const { return CountsBy(params_.metric, row); }

bool CountsBy(std::string_view metric, const EpisodeRow& row) {
  return row.counts() || (row.outcome == "not_planned" && metric == kNotSuccess);
}

bool FailsBy(std::string_view metric, const EpisodeRow& row) {
  if (metric == "any_failure") return row.any_failure();
  if (metric == kNotSuccess) return row.outcome != "success";
  for (std::size_t m = 0; m < row.events_of.size(); ++m)
    if (metric == Name(static_cast<FailureMode>(m))) return row.events_of[m] > 0;
  return false;
}

GateVerdict Overall(const std::vector<GateState>& gates) {
  const auto is = [](GateVerdict verdict) {
    return [verdict](const GateState& gate) { return gate.verdict() == verdict; };
  };
  if (std::ranges::any_of(gates, is(GateVerdict::kFailed))) return GateVerdict::kFailed;
  if (std::ranges::all_of(gates, is(GateVerdict::kPassed))) return GateVerdict::kPassed;
  return GateVerdict::kUndecided;
}

}  // namespace floorproof
