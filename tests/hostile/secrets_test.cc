// SPDX-License-Identifier: Apache-2.0
// An error line about a file of the wrong kind quotes nothing of it: an untrusted scenario may name
// any file of the machine, and error lines end up in public logs.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "apps/run_floorproof.h"
#include "base/base64.h"
#include "base/error.h"
#include "run/campaign/replay_shelf.h"
#include "tests/bad_input/child.h"
#include "tests/hostile/secret_files.h"
#include "tests/own_folder.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class Secrets : public OwnFolderTest {
 protected:
  ChildResult Run(const std::vector<std::string>& arguments) const {
    return RunForked(RunFloorproof, arguments, folder_);
  }
  static void ExpectUntold(const ChildResult& dut, const std::string& where) {
    EXPECT_EQ(dut.signal, 0) << where;
    EXPECT_NE(dut.status, 0) << where;
    EXPECT_THAT(dut.out + dut.err, Not(HasSubstr(kSecret))) << where;
  }
};

std::string WithFile(std::string text, const std::string& name) {
  for (std::size_t at; (at = text.find("FILE")) != std::string::npos;) text.replace(at, 4, name);
  return text;
}

class SecretsOfFiles : public Secrets, public ::testing::WithParamInterface<std::string> {};

TEST_P(SecretsOfFiles, AreNotToldWhereverAScenarioNamesThem) {
  const std::string name = GetParam(), secret = SecretFiles().at(name);
  for (const char* ending : {"", ".yaml", ".xml"}) Save(name + ending, secret);
  Save("map.yaml", "image: " + name +
                       "\nresolution: 0.5\norigin: [0, 0, 0]\n"
                       "occupied_thresh: 0.65\nfree_thresh: 0.2\nnegate: 0\n");
  Save("names_it.xml", "<mujoco><include file=\"" + name + ".xml\"/></mujoco>\n");
  for (const std::string& text : ScenariosNaming()) {
    Save("s.yaml", WithFile(text, name));
    ExpectUntold(Run({"plan", "s.yaml", "--out", "o"}), name + " in\n" + WithFile(text, name));
  }
  // The file itself where a scenario, a map, a robot should be: the user named it, and still.
  Save("s.yaml", secret);
  for (const char* command : {"plan", "init", "robot"})
    ExpectUntold(Run({command, "s.yaml", "--out", "o"}), name + std::string(" to ") + command);
}

std::vector<std::string> Names() {
  std::vector<std::string> names;
  for (const auto& [name, content] : SecretFiles()) names.push_back(name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Shapes, SecretsOfFiles, ::testing::ValuesIn(Names()),
                         [](const auto& shape) { return shape.param; });

// A folder of results from elsewhere: each of its files, one after another, is the secret, or leads
// to it.
TEST_F(Secrets, AreNotToldOfFoldersOfResults) {
  Save("plan.csv", "x_m,y_m\n1.0,1.0\n1.6,1.0\n");
  Save("s.yaml", WithFile(ScenariosNaming()[0], "plan.csv"));
  ASSERT_EQ(Run({"run", "s.yaml", "--out", "o"}).status, 0);
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "o"))
    if (entry.is_regular_file()) files.push_back(entry.path());
  ASSERT_GT(files.size(), 8u);
  const fs::path outside = folder_ / "secret";
  for (const auto& [name, secret] : SecretFiles()) {
    Save("secret", secret);
    for (const fs::path& file : files) {
      // Each file is tried with some of the shapes; each shape is tried with some file.
      if ((std::hash<std::string>()(name + file.filename().string()) & 3) != 0) continue;
      const std::string before = Slurp(file);
      fs::remove(file);
      fs::create_symlink(outside, file);
      for (const char* command : {"replay", "report"}) {
        const ChildResult dut = Run({command, "o"});
        EXPECT_THAT(dut.out + dut.err, Not(HasSubstr(kSecret))) << command << " " << file << name;
      }
      fs::remove(file);  // the page itself, perhaps
      const fs::path page = folder_ / "o/report.html";
      const std::string shown = fs::exists(page) ? Slurp(page) : "";
      EXPECT_THAT(shown, Not(HasSubstr(kSecret))) << file << name;
      std::ofstream(file, std::ios::binary) << before;
    }
  }
}

