/// What a call from Python needs besides arrays: errors, the interpreter's lock, progress, and Ctrl-C.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <memory>

namespace hemitex::python {

namespace py = pybind11;

/// Adds the exception `InputError`, with `file`, `line` and `advice`, to the module, and lets Python raise it where C++
/// throws raster::InputError.
void addErrors(py::module_& module);

/// Adds `SizePolicy`, which refuses what is too large, or nothing, while it lives; one that refuses lives as long as the
/// module (see raster/base/memory_budget.h).
void addSizePolicy(py::module_& module);

/// Calls `function` without the interpreter's lock, so that other threads of Python run meanwhile.
template <typename Function>
auto unlocked(const Function& function) {
  const py::gil_scoped_release released;
  return function();
}

/// A Python object that C++ keeps without the lock, and releases with it.
using Kept = std::shared_ptr<const py::object>;
Kept keep(py::object object);

/// Tells Python how far a call is, at most twenty times per second. Also lets Ctrl-C end the call.
class Progress {
 public:
  /// `callback` takes the share that is done, in [0, 1]; None: no progress is reported.
  explicit Progress(py::object callback) : callback_(keep(std::move(callback))) {}

  /// To be called without the lock, by the thread of the call. Returns whether the callback did not return False.
  /// Throws what the callback raises, and KeyboardInterrupt after Ctrl-C.
  bool tell(double share);

 private:
  Kept callback_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace hemitex::python
