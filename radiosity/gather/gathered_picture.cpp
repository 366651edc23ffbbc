#include "radiosity/gather/gathered_picture.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>

#include "radiosity/discretization/element_materials.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/pictures/pictures.h"
#include "radiosity/pictures/visibility.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// A visible point in space.
struct VisiblePoint {
  Visible visible;
  glm::dvec3 position, normal;
};

/// The pixels of a picture, and what their middles show.
class Pixels {
 public:
  Pixels(const Scene& scene, const Camera& camera, int width, int height)
      : scene_(scene),
        eye_(camera.eye),
        axes_(axesOf(camera)),
        width_(width),
        height_(height),
        side_(2 * tangentOfDegrees(camera.fov / 2) / height) {
    for (const std::optional<Visible>& visible : visibleSamples(scene, camera, width, height))
      points_.push_back(visible ? std::optional(pointOf(*visible)) : std::nullopt);
  }

  /// Row by row from the top; nothing for the background.
  const std::vector<std::optional<VisiblePoint>>& points() const { return points_; }

  /// The curved surfaces that pixels show.
  std::vector<std::uint32_t> curvedSurfaces() const {
    std::set<std::uint32_t> surfaces;
    for (const auto& point : points_)
      if (point && scene_.surfaces[point->visible.surface].curvedPart) surfaces.insert(point->visible.surface);
    return {surfaces.begin(), surfaces.end()};
  }

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

  /// The pixels as texels without light, row by row from the top; those of curved surfaces have no place.
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
        if (const auto& point = points_[at(column, row)]; point && !scene_.surfaces[point->visible.surface].curvedPart)
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

  /// Whether the next pixel is of another part. No edge is at the border of the picture.
  bool isEdge(int column, int row, int right, int down) const {
    if (column + right >= width_ || row + down >= height_) return false;
    const auto &one = points_[at(column, row)], &other = points_[at(column + right, row + down)];
    return one && other ? !areTogether(*one, *other) : one.has_value() != other.has_value();
  }

  /// Whether all of a pixel shows a plane.
  bool isInside(int column, int row) const {
    const VisiblePoint& point = *points_[at(column, row)];
    for (const glm::ivec2& step : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
      const glm::ivec2 next = glm::ivec2(column, row) + step;
      if (next.x < 0 || next.x >= width_ || next.y < 0 || next.y >= height_) continue;
      const auto& other = points_[at(next.x, next.y)];
      if (!other || other->visible.surface != point.visible.surface ||
          std::abs(glm::dot(point.normal, other->position - point.position)) > contactTolerance(scene_))
        return false;
    }
    return true;
  }

  /// In the first instance.
  SurfacePoint surfacePoint(const Visible& visible) const {
    return pointOn(scene_.surfaces[visible.surface], visible.triangle, {visible.weights.y, visible.weights.z});
  }

  const Scene& scene_;
  glm::dvec3 eye_;
  CameraAxes axes_;
  int width_, height_;
  double side_;  ///< of a pixel at depth 1
  std::vector<std::optional<VisiblePoint>> points_;
};

/// The irradiance of the texels of a curved surface. Its facets shade each other, so that points would differ from
/// their neighbours.
struct CurvedLight {
  int columns = 0, rows = 0;
  std::vector<glm::dvec3> texels;  ///< row by row from v = 0

  /// Bilinear between the middles of texels, at a place of the chart.
  glm::dvec3 at(const glm::dvec2& chart) const {
    const glm::dvec2 place =
        glm::clamp(chart * glm::dvec2(columns, rows) - 0.5, glm::dvec2(0), glm::dvec2(columns - 1, rows - 1));
    const int left = std::min(static_cast<int>(place.x), std::max(columns - 2, 0)),
              low = std::min(static_cast<int>(place.y), std::max(rows - 2, 0));
    const auto texel = [&](int column, int row) {
      return texels[static_cast<std::size_t>(std::min(row, rows - 1)) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(std::min(column, columns - 1))];
    };
    const glm::dvec2 share = place - glm::dvec2(left, low);
    return glm::mix(glm::mix(texel(left, low), texel(left + 1, low), share.x),
                    glm::mix(texel(left, low + 1), texel(left + 1, low + 1), share.x), share.y);
  }
};

glm::dvec2 chartOf(const Scene& scene, const Visible& visible) {
  const auto& [a, b, c] = scene.surfaces[visible.surface].triangles[visible.triangle].chart;
  return visible.weights.x * a + visible.weights.y * b + visible.weights.z * c;
}

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
  const Pixels pixels(scene, camera, width, height);
  Gatherer gatherer(scene, discretization, layout, textures, solution, settings, progress);
  std::vector<LitTexels> all{pixels.texels()};
  const std::vector<std::uint32_t> curved = pixels.curvedSurfaces();
  const Magnifications magnifications = magnificationsOf(textures);
  const CornerNormals normals = smoothNormals(scene);
  for (const std::uint32_t s : curved) all.push_back(texelsOf(scene, discretization, normals, s, magnifications[s]));
  gatherer.light(all, TexelUse::Shown);
  std::vector<CurvedLight> curvedLight(scene.surfaces.size());
  for (std::size_t k = 0; k < curved.size(); ++k)
    curvedLight[curved[k]] = {all[k + 1].columns, all[k + 1].rows,
                              gatherer.coloursOf(curved[k], magnifications[curved[k]], all[k + 1])};
  const LitTexels& lit = all.front();
  std::vector<std::optional<glm::dvec3>> irradiance(lit.places.size());
  GatheredPicture picture;
  picture.error = gatherer.error();
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    if (pixels.points()[i]) ++picture.pixels;
    if (lit.places[i])
      irradiance[i] = gatherer.colourOf(lit.places[i]->surface,
                                        elementAt(scene, discretization, pixels.points()[i]->visible), lit.allLight(i));
  }
  std::atomic<std::size_t> drawn = gatherer.drawn();
  picture.image = drawPicture(
      scene, camera, width, height,
      [&](const Visible& visible) {
        const std::uint32_t element = elementAt(scene, discretization, visible);
        std::optional<glm::dvec3> light;
        if (const CurvedLight& texels = curvedLight[visible.surface]; texels.columns > 0) {
          light = texels.at(chartOf(scene, visible));
        } else {
          const VisiblePoint point = pixels.pointOf(visible);
          light = pixels.interpolated(irradiance, point);
          if (!light) {
            ++drawn;
            light = gatherer.colourOf(visible.surface, element, gatherer.lightAt(pixels.placeOf(point, false)));
          }
        }
        return exposure * radiosityAt(scene, discretization, visible, element, *light);
      },
      background);
  picture.drawn = drawn;
  return picture;
}

}  // namespace hemitex::radiosity
