#include "reference/conformance/diagnosis/staged_device.h"

#include <algorithm>
#include <cmath>

#include "reference/conformance/verdict/triangle_bounds.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;

constexpr double subPixels = 256;  // per pixel

/// A linear function on the picture.
struct Plane {
  glm::dvec2 slope{0.0};
  double atOrigin = 0;

  double at(const glm::dvec2& position) const { return slope.x * position.x + slope.y * position.y + atOrigin; }
};

/// The linear functions of a triangle. Edge k is opposite vertex k, positive inside and exact. Attributes are quotients
/// of sums of edges times vertex values.
struct Setup {
  std::array<Plane, 3> edges;
  std::array<bool, 3> ownsEdge;
  std::array<double, 3> inverseW;  ///< at the vertices, over the doubled area
  std::array<double, 3> weights, u, v;

  bool covers(const std::array<double, 3>& values) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (values[k] < 0 || (values[k] == 0 && !ownsEdge[k])) return false;
    return true;
  }

  std::array<double, 3> edgesAt(const glm::dvec2& position) const {
    return {edges[0].at(position), edges[1].at(position), edges[2].at(position)};
  }
};

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Pixels [first, end) of the scissor rectangle that may hold covered samples.
struct PixelBox {
  glm::ivec2 first, end;
};

PixelBox boxOf(const DeviceTriangle& triangle, const raster::Scissor& scissor) {
  const auto& [a, b, c] = triangle.vertices;
  const glm::dvec2 low = glm::min(a.position, glm::min(b.position, c.position));
  const glm::dvec2 high = glm::max(a.position, glm::max(b.position, c.position));
  return {glm::max(glm::ivec2(glm::floor(low / subPixels)) - 1, glm::ivec2(scissor.column, scissor.row)),
          glm::min(glm::ivec2(glm::floor(high / subPixels)) + 1,
                   glm::ivec2(scissor.column + scissor.width, scissor.row + scissor.height))};
}

Setup setUp(const StagedDevice& device, const DeviceTriangle& triangle) {
  Setup setup{};
  for (std::size_t k = 0; k < 3; ++k) {
    const DeviceVertex& vertex = triangle.vertices[k];
    const glm::dvec2 &p = triangle.vertices[(k + 1) % 3].position, &q = triangle.vertices[(k + 2) % 3].position;
    const glm::dvec2 along = (triangle.area > 0 ? 1.0 : -1.0) * (q - p);
    setup.edges[k] = {{-along.y, along.x}, along.y * p.x - along.x * p.y};
    setup.ownsEdge[k] = device.ownsEdge(along);
    setup.inverseW[k] = 1 / vertex.view.w / std::abs(triangle.area);
    setup.weights[k] = device.weight(vertex.view.w);
    setup.u[k] = setup.weights[k] * vertex.view.u;
    setup.v[k] = setup.weights[k] * vertex.view.v;
  }
  return setup;
}

/// Clamps coordinates to finite values: extrapolation to a sample outside of the triangle may give any quotient or NaN.
glm::dvec2 held(const glm::dvec2& coordinates) {
  constexpr double largest = 1e9;
  const auto hold = [=](double x) { return std::isnan(x) ? 0.0 : std::clamp(x, -largest, largest); };
  return {hold(coordinates.x), hold(coordinates.y)};
}

Lookup lookUp(const Setup& setup, const glm::dvec2& position) {
  const std::array<double, 3> edges = setup.edgesAt(position);
  const double total = dot(edges, setup.weights);
  const glm::dvec2 at = glm::dvec2(dot(edges, setup.u), dot(edges, setup.v)) / total;
  const auto change = [&](int axis) {
    std::array<double, 3> slopes;
    for (std::size_t k = 0; k < 3; ++k) slopes[k] = subPixels * setup.edges[k].slope[axis];
    return (glm::dvec2(dot(slopes, setup.u), dot(slopes, setup.v)) - at * dot(slopes, setup.weights)) / total;
  };
  return {held(at), held(change(0)), held(change(1))};
}

struct Sample {
  bool hasDepth = false;  ///< without a depth, any fragment passes
  double depth = 0;
  ItemId id = 0;
};

/// The samples of a rectangle of pixels, device.samples.size() per pixel.
struct Samples {
  raster::Scissor rectangle;
  std::vector<Sample> samples;

