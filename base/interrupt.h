// SPDX-License-Identifier: Apache-2.0
// Ctrl-C, SIGTERM and SIGHUP (a terminal that closes). Where no file is half written, the process
// ends at once and says what is there. While interrupts are held, the signal is only remembered;
// whoever holds them checks, tidies up and ends.
//
// Ending within the handler makes reading, planning and compiling interruptible everywhere, in
// other people's libraries too, without a check in every loop.
#pragma once

#include <exception>
#include <string>

namespace floorproof {

inline constexpr int kInterruptedExit = 130;

// Installs the handlers. Signals that the caller's shell ignores (nohup, a background job) stay
// ignored.
void CatchInterrupts();

// What the one line on stderr says from now on, behind "floorproof: interrupted: ".
void SayWhenInterrupted(const std::string& what_is_there);

// True once a signal was seen; only ever while interrupts are held. In a host that catches signals
// itself, what the host answers.
bool Interrupted();

// For a program that holds this one as a library and never calls CatchInterrupts: it is asked in
// place of a signal. It may be asked often, on the thread that calls Interrupted().
void AskHostForInterrupts(bool (*asked)());

// Thrown by who looked, once it has tidied up: `main` ends the process.
class Interruption : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

// Prints the line and ends the process with status 130. For `main` alone.
[[noreturn]] void EndInterrupted();

// Holds interrupts as long as it lives; holds nest. A second signal during a hold ends the process
// at once. A signal that nobody checked for takes effect when the last hold ends.
class HoldInterrupts {
 public:
  HoldInterrupts();
  ~HoldInterrupts();
  HoldInterrupts(const HoldInterrupts&) = delete;
  HoldInterrupts& operator=(const HoldInterrupts&) = delete;
};

}  // namespace floorproof
