#include "radiosity/form_factors/projected_form_factors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "radiosity/form_factors/level_of_detail.h"
#include "radiosity/geometry/tangent_along.h"
#include "radiosity/projection/parallel_view.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

/// The number of pixels in which each of a row's elements is seen; `buffers` hold the whole faces of the projection.
std::vector<std::uint32_t> pixelsOf(const FormFactorRow& row, const Discretization& discretization,
                                    const IdLayout& layout, const Projection& projection,
                                    std::span<const raster::ItemBuffer> buffers) {
  std::vector<std::uint32_t> pixels(row.elements.size());
  for (std::size_t face = 0; face < buffers.size(); ++face) {
    const std::vector<std::uint64_t>& before = projection.sharesBefore[projection.faces[face].shares];
    for (std::size_t i = 0; i + 1 < before.size(); ++i) {
      const auto element = elementOf(discretization, layout, buffers[face].ids[i]);
      if (before[i] == before[i + 1] || !element) continue;
      const auto place = std::lower_bound(row.elements.begin(), row.elements.end(), *element);
      ++pixels[static_cast<std::size_t>(place - row.elements.begin())];
    }
  }
  return pixels;
}

/// A cone from a lamp: its axis, and the tangent of its half-angle, which is infinite from a right angle on.
struct Cone {
  glm::dvec3 axis;
  double tangent;
};

constexpr double wide = std::numeric_limits<double>::infinity();

/// The light of a lamp. The axis of one that shines everywhere lies along no edge of usual scenes, whose elements would
/// end along rows of pixels.
Cone coneOf(const Lamp& lamp) {
  if (!lamp.cone) return {glm::normalize(glm::dvec3(1, 2, 4)), wide};
  const double cosine = lamp.cone->outerCosine;
  return {lamp.cone->axis, cosine > 0 ? std::sqrt(1 - cosine * cosine) / cosine : wide};
}

/// The scene, all of whose triangles are in boxes.
Cone coneAround(std::span<const SpaceBox> boxes, const Lamp& lamp) {
  SpaceBox all = boxes.front();
  for (const SpaceBox& box : boxes) all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
  const double radius = 0.5 * glm::length(all.high - all.low);
  const glm::dvec3 way = 0.5 * (all.low + all.high) - lamp.position;
  const double distance = glm::length(way);
  if (distance > farDistance * radius)
    throw raster::InputError(
        "the lamp `" + raster::excerpt(lamp.name) + "` is farther from the scene than a thousand times its radius",
        "replace it by parallel light, or move it nearer");
  return {way / distance, distance > radius ? radius / std::sqrt(distance * distance - radius * radius) : wide};
}

}  // namespace

ProjectedFormFactors::ProjectedFormFactors(const Scene& scene, const Discretization& discretization,
                                           const IdLayout& layout, raster::ItemBufferRenderer& renderer,
                                           const ViewSettings& settings)
    : scene_(scene),
      discretization_(discretization),
      layout_(layout),
      renderer_(renderer),
      settings_(settings),
      boxes_(triangleBoxes(scene)),
      counter_(discretization, layout) {
  if (isSumOfWindows()) sums_ = renderer.makeSums([this] { return counter_.table(); });
}

const Projection& ProjectedFormFactors::projectionAfter(int halvings) {
  const int halved = settings_.resolution >> halvings;
  const int resolution = std::min(settings_.resolution, std::max(smallestResolution, halved + halved % 2));
  if (const auto known = projections_.find(resolution); known != projections_.end()) return known->second;
  const auto made = projections_.emplace(resolution, projectionOf(settings_.projection, resolution)).first;
  if (sums_) weights_[&made->second] = addWeights(made->second);
  return made->second;
}

std::vector<std::size_t> ProjectedFormFactors::addWeights(const Projection& projection) {
  std::vector<std::size_t> tables, ofFaces;
  for (const std::vector<std::uint64_t>& before : projection.sharesBefore) tables.push_back(sums_->addWeights(before));
  if (std::count(tables.begin(), tables.end(), raster::PixelSums::none) > 0) return {};
  for (const ProjectionFace& face : projection.faces) ofFaces.push_back(tables[face.shares]);
  return ofFaces;
}

View ProjectedFormFactors::viewFrom(const ViewPoint& from) {
  const Projection& projection = projectionAfter(from.halvings);
  const glm::dvec3 eye = eyeOver(scene_, from.surface, from.point);
  View view{&projection, {}, skippedTriangles(scene_, boxes_, from.surface, from.point), from.area};
  view.faces = facesOver(projection.faces, eye - scene_.origin, from.point.normal, from.up,
                         nearDistance(scene_, boxes_, eye, view.skipped, projection.squaredReach));
  return view;
}

std::vector<ViewPoint> ProjectedFormFactors::pointsOfPatch(const Patch& patch) const {
  std::vector<ViewPoint> points;
  const auto add = [&](const SurfacePoint& point, double area) {
    const glm::dvec3 up = upOf(settings_.orientation, point.normal, patch.turn, static_cast<int>(points.size()));
    points.push_back({patch.surface, point, up, patch.halvings, area});
  };
  if (patch.points > 1)
    for (const ShootingBlock& block : shootingBlocks(scene_, discretization_, patch)) add(block.centre, block.area);
  // For a texel with almost no area, rounding may leave no block with area.
  if (points.empty()) add(patchCentre(scene_, discretization_, patch), patch.area);
  return points;
}

