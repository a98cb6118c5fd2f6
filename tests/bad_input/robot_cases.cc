// SPDX-License-Identifier: Apache-2.0
// Robot files of a user that are broken.
#include <sys/stat.h>

#include "tests/bad_input/bad_input.h"

namespace floorproof {
namespace {

BadInput Robot(const std::string& name, const std::string& text, std::vector<std::string> named) {
  named.insert(named.begin(), "floorproof: mine.xml");
  return {name,
          {"plan", "scenario.yaml", "--out", "o", "--set", "robot=mine.xml"},
          {{"mine.xml", text}},
          std::move(named)};
}

}  // namespace

std::vector<BadInput> RobotCases() {
  const auto with_base = [](const std::string& inside, const std::string& after = "") {
    return "<mujoco><worldbody><body name=\"base\" pos=\"0 0 1\">" + inside +
           "<geom size=\"0.1\"/></body></worldbody>" + after + "</mujoco>";
  };
  std::vector<BadInput> cases = {
      Robot("Empty", "", {"MJCF"}),
      Robot("IsText", "beluga\n", {"MJCF"}),
      Robot("OpenTag", "<mujoco><worldbody>", {"MJCF"}),
      Robot("AnotherFormat", "<robot name=\"urdf\"><nothing/></robot>", {": "}),
      Robot("UnknownElement", "<mujoco><worldbody><bdy/></worldbody></mujoco>", {"bdy"}),
      Robot("Binary", std::string("\0\1\2\xff", 4), {"MJCF"}),
      Robot("NoBody", "<mujoco/>", {"base", "a robot needs a body named base"}),
      Robot("NoFreeJoint", with_base(""), {"base", "free joint"}),
      Robot("NoDrive", with_base("<freejoint/>"), {"drive", "missing under <custom>"}),
      Robot("NoWheels",
            with_base("<freejoint/>",
                      "<custom><text name=\"drive\" data=\"differential\"/>"
                      "<numeric name=\"tool_width_m\" data=\"0.3\"/>"
                      "<numeric name=\"step_m\" data=\"0.01\"/>"
                      "<numeric name=\"cruise_mps\" data=\"0.3\"/>"
                      "<numeric name=\"max_speed_mps\" data=\"0.5\"/>"
                      "<numeric name=\"max_accel_mps2\" data=\"0.5\"/>"
                      "<numeric name=\"max_yaw_rate_radps\" data=\"1\"/>"
                      "<numeric name=\"max_yaw_accel_radps2\" data=\"1\"/>"
                      "<numeric name=\"hotel_load_w\" data=\"10\"/></custom>"),
            {"a robot needs at least one driven wheel"}),
      Robot("NegativeMass",
            "<mujoco><worldbody><body name=\"base\"><freejoint/><geom size=\"0.1\" "
            "mass=\"-1\"/></body></worldbody></mujoco>",
            {"mass"}),
      Robot("NotANumber",
            "<mujoco><worldbody><body name=\"base\" pos=\"0 0 up\"><freejoint/><geom "
            "size=\"0.1\"/></body></worldbody></mujoco>",
            {"pos"}),
      Robot("NestedDeep",
            [] {
              std::string text = "<mujoco><worldbody>";
              for (int i = 0; i < 20'000; ++i) text += "<body>";
              return text;
            }(),
            {"MJCF"}),
      Robot("ABillionCopies",
            with_base("<replicate count=\"1000\"><replicate count=\"1000\"><geom "
                      "size=\"0.1\"/></replicate></replicate>"),
            {":1: count = 1000", "10000 copies"}),
      Robot("AHugeTexture",
            "<mujoco><asset><texture name=\"t\" type=\"2d\" builtin=\"flat\" width=\"200000\" "
            "height=\"200000\"/></asset></mujoco>",
            {"width = 200000", "8192"}),
      Robot("IncludesItself", "<mujoco><include file=\"mine.xml\"/></mujoco>",
            {"include", "without end"}),
      Robot("MeshIsADevice",
            "<mujoco><asset>\n<mesh name=\"m\" file=\"/dev/zero\"/></asset></mujoco>",
            {":2: file = /dev/zero", "a pipe or a device"}),
      Robot("IncludesADevice", "<mujoco><include file='/dev/zero'/></mujoco>",
            {"file = /dev/zero", "a pipe or a device"}),
      Robot(
          "MissingMesh",
          "<mujoco><asset><mesh name=\"m\" file=\"none.stl\"/></asset><worldbody><body "
          "name=\"base\"><freejoint/><geom type=\"mesh\" mesh=\"m\"/></body></worldbody></mujoco>",
          {"none.stl"}),
  };
  cases.push_back({"Missing",
                   {"plan", "scenario.yaml", "--set", "robot=none.xml"},
                   {},
                   {"robot = none.xml", "no such file"}});
  cases.push_back({"NoXml",
                   {"plan", "scenario.yaml", "--set", "robot=map.pgm"},
                   {},
                   {"robot = map.pgm", "unknown robot", ".xml"}});
  cases.push_back({"APipe",
                   {"plan", "scenario.yaml", "--set", "robot=pipe.xml"},
                   {},
                   {"robot = pipe.xml", "a pipe or a device"},
                   [](const std::filesystem::path& folder) {
                     return mkfifo((folder / "pipe.xml").c_str(), 0600) == 0;
                   }});
  return cases;
}

}  // namespace floorproof
