#include "radiosity/discretization/neighbours.h"

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <numeric>
#include <utility>

namespace hemitex::radiosity {
namespace {

/// Numbers for the positions of all corners, three per triangle; equal positions have equal numbers.
std::vector<std::uint32_t> numberedPositions(const Surface& surface) {
  const auto at = [&](std::uint32_t corner) { return surface.triangles[corner / 3].position[corner % 3]; };
  const auto key = [&](std::uint32_t corner) {
    const glm::dvec3 p = at(corner);
    return std::array{p.x, p.y, p.z};
  };
  std::vector<std::uint32_t> order(3 * surface.triangles.size()), numbers(order.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && at(order[i]) != at(order[i - 1])) ++number;
    numbers[order[i]] = number;
  }
  return numbers;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> neighbours(const Surface& surface) {
  const std::vector<std::uint32_t> numbers = numberedPositions(surface);
  // Edges by the numbers of their ends, with triangle and opposite corner as one number.
  std::vector<std::pair<std::uint64_t, std::uint32_t>> edges;
  edges.reserve(numbers.size());
  for (std::uint32_t corner = 0; corner < numbers.size(); ++corner) {
    const std::uint32_t first = corner / 3 * 3, a = numbers[first + (corner + 1) % 3],
                        b = numbers[first + (corner + 2) % 3];
    edges.emplace_back(std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), corner);
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::array<std::uint32_t, 3>> result(surface.triangles.size(), {noNeighbour, noNeighbour, noNeighbour});
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].first == edges[begin].first) ++end;
    for (std::size_t i = begin; i < end && end - begin > 1; ++i) {
      const std::uint32_t corner = edges[i].second, next = edges[i + 1 < end ? i + 1 : begin].second;
      result[corner / 3][corner % 3] = next / 3;
    }
  }
  return result;
}

std::size_t oppositeCorner(const Triangle& triangle, std::size_t corner, const Triangle& other) {
  const glm::dvec3 &a = triangle.position[(corner + 1) % 3], &b = triangle.position[(corner + 2) % 3];
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 &c = other.position[(k + 1) % 3], &d = other.position[(k + 2) % 3];
    if ((a == c && b == d) || (a == d && b == c)) return k;
  }
  return 0;
}

}  // namespace hemitex::radiosity
