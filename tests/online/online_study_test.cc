// SPDX-License-Identifier: Apache-2.0
// The bundled study of unknown floors, on sites that no planner was developed on. Slow.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>

#include "run/episode/execute.h"
#include "run/scenario/scenario_file.h"
#include "tests/places.h"

namespace floorproof {
namespace {

constexpr std::uint64_t kSites = 300;

struct Drive {
  double coverage, revisited, length_m;
  Outcome outcome;
};

double Median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

class UnknownFloors : public ::testing::Test {
 protected:
  // By variant, a drive a site.
  static std::map<std::string, std::vector<Drive>> DriveAll() {
    const ScenarioFile file(SourceFile("models/scenarios/unknown_floor.yaml"), {{"seed", "2024"}});
    std::map<std::string, std::vector<Drive>> drives;
    for (const Variant& variant : file.variants())
      for (std::uint64_t site = 0; site < kSites; ++site) {
        Scenario s = file.Read(site, variant);
        const EpisodeRecord record = Execute(s).record;
        const Metrics& m = record.metrics;
        drives[variant.name].push_back({m.coverage, m.revisited, m.path_length_m, record.outcome});
      }
    return drives;
  }
};

TEST_F(UnknownFloors, AreCoveredWithFewCellsTwice) {
  const auto drives = DriveAll();
  ASSERT_EQ(drives.size(), 9u);
  for (const char* radius : {"1.0", "1.5", "2.5"}) {
    const auto of = [&](const std::string& planner) -> const std::vector<Drive>& {
      return drives.at("planner=" + planner + ",radius_m=" + radius);
    };
    const auto &window = of("window"), &random = of("random"), &ours = of("frontier");
    std::vector<double> twice, ours_twice;
    int half = 0, no_longer = 0;
    for (std::size_t i = 0; i < kSites; ++i) {
      for (const auto* drive : {&window[i], &ours[i]}) {
        EXPECT_EQ(drive->outcome, Outcome::kSuccess) << radius << " m, site " << i;
        EXPECT_GE(drive->coverage, 0.98);
      }
      EXPECT_LT(window[i].revisited, random[i].revisited);
      twice.push_back(window[i].revisited);
      ours_twice.push_back(ours[i].revisited);
      half += ours[i].revisited <= 0.5 * window[i].revisited;
      no_longer += ours[i].length_m <= window[i].length_m;
    }
    EXPECT_GE(Median(twice), 0.10) << radius;
    EXPECT_LE(Median(twice), 0.20) << radius;
    EXPECT_LE(Median(ours_twice), 0.03) << radius;
    EXPECT_GE(half, 0.95 * kSites) << radius;
    EXPECT_GE(no_longer, 0.99 * kSites) << radius;
    std::cout << radius << " m: J_cc " << Median(twice) << " and " << Median(ours_twice)
              << ", at most half on " << half << ", no longer on " << no_longer << " of " << kSites
              << "\n";
  }
}

}  // namespace
}  // namespace floorproof
