// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and SIGTERM. Where no file is half written the process ends at once, saying what is there;
// while interrupts are held the signal is remembered, and who holds them looks, tidies up and ends.
//
// Ending within the handler is what makes reading, planning and compiling interruptible everywhere,
// in other people's libraries too, without a question in every loop.
#pragma once

#include <exception>
#include <string>

namespace floorproof {

inline constexpr int kInterruptedExit = 130;

// Installs the handlers; signals that the caller's shell ignores (nohup, a background job) stay so.
void CatchInterrupts();

// What the one line on stderr says from now on, behind "floorproof: interrupted: ".
void SayWhenInterrupted(const std::string& what_is_there);

// True once a signal was seen; only ever while interrupts are held.
bool Interrupted();

// Thrown by who looked, once it has tidied up: `main` ends the process.
class Interruption : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

// Prints the line and ends the process with status 130. For `main` alone.
[[noreturn]] void EndInterrupted();

// Holds interrupts as long as it lives; nests. A second signal meanwhile ends the process at once.
// A signal that nobody looked for takes effect when the last hold ends.
class HoldInterrupts {
 public:
  HoldInterrupts();
  ~HoldInterrupts();
  HoldInterrupts(const HoldInterrupts&) = delete;
  HoldInterrupts& operator=(const HoldInterrupts&) = delete;
};

}  // namespace floorproof
