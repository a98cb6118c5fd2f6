// SPDX-License-Identifier: Apache-2.0
#include "report/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>

#include "base/input_file.h"
#include "base/printable.h"
#include "env/core/failure_text.h"
#include "render/hazard_looks.h"
#include "report/drive_marks.h"
#include "run/episode/json_file.h"

namespace floorproof {
namespace {

double Rounded(double value, double per) { return std::round(value * per) / per + 0.0; }

PageJson PointsData(const std::vector<Vec2>& points) {
  PageJson list = PageJson::array();
  for (const Vec2& p : points) list.push_back({Thousandths(p.x()), Thousandths(p.y())});
  return list;
}

// The grid as the page has it, the top row first: {frame, cells: {width, height, cell_m, runs}},
// where runs are [value, count, ..]. `value_of(ix, iy, every)` of `every` cells a side, which are
// one of the page's.
template <class ValueOf>
PageJson GridData(const GridFrame& frame, const ValueOf& value_of) {
  constexpr int kMostCells = 900;  // a side: no screen shows more of them
  const int every =
      std::max(1, (std::max(frame.width, frame.height) + kMostCells - 1) / kMostCells);
  const int width = (frame.width + every - 1) / every;
  const int height = (frame.height + every - 1) / every;
  PageJson runs = PageJson::array();
  int last = 0;
  long count = 0;
  const auto end_run = [&] {
    if (count == 0) return;
    runs.push_back(last);
    runs.push_back(count);
    count = 0;
  };
  for (int row = height - 1; row >= 0; --row)
    for (int column = 0; column < width; ++column) {
      const int value = value_of(column * every, row * every, every);
      if (value != last) end_run();
      last = value;
      ++count;
    }
  end_run();
  const double cell_m = every * frame.cell_m;
  return {{"frame",
           {{"x", frame.X_WG.x_m},
            {"y", frame.X_WG.y_m},
            {"yaw", frame.X_WG.yaw_rad},
            {"width_m", width * cell_m},
            {"height_m", height * cell_m}}},
          {"cells",
           {{"width", width}, {"height", height}, {"cell_m", cell_m}, {"runs", std::move(runs)}}}};
}

// A wall wherever one is.
int KindOf(const HazardMap& map, int from_x, int from_y, int every) {
  bool unknown = false;
  for (int iy = from_y; iy < std::min(from_y + every, map.frame.height); ++iy)
    for (int ix = from_x; ix < std::min(from_x + every, map.frame.width); ++ix) {
      if (map.occupancy(ix, iy) == CellState::kOccupied) return 1;
      unknown = unknown || map.occupancy(ix, iy) == CellState::kUnknown;
    }
  return unknown ? 2 : 0;
}

// The part of the floor that is known, with a little around it, in the grid's frame, m: a map from
// a robot is mostly of what nobody knows.
PageJson SeenRectangle(const HazardMap& map) {
  int low_x = map.frame.width, low_y = map.frame.height, high_x = -1, high_y = -1;
  for (int iy = 0; iy < map.frame.height; ++iy)
    for (int ix = 0; ix < map.frame.width; ++ix) {
      if (map.occupancy(ix, iy) == CellState::kUnknown) continue;
      low_x = std::min(low_x, ix);
      high_x = std::max(high_x, ix);
      low_y = std::min(low_y, iy);
      high_y = std::max(high_y, iy);
    }
  if (high_x < 0) return nullptr;
  constexpr int kAround = 3;  // cells
  const auto metres = [&](int cell, int most) {
    return std::clamp(cell, 0, most) * map.frame.cell_m;
  };
  return {metres(low_x - kAround, map.frame.width), metres(low_y - kAround, map.frame.height),
          metres(high_x + 1 + kAround, map.frame.width),
          metres(high_y + 1 + kAround, map.frame.height)};
}

std::vector<std::string_view> Fields(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(',', at), line.size());
    fields.push_back(line.substr(at, end - at));
    at = end + 1;
  }
  return fields;
}

double NumberOf(std::string_view text) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

