// SPDX-License-Identifier: Apache-2.0
// Robot files of a user that are broken.
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/sanitizer.h"
#include "tests/bad_input/bad_input.h"
#include "tests/places.h"

namespace floorproof {
namespace {

BadInput Robot(const std::string& name, const std::string& text, std::vector<std::string> named) {
  named.insert(named.begin(), "floorproof: mine.xml");
  return {name,
          {"plan", "scenario.yaml", "--out", "o", "--set", "robot=mine.xml"},
          {{"mine.xml", text}},
          std::move(named)};
}

std::string Beluga() {
  std::ifstream file(SourceFile("models/beluga.xml"));
  return {std::istreambuf_iterator<char>(file), {}};
}

// BELUGA with these lines before its others: whatever is wrong is wrong with them.
BadInput Beside(const std::string& name, const std::string& lines, std::vector<std::string> named) {
  return Robot(name, Replaced(Beluga(), "<custom>", lines + "<custom>"), std::move(named));
}
BadInput Asset(const std::string& name, const std::string& line, std::vector<std::string> named) {
  return Beside(name, "<asset>" + line + "</asset>", std::move(named));
}
// BELUGA with this in its body `base`.
BadInput Carried(const std::string& name, const std::string& line, std::vector<std::string> named) {
  const std::string joint = "<freejoint name=\"root\"/>";
  return Robot(name, Replaced(Beluga(), joint, joint + line), std::move(named));
}

BadInput WithFiles(BadInput bad, const Files& files) {
  bad.files.insert(files.begin(), files.end());
  return bad;
}

// With this made beside the robot's file.
BadInput Prepared(BadInput bad, std::function<bool(const std::filesystem::path&)> prepare) {
  bad.prepare = std::move(prepare);
  return bad;
}

bool MakePipe(const std::filesystem::path& folder) {
  return mkfifo((folder / "pipe").c_str(), 0600) == 0;
}

// A tetrahedron, in the folder above the robot's.
bool SaveOutside(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "below");
  std::ofstream(folder / "outside.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  std::filesystem::rename(folder / "mine.xml", folder / "below/mine.xml");
  std::filesystem::create_symlink("../outside.obj", folder / "below/link.obj");
  std::filesystem::create_symlink("../none.obj", folder / "below/dangling.obj");
  return true;
}
BadInput FromOutside(const std::string& name, const std::string& file,
                     std::vector<std::string> named) {
  BadInput bad = Prepared(Asset(name, "<mesh name=\"m\" file=\"" + file + "\"/>", {}), SaveOutside);
  bad.arguments.back() = "robot=below/mine.xml";
  named.insert(named.begin(), "floorproof: below/mine.xml:");
  bad.named = std::move(named);
  return bad;
}

// What crashes MuJoCo's compiler, or makes it build what nobody can hold.
std::vector<BadInput> CompilerCases() {
  const auto builtin = [](const std::string& name, const std::string& shape) {
    return Asset(name, "<mesh name=\"m\" builtin=" + shape + "/>",
                 {"MuJoCo", "while it compiled this robot"});
  };
  std::string field(8, '\0');
  field[1] = field[5] = '\x7f';  // 32512 x 32512
  std::vector<BadInput> cases = {
      builtin("ABuiltinPlate", "\"plate\" params=\"100000 100000\""),
      builtin("ABuiltinSupersphere", "\"supersphere\" params=\"1000000 1 1\""),
      builtin("ABuiltinWedge", "\"wedge\" params=\"100000 100000 90 90 0\""),
      Asset("AModelOfItself", "<model name=\"x\" file=\"mine.xml\"/>",
            {"file = mine.xml", "is the robot's file itself"}),
      Carried("ABodyBeyondTheUniverse", "<body pos=\"1e9 0 0.1\"><geom size=\"0.01\"/></body>",
              {"body 2 = 1e+09", "within 10 m of the robot's base"}),
      WithFiles(Asset("AHugeHeightField", "<hfield name=\"h\" file=\"h.bin\" size=\"1 1 1 1\"/>",
                      {"does not compile"}),
                {{"h.bin", field}}),
      Asset("AWideHeightField", "<hfield name=\"h\" nrow=\"8193\" ncol=\"2\" size=\"1 1 1 1\"/>",
            {"nrow = 8193", "8192"}),
      WithFiles(Asset("AHugePicture", "<texture name=\"t\" type=\"2d\" file=\"t.png\"/>",
                      {"does not compile"}),
                {{"t.png", PngOfSize(30'000, 30'000)}}),
      Carried("ManyCopies",
              "<replicate count=\"&#50;001\"><site size=\"0.001\"/><geom size=\"0.001\" "
              "pos=\"0 0 0.1\"/></replicate>",
              {"geoms = 20", "at most 2000"}),
  };
#ifndef FP_ADDRESS_SANITIZER  // which leaves memory without a bound
  cases.push_back(builtin("ABuiltinSupertorus", "\"supertorus\" params=\"1000000 0.5 1 1\""));
  cases.push_back(Beside("ABillionUserNumbers", "<size nuser_geom=\"1000000000\"/>",
                         {"MuJoCo", "while it compiled this robot"}));
  cases.push_back(Asset("AHugeHeightFieldInNumbers",
                        "<hfield name=\"h\" nrow=\"40000\" ncol=\"40000\" size=\"1 1 1 1\"/>",
                        {"MuJoCo", "while it compiled this robot"}));
#endif
  return cases;
}

// Files that a model may not have, however it spells them.
std::vector<BadInput> FileCases() {
  return {
      Asset("MeshByAnEntity", "<mesh name=\"m\" file=\"&#47;dev/zero\"/>",
            {"file = /dev/zero", "outside the folder"}),
      Asset("MeshBehindACommentThatIsNone",
            "<material name=\"<!--\"/><mesh name=\"m\" "
            "file=\"/dev/zero\"/><material name=\"-->\"/>",
            {":", "file = /dev/zero", "outside the folder"}),
      Prepared(Asset("MeshIsAPipe",
                     "<mesh name=\"m\" file=\"&#112;ipe\" "
                     "content_type=\"model/obj\"/>",
                     {"file = pipe", "a pipe or a device"}),
               MakePipe),
      Prepared(WithFiles(Beside("IncludesAPipeDeepWithin", "<include file=\"a.xml\"/>",
                                {"file = pipe", "a pipe or a device"}),
                         {{"a.xml", "<mujoco><include file=\"b.xml\"/></mujoco>"},
                          {"b.xml", "<mujoco><include file='&#112;ipe'/></mujoco>"}}),
               MakePipe),
      FromOutside("MeshOutside", "../outside.obj", {"outside.obj", "outside the folder"}),
      FromOutside("MeshOutsideByALink", "link.obj", {"file = link.obj", "outside the folder"}),
      FromOutside("MeshMissingOutside", "/no/such/mesh.obj",
                  {"file = /no/such/mesh.obj", "outside the folder"}),
      FromOutside("MeshMissingOutsideByALink", "dangling.obj",
                  {"file = dangling.obj", "outside the folder"}),
      FromOutside("MeshHidden", ".git/x.obj", {"file = .git/x.obj", "hidden"}),
      Beside("IncludesAFolder", "<include file=\".\"/>", {"is a folder"}),
  };
}

// Larger, faster or heavier than a floor robot is.
std::vector<BadInput> LimitCases() {
  const auto custom = [](const std::string& name, const std::string& from, const std::string& to,
                         std::vector<std::string> named) {
    return Robot(name, Replaced(Beluga(), from, to), std::move(named));
  };
  const auto set = [](const std::string& name, const std::string& key, const std::string& value) {
    return BadInput{name,
                    {"plan", "scenario.yaml", "--out", "o", "--set", "robot=beluga", "--set",
                     "robot." + key + "=" + value},
                    {},
                    {"robot." + key + " = " + value, "must be in ["}};
  };
  return {
      custom("AToolOfAContinent", "name=\"tool_width_m\" data=\"",
             "name=\"tool_width_m\" data=\"1e9 ", {"tool_width_m = 1e+09", "must be in ["}),
      custom("AToolOfADustGrain", "name=\"tool_width_m\" data=\"",
             "name=\"tool_width_m\" data=\"1e-9 ", {"tool_width_m = ", "must be in ["}),
      custom("FasterThanLight", "name=\"max_speed_mps\" data=\"",
             "name=\"max_speed_mps\" data=\"1e9 ", {"max_speed_mps = 1e+09", "must be in ["}),
      Carried("AGeomFarAway", "<geom size=\"0.01\" pos=\"11 0 0.1\"/>",
              {"geom ", "within 10 m of the robot's base"}),
      Carried("AGeomAsLargeAsAHall", "<geom size=\"11\" pos=\"0 0 0.1\" mass=\"1\"/>",
              {"geom ", "within 10 m of the robot's base"}),
      Carried("ACasterOfHugeRollers",
              "<geom type=\"cylinder\" size=\"0.01 0.01\" pos=\"0 0 0.1\" user=\"1e9 0.5\" "
              "conaffinity=\"1\"/>",
              {"geom ", "within 10 m of the robot's base"}),
      Carried("AsHeavyAsAShip", "<geom size=\"0.01\" pos=\"0 0 0.1\" mass=\"1e6\"/>",
              {"body base", "mass (kg)", "10000"}),
      set("WheelsOfAPlanet", "wheel_radius_m", "1e9"),
      set("ClearanceOfAPlanet", "clearance_m", "1e9"),
      set("MassOfAPlanet", "mass_kg", "1e24"),
      set("RollersOfAPlanet", "roller_radius_m", "1e9"),
      set("WheelsOfNothing", "wheel_radius_m", "1e-9"),
  };
}

// A URDF of two wheels that reach no floor without their links' shapes: each case says what it
// breaks.
std::string Urdf(const std::string& more) {
  std::string text =
      "<robot name=\"r\">\n<link name=\"base\"><inertial><mass value=\"5\"/><inertia ixx=\"1\" "
      "iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n";
  for (const char* side : {"0.1", "-0.1"})
    text += std::string("<link name=\"wheel at ") + side +
            "\"><collision><geometry><sphere radius=\"0.05\"/></geometry></collision></link>\n"
            "<joint name=\"axle at " +
            side + "\" type=\"continuous\"><parent link=\"base\"/><child link=\"wheel at " + side +
            "\"/><origin xyz=\"0 " + side + " 0\"/><axis xyz=\"0 1 0\"/></joint>\n";
  return text + more + "</robot>\n";
}

BadInput UrdfCase(const std::string& name, const std::string& text,
                  std::vector<std::string> named) {
  named.insert(named.begin(), "floorproof: my.urdf");
  return {"Urdf" + name, {"robot", "my.urdf"}, {{"my.urdf", text}}, std::move(named)};
}

// What a robot that steers must be.
std::vector<BadInput> SteeringCases() {
  const auto scrubber = [](const std::string& name, const std::string& from, const std::string& to,
                           std::vector<std::string> named) {
    std::ifstream file(SourceFile("models/scrubber.xml"));
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return Robot(name, Replaced(text, from, to), std::move(named));
  };
  const std::string names = "<text name=\"steering\" data=\"fork\"/>";
  return {
      scrubber("SteeringIsNoActuator", names, "<text name=\"steering\" data=\"frok\"/>",
               {"cylinder"}),
      scrubber("SteeringIsNotNamed", names, "", {"fork", "cylinder", "named as steering"}),
      scrubber("SteeringIsTwo", names, "<text name=\"steering\" data=\"fork fork\"/>",
               {"steering", "one wheel can steer"}),
      scrubber("SteeringHasNoRange", "range=\"-1.1345 1.1345\" armature", "armature",
               {"fork", "range"}),
      scrubber("SteeringIsTooWide", "range=\"-1.1345 1.1345\"", "range=\"-1.1345 1.6\"",
               {"fork", "89 degrees"}),
      scrubber("SteeringIsAslant", "axis=\"0 0 1\" range", "axis=\"0.5 0 1\" range",
               {"fork", "axis points up"}),
      scrubber("SteeredWheelTrails", "<body name=\"drive\">",
               "<body name=\"drive\" pos=\"-.05 0 0\">", {"fork", "through the wheel's centre"}),
      scrubber("AxleOffTheOrigin", "pos=\"0 0.27 0.10\"", "pos=\"0.1 0.27 0.10\"",
               {"rear_left", "x = 0"}),
  };
}

std::vector<BadInput> UrdfCases() {
  const auto mesh = [](const std::string& uri) {
    return Urdf("<link name=\"m\"><visual><geometry>\n<mesh filename=\"" + uri +
                "\"/></geometry></visual></link><joint name=\"mj\" type=\"fixed\"><parent "
                "link=\"base\"/><child link=\"m\"/></joint>");
  };
  std::string links;
  for (int k = 0; k < 10'000; ++k) links += "<link name=\"l" + std::to_string(k) + "\"/>";
  return {
      UrdfCase("WithoutWheels", Replaced(Urdf(""), "<axis xyz=\"0 1 0\"/>", ""),
               {"no drive takes its wheels"}),
      UrdfCase("OfNoLinks", "<robot name=\"r\"/>", {"has no link"}),
      UrdfCase("OfTwoRoots", Urdf("<link name=\"loose\"/>"),
               {":7: link = loose", "hangs on nothing"}),
      UrdfCase("WithALoop",
               Urdf("<joint name=\"again\" type=\"fixed\"><parent link=\"wheel at 0.1\"/><child "
                    "link=\"wheel at -0.1\"/></joint>"),
               {":7: joint = again", "closes a loop"}),
      UrdfCase("OfTenThousandLinks", Urdf(links), {"link = 10003", "at most 500"}),
      UrdfCase("MeshClimbsOut", mesh("package://p/../../out.stl"),
               {":8: mesh = package://p/../../out.stl", "outside the folder"}),
      UrdfCase("MeshIsADevice", mesh("/dev/zero"), {":8: mesh = /dev/zero", "outside the folder"}),
      UrdfCase("NeverClosed", "<robot name=\"r\"><link name=\"a\">", {"XML"}),
      UrdfCase("NestedDeep",
               [] {
                 std::string text = "<robot name=\"r\">";
                 for (int k = 0; k < 100'000; ++k) text += "<link name=\"a\">";
                 return text;
               }(),
               {"XML"}),
      UrdfCase("OfNoMass", Replaced(Urdf(""), "value=\"5\"", "value=\"0\""), {"has a mass"}),
      UrdfCase("NotANumber", Replaced(Urdf(""), "radius=\"0.05\"", "radius=\"wide\""), {"radius"}),
      UrdfCase("NotFinite", Replaced(Urdf(""), "value=\"5\"", "value=\"inf\""),
               {":2: mass value = inf: must be a finite number"}),
      UrdfCase("IsXacro", Urdf("<xacro:wheel/>"), {":7: xacro:wheel", "is xacro"}),
  };
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
      Robot("DriveIsUnknown", Replaced(Beluga(), "\"differential\"", "\"diferential\""),
            {": drive = diferential: unknown; did you mean differential?"}),
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
      Robot("NegativeGain",
            Replaced(Beluga(), "controller=\"0 0 5 0 0 12\"", "controller=\"-1 0 5 0 0 12\""),
            {"wheel_left", "controller's gains must be 0 or more"}),
      Robot("NotFinite", Replaced(Beluga(), "mass=\"6.0\"", "mass=\"nan\""),
            {":75: geom 'belly' mass = nan: must be a finite number"}),
      Robot("NegativeFriction", Replaced(Beluga(), "friction=\"0.02 0 0\"", "friction=\"-1 0 0\""),
            {":", "geom 'caster_front' friction = -1: must be in [0, "}),
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
      Robot("CopiesOfCopies",
            with_base("<replicate count=\"60\"><replicate count=\"60\"><geom "
                      "size=\"0.1\"/></replicate></replicate>"),
            {"geoms = 3601", "at most 2000"}),
      Robot("AHugeTexture",
            "<mujoco><asset><texture name=\"t\" type=\"2d\" builtin=\"flat\" width=\"200000\" "
            "height=\"200000\"/></asset></mujoco>",
            {"width = 200000", "8192"}),
      Robot("IncludesItself", "<mujoco><include file=\"mine.xml\"/></mujoco>",
            {":1: file = mine.xml", "is the robot's file itself"}),
      Robot("MeshIsADevice",
            "<mujoco><asset>\n<mesh name=\"m\" file=\"/dev/zero\"/></asset></mujoco>",
            {":2: file = /dev/zero", "outside the folder"}),
      Robot("IncludesADevice", "<mujoco><include file='/dev/zero'/></mujoco>",
            {"file = /dev/zero", "outside the folder"}),
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
  cases.push_back({"AUrdf",
                   {"plan", "scenario.yaml", "--set", "robot=my.urdf"},
                   {},
                   {"robot = my.urdf", "`floorproof robot my.urdf`"}});
  cases.push_back({"APipe",
                   {"plan", "scenario.yaml", "--set", "robot=pipe.xml"},
                   {},
                   {"robot = pipe.xml", "a pipe or a device"},
                   [](const std::filesystem::path& folder) {
                     return mkfifo((folder / "pipe.xml").c_str(), 0600) == 0;
                   }});
  for (const auto& more :
       {CompilerCases(), FileCases(), LimitCases(), SteeringCases(), UrdfCases()})
    cases.insert(cases.end(), more.begin(), more.end());
  return cases;
}

}  // namespace floorproof
