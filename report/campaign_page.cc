// SPDX-License-Identifier: Apache-2.0
#include "report/campaign_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/input_file.h"
#include "base/quantity.h"
#include "env/core/failure_text.h"
#include "report/campaign_data.h"
#include "report/drawing_progress.h"
#include "report/failing_episodes.h"
#include "report/films.h"
#include "report/page_data.h"
#include "report/pairs.h"
#include "report/pictures.h"
#include "report/recorded_campaign.h"
#include "report/verdict.h"
#include "run/campaign/campaign_store.h"
#include "run/campaign/replay_shelf.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxEpisodes = 300;  // listed on the page, of all variants
// A campaign may have hundreds of variants: plans, say, each on a floor of its own. Nobody looks at
// so many maps, nor at how each differs from the first.
constexpr std::size_t kMaxMaps = 24, kMaxPairs = 24;

// What `read` returns, of a row. Throws InputError naming the database where its texts are damaged.
template <class Read>
auto FromRow(const fs::path& database, const Read& read) {
  try {
    return read();
  } catch (const InternalError& e) {
    throw InputError({database.string(), 0}, "", "",
                     fmt::format("holds events that cannot be read ({})", e.what()));
  }
}

// The rows of a campaign, walked through once.
class Rows {
 public:
  Rows(Report& report, const std::string& named) : report_(report), named_(named) {
    const std::size_t variants = report.summary.variants.size();
    share_ = std::max<std::size_t>(10, kMaxEpisodes / std::max<std::size_t>(1, variants));
  }

  // Throws InputError where an event cannot be read, or the summary is of other episodes.
  void Read(const CampaignStore& store, const VariantSummary& variant, const fs::path& folder) {
    const fs::path database = folder / "campaign.sqlite", summary = folder / "summary.json";
    std::size_t listed = 0;
    int rows = 0;
    std::vector<HeatFailure> places;
    store.ForEach(variant.name, [&](const EpisodeRow& row) {
      ++rows;
      if (!IsListed(row)) return;
      const std::vector<Event> events = FromRow(database, [&] { return EventsOf(row); });
      if (row.counts()) AddPlaces(row.episode, events, places);
      what_[{variant.name, row.episode}] = WhatFailed(row, events);
      if (listed++ < share_)
        report_.episodes.push_back(FromRow(database, [&] {
          return FailingEpisode(row, events, named_, report_.summary.variants.size() > 1);
        }));
      else
        ++report_.episodes_left_out;
    });
    if (rows != variant.n + variant.errors + variant.not_planned)
      throw InputError({summary.string(), 0}, "variants." + variant.name, "",
                       fmt::format("is not of the {} that campaign.sqlite holds: `campaign "
                                   "--resume` writes it anew",
                                   CountText(rows, "episode")));
    places_.push_back(std::move(places));
  }

  const std::vector<std::vector<HeatFailure>>& places() const { return places_; }
  std::string WhatOf(const std::string& variant, std::uint64_t episode) const {
    const auto found = what_.find({variant, episode});
    return found == what_.end() ? "success" : found->second;
  }

 private:
  // Numbered by the episode, under which the page lists it and `replay` drives it again.
  static void AddPlaces(std::uint64_t episode, const std::vector<Event>& events,
                        std::vector<HeatFailure>& places) {
    for (std::size_t i = 0; i < events.size(); ++i)
      places.push_back({{events[i].x_m, events[i].y_m},
                        i == 0 ? fmt::format("{}", episode) : fmt::format("{}.{}", episode, i + 1),
                        FailureName(events[i])});
  }

  Report& report_;
  std::string named_;
  std::size_t share_ = 0;  // episodes listed of a variant
  std::vector<std::vector<HeatFailure>> places_;
  std::map<std::pair<std::string, std::uint64_t>, std::string> what_;
};

