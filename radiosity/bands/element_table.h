/// The rows of elements.csv.
#pragma once

#include "radiosity/base/csv_table.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::radiosity {

/// One row per element, ordered by surface and texel: the column and row of its own texel, centre, normal (of a curved
/// surface the mean), area and radiosity in W/m^2; in a scene with wavelengths its colour, and the radiosity in each
/// band, by ascending wavelengths. For a quadtree leaf the texel is the first with area. All arguments must outlive the
/// table.
Table elementTable(const Scene& scene, const Discretization& discretization, const Solution& solution);

}  // namespace hemitex::radiosity
