/// The error bound of a hemicube's pixels for a convex polygon.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "radiosity/discretization/patch_points.h"
#include "radiosity/projection/projection_kinds.h"

namespace hemitex::tests {

/// A bound on the difference between the shares of samples and the integral over a visible convex polygon, seen from a
/// point. For a closed convex curve of length L in a grid of unit width, the number of grid points differs from the
/// area by at most L/2 + 1 (Jarnik). So half a pixel, times the density of the form factor, is integrated along the
/// polygon's outline on the hemicube.
inline double outlineBound(const radiosity::SurfacePoint& point, const std::vector<glm::dvec3>& polygon, int pixels) {
  const auto faces =
      radiosity::facesOver(radiosity::hemicubeFaces(pixels), point.position, point.normal, glm::dvec3(0), 1);
  constexpr int steps = 250;
  constexpr double pi = 3.14159265358979323846;
  double bound = 5 * 4 / (pi * pixels * pixels);  // one pixel per face, none larger than those at the middle of the top
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    // Steps of equal angles about the point: small where the edge is near.
    const glm::dvec3 start = polygon[i] - point.position, edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double length = glm::length(edge);
    const glm::dvec3 along = edge / length, foot = start - glm::dot(start, along) * along;
    const double distance = std::max(glm::length(foot), 1e-12 * length);
    const double from = std::atan(glm::dot(start, along) / distance);
    const double turn = (std::atan((glm::dot(start, along) + length) / distance) - from) / steps;
    for (int s = 0; s < steps; ++s) {
      const double before = std::tan(from + s * turn), after = std::tan(from + (s + 1) * turn);
      const glm::dvec3 step = distance * (after - before) * along;
      const glm::dvec3 d = foot + distance * std::tan(from + (s + 0.5) * turn) * along;
      const double height = glm::dot(d, point.normal);
      if (height <= 0) continue;
      const auto depth = [&d](const raster::Face& face) { return glm::dot(glm::dvec3(face.w), d); };
      const raster::Face& face =
          *std::max_element(faces.begin(), faces.end(),
                            [&](const raster::Face& a, const raster::Face& b) { return depth(a) < depth(b); });
      // On the face: d / w. A step moves it by (step - (step along w) d / w) / w. The density is (height / w) / (pi
      // s^4), with s the distance to the point on the face.
      const double w = depth(face);
      const glm::dvec3 at = d / w;
      const double across = glm::length(step - glm::dot(glm::dvec3(face.w), step) * at) / w;
      bound += across / pixels * (height / w) / (pi * glm::dot(at, at) * glm::dot(at, at));
    }
  }
  return bound;
}

}  // namespace hemitex::tests
