/// Derives the item ID of one pixel by the raster rules, with every number from the vertices to the blend. A reader can
/// check it by hand.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "reference/conformance/trace/fragments.h"

namespace hemitex::reference {

/// The vertex stage, in binary32.
struct DerivedVertex {
  std::uint32_t index;  ///< in DrawList::positions
  glm::vec3 position;   ///< P
  glm::vec3 fromEye;    ///< d = P - E
  glm::vec3 view;       ///< x, y, w
  glm::vec2 texcoord;
};

/// A corner of the clipped triangle, projected and snapped.
struct DerivedCorner {
  raster::ViewVertex view;
  glm::dvec2 q;        ///< x/w and y/w
  glm::ivec2 snapped;  ///< in 1/256 pixel
};

using raster::EdgeKind;

/// The edge opposite a corner, at the sample.
struct DerivedEdge {
  std::int64_t value;  ///< doubled area of the edge and the sample, positive inside
  EdgeKind kind;       ///< decides coverage where the value is 0
};

struct DerivedTexel {
  int width, height;     ///< of the index map: N x M
  glm::dvec2 position;   ///< u N and v M
  raster::ItemId index;  ///< of the fragment's texel
};

/// A sum of the blend, of one channel or of whole item IDs.
struct DerivedSum {
  int bits;
  std::uint64_t offset, texel;
  std::uint64_t result;  ///< clamped, or modulo 2^bits
};

/// The next triangle behind the visible one.
struct RunnerUp {
  DrawnTriangle drawn;
  double inverseDepth;               ///< 1/w
  double difference;                 ///< 1/w of the visible triangle minus this one; 0 exactly where they are equal
  std::optional<double> depth = {};  ///< as in Derivation
};

/// Real numbers are exact values rounded once to binary64. Those of `visible` are rounded more often.
struct Derivation {
  Fragment visible;
  std::array<DerivedVertex, 3> vertices;
  std::vector<raster::ClipPlane> cutBy;  ///< planes that cut off at least one vertex
  int piece = 0, pieces = 1;             ///< index of the triangle in its fan, size of the fan
  std::array<DerivedCorner, 3> corners;
  glm::ivec2 sample;  ///< in 1/256 pixel
  std::int64_t area;  ///< doubled and signed
  std::array<DerivedEdge, 3> edges;
  std::array<double, 3> weights;      ///< barycentric
  double inverseDepth;                ///< 1/w
  std::optional<double> depth;        ///< the stored depth, or z/w in clip space; else none, where 1/w is the depth
  glm::dvec2 coordinates;             ///< u, v
  std::optional<DerivedTexel> texel;  ///< none without an index map, or on a back
  std::vector<DerivedSum> sums;       ///< clamped add: one per channel; integer add: one; replace: none
  std::optional<RunnerUp> runnerUp;
};

/// Derives the item ID of pixel (column, row) of the viewport; nothing for a background pixel. `fragments` are those at
/// the pixel (fragmentsAt).
std::optional<Derivation> derive(const raster::DrawList& list, const raster::Face& face,
                                 const std::vector<Fragment>& fragments, int column, int row);

}  // namespace hemitex::reference
