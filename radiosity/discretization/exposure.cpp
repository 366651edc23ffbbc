#include "radiosity/discretization/exposure.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "radiosity/discretization/cut_surface.h"
#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/discretization/texel_areas.h"
#include "radiosity/discretization/triangle_slices.h"
#include "radiosity/scene/contacts.h"
#include "radiosity/scene/ray_tree.h"
#include "raster/base/cross.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// Pixels along the sides of the hemicubes that define the rays from a point, one ray per pixel. Where the few see only
/// backs, they are enough: inside a solid nothing else is visible. The second is the smallest with which random rooms
/// agree with light tracing (exposure_test.cpp). The many are for lights, of which no part may be lost that lights
/// anything: they see what is 1/36 as high as it is far away, and lower parts get less than a thousandth of the light.
constexpr int fewPixels = 2, pixels = 6, manyPixels = 36;
// The rooms of exposure_test.cpp and the furnished room need none of the following limits exactly. They hold with each
// alone at the values in brackets; those chosen lie between.
/// Number of points of a region from which rays start [1 to 16].
constexpr int pointsOfRegion = 4;
/// The place of the first of them, in distances between them: off the border of two cuttings.
constexpr double firstPoint = 0.45;
/// Points lie in cuttings of at least this share of the area of the largest one.
constexpr double minOfLargest = 0.3;
/// A region is exposed if exposed fronts are at least this share of all exposed fronts and backs that it sees [.03 to
/// .3]. Inside a solid it is 0, but for rays through cracks.
constexpr double minExposed = 0.1;
/// It is also exposed if lights are at least this share of its view, whatever surrounds it [.0005 to .05].
constexpr double minLights = 0.005;
/// Of a sum of shares.
constexpr double rounding = 1e-12;

/// Cuttings of a surface that are exposed or buried together.
struct Region {
  std::uint32_t surface = 0;
  std::vector<std::uint32_t> cuttings = {};  ///< largest first
  bool isBuried = false;
};

/// The view from a region, as sums of form factors.
struct Seen {
  double backs = 0, exposedFronts = 0;
  double lights = 0;                             ///< the part of the exposed fronts that emits
  double open = 0;                               ///< where light comes from outside
  std::size_t points = 0;                        ///< number of points, over which all shares are summed
  std::map<std::uint32_t, double> regions = {};  ///< fronts, by region
};

/// A direction relative to a surface, z along its normal, with its form factor.
struct LookDirection {
  glm::dvec3 direction;
  double share;
};

/// Directions to the pixel centres of a hemicube.
std::vector<LookDirection> lookDirections(int resolution) {
  std::vector<LookDirection> directions;
  double sum = 0;
  const auto add = [&](const glm::dvec3& direction) {
    const double square = glm::dot(direction, direction), share = direction.z / (square * square);
    directions.push_back({direction, share});
    sum += share;
  };
  const auto at = [resolution](int i) { return (2 * i + 1.0) / resolution - 1; };
  for (int j = 0; j < resolution; ++j)
    for (int i = 0; i < resolution; ++i) {
      add({at(i), at(j), 1});
      if (at(j) < 0) continue;
      for (const double side : {-1.0, 1.0}) {
        add({side, at(i), at(j)});
        add({at(i), side, at(j)});
      }
    }
  for (LookDirection& direction : directions) direction.share /= sum;
  return directions;
}

/// The axes of a hemicube over a triangle, the third one along the normal. They turn with the triangle, so that a
/// turned scene has the same view. The angle to its edges keeps rays off the edges of boxes, which rounding would
/// decide.
glm::dmat3 viewAxes(const Triangle& triangle) {
  const glm::dvec3 n = normal(triangle), edge = glm::normalize(triangle.position[1] - triangle.position[0]);
  const glm::dvec3 x = 15.0 / 17 * edge + 8.0 / 17 * glm::cross(n, edge);
  return {x, glm::cross(n, x), n};
}

/// The slices of each triangle of a surface.
using SlicesOfSurface = std::span<const std::vector<Slice>>;

std::vector<SlicesOfSurface> slicesOfSurfaces(const Scene& scene, const SceneSlices& slices) {
  std::vector<SlicesOfSurface> result;
  std::size_t first = 0;
  for (const Surface& surface : scene.surfaces) {
    result.push_back(SlicesOfSurface(slices.ofTriangle).subspan(first, surface.triangles.size()));
    first += surface.triangles.size();
  }
  return result;
}

