#include "radiosity/pictures/default_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "radiosity/discretization/patch_points.h"
#include "radiosity/pictures/visibility.h"

namespace hemitex::radiosity {
namespace {

constexpr int viewWidth = 64;
constexpr int viewHeight = 48;
constexpr double viewFov = 60;

template <typename Visit>
void forEachTriangle(const Scene& scene, Visit visit) {
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles) visit(triangle);
}

/// The two axes other than `up`.
std::array<int, 2> levelAxes(int up) { return {0, 3 - up}; }

glm::dvec3 axisVector(int axis) {
  glm::dvec3 vector(0.0);
  vector[axis] = 1;
  return vector;
}

double crossSection(const Bounds& bounds, int up) {
  const glm::dvec3 size = bounds.high - bounds.low;
  return size[0] * size[3 - up];
}

/// Its length is the area of the triangle; its components are the areas of the projections along the axes.
glm::dvec3 areaVector(const Triangle& triangle) {
  const auto& [a, b, c] = triangle.position;
  return 0.5 * glm::cross(b - a, c - a);
}

/// The largest area of fronts that face up to within 45 degrees, at about one height in the lower half of the scene.
struct Floor {
  int up = 1;              ///< axis
  double area = 0;         ///< projected along `up`
  glm::dvec3 middle{0.0};  ///< mean over the area
  Bounds bounds;           ///< undefined if the area is 0
};

Floor floorAlong(const Scene& scene, const Bounds& bounds, int up) {
  constexpr int levels = 16;
  const double bottom = bounds.low[up], height = bounds.high[up] - bottom;
  const auto levelOf = [&](const Triangle& triangle) {
    if (!(height > 0)) return 0;
    return std::clamp(static_cast<int>(levels * ((middleOf(triangle)[up] - bottom) / height)), 0, levels - 1);
  };
  const auto upwardArea = [&](const Triangle& triangle) {
    const glm::dvec3 area = areaVector(triangle);
    return area[up] > 0.7 * glm::length(area) ? area[up] : 0.0;
  };

  std::array<double, levels> areas{};
  forEachTriangle(scene, [&](const Triangle& t) { areas[static_cast<std::size_t>(levelOf(t))] += upwardArea(t); });
  // Sums two levels at a time, because a floor that is not flat may lie in both.
  int best = 0;
  const auto areaAt = [&](int level) {
    return areas[static_cast<std::size_t>(level)] + areas[static_cast<std::size_t>(level) + 1];
  };
  for (int level = 1; level < levels / 2; ++level)
    if (areaAt(level) > areaAt(best)) best = level;

  Floor floor;
  floor.up = up;
  forEachTriangle(scene, [&](const Triangle& triangle) {
    const double area = upwardArea(triangle);
    if (area == 0 || levelOf(triangle) < best || levelOf(triangle) > best + 1) return;
    floor.area += area;
    floor.middle += area * middleOf(triangle);
    floor.bounds.include(triangle);
  });
  if (floor.area > 0) floor.middle /= floor.area;
  return floor;
}

/// The floor along the axis that points up (see upAxis).
Floor floorOf(const Scene& scene, const Bounds& bounds, std::optional<int> up) {
  if (const std::optional<int> stated = up ? up : scene.up) return floorAlong(scene, bounds, *stated);
  const Floor y = floorAlong(scene, bounds, 1), z = floorAlong(scene, bounds, 2);
  const double sectionY = crossSection(bounds, 1), sectionZ = crossSection(bounds, 2);
  const bool isFlat = !(sectionY > 0 && sectionZ > 0);
  return !isFlat && z.area > 0.5 * sectionZ && z.area / sectionZ > 2 * y.area / sectionY ? z : y;
}

/// The height of the free space above the floor: up to the height at which half of the floor lies below fronts that
/// face down, or up to the top of the scene. Lower objects count as furniture.
double freeHeight(const Scene& scene, const Bounds& bounds, const Floor& floor) {
  const double top = bounds.high[floor.up] - floor.middle[floor.up];
  std::vector<std::pair<double, double>> ceilings;  // height above the floor, area
  forEachTriangle(scene, [&](const Triangle& triangle) {
    const double height = middleOf(triangle)[floor.up] - floor.middle[floor.up];
    const double area = -areaVector(triangle)[floor.up];
    if (area > 0 && height > 0.2 * top) ceilings.emplace_back(height, area);
  });
  std::sort(ceilings.begin(), ceilings.end());
  double covered = 0;
  for (const auto& [height, area] : ceilings)
    if ((covered += area) >= 0.5 * floor.area) return height;
  return top;
}

/// Views at eye height, from places along the border of the floor towards its middle, slightly downwards.
std::vector<Camera> standingCameras(const Floor& floor, double height) {
  constexpr std::array<double, 5> places{0.1, 0.3, 0.5, 0.7, 0.9};
  const auto [u, v] = levelAxes(floor.up);
  const glm::dvec3 low = floor.bounds.low, size = floor.bounds.high - low;
  const double eyeHeight = 0.6 * std::min(height, 1.5 * std::sqrt(size[u] * size[v]));
  std::vector<Camera> cameras;
  for (std::size_t j = 0; j < places.size(); ++j)
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (i % 4 != 0 && j % 4 != 0) continue;
      glm::dvec3 eye, target = floor.middle;
      eye[u] = low[u] + places[i] * size[u];
      eye[v] = low[v] + places[j] * size[v];
      eye[floor.up] = floor.middle[floor.up] + eyeHeight;
      target[floor.up] = eye[floor.up];
      if (glm::distance(eye, target) < 0.1 * glm::length(size)) continue;
      target[floor.up] -= std::min(0.35 * eyeHeight, 0.4 * glm::distance(eye, target));
      cameras.push_back({eye, target, axisVector(floor.up), viewFov});
    }
  return cameras;
}