std::string PageText(const PageJson& json) {
  return json.dump(-1, ' ', false, PageJson::error_handler_t::replace);
}

double Thousandths(double value) { return Rounded(value, 1e3); }

PageJson MapData(const HazardMap& map) {
  PageJson hazards = PageJson::array();
  const std::vector<HazardLook> looks = HazardLooks(map);
  for (std::size_t h = 0; h < looks.size(); ++h) {
    const Hazard& hazard = map.hazards[h];
    const auto& [colour, label] = looks[h];
    PageJson polygons = PageJson::array();
    for (const Polygon& polygon : hazard.footprint) polygons.push_back(PointsData(polygon));
    if (polygons.empty()) continue;
    hazards.push_back(
        {{"id", hazard.id},
         {"label", label},
         {"colour", fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2])},
         {"known", hazard.known},
         {"text", HazardPhrase(hazard) + (hazard.known ? "" : ", on no map")},
         {"polygons", std::move(polygons)}});
  }
  PageJson data =
      GridData(map.frame, [&](int ix, int iy, int every) { return KindOf(map, ix, iy, every); });
  data["name"] = map.name;
  data["seen"] = SeenRectangle(map);
  data["hazards"] = std::move(hazards);
  return data;
}

PageJson VisitsData(const Visits& visits) {
  return GridData(visits.frame, [&](int ix, int iy, int every) {
    const std::uint8_t passes = visits.passes(std::min(ix + every / 2, visits.frame.width - 1),
                                              std::min(iy + every / 2, visits.frame.height - 1));
    return passes == Visits::kOutOfReach ? -1 : static_cast<int>(passes);
  });
}

PageJson RatesData(const VariantSummary& variant) {
  if (variant.places.empty()) return nullptr;
  PageJson places = PageJson::array();
  for (const FailurePlace& place : variant.places)
    places.push_back({Thousandths(place.p_W.x()), Thousandths(place.p_W.y()), place.rate.k,
                      place.rate.n, Rounded(place.rate.lower, 1e6),
                      Rounded(place.rate.upper, 1e6)});
  return {{"cell_m", variant.place_m}, {"places", std::move(places)}};
}

PageJson WayData(const Path& plan) {
  std::vector<Vec2> way;
  for (const Waypoint& waypoint : plan) way.push_back(waypoint.p_W);
  return PointsData(way);
}

PageJson FailureData(const Event& event, const std::string& label, const std::string& text) {
  return {{"t_s", Rounded(event.t_s, 1e3)}, {"x", Thousandths(event.x_m)},
          {"y", Thousandths(event.y_m)},    {"label", label},
          {"what", FailureName(event)},     {"text", text}};
}

void AddFilmTimes(const std::filesystem::path& folder, PageJson& drive) {
  const std::filesystem::path file = folder / "video.json";
  if (!WhyUnreadable(file, kMaxResultBytes).empty()) return;
  const JsonValue times = ReadJsonFile(file, "a film's times", kMaxResultBytes);
  std::vector<double> frames_s;
  for (const JsonValue& t_s : times.at("t_s").elements()) frames_s.push_back(t_s.get<double>());
  drive["film_fps"] = times.at("fps").get<double>();
  drive["film_t_s"] = std::move(frames_s);
}

