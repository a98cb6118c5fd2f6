// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/host.h"

#include <floorproof/version.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/file_output.h"
#include "base/fork.h"
#include "base/interrupt.h"
#include "base/printable.h"
#include "base/usable_cores.h"

namespace floorproof {
namespace {

using Clock = std::chrono::steady_clock;

// --- exceptions ---

// They live as long as the interpreter.
PyObject* g_input_error = nullptr;
PyObject* g_internal_error = nullptr;

// What Python raised, kept by whoever carries it through C++; it may be dropped without the GIL.
class Raised {
 public:
  explicit Raised(PyObject* exception) : exception_(exception) {}  // takes the reference
  ~Raised() {
    if (!Py_IsInitialized()) return;
    const Gil held;
    Py_DECREF(exception_);
  }
  Raised(const Raised&) = delete;
  Raised& operator=(const Raised&) = delete;
  PyObject* New() const { return Py_NewRef(exception_); }

 private:
  PyObject* exception_;
};

// An InternalError with what Python raised below it as its cause.
class RaisedError : public InternalError {
 public:
  RaisedError(const std::string& text, std::shared_ptr<Raised> cause)
      : InternalError(text), cause_(std::move(cause)) {}
  const Raised& cause() const { return *cause_; }

 private:
  std::shared_ptr<Raised> cause_;
};

// What ended this thread's call: KeyboardInterrupt, or what else a signal's handler raised.
thread_local std::shared_ptr<Raised> t_interruption;

void Raise(PyObject* type, const char* text, const RaisedError* from = nullptr) {
  const std::string said = ErrorLine(text);
  PyObject* words =
      PyUnicode_DecodeUTF8(said.data(), static_cast<Py_ssize_t>(said.size()), "backslashreplace");
  PyObject* error = words == nullptr ? nullptr : PyObject_CallOneArg(type, words);
  Py_XDECREF(words);
  if (error == nullptr) return;  // that is raised
  if (from != nullptr) PyException_SetCause(error, from->cause().New());
  PyErr_SetObject(type, error);
  Py_DECREF(error);
}

void Translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Interruption&) {
    if (const auto raised = std::exchange(t_interruption, nullptr)) {
      PyObject* error = raised->New();
      PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error)), error);
      Py_DECREF(error);
    } else {
      PyErr_SetNone(Ending() ? PyExc_SystemExit : PyExc_KeyboardInterrupt);
    }
  } catch (const InputError& e) {
    Raise(g_input_error, e.what());
  } catch (const std::filesystem::filesystem_error& e) {
    Raise(IsOfTheDisk(e.code()) ? g_internal_error : g_input_error, e.what());
  } catch (const RaisedError& e) {
    Raise(g_internal_error, e.what(), &e);
  } catch (const InternalError& e) {
    Raise(g_internal_error, e.what());
  }
}

PyObject* NewException(nb::module_& m, const char* name, const char* doc, PyObject* base) {
  const std::string full = std::string("floorproof.") + name;
  PyObject* made = PyErr_NewExceptionWithDoc(full.c_str(), doc, base, nullptr);
  m.attr(name) = nb::borrow(made);
  return made;
}

// As UTF-8, whatever it holds.
std::string Utf8(PyObject* text) {
  const auto bytes = nb::steal(PyUnicode_AsEncodedString(text, "utf-8", "backslashreplace"));
  if (!bytes.is_valid()) throw nb::python_error();
  return std::string(PyBytes_AsString(bytes.ptr()));
}

// What `say` makes; "" where that raises in its turn.
template <class Say>
std::string Try(const Say& say) {
  try {
    return say();
  } catch (nb::python_error&) {
    return "";
  } catch (const nb::cast_error&) {
    return "";
  }
}

// " (zigzag.py:12)": the innermost line that is the user's.
std::string Place(nb::object at) {
  std::string place;
  for (; at.is_valid() && !at.is_none(); at = at.attr("tb_next")) {
    const nb::object code = at.attr("tb_frame").attr("f_code");
    const std::filesystem::path file(Utf8(nb::object(code.attr("co_filename")).ptr()));
    if (file.parent_path().filename() == "floorproof") continue;
    place = " (" + file.filename().string() + ":" +
            std::to_string(nb::cast<int>(at.attr("tb_lineno"))) + ")";
  }
  return place;
}

