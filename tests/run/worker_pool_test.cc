// SPDX-License-Identifier: Apache-2.0
// Workers that answer, workers that die once or twice, and that none is left behind.
#include "run/campaign/worker_pool.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "base/watched_call.h"
#include "tests/own_folder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// Processes whose parent is `parent`, zombies too; by /proc.
std::set<pid_t> ChildrenOf(pid_t parent) {
  std::set<pid_t> children;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream stat(entry.path() / "stat");
    std::string line;
    std::getline(stat, line);
    const auto end = line.rfind(')');  // behind the program's name
    if (end == std::string::npos) continue;
    std::istringstream rest(line.substr(end + 1));
    char state = 0;
    pid_t of = 0;
    rest >> state >> of;
    if (of == parent) children.insert(static_cast<pid_t>(std::stol(name)));
  }
  return children;
}

// Ends this process at once, without a core file and without a sanitizer's report.
[[noreturn]] void DieBy(int signal_number) {
  signal(signal_number, SIG_DFL);
  raise(signal_number);
  _exit(99);
}

class WorkerPoolTest : public OwnFolderTest {
 protected:
  WorkerPoolTest() {
    const rlimit none = {0, 0};
    setrlimit(RLIMIT_CORE, &none);
    before_ = ChildrenOf(getpid());
  }
  ~WorkerPoolTest() override {
    EXPECT_EQ(ChildrenOf(getpid()), before_) << "a worker or a zombie is left";
  }

  // Jobs 0 .. n - 1.
  void Run(int workers, Job n, const std::function<std::string(Job)>& work) {
    PoolCallbacks callbacks;
    Job job = 0;
    callbacks.work = work;
    callbacks.next = [&]() -> std::optional<Job> {
      if (job == n) return std::nullopt;
      return job++;
    };
    callbacks.done = [&](Job done, std::string answer) {
      EXPECT_TRUE(answers_.emplace(done, std::move(answer)).second) << done << " came twice";
    };
    callbacks.crashed = [&](Job crashed, const std::string& how) {
      EXPECT_TRUE(crashed_.emplace(crashed, how).second) << crashed << " crashed twice";
    };
    callbacks.hung = [&](Job hung, const std::string& why) {
      EXPECT_TRUE(hung_.emplace(hung, why).second) << hung << " hung twice";
    };
    callbacks.stop = [&] { return stop_ && stop_(); };
    RunInWorkers(workers, callbacks);
  }

  std::set<pid_t> before_;
  std::map<Job, std::string> answers_, crashed_, hung_;
  std::function<bool()> stop_;
};

TEST_F(WorkerPoolTest, EveryJobIsDoneOnce) {
  for (const int workers : {1, 2, 7}) {
    answers_.clear();
    Run(workers, 100, [](Job job) { return "answer " + std::to_string(job); });
    ASSERT_EQ(answers_.size(), 100u);
    for (const auto& [job, answer] : answers_) EXPECT_EQ(answer, "answer " + std::to_string(job));
  }
  EXPECT_TRUE(crashed_.empty());
}

TEST_F(WorkerPoolTest, JobsAreDoneInOtherProcesses) {
  Run(2, 10, [](Job) { return std::to_string(getpid()); });
  std::set<std::string> pids;
  for (const auto& [job, answer] : answers_) pids.insert(answer);
  EXPECT_LE(pids.size(), 2u) << "a process does many";
  EXPECT_EQ(pids.count(std::to_string(getpid())), 0u);
}

TEST_F(WorkerPoolTest, NoJobsAndMoreWorkersThanJobs) {
  Run(3, 0, [](Job) { return ""; });
  EXPECT_TRUE(answers_.empty());
  Run(8, 2, [](Job) { return ""; });
  EXPECT_EQ(answers_.size(), 2u) << "empty answers too";
}

TEST_F(WorkerPoolTest, AnyBytesOfAnyLengthComeBack) {
  const auto answer = [](Job job) {
    std::string bytes((job + 1) << 20, '\0');
    for (std::size_t i = 0; i < bytes.size(); i += 997) bytes[i] = static_cast<char>(i + job);
    return bytes;
  };
  Run(2, 4, answer);
  ASSERT_EQ(answers_.size(), 4u);
  for (const auto& [job, bytes] : answers_) EXPECT_TRUE(bytes == answer(job)) << job;
}

