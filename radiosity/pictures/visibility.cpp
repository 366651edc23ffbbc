#include "radiosity/pictures/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hemitex::radiosity {
namespace {

raster::DrawList makeTriangleList(const Scene& scene) {
  raster::DrawList list;
  list.format = *raster::formatNamed("r32ui");
  raster::ItemId number = 0;
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles) {
      list.draws.push_back({.first = 3 * number, .count = 3, .offset = number, .back = {}});
      for (const glm::dvec3& position : triangle.position) {
        list.indices.push_back(static_cast<std::uint32_t>(list.positions.size()));
        list.positions.emplace_back(position - scene.origin);
      }
      ++number;
    }
  list.texcoords.resize(list.positions.size());
  return list;
}

std::vector<raster::ItemId> firstTriangles(const Scene& scene) {
  std::vector<raster::ItemId> first;
  raster::ItemId number = 0;
  for (const Surface& surface : scene.surfaces) {
    first.push_back(number);
    number += static_cast<raster::ItemId>(surface.triangles.size());
  }
  return first;
}

/// The rays of a face's samples, with the numbers that the face was drawn with.
class Rays {
 public:
  /// The direction d of a point (x, y) of the picture plane solves X . d = x, Y . d = y, W . d = 1. By Cramer's rule d
  /// = (x (Y x W) + y (W x X) + X x Y) / det(X, Y, W). The length of d does not matter, but the sign of the determinant
  /// does, because d must point forward.
  explicit Rays(const raster::Face& face) : face_(face) {
    const glm::dvec3 x(face.x), y(face.y), w(face.w);
    const double determinant = raster::determinant(face);
    alongX_ = glm::cross(y, w) / determinant;
    alongY_ = glm::cross(w, x) / determinant;
    forward_ = glm::cross(x, y) / determinant;
  }

  glm::dvec3 eye() const { return glm::dvec3(face_.eye); }

  /// Through the middle of a pixel of the scissor rectangle.
  glm::dvec3 direction(int column, int row) const {
    const double x = (2.0 * (face_.scissor.column + column) + 1) / face_.resolution - 1;
    const double y = (2.0 * (face_.scissor.row + row) + 1) / face_.resolution - 1;
    return x * alongX_ + y * alongY_ + forward_;
  }

 private:
  raster::Face face_;
  glm::dvec3 alongX_, alongY_, forward_;
};

/// Barycentric weights of the intersection of a ray and a triangle's plane. Let a, b, c be the corners relative to the
/// eye. Then the weights are in the ratio of the volumes d . (b x c), d . (c x a), d . (a x b). If rounding in the
/// rasterizer puts a sample beside the triangle, the point is moved to its border. If the triangle is seen edge-on, all
/// its points are equally near.
glm::dvec3 weightsOf(const std::array<glm::dvec3, 3>& corner, const glm::dvec3& eye, const glm::dvec3& direction) {
  const glm::dvec3 a = corner[0] - eye, b = corner[1] - eye, c = corner[2] - eye;
  const glm::dvec3 volumes(glm::dot(direction, glm::cross(b, c)), glm::dot(direction, glm::cross(c, a)),
                           glm::dot(direction, glm::cross(a, b)));
  const glm::dvec3 weights = glm::max(volumes / (volumes.x + volumes.y + volumes.z), glm::dvec3(0.0));
  const double sum = weights.x + weights.y + weights.z;
  return sum > 0 && std::isfinite(sum) ? weights / sum : glm::dvec3(1.0 / 3);
}

}  // namespace

TriangleView::TriangleView(const Scene& scene)
    : scene_(scene), firstTriangle_(firstTriangles(scene)), renderer_(makeTriangleList(scene)) {}

Visible TriangleView::locate(raster::ItemId triangle) const {
  const auto next = std::upper_bound(firstTriangle_.begin(), firstTriangle_.end(), triangle);
  const auto surface = static_cast<std::uint32_t>(next - firstTriangle_.begin() - 1);
  return {.surface = surface, .triangle = triangle - firstTriangle_[surface]};
}

std::vector<std::optional<Visible>> TriangleView::see(const Camera& camera, int width, int height) {
  return see(cameraFace(scene_, camera, width, height), trianglesFacingAway(scene_, camera.eye));
}

std::vector<std::optional<Visible>> TriangleView::seeBothSides(const Camera& camera, int width, int height) {
  return see(cameraFace(scene_, camera, width, height), {});
}

std::vector<std::optional<Visible>> TriangleView::see(const raster::Face& face,
                                                      const std::vector<std::uint32_t>& skipped) {
  const int width = face.scissor.width, height = face.scissor.height;
  const raster::ItemBuffer buffer = render(renderer_, {&face, 1}, skipped).front();
  const raster::ItemId background = raster::backgroundId(renderer_.drawList().format);
  const Rays rays(face);
  std::vector<std::optional<Visible>> samples(buffer.ids.size());
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const auto pixel =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
      if (buffer.ids[pixel] == background) continue;
      Visible visible = locate(buffer.ids[pixel]);
      std::array<glm::dvec3, 3> corner = scene_.surfaces[visible.surface].triangles[visible.triangle].position;
      for (glm::dvec3& position : corner) position -= scene_.origin;
      visible.weights = weightsOf(corner, rays.eye(), rays.direction(column, row));
      const auto fromTop = static_cast<std::size_t>(height - 1 - row);
      samples[fromTop * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)] = visible;
    }
  return samples;
}

std::vector<std::uint32_t> trianglesFacingAway(const Scene& scene, const glm::dvec3& eye) {
  std::vector<std::uint32_t> away;
  std::uint32_t number = 0;
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles) {
      const auto& [a, b, c] = triangle.position;
      if (glm::dot(glm::cross(b - a, c - a), eye - a) < 0) away.push_back(number);
      ++number;
    }
  return away;
}

std::vector<std::optional<Visible>> visibleSamples(const Scene& scene, const Camera& camera, int width, int height) {
  return TriangleView(scene).see(camera, width, height);
}

}  // namespace hemitex::radiosity
