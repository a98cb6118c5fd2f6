// SPDX-License-Identifier: Apache-2.0
#include "env/map/char_grid.h"

#include <algorithm>
#include <memory>

#include "base/json_schema.h"
#include "base/params.h"
#include "env/map/cell_shapes.h"
#include "env/map/ros_map.h"
#include "env/map/written_hazard.h"

namespace floorproof {
namespace {

constexpr std::size_t kMaxHazards = 10'000;
constexpr std::string_view kCharacters = ".#G?v^=gr";

void VisitGrid(ParamVisitor& v, double& cell_m, double& inset_m) {
  v("cell_m", cell_m, Between(0.01, 100), "width of a cell");
  v("inset_m", inset_m, NonNegative(), "solids drawn back towards free cells");
}
constexpr double kCell_m = 0.5;  // hTetro's own width

// A character that stands for a hazard, and what it measures unless grid.sizes says otherwise.
struct Kind {
  char character;
  const char* key;   // below grid.sizes
  const char* type;  // the plug-in
  enum class Shape { kArea, kPane, kRun } shape;
  double height_m = 0;  // not 0: the type's height_m, whose sign the character fixes
};
constexpr Kind kKinds[] = {
    {'G', "glass", "glass", Kind::Shape::kPane},
    {'v', "drop", "step", Kind::Shape::kArea, -0.15},   // a stair's riser, down
    {'^', "raised", "step", Kind::Shape::kArea, 0.15},  // and up
    {'=', "cable_cover", "cable_cover", Kind::Shape::kRun},
    {'g', "groove", "groove", Kind::Shape::kRun},
    {'r', "rough", "rough", Kind::Shape::kArea},
};

// The keys that one character's hazards are made with.
class Maker {
 public:
  Maker(const Kind& kind, const ConfigNode* sizes, const std::string& sizes_key)
      : kind_(kind), path_(sizes_key + "." + kind.key + ".") {
    if (sizes != nullptr) node_ = *sizes;
    if (!node_.IsMap() && !node_.IsNull())
      throw InputError(node_.mark, path_.substr(0, path_.size() - 1), "", "must be a map of keys");
    node_.kind = ConfigNode::Kind::kMap;
    if (kind.height_m != 0) ReadHeight();
    if (kind.shape == Kind::Shape::kPane) {
      const ConfigNode* thickness = node_.Find("thickness_m");
      fills_cell_ = thickness == nullptr || (thickness->IsScalar() && thickness->scalar == "cell");
      if (fills_cell_) node_.Remove("thickness_m");
    }
    type_ = Make(node_);
    common_.Read(node_, path_);
  }

  bool fills_cell() const { return fills_cell_; }
  const Kind& kind() const { return kind_; }

  // A hazard without footprint and solids, for Add() to fill.
  Hazard Empty() const {
    Hazard hazard;
    hazard.type = kind_.type;
    return hazard;
  }
  // Adds the footprint of one place and the solids of another (drawn back).
  void Add(Hazard& hazard, const std::vector<Vec2>& place, const std::vector<Vec2>& built) const {
    Append(hazard, *type_, *type_, place, built);
  }
  // Glass as thick as its cells: panes along the longer side.
  void AddFilled(Hazard& hazard, const Vec2& low, const Vec2& high, const Vec2& built_low,
                 const Vec2& built_high) const {
    const auto [place, thick] = CentreLine(low, high);
    const auto [built, built_thick] = CentreLine(built_low, built_high);
    Append(hazard, *MakeThick(thick), *MakeThick(built_thick), place, built);
  }

  static std::pair<std::vector<Vec2>, double> CentreLine(const Vec2& low, const Vec2& high) {
    const Vec2 size = high - low, middle = (low + high) / 2;
    if (size.x() > size.y()) return {{{low.x(), middle.y()}, {high.x(), middle.y()}}, size.y()};
    return {{{middle.x(), low.y()}, {middle.x(), high.y()}}, size.x()};
  }

  ConfigNode Resolved() const {
    ConfigNode node = ConfigNode::Map();
    WriteParams(*type_, node);
    if (fills_cell_) node.Add("thickness_m", ConfigNode::Scalar("cell"));
    // The shared keys' defaults are the type's own: made on a place of a metre.
    Hazard sample = MakeHazard(*type_, SamplePlace(), node_, path_);
    common_.Apply(sample);
    WriteCommonHazardKeys(sample, node);
    return node;
  }

