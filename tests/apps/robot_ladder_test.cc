// SPDX-License-Identifier: Apache-2.0
// `robot --ladder` from end to end: a robot of one's own is measured, its model keeps what its user
// wrote, plans go by its limits, and a changed model is told so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/run_program.h"
#include "tests/own_folder.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

using ::testing::HasSubstr;
using ::testing::Not;

class RobotLadder : public OwnFolderTest {
 protected:
  std::string Load(const std::string& name) const { return Slurp(folder_ / name); }

  Result Run(const std::string& arguments) const { return RunProgram(folder_, arguments); }

  // A hall with a carpet of this height across it.
  void SaveHall(double carpet_m) const {
    Save("s.yaml", R"(scenario: 1
site:
  site: 1
  grid:
    cell_m: 0.5
    rows: |
      ########
      #......#
      #......#
      #......#
      ########
  start: {x_m: 0.9, y_m: 0.9, yaw_deg: 0}
  hazards:
    - {type: carpet, id: rug, height_m: )" +
                       std::to_string(carpet_m) +
                       R"(, polygon_m: [[2, 0.5], [3.5, 0.5], [3.5, 2], [2, 2]]}
robot: my.xml
plan: {planner: boustrophedon}
)");
  }
};

constexpr const char* kUrdf = R"(<robot name="my">
<link name="base"><inertial><mass value="6"/><origin xyz="-0.02 0 0.08"/>
 <inertia ixx="0.05" iyy="0.06" izz="0.08" ixy="0" ixz="0" iyz="0"/></inertial>
 <collision><origin xyz="-0.02 0 0.08"/><geometry><box size="0.3 0.2 0.1"/></geometry></collision>
 <collision><origin xyz="-0.14 0 0.015"/><geometry><sphere radius="0.015"/></geometry></collision></link>
<link name="l"><collision><geometry><cylinder radius="0.05" length="0.02"/></geometry></collision></link>
<link name="r"><collision><geometry><cylinder radius="0.05" length="0.02"/></geometry></collision></link>
<joint name="left" type="continuous"><parent link="base"/><child link="l"/>
 <origin xyz="0 0.12 0.05" rpy="-1.5707963267948966 0 0"/><axis xyz="0 0 1"/></joint>
<joint name="right" type="continuous"><parent link="base"/><child link="r"/>
 <origin xyz="0 -0.12 0.05" rpy="-1.5707963267948966 0 0"/><axis xyz="0 0 1"/></joint>
</robot>)";

TEST_F(RobotLadder, MeasuresARobotForItsPlans) {
  Save("my.urdf", kUrdf);
  const Result dut = Run("robot my.urdf --out my.xml --ladder --json");
  ASSERT_EQ(dut.status, 0) << dut.err;
  const auto rows = nlohmann::json::parse(dut.out)["ladder"];
  EXPECT_EQ(rows.size(), 144u);
  EXPECT_EQ(rows[0]["robot"], "my");
  const std::string model = Load("my.xml"), table = Load("my.ladder.csv");
  EXPECT_THAT(model, HasSubstr("<numeric name=\"measured_step_forward_mm\" data=\""));
  EXPECT_EQ(std::ranges::count(table, '\n'), 145);
  EXPECT_EQ(Load("my.ladder.png").substr(1, 3), "PNG");

  // Measured again: the same bytes. Made again of its URDF: what was measured stays.
  EXPECT_EQ(Run("robot my.xml --ladder --jobs 1").status, 0);
  EXPECT_EQ(Load("my.xml"), model);
  EXPECT_EQ(Load("out/robot/my.ladder.csv"), table);
  EXPECT_EQ(Run("robot my.urdf --out my.xml").status, 0);
  EXPECT_EQ(Load("my.xml"), model);
  EXPECT_EQ(nlohmann::json::parse(Run("robot my.xml --json").out)["measured"]["not_used"], "");

  // Made with other keys it is another model; an edited figure is told.
  const Result other = Run("robot my.urdf --out my.xml --set cruise_mps=0.2");
  EXPECT_THAT(other.out, HasSubstr("the limits that my.xml held are dropped"));
  EXPECT_THAT(Load("my.xml"), Not(HasSubstr("measured_")));
  EXPECT_THAT(Run("robot my.urdf --out my.xml --set cruise_mps=0.3").out,
              Not(HasSubstr("dropped")));
  std::string edited = model;
  const std::string steps = "<numeric name=\"measured_step_forward_mm\" data=\"";
  edited.insert(edited.find(steps) + steps.size(), "1");
  Save("my.xml", edited);
  EXPECT_THAT(Run("robot my.xml").out, HasSubstr("not used: they were edited since"));
  Save("my.xml", model);

  // A carpet is crossed up to its own limit, whatever step_m is.
  double limit_mm = 1e9;
  for (const auto& row : rows)
    if (row["hazard"] == "carpet" && row["friction"] == 0.8)
      limit_mm = std::min(limit_mm, row["limit"].get<double>());
  SaveHall(0.9 * limit_mm / 1000);
  EXPECT_THAT(Run("plan s.yaml --out over").out, HasSubstr("drives over 'rug'"));
  SaveHall(1.1 * limit_mm / 1000);
  const std::string plan = Run("plan s.yaml --out off").out;
  EXPECT_THAT(plan, HasSubstr("more than the robot was measured to cross"));
  EXPECT_THAT(plan, Not(HasSubstr("drives over")));

  // Heavier than it was measured, by the scenario or in the file.
  EXPECT_THAT(
      Run("plan s.yaml --out off --set robot.name=my.xml --set robot.mass_kg=9").out,
      HasSubstr(
          "measured limits are not used: the scenario changes its mass by more than a tenth"));
  std::string heavier = model;
  heavier.replace(heavier.find("mass=\""), 6, "mass=\"1");
  Save("my.xml", heavier);
  for (const char* command : {"plan s.yaml --out off", "robot my.xml"})
    EXPECT_THAT(Run(command).out, HasSubstr("not used: the model was changed since"));
  EXPECT_THAT(Run("robot my.urdf --out my.xml").err, HasSubstr("is there already, changed"));
}

}  // namespace
}  // namespace floorproof
