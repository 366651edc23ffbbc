#include "reference/measurement/bench/report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace hemitex::reference {

std::vector<EqualTimeError> equalTimeErrors(const std::string& scene, const RowComparison& comparison) {
  std::vector<EqualTimeError> errors;
  for (const RowQuality& hemicube : comparison.turnedHemicubes)
    if (const auto rays = errorAtTime(comparison.rays, hemicube.seconds))
      errors.push_back({scene, hemicube.size, hemicube.seconds, hemicube.error, *rays});
  return errors;
}

namespace {

bool isOpenGl(const BenchRatio& ratio) { return ratio.what == "opengl" || ratio.what == "opengl-plain"; }

auto placeOf(const BenchRatio& ratio) { return std::tie(ratio.scene, ratio.triangles, ratio.resolution); }

/// Removes the slower device of OpenGL from each place.
void keepFasterOpenGl(std::vector<BenchRatio>& ratios) {
  const std::vector<BenchRatio> all = ratios;
  std::erase_if(ratios, [&all](const BenchRatio& ratio) {
    return isOpenGl(ratio) && std::any_of(all.begin(), all.end(), [&ratio](const BenchRatio& other) {
             return isOpenGl(other) && placeOf(other) == placeOf(ratio) && other.overHemicube < ratio.overHemicube;
           });
  });
}

}  // namespace

std::vector<BenchRatio> benchRatios(const std::vector<BenchRun>& runs) {
  const auto place = [](const BenchRun& run) { return std::tie(run.scene, run.triangles, run.resolution); };
  std::vector<BenchRatio> ratios;
  for (const BenchRun& run : runs) {
    if (run.what == "hemicube" || run.what == "shot" || run.what == "solution") continue;
    const auto hemicube = std::find_if(runs.begin(), runs.end(), [&](const BenchRun& other) {
      return other.what == "hemicube" && place(other) == place(run);
    });
    if (hemicube == runs.end()) continue;
    ratios.push_back({run.scene, run.triangles, run.resolution, run.what, ratioOf(run.seconds, hemicube->seconds)});
  }
  keepFasterOpenGl(ratios);
  return ratios;
}

std::vector<Crossover> crossovers(const std::vector<BenchRun>& runs) {
  std::map<std::pair<std::string, int>, std::vector<BenchRatio>> curves;
  for (const BenchRatio& ratio : benchRatios(runs))
    if (ratio.what == "embree") curves[{ratio.scene, ratio.resolution}].push_back(ratio);
  std::vector<Crossover> result;
  for (auto& [place, curve] : curves) {
    std::sort(curve.begin(), curve.end(),
              [](const BenchRatio& a, const BenchRatio& b) { return a.triangles < b.triangles; });
    Crossover crossover{place.first, place.second, std::nullopt};
    if (curve.front().overHemicube < 1) crossover.triangles = static_cast<double>(curve.front().triangles);
    for (std::size_t i = 1; i < curve.size(); ++i) {
      const BenchRatio &few = curve[i - 1], &many = curve[i];
      if (!(few.overHemicube >= 1 && many.overHemicube < 1)) continue;
      const double part = std::log(few.overHemicube) / std::log(few.overHemicube / many.overHemicube);
      const auto first = static_cast<double>(few.triangles), last = static_cast<double>(many.triangles);
      crossover.triangles = first * std::pow(last / first, part);
    }
    result.push_back(crossover);
  }
  return result;
}

}  // namespace hemitex::reference
