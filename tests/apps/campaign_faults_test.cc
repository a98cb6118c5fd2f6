// SPDX-License-Identifier: Apache-2.0
// What a campaign survives: kills, full and read-only disks, Ctrl-C, crashing episodes, a corrupted
// database. Afterwards every finished episode is there once, and resuming gives what an undisturbed
// campaign gives.
//
// Moments are drawn from a seed. Which episode they hit depends on the machine; what is asserted
// does not.
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <random>

#include "tests/apps/campaign_program.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class CampaignFaults : public CampaignProgram {
 protected:
  static std::string Command(int n, const std::string& more = "") {
    return "campaign s.yaml --no-films --jobs 2 -n " + std::to_string(n) + " --out o --resume " +
           more;
  }
  // How long that took.
  std::chrono::milliseconds MakeWhole(int n) const {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(Campaign("--jobs 2 -n " + std::to_string(n) + " --out whole").status, 0);
    return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() -
                                                                 begin);
  }
  useconds_t Moment(int most_ms) {
    return static_cast<useconds_t>(random_() % static_cast<unsigned>(1000 * most_ms));
  }
  // Rows done so far, each as it is in the whole campaign.
  long ExpectRowsOfTheWhole() const {
    if (!fs::exists(folder_ / "o/campaign.sqlite")) return 0;
    std::map<std::string, int> whole;
    std::istringstream lines(Dump("whole"));
    for (std::string line; std::getline(lines, line);) ++whole[line];
    std::istringstream there(Dump("o"));
    long n = 0;
    for (std::string line; std::getline(there, line); ++n) EXPECT_EQ(whole[line], 1) << line;
    return n;
  }
  // Rows that others can see so far.
  long Rows() const {
    return fs::exists(folder_ / "o/campaign.sqlite-wal")
               ? static_cast<long>(fs::file_size(folder_ / "o/campaign.sqlite-wal") / 4096)
               : 0;
  }
  static void ExpectOneLine(const Ended& dut, int status, const char* why) {
    EXPECT_EQ(dut.status, status) << dut.said;
    EXPECT_THAT(dut.said, HasSubstr(why));
    EXPECT_EQ(std::ranges::count(dut.said, '\n'), 1) << dut.said;
  }
  Ended Finish(Program& dut) const {
    const int status = dut.Wait();
    return {status, dut.Said(), dut.Out()};
  }

  std::mt19937 random_{20};  // its numbers are the standard's own
};

// No verdict is printed for rows that are gone.
TEST_F(CampaignFaults, TheDatabaseOrItsFolderTakenAwayIsNoticed) {
  constexpr int kEpisodes = 2000;  // more than are driven until then
  const std::pair<const char*, std::function<void()>> ways[] = {
      {"o", [&] { fs::remove_all(folder_ / "o"); }},
      {"o/campaign.sqlite", [&] { fs::remove(folder_ / "o/campaign.sqlite"); }},
      {"moved", [&] { fs::rename(folder_ / "o", folder_ / "moved"); }},
      {"replaced", [&] {
         fs::rename(folder_ / "o/campaign.sqlite", folder_ / "o/other");
         fs::copy(folder_ / "o/other", folder_ / "o/campaign.sqlite");
       }}};
  for (const auto& [what, take_away] : ways) {
    fs::remove_all(folder_ / "o");
    Program dut(Command(kEpisodes), folder_);
    dut.AWorker();
    while (!fs::exists(folder_ / "o/summary.json") && !dut.HasEnded() && Rows() < 4) usleep(1000);
    take_away();
    const Ended ended = Finish(dut);
    ExpectOneLine(ended, 3, "was removed or moved while");
    EXPECT_THAT(ended.out, ::testing::Not(HasSubstr("Verdict"))) << what;
  }
}

TEST_F(CampaignFaults, TheParentKilledAtTwentyMoments) {
  constexpr int kEpisodes = 80;
  // On a fast machine sooner: it must not be done before the last of them.
  const int most_ms = static_cast<int>(MakeWhole(kEpisodes).count() / 15);
  long before = 0;
  int killed = 0;
  for (int i = 0; i < 20; ++i) {
    Program dut(Command(kEpisodes), folder_);
    if (i % 4 != 0) dut.AWorker();  // else while it starts, or makes its database
    usleep(Moment(i % 4 == 0 ? 60 : std::clamp(most_ms, 1, 700)));
    const std::vector<pid_t> workers = dut.Workers();
    dut.Send(SIGKILL);
    killed += dut.Wait() == -SIGKILL;
    const long now = ExpectRowsOfTheWhole();
    EXPECT_GE(now, before) << "a finished episode is lost";
    before = now;
    for (int wait = 0; wait < 2000; ++wait)
      if (std::ranges::none_of(workers, [](pid_t worker) { return kill(worker, 0) == 0; }))
        break;
      else
        usleep(1000);
    for (const pid_t worker : workers) EXPECT_NE(kill(worker, 0), 0) << "a worker lives on";
  }
  EXPECT_GE(killed, 15);
  const Ended dut = Run(Command(kEpisodes));
  EXPECT_EQ(dut.status, 0) << dut.said;
  ExpectSameResults("whole", "o");
}

