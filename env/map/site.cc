// SPDX-License-Identifier: Apache-2.0
// A site file is first read as it is written (ReadWritten). It then either becomes a HazardMap or
// is written again with every default stated. Both start from the same structure, so they cannot
// differ.
#include "env/map/site.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "base/input_file.h"
#include "base/name_param.h"
#include "base/params.h"
#include "base/quantity.h"
#include "env/core/failure_text.h"
#include "env/core/ramp_ends.h"
#include "env/core/slopes.h"
#include "env/geometry/box.h"
#include "env/map/char_grid.h"
#include "env/map/generate.h"
#include "env/map/lay_floors.h"
#include "env/map/site_keys.h"
#include "env/map/written_hazard.h"
#include "media/media.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kKnown = {"site",    "name",  "map",     "grid",  "generate",
                                         "unknown", "floor", "hazards", "start", "goal"};

struct Written {
  std::string name;
  fs::path ros_map;  // empty: a grid
  CharGrid grid;
  ConfigNode generate;  // resolved; none: a map or a drawing
  bool unknown_is_wall = true;
  double floor_friction = kFloorFriction;
  std::vector<WrittenHazard> hazards;
  std::optional<Pose2> start;
  std::optional<Vec2> goal;
  double start_yaw_deg = 0;
};

void ReadPlaces(const ConfigNode& node, Written& site) {
  const auto need = [](const ConfigNode& at, const std::string& path) {
    for (const char* key : {"x_m", "y_m"})
      if (at.Find(key) == nullptr) throw InputError(at.mark, path + key, "", "missing");
  };
  if (const ConfigNode* start = node.Find("start")) {
    Pose2 pose;
    ReadParams(*start, "start.",
               [&](ParamVisitor& v) { VisitSiteStart(v, pose, site.start_yaw_deg); });
    need(*start, "start.");
    pose.yaw_rad = WrapAngle(site.start_yaw_deg * kPi / 180);
    site.start = pose;
  }
  if (const ConfigNode* goal = node.Find("goal")) {
    Vec2 p = Vec2::Zero();
    ReadParams(*goal, "goal.", [&](ParamVisitor& v) { VisitSiteGoal(v, p); });
    need(*goal, "goal.");
    site.goal = p;
  }
}

void ReadFloor(const ConfigNode& node, Written& site) {
  if (const ConfigNode* unknown = node.Find("unknown")) {
    const std::string text = AsString(*unknown, "unknown");
    if (text != "wall" && text != "free")
      throw InputError(unknown->mark, "unknown", text, "must be wall or free");
    site.unknown_is_wall = text == "wall";
  }
  if (const ConfigNode* floor = node.Find("floor"))
    ReadParams(*floor, "floor.", [&](ParamVisitor& v) { VisitSiteFloor(v, site.floor_friction); });
}

void ReadHazards(const ConfigNode& node, Written& site) {
  const ConfigNode* list = node.Find("hazards");
  if (list != nullptr && !list->IsNull()) {
    if (!list->IsList() || list->items.size() > kMostSiteHazards)
      throw InputError(
          list->mark, "hazards", list->IsList() ? CountText(list->items.size(), "hazard") : "",
          "must be a list of at most " + std::to_string(kMostSiteHazards) + " hazards");
    std::size_t corners = 0;
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      const std::string key = "hazards[" + std::to_string(i) + "]";
      site.hazards.push_back(ReadHazard(list->items[i], key));
      const WrittenHazard& hazard = site.hazards.back();
      corners += hazard.place.size();
      if (corners > kMaxSiteCorners)
        throw InputError(hazard.place_mark, hazard.place_key,
                         CountText(corners, "corner") + " up to here",
                         "a site's hazards have at most " + std::to_string(kMaxSiteCorners) +
                             " corners together");
    }
  }
  std::vector<Hazard*> all;
  for (Hazard& hazard : site.grid.hazards) all.push_back(&hazard);
  for (WrittenHazard& written : site.hazards) all.push_back(&written.hazard);
  // What is still to be drawn takes its names first.
  if (site.generate.IsNull()) NameHazards(all, list == nullptr ? node.mark : list->mark);
}

void CheckOneFloor(const ConfigNode& node) {
  std::vector<const ConfigNode*> floors;
  for (const char* key : {"map", "grid", "generate"})
    if (const ConfigNode* floor = node.Find(key)) floors.push_back(floor);
  if (floors.size() != 1)
    throw InputError(floors.empty() ? SourceMark{node.mark.file, 0} : floors.back()->mark,
                     "map, grid or generate", "",
                     "a site has one of the three: map (a ROS map), grid (a drawing) or generate "
                     "(a random site)");
}

