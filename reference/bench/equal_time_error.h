/// Hemicubes and rays at equal time: rows of form factors from the same points, each against the true row of its point,
/// with the time that it took. What a hemicube is worth is what as many rays as fit into its time are not
/// (errorAtTime).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/scene/scene.h"
#include "reference/rays/monte_carlo_form_factors.h"

namespace hemitex::reference {

/// The sum over all elements of |F - truth|: 0 for the truth, 2 for a row that sees only what is not there.
double distanceToTruth(const radiosity::FormFactorRow& row, const MeasuredRow& truth);

/// Up to `count` patches, spread evenly over all of them, ascending.
std::vector<std::uint32_t> spreadPatches(const radiosity::Discretization& discretization, std::size_t count);

/// What rows of one size cost, and how good they are, in the mean over the points.
struct RowQuality {
  int size = 0;        ///< pixels along the side of a hemicube, or rays a row
  double seconds = 0;  ///< a row; the median over the repeats
  double error = 0;    ///< see distanceToTruth
};

/// The error at a time, between the qualities of ascending sizes that were measured around it: a straight line in the
/// logarithms of both. Nothing where all of them took longer, or none did.
std::optional<double> errorAtTime(const std::vector<RowQuality>& qualities, double seconds);

struct RowComparisonSettings {
  std::vector<int> hemicubes = {128, 256, 512, 1024};        ///< resolutions of those that stand all alike
  std::vector<int> turnedHemicubes = {128, 256, 512, 1024};  ///< and of those that are turned (see Orientation)
  std::vector<int> rays = {1 << 10, 1 << 12, 1 << 14, 1 << 16, 1 << 18, 1 << 20, 1 << 22};
  std::size_t points = 24;
  int truthSamples = 1 << 10;  ///< of the aimed rays that true rows are measured with
  int repeats = 5;
};

struct RowComparison {
  std::vector<std::uint32_t> patches;  ///< from whose centres all rows leave
  double truthError = 0;               ///< of the true rows themselves: the sum of their standard errors, the mean
  std::vector<RowQuality> hemicubes, turnedHemicubes, rays;
};

/// All sizes are timed in interleaved repetitions (timing.h).
RowComparison compareRows(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                          const RowComparisonSettings& settings = {});

}  // namespace hemitex::reference