// One kill a process: killed twice, an episode is reported as crashed.
TEST_F(CampaignFaults, AWorkerKilledAtTwentyMoments) {
  constexpr int kRuns = 20, kMore = 3;
  MakeWhole(kRuns * kMore);
  for (int i = 1; i <= kRuns; ++i) {
    Program dut(Command(i * kMore), folder_);
    const pid_t worker = dut.AWorker();
    usleep(Moment(150));
    if (worker != 0) kill(worker, SIGKILL);
    EXPECT_EQ(dut.Wait(), 0) << dut.Said();
    EXPECT_EQ(ExpectRowsOfTheWhole(), i * kMore);
  }
  ExpectSameResults("whole", "o");
}

TEST_F(CampaignFaults, CtrlCAtTenMoments) {
  constexpr int kEpisodes = 60;
  MakeWhole(kEpisodes);
  long before = 0;
  for (int i = 0; i < 10; ++i) {
    Program dut(Command(kEpisodes), folder_);
    dut.AWorker();
    usleep(Moment(600));
    dut.Send(i % 2 == 0 ? SIGINT : SIGTERM);
    const Ended ended = Finish(dut);
    if (ended.status != 0) ExpectOneLine(ended, 130, "floorproof: interrupted: ");
    const long now = ExpectRowsOfTheWhole();
    EXPECT_GE(now, before);
    before = now;
  }
  EXPECT_EQ(Run(Command(kEpisodes)).status, 0);
  ExpectSameResults("whole", "o");
}

// A drive that takes its process down whenever it is tried: killed here, twice, while it drives.
TEST_F(CampaignFaults, AnEpisodeThatAbortsItsProcessTwice) {
  std::string laps = "x_m,y_m\n";
  for (int i = 0; i < 30; ++i) laps += i % 2 == 0 ? "0.8,1.0\n" : "1.15,1.0\n";
  std::ofstream(folder_ / "p.csv") << "x_m,y_m\n1.0,1.0\n" << laps.substr(8);
  Write("");
  ASSERT_EQ(Campaign("-n 3 --jobs 1 --set time_limit_s=200 --out whole").status, 0);
  Program dut("campaign s.yaml --no-films -n 3 --jobs 1 --set time_limit_s=200 --out o", folder_);
  const pid_t first = dut.AWorker();
  kill(first, SIGABRT);
  const pid_t second = dut.AWorker(first);
  kill(second, SIGABRT);
  EXPECT_EQ(dut.Wait(), 3) << dut.Said();
  EXPECT_EQ(Select("o", "SELECT episode, outcome, message FROM episode WHERE outcome = 'error'"),
            "1:0|3:error|3:crashed: its process was killed by Aborted, twice\n");
  const std::string rest = "SELECT * FROM episode WHERE episode > 0 ORDER BY episode";
  EXPECT_EQ(Select("o", rest), Select("whole", rest)) << "the rest went on";
  EXPECT_EQ(Count("o", "SELECT count(*) FROM episode"), 3);
  // It stays what it was found to be.
  EXPECT_EQ(Campaign("-n 3 --jobs 1 --set time_limit_s=200 --out o --resume").status, 3);
  EXPECT_EQ(Count("o", "SELECT count(*) FROM episode"), 3);
}

TEST_F(CampaignFaults, AFileThatMayNotGrow) {
  constexpr int kEpisodes = 80;
  MakeWhole(kEpisodes);
  {
    Program dut(Command(kEpisodes), folder_, [] {
      signal(SIGXFSZ, SIG_IGN);
      const rlimit most = {48 << 10, 48 << 10};
      setrlimit(RLIMIT_FSIZE, &most);
    });
    const Ended ended = Finish(dut);
    ExpectOneLine(ended, 3, "campaign.sqlite: cannot be written: ");
    EXPECT_THAT(ended.said, HasSubstr("; missing: the episodes that are not in campaign.sqlite"));
    EXPECT_THAT(ended.said, HasSubstr("; --resume goes on"));
  }
  EXPECT_LT(ExpectRowsOfTheWhole(), kEpisodes);
  EXPECT_EQ(Run(Command(kEpisodes)).status, 0);
  ExpectSameResults("whole", "o");
}

// Mounts are this process's own: it must not leave one behind.
class OwnDisk {
 public:
  OwnDisk(const fs::path& folder, const char* options) : folder_(folder) {
    fs::create_directories(folder);
    mounted_ = unshare(CLONE_NEWNS) == 0 &&
               mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
               mount("disk", folder.c_str(), "tmpfs", 0, options) == 0;
    why_ = std::strerror(errno);
  }
  ~OwnDisk() {
    if (mounted_) umount2(folder_.c_str(), MNT_DETACH);
  }
  OwnDisk(const OwnDisk&) = delete;
  OwnDisk& operator=(const OwnDisk&) = delete;
  bool mounted() const { return mounted_; }
  const std::string& why() const { return why_; }
  void Change(unsigned long flags, const char* options) const {
    EXPECT_EQ(mount("disk", folder_.c_str(), "tmpfs", MS_REMOUNT | flags, options), 0)
        << std::strerror(errno);
  }

