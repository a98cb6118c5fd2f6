// SPDX-License-Identifier: Apache-2.0
#include "report/campaign_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "base/input_file.h"
#include "base/key_name.h"
#include "base/quantity.h"
#include "env/core/failure_text.h"
#include "report/failing_episodes.h"
#include "report/page_data.h"
#include "run/campaign/replay_shelf.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostRows = 10'000;   // of the table, of all variants
constexpr std::size_t kMostPlaces = 2'000;  // on the map, of a variant
constexpr std::uintmax_t kLargestReplay = 2u << 20, kAllReplays = 6u << 20;  // bytes in the page

PageJson Rounded(const std::optional<double>& value) {
  return value ? PageJson(Thousandths(*value)) : PageJson(nullptr);
}

// "step height (m)"
std::string Heading(const std::string& key) {
  const KeyName name = NameOfKey(key);
  return name.unit.empty() ? name.name : name.name + " (" + name.unit + ")";
}

class Gatherer {
 public:
  Gatherer(const CampaignStore& store, const fs::path& folder, const std::string& named,
           Report& report)
      : store_(store), folder_(folder), named_(named), report_(report) {}

  void Gather() {
    ReadRows();
    std::size_t mapped = 0;
    for (std::size_t v = 0; v < report_.summary.variants.size(); ++v)
      if (!report_.maps.at(v).data.is_null()) map_of_[report_.summary.variants[v].name] = mapped++;
    ChooseDrives();
    PageJson maps = PageJson::array();
    for (std::size_t v = 0; v < report_.summary.variants.size(); ++v) {
      PageJson& map = report_.maps.at(v).data;
      if (map.is_null()) continue;
      maps.push_back({{"name", report_.summary.variants[v].name},
                      {"map", std::move(map)},
                      {"ways", PageJson::array()},
                      {"rates", RatesData(report_.summary.variants[v])},
                      {"note", NoteOf(v)},
                      {"failures", Places(report_.summary.variants[v].name)}});
    }
    report_.data =
        PageText({{"drives", std::move(drives_)}, {"maps", std::move(maps)}, {"table", Table()}});
  }

 private:
  using Key = std::pair<std::string, std::uint64_t>;  // variant, episode

  struct Failing {
    EpisodeRow row;
    std::vector<Event> events;
    PageJson drawn;
    ReportEpisode said;
    std::size_t number = 0;  // in the table
  };

  bool several() const { return report_.summary.variants.size() > 1; }

  void ReadRows() {
    const std::size_t share = kMostRows / std::max<std::size_t>(1, report_.summary.variants.size());
    for (const VariantSummary& variant : report_.summary.variants) {
      std::size_t listed = 0;
      store_.ForEach(variant.name, [&](const EpisodeRow& row) {
        if (!IsListed(row)) return;
        ++all_;
        std::vector<Event> events = EventsOf(row);
        if (row.counts()) places_of_[variant.name] += events.size();
        if (listed++ >= share) return;
        ReportEpisode said = FailingEpisode(row, events, named_, several());
        failing_.push_back(
            {row, std::move(events), PageJson::parse(row.drawn), std::move(said), failing_.size()});
      });
    }
  }

  // Films are in the page anyway; of replays first the first of each mode, then the others, as many
  // as there is room for.
  void ChooseDrives() {
    std::uintmax_t used = 0;
    std::set<Key> chosen;
    const auto choose = [&](const Failing& failing) {
      const Key key{failing.row.variant, failing.row.episode};
      if (chosen.contains(key)) return;
      const fs::path file = EpisodeFolder(folder_, key.first, key.second) / "replay.bin";
      if (!IsPlainFile(file)) return;
      std::error_code ignored;
      const std::uintmax_t size = fs::file_size(file, ignored);
      if (!WhyUnreadable(file, kLargestReplay).empty() || used + size > kAllReplays) return;
      used += size;
      chosen.insert(key);
    };
    std::set<std::tuple<std::string, FailureMode>> seen;
    for (const Failing& failing : failing_)
      for (const Event& event : failing.events)
        if (seen.emplace(failing.row.variant, event.mode).second) choose(failing);
    for (const Failing& failing : failing_) choose(failing);

    for (const Failing& failing : failing_) {
      const Key key{failing.row.variant, failing.row.episode};
      const auto film = std::ranges::find_if(report_.films, [&](const ReportFilm& f) {
        return f.variant == key.first && f.episode == key.second && !f.mp4.empty();
      });
      if (!chosen.contains(key) && film == report_.films.end()) continue;
      PageJson events = PageJson::array();
      for (std::size_t i = 0; i < failing.events.size(); ++i) events.push_back(EventOf(failing, i));
      PageJson drive = {{"name", fmt::format("{}{}: {}", several() ? key.first + " " : "episode ",
                                             key.second, WhatFailed(failing.row, failing.events))},
                        {"events", std::move(events)},
                        {"end_s", failing.row.metric(&Metrics::duration_s).value_or(0)},
                        {"command", failing.said.command}};
      if (const auto map = map_of_.find(key.first); map != map_of_.end())
        drive["map"] = map->second;
      if (chosen.contains(key)) {
        const std::string id = fmt::format("replay-{}", report_.replays.size());
        report_.replays.emplace_back(
            id, ReadInputFile(EpisodeFolder(folder_, key.first, key.second) / "replay.bin",
                              kLargestReplay));
        drive["replay"] = id;
      }
      if (film != report_.films.end()) {
        drive["film"] = fmt::format("film-{}", film - report_.films.begin());
        AddFilmTimes(EpisodeFolder(folder_, key.first, key.second), drive);
      }
      drive_of_[key] = drives_.size();
      drives_.push_back(std::move(drive));
    }
  }