// A floor that each episode draws anew has no one map.
bool HasOneMap(const Scenario& scenario) {
  const ConfigNode* generate = scenario.text.site.Find("generate");
  if (generate == nullptr) return true;
  if (generate->Find("seed") == nullptr) return false;
  return std::ranges::none_of(scenario.text.randomise.entries, [](const auto& entry) {
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
std::optional<HeatValues> RatesOnFloor(const VariantSummary& variant) {
  constexpr int kMaxCells = 1 << 24;  // an event far off the map makes no picture's grid
  const std::vector<FailurePlace>& places = variant.places;
  const double cell_m = variant.place_m;
  if (places.empty()) return std::nullopt;
  Vec2 low = places.front().p_W, high = low;
  for (const FailurePlace& place : places) {
    low = low.cwiseMin(place.p_W);
    high = high.cwiseMax(place.p_W);
  }
  const Vec2 cells = (high - low) / cell_m + Vec2::Ones();
  if (!(cells.x() * cells.y() < kMaxCells)) return std::nullopt;
  HeatValues heat;
  heat.frame = {static_cast<int>(std::lround(cells.x())),
                static_cast<int>(std::lround(cells.y())),
                cell_m,
                {low.x() - cell_m / 2, low.y() - cell_m / 2, 0}};
  heat.values = Grid<float>(heat.frame.width, heat.frame.height, HeatValues::kNone);
  for (const FailurePlace& place : places) {
    const Cell cell = heat.frame.ToCell(place.p_W);
    heat.values(cell.ix, cell.iy) = static_cast<float>(100 * place.rate.rate);
  }
  return heat;
}

// Which variants' maps are shown: those that failed most.
std::vector<bool> WithMap(const std::vector<VariantSummary>& variants) {
  std::vector<std::size_t> order(variants.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t v) {
    return variants[v].failures.empty() ? 0 : variants[v].failures.front().k;
  });
  std::vector<bool> with(variants.size());
  for (std::size_t i = 0; i < std::min(kMaxMaps, order.size()); ++i) with[order[i]] = true;
  return with;
}

void AddMaps(const fs::path& folder, const Rows& rows, const Console& console, Report& report) {
  std::optional<ScenarioFile> file;
  std::string why;
  try {
    file.emplace(folder / "scenario.resolved.yaml");
    const Scenario scenario = file->Read(std::nullopt);
    report.title = scenario.spec.name;
    report.subject = SubjectOf(scenario, file->variants());
  } catch (const InputError& e) {
    why = fmt::format("The map cannot be read any more: {}", e.what());
  }
  const auto& variants = report.summary.variants;
  report.maps.resize(variants.size());
  const std::vector<bool> with_map = WithMap(variants);
  DrawingProgress progress(console, "drawing maps");
  for (std::size_t v = 0; v < variants.size(); ++v) {
    progress.Show(static_cast<int>(v), static_cast<int>(variants.size()));
    const std::string& name = variants[v].name;
    ReportMap& map = report.maps[v];
    const fs::path png = folder / PictureFile(name, v + 1);
    if (!with_map[v]) {
      map.left_out = true;
      continue;
    }
    // What was drawn while the site could be read still shows where.
    const auto keep = [&](const std::string& note) {
      map.note = note;
      if (WhyUnreadable(png, kMaxResultBytes).empty())
        map.png = ReadInputFile(png, kMaxResultBytes);
    };
    if (!file) {
      keep(why);
      continue;
    }
    try {
      const Scenario scenario = file->Read(std::nullopt, SiteOf(*file, name));
      if (!HasOneMap(scenario)) {
        map.note = "Each episode draws a floor of its own: there is no one map to show.";
        continue;
      }
      const std::optional<HeatValues> rates = RatesOnFloor(variants[v]);
      HeatMapOptions options;
      options.failures = rows.places()[v];
      options.failures_by = "failures, by episode";
      WriteFailurePlaces(scenario.world.site.map, name + " on " + scenario.world.site.map.name,
                         std::move(options), rates ? &*rates : nullptr, png);
      map.png = ReadInputFile(png, kMaxResultBytes);
      map.data = MapData(scenario.world.site.map);
      if (!scenario.text.randomise.IsNull())
        map.note = "the map is the site as written, before an episode's draws";
    } catch (const InputError& e) {
      keep(fmt::format("The map cannot be read any more: {}", e.what()));
    }
  }
}

}  // namespace

ResultNames PageResults() {
  return {"page", [](std::string_view name) {
            return name == "report.html" ||
                   (name.starts_with("heatmap_failures_") && name.ends_with(".png"));
          }};
}

Report GatherReport(const fs::path& folder, const std::string& named, ResultFolder& out,
                    const Console& console) {
  auto [recorded, store] = ReadRecordedCampaign(folder);
  Report report;
  report.summary = std::move(recorded);
  const CampaignSummary& summary = report.summary;
  out.Begin();
  Rows rows(report, named);
  for (const VariantSummary& variant : summary.variants) rows.Read(store, variant, folder);
  report.dependence = DependenceOf(store, summary);
  for (std::size_t v = 1; v < summary.variants.size() && summary.variants.size() <= kMaxPairs + 1;
       ++v)
    report.pairs.push_back(ShownPair(
        CompareVariants(store, summary.variants[0].name, store, summary.variants[v].name)));
  report.title = "campaign " + summary.campaign;
  AddMaps(folder, rows, console, report);
  AddFilms(
      folder, [&](const std::string& v, std::uint64_t id) { return rows.WhatOf(v, id); }, report);
  AddCampaignData(store, folder, named, report);
  if (const fs::path settings = folder / "scenario.resolved.yaml";
      WhyUnreadable(settings, kMaxResultBytes).empty())
    report.settings = ReadInputFile(settings, kMaxResultBytes);
  return report;
}

}  // namespace floorproof
