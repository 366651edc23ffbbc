#include "raster/view_bounds.h"

#include <algorithm>
#include <cmath>

namespace hemitex::raster {
namespace {

/// The vertex stage's five roundings of binary32 change the product of a row and a distance by less than 2^-21 of their
/// lengths' product; this leaves room for more.
constexpr double vertexRounding = 0x1p-19;

double sumOf(const glm::dvec3& v) { return v.x + v.y + v.z; }

}  // namespace

ViewBounds::ViewBounds(const Face& face) : eye_(face.eye) {
  const glm::dvec3 x(face.x), y(face.y), w(face.w);
  const double width = glm::length(w);
  const auto plane = [](const glm::dvec3& normal, double size, double offset) {
    return Plane{normal, glm::abs(normal), offset, vertexRounding * size};
  };
  // The sides of the scissor rectangle on the picture plane, one pixel out, which is more than snapping moves a vertex.
  const double pixel = 2.0 / face.resolution;
  const auto before = [&](const glm::dvec3& axis, int first) {
    const double low = (first - 1) * pixel - 1;
    return plane(low * w - axis, std::abs(low) * width + glm::length(axis), 0);
  };
  const auto behind = [&](const glm::dvec3& axis, int end) {
    const double high = (end + 1) * pixel - 1;
    return plane(axis - high * w, std::abs(high) * width + glm::length(axis), 0);
  };
  const Scissor& scissor = face.scissor;
  planes_ = {plane(-w, width, -static_cast<double>(face.nearDistance)), before(x, scissor.column),
             behind(x, scissor.column + scissor.width), before(y, scissor.row),
             behind(y, scissor.row + scissor.height)};
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

}  // namespace hemitex::raster
