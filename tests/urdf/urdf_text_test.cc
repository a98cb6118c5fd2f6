// SPDX-License-Identifier: Apache-2.0
// What is refused, mended or left out before MuJoCo reads a URDF.
#include "env/urdf/urdf_text.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "env/urdf/urdf_model.h"
#include "tests/urdf/urdf_files.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kTetrahedron =
    "v -0.1 -0.1 0.05\nv 0.1 -0.1 0.05\nv 0 0.1 0.05\nv 0 0 0.2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 "
    "3\n";

std::string Meshed(const std::string& uri) {
  return WithBall("<link name=\"shell\"><visual><geometry><mesh filename=\"" + uri +
                  "\"/></geometry></visual></link><joint name=\"shell_joint\" type=\"fixed\">"
                  "<parent link=\"base_link\"/><child link=\"shell\"/></joint>");
}

void SaveMesh(const fs::path& file) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << kTetrahedron;
}

TEST(UrdfText, AMeshIsFoundBelowTheFile) {
  SaveMesh(OwnFolder() / "meshes/shell.obj");
  SaveMesh(OwnFolder() / "pkg/meshes/shell.obj");
  for (const char* uri :
       {"package://my_robot/meshes/shell.obj", "meshes/shell.obj", "package://pkg/meshes/shell.obj",
        "package://pkg/pkg/meshes/shell.obj", "model://pkg/meshes/shell.obj"})
    EXPECT_THAT(Converted(Meshed(uri)).text, HasSubstr("<mesh name=\"hull_0\" vertex=")) << uri;
  EXPECT_THAT(Converted(Meshed("file://" + (OwnFolder() / "meshes/shell.obj").string())).text,
              HasSubstr("hull_0"));
}

// Two files of one name are two meshes.
TEST(UrdfText, MeshesOfOneNameAreKeptApart) {
  SaveMesh(OwnFolder() / "a/shell.obj");
  SaveMesh(OwnFolder() / "b/shell.obj");
  const std::string twice = Replaced(Meshed("a/shell.obj"), "</geometry></visual></link>",
                                     "</geometry></visual><visual><geometry><mesh "
                                     "filename=\"b/shell.obj\"/></geometry></visual></link>");
  const fs::path file = WrittenUrdf(twice);
  const UrdfText dut = PrepareUrdf(file, {});
  ASSERT_EQ(dut.meshes.size(), 2u);
  EXPECT_NE(dut.meshes[0].name, dut.meshes[1].name);
}

TEST(UrdfText, AMissingMeshIsSaidAndLeftOut) {
  for (const char* uri : {"package://pkg/meshes/none.stl", "none.obj"}) {
    const UrdfMjcf dut = Converted(Meshed(uri));
    EXPECT_THAT(dut.notes, Contains(AllOf(HasSubstr(uri), HasSubstr("is not there below"))));
    EXPECT_THAT(dut.text, Not(HasSubstr("hull_0")));
  }
  std::ofstream(OwnFolder() / "shell.glb") << "glTF";
  EXPECT_THAT(Converted(Meshed("shell.glb")).notes,
              Contains(AllOf(HasSubstr("has an unsupported format"),
                             HasSubstr("assimp export shell.glb shell.stl"))));
}

// A box of 0.2 x 0.4 x 0.6 units of this many metres, its middle moved by 1 unit along x.
std::string Collada(const std::string& up, const std::string& metres) {
  std::string corners;
  for (int i = 0; i < 8; ++i)
    corners += std::string(i & 1 ? "0.1 " : "-0.1 ") + (i & 2 ? "0.2 " : "-0.2 ") +
               (i & 4 ? "0.3 " : "-0.3 ");
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="unit" meter=")" +
         metres + R"("/><up_axis>)" + up + R"(</up_axis></asset>
<library_geometries><geometry id="box"><mesh>
<source id="corners"><float_array id="values" count="24">)" +
         corners +
         R"(</float_array><technique_common><accessor source="#values" count="8" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="at"><input semantic="POSITION" source="#corners"/></vertices>
