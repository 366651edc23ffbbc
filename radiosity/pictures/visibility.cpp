#include "radiosity/pictures/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/projection/patch_view.h"

namespace hemitex::radiosity {
namespace {

constexpr const char* numberFormat = "r32ui";

raster::DrawList makeTriangleList(const Scene& scene) {
  raster::DrawList list;
  list.format = *raster::formatNamed(numberFormat);
  raster::ItemId number = 0;
  HoleMaps holes(scene);
  forEachPlace(scene, [&](const TrianglePlace& place) {
    const Triangle& triangle = scene.surfaces[place.surface].triangles[place.triangle];
    appendDraw(list, {&triangle, 1}, scene.instances[place.instance], scene.origin).offset = number++;
    holes.cut(list, list.draws.size() - 1, scene.surfaces[place.surface], {&triangle, 1},
              scene.instances[place.instance]);
  });
  return list;
}

/// Returns a function of the directions of rays through the middles of pixels (column, row) of a face's scissor
/// rectangle, with the numbers that the face was drawn with.
///
/// The direction d of a point (x, y) of the picture plane solves X . d = x, Y . d = y, W . d = 1. By Cramer's rule d
/// = (x (Y x W) + y (W x X) + X x Y) / det(X, Y, W). The length of d does not matter, but the sign of the determinant
/// does, because d must point forward.
auto directionsOf(const raster::Face& face) {
  const glm::dvec3 x(face.x), y(face.y), w(face.w);
  const double determinant = raster::determinant(face);
  const glm::dvec3 alongX = glm::cross(y, w) / determinant, alongY = glm::cross(w, x) / determinant,
                   forward = glm::cross(x, y) / determinant;
  return [=](int column, int row) {
    return ((2.0 * (face.scissor.column + column) + 1) / face.resolution - 1) * alongX +
           ((2.0 * (face.scissor.row + row) + 1) / face.resolution - 1) * alongY + forward;
  };
}

/// Gives barycentric weights of the intersection of a ray and a triangle's plane. Let a, b, c be the corners relative
/// to the eye. Then the weights are in the ratio of the volumes d . (b x c), d . (c x a), d . (a x b). If rounding in
/// the rasterizer puts a sample beside the triangle, the point is moved to its border. If the triangle is seen edge-on,
/// all its points are equally near.
class WeightsInTriangle {
 public:
  WeightsInTriangle() = default;
  WeightsInTriangle(const Scene& scene, const TrianglePlace& place, const glm::dvec3& eye) {
    std::array<glm::dvec3, 3> corner = scene.surfaces[place.surface].triangles[place.triangle].position;
    for (glm::dvec3& position : corner) position = scene.instances[place.instance](position) - scene.origin - eye;
    const auto& [a, b, c] = corner;
    normals_ = {glm::cross(b, c), glm::cross(c, a), glm::cross(a, b)};
  }

  glm::dvec3 along(const glm::dvec3& direction) const {
    const glm::dvec3 volumes(glm::dot(direction, normals_[0]), glm::dot(direction, normals_[1]),
                             glm::dot(direction, normals_[2]));
    const glm::dvec3 weights = glm::max(volumes / (volumes.x + volumes.y + volumes.z), glm::dvec3(0.0));
    const double sum = weights.x + weights.y + weights.z;
    return sum > 0 && std::isfinite(sum) ? weights / sum : glm::dvec3(1.0 / 3);
  }