  PageJson EventOf(const Failing& failing, std::size_t i) const {
    const std::string number = i == 0 ? fmt::format("{}", failing.row.episode)
                                      : fmt::format("{}.{}", failing.row.episode, i + 1);
    const Event& event = failing.events[i];
    return FailureData(event, number, event.hazard.empty() ? "" : "at " + event.hazard);
  }

  PageJson DriveOf(const Key& key) const {
    const auto found = drive_of_.find(key);
    return found == drive_of_.end() ? PageJson(nullptr) : PageJson(found->second);
  }

  // Under the variant's map.
  std::string NoteOf(std::size_t v) const {
    const std::string& note = report_.maps.at(v).note;
    const auto all = places_of_.find(report_.summary.variants[v].name);
    if (all == places_of_.end() || all->second <= kMostPlaces) return note;
    return fmt::format("{}{}the first {} of {}", note, note.empty() ? "" : "; ",
                       FixedText(static_cast<double>(kMostPlaces), 0),
                       CountText(all->second, "failure"));
  }

  PageJson Places(const std::string& variant) const {
    PageJson places = PageJson::array();
    for (const Failing& failing : failing_) {
      if (failing.row.variant != variant || !failing.row.counts()) continue;
      for (std::size_t i = 0; i < failing.events.size() && places.size() < kMostPlaces; ++i) {
        PageJson place = EventOf(failing, i);
        place["text"] =
            fmt::format("episode {}: {} at {} s{}", failing.row.episode,
                        FailureName(failing.events[i]), FixedText(failing.events[i].t_s, 1),
                        failing.events[i].hazard.empty() ? "" : ", " + failing.events[i].hazard);
        place["drive"] = DriveOf({variant, failing.row.episode});
        place["row"] = failing.number;
        places.push_back(std::move(place));
      }
    }
    return places;
  }

  // Failing episodes with what was drawn, a column each.
  PageJson Table() const {
    std::map<std::string, bool> drawn;  // name: whether each value is a number
    for (const Failing& failing : failing_)
      for (const auto& [name, value] : failing.drawn.items()) {
        const auto entry = drawn.emplace(name, true).first;
        entry->second = entry->second && value.is_number();
      }
    PageJson columns = PageJson::array();
    const auto add = [&](const std::string& key, const std::string& name, bool number,
                         const std::string& said = "") {
      columns.push_back(
          {{"key", key}, {"name", said.empty() ? name : said}, {"number", number}, {"path", name}});
    };
    add("episode", "Episode", true);
    if (several()) add("variant", "Variant", false);
    add("what", "Failure", false);
    add("detail", "Hazard, or reason", false);
    add("t_s", "Time (s)", true);
    add("x_m", "x (m)", true);
    add("y_m", "y (m)", true);
    std::size_t number = 0;
    for (const auto& [name, is_number] : drawn)
      add(fmt::format("drawn_{}", number++), name, is_number, Heading(name));
    PageJson rows = PageJson::array();
    for (const Failing& failing : failing_) {
      const ReportEpisode& e = failing.said;
      PageJson row = {{"episode", e.episode},
                      {"variant", e.variant},
                      {"what", e.what},
                      {"detail", e.detail},
                      {"t_s", Rounded(e.t_s)},
                      {"x_m", Rounded(e.x_m)},
                      {"y_m", Rounded(e.y_m)},
                      {"command", e.command},
                      {"drive", DriveOf({e.variant, e.episode})}};
      number = 0;
      for (const auto& [name, is_number] : drawn) {
        const std::string key = fmt::format("drawn_{}", number++);
        if (!failing.drawn.contains(name)) continue;
        const PageJson& value = failing.drawn.at(name);
        row[key] = value.is_number() || value.is_string() ? value : PageJson(value.dump());
      }
      rows.push_back(std::move(row));
    }
    return {{"columns", std::move(columns)}, {"rows", std::move(rows)}, {"of", all_}};
  }

  const CampaignStore& store_;
  const fs::path& folder_;
  const std::string& named_;
  Report& report_;
  std::vector<Failing> failing_;                    // as many as the table lists
  std::uint64_t all_ = 0;                           // episodes that failed, of all variants
  std::map<std::string, std::uint64_t> places_of_;  // places where the variant failed
  PageJson drives_ = PageJson::array();
  std::map<Key, std::size_t> drive_of_;
  std::map<std::string, std::size_t> map_of_;  // by variant; those that have one
};

}  // namespace

void AddCampaignData(const CampaignStore& store, const fs::path& folder, const std::string& named,
                     Report& report) {
  Gatherer(store, folder, named, report).Gather();
}

}  // namespace floorproof
