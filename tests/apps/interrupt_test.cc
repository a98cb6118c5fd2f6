// SPDX-License-Identifier: Apache-2.0
// Ctrl-C at any moment: exit status 130, one line that says what is there, and every file that is
// there is whole. The moments are derived from what the program has done so far, and spread in
// between. What is asserted holds wherever they fall.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <opencv2/videoio.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/config.h"
#include "media/media.h"
#include "tests/own_folder.h"
#include "tests/places.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// The program, running in `folder` on its own.
class Program {
 public:
  Program(const std::vector<std::string>& arguments, const fs::path& folder,
          void (*on_sigint)(int) = SIG_DFL, rlim_t most_bytes = RLIM_INFINITY)
      : said_(folder / ".." / (folder.filename().string() + ".said")) {
    std::vector<std::string> words = {ProgramFile().string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ != 0) return;
    const int out = open("/dev/null", O_RDWR);
    const int err = open(said_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(out, 0), dup2(out, 1), dup2(err, 2);
    signal(SIGINT, on_sigint), signal(SIGTERM, SIG_DFL), signal(SIGHUP, SIG_DFL);
    const rlimit limit{most_bytes, most_bytes};  // of any file: a disk that is full
    setrlimit(RLIMIT_FSIZE, &limit);
    signal(SIGXFSZ, SIG_IGN);
    alarm(240);
    if (chdir(folder.c_str()) == 0) execv(argv[0], argv.data());
    _exit(127);
  }
  ~Program() {
    if (!HasEnded()) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
    fs::remove(said_);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  bool HasEnded() {
    if (!ended_) ended_ = waitpid(pid_, &code_, WNOHANG) == pid_;
    return ended_;
  }
  // Before the first line of main a signal ends any program, silently.
  bool Listens() const {
    std::istringstream status(Slurp("/proc/" + std::to_string(pid_) + "/status"));
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("SigCgt:"))
        return (std::stoull(line.substr(7), nullptr, 16) >> (SIGTERM - 1)) & 1;
    return false;
  }
  void Send(int number) const { kill(pid_, number); }
  // The exit status; -1 when a signal ended it.
  int Wait() {
    if (!ended_) waitpid(pid_, &code_, 0);
    ended_ = true;
    return WIFEXITED(code_) ? WEXITSTATUS(code_) : -1;
  }
  // Without the address sanitizer's three lines on a handler that ends the process from a thread
  // whose stack it does not know.
  std::string Said() const {
    std::istringstream all(Slurp(said_));
    std::string said;
    for (std::string line; std::getline(all, line);)
      if (line.find("__asan_handle_no_return") == std::string::npos &&
          !line.starts_with("False positive error reports may follow") &&
          line.find("github.com/google/sanitizers") == std::string::npos &&
          !line.starts_with("  "))  // how far it is, on a machine that needs more than ten seconds
        said += line + "\n";
    return said;
  }

 private:
  fs::path said_;
  pid_t pid_ = -1;
  int code_ = 0;
  bool ended_ = false;
};

// When the signal is sent: once the program listens, `file` is there with at least `bytes`, and
// then some time more.
struct Moment {
  std::string file;
  std::uintmax_t bytes = 0;
  int then_ms = 0;
  int number = SIGINT;
};

class InterruptTest : public OwnFolderTest {
 protected:
  InterruptTest() { Fresh(); }
  void Fresh() const {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "room.yaml") << R"(scenario: 1
site:
  site: 1
  grid:
    cell_m: 0.5
    rows: |
      #####
      #...#
      #...#
      #####
  start: {x_m: 0.9, y_m: 0.9, yaw_deg: 0}
robot: beluga
plan: {planner: boustrophedon}
video: {width: 160, height: 90, max_frames: 80, camera: top}
)";
  }

  static bool IsThere(const fs::path& file, std::uintmax_t bytes) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    return !error && size >= bytes;
  }

  // Interrupts the command there; true when it had not ended before the signal.
  bool Interrupt(const std::vector<std::string>& arguments, const Moment& moment) const {
    SCOPED_TRACE(arguments.front() + " at " + moment.file + " " + std::to_string(moment.bytes) +
                 " + " + std::to_string(moment.then_ms) + " ms");
    Program dut(arguments, folder_);
    while (!dut.HasEnded() && !dut.Listens()) usleep(200);
    if (!moment.file.empty())
      while (!dut.HasEnded() && !IsThere(folder_ / moment.file, moment.bytes)) usleep(200);
    usleep(static_cast<useconds_t>(1000 * moment.then_ms));
    dut.Send(moment.number);
    const int status = dut.Wait();
    ExpectWholeFiles();
    if (status == 0 || status == 1) {
      EXPECT_EQ(dut.Said(), "");
      return false;
    }
    EXPECT_EQ(status, 130) << dut.Said();
    EXPECT_TRUE(dut.Said().starts_with("floorproof: interrupted: ")) << dut.Said();
    EXPECT_EQ(std::ranges::count(dut.Said(), '\n'), 1) << dut.Said();
    return true;
  }

  void ExpectWholeFiles() const {
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      const fs::path file = entry.path();
      SCOPED_TRACE(file.string());
      EXPECT_EQ(file.filename().string().find(".part"), std::string::npos);
      const std::string kind = file.extension().string();
      if (kind == ".json") {
        EXPECT_TRUE(nlohmann::json::accept(Slurp(file)));
      }
      if (kind == ".yaml") {
        EXPECT_NO_THROW(ReadYamlFile(file));
      }
      if (kind == ".png") {
        EXPECT_NO_THROW(ReadImage(file));
      }
      if (kind == ".csv") ExpectWholeRows(Slurp(file));
      if (kind == ".mp4") {
        EXPECT_GT(cv::VideoCapture(file.string()).get(cv::CAP_PROP_FRAME_COUNT), 1);
      }
      if (kind == ".xml") {
        EXPECT_TRUE(Slurp(file).ends_with(file.filename() == "junit.xml" ? "</testsuites>\n"
                                                                         : "</mujoco>\n"));
      }
    }
  }
  static void ExpectWholeRows(const std::string& csv) {
    EXPECT_TRUE(csv.ends_with("\n"));
    std::istringstream rows(csv);
    std::string head, row;
    std::getline(rows, head);
    const auto commas = std::ranges::count(head, ',');
    while (std::getline(rows, row)) EXPECT_EQ(std::ranges::count(row, ','), commas) << row;
  }
  const std::string hall_ = SourceFile("models/scenarios/demo_beluga.yaml").string();
};

