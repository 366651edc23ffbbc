/// Test vectors, the judge of rasterizers and explanations of pixels for Python.
#pragma once

#include "python/bindings/calls.h"

namespace hemitex::python {

void addConformance(py::module_& module);

}  // namespace hemitex::python