<polylist count="6"><input semantic="VERTEX" source="#at" offset="0"/><vcount>4 4 4 4 4 4</vcount>
<p>0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3 0 4 6 2 1 3 7 5</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node id="node"><translate>1 0 0</translate>
<instance_geometry url="#box"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>
)";
}

// In the file's own unit and along its own axes, whatever its up_axis.
TEST(UrdfText, AColladaMeshIsRead) {
  for (const char* up : {"Z_UP", "Y_UP"})
    for (const double metres : {1.0, 0.01}) {
      std::ofstream(OwnFolder() / "box.DAE") << Collada(up, std::to_string(metres));
      const UrdfModel dut = ReadUrdfModel(WrittenUrdf(Meshed("box.DAE")), {});
      const auto shell = std::ranges::find(dut.links, "shell", &UrdfLink::name);
      ASSERT_NE(shell, dut.links.end());
      ASSERT_EQ(shell->shapes.size(), 1u);
      Eigen::AlignedBox3d bounds;
      for (const Vec3& p : shell->shapes[0].Points()) bounds.extend(p - shell->p_M);
      EXPECT_TRUE(bounds.sizes().isApprox(metres * Vec3(0.2, 0.4, 0.6), 1e-5))
          << up << " " << bounds.sizes().transpose();
      EXPECT_TRUE(bounds.center().isApprox(metres * Vec3(1, 0, 0), 1e-5))
          << up << " " << bounds.center().transpose();
    }
}

// A broken mesh that is only seen is left out with a note; one that collides is refused.
TEST(UrdfText, ABrokenColladaMeshIsNamed) {
  const std::string collides = Replaced(Replaced(Meshed("torn.dae"), "<visual>", "<collision>"),
                                        "</visual>", "</collision>");
  for (const std::string& text :
       {std::string(), std::string("<COLLADA/>"), std::string("<COLLADA"), std::string("no XML"),
        Replaced(Collada("Z_UP", "1"), "<vcount>4 4 4 4 4 4</vcount>",
                 "<vcount>0 0 0 0 0 0</vcount>"),
        std::string("<!DOCTYPE a [<!ENTITY b SYSTEM \"/etc/passwd\">]><COLLADA>&b;</COLLADA>")}) {
    std::ofstream(OwnFolder() / "torn.dae") << text;
    EXPECT_THAT(RefusalOf(collides), HasSubstr("torn.dae")) << text;
    EXPECT_THAT(Converted(Meshed("torn.dae")).notes,
                Contains(AllOf(HasSubstr("torn.dae is not a valid Collada mesh"),
                               HasSubstr("left out of the visual"))))
        << text;
  }
}

TEST(UrdfText, AMeshOutsideTheFolderIsRefused) {
  std::ofstream(OwnFolder().parent_path() / "outside.obj") << kTetrahedron;
  std::error_code ignored;
  fs::create_symlink("../outside.obj", OwnFolder() / "link.obj", ignored);
  for (const std::string uri : {"../outside.obj", "package://pkg/../../outside.obj", "/etc/passwd",
                                "file:///etc/passwd", "link.obj", "meshes/../../outside.obj"})
    EXPECT_THAT(RefusalOf(Meshed(uri)),
                AllOf(HasSubstr("my.urdf:"), HasSubstr(uri), HasSubstr("lies outside the folder")))
        << uri;
}

TEST(UrdfText, ABrokenMeshIsNamed) {
  std::ofstream(OwnFolder() / "torn.stl") << "solid torn";
  EXPECT_THAT(RefusalOf(Meshed("torn.stl")), HasSubstr("torn.stl"));
}