/// Finds the buried regions.
class BuriedRegions {
 public:
  BuriedRegions(const Scene& scene, std::span<const GridSize> sizes, const SceneSlices& slices, const RayTree& rays,
                Regions regions = Regions::FarFromSlices)
      : scene_(scene),
        sizes_(sizes),
        cut_(scene.surfaces.size()),
        regionOf_(scene.surfaces.size()),
        rays_(rays),
        isInside_(scene.surfaces.size()) {
    cutSurfaces(slices, regions);
    findInside();
    std::vector<std::optional<Seen>> seen(regions_.size());
    raster::parallelFor(regions_.size(), [&](std::size_t r) { seen[r] = seenFrom(regions_[r]); });
    for (std::size_t r = 0; r < regions_.size(); ++r) regions_[r].isBuried = seen[r].has_value();
    settle(seen);
  }

  /// The exposed regions of a surface that slices cut.
  std::vector<std::vector<std::uint32_t>> exposedRegions(std::uint32_t surface) const {
    std::vector<std::vector<std::uint32_t>> exposed;
    // Regions lie in the order of their surfaces.
    const auto isBefore = [](const Region& region, std::uint32_t s) { return region.surface < s; };
    auto region = std::lower_bound(regions_.begin(), regions_.end(), surface, isBefore);
    for (; region != regions_.end() && region->surface == surface; ++region)
      if (!region->isBuried) exposed.push_back(region->cuttings);
    return exposed;
  }

  /// The cuttings of a surface; null if no slice cuts it.
  const CutSurface* cutOf(std::uint32_t surface) const { return cut_[surface] ? &*cut_[surface] : nullptr; }

  Exposure exposureOf(std::uint32_t surface) const {
    if (!cut_[surface]) return {.isBuried = isInside_[surface] != 0};
    Exposure exposure{.isBuried = true};
    std::map<std::uint32_t, std::vector<TexelPiece>> exposedIn;  // those of texels with buried pieces
    const std::vector<Cutting>& cuttings = cut_[surface]->cuttings;
    const auto isBuried = [&](std::size_t c) { return regions_[regionOf_[surface][c]].isBuried; };
    for (std::size_t c = 0; c < cuttings.size(); ++c)
      if (isBuried(c)) exposedIn[cuttings[c].texel];
    for (std::size_t c = 0; c < cuttings.size(); ++c) {
      if (isBuried(c)) continue;
      exposure.isBuried = false;
      if (const auto found = exposedIn.find(cuttings[c].texel); found != exposedIn.end())
        found->second.push_back(pieceOf(surface, cuttings[c]));
    }
    if (!exposure.isBuried)
      for (auto& [texel, pieces] : exposedIn) exposure.cutTexels.push_back({texel, std::move(pieces)});
    return exposure;
  }

 private:
  void cutSurfaces(const SceneSlices& slices, Regions regions) {
    const std::vector<SlicesOfSurface> ofSurface = slicesOfSurfaces(scene_, slices);
    raster::parallelFor(scene_.surfaces.size(), [&](std::size_t s) {
      const SlicesOfSurface own = ofSurface[s];
      if (!slices.isTouching[s] && std::all_of(own.begin(), own.end(), [](const auto& some) { return some.empty(); }))
        return;
      cut_[s] = cutSurface(scene_.surfaces[s], sizes_[s], own, outlineTolerance(scene_), regions);
    });
    for (std::uint32_t s = 0; s < cut_.size(); ++s) {
      if (!cut_[s]) continue;
      regionOf_[s].resize(cut_[s]->cuttings.size());
      for (std::vector<std::uint32_t>& cuttings : cut_[s]->regions) {
        for (const std::uint32_t cutting : cuttings)
          regionOf_[s][cutting] = static_cast<std::uint32_t>(regions_.size());
        regions_.push_back({s, std::move(cuttings)});
      }
    }
  }

  /// Finds the surfaces that no outline cuts and that lie inside a solid, by their first triangles.
  void findInside() {
    raster::parallelFor(scene_.surfaces.size(), [&](std::size_t s) {
      const Surface& surface = scene_.surfaces[s];
      if (!cut_[s] && !surface.twin) isInside_[s] = isInside(s, pointOn(surface, 0, glm::dvec2(1.0 / 3))) ? 1 : 0;
    });
  }

  bool isInside(std::size_t surface, const SurfacePoint& point) const {
    return isInsideSolid(scene_, rays_, eyeOver(scene_, static_cast<std::uint32_t>(surface), point));
  }

