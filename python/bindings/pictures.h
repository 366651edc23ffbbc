/// Pictures for Python: of light, of any values of elements, and of edges and item IDs.
#pragma once

#include "python/bindings/calls.h"

namespace hemitex::python {

void addPictures(py::module_& module);

}  // namespace hemitex::python
