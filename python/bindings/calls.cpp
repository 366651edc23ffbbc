#include "python/bindings/calls.h"

#include <filesystem>

#include "raster/base/input_error.h"
#include "raster/base/memory_budget.h"

namespace hemitex::python {
namespace {

/// The class InputError, which lives as long as the interpreter.
PyObject*& inputError() {
  static PyObject* error = nullptr;
  return error;
}

void raise(const std::string& what, const std::string& file, int line, const std::string& advice) {
  py::object error = py::reinterpret_borrow<py::object>(inputError())(what);
  error.attr("file") = file.empty() ? py::object(py::none()) : py::str(file);
  error.attr("line") = line > 0 ? py::object(py::int_(line)) : py::object(py::none());
  error.attr("advice") = advice;
  PyErr_SetObject(inputError(), error.ptr());
}

}  // namespace

void addErrors(py::module_& module) {
  inputError() = PyErr_NewExceptionWithDoc("hemitex.InputError",
                                           "Wrong input: a file, an array or a setting. `file` and `line` say where "
                                           "(None where there is none), and `advice` "
                                           "what to do.",
                                           PyExc_ValueError, nullptr);
  module.attr("InputError") = py::reinterpret_borrow<py::object>(inputError());
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const raster::InputError& error) {
      raise(error.what(), error.file(), error.line(), error.advice());
    } catch (const std::filesystem::filesystem_error& error) {
      raise(error.what(), error.path1().string(), 0, {});
    }
  });
}

void addSizePolicy(py::module_& module) {
  py::class_<raster::SizePolicy>(module, "SizePolicy").def(py::init([](bool insists) {
    return new raster::SizePolicy(insists, "use `with hemitex.insist():` to run all the same");
  }));
  module.attr("ordinary") = module.attr("SizePolicy")(false);
}

Kept keep(py::object object) {
  return Kept(new py::object(std::move(object)), [](const py::object* kept) {
    const py::gil_scoped_acquire locked;
    delete kept;
  });
}

bool Progress::tell(double share) {
  constexpr std::chrono::milliseconds pause(50);
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < pause) return true;
  const py::gil_scoped_acquire locked;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  const bool goesOn = callback_->is_none() || !(*callback_)(share).is(py::bool_(false));
  last_ = std::chrono::steady_clock::now();
  return goesOn;
}

}  // namespace hemitex::python