  std::size_t pixelAt(int column, int row) const {
    return static_cast<std::size_t>(row - rectangle.row) * static_cast<std::size_t>(rectangle.width) +
           static_cast<std::size_t>(column - rectangle.column);
  }
};

/// Copies the depths of the pixels that both rectangles contain.
void copyDepths(const Samples& from, Samples& to, std::size_t perPixel) {
  const raster::Scissor &a = from.rectangle, &b = to.rectangle;
  const int endColumn = std::min(a.column + a.width, b.column + b.width);
  const int endRow = std::min(a.row + a.height, b.row + b.height);
  for (int row = std::max(a.row, b.row); row < endRow; ++row)
    for (int column = std::max(a.column, b.column); column < endColumn; ++column)
      for (std::size_t s = 0; s < perPixel; ++s) {
        const Sample& source = from.samples[from.pixelAt(column, row) * perPixel + s];
        Sample& target = to.samples[to.pixelAt(column, row) * perPixel + s];
        target.hasDepth = source.hasDepth;
        target.depth = source.depth;
      }
}

/// Draws the pixels of one scissor rectangle. `earlier` holds the samples whose depths stay in the target.
class FaceDrawing {
 public:
  FaceDrawing(const StagedDevice& device, const raster::DrawList& list, const raster::Face& view,
              std::span<const Samples> earlier)
      : device_(device), list_(list), view_(view), target_{view.scissor, {}} {
    const auto pixels = static_cast<std::size_t>(view.scissor.width) * static_cast<std::size_t>(view.scissor.height);
    target_.samples.assign(pixels * device.samples.size(), {false, 0, raster::backgroundId(list.format)});
    for (const Samples& samples : earlier) copyDepths(samples, target_, device.samples.size());
  }

  void draw(const DeviceTriangle& triangle) {
    const PixelBox box = boxOf(triangle, view_.scissor);
    if (box.first.x >= box.end.x || box.first.y >= box.end.y) return;
    const Facing facing = device_.facing(triangle.facesAway ? Facing::Back : Facing::Front, view_);
    if (facing == Facing::Culled) return;
    const Setup setup = setUp(device_, triangle);
    for (int row = box.first.y; row < box.end.y; ++row)
      for (int column = box.first.x; column < box.end.x; ++column)
        drawPixel(setup, list_.draws[triangle.draw], facing, column, row);
  }

  raster::ItemBuffer resolve() const {
    raster::ItemBuffer buffer{view_.scissor.width, view_.scissor.height, {}};
    std::vector<ItemId> ids(device_.samples.size());
    for (std::size_t first = 0; first < target_.samples.size(); first += ids.size()) {
      for (std::size_t s = 0; s < ids.size(); ++s) ids[s] = target_.samples[first + s].id;
      buffer.ids.push_back(device_.resolve(ids));
    }
    return buffer;
  }

  const Samples& target() const { return target_; }

 private:
  void drawPixel(const Setup& setup, const raster::Draw& draw, Facing facing, int column, int row) {
    const glm::dvec2 corner(subPixels * column, subPixels * row);
    const std::size_t pixel = target_.pixelAt(column, row);
    for (std::size_t s = 0; s < device_.samples.size(); ++s) {
      const std::array<double, 3> edges = setup.edgesAt(corner + device_.samples[s]);
      if (!setup.covers(edges)) continue;
      Sample& sample = target_.samples[pixel * device_.samples.size() + s];
      const double depth = device_.depth(dot(edges, setup.inverseW), static_cast<double>(view_.nearDistance));
      if (sample.hasDepth && !device_.passes(depth, sample.depth)) continue;
      sample = {true, depth, device_.store(sample.id, shade(setup, draw, facing, corner + device_.shadingSample))};
    }
  }

  ItemId shade(const Setup& setup, const raster::Draw& draw, Facing facing, const glm::dvec2& position) const {
    if (facing == Facing::Back && draw.back) return *draw.back;
    if (!draw.indexMap) return draw.offset;
    const ItemId texel = device_.fetch(list_, static_cast<std::size_t>(*draw.indexMap), lookUp(setup, position));
    return device_.blend(list_, draw.offset, texel);
  }

  const StagedDevice& device_;
  const raster::DrawList& list_;
  const raster::Face& view_;
  Samples target_;
};

