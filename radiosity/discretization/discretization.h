/// The discretization: surfaces become texel grids, texels become elements, blocks of texels become patches. No
/// geometry is cut; all that is stored is how much of the surface lies in each texel (Nielsen and Christensen 2002,
/// section 3).
///
/// Texel (column, row) of a columns x rows grid is the square [column, column+1]/columns x [row, row+1]/rows of the
/// chart. Its area is the exact area of the surface inside it. A texel without area is a *phantom*. A texel whose
/// square is covered for less than a quarter merges into its largest neighbour of the same surface: a sliver element
/// would glow, because the few pixels it is seen in are quantized while its area is tiny. One spill table, from
/// texels to elements, says where every texel's light goes: to its own element, to the one it merged into, or, for a
/// phantom (a sample can fall on one at a chart's border), to the nearest element.
///
/// What lies inside a solid is not exposed (see exposure.h): it has no part in areas and centres, so that it neither
/// receives nor sends. A texel that is wholly buried is a phantom, and one of which less than a quarter is exposed
/// merges.
///
/// Under a quadtree elements are not texels but its leaves: all texels of a leaf spill to one element. A texel is still
/// what slivers are measured by: where one merges with a neighbour, its light goes to that neighbour's leaf.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/geometry/quadtree.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

struct Element {
  double area = 0;  ///< of the exposed surface inside its texels, in the scene's units squared; above 0
  std::uint32_t surface = 0;
  std::uint32_t texel = 0;  ///< row * columns + column of its own texel, the one the others merged into; of a leaf of
                            ///< several texels the first that is one's own
};

/// A block of texels of one surface that shoots as one. A leaf of a quadtree that is larger is a patch of its own.
struct Patch {
  std::uint32_t surface = 0;
  int column = 0, row = 0, width = 0, height = 0;    ///< in texels; at the grid's end a block may be smaller
  std::uint32_t firstElement = 0, elementCount = 0;  ///< in Discretization::patchElements
  int halvings = 0;  ///< of the resolution that it is drawn at, for it shoots little (see patch_subdivision.h)
  int points = 1;    ///< along its side: it shoots from points x points of them; more than 1 only for a single element
  bool isSettled = false;  ///< whether to split it has been decided
  /// Instead of its number, what a turned projection over it is turned by (see turnOf): patches that were renumbered
  /// look as they did.
  std::optional<std::uint32_t> turn = {};
};

/// The texels of one surface.
struct Grid {
  int columns = 1;
  int rows = 1;
  std::uint32_t firstElement = 0, elementCount = 0;  ///< its elements, ordered by texel
  std::uint32_t firstPatch = 0, patchCount = 0;      ///< its patches as they were made, in a row
  std::vector<std::uint32_t> laterPatches = {};      ///< those that parts of them became when they were split
  std::vector<std::uint32_t> spill;                  ///< columns * rows: the element each texel gives its light to
  std::vector<bool> covered;                         ///< columns * rows: whether the texel has area
  std::uint32_t phantoms = 0;                        ///< texels without area
  std::uint32_t buried = 0;                          ///< those of them that have area, but inside solids alone
  std::vector<CutTexel> cutTexels = {};              ///< texels that are buried in part or wholly, ascending
  std::optional<Quadtree> quadtree = {};  ///< whose leaves are the elements; without one every texel is a leaf
};

/// The leaf that holds a texel: what an element with this own texel consists of, but for slivers.
Leaf leafOf(const Grid& grid, std::uint32_t texel);

struct Discretization {
  std::vector<Grid> grids;             ///< one a surface
  std::vector<Element> elements;       ///< surface by surface, by texel within one
  std::vector<std::uint32_t> patchOf;  ///< one an element; by itself, for shots ask for nothing else
  /// One an element, in Surface::triangles: the first that covers the middle of its own texel or leaf, else the one
  /// with the largest piece there.
  std::vector<std::uint32_t> triangleOf;
  /// Surface by surface, row by row, and behind them those that others were split into; none without elements.
  std::vector<Patch> patches;
  std::vector<std::uint32_t> patchElements;  ///< the elements of each patch, ascending
  /// One an element, maps averaged over it and multiplied with the material's values; empty where no surface has a map
  /// of that kind.
  std::vector<glm::dvec3> mappedReflectance, mappedEmission;
};

