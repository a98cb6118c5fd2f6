// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/file_output.h"
#include "base/quantity.h"
#include "report/compare_page.h"
#include "report/comparison_tables.h"
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

void SayComparison(const Comparison& comparison, const Globals& globals) {
  for (const ComparisonPart& part : ComparisonParts(comparison)) {
    if (!part.table.empty()) globals.Say(part.table);
    for (const std::string& note : part.notes) globals.Say("  " + note);
  }
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
    globals.Say("a: " + a.name());
    globals.Say("b: " + b.name());
    globals.Say(CountText(comparison.n, "episode") + " in both, with the same draws");
    if (comparison.repeats > 0)
      globals.Say(
          fmt::format("one pair, repeated: all {} came out the same on both sides, to the "
                      "last bit, and count once; {}",
                      comparison.repeats, kHowToDiffer));
    if (comparison.only_a + comparison.only_b > 0)
      globals.Say(fmt::format("left out: {} that only a planned or drove, {} that only b did",
                              comparison.only_a, comparison.only_b));
    SayComparison(comparison, globals);
    if (!page->empty()) {
      WriteFileWhole(*page, ComparePage({a.folder, a.variant, a.name()},
                                        {b.folder, b.variant, b.name()}, comparison));
      globals.SayFact("Page", *page);
    }
    status = kExitDone;
  });
}

}  // namespace floorproof
