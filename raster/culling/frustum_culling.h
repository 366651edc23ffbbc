/// View bounds: conservative frustum culling of boxes against the scissor rectangle of a face. All bounds include the
/// rounding of the vertex stage, clipping and snapping, so that culling changes no pixel.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "raster/interface/face.h"

namespace hemitex::raster {

/// An axis-parallel box around positions. It is infinite if a position is not finite or may become so in the vertex
/// stage.
struct Box {
  glm::dvec3 low, high;
};

/// The smallest box around both.
inline Box around(const Box& a, const Box& b) { return {glm::min(a.low, b.low), glm::max(a.high, b.high)}; }

/// The place of a box in a view.
struct BoxPlace {
  /// Triangles inside the box cover no sample outside this part of the scissor rectangle; it may be empty.
  Scissor part;
  /// Upper bound of 1/w of the triangles inside the box; infinite if the box may be visible and touch the near plane.
  double inverseDepth;
};

class ViewBounds {
 public:
  explicit ViewBounds(const Face& face);

  /// Returns false only if no triangle inside the box covers a sample of the scissor rectangle.
  bool mayShow(const Box& box) const;

  BoxPlace placeOf(const Box& box) const;

 private:
  /// A product row . d of positions d relative to the eye.
  struct Row {
    glm::dvec3 row, absolute;  ///< `absolute` holds the absolute values of `row`
    double rounding;           ///< rounding error of the vertex stage per unit of distance from the eye

    /// The rounding error of the vertex stage for positions within the distance `reach` of the eye.
    double offAt(double reach) const;
  };
  /// Points with row . d > offset are outside the view.
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
