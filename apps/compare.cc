// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "apps/command.h"
#include "env/run/campaign_comparison.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// DIR or DIR:VARIANT; without a variant the only one.
struct Side {
  std::string text, variant;
  CampaignStore store;
};

Side OpenSide(const std::string& text) {
  // A colon within the folder's own name is taken as such where that folder is there.
  std::error_code ignored;
  const auto colon = fs::exists(text, ignored) ? std::string::npos : text.rfind(':');
  const fs::path folder = text.substr(0, colon);
  Side side{text, colon == std::string::npos ? "" : text.substr(colon + 1),
            CampaignStore::Open(folder / "campaign.sqlite", false)};
  const std::vector<std::string> variants = side.store.Variants();
  if (side.variant.empty() && variants.size() == 1) side.variant = variants.front();
  if (std::ranges::find(variants, side.variant) != variants.end()) return side;
  std::string known;
  for (const std::string& name : variants) known += (known.empty() ? "" : "; ") + name;
  throw InputError({folder.string(), 0}, "variant", side.variant, "must be one of: " + known);
}

std::string Signed(const nlohmann::ordered_json& value, double scale) {
  return value.is_null() ? "-" : fmt::format("{:+.4g}", scale * value.get<double>());
}

void SayComparison(const nlohmann::ordered_json& json, const Globals& globals) {
  globals.Say(fmt::format("A: {}\nB: {}\n{} episodes in both, the same draws in each",
                          json["a"].get<std::string>(), json["b"].get<std::string>(),
                          json["n"].get<int>()));
  globals.Say(fmt::format("  {:<14} {:>7} {:>7} {:>9} {:>9}  {}", "failures", "A", "B", "only A",
                          "only B", "rate A - B, 95 % interval; exact McNemar p"));
  for (const auto& [mode, row] : json["failures"].items())
    globals.Say(fmt::format("  {:<14} {:>7} {:>7} {:>9} {:>9}  {} % ({} to {}); p = {:.3g}", mode,
                            row["a"].get<int>(), row["b"].get<int>(), row["only_a"].get<int>(),
                            row["only_b"].get<int>(), Signed(row["difference"], 100),
                            Signed(row["lower"], 100), Signed(row["upper"], 100),
                            row["p"].get<double>()));
  globals.Say(fmt::format("  {:<18} {}", "metrics", "mean of A - B, 95 % interval; median"));
  for (const auto& [metric, row] : json["metrics"].items())
    globals.Say(fmt::format("  {:<18} {} ({} to {}); {}", metric, Signed(row["mean"], 1),
                            Signed(row["lower"], 1), Signed(row["upper"], 1),
                            Signed(row["median"], 1)));
}

}  // namespace

void AddCompare(CLI::App& app, const Globals& globals, int& status) {
  auto sides = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand(
      "compare", "The same episodes under two variants, or in two campaigns of one seed: paired");
  command->add_option("DIR[:VARIANT]", *sides, "Two campaigns, or variants of one")
      ->required()
      ->expected(2);
  command->callback([sides, &globals, &status] {
    const Side a = OpenSide(sides->at(0)), b = OpenSide(sides->at(1));
    const auto json = CompareVariants(a.store, a.variant, b.store, b.variant);
    globals.Result(json);
    SayComparison(json, globals);
    status = kDone;
  });
}

}  // namespace floorproof
