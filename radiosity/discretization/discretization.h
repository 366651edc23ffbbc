/// The discretization: surfaces become texel grids, texels become elements, blocks of texels become patches. No
/// geometry is cut; the discretization stores the area of the surface in each texel (Nielsen and Christensen 2002,
/// section 3).
///
/// Texel (column, row) of a columns x rows grid is the square [column, column+1]/columns x [row, row+1]/rows of the
/// chart. Its area is the exact area of the surface inside it. A texel without area is a *phantom*. A texel covered by
/// less than a quarter is a sliver and merges into its largest neighbour of the same surface. Otherwise its radiosity
/// would be too large, because few quantized pixels would be divided by a tiny area.
///
/// One table, the texel-to-element map (`elementOfTexel`), maps each texel to the element that receives its light. That
/// is its own element, the element it merged into, or the nearest element for a phantom. (A sample at a chart's border
/// can select a phantom.)
///
/// A part of a surface inside a solid is not exposed (see exposure.h). It does not count in areas and centres, so that
/// it neither receives nor sends light. The holes of a cut-out count as buried. A completely buried texel is a phantom;
/// a texel of which less than a quarter is exposed merges.
///
/// With a quadtree the elements are its leaves, and all texels of a leaf map to one element. Slivers are still merged
/// per texel: a sliver maps to the leaf of the neighbour that it merged with.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/geometry/quadtree.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

struct Element {
  double area = 0;  ///< of the exposed surface inside its texels, in squared units of the scene; above 0
  std::uint32_t surface = 0;
  std::uint32_t texel = 0;  ///< row * columns + column of its own texel, which others may have merged into; for a leaf,
                            ///< the first own texel
};

/// A block of texels of one surface that shoots as one. A quadtree leaf that is larger is a patch of its own.
struct Patch {
  std::uint32_t number = 0;  ///< in Patches::list
  std::uint32_t surface = 0;
  int column = 0, row = 0, width = 0, height = 0;  ///< in texels; the last block of a row or a column may be smaller
  std::vector<std::uint32_t> elements = {};        ///< those whose own texels lie in the block, ascending; at least one
  double area = 0;                                 ///< of its elements
  int halvings =
      0;  ///< halvings of the resolution that it is drawn at, because it shoots little (see patch_subdivision.h)
  int points = 1;  ///< along its side: it shoots from points x points points; more than 1 only for a single element
  bool isSettled = false;  ///< whether its splitting has been decided
  /// Number for the rotation of a projection that is rotated per patch (see turnOf): the first number of the patch, so
  /// that it keeps its rotation when an edit of the scene changes its number.
  std::uint32_t turn = 0;
};

/// The elements divided into patches. Each element belongs to one patch.
struct Patches {
  std::vector<Patch> list;               ///< surface by surface, row by row, then those that others were split into
  std::vector<std::uint32_t> ofElement;  ///< one per element; a separate array, because shots read nothing else
};

/// The texels of one surface.
struct Grid {
  int columns = 1;
  int rows = 1;
  std::uint32_t firstElement = 0, elementCount = 0;  ///< its elements, ordered by texel
  std::uint32_t firstPatch = 0, patchCount = 0;      ///< its original patches, consecutive
  std::vector<std::uint32_t> elementOfTexel;  ///< columns * rows: the element that receives the light of each texel
  std::vector<bool> covered;                  ///< columns * rows: whether the texel has area
  std::uint32_t phantoms = 0;                 ///< number of texels without area
  std::uint32_t buried = 0;                   ///< number of those that have area only inside solids
  std::vector<CutTexel> cutTexels = {};       ///< texels that are partly or completely buried, ascending
  bool isDark = false;  ///< whether the surface is buried completely or all holes: it keeps its elements, which do not
                        ///< emit
  std::shared_ptr<const TexelMask> mask = {};  ///< of a cut-out: n x m texels per texel of the grid
  std::optional<Quadtree> quadtree = {};       ///< its leaves are the elements; without quadtree each texel is a leaf
};

/// The numbers of consecutive elements, for loops. (clang 14 cannot compile std::views::iota of g++ 12's library.)
struct ElementNumbers {
  struct Iterator {
    std::uint32_t element;

    std::uint32_t operator*() const { return element; }
    Iterator& operator++() { return ++element, *this; }
    bool operator==(const Iterator&) const = default;
  };
  std::uint32_t first, count;

  Iterator begin() const { return {first}; }
  Iterator end() const { return {first + count}; }
};

/// The numbers of the elements of a surface, ascending.
inline ElementNumbers elementsOf(const Grid& grid) { return {grid.firstElement, grid.elementCount}; }

