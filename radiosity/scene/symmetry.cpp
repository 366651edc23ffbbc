#include "radiosity/scene/symmetry.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "raster/base/input_error.h"
#include "raster/base/memory_budget.h"
#include "raster/base/short_number.h"

namespace hemitex::radiosity {
namespace {

constexpr std::string_view axisNames = "xyz";

/// The memory that a triangle of an image takes in a solution, as measured: its positions, and boxes to cull it.
constexpr std::uint64_t bytesPerImageTriangle = 160;

/// The map of a coordinate to sign * coordinate + shift.
struct AxisImage {
  double sign = 1, shift = -0.0;
};

/// The images of a box on each side by default.
constexpr int defaultRepeats = 4;

/// The farthest image, in extents of the scene: positions relative to all images are rounded to binary32.
constexpr int farthestImage = 4096;

/// Whether images repeat along an axis.
bool repeats(const Symmetry& symmetry, std::size_t axis) {
  return symmetry.mirrors[axis].size() == 2 || symmetry.period[static_cast<int>(axis)] != 0;
}

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
  if (symmetry.repeats && !repeats(symmetry, 0) && !repeats(symmetry, 1) && !repeats(symmetry, 2))
    throw raster::InputError("a number of repeats is given, and nothing is repeated",
                             "give a period, or two mirror planes across an axis");
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

}  // namespace

bool Symmetry::isNone() const {
  return std::all_of(mirrors.begin(), mirrors.end(), [](const auto& planes) { return planes.empty(); }) &&
         period == glm::dvec3(0.0) && !repeats;
}

void setSymmetry(Scene& scene, const Symmetry& symmetry) {
  measureBounds(scene);
  requireUsable(scene, symmetry);
  std::array<std::vector<AxisImage>, 3> along;
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    along[axis] = imagesAlong(symmetry.mirrors[axis], symmetry.period[static_cast<int>(axis)],
                              symmetry.repeats.value_or(defaultRepeats));
    count *= along[axis].size();
    const double centre = scene.origin[static_cast<int>(axis)];
    for (const AxisImage& image : along[axis])
      if (!(std::abs(image.sign * centre + image.shift - centre) <= farthestImage * scene.extent))
        throw raster::InputError("an image of the scene along " + std::string(1, axisNames[axis]) +
                                     " is farther away than " + std::to_string(farthestImage) +
                                     " times the size of the scene",
                                 "give a smaller period, nearer mirror planes or fewer repeats");
  }
  constexpr std::size_t maxTriangles = std::size_t{1} << 28;
  if (count > maxTriangles / triangleCount(scene))
    throw raster::InputError("the scene and its images have more than 2^28 triangles", "repeat it less often");
  const std::size_t images = (count - 1) * triangleCount(scene);
  raster::requireMemory(images * bytesPerImageTriangle, "",
                        "the draw list of " + std::to_string(images) + " triangles of images", "repeat it less often");
  scene.instances.clear();
  for (const AxisImage& z : along[2])
    for (const AxisImage& y : along[1])
      for (const AxisImage& x : along[0])
        scene.instances.push_back({{x.sign, y.sign, z.sign}, {x.shift, y.shift, z.shift}});
  if (scene.instances.size() > 1) measureBounds(scene);
}

}  // namespace hemitex::radiosity