TEST_F(WorkerPoolTest, AJobThatDiesTwiceIsCrashedAndTheRestGoesOn) {
  for (const int workers : {1, 3}) {
    answers_.clear(), crashed_.clear();
    Run(workers, 30, [](Job job) -> std::string {
      if (job % 10 == 3) DieBy(job == 13 ? SIGKILL : SIGABRT);
      return "";
    });
    EXPECT_EQ(answers_.size(), 27u);
    ASSERT_EQ(crashed_.size(), 3u);
    EXPECT_EQ(crashed_[3], "its process was killed by Aborted, twice");
    EXPECT_EQ(crashed_[13], "its process was killed by Killed, twice");
    EXPECT_EQ(crashed_[23], "its process was killed by Aborted, twice");
  }
}

TEST_F(WorkerPoolTest, AJobThatEndsItsProcessOrThrowsIsCrashed) {
  Run(2, 6, [](Job job) -> std::string {
    if (job == 1) _exit(7);
    if (job == 4) {
      const int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, STDERR_FILENO);  // what the language says of it
      signal(SIGABRT, SIG_DFL);
      throw std::runtime_error("of no kind that is expected");
    }
    return "";
  });
  EXPECT_EQ(answers_.size(), 4u);
  ASSERT_EQ(crashed_.size(), 2u);
  EXPECT_EQ(crashed_[1], "its process was ended with status 7, twice");
  EXPECT_EQ(crashed_[4], "its process was killed by Aborted, twice");
}

TEST_F(WorkerPoolTest, AJobThatDiesOnceIsTriedAgain) {
  Run(2, 20, [this](Job job) -> std::string {
    const fs::path tried = folder_ / std::to_string(job);
    if (job % 5 == 0 && !fs::exists(tried)) {
      std::ofstream(tried) << "1";
      DieBy(SIGSEGV);
    }
    return "";
  });
  EXPECT_EQ(answers_.size(), 20u);
  EXPECT_TRUE(crashed_.empty());
}

