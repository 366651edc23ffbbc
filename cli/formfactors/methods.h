/// The methods of `hemitex formfactors`: where a row of form factors comes from.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/common/options.h"
#include "cli/common/surface_names.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::cli {

/// What the columns of the output stand for: elements, or families of surfaces.
struct Receivers {
  std::vector<std::uint32_t> ofElement;  ///< the receiver that each element belongs to
  std::vector<std::uint32_t> ofSurface;  ///< the receiver that each surface belongs to; empty where they are elements
  std::vector<double> area;              ///< one a receiver
};

Receivers elementsAsReceivers(const radiosity::Discretization& discretization);
Receivers familiesAsReceivers(const radiosity::Discretization& discretization, const Families& families);

/// A row of form factors, one a receiver.
struct Row {
  std::vector<double> formFactor;
  std::vector<double> standardError;  ///< empty where the method has none
  std::optional<double> background;   ///< left the scene; none where the method does not look at blockers
  std::optional<double> back;         ///< absorbed by the backs of surfaces; likewise
  std::optional<double> captured;     ///< by the projection, of all light; the rest is in `background`; none where the
                                      ///< method does not draw
};

/// The row that leaves a source. Whatever it was made from outlives it.
using RowMethod = std::function<Row(const Source&)>;

/// A surface shoots from its patches, so its row is the mean of its patches' rows, weighted by their areas. Shares are
/// integers and add up exactly within a row; only the mean over patches is taken in binary64, in the patches' order. A
/// texel shoots from its centre, by an aligned projection.
RowMethod drawnMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                      const Receivers& receivers, const radiosity::IdSettings& id,
                      const radiosity::DrawingSettings& settings, Console& console);

/// How rays measure.
struct RayOptions {
  int samples = 1 << 16;
  bool aimed = false;  ///< at each receiver; else over the hemisphere
};

/// Sources shoot from their whole area.
RowMethod rayMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                    const Receivers& receivers, const RayOptions& options);

/// Sources shoot from their whole area, and nothing stands in the way.
RowMethod analyticMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                         const Receivers& receivers);

}  // namespace hemitex::cli