TraceData ReadTraceData(std::string_view csv) {
  constexpr std::size_t kMostRows = 1500;
  const auto line_at = [&](std::size_t& at) {
    const std::size_t end = std::min(csv.find('\n', at), csv.size());
    const std::string_view line = csv.substr(at, end - at);
    at = end + 1;
    return line;
  };
  std::size_t at = 0;
  const std::vector<std::string_view> names = Fields(line_at(at));
  const auto column_of = [&](std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  const std::size_t t = column_of("t_s"), x = column_of("x_m"), y = column_of("y_m");
  if (std::max({t, x, y}) >= names.size()) return {nullptr, nullptr};
  const std::size_t rows = static_cast<std::size_t>(std::ranges::count(csv, '\n'));
  const std::size_t every = std::max<std::size_t>(1, rows / kMostRows);
  struct Curve {
    const char* name;
    double (*of)(std::span<const double> values);
    std::vector<std::size_t> columns;
    double per;
  };
  const Curve curves[] = {
      {"speed_mps",
       [](auto v) { return std::hypot(v[0], v[1]); },
       {column_of("vx_mps"), column_of("vy_mps")},
       1e3},
      {"tilt_deg",
       [](auto v) { return std::acos(std::cos(v[0]) * std::cos(v[1])) * 180 / kPi; },
       {column_of("roll_rad"), column_of("pitch_rad")},
       1e3},
      {"cross_track_mm", [](auto v) { return 1e3 * v[0]; }, {column_of("cross_track_m")}, 1e2},
      {"power_w", [](auto v) { return v[0]; }, {column_of("power_w")}, 1e2},
      {"coverage_percent", [](auto v) { return 100 * v[0]; }, {column_of("coverage")}, 1e2}};
  PageJson columns = {{"t_s", PageJson::array()}};
  std::vector<TraceRow> places;
  for (std::size_t row = 0; at < csv.size(); ++row) {
    const std::string_view line = line_at(at);
    if (row % every != 0 && at < csv.size()) continue;
    const std::vector<std::string_view> fields = Fields(line);
    if (fields.size() != names.size()) return {nullptr, nullptr};
    columns["t_s"].push_back(Rounded(NumberOf(fields[t]), 1e3));
    TraceRow& place = places.emplace_back();
    place.t_s = NumberOf(fields[t]);
    place.x_m = NumberOf(fields[x]);
    place.y_m = NumberOf(fields[y]);
    if (!std::isfinite(place.t_s + place.x_m + place.y_m)) return {nullptr, nullptr};
    for (const Curve& curve : curves) {
      if (std::ranges::any_of(curve.columns, [&](std::size_t c) { return c >= names.size(); }))
        continue;
      double values[2] = {};
      for (std::size_t k = 0; k < curve.columns.size(); ++k)
        values[k] = NumberOf(fields[curve.columns[k]]);
      const double value = curve.of(std::span<const double>(values));
      columns[curve.name].push_back(std::isfinite(value) ? PageJson(Rounded(value, curve.per))
                                                         : PageJson(nullptr));
    }
  }
  if (places.empty()) return {nullptr, nullptr};
  PageJson way = PageJson::array();
  for (const std::vector<Vec2>& stretch : WayDriven(places)) {
    if (!way.empty()) way.push_back({nullptr, nullptr});
    for (PageJson& p : PointsData(stretch)) way.push_back(std::move(p));
  }
  return {std::move(columns), std::move(way)};
}

PageJson SafetyData(std::string_view csv, const std::string& mission) {
  constexpr std::string_view kHead = "t_s,node,safety_state,level,machine_state,reason";
  std::size_t at = csv.find('\n');
  if (at == csv.npos || csv.substr(0, at) != kHead) return nullptr;
  PageJson times = {0}, states = {0}, levels = {"high"};
  const std::string whole = CsvField(mission.empty() ? "mission" : mission) + ",";
  for (++at; at < csv.size();) {
    const std::size_t end = std::min(csv.find('\n', at), csv.size());
    std::string_view line = csv.substr(at, end - at);
    at = end + 1;
    const double t_s = NumberOf(line);
    line.remove_prefix(std::min(line.size(), line.find(',')));
    if (line.empty() || !std::isfinite(t_s)) return nullptr;
    line.remove_prefix(1);
    if (!line.starts_with(whole)) continue;
    const std::vector<std::string_view> fields = Fields(line.substr(whole.size()));
    if (fields.size() < 4 || !std::isfinite(NumberOf(fields[0]))) return nullptr;
    times.push_back(t_s);
    states.push_back(NumberOf(fields[0]));
    levels.push_back(std::string(fields[1]));
  }
  return {{"t_s", std::move(times)}, {"state", std::move(states)}, {"level", std::move(levels)}};
}

}  // namespace floorproof
