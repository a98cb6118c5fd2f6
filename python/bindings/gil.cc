// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/gil.h"

#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>
#include <utility>

namespace floorproof {
namespace {

// For how long the end of the interpreter waits for drives that end, files and all.
constexpr std::chrono::milliseconds kGrace(1000);

std::atomic<bool> g_ending{false};
std::thread::id g_ender;  // the thread that ends the interpreter

std::atomic<int> g_working{0};  // threads that do
thread_local bool t_works = false;

bool SetWorks(bool works) {
  const bool before = std::exchange(t_works, works);
  g_working += static_cast<int>(works) - static_cast<int>(before);
  return before;
}

bool Finalizing() {
#if PY_VERSION_HEX >= 0x030D0000
  return Py_IsFinalizing() != 0;
#else
  return _Py_IsFinalizing() != 0;
#endif
}

// Whoever asks for the GIL now would be unwound.
void AskNoMore() {
  if (Ending() && Finalizing()) AwaitEnd();
}

// The process goes while a thread still works (a long plan, say, which nothing interrupts): what it
// works with must not be torn down below it.
void OnExit(int status, void*) {
  if (g_working <= 0) return;
  std::fflush(stdout);
  std::fflush(stderr);
  _exit(status);
}

// By atexit: Python's other threads still get the GIL.
void End() {
  g_ender = std::this_thread::get_id();
  g_ending = true;
  PyThreadState* const thread = PyEval_SaveThread();
  const auto until = std::chrono::steady_clock::now() + kGrace;
  while (g_working > 0 && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  PyEval_RestoreThread(thread);
  if (g_working > 0) on_exit(&OnExit, nullptr);
}

// A child process has this one thread, and does not end with its parent's interpreter.
void InChild() {
  g_ending = false;
  g_working = t_works ? 1 : 0;
}

}  // namespace

bool Ending() { return g_ending && std::this_thread::get_id() != g_ender; }

void AwaitEnd() {
  SetWorks(false);
  for (;;) pause();
}

Gil::Gil()
    : before_(OrAwaitEnd([] {
        AskNoMore();
        return PyGILState_Ensure();
      })) {}

Gil::~Gil() {
  OrAwaitEnd([this] { PyGILState_Release(before_); });
}

NoGil::NoGil() : worked_(SetWorks(true)), thread_(PyEval_SaveThread()) {}

NoGil::~NoGil() {
  OrAwaitEnd([this] {
    AskNoMore();
    PyEval_RestoreThread(thread_);
  });
  SetWorks(worked_);
}

Away::Away() : worked_(SetWorks(false)) {}

Away::~Away() { SetWorks(worked_); }

void WatchForTheEnd() {
  pthread_atfork(nullptr, nullptr, &InChild);
  nb::module_::import_("atexit").attr("register")(nb::cpp_function(&End));
}

}  // namespace floorproof