 private:
  void ReadHeight() {
    const ConfigNode* height = node_.Find("height_m");
    if (height == nullptr) {
      node_.Add("height_m", ConfigNode::Scalar(FormatDouble(kind_.height_m)));
      return;
    }
    const double value = AsDouble(*height, path_ + "height_m");
    if (value * kind_.height_m <= 0)
      throw InputError(
          height->mark, path_ + "height_m", height->scalar,
          kind_.height_m < 0 ? "must be < 0: v is a drop" : "must be > 0: ^ is raised");
  }
  std::unique_ptr<HazardType> Make(const ConfigNode& node) const {
    auto type = MakePlugin(HazardTypes(), kind_.type, path_ + "type", node.mark);
    ReadParams(node, path_, *type, CommonHazardKeys::Names());
    return type;
  }
  std::unique_ptr<HazardType> MakeThick(double thickness_m) const {
    ConfigNode node = node_;
    node.Add("thickness_m", ConfigNode::Scalar(FormatDouble(thickness_m)));
    return Make(node);
  }
  std::vector<Vec2> SamplePlace() const {
    if (type_->placement() == HazardType::Placement::kLine) return {{0, 0}, {1, 0}};
    return Rectangle({0, 0}, {0.1, 0.1});
  }
  void Append(Hazard& hazard, HazardType& type, HazardType& built_type,
              const std::vector<Vec2>& place, const std::vector<Vec2>& built) const {
    Hazard whole = MakeHazard(type, place, node_, path_);
    const Hazard drawn_back = MakeHazard(built_type, built, node_, path_);
    whole.type = kind_.type;
    common_.Apply(whole);
    whole.footprint.insert(whole.footprint.begin(), hazard.footprint.begin(),
                           hazard.footprint.end());
    whole.solids = std::move(hazard.solids);
    whole.solids.insert(whole.solids.end(), drawn_back.solids.begin(), drawn_back.solids.end());
    hazard = std::move(whole);
  }

  const Kind& kind_;
  std::string path_;
  ConfigNode node_;
  std::unique_ptr<HazardType> type_;
  CommonHazardKeys common_;
  bool fills_cell_ = false;
};

std::vector<std::string> SplitRows(const std::string& text) {
  std::vector<std::string> rows;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string row = text.substr(at, end - at);
    while (!row.empty() && (row.back() == ' ' || row.back() == '\r' || row.back() == '\t'))
      row.pop_back();
    rows.push_back(std::move(row));
    at = end + 1;
  }
  while (!rows.empty() && rows.back().empty()) rows.pop_back();
  return rows;
}

Grid<char> ReadRows(const ConfigNode& grid) {
  const ConfigNode* node = grid.Find("rows");
  if (node == nullptr || !node->IsScalar())
    throw InputError(node == nullptr ? grid.mark : node->mark, "grid.rows", "",
                     "must be the drawing: 'rows: |', then a line a row, top row first");
  const std::vector<std::string> rows = SplitRows(node->scalar);
  if (rows.empty() || rows[0].empty())
    throw InputError(node->mark, "grid.rows", "", "must have a row of at least one character");
  // A block's text begins on the line below its key.
  const auto at = [&](std::size_t row) {
    const bool block = rows.size() > 1 && node->quoted;
    SourceMark mark = node->mark;
    if (mark.line > 0 && block) mark.line += static_cast<int>(row) + 1;
    return mark;
  };
  Grid<char> chars(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::string key = "grid.rows[" + std::to_string(r) + "]";
    for (std::size_t x = 0; x < rows[r].size(); ++x)
      if (kCharacters.find(rows[r][x]) == std::string_view::npos)
        throw InputError(at(r), key, rows[r],
                         "unknown character at column " + std::to_string(x + 1) +
                             " (known: " + std::string(kCharacters) + ")");
    if (rows[r].size() != rows[0].size())
      throw InputError(at(r), key, rows[r],
                       "has " + std::to_string(rows[r].size()) + " characters, the top row " +
                           std::to_string(rows[0].size()));
    for (std::size_t x = 0; x < rows[r].size(); ++x)
      chars(static_cast<int>(x), static_cast<int>(rows.size() - 1 - r)) = rows[r][x];
  }
  return chars;
}

// How far the solids of a box go beyond its cells, a side: -inset towards floor that is driven on,
// +inset towards walls (drawn back themselves), else 0.
double Overhang(const Grid<char>& chars, const CellBox& beyond, double inset_m) {
  bool wall = false;
  for (int y = beyond.y0; y < beyond.y1; ++y)
    for (int x = beyond.x0; x < beyond.x1; ++x) {
      if (!chars.Inside(x, y)) return inset_m;
      if (IsDrivable(chars(x, y))) return -inset_m;
      wall |= chars(x, y) == '#';
    }
  return wall ? inset_m : 0;
}

struct Placed {
  Cell first;
  Hazard hazard;
};

class GridHazards {
 public:
  GridHazards(const Grid<char>& chars, double cell_m, double inset_m)
      : chars_(chars), cell_m_(cell_m), inset_m_(inset_m) {}

