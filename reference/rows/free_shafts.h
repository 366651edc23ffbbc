/// Whether nothing lies between two facets: a proof, without samples, that each sees all of the other that is in front
/// of it.
///
/// All light between two convex polygons runs in their convex hull, the shaft. A polygon that a plane separates from
/// the shaft hides nothing. The planes that are tried: those of the three polygons, those of the axes, and those along
/// an edge of one polygon and the line between the middles of the other two. Source of the idea: Haines and Wallace,
/// Shaft culling for efficient ray-cast radiosity, Eurographics Workshop on Rendering (1991).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/geometry/nearest_boxes.h"
#include "reference/truth/closed_forms/merged_pieces.h"

namespace hemitex::reference {

class FreeShafts {
 public:
  /// All facets of a scene at all instances, in its frame; planar.
  explicit FreeShafts(std::vector<ConvexPolygons> facets);

  const ConvexPolygons& polygonsOf(std::uint32_t facet) const { return facets_[facet]; }
  /// Whether the shafts of two facets are certainly free. If not, something may be hidden, or not.
  bool isFree(std::uint32_t from, std::uint32_t to) const;
  /// Whether a part of the back of `to` is in front of `from`, hidden or not.
  bool maySeeBack(std::uint32_t from, std::uint32_t to) const;

 private:
  struct Part {
    std::uint32_t facet;
    std::vector<glm::dvec3> corners;
    glm::dvec3 normal;
  };

  bool isFree(const Part& from, const Part& to) const;

  std::vector<ConvexPolygons> facets_;
  std::vector<Part> parts_;           ///< facet by facet
  std::vector<std::uint32_t> first_;  ///< the first part of each facet; one more at the end
  radiosity::NearestBoxes boxes_;     ///< of the parts
};

}  // namespace hemitex::reference
