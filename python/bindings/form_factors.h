/// Form factors for Python: rows, matrices, hemicubes, closed forms, and the judge of matrices.
#pragma once

#include "python/bindings/calls.h"
#include "python/bindings/settings.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/index_maps/id_layout.h"

namespace hemitex::python {

/// The settings of projections. `others` are the methods that do not draw, for the message about a wrong name.
radiosity::DrawingSettings drawingSettings(const Settings& settings, const std::vector<std::string>& others = {});
/// The settings of item IDs.
radiosity::IdSettings idSettings(const Settings& settings);

void addFormFactors(py::module_& module);

}  // namespace hemitex::python
