/// A bounding volume hierarchy over the triangles of a scene: the first hit of a ray, and the triangles near a box. It
/// is used for the few rays that test visibility from a point. It computes in double precision, which resolves gaps and
/// solids far smaller than the depths of an item buffer do. Rays pass through the holes of cut-outs.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The intersection of a ray and a triangle.
struct TriangleHit {
  std::uint32_t surface = 0, triangle = 0;  ///< in Scene::surfaces, in Surface::triangles
  glm::dvec2 weights{0.0};                  ///< barycentric, of the triangle's corners 1 and 2
  double distance = 0;                      ///< in lengths of the ray's direction
  bool isFront = false;                     ///< whether the ray meets the front of the triangle
  std::uint32_t instance = 0;               ///< in Scene::instances
  std::int32_t shell = 0;                   ///< of the triangle
};

class RayTree {
 public:
  /// Copies all corners. Takes O(n log n) time for n triangles.
  explicit RayTree(const Scene& scene);

  /// The first triangle that a ray meets, up to a distance in lengths of its direction. If faces are in contact (see
  /// contactTolerance), a hit of a back comes first. The reason: the front of a face that touches another is invisible.
  /// Rays pass through backs that are backed.
  std::optional<TriangleHit> firstHit(const glm::dvec3& origin, const glm::dvec3& direction,
                                      double distance = std::numeric_limits<double>::infinity()) const;
  /// Whether a triangle lies on the ray, up to a distance in lengths of its direction; not backs that are backed.
  bool isBlocked(const glm::dvec3& origin, const glm::dvec3& direction, double distance) const;
  /// Whether the ray meets the back of a triangle that faces along it, up to a distance in lengths of its direction.
  /// "Along" means that the cosine of the angle between the normal and the ray is at least `cosine`. Triangles of the
  /// surface `except` in the first instance do not count.
  bool meetsBack(const glm::dvec3& origin, const glm::dvec3& direction, double distance, double cosine,
                 std::uint32_t except = noSurface) const;
  /// Calls visit(hit) for all triangles that a ray meets, in any order, also for backs that are backed and for
  /// Scene::covered, which have no surface.
  void visitHits(const glm::dvec3& origin, const glm::dvec3& direction,
                 const std::function<void(const TriangleHit&)>& visit) const;
  /// Appends the numbers of the triangles whose boxes intersect the box [low, high], in any order, except those of one
  /// surface in the first instance.
  void appendNear(const glm::dvec3& low, const glm::dvec3& high, std::vector<std::uint32_t>& numbers,
                  std::uint32_t except = noSurface) const;

  static constexpr std::uint32_t noSurface = UINT32_MAX;

 private:
  struct Leaf {
    glm::dvec3 corner, along1, along2;
    TrianglePlace place;
    std::uint32_t number;
    bool isBacked, isReflected;
    std::int32_t shell;
    bool isHidden;                               ///< one of Scene::covered
    std::shared_ptr<const HoledTriangle> holed;  ///< null without a cut-out

    /// The surface of a triangle of the first instance.
    std::uint32_t firstSurface() const { return place.instance == 0 ? place.surface : noSurface; }
  };
  /// The first child of an inner node is the next node. A leaf node has triangles instead.
  struct Node {
    std::array<glm::dvec3, 2> corners;  ///< of the box around all triangles below: low and high
    std::uint32_t second = 0;           ///< the second child, or the first triangle
    std::uint32_t triangles = 0;        ///< 0 for an inner node
    std::uint32_t surface = noSurface;  ///< of all triangles below, if they have the same in the first instance
  };

  /// Calls visit(leaf, end) for the triangles of leaf nodes whose entryOf(node, end) is below `end`, and below which
  /// all inner nodes' are, the smaller first. The callback may reduce `end`.
  template <typename Entry, typename Visit>
  void walk(double end, const Entry& entryOf, const Visit& visit) const;
  /// Calls meet(hit, leaf, end) for triangles along the ray up to `end`, approximately in order of distance, without
  /// those of the surface `except` in the first instance.
  template <typename Meet>
  void trace(const glm::dvec3& origin, const glm::dvec3& direction, double end, const Meet& meet,
             std::uint32_t except = noSurface) const;
  void build(std::uint32_t begin, std::uint32_t end, int depth);

  double touching_;
  std::vector<Leaf> leaves_;
  std::vector<Node> nodes_;
};

}  // namespace hemitex::radiosity
