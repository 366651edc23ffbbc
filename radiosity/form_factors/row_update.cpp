#include "radiosity/form_factors/row_update.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "radiosity/index_maps/scene_draw_list.h"

namespace hemitex::radiosity {
namespace {

bool isSameView(const raster::Face& a, const raster::Face& b) {
  return a.eye == b.eye && a.x == b.x && a.y == b.y && a.w == b.w && a.nearDistance == b.nearDistance;
}

bool isEmpty(const raster::Scissor& scissor) { return scissor.width == 0 || scissor.height == 0; }

/// The smallest rectangle around two others.
raster::Scissor around(const raster::Scissor& a, const raster::Scissor& b) {
  if (isEmpty(a)) return b;
  if (isEmpty(b)) return a;
  const int column = std::min(a.column, b.column), row = std::min(a.row, b.row);
  return {column, row, std::max(a.column + a.width, b.column + b.width) - column,
          std::max(a.row + a.height, b.row + b.height) - row};
}

/// `known` is the row of the view before, if known.
RowChange changeOfView(SceneChange& change, const View& before, const View& after, const FormFactorRow* known) {
  const std::vector<Window> windows = windowsOf(change, after);
  const bool sameViews = areSameViews(before, after);
  if (sameViews && windows.empty()) return {};
  if (sameViews) return {change.rowsBefore.ofWindows(before, windows), change.rowsAfter.ofWindows(after, windows)};
  return {known != nullptr ? *known : change.rowsBefore.ofView(before), change.rowsAfter.ofView(after), true};
}

}  // namespace

bool areSameViews(const View& a, const View& b) {
  return std::equal(a.faces.begin(), a.faces.end(), b.faces.begin(), b.faces.end(), isSameView);
}

std::vector<Window> windowsOf(const SceneChange& change, const View& view) {
  std::vector<Window> windows;
  for (std::size_t face = 0; face < view.faces.size(); ++face) {
    const raster::Scissor window =
        around(change.gone.windowOf(view.faces[face]), change.come.windowOf(view.faces[face]));
    if (!isEmpty(window)) windows.push_back({face, window});
  }
  return windows;
}

ChangedSurfaces::ChangedSurfaces(const Scene& scene, const std::vector<bool>& isChanged)
    : low_(std::numeric_limits<double>::infinity()), high_(-std::numeric_limits<double>::infinity()) {
  for (const Instance& instance : scene.instances)
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
      if (!isChanged[s]) continue;
      appendDraw(list_, scene.surfaces[s].triangles, instance, scene.origin);
      for (const Triangle& triangle : scene.surfaces[s].triangles)
        for (const glm::dvec3& corner : triangle.position) {
          low_ = glm::min(low_, instance(corner));
          high_ = glm::max(high_, instance(corner));
        }
    }
  clusters_ = raster::clustersOf(list_);
}

double ChangedSurfaces::largestShare(const SurfacePoint& point, double pixelAngle) const {
  if (empty()) return 0;
  const glm::dvec3 centre = 0.5 * (low_ + high_) - point.position, half = 0.5 * (high_ - low_);
  if (glm::dot(point.normal, centre) + glm::dot(glm::abs(point.normal), half) <= 0) return 0;
  const double radius = glm::length(half), distance = glm::length(centre);
  if (distance <= radius) return 1;
  const double sine = radius / distance + pixelAngle;
  return std::min(1.0, sine * sine);
}

double ChangedSurfaces::distanceFrom(const glm::dvec3& point) const {
  return glm::length(glm::max(glm::max(low_ - point, point - high_), 0.0));
}

raster::Scissor ChangedSurfaces::windowOf(const raster::Face& face) const {
  return raster::coveredBounds(list_, clusters_, face);
}

double pixelAngle(const Projection& projection) {
  double largest = 0;
  for (const ProjectionFace& face : projection.faces) {
    // The sides of a pixel on the picture plane; its distance is at least 1 / |w|.
    const double size = 2 * glm::length(face.w) / face.resolution;
    largest = std::max(largest, size * (1 / glm::length(face.x) + 1 / glm::length(face.y)));
  }
  return largest;
}

RowChange changeOf(SceneChange& change, const Patch& patchBefore, const Patch& patchAfter, const FormFactorRow* known) {
  const std::vector<View> before = change.rowsBefore.viewsOfPatch(patchBefore);
  const std::vector<View> after = change.rowsAfter.viewsOfPatch(patchAfter);
  if (before.size() != after.size() || !change.rowsAfter.isSumOfWindows())
    return {known != nullptr ? *known : change.rowsBefore.ofPatch(patchBefore), change.rowsAfter.ofPatch(patchAfter),
            true};
  if (after.size() == 1) return changeOfView(change, before.front(), after.front(), known);
  std::vector<RowChange> views;
  std::vector<WeightedRow> gone, come;
  double area = 0;
  for (std::size_t view = 0; view < after.size(); ++view) {
    area += after[view].area;
    views.push_back(changeOfView(change, before[view], after[view], nullptr));
    if (views.back().isNothing()) continue;
    gone.push_back({views.back().before, after[view].area});
    come.push_back({views.back().after, after[view].area});
  }
  if (gone.empty()) return {};
  return {
      .before = partOfMean(gone, area), .after = partOfMean(come, area), .isRounded = true, .views = std::move(views)};
}

}  // namespace hemitex::radiosity
