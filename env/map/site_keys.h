// SPDX-License-Identifier: Apache-2.0
// The keys of a site file: those that its reader and its schema share, and the schema.
#pragma once

#include <cstddef>

#include "base/json_schema.h"
#include "env/geometry/geometry.h"

namespace floorproof {

// Dry rubber on a hard floor: the middle of ISO 18646-2's 0.6 to 1.0.
inline constexpr double kFloorFriction = 0.8;
inline constexpr std::size_t kMostSiteHazards = 10'000;
// The corners of all polygons and lines of a site, as they are written.
inline constexpr std::size_t kMaxSiteCorners = 50'000;

void VisitSiteStart(ParamVisitor& v, Pose2& start, double& yaw_deg);
void VisitSiteGoal(ParamVisitor& v, Vec2& goal);
void VisitSiteFloor(ParamVisitor& v, double& friction);

// Of a site file, or of the map that stands for one in a scenario.
ConfigNode SiteSchema();

}  // namespace floorproof
