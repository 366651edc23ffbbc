/// Rows of form factors by each method: drawn projections, rays, closed forms, and facets with bounded errors. A row
/// goes from whole surfaces or from one texel to all elements or surfaces.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/surface_names.h"
#include "reference/matrices/sparse_row.h"

namespace hemitex::reference {

/// The source of form factors: whole surfaces, one texel of a surface, or a point with a normal.
struct Source {
  std::vector<std::uint32_t> surfaces = {};   ///< none for a point
  std::optional<std::uint32_t> element = {};  ///< the element of the texel; without it, the whole surfaces
  radiosity::SurfacePoint point = {};         ///< without surfaces: the normal is a unit vector. It is only drawn
};

/// A texel of a surface. Throws InputError if no surface has the name, or it has several parts, or no such texel with
/// area.
Source texelSource(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                   const std::string& name, int column, int row);

/// The receivers of form factors: elements, or families of surfaces.
struct RowReceivers {
  std::vector<std::uint32_t> ofElement;  ///< the receiver of each element
  std::vector<std::uint32_t> ofSurface;  ///< the receiver of each surface; empty if receivers are elements
  std::vector<double> area;              ///< one per receiver, in squared units of the scene
};

RowReceivers elementsAsReceivers(const radiosity::Discretization& discretization);
RowReceivers familiesAsReceivers(const radiosity::Discretization& discretization, const radiosity::Families& families);

/// Computes rows. Keeps references to the arguments of the function that made it.
struct RowMethod {
  std::function<SparseRow(const Source&)> row;
  std::optional<double> captured = {};  ///< share that the projection captures; the rest is in `surroundings`; none if
                                        ///< the method does not draw
};

/// Draws projections. The row of a surface is the mean of the rows of its patches, weighted by area. Shares are
/// integers, so sums within a row are exact. The mean over patches is in double precision, in the order of patches. The
/// row of a texel is drawn from its centre, by an aligned projection. `layout` is that of the discretization.
RowMethod drawnMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                      const RowReceivers& receivers, radiosity::IdLayout layout,
                      const radiosity::DrawingSettings& settings,
                      const radiosity::RendererFactory& makeRenderer = radiosity::softwareRenderer);

/// Rows with an error of at most `maxError` (reference/rows/facet_form_factors.h). Each receiver is one surface
/// of one element. Rows are computed in blocks of `blockLength` facets from the one that is asked for, by all threads.
/// If ranks share the rows, the length is 1, because a rank does not compute facets in their order.
RowMethod facetMethod(const radiosity::Scene& scene, const RowReceivers& receivers, double maxError,
                      std::size_t blockLength);

/// Settings of the ray method.
struct RayOptions {
  int samples = 1 << 16;
  std::uint32_t seed = 0;
  bool aimed = false;  ///< rays aim at each receiver; otherwise they cover the hemisphere
};

/// Casts rays from the whole area of the source.
RowMethod rayMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                    const RowReceivers& receivers, const RayOptions& options);

/// Evaluates closed forms over the whole area of the source; ignores blockers.
RowMethod analyticMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                         const RowReceivers& receivers);

}  // namespace hemitex::reference
