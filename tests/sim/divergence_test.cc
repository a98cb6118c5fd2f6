// SPDX-License-Identifier: Apache-2.0
// Models whose numbers are all finite, and whose physics diverges all the same.
#include "env/sim/divergence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "env/sim/simulation.h"
#include "tests/robot_file.h"
#include "tests/robots.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

// Beluga with a weight that gravity throws upwards, along a joint without an end.
std::string WithThrownWeight(const std::string& gravcomp) {
  std::string text = Slurp(FindRobotFile("beluga", {}));
  const std::string joint = "<freejoint name=\"root\"/>";
  return text.insert(text.find(joint) + joint.size(),
                     "<body name=\"arm\" gravcomp=\"" + gravcomp +
                         "\"><joint name=\"lift\" type=\"slide\" axis=\"0 0 1\"/><geom "
                         "size=\"0.01\" mass=\"1e-3\" contype=\"0\" conaffinity=\"0\"/></body>");
}

HazardMap Floor() {
  HazardMap map;
  map.frame = {16, 16, 0.25, {}};
  map.occupancy = Grid<CellState>(16, 16);
  return map;
}

// What is said of it, and when the last step ended.
std::pair<std::string, double> Diverge(const std::string& mjcf) {
  const RobotFile file(mjcf);
  const RobotModel robot = ReadRobot(file.path());
  const HazardMap map = Floor();
  const Scene scene = BuildScene(map, robot, {}, {2, 2, 0});
  Simulation dut(scene, map, robot.spec);
  dut.Reset({2, 2, 0});
  for (int step = 0; step < 2500; ++step)
    if (!dut.Step()) return {dut.divergence(), dut.truth().t_s};
  return {"", 0};
}

// At 5e8 g, 10^10 m are reached after two seconds.
TEST(Divergence, NamesBodyJointAndTime) {
  const auto [dut, end_s] = Diverge(WithThrownWeight("5e8"));
  EXPECT_THAT(dut, MatchesRegex("body 'arm' \\(joint 'lift'\\) at [0-9.]+ s"));
  EXPECT_NEAR(std::stod(dut.substr(dut.find(" at ") + 4)), end_s, 0.005);
  EXPECT_NEAR(end_s, std::sqrt(2e10 / (5e8 * 9.81)), 0.1);
}

TEST(Divergence, IsNotedWhileTheRobotSettles) {
  EXPECT_THAT(Diverge(WithThrownWeight("1e10")).first,
              MatchesRegex("body 'arm' \\(joint 'lift'\\) at 0.00[0-9] s, while it settled .*"));
}

TEST(Divergence, OfASoundRobotIsNone) {
  EXPECT_EQ(Diverge(Slurp(FindRobotFile("beluga", {}))).first, "");
}

// The index that MuJoCo gives is of a speed, a coordinate or nothing.
TEST(Divergence, IsNamedByEachWarning) {
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  const ModelPtr model = CompileAlone(robot);
  const DataPtr data = MakeData(model.get());
  const int base = mj_name2id(model.get(), mjOBJ_BODY, "base");
  const auto with = [&](mjtWarning warning, int index) {
    mj_resetData(model.get(), data.get());
    data->warning[warning] = {index, 1};
    EXPECT_TRUE(HasDiverged(data.get()));
    return DescribeDivergence(model.get(), data.get(), base);
  };
  EXPECT_FALSE(HasDiverged(data.get()));
  EXPECT_EQ(DescribeDivergence(model.get(), data.get(), base), "body 'base' at 0.000 s");
  EXPECT_EQ(with(mjWARN_BADQPOS, 6), "body 'base' (joint 'root') at 0.000 s");
  EXPECT_EQ(with(mjWARN_BADQPOS, 7), "body 'wheel_left' (joint 'wheel_left') at 0.000 s");
  EXPECT_EQ(with(mjWARN_BADQVEL, 6), "body 'wheel_left' (joint 'wheel_left') at 0.000 s");
  EXPECT_EQ(with(mjWARN_BADQACC, 5), "body 'base' (joint 'root') at 0.000 s");
  EXPECT_EQ(with(mjWARN_BADQACC, -1), "body 'base' at 0.000 s");
  EXPECT_EQ(with(mjWARN_BADQACC, 999), "body 'base' at 0.000 s");
  EXPECT_THAT(with(mjWARN_CNSTRFULL, 0), HasSubstr("more contacts than MuJoCo has room for at"));
}

}  // namespace
}  // namespace floorproof