/// A view from outside against `direction` towards the middle of the bounds, as near as all of them are visible.
Camera outsideCamera(const Bounds& bounds, const glm::dvec3& direction, int up) {
  const glm::dvec3 middle = 0.5 * (bounds.low + bounds.high), half = 0.5 * (bounds.high - bounds.low);
  const glm::dvec3 backward = glm::normalize(direction);
  const glm::dvec3 right = glm::normalize(glm::cross(axisVector(up), backward)), upward = glm::cross(backward, right);
  const double tangent = tangentOfDegrees(viewFov / 2);
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p = half * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const double side =
        std::max(std::fabs(glm::dot(upward, p)), std::fabs(glm::dot(right, p)) * viewHeight / viewWidth);
    distance = std::max(distance, 1.1 * side / tangent + glm::dot(backward, p));
  }
  return {middle + distance * backward, middle, axisVector(up), viewFov};
}

/// Views through each of the four sides.
std::vector<Camera> sideCameras(const Bounds& bounds, int up) {
  std::vector<Camera> cameras;
  for (const int axis : levelAxes(up))
    for (const double sign : {1.0, -1.0}) cameras.push_back(outsideCamera(bounds, sign * axisVector(axis), up));
  return cameras;
}

/// Views from four corners of a cube, above (`side` 1) or below (-1).
std::vector<Camera> cornerCameras(const Bounds& bounds, int up, double side) {
  const auto [u, v] = levelAxes(up);
  std::vector<Camera> cameras;
  for (const double b : {1.0, -1.0})
    for (const double a : {1.0, -1.0})
      cameras.push_back(outsideCamera(bounds, a * axisVector(u) + b * axisVector(v) + side * axisVector(up), up));
  return cameras;
}

/// Scores views of one scene.
class ViewScores {
 public:
  ViewScores(const Scene& scene, const Floor& floor, double height) : scene_(scene), view_(scene), up_(floor.up) {
    if (floor.area == 0) return;
    const auto [u, v] = levelAxes(floor.up);
    const glm::dvec3 size = floor.bounds.high - floor.bounds.low;
    near_ = std::min(0.15 * std::sqrt(size[u] * size[u] + size[v] * size[v]), 0.5 * height);
    obstacleHeight_ = floor.middle[floor.up] + 0.1 * height;
  }

  struct View {
    double score = 0;  ///< visible area, reduced where backs or near objects fill the picture
    double sky = 0;    ///< share of the picture without surfaces
  };