  /// The sum of the views from some points of a region. Nothing if a point sees no back, or if the region emits and
  /// sees any front; then the region is exposed. The view from inside a solid shows backs alone.
  std::optional<Seen> seenFrom(const Region& region) const {
    const std::vector<std::uint32_t> points = somePoints(region);
    const auto inside = std::count_if(points.begin(), points.end(), [&](std::uint32_t number) {
      return isInside(region.surface, middleOf(region.surface, cut_[region.surface]->cuttings[number]));
    });
    if (2 * inside > static_cast<std::ptrdiff_t>(points.size())) return Seen{.backs = 1, .points = 1};
    Seen all;
    for (const std::uint32_t number : points) {
      const Cutting& cutting = cut_[region.surface]->cuttings[number];
      const Seen seen = seenFrom(region.surface, cutting);
      if (seen.backs == 0) return std::nullopt;
      all.backs += seen.backs;
      all.exposedFronts += seen.exposedFronts;
      all.lights += seen.lights;
      for (const auto& [other, share] : seen.regions) all.regions[other] += share;
      ++all.points;
    }
    if (emits(scene_, region.surface) && seesFronts(all)) return std::nullopt;
    return all;
  }

  static bool seesFronts(const Seen& seen) { return seen.exposedFronts > 0 || !seen.regions.empty(); }

  SurfacePoint middleOf(std::uint32_t surface, const Cutting& cutting) const {
    return pointOn(scene_.surfaces[surface], cutting.triangle, cutting.centre);
  }

  /// The view from the middle of a cutting.
  Seen seenFrom(std::uint32_t surface, const Cutting& cutting) const {
    const SurfacePoint point = middleOf(surface, cutting);
    const glm::dvec3 eye = eyeOver(scene_, surface, point);
    // A face that touches another sees the inside of the solid behind that face, or the outside of the scene.
    const bool isTouching = rays_.meetsBack(eye, -point.normal, 2 * contactTolerance(scene_), touchingCosine);
    const glm::dmat3 axes = viewAxes(scene_.surfaces[surface].triangles[cutting.triangle]);
    Seen seen = look(eye, axes, fewDirections_);
    if (seen.backs < 1 - rounding) seen = look(eye, axes, directions_);
    if (emits(scene_, surface) && !seesFronts(seen)) seen = look(eye, axes, manyDirections_);
    // What stands on a back gets no light from beyond it.
    if (isTouching)
      seen.backs += 1;
    else
      seen.exposedFronts += seen.open;
    return seen;
  }

  /// Some cuttings of a region, evenly by area. Slivers are too near to outlines for a reliable view.
  std::vector<std::uint32_t> somePoints(const Region& region) const {
    const std::vector<Cutting>& cuttings = cut_[region.surface]->cuttings;
    const double smallest = minOfLargest * cuttings[region.cuttings.front()].area;
    std::vector<std::uint32_t> large;
    double whole = 0, before = 0;
    for (const std::uint32_t c : region.cuttings) {
      if (cuttings[c].area < smallest) break;
      large.push_back(c);
      whole += cuttings[c].area;
    }
    // Their order by number does not depend on the rounding of areas.
    std::sort(large.begin(), large.end());
    std::vector<std::uint32_t> some;
    for (const std::uint32_t c : large) {
      before += cuttings[c].area;
      if (before > (static_cast<double>(some.size()) + firstPoint) / pointsOfRegion * whole) some.push_back(c);
    }
    return some;
  }

  Seen look(const glm::dvec3& eye, const glm::dmat3& axes, const std::vector<LookDirection>& directions) const {
    Seen seen;
    for (const LookDirection& look : directions) {
      const auto hit = rays_.firstHit(eye, axes * look.direction);
      if (!hit && brightest(scene_.outside) > 0) seen.open += look.share;
      if (!hit) continue;
      if (!hit->isFront)
        seen.backs += look.share;
      else if (isInside_[hit->surface] != 0)
        continue;
      else if (!cut_[hit->surface])
        addExposed(hit->surface, look.share, seen);
      else
        seen.regions[regionAt(*hit)] += look.share;
    }
    return seen;
  }

  std::uint32_t regionAt(const TriangleHit& hit) const {
    const std::uint32_t cutting =
        cuttingAt(*cut_[hit.surface], scene_.surfaces[hit.surface], sizes_[hit.surface], hit.triangle, hit.weights);
    return regionOf_[hit.surface][cutting];
  }

  void addExposed(std::uint32_t surface, double share, Seen& seen) const {
    seen.exposedFronts += share;
    if (emits(scene_, surface)) seen.lights += share;
  }

