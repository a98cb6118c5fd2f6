// SPDX-License-Identifier: Apache-2.0
#include "apps/campaign_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/quantity.h"
#include "base/usable_cores.h"
#include "run/scenario/override.h"
#include "stats/binomial.h"

namespace floorproof {
namespace {

std::optional<EpisodeRange> ReadEpisodes(const std::string& text) {
  if (text.empty()) return {};
  unsigned long long a = 0, b = 0;
  int used = 0;
  if (std::sscanf(text.c_str(), "%llu:%llu%n", &a, &b, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size())
    throw InputError({"--episodes", 0}, "", text,
                     "must be A:B, the first id and the one behind the last");
  return EpisodeRange{a, b};
}

std::string Text(const CampaignProgress& p, const std::vector<Variant>& variants) {
  const auto number = [](auto n) { return FixedText(static_cast<double>(n), 0); };
  std::string text = "  " + number(p.done) + " of " + CountText(p.total, "episode");
  if (p.done_now > 0) {
    const double rate = static_cast<double>(p.done_now) / p.elapsed_s;
    text += fmt::format(", {} a second, {} to go at most", FixedText(rate, 1),
                        TimeText(std::ceil(static_cast<double>(p.total - p.done) / rate)));
  }
  constexpr std::size_t kShown = 3;
  for (std::size_t v = 0; v < std::min(kShown, p.variants.size()); ++v) {
    const VariantProgress& at = p.variants[v];
    if (at.errors > 0) text += "; " + CountText(at.errors, "error");
    if (at.n == 0) continue;
    text += fmt::format("; {}{} of {} fail", p.variants.size() > 1 ? variants[v].name + ": " : "",
                        number(at.any_failure), number(at.n));
    text += at.repetition.repeated()
                ? " (one episode, repeated)"
                : fmt::format(
                      " (at most {})",
                      PercentText(ClopperPearsonUpper(static_cast<int>(at.any_failure),
                                                      static_cast<int>(at.n), kReportedConfidence),
                                  2));
  }
  return text;
}

}  // namespace

CampaignRequest RequestOf(const CampaignArguments& arguments) {
  return {.episodes = arguments.n,
          .shard = ReadEpisodes(arguments.episodes),
          .jobs = arguments.jobs > 0 ? arguments.jobs : UsableCores(),
          .resume = arguments.resume};
}

std::vector<Override> OverridesOf(const Globals& globals, const CampaignArguments& arguments) {
  std::vector<Override> overrides = globals.Overrides();
  if (arguments.seed >= 0) overrides.push_back({"seed", std::to_string(arguments.seed)});
  return overrides;
}

void CampaignLine::OnProgress(const CampaignProgress& progress) {
  if (line_.IsDue()) line_.Show(Text(progress, variants_));
}

}  // namespace floorproof
