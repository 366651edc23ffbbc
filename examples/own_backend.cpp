/// A backend of one's own, judged by the vectors of hemitex: the first attempt is wrong, and the diagnosis names its
/// fault; the second is right.
///
/// A backend is one class derived from raster::ItemBufferRenderer. This one draws a floor in front of the eye and no
/// more: it neither clips nor tells front from back, it covers no sample on an edge, and it computes in double
/// precision what the rules want exactly. Other vectors of the suite find all of that. A backend for a GPU copies the
/// draw list to the device in its constructor, and draws the faces in `draw`.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <span>
#include <utility>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"
#include "reference/conformance/diagnosis/diagnosis.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/verdict/verdict.h"

namespace {

using namespace hemitex;

enum class Interpolation { Affine, Perspective };

/// A vertex on the picture: the sample of pixel (i, j) is at (i + 1/2, j + 1/2).
struct ScreenVertex {
  double x, y, w, u, v;
};

/// Twice the signed area of a triangle a, b, (x, y).
double edge(const ScreenVertex& a, const ScreenVertex& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

class SimpleRenderer final : public raster::ItemBufferRenderer {
 public:
  SimpleRenderer(raster::DrawList list, Interpolation interpolation)
      : list_(std::move(list)), interpolation_(interpolation) {}

  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override {
    buffers.resize(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
      drawFace(faces[f], skipped, buffers[f]);
      drawn(f);
    }
  }

 private:
  void drawFace(const raster::Face& face, std::span<const std::uint32_t> skipped, raster::ItemBuffer& buffer) {
    buffer.resize(face.scissor);
    std::fill(buffer.ids.begin(), buffer.ids.end(), raster::backgroundId(list_.format));
    nearest_.assign(buffer.ids.size(), 0);
    for (const raster::Draw& run : list_.draws)
      for (std::uint32_t i = run.first; i < run.first + run.count; i += 3)
        if (!std::binary_search(skipped.begin(), skipped.end(), i / 3))
          drawTriangle(face, run, {onScreen(face, i), onScreen(face, i + 1), onScreen(face, i + 2)}, buffer);
  }

  ScreenVertex onScreen(const raster::Face& face, std::uint32_t index) const {
    const std::uint32_t vertex = list_.indices[index];
    const glm::vec3 d = list_.positions[vertex] - face.eye;
    const double w = glm::dot(face.w, d), half = face.resolution / 2.0;
    const auto snapped = [&](double clip) { return std::nearbyint((clip / w + 1) * half * 256) / 256; };
    return {snapped(glm::dot(face.x, d)), snapped(glm::dot(face.y, d)), w, list_.texcoords[vertex].x,
            list_.texcoords[vertex].y};
  }

  void drawTriangle(const raster::Face& face, const raster::Draw& run, const std::array<ScreenVertex, 3>& corner,
                    raster::ItemBuffer& buffer) {
    const auto& [a, b, c] = corner;
    const double area = edge(a, b, c.x, c.y);
    for (int row = 0; row < buffer.height; ++row)
      for (int column = 0; column < buffer.width; ++column) {
        const double x = face.scissor.column + column + 0.5, y = face.scissor.row + row + 0.5;
        const double p = edge(b, c, x, y) / area, q = edge(c, a, x, y) / area, r = 1 - p - q;
        if (!(p > 0 && q > 0 && r > 0)) continue;
        const double inverseDepth = p / a.w + q / b.w + r / c.w;
        const std::size_t pixel = static_cast<std::size_t>(row * buffer.width + column);
        if (inverseDepth <= nearest_[pixel]) continue;
        nearest_[pixel] = inverseDepth;
        buffer.ids[pixel] = interpolation_ == Interpolation::Affine
                                ? idAt(run, p * a.u + q * b.u + r * c.u, p * a.v + q * b.v + r * c.v)
                                : idAt(run, (p * a.u / a.w + q * b.u / b.w + r * c.u / c.w) / inverseDepth,
                                       (p * a.v / a.w + q * b.v / b.w + r * c.v / c.w) / inverseDepth);
      }
  }

  /// The offset, blended with the nearest texel of the index map.
  raster::ItemId idAt(const raster::Draw& run, double u, double v) const {
    if (!run.indexMap) return run.offset;
    const raster::IndexMap& map = list_.indexMaps[static_cast<std::size_t>(*run.indexMap)];
    const int column = std::clamp(static_cast<int>(std::floor(u * map.width)), 0, map.width - 1);
    const int row = std::clamp(static_cast<int>(std::floor(v * map.height)), 0, map.height - 1);
    return raster::blend(list_.format, list_.blend, run.offset,
                         map.ids[static_cast<std::size_t>(row * map.width + column)]);
  }

  raster::DrawList list_;
  Interpolation interpolation_;
  std::vector<double> nearest_;  // 1/w of what each pixel shows
};

/// Draws a vector, and prints the verdict on it. Returns whether it has no errors.
bool check(const reference::TestVector& vector, Interpolation interpolation) {
  SimpleRenderer renderer(vector.list, interpolation);
  const std::vector<raster::ItemBuffer> found = raster::render(renderer, reference::facesOf(vector));
  const reference::Verdict verdict = reference::judge(vector, found, {});
  if (reference::hasErrors(verdict))
    std::cout << vector.name << ": wrong item IDs; " << reference::toText(reference::diagnose(vector, verdict)) << '\n';
  else
    std::cout << vector.name << ": no errors\n";
  return !reference::hasErrors(verdict);
}

}  // namespace

/// Exit code 0 if the first attempt fails and the second passes, as this example promises.
int main() {
  const std::vector<reference::TestVector> suite = reference::vectorSuite();
  const auto isFloor = [](const reference::TestVector& vector) { return vector.name == "perspective-floor"; };
  const reference::TestVector& floor = *std::find_if(suite.begin(), suite.end(), isFloor);
  const bool isAffineRight = check(floor, Interpolation::Affine);
  const bool isPerspectiveRight = check(floor, Interpolation::Perspective);
  return !isAffineRight && isPerspectiveRight ? 0 : 1;
}