  /// Marks regions that see enough exposed fronts as exposed, until nothing changes.
  void settle(const std::vector<std::optional<Seen>>& seen) {
    const auto seesExposed = [&](const Seen& view) {
      Seen all = view;
      for (const auto& [region, share] : view.regions)
        if (!regions_[region].isBuried) addExposed(regions_[region].surface, share, all);
      return all.exposedFronts >= minExposed * (all.exposedFronts + all.backs) ||
             all.lights >= minLights * static_cast<double>(all.points);
    };
    bool hasChanged = true;
    while (hasChanged) {
      hasChanged = false;
      for (std::size_t r = 0; r < regions_.size(); ++r) {
        if (!regions_[r].isBuried || !seesExposed(*seen[r])) continue;
        regions_[r].isBuried = false;
        hasChanged = true;
      }
    }
  }

  TexelPiece pieceOf(std::uint32_t surface, const Cutting& cutting) const {
    if (cutting.piece) return {cutting.triangle, *cutting.piece};
    const GridSize& grid = sizes_[surface];
    const auto columns = static_cast<std::uint32_t>(grid.columns);
    const auto corners = inTexels(scene_.surfaces[surface].triangles[cutting.triangle], grid.columns, grid.rows);
    return {cutting.triangle, clippedToCell(corners, cutting.texel % columns, cutting.texel / columns)};
  }

  const Scene& scene_;
  std::span<const GridSize> sizes_;
  std::vector<std::optional<CutSurface>> cut_;        ///< of surfaces with slices
  std::vector<std::vector<std::uint32_t>> regionOf_;  ///< of each cutting, by surface
  const RayTree& rays_;
  std::vector<std::uint8_t> isInside_;  ///< of each surface that no outline cuts: whether it lies inside a solid
  std::vector<LookDirection> fewDirections_ = lookDirections(fewPixels), directions_ = lookDirections(pixels),
                             manyDirections_ = lookDirections(manyPixels);
  std::vector<Region> regions_;
};

/// The barycentric weights of the corners of a piece.
std::vector<glm::dvec2> cornersOf(const Piece& piece) {
  std::vector<glm::dvec2> corners;
  for (std::size_t k = 0; k < piece.size; ++k) corners.push_back(piece.corners[k].weight);
  return corners;
}

/// Grids for cutting surfaces. Each slice is compared with all pieces of its texels, so that many slices need cells.
std::vector<GridSize> gridsOfSlices(const Scene& scene, const SceneSlices& slices) {
  constexpr std::size_t many = 1024, perTexel = 16, maxSide = 4096;  // slices of a triangle
  std::vector<GridSize> grids;
  for (const SlicesOfSurface own : slicesOfSurfaces(scene, slices)) {
    std::size_t count = 0, side = 1;
    for (const std::vector<Slice>& ofTriangle : own) count += ofTriangle.size();
    count /= own.size();
    while (count > many && side < maxSide && side * side * perTexel < count) side *= 2;
    grids.push_back({static_cast<int>(side), static_cast<int>(side)});
  }
  return grids;
}

/// The number of the first triangle of the connected part that contains each triangle of a surface.
std::vector<std::uint32_t> connectedTriangles(const Surface& surface) {
  const std::vector<std::vector<Slice>> noSlices(surface.triangles.size());
  std::vector<std::uint32_t> part(surface.triangles.size());
  for (const std::vector<std::uint32_t>& region : cutSurface(surface, {}, noSlices, 0, Regions::Connected).regions)
    for (const std::uint32_t triangle : region) part[triangle] = *std::min_element(region.begin(), region.end());
  return part;
}

/// The exposed regions that become surfaces of their own: of each connected part all large ones but the largest.
std::vector<std::vector<std::uint32_t>> regionsBehindWalls(const Surface& surface, const CutSurface& cut,
                                                           std::vector<std::vector<std::uint32_t>> exposed) {
  constexpr double minShare = 1.0 / 4096;
  const double smallest = minShare * area(surface);
  const auto areaOf = [&](const std::vector<std::uint32_t>& region) {
    double sum = 0;
    for (const std::uint32_t c : region) sum += cut.cuttings[c].area;
    return sum;
  };
  std::erase_if(exposed, [&](const auto& region) { return areaOf(region) < smallest; });
  if (exposed.size() < 2) return {};
  const std::vector<std::uint32_t> connected = connectedTriangles(surface);
  const auto partOf = [&](const auto& region) { return connected[cut.cuttings[region.front()].triangle]; };
  std::map<std::uint32_t, std::size_t> largest;  // by connected part
  for (std::size_t i = 0; i < exposed.size(); ++i) {
    const auto [found, isNew] = largest.try_emplace(partOf(exposed[i]), i);
    // Not by rounding alone, so that equal halves keep their order.
    if (!isNew && areaOf(exposed[i]) > (1 + 1e-6) * areaOf(exposed[found->second])) found->second = i;
  }
  std::vector<std::vector<std::uint32_t>> behind;
  for (std::size_t i = 0; i < exposed.size(); ++i)
    if (largest.at(partOf(exposed[i])) != i) behind.push_back(std::move(exposed[i]));
  return behind;
}

