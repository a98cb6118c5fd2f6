// SPDX-License-Identifier: Apache-2.0
#include "env/map/site_generator.h"

#include <algorithm>
#include <cmath>

#include "base/quantity.h"
#include "env/map/char_grid.h"
#include "env/map/ros_map.h"

namespace floorproof {
namespace {

constexpr int kLeastCells = 3, kMaxCells = 4000;
constexpr int kMaxCellsInAll = 4'000'000;  // so that the drawing fits in a file that can be read
constexpr int kMaxOfAKind = 1000;          // all seven stay below a drawing's 10,000 hazards
constexpr int kMaxClusterCells = 10'000;
const Bounds kCountOfAKind = Between(0, kMaxOfAKind), kSeed = Between(0, 2147483647.0),
             kClusterCells = Between(1, kMaxClusterCells);
constexpr int kShareForMore = 3;  // what need not be there, while hazards take a third of the floor

// How many drawings are tried before a site is refused as too full. A large site gets fewer,
// because chance evens out there and each drawing takes its time.
int MostDrawings(const GenerateParams& p) {
  constexpr int kMax = 20;
  return std::clamp(kMaxCellsInAll / (p.width * p.height), 1, kMax);
}

// After the sites of the hTetro FMEA paper, section 4: 11 x 11, 12 x 12 and 6 x 6 cells of 0.5 m
// beside a staircase, before glass, with a cable cover and a level change.
void LikeThePapersSites(GenerateParams& p) {
  p.width = p.height = 12;
  p.obstacle_density = 0.04;
  p.cluster_cells = {1, 4};
  p.hazards.mixed = {1, 3};
  p.hazards.drop = p.hazards.raised = p.hazards.cable_cover = p.hazards.groove = {0, 1};
}

struct MixKey {
  const char* name;
  char character;  // 0: drawn
  bool strip;
  IntRange HazardMix::*count;
};
// In the order in which they are drawn: what needs the most room first.
constexpr MixKey kMix[] = {
    {"cable_cover", '=', true, &HazardMix::cable_cover},
    {"groove", 'g', true, &HazardMix::groove},
    {"drop", 'v', false, &HazardMix::drop},
    {"raised", '^', false, &HazardMix::raised},
    {"glass", 'G', false, &HazardMix::glass},
    {"rough", 'r', false, &HazardMix::rough},
    {"mixed", 0, false, &HazardMix::mixed},
};

// N, or [low, high].
IntRange ReadRange(const ConfigNode& node, const std::string& key, const Bounds& rule) {
  if (!node.IsList()) {
    const int n = static_cast<int>(AsInt(node, key, rule));
    return {n, n};
  }
  if (node.items.size() != 2)
    throw InputError(node.mark, key, "", "must be a whole number or a range [least, most]");
  const IntRange range = {static_cast<int>(AsInt(node.items[0], key + "[0]", rule)),
                          static_cast<int>(AsInt(node.items[1], key + "[1]", rule))};
  if (range.low > range.high)
    throw InputError(node.items[1].mark, key + "[1]", node.items[1].scalar,
                     "must be at least the range's first number");
  return range;
}

ConfigNode RangeSchema(const Bounds& rule) {
  return AnyOf({WholeSchema(rule), ListSchema(WholeSchema(rule), 2, 2)});
}

ConfigNode Pair(int a, int b) {
  return ConfigNode::List(
      {ConfigNode::Scalar(std::to_string(a)), ConfigNode::Scalar(std::to_string(b))});
}

ConfigNode WriteRange(const IntRange& range) {
  if (range.low == range.high) return ConfigNode::Scalar(std::to_string(range.low));
  return Pair(range.low, range.high);
}

void ReadCells(const ConfigNode& node, GenerateParams& p) {
  const std::string key = "generate.cells";
  const auto side = [](const ConfigNode& written, const std::string& of) {
    const std::int64_t n = AsInt(written, of);
    if (n < kLeastCells)
      throw InputError(written.mark, of, written.scalar,
                       "must be at least " + std::to_string(kLeastCells) +
                           ": the outer wall is counted, and one cell of floor lies within it");
    if (n > kMaxCells)
      throw InputError(written.mark, of, written.scalar,
                       "must be at most " + std::to_string(kMaxCells));
    return static_cast<int>(n);
  };
  if (node.IsList() && node.items.size() != 2)
    throw InputError(node.mark, key, "", "must be [width, height], or one number for a square");
  const bool pair = node.IsList();
  p.width = pair ? side(node.items[0], key + "[0]") : side(node, key);
  p.height = pair ? side(node.items[1], key + "[1]") : p.width;
  if (p.width > kMaxCellsInAll / p.height)
    throw InputError(node.mark, key, std::to_string(p.width) + " x " + std::to_string(p.height),
                     "must be at most " + std::to_string(kMaxCellsInAll) + " cells in all");
}

void ReadMix(const ConfigNode& node, HazardMix& mix) {
  if (!node.IsMap())
    throw InputError(node.mark, "generate.hazards", "", "must be a map of types to counts");
  std::vector<std::string> known;
  for (const MixKey& key : kMix) known.emplace_back(key.name);
  RefuseUnknownKeys(node, "generate.hazards.", known);
  for (const MixKey& key : kMix)
    if (const ConfigNode* count = node.Find(key.name))
      mix.*key.count =
          ReadRange(*count, std::string("generate.hazards.") + key.name, kCountOfAKind);
}

// The grid that is drawn, still without its rows. What `generate` says is taken with its lines.
ConfigNode GridOf(const GenerateParams& p, const ConfigNode& node) {
  ConfigNode grid = ConfigNode::Map();
  grid.mark = node.mark;
  grid.Add("cell_m", ConfigNode::Scalar(FormatDouble(p.cell_m)));
  grid.Add("inset_m", ConfigNode::Scalar(FormatDouble(p.inset_m)));
  for (const char* key : {"inset_m", "sizes"})
    if (const ConfigNode* written = node.Find(key)) grid.Add(key, *written);
  return grid;
}

const SiteKind& KindOf(const GenerateParams& p) {
  return *std::ranges::find_if(SiteKinds(), [&](const SiteKind& k) { return k.name == p.kind; });
}

// The named key below `node`, or the node: where a refusal points.
const ConfigNode& Written(const ConfigNode& node, const std::string& key) {
  const std::size_t dot = key.find('.');
  const ConfigNode* found = node.Find(key.substr(0, dot));
  if (found == nullptr) return node;
  return dot == std::string::npos ? *found : Written(*found, key.substr(dot + 1));
}

// Draws all that stands within the walls; the key for which there was no room, or empty.
std::string Populate(const GenerateParams& p, int furniture_cells, FloorDrawing& floor,
                     Stream& stream) {
  const SiteKind& kind = KindOf(p);
  const int for_more = floor.FreeCells() / kShareForMore, cells = floor.FreeCells();
  for (const MixKey& key : kMix) {
    const IntRange& range = p.hazards.*key.count;
    const int wanted = range.Draw(stream);
    for (int i = 0; i < wanted; ++i) {
      const bool must = i < range.low;
      const int left = for_more - (cells - floor.FreeCells());
      if (!must && left < 1) break;
      IntRange size = p.cluster_cells;
      if (!must) size = {std::min(size.low, left), std::min(size.high, left)};
      const char c = key.character != 0 ? key.character : "Gv^r"[stream.Below(4)];
      const bool at_border = kind.level_changes_at_border && (c == 'v' || c == '^');
      if (key.strip ? floor.AddStrip(c, stream) : floor.AddCluster(c, size, at_border, stream))
        continue;
      if (must) return std::string("hazards.") + key.name;
      break;
    }
  }
  return floor.Furnish(furniture_cells, p.cluster_cells, stream) ? "" : "obstacle_density";
}

ConfigNode Place(const GenerateParams& p, Cell cell) {
  const Vec2 p_W = GridFrame{p.width, p.height, p.cell_m, {}}.Center(cell);
  ConfigNode place = ConfigNode::Map();
  place.Add("x_m", ConfigNode::Scalar(FormatDouble(p_W.x())));
  place.Add("y_m", ConfigNode::Scalar(FormatDouble(p_W.y())));
  return place;
}

}  // namespace

const std::vector<SiteKind>& SiteKinds() {
  static const std::vector<SiteKind> kKinds = {
      {"room", "one room with furniture", false, false, [](GenerateParams&) {}},
      {"rooms", "rooms joined by doors, with furniture", true, false,
       [](GenerateParams& p) { p.width = 30, p.height = 20; }},
      {"fmea",
       "a small floor with clusters of hazards, strips that split it, level changes at its border",
       false, true, LikeThePapersSites},
  };
  return kKinds;
}

void GenerateParams::Visit(ParamVisitor& v) {
  std::vector<std::string> kinds;
  for (const SiteKind& k : SiteKinds()) kinds.emplace_back(k.name);
  v("kind", kind, kinds, "what is drawn");
  v("cell_m", cell_m, Between(0.01, 100), "width of a cell");
  v("inset_m", inset_m, NonNegative(), "solids drawn back towards free cells");
  v("obstacle_density", obstacle_density, Between(0, 0.5),
    "share of the cells within the walls that are blind objects");
  v("room_cells", room_cells, Between(2, kMaxCells), "least side of a room, within its walls");
  v("door_cells", door_cells, Between(1, kMaxCells), "width of a door");
}

GenerateParams ReadGenerate(const ConfigNode& node) {
  GenerateParams p;
  const std::vector<std::string> others = {"cells", "cluster_cells", "hazards", "sizes", "seed"};
  const auto read = [&] {
    ReadParams(
        node, "generate.", [&](ParamVisitor& v) { p.Visit(v); }, others);
  };
  read();
  KindOf(p).defaults(p);  // they hang on the kind, and what is written wins
  read();
  if (const ConfigNode* cells = node.Find("cells")) ReadCells(*cells, p);
  if (const ConfigNode* cells = node.Find("cluster_cells"))
    p.cluster_cells = ReadRange(*cells, "generate.cluster_cells", kClusterCells);
  if (const ConfigNode* mix = node.Find("hazards")) ReadMix(*mix, p.hazards);
  if (const ConfigNode* seed = node.Find("seed"))
    p.seed = static_cast<int>(AsInt(*seed, "generate.seed", kSeed));
  CheckFloorSize({p.width, p.height, p.cell_m, {}}, Written(node, "cells").mark, "generate.cells");
  // What the drawing's reader would refuse is refused here, in the words that were written.
  ConfigNode sample = GridOf(p, node);
  sample.Add("rows", ConfigNode::Scalar("."));
  p.sizes = *ReadCharGrid(sample, "generate").resolved.Find("sizes");
  return p;
}

std::vector<NamedSchema> GenerateSchemas() {
  MapSchema mix;
  for (const MixKey& key : kMix)
    mix.Key(key.name, RangeSchema(kCountOfAKind),
            key.strip ? "strips from wall to wall: how many, or [least, most]"
                      : "clusters: how many, or [least, most]");
  std::vector<NamedSchema> kinds;
  for (const SiteKind& kind : SiteKinds()) {
    GenerateParams p;
    kind.defaults(p);
    MapSchema keys;
    keys.Params([&](ParamVisitor& v) { p.Visit(v); })
        .Key("cells", RangeSchema(Between(kLeastCells, kMaxCells)),
             "[width, height] in cells, outer wall included, or one number for a square")
        .Key("cluster_cells", RangeSchema(kClusterCells),
             "about the size of a cluster, or of a piece of furniture, in cells")
        .Key("hazards", mix.Node(), "how many of each type")
        .Key("sizes", CharSizesSchema(), "what a character's hazard measures")
        .Key("seed", WholeSchema(kSeed), "makes it one fixed site");
    kinds.push_back({kind.name, kind.help, std::move(keys)});
  }
  return kinds;
}

ConfigNode WriteGenerate(const GenerateParams& params) {
  GenerateParams p = params;
  ConfigNode node = ConfigNode::Map();
  WriteParams([&](ParamVisitor& v) { p.Visit(v); }, node);
  node.Add("cells", Pair(p.width, p.height));
  node.Add("cluster_cells", WriteRange(p.cluster_cells));
  ConfigNode& hazards = node.Add("hazards", ConfigNode::Map());
  for (const MixKey& key : kMix) hazards.Add(key.name, WriteRange(p.hazards.*key.count));
  node.Add("sizes", p.sizes);
  if (p.seed) node.Add("seed", ConfigNode::Scalar(std::to_string(*p.seed)));
  return node;
}

ConfigNode DrawSite(const GenerateParams& p, const ConfigNode& node, Stream& stream) {
  FloorDrawing walls(p.width, p.height);
  if (KindOf(p).has_rooms) walls.DivideIntoRooms(p.room_cells, p.door_cells, stream);
  const int furniture_cells = static_cast<int>(std::lround(p.obstacle_density * walls.FreeCells()));
  FloorDrawing floor = walls;
  std::string full = Populate(p, furniture_cells, floor, stream);
  const int most = MostDrawings(p);
  for (int drawings = 1; !full.empty(); ++drawings) {
    if (drawings == most) {
      const ConfigNode& written = Written(node, full);
      throw InputError(written.mark, "generate." + full, written.scalar,
                       "no room for so much on " + std::to_string(p.width) + " x " +
                           std::to_string(p.height) + " cells, in " + CountText(most, "drawing"));
    }
    floor = walls;
    full = Populate(p, furniture_cells, floor, stream);
  }
  const FloorDrawing::Ends ends = floor.ChooseEnds(stream);
  ConfigNode site = ConfigNode::Map();
  ConfigNode& grid = site.Add("grid", GridOf(p, node));
  grid.Add("rows", ConfigNode::Scalar(floor.Rows(), true)).mark = node.mark;
  site.Add("start", Place(p, ends.start)).Add("yaw_deg", ConfigNode::Scalar("0"));
  site.Add("goal", Place(p, ends.goal));
  return site;
}

}  // namespace floorproof
