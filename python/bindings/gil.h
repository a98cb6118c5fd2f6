// SPDX-License-Identifier: Apache-2.0
// The GIL, and the threads that want it when the interpreter ends.
//
// CPython (before 3.14) ends a daemon thread that asks for the GIL then by pthread_exit, which
// unwinds its frames. Frames of C++ that nothing may leave (noexcept, destructors) abort the
// process instead. So drives are told to end before, and a thread that asks too late waits for the
// end of the process here.
#pragma once

#include <cxxabi.h>
#include <nanobind/nanobind.h>

namespace floorproof {

namespace nb = nanobind;

// Whether the program ends, and this thread with it: its drive is given up as on Ctrl-C.
bool Ending();

// Never returns: this thread is not to go on.
[[noreturn]] void AwaitEnd();

// call(), which may ask for the GIL; within it AwaitEnd() takes the place of pthread_exit. What
// lives in frames above is left alone, as it may need the GIL to go.
template <class Call>
auto OrAwaitEnd(const Call& call) {
  try {
    return call();
  } catch (abi::__forced_unwind&) {
    AwaitEnd();
  }
}

// The thread has the GIL as long as this lives.
class Gil {
 public:
  Gil();
  ~Gil();
  Gil(const Gil&) = delete;
  Gil& operator=(const Gil&) = delete;

 private:
  PyGILState_STATE before_;
};

// The thread has not got it as long as this lives: it works, and the end of the interpreter waits a
// moment for it.
class NoGil {
 public:
  NoGil();
  ~NoGil();
  NoGil(const NoGil&) = delete;
  NoGil& operator=(const NoGil&) = delete;

 private:
  bool worked_;
  PyThreadState* thread_;
};

// The thread is in Python code as long as this lives: the end of the interpreter does not
// wait for it.
class Away {
 public:
  Away();
  ~Away();
  Away(const Away&) = delete;
  Away& operator=(const Away&) = delete;

 private:
  bool worked_;
};

// what(args...), which is written in Python, by a user perhaps. With the GIL.
template <class... Args>
nb::object Ask(const nb::object& what, const Args&... args) {
  const Away away;
  return OrAwaitEnd([&] { return what(args...); });
}

// Once, when the module is loaded.
void WatchForTheEnd();

}  // namespace floorproof
