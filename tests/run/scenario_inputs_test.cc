// SPDX-License-Identifier: Apache-2.0
// What a scenario is read from: read once, hashed, kept beside its record.
#include <gmock/gmock.h>

#include "base/file_output.h"
#include "env/scene/models_folder.h"
#include "run/campaign/campaign_about.h"
#include "run/episode/make_plan.h"
#include "run/episode/records.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"
#include "tests/run/scenario_text.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

std::string WhyRefused(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(InputFiles, AFileIsReadOnceUnderWhateverNames) {
  const fs::path folder = fs::path(::testing::TempDir()) / "InputFiles.Once";
  fs::create_directories(folder);
  std::ofstream(folder / "a") << "first";
  const InputFiles dut, copy = dut, other;
  EXPECT_EQ(dut.Read(folder / "a", 100), "first");
  std::ofstream(folder / "a") << "second";
  EXPECT_EQ(dut.Read(folder / "." / "a", 100), "first");
  EXPECT_EQ(copy.Read(folder / "a", 100), "first") << "copies share";
  EXPECT_EQ(dut.Sha256(folder / "a"), Sha256("first"));
  EXPECT_EQ(other.Read(folder / "a", 100), "second");
  EXPECT_EQ(dut.All().size(), 1u);
  EXPECT_THROW(dut.Read(folder / "a", 3), InputError);
  fs::remove_all(folder);
}

TEST(InputFiles, ACopyStandsInAndMustBeWhatItsNameSays) {
  const fs::path folder = fs::path(::testing::TempDir()) / "InputFiles.Copy";
  fs::create_directories(folder);
  std::ofstream(folder / "a") << "content";
  KeepCopy(InputFiles(), folder / "a", folder);
  const fs::path kept = KeptCopy(folder, Sha256("content"));
  EXPECT_EQ(Slurp(kept), "content");
  const InputFiles dut, damaged;
  dut.StandIn("/nowhere/b", Sha256("content"), kept);
  EXPECT_EQ(dut.WhyUnreadable("/nowhere/b", 100), "");
  EXPECT_EQ(dut.Read("/nowhere/../nowhere/b", 100), "content");
  std::ofstream(kept) << "other";
  damaged.StandIn("/nowhere/b", Sha256("content"), kept);
  EXPECT_THAT(WhyRefused([&] { damaged.Read("/nowhere/b", 100); }),
              AllOf(HasSubstr(kept.string()), HasSubstr("is not what its name says")));
  EXPECT_THAT(WhyRefused([&] { KeepCopy(InputFiles(), folder / "a", folder); }),
              HasSubstr("is not what its name says"));
  fs::remove_all(folder);
}

// BELUGA with a load that is a mesh, on a floor from a ROS map, after a plan of its own: all in
// files of the user's.
class ScenarioInputs : public ScenarioTest {
 protected:
  ScenarioInputs() {
    for (const char* name : {"in/robot/parts", "in/robot/meshes", "in/map"})
      fs::create_directories(folder_ / name);
    std::string mjcf = Slurp(ModelsFolder() / "beluga.xml");
    const std::string at = "<mujoco model=\"beluga\">", joint = "<freejoint name=\"root\"/>";
    mjcf.replace(mjcf.find(at), at.size(), at + R"(<include file="parts/load.xml"/>)");
    mjcf.replace(mjcf.find(joint), joint.size(), joint + R"(<geom type="mesh" mesh="load"
        pos="0 0 0.1" contype="0" conaffinity="0" density="1000"/>)");
    Save("in/robot/robot.xml", mjcf);
    Save("in/robot/parts/load.xml",
         R"(<mujoco><asset><mesh name="load" file="../meshes/load.obj"/></asset></mujoco>)");
    SaveLoad(0.1);
    SaveMap(20);
    SavePlan(1.0);
    Save("in/s.yaml",
         "scenario: 1\nsite: {site: 1, map: map/map.yaml}\nrobot: robot/robot.xml\n"
         "start: {x_m: 1, y_m: 1, yaw_deg: 0}\nplan: {file: plan.csv}\ndrive: none\n");
  }
  // A cube of that side, whose weight the robot's mass tells.
  void SaveLoad(double side_m) const {
    std::string obj;
    for (int i = 0; i < 8; ++i)
      obj += "v " + std::to_string(i & 1 ? side_m : 0) + " " + std::to_string(i & 2 ? side_m : 0) +
             " " + std::to_string(i & 4 ? side_m : 0) + "\n";
    for (const char* face : {"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"})
      obj += std::string("f ") + face + "\n";
    Save("in/robot/meshes/load.obj", obj);
  }
  // A free floor of so many cells a side, of 0.2 m.
  void SaveMap(int cells) const {
    std::string image = "P2\n" + std::to_string(cells) + " " + std::to_string(cells) + "\n255\n";
    for (int i = 0; i < cells * cells; ++i) image += "254\n";
    Save("in/map/map.pgm", image);
    Save("in/map/map.yaml",
         "image: map.pgm\nresolution: 0.2\norigin: [0, 0, 0]\n"
         "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  }
  void SavePlan(double y_m) const {
    Save("in/plan.csv", "x_m,y_m\n1,1\n2," + std::to_string(y_m) + "\n");
  }
  static std::string Read(const ScenarioFile& file, std::optional<std::uint64_t> episode = 0) {
    const Scenario s = file.Read(episode);
    return std::to_string(s.world.robot.spec.mass_kg) + " kg, " +
           std::to_string(s.world.site.map.frame.width) + " cells, to y " +
           std::to_string(s.spec.user_plan.back().p_W.y());
  }
  // Built, as an episode is: meshes are read by the compiler.
  static double MassOfScene(const ScenarioFile& file) {
    const Scenario s = file.Read();
    const Scene scene = BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start);
    return scene.model->body_subtreemass[scene.base_body];
  }
  std::vector<std::string> FilesListed(const std::string& resolved) const {
    std::vector<std::string> names;
    const ConfigNode root = ParseYaml(resolved, "");
    for (const auto& [name, hash] : root.Find("files")->entries) names.push_back(name);
    return names;
  }
};

TEST_F(ScenarioInputs, EpisodesKeepToTheInputsOfTheFirst) {
  const ScenarioFile dut(folder_ / "in/s.yaml");
  const std::string before = Read(dut);
  const double mass_kg = MassOfScene(dut);
  SavePlan(2.0);
  SaveMap(30);
  SaveLoad(0.2);
  EXPECT_EQ(Read(dut, 1), before);
  EXPECT_EQ(MassOfScene(dut), mass_kg);
  const ScenarioFile anew(folder_ / "in/s.yaml");
  EXPECT_THAT(Read(anew), AllOf(HasSubstr("30 cells"), HasSubstr("y 2.0")));
  EXPECT_NEAR(MassOfScene(anew) - mass_kg, 7.0, 1e-6) << "8 l of water, and 1 l before";
  EXPECT_EQ(MassOfScene(dut), mass_kg) << "whoever reads it in between";
}

TEST_F(ScenarioInputs, EveryFileThatTheEngineOpensIsListed) {
  const ScenarioFile file(folder_ / "in/s.yaml");
  const std::string resolved = ResolvedScenario(file.Read(), folder_ / "out");
  for (const char* name :
       {"../in/robot/robot.xml", "../in/robot/parts/load.xml", "../in/robot/meshes/load.obj",
        "../in/map/map.yaml", "../in/map/map.pgm", "../in/plan.csv"})
    EXPECT_THAT(FilesListed(resolved), ::testing::Contains(name));
}

TEST_F(ScenarioInputs, AnotherMeshIsAnotherCampaign) {
  const CampaignAbout before = DescribeCampaign(ScenarioFile(folder_ / "in/s.yaml"));
  RequireSame(before, DescribeCampaign(ScenarioFile(folder_ / "in/s.yaml")), "o");
  SaveLoad(0.2);
  const CampaignAbout after = DescribeCampaign(ScenarioFile(folder_ / "in/s.yaml"));
  EXPECT_THAT(WhyRefused([&] { RequireSame(before, after, "o"); }), HasSubstr("load.obj"));
}

// A record is of what was driven: drawn again, it would be another experiment.
TEST_F(ScenarioInputs, WhatIsSetIsNotDrawnNorInTheRecord) {
  std::ofstream(folder_ / "in/drawn.yaml") << Slurp(folder_ / "in/s.yaml")
                                           << "randomise: {site.floor.friction: {uniform: [0.5, "
                                              "0.9]}, start.x_m: {normal: [1, 0.05]}}\n";
  fs::create_directories(folder_ / "out");
  for (const auto& set : std::vector<std::vector<Override>>{
           {{"site.floor.friction", "0.3"}},
           {{"site.floor.friction", "0.3"}, {"start", "{x_m: 1.1, y_m: 1, yaw_deg: 0}"}}}) {
    const Scenario driven = ScenarioFile(folder_ / "in/drawn.yaml", set).Read();
    EXPECT_EQ(driven.world.site.map.floor_friction, 0.3);
    EXPECT_EQ(driven.spec.drawn.size(), 2 - set.size());
    WriteResolvedScenario(driven, folder_ / "out");
    const Scenario again = ScenarioFile(folder_ / "out/scenario.resolved.yaml").Read();
    EXPECT_EQ(again.world.site.map.floor_friction, 0.3);
    EXPECT_EQ(again.world.start.x_m, driven.world.start.x_m);
    EXPECT_EQ(again.spec.drawn.size(), driven.spec.drawn.size());
  }
}

// Wherever a scenario names a file, the path is from its folder; the record's, from its own.
TEST_F(ScenarioInputs, PathsAreTheScenariosWhereverTheyAreWritten) {
  for (const char* folder : {"in/floors", "in/maps"}) fs::create_directories(folder_ / folder);
  const auto map = [](const char* cell_m) {
    return std::string("image: ../map/map.pgm\nresolution: ") + cell_m +
           "\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  };
  Save("in/maps/wide.yaml", map("0.4"));
  Save("in/maps/wider.yaml", map("0.5"));
  Save("in/floors/site.yaml", "site: 1\nmap: ../map/map.yaml\n");
  const std::string written =
      "scenario: 1\nsite: floors/site.yaml\nrobot: beluga\nstart: {x_m: 1, y_m: 1}\n"
      "plan: {file: plan.csv}\ndrive: none\n";
  const auto widths = [](const ScenarioFile& file) {
    std::vector<double> cells_m;
    for (const Variant& variant : file.variants())
      cells_m.push_back(file.Read(0, variant).world.site.map.frame.cell_m);
    return cells_m;
  };
  const std::vector<std::pair<std::string, std::vector<double>>> cases = {
      {"matrix: {site.map: [maps/wide.yaml, maps/wider.yaml]}", {0.4, 0.5}},
      {"matrix: {floor: [{label: a, site.map: maps/wide.yaml}]}", {0.4}},
      {"matrix: {site: [{label: a, site: {site: 1, map: maps/wide.yaml}}, floors/site.yaml]}",
       {0.4, 0.2}},
      {"matrix: {site: [{label: a, site: floors/site.yaml}]}", {0.2}},
      {"matrix: {robot: [{label: a, robot: robot/robot.xml}, {label: b, robot.name: beluga}]}",
       {0.2, 0.2}},
      {"matrix: {plan: [{label: a, plan: {file: plan.csv}}, {label: b, plan: spiral}]}",
       {0.2, 0.2}},
      {"randomise: {site.map: {choice: [maps/wide.yaml]}}", {0.4}},
      {"randomise: {site: {choice: [{site: 1, map: maps/wider.yaml}]}}", {0.5}},
      {"randomise: {robot: {choice: [{name: robot/robot.xml}]}}", {0.2}},
      {"randomise: {plan: {choice: [{file: plan.csv}]}}", {0.2}}};
  fs::create_directories(folder_ / "far/out");
  for (const auto& [draws, expected] : cases) {
    SCOPED_TRACE(draws);
    Save("in/s.yaml", written + draws + "\n");
    const ScenarioFile file(folder_ / "in/s.yaml");
    EXPECT_EQ(widths(file), expected);
    WriteResolvedScenario(file.Read(std::nullopt), folder_ / "far/out", file.files().All());
    EXPECT_EQ(widths(ScenarioFile(folder_ / "far/out/scenario.resolved.yaml")), expected);
  }
  Save("in/s.yaml", written);
  const ScenarioFile set(folder_ / "in/s.yaml", {{"site.map", "maps/wide.yaml"}});
  EXPECT_EQ(widths(set), std::vector<double>{0.4});
}

// A site's start that is drawn is not the record's for all episodes.
TEST_F(ScenarioInputs, ADrawnStartOfTheSiteIsDrawnAgain) {
  fs::create_directories(folder_ / "out");
  for (const char* draws : {"randomise: {site.start.x_m: {choice: [1.5]}}",
                            "randomise: {site.start: {choice: [{x_m: 1.5, y_m: 1}]}}",
                            "matrix: {site.start.x_m: [1.5]}"}) {
    SCOPED_TRACE(draws);
    Save("in/s.yaml", std::string("scenario: 1\nsite: {site: 1, map: map/map.yaml, start: {x_m: 1, "
                                  "y_m: 1}}\nrobot: beluga\ndrive: none\n") +
                          draws + "\n");
    const ScenarioFile file(folder_ / "in/s.yaml");
    ASSERT_EQ(file.Read(0, file.variants().front()).world.start.x_m, 1.5);
    WriteResolvedScenario(file.Read(std::nullopt), folder_ / "out", file.files().All());
    const ScenarioFile again(folder_ / "out/scenario.resolved.yaml");
    EXPECT_EQ(again.Read(0, again.variants().front()).world.start.x_m, 1.5);
  }
}

// Two robots that only draws name, and two files of one name.
TEST_F(ScenarioInputs, AnotherDrawnRobotIsAnotherCampaign) {
  for (const char* robot : {"r1", "r2"}) {
    fs::create_directories(folder_ / "in" / robot);
    fs::copy(ModelsFolder() / "beluga.xml", folder_ / "in" / robot / "mine.xml");
  }
  const auto heavier = [&](const char* robot) {
    std::string text = Slurp(ModelsFolder() / "beluga.xml");
    const std::size_t at = text.find("mass=\"");
    ASSERT_NE(at, std::string::npos);
    text.insert(at + 6, "1");
    std::ofstream(folder_ / "in" / robot / "mine.xml") << text;
  };
  std::ofstream(folder_ / "in/drawn.yaml")
      << Slurp(folder_ / "in/s.yaml")
      << "randomise: {robot: {choice: [r1/mine.xml, r2/mine.xml]}}\n";
  const auto describe = [&] { return DescribeCampaign(ScenarioFile(folder_ / "in/drawn.yaml")); };
  const CampaignAbout same = describe();
  RequireSame(same, describe(), "o");
  heavier("r2");
  const CampaignAbout second = describe();
  EXPECT_THAT(WhyRefused([&] { RequireSame(same, second, "o"); }), HasSubstr("r2/mine.xml"));
  fs::copy(ModelsFolder() / "beluga.xml", folder_ / "in/r2/mine.xml",
           fs::copy_options::overwrite_existing);
  heavier("r1");
  EXPECT_NE(describe().id, second.id) << "the same two files, each in the other's place";
}

// `link/..` is the folder above the one that the link leads to.
TEST_F(ScenarioInputs, TheRobotThatIsHashedIsTheOneThatIsRead) {
  fs::create_directories(folder_ / "real/deep");
  fs::create_directory_symlink(folder_ / "real/deep", folder_ / "link");
  for (const char* at : {"real/r", "r"}) fs::create_directories(folder_ / at);
  const std::string text = Slurp(ModelsFolder() / "beluga.xml");
  std::ofstream(folder_ / "real/r/mine.xml") << text;
  std::ofstream(folder_ / "r/mine.xml") << "no robot";
  std::ofstream(folder_ / "real/deep/s.yaml")
      << "scenario: 1\nsite: {site: 1, grid: {cell_m: 0.5, rows: \"......\\n......\\n......\"}, "
         "start: {x_m: 1, "
         "y_m: 0.7}}\nrobot: ../r/mine.xml\n";
  const Scenario dut = ScenarioFile(folder_ / "link/s.yaml", {}, Trust::kFull).Read();
  EXPECT_EQ(dut.files.Sha256(dut.spec.robot_file), Sha256(text));
  ASSERT_EQ(dut.world.robot.files.size(), 1u);
  EXPECT_EQ(fs::canonical(dut.world.robot.files[0]), fs::canonical(folder_ / "real/r/mine.xml"));
}

// What the program trusts as its own is its own.
TEST_F(ScenarioInputs, NothingStandsInForABundledRobot) {
  const std::string text = "<mujoco><asset><mesh name=\"a\" builtin=\"plate\"/></asset></mujoco>";
  fs::create_directories(folder_ / "in/inputs");
  std::ofstream(folder_ / "in/inputs" / Sha256(text)) << text;
  std::ofstream(folder_ / "in/bundled.yaml")
      << "scenario: 1\nsite: {site: 1, grid: {cell_m: 0.5, rows: \"......\\n......\\n......\"}, "
         "start: {x_m: 1, "
         "y_m: 0.7}}\nrobot: beluga\nfiles: {\"bundled:beluga.xml\": \""
      << Sha256(text) << "\"}\n";
  EXPECT_THAT(WhyRefused([&] { ScenarioFile(folder_ / "in/bundled.yaml").Read(); }),
              HasSubstr("the file has changed since"));
}

// A record that leads into the program's folder could not be read beside another one.
TEST_F(ScenarioInputs, WhatComesWithTheProgramIsListedByItsName) {
  std::ofstream(folder_ / "in/bundled.yaml")
      << "scenario: 1\nsite: {site: 1, map: map/map.yaml, start: {x_m: 1, y_m: 1}}\n"
         "robot: beluga\nplan: {planner: fmea_path_transform}\nmission: follow_plan\n";
  const Scenario dut = ScenarioFile(folder_ / "in/bundled.yaml").Read();
  EXPECT_THAT(FilesListed(ResolvedScenario(dut, folder_ / "out")),
              ::testing::IsSupersetOf({"bundled:beluga.xml", "bundled:fmea/htetro.yaml",
                                       "bundled:missions/follow_plan.yaml"}));
}

TEST_F(ScenarioInputs, ARecordIsReadWhereItIsMovedTo) {
  const ScenarioFile file(folder_ / "in/s.yaml");
  const std::string before = Read(file);
  const double mass_kg = MassOfScene(file);
  fs::create_directories(folder_ / "out");
  WriteResolvedScenario(file.Read(), folder_ / "out");
  fs::create_directories(folder_ / "some/where");
  fs::rename(folder_ / "out", folder_ / "some/where/else");
  fs::remove_all(folder_ / "in");
  const fs::path record = folder_ / "some/where/else/scenario.resolved.yaml";
  const ScenarioFile dut(record);
  EXPECT_EQ(Read(dut), before);
  EXPECT_EQ(MassOfScene(dut), mass_kg);
  EXPECT_EQ(ResolvedScenario(dut.Read(), record.parent_path()), Slurp(record));
  // Moved on, and from there again.
  fs::create_directories(folder_ / "third");
  WriteResolvedScenario(dut.Read(), folder_ / "third");
  fs::remove_all(folder_ / "some");
  EXPECT_EQ(Read(ScenarioFile(folder_ / "third/scenario.resolved.yaml")), before);
}

// Named by absolute paths, in the map and in the robot.
TEST_F(ScenarioInputs, AbsolutePathsMoveToo) {
  Save("in/robot/parts/load.xml", R"(<mujoco><asset><mesh name="load" file=")" +
                                      (folder_ / "in/robot/meshes/load.obj").string() +
                                      R"("/></asset></mujoco>)");
  Save("in/map/map.yaml", "image: " + (folder_ / "in/map/map.pgm").string() +
                              "\nresolution: 0.2\norigin: [0, 0, 0]\noccupied_thresh: 0.65\n"
                              "free_thresh: 0.196\n");
  const ScenarioFile file(folder_ / "in/s.yaml");
  const std::string before = Read(file);
  const double mass_kg = MassOfScene(file);
  fs::create_directories(folder_ / "out");
  WriteResolvedScenario(file.Read(), folder_ / "out");
  fs::create_directories(folder_ / "a/b");
  fs::rename(folder_ / "out", folder_ / "a/b/c");
  fs::remove_all(folder_ / "in");
  const ScenarioFile dut(folder_ / "a/b/c/scenario.resolved.yaml");
  EXPECT_EQ(Read(dut), before);
  EXPECT_EQ(MassOfScene(dut), mass_kg);
}

TEST_F(ScenarioInputs, ACopyThatWasChangedIsRefused) {
  fs::create_directories(folder_ / "out");
  const Scenario s = ScenarioFile(folder_ / "in/s.yaml", {}, Trust::kFull).Read();
  WriteResolvedScenario(s, folder_ / "out");
  for (const auto& entry : fs::directory_iterator(folder_ / "out/inputs")) {
    const std::string was = Slurp(entry.path());
    std::ofstream(entry.path()) << was << "\n";
    EXPECT_THAT(
        WhyRefused(
            [&] { ScenarioFile(folder_ / "out/scenario.resolved.yaml", {}, Trust::kFull).Read(); }),
        AllOf(HasSubstr(entry.path().filename().string()), HasSubstr("is not what its name says")));
    std::ofstream(entry.path()) << was;
  }
}

// A record of a version that kept no copies.
TEST_F(ScenarioInputs, WithoutCopiesTheFilesThemselvesAreReadAndCompared) {
  fs::create_directories(folder_ / "out");
  const ScenarioFile file(folder_ / "in/s.yaml", {}, Trust::kFull);
  WriteResolvedScenario(file.Read(), folder_ / "out");
  fs::remove_all(folder_ / "out/inputs");
  EXPECT_EQ(Read(ScenarioFile(folder_ / "out/scenario.resolved.yaml", {}, Trust::kFull)),
            Read(file));
  SaveLoad(0.2);
  EXPECT_THAT(WhyRefused([&] {
                ScenarioFile(folder_ / "out/scenario.resolved.yaml", {}, Trust::kFull).Read();
              }),
              AllOf(HasSubstr("load.obj"), HasSubstr("has changed since")));
}

}  // namespace
}  // namespace floorproof
