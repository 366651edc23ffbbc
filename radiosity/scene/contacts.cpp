#include "radiosity/scene/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "radiosity/geometry/contact_parts.h"
#include "radiosity/geometry/triangulation.h"
#include "radiosity/scene/ray_tree.h"
#include "raster/base/cross.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// Chart coordinates are multiples of it.
constexpr double chartUnit = 0x1p-24;
constexpr std::size_t maxWarnings = 5;
/// Rooms are compared with all shells.
constexpr std::size_t maxRooms = 200;

/// The share of a shell that lies back to back with others if it is a skin of them. A box in a niche has five sixths.
constexpr double minOfSkin = 0.9;

/// Whether a surface is the back of another one, which the file lacks.
bool isBack(const Scene& scene, std::uint32_t s) {
  return scene.surfaces[s].twin && static_cast<std::uint32_t>(*scene.surfaces[s].twin) < s;
}

/// Whether the chart of a surface is a plan of it: an affine map of one plane but for rounding. No two triangles
/// overlap in a chart (chart_validation.h), and so none lies in the place of another.
bool hasPlan(const Surface& surface) {
  constexpr double rounding = 0x1p-20;  // of its extent; charts have 24 bits
  struct Corner {
    glm::dvec2 chart;
    glm::dvec3 position;
  };
  std::vector<Corner> corners;
  for (const Triangle& triangle : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) corners.push_back({triangle.chart[k], triangle.position[k]});
  if (corners.empty()) return false;
  const auto [left, right] = std::minmax_element(
      corners.begin(), corners.end(), [](const Corner& a, const Corner& b) { return a.chart.x < b.chart.x; });
  const Corner a = *left, b = *right;
  const auto besides = [&](const Corner& corner) { return raster::cross(b.chart - a.chart, corner.chart - a.chart); };
  const Corner c = *std::max_element(corners.begin(), corners.end(), [&](const Corner& one, const Corner& two) {
    return std::abs(besides(one)) < std::abs(besides(two));
  });
  return std::all_of(corners.begin(), corners.end(), [&](const Corner& corner) {
    const double third = besides(corner) / besides(c),
                 second = raster::cross(corner.chart - a.chart, c.chart - a.chart) / besides(c);
    return glm::distance(corner.position,
                         a.position + second * (b.position - a.position) + third * (c.position - a.position)) <=
           rounding * glm::distance(a.position, b.position);
  });
}

/// The triangles of a scene, by number.
struct SceneTriangles {
  std::vector<TrianglePositions> positions;
  std::vector<std::uint32_t> surfaces;
  std::vector<std::int64_t> ranks;   ///< see ContactRules
  std::vector<std::uint32_t> plans;  ///< the surface if it has a plan, or RayTree::noSurface
  std::vector<bool> areHoled;        ///< of cut-outs, which are in contact with nothing and enclose nothing

  explicit SceneTriangles(const Scene& scene) {
    const auto count = static_cast<std::int64_t>(triangleCount(scene));
    for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
      const bool isPlan = hasPlan(scene.surfaces[s]);
      for (const Triangle& triangle : scene.surfaces[s].triangles) {
        const auto number = static_cast<std::int64_t>(positions.size());
        positions.push_back(triangle.position);
        surfaces.push_back(s);
        plans.push_back(isPlan ? s : RayTree::noSurface);
        areHoled.push_back(cutOutOf(scene, scene.surfaces[s]) != nullptr);
        ranks.push_back(isBack(scene, s) ? -number : number + count);
      }
    }
  }

  /// A triangle in space.
  NumberedTriangle at(const Scene& scene, std::uint32_t number) const {
    const auto count = static_cast<std::uint32_t>(positions.size());
    if (number < count) return {number, positions[number]};
    const Instance& instance = scene.instances[number / count];
    const auto& [a, b, c] = positions[number % count];
    return {number % count,
            {instance(a), instance(instance.reflects() ? c : b), instance(instance.reflects() ? b : c)}};
  }
};