 private:
  fs::path folder_;
  bool mounted_ = false;
  std::string why_;
};

TEST_F(CampaignFaults, AFullDisk) {
  const OwnDisk disk(folder_ / "o", "size=128k");
  if (!disk.mounted()) GTEST_SKIP() << "no disk can be mounted here: " << disk.why();
  constexpr int kEpisodes = 80;
  MakeWhole(kEpisodes);
  ExpectOneLine(Run(Command(kEpisodes)), 3, "cannot be written: ");
  const long first = ExpectRowsOfTheWhole();
  EXPECT_LT(first, kEpisodes);
  ExpectOneLine(Run(Command(kEpisodes)), 3, "cannot be written: ");
  EXPECT_GE(ExpectRowsOfTheWhole(), first);
  disk.Change(0, "size=16m");
  EXPECT_EQ(Run(Command(kEpisodes)).status, 0);
  ExpectSameResults("whole", "o");
}

// Too small for the first row, whichever file meets that: nothing that would be in the way is left.
class CampaignOnASmallDisk : public CampaignFaults {
 protected:
  Ended FullThenWhole(const OwnDisk& disk, const char* enough) const {
    Ended full = Run(Command(2));
    ExpectOneLine(full, 3, "; missing: ");
    disk.Change(0, enough);
    EXPECT_EQ(Run(Command(2)).status, 0);
    ExpectSameResults("whole", "o");
    return full;
  }
};

TEST_F(CampaignOnASmallDisk, IsFullFromTheStart) {
  MakeWhole(2);
  for (const char* size : {"size=4k", "size=8k", "size=24k", "size=48k"}) {
    SCOPED_TRACE(size);
    const OwnDisk disk(folder_ / "o", size);
    if (!disk.mounted()) GTEST_SKIP() << "no disk can be mounted here: " << disk.why();
    EXPECT_THAT(FullThenWhole(disk, "size=16m").said, HasSubstr("cannot be written: "));
  }
}

TEST_F(CampaignOnASmallDisk, HasNoRoomForNames) {
  MakeWhole(2);
  for (const char* names : {"nr_inodes=1", "nr_inodes=2", "nr_inodes=3", "nr_inodes=5"}) {
    SCOPED_TRACE(names);
    const OwnDisk disk(folder_ / "o", names);
    if (!disk.mounted()) GTEST_SKIP() << "no disk can be mounted here: " << disk.why();
    FullThenWhole(disk, "nr_inodes=100");
  }
}

TEST_F(CampaignFaults, AReadOnlyFolder) {
  const OwnDisk disk(folder_ / "o", "size=16m");
  if (!disk.mounted() && geteuid() == 0)
    GTEST_SKIP() << "root writes everywhere, and no disk can be mounted here: " << disk.why();
  const auto set_read_only = [&](bool read_only) {
    if (disk.mounted())
      disk.Change(read_only ? MS_RDONLY : 0, "size=16m");
    else
      for (const char* name : {"o", "o/campaign.sqlite"})
        chmod((folder_ / name).c_str(), read_only ? 0555 : 0755);
  };
  MakeWhole(6);
  set_read_only(true);
  ExpectOneLine(Run(Command(6)), 2, "cannot be written: ");
  EXPECT_TRUE(fs::is_empty(folder_ / "o"));
  set_read_only(false);
  ASSERT_EQ(Run(Command(3)).status, 0);
  const std::string bytes = Slurp(folder_ / "o/campaign.sqlite");
  set_read_only(true);
  ExpectOneLine(Run(Command(6)), 2, "cannot be written: ");
  EXPECT_TRUE(Slurp(folder_ / "o/campaign.sqlite") == bytes);
  set_read_only(false);
  EXPECT_EQ(Run(Command(6)).status, 0);
  ExpectSameResults("whole", "o");
}

TEST_F(CampaignFaults, ACorruptedDatabaseIsRefusedUntouched) {
  ASSERT_EQ(Run(Command(20)).status, 0);
  const fs::path file = folder_ / "o/campaign.sqlite";
  const std::string whole = Slurp(file);
  for (const std::size_t at : {std::size_t{0}, std::size_t{100}, whole.size() / 3, whole.size() / 2,
                               whole.size() - 4000}) {
    std::string bytes = whole;
    for (std::size_t i = at; i < std::min(at + 4000, bytes.size()); ++i)
      bytes[i] = static_cast<char>(random_());
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    const std::string summary = Slurp(folder_ / "o/summary.json");
    ExpectOneLine(Run(Command(30)), 2, "campaign.sqlite: is ");
    EXPECT_TRUE(Slurp(file) == bytes) << at;
    EXPECT_EQ(Slurp(folder_ / "o/summary.json"), summary);
  }
  std::ofstream(file, std::ios::binary | std::ios::trunc) << whole.substr(0, whole.size() / 2);
  ExpectOneLine(Run(Command(30)), 2, "campaign.sqlite: is damaged");
  EXPECT_TRUE(Slurp(file) == whole.substr(0, whole.size() / 2));
}

}  // namespace
}  // namespace floorproof