// A campaign's folder from elsewhere that leads out of itself.
class SecretsOfACampaign : public Secrets {
 protected:
  SecretsOfACampaign() {
    Save("plan.csv", "x_m,y_m\n1.0,1.0\n1.6,1.0\n");
    Save("s.yaml", WithFile(ScenariosNaming()[0], "plan.csv") + "time_limit_s: 1\ngate: none\n");
    fs::create_directories(folder_ / "outside/7");
    for (const char* file : {"outside/key", "outside/7/video.mp4", "outside/7/frame_a.png"})
      Save(file, kSecret + "\n");
    EXPECT_EQ(
        Run({"campaign", "s.yaml", "-n", "1", "--jobs", "1", "--no-films", "--out", "c"}).status,
        0);
  }
  // No command shows the secret, in plain text or as a page embeds it, or hangs.
  void ExpectKept(const std::string& what) const {
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{"report", "c"},
                                               {"replay", "c", "--episode", "0"},
                                               {"merge", "c", "--out", "m"},
                                               {"compare", "c", "c"}}) {
      const ChildResult dut = RunForked(RunFloorproof, command, folder_, {.wall_s = 20});
      EXPECT_EQ(dut.signal, 0) << what << ": " << command[0];
      EXPECT_THAT(dut.out + dut.err, Not(HasSubstr(kSecret))) << what << ": " << command[0];
    }
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      if (!entry.is_regular_file() || entry.is_symlink() ||
          entry.path().string().find("/outside/") != std::string::npos)
        continue;
      const std::string bytes = Slurp(entry.path());
      for (const std::string& secret : std::vector{kSecret, Base64(kSecret + "\n")})
        EXPECT_THAT(bytes, Not(HasSubstr(secret))) << what << ": " << entry.path();
    }
  }
};

TEST_F(SecretsOfACampaign, AreNotReachedByLinks) {
  fs::rename(folder_ / "c", folder_ / "whole");
  const std::vector<std::pair<std::string, std::string>> links = {
      {"scenario.resolved.yaml", "outside/key"},
      {"summary.json", "outside/key"},
      {"episodes", "outside"},
      {"episodes/default", "outside"},
      {"episodes/default/7", "outside/7"},
      {"heatmap_failures_1.png", "outside/key"}};
  for (const auto& [name, to] : links) {
    fs::remove_all(folder_ / "c");
    fs::remove_all(folder_ / "m");
    fs::copy(folder_ / "whole", folder_ / "c", fs::copy_options::recursive);
    fs::remove_all(folder_ / "c" / name);
    fs::create_directories((folder_ / "c" / name).parent_path());
    fs::create_symlink(folder_ / to, folder_ / "c" / name);
    ExpectKept(name);
  }
}

TEST_F(SecretsOfACampaign, AreNotReachedByAVariantsName) {
  for (const char* file : {"summary.json", "campaign.sqlite"}) {
    std::string bytes = Slurp(folder_ / "c" / file);
    for (std::size_t at; (at = bytes.find("\"default\"")) != std::string::npos;)
      bytes.replace(at, 9, "\"../../outside\"");
    std::ofstream(folder_ / "c" / file, std::ios::binary) << bytes;
  }
  EXPECT_THROW(EpisodeFolder(folder_ / "c", "../../outside", 7), InputError);
  ExpectKept("a variant's name");
}

TEST_F(SecretsOfACampaign, NeitherDoesAPipeHoldACommandUp) {
  fs::create_directories(folder_ / "c/inputs");
  ASSERT_EQ(mkfifo((folder_ / "c/inputs" / std::string(64, 'a')).c_str(), 0600), 0);
  ExpectKept("a pipe");
}

}  // namespace
}  // namespace floorproof