// An answer cut short is no answer.
TEST_F(WorkerPoolTest, DyingWhileAnsweringIsDying) {
  std::set<pid_t> killed;
  stop_ = [&] {
    // A worker whose pipe is full sleeps in its answer: the parent reads it only after this.
    for (const pid_t child : ChildrenOf(getpid()))
      if (killed.size() < 2 && before_.count(child) == 0 && killed.insert(child).second)
        kill(child, SIGKILL);
    return false;
  };
  Run(1, 3, [](Job) {
    usleep(20'000);
    return std::string(4 << 20, 'x');
  });
  EXPECT_EQ(answers_.size() + crashed_.size(), 3u);
  EXPECT_LE(crashed_.size(), 1u);
  for (const auto& [job, answer] : answers_) EXPECT_EQ(answer.size(), 4u << 20);
}

// Jobs that would take minutes are given up within the poll's tenth of a second.
TEST_F(WorkerPoolTest, StopGivesUpWhatFlies) {
  int asked = 0;
  stop_ = [&] { return ++asked > 3; };
  Run(3, 100, [](Job) {
    sleep(200);
    return "";
  });
  EXPECT_EQ(asked, 4);
  EXPECT_TRUE(answers_.empty());
  EXPECT_TRUE(crashed_.empty());
}

TEST_F(WorkerPoolTest, WhatTheParentThrowsEndsTheWorkers) {
  PoolCallbacks callbacks;
  callbacks.work = [](Job job) {
    if (job > 0) sleep(200);
    return std::string();
  };
  Job job = 0;
  callbacks.next = [&] { return std::optional<Job>(job++); };
  callbacks.done = [](Job, const std::string&) { throw std::runtime_error("disk full"); };
  callbacks.stop = [] { return false; };
  EXPECT_THROW(RunInWorkers(3, callbacks), std::runtime_error);
}

// It is tried once, and what it was in the middle of is what is said of it.
TEST_F(WorkerPoolTest, AJobWhoseCallIsOverdueIsGivenUpAndTheRestGoesOn) {
  const double now_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  Run(2, 30, [&](Job job) {
    BeginCall(now_s, "took more than " + std::to_string(job));
    if (job % 10 == 3) sleep(200);
    EndCall();
    if (job == 4) usleep(300'000);  // in no call, or in one that may go on
    BeginCall(now_s + 1000, "");
    if (job == 5) usleep(300'000);
    return std::string();
  });
  EXPECT_EQ(answers_.size(), 27u);
  EXPECT_TRUE(crashed_.empty());
  EXPECT_THAT(hung_, ::testing::ElementsAre(std::pair(Job{3}, "took more than 3"),
                                            std::pair(Job{13}, "took more than 13"),
                                            std::pair(Job{23}, "took more than 23")));
}

TEST_F(WorkerPoolTest, WhatIsSaidOfACallIsCutBetweenLetters) {
  const std::string letter = "\u00e4";  // two bytes
  std::string name;
  for (int i = 0; i < 600; ++i) name += letter;
  Run(1, 1, [&](Job) {
    BeginCall(1, name);
    sleep(200);
    return std::string();
  });
  ASSERT_EQ(hung_.size(), 1u);
  EXPECT_EQ(hung_[0].size(), 1022u);
  EXPECT_TRUE(name.starts_with(hung_[0]));
}

// A plug-in may hold a log file that it opened beforehand.
TEST_F(WorkerPoolTest, WhatTheCallerHasOpenStaysOpen) {
  const int log = open((folder_ / "log").c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  Run(2, 4, [&](Job) { return std::to_string(write(log, "asked\n", 6)); });
  for (const auto& [job, wrote] : answers_) EXPECT_EQ(wrote, "6");
  EXPECT_EQ(fs::file_size(folder_ / "log"), 24u);
  close(log);
}

// Else a worker that dies would not be noticed as long as another one holds its pipe.
TEST_F(WorkerPoolTest, OneWorkerHoldsNoPipeOfAnother) {
  const auto pipes = [] {
    std::string found;
    for (const auto& fd : fs::directory_iterator("/proc/self/fd")) {
      std::error_code ignored;
      const std::string what = fs::read_symlink(fd.path(), ignored).string();
      if (what.starts_with("pipe:")) found += what + ' ';
    }
    return found;
  };
  const std::string inherited = pipes();
  const auto many = [](const std::string& list) { return std::ranges::count(list, ' '); };
  Run(3, 9, [&](Job) {
    usleep(10'000);
    return pipes();
  });
  for (const auto& [job, held] : answers_) EXPECT_EQ(many(held), many(inherited) + 2) << held;
}

// Ctrl-C at a terminal reaches the whole group: it is the parent's to act on.
TEST_F(WorkerPoolTest, WorkersIgnoreCtrlC) {
  Run(2, 4, [](Job) {
    raise(SIGINT);
    return "still here";
  });
  EXPECT_EQ(answers_.size(), 4u);
  EXPECT_TRUE(crashed_.empty());
}

// kill -9 of the parent: the workers die with it. They become this process's children then, being
// its grandchildren, so that their end can be seen.
TEST_F(WorkerPoolTest, WorkersDieWithTheirParent) {
  ASSERT_EQ(prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
  const pid_t parent = fork();
  if (parent == 0) {
    try {
      Run(3, 100, [this](Job job) {
        std::ofstream(folder_ / std::to_string(job)) << getpid();
        sleep(200);
        return "";
      });
    } catch (...) {
    }
    _exit(0);
  }
  for (int job = 0; job < 3; ++job)
    while (!fs::exists(folder_ / std::to_string(job))) usleep(1000);
  EXPECT_EQ(ChildrenOf(parent).size(), 3u);
  kill(parent, SIGKILL);
  EXPECT_EQ(waitpid(parent, nullptr, 0), parent);
  // Would hang where a worker lived on.
  for (int worker = 0; worker < 3; ++worker) {
    int status = 0;
    EXPECT_GT(waitpid(-1, &status, 0), 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  }
  prctl(PR_SET_CHILD_SUBREAPER, 0);
}

}  // namespace
}  // namespace floorproof
