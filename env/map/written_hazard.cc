// SPDX-License-Identifier: Apache-2.0
#include "env/map/written_hazard.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/json_schema.h"
#include "base/params.h"
#include "base/quantity.h"

namespace floorproof {
namespace {

const Bounds kRestitution = Between(0, 1), kReflectance = Between(0, 1);
const Bounds kFriction = {0, 5, true};
constexpr double kFarthest_m = 1e6;
constexpr std::size_t kMaxPoints = 10'000;

Vec2 ReadPoint(const ConfigNode& node, const std::string& key) {
  if (!node.IsList() || node.items.size() != 2)
    throw InputError(node.mark, key, "", "must be a point [x, y], in metres");
  const Bounds place = Between(-kFarthest_m, kFarthest_m);
  return {AsDouble(node.items[0], key, place), AsDouble(node.items[1], key, place)};
}

std::vector<Vec2> ReadPoints(const ConfigNode& node, const std::string& key, std::size_t least) {
  if (!node.IsList() || node.items.size() < least || node.items.size() > kMaxPoints)
    throw InputError(node.mark, key,
                     node.IsList() ? CountText(node.items.size(), "point") : node.scalar,
                     "must be a list of " + std::to_string(least) + " to " +
                         std::to_string(kMaxPoints) + " points [x, y]");
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    points.push_back(ReadPoint(node.items[i], key + "[" + std::to_string(i) + "]"));
    if (i > 0 && (points[i] - points[i - 1]).norm() < 1e-6)
      throw InputError(node.items[i].mark, key + "[" + std::to_string(i) + "]", "",
                       "is the same point as the one before");
  }
  return points;
}

const char* PlaceKey(HazardType::Placement placement) {
  return placement == HazardType::Placement::kPolygon ? "polygon_m" : "line_m";
}

std::vector<Vec2> ReadPlace(const ConfigNode& node, const std::string& path,
                            const std::string& type, HazardType::Placement placement) {
  const bool polygon = placement == HazardType::Placement::kPolygon;
  const std::string key = PlaceKey(placement);
  const std::string other = polygon ? "line_m" : "polygon_m";
  if (const ConfigNode* wrong = node.Find(other))
    throw InputError(wrong->mark, path + other, "", "a " + type + " is placed by " + key);
  const ConfigNode* place = node.Find(key);
  if (place == nullptr)
    throw InputError(node.mark, path + key, "", "missing; it says where the " + type + " lies");
  return polygon ? ReadPolygon(*place, path + key) : ReadPoints(*place, path + key, 2);
}

ConfigNode PointsSchema(std::size_t least) {
  return ListSchema(ListSchema(NumberSchema(Between(-kFarthest_m, kFarthest_m)), 2, 2), least,
                    kMaxPoints);
}

}  // namespace

Polygon ReadPolygon(const ConfigNode& node, const std::string& key) {
  Polygon polygon = ReadPoints(node, key, 3);
  if ((polygon.front() - polygon.back()).norm() < 1e-6) polygon.pop_back();  // closed by hand
  if (polygon.size() < 3 || !IsSimple(polygon))
    throw InputError(node.mark, key, "", "its edges cross or touch each other");
  if (std::abs(SignedArea(polygon)) < 1e-8)
    throw InputError(node.mark, key, "", "encloses no area");
  if (SignedArea(polygon) < 0) {  // counter-clockwise, the first edge still first
    std::reverse(polygon.begin(), polygon.end());
    std::rotate(polygon.begin(), polygon.end() - 2, polygon.end());
  }
  return polygon;
}

ConfigNode WritePoints(const std::vector<Vec2>& points) {
  ConfigNode list = ConfigNode::List();
  for (const Vec2& p : points)
    list.items.push_back(ConfigNode::List(
        {ConfigNode::Scalar(FormatDouble(p.x())), ConfigNode::Scalar(FormatDouble(p.y()))}));
  return list;
}

ConfigNode PolygonSchema() { return PointsSchema(3); }

void CommonHazardKeys::AddTo(MapSchema& map) {
  map.Key("known", BoolSchema(), "false: it is there, but not on the map that planners get")
      .Key("restitution", NumberSchema(kRestitution), "from 0, dead, to 1 (default: the type's)")
      .Key("friction", AnyOf({NumberSchema(kFriction), ChoiceSchema({"none"})}),
           "coefficient (default: the type's; none: the floor's)")
      .Key("reflectance", NumberSchema(kReflectance), "of a lidar's beam (default 1)");
}

const std::vector<std::string>& CommonHazardKeys::Names() {
  static const std::vector<std::string> kNames = [] {
    MapSchema map;
    AddTo(map);
    return map.Names();
  }();
  return kNames;
}

void CommonHazardKeys::Read(const ConfigNode& node, const std::string& path) {
  if (const auto* n = node.Find("known")) known = AsBool(*n, path + "known");
  if (const auto* n = node.Find("restitution"))
    restitution = AsDouble(*n, path + "restitution", kRestitution);
  if (const auto* n = node.Find("reflectance"))
    reflectance = AsDouble(*n, path + "reflectance", kReflectance);
  if (const auto* n = node.Find("friction")) {
    const bool none = n->IsScalar() && n->scalar == "none";
    friction = none ? std::optional<double>() : AsDouble(*n, path + "friction", kFriction);
  }
}

void CommonHazardKeys::Apply(Hazard& hazard) const {
  hazard.known = known;
  hazard.material.reflectance = reflectance;
  if (restitution) hazard.material.restitution = *restitution;
  if (friction) hazard.material.friction = *friction;
  hazard.keys.emplace_back("restitution", hazard.material.restitution);
  if (hazard.material.friction) hazard.keys.emplace_back("friction", *hazard.material.friction);
}

