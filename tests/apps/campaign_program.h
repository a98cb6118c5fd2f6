// SPDX-License-Identifier: Apache-2.0
// `floorproof campaign` as a process of its own, on a tiny scenario, and what its folder holds.
#pragma once

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/own_folder.h"
#include "tests/places.h"
#include "tests/slurp.h"

namespace floorproof {

inline std::vector<std::string> Words(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

// The program, running in `folder` on its own; killed where the test ends first.
class Program {
 public:
  Program(
      const std::string& arguments, const std::filesystem::path& folder,
      const std::function<void()>& in_child = [] {})
      : Program(Words(arguments), folder, in_child) {}
  // Arguments may have spaces, as a path may.
  Program(
      const std::vector<std::string>& arguments, const std::filesystem::path& folder,
      const std::function<void()>& in_child = [] {})
      : out_(folder / ".stdout"), err_(folder / ".stderr") {
    std::vector<std::string> words = {ProgramFile().string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ != 0) return;
    const int null = open("/dev/null", O_RDONLY);
    const int out = open(out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int err = open(err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(null, 0), dup2(out, 1), dup2(err, 2);
    signal(SIGINT, SIG_DFL), signal(SIGTERM, SIG_DFL);
    const rlimit none = {0, 0};
    setrlimit(RLIMIT_CORE, &none);
    alarm(240);
    if (chdir(folder.c_str()) == 0) {
      in_child();
      execv(argv[0], argv.data());
    }
    _exit(127);
  }
  ~Program() {
    if (!HasEnded()) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  bool HasEnded() {
    if (!ended_) ended_ = waitpid(pid_, &code_, WNOHANG) == pid_;
    return ended_;
  }
  // The exit status; minus the signal's number where one ended it.
  int Wait() {
    if (!ended_) waitpid(pid_, &code_, 0);
    ended_ = true;
    return WIFEXITED(code_) ? WEXITSTATUS(code_) : -WTERMSIG(code_);
  }
  void Send(int number) const { kill(pid_, number); }
  std::vector<pid_t> Workers() const {
    const std::string id = std::to_string(pid_);
    std::istringstream in(Slurp("/proc/" + id + "/task/" + id + "/children"));
    std::vector<pid_t> workers;
    for (pid_t worker = 0; in >> worker;) workers.push_back(worker);
    return workers;
  }
  // Waits for a worker other than `not_this`; 0: the program ended before.
  pid_t AWorker(pid_t not_this = 0) {
    while (!HasEnded()) {
      for (const pid_t worker : Workers())
        if (worker != not_this) return worker;
      usleep(500);
    }
    return 0;
  }
  // What it says for people; a sanitizer's own lines are not its.
  std::string Said() const {
    std::istringstream all(Slurp(err_));
    std::string said;
    for (std::string line; std::getline(all, line);)
      if (line.starts_with("floorproof:")) said += line + "\n";
    return said;
  }
  std::string Out() const { return Slurp(out_); }

 private:
  std::filesystem::path out_, err_;
  pid_t pid_ = -1;
  int code_ = 0;
  bool ended_ = false;
};

struct Ended {
  int status = 0;
  std::string said, out;
};

class CampaignProgram : public OwnFolderTest {
 protected:
  CampaignProgram() {
    std::ofstream(folder_ / "p.csv") << "x_m,y_m\n1.0,1.0\n1.6,1.0\n";
    Write("");
  }

  // A drive of 0.8 m over a sill that is high enough to stop some; `drawn` is more of `randomise`.
  void Write(const std::string& more, const std::string& drawn = "") const {
    std::ofstream(folder_ / "s.yaml") << R"(scenario: 1
site:
  site: 1
  grid:
    cell_m: 0.5
    rows: |
      ######
      #....#
      #....#
      ######
  start: {x_m: 1.0, y_m: 1.0, yaw_deg: 0}
  hazards:
  - {type: step, id: sill, known: false, polygon_m: [[1.4,0.5],[1.5,0.5],[1.5,1.5],[1.4,1.5]], height_m: 0.006}
robot: beluga
plan: {file: p.csv}
time_limit_s: 12
failures: {stuck: {window_s: 3}}
randomise:
  site.floor.friction: {uniform: [0.4, 1.0]}
  site.hazards.sill.height_m: {uniform: [0.004, 0.03]}
  start.y_m: {normal: [1.0, 0.02]}
)" + drawn + more;
  }

  // The plan is this shell script's.
  void PlanBy(const std::string& script) const {
    std::ofstream(folder_ / "p.sh") << "#!/bin/sh\n" + script;
    std::filesystem::permissions(folder_ / "p.sh", std::filesystem::perms::owner_all);
    std::string text = Slurp(folder_ / "s.yaml");
    text.replace(text.find("file: p.csv"), 11, "command: [./p.sh]");
    std::ofstream(folder_ / "s.yaml") << text;
  }

  Ended Run(const std::string& arguments) const {
    Program program(arguments, folder_);
    const int status = program.Wait();
    return {status, program.Said(), program.Out()};
  }
  // Of `campaign s.yaml --no-films`.
  Ended Campaign(const std::string& arguments) const {
    return Run("campaign s.yaml --no-films " + arguments);
  }

  // All columns of table `episode`, ordered by its key, as text that tells kinds apart.
  std::string Dump(const std::string& out) const {
    return Select(out, "SELECT * FROM episode ORDER BY campaign, variant, episode");
  }
  std::string Select(const std::string& out, const std::string& sql) const {
    sqlite3* db = nullptr;
    const std::string file = (folder_ / out / "campaign.sqlite").string();
    EXPECT_EQ(sqlite3_open_v2(file.c_str(), &db, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
    sqlite3_stmt* select = nullptr;
    EXPECT_EQ(sqlite3_prepare_v2(db, sql.c_str(), -1, &select, nullptr), SQLITE_OK)
        << sqlite3_errmsg(db);
    std::string text;
    int code = SQLITE_DONE;
    while (select != nullptr && (code = sqlite3_step(select)) == SQLITE_ROW) {
      for (int i = 0; i < sqlite3_column_count(select); ++i) {
        const int type = sqlite3_column_type(select, i);
        const auto* value = reinterpret_cast<const char*>(sqlite3_column_text(select, i));
        text += (i > 0 ? "|" : "") +
                (type == SQLITE_NULL ? "null" : std::to_string(type) + ":" + value);
      }
      text += "\n";
    }
    EXPECT_EQ(code, SQLITE_DONE) << sqlite3_errmsg(db);
    sqlite3_finalize(select);
    sqlite3_close(db);
    return text;
  }
  // One number, of one row.
  long Count(const std::string& out, const std::string& sql) const {
    const std::string text = Select(out, sql);
    return text.starts_with("1:") ? std::stol(text.substr(2)) : -1;
  }

  void ExpectSameResults(const std::string& a, const std::string& b) const {
    for (const char* file : {"summary.json", "episodes.csv", "dependence.csv", "junit.xml"}) {
      EXPECT_NE(Slurp(folder_ / a / file), "") << a << "/" << file;
      EXPECT_EQ(Slurp(folder_ / a / file), Slurp(folder_ / b / file)) << b << "/" << file;
    }
    EXPECT_EQ(Dump(a), Dump(b)) << b;
  }
};

}  // namespace floorproof
