// SPDX-License-Identifier: Apache-2.0
#include "report/campaign_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "base/input_file.h"
#include "report/failing_episodes.h"
#include "report/films.h"
#include "report/pairs.h"
#include "report/pictures.h"
#include "report/summary.h"
#include "run/campaign/campaign_store.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxBytes = 64u << 20;
constexpr std::size_t kMaxEpisodes = 300;  // listed on the page, of all variants

// The rows of a campaign, walked through once.
class Rows {
 public:
  Rows(Report& report, const std::string& named) : report_(report), named_(named) {
    share_ =
        std::max<std::size_t>(10, kMaxEpisodes / std::max<std::size_t>(1, report.variants.size()));
  }

  void Read(const CampaignStore& store, const ReportVariant& variant, const fs::path& summary) {
    std::size_t listed = 0;
    int rows = 0;
    std::vector<Event> places;
    store.ForEach(variant.name, [&](const EpisodeRow& row) {
      ++rows;
      if (!IsListed(row)) return;
      const std::vector<Event> events = EventsOf(row);
      if (row.counts()) places.insert(places.end(), events.begin(), events.end());
      what_[{variant.name, row.episode}] = WhatFailed(row, events);
      if (listed++ < share_)
        report_.episodes.push_back(
            FailingEpisode(row, events, named_, report_.variants.size() > 1));
      else
        ++report_.episodes_left_out;
    });
    if (rows != variant.n + variant.errors + variant.not_planned)
      throw InputError(
          {summary.string(), 0}, "variants." + variant.name, "",
          fmt::format("is not of the {} episodes that campaign.sqlite holds: `campaign "
                      "--resume` writes it anew",
                      rows));
    places_.push_back(std::move(places));
  }

  const std::vector<std::vector<Event>>& places() const { return places_; }
  std::string WhatOf(const std::string& variant, std::uint64_t episode) const {
    const auto found = what_.find({variant, episode});
    return found == what_.end() ? "success" : found->second;
  }

 private:
  Report& report_;
  std::string named_;
  std::size_t share_ = 0;  // episodes listed of a variant
  std::vector<std::vector<Event>> places_;
  std::map<std::pair<std::string, std::uint64_t>, std::string> what_;
};

// A floor that each episode draws anew has no one map.
bool HasOneMap(const Scenario& scenario) {
  const ConfigNode* generate = scenario.site_node.Find("generate");
  if (generate == nullptr) return true;
  if (generate->Find("seed") == nullptr) return false;
  return std::ranges::none_of(scenario.randomise.entries, [](const auto& entry) {
    return entry.first.starts_with("site.generate");
  });
}

// What the variant changes of the site: the resolved scenario states the first robot's tracker,
// with which another variant's robot may not read.
Variant SiteOf(const ScenarioFile& file, const std::string& name) {
  Variant changes;
  for (const Variant& variant : file.variants())
    if (variant.name == name)
      for (const auto& [key, value] : variant.overrides)
        if (key == "site" || key.starts_with("site.")) changes.overrides.emplace_back(key, value);
  return changes;
}

std::string PictureFile(const std::string& variant, std::size_t number) {
  std::string name = variant;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) &&
        std::string_view("._=+,-").find(c) == std::string_view::npos)
      c = '_';
  if (name != variant || name.size() > 150) name = name.substr(0, 150) + fmt::format("_{}", number);
  return "heatmap_failures_" + name + ".png";
}

