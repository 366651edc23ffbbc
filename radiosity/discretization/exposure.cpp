#include "radiosity/discretization/exposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "radiosity/discretization/cut_surface.h"
#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/discretization/texel_areas.h"
#include "radiosity/discretization/triangle_slices.h"
#include "radiosity/geometry/tangent_along.h"
#include "radiosity/scene/ray_tree.h"
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
/// A region is exposed if exposed fronts are at least this share of all exposed fronts and backs that it sees [.03 to
/// .3]. Inside a solid it is 0, but for rays through cracks.
constexpr double minExposed = 0.1;
/// It is also exposed if lights are at least this share of its view, whatever surrounds it [.0005 to .05].
constexpr double minLights = 0.005;
/// Opposite faces at the same place touch if the cosine of the angle between them is at least this [.9 to .999999].
constexpr double touchingCosine = 0.999;
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

/// Finds the buried regions.
class BuriedRegions {
 public:
  /// `slices` has one entry per triangle of the scene.
  BuriedRegions(const Scene& scene, std::span<const GridSize> sizes, const std::vector<std::vector<Slice>>& slices,
                const RayTree& rays)
      : scene_(scene), sizes_(sizes), cut_(scene.surfaces.size()), regionOf_(scene.surfaces.size()), rays_(rays) {
    cutSurfaces(slices);
    std::vector<std::optional<Seen>> seen(regions_.size());
    raster::parallelFor(regions_.size(), [&](std::size_t r) { seen[r] = seenFrom(regions_[r]); });
    for (std::size_t r = 0; r < regions_.size(); ++r) regions_[r].isBuried = seen[r].has_value();
    settle(seen);
  }

  std::vector<CutTexel> cutTexels(std::uint32_t surface) const {
    std::vector<CutTexel> cut;
    if (!cut_[surface]) return cut;
    std::map<std::uint32_t, std::vector<Cutting>> exposedIn;
    bool hasExposed = false;
    const std::vector<Cutting>& cuttings = cut_[surface]->cuttings;
    for (std::size_t c = 0; c < cuttings.size(); ++c)
      if (regions_[regionOf_[surface][c]].isBuried) exposedIn[cuttings[c].texel];
    for (std::size_t c = 0; c < cuttings.size(); ++c) {
      if (regions_[regionOf_[surface][c]].isBuried) continue;
      hasExposed = true;
      if (const auto found = exposedIn.find(cuttings[c].texel); found != exposedIn.end())
        found->second.push_back(cuttings[c]);
    }
    if (!hasExposed) return cut;
    for (auto& [texel, some] : exposedIn) cut.push_back({texel, piecesOf(surface, texel, some)});
    return cut;
  }

