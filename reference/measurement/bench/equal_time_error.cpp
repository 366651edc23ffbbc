#include "reference/measurement/bench/equal_time_error.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "reference/measurement/bench/timing.h"
#include "reference/truth/rays/embree_form_factors.h"
#include "reference/truth/rays/ray_source.h"

namespace hemitex::reference {
namespace {

/// A method that computes rows, and its measured quality.
struct Contender {
  radiosity::RowSource rowOf;
  std::vector<RowQuality>& group;  ///< receives the quality
  RowQuality quality;
};

std::vector<MeasuredRow> trueRows(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                                  const std::vector<radiosity::Patch>& patches, int samples) {
  const RayFormFactors rays(scene, discretization);
  const Receivers receivers = everyElement(discretization);
  std::vector<MeasuredRow> rows;
  for (const radiosity::Patch& patch : patches) {
    const RaySource raySource =
        pointRaySource(scene, patch.surface, radiosity::patchCentre(scene, discretization, patch));
    rows.push_back(rays.aimed(raySource, receivers, {.samples = samples}));
  }
  return rows;
}

double sumOfStandardErrors(const MeasuredRow& row) {
  double sum = 0;
  for (const Measurement& receiver : row.receivers) sum += receiver.standardError;
  return sum;
}

void race(std::vector<Contender>& contenders, const std::vector<radiosity::Patch>& patches,
          const std::vector<MeasuredRow>& truth, int repeats) {
  const auto count = static_cast<double>(patches.size());
  const auto secondsOfRows = [&](std::size_t i, int repeat) {
    Contender& contender = contenders[i];
    double spent = 0;
    for (std::size_t p = 0; p < patches.size(); ++p) {
      const Stopwatch watch;
      const radiosity::FormFactorRow row = contender.rowOf(patches[p]);
      spent += watch.seconds();
      if (repeat == 0) contender.quality.error += distanceToTruth(row, truth[p]) / count;
    }
    return spent;
  };
  const std::vector<Timing> timings = interleavedTimings(contenders.size(), repeats, secondsOfRows);
  for (std::size_t i = 0; i < contenders.size(); ++i) contenders[i].quality.seconds = timings[i].median / count;
}

}  // namespace

double distanceToTruth(const radiosity::FormFactorRow& row, const MeasuredRow& truth) {
  double error = 0;
  std::size_t next = 0;
  for (std::uint32_t element = 0; element < truth.receivers.size(); ++element) {
    const bool isSeen = next < row.elements.size() && row.elements[next] == element;
    error += std::abs((isSeen ? radiosity::formFactor(row.shares[next++]) : 0) - truth.receivers[element].value);
  }
  return error;
}

std::vector<radiosity::Patch> spreadPatches(const radiosity::Discretization& discretization, std::size_t count) {
  const std::vector<radiosity::Patch>& all = discretization.patches.list;
  const std::size_t taken = std::min(count, all.size());
  std::vector<radiosity::Patch> patches;
  for (std::size_t i = 0; i < taken; ++i) patches.push_back(all[(2 * i + 1) * all.size() / (2 * taken)]);
  return patches;
}

std::optional<double> errorAtTime(const std::vector<RowQuality>& qualities, double seconds) {
  const auto later = std::find_if(qualities.begin(), qualities.end(),
                                  [seconds](const RowQuality& quality) { return quality.seconds >= seconds; });
  if (later == qualities.begin() || later == qualities.end()) return std::nullopt;
  const RowQuality &slow = *later, &fast = *(later - 1);
  const double share = std::log(seconds / fast.seconds) / std::log(slow.seconds / fast.seconds);
  return fast.error * std::pow(slow.error / fast.error, share);
}

RowComparison compareRows(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                          const RowComparisonSettings& settings) {
  RowComparison result;
  result.patches = spreadPatches(discretization, settings.points);
  const std::vector<MeasuredRow> truth = trueRows(scene, discretization, result.patches, settings.truthSamples);
  for (const MeasuredRow& row : truth)
    result.truthError += sumOfStandardErrors(row) / static_cast<double>(truth.size());

  const radiosity::IdLayout layout = radiosity::layOut(discretization);
  const auto renderer = settings.makeRenderer(radiosity::makeDrawList(scene, discretization, layout));
  std::vector<Contender> contenders;
  const auto addHemicubes = [&](const std::vector<int>& resolutions, radiosity::Orientation orientation,
                                std::vector<RowQuality>& group) {
    for (const int resolution : resolutions) {
      const auto rows = std::make_shared<radiosity::ProjectedFormFactors>(
          scene, discretization, layout, *renderer, radiosity::ViewSettings{resolution, orientation});
      contenders.push_back(
          {[rows](const radiosity::Patch& patch) { return rows->ofPatch(patch); }, group, {.size = resolution}});
    }
  };
  addHemicubes(settings.hemicubes, radiosity::Orientation::Aligned, result.hemicubes);
  addHemicubes(settings.turnedHemicubes, radiosity::Orientation::Turned, result.turnedHemicubes);
  for (const int count : settings.rays) {
    const auto rows =
        std::make_shared<RayRows>(scene, discretization, RayRowSettings{.rays = count, .start = RayStart::Centre});
    contenders.push_back(
        {[rows](const radiosity::Patch& patch) { return rows->ofPatch(patch); }, result.rays, {.size = count}});
  }
  race(contenders, result.patches, truth, settings.repeats);
  for (const Contender& contender : contenders) contender.group.push_back(contender.quality);
  return result;
}

}  // namespace hemitex::reference
