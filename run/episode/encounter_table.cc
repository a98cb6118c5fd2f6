// SPDX-License-Identifier: Apache-2.0
#include "run/episode/encounter_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/printable.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kSize = 3;     // column
constexpr std::size_t kNumbers = 4;  // the first of them, which are kApproach and kPlace

struct PlaceColumn {
  std::string_view name;
  double Encounter::*member;
};
constexpr std::array<PlaceColumn, 5> kPlace = {{{"t_s", &Encounter::t_s},
                                                {"x_m", &Encounter::x_m},
                                                {"y_m", &Encounter::y_m},
                                                {"time_s", &Encounter::time_s},
                                                {"way_m", &Encounter::way_m}}};

std::string SizeText(const Encounter& encounter) {
  Json size = Json::object();
  for (const auto& [name, value] : encounter.size) size[name] = value;
  return size.dump();
}

void TakeOutcome(const std::string& text, Encounter& encounter) {
  for (const auto outcome : {Encounter::Outcome::kCleared, Encounter::Outcome::kCensored}) {
    encounter.outcome = outcome;
    if (text == OutcomeText(encounter)) return;
  }
  encounter.outcome = Encounter::Outcome::kFailed;
  for (int mode = 0; mode < kNumFailureModes; ++mode) {
    encounter.mode = static_cast<FailureMode>(mode);
    if (text == OutcomeText(encounter)) return;
  }
  throw InternalError("no outcome of an encounter: " + text);
}

// The place of the text among these names, as the enumerator's value.
template <class Enum>
Enum NamedBy(const std::array<std::string_view, 3>& names, const std::string& text) {
  const auto at = std::ranges::find(names, text);
  if (at == names.end()) throw InternalError("none of an encounter's words: " + text);
  return static_cast<Enum>(at - names.begin());
}
template <class Enum>
std::string NameOf(const std::array<std::string_view, 3>& names, Enum value) {
  return std::string(names[static_cast<std::size_t>(value)]);
}

}  // namespace

const std::vector<EncounterColumn>& EncounterColumns() {
  static const std::vector<EncounterColumn> kColumns = [] {
    std::vector<EncounterColumn> columns = {
        {"hazard", true}, {"type", true}, {"passage", true}, {"size", true}};
    for (const ApproachColumn& column : kApproach) columns.push_back({column.name});
    for (const PlaceColumn& column : kPlace) columns.push_back({column.name});
    columns.push_back({"outcome", true});
    columns.push_back({"energy_j"});
    columns.push_back({"after", true});
    columns.push_back({"sensed", true});
    return columns;
  }();
  return kColumns;
}

std::vector<EncounterValue> EncounterValues(const Encounter& encounter) {
  std::vector<EncounterValue> values = {encounter.hazard, encounter.type,
                                        std::string(Name(encounter.passage)), SizeText(encounter)};
  for (const ApproachColumn& column : kApproach) values.emplace_back(encounter.at.*column.member);
  for (const PlaceColumn& column : kPlace) values.emplace_back(encounter.*column.member);
  values.emplace_back(std::string(OutcomeText(encounter)));
  values.emplace_back(encounter.energy_j);
  values.emplace_back(NameOf(kAfterNames, encounter.after));
  values.emplace_back(NameOf(kSensedNames, encounter.sensed));
  return values;
}

Encounter EncounterOf(std::span<const EncounterValue> values) {
  if (values.size() != EncounterColumns().size())
    throw InternalError("a row of encounters has another number of columns");
  try {
    Encounter encounter;
    encounter.hazard = std::get<std::string>(values[0]);
    encounter.type = std::get<std::string>(values[1]);
    const auto& passage = std::get<std::string>(values[2]);
    encounter.passage = passage == Name(Passage::kOver) ? Passage::kOver : Passage::kBeside;
    if (passage != Name(encounter.passage)) throw InternalError("no passage: " + passage);
    const Json size = Json::parse(std::get<std::string>(values[kSize]), nullptr, false);
    if (!size.is_object()) throw InternalError("a row of encounters has a size that is no map");
    for (const auto& [name, value] : size.items()) {
      if (!value.is_number())
        throw InternalError("a row of encounters has a size that is no number: " + name);
      encounter.size.emplace_back(name, value.get<double>());
    }
    std::size_t at = kNumbers;
    for (const ApproachColumn& column : kApproach)
      encounter.at.*column.member = std::get<double>(values[at++]);
    for (const PlaceColumn& column : kPlace)
      encounter.*column.member = std::get<double>(values[at++]);
    TakeOutcome(std::get<std::string>(values[at++]), encounter);
    encounter.energy_j = std::get<double>(values[at++]);
    encounter.after = NamedBy<Encounter::After>(kAfterNames, std::get<std::string>(values[at++]));
    encounter.sensed = NamedBy<Encounter::Sensed>(kSensedNames, std::get<std::string>(values[at]));
    return encounter;
  } catch (const std::bad_variant_access&) {
    throw InternalError("a row of encounters has values of other types");
  }
}

std::string EncountersCsv(const std::vector<Encounter>& encounters) {
  std::vector<std::string> sizes;
  for (const Encounter& encounter : encounters)
    for (const auto& [name, value] : encounter.size)
      if (std::ranges::find(sizes, name) == sizes.end()) sizes.push_back(name);

  const std::vector<EncounterColumn>& columns = EncounterColumns();
  std::string csv;
  const auto add = [&](const std::string& field, bool first) { csv += (first ? "" : ",") + field; };
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i != kSize) add(std::string(columns[i].name), i == 0);
    if (i == kSize)
      for (const std::string& name : sizes) add("size." + CsvField(name), false);
  }
  csv += "\n";
  for (const Encounter& encounter : encounters) {
    const std::vector<EncounterValue> values = EncounterValues(encounter);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i == kSize) {
        for (const std::string& name : sizes) {
          const auto at =
              std::ranges::find(encounter.size, name, &std::pair<std::string, double>::first);
          add(at == encounter.size.end() ? "" : fmt::format("{}", at->second), false);
        }
      } else if (const auto* text = std::get_if<std::string>(&values[i])) {
        add(CsvField(*text), i == 0);
      } else {
        add(fmt::format("{}", std::get<double>(values[i])), i == 0);
      }
    }
    csv += "\n";
  }
  return csv;
}

}  // namespace floorproof