// A file's name while it is written begins where it will stand; the film's is there all the while.
constexpr const char* kFilmPart = "o/.video.part.mp4";

const std::vector<std::string> kFilmedRun = {"run", "room.yaml", "--out", "o", "--video"};

TEST_F(InterruptTest, OfARunBeforeItsFilm) {
  const Moment moments[] = {
      {"", 0, 0},
      {"", 0, 5},
      {"o/plan.csv", 0, 0},
      {"o/plan.json", 0, 0},
      {"o/plan.json", 0, 0, SIGTERM},
      {"o/plan.json", 0, 0, SIGHUP},
      {"o/plan.json", 0, 60},
      {"o/trace.csv", 0, 0},
      {"o/result.json", 0, 0},
      {"o/heatmap_visits.png", 0, 0},
      {"o/heatmap_failures.png", 0, 0},
  };
  for (const Moment& moment : moments) {
    Fresh();
    EXPECT_TRUE(Interrupt(kFilmedRun, moment)) << moment.file;
    EXPECT_FALSE(fs::exists(folder_ / "o/video.mp4"));
    if (moment.file == "o/plan.csv") {  // result.json says that the drive was not cut short
      EXPECT_FALSE(fs::exists(folder_ / "o/result.json"));
    }
  }
}

TEST_F(InterruptTest, OfAFilm) {
  for (const Moment& moment : {Moment{kFilmPart, 0, 0}, Moment{kFilmPart, 0, 50},
                               Moment{kFilmPart, 0, 50, SIGTERM}, Moment{"o/frame_start.png"}}) {
    Fresh();
    EXPECT_TRUE(Interrupt(kFilmedRun, moment)) << moment.then_ms;
    EXPECT_FALSE(fs::exists(folder_ / "o/video.mp4"));
    EXPECT_TRUE(fs::exists(folder_ / "o/result.json"));
  }
  Fresh();  // here the film may have been finished before the signal came
  Interrupt(kFilmedRun, {"o/frame_end.png"});
}