Written ReadWritten(const ConfigNode& node, const fs::path& folder) {
  if (!node.IsMap()) throw InputError(node.mark, "site", "", "must be a map of keys");
  const ConfigNode* version = node.Find("site");
  const fs::path file = fs::path(node.mark.file);
  if (version == nullptr && node.Find("image") && node.Find("resolution"))
    throw InputError({file.string(), 0}, "", "",
                     "is a ROS map, not a site: a site names it, `site: 1` and `map: " +
                         file.filename().string() + "`; `floorproof init` writes one");
  if (node.Find("scenario") != nullptr)
    throw InputError({file.string(), 0}, "", "", "is a scenario, not a site");
  if (version == nullptr)
    throw InputError({node.mark.file, 0}, "site", "",
                     "missing; write site: 1 (the format's version)");
  RefuseUnknownKeys(node, "", kKnown);
  if (AsInt(*version, "site") != 1)
    throw InputError(version->mark, "site", version->scalar, "must be 1, the format's version");

  Written site;
  site.name = file.stem().string();
  if (site.name.empty()) site.name = "site";
  if (const ConfigNode* name = node.Find("name")) site.name = AsName(*name, "name");
  CheckOneFloor(node);
  if (const ConfigNode* map = node.Find("map"))
    site.ros_map = PathIn(folder, *map, "map");
  else if (const ConfigNode* grid = node.Find("grid"))
    site.grid = ReadCharGrid(*grid);
  else
    site.generate = ResolvedGenerate(*node.Find("generate"));
  ReadFloor(node, site);
  ReadHazards(node, site);
  ReadPlaces(node, site);
  return site;
}

void CheckOnMap(const ConfigNode& node, const std::string& key, const Vec2& p_W,
                const GridFrame& frame) {
  const Vec2 size = frame.cell_m * Vec2(frame.width, frame.height);
  const Vec2 p_G = frame.ToGrid(p_W);
  if ((p_G.array() >= 0).all() && (p_G.array() < size.array()).all()) return;
  const auto shown = [](const Vec2& p) {
    return "(" + FormatDouble(p.x()) + ", " + FormatDouble(p.y()) + ")";
  };
  throw InputError(node.Find(key)->mark, key, shown(p_W),
                   "lies off the map, whose lower left corner is " + shown(frame.X_WG.p()) +
                       " and upper right " + shown(frame.X_WG * size));
}

void LayWrittenFloors(const std::vector<WrittenHazard>& hazards, const std::string& file,
                      Site& site) {
  for (const WrittenHazard& written : hazards) site.map.hazards.push_back(written.hazard);
  std::vector<UnbentHazard> unbent_ones;
  try {
    unbent_ones = LayFloors(site.map.hazards, site.warnings);
  } catch (const InputError& e) {
    throw InputError({file, 0}, "", "", e.what());
  }
  for (const UnbentHazard& unbent : unbent_ones)
    for (const WrittenHazard& written : hazards)
      if (written.hazard.id == unbent.id)
        throw InputError(
            written.place_mark, written.place_key, WriteYamlLine(WritePoints(written.place)),
            "a " + written.hazard.type + " bends over edges of at most " +
                LengthText(*written.hazard.bend_m) + "; the floors beneath this one differ by " +
                LengthText(unbent.edge_m));
}

// A hazard that lies completely off the map is more likely due to a wrong origin than intended.
void WarnOfFarHazards(Site& site, const std::string& file) {
  const GridFrame& frame = site.map.frame;
  const Pose2 X_GW = frame.X_WG.Inverse();
  const Vec2 size = frame.cell_m * Vec2(frame.width, frame.height);
  for (const Hazard& hazard : site.map.hazards) {
    bool near = false;
    for (Polygon polygon : hazard.footprint) {
      for (Vec2& p : polygon) p = X_GW * p;
      near |= Overlap(BoxAround(polygon), {Vec2::Zero(), size});
    }
    if (!near) site.warnings.push_back(file + ": hazard " + hazard.id + " lies off the map");
  }
}

void WarnOfRampEnds(Site& site, const std::string& file) {
  for (const Hazard& hazard : site.map.hazards)
    if (const auto end = FindLooseRampEnd(site.map, hazard))
      site.warnings.push_back(
          file + ": ramp " + hazard.id + " does not meet the floor: its end at " +
          PlaceText(end->p_W.x(), end->p_W.y()) + " is " + LengthText(std::abs(end->off_m)) +
          (end->off_m > 0 ? " above" : " below") + " the floor beyond");
}

// The one site that `generate` with a seed stands for.
ConfigNode FixedSite(const ConfigNode& node) {
  CheckOneFloor(node);
  const ConfigNode& generate = *node.Find("generate");
  if (DrawnAtRandom(generate))
    throw InputError(generate.mark, "generate.seed", "",
                     "missing: without it each episode of a scenario draws a site of its own; "
                     "write seed: N for one fixed site");
  return GeneratedSite(node, 0, 0);
}

}  // namespace