/// The shells of a scene. Those with holes are not closed.
Shells shellsOf(const SceneTriangles& triangles) {
  Shells shells = findShells(triangles.positions);
  for (std::size_t t = 0; t < triangles.areHoled.size(); ++t)
    if (triangles.areHoled[t]) shells.isClosed[shells.ofTriangle[t]] = false;
  return shells;
}

/// The faces in the place of a triangle.
std::vector<FaceInPlace> facesInPlaceOf(const Scene& scene, const SceneTriangles& triangles, const RayTree& tree,
                                        std::size_t t) {
  const double tolerance = contactTolerance(scene);
  const auto& [a, b, c] = triangles.positions[t];
  std::vector<std::uint32_t> numbers;
  tree.appendNear(glm::min(glm::min(a, b), c) - tolerance, glm::max(glm::max(a, b), c) + tolerance, numbers,
                  triangles.plans[t]);
  std::vector<NumberedTriangle> near;
  for (const std::uint32_t number : numbers)
    if (number != t && !triangles.areHoled[number % triangles.areHoled.size()])
      near.push_back(triangles.at(scene, number));
  return facesInPlace(triangles.positions[t], near, tolerance);
}

/// The faces in the place of each triangle but cut-outs.
std::vector<std::vector<FaceInPlace>> facesInPlaces(const Scene& scene, const SceneTriangles& triangles,
                                                    const RayTree& tree) {
  std::vector<std::vector<FaceInPlace>> others(triangles.positions.size());
  raster::parallelFor(others.size(), [&](std::size_t t) {
    if (!triangles.areHoled[t]) others[t] = facesInPlaceOf(scene, triangles, tree, t);
  });
  return others;
}

/// Of each shell, whether it is a skin (see ContactRules).
std::vector<bool> findSkins(const SceneTriangles& triangles, const Shells& shells,
                            const std::vector<std::vector<FaceInPlace>>& others) {
  std::vector<double> area(shells.kinds.size()), touching(shells.kinds.size());
  for (std::size_t t = 0; t < others.size(); ++t) {
    const auto& [a, b, c] = triangles.positions[t];
    const double own = glm::length(glm::cross(b - a, c - a));
    const std::uint32_t shell = shells.ofTriangle[t];
    double share = 0;
    for (const FaceInPlace& other : others[t]) {
      const std::uint32_t of = shells.ofTriangle[other.number];
      const bool isOfSolid = of != shell && shells.isClosed[of] && shells.kinds[of] == ShellKind::Solid;
      share += other.isOpposite && !isOfSolid ? other.share : 0;
    }
    area[shell] += own;
    touching[shell] += std::min(share, 1.0) * own;
  }
  std::vector<bool> isSkin;
  for (std::size_t s = 0; s < area.size(); ++s) isSkin.push_back(touching[s] >= minOfSkin * area[s]);
  return isSkin;
}

/// Directions of rays, off the axes and the diagonals of boxes.
constexpr std::array directions{glm::dvec3(0.267, 0.911, 0.314), glm::dvec3(-0.872, 0.179, 0.456),
                                glm::dvec3(0.401, -0.338, -0.852)};

/// How often each closed shell goes around a point, by shell and instance. A ray from inside a shell leaves it once
/// more than it enters it.
using Windings = std::map<std::pair<std::int32_t, std::uint32_t>, int>;

Windings windingsAlong(const RayTree& rays, const glm::dvec3& point, const glm::dvec3& direction) {
  Windings windings;
  rays.visitHits(point, direction, [&](const TriangleHit& hit) {
    if (hit.shell != 0) windings[{std::abs(hit.shell), hit.instance}] += hit.isFront == (hit.shell > 0) ? -1 : 1;
  });
  return windings;
}

/// Whether a closed room is around a point.
bool isInRoom(const Scene& scene, const RayTree& rays, const glm::dvec3& point) {
  return std::count_if(directions.begin(), directions.end(), [&](const glm::dvec3& direction) {
           const Windings windings = windingsAlong(rays, point, direction);
           return std::any_of(windings.begin(), windings.end(), [&](const auto& of) {
             return of.second < 0 && scene.shellVolumes[static_cast<std::size_t>(of.first.first) - 1] < 0;
           });
         }) > 1;
}

