#include "raster/culling/frustum_culling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemitex::raster {
namespace {

/// Relative to the product of the lengths of a row and a distance: the five binary32 roundings of the vertex stage are
/// below 2^-21. This bound is larger.
constexpr double vertexRounding = 0x1p-19;
/// Below the smallest normal binary32 number, each of the three products of a row has an error of up to 2^-150. A side
/// of the view takes one row and at most twice another.
constexpr double vertexUnderflow = 0x1p-146;

/// A box relative to an eye.
struct SeenBox {
  glm::dvec3 centre, half;
  double reach;  ///< upper bound of the distance of its corners from the eye

  SeenBox(const Box& box, const glm::dvec3& eye)
      : centre(0.5 * (box.low + box.high) - eye), half(0.5 * (box.high - box.low)) {
    const glm::dvec3 corner = glm::abs(centre) + half;
    reach = corner.x + corner.y + corner.z;
  }
};

struct Range {
  double low, high;
};

/// Reduces [first, first + count) to the pixels whose samples may lie between two points of the picture plane. Snapping
/// moves a vertex by half a sub-pixel; the whole sub-pixel used here also covers other rounding.
void narrow(double low, double high, int resolution, int& first, int& count) {
  constexpr double subPixel = 1.0 / 256;
  const auto position = [=](double q) { return (std::clamp(q, -1.5, 1.5) + 1) * 0.5 * resolution - 0.5; };
  // std::floor and std::ceil are calls on processors without SSE 4.1.
  const auto floorOf = [](double x) {
    const int truncated = static_cast<int>(x);
    return truncated - (truncated > x ? 1 : 0);
  };
  const int begin = std::max(first, -floorOf(subPixel - position(low)));
  const int end = std::min(first + count, floorOf(position(high) + subPixel) + 1);
  first = begin;
  count = std::max(end - begin, 0);
}

}  // namespace

double ViewBounds::Row::offAt(double reach) const { return rounding * reach + vertexUnderflow; }

ViewBounds::Row ViewBounds::rowOf(const glm::dvec3& row, double size) {
  return {row, glm::abs(row), vertexRounding * size};
}

ViewBounds::ViewBounds(const Face& face)
    : eye_(face.eye),
      x_(rowOf(face.x, glm::length(glm::dvec3(face.x)))),
      y_(rowOf(face.y, glm::length(glm::dvec3(face.y)))),
      w_(rowOf(face.w, glm::length(glm::dvec3(face.w)))),
      nearDistance_(face.nearDistance),
      resolution_(face.resolution),
      scissor_(face.scissor) {
  const glm::dvec3 w(face.w);
  const double width = glm::length(w);
  // The sides of the scissor rectangle on the picture plane, moved out by one pixel, which is more than snapping moves
  // a vertex.
  const double pixel = 2.0 / face.resolution;
  const auto before = [&](const glm::dvec3& axis, int first) {
    const double low = (first - 1) * pixel - 1;
    return Plane{rowOf(low * w - axis, std::abs(low) * width + glm::length(axis)), 0};
  };
  const auto behind = [&](const glm::dvec3& axis, int end) {
    const double high = (end + 1) * pixel - 1;
    return Plane{rowOf(axis - high * w, std::abs(high) * width + glm::length(axis)), 0};
  };
  planes_ = {Plane{rowOf(-w, width), -nearDistance_}, before(x_.row, scissor_.column),
             behind(x_.row, scissor_.column + scissor_.width), before(y_.row, scissor_.row),
             behind(y_.row, scissor_.row + scissor_.height)};
}

bool ViewBounds::mayShow(const Box& box) const {
  const SeenBox seen(box, eye_);
  // An infinite box gives NaN here, so that no plane culls it.
  return std::none_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    const double least = glm::dot(plane.row.row, seen.centre) - glm::dot(plane.row.absolute, seen.half);
    return least - plane.offset > plane.row.offAt(seen.reach);
  });
}

BoxPlace ViewBounds::placeOf(const Box& box) const {
  const SeenBox seen(box, eye_);
  const auto rangeOf = [&seen](const Row& row) {
    const double middle = glm::dot(row.row, seen.centre);
    const double reach = glm::dot(row.absolute, seen.half) + row.offAt(seen.reach);
    return Range{middle - reach, middle + reach};
  };
  const Range w = rangeOf(w_);
  if (!(w.low > nearDistance_)) {
    if (!mayShow(box)) return {{scissor_.column, scissor_.row, 0, 0}, 0};
    return {scissor_, std::numeric_limits<double>::infinity()};
  }
  // Numerator and denominator range independently, so that the quotient is largest at an end of their ranges. Clipping
  // leaves a triangle inside its former bounds, and 1/w at a sample is a mean of the values at the vertices.
  const auto least = [&](const Range& range) { return range.low / (range.low < 0 ? w.low : w.high); };
  const auto largest = [&](const Range& range) { return range.high / (range.high > 0 ? w.low : w.high); };
  BoxPlace place{scissor_, 1 / w.low};
  const Range x = rangeOf(x_), y = rangeOf(y_);
  narrow(least(x), largest(x), resolution_, place.part.column, place.part.width);
  narrow(least(y), largest(y), resolution_, place.part.row, place.part.height);
  return place;
}

}  // namespace hemitex::raster
