// SPDX-License-Identifier: Apache-2.0
// A hazard as a site file writes it: the keys of its type, the keys that all types share, its
// place.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/config.h"
#include "env/core/hazard_map.h"
#include "env/hazards/hazard_type.h"

namespace floorproof {

class MapSchema;

// A list of points [x, y], made counter-clockwise with the first edge still first. Throws
// InputError where it is no simple polygon.
Polygon ReadPolygon(const ConfigNode& node, const std::string& key);
ConfigNode WritePoints(const std::vector<Vec2>& points);
ConfigNode PolygonSchema();

// What every type takes besides its own keys.
struct CommonHazardKeys {
  bool known = true;
  std::optional<double> restitution;  // none: the type's own
  double reflectance = 1;
  std::optional<std::optional<double>> friction;  // not written: the type's own; none: the floor's

  static const std::vector<std::string>& Names();
  static void AddTo(MapSchema& map);
  void Read(const ConfigNode& node, const std::string& path);
  void Apply(Hazard& hazard) const;
};

// Adds the shared keys with the values that `hazard` has.
void WriteCommonHazardKeys(const Hazard& hazard, ConfigNode& node);

// Makes a hazard of this type, whose keys were read from `node`; what the type itself refuses is
// said with the node's file and line, and with `path` before the key.
Hazard MakeHazard(HazardType& type, const std::vector<Vec2>& place, const ConfigNode& node,
                  const std::string& path);

// One entry of a site's `hazards`.
struct WrittenHazard {
  Hazard hazard;  // its id is empty when none was written
  std::unique_ptr<HazardType> type;
  std::vector<Vec2> place;
  SourceMark place_mark;
  std::string place_key;        // with its path: hazards[1].polygon_m
  Vec2 shift_m = Vec2::Zero();  // by which the whole place is moved
};
WrittenHazard ReadHazard(const ConfigNode& node, const std::string& path);
ConfigNode HazardSchema();
// The entry with every default stated.
ConfigNode WriteHazard(WrittenHazard& written);

// Gives hazards without an id one of the form type-index, counting each type from 0 and passing
// over ids that are taken. Throws InputError when two have the same.
void NameHazards(std::vector<Hazard*>& hazards, const SourceMark& mark);

}  // namespace floorproof