/// The texels of a surface's grid.
struct GridSize {
  int columns = 1, rows = 1;

  GridSize() = default;
  GridSize(int side) : columns(side), rows(side) {}
  GridSize(int columnCount, int rowCount) : columns(columnCount), rows(rowCount) {}
  bool operator==(const GridSize&) const = default;
};

struct DiscretizationSettings {
  std::optional<int> texels = {};  ///< columns and rows of every surface; 1 to 4096
  /// Instead: the wanted side of a texel in the scene's units, above 0 (see gridSizeOf). With neither, texels have a
  /// size that follows the scene (see followingScene).
  std::optional<double> texelSize = {};
  bool powersOfTwo = false;  ///< with a texel size: grids have 1, 2, 4, ... columns and rows, so that many are alike
  int maxTexels = 4096;      ///< columns and rows that a texel size may ask for; 1 to 4096
  /// Every texel that this asks for is cut into so many along each side, as far as 4096 columns and rows allow: levels
  /// of detail whose texels nest. At least 1. What is named below keeps its number.
  int subdivision = 1;
  /// By surface name or, less binding, family; 1 = not discretized.
  std::map<std::string, GridSize> surfaceTexels = {};
  /// As if all of every surface were exposed, inside solids as well: where solids move, what they bury changes.
  bool isUnburied = false;
  int patch = 4;                    ///< texels along a patch's side; at least 1
  std::optional<int> patches = {};  ///< instead: patches along the longer side of every surface's grid; at least 1
};

/// A surface of one texel: it takes one item ID and no index map, and is Gouraud shaded.
inline bool isDiscretized(const Grid& grid) { return grid.columns > 1 || grid.rows > 1; }

/// A value that the elements of one surface have: of its material, or of each element where maps say it. Refers to the
/// scene or the discretization.
class SurfaceValues {
 public:
  SurfaceValues(const glm::dvec3& ofMaterial, const std::vector<glm::dvec3>& mapped)
      : ofMaterial_(ofMaterial), mapped_(mapped.empty() ? nullptr : mapped.data()) {}

  const glm::dvec3& of(std::uint32_t element) const { return areEqual() ? ofMaterial_ : mapped_[element]; }
  /// Every element has the same for sure.
  bool areEqual() const { return mapped_ == nullptr; }
  /// That of every element is 0 for sure.
  bool areZero() const { return areEqual() && ofMaterial_ == glm::dvec3(0); }

 private:
  const glm::dvec3& ofMaterial_;
  const glm::dvec3* mapped_;
};

/// Diffuse reflectances and emitted radiosities of a surface's elements, maps averaged over each.
SurfaceValues reflectances(const Scene& scene, const Discretization& discretization, std::uint32_t surface);
SurfaceValues emissions(const Scene& scene, const Discretization& discretization, std::uint32_t surface);

/// The same of one element.
glm::dvec3 reflectance(const Scene& scene, const Discretization& discretization, std::uint32_t element);
glm::dvec3 emission(const Scene& scene, const Discretization& discretization, std::uint32_t element);

/// The texels of a grid, and what of them is exposed. Refers to the grid.
inline TexelGrid texelGrid(const Grid& grid) { return {grid.columns, grid.rows, grid.cutTexels}; }

/// The numbers of a surface's patches, ascending.
std::vector<std::uint32_t> patchesOf(const Grid& grid);

/// The area of a patch's elements.
double patchArea(const Discretization& discretization, const Patch& patch);

}  // namespace hemitex::radiosity