// The rates on a grid that spans them; none where no episode failed.
std::optional<HeatValues> RatesOnFloor(const ReportPlaces& places) {
  constexpr int kMaxCells = 1 << 24;  // an event far off the map makes no picture's grid
  if (places.rates.empty()) return std::nullopt;
  Vec2 low = places.rates.front().p_W, high = low;
  for (const ReportPlace& place : places.rates) {
    low = low.cwiseMin(place.p_W);
    high = high.cwiseMax(place.p_W);
  }
  const Vec2 cells = (high - low) / places.cell_m + Vec2::Ones();
  if (!(cells.x() * cells.y() < kMaxCells)) return std::nullopt;
  HeatValues heat;
  heat.frame = {static_cast<int>(std::lround(cells.x())),
                static_cast<int>(std::lround(cells.y())),
                places.cell_m,
                {low.x() - places.cell_m / 2, low.y() - places.cell_m / 2, 0}};
  heat.values = Grid<float>(heat.frame.width, heat.frame.height, HeatValues::kNone);
  for (const ReportPlace& place : places.rates) {
    const Cell cell = heat.frame.ToCell(place.p_W);
    heat.values(cell.ix, cell.iy) = static_cast<float>(100 * place.rate.rate);
  }
  return heat;
}

void AddPlaces(const fs::path& folder, const Rows& rows, Report& report) {
  std::optional<ScenarioFile> file;
  std::string why;
  try {
    file.emplace(folder / "scenario.resolved.yaml");
    report.title = file->Read(std::nullopt).name;
  } catch (const InputError& e) {
    why = fmt::format("The map cannot be read any more: {}", e.what());
  }
  for (std::size_t v = 0; v < report.variants.size(); ++v) {
    ReportVariant& variant = report.variants[v];
    const fs::path png = folder / PictureFile(variant.name, v + 1);
    // What was drawn while the site could be read still shows where.
    const auto keep = [&](const std::string& note) {
      variant.places_note = note;
      if (WhyUnreadable(png, kMaxBytes).empty()) variant.places_png = ReadInputFile(png, kMaxBytes);
    };
    if (!file) {
      keep(why);
      continue;
    }
    try {
      const Scenario scenario = file->Read(std::nullopt, SiteOf(*file, variant.name));
      if (!HasOneMap(scenario)) {
        variant.places_note = "Each episode draws a floor of its own: there is no one map to show.";
        continue;
      }
      const std::optional<HeatValues> rates = RatesOnFloor(variant.places);
      WriteFailurePlaces(scenario.site.map, variant.name + " on " + scenario.site.map.name,
                         rows.places()[v], rates ? &*rates : nullptr, nullptr, png);
      variant.places_png = ReadInputFile(png, kMaxBytes);
      if (!scenario.randomise.IsNull())
        variant.places_note = "the map is the site as written, before an episode's draws";
    } catch (const InputError& e) {
      keep(fmt::format("The map cannot be read any more: {}", e.what()));
    }
  }
}

}  // namespace

Report GatherReport(const fs::path& folder, const std::string& named) {
  Report report;
  ReadSummary(folder / "summary.json", report);
  const fs::path database = folder / "campaign.sqlite";
  if (const std::string why = WhyUnreadable(database, std::numeric_limits<std::uintmax_t>::max());
      !why.empty())
    throw InputError({database.string(), 0}, "", "", why + ": not the folder of a `campaign`");
  const CampaignStore store = CampaignStore::Open(database, false);
  if (store.about().id != report.campaign)
    throw InputError({(folder / "summary.json").string(), 0}, "campaign", report.campaign,
                     "is another campaign than campaign.sqlite's, " + store.about().id);
  Rows rows(report, named);
  try {
    for (const ReportVariant& variant : report.variants)
      rows.Read(store, variant, folder / "summary.json");
  } catch (const nlohmann::json::exception& e) {
    throw InputError({database.string(), 0}, "", "",
                     fmt::format("holds events that cannot be read ({})", e.what()));
  }
  for (std::size_t v = 1; v < report.variants.size(); ++v)
    report.pairs.push_back(
        ShownPair(CompareVariants(store, report.variants[0].name, store, report.variants[v].name)));
  report.title = "campaign " + report.campaign;
  AddPlaces(folder, rows, report);
  AddFilms(
      folder, [&](const std::string& v, std::uint64_t id) { return rows.WhatOf(v, id); }, report);
  report.settings = ReadInputFile(folder / "scenario.resolved.yaml", kMaxBytes);
  return report;
}

}  // namespace floorproof