ConfigNode GeneratedSite(const ConfigNode& node, std::uint64_t campaign_seed,
                         std::uint64_t episode) {
  const ConfigNode* generate = node.Find("generate");
  if (generate == nullptr) return node;
  CheckOneFloor(node);
  ConfigNode drawn = Generated(*generate, campaign_seed, episode);
  ConfigNode site = node;
  site.Remove("generate");
  for (auto& [key, value] : drawn.entries) {
    ConfigNode* written = site.Find(key);
    if (written == nullptr || written->IsNull()) {
      site.Add(key, std::move(value));
    } else if (key == "hazards" && written->IsList()) {  // behind those whose index may be known
      std::ranges::move(value.items, std::back_inserter(written->items));
    }
  }
  return site;
}

Site ReadSite(const ConfigNode& node, const fs::path& folder, const InputFiles& files) {
  if (node.Find("generate") != nullptr) return ReadSite(FixedSite(node), folder, files);
  Written written = ReadWritten(node, folder);
  Site site;
  HazardMap& map = site.map;
  map.name = written.name;
  map.unknown_is_wall = written.unknown_is_wall;
  map.floor_friction = written.floor_friction;
  map.start = written.start;
  map.goal = written.goal;
  if (written.ros_map.empty()) {
    map.frame = written.grid.frame;
    map.occupancy = std::move(written.grid.occupancy);
    map.inset_m = written.grid.inset_m;
    map.hazards = std::move(written.grid.hazards);
  } else {
    if (const std::string why = files.WhyUnreadable(written.ros_map, kMaxImageBytes); !why.empty())
      throw InputError(node.Find("map")->mark, "map", node.Find("map")->scalar, why);
    RosMap ros = ReadRosMap(written.ros_map, files);
    map.frame = ros.frame;
    map.occupancy = std::move(ros.occupancy);
    site.files_read = {written.ros_map, ros.image};
    site.warnings = std::move(ros.warnings);
  }
  LayWrittenFloors(written.hazards, node.mark.file, site);
  if (map.start) CheckOnMap(node, "start", map.start->p(), map.frame);
  if (map.goal) CheckOnMap(node, "goal", *map.goal, map.frame);
  WarnOfFarHazards(site, node.mark.file);
  WarnOfRampEnds(site, node.mark.file);
  return site;
}

Site ReadSiteFile(const fs::path& path) {
  Site site = ReadSite(ReadYamlFile(path), path.parent_path());
  site.files_read.insert(site.files_read.begin(), path);
  return site;
}

ConfigNode ResolveSite(const ConfigNode& node, const fs::path& folder, const fs::path& folder_out) {
  Written written = ReadWritten(node, folder);
  ConfigNode out = ConfigNode::Map();
  out.Add("site", ConfigNode::Scalar("1"));
  out.Add("name", ConfigNode::Scalar(written.name, true));
  if (!written.generate.IsNull()) {
    out.Add("generate", written.generate);
  } else if (written.ros_map.empty()) {
    out.Add("grid", written.grid.resolved);
  } else {
    // Canonical, since ../ in a path through a symbolic link would lead elsewhere.
    const fs::path target = fs::weakly_canonical(fs::absolute(written.ros_map));
    const fs::path from = fs::weakly_canonical(fs::absolute(folder_out.empty() ? "." : folder_out));
    out.Add("map", ConfigNode::Scalar(target.lexically_relative(from).string(), true));
  }
  out.Add("unknown", ConfigNode::Scalar(written.unknown_is_wall ? "wall" : "free"));
  ConfigNode& floor = out.Add("floor", ConfigNode::Map());
  floor.Add("friction", ConfigNode::Scalar(FormatDouble(written.floor_friction)));
  ConfigNode& hazards = out.Add("hazards", ConfigNode::List());
  for (WrittenHazard& hazard : written.hazards) hazards.items.push_back(WriteHazard(hazard));
  const auto add_place = [&](const char* key, const Vec2& p) -> ConfigNode& {
    ConfigNode& place = out.Add(key, ConfigNode::Map());
    place.Add("x_m", ConfigNode::Scalar(FormatDouble(p.x())));
    place.Add("y_m", ConfigNode::Scalar(FormatDouble(p.y())));
    return place;
  };
  if (written.start)
    add_place("start", written.start->p())
        .Add("yaw_deg", ConfigNode::Scalar(FormatDouble(written.start_yaw_deg)));
  if (written.goal) add_place("goal", *written.goal);
  return out;
}

}  // namespace floorproof
