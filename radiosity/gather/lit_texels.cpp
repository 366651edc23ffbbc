#include "radiosity/gather/lit_texels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "radiosity/discretization/patch_points.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// The side of a texel in space, for changes of the chart along u and along v.
std::pair<glm::dvec3, glm::dvec3> sidesOf(const Triangle& triangle, const glm::dvec2& texels) {
  const glm::dvec2 b = texels * (triangle.chart[1] - triangle.chart[0]),
                   c = texels * (triangle.chart[2] - triangle.chart[0]);
  const glm::dvec3 p = triangle.position[1] - triangle.position[0], q = triangle.position[2] - triangle.position[0];
  const double determinant = b.x * c.y - b.y * c.x;
  return {(c.y * p - b.y * q) / determinant, (b.x * q - c.x * p) / determinant};
}

/// Whether all triangles of a surface are in contact with one plane.
bool isFlat(const Scene& scene, const Surface& surface) {
  const glm::dvec3 n = normal(surface.triangles.front()), corner = surface.triangles.front().position[0];
  for (const Triangle& triangle : surface.triangles)
    for (const glm::dvec3& other : triangle.position)
      if (std::abs(glm::dot(n, other - corner)) > contactTolerance(scene)) return false;
  return true;
}

/// The place of a texel: the middle of its exposed part, and the whole texel if all of it is exposed and flat.
std::optional<LitPlace> placeOf(const Surface& surface, const Grid& grid, std::uint32_t number, int column, int row,
                                int magnification, bool isFlat) {
  const double side = 1.0 / magnification;
  const auto block = shootingBlock(surface, grid, glm::dvec2(column, row) * side, glm::dvec2(side));
  if (!block) return std::nullopt;
  LitPlace place{number, block->centre};
  if (!isFlat) return place;
  const auto [along1, along2] = sidesOf(surface.triangles[block->centre.triangle],
                                        glm::dvec2(grid.columns, grid.rows) * static_cast<double>(magnification));
  if (block->area >= 0.999 * glm::length(glm::cross(along1, along2))) {
    place.along1 = along1;
    place.along2 = along2;
  }
  return place;
}

/// Gives the texels of a curved surface normals between those of the corners of its triangles.
void smooth(const Surface& surface, const std::vector<std::array<glm::dvec3, 3>>& normals, LitTexels& texels) {
  for (std::optional<LitPlace>& place : texels.places) {
    if (!place) continue;
    SurfacePoint& point = place->point;
    const auto& [a, b, c] = surface.triangles[point.triangle].position;
    const auto share = [&](const glm::dvec3& p, const glm::dvec3& q) {
      return glm::dot(glm::cross(p - point.position, q - point.position), point.normal);
    };
    const std::array<glm::dvec3, 3>& corners = normals[point.triangle];
    const glm::dvec3 mean = share(b, c) * corners[0] + share(c, a) * corners[1] + share(a, b) * corners[2];
    if (glm::dot(mean, point.normal) > 0) point.normal = glm::normalize(mean);
  }
}

/// A source is weak at texels where it raises the light of the sources before it by no more than the first share, and
/// faint where by no more than the second one.
struct SmallShares {
  double weak, faint;
};
constexpr SmallShares ofPictures{0.02, 0.002}, ofElements{std::numeric_limits<double>::infinity(), 0.02};

/// Sources by the light that they would add at some texels if nothing were in between, the most first: then few are not
/// weak.
std::vector<std::size_t> sourcesByLight(const DirectLight& direct, const LitTexels& texels) {
  constexpr std::size_t texelsPerSample = 61;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t source = 0; source < direct.count(); ++source) {
    double light = 0;
    for (std::size_t texel = 0; texel < texels.places.size(); texel += texelsPerSample)
      if (texels.places[texel]) light += direct.factor(source, texels.places[texel]->point);
    order.emplace_back(-light * bandSum(direct.light(source)), source);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> sources;
  for (const auto& [light, source] : order) sources.push_back(source);
  return sources;
}