// "ZeroDivisionError: division by zero (zigzag.py:12)".
std::string Said(const nb::python_error& raised) {
  std::string what = Try([&] { return Utf8(nb::str(raised.value()).ptr()); });
  std::ranges::replace(what, '\n', ' ');
  return Try([&] { return Utf8(nb::object(raised.type().attr("__name__")).ptr()); }) +
         (what.empty() ? "" : ": " + what) + Try([&] { return Place(raised.traceback()); });
}

// --- Ctrl-C ---

thread_local Clock::time_point t_asked;
thread_local int t_calls = 0;  // a plug-in may call into this module again
thread_local bool t_interrupted = false;

// Python's own handler has noted the signal; asking runs it, on the main thread. What it raises,
// KeyboardInterrupt mostly, is raised anew where the call ends.
bool PythonInterrupted() {
  if (Ending()) return true;
  constexpr auto kOften = std::chrono::milliseconds(20);
  const auto now = Clock::now();
  if (t_interrupted || now - t_asked < kOften) return t_interrupted;
  t_asked = now;
  const Gil held;
  OrAwaitEnd([] {
    if (PyErr_CheckSignals() == 0) return;
    const nb::python_error raised;
    t_interruption = std::make_shared<Raised>(Py_NewRef(raised.value().ptr()));
    t_interrupted = true;
  });
  return t_interrupted;
}

// --- forks ---

// CPython's own precautions, as os.fork() takes them.
thread_local std::optional<Gil> t_held;

void BeforeFork() {
  t_held.emplace();
  OrAwaitEnd([] { PyOS_BeforeFork(); });
}

void InParent() {
  OrAwaitEnd([] { PyOS_AfterFork_Parent(); });
  t_held.reset();
}

bool g_forked = false;  // a campaign's worker: nobody above it takes an end that a plug-in asks for
bool g_worker = false;  // or one of somebody's pool

void InChild() {
  g_forked = true;
  PyOS_AfterFork_Child();
  t_held.reset();
}

}  // namespace

void ThrowRaised(const std::string& who, nb::python_error& raised) {
  auto exception = std::make_shared<Raised>(Py_NewRef(raised.value().ptr()));
  const bool ends =
      (raised.matches(PyExc_SystemExit) && !g_worker) || raised.matches(PyExc_KeyboardInterrupt);
  if (ends && !g_forked) {
    t_interruption = std::move(exception);
    t_interrupted = true;
    throw Interruption();
  }
  if (raised.matches(g_input_error))  // that says it all
    throw InputError(Try([&] { return Utf8(nb::str(raised.value()).ptr()); }));
  throw RaisedError(who + " raised " + Said(raised), std::move(exception));
}

void DriveForOthers() { g_worker = true; }

Call::Call() {
  if (t_calls++ > 0) return;
  t_interrupted = false;
  t_interruption.reset();
}

Call::~Call() { --t_calls; }

void Call::End() const {
  if (t_interrupted || Ending()) throw Interruption();
}

void BindHost(nb::module_& m) {
  g_input_error = NewException(
      m, "InputError",
      "Bad input: the message is the command line's, naming file, line, key, value and rule.",
      PyExc_ValueError);
  g_internal_error = NewException(
      m, "InternalError",
      "The tool or the physics broke, the disk is full, or a plug-in raised; what that "
      "raised is the cause.",
      PyExc_RuntimeError);
  nb::register_exception_translator(&Translate);
  WatchForTheEnd();
  AskHostForInterrupts(&PythonInterrupted);
  SetForkHooks({&BeforeFork, &InParent, &InChild});
  m.def("usable_cores", &UsableCores);
  m.def(
      "error_line", [](const std::string& text) { return ErrorLine(text); }, nb::arg("text"));
  m.def(
      "is_of_the_disk",
      [](int error) { return IsOfTheDisk(std::error_code(error, std::generic_category())); },
      nb::arg("error"));
  m.attr("__version__") = FLOORPROOF_VERSION;
}

}  // namespace floorproof
