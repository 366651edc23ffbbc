/// What a solved folder says in numbers: solution.json (the settings, what they led to and where the light went) and
/// elements.csv (the radiosity of every element).
#pragma once

#include <nlohmann/json.hpp>

#include "cli/common/table.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::cli {

/// One row an element, in the order of surfaces and, within one, of texels: the column and row of its own texel (of a
/// quadtree's leaf the first that has area), its centre and normal, its area and its radiosity. All referenced objects
/// must outlive the table.
Table elementTable(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                   const radiosity::Solution& solution);

/// The object of solution.json, but for settings, times and warnings: the surfaces with their grids and their places in
/// the radiosity textures, counts, residual, energy.
nlohmann::ordered_json describe(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                                const radiosity::IdLayout& layout, const radiosity::Solution& solution);

}  // namespace hemitex::cli
