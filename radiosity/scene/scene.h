/// The scene: a file of a scene or mesh with its materials, checked, triangulated and with charts.
///
/// A surface is a set of triangles that share a material and a chart: coordinates in [0,1]^2 that no two triangles
/// share. The index map covers the chart, so that each texel is an element of the surface (Nielsen and Christensen
/// 2002, section 3.1). Positions are doubles. `origin`, the centre of the bounds, is subtracted before drawing, so that
/// a scene far from zero loses no digits.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/base/bands.h"
#include "radiosity/images/cut_out.h"
#include "radiosity/images/image.h"
#include "radiosity/meshes/scene_object.h"
#include "radiosity/spectra/spectrum.h"

namespace hemitex::radiosity {

inline double largestBand(const glm::dvec3& bands) { return glm::max(glm::max(bands.r, bands.g), bands.b); }

/// Parallel light.
struct Sun {
  glm::dvec3 towards{0.0};     ///< unit vector from the scene to the sun
  glm::dvec3 irradiance{0.0};  ///< of a plane at right angles to the light, W/m^2 per band, >= 0
};

/// Light from outside a scene: a uniform sky on all sides, and suns.
struct OutsideLight {
  /// The irradiance of a plane that nothing hides, W/m^2 per band, >= 0. The sky surrounds the scene, also from below,
  /// because no axis of a file is known to point up. Its radiance is this value over pi.
  glm::dvec3 sky{0.0};
  std::vector<Sun> suns = {};
};

/// The largest irradiance of the sky and the suns in any band.
inline double brightest(const OutsideLight& light) {
  double result = largestBand(light.sky);
  for (const Sun& sun : light.suns) result = glm::max(result, largestBand(sun.irradiance));
  return result;
}

/// The directions into which a spot shines. Its intensity is full up to the inner angle and 0 from the outer one on.
/// Between them it is the square of a linear function of the cosine, as KHR_lights_punctual recommends.
struct LampCone {
  glm::dvec3 axis{0.0, 0.0, -1.0};            ///< unit vector away from the lamp
  double innerCosine = 1, outerCosine = 0.5;  ///< of the angles to the axis, 0 <= outer < inner <= 1
};

/// A lamp that is a point.
struct Lamp {
  std::string name;                   ///< for edits and for messages
  glm::dvec3 position{0.0};           ///< in units of the file
  glm::dvec3 intensity{0.0};          ///< radiant, W/sr per RGB band, >= 0; of a spot along its axis
  std::optional<LampCone> cone = {};  ///< without it the lamp shines equally in all directions
};

struct Material {
  std::string name;
  glm::dvec3 reflectance{0.5};             ///< Kd, diffuse, RGB in [0, 1)
  glm::dvec3 emission{0.0};                ///< Ke as emitted radiosity, W/m^2 per RGB band, >= 0
  std::optional<int> reflectanceMap = {};  ///< map_Kd in Scene::images, linear; scales the reflectance
  std::optional<int> emissionMap = {};     ///< map_Ke in Scene::images, linear; scales the emission
  /// In scenes with wavelengths, instead of the colours above, which only pictures show then: in [0, 1), and emitted
  /// radiosity at each wavelength, from 0 to 1e30.
  std::optional<Spectrum> reflectanceSpectrum = {}, emissionSpectrum = {};
  std::shared_ptr<const CutOut> cutOut = {};  ///< its holes: light and views pass through
  bool isDoubleSided = false;                 ///< whether a cut-out is lit from both sides
};

struct Triangle {
  std::array<glm::dvec3, 3>
      position;  ///< in units of the file, origin not subtracted; counter-clockwise seen from the front
  std::array<glm::dvec2, 3> chart;     ///< in [0,1]^2, multiples of 2^-24, which binary32 represents exactly
  std::array<glm::dvec2, 3> texcoord;  ///< the file's coordinates for material maps; without them the chart's
  /// Colours of the corners, linear, which scale the reflectance where the surface has them.
  std::array<glm::vec3, 3> colour = {glm::vec3(1), glm::vec3(1), glm::vec3(1)};
  std::uint32_t polygon = 0;  ///< the face of the file that contains the triangle, counted from 0 over the file
  /// Whether another face lies on the back and shows its front there, so that the back is never visible (see
  /// contacts.h).
  bool isBacked = false;
  /// The closed shell of the file to which the triangle belongs, from 1; negative if it looks the other way there by
  /// mistake; 0 for none.
  std::int32_t shell = 0;
};

struct Surface {
  /// Unique: the group's name, `/material` if a group has several, `#n` for parts, `/back` for the other side in
  /// two-sided scenes; `~2`, `~3`, ... for repeated names.
  std::string name;
  std::string family;  ///< the name without `#n`, which users give on the command line
  int material = 0;    ///< in Scene::materials
  std::vector<Triangle>
      triangles;  ///< in file order; never empty, all with area (see hasArea) in space and in the chart
  /// Surfaces of one family with the same number are charts of one curved part of the mesh.
  std::optional<std::uint32_t> curvedPart = {};
  std::optional<int> twin = {};    ///< of a two-sided surface: the surface of the other side
  std::optional<int> object = {};  ///< in Scene::objects; one without it is an object of its own
  bool hasColours = false;         ///< a corner of its triangles has another colour than white
};

/// A place of all surfaces: it maps coordinates to `sign * coordinate + shift`.
struct Instance {
  glm::dvec3 sign{1.0};    ///< each 1 or -1
  glm::dvec3 shift{-0.0};  ///< adding -0 changes no number, not even the sign of 0