// What an earlier run left behind is no part of this one.
TEST_F(InterruptTest, OfARunInAUsedFolder) {
  fs::create_directories(folder_ / "o");
  std::ofstream(folder_ / "o/result.json") << "{}";
  std::ofstream(folder_ / "o/trace.csv") << "old\n";
  std::ofstream(folder_ / "o/files.sha256")
      << "# written by floorproof; `sha256sum --check` compares\n# being written: episode\n";
  EXPECT_TRUE(Interrupt({"run", hall_, "--out", "o"}, {"o/plan.json", 0, 30}));
  EXPECT_FALSE(fs::exists(folder_ / "o/result.json"));
  if (fs::exists(folder_ / "o/trace.csv")) {
    EXPECT_NE(Slurp(folder_ / "o/trace.csv"), "old\n");
  }
}

// A drive cut short leaves the rows that were driven.
TEST_F(InterruptTest, OfADriveKeepsItsTrace) {
  const std::vector<std::string> run = {"run", hall_, "--out", "o"};
  int with_trace = 0;
  for (const int then_ms : {100, 200, 300, 400}) {
    Fresh();
    if (!Interrupt(run, {"o/plan.json", 0, then_ms})) continue;
    if (fs::exists(folder_ / "o/result.json")) continue;
    with_trace += fs::exists(folder_ / "o/trace.csv");
  }
  EXPECT_GE(with_trace, 1);
}

