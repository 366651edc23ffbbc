#include "reference/diagnosis/staged_device.h"

#include <algorithm>
#include <cmath>

#include "reference/verdict/triangle_bounds.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;

constexpr double subPixels = 256;  // units a pixel side

/// A linear function on the picture.
struct Plane {
  glm::dvec2 slope{0.0};
  double atOrigin = 0;

  double at(const glm::dvec2& position) const { return slope.x * position.x + slope.y * position.y + atOrigin; }
};

/// Edges, opposite their vertices, are positive inside and exact; attributes are quotients of linear functions, each
/// multiplied by the doubled area.
struct Setup {
  std::array<Plane, 3> edges;
  std::array<bool, 3> ownsEdge;
  std::array<double, 3> inverseW;  ///< at the vertices, over the doubled area
  std::array<double, 3> weights, u, v;
  glm::ivec2 first, end;  ///< pixels that may hold covered samples

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

Setup setUp(const StagedDevice& device, const DeviceTriangle& triangle, const raster::Scissor& scissor) {
  Setup setup{};
  glm::dvec2 low = triangle.vertices[0].position, high = low;
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
    low = glm::min(low, vertex.position);
    high = glm::max(high, vertex.position);
  }
  setup.first = glm::max(glm::ivec2(glm::floor(low / subPixels)) - 1, glm::ivec2(scissor.column, scissor.row));
  setup.end = glm::min(glm::ivec2(glm::floor(high / subPixels)) + 1,
                       glm::ivec2(scissor.column + scissor.width, scissor.row + scissor.height));
  return setup;
}

/// Coordinates that later stages can count with: extrapolated to a sample that the triangle does not cover, a quotient
/// may have any size or no value.
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
  bool isCovered = false;
  double depth = 0;
  ItemId id = 0;
};

/// Draws one face.
class FaceDrawing {
 public:
  FaceDrawing(const StagedDevice& device, const raster::DrawList& list, const raster::Face& view)
      : device_(device), list_(list), view_(view) {
    const auto pixels = static_cast<std::size_t>(view.scissor.width) * static_cast<std::size_t>(view.scissor.height);
    samples_.assign(pixels * device.samples.size(), {false, 0, raster::backgroundId(list.format)});
  }

  void draw(const DeviceTriangle& triangle) {
    const Facing facing = device_.facing(triangle.facesAway ? Facing::Back : Facing::Front, view_);
    if (facing == Facing::Culled) return;
    const Setup setup = setUp(device_, triangle, view_.scissor);
    for (int row = setup.first.y; row < setup.end.y; ++row)
      for (int column = setup.first.x; column < setup.end.x; ++column)
        drawPixel(setup, list_.draws[triangle.draw], facing, column, row);
  }

  raster::ItemBuffer resolve() const {
    raster::ItemBuffer buffer{view_.scissor.width, view_.scissor.height, {}};
    std::vector<ItemId> ids(device_.samples.size());
    for (std::size_t first = 0; first < samples_.size(); first += ids.size()) {
      for (std::size_t s = 0; s < ids.size(); ++s) ids[s] = samples_[first + s].id;
      buffer.ids.push_back(device_.resolve(ids));
    }
    return buffer;
  }

 private:
  void drawPixel(const Setup& setup, const raster::Draw& draw, Facing facing, int column, int row) {
    const glm::dvec2 corner(subPixels * column, subPixels * row);
    const auto pixel =
        static_cast<std::size_t>(row - view_.scissor.row) * static_cast<std::size_t>(view_.scissor.width) +
        static_cast<std::size_t>(column - view_.scissor.column);
    for (std::size_t s = 0; s < device_.samples.size(); ++s) {
      const std::array<double, 3> edges = setup.edgesAt(corner + device_.samples[s]);
      if (!setup.covers(edges)) continue;
      Sample& sample = samples_[pixel * device_.samples.size() + s];
      const double depth = device_.depth(dot(edges, setup.inverseW), static_cast<double>(view_.nearDistance));
      if (sample.isCovered && !device_.passes(depth, sample.depth)) continue;
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
  std::vector<Sample> samples_;  ///< device.samples.size() a pixel of the scissor rectangle
};

}  // namespace

ItemId nearestTexel(const raster::IndexMap& map, const glm::dvec2& at) {
  const auto texel = [](double coordinate, int size) {
    return static_cast<std::size_t>(std::clamp(std::floor(coordinate * size), 0.0, size - 1.0));
  };
  return map.ids[texel(at.y, map.height) * static_cast<std::size_t>(map.width) + texel(at.x, map.width)];
}

std::vector<raster::ItemBuffer> drawOn(const StagedDevice& device, const TestVector& vector) {
  raster::DrawList list = vector.list;
  device.upload(list);
  std::vector<raster::Face> faces;
  for (const VectorFace& face : vector.faces) faces.push_back(face.face);

  std::vector<raster::ItemBuffer> buffers;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    raster::Face view = device.camera(faces, f);
    view.resolution = faces[f].resolution;
    view.scissor = faces[f].scissor;
    FaceDrawing drawing(device, list, view);
    const auto hasArea = [](const DeviceTriangle& triangle) { return triangle.area != 0; };
    for (const DeviceTriangle& triangle : placeTriangles(list, view, {}, false, hasArea)) drawing.draw(triangle);
    buffers.push_back(drawing.resolve());
    device.readBack(view, buffers.back());
  }
  return buffers;
}

}  // namespace hemitex::reference
