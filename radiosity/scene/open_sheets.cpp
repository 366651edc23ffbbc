#include "radiosity/scene/open_sheets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <string_view>
#include <tuple>

#include "radiosity/geometry/mesh_edges.h"
#include "radiosity/geometry/tangent_along.h"
#include "radiosity/scene/ray_tree.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// Points of a surface from which its back looks.
constexpr std::size_t pointsOfSurface = 4;
/// Directions along a side of the square: for the first step of walks from a point, and for the other steps.
constexpr int firstSide = 6, nextSide = 8;
/// Number of fronts after which a walk counts as lit. Inside a solid of which half of the faces are missing, where it
/// touches fronts of others, a walk meets that many with a probability of 1/256.
constexpr int maxFronts = 8;
/// The share of walks that must be lit.
constexpr double minLit = 0.08;
/// If no walk is lit of the first ones from a point, and this many of them begin at other backs, the point lies inside
/// a solid.
constexpr std::size_t fewDirections = 12, mostOfFew = 9;
/// Has no common divisor with the number of directions: any few of them are spread over all.
constexpr std::size_t spread = 7;

/// Directions with about the density of the cosine around z: middles of the cells of a square, whose rings are mapped
/// to circles of a disk, and lifted to the hemisphere (Malley).
std::vector<glm::dvec3> cosineDirections(int side) {
  std::vector<glm::dvec3> directions;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const glm::dvec2 p((2 * i + 1.0) / side - 1, (2 * j + 1.0) / side - 1);
      const double longer = std::max(std::abs(p.x), std::abs(p.y)), length = glm::length(p);
      const glm::dvec2 onDisk = length > 0 ? p * (longer / length) : p;
      directions.emplace_back(onDisk, std::sqrt(1 - longer * longer));
    }
  }
  return directions;
}

/// The surfaces with visible backs that belong to components with a border, except emitters and closed shells, whose
/// borders come from contacts.
std::vector<std::uint32_t> openSurfaces(const Scene& scene) {
  std::vector<TrianglePositions> positions;
  std::vector<std::uint32_t> owners;
  std::vector<bool> hasBack;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    for (const Triangle& triangle : scene.surfaces[s].triangles) {
      positions.push_back(triangle.position);
      owners.push_back(s);
      hasBack.push_back(!triangle.isBacked && triangle.shell == 0);
    }
  }
  const MeshEdges edges = findEdges(positions);
  const TriangleSets components = connectedSets(edges, [](std::uint32_t, std::uint32_t) { return true; });
  std::vector<bool> hasBorder(components.triangles.size(), false), isOpen(scene.surfaces.size(), false);
  for (std::uint32_t e = 0; e < edges.count(); ++e)
    if (edges.around(e).size() == 1) hasBorder[components.owner[edges.around(e)[0] / 3]] = true;
  for (std::size_t t = 0; t < owners.size(); ++t)
    if (hasBack[t] && hasBorder[components.owner[t]]) isOpen[owners[t]] = true;
  std::vector<std::uint32_t> open;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
    if (isOpen[s] && !emits(scene, s)) open.push_back(s);
  return open;
}

/// Numbers of walks.
struct WalkCounts {
  std::size_t lit = 0, all = 0;
};

/// Walks from the backs of surfaces.
class BackWalks {
 public:
  explicit BackWalks(const Scene& scene) : scene_(scene), rays_(scene) {}

  WalkCounts from(std::uint32_t number) const {
    std::vector<Triangle> triangles = scene_.surfaces[number].triangles;
    std::erase_if(triangles, [](const Triangle& triangle) { return triangle.isBacked; });
    const std::size_t count = triangles.size(), points = std::min(count, pointsOfSurface);
    std::minstd_rand random(number + 1);
    WalkCounts walks;
    for (std::size_t i = 0; i < points; ++i) {
      const Triangle& triangle = triangles[i * count / points];
      const glm::dvec3 middle = middleOf(triangle);
      std::size_t backs = 0;
      for (std::size_t d = 0; d < first_.size(); ++d) {
        if (d == fewDirections && walks.lit == 0 && backs >= mostOfFew) return walks;
        ++walks.all;
        const auto hit = firstHit(middle, -normal(triangle), first_[spread * d % first_.size()]);
        if (hit && !hit->isFront) ++backs;
        if (hit && hit->isFront && endsLit(*hit, random)) ++walks.lit;
      }
    }
    return walks;
  }

 private:
  /// `direction` is relative to the normal.
  std::optional<TriangleHit> firstHit(const glm::dvec3& point, const glm::dvec3& normal,
                                      const glm::dvec3& direction) const {
    const glm::dvec3 x = tangentAlong(normal, glm::dvec3(0)), y = glm::cross(normal, x);
    return rays_.firstHit(point + contactTolerance(scene_) * normal, glm::dmat3(x, y, normal) * direction);
  }

  /// Whether a walk from a front meets an emitter, or fronts only. A walk ends at a back or outside the scene.
  bool endsLit(TriangleHit hit, std::minstd_rand& random) const {
    for (int fronts = 1; fronts < maxFronts && !emits(scene_, hit.surface); ++fronts) {
      const Triangle& triangle = scene_.surfaces[hit.surface].triangles[hit.triangle];
      const glm::dvec3 point = triangle.position[0] + hit.weights.x * (triangle.position[1] - triangle.position[0]) +
                               hit.weights.y * (triangle.position[2] - triangle.position[0]);
      const auto next = firstHit(point, normal(triangle), next_[random() % next_.size()]);
      if (!next || !next->isFront) return false;
      hit = *next;
    }
    return true;
  }

  const Scene& scene_;
  RayTree rays_;
  std::vector<glm::dvec3> first_ = cosineDirections(firstSide), next_ = cosineDirections(nextSide);
};

}  // namespace

std::vector<std::uint32_t> sheetsLitFromBothSides(const Scene& scene) {
  const std::vector<std::uint32_t> open = openSurfaces(scene);
  if (open.empty()) return {};
  const BackWalks walks(scene);
  std::vector<WalkCounts> counts(open.size());
  raster::parallelFor(open.size(), [&](std::size_t i) { counts[i] = walks.from(open[i]); });
  // The charts of a curved part are one sheet.
  const auto sheetOf = [&](std::uint32_t s) {
    const Surface& surface = scene.surfaces[s];
    return std::tuple(std::string_view(surface.family), surface.curvedPart, surface.curvedPart ? 0 : s);
  };
  std::map<decltype(sheetOf(0)), WalkCounts> ofSheets;
  for (std::size_t i = 0; i < open.size(); ++i) {
    WalkCounts& sum = ofSheets[sheetOf(open[i])];
    sum.lit += counts[i].lit;
    sum.all += counts[i].all;
  }
  std::vector<std::uint32_t> sheets;
  for (const std::uint32_t s : open) {
    const WalkCounts& sum = ofSheets.at(sheetOf(s));
    if (static_cast<double>(sum.lit) >= minLit * static_cast<double>(sum.all)) sheets.push_back(s);
  }
  return sheets;
}

}  // namespace hemitex::radiosity