  void Add(const Maker& maker, const SourceMark& mark) {
    const Kind& kind = maker.kind();
    if (kind.shape == Kind::Shape::kRun) {
      for (const CellRun& run : Runs(chars_, kind.character)) {
        Hazard hazard = maker.Empty();
        maker.Add(hazard, Line(run, 0), Line(run, inset_m_));
        Place(run.first, std::move(hazard), mark);
      }
      return;
    }
    for (const CellArea& area : JoinedAreas(chars_, kind.character)) {
      Hazard hazard = maker.Empty();
      for (const CellBox& box : area.boxes) AddBox(maker, box, hazard);
      Place(area.first, std::move(hazard), mark);
    }
  }

  std::vector<Hazard> InReadingOrder() && {
    std::ranges::stable_sort(placed_, [](const Placed& a, const Placed& b) {
      return a.first.iy > b.first.iy || (a.first.iy == b.first.iy && a.first.ix < b.first.ix);
    });
    std::vector<Hazard> hazards;
    for (Placed& p : placed_) hazards.push_back(std::move(p.hazard));
    return hazards;
  }

 private:
  void Place(Cell first, Hazard hazard, const SourceMark& mark) {
    if (placed_.size() >= kMaxHazards)
      throw InputError(mark, "grid.rows", "",
                       "draws more than " + std::to_string(kMaxHazards) + " hazards");
    placed_.push_back({first, std::move(hazard)});
  }

  void AddBox(const Maker& maker, const CellBox& b, Hazard& hazard) const {
    const Vec2 low = cell_m_ * Vec2(b.x0, b.y0), high = cell_m_ * Vec2(b.x1, b.y1);
    const Vec2 built_low = low - Vec2(Overhang(chars_, {b.x0 - 1, b.y0, b.x0, b.y1}, inset_m_),
                                      Overhang(chars_, {b.x0, b.y0 - 1, b.x1, b.y0}, inset_m_));
    const Vec2 built_high = high + Vec2(Overhang(chars_, {b.x1, b.y0, b.x1 + 1, b.y1}, inset_m_),
                                        Overhang(chars_, {b.x0, b.y1, b.x1, b.y1 + 1}, inset_m_));
    if (maker.kind().shape == Kind::Shape::kArea) {
      maker.Add(hazard, Rectangle(low, high), Rectangle(built_low, built_high));
    } else if (maker.fills_cell()) {
      maker.AddFilled(hazard, low, high, built_low, built_high);
    } else {
      const std::vector<Vec2> line = Maker::CentreLine(low, high).first;
      maker.Add(hazard, line, line);
    }
  }

  // To the middle of another strip's cell, and so far into walls.
  std::vector<Vec2> Line(const CellRun& run, double into_wall_m) const {
    const auto beyond = [&](CellRun::End end) {
      if (end == CellRun::End::kJoin) return cell_m_ / 2;
      return end == CellRun::End::kWall ? into_wall_m : 0.0;
    };
    const Vec2 along = run.along_x ? Vec2(1, 0) : Vec2(0, 1);
    const Vec2 low = cell_m_ * Vec2(run.box.x0, run.box.y0);
    const Vec2 high = cell_m_ * Vec2(run.box.x1, run.box.y1);
    const Vec2 half = cell_m_ / 2 * (Vec2(1, 1) - along);
    return {low + half - along * beyond(run.before), high - half + along * beyond(run.after)};
  }

  const Grid<char>& chars_;
  double cell_m_, inset_m_;
  std::vector<Placed> placed_;
};

CellState StateOf(char c) {
  if (c == '#') return CellState::kOccupied;
  return c == '?' ? CellState::kUnknown : CellState::kFree;
}

}  // namespace

