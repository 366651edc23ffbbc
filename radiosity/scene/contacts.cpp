#include "radiosity/scene/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "radiosity/geometry/contact_parts.h"
#include "radiosity/geometry/triangulation.h"
#include "radiosity/scene/ray_tree.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// Chart coordinates are multiples of it.
constexpr double chartUnit = 0x1p-24;
constexpr std::size_t mostWarnings = 5;

/// The triangles of a scene, by number.
struct NumberedTriangles {
  std::vector<TrianglePositions> positions;
  std::vector<std::uint32_t> surfaces;

  explicit NumberedTriangles(const Scene& scene) {
    for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
      for (const Triangle& triangle : scene.surfaces[s].triangles) {
        positions.push_back(triangle.position);
        surfaces.push_back(s);
      }
  }
};

/// The parts of each triangle; none for those without contact.
std::vector<std::vector<ContactPart>> partsInContact(const Scene& scene, const NumberedTriangles& triangles) {
  const RayTree tree(scene);
  const double tolerance = contactTolerance(scene);
  const std::size_t count = triangles.positions.size();
  std::vector<std::vector<std::uint32_t>> others(count);
  raster::parallelFor(count, [&](std::size_t t) {
    const auto& [a, b, c] = triangles.positions[t];
    std::vector<std::uint32_t> near;
    tree.appendNear(glm::min(glm::min(a, b), c) - tolerance, glm::max(glm::max(a, b), c) + tolerance, near);
    std::erase_if(near, [&](std::uint32_t other) { return other >= count || other == t; });
    std::sort(near.begin(), near.end());
    others[t] = inOnePlace(triangles.positions, static_cast<std::uint32_t>(t), near, tolerance);
  });
  std::vector<std::vector<ContactPart>> parts(count);
  if (std::all_of(others.begin(), others.end(), [](const auto& some) { return some.empty(); })) return parts;
  const Shells shells = findShells(triangles.positions);
  raster::parallelFor(count, [&](std::size_t t) {
    if (!others[t].empty())
      parts[t] = contactParts(triangles.positions, shells, static_cast<std::uint32_t>(t), others[t], tolerance);
  });
  return parts;
}

glm::dvec2 onChart(const glm::dvec2& place) { return glm::round(place / chartUnit) * chartUnit; }

/// The triangle between three places of another one, in its weights.
Triangle partOf(const Triangle& whole, const std::array<glm::dvec2, 3>& weights) {
  Triangle part = whole;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto at = [&](const auto& corners) {
      return corners[0] + weights[k].x * (corners[1] - corners[0]) + weights[k].y * (corners[2] - corners[0]);
    };
    part.position[k] = at(whole.position);
    part.chart[k] = onChart(at(whole.chart));
    part.texcoord[k] = at(whole.texcoord);
  }
  return part;
}

bool keepsArea(const Triangle& triangle) {
  const auto inSpace = [](const glm::dvec2& place) { return glm::dvec3(place, 0); };
  return hasArea(triangle.position[0], triangle.position[1], triangle.position[2]) &&
         hasArea(inSpace(triangle.chart[0]), inSpace(triangle.chart[1]), inSpace(triangle.chart[2]));
}

/// Appends what is left of a triangle.
void appendParts(const Triangle& whole, const std::vector<ContactPart>& parts, std::vector<Triangle>& triangles) {
  if (parts.empty()) triangles.push_back(whole);
  for (const ContactPart& part : parts) {
    if (part.contact.coveredBy) continue;
    for (std::size_t k = 2; k < part.corners.size(); ++k) {
      Triangle triangle = parts.size() == 1 ? whole : partOf(whole, {part.corners[0], part.corners[k - 1], part.corners[k]});
      triangle.isBacked = part.contact.isBacked;
      if (parts.size() == 1 || keepsArea(triangle)) triangles.push_back(triangle);
    }
  }
}

