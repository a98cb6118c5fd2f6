// SPDX-License-Identifier: Apache-2.0
// Sites as large as they may be are read, and the schema accepts them too.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "env/map/site.h"
#include "env/map/site_keys.h"
#include "tests/schema_takes.h"

namespace floorproof {
namespace {

constexpr const char* kFloor = "site: 1\ngrid:\n  cell_m: 100\n  rows: |\n    ...\n    ...\n";

// Corners on a circle.
std::string Carpet(int corners, const Vec2& centre, double radius_m) {
  std::string text = "{type: carpet, polygon_m: [";
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    text += "[" + std::to_string(centre.x() + radius_m * std::cos(angle)) + ", " +
            std::to_string(centre.y() + radius_m * std::sin(angle)) + "], ";
  }
  return text + "]}, ";
}

void ExpectTaken(const std::string& more, std::size_t hazards) {
  const ConfigNode node = ParseYaml(kFloor + more, "site.yaml");
  EXPECT_EQ(ReadSite(node, ".").map.hazards.size(), hazards);
  EXPECT_TRUE(Takes(SiteSchema(), node));
}

TEST(SiteLimits, TenThousandHazardsAreRead) {
  std::string list;
  for (std::size_t i = 0; i < kMostSiteHazards; ++i)
    list += Carpet(
        3, Vec2(1 + 2.0 * static_cast<double>(i % 100), 1 + static_cast<double>(i / 100)), 0.4);
  ExpectTaken("hazards: [" + list + "]\n", kMostSiteHazards);
}

TEST(SiteLimits, TenThousandCornersOfAPolygonAreRead) {
  ExpectTaken("hazards: [" + Carpet(10'000, {100, 50}, 40) + "]\n", 1);
}

TEST(SiteLimits, ANameOfTwoHundredBytesIsRead) {
  ExpectTaken("name: " + std::string(200, 'n') + "\n", 0);
  const ConfigNode longer =
      ParseYaml(kFloor + ("name: " + std::string(201, 'n')) + "\n", "site.yaml");
  EXPECT_FALSE(Takes(SiteSchema(), longer));
}

}  // namespace
}  // namespace floorproof
