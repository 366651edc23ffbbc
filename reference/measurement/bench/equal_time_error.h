/// Compares the errors of hemicubes and rays at equal time. Both compute rows of form factors from the same points. The
/// error of a row is its distance to the true row of its point. errorAtTime gives the error of as many rays as take the
/// time of a hemicube.
#pragma once

#include <optional>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/scene/scene.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"

namespace hemitex::reference {

/// The sum of |F - truth| over all elements: 0 for the truth, 2 for a row that sees only invisible elements.
double distanceToTruth(const radiosity::FormFactorRow& row, const MeasuredRow& truth);

/// Up to `count` patches, spread evenly over all patches, ascending.
std::vector<radiosity::Patch> spreadPatches(const radiosity::Discretization& discretization, std::size_t count);

/// The time and error of rows of one size; means over the points.
struct RowQuality {
  int size = 0;        ///< pixels along the side of a hemicube, or rays per row
  double seconds = 0;  ///< per row; median of the repetitions
  double error = 0;    ///< see distanceToTruth
};

/// The error at a time, interpolated between qualities of ascending sizes, linearly in the logarithms of time and
/// error. Nothing if the time is outside the measured range.
std::optional<double> errorAtTime(const std::vector<RowQuality>& qualities, double seconds);

struct RowComparisonSettings {
  std::vector<int> hemicubes = {128, 256, 512, 1024};        ///< resolutions of hemicubes with equal rotation
  std::vector<int> turnedHemicubes = {128, 256, 512, 1024};  ///< and with rotation per patch (see Orientation)
  std::vector<int> rays = {1 << 10, 1 << 12, 1 << 14, 1 << 16, 1 << 18, 1 << 20, 1 << 22};
  std::size_t points = 24;
  int truthSamples = 1 << 10;  ///< of the aimed rays for true rows
  int repeats = 5;
  radiosity::RendererFactory makeRenderer = radiosity::softwareRenderer;
};

struct RowComparison {
  std::vector<radiosity::Patch> patches;  ///< all rows start from their centres
  double truthError = 0;                  ///< of the true rows: the sum of standard errors, mean over the points
  std::vector<RowQuality> hemicubes, turnedHemicubes, rays;
};

/// Measures all sizes in interleaved repetitions (timing.h).
RowComparison compareRows(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                          const RowComparisonSettings& settings = {});

}  // namespace hemitex::reference