CharGrid ReadCharGrid(const ConfigNode& node, const std::string& key) {
  if (!node.IsMap()) throw InputError(node.mark, key, "", "must be a map of keys");
  CharGrid grid;
  double cell_m = kCell_m;
  ReadParams(node, key + ".", [&](ParamVisitor& v) { VisitGrid(v, cell_m, grid.inset_m); },
             {"rows", "sizes"});
  if (grid.inset_m >= cell_m / 2)
    throw InputError(node.Find("inset_m") ? node.Find("inset_m")->mark : node.mark,
                     key + ".inset_m", FormatDouble(grid.inset_m),
                     "must be less than half of cell_m");
  const Grid<char> chars = ReadRows(node);
  const SourceMark rows_mark = node.Find("rows")->mark;
  grid.frame = {chars.width, chars.height, cell_m, {}};
  CheckFloorSize(grid.frame, rows_mark, "grid.cell_m");
  grid.occupancy = Grid<CellState>(chars.width, chars.height);
  std::ranges::transform(chars.cells, grid.occupancy.cells.begin(), StateOf);

  const ConfigNode* sizes = node.Find("sizes");
  const std::string sizes_key = key + ".sizes";
  if (sizes != nullptr) {
    std::vector<std::string> known;
    for (const Kind& kind : kKinds) known.emplace_back(kind.key);
    if (!sizes->IsMap()) throw InputError(sizes->mark, sizes_key, "", "must be a map of keys");
    RefuseUnknownKeys(*sizes, sizes_key + ".", known);
  }
  grid.resolved = ConfigNode::Map();
  grid.resolved.Add("cell_m", ConfigNode::Scalar(FormatDouble(cell_m)));
  grid.resolved.Add("inset_m", ConfigNode::Scalar(FormatDouble(grid.inset_m)));
  std::string drawing;
  for (const std::string& row : SplitRows(node.Find("rows")->scalar)) drawing += row + "\n";
  grid.resolved.Add("rows", ConfigNode::Scalar(drawing, true));
  ConfigNode& resolved_sizes = grid.resolved.Add("sizes", ConfigNode::Map());
  GridHazards hazards(chars, cell_m, grid.inset_m);
  for (const Kind& kind : kKinds) {
    const Maker maker(kind, sizes == nullptr ? nullptr : sizes->Find(kind.key), sizes_key);
    hazards.Add(maker, rows_mark);
    resolved_sizes.Add(kind.key, maker.Resolved());
  }
  grid.hazards = std::move(hazards).InReadingOrder();
  return grid;
}

ConfigNode CharSizesSchema() {
  MapSchema sizes;
  for (const Kind& kind : kKinds) {
    const auto type = MakePlugin(HazardTypes(), kind.type, "type");
    ConfigNode usual = ConfigNode::Map();
    if (kind.height_m != 0) usual.Add("height_m", ConfigNode::Scalar(FormatDouble(kind.height_m)));
    ReadParams(usual, "", *type);
    MapSchema keys;
    keys.Params(*type);
    CommonHazardKeys::AddTo(keys);
    if (kind.height_m != 0)
      keys.At("height_m")
          .Add(kind.height_m < 0 ? "exclusiveMaximum" : "exclusiveMinimum",
               ConfigNode::Scalar("0"));
    if (kind.shape == Kind::Shape::kPane) {
      ConfigNode number = keys.At("thickness_m");
      for (const char* own : {"default", "description"}) number.Remove(own);
      keys.Key("thickness_m", AnyOf({std::move(number), ChoiceSchema({"cell"})}),
               "of its panes (m); cell: as thick as their cells (default cell)");
    }
    sizes.Key(kind.key, OrNull(keys.Node()), std::string(1, kind.character) + " in the drawing");
  }
  return sizes.Node();
}

ConfigNode CharGridSchema() {
  MapSchema map;
  CharGrid grid;
  double cell_m = kCell_m;
  map.Params([&](ParamVisitor& v) { VisitGrid(v, cell_m, grid.inset_m); })
      .Key("rows", TextSchema("^[" + std::string(kCharacters) + " \\t\\r\\n]*$"),
           "the drawing, a line a row, top row first: . free, # wall, G glass, v drop, ^ raised, = "
           "cable cover, g groove, r rough, ? unknown")
      .Require("rows")
      .Key("sizes", CharSizesSchema(), "what a character's hazard measures");
  return map.Node();
}

}  // namespace floorproof
