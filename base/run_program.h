// SPDX-License-Identifier: Apache-2.0
// Another program, run with a folder of its own to exchange files with: for a bounded time, and
// never left behind.
//
// A guard process stands between it and this one. The guard ends the program with all that it
// started, and removes the folder, when it is told to and when this process dies, however that
// comes (SIGKILL too). If both are killed, the program is killed too, and the folder is removed by
// the next process of this user that runs a program; other processes that it had started are not
// ended.
// The program's TMPDIR is within the folder, so its own temporary files go with it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/interrupt.h"

namespace floorproof {

struct ProgramCall {
  std::vector<std::string> words;  // the program and its arguments, by execvp's rules
  std::filesystem::path folder;    // that it works in; a program named with a slash is looked for
                                   // from there
  double wall_s = 60;              // by the wall clock, then it is ended
};

struct ProgramOutcome {
  bool in_time = true;
  // How it failed: "ended with status 3", "was killed (Segmentation fault)", "cannot be started:
  // Permission denied", "took more than 0.3 s". Empty: it ended with status 0. One of its
  // processes that cannot be ended, since it is another user's now, is a failure; its number is
  // said.
  std::string failure;
  std::string last_words;  // the end of what it wrote to stderr
};

// Why execvp would not find or not run the program; empty when it would.
std::string WhyNoProgram(const std::string& program, const std::filesystem::path& folder);

// A fresh folder that no other user may look into, as long as this lives. Interrupts are held until
// it is gone.
class ExchangeFolder {
 public:
  // Throws InputError where no folder for temporary files can be written to.
  ExchangeFolder();
  ~ExchangeFolder();
  ExchangeFolder(const ExchangeFolder&) = delete;
  ExchangeFolder& operator=(const ExchangeFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  // Runs the program to its end, once. It has no stdin, what it writes to stdout is dropped, and of
  // its stderr the last 4 KiB are kept. What it started and left running is ended with it. Throws
  // Interruption when there was an interrupt, and InternalError where no process can be had.
  ProgramOutcome Run(const ProgramCall& call);

 private:
  void EndGuard();

  HoldInterrupts hold_;
  std::filesystem::path path_;
  pid_t guard_ = -1;
  int control_ = -1;  // the guard waits for this to be shut
  int lock_ = -1;     // of the folder, by flock: no other process takes it for left behind
};

}  // namespace floorproof