// What was driven cannot be kept: both is said.
TEST_F(InterruptTest, OfADriveOnAFullDiskIsStillAnInterruption) {
  int interrupted = 0;
  for (const int then_ms : {200, 400, 1500}) {
    Fresh();
    Program dut({"run", hall_, "--out", "o"}, folder_, SIG_DFL, 12'000);
    while (!dut.HasEnded() && !IsThere(folder_ / "o/plan.json", 0)) usleep(200);
    usleep(static_cast<useconds_t>(1000 * then_ms));
    dut.Send(SIGINT);
    const int status = dut.Wait();
    if (dut.Said().find("interrupted: ") == std::string::npos) continue;  // it had ended
    EXPECT_EQ(status, 130) << dut.Said();
    const bool full = dut.Said().find("trace.csv: cannot be written") != std::string::npos;
    interrupted += full && std::ranges::count(dut.Said(), '\n') == 2;
  }
  EXPECT_GE(interrupted, 1);
}

TEST_F(InterruptTest, OfTheOtherCommands) {
  std::string pgm = "P5 400 400 255\n";
  for (int i = 0; i < 400 * 400; ++i) pgm += i % 400 < 2 || i < 800 ? '\0' : '\xfe';
  const auto prepare = [&] {
    Fresh();
    std::ofstream(folder_ / "map.pgm", std::ios::binary) << pgm;
    std::ofstream(folder_ / "map.yaml") << "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n"
                                           "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
  };
  const std::vector<std::string> init = {"init", "map.yaml", "--out", "o"};
  const std::vector<std::string> plan = {"plan", "room.yaml", "--out", "o"};
  const std::vector<std::string> scene = {"scene", "room.yaml", "--out", "scene.xml"};
  const std::vector<std::string> demo = {"demo",
                                         "--out",
                                         "o",
                                         "--set",
                                         "video.max_frames=20",
                                         "--set",
                                         "video.width=320",
                                         "--set",
                                         "video.height=180",
                                         "--set",
                                         "time_limit_s=8"};
  const std::pair<std::vector<std::string>, Moment> cases[] = {
      {init, {"", 0, 0}},
      {init, {"", 0, 30, SIGTERM}},
      {plan, {"", 0, 0}},
      {plan, {"", 0, 10}},
      {plan, {"o/plan.csv", 0, 0}},
      {scene, {"", 0, 0}},
      {scene, {"", 0, 20}},
      {demo, {"", 0, 0}},
      {demo, {"o/demo_beluga/plan.json", 0, 100}},
      {demo, {"o/demo_beluga/.video.part.mp4", 0, 50}},
      {demo, {"o/demo_unseen_step/plan.csv", 0, 0}},
  };
  for (const auto& [command, moment] : cases) {
    prepare();
    const bool interrupted = Interrupt(command, moment);
    if (moment.then_ms == 0 || command == demo) {
      EXPECT_TRUE(interrupted) << command.front();
    }
  }
}

TEST_F(InterruptTest, OfAReplayLeavesTheRecords) {
  ASSERT_EQ(Program({"run", "room.yaml", "--out", "o"}, folder_).Wait(), 0);
  const std::string result = Slurp(folder_ / "o/result.json");
  const std::string trace = Slurp(folder_ / "o/trace.csv");
  for (const Moment& moment : {Moment{}, Moment{"", 0, 150}, Moment{kFilmPart, 0, 50}}) {
    EXPECT_TRUE(Interrupt({"replay", "o", "--video"}, moment));
    EXPECT_EQ(Slurp(folder_ / "o/result.json"), result);
    EXPECT_EQ(Slurp(folder_ / "o/trace.csv"), trace);
    EXPECT_FALSE(fs::exists(folder_ / "o/video.mp4"));
  }
}

// nohup, and shells that start a job in the background: what they ignore stays ignored.
TEST_F(InterruptTest, ThatTheShellIgnoresIsIgnored) {
  Program dut({"plan", "room.yaml", "--out", "o"}, folder_, SIG_IGN);
  while (!dut.HasEnded() && !dut.Listens()) usleep(200);
  dut.Send(SIGINT);
  EXPECT_EQ(dut.Wait(), 0);
}

// A robot that is being measured keeps its model as it is.
TEST_F(InterruptTest, TheLadderOfARobot) {
  fs::copy_file(SourceFile("models/beluga.xml"), folder_ / "mine.xml");
  const std::string model = Slurp(folder_ / "mine.xml");
  const std::vector<std::string> dut = {"robot", "mine.xml", "--ladder", "--quiet"};
  EXPECT_TRUE(Interrupt(dut, {"out/robot/mine.ladder.csv", 1, 0}));
  EXPECT_TRUE(Interrupt(dut, {"out/robot/mine.ladder.csv", 1, 500, SIGTERM}));
  EXPECT_EQ(Slurp(folder_ / "mine.xml"), model);
  EXPECT_FALSE(fs::exists(folder_ / "out/robot/mine.ladder.png"));
}

// The methods that were done are kept, and the files say that they are not all.
TEST_F(InterruptTest, OfASuiteKeepsTheMethodsThatWereDone) {
  const std::vector<std::string> dut = {
      "suite",         "beluga",
      "--methods",     "bump,drop_stop,stopping_distance,path_deviation,lost",
      "--reliability", "0.6",
      "--confidence",  "0.9",
      "--jobs",        "1",
      "--out",         "o",
      "--no-films",    "--quiet"};
  // Runs are there once a method is done.
  for (const auto& [moment, least] :
       {std::pair(Moment{"o/suite.json", 1, 0}, 0u), std::pair(Moment{"o/runs.csv", 300, 0}, 1u)}) {
    Fresh();
    ASSERT_TRUE(Interrupt(dut, moment));
    const auto robot = nlohmann::json::parse(Slurp(folder_ / "o/suite.json"))["robots"][0];
    EXPECT_EQ(robot["whole"], false);
    EXPECT_GE(robot["methods"].size(), least);
    EXPECT_EQ(std::ranges::count(Slurp(folder_ / "o/suite.csv"), '\n'),
              static_cast<std::ptrdiff_t>(1 + robot["methods"].size()));
    for (const auto& method : robot["methods"]) EXPECT_EQ(method["n"], 5) << "as a whole one has";
  }
}

}  // namespace
}  // namespace floorproof
