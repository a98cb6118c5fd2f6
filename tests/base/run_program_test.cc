// SPDX-License-Identifier: Apache-2.0
#include "base/run_program.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <memory>

#include "base/error.h"
#include "tests/own_folder.h"

namespace floorproof {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

// The shell does it; the folder to exchange files is $0.
ProgramCall Sh(const std::string& script, const ExchangeFolder& folder, double wall_s = 20) {
  return {{"sh", "-c", script, folder.path().string()}, ::testing::TempDir(), wall_s};
}

std::string FailureOf(const std::string& script, double wall_s = 20) {
  ExchangeFolder dut;
  return dut.Run(Sh(script, dut, wall_s)).failure;
}

std::string Content(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Whether a process that wrote its number into the file is gone, or goes soon.
bool IsGone(pid_t process) {
  for (int i = 0; i < 2000; ++i) {
    if (kill(process, 0) != 0) return true;
    usleep(1000);
  }
  return false;
}

TEST(ExchangeFolder, IsOurOwnAndFreshAndGoesAway) {
  fs::path first;
  {
    const ExchangeFolder dut, other;
    first = dut.path();
    EXPECT_NE(first, other.path());
    EXPECT_TRUE(fs::is_empty(first));
    EXPECT_EQ(fs::status(first).permissions(), fs::perms::owner_all);
    std::ofstream(first / "file") << "x";
  }
  EXPECT_FALSE(fs::exists(first));
}

TEST(RunProgram, ExchangesFilesAndSaysNothingWhenItWentWell) {
  ExchangeFolder dut;
  std::ofstream(dut.path() / "request") << "4 5";
  const ProgramOutcome outcome = dut.Run(
      Sh("read a b < \"$0\"/request; echo $((a + b)) > \"$0\"/answer; pwd > \"$0\"/where", dut));
  EXPECT_EQ(outcome.failure, "");
  EXPECT_EQ(outcome.last_words, "");
  EXPECT_EQ(Content(dut.path() / "answer"), "9\n");
  std::string where = Content(dut.path() / "where");
  where.pop_back();  // the end of the line
  EXPECT_TRUE(fs::equivalent(where, ::testing::TempDir())) << where;
}

TEST(RunProgram, SaysHowItEnded) {
  EXPECT_EQ(FailureOf("exit 3"), "ended with status 3");
  EXPECT_EQ(FailureOf("kill -SEGV $$"), "was killed (Segmentation fault)");
  EXPECT_EQ(FailureOf("kill -KILL $$"), "was killed (Killed)");
  EXPECT_EQ(FailureOf("kill -KILL $PPID; sleep 1000"), "ended the process that watches it");
  ExchangeFolder dut;
  const ProgramCall none{{"/no/such/program"}, ::testing::TempDir(), 20};
  EXPECT_EQ(dut.Run(none).failure, "cannot be started: No such file or directory");
}

TEST(RunProgram, KeepsTheEndOfWhatItSays) {
  ExchangeFolder dut;
  const ProgramOutcome outcome = dut.Run(Sh("echo out; echo why >&2; exit 1", dut));
  EXPECT_EQ(outcome.last_words, "why\n");
  ExchangeFolder other;
  const ProgramOutcome endless =
      other.Run(Sh("i=0; while [ $i -lt 3000 ]; do echo number $i; i=$((i+1)); done >&2", other));
  EXPECT_EQ(endless.failure, "");
  EXPECT_EQ(endless.last_words.size(), 4096u);
  EXPECT_THAT(endless.last_words, EndsWith("number 2999\n"));
}

TEST(RunProgram, EndsWhatTakesTooLongWhateverItDoes) {
  for (const char* script :
       {"sleep 1000",
        "trap '' TERM INT HUP; sleep 1000 & while :; do echo endless; echo endless >&2; done"})
    EXPECT_EQ(FailureOf(script, 0.3), "took more than 0.3 s") << script;
  // It leaves its group for ours. Where it is waited for, it comes to its end.
  const fs::path ended = fs::path(::testing::TempDir()) / "ended";
  fs::remove(ended);
  ExchangeFolder dut;
  const std::string script =
      "import os, sys, time; os.setpgid(0, os.getpgid(os.getppid())); "
      "time.sleep(4); open(sys.argv[1], 'w')";
  const ProgramOutcome outcome =
      dut.Run({{"python3", "-ISc", script, ended.string()}, ::testing::TempDir(), 0.5});
  EXPECT_EQ(outcome.failure, "took more than 0.5 s");
  EXPECT_FALSE(fs::exists(ended));
}

TEST(RunProgram, LeavesNobodyBehind) {
  const std::string note = "echo $! > \"$0\"/child; ";
  for (const auto& [script, wall_s] :
       {std::pair("sleep 1000 & " + note + "exit 0", 20.0),            // forks and leaves
        {"sleep 1000 & " + note + "wait", 1.0},                        // waits too long
        {"setsid sh -c 'echo $$ > \"'\"$0\"'\"/child; sleep 1000' & "  // in a session of its own
         "while [ ! -s \"$0\"/child ]; do sleep 0.01; done; exit 0",
         20.0}}) {
    pid_t child = 0;
    {
      // A copy outlives the folder.
      const fs::path kept = fs::path(::testing::TempDir()) / "kept_child";
      ExchangeFolder dut;
      fs::remove(kept);
      std::ofstream(dut.path() / "child");
      fs::create_hard_link(dut.path() / "child", kept);
      dut.Run(Sh(script, dut, wall_s));
      child = static_cast<pid_t>(std::atoi(Content(kept).c_str()));
      fs::remove(kept);
    }
    ASSERT_GT(child, 0) << script;
    EXPECT_TRUE(IsGone(child)) << script;
  }
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a zombie is left";
  EXPECT_EQ(errno, ECHILD);
}

// As a worker of a campaign is ended.
TEST(RunProgram, IsEndedAndTidiedUpWhenItsCallerIsKilled) {
  const fs::path note = fs::path(::testing::TempDir()) / "caller_killed";
  fs::remove(note);
  const pid_t caller = fork();
  if (caller == 0) {
    ExchangeFolder folder;
    folder.Run(Sh("echo $$ \"$0\" > " + note.string() + ".part; mv " + note.string() + ".part " +
                      note.string() + "; sleep 1000",
                  folder));
    _exit(0);
  }
  for (int i = 0; i < 5000 && !fs::exists(note); ++i) usleep(1000);
  pid_t program = 0;
  std::string folder;
  std::ifstream(note) >> program >> folder;
  fs::remove(note);
  ASSERT_GT(program, 0);
  ASSERT_TRUE(fs::exists(folder));
  kill(caller, SIGKILL);
  waitpid(caller, nullptr, 0);
  EXPECT_TRUE(IsGone(program));
  for (int i = 0; i < 2000 && fs::exists(folder); ++i) usleep(1000);
  EXPECT_FALSE(fs::exists(folder));
}

using TemporaryFiles = OwnFolderTest;

// mktemp and Python's tempfile follow TMPDIR.
TEST_F(TemporaryFiles, OfAProgramThatTakesTooLongAreRemoved) {
  const fs::path note = folder_ / "where";
  {
    ExchangeFolder dut;
    EXPECT_FALSE(dut.Run(Sh("mktemp > " + note.string() + "; sleep 1000", dut, 1)).in_time);
  }
  std::string file = Content(note);
  ASSERT_THAT(file, EndsWith("\n"));
  file.pop_back();
  EXPECT_FALSE(fs::exists(file)) << file;
}

TEST_F(TemporaryFiles, OfKilledProcessesAreRemovedByTheNextUnlessSomebodyUsesThem) {
  const auto make = [&](const std::string& name, bool old = true) {
    const fs::path made = folder_ / ("floorproof-exchange-" + name);
    fs::create_directory(made);
    std::ofstream(made / "request.json") << "{}";
    if (old) fs::last_write_time(made, fs::file_time_type::clock::now() - std::chrono::hours(1));
    return made;
  };
  const fs::path stale = make("stale"), used = make("used"), young = make("young", false),
                 other = folder_ / "another-program", link = folder_ / "floorproof-exchange-link";
  fs::create_directory(other);
  fs::create_directory_symlink(other, link);
  const int lock = open(used.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(flock(lock, LOCK_EX), 0);
  const pid_t child = fork();
  if (child == 0) {
    setenv("TMPDIR", folder_.c_str(), 1);
    const ExchangeFolder dut;
    _exit(dut.path().parent_path() == folder_ ? 0 : 1);
  }
  int status = 1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_FALSE(fs::exists(stale));
  for (const fs::path& kept : {used, young, other, link}) EXPECT_TRUE(fs::exists(kept)) << kept;
  close(lock);
}

// As a host does whose other threads fork.
TEST(RunProgram, IsEndedThoughSomebodyHasInheritedWhatItsCallerHolds) {
  auto dut = std::make_unique<ExchangeFolder>();
  dut->Run(Sh("exit 0", *dut));
  const pid_t heir = fork();
  if (heir == 0) sleep(3), _exit(0);
  dut.reset();
  EXPECT_EQ(waitpid(heir, nullptr, WNOHANG), 0) << "it was waited for";
  kill(heir, SIGKILL);
  waitpid(heir, nullptr, 0);
}

TEST(RunProgram, IsTidiedUpWhenItsCallerIsKilledAndHasAnHeir) {
  const fs::path note = fs::path(::testing::TempDir()) / "heir";
  const pid_t caller = fork();
  if (caller == 0) {
    ExchangeFolder dut;
    dut.Run(Sh("exit 0", dut));
    const pid_t heir = fork();
    if (heir == 0) sleep(5), _exit(0);
    std::ofstream(note) << heir << " " << dut.path().string();
    raise(SIGKILL);
  }
  waitpid(caller, nullptr, 0);
  pid_t heir = 0;
  std::string folder;
  std::ifstream(note) >> heir >> folder;
  fs::remove(note);
  ASSERT_GT(heir, 0);
  for (int i = 0; i < 2000 && fs::exists(folder); ++i) usleep(1000);
  EXPECT_FALSE(fs::exists(folder));
  kill(heir, SIGKILL);
}

TEST(RunProgram, IsEndedByAnInterrupt) {
  const pid_t caller = fork();
  if (caller == 0) {
    CatchInterrupts();
    std::string path;
    try {
      ExchangeFolder dut;
      path = dut.path();
      dut.Run(Sh("kill -INT " + std::to_string(getpid()) + "; sleep 1000", dut));
    } catch (const Interruption&) {
      _exit(fs::exists(path) ? 1 : 0);
    }
    _exit(2);
  }
  int status = 0;
  waitpid(caller, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(WhyNoProgram, LooksWhereItWouldBeRunFrom) {
  const ExchangeFolder folder;
  std::ofstream(folder.path() / "cover_it") << "#!/bin/sh\n";
  EXPECT_EQ(WhyNoProgram("sh", folder.path()), "");
  EXPECT_EQ(WhyNoProgram("/bin/sh", folder.path()), "");
  EXPECT_THAT(WhyNoProgram("cover_it", folder.path()), HasSubstr("named ./cover_it"));
  EXPECT_THAT(WhyNoProgram("./cover_it", folder.path()), HasSubstr("is not executable"));
  EXPECT_THAT(WhyNoProgram("./none", folder.path()), HasSubstr("no such program"));
  EXPECT_THAT(WhyNoProgram("./", folder.path()), HasSubstr("is a folder"));
  fs::permissions(folder.path() / "cover_it", fs::perms::owner_exec, fs::perm_options::add);
  EXPECT_EQ(WhyNoProgram("./cover_it", folder.path()), "");
}

}  // namespace
}  // namespace floorproof
