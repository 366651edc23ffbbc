/// The methods of `hemitex formfactors`: each computes rows of form factors.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/scene/scene_options.h"
#include "cli/scene/surface_names.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::cli {

/// The receivers of form factors: elements, or families of surfaces.
struct Receivers {
  std::vector<std::uint32_t> ofElement;  ///< the receiver of each element
  std::vector<std::uint32_t> ofSurface;  ///< the receiver of each surface; empty if receivers are elements
  std::vector<double> area;              ///< one per receiver, in squared units of the scene
};

Receivers elementsAsReceivers(const radiosity::Discretization& discretization);
Receivers familiesAsReceivers(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                              const Families& families);

/// A row of form factors. Receivers that are not seen have no entry.
struct Row {
  std::vector<std::uint32_t> receiver = {};   ///< ascending
  std::vector<double> formFactor = {};        ///< one per entry of `receiver`
  std::vector<double> standardError = {};     ///< one per entry of `receiver`; for facets the estimated error; empty if
                                              ///< the method has none
  std::optional<double> background = {};      ///< share that leaves the scene; none if the method ignores blockers
  std::optional<double> back = {};            ///< share that meets backs of faces; none if the method ignores blockers
  double backgroundError = 0, backError = 0;  ///< as standardError
  std::optional<double> captured = {};  ///< share that the projection captures; the rest is in `background`; none if
                                        ///< the method does not draw
  std::optional<double> error = {};     ///< estimate of the sum of the absolute errors; none if the method has none
};

/// The place of a receiver in `row.receiver`; nothing if it has no entry.
std::optional<std::size_t> entryOf(const Row& row, std::size_t receiver);

/// Computes the row of a source. Keeps references to the arguments of the function that made it.
using RowMethod = std::function<Row(const Source&)>;

/// Draws projections. The row of a surface is the mean of the rows of its patches, weighted by area. Shares are
/// integers, so sums within a row are exact. The mean over patches is in double precision, in the order of patches. The
/// row of a texel is drawn from its centre, by an aligned projection.
RowMethod drawnMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                      const Receivers& receivers, const radiosity::IdSettings& id,
                      const radiosity::DrawingSettings& settings, Console& console);

/// Rows with an error of at most `maxError` (reference/truth/facets/facet_form_factors.h). Each receiver is one surface
/// of one element. Rows are computed in blocks of `blockLength` facets from the one that is asked for, by all threads.
/// If ranks share the rows, the length is 1, because a rank does not compute facets in their order.
RowMethod facetMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                      const Receivers& receivers, double maxError, std::size_t blockLength);

/// Settings of the ray method.
struct RayOptions {
  int samples = 1 << 16;
  std::uint32_t seed = 0;
  bool aimed = false;  ///< rays aim at each receiver; otherwise they cover the hemisphere
};

/// Casts rays from the whole area of the source.
RowMethod rayMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                    const Receivers& receivers, const RayOptions& options);

/// Evaluates closed forms over the whole area of the source; ignores blockers.
RowMethod analyticMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                         const Receivers& receivers);

}  // namespace hemitex::cli
