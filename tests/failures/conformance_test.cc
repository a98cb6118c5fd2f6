// SPDX-License-Identifier: Apache-2.0
// What every registered detector promises; a new one inherits these tests with its line in
// list.inc.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "tests/controllers/allocation_guard.h"
#include "tests/failures/synthetic.h"

namespace floorproof {

void PrintTo(const PluginEntry<Detector>& entry, std::ostream* os) { *os << entry.name; }

namespace {

constexpr FailureMode kModes[] = {FailureMode::kVeerOff, FailureMode::kStuck,
                                  FailureMode::kRollOver, FailureMode::kBounceBack};

class DetectorConformance : public testing::TestWithParam<PluginEntry<Detector>> {};

// Straights, bends, turns on the spot both ways, standing still, crawling, a there and back.
Trace CleanTrace() {
  return Drive({{8, {0.3, 0, 0}},
                {4, {0, 0, 0.8}},
                {3, {0.2, 0, -0.4}},
                {20, {0, 0, 0}, true},
                {12, {0, 0, -0.06}},
                {15, {0.012, 0, 0}},
                {4, {0.3, 0, 0}},
                {4, {-0.3, 0, 0}},
                {4, {0.3, 0, 0}},
                {4, {-0.3, 0, 0}}});
}

TEST_P(DetectorConformance, IsSilentOnACleanTrace) {
  const auto dut = GetParam().make();
  EXPECT_TRUE(Judge(*dut, CleanTrace()).empty());
  EXPECT_GT(dut->margin(), 0);
}

TEST_P(DetectorConformance, FiresOnceOnItsOwnFailureWithEvidence) {
  const auto dut = GetParam().make();
  const auto events = Judge(*dut, FailingTrace(dut->mode()));
  ASSERT_EQ(events.size(), 1u);
  const Event& event = events[0];
  EXPECT_EQ(event.mode, dut->mode());
  EXPECT_GT(event.t_s, 0);
  EXPECT_NE(event.value, event.threshold);
  EXPECT_EQ(event.effect.size(), 2u);
  EXPECT_FALSE(event.evidence.empty());
  for (const auto& [name, value] : event.evidence) EXPECT_TRUE(std::isfinite(value)) << name;
  EXPECT_LT(dut->margin(), 0);
}

TEST_P(DetectorConformance, IsSilentOnTheOtherModesFailures) {
  const auto dut = GetParam().make();
  for (const FailureMode mode : kModes) {
    if (mode == dut->mode()) continue;
    EXPECT_TRUE(Judge(*dut, FailingTrace(mode)).empty()) << Name(mode);
  }
}

TEST_P(DetectorConformance, MirroredMotionGivesMirroredEvents) {
  const auto dut = GetParam().make(), mirrored = GetParam().make();
  const Trace trace = FailingTrace(dut->mode());
  const auto events = Judge(*dut, trace), images = Judge(*mirrored, Mirrored(trace));
  ASSERT_EQ(events.size(), images.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(events[i].t_s, images[i].t_s);
    EXPECT_EQ(events[i].kind, images[i].kind);
    EXPECT_DOUBLE_EQ(events[i].value, images[i].value);
    EXPECT_EQ(events[i].x_m, images[i].x_m);
    EXPECT_EQ(events[i].y_m, -images[i].y_m);
  }
  EXPECT_DOUBLE_EQ(dut->margin(), mirrored->margin());
}

TEST_P(DetectorConformance, StartForgetsWhatWas) {
  const auto dut = GetParam().make();
  ASSERT_EQ(Judge(*dut, FailingTrace(dut->mode())).size(), 1u);
  EXPECT_TRUE(Judge(*dut, CleanTrace()).empty());
  EXPECT_GT(dut->margin(), 0);
  EXPECT_EQ(Judge(*dut, FailingTrace(dut->mode())).size(), 1u);
}

TEST_P(DetectorConformance, UpdateAllocatesNothing) {
  const auto dut = GetParam().make();
  std::vector<Trace> traces = {CleanTrace()};
  for (const FailureMode mode : kModes)
    if (mode != dut->mode()) traces.push_back(FailingTrace(mode));
  for (const Trace& trace : traces) {
    dut->Start(TestContext());
    const auto before = AllocationCount();
    for (const Sample& sample : trace) dut->Update(sample);
    EXPECT_EQ(AllocationCount(), before);
  }
}

TEST_P(DetectorConformance, ParametersAreDocumentedAndReadBack) {
  const auto dut = GetParam().make();
  const auto docs = DocumentParams(*dut);
  EXPECT_FALSE(docs.empty());
  for (const ParamDoc& doc : docs) EXPECT_FALSE(doc.help.empty()) << doc.name;
  ConfigNode written = ConfigNode::Map(), again = ConfigNode::Map();
  WriteParams(*dut, written);
  const auto other = GetParam().make();
  ReadParams(written, "failures.", *other);
  WriteParams(*other, again);
  EXPECT_EQ(WriteYaml(written), WriteYaml(again));
}

INSTANTIATE_TEST_SUITE_P(All, DetectorConformance, testing::ValuesIn(Detectors()),
                         [](const auto& suite) { return std::string(suite.param.name); });

TEST(HazardId, NamesHazardsWallsAndNothing) {
  const HazardMap map = TestMap();
  EXPECT_EQ(HazardId(map, kGlassHazard, true), "door");
  EXPECT_EQ(HazardId(map, kStepHazard, false), "sill");
  EXPECT_EQ(HazardId(map, -1, true), "wall");
  EXPECT_EQ(HazardId(map, -1, false), "");
  EXPECT_EQ(HazardId(map, 99, false), "");
}

}  // namespace
}  // namespace floorproof