 private:
  std::array<glm::dvec3, 3> normals_{};  ///< of the planes through the eye and an edge
};

}  // namespace

TriangleView::TriangleView(const Scene& scene) : scene_(scene), renderer_(makeTriangleList(scene)) {
  forEachPlace(scene, [&](const TrianglePlace& place) { places_.push_back(place); });
}

TriangleSamples TriangleView::see(const Camera& camera, int width, int height, std::span<const std::uint32_t> skipped,
                                  const glm::vec2& shift) {
  raster::Face face = cameraFace(scene_, camera, width, height);
  // A point at x is drawn at x less the shift, and so on. The distance of samples is 2 / resolution.
  face.x -= 2 * shift.x / static_cast<float>(face.resolution) * face.w;
  face.y -= 2 * shift.y / static_cast<float>(face.resolution) * face.w;
  raster::draw(renderer_, {&face, 1}, skipped, buffers_);
  return {scene_, places_, face, buffers_.front()};
}

std::vector<std::optional<Visible>> TriangleSamples::row(int row, std::span<const std::uint8_t> wanted) const {
  const auto width = static_cast<std::size_t>(numbers_.width);
  const int drawnRow = numbers_.height - 1 - row;
  const std::span numbers = std::span(numbers_.ids).subspan(static_cast<std::size_t>(drawnRow) * width, width);
  const raster::ItemId background = raster::backgroundId(*raster::formatNamed(numberFormat));
  const auto direction = directionsOf(face_);
  std::vector<std::optional<Visible>> points(width);
  raster::ItemId last = background;
  WeightsInTriangle weights;
  for (std::size_t i = 0; i < width; ++i) {
    if (numbers[i] == background || (!wanted.empty() && wanted[i] == 0)) continue;
    const TrianglePlace& place = places_[numbers[i]];
    if (std::exchange(last, numbers[i]) != numbers[i]) weights = {scene_, place, glm::dvec3(face_.eye)};
    points[i] = {place.surface, place.triangle, weights.along(direction(static_cast<int>(i), drawnRow)),
                 place.instance};
  }
  return points;
}

std::vector<std::optional<Visible>> allPoints(const TriangleSamples& samples) {
  std::vector<std::optional<Visible>> points;
  for (int row = 0; row < samples.rows(); ++row) {
    const std::vector<std::optional<Visible>> ofRow = samples.row(row);
    points.insert(points.end(), ofRow.begin(), ofRow.end());
  }
  return points;
}

glm::dvec3 positionOf(const Scene& scene, const Visible& visible) {
  const auto& [a, b, c] = scene.surfaces[visible.surface].triangles[visible.triangle].position;
  const glm::dvec3& weight = visible.weights;
  return scene.instances[visible.instance](weight.x * a + weight.y * b + weight.z * c);
}

std::vector<std::optional<Visible>> visibleSamples(const Scene& scene, const Camera& camera, int width, int height) {
  TriangleView view(scene);
  return allPoints(view.see(camera, width, height, trianglesFacingAway(scene, camera.eye)));
}

std::vector<bool> seenSurfaces(const Scene& scene, const Camera& camera, int width, int height) {
  constexpr double minOfArea = 1.0 / 8, minOfPicture = 1.0 / 2;
  const glm::dvec3 forward = axesOf(camera).forward;
  const double pixelSide = 2 * tangentOfDegrees(camera.fov / 2) / height;  // at distance 1
  std::vector<double> shown(scene.surfaces.size());                        // area
  std::vector<int> pixels(scene.surfaces.size());
  for (const std::optional<Visible>& visible : visibleSamples(scene, camera, width, height)) {
    if (!visible) continue;
    const Triangle triangle = placed(scene, {visible->instance, visible->surface, visible->triangle});
    const glm::dvec3 ray = positionOf(scene, *visible) - camera.eye;
    // At depth z the pixel is z pixelSide wide and high. Its projection along the ray to the surface is larger by z
    // over the distance of the eye from the plane of the surface.
    const double z = glm::dot(ray, forward), side = z * pixelSide;
    shown[visible->surface] += std::min(side * side * z / std::abs(glm::dot(ray, normal(triangle))), area(triangle));
    ++pixels[visible->surface];
  }
  std::vector<bool> seen;
  for (std::size_t s = 0; s < shown.size(); ++s) {
    const double all = area(scene.surfaces[s]);
    seen.push_back(shown[s] >= minOfArea * all || pixels[s] >= minOfPicture * width * height);
  }
  return seen;
}

}  // namespace hemitex::radiosity
