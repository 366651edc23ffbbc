/// A hierarchy of boxes around a scene's triangles: which triangle a ray meets first, and which are near a box. For the
/// few rays that say what is seen from a point; in binary64, so that it sees gaps and solids that are far smaller than
/// an item buffer's depths tell apart.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// Where a ray meets a triangle.
struct TriangleHit {
  std::uint32_t surface = 0, triangle = 0;  ///< in Scene::surfaces, in Surface::triangles
  glm::dvec2 weights{0.0};                  ///< barycentric, of the triangle's corners 1 and 2
  double distance = 0;                      ///< in lengths of the ray's direction
  bool isFront = false;                     ///< whether the ray comes from the triangle's front
};

class RayTree {
 public:
  /// Keeps copies of all corners. Takes n log n for n triangles.
  explicit RayTree(const Scene& scene);

  /// The triangle that a ray meets first. Where faces touch, to within 2^-30 extents of the scene, it is one whose back
  /// the ray meets, if there is one: nothing is seen of the front of a face that touches another.
  std::optional<TriangleHit> firstHit(const glm::dvec3& origin, const glm::dvec3& direction) const;
  /// Whether the ray meets a triangle from its back up to a distance, in lengths of its direction, that faces along it:
  /// whose normal's angle with it has at least this cosine.
  bool meetsBack(const glm::dvec3& origin, const glm::dvec3& direction, double distance, double cosine) const;
  /// Appends the numbers in the scene of the triangles whose boxes meet the box [low, high], in any order.
  void appendNear(const glm::dvec3& low, const glm::dvec3& high, std::vector<std::uint32_t>& numbers) const;

 private:
  struct Leaf {
    glm::dvec3 corner, along1, along2;
    std::uint32_t surface, triangle, number;
  };
  /// The first child of an inner node is the next node. A node of the tree's bottom has triangles instead.
  struct Node {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
    std::uint32_t second = 0;     ///< the other child, or the first triangle
    std::uint32_t triangles = 0;  ///< 0 of an inner node
  };

  /// Calls meet(hit, end) for triangles in the ray's way, the nearer ones first as far as boxes tell, up to `end`,
  /// which meet may bring nearer.
  template <typename Meet>
  void trace(const glm::dvec3& origin, const glm::dvec3& direction, double end, const Meet& meet) const;
  void build(std::uint32_t begin, std::uint32_t end);

  double touching_;
  std::vector<Leaf> leaves_;
  std::vector<Node> nodes_;
};

}  // namespace hemitex::radiosity