  /// The score is the sum, over surfaces, of the square root of the visible area. Of views with equal areas, the one
  /// that shows more surfaces has a larger score.
  ///
  /// A pixel of area a on the plane w = 1, seen at v = P - eye, covers a w^3 / |n . v| of a surface with unit normal n
  /// at P. Here w is the depth of v; the factor w^2 is for the distance, and w / |n . v| for the slant. The sum over
  /// the pixels of one triangle is at most the triangle's area, which limits walls at grazing angles.
  View operator()(const Camera& camera) {
    const double pixelSide = 2 * tangentOfDegrees(camera.fov / 2) / viewHeight;
    const glm::dvec3 forward = glm::normalize(camera.lookAt - camera.eye);
    SeenAreas seen;
    int sky = 0, backs = 0, near = 0, nearMiddle = 0;
    const auto samples = allPoints(view_.see(camera, viewWidth, viewHeight, {}));
    for (int row = 0; row < viewHeight; ++row)
      for (int column = 0; column < viewWidth; ++column) {
        const std::optional<Visible>& sample = samples[static_cast<std::size_t>(row * viewWidth + column)];
        if (!sample) {
          ++sky;
          continue;
        }
        const Triangle triangle = placed(scene_, {sample->instance, sample->surface, sample->triangle});
        const glm::dvec3 v = positionOf(scene_, *sample) - camera.eye;
        if (glm::length(v) < near_ && (camera.eye + v)[up_] > obstacleHeight_) {
          ++near;
          if (isMiddle(row, viewHeight) && isMiddle(column, viewWidth)) ++nearMiddle;
        }
        const double slant = -glm::dot(normal(triangle), v);
        if (slant <= 0) {
          ++backs;
          continue;
        }
        const double w = glm::dot(forward, v);
        seen[{sample->surface, sample->triangle}] += pixelSide * pixelSide * w * w * w / slant;
      }
    const double pixels = viewWidth * viewHeight;
    const double clear = (1 - backs / pixels) * (1 - near / pixels) * (nearMiddle > 0 ? 0.1 : 1.0);
    return {sumOfRoots(seen) * clear * clear, sky / pixels};
  }

 private:
  using SeenAreas = std::map<std::pair<std::uint32_t, std::uint32_t>, double>;  ///< by surface and triangle

  double sumOfRoots(const SeenAreas& seen) const {
    std::map<std::uint32_t, double> areas;  // by surface
    for (const auto& [place, estimate] : seen)
      areas[place.first] += std::min(estimate, area(scene_.surfaces[place.first].triangles[place.second]));
    double sum = 0;
    for (const auto& [surface, area] : areas) sum += std::sqrt(area);
    return sum;
  }

  static bool isMiddle(int index, int size) { return index >= size / 4 && index < size - size / 4; }

  const Scene& scene_;
  TriangleView view_;
  int up_;
  double near_ = 0;  ///< minimum distance of objects
  double obstacleHeight_ =
      0;  ///< height above the lowest points below which near objects, such as the floor, are ignored
};

struct Choice {
  Camera camera;
  double score = 0;
};

void chooseBest(ViewScores& scoreOf, const std::vector<Camera>& cameras, Choice& best) {
  for (const Camera& camera : cameras) {
    const double score = scoreOf(camera).score;
    if (score > best.score) best = {camera, score};
  }
}

/// The opposite view with the same downward angle.
Camera turnedRound(const Camera& camera) {
  Camera turned = camera;
  turned.lookAt = 2.0 * camera.eye - camera.lookAt;
  turned.lookAt += 2 * glm::dot(camera.lookAt - camera.eye, camera.up) * camera.up;
  return turned;
}

}  // namespace

Camera defaultCamera(const Scene& scene, std::optional<int> up) {
  const Bounds bounds = boundsOf(scene);
  const Floor floor = floorOf(scene, bounds, up);
  const double height = freeHeight(scene, bounds, floor);
  ViewScores scoreOf(scene, floor, height);
  Choice best;
  if (floor.area > 0.25 * crossSection(bounds, floor.up) && height > 0) {
    chooseBest(scoreOf, standingCameras(floor, height), best);
    // In a room there is a wall behind the eye. In an open scene, views from farther away are candidates too.
    if (best.score > 0 && scoreOf(turnedRound(best.camera)).sky <= 0.25) return best.camera;
    chooseBest(scoreOf, sideCameras(bounds, floor.up), best);
  }
  chooseBest(scoreOf, cornerCameras(bounds, floor.up, 1), best);
  if (best.score == 0) chooseBest(scoreOf, cornerCameras(bounds, floor.up, -1), best);
  return best.score > 0 ? best.camera : cornerCameras(bounds, floor.up, 1).front();
}

int upAxis(const Scene& scene, std::optional<int> given) { return floorOf(scene, boundsOf(scene), given).up; }

}  // namespace hemitex::radiosity