std::vector<View> ProjectedFormFactors::viewsOfPatch(const Patch& patch) {
  std::vector<View> views;
  for (const ViewPoint& point : pointsOfPatch(patch)) views.push_back(viewFrom(point));
  return views;
}

FormFactorRow ProjectedFormFactors::ofView(const View& view) { return std::move(ofViews({&view, 1}).front()); }

/// Views of projections without weights, such as those of lamps, are drawn and summed here.
std::vector<FormFactorRow> ProjectedFormFactors::ofViews(std::span<const View> views) {
  std::vector<FormFactorRow> rows(views.size());
  std::vector<std::size_t> places;
  std::vector<raster::SummedView> summed;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const auto weights = weights_.find(views[v].projection);
    if (weights == weights_.end() || weights->second.empty()) {
      rows[v] = drawnRow(views[v]);
    } else {
      places.push_back(v);
      summed.push_back({views[v].faces, weights->second, views[v].skipped});
    }
  }
  if (summed.empty()) return rows;
  std::vector<raster::SlotSums> sums = sums_->sum(summed);
  for (std::size_t s = 0; s < sums.size(); ++s) {
    rows[places[s]] = counter_.rowOf(std::move(sums[s]));
    rows[places[s]].background += wholeShare - views[places[s]].projection->captured;
  }
  return rows;
}

FormFactorRow ProjectedFormFactors::drawnRow(const View& view) {
  FormFactorRow row = ofWindows(view, wholeFaces(*view.projection));
  if (settings_.pixelsPerElement > 0) {
    const std::vector<std::uint32_t> pixels = pixelsOf(row, discretization_, layout_, *view.projection, buffers_);
    row = withCoarserMaps(discretization_, row, pixels, settings_.pixelsPerElement);
  }
  row.background += wholeShare - view.projection->captured;
  return row;
}

FormFactorRow ProjectedFormFactors::ofWindows(const View& view, std::span<const Window> windows) {
  std::vector<raster::Face> faces;
  for (const Window& window : windows) {
    faces.push_back(view.faces[window.face]);
    faces.back().scissor = window.scissor;
  }
  return counter_.rowOf(*view.projection, [&](const AddWindow& add) {
    renderer_.draw(faces, view.skipped, buffers_, [&](std::size_t w) { add(windows[w], buffers_[w]); });
  });
}

FormFactorRow ProjectedFormFactors::from(std::uint32_t surface, const SurfacePoint& point) {
  return ofView(viewFrom({surface, point}));
}

FormFactorRow ProjectedFormFactors::ofPatch(const Patch& patch) { return ofPoints(pointsOfPatch(patch)); }

FormFactorRow ProjectedFormFactors::ofLamp(const Lamp& lamp, std::uint32_t number) {
  constexpr int finer = 4, finest = 2048;
  const Cone light = coneOf(lamp), scene = coneAround(boxes_.boxes, lamp);
  const bool isNarrower = scene.tangent < std::min(light.tangent, widestLampFace);
  const Cone& drawn = isNarrower ? scene : light;
  // The first turns have the slopes 0, 2 and 1/2, along which samples repeat.
  const glm::dvec3 up = upOf(settings_.orientation, drawn.axis, number + 4, 0), y = tangentAlong(drawn.axis, up),
                   x = glm::cross(y, drawn.axis);
  std::optional<LampCone> cone = lamp.cone;
  if (cone) cone->axis = glm::dvec3(glm::dot(x, cone->axis), glm::dot(y, cone->axis), glm::dot(drawn.axis, cone->axis));
  const Projection projection =
      lampProjection(std::min(finer * settings_.resolution, finest), cone, drawn.tangent, !isNarrower);
  View view{&projection, {}, trianglesFacingAway(scene_, lamp.position, true)};
  view.faces = facesOver(projection.faces, lamp.position - scene_.origin, drawn.axis, up,
                         nearDistance(scene_, boxes_, lamp.position, view.skipped, projection.squaredReach));
  return ofView(view);
}

FormFactorRow ProjectedFormFactors::ofPoints(std::span<const ViewPoint> points) {
  const std::vector<ViewPoint> all(points.begin(), points.end());
  return std::move(ofManyPoints({&all, 1}).front());
}

std::vector<FormFactorRow> ProjectedFormFactors::ofManyPoints(std::span<const std::vector<ViewPoint>> points) {
  std::vector<View> views;
  for (const std::vector<ViewPoint>& ofRow : points)
    for (const ViewPoint& point : ofRow) views.push_back(viewFrom(point));
  std::vector<FormFactorRow> rows, ofViews = this->ofViews(views);
  auto next = ofViews.begin();
  for (const std::vector<ViewPoint>& ofRow : points) {
    std::vector<WeightedRow> weighted;
    for (const ViewPoint& point : ofRow) weighted.push_back({std::move(*next++), point.area});
    rows.push_back(weighted.size() == 1 ? std::move(weighted.front().row) : meanOf(weighted));
  }
  return rows;
}

}  // namespace hemitex::radiosity
