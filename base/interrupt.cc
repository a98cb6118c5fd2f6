// SPDX-License-Identifier: Apache-2.0
#include "base/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstring>
#include <deque>

#include "base/printable.h"

namespace floorproof {
namespace {

// The number of holds, or kEnding. One atomic number decides between a handler that ends the
// process, perhaps on a thread of a codec or a driver, and a thread that begins a hold.
constexpr int kEnding = -1;
std::atomic<int> g_holds{0};
std::atomic<bool> g_seen{false};
std::atomic<bool (*)()> g_host{nullptr};
std::atomic<const char*> g_line{"floorproof: interrupted: nothing was written\n"};
static_assert(std::atomic<int>::is_always_lock_free &&
              std::atomic<const char*>::is_always_lock_free);

// Only what a signal handler may call.
[[noreturn]] void End() {
  const char* line = g_line.load();
  // A full pipe or a closed terminal must not keep the process.
  static_cast<void>(!write(STDERR_FILENO, line, std::strlen(line)));
  _exit(kInterruptedExit);
}

void EndUnlessHeld() {
  int none = 0;
  if (g_holds.compare_exchange_strong(none, kEnding)) End();
}

void OnSignal(int) {
  EndUnlessHeld();
  if (g_holds == kEnding) return;  // another thread is ending the process
  if (g_seen.exchange(true)) End();
  EndUnlessHeld();  // the last hold may have ended on another thread in between
}

}  // namespace

void CatchInterrupts() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    if (sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = OnSignal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, nullptr);
  }
}

void SayWhenInterrupted(const std::string& what_is_there) {
  if (g_host.load() != nullptr) return;  // nothing ends the process here
  // Lines live for ever: a handler may be reading the one before.
  static auto& lines = *new std::deque<std::string>;
  lines.push_back("floorproof: interrupted: " + Printable(what_is_there) + "\n");
  g_line = lines.back().c_str();
}

bool Interrupted() {
  bool (*const host)() = g_host;
  return g_seen || (host != nullptr && host());
}

void AskHostForInterrupts(bool (*asked)()) { g_host = asked; }

void EndInterrupted() {
  std::fflush(stdout);
  End();
}

HoldInterrupts::HoldInterrupts() {
  int holds = g_holds;
  do {
    while (holds == kEnding) {  // the process is ending: begin nothing
      pause();
      holds = g_holds;
    }
  } while (!g_holds.compare_exchange_weak(holds, holds + 1));
}

HoldInterrupts::~HoldInterrupts() {
  // Where an Interruption is on its way, `main` ends the process.
  if (--g_holds == 0 && g_seen && std::uncaught_exceptions() == 0) EndInterrupted();
}

}  // namespace floorproof
