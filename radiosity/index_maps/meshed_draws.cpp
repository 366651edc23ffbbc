#include "radiosity/index_maps/meshed_draws.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/discretization/texel_areas.h"
#include "radiosity/geometry/grid_clipping.h"
#include "raster/base/cross.h"

namespace hemitex::radiosity {
namespace {

using raster::cross;

/// The weights, of the triangle's corners 1 and 2, of the projection of a point onto the plane of the triangle.
glm::dvec2 weightsInPlane(const Triangle& triangle, const glm::dvec3& point) {
  const glm::dvec3 a = triangle.position[1] - triangle.position[0], b = triangle.position[2] - triangle.position[0],
                   p = point - triangle.position[0];
  const glm::dvec3 n = glm::cross(a, b);
  return glm::dvec2(glm::dot(glm::cross(p, b), n), glm::dot(glm::cross(a, p), n)) / glm::dot(n, n);
}

template <typename Vector>
Vector at(const std::array<Vector, 3>& corner, const glm::dvec2& weight) {
  return (1 - weight.x - weight.y) * corner[0] + weight.x * corner[1] + weight.y * corner[2];
}

bool turnsLeftEverywhere(const std::array<glm::dvec2, 4>& corner) {
  for (std::size_t k = 0; k < 4; ++k)
    if (!(cross(corner[(k + 1) % 4] - corner[k], corner[(k + 2) % 4] - corner[(k + 1) % 4]) > 0)) return false;
  return true;
}

/// The convex quad of two triangles of a fan, with corners in texels; nothing if they are not in one plane with one
/// affine chart. The test allows for binary32 positions and 24-bit chart coordinates. Its weights are those of the
/// first triangle.
std::optional<Piece> quadOf(const Triangle& first, const Triangle& second, const Grid& grid, double extent) {
  if (first.polygon != second.polygon || first.position[0] != second.position[0] ||
      first.position[2] != second.position[1] || first.chart[0] != second.chart[0] || first.chart[2] != second.chart[1])
    return std::nullopt;
  const glm::dvec2 weight = weightsInPlane(first, second.position[2]);
  if (glm::distance(at(first.position, weight), second.position[2]) > 0x1p-24 * extent ||
      glm::distance(at(first.chart, weight), second.chart[2]) > 0x1p-22)
    return std::nullopt;
  Piece quad = wholeTriangle(inTexels(first, grid.columns, grid.rows));
  quad.corners[quad.size++] = {inTexels(second, grid.columns, grid.rows)[2], weight};
  std::array<glm::dvec2, 4> corner;
  for (std::size_t k = 0; k < 4; ++k) corner[k] = quad.corners[k].grid;
  const bool isConvex =
      turnsLeftEverywhere(corner) || turnsLeftEverywhere({corner[3], corner[2], corner[1], corner[0]});
  return isConvex ? std::optional(quad) : std::nullopt;
}

using Place = std::array<std::int64_t, 3>;

struct HashOfPlace {
  std::size_t operator()(const Place& place) const {
    return std::hash<std::string_view>()({reinterpret_cast<const char*>(place.data()), sizeof place});
  }
};

/// Merges positions on a grid of 2^-30 extents or finer.
class Corners {
 public:
  Corners(const glm::dvec3& origin, double extent) : origin_(origin), unit_(std::ldexp(1.0, std::ilogb(extent) - 30)) {}

  /// The number of a position, the same for all positions at one place of the grid. Appends new positions.
  std::uint32_t numberOf(const glm::dvec3& position, std::vector<glm::vec3>& positions) {
    Place place;
    glm::vec3 rounded;
    for (int axis = 0; axis < 3; ++axis) {
      const double units = std::nearbyint((position[axis] - origin_[axis]) / unit_);
      place[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(units);
      rounded[axis] = static_cast<float>(units * unit_);
    }
    const auto [known, isNew] = numbers_.try_emplace(place, static_cast<std::uint32_t>(positions.size()));
    if (isNew) positions.push_back(rounded);
    return known->second;
  }

 private:
  glm::dvec3 origin_;
  double unit_;
  std::unordered_map<Place, std::uint32_t, HashOfPlace> numbers_;
};

/// Appends the pieces of the surfaces, one surface at one instance at a time.
class Mesher {
 public:
  Mesher(const Scene& scene, const Discretization& discretization, const IdLayout& layout)
      : scene_(scene), discretization_(discretization), layout_(layout), corners_(scene.origin, scene.extent) {
    draws_.list.format = layout.format;
    draws_.list.blend = layout.blend;
  }

