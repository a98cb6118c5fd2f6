// SPDX-License-Identifier: Apache-2.0
// What it takes to run inside a Python interpreter: calls both ways, Ctrl-C, forks, exceptions.
#pragma once

#include <nanobind/nanobind.h>
// All conversions in all files: where one lacks one, it would have another meaning of the same
// name.
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <functional>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/interrupt.h"
#include "python/bindings/gil.h"

namespace floorproof {

// Exceptions, Ctrl-C and forks. Once, when the module is loaded.
void BindHost(nb::module_& m);

// From here on this process drives episodes that others record: a plug-in that ends the program,
// sys.exit, is an error of its episode.
void DriveForOthers();

// A call into this module: Ctrl-C that is noticed during it, on its thread, is raised at its end;
// in a program that ends, SystemExit, which ends a thread without a word.
class Call {
 public:
  Call();
  ~Call();
  // Throws Interruption if there was one.
  void End() const;
};

// Does `work` while other Python threads run.
template <class Work>
auto WithoutGil(const Work& work) {
  const Call call;
  const NoGil released;
  auto result = work();
  call.End();
  return result;
}

// Calls back into Python, from wherever: `call` runs with the GIL, and what Python raises ends the
// work, as the program's end does. `who` is named by the error that comes of it: `plan.planner
// zigzag`, say. What is written in Python is called by Ask().
template <class Call>
auto InPython(const std::string& who, const Call& call);

// What Python may look at during one call alone: whoever keeps it and asks later is told so.
template <class T>
class Lent {
 public:
  explicit Lent(T* lent) : lent_(lent) {}
  T& operator*() const {
    if (lent_ == nullptr)
      throw InputError("is of its own call alone: keep copies of what it holds");
    return *lent_;
  }
  T* operator->() const { return &**this; }
  void TakeBack() { lent_ = nullptr; }

 private:
  T* lent_;
};

// call(object), with an `As` that is taken back behind it. With the GIL.
template <class As, class T, class Call>
auto Lend(T& what, const Call& call) {
  struct Back {
    nb::object object;
    ~Back() { nb::cast<As&>(object).lent.TakeBack(); }
  };
  const Back back{nb::cast(As{Lent<const T>(&what)})};
  return call(back.object);
}

// What Python raised, as an InternalError that names `who` and says what and where; the exception
// itself becomes its cause. KeyboardInterrupt becomes an Interruption.
[[noreturn]] void ThrowRaised(const std::string& who, nb::python_error& raised);

template <class Call>
auto InPython(const std::string& who, const Call& call) {
  if (Ending()) throw Interruption();
  const Gil held;
  return OrAwaitEnd([&] {
    try {
      return call();
    } catch (nb::python_error& raised) {
      ThrowRaised(who, raised);
    } catch (const nb::cast_error&) {
      throw InternalError(who + " returned what has another type than it should");
    }
  });
}

}  // namespace floorproof
