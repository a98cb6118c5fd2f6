// SPDX-License-Identifier: Apache-2.0
// URDFs that tests write, and what becomes of them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "controllers/drive.h"
#include "env/scene/robot_model.h"
#include "env/urdf/urdf_mjcf.h"

namespace floorproof {

// A base of 5 kg on two wheels (radius 50 mm, track 240 mm), a lidar; no caster yet.
inline constexpr const char* kBase = R"(<?xml version="1.0"?>
<robot name="two wheels">
<link name="base_footprint"/>
<link name="base_link">
 <inertial><origin xyz="-0.02 0 0.05"/><mass value="5"/>
  <inertia ixx="0.03" iyy="0.04" izz="0.06" ixy="0" ixz="0" iyz="0"/></inertial>
 <collision><origin xyz="-0.02 0 0.05"/><geometry><box size="0.3 0.2 0.1"/></geometry></collision>
</link>
<joint name="foot" type="fixed">
 <parent link="base_footprint"/><child link="base_link"/><origin xyz="0 0 0.03"/></joint>
<link name="left">
 <inertial><mass value="0.3"/><inertia ixx="3e-4" iyy="3e-4" izz="5e-4" ixy="0" ixz="0" iyz="0"/></inertial>
 <collision><geometry><cylinder radius="0.05" length="0.02"/></geometry></collision></link>
<link name="right">
 <inertial><mass value="0.3"/><inertia ixx="3e-4" iyy="3e-4" izz="5e-4" ixy="0" ixz="0" iyz="0"/></inertial>
 <collision><geometry><cylinder radius="0.05" length="0.02"/></geometry></collision></link>
<joint name="left_joint" type="continuous"><parent link="base_link"/><child link="left"/>
 <origin xyz="0 0.12 0.02" rpy="-1.5707963267948966 0 0"/><axis xyz="0 0 1"/></joint>
<joint name="right_joint" type="continuous"><parent link="base_link"/><child link="right"/>
 <origin xyz="0 -0.12 0.02" rpy="-1.5707963267948966 0 0"/><axis xyz="0 0 1"/></joint>
<link name="laser"/>
<joint name="laser_joint" type="fixed"><parent link="base_link"/><child link="laser"/>
 <origin xyz="0.1 0 0.15"/></joint>
)";

inline constexpr const char* kBall = R"(<link name="ball">
 <collision><geometry><sphere radius="0.015"/></geometry></collision></link>
<joint name="ball_joint" type="fixed"><parent link="base_link"/><child link="ball"/>
 <origin xyz="-0.14 0 -0.015"/></joint>
)";

// The pivot 0.12 m behind the axle, 20 mm of trail, a wheel of 25 mm.
inline constexpr const char* kSwivel = R"(<link name="fork">
 <inertial><mass value="0.1"/><inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="fork_joint" type="continuous"><parent link="base_link"/><child link="fork"/>
 <origin xyz="-0.12 0 0.02"/><axis xyz="0 0 1"/></joint>
<link name="caster_wheel">
 <inertial><mass value="0.1"/><inertia ixx="3e-5" iyy="6e-5" izz="3e-5" ixy="0" ixz="0" iyz="0"/></inertial>
 <collision><origin rpy="1.5707963267948966 0 0"/><geometry><cylinder radius="0.025" length="0.012"/></geometry></collision></link>
<joint name="caster_joint" type="continuous"><parent link="fork"/><child link="caster_wheel"/>
 <origin xyz="-0.02 0 -0.025"/><axis xyz="0 1 0"/></joint>
)";

inline std::string WithBall(const std::string& more = "") {
  return std::string(kBase) + kBall + more + "</robot>\n";
}
inline std::string WithSwivel() { return std::string(kBase) + kSwivel + "</robot>\n"; }

// `text` with every `from` replaced; `from` must be there.
inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

// A folder of the running test's own.
inline std::filesystem::path OwnFolder() {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("urdf.") + test->test_suite_name() + "." + test->name());
  std::filesystem::create_directories(folder);
  return folder;
}
inline std::filesystem::path WrittenUrdf(const std::string& text) {
  const std::filesystem::path file = OwnFolder() / "my.urdf";
  std::ofstream(file) << text;
  return file;
}

inline std::optional<DriveChoice> AnyDrive(const RobotSpec& robot, std::string& why) {
  const auto* drive = DriveFor(robot, why);
  if (drive == nullptr) return std::nullopt;
  return DriveChoice{std::string(drive->name), drive->make()->holonomic()};
}

inline UrdfMjcf Converted(const std::string& text, const UrdfAnswers& answers = {}) {
  return MjcfOfUrdf(WrittenUrdf(text), answers, AnyDrive);
}
// The MJCF's file.
inline std::filesystem::path ConvertedFile(const std::string& text,
                                           const UrdfAnswers& answers = {}) {
  const std::filesystem::path file = OwnFolder() / "my.xml";
  std::ofstream(file) << Converted(text, answers).text;
  return file;
}

// What the URDF is refused with; "taken" where it is not.
inline std::string RefusalOf(const std::string& text, const UrdfAnswers& answers = {}) {
  try {
    Converted(text, answers);
  } catch (const InputError& e) {
    return e.what();
  }
  return "taken";
}

}  // namespace floorproof
