#include "radiosity/gather/gathered_picture.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "radiosity/discretization/element_materials.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/pictures/pictures.h"
#include "radiosity/pictures/visibility.h"
#include "radiosity/textures/texture_filter.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// A visible point in space, with the smooth normal of a curved surface.
struct VisiblePoint {
  Visible visible;
  glm::dvec3 position, normal;
};

/// The pixels of a picture, and what their middles show.
class Pixels {
 public:
  Pixels(const Scene& scene, const Discretization& discretization, const Camera& camera, int width, int height)
      : scene_(scene),
        discretization_(discretization),
        eye_(camera.eye),
        axes_(axesOf(camera)),
        width_(width),
        height_(height),
        side_(2 * tangentOfDegrees(camera.fov / 2) / height),
        normals_(smoothNormals(scene, discretization)) {
    for (const std::optional<Visible>& visible : visibleSamples(scene, camera, width, height))
      points_.push_back(visible ? std::optional(pointOf(*visible)) : std::nullopt);
  }

  /// Row by row from the top; nothing for the background.
  const std::vector<std::optional<VisiblePoint>>& points() const { return points_; }

  VisiblePoint pointOf(const Visible& visible) const {
    const Instance& instance = scene_.instances[visible.instance];
    return {visible, positionOf(scene_, visible), instance.sign * surfacePoint(visible).normal};
  }

  /// Whether two points are of one part of a surface, about as far from the eye: their normals differ by at most 20
  /// degrees, and each is in the plane of the other, up to the side of a pixel there.
  bool areTogether(const VisiblePoint& one, const VisiblePoint& other) const {
    constexpr double minCosine = 0.94;
    if (one.visible.surface != other.visible.surface || one.visible.instance != other.visible.instance) return false;
    if (glm::dot(one.normal, other.normal) < minCosine) return false;
    const glm::dvec3 way = other.position - one.position;
    const double distance = std::max(std::abs(glm::dot(one.normal, way)), std::abs(glm::dot(other.normal, way)));
    return distance <= side_ * depthOf(one.position);
  }

  /// The pixels as texels without light, row by row from the top.
  LitTexels texels() const {
    LitTexels texels;
    texels.columns = width_;
    texels.rows = height_;
    texels.places.resize(points_.size());
    texels.direct = texels.seen = BandTable(points_.size(), bandCount(scene_));
    texels.isBeforeEdge.resize(points_.size());
    for (int row = 0; row < height_; ++row)
      for (int column = 0; column < width_; ++column)
        texels.isBeforeEdge[at(column, row)] = isEdge(column, row, 1, 0) || isEdge(column, row, 0, 1);
    for (int row = 0; row < height_; ++row)
      for (int column = 0; column < width_; ++column)
        if (const auto& point = points_[at(column, row)])
          texels.places[at(column, row)] = placeOf(*point, isInside(column, row));
    return texels;
  }

  /// The place of a point in the first instance, whose light all instances have; of a pixel with its sides, or alone.
  LitPlace placeOf(const VisiblePoint& point, bool isPixel) const {
    LitPlace place{point.visible.surface, surfacePoint(point.visible)};
    if (!isPixel) return place;
    const Instance& instance = scene_.instances[point.visible.instance];
    const glm::dvec3 ray = point.position - eye_;
    const double length = side_ * depthOf(point.position);
    const auto onSurface = [&](const glm::dvec3& axis) {
      const glm::dvec3 along = axis - ray * (glm::dot(point.normal, axis) / glm::dot(point.normal, ray));
      return instance.sign * (length * along);
    };
    place.along1 = onSurface(axes_.right);
    place.along2 = onSurface(axes_.up);
    return place;
  }

  /// The mean of the values of pixels around a point that belong to it, bilinear; nothing if there are none.
  std::optional<glm::dvec3> interpolated(const std::vector<std::optional<glm::dvec3>>& values,
                                         const VisiblePoint& point) const {
    const glm::dvec3 ray = point.position - eye_;
    const double unit = side_ * depthOf(point.position);
    const glm::dvec2 place(0.5 * width_ + glm::dot(axes_.right, ray) / unit - 0.5,
                           0.5 * height_ - glm::dot(axes_.up, ray) / unit - 0.5);
    const int left = static_cast<int>(std::floor(place.x)), top = static_cast<int>(std::floor(place.y));
    glm::dvec3 sum(0);
    double weights = 0;
    for (int row = std::max(top, 0); row <= std::min(top + 1, height_ - 1); ++row)
      for (int column = std::max(left, 0); column <= std::min(left + 1, width_ - 1); ++column) {
        const std::size_t pixel = at(column, row);
        if (!points_[pixel] || !values[pixel] || !areTogether(point, *points_[pixel])) continue;
        // A sample in the middle of one pixel has at least a little of its neighbours, should that be of another part.
        const double weight = std::max((1 - std::abs(place.x - column)) * (1 - std::abs(place.y - row)), 1e-6);
        sum += weight * *values[pixel];
        weights += weight;
      }
    return weights > 0 ? std::optional(sum / weights) : std::nullopt;
  }

