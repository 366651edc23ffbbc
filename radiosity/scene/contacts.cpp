#include "radiosity/scene/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
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
constexpr std::size_t maxWarnings = 5;
/// Rooms are compared with all shells.
constexpr std::size_t maxRooms = 200;

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
    part.colour[k] = at(std::array<glm::dvec3, 3>{whole.colour[0], whole.colour[1], whole.colour[2]});
  }
  return part;
}

bool keepsArea(const Triangle& triangle) {
  const auto inSpace = [](const glm::dvec2& place) { return glm::dvec3(place, 0); };
  return hasArea(triangle.position[0], triangle.position[1], triangle.position[2]) &&
         hasArea(inSpace(triangle.chart[0]), inSpace(triangle.chart[1]), inSpace(triangle.chart[2]));
}

/// Appends what is left of a triangle, and the covered parts of closed shells.
void appendParts(const Triangle& whole, const std::vector<ContactPart>& parts, std::vector<Triangle>& left,
                 std::vector<Triangle>& covered) {
  if (parts.empty()) left.push_back(whole);
  for (const ContactPart& part : parts) {
    if (part.contact.coveredBy && whole.shell == 0) continue;
    std::vector<Triangle>& triangles = part.contact.coveredBy ? covered : left;
    for (std::size_t k = 2; k < part.corners.size(); ++k) {
      Triangle triangle =
          parts.size() == 1 ? whole : partOf(whole, {part.corners[0], part.corners[k - 1], part.corners[k]});
      triangle.isBacked = part.contact.isBacked;
      if (parts.size() == 1 || keepsArea(triangle)) triangles.push_back(triangle);
    }
  }
}

/// One sentence for each pair of groups in one place, and one for the rest if there are many.
std::vector<std::string> coverWarnings(const std::set<std::pair<std::string, std::string>>& pairs) {
  std::vector<std::string> warnings;
  for (const auto& [covered, by] : pairs) {
    if (warnings.size() == maxWarnings) {
      warnings.push_back("faces of " + std::to_string(pairs.size() - maxWarnings) +
                         " more pairs of groups lie in one place; the last one covers");
      break;
    }
    const std::string of = by == covered ? "itself" : "`" + raster::excerpt(covered) + "`";
    warnings.push_back("`" + raster::excerpt(by) + "` covers " + of +
                       " where both lie in one place and face the same way, because the later face covers");
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
    warnings.push_back("`" + raster::excerpt(scene.surfaces[s].name) +
                       "` looks the other way than the other faces of its closed shell; --flip turns it over");
  return warnings;
}

/// Whether a sample of the triangles of a room sees fronts on the outside, which belong to nothing in the room.
bool isLookedAtFromOutside(const Scene& scene, const NumberedTriangles& triangles,
                           const std::vector<std::uint32_t>& room, const RayTree& tree) {
  constexpr std::size_t maxSamples = 64, minShare = 8;
  std::size_t rays = 0, fronts = 0;
  for (std::size_t i = 0; i < std::min(room.size(), maxSamples); ++i) {
    const auto& [a, b, c] = triangles.positions[room[i * room.size() / std::min(room.size(), maxSamples)]];
    const glm::dvec3 out = -glm::normalize(glm::cross(b - a, c - a)), along = glm::normalize(b - a);
    for (const glm::dvec3& tilt : {along, -along, glm::cross(out, along), -glm::cross(out, along)}) {
      const auto hit = tree.firstHit((a + b + c) / 3.0 + contactTolerance(scene) * out, out + tilt);
      ++rays;
      if (hit && hit->isFront) ++fronts;
    }
  }
  return minShare * fronts > rays;
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
  std::size_t rooms = 0;
  for (std::size_t room = 0; room < ofShells.size() && warnings.size() < maxWarnings && rooms < maxRooms; ++room) {
    if (shells.kinds[room] != ShellKind::Room || !shells.isClosed[room]) continue;
    const auto emits = [&](std::uint32_t t) {
      const Surface& surface = scene.surfaces[triangles.surfaces[t]];
      return scene.materials[static_cast<std::size_t>(surface.material)].emission != glm::dvec3(0);
    };
    if (std::any_of(ofShells[room].begin(), ofShells[room].end(), emits)) continue;
    ++rooms;
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
  std::vector<std::int32_t> closed;  // the number of each shell, or 0
  for (std::size_t shell = 0; shell < shells.kinds.size(); ++shell) {
    const bool isCounted = shells.isClosed[shell] && shells.kinds[shell] != ShellKind::Sheet;
    if (isCounted) scene.shellVolumes.push_back(shells.volumes[shell]);
    closed.push_back(isCounted ? static_cast<std::int32_t>(scene.shellVolumes.size()) : 0);
  }
  std::size_t t = 0;
  for (Surface& surface : scene.surfaces)
    for (Triangle& triangle : surface.triangles) {
      triangle.shell = (shells.isTurnedOver[t] ? -1 : 1) * closed[shells.ofTriangle[t]];
      ++t;
    }
  warn(turnedWarnings(scene, triangles, shells));
  warn(emptyRoomWarnings(scene, triangles, shells, tree));
  const std::vector<std::vector<ContactPart>> parts = partsInContact(scene, triangles, shells, tree);
  std::set<std::pair<std::string, std::string>> covered;  // the families of the covered one and the other
  std::size_t number = 0;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    std::vector<Triangle> left;
    for (const Triangle& triangle : scene.surfaces[s].triangles) {
      appendParts(triangle, parts[number], left, scene.covered);
      for (const ContactPart& part : parts[number])
        if (part.contact.coveredBy)
          covered.insert(
              {scene.surfaces[s].family, scene.surfaces[triangles.surfaces[*part.contact.coveredBy]].family});
      ++number;
    }
    scene.surfaces[s].triangles = std::move(left);
  }
  warn(coverWarnings(covered));
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

bool isInsideSolid(const Scene& scene, const RayTree& rays, const glm::dvec3& point) {
  if (scene.shellVolumes.empty()) return false;
  const auto isInside = [&](const glm::dvec3& direction) {
    std::map<std::pair<std::int32_t, std::uint32_t>, int> windings;  // by shell and instance
    rays.visitHits(point, direction, [&](const TriangleHit& hit) {
      if (hit.shell != 0) windings[{std::abs(hit.shell), hit.instance}] += hit.isFront == (hit.shell > 0) ? -1 : 1;
    });
    double smallest = 0;
    for (const auto& [key, winding] : windings) {
      const double volume = scene.shellVolumes[static_cast<std::size_t>(key.first) - 1];
      const double size = std::abs(volume), known = std::abs(smallest);
      const bool isIn = volume > 0 ? winding > 0 : winding < 0;
      // Of equal ones, the skins of one wall, the room counts as smaller.
      const double bound = volume < 0 ? 1 + shellVolumeRounding : 1 - shellVolumeRounding;
      if (isIn && (smallest == 0 || size < bound * known)) smallest = volume;
    }
    return smallest > 0;
  };
  return std::count_if(directions.begin(), directions.end(), isInside) > 1;
}

}  // namespace hemitex::radiosity
