/// Error by number of elements on the Cornell box, for equal texels and for quadtrees: prints a table. The error is
/// that of constant elements at each texel of a fine solution, weighted by flux
/// (reference/truth/solution/radiosity_error.h). The last column for quadtrees is the number of equal elements with the
/// same error, interpolated on a logarithmic scale.
#include <cmath>
#include <cstdio>
#include <vector>

#include "radiosity/discretization/adaptive_subdivision.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "reference/truth/solution/radiosity_error.h"

using namespace hemitex;

namespace {

constexpr int finestTexels = 64;
constexpr int fineResolution = 1024, resolution = 256;

struct Point {
  double elements, error;
};

class Curve {
 public:
  Curve()
      : scene_(radiosity::loadScene(HEMITEX_DATA "/cornell-box.obj")),
        fine_(radiosity::discretize(scene_, settings(finestTexels))),
        truth_(solved(fine_, fineResolution)) {}

  Point uniform(int texels) const {
    const radiosity::Discretization discretization = radiosity::discretize(scene_, settings(texels));
    return pointOf(discretization, solved(discretization, resolution));
  }

  Point adaptive(double tolerance) const {
    std::vector<glm::dvec3> last;
    const auto solveElements = [&](const radiosity::Discretization& discretization) {
      return last = solved(discretization, resolution);
    };
    const radiosity::Discretization discretization =
        radiosity::adaptiveDiscretization(scene_, settings(finestTexels), tolerance, solveElements);
    return pointOf(discretization, last);
  }

 private:
  /// The same patches for all.
  static radiosity::DiscretizationSettings settings(int texels) { return {.texels = texels, .patches = 4}; }

  std::vector<glm::dvec3> solved(const radiosity::Discretization& discretization, int side) const {
    radiosity::SceneFormFactors drawn(scene_, discretization, radiosity::layOut(discretization, {.format = "r32ui"}),
                                      {.resolution = side});
    return radiosity::solve({.scene = scene_,
                             .discretization = discretization,
                             .patches = discretization.patches,
                             .rowOf = drawn.rowOf(),
                             .split = drawn.splits()})
        .radiosity;
  }

  Point pointOf(const radiosity::Discretization& discretization, const std::vector<glm::dvec3>& radiosity) const {
    const auto found = reference::onOtherGrids(discretization, radiosity, fine_);
    return {static_cast<double>(discretization.elements.size()), reference::errorOf(fine_, found, truth_).fluxWeighted};
  }

  radiosity::Scene scene_;
  radiosity::Discretization fine_;
  std::vector<glm::dvec3> truth_;
};

/// The number of elements of the curve at an error; 0 if it does not reach the error.
double elementsAt(const std::vector<Point>& curve, double error) {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const Point &a = curve[i - 1], &b = curve[i];
    if (b.error > error || a.error < error) continue;
    const double part = std::log(error / a.error) / std::log(b.error / a.error);
    return a.elements * std::pow(b.elements / a.elements, part);
  }
  return 0;
}

}  // namespace

int main() {
  const Curve curve;
  std::vector<Point> uniform;
  for (int texels = 4; texels <= finestTexels; texels *= 2) {
    uniform.push_back(curve.uniform(texels));
    std::printf("uniform %2d   %6.0f elements, error %.5f\n", texels, uniform.back().elements, uniform.back().error);
    std::fflush(stdout);
  }
  for (const double tolerance : {1e-3, 3e-4, 1e-4, 3e-5}) {
    const Point point = curve.adaptive(tolerance);
    const double equal = elementsAt(uniform, point.error);
    std::printf("adaptive %.0e %6.0f elements, error %.5f, of equal ones %6.0f: %.2f of them\n", tolerance,
                point.elements, point.error, equal, point.elements / equal);
    std::fflush(stdout);
  }
}