 private:
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column);
  }

  double depthOf(const glm::dvec3& position) const { return glm::dot(axes_.forward, position - eye_); }

  /// Whether the pixel beside another is of another part. No edge is at the border of the picture.
  bool isEdge(int column, int row, int right, int down) const {
    if (column + right < 0 || column + right >= width_ || row + down < 0 || row + down >= height_) return false;
    const auto &one = points_[at(column, row)], &other = points_[at(column + right, row + down)];
    return one && other ? !areTogether(*one, *other) : one.has_value() != other.has_value();
  }

  /// Whether all of a pixel shows a plane.
  bool isInside(int column, int row) const {
    if (scene_.surfaces[points_[at(column, row)]->visible.surface].curvedPart) return false;
    return !isEdge(column, row, 1, 0) && !isEdge(column, row, -1, 0) && !isEdge(column, row, 0, 1) &&
           !isEdge(column, row, 0, -1);
  }

  /// In the first instance.
  SurfacePoint surfacePoint(const Visible& visible) const {
    const Surface& surface = scene_.surfaces[visible.surface];
    SurfacePoint point = pointOn(surface, visible.triangle, {visible.weights.y, visible.weights.z});
    if (!surface.curvedPart) return point;
    const Grid& grid = discretization_.grids[visible.surface];
    const auto& [a, b, c] = surface.triangles[visible.triangle].chart;
    const glm::dvec2 chart = visible.weights.x * a + visible.weights.y * b + visible.weights.z * c;
    const glm::dvec3 smooth =
        filteredValue(grid, normals_, normalFilter(grid), chart * glm::dvec2(grid.columns, grid.rows));
    if (glm::dot(smooth, point.normal) > 0) point.normal = glm::normalize(smooth);
    return point;
  }

  const Scene& scene_;
  const Discretization& discretization_;
  glm::dvec3 eye_;
  CameraAxes axes_;
  int width_, height_;
  double side_;                      ///< of a pixel at depth 1
  std::vector<glm::dvec3> normals_;  ///< of elements
  std::vector<std::optional<VisiblePoint>> points_;
};

/// The radiosity of a visible point with an irradiance: that of its element, or with the maps of its surface.
glm::dvec3 radiosityAt(const Scene& scene, const Discretization& discretization, const Visible& visible,
                       std::uint32_t element, const glm::dvec3& irradiance) {
  const Surface& surface = scene.surfaces[visible.surface];
  if (!hasMaps(scene, surface))
    return emission(scene, discretization, element) + reflectance(scene, discretization, element) * irradiance;
  const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
  const auto& [a, b, c] = surface.triangles[visible.triangle].texcoord;
  glm::dvec3 emitted = material.emission;
  if (material.emissionMap)
    emitted *= bilinear(scene.images[static_cast<std::size_t>(*material.emissionMap)],
                        visible.weights.x * a + visible.weights.y * b + visible.weights.z * c);
  if (discretization.grids[visible.surface].isDark) emitted = glm::dvec3(0);
  return emitted + unlitColour(scene, visible) * irradiance;
}

}  // namespace

GatheredPicture gatheredPicture(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                                const Solution& solution, const Camera& camera, int width, int height, double exposure,
                                const glm::dvec3& background, const GatherSettings& settings,
                                const GatherProgress& progress) {
  const TextureLayout textures = layOutTextures(scene, discretization, {{}, maxGatheredTexels});
  const Pixels pixels(scene, discretization, camera, width, height);
  Gatherer gatherer(scene, discretization, layout, textures, solution, settings, progress);
  std::vector<LitTexels> all{pixels.texels()};
  gatherer.light(all);
  const LitTexels& lit = all.front();
  std::vector<std::optional<glm::dvec3>> irradiance(lit.places.size());
  GatheredPicture picture;
  picture.error = gatherer.error();
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    if (!lit.places[i]) continue;
    irradiance[i] = gatherer.colourOf(lit.places[i]->surface,
                                      elementAt(scene, discretization, pixels.points()[i]->visible), lit.allLight(i));
    ++picture.pixels;
  }
  std::atomic<std::size_t> drawn = gatherer.drawn();
  picture.image = drawPicture(
      scene, camera, width, height,
      [&](const Visible& visible) {
        const VisiblePoint point = pixels.pointOf(visible);
        const std::uint32_t element = elementAt(scene, discretization, visible);
        std::optional<glm::dvec3> light = pixels.interpolated(irradiance, point);
        if (!light) {
          ++drawn;
          light = gatherer.colourOf(visible.surface, element, gatherer.lightAt(pixels.placeOf(point, false)));
        }
        return glm::min(exposure * radiosityAt(scene, discretization, visible, element, *light), glm::dvec3(1));
      },
      background);
  picture.drawn = drawn;
  return picture;
}

}  // namespace hemitex::radiosity
