#include "reference/bench/report.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>

namespace hemitex::reference {
namespace {

const std::string room = "paper-room", complexScene = "gallery";
constexpr std::size_t million = 1000000;

/// Gathers requirements. What is required of several is held against the worst of them, and of none against nothing.
class Requirements {
 public:
  void atLeast(const std::string& what, const std::vector<double>& measured, double limit) {
    if (measured.empty()) return;
    const double worst = *std::min_element(measured.begin(), measured.end());
    list_.push_back({what + ", at least", worst, limit, worst >= limit});
  }
  void atMost(const std::string& what, const std::vector<double>& measured, double limit) {
    if (measured.empty()) return;
    const double worst = *std::max_element(measured.begin(), measured.end());
    list_.push_back({what + ", at most", worst, limit, worst <= limit});
  }
  std::vector<Requirement> list() && { return std::move(list_); }

 private:
  std::vector<Requirement> list_;
};

/// The ratios that `isMeant`.
std::vector<double> those(const std::vector<BenchRatio>& ratios,
                          const std::function<bool(const BenchRatio&)>& isMeant) {
  std::vector<double> meant;
  for (const BenchRatio& ratio : ratios)
    if (isMeant(ratio)) meant.push_back(ratio.ratio);
  return meant;
}

/// The number of triangles of a scene as it is: the fewest.
std::map<std::string, std::size_t> ownTriangles(const std::vector<BenchRun>& runs) {
  std::map<std::string, std::size_t> own;
  for (const BenchRun& run : runs) {
    const auto [known, isNew] = own.try_emplace(run.scene, run.triangles);
    known->second = std::min(known->second, run.triangles);
  }
  return own;
}

void addRuns(const std::vector<BenchRun>& runs, Requirements& list) {
  const auto own = ownTriangles(runs);
  const auto isOwn = [&own](const BenchRatio& r, const std::string& scene) {
    return r.scene == scene && r.triangles == own.at(scene);
  };
  const auto embree = ratiosOf(runs, "embree", "hemicube"), openGl = ratiosOf(runs, "opengl", "hemicube");
  list.atLeast("times faster than Embree, the room", those(embree, [&](const BenchRatio& r) { return isOwn(r, room); }),
               5);
  list.atLeast("times faster than Embree, the complex scene",
               those(embree, [&](const BenchRatio& r) { return isOwn(r, complexScene); }), 4);
  list.atLeast("times faster than Embree, 1,000,000 triangles from R = 512 up",
               those(embree, [](const BenchRatio& r) { return r.triangles >= million && r.resolution >= 512; }), 1);
  list.atLeast("times faster than OpenGL, from 8,000 triangles up",
               those(openGl, [](const BenchRatio& r) { return r.triangles >= 8000; }), 8);
  list.atLeast("times faster than OpenGL, below 8,000 triangles",
               those(openGl, [](const BenchRatio& r) { return r.triangles < 8000; }), 5);
  list.atMost("times the floor, the room at R = 1024",
              those(ratiosOf(runs, "hemicube", "floor"),
                    [&](const BenchRatio& r) { return isOwn(r, room) && r.resolution == 1024; }),
              2.5);
  list.atLeast("times faster than meshing, the complex scene at R = 128",
               those(ratiosOf(runs, "hemicube-mesh", "hemicube"),
                     [&](const BenchRatio& r) { return isOwn(r, complexScene) && r.resolution == 128; }),
               13.3);
}

}  // namespace

std::vector<EqualTimeError> equalTimeErrors(const std::string& scene, const RowComparison& comparison) {
  std::vector<EqualTimeError> errors;
  for (const RowQuality& hemicube : comparison.turnedHemicubes)
    if (const auto rays = errorAtTime(comparison.rays, hemicube.seconds))
      errors.push_back({scene, hemicube.size, hemicube.seconds, hemicube.error, *rays});
  return errors;
}

std::vector<BenchRatio> ratiosOf(const std::vector<BenchRun>& runs, const std::string& what, const std::string& of) {
  std::vector<BenchRatio> ratios;
  for (const BenchRun& run : runs) {
    if (run.what != what) continue;
    for (const BenchRun& other : runs)
      if (other.what == of && other.scene == run.scene && other.triangles == run.triangles &&
          other.resolution == run.resolution)
        ratios.push_back({run.scene, run.triangles, run.resolution, ratioOf(run.seconds, other.seconds)});
  }
  return ratios;
}

std::vector<Crossover> crossovers(const std::vector<BenchRun>& runs) {
  std::map<std::pair<std::string, int>, std::vector<BenchRatio>> curves;
  for (const BenchRatio& ratio : ratiosOf(runs, "embree", "hemicube"))
    curves[{ratio.scene, ratio.resolution}].push_back(ratio);
  std::vector<Crossover> result;
  for (auto& [place, curve] : curves) {
    std::sort(curve.begin(), curve.end(),
              [](const BenchRatio& a, const BenchRatio& b) { return a.triangles < b.triangles; });
    Crossover crossover{place.first, place.second, std::nullopt};
    if (curve.front().ratio < 1) crossover.triangles = static_cast<double>(curve.front().triangles);
    for (std::size_t i = 1; i < curve.size(); ++i) {
      const BenchRatio &few = curve[i - 1], &many = curve[i];
      if (!(few.ratio >= 1 && many.ratio < 1)) continue;
      const double part = std::log(few.ratio) / std::log(few.ratio / many.ratio);
      const auto first = static_cast<double>(few.triangles), last = static_cast<double>(many.triangles);
      crossover.triangles = first * std::pow(last / first, part);
    }
    result.push_back(crossover);
  }
  return result;
}

std::vector<Requirement> requirementsOf(const BenchReport& report) {
  Requirements list;
  addRuns(report.runs, list);
  for (const EqualTimeError& error : report.errors)
    list.atMost("of the error of rays at equal time, " + error.scene + " at R = " + std::to_string(error.resolution),
                {error.hemicube / error.rays}, 0.5);
  for (const BenchGrowth& growth : report.growth)
    list.atMost("times the drawing time of the fewest elements at the most, " + growth.scene,
                {ratioOf(growth.points.back().draw, growth.points.front().draw)}, 1.05);
  if (report.cores) {
    list.atLeast("of what arithmetic gains from the second core, a hemicube", {report.cores->hemicubeOfArithmetic},
                 0.93);
    list.atLeast("of what arithmetic gains from the second core, a solution", {report.cores->solutionOfArithmetic},
                 0.93);
  }
  for (const WallTimes& wall : report.walls)
    list.atMost("times the moved wall, R = " + std::to_string(wall.resolution), {ratioOf(wall.tied, wall.moved)}, 2);
  for (const SolutionParts& parts : report.parts)
    list.atMost("of a solution's time beside its hemicubes, " + std::to_string(parts.elements) +
                    " elements, R = " + std::to_string(parts.resolution),
                {parts.besideOfTotal}, 0.2);
  if (report.memory) {
    list.atMost("bytes an element", {report.memory->bytesPerElement}, 64);
    list.atMost("bytes a pixel", {report.memory->bytesPerPixel}, 24);
  }
  return std::move(list).list();
}

}  // namespace hemitex::reference
