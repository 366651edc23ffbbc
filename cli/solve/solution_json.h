/// The numbers of a solved folder: solution.json (settings, counts and the balance of flux) and elements.csv (the
/// radiosity of each element).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "cli/common/table.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/textures/texture_layout.h"

namespace hemitex::cli {

/// One row per element, ordered by surface and texel: the column and row of its own texel, centre, normal, area and
/// radiosity in W/m^2. For a quadtree leaf the texel is the first with area. All referenced objects must outlive the
/// table.
Table elementTable(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                   const radiosity::Solution& solution);

/// The object of solution.json without settings, times and warnings: surfaces with their grids and places in the
/// radiosity textures (null without `textures`), counts, residual and energy.
nlohmann::ordered_json describe(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                                const radiosity::IdLayout& layout,
                                const std::optional<radiosity::TextureLayout>& textures,
                                const radiosity::Solution& solution);

}  // namespace hemitex::cli