void WriteCommonHazardKeys(const Hazard& hazard, ConfigNode& node) {
  const Material& m = hazard.material;
  node.Add("known", ConfigNode::Scalar(hazard.known ? "true" : "false"));
  node.Add("restitution", ConfigNode::Scalar(FormatDouble(m.restitution)));
  node.Add("reflectance", ConfigNode::Scalar(FormatDouble(m.reflectance)));
  node.Add("friction", ConfigNode::Scalar(m.friction ? FormatDouble(*m.friction) : "none"));
}

Hazard MakeHazard(HazardType& type, const std::vector<Vec2>& place, const ConfigNode& node,
                  const std::string& path) {
  try {
    Hazard hazard = type.Make(place);
    hazard.keys = NumericParams(type);
    return hazard;
  } catch (const InputError& e) {
    throw InputError(node.mark, "", "", path + e.what());
  }
}

WrittenHazard ReadHazard(const ConfigNode& node, const std::string& path) {
  if (!node.IsMap())
    throw InputError(node.mark, path, "", "must be a map of keys: {type: ..., ...}");
  const std::string prefix = path + ".";
  const ConfigNode* type = node.Find("type");
  if (type == nullptr) throw InputError(node.mark, prefix + "type", "", "missing");
  const std::string name = AsString(*type, prefix + "type");

  WrittenHazard written;
  written.type = MakePlugin(HazardTypes(), name, prefix + "type", type->mark);
  std::vector<std::string> others = CommonHazardKeys::Names();
  others.insert(others.end(), {"type", "id", "polygon_m", "line_m", "shift_x_m", "shift_y_m"});
  ReadParams(node, prefix, *written.type, others);
  CommonHazardKeys common;
  common.Read(node, prefix);
  written.place = ReadPlace(node, prefix, name, written.type->placement());
  const std::string place_key = PlaceKey(written.type->placement());
  written.place_mark = node.Find(place_key)->mark;
  written.place_key = prefix + place_key;
  const Bounds far = Between(-kFarthest_m, kFarthest_m);
  if (const auto* n = node.Find("shift_x_m"))
    written.shift_m.x() = AsDouble(*n, prefix + "shift_x_m", far);
  if (const auto* n = node.Find("shift_y_m"))
    written.shift_m.y() = AsDouble(*n, prefix + "shift_y_m", far);
  std::vector<Vec2> place = written.place;
  for (Vec2& p : place) p += written.shift_m;
  written.hazard = MakeHazard(*written.type, place, node, prefix);
  written.hazard.type = name;
  common.Apply(written.hazard);
  if (const ConfigNode* id = node.Find("id")) {
    written.hazard.id = AsString(*id, prefix + "id");
    // "wall" names the map's own obstacles in events; ids also stand in CSV columns.
    if (written.hazard.id.empty() || written.hazard.id == "wall" || written.hazard.id.size() > 64 ||
        written.hazard.id.find_first_of(",\"\n\r\t") != std::string::npos)
      throw InputError(id->mark, prefix + "id", written.hazard.id,
                       "must be 1 to 64 characters without comma, quote or tab, and not wall");
  }
  return written;
}

ConfigNode HazardSchema() {
  std::vector<NamedSchema> types = PluginSchemas(HazardTypes());
  for (NamedSchema& type : types) {
    MapSchema& keys = type.keys;
    const auto made = MakePlugin(HazardTypes(), type.name, "type");
    const bool polygon = made->placement() == HazardType::Placement::kPolygon;
    const char* place = PlaceKey(made->placement());
    keys.Key("id", TextSchema(R"re(^(?!wall$)[^,"\n\r\t]{1,64}$)re"),
             "by which events, draws and --set name it (default: its type and a number)")
        .Key(place, PointsSchema(polygon ? 3 : 2),
             polygon ? "where it lies: a polygon's corners [x, y] (m)"
                     : "where it lies: the points [x, y] of a line (m)")
        .Require(place)
        .Key("shift_x_m", NumberSchema(Between(-kFarthest_m, kFarthest_m)),
             "moves it as a whole (default 0)")
        .Key("shift_y_m", NumberSchema(Between(-kFarthest_m, kFarthest_m)),
             "moves it as a whole (default 0)");
    CommonHazardKeys::AddTo(keys);
  }
  return NamedMapSchema("type", "what stands or lies there", types, Unnamed::kRefused);
}

ConfigNode WriteHazard(WrittenHazard& written) {
  ConfigNode node = ConfigNode::Map();
  node.Add("type", ConfigNode::Scalar(written.hazard.type));
  if (!written.hazard.id.empty()) node.Add("id", ConfigNode::Scalar(written.hazard.id, true));
  node.Add(PlaceKey(written.type->placement()), WritePoints(written.place));
  node.Add("shift_x_m", ConfigNode::Scalar(FormatDouble(written.shift_m.x())));
  node.Add("shift_y_m", ConfigNode::Scalar(FormatDouble(written.shift_m.y())));
  WriteParams(*written.type, node);
  WriteCommonHazardKeys(written.hazard, node);
  return node;
}

void NameHazards(std::vector<Hazard*>& hazards, const SourceMark& mark) {
  std::set<std::string> taken;
  for (const Hazard* hazard : hazards)
    if (!hazard->id.empty() && !taken.insert(hazard->id).second)
      throw InputError(mark, "id", hazard->id, "two hazards have this id");
  std::map<std::string, int> next;
  for (Hazard* hazard : hazards) {
    if (!hazard->id.empty()) continue;
    do hazard->id = hazard->type + "-" + std::to_string(next[hazard->type]++);
    while (!taken.insert(hazard->id).second);
  }
}

}  // namespace floorproof
