#include "raster/view_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemitex::raster {
namespace {

/// The vertex stage's five roundings of binary32 change the product of a row and a distance by less than 2^-21 of their
/// lengths' product; this leaves room for more.
constexpr double vertexRounding = 0x1p-19;

double sumOf(const glm::dvec3& v) { return v.x + v.y + v.z; }

/// Pixels whose samples may lie between two points of the picture plane, inside [first, first + count), one more on
/// either side than snapping asks for.
void narrow(double low, double high, int resolution, int& first, int& count) {
  const auto pixel = [=](double q) { return (std::clamp(q, -2.0, 2.0) + 1) * 0.5 * resolution; };
  const int begin = std::max(first, static_cast<int>(std::floor(pixel(low))) - 1);
  const int end = std::min(first + count, static_cast<int>(std::ceil(pixel(high))) + 1);
  first = begin;
  count = std::max(end - begin, 0);
}

}  // namespace

ViewBounds::ViewBounds(const Face& face)
    : eye_(face.eye),
      x_(face.x),
      y_(face.y),
      w_(face.w),
      nearDistance_(face.nearDistance),
      resolution_(face.resolution),
      scissor_(face.scissor) {
  const double width = glm::length(w_);
  const auto plane = [](const glm::dvec3& normal, double size, double offset) {
    return Plane{normal, glm::abs(normal), offset, vertexRounding * size};
  };
  // The sides of the scissor rectangle on the picture plane, one pixel out, which is more than snapping moves a vertex.
  const double pixel = 2.0 / face.resolution;
  const auto before = [&](const glm::dvec3& axis, int first) {
    const double low = (first - 1) * pixel - 1;
    return plane(low * w_ - axis, std::abs(low) * width + glm::length(axis), 0);
  };
  const auto behind = [&](const glm::dvec3& axis, int end) {
    const double high = (end + 1) * pixel - 1;
    return plane(axis - high * w_, std::abs(high) * width + glm::length(axis), 0);
  };
  planes_ = {plane(-w_, width, -nearDistance_), before(x_, scissor_.column),
             behind(x_, scissor_.column + scissor_.width), before(y_, scissor_.row),
             behind(y_, scissor_.row + scissor_.height)};
}

bool ViewBounds::mayShow(const Box& box) const {
  const glm::dvec3 centre = 0.5 * (box.low + box.high) - eye_, half = 0.5 * (box.high - box.low);
  const double reach = sumOf(glm::abs(centre)) + sumOf(half);  // no corner is farther from the eye
  // With the NaN of an infinite box, none of them.
  return std::none_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    const double least = glm::dot(plane.normal, centre) - glm::dot(plane.absolute, half);
    return least - plane.offset > plane.rounding * reach;
  });
}

ViewBounds::Range ViewBounds::rangeOf(const glm::dvec3& row, const Box& box) const {
  const glm::dvec3 centre = 0.5 * (box.low + box.high) - eye_, half = 0.5 * (box.high - box.low);
  const double middle = glm::dot(row, centre);
  const double rounding = vertexRounding * glm::length(row) * (sumOf(glm::abs(centre)) + sumOf(half));
  const double reach = glm::dot(glm::abs(row), half) + rounding;
  return {middle - reach, middle + reach};
}

BoxPlace ViewBounds::placeOf(const Box& box) const {
  const Range w = rangeOf(w_, box);
  if (!(w.low > nearDistance_)) return {scissor_, std::numeric_limits<double>::infinity()};
  // Where numerator and denominator range independently of each other, a quotient is largest at one of their ends. What
  // clipping cuts off a triangle leaves it inside of what it was. 1/w at a sample is a mean of the vertices' own.
  const auto least = [&](const Range& range) { return range.low / (range.low < 0 ? w.low : w.high); };
  const auto largest = [&](const Range& range) { return range.high / (range.high > 0 ? w.low : w.high); };
  BoxPlace place{scissor_, 1 / w.low};
  const Range x = rangeOf(x_, box), y = rangeOf(y_, box);
  narrow(least(x), largest(x), resolution_, place.part.column, place.part.width);
  narrow(least(y), largest(y), resolution_, place.part.row, place.part.height);
  return place;
}

}  // namespace hemitex::raster
