// SPDX-License-Identifier: Apache-2.0
#include "run/rare/rare_gate.h"

#include <fmt/format.h>

#include "base/quantity.h"
#include "stats/binomial.h"

namespace floorproof {

std::optional<RareGate> RareGate::Read(const ConfigNode& node, const std::string& mode) {
  if (node.IsNull()) return std::nullopt;
  RareGate gate;
  ReadParams(node, "gate.", [&](ParamVisitor& v) { gate.params_.Visit(v); });
  const GateParams& p = gate.params_;
  if (p.mode != "rare") return std::nullopt;
  if (p.metric != mode)
    throw InputError(node.mark, "gate.metric", p.metric, "must be what --mode asks for, " + mode);
  if (!(p.max_rate > 0 && p.max_rate < 1))
    throw InputError(node.mark, "gate.max_rate", FormatDouble(p.max_rate), "must be in (0, 1)");
  for (const char* key : {"min_n", "max_n"})
    if (const ConfigNode* written = node.Find(key))
      throw InputError(written->mark, std::string("gate.") + key, written->scalar,
                       "is not for mode: rare, whose drives --max-n limits");
  return gate;
}

RareVerdict RareGate::Judge(const RareEstimate& e, std::uint64_t errors) const {
  const double limit = params_.max_rate;
  if (errors > 0)
    return {GateVerdict::kUndecided, false,
            fmt::format("undecided: {} had no outcome", CountText(errors, "drive"))};
  // Two ways to pass, and two to fail: each has half of what may be wrong.
  const double each = (1 + params_.confidence) / 2;
  const double most = ClopperPearsonUpper(e.nominal_failures, e.nominal_draws, each);
  const std::optional<Interval> rate = e.answer == RareAnswer::kEstimate
                                           ? std::optional(IntervalOf(e, params_.confidence))
                                           : std::nullopt;
  const bool surely_more = e.confidence >= params_.confidence && e.lower_bound > limit;
  const bool fails = surely_more || (rate && rate->lower > limit);
  const bool surely_less = most < limit;
  const bool passes = surely_less || (rate && rate->upper < limit);
  const auto say = [&](GateVerdict verdict, bool sampler, double bound, const char* side) {
    return RareVerdict{
        verdict, sampler,
        fmt::format("{}: {} {} {} at {}{}, the limit is {}", GateVerdictName(verdict),
                    params_.metric, side, PercentText(bound), PercentText(params_.confidence),
                    sampler ? ", resting on the sampler" : "", PercentText(limit))};
  };
  if (passes && fails)
    return {GateVerdict::kUndecided, true,
            "undecided: drives as they come and the sampler contradict each other"};
  if (surely_less) return say(GateVerdict::kPassed, false, most, "is at most");
  if (passes) return say(GateVerdict::kPassed, true, rate->upper, "is at most");
  if (surely_more) return say(GateVerdict::kFailed, false, e.lower_bound, "is at least");
  if (fails) return say(GateVerdict::kFailed, true, rate->lower, "is at least");
  if (rate)
    return {GateVerdict::kUndecided, true,
            fmt::format("undecided: {} may be {} to {}, the limit is {}", params_.metric,
                        PercentText(rate->lower), PercentText(rate->upper), PercentText(limit))};
  return {GateVerdict::kUndecided, false,
          fmt::format("undecided: {} is at most {} at {} by {} as they come, the limit is {}",
                      params_.metric, PercentText(most), PercentText(params_.confidence),
                      CountText(e.nominal_draws, "drive"), PercentText(limit))};
}

}  // namespace floorproof
