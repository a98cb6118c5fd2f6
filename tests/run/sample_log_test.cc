// SPDX-License-Identifier: Apache-2.0
#include "run/episode/sample_log.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

// Control periods of a robot at a place along x.
class Log {
 public:
  explicit Log(std::size_t places = 10) : dut(places) {}
  void Drive(double x_m) { Add(x_m, false, {}); }
  void Dwell(double x_m, const std::vector<WaypointTask>& tasks) { Add(x_m, true, tasks); }
  void React(double x_m) {
    sample_.command.reacting = true;
    Drive(x_m);
    sample_.command.reacting = false;
  }
  std::vector<int> places() const {
    std::vector<int> places;
    for (const SampleStop& stop : dut.stops()) places.push_back(stop.place);
    return places;
  }

  SampleLog dut;

 private:
  void Add(double x_m, bool dwelling, const std::vector<WaypointTask>& tasks) {
    sample_.t_s += 0.02;
    sample_.p_WB.x() = x_m;
    sample_.command.dwelling = dwelling;
    sample_.command.tasks = tasks;
    dut.OnControl(sample_);
    sample_.command.tasks = {};  // a view of what is gone
  }
  Sample sample_;
};

WaypointTask Take(int place) { return {WaypointTask::Kind::kSample, place}; }

TEST(SampleLog, ASampleIsTakenAsItsDwellEnds) {
  Log log;
  log.Drive(0);
  log.Dwell(1, {Take(4)});
  log.Dwell(1.01, {Take(4)});
  EXPECT_TRUE(log.dut.stops().empty());
  log.Drive(1.02);
  ASSERT_EQ(log.places(), std::vector<int>{4});
  EXPECT_EQ(log.dut.stops()[0].X_WB.x_m, 1.01);
  EXPECT_NEAR(log.dut.stops()[0].t_s, 0.06, 1e-12);
  log.Drive(1.5);
  log.Dwell(2, {});  // nothing is done there
  log.Drive(2.1);
  EXPECT_EQ(log.places(), std::vector<int>{4});
}

TEST(SampleLog, DwellsThatFollowEachOtherAreTwo) {
  Log log;
  log.Dwell(1, {Take(4)});
  log.Dwell(1, {Take(2)});
  log.Drive(1.1);
  EXPECT_EQ(log.places(), (std::vector<int>{4, 2}));
}

TEST(SampleLog, SeveralAtOnePlaceAreTakenInOrder) {
  Log log;
  for (int i = 0; i < 3; ++i) log.Dwell(1, {Take(3), Take(1)});
  log.Drive(1.1);
  EXPECT_EQ(log.places(), (std::vector<int>{3, 1}));
}

TEST(SampleLog, ADwellThatIsBrokenOffTookNone) {
  Log log;
  log.Dwell(1, {Take(4)});
  log.React(0.9);  // something pressed its shell
  log.Drive(0.9);
  EXPECT_TRUE(log.places().empty());
  log.Dwell(1, {Take(4)});  // it comes back
  log.Drive(1.1);
  EXPECT_EQ(log.places(), std::vector<int>{4});
  log.Dwell(2, {Take(5)});
  log.dut.BreakOff();  // it was carried away
  log.Drive(3);
  EXPECT_EQ(log.places(), std::vector<int>{4});
}

TEST(SampleLog, WhatIsNoPlaceOfThePlanIsNoSample) {
  Log log(2);
  log.Dwell(1, {Take(2)});
  log.Dwell(2, {Take(-1)});
  log.Dwell(3, {Take(1)});
  log.Drive(4);
  EXPECT_EQ(log.places(), std::vector<int>{1});
}

}  // namespace
}  // namespace floorproof
