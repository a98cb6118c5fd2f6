// SPDX-License-Identifier: Apache-2.0
// The bundled audits of three sites, each driven in five orders: Table 3 of "audit-sampling".
#include <map>

#include "run/scenario/scenario_file.h"
#include "tests/places.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

struct Site {
  const char* name;
  int samples;  // N of the paper
  friend void PrintTo(const Site& site, std::ostream* out) { *out << site.name; }
};
class AuditOrders : public ScenarioTest, public ::testing::WithParamInterface<Site> {};

TEST_P(AuditOrders, StandToEachOtherAsInThePaper) {
  const ScenarioFile file(SourceFile("models/scenarios/audit_tours.yaml"));
  std::map<std::string, Metrics> driven;
  const std::string prefix = std::string("site=") + GetParam().name + ",order=";
  for (const Variant& variant : file.variants()) {
    if (!variant.name.starts_with(prefix)) continue;
    SCOPED_TRACE(variant.name);
    Scenario scenario = file.Read(0, variant);
    const Execution execution = Execute(scenario);
    ASSERT_EQ(execution.record.outcome, Outcome::kSuccess) << execution.record.message;
    EXPECT_EQ(execution.record.metrics.contacts, 0);
    const auto reached = std::ranges::count_if(execution.plan.samples, &SamplePlace::reachable);
    EXPECT_EQ(reached, GetParam().samples);
    driven[variant.name.substr(prefix.size())] = execution.record.metrics;
  }
  ASSERT_EQ(driven.size(), 5u);
  const auto length_m = [&](const char* order) { return driven.at(order).path_length_m; };
  EXPECT_LE(length_m("tour"), length_m("aco") + 0.05);
  for (const auto measure : {&Metrics::path_length_m, &Metrics::duration_s, &Metrics::energy_j}) {
    const auto of = [&](const char* order) { return driven.at(order).*measure; };
    EXPECT_LE(of("tour"), 1.03 * of("aco"));  // turns count in time and energy
    EXPECT_LT(of("aco"), std::min(of("zigzag"), of("pso")));
    EXPECT_GT(of("random_order"), std::max(of("zigzag"), of("pso")));
  }
}

INSTANTIATE_TEST_SUITE_P(Sites, AuditOrders,
                         ::testing::Values(Site{"lab", 29}, Site{"pantry", 39},
                                           Site{"entrance", 59}));

}  // namespace
}  // namespace floorproof
