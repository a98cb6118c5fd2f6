// SPDX-License-Identifier: Apache-2.0
#include "env/map/site_keys.h"

#include "base/name_param.h"
#include "env/map/char_grid.h"
#include "env/map/generate.h"
#include "env/map/written_hazard.h"

namespace floorproof {
namespace {

const Bounds kPlace = Between(-1e6, 1e6);

ConfigNode Place(const std::function<void(ParamVisitor&)>& visit) {
  return MapSchema()
      .Params(visit, MapSchema::Defaults::kElsewhere)
      .Require("x_m")
      .Require("y_m")
      .Node();
}

// What is walked on stands in one of them.
ConfigNode OneOf(const std::vector<std::string>& keys) {
  ConfigNode choices = ConfigNode::List();
  for (const std::string& key : keys) {
    ConfigNode choice = ConfigNode::Map();
    choice.Add("required", ConfigNode::List({ConfigNode::Scalar(key, true)}));
    choices.items.push_back(std::move(choice));
  }
  return choices;
}

}  // namespace

void VisitSiteStart(ParamVisitor& v, Pose2& start, double& yaw_deg) {
  v("x_m", start.x_m, kPlace, "x of the robot's centre (m)");
  v("y_m", start.y_m, kPlace, "y of the robot's centre (m)");
  v("yaw_deg", yaw_deg, Between(-360, 360), "heading (deg, from x to y)");
}

void VisitSiteGoal(ParamVisitor& v, Vec2& goal) {
  v("x_m", goal.x(), kPlace, "m");
  v("y_m", goal.y(), kPlace, "m");
}

void VisitSiteFloor(ParamVisitor& v, double& friction) {
  v("friction", friction, {0, 5, true}, "coefficient between floor and wheels");
}

ConfigNode SiteSchema() {
  Pose2 start;
  Vec2 goal = Vec2::Zero();
  double yaw_deg = 0, friction = kFloorFriction;
  ConfigNode unknown = ChoiceSchema({"wall", "free"});
  unknown.Add("default", ConfigNode::Scalar("wall", true));
  MapSchema map;
  map.Key("site", ConstSchema("1"), "the format's version")
      .Require("site")
      .Key("name", NameSchema(), "default: the file's stem")
      .Key("map", TextSchema("."), "a ROS map_server file (.yaml), from this file's folder")
      .Key("grid", CharGridSchema(), "a floor drawn in characters")
      .Key("generate", OrNull(GenerateSchema()), "a floor drawn at random, or of one crossing")
      .Key("unknown", std::move(unknown), "what unknown cells become")
      .Key("floor",
           OrNull(MapSchema().Params([&](ParamVisitor& v) { VisitSiteFloor(v, friction); }).Node()),
           "the floor where no hazard says otherwise")
      .Key("start", Place([&](ParamVisitor& v) { VisitSiteStart(v, start, yaw_deg); }),
           "where a robot starts, unless the scenario says where")
      .Key("goal", Place([&](ParamVisitor& v) { VisitSiteGoal(v, goal); }),
           "where a robot is to end, unless the scenario says where")
      .Key("hazards", OrNull(ListSchema(HazardSchema(), 0, kMostSiteHazards)),
           "what stands and lies there; where they overlap, the later one wins");
  ConfigNode site = map.Node();
  site.Add("oneOf", OneOf({"map", "grid", "generate"}));
  return site;
}

}  // namespace floorproof