/// The parts that a surface is separated into: 0, and one per region behind a wall.
class SeparatedSurface {
 public:
  SeparatedSurface(const Surface& surface, const GridSize& grid, const CutSurface& cut,
                   const std::vector<std::vector<std::uint32_t>>& exposed,
                   const std::vector<std::vector<std::uint32_t>>& behind)
      : surface_(surface), grid_(grid), cut_(cut), partOf_(cut.cuttings.size()), parts_(behind.size() + 1) {
    for (const std::vector<std::uint32_t>& region : exposed)
      for (const std::uint32_t c : region) partOf_[c] = 0;
    for (std::size_t part = 0; part < behind.size(); ++part)
      for (const std::uint32_t c : behind[part]) partOf_[c] = part + 1;
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) separate(t);
    std::erase_if(parts_, [](const auto& part) { return part.empty(); });
  }

  std::vector<std::vector<Triangle>> take() { return std::move(parts_); }

 private:
  void separate(std::uint32_t triangle) {
    std::set<std::size_t> parts;
    for (std::uint32_t c = cut_.first[triangle]; c < cut_.first[triangle + 1]; ++c)
      if (partOf_[c]) parts.insert(*partOf_[c]);
    if (parts.size() < 2) return parts_[parts.empty() ? 0 : *parts.begin()].push_back(surface_.triangles[triangle]);
    for (std::uint32_t c = cut_.first[triangle]; c < cut_.first[triangle + 1]; ++c)
      partOf_[c] ? append(triangle, *cut_.cuttings[c].piece, *partOf_[c]) : appendBuried(triangle, cut_.cuttings[c]);
  }

  void append(std::uint32_t triangle, const Piece& piece, std::size_t part) {
    const std::vector<Triangle> triangles = trianglesOf(surface_.triangles[triangle], cornersOf(piece));
    parts_[part].insert(parts_[part].end(), triangles.begin(), triangles.end());
  }

  /// A buried piece belongs to the part beside it. Between two parts each gets a half, so that a picture that shows
  /// the border of the wall by rounding shows light of the same side.
  void appendBuried(std::uint32_t triangle, const Cutting& cutting) {
    const Piece& piece = *cutting.piece;
    const auto corner = [&](std::size_t i) { return piece.corners[i % piece.size].weight; };
    const auto middleOf = [&](std::size_t i) { return (corner(i) + corner(i + 1)) / 2.0; };
    const auto partBeside = [&](std::size_t i) {
      constexpr double step = 1e-3;  // beyond the side, in distances from the centre
      return partAt(triangle, middleOf(i) + step * (middleOf(i) - cutting.centre));
    };
    std::optional<std::size_t> side;  // the first one with a part beside it
    for (std::size_t i = 0; i < piece.size; ++i) {
      const std::optional<std::size_t> part = partBeside(i);
      if (!part) continue;
      if (!side) side = i;
      const std::size_t first = *partBeside(*side);
      if (first == *part) continue;
      // The line in the middle between both sides.
      const glm::dvec2 from = (corner(*side) + corner(i + 1)) / 2.0,
                       along = (corner(*side + 1) + corner(i)) / 2.0 - from;
      std::array<double, 12> distances{};
      for (std::size_t k = 0; k < piece.size; ++k) distances[k] = raster::cross(along, corner(k) - from);
      const Halves halves = split(piece, distances);
      const bool isBelow = raster::cross(along, middleOf(*side) - from) < 0;
      append(triangle, isBelow ? halves.below : halves.above, first);
      return append(triangle, isBelow ? halves.above : halves.below, *part);
    }
    append(triangle, piece, side ? *partBeside(*side) : 0);
  }

  /// The part of an exposed piece at a point of a triangle.
  std::optional<std::size_t> partAt(std::uint32_t triangle, const glm::dvec2& weights) const {
    if (weights.x < 0 || weights.y < 0 || weights.x + weights.y > 1) return std::nullopt;
    return partOf_[cuttingAt(cut_, surface_, grid_, triangle, weights)];
  }

  const Surface& surface_;
  const GridSize& grid_;
  const CutSurface& cut_;
  std::vector<std::optional<std::size_t>> partOf_;  ///< of each cutting; none if it is buried
  std::vector<std::vector<Triangle>> parts_;
};