/// Of each triangle in contact, whether it lies in a closed room; empty if there is none.
std::vector<std::uint8_t> findIndoors(const Scene& scene, const SceneTriangles& triangles, const RayTree& tree,
                                      const std::vector<std::vector<FaceInPlace>>& others) {
  if (std::none_of(scene.shellVolumes.begin(), scene.shellVolumes.end(), [](double volume) { return volume < 0; }))
    return {};
  std::vector<std::uint8_t> isIndoors(others.size());
  raster::parallelFor(others.size(), [&](std::size_t t) {
    const auto& [a, b, c] = triangles.positions[t];
    if (!others[t].empty()) isIndoors[t] = isInRoom(scene, tree, (a + b + c) / 3.0) ? 1 : 0;
  });
  return isIndoors;
}

/// The parts of each triangle; none for those without contact.
std::vector<std::vector<ContactPart>> partsInContact(const Scene& scene, const SceneTriangles& triangles,
                                                     const Shells& shells, const RayTree& tree) {
  const std::vector<std::vector<FaceInPlace>> others = facesInPlaces(scene, triangles, tree);
  const ContactRules rules{shells, findSkins(triangles, shells, others), triangles.ranks,
                           findIndoors(scene, triangles, tree, others)};
  std::vector<std::vector<ContactPart>> parts(others.size());
  raster::parallelFor(parts.size(), [&](std::size_t t) {
    if (!others[t].empty())
      parts[t] = contactParts(triangles.positions[t], static_cast<std::uint32_t>(t), others[t], rules);
  });
  return parts;
}

glm::dvec2 onChart(const glm::dvec2& place) { return glm::round(place / chartUnit) * chartUnit; }

