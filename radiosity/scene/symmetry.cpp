#include "radiosity/scene/symmetry.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "raster/base/input_error.h"
#include "raster/base/short_number.h"

namespace hemitex::radiosity {
namespace {

constexpr std::string_view axisNames = "xyz";

/// The map of a coordinate to sign * coordinate + shift.
struct AxisImage {
  double sign = 1, shift = 0;
};

/// The images along an axis; the first one is the box itself.
std::vector<AxisImage> imagesAlong(std::vector<double> mirrors, double period, int repeats) {
  std::sort(mirrors.begin(), mirrors.end());
  std::vector<AxisImage> box{{}};
  if (!mirrors.empty()) box.push_back({-1, 2 * mirrors.front()});
  if (mirrors.size() == 2) period = 2 * (mirrors[1] - mirrors[0]);
  if (period == 0) return box;
  std::vector<AxisImage> images;
  for (int k = 0; k <= 2 * repeats; ++k) {  // 0, 1, -1, 2, -2, ...
    const int number = (k + 1) / 2 * (k % 2 == 1 ? 1 : -1);
    for (const AxisImage& image : box) images.push_back({image.sign, image.shift + number * period});
  }
  return images;
}

void requireUsable(const Scene& scene, const Symmetry& symmetry) {
  const double tolerance = contactTolerance(scene);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double>& mirrors = symmetry.mirrors[axis];
    const std::string name(1, axisNames[axis]);
    const double period = symmetry.period[static_cast<int>(axis)];
    if (!mirrors.empty() && period != 0)
      throw raster::InputError("the scene has mirror planes and a period along " + name,
                               "omit one of them: two mirror planes repeat the scene, too");
    if (!std::isfinite(period) || period < 0)
      throw raster::InputError("the period along " + name + " is " + raster::shortNumber(period),
                               "it is the length of a box; 0 means that the scene is not repeated");
    if (mirrors.size() > 2 || (mirrors.size() == 2 && mirrors[0] == mirrors[1]))
      throw raster::InputError("there are more than two different mirror planes along " + name, "omit the others");
    for (const double mirror : mirrors)
      for (const Surface& surface : scene.surfaces) {
        bool isBelow = false, isAbove = false;
        for (const Triangle& triangle : surface.triangles)
          for (const glm::dvec3& corner : triangle.position) {
            const double height = corner[static_cast<int>(axis)] - mirror;
            isBelow = isBelow || height < -tolerance;
            isAbove = isAbove || height > tolerance;
          }
        if (isBelow && isAbove)
          throw raster::InputError("the mirror plane " + name + " = " + raster::shortNumber(mirror) +
                                       " cuts the surface `" + raster::excerpt(surface.name) + "`",
                                   "divide the surface there, and omit what is behind the plane");
      }
  }
}

Surface imageOf(const Surface& surface, const std::array<AxisImage, 3>& image) {
  Surface result = surface;
  for (Triangle& triangle : result.triangles)
    for (glm::dvec3& corner : triangle.position)
      for (int axis = 0; axis < 3; ++axis) {
        const AxisImage& map = image[static_cast<std::size_t>(axis)];
        corner[axis] = map.sign * corner[axis] + map.shift;
      }
  if (image[0].sign * image[1].sign * image[2].sign < 0) turnOver(result);  // a reflection turns the winding
  return result;
}

}  // namespace

bool Symmetry::isNone() const {
  return std::all_of(mirrors.begin(), mirrors.end(), [](const auto& planes) { return planes.empty(); }) &&
         period == glm::dvec3(0.0);
}

void addImages(Scene& scene, const Symmetry& symmetry) {
  requireUsable(scene, symmetry);
  std::array<std::vector<AxisImage>, 3> along;
  std::size_t images = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    along[axis] = imagesAlong(symmetry.mirrors[axis], symmetry.period[static_cast<int>(axis)], symmetry.repeats);
    images *= along[axis].size();
  }
  const std::size_t count = scene.surfaces.size();
  std::uint32_t parts = 0;  // numbers of curved parts
  for (const Surface& surface : scene.surfaces)
    parts = std::max(parts, surface.curvedPart ? *surface.curvedPart + 1 : 0);
  constexpr std::size_t maxSurfaces = std::size_t{1} << 24;
  if (images * count > maxSurfaces)
    throw raster::InputError("the scene and its images have " + std::to_string(images * count) + " surfaces",
                             "repeat it less often");
  for (std::size_t n = 1; n < images; ++n) {
    const std::size_t x = n % along[0].size(), y = n / along[0].size() % along[1].size(),
                      z = n / along[0].size() / along[1].size();
    const std::array image{along[0][x], along[1][y], along[2][z]};
    for (std::size_t s = 0; s < count; ++s) {
      Surface surface = imageOf(scene.surfaces[s], image);
      surface.name += "@" + std::to_string(n);
      surface.imageOf = static_cast<std::uint32_t>(s);
      if (surface.twin) surface.twin = *surface.twin + static_cast<int>(n * count);
      if (surface.curvedPart) *surface.curvedPart += static_cast<std::uint32_t>(n) * parts;
      scene.surfaces.push_back(std::move(surface));
    }
  }
  measureBounds(scene);
}

}  // namespace hemitex::radiosity