  void append(std::size_t surface, const Instance& instance) {
    instance_ = instance;
    const std::vector<Triangle>& triangles = scene_.surfaces[surface].triangles;
    const Grid& grid = discretization_.grids[surface];
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      startTriangle();
      const auto quad = t + 1 < triangles.size() ? quadOf(triangles[t], triangles[t + 1], grid, scene_.extent)
                                                 : std::optional<Piece>();
      cut(surface, triangles[t], quad.value_or(wholeTriangle(inTexels(triangles[t], grid.columns, grid.rows))));
      if (!quad) continue;
      startTriangle();
      ++t;
    }
  }

  MeshedDraws finish() {
    startTriangle();
    draws_.list.texcoords.resize(draws_.list.positions.size());
    return std::move(draws_);
  }

 private:
  void startTriangle() { draws_.firstPiece.push_back(static_cast<std::uint32_t>(draws_.list.indices.size() / 3)); }

  void cut(std::size_t surface, const Triangle& triangle, const Piece& polygon) {
    const Grid& grid = discretization_.grids[surface];
    forEachCellOf(polygon, [&](std::int64_t column, std::int64_t row, const Piece& piece) {
      if (share(piece) == 0) return;
      const std::uint32_t element = grid.elementOfTexel[texelOfCell(column, row, grid.columns, grid.rows)];
      const auto append = [&](const Piece& part) {
        appendPiece(triangle, part, idOf(discretization_, layout_, element));
      };
      if (grid.mask)
        forEachOpaquePart(*grid.mask, glm::dvec2(grid.columns, grid.rows), piece, append);
      else
        append(piece);
    });
  }

  /// Appends a piece as a fan; corners at the same place are merged.
  void appendPiece(const Triangle& triangle, const Piece& piece, raster::ItemId id) {
    std::vector<std::uint32_t> outline;
    for (std::size_t i = 0; i < piece.size; ++i) {
      const std::uint32_t corner =
          corners_.numberOf(instance_(at(triangle.position, piece.corners[i].weight)), draws_.list.positions);
      if (outline.empty() || corner != outline.back()) outline.push_back(corner);
    }
    while (outline.size() > 1 && outline.back() == outline.front()) outline.pop_back();
    if (instance_.reflects()) std::reverse(outline.begin(), outline.end());
    for (std::size_t i = 2; i < outline.size(); ++i) appendTriangle({outline[0], outline[i - 1], outline[i]}, id);
  }

  void appendTriangle(const std::array<std::uint32_t, 3>& corners, raster::ItemId id) {
    raster::DrawList& list = draws_.list;
    if (list.draws.empty() || list.draws.back().offset != id)
      list.draws.push_back({.first = static_cast<std::uint32_t>(list.indices.size()),
                            .offset = id,
                            .back = raster::backId(layout_.format)});
    list.indices.insert(list.indices.end(), corners.begin(), corners.end());
    list.draws.back().count += 3;
  }

  const Scene& scene_;
  const Discretization& discretization_;
  const IdLayout& layout_;
  Instance instance_ = {};  ///< of what is appended
  MeshedDraws draws_;
  Corners corners_;
};

}  // namespace

MeshedDraws makeMeshedDraws(const Scene& scene, const Discretization& discretization, const IdLayout& layout) {
  Mesher mesher(scene, discretization, layout);
  for (const Instance& instance : scene.instances)
    for (std::size_t surface = 0; surface < scene.surfaces.size(); ++surface) mesher.append(surface, instance);
  return mesher.finish();
}

MeshedRenderer::MeshedRenderer(std::unique_ptr<raster::ItemBufferRenderer> pieces,
                               std::vector<std::uint32_t> firstPiece)
    : pieces_(std::move(pieces)), firstPiece_(std::move(firstPiece)) {}

void MeshedRenderer::draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
                          std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) {
  std::vector<std::uint32_t> skippedPieces;
  for (const std::uint32_t triangle : skipped)
    for (std::uint32_t piece = firstPiece_[triangle]; piece < firstPiece_[triangle + 1]; ++piece)
      skippedPieces.push_back(piece);
  pieces_->draw(faces, skippedPieces, buffers, drawn);
}

}  // namespace hemitex::radiosity