/// The triangle between three places of another one, in its weights.
Triangle partOf(const Triangle& whole, const std::array<glm::dvec2, 3>& weights) {
  Triangle part = whole;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto at = [&](const auto& corners) {
      if (weights[k] == glm::dvec2(1, 0)) return corners[1];
      if (weights[k] == glm::dvec2(0, 1)) return corners[2];
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

/// The step of the positions of cuts: they are rounded, so that triangles on both sides of an edge have the same ones.
/// It is far below the rounding to binary32 when a scene is drawn.
double cutStep(const Scene& scene) { return std::exp2(std::floor(std::log2(contactTolerance(scene))) - 8); }

/// Rounds the corners that are none of the whole triangle.
void roundCuts(const Triangle& whole, double step, Triangle& part) {
  for (glm::dvec3& corner : part.position)
    if (std::find(whole.position.begin(), whole.position.end(), corner) == whole.position.end())
      corner = glm::round(corner / step) * step;
}

/// Appends what is left of a triangle, and the covered parts of closed shells.
void appendParts(const Triangle& whole, const std::vector<ContactPart>& parts, double step, std::vector<Triangle>& left,
                 std::vector<Triangle>& covered) {
  if (parts.empty()) left.push_back(whole);
  for (const ContactPart& part : parts) {
    const bool isHidden = part.contact.coveredBy || part.contact.isJoined;
    if (isHidden && whole.shell == 0) continue;
    std::vector<Triangle>& triangles = isHidden ? covered : left;
    for (Triangle triangle : parts.size() == 1 ? std::vector{whole} : trianglesOf(whole, part.corners)) {
      roundCuts(whole, step, triangle);
      triangle.isBacked = whole.isBacked || part.contact.isBacked;
      triangles.push_back(triangle);
    }
  }
}

/// Where the edges of triangles are cut, by the numbers of the triangles near.
std::map<std::uint32_t, std::vector<glm::dvec3>> cutsOf(const Scene& scene, const SceneTriangles& triangles,
                                                        const std::vector<std::vector<ContactPart>>& parts,
                                                        const RayTree& tree) {
  const double step = cutStep(scene);
  std::vector<glm::dvec3> points;
  std::size_t number = 0;
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& whole : surface.triangles) {
      std::vector<Triangle> left, covered;
      if (parts[number].size() > 1) appendParts(whole, parts[number], step, left, covered);
      for (const std::vector<Triangle>* some : {&left, &covered})
        for (const Triangle& triangle : *some)
          for (const glm::dvec3& corner : triangle.position)
            if (std::find(whole.position.begin(), whole.position.end(), corner) == whole.position.end())
              points.push_back(corner);
      ++number;
    }
  const auto isBefore = [](const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::sort(points.begin(), points.end(), isBefore);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::map<std::uint32_t, std::vector<glm::dvec3>> cuts;
  std::vector<std::uint32_t> near;
  for (const glm::dvec3& point : points) {
    near.clear();
    tree.appendNear(point - step, point + step, near);
    for (const std::uint32_t n : near)
      if (n < triangles.positions.size()) cuts[n].push_back(point);
  }
  return cuts;
}

/// The first corner of the edge of a triangle on which a point lies, and its place along the edge, if there is one.
std::optional<std::pair<std::size_t, double>> edgeAt(const Triangle& triangle, const glm::dvec3& point, double margin) {
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 &start = triangle.position[k], along = triangle.position[(k + 1) % 3] - start;
    const double length = glm::length(along), place = glm::dot(point - start, along) / length;
    if (place <= margin || place >= length - margin) continue;
    if (glm::length(point - start - place / length * along) <= margin) return std::pair(k, place / length);
  }
  return std::nullopt;
}

/// Divides triangles at points on their edges, so that both sides of an edge have the same corners.
void divideAt(const std::vector<glm::dvec3>& points, double margin, std::vector<Triangle>& triangles) {
  for (const glm::dvec3& point : points)
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto edge = edgeAt(triangles[t], point, margin);
      if (!edge) continue;
      const auto [start, share] = *edge;
      const std::size_t end = (start + 1) % 3;
      std::array<Triangle, 2> halves{triangles[t], triangles[t]};
      for (std::size_t half = 0; half < 2; ++half) {
        const std::size_t corner = half == 0 ? end : start;
        const Triangle& whole = triangles[t];
        halves[half].position[corner] = point;
        halves[half].chart[corner] = onChart(glm::mix(whole.chart[start], whole.chart[end], share));
        halves[half].texcoord[corner] = glm::mix(whole.texcoord[start], whole.texcoord[end], share);
        halves[half].colour[corner] = glm::mix(whole.colour[start], whole.colour[end], static_cast<float>(share));
      }
      if (!keepsArea(halves[0]) || !keepsArea(halves[1])) continue;
      triangles[t] = halves[0];
      triangles.push_back(halves[1]);
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

/// One sentence for each cut-out in the place of another face.
std::vector<std::string> cutOutWarnings(const Scene& scene, const SceneTriangles& triangles, const RayTree& tree) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t t = 0; t < triangles.areHoled.size() && pairs.size() < maxWarnings; ++t)
    if (triangles.areHoled[t] && !isBack(scene, triangles.surfaces[t]))
      for (const FaceInPlace& other : facesInPlaceOf(scene, triangles, tree, t))
        pairs.emplace(triangles.surfaces[t], triangles.surfaces[other.number]);
  std::vector<std::string> warnings;
  for (const auto& [cutOut, other] : pairs)
    warnings.push_back("the cut-out `" + raster::excerpt(scene.surfaces[cutOut].name) + "` lies in the place of `" +
                       raster::excerpt(scene.surfaces[other].name) +
                       "`, so that either may be lit and seen; move it a little off");
  return warnings;
}

/// The surfaces of which a triangle looks the other way than the rest of a closed shell.
std::vector<std::string> turnedWarnings(const Scene& scene, const SceneTriangles& triangles, const Shells& shells) {
  std::set<std::uint32_t> turned;
  for (std::uint32_t t = 0; t < triangles.surfaces.size(); ++t)
    if (shells.isTurnedOver[t] && !scene.surfaces[triangles.surfaces[t]].twin && shells.kindOf(t) != ShellKind::Sheet &&
        shells.isClosed[shells.ofTriangle[t]])
      turned.insert(triangles.surfaces[t]);
  std::vector<std::string> warnings;
  for (const std::uint32_t s : turned)
    warnings.push_back("`" + raster::excerpt(scene.surfaces[s].name) +
                       "` looks the other way than the other faces of its closed shell; --flip turns it over");
  return warnings;
}

