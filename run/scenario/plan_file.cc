// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/plan_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "base/comma_list.h"
#include "base/config.h"
#include "base/params.h"
#include "env/core/coverage.h"

namespace floorproof {
namespace {

const std::vector<std::string> kColumns = {"x_m",   "y_m",       "yaw_rad",
                                           "shape", "speed_mps", "dwell_s"};
const std::vector<std::string> kPlaceColumns = {"x_m", "y_m"};
constexpr std::uintmax_t kMaxBytes = 32u << 20;
// 12.5 km of a waypoint each 50 mm: more than a battery lasts.
constexpr std::size_t kMaxRows = 250'000;
// Beyond these a drive has no end; the dwells count together.
constexpr double kSlowest_mps = 1e-3, kLongestDwell_s = 1e5;

std::vector<std::string> SplitRow(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  return SplitAtCommas(line);
}

// Nothing in such a file holds one.
void RefuseSemicolons(const std::string& line, const SourceMark& mark) {
  if (line.find(';') != line.npos)
    throw InputError(mark, "", "", "is divided by semicolons: must be by commas");
}

// A first row without a column's name, or one like it, belongs to another kind of file, which may
// hold a secret: it is not quoted.
void RefuseOtherKinds(const std::vector<std::string>& header, const SourceMark& mark,
                      const std::vector<std::string>& columns) {
  if (std::ranges::none_of(
          header, [&](const std::string& name) { return !Nearest(name, columns).empty(); }))
    throw InputError(mark, "", "", "is no row of column names: the first row names x_m,y_m,...");
}

std::vector<std::string> ReadHeader(const std::string& line, const SourceMark& mark,
                                    const std::vector<std::string>& columns) {
  RefuseSemicolons(line, mark);
  const auto header = SplitRow(line);
  RefuseOtherKinds(header, mark, columns);
  for (const auto& name : header) {
    if (std::ranges::find(columns, name) == columns.end()) {
      const std::string near = DidYouMean(name, columns);
      throw InputError(
          mark, name, "",
          "unknown column" +
              (near.empty() ? " (the first row names the columns: x_m,y_m,...)" : near));
    }
    if (std::ranges::count(header, name) > 1)
      throw InputError(mark, name, "", "the column stands twice");
  }
  for (const char* needed : {"x_m", "y_m"})
    if (std::ranges::find(header, needed) == header.end())
      throw InputError(mark, needed, "", "the column is missing");
  return header;
}

std::string ReadShape(const std::string& text, const SourceMark& mark) {
  const bool word = text.size() <= 32 && std::ranges::all_of(text, [](unsigned char c) {
                      return std::isalnum(c) || c == '_' || c == '-';
                    });
  if (!word)
    throw InputError(mark, "shape", text, "must be at most 32 letters, digits, '_' or '-'");
  return text;
}

Waypoint ReadRow(const std::vector<std::string>& header, const std::vector<std::string>& cells,
                 const SourceMark& mark) {
  Waypoint w;
  for (std::size_t i = 0; i < header.size(); ++i) {
    const std::string& name = header[i];
    if (name == "shape") {
      w.shape = ReadShape(cells[i], mark);
      continue;
    }
    if (cells[i].empty() && name != "x_m" && name != "y_m") continue;
    ConfigNode node = ConfigNode::Scalar(cells[i]);
    node.mark = mark;
    if (name == "x_m") w.p_W.x() = AsDouble(node, name);
    if (name == "y_m") w.p_W.y() = AsDouble(node, name);
    if (name == "yaw_rad") w.yaw_rad = AsDouble(node, name);
    if (name == "speed_mps") w.speed_mps = AsDouble(node, name);
    if (name == "dwell_s") w.dwell_s = AsDouble(node, name);
  }
  return w;
}

// What a row is, in messages where there is none.
Path ReadRows(const std::filesystem::path& file, const GridFrame& map,
              const std::vector<std::string>& columns, const char* row, std::vector<int>* lines,
              const InputFiles& files) {
  const std::string name = file.string();
  std::istringstream in(files.Read(file, kMaxBytes));
  std::vector<std::string> header;
  Path path;
  int number = 0;
  double dwell_s = 0;
  if (in.str().starts_with("\xEF\xBB\xBF")) in.seekg(3);  // spreadsheets put a byte order mark
  for (std::string line; std::getline(in, line);) {
    const SourceMark mark{name, ++number};
    if (line.empty() || line == "\r" || line[0] == '#') continue;
    if (header.empty()) {
      header = ReadHeader(line, mark, columns);
      continue;
    }
    RefuseSemicolons(line, mark);
    const auto cells = SplitRow(line);
    if (cells.size() != header.size())
      throw InputError(mark, "", "",
                       "has " + std::to_string(cells.size()) + " columns, the first row " +
                           std::to_string(header.size()));
    if (path.size() == kMaxRows)
      throw InputError(
          mark, "", "",
          "a file has at most " + std::to_string(kMaxRows) + " rows, a " + row + " each");
    const Waypoint w = ReadRow(header, cells, mark);
    CheckWaypoint(w, map, mark, dwell_s);
    path.push_back(w);
    if (lines) lines->push_back(number);
  }
  if (path.empty())
    throw InputError({name, std::max(1, number)}, "", "", std::string("holds no ") + row);
  return path;
}

}  // namespace

void CheckWaypoint(const Waypoint& w, const GridFrame& map, const SourceMark& mark,
                   double& dwell_s) {
  const auto require = [&](const char* name, double value, const Bounds& rule = {}) {
    if (!rule.Allows(value)) throw InputError(mark, name, FormatDouble(value), rule.Text());
  };
  require("x_m", w.p_W.x());
  require("y_m", w.p_W.y());
  if (w.yaw_rad) require("yaw_rad", *w.yaw_rad);
  require("speed_mps", w.speed_mps, NonNegative());
  if (w.speed_mps > 0 && w.speed_mps < kSlowest_mps)
    throw InputError(mark, "speed_mps", FormatDouble(w.speed_mps),
                     "must be at least " + FormatDouble(kSlowest_mps) + " (none: cruise speed)");
  require("dwell_s", w.dwell_s, Between(0, kLongestDwell_s));
  if (!map.Inside(map.ToCell(w.p_W)))
    throw InputError(mark, "x_m, y_m", FormatDouble(w.p_W.x()) + ", " + FormatDouble(w.p_W.y()),
                     "lies off the map");
  dwell_s += w.dwell_s;
  if (dwell_s > kLongestDwell_s)
    throw InputError(
        mark, "dwell_s", FormatDouble(w.dwell_s),
        fmt::format("makes more than {:.0f} s together with those above", kLongestDwell_s));
}

Path ReadPlan(const std::filesystem::path& file, const GridFrame& map, std::vector<int>* lines,
              const InputFiles& files) {
  return ReadRows(file, map, kColumns, "waypoint", lines, files);
}

std::vector<Vec2> ReadPlaces(const std::filesystem::path& file, const GridFrame& map,
                             const InputFiles& files) {
  std::vector<int> lines;
  const Path rows = ReadRows(file, map, kPlaceColumns, "place", &lines, files);
  const GridFrame fine = FineFrame(map);
  std::map<std::pair<int, int>, int> line_of;  // by cell
  std::vector<Vec2> places;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Vec2& p = rows[i].p_W;
    const Cell cell = fine.ToCell(p);
    const auto [it, fresh] = line_of.try_emplace({cell.ix, cell.iy}, lines[i]);
    if (!fresh)
      throw InputError({file.string(), lines[i]}, "x_m, y_m",
                       FormatDouble(p.x()) + ", " + FormatDouble(p.y()),
                       fmt::format("lies in the same cell of {} m as the place in line {}",
                                   FormatDouble(fine.cell_m), it->second));
    places.push_back(p);
  }
  return places;
}

std::string PlanCsv(const Path& path) {
  std::string out = "x_m,y_m,yaw_rad,shape,speed_mps,dwell_s\n";
  for (const auto& w : path) {
    out += FormatDouble(w.p_W.x()) + "," + FormatDouble(w.p_W.y()) + ",";
    if (w.yaw_rad) out += FormatDouble(*w.yaw_rad);
    out += "," + w.shape + ",";
    if (w.speed_mps > 0) out += FormatDouble(w.speed_mps);
    out += ",";
    if (w.dwell_s > 0) out += FormatDouble(w.dwell_s);
    out += "\n";
  }
  return out;
}

}  // namespace floorproof