/// The leaf that contains a texel. An element with this own texel consists of the leaf, except for slivers.
Leaf leafOf(const Grid& grid, std::uint32_t texel);

struct Discretization {
  std::vector<Grid> grids;        ///< one per surface
  std::vector<Element> elements;  ///< surface by surface, by texel within a surface
  /// One per element, in Surface::triangles: the first triangle that covers the middle of the own texel or leaf, else
  /// the triangle with the largest piece there.
  std::vector<std::uint32_t> triangleOf;
  Patches patches;
  /// One per element: the average of the map times the value of the material. Empty if no surface has a map of that
  /// kind.
  std::vector<glm::dvec3> mappedReflectance, mappedEmission;
};

/// The number of texels of a surface's grid.
struct GridSize {
  int columns = 1, rows = 1;

  GridSize() = default;
  GridSize(int side) : columns(side), rows(side) {}
  GridSize(int columnCount, int rowCount) : columns(columnCount), rows(rowCount) {}
  bool operator==(const GridSize&) const = default;
};

struct DiscretizationSettings {
  std::optional<int> texels = {};  ///< columns and rows of all surfaces; 1 to 4096
  /// Alternatively the side of a texel in units of the scene, above 0 (see gridSizeOf). With neither, the texel size is
  /// derived from the scene (see followingScene).
  std::optional<double> texelSize = {};
  bool powersOfTwo = false;  ///< with a texel size: grids have 1, 2, 4, ... columns and rows, so that many are equal
  int maxTexels = 4096;      ///< maximum of columns and rows with a texel size; 1 to 4096
  /// Divides each texel from the settings above into this number along each side, up to 4096 columns and rows: nested
  /// levels of detail. At least 1. Does not change surfaceTexels.
  int subdivision = 1;
  /// By surface name or, with lower priority, family; 1 = not discretized.
  std::map<std::string, GridSize> surfaceTexels = {};
  /// Treats all surfaces as completely exposed, also inside solids. For moving solids, whose buried areas change.
  bool isUnburied = false;
  int patch = 4;                    ///< texels along the side of a patch; at least 1
  std::optional<int> patches = {};  ///< alternatively: patches along the longer side of each grid; at least 1
};

/// A surface of one texel takes one item ID without an index map, and is Gouraud shaded.
inline bool isDiscretized(const Grid& grid) { return grid.columns > 1 || grid.rows > 1; }

/// A value of the elements of one surface: that of the material, or one value per element if there are maps. Keeps
/// references to the scene or the discretization.
class SurfaceValues {
 public:
  SurfaceValues(const glm::dvec3& ofMaterial, const std::vector<glm::dvec3>& mapped)
      : ofMaterial_(ofMaterial), mapped_(mapped.empty() ? nullptr : mapped.data()) {}

  const glm::dvec3& of(std::uint32_t element) const { return areEqual() ? ofMaterial_ : mapped_[element]; }
  /// True only if all elements have the same value.
  bool areEqual() const { return mapped_ == nullptr; }
  /// True only if all elements have the value 0.
  bool areZero() const { return areEqual() && ofMaterial_ == glm::dvec3(0); }

 private:
  const glm::dvec3& ofMaterial_;
  const glm::dvec3* mapped_;
};

/// A value of each element, by its number, such as its radiosity.
using ElementValues = std::function<glm::dvec3(std::uint32_t element)>;

/// The values of a list, which must outlive the result.
inline ElementValues valuesIn(const std::vector<glm::dvec3>& list) {
  return [&list](std::uint32_t element) { return list[element]; };
}

/// Diffuse reflectances and emitted radiosities of the elements of a surface; maps are averaged over each element.
SurfaceValues reflectances(const Scene& scene, const Discretization& discretization, std::uint32_t surface);
SurfaceValues emissions(const Scene& scene, const Discretization& discretization, std::uint32_t surface);

/// As above, for one element.
glm::dvec3 reflectance(const Scene& scene, const Discretization& discretization, std::uint32_t element);
glm::dvec3 emission(const Scene& scene, const Discretization& discretization, std::uint32_t element);

/// The texels of a grid, its cut texels and its holes, unless the surface has nothing else. Keeps references to the
/// grid.
inline TexelGrid texelGrid(const Grid& grid) {
  return {grid.columns, grid.rows, grid.cutTexels, grid.isDark ? nullptr : grid.mask.get()};
}

/// The numbers of the patches of each of `surfaces` surfaces, ascending.
std::vector<std::vector<std::uint32_t>> patchesOfSurfaces(const Patches& patches, std::size_t surfaces);

/// Replaces a patch by parts, which have its elements: the first part gets its number, the others are appended.
void replacePatch(Patches& patches, std::uint32_t number, std::vector<Patch> parts);

}  // namespace hemitex::radiosity
