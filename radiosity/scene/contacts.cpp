#include "radiosity/scene/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
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
std::vector<std::vector<ContactPart>> partsInContact(const Scene& scene, const NumberedTriangles& triangles,
                                                     const Shells& shells, const RayTree& tree) {
  const double tolerance = contactTolerance(scene);
  const std::size_t count = triangles.positions.size();
  std::vector<std::vector<ContactPart>> parts(count);
  raster::parallelFor(count, [&](std::size_t t) {
    const auto& [a, b, c] = triangles.positions[t];
    std::vector<std::uint32_t> near;
    tree.appendNear(glm::min(glm::min(a, b), c) - tolerance, glm::max(glm::max(a, b), c) + tolerance, near);
    std::erase_if(near, [&](std::uint32_t other) { return other >= count; });
    parts[t] = contactParts(triangles.positions, shells, static_cast<std::uint32_t>(t), near, tolerance);
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

/// Appends what is left of a triangle, and the covered parts of solids.
void appendParts(const Triangle& whole, const std::vector<ContactPart>& parts, std::vector<Triangle>& left,
                 std::vector<Triangle>& covered) {
  if (parts.empty()) left.push_back(whole);
  for (const ContactPart& part : parts) {
    if (part.contact.coveredBy && whole.solid == 0) continue;
    std::vector<Triangle>& triangles = part.contact.coveredBy ? covered : left;
    for (std::size_t k = 2; k < part.corners.size(); ++k) {
      Triangle triangle =
          parts.size() == 1 ? whole : partOf(whole, {part.corners[0], part.corners[k - 1], part.corners[k]});
      triangle.isBacked = part.contact.isBacked;
      if (parts.size() == 1 || keepsArea(triangle)) triangles.push_back(triangle);
    }
  }
}

std::string quoted(const Surface& surface) { return "`" + raster::excerpt(surface.name) + "`"; }

/// One sentence for each pair of surfaces in one place, and one for the rest if there are many.
std::vector<std::string> coverWarnings(const Scene& scene,
                                       const std::set<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  std::vector<std::string> warnings;
  for (const auto& [covered, by] : pairs) {
    if (warnings.size() == mostWarnings) {
      warnings.push_back("faces of " + std::to_string(pairs.size() - mostWarnings) +
                         " more pairs of surfaces lie in one place; the last one covers");
      break;
    }
    warnings.push_back(quoted(scene.surfaces[by]) + " covers " + quoted(scene.surfaces[covered]) +
                       " where both lie in one place and face the same way, because it comes later in the file");
  }
  return warnings;
}

/// The surfaces of which a triangle looks the other way than the rest of a closed shell.
std::vector<std::string> turnedWarnings(const Scene& scene, const NumberedTriangles& triangles, const Shells& shells) {
  std::set<std::uint32_t> turned;
  for (std::uint32_t t = 0; t < triangles.surfaces.size(); ++t)
    if (shells.isTurnedOver[t] && shells.kindOf(t) != ShellKind::Sheet && shells.isClosed[shells.ofTriangle[t]])
      turned.insert(triangles.surfaces[t]);
  std::vector<std::string> warnings;
  for (const std::uint32_t s : turned)
    warnings.push_back(quoted(scene.surfaces[s]) +
                       " looks the other way than the other faces of its closed shell; --flip turns it over");
  return warnings;
}

/// Whether a sample of the triangles of a room sees fronts on the outside, which belong to nothing in the room.
bool isLookedAtFromOutside(const Scene& scene, const NumberedTriangles& triangles,
                           const std::vector<std::uint32_t>& room, const RayTree& tree) {
  constexpr std::size_t mostSamples = 64, smallestShare = 8;
  std::size_t rays = 0, fronts = 0;
  for (std::size_t i = 0; i < std::min(room.size(), mostSamples); ++i) {
    const auto& [a, b, c] = triangles.positions[room[i * room.size() / std::min(room.size(), mostSamples)]];
    const glm::dvec3 out = -glm::normalize(glm::cross(b - a, c - a)), along = glm::normalize(b - a);
    for (const glm::dvec3& tilt : {along, -along, glm::cross(out, along), -glm::cross(out, along)}) {
      const auto hit = tree.firstHit((a + b + c) / 3.0 + contactTolerance(scene) * out, out + tilt);
      ++rays;
      if (hit && hit->isFront) ++fronts;
    }
  }
  return smallestShare * fronts > rays;
}

/// The rooms in which nothing is, and which are seen from outside: solids of which all faces are turned over.
std::vector<std::string> emptyRoomWarnings(const Scene& scene, const NumberedTriangles& triangles, const Shells& shells,
                                           const RayTree& tree) {
  std::vector<std::vector<std::uint32_t>> ofShells(shells.kinds.size());
  std::vector<Bounds> bounds(shells.kinds.size());
  for (std::uint32_t t = 0; t < triangles.surfaces.size(); ++t) {
    ofShells[shells.ofTriangle[t]].push_back(t);
    for (const glm::dvec3& corner : triangles.positions[t]) bounds[shells.ofTriangle[t]].include(corner);
  }
  const auto isIn = [](const Bounds& inner, const Bounds& outer) {
    return glm::all(glm::greaterThanEqual(inner.low, outer.low)) &&
           glm::all(glm::lessThanEqual(inner.high, outer.high));
  };
  std::vector<std::string> warnings;
  for (std::size_t room = 0; room < ofShells.size() && warnings.size() < mostWarnings; ++room) {
    if (shells.kinds[room] != ShellKind::Room || !shells.isClosed[room]) continue;
    const auto emits = [&](std::uint32_t t) {
      const Surface& surface = scene.surfaces[triangles.surfaces[t]];
      return scene.materials[static_cast<std::size_t>(surface.material)].emission != glm::dvec3(0);
    };
    if (std::any_of(ofShells[room].begin(), ofShells[room].end(), emits)) continue;
    bool isEmpty = true;
    for (std::size_t other = 0; other < ofShells.size() && isEmpty; ++other)
      isEmpty = other == room || !isIn(bounds[other], bounds[room]);
    if (!isEmpty || !isLookedAtFromOutside(scene, triangles, ofShells[room], tree)) continue;
    const Surface& surface = scene.surfaces[triangles.surfaces[ofShells[room].front()]];
    warnings.push_back("all faces of `" + raster::excerpt(surface.family) +
                       "` look inwards, and nothing is inside, so that light falls on backs; if it is a solid, --flip "
                       "turns it over");
  }
  return warnings;
}

/// Whether a ray meets the front of a triangle, or the back; nothing if it misses it (Moeller and Trumbore 1997).
std::optional<bool> sideMet(const Triangle& triangle, const glm::dvec3& origin, const glm::dvec3& direction) {
  const glm::dvec3 along1 = triangle.position[1] - triangle.position[0],
                   along2 = triangle.position[2] - triangle.position[0], offset = origin - triangle.position[0];
  const glm::dvec3 p = glm::cross(direction, along2), q = glm::cross(offset, along1);
  const double determinant = glm::dot(along1, p);
  const double u = glm::dot(offset, p) / determinant, v = glm::dot(direction, q) / determinant;
  if (!(u >= 0 && v >= 0 && u + v <= 1 && glm::dot(along2, q) / determinant > 0)) return std::nullopt;
  return determinant > 0;
}

/// Directions of rays, off the axes and the diagonals of boxes.
constexpr std::array directions{glm::dvec3(0.267, 0.911, 0.314), glm::dvec3(-0.872, 0.179, 0.456),
                                glm::dvec3(0.401, -0.338, -0.852)};

}  // namespace

void resolveContacts(Scene& scene) {
  const NumberedTriangles triangles(scene);
  const Shells shells = findShells(triangles.positions);
  const RayTree tree(scene);
  const auto warn = [&](const std::vector<std::string>& warnings) {
    scene.warnings.insert(scene.warnings.end(), warnings.begin(), warnings.end());
  };
  std::size_t t = 0;
  for (Surface& surface : scene.surfaces)
    for (Triangle& triangle : surface.triangles) {
      const std::uint32_t shell = shells.ofTriangle[t];
      if (shells.isClosed[shell] && shells.kinds[shell] == ShellKind::Solid)
        triangle.solid = (shells.isTurnedOver[t] ? -1 : 1) * (static_cast<std::int32_t>(shell) + 1);
      ++t;
    }
  warn(turnedWarnings(scene, triangles, shells));
  warn(emptyRoomWarnings(scene, triangles, shells, tree));
  const std::vector<std::vector<ContactPart>> parts = partsInContact(scene, triangles, shells, tree);
  std::set<std::pair<std::uint32_t, std::uint32_t>> covered;
  std::size_t number = 0;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    std::vector<Triangle> left;
    for (const Triangle& triangle : scene.surfaces[s].triangles) {
      appendParts(triangle, parts[number], left, scene.covered);
      for (const ContactPart& part : parts[number])
        if (part.contact.coveredBy) covered.insert({s, triangles.surfaces[*part.contact.coveredBy]});
      ++number;
    }
    scene.surfaces[s].triangles = std::move(left);
  }
  warn(coverWarnings(scene, covered));
  std::erase_if(scene.surfaces, [](const Surface& surface) { return surface.triangles.empty(); });
}

void findBacked(Scene& scene) {
  const NumberedTriangles triangles(scene);
  const std::vector<std::vector<ContactPart>> parts =
      partsInContact(scene, triangles, findShells(triangles.positions), RayTree(scene));
  std::size_t number = 0;
  for (Surface& surface : scene.surfaces)
    for (Triangle& triangle : surface.triangles) {
      const std::vector<ContactPart>& own = parts[number++];
      triangle.isBacked = surface.twin || (own.size() == 1 && own.front().contact.isBacked);
    }
}

Solids::Solids(const Scene& scene, const RayTree& rays)
    : scene_(scene),
      rays_(rays),
      hasSolid_(std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [](const Surface& surface) {
        return std::any_of(surface.triangles.begin(), surface.triangles.end(),
                           [](const Triangle& triangle) { return triangle.solid != 0; });
      })) {}

bool Solids::contain(const glm::dvec3& point) const {
  if (!hasSolid_) return false;
  const auto isInside = [&](const glm::dvec3& direction) {
    std::map<std::pair<std::uint32_t, std::int32_t>, int> windings;  // by instance and solid
    const auto meet = [&](std::uint32_t instance, std::int32_t solid, bool isFront) {
      if (solid != 0) windings[{instance, std::abs(solid)}] += isFront == (solid > 0) ? -1 : 1;
    };
    rays_.visitHits(point, direction, [&](const TriangleHit& hit) {
      meet(hit.instance, scene_.surfaces[hit.surface].triangles[hit.triangle].solid, hit.isFront);
    });
    for (std::uint32_t i = 0; i < scene_.instances.size(); ++i)
      for (const Triangle& triangle : scene_.covered)
        if (const auto front = sideMet(placed(triangle, scene_.instances[i]), point, direction))
          meet(i, triangle.solid, *front);
    return std::any_of(windings.begin(), windings.end(), [](const auto& winding) { return winding.second > 0; });
  };
  return std::count_if(directions.begin(), directions.end(), isInside) > 1;
}

}  // namespace hemitex::radiosity