/// Replaces surfaces by parts; no parts mean that a surface stays.
void replaceByParts(Scene& scene, std::vector<std::vector<std::vector<Triangle>>> partsOf) {
  std::set<std::string> names;
  std::uint32_t curvedParts = 0;
  for (const Surface& surface : scene.surfaces) {
    names.insert(surface.name);
    curvedParts = std::max(curvedParts, surface.curvedPart ? *surface.curvedPart + 1 : 0);
  }
  std::vector<Surface> surfaces;
  std::vector<int> number;  // of each surface after it
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    number.push_back(static_cast<int>(surfaces.size()));
    Surface whole = std::move(scene.surfaces[s]);
    if (partsOf[s].size() < 2) {
      surfaces.push_back(std::move(whole));
      continue;
    }
    for (std::size_t part = 0; part < partsOf[s].size(); ++part) {
      Surface one = whole;
      if (part > 0 || whole.name == whole.family)
        for (std::size_t n = 1; !names.insert(one.name = whole.family + '#' + std::to_string(n)).second;) ++n;
      if (part > 0 && whole.curvedPart) one.curvedPart = curvedParts++;
      one.triangles = std::move(partsOf[s][part]);
      surfaces.push_back(std::move(one));
    }
  }
  for (Surface& surface : surfaces)
    if (surface.twin) surface.twin = number[static_cast<std::size_t>(*surface.twin)];
  scene.surfaces = std::move(surfaces);
}

}  // namespace

std::vector<Exposure> findExposure(const Scene& scene, std::span<const GridSize> sizes) {
  std::vector<Exposure> exposure(scene.surfaces.size());
  if (!hasBacks(scene)) return exposure;
  const RayTree rays(scene);
  const BuriedRegions regions(scene, sizes, triangleSlices(scene, rays), rays);
  raster::parallelFor(exposure.size(),
                      [&](std::size_t s) { exposure[s] = regions.exposureOf(static_cast<std::uint32_t>(s)); });
  return exposure;
}

Scene separatedAtWalls(Scene scene) {
  if (!hasBacks(scene)) return scene;
  const RayTree rays(scene);
  const SceneSlices slices = triangleSlices(scene, rays);
  const std::vector<GridSize> sizes = gridsOfSlices(scene, slices);
  const BuriedRegions regions(scene, sizes, slices, rays, Regions::Connected);
  std::vector<std::vector<std::vector<Triangle>>> partsOf(scene.surfaces.size());
  raster::parallelFor(partsOf.size(), [&](std::size_t s) {
    const CutSurface* const cut = regions.cutOf(static_cast<std::uint32_t>(s));
    if (cut == nullptr || scene.surfaces[s].twin) return;
    const auto exposed = regions.exposedRegions(static_cast<std::uint32_t>(s));
    const auto behind = regionsBehindWalls(scene.surfaces[s], *cut, exposed);
    if (!behind.empty()) partsOf[s] = SeparatedSurface(scene.surfaces[s], sizes[s], *cut, exposed, behind).take();
  });
  replaceByParts(scene, std::move(partsOf));
  return scene;
}

Scene withoutBuried(Scene scene) {
  const std::vector<Exposure> exposure = findExposure(scene, std::vector<GridSize>(scene.surfaces.size(), {1, 1}));
  for (std::size_t s = 0; s < exposure.size(); ++s) {
    std::vector<Triangle>& triangles = scene.surfaces[s].triangles;
    if (exposure[s].isBuried) triangles.clear();
    if (exposure[s].cutTexels.empty()) continue;
    std::vector<Triangle> left;
    for (const TexelPiece& exposed : exposure[s].cutTexels.front().exposed) {
      const std::vector<Triangle> parts = trianglesOf(triangles[exposed.triangle], cornersOf(exposed.piece));
      left.insert(left.end(), parts.begin(), parts.end());
    }
    triangles = std::move(left);
  }
  removeEmptySurfaces(scene);
  return scene;
}

}  // namespace hemitex::radiosity