  glm::dvec3 operator()(const glm::dvec3& position) const { return sign * position + shift; }
  /// Whether the instance is a mirror image, which turns the winding of triangles over.
  bool reflects() const { return sign.x * sign.y * sign.z < 0; }
};

/// A camera that a scene file contains.
struct SceneCamera {
  glm::dvec3 eye{0.0};
  glm::dvec3 lookAt{0.0, 0.0, -1.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double fov = 50;  ///< vertical, in degrees, in (0, 180)
};

struct Scene {
  glm::dvec3 origin{0.0};  ///< the centre of the bounds (see measureBounds)
  double extent = 0;       ///< the diagonal of the bounds
  double rounding = 0;  ///< by how much the file rounds coordinates to binary32 (see measureBounds); often unknown: 0
  std::vector<Material> materials;
  std::vector<Image> images;
  /// Object by object in the order of their first faces; backs of two-sided ones behind all fronts.
  std::vector<Surface> surfaces;
  /// The surfaces are in space once per instance: first as they are, then as images (see symmetry.h). All images of an
  /// element have its light, so that elements and light are those of the first instance.
  std::vector<Instance> instances = {Instance()};
  std::size_t faces = 0;       ///< of the file, with those that were dropped
  std::optional<int> up = {};  ///< the axis that points up, if the file states it: 1, y, in glTF
  OutsideLight outside = {};   ///< of a file only the suns
  std::vector<Lamp> lamps = {};
  int photometricLights = 0;               ///< lamps and suns that the file states in candela and lux
  double squareMetres = 1;                 ///< of a square unit, by which W/sr become W/m^2 at a distance in units
  std::vector<std::string> warnings;       ///< one sentence each, for the user
  std::optional<SceneCamera> camera = {};  ///< OBJ files have none
  /// The parts of closed shells that other faces cover, which no surface has.
  std::vector<Triangle> covered = {};
  std::vector<std::pair<std::string, std::string>> coverings = {};  ///< families: one that is covered, and by which
  std::vector<double> shellVolumes = {};  ///< of each closed shell, from 1 on: of solids positive, of rooms negative
  /// Those of the file, some without surfaces; then the backs of two-sided ones, named `/back`, with the same parents.
  std::vector<SceneObject> objects = {};
  std::vector<std::filesystem::path> files = {};  ///< all that were read: the scene, its materials, images and buffers
  /// The bands in which light is computed, in nm: descending, as R, G and B are, which are the bands without
  /// wavelengths.
  std::vector<double> wavelengths = {};
};

/// The number of bands of a scene.
std::size_t bandCount(const Scene& scene);
/// The channel of a colour, 0 to 2, that stands for a band: R for wavelengths from 590 nm, G for those from 490 nm, and
/// B for shorter ones.
int channelOf(const Scene& scene, std::size_t band);
/// Light of a colour in the bands of a scene. At wavelengths it is divided by the colour of equal energy, so that it
/// keeps its colour. Of a saturated colour, the channels of the spectrum (see colour.h) differ from those of the colour
/// by at most 0.08 of its largest one.
Bands lightInBands(const Scene& scene, const glm::dvec3& colour);
/// The reflectance and the emitted radiosity of a material in the bands of a scene, without maps. A reflectance that is
/// only a colour has the channel of each band, so that a grey has its value at all wavelengths.
Bands reflectanceInBands(const Scene& scene, const Material& material);
Bands emissionInBands(const Scene& scene, const Material& material);

/// Whether the reflectance or the emission may differ over a surface, by maps or colours of corners; over any.
bool hasMaps(const Scene& scene, const Surface& surface);
bool hasMaps(const Scene& scene);

/// The area of a triangle, and its unit normal on the front side.
double area(const Triangle& triangle);
glm::dvec3 normal(const Triangle& triangle);
glm::dvec3 middleOf(const Triangle& triangle);
/// The area of all triangles of a surface.
double area(const Surface& surface);

/// Exchanges front and back: the same triangles in reverse order, each corner with its own coordinates.
void turnOver(Surface& surface);

/// Makes two surfaces with the same triangles the two sides of one sheet: twins, whose backs are never visible.
void makeTwins(std::vector<Surface>& surfaces, std::size_t one, std::size_t other);

/// Whether a triangle of a surface is backed, and whether one of a scene is not.
bool hasBacked(const Surface& surface);
bool hasBacks(const Scene& scene);

/// Whether the material of a surface emits light in any band.
bool emits(const Scene& scene, std::size_t surface);

/// The number of triangles of all surfaces. Triangles are numbered through the scene, surface by surface.
std::size_t triangleCount(const Scene& scene);

/// A triangle or surface at an instance. A mirror image exchanges the corners 1 and 2, so that its front stays in
/// front.
Triangle placed(const Triangle& triangle, const Instance& instance);
Surface placed(const Surface& surface, const Instance& instance);
/// Barycentric weights of the corners 1 and 2 of a triangle at an instance as those of the triangle, or the reverse.
glm::dvec2 placedWeights(const glm::dvec2& weights, const Instance& instance);

/// The number of triangles in space: those of all surfaces once per instance. They are numbered instance by instance,
/// so that those of the first have their numbers in the scene.
std::size_t placedTriangleCount(const Scene& scene);

/// The place of a triangle in space.
struct TrianglePlace {
  std::uint32_t instance = 0;               ///< in Scene::instances
  std::uint32_t surface = 0, triangle = 0;  ///< in Scene::surfaces, in Surface::triangles
};

/// The triangle at its place in space, and its corners.
inline Triangle placed(const Scene& scene, const TrianglePlace& place) {
  return placed(scene.surfaces[place.surface].triangles[place.triangle], scene.instances[place.instance]);
}
inline std::array<glm::dvec3, 3> placedCorners(const Scene& scene, const TrianglePlace& place) {
  const Instance& instance = scene.instances[place.instance];
  const auto& [a, b, c] = scene.surfaces[place.surface].triangles[place.triangle].position;
  return {instance(a), instance(instance.reflects() ? c : b), instance(instance.reflects() ? b : c)};
}

/// The cut-out of a surface; null without one.
const CutOut* cutOutOf(const Scene& scene, const Surface& surface);
bool hasCutOuts(const Scene& scene);
/// Whether a place of a triangle is a hole, by the barycentric weights of the corners 1 and 2.
bool isHole(const CutOut& cutOut, const Triangle& triangle, const glm::dvec2& weights);

/// A triangle of a surface with a cut-out, for rays.
struct HoledTriangle {
  std::shared_ptr<const CutOut> cutOut;
  Triangle triangle;
};
/// The triangle at a place; null without a cut-out. Its weights are those of the placed triangle.
std::shared_ptr<const HoledTriangle> holedTriangle(const Scene& scene, const TrianglePlace& place);

/// Calls visit(place) for all triangles in space, in the order of their numbers.
template <typename Visit>
void forEachPlace(const Scene& scene, const Visit& visit) {
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
    for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
      for (std::uint32_t t = 0; t < scene.surfaces[s].triangles.size(); ++t) visit(TrianglePlace{i, s, t});
}

/// The memory that a scene takes per triangle while it is read and solved, as measured (see docs/performance.md).
inline constexpr std::uint64_t bytesPerTriangle = 1100;

/// The sum over the RGB bands.
inline double bandSum(const glm::dvec3& bands) { return bands.x + bands.y + bands.z; }

/// By how much the coordinates of a scene are rounded. If all are binary32 numbers, as in glTF, one that needs all 24
/// bits is off by up to half of the last one. Those with fewer bits count as exact. 0 if one is not binary32.
double coordinateRounding(const Scene& scene);
/// The root of the mean area of triangles. The scene must have one.
double meanSize(const Scene& scene);

/// A box around points.
struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  void include(const glm::dvec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  void include(const Triangle& triangle) {
    for (const glm::dvec3& corner : triangle.position) include(corner);
  }
  void include(const Bounds& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
};

/// The bounds of the surfaces of a scene, without images. A few triangles far away, which would make them 256 times as
/// large, do not count.
Bounds boundsOf(const Scene& scene);

/// Sets the origin, the extent and the rounding of a scene that has a surface, from all its instances. Triangles
/// outside boundsOf do not count, so that they do not make positions coarse. The rounding is at most 2^-13 of meanSize.
void measureBounds(Scene& scene);

/// One sentence for each surface outside the bounds, and one for the rest if there are many.
std::vector<std::string> resolutionWarnings(const Scene& scene);

/// One sentence if the coordinates are rounded to binary32 by more than a hundredth of the size of the faces.
std::vector<std::string> roundingWarnings(const Scene& scene);

/// The distance up to which faces are in contact, in units of the file: eight times the rounding of coordinates to
/// binary32, 2^-24 of the scene's extent or more (see Scene::rounding). Each of two corners is off by up to the root of
/// 3 times this rounding, so that faces in one plane keep well within the distance. Outlines within four times the
/// distance are one.
double contactTolerance(const Scene& scene);

}  // namespace hemitex::radiosity