/// The light of one source at the texels of a surface.
class SourceTexels {
 public:
  SourceTexels(const DirectLight& direct, std::size_t source, const SmallShares& small, LitTexels& texels,
               const std::atomic<bool>* isCancelled)
      : direct_(direct),
        source_(source),
        small_(small),
        texels_(texels),
        isCancelled_(isCancelled),
        factors_(texels.places.size()),
        shares_(texels.places.size(), behind) {}

  void add() {
    raster::parallelFor(static_cast<std::size_t>((texels_.rows + block - 1) / block), [&](std::size_t row) {
      for (int column = 0; column < texels_.columns && !isStopping(); column += block)
        probeBlock(column, static_cast<int>(row) * block);
    });
    raster::parallelFor(static_cast<std::size_t>(texels_.rows), [&](std::size_t row) {
      for (int column = 0; column < texels_.columns && !isStopping(); ++column) addAt(column, static_cast<int>(row));
    });
  }

 private:
  bool isStopping() const { return isCancelled_ && *isCancelled_; }

  static constexpr float behind = -1;  ///< the share of a source behind the horizon
  static constexpr int block = 8;      ///< texels along the side

  /// Whether the source raises the light of the sources before it by no more than a share.
  bool isBelow(double share, std::size_t texel) const {
    return factors_[texel] * bandSum(direct_.light(source_)) <= share * bandSum(texels_.direct[texel]);
  }
  bool areBelow(double share, const std::vector<std::size_t>& texels) const {
    return std::all_of(texels.begin(), texels.end(), [&](std::size_t texel) { return isBelow(share, texel); });
  }

  /// Where the source is weak, the corners and the middle of a block stand for all of it if they see all of the source,
  /// or all see nothing. Where it is faint, their mean does.
  void probeBlock(int left, int low) {
    const int right = std::min(left + block, texels_.columns) - 1, top = std::min(low + block, texels_.rows) - 1;
    std::vector<std::size_t> lit;
    for (int row = low; row <= top; ++row)
      for (int column = left; column <= right; ++column) {
        const std::size_t texel = texels_.at(column, row);
        if (texels_.places[texel]) factors_[texel] = direct_.factor(source_, texels_.places[texel]->point);
        if (factors_[texel] > 0) lit.push_back(texel);
      }
    if (lit.empty()) return;
    const std::optional<float> common =
        areBelow(small_.weak, lit) ? shareOfBlock(left, low, right, top, lit) : std::nullopt;
    for (const std::size_t texel : lit) {
      if (common)
        shares_[texel] = *common;
      else
        probe(texel);
    }
  }

  /// The share that stands for all texels of a block at which the source is weak; none if they must be looked at.
  std::optional<float> shareOfBlock(int left, int low, int right, int top, const std::vector<std::size_t>& lit) {
    float sum = 0;
    int count = 0;
    for (const std::size_t texel : {texels_.at(left, low), texels_.at(right, low), texels_.at(left, top),
                                    texels_.at(right, top), texels_.at((left + right) / 2, (low + top) / 2)})
      if (const float share = probe(texel); share != behind) {
        sum += share;
        ++count;
      }
    if (count == 0) return std::nullopt;
    const float mean = sum / static_cast<float>(count);
    return mean == 0 || mean == 1 || areBelow(small_.faint, lit) ? std::optional(mean) : std::nullopt;
  }

  float probe(std::size_t texel) {
    if (shares_[texel] == behind && factors_[texel] > 0)
      shares_[texel] = static_cast<float>(direct_.probedShare(source_, *texels_.places[texel]));
    return shares_[texel];
  }

  /// Whether the source is seen in part at a texel, or in another way than at a neighbour.
  bool isUneven(int column, int row) const {
    const float share = shares_[texels_.at(column, row)];
    if (share > 0 && share < 1) return true;
    for (int y = std::max(row - 1, 0); y <= std::min(row + 1, texels_.rows - 1); ++y)
      for (int x = std::max(column - 1, 0); x <= std::min(column + 1, texels_.columns - 1); ++x)
        if (const float other = shares_[texels_.at(x, y)]; other != behind && other != share) return true;
    return false;
  }