std::vector<DeviceTriangle> placeFace(const StagedDevice& device, const raster::DrawList& list,
                                      const raster::Face& view) {
  if (device.geometry) return placeTriangles(*device.geometry, list, view);
  return placeTriangles(list, view, {}, false, [](const DeviceTriangle& triangle) { return triangle.area != 0; });
}

bool isSameView(const raster::Face& a, const raster::Face& b) {
  return a.eye == b.eye && a.x == b.x && a.y == b.y && a.w == b.w && a.nearDistance == b.nearDistance &&
         a.resolution == b.resolution;
}

/// Whether the draws take the same triangles in the same order.
bool haveSameTriangles(const raster::DrawList& a, const raster::DrawList& b) {
  return a.indices == b.indices && a.texcoords == b.texcoords &&
         std::equal(
             a.draws.begin(), a.draws.end(), b.draws.begin(), b.draws.end(),
             [](const raster::Draw& x, const raster::Draw& y) { return x.first == y.first && x.count == y.count; });
}

/// The view of face `f` through the device's camera.
raster::Face viewOf(const StagedDevice& device, const std::vector<raster::Face>& faces, std::size_t f) {
  if (!device.camera) return faces[f];
  raster::Face view = device.camera(faces, f);
  view.resolution = faces[f].resolution;
  view.scissor = faces[f].scissor;
  return view;
}

/// Draws the pixels of the view's scissor rectangle. `earlier` is the memory of a device that keeps depths.
raster::ItemBuffer drawFace(const StagedDevice& device, const raster::DrawList& list, const raster::Face& view,
                            const std::vector<DeviceTriangle>& triangles, std::vector<Samples>& earlier) {
  FaceDrawing drawing(device, list, view, earlier);
  for (const DeviceTriangle& triangle : triangles) drawing.draw(triangle);
  if (device.keepsDepth) earlier.push_back(drawing.target());
  return drawing.resolve();
}

}  // namespace

ItemId nearestTexel(const raster::IndexMap& map, const glm::dvec2& at) {
  const auto texel = [](double coordinate, int size) {
    return static_cast<std::size_t>(std::clamp(std::floor(coordinate * size), 0.0, size - 1.0));
  };
  return map.ids[texel(at.y, map.height) * static_cast<std::size_t>(map.width) + texel(at.x, map.width)];
}

StagedDevice withReadBack(const ReadBack& readBack) {
  StagedDevice device;
  device.readBack = readBack;
  device.isDrawnByRules = true;
  return device;
}

PlacedVector placeVector(const TestVector& vector) {
  PlacedVector placed{vector.list, facesOf(vector), {}, {}};
  const StagedDevice device;
  std::vector<Samples> earlier;
  for (const VectorFace& face : vector.faces) {
    placed.triangles.push_back(placeFace(device, vector.list, face.face));
    placed.buffers.push_back(drawFace(device, vector.list, face.face, placed.triangles.back(), earlier));
  }
  return placed;
}

void drawOn(const StagedDevice& device, const PlacedVector& placed,
            const std::function<bool(const raster::ItemBuffer&)>& wantsMore) {
  constexpr int stripRows = 8;
  raster::DrawList changed;
  if (device.upload) device.upload(changed = placed.list);
  const raster::DrawList& list = device.upload ? changed : placed.list;
  const bool isSameMesh = !device.geometry && (!device.upload || haveSameTriangles(list, placed.list));
  std::vector<Samples> earlier;
  for (std::size_t f = 0; f < placed.faces.size(); ++f) {
    raster::Face view = viewOf(device, placed.faces, f);
    const bool isPlaced = isSameMesh && isSameView(view, placed.faces[f]);
    const std::vector<DeviceTriangle> moved = isPlaced ? std::vector<DeviceTriangle>{} : placeFace(device, list, view);
    const std::vector<DeviceTriangle>& triangles = isPlaced ? placed.triangles[f] : moved;
    if (device.readBack) {
      raster::ItemBuffer buffer =
          device.isDrawnByRules ? placed.buffers[f] : drawFace(device, list, view, triangles, earlier);
      device.readBack(view, buffer);
      if (!wantsMore(buffer)) return;
      continue;
    }
    const int endRow = view.scissor.row + view.scissor.height;
    for (; view.scissor.row < endRow; view.scissor.row += stripRows) {
      view.scissor.height = std::min(stripRows, endRow - view.scissor.row);
      if (!wantsMore(drawFace(device, list, view, triangles, earlier))) return;
    }
  }
}

}  // namespace hemitex::reference
