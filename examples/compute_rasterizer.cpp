/// A compute rasterizer of triangle numbers, for picking. Its first version has holes along shared edges: the judge
/// finds and names them. The second version has a fill rule and passes.
#include <algorithm>
#include <array>
#include <iostream>

#include "reference/conformance/diagnosis/diagnosis.h"
#include "reference/conformance/suite/vector_suite.h"

using namespace hemitex;

struct Corner {
  std::int64_t x, y;  // in 1/256 pixel
  double w;
};

Corner place(const raster::Face& face, const glm::vec3& position) {
  const glm::vec3 d = position - face.eye;
  const double w = glm::dot(face.w, d), half = 128.0 * face.resolution;
  const auto snapped = [&](float x) { return static_cast<std::int64_t>(std::nearbyint((x / w + 1) * half)); };
  return {snapped(glm::dot(face.x, d)), snapped(glm::dot(face.y, d)), w};
}

std::int64_t edge(const Corner& a, const Corner& b, const Corner& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

raster::ItemBuffer draw(const raster::DrawList& list, const raster::Face& face, bool hasFillRule) {
  raster::ItemBuffer buffer;
  buffer.resize(face.scissor);
  std::fill(buffer.ids.begin(), buffer.ids.end(), raster::backgroundId(list.format));
  std::vector<double> nearest(buffer.ids.size());  // 1/w: a GPU has an atomic maximum of 1/w and the number
  for (std::uint32_t number = 0; number < list.indices.size() / 3; ++number) {
    std::array<Corner, 3> t;
    for (std::uint32_t k = 0; k < 3; ++k) t[k] = place(face, list.positions[list.indices[3 * number + k]]);
    if (edge(t[0], t[1], t[2]) < 0) std::swap(t[1], t[2]);  // both windings are drawn
    for (std::size_t pixel = 0; pixel < buffer.ids.size(); ++pixel) {
      const int column = static_cast<int>(pixel) % buffer.width, row = static_cast<int>(pixel) / buffer.width;
      const Corner sample{256 * column + 128, 256 * row + 128, 0};
      bool isCovered = true;
      double sum = 0, area = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Corner &a = t[(k + 1) % 3], &b = t[(k + 2) % 3];
        const std::int64_t inside = edge(a, b, sample);
        const bool isTopLeft = b.y < a.y || (b.y == a.y && b.x > a.x);
        isCovered &= inside > 0 || (inside == 0 && hasFillRule && isTopLeft);
        sum += static_cast<double>(inside) / t[k].w;
        area += static_cast<double>(inside);
      }
      if (!isCovered || sum / area <= nearest[pixel]) continue;
      nearest[pixel] = sum / area;
      buffer.ids[pixel] = list.draws[0].offset + number;
    }
  }
  return buffer;
}

/// Draws a vector and prints the verdict on it. Returns whether it has no errors.
bool check(const reference::TestVector& vector, bool hasFillRule) {
  const std::vector<raster::ItemBuffer> found{draw(vector.list, vector.faces[0].face, hasFillRule)};
  const reference::Verdict verdict = reference::judge(vector, found, {});
  const std::string diagnosis = reference::toText(reference::diagnose(vector, verdict));
  std::cout << vector.name << ": " << (reference::hasErrors(verdict) ? diagnosis : "no errors") << '\n';
  return !reference::hasErrors(verdict);
}

/// Exit code 0 if the first version fails and the second one passes, as this example promises.
int main() {
  reference::TestVector vector = reference::meshVectors()[2];
  vector.list.value = raster::PixelValue::TriangleNumbers;
  vector.list.draws = {{0, static_cast<std::uint32_t>(vector.list.indices.size()), 0, {}}};
  const bool isFirstRight = check(vector, false), isSecondRight = check(vector, true);
  return !isFirstRight && isSecondRight ? 0 : 1;
}