  void addAt(int column, int row) {
    constexpr std::uint32_t fewRays = DirectLight::maxRays / 8;
    const std::size_t texel = texels_.at(column, row);
    if (shares_[texel] == behind) return;
    const bool isCast = !isBelow(small_.faint, texel) && isUneven(column, row);
    const std::uint32_t rays = isBelow(small_.weak, texel) ? fewRays : DirectLight::maxRays;
    const double share = isCast ? direct_.visibleShare(source_, *texels_.places[texel], rays) : double{shares_[texel]};
    addTo(texels_.direct[texel], direct_.light(source_), factors_[texel] * share);
  }

  const DirectLight& direct_;
  std::size_t source_;
  SmallShares small_;
  LitTexels& texels_;
  const std::atomic<bool>* isCancelled_;
  std::vector<double> factors_;
  std::vector<float> shares_;  ///< in [0, 1], or `behind`
};

}  // namespace

std::vector<LitTexels> texelsOf(const Scene& scene, const Discretization& discretization,
                                const Magnifications& magnifications) {
  const CornerNormals normals = smoothNormals(scene);
  std::vector<LitTexels> all(scene.surfaces.size());
  raster::parallelFor(all.size(), [&](std::size_t s) {
    all[s] = texelsOf(scene, discretization, normals, static_cast<std::uint32_t>(s), magnifications[s]);
  });
  return all;
}

void addDirectLight(const DirectLight& direct, LitTexels& texels, TexelUse use, const std::atomic<bool>* isCancelled) {
  const SmallShares& small = use == TexelUse::Shown ? ofPictures : ofElements;
  for (const std::size_t source : sourcesByLight(direct, texels))
    SourceTexels(direct, source, small, texels, isCancelled).add();
}

CornerNormals smoothNormals(const Scene& scene) {
  using Vertex = std::tuple<std::string_view, std::uint32_t, double, double, double>;  // of a curved part
  const auto vertexOf = [](const Surface& surface, const glm::dvec3& p) {
    return Vertex(surface.family, *surface.curvedPart, p.x, p.y, p.z);
  };
  std::map<Vertex, glm::dvec3> sums;
  for (const Surface& surface : scene.surfaces) {
    if (!surface.curvedPart) continue;
    for (const Triangle& triangle : surface.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3& p = triangle.position[k];
        const glm::dvec3 next = triangle.position[(k + 1) % 3] - p, last = triangle.position[(k + 2) % 3] - p;
        sums[vertexOf(surface, p)] += glm::cross(next, last) / (glm::dot(next, next) * glm::dot(last, last));
      }
  }
  CornerNormals normals(scene.surfaces.size());
  for (std::size_t s = 0; s < normals.size(); ++s) {
    const Surface& surface = scene.surfaces[s];
    if (!surface.curvedPart) continue;
    for (const Triangle& triangle : surface.triangles) {
      std::array<glm::dvec3, 3>& corners = normals[s].emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 sum = sums.at(vertexOf(surface, triangle.position[k]));
        corners[k] = glm::dot(sum, sum) > 0 ? glm::normalize(sum) : glm::dvec3(0);
      }
    }
  }
  return normals;
}

LitTexels texelsOf(const Scene& scene, const Discretization& discretization, const CornerNormals& normals,
                   std::uint32_t surface, int magnification) {
  const Grid& grid = discretization.grids[surface];
  LitTexels texels;
  texels.columns = grid.columns * magnification;
  texels.rows = grid.rows * magnification;
  const std::size_t count = static_cast<std::size_t>(texels.columns) * static_cast<std::size_t>(texels.rows);
  texels.places.resize(count);
  texels.direct = texels.seen = BandTable(count, bandCount(scene));
  const bool isPlane = isFlat(scene, scene.surfaces[surface]);
  raster::parallelFor(static_cast<std::size_t>(texels.rows), [&](std::size_t row) {
    for (int column = 0; column < texels.columns; ++column)
      texels.places[texels.at(column, static_cast<int>(row))] =
          placeOf(scene.surfaces[surface], grid, surface, column, static_cast<int>(row), magnification, isPlane);
  });
  if (scene.surfaces[surface].curvedPart) smooth(scene.surfaces[surface], normals[surface], texels);
  return texels;
}

}  // namespace hemitex::radiosity