/// Whether a sample of the triangles of a room sees fronts on the outside, which belong to nothing in the room.
bool isLookedAtFromOutside(const Scene& scene, const SceneTriangles& triangles, const std::vector<std::uint32_t>& room,
                           const RayTree& tree) {
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
std::vector<std::string> emptyRoomWarnings(const Scene& scene, const SceneTriangles& triangles, const Shells& shells,
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
    const auto isLit = [&](std::uint32_t t) {
      const std::uint32_t surface = triangles.surfaces[t];
      return scene.surfaces[surface].twin || emits(scene, surface);
    };
    if (std::any_of(ofShells[room].begin(), ofShells[room].end(), isLit)) continue;
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

}  // namespace

std::vector<Triangle> trianglesOf(const Triangle& whole, std::span<const glm::dvec2> corners) {
  std::vector<Triangle> triangles;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Triangle triangle = partOf(whole, {corners[0], corners[k - 1], corners[k]});
    if (keepsArea(triangle)) triangles.push_back(triangle);
  }
  return triangles;
}

Contacts findContacts(Scene& scene) {
  const SceneTriangles triangles(scene);
  const Shells shells = shellsOf(triangles);
  scene.shellVolumes.clear();
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
  const RayTree tree(scene);
  Contacts contacts{partsInContact(scene, triangles, shells, tree), {}, turnedWarnings(scene, triangles, shells)};
  contacts.cuts = cutsOf(scene, triangles, contacts.parts, tree);
  for (std::string& warning : cutOutWarnings(scene, triangles, tree)) contacts.warnings.push_back(std::move(warning));
  for (std::string& warning : emptyRoomWarnings(scene, triangles, shells, tree))
    contacts.warnings.push_back(std::move(warning));
  return contacts;
}

Scene resolved(Scene scene, const Contacts& contacts) {
  const SceneTriangles triangles(scene);
  const double step = cutStep(scene);
  scene.warnings.insert(scene.warnings.end(), contacts.warnings.begin(), contacts.warnings.end());
  std::set<std::pair<std::string, std::string>> covered;  // the families of the covered one and the other
  std::uint32_t number = 0;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    std::vector<Triangle> left;
    for (const Triangle& triangle : scene.surfaces[s].triangles) {
      const std::vector<ContactPart>& parts = contacts.parts[number];
      std::vector<Triangle> own;
      appendParts(triangle, parts, step, own, scene.covered);
      if (const auto cuts = contacts.cuts.find(number); cuts != contacts.cuts.end()) divideAt(cuts->second, step, own);
      left.insert(left.end(), own.begin(), own.end());
      for (const ContactPart& part : parts)
        if (part.contact.coveredBy && !part.contact.isJoined && !isBack(scene, s))
          covered.insert(
              {scene.surfaces[s].family, scene.surfaces[triangles.surfaces[*part.contact.coveredBy]].family});
      ++number;
    }
    scene.surfaces[s].triangles = std::move(left);
  }
  for (std::string& warning : coverWarnings(covered)) scene.warnings.push_back(std::move(warning));
  scene.coverings.assign(covered.begin(), covered.end());
  return scene;
}

void removeEmptySurfaces(Scene& scene) {
  std::vector<int> number;  // of each surface after it, or -1
  int next = 0;
  for (const Surface& surface : scene.surfaces) {
    number.push_back(surface.triangles.empty() ? -1 : next++);
  }
  std::erase_if(scene.surfaces, [](const Surface& surface) { return surface.triangles.empty(); });
  for (Surface& surface : scene.surfaces) {
    if (!surface.twin) continue;
    surface.twin = number[static_cast<std::size_t>(*surface.twin)];
    if (*surface.twin < 0) surface.twin.reset();
  }
}

void findBacked(Scene& scene) {
  const SceneTriangles triangles(scene);
  const std::vector<std::vector<ContactPart>> parts =
      partsInContact(scene, triangles, shellsOf(triangles), RayTree(scene));
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
    const Windings windings = windingsAlong(rays, point, direction);
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
