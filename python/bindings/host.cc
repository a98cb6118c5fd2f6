// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/host.h"

#include <floorproof/version.h>

#include <chrono>
#include <filesystem>
#include <optional>

#include "base/error.h"
#include "base/file_output.h"
#include "base/fork.h"
#include "base/interrupt.h"
#include "base/printable.h"

namespace floorproof {
namespace {

using Clock = std::chrono::steady_clock;

// --- exceptions ---

// They live as long as the interpreter.
PyObject* g_input_error = nullptr;
PyObject* g_internal_error = nullptr;
// What Python raised below the error that is on its way, or nullptr. Guarded by the GIL.
PyObject* g_cause = nullptr;

// Raises `type` with the text and, as its cause, what Python raised below.
void Raise(PyObject* type, const char* text) {
  PyErr_SetString(type, Printable(text).c_str());
  if (g_cause == nullptr) return;
  PyObject *kind = nullptr, *value = nullptr, *trace = nullptr;
  PyErr_Fetch(&kind, &value, &trace);
  PyErr_NormalizeException(&kind, &value, &trace);
  PyException_SetCause(value, std::exchange(g_cause, nullptr));  // takes the reference
  PyErr_Restore(kind, value, trace);
}

void Translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Interruption&) {
    Py_CLEAR(g_cause);
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  } catch (const InputError& e) {
    Raise(g_input_error, e.what());
  } catch (const std::filesystem::filesystem_error& e) {
    Raise(IsOfTheDisk(e.code()) ? g_internal_error : g_input_error, e.what());
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

// "ZeroDivisionError: division by zero (zigzag.py:12)": the innermost line that is the user's.
std::string Said(const nb::python_error& raised) {
  std::string text = nb::cast<std::string>(raised.type().attr("__name__"));
  if (const auto what = nb::cast<std::string>(nb::str(raised.value())); !what.empty())
    text += ": " + what;
  std::string place;
  for (nb::object at = raised.traceback(); at.is_valid() && !at.is_none();
       at = at.attr("tb_next")) {
    const nb::object code = at.attr("tb_frame").attr("f_code");
    const std::filesystem::path file(nb::cast<std::string>(code.attr("co_filename")));
    if (file.parent_path().filename() == "floorproof") continue;
    place = " (" + file.filename().string() + ":" +
            std::to_string(nb::cast<int>(at.attr("tb_lineno"))) + ")";
  }
  return text + place;
}

// --- Ctrl-C ---

thread_local Clock::time_point t_asked;
thread_local int t_calls = 0;  // a plug-in may call into this module again
thread_local bool t_interrupted = false;

// Python's own handler has noted the signal; asking runs it, on the main thread. What it raises
// (KeyboardInterrupt, mostly) is raised anew where the call ends.
bool PythonInterrupted() {
  constexpr auto kOften = std::chrono::milliseconds(20);
  const auto now = Clock::now();
  if (t_interrupted || now - t_asked < kOften) return t_interrupted;
  t_asked = now;
  const nb::gil_scoped_acquire held;
  if (PyErr_CheckSignals() != 0) {
    PyErr_Clear();
    t_interrupted = true;
  }
  return t_interrupted;
}

// --- forks ---

// CPython's own precautions, as os.fork() takes them.
thread_local std::optional<PyGILState_STATE> g_held;

void BeforeFork() {
  g_held = PyGILState_Ensure();
  PyOS_BeforeFork();
}

void InParent() {
  PyOS_AfterFork_Parent();
  PyGILState_Release(*g_held);
}

void InChild() {
  PyOS_AfterFork_Child();
  PyGILState_Release(*g_held);
}

}  // namespace

void ThrowRaised(const std::string& who, nb::python_error& raised) {
  if (raised.matches(PyExc_KeyboardInterrupt)) {
    t_interrupted = true;
    throw Interruption();
  }
  const std::string said = Said(raised);
  Py_XDECREF(std::exchange(g_cause, raised.value().inc_ref().ptr()));
  throw InternalError(who + " raised " + said);
}

Call::Call() {
  if (t_calls++ == 0) t_interrupted = false;
}

Call::~Call() { --t_calls; }

void Call::End() const {
  if (t_interrupted) throw Interruption();
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
  AskHostForInterrupts(&PythonInterrupted);
  SetForkHooks({&BeforeFork, &InParent, &InChild});
  m.attr("__version__") = FLOORPROOF_VERSION;
}

}  // namespace floorproof