/// One sentence for each pair of surfaces in one place, and one for the rest if there are many.
std::vector<std::string> coverWarnings(const Scene& scene, const std::set<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  std::vector<std::string> warnings;
  for (const auto& [covered, by] : pairs) {
    if (warnings.size() == mostWarnings) {
      warnings.push_back("faces of " + std::to_string(pairs.size() - mostWarnings) +
                         " more pairs of surfaces lie in one place; the last one covers");
      break;
    }
    const auto name = [&](std::uint32_t s) { return "`" + raster::excerpt(scene.surfaces[s].name) + "`"; };
    warnings.push_back(name(by) + " covers " + name(covered) +
                       " where both lie in one place and face the same way, because it comes later in the file");
  }
  return warnings;
}

/// Directions of rays, off the axes and the diagonals of boxes.
constexpr std::array directions{glm::dvec3(0.267, 0.911, 0.314), glm::dvec3(-0.872, 0.179, 0.456),
                                glm::dvec3(0.401, -0.338, -0.852)};

}  // namespace

void resolveContacts(Scene& scene) {
  const NumberedTriangles triangles(scene);
  const std::vector<std::vector<ContactPart>> parts = partsInContact(scene, triangles);
  std::set<std::pair<std::uint32_t, std::uint32_t>> covered;
  std::size_t number = 0;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    std::vector<Triangle> left;
    for (const Triangle& triangle : scene.surfaces[s].triangles) {
      appendParts(triangle, parts[number], left);
      for (const ContactPart& part : parts[number])
        if (part.contact.coveredBy) covered.insert({s, triangles.surfaces[*part.contact.coveredBy]});
      ++number;
    }
    scene.surfaces[s].triangles = std::move(left);
  }
  const std::vector<std::string> warnings = coverWarnings(scene, covered);
  scene.warnings.insert(scene.warnings.end(), warnings.begin(), warnings.end());
  std::erase_if(scene.surfaces, [](const Surface& surface) { return surface.triangles.empty(); });
}

void findBacked(Scene& scene) {
  const std::vector<std::vector<ContactPart>> parts = partsInContact(scene, NumberedTriangles(scene));
  std::size_t number = 0;
  for (Surface& surface : scene.surfaces)
    for (Triangle& triangle : surface.triangles) {
      const std::vector<ContactPart>& own = parts[number++];
      triangle.isBacked = surface.twin || (own.size() == 1 && own.front().contact.isBacked);
    }
}

Solids::Solids(const Scene& scene, const RayTree& rays) : rays_(rays) {
  std::vector<TrianglePositions> positions;
  for (const Surface& surface : scene.surfaces) {
    firstTriangle_.push_back(static_cast<std::uint32_t>(positions.size()));
    if (surface.twin) continue;
    for (const Triangle& triangle : surface.triangles) positions.push_back(triangle.position);
  }
  firstTriangle_.push_back(static_cast<std::uint32_t>(positions.size()));
  shells_ = findShells(positions);
  hasSolid_ = std::find(shells_.kinds.begin(), shells_.kinds.end(), ShellKind::Solid) != shells_.kinds.end();
}

bool Solids::contain(const glm::dvec3& point) const {
  if (!hasSolid_) return false;
  const auto isInside = [&](const glm::dvec3& direction) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> windings;  // by instance and shell
    rays_.visitHits(point, direction, [&](const TriangleHit& hit) {
      const std::uint32_t triangle = firstTriangle_[hit.surface] + hit.triangle;
      if (triangle >= firstTriangle_[hit.surface + 1] || shells_.kindOf(triangle) != ShellKind::Solid) return;
      windings[{hit.instance, shells_.ofTriangle[triangle]}] += hit.isFront ? -1 : 1;
    });
    return std::any_of(windings.begin(), windings.end(), [](const auto& winding) { return winding.second > 0; });
  };
  return std::count_if(directions.begin(), directions.end(), isInside) > 1;
}

}  // namespace hemitex::radiosity
