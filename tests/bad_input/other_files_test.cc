// SPDX-License-Identifier: Apache-2.0
// Files of other kinds in the place of robots, meshes and pictures. Error lines quote nothing of
// them: a user may name another file by mistake, and a service runs the files of others.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "apps/run_floorproof.h"
#include "base/printable.h"
#include "tests/bad_input/bad_input.h"
#include "tests/bad_input/child.h"
#include "tests/own_folder.h"
#include "tests/places.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

const std::string kSecret = "hunter2hunter2";

std::map<std::string, std::string> Contents() {
  const std::string pad(200, '\x81');
  return {
      {"Password", "root:x:0:0:" + kSecret + ":/root:/bin/bash\n" + kSecret + ":x:1:1::/:\n"},
      {"Token", "TOKEN=" + kSecret},
      {"Lines", kSecret + "\n\nTOKEN: " + kSecret + "\n[" + kSecret + "]\n'" + kSecret + "'\n"},
      {"Environment", std::string("HOME=/x\0TOKEN=", 14) + kSecret + std::string("\0A=b\0", 5)},
      {"Binary", std::string("\x89\0\1\2", 4) + kSecret + pad + kSecret},
      {"BeginsLikeXml", "<" + kSecret + "=" + kSecret + ">\n" + kSecret},
      {"BeginsLikeObj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 " + kSecret + "\nusemtl " +
                            kSecret + "\n" + kSecret + " 1 2\n"},
      {"BeginsLikeStl", "solid " + kSecret + "\nfacet normal " + kSecret + " 0 0\n" + pad},
      {"BeginsLikePng", "\x89PNG\r\n\x1a\n" + kSecret + pad},
      {"BeginsLikeCollada", "<COLLADA version=\"1.4.1\">" + kSecret + "<asset>" + kSecret},
  };
}

// Beluga with an asset that is read from `other`.
std::string WithAsset(const std::string& asset) {
  return Replaced(Slurp(SourceFile("models/beluga.xml")), "<custom>",
                  "<asset>" + asset + "</asset><custom>");
}
// A URDF that is accepted unless its mesh is broken.
std::string UrdfWithMesh(const std::string& file, const std::string& holder) {
  return Replaced(Slurp(SourceFile("models/others/scout_mini.urdf")), "</robot>",
                  "<link name=\"m\"><" + holder + "><geometry><mesh filename=\"" + file +
                      "\"/></geometry></" + holder +
                      "></link><joint name=\"mj\" type=\"fixed\"><parent link=\"base_link\"/>"
                      "<child link=\"m\"/></joint></robot>");
}

struct Role {
  std::string robot, text;  // the robot's file and its content; an empty text: the other file
  std::string other;
};
std::map<std::string, Role> Roles() {
  std::map<std::string, Role> roles = {
      {"Robot", {"other.xml", "", "other.xml"}},
      {"Urdf", {"other.urdf", "", "other.urdf"}},
      {"Include", {"mine.xml", "<mujoco><include file=\"other.xml\"/></mujoco>", "other.xml"}},
      {"Model", {"mine.xml", WithAsset("<model name=\"m\" file=\"other.xml\"/>"), "other.xml"}},
      {"Texture",
       {"mine.xml", WithAsset("<texture name=\"t\" type=\"2d\" file=\"other.png\"/>"),
        "other.png"}},
      {"RawTexture",
       {"mine.xml", WithAsset("<texture name=\"t\" type=\"2d\" file=\"other.bin\"/>"),
        "other.bin"}},
      {"HeightField",
       {"mine.xml", WithAsset("<hfield name=\"h\" size=\"1 1 1 1\" file=\"other.bin\"/>"),
        "other.bin"}},
      {"HeightPicture",
       {"mine.xml", WithAsset("<hfield name=\"h\" size=\"1 1 1 1\" file=\"other.png\"/>"),
        "other.png"}},
  };
  for (const std::string kind : {"obj", "stl", "msh", "dae"})
    roles["Mesh_" + kind] = {
        "mine.xml", WithAsset("<mesh name=\"m\" file=\"other." + kind + "\"/>"), "other." + kind};
  for (const std::string kind : {"obj", "stl", "dae"})
    roles["UrdfVisual_" + kind] = {"mine.urdf", UrdfWithMesh("other." + kind, "visual"),
                                   "other." + kind};
  roles["UrdfCollision"] = {"mine.urdf", UrdfWithMesh("other.dae", "collision"), "other.dae"};
  return roles;
}

class OtherFile : public OwnFolderTest,
                  public ::testing::WithParamInterface<std::pair<const std::string, Role>> {};

TEST_P(OtherFile, IsNotQuoted) {
  const auto& [name, role] = GetParam();
  for (const auto& [kind, content] : Contents()) {
    if (!role.text.empty()) std::ofstream(folder_ / role.robot) << role.text;
    std::ofstream(folder_ / role.other, std::ios::binary) << content;
    const ChildResult dut = RunForked(RunFloorproof, {"robot", role.robot}, folder_);
    EXPECT_EQ(dut.signal, 0) << kind;
    EXPECT_EQ((dut.out + dut.err).find(kSecret), std::string::npos) << kind << dut.out << dut.err;
    EXPECT_EQ(WhyUnprintable(dut.out + dut.err), "") << kind << ": " << dut.err;
    if (dut.status == 0) {  // a visual mesh is dropped
      EXPECT_NE(dut.out.find("mesh " + role.other + " is "), std::string::npos) << dut.out;
      continue;
    }
    EXPECT_EQ(dut.status, 2) << kind << dut.out;
    EXPECT_EQ(std::ranges::count(dut.err, '\n'), 1) << kind << ": " << dut.err;
    EXPECT_LE(dut.err.size(), 620u) << kind << ": " << dut.err;
    EXPECT_TRUE(dut.err.starts_with("floorproof: " + role.robot + ":")) << kind << ": " << dut.err;
  }
}

std::string RoleName(const ::testing::TestParamInfo<std::pair<const std::string, Role>>& tested) {
  return tested.param.first;
}
INSTANTIATE_TEST_SUITE_P(As, OtherFile, ::testing::ValuesIn(Roles()), RoleName);

}  // namespace
}  // namespace floorproof
