// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/file_output.h"
#include "base/quantity.h"
#include "base/words.h"
#include "report/compare_page.h"
#include "run/scenario/chance.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// DIR or DIR:VARIANT; without a variant the only one.
struct Side {
  fs::path folder;
  std::string variant;
  CampaignStore store;

  std::string name() const { return folder.string() + ":" + variant; }
};

Side OpenSide(const std::string& text) {
  // A colon within the folder's own name is taken as such where that folder is there.
  std::error_code ignored;
  const auto colon = fs::exists(text, ignored) ? std::string::npos : text.rfind(':');
  const fs::path folder = text.substr(0, colon);
  Side side{folder, colon == std::string::npos ? "" : text.substr(colon + 1),
            CampaignStore::Open(folder / "campaign.sqlite", false)};
  const std::vector<std::string> variants = side.store.Variants();
  if (side.variant.empty() && variants.size() == 1) side.variant = variants.front();
  if (std::ranges::find(variants, side.variant) != variants.end()) return side;
  std::string known;
  for (const std::string& name : variants) known += (known.empty() ? "" : "; ") + name;
  throw InputError({folder.string(), 0}, "variant", side.variant, "must be one of: " + known);
}

std::string Signed(double value, double scale = 1) {
  return std::isfinite(value) ? (scale * value < 0 ? "" : "+") + NumberText(scale * value, 4) : "–";
}

std::string Significance(double p) {
  constexpr double kLeastShown = 1e-4;
  return p < kLeastShown ? "p < " + NumberText(kLeastShown) : "p = " + NumberText(p);
}

std::string Number(int n) { return FixedText(n, 0); }

// "+1.2 (-0.3 to +2.7)"
std::string WithInterval(double estimate, const Interval& interval, double scale = 1) {
  return fmt::format("{} ({} to {})", Signed(estimate, scale), Signed(interval.lower, scale),
                     Signed(interval.upper, scale));
}

// Of the figures that differ anywhere, and of those that a reader asks for.
void SayPlans(const Comparison& c, const Globals& globals) {
  const auto spread = [](const Quartiles& q) {
    return fmt::format("{} [{}, {}]", NumberText(q.median, 4), NumberText(q.lower, 4),
                       NumberText(q.upper, 4));
  };
  const auto percent = [](const Quartiles& q) {
    return fmt::format("{:+.1f} % [{:+.1f}, {:+.1f}]", 100 * q.median, 100 * q.lower,
                       100 * q.upper);
  };
  TextTable table({{.heading = "Plans", .wraps = true},
                   {.heading = "Pairs", .right = true},
                   {.heading = "a: median [quartiles]", .wraps = true},
                   {.heading = "b", .wraps = true},
                   {.heading = "Change", .wraps = true},
                   {.heading = "b lower, same, higher", .wraps = true}});
  for (const ComparedPlanFigure& f : c.plans) {
    constexpr std::array<std::string_view, 4> kAlways = {
        "length_m", "cumulative_risk", "hazard_free_coverage", "terrain_crossings"};
    if (f.lower + f.higher == 0 && std::ranges::find(kAlways, f.figure) == kAlways.end()) continue;
    table.Add({f.figure, Number(f.n), spread(f.a), spread(f.b), f.change ? percent(*f.change) : "–",
               fmt::format("{}, {}, {}", f.lower, f.same, f.higher)});
  }
  if (!table.empty()) globals.Say(table);
  const ComparedPlans& both = c.risk_and_length;
  if (both.n > 0)
    globals.Say(fmt::format(
        "  cumulative_risk and length_m together: b has less of both in {}, less of one in {}, the "
        "same in {}, more of one in {}",
        both.both_lower, both.none_higher - both.both_lower - both.same, both.same,
        both.n - both.none_higher));
}

void SayDrives(const Comparison& c, const Globals& globals) {
  TextTable failures({{.heading = "Failures"},
                      {.heading = "a", .right = true},
                      {.heading = "b", .right = true},
                      {.heading = "Only a", .right = true},
                      {.heading = "Only b", .right = true},
                      {.heading = "b - a, 95 % interval, % of pairs", .wraps = true},
                      {.heading = "McNemar"}});
  for (const ComparedFailure& f : c.failures)
    failures.Add({Words(f.mode), Number(f.both + f.only_a), Number(f.both + f.only_b),
                  Number(f.only_a), Number(f.only_b), WithInterval(f.difference, f.interval, 100),
                  Significance(f.p)});
  globals.Say(failures);
  TextTable metrics({{.heading = "Metrics", .wraps = true},
                     {.heading = "Pairs", .right = true},
                     {.heading = "Mean b - a, 95 % interval", .wraps = true},
                     {.heading = "Median", .right = true}});
  bool starred = false;
  std::string same;
  for (const ComparedMetric& m : c.metrics) {
    const Interval& interval = m.mean.interval;
    if (m.mean.estimate == 0 && interval.lower == 0 && interval.upper == 0) {
      same += (same.empty() ? "" : ", ") + m.metric;
      continue;
    }
    starred |= m.successes_only;
    metrics.Add({m.metric + (m.successes_only ? " *" : ""), Number(m.mean.n),
                 WithInterval(m.mean.estimate, m.mean.interval), Signed(m.median.estimate)});
  }
  if (!metrics.empty()) globals.Say(metrics);
  if (!same.empty()) globals.SayFact("The same in all", same);
  if (starred) globals.Say("  * where both succeed: a failure ends an episode early");
}

}  // namespace

void AddCompare(CommandLine& line, const Globals& globals, int& status) {
  auto sides = std::make_shared<std::vector<std::string>>();
  auto page = std::make_shared<std::string>();
  Subcommand command = line.Add(
      "compare", "The same episodes under two variants, or in two campaigns of one seed: paired");
  command.Texts("DIR[:VARIANT]", *sides, "Two campaigns, or variants of one",
                Subcommand::Need::kRequired, 2);
  command.Text("--page", *page, "Also write the comparison as a page: this .html file");
  command.OnRun([sides, page, &globals, &status] {
    const std::string ending = fs::path(*page).extension().string();
    if (!page->empty() && ending != ".html")
      throw InputError({"--page", 0}, "", *page, "must end in .html");
    const Side a = OpenSide(sides->at(0)), b = OpenSide(sides->at(1));
    const Comparison comparison = CompareVariants(a.store, a.variant, b.store, b.variant);
    auto json = ComparisonJson(comparison);
    json["a_folder"] = a.folder.string();
    json["b_folder"] = b.folder.string();
    globals.Result(json);
    globals.Say(fmt::format("a: {}\nb: {}\n{} in both, with the same draws", a.name(), b.name(),
                            CountText(comparison.n, "episode")));
    if (comparison.repeats > 0)
      globals.Say(
          fmt::format("one pair, repeated: all {} came out the same on both sides, to the "
                      "last bit, and count once; {}",
                      comparison.repeats, kHowToDiffer));
    if (comparison.only_a + comparison.only_b > 0)
      globals.Say(fmt::format("left out: {} that only a planned or drove, {} that only b did",
                              comparison.only_a, comparison.only_b));
    const bool driven = !comparison.metrics.empty();
    if (driven) SayDrives(comparison, globals);
    SayPlans(comparison, globals);
    if (!page->empty()) {
      WriteFileWhole(*page, ComparePage({a.folder, a.variant, a.name()},
                                        {b.folder, b.variant, b.name()}, comparison));
      globals.SayFact("Page", *page);
    }
    status = kExitDone;
  });
}

}  // namespace floorproof
