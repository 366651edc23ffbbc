/// View bounds: what the scissor rectangle of a face shows of the scene, as half-spaces that boxes are held against.
/// Everything leaves room for what the vertex stage, clipping and snapping round, so that no pixel can tell what was
/// left out.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "raster/interface/face.h"

namespace hemitex::raster {

/// An axis-parallel box around positions; infinite where a position is not finite or may become so on the way.
struct Box {
  glm::dvec3 low, high;
};

/// Where a box stands in a view.
struct BoxPlace {
  /// The part of the scissor rectangle outside of which no triangle inside the box covers a sample; it may be empty.
  Scissor part;
  /// 1/w of no triangle inside the box is larger; infinite where it may be seen and touch the near plane.
  double inverseDepth;
};

class ViewBounds {
 public:
  explicit ViewBounds(const Face& face);

  /// False only where no triangle inside the box covers a sample of the scissor rectangle.
  bool mayShow(const Box& box) const;

  BoxPlace placeOf(const Box& box) const;

 private:
  /// A product row . d with positions d from the eye.
  struct Row {
    glm::dvec3 row, absolute;  ///< and its coordinates' sizes
    double rounding;           ///< what the vertex stage may be off, for each unit of distance from the eye

    /// What the vertex stage may be off for a position that is no farther from the eye than `reach`.
    double offAt(double reach) const;
  };
  /// Points with row . d > offset are not shown.
  struct Plane {
    Row row;
    double offset;
  };
  static Row rowOf(const glm::dvec3& row, double size);

  glm::dvec3 eye_;
  Row x_, y_, w_;
  double nearDistance_;
  int resolution_;
  Scissor scissor_;
  std::array<Plane, 5> planes_;
};

}  // namespace hemitex::raster