TEST(UrdfText, WhatIsNoTreeIsRefused) {
  const auto joint = [](const std::string& name, const std::string& parent,
                        const std::string& child) {
    return "<joint name=\"" + name + "\" type=\"fixed\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/></joint>\n";
  };
  EXPECT_THAT(RefusalOf(WithBall("<link name=\"loose\"/>")),
              AllOf(HasSubstr("link = loose"), HasSubstr("hangs on nothing, and so does "
                                                         "base_footprint")));
  EXPECT_THAT(RefusalOf(WithBall(joint("again", "laser", "ball"))),
              AllOf(HasSubstr("joint = again"), HasSubstr("closes a loop: link ball hangs on joint "
                                                          "ball_joint already")));
  EXPECT_THAT(RefusalOf(WithBall("<link name=\"x\"/><link name=\"y\"/>" + joint("xy", "x", "y") +
                                 joint("yx", "y", "x"))),
              HasSubstr("run in a circle"));
  EXPECT_THAT(RefusalOf(WithBall(joint("nowhere", "base_link", "nobody"))),
              AllOf(HasSubstr("child = nobody"), HasSubstr("names no link")));
  EXPECT_THAT(RefusalOf(WithBall("<link name=\"ball\"/>")), HasSubstr("two links have this name"));
  EXPECT_THAT(RefusalOf("<robot name=\"r\"></robot>"), HasSubstr("has no link"));
}

TEST(UrdfText, TenThousandLinksAreRefusedAtOnce) {
  std::string links;
  for (int i = 0; i < 10'000; ++i) links += "<link name=\"l" + std::to_string(i) + "\"/>";
  EXPECT_THAT(RefusalOf(WithBall(links)),
              AllOf(HasSubstr("link = 10006"), HasSubstr("at most 500")));
}

TEST(UrdfText, WhatIsNoUrdfSaysSo) {
  EXPECT_THAT(RefusalOf("<mujoco/>"), HasSubstr("is no URDF"));
  EXPECT_THAT(RefusalOf(""), HasSubstr("is no URDF"));
  EXPECT_THAT(RefusalOf(WithBall("<xacro:wheel side=\"left\"/>")), HasSubstr("is xacro"));
  EXPECT_THAT(RefusalOf(Replaced(WithBall(), "<mass value=\"5\"/>", "<mass value=\"${m}\"/>")),
              AllOf(HasSubstr("my.urdf:5: mass = ${m}: "), HasSubstr("is xacro")));
  EXPECT_THAT(RefusalOf(WithBall("<oops")), HasSubstr("XML"));
  EXPECT_THAT(RefusalOf(Replaced(WithBall(), "type=\"continuous\"", "type=\"floating\"")),
              AllOf(HasSubstr("left_joint = floating"), HasSubstr("must be revolute")));
  EXPECT_FALSE(IsUrdf(FindRobotFile("beluga", {}), {}));
  EXPECT_FALSE(IsUrdf(OwnFolder() / "none.urdf", {}));
  EXPECT_TRUE(IsUrdf(WrittenUrdf(WithBall()), {}));
}

// Whatever is missing behind the cut is not what is wrong.
TEST(UrdfText, HalfAFileSaysSo) {
  const std::string whole = WithBall();
  for (const std::size_t cut : {whole.find("<link name=\"right\">"), whole.find("radius="),
                                whole.find("</robot>"), whole.find("</robot>") + 6})
    EXPECT_THAT(RefusalOf(whole.substr(0, cut)), HasSubstr("does not end")) << whole.substr(0, cut);
  EXPECT_EQ(RefusalOf(whole), "taken");
}

// The importer would take compiler settings from it, and folders of meshes.
TEST(UrdfText, ItsOwnSectionForMujocoIsNotRead) {
  const std::string with =
      WithBall("<mujoco>\n<compiler meshdir=\"/\"/>\n</mujoco>\n<link name=\"x\"/>");
  const fs::path file = WrittenUrdf(Replaced(with, "<link name=\"x\"/>", ""));
  const UrdfText dut = PrepareUrdf(file, {});
  EXPECT_EQ(dut.xml.find("meshdir"), std::string::npos);
  EXPECT_EQ(std::ranges::count(dut.xml, '\n'),
            std::ranges::count(Replaced(with, "<link name=\"x\"/>", ""), '\n'))
      << "messages name the lines of the user's file";
  EXPECT_THAT(dut.notes, Contains(HasSubstr("<mujoco> is not read")));
}

}  // namespace
}  // namespace floorproof
