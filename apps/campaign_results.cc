// SPDX-License-Identifier: Apache-2.0
#include "apps/campaign_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/failing_episodes.h"
#include "run/campaign/campaign_summary.h"

namespace floorproof {
namespace {

std::string_view Why(CampaignEnd end) {
  switch (end) {
    case CampaignEnd::kComplete:
      return "all episodes are done";
    case CampaignEnd::kGateDecided:
      return "the gate's verdict is final";
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

// Of the variant that has least.
std::string Unfinished(const CampaignRun& run, std::uint64_t asked) {
  std::uint64_t least = asked;
  for (const VariantProgress& variant : run.variants) least = std::min(least, variant.prefix);
  return fmt::format("{} of {} episodes stand without a gap: {}", least, asked, Why(run.end));
}

// To three digits, never downwards: a bound that is told too low would seem to pass a gate.
double RoundedUp(double value) {
  if (value <= 0) return value;
  const double unit = std::pow(10, std::floor(std::log10(value)) - 2);
  return std::ceil(value / unit - 1e-9) * unit;
}

void SayRates(const nlohmann::ordered_json& summary, const Globals& globals) {
  for (const auto& [name, variant] : summary["variants"].items()) {
    globals.Say(fmt::format(
        "{}: {} episodes, {} success, {} failure, {} timeout; {} errors, {} "
        "without a plan",
        name, variant["n"].get<int>(), variant["outcomes"]["success"].get<int>(),
        variant["outcomes"]["failure"].get<int>(), variant["outcomes"]["timeout"].get<int>(),
        variant["n_error"].get<int>(), variant["n_not_planned"].get<int>()));
    if (!variant["first_error"].is_null())
      globals.Say("  the first error: " + variant["first_error"].get<std::string>());
    for (const auto& [mode, rate] : variant["failures"].items()) {
      if (rate["n"] == 0) continue;
      const double lower = 100 * rate["lower"].get<double>(),
                   upper = 100 * rate["upper"].get<double>();
      const std::string text =
          rate["k"] == 0 ? fmt::format("none; at most {:.3g} %", RoundedUp(upper))
                         : fmt::format("{} = {:.3g} % ({:.3g} to {:.3g} %)", rate["k"].get<int>(),
                                       100 * rate["rate"].get<double>(), lower, upper);
      globals.Say(fmt::format("  {:<12} {}", mode, text));
    }
  }
}

int StatusOf(const CampaignRun& run, const std::vector<GateState>& gate) {
  const bool broken = std::ranges::any_of(run.variants, [](const auto& v) { return v.errors > 0; });
  if (broken) return kBroken;
  if (run.end == CampaignEnd::kFailFast) return kNotSuccess;
  if (!gate.empty()) {
    const GateVerdict verdict = Overall(gate);
    if (verdict == GateVerdict::kUndecided) return kGateUndecided;
    return verdict == GateVerdict::kPassed ? kDone : kNotSuccess;
  }
  return kDone;
}

}  // namespace

int SayResults(const ScenarioFile& file, const CampaignStore& store, const CampaignRun& run,
               const std::filesystem::path& folder, const Globals& globals) {
  const std::vector<Variant>& variants = file.variants();
  std::vector<GateState> gate;
  for (const VariantProgress& variant : run.variants)
    if (variant.gate) gate.push_back(*variant.gate);
  const bool whole = run.end == CampaignEnd::kComplete || run.end == CampaignEnd::kGateDecided;
  const CampaignEnding ending{whole ? "" : Unfinished(run, store.asked()),
                              run.end == CampaignEnd::kFailFast};
  const auto summary = WriteSummaryFiles(store, variants, gate, ending, file.name(), folder);
  globals.Result(summary);
  globals.Say(std::string(Why(run.end)) + "; results are in " + folder.string());
  SayRates(summary, globals);
  if (ListFailingEpisodes(store, variants, folder, globals) > 0 || variants.size() > 1)
    globals.Say(fmt::format("`floorproof report {}` shows them on a page", folder.string()));
  for (std::size_t v = 0; v < gate.size(); ++v)
    globals.Say(
        fmt::format("gate{}: {}", gate.size() > 1 ? " " + variants[v].name : "", gate[v].Text()));
  return StatusOf(run, gate);
}

}  // namespace floorproof
