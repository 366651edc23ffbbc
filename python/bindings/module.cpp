/// The module hemitex._core: functions that take and return plain values and arrays. The package hemitex gives them
/// names, types and documentation.
#include <pybind11/pybind11.h>

#include "python/bindings/calls.h"
#include "python/bindings/conformance.h"
#include "python/bindings/form_factors.h"
#include "python/bindings/light.h"
#include "python/bindings/pictures.h"
#include "python/bindings/scenes.h"

PYBIND11_MODULE(_core, module) {
  using namespace hemitex::python;
  addErrors(module);
  addSizePolicy(module);
  addScenes(module);
  addFormFactors(module);
  addLight(module);
  addPictures(module);
  addConformance(module);
}
