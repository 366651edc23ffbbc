/// The rows of elements.csv.
#pragma once

#include "radiosity/bands/colour_solution.h"
#include "radiosity/base/csv_table.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::radiosity {

/// One row per element, ordered by surface and texel: the column and row of its own texel, centre, normal (of a curved
/// surface the mean), area and radiosity in W/m^2; with bands its colour, and the radiosity in each band. For a
/// quadtree leaf the texel is the first with area. `solution` is the colour of `bands`, which are null if there are
/// none. All must outlive the table.
Table elementTable(const Scene& scene, const Discretization& discretization, const Solution& solution,
                   const BandSolution* bands = nullptr);

}  // namespace hemitex::radiosity