 private:
  void cutSurfaces(const std::vector<std::vector<Slice>>& slices) {
    std::vector<std::size_t> first{0};
    for (const Surface& surface : scene_.surfaces) first.push_back(first.back() + surface.triangles.size());
    raster::parallelFor(scene_.surfaces.size(), [&](std::size_t s) {
      const auto own = std::span(slices).subspan(first[s], first[s + 1] - first[s]);
      if (std::all_of(own.begin(), own.end(), [](const auto& some) { return some.empty(); })) return;
      cut_[s] = cutSurface(scene_.surfaces[s], sizes_[s], own, eyeInset * scene_.extent);
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

  /// The sum of the views from some points of a region. Nothing if a point sees no back, or if the region emits and
  /// sees any front; then the region is exposed.
  std::optional<Seen> seenFrom(const Region& region) const {
    Seen all;
    for (const std::uint32_t number : somePoints(region)) {
      const Cutting& cutting = cut_[region.surface]->cuttings[number];
      const Seen seen = seenFrom(region.surface, cutting);
      if (seen.backs == 0) return std::nullopt;
      all.backs += seen.backs;
      all.exposedFronts += seen.exposedFronts;
      all.lights += seen.lights;
      for (const auto& [other, share] : seen.regions) all.regions[other] += share;
      ++all.points;
    }
    if (emits(region.surface) && seesFronts(all)) return std::nullopt;
    return all;
  }

  static bool seesFronts(const Seen& seen) { return seen.exposedFronts > 0 || !seen.regions.empty(); }

  /// The view from the middle of a cutting.
  Seen seenFrom(std::uint32_t surface, const Cutting& cutting) const {
    const SurfacePoint point = pointOn(scene_.surfaces[surface], cutting.triangle, cutting.centre);
    const glm::dvec3 eye = eyeOver(scene_, surface, point);
    // A face that touches another sees the inside of the solid behind that face, or the outside of the scene.
    const bool isTouching = rays_.meetsBack(eye, -point.normal, 2 * eyeHeight * scene_.extent, touchingCosine);
    Seen seen = look(eye, point.normal, fewDirections_);
    if (seen.backs < 1 - rounding) seen = look(eye, point.normal, directions_);
    if (emits(surface) && !seesFronts(seen)) seen = look(eye, point.normal, manyDirections_);
    if (isTouching) seen.backs += 1;
    return seen;
  }

  /// The largest cutting of a region and some others, evenly by area. Slivers are too near to outlines for a reliable
  /// view.
  std::vector<std::uint32_t> somePoints(const Region& region) const {
    const std::vector<Cutting>& cuttings = cut_[region.surface]->cuttings;
    double whole = 0, before = 0;
    for (const std::uint32_t c : region.cuttings) whole += cuttings[c].area;
    std::vector<std::uint32_t> some;
    for (const std::uint32_t c : region.cuttings) {
      if (before >= static_cast<double>(some.size()) / pointsOfRegion * whole) some.push_back(c);
      before += cuttings[c].area;
    }
    return some;
  }

  Seen look(const glm::dvec3& eye, const glm::dvec3& normal, const std::vector<LookDirection>& directions) const {
    Seen seen;
    const glm::dvec3 x = tangentAlong(normal, glm::dvec3(0)), y = glm::cross(normal, x);
    for (const LookDirection& look : directions) {
      const auto hit = rays_.firstHit(eye, glm::dmat3(x, y, normal) * look.direction);
      if (!hit) continue;
      if (!hit->isFront)
        seen.backs += look.share;
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

  bool emits(std::uint32_t surface) const {
    return scene_.materials[static_cast<std::size_t>(scene_.surfaces[surface].material)].emission != glm::dvec3(0);
  }

  void addExposed(std::uint32_t surface, double share, Seen& seen) const {
    seen.exposedFronts += share;
    if (emits(surface)) seen.lights += share;
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

  /// The exposed pieces of a texel, by triangle.
  std::vector<TexelPiece> piecesOf(std::uint32_t surface, std::uint32_t texel,
                                   const std::vector<Cutting>& cuttings) const {
    const GridSize& grid = sizes_[surface];
    const auto columns = static_cast<std::uint32_t>(grid.columns);
    std::vector<TexelPiece> pieces;
    for (const Cutting& cutting : cuttings) {
      const auto corners = inTexels(scene_.surfaces[surface].triangles[cutting.triangle], grid.columns, grid.rows);
      pieces.push_back({cutting.triangle,
                        cutting.piece ? *cutting.piece : clippedToCell(corners, texel % columns, texel / columns)});
    }
    return pieces;
  }

  const Scene& scene_;
  std::span<const GridSize> sizes_;
  std::vector<std::optional<CutSurface>> cut_;        ///< of surfaces with slices
  std::vector<std::vector<std::uint32_t>> regionOf_;  ///< of each cutting, by surface
  const RayTree& rays_;
  std::vector<LookDirection> fewDirections_ = lookDirections(fewPixels), directions_ = lookDirections(pixels),
                             manyDirections_ = lookDirections(manyPixels);
  std::vector<Region> regions_;
};

}  // namespace

std::vector<std::vector<CutTexel>> cutTexels(const Scene& scene, std::span<const GridSize> sizes) {
  std::vector<std::vector<CutTexel>> cut(scene.surfaces.size());
  if (std::all_of(scene.surfaces.begin(), scene.surfaces.end(), [](const Surface& s) { return s.twin.has_value(); }))
    return cut;
  const RayTree rays(scene);
  const std::vector<std::vector<Slice>> slices = triangleSlices(scene, rays);
  if (std::all_of(slices.begin(), slices.end(), [](const auto& some) { return some.empty(); })) return cut;
  const BuriedRegions regions(scene, sizes, slices, rays);
  raster::parallelFor(cut.size(), [&](std::size_t s) { cut[s] = regions.cutTexels(static_cast<std::uint32_t>(s)); });
  return cut;
}

}  // namespace hemitex::radiosity
