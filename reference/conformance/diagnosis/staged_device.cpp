#include "reference/conformance/diagnosis/staged_device.h"

#include <algorithm>
#include <map>

#include "reference/conformance/trace/fragments.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;
using raster::SnappedTriangle;

/// The triangles of a list in draw order.
std::vector<SnappedTriangle> placeBy(const StagedGeometry& geometry, const raster::DrawList& list,
                                     const raster::Face& face) {
  const raster::Viewport viewport = raster::viewportOf(face);
  const double moved = face.sample == raster::SamplePlace::Corner ? 128 : 0;
  const auto snap = [&](const raster::ViewVertex& p) {
    const auto place = [&](double q, int pixels) {
      return static_cast<std::int64_t>((geometry.snap(raster::subPixels(q, pixels)) + moved) *
                                       static_cast<double>(geometry.fineness));
    };
    return raster::SnappedPoint{place(p.x / p.w, viewport.columns), place(p.y / p.w, viewport.rows)};
  };
  const auto isAhead = [](const raster::ViewVertex& p) { return p.w > 0; };
  std::vector<SnappedTriangle> triangles;
  for (const DrawnTriangle& drawn : drawnTriangles(list)) {
    const raster::ClippedPolygon polygon = geometry.polygon(face, list, drawn.triangle);
    for (std::size_t k = 2; k < polygon.count; ++k) {
      const std::array<raster::ViewVertex, 3> fan = raster::fanTriangle(polygon, k);
      if (!std::all_of(fan.begin(), fan.end(), isAhead)) continue;
      SnappedTriangle triangle = raster::snappedTriangle(list, face, fan, {snap(fan[0]), snap(fan[1]), snap(fan[2])});
      triangle.draw = drawn.draw;
      triangle.number = drawn.triangle;
      if (triangle.area != 0) triangles.push_back(triangle);
    }
  }
  return triangles;
}

/// The pixels of [first, first + size) from that of the smallest to that of the largest position.
raster::PixelRange pixelsBetween(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t pixel, int first,
                                 int size) {
  const auto [low, high] = std::minmax({a, b, c});
  return {static_cast<int>(std::max<std::int64_t>(low / pixel - 1, first)),
          static_cast<int>(std::min<std::int64_t>(high / pixel + 1, first + size))};
}

/// Clamps coordinates to finite values: extrapolation to a sample outside of the triangle may give any quotient or NaN.
glm::dvec2 held(const glm::dvec2& coordinates) {
  constexpr double largest = 1e9;
  const auto hold = [=](double x) { return std::isnan(x) ? 0.0 : std::clamp(x, -largest, largest); };
  return {hold(coordinates.x), hold(coordinates.y)};
}

/// A list on the device. Without holes in its index maps, a fetched value that means a hole discards nothing.
struct UploadedList {
  const raster::DrawList& list;
  bool hasHoles = std::any_of(list.indexMaps.begin(), list.indexMaps.end(), raster::hasHoles);
};

/// The item ID of a fragment; nothing where it is discarded.
std::optional<ItemId> shade(const StagedDevice& device, const UploadedList& uploaded, const SnappedTriangle& triangle,
                            Facing facing, const raster::SnappedPoint& position) {
  const raster::DrawList& list = uploaded.list;
  const raster::Draw& draw = list.draws[triangle.draw];
  const bool showsBack = facing == Facing::Back && draw.back, isNumbered = list.value != raster::PixelValue::ItemIds;
  const ItemId flat = showsBack ? *draw.back : isNumbered ? flatValue(list, draw, triangle.number) : draw.offset;
  if (!draw.indexMap || ((showsBack || isNumbered) && !uploaded.hasHoles)) return flat;
  const Lookup lookup{triangle, position, held(device.interpolate(triangle, position))};
  const ItemId texel = device.fetch(list, static_cast<std::size_t>(*draw.indexMap), lookup);
  if (uploaded.hasHoles && texel == raster::holeTexel) return {};
  return showsBack || isNumbered ? flat : device.blend(list, draw.offset, texel);
}

/// Whether a position lies on the line of one pixel along an edge, in sub-pixels over `unit`.
bool isOnLine(const SnappedTriangle& triangle, const raster::SnappedPoint& position, const raster::Weights& weights,
              std::int64_t unit) {
  for (std::size_t k = 0; k < 3; ++k) {
    const raster::SnappedPoint &a = triangle.corners[(k + 1) % 3], &b = triangle.corners[(k + 2) % 3];
    const std::int64_t dx = std::abs(b.x - a.x), dy = std::abs(b.y - a.y);
    if (std::abs(weights[k]) > 128 * unit * std::max(dx, dy)) continue;
    const auto [low, high] = dx >= dy ? std::minmax({a.x, b.x}) : std::minmax({a.y, b.y});
    const std::int64_t along = dx >= dy ? position.x : position.y;
    if (low <= along && along <= high) return true;
  }
  return false;
}

/// Whether the triangle covers a position, in sub-pixels over `unit`.
bool coversAt(const StagedDevice& device, const SnappedTriangle& triangle, const raster::SnappedPoint& position,
              const raster::Weights& weights, std::int64_t unit) {
  if (device.drawsLines) return isOnLine(triangle, position, weights, unit);
  if (device.widening == 0) return covers(triangle, weights, device.ownsSamples);
  const std::int64_t reach = device.widening * unit;
  for (std::size_t k = 0; k < 3; ++k) {
    const raster::SnappedPoint along = directionOf(triangle, k);
    if (weights[k] + reach * (std::abs(along.x) + std::abs(along.y)) < 0) return false;
  }
  const auto& [a, b, c] = triangle.corners;
  const auto isNear = [reach](const std::pair<std::int64_t, std::int64_t>& range, std::int64_t at) {
    return range.first - reach <= at && at <= range.second + reach;
  };
  return isNear(std::minmax({a.x, b.x, c.x}), position.x) && isNear(std::minmax({a.y, b.y, c.y}), position.y);
}

/// Whether the triangle covers a sample of the 2 x 2 pixels around one.
bool coversQuad(const StagedDevice& device, const SnappedTriangle& triangle, int column, int row) {
  for (const int pixel : {0, 1, 2, 3}) {
    const raster::SnappedPoint sample = raster::sampleOf(column / 2 * 2 + pixel % 2, row / 2 * 2 + pixel / 2);
    if (coversAt(device, triangle, sample, weightsAt(triangle, sample), 1)) return true;
  }
  return false;
}

double depthOn(const StagedDevice& device, const SnappedTriangle& triangle, const raster::Weights& weights,
               const raster::Face& view) {
  if (!device.depth) return coveredSample(triangle, weights).depth;
  const double depth = raster::depthOf(triangle, raster::weightsOverDepth<double>(triangle, weights));
  return device.depth(-depth, static_cast<double>(view.nearDistance));
}

/// The largest change of 1/w per pixel.
double slopeOf(const SnappedTriangle& triangle, std::int64_t pixelSize) {
  const auto at = [&](std::int64_t x, std::int64_t y) {
    const auto overDepth = raster::weightsOverDepth<double>(triangle, weightsAt(triangle, {x, y}));
    return overDepth[0] + overDepth[1] + overDepth[2];
  };
  const double origin = at(0, 0);
  return std::max(std::abs(at(pixelSize, 0) - origin), std::abs(at(0, pixelSize) - origin));
}

/// A sample of the target.
struct Sample {
  std::optional<double> depth;  ///< without one, any fragment passes
  ItemId id;
};

/// Draws a triangle into the samples of the view's scissor rectangle.
void drawTriangle(const StagedDevice& device, const UploadedList& uploaded, const raster::Face& view,
                  const SnappedTriangle& triangle, std::vector<Sample>& target) {
  const raster::Scissor& scissor = view.scissor;
  const std::int64_t unit = device.geometry ? device.geometry->fineness : 1, pixelSize = 256 * unit;
  const auto& [a, b, c] = triangle.corners;
  const raster::PixelRange columns = pixelsBetween(a.x, b.x, c.x, pixelSize, scissor.column, scissor.width);
  const raster::PixelRange rows = pixelsBetween(a.y, b.y, c.y, pixelSize, scissor.row, scissor.height);
  if (columns.first >= columns.end || rows.first >= rows.end || !device.keeps(triangle)) return;
  const Facing facing = device.facing(triangle.facesAway ? Facing::Back : Facing::Front, view);
  if (facing == Facing::Culled || isCulled(uploaded.list.draws[triangle.draw], facing == Facing::Back)) return;
  const bool counts = uploaded.list.value == raster::PixelValue::PassedSamples;
  const double bias = device.depthBias == 0 ? 0 : device.depthBias * slopeOf(triangle, pixelSize);
  for (int row = rows.first; row < rows.end; ++row)
    for (int column = columns.first; column < columns.end; ++column) {
      const auto inPixel = [&](const raster::SnappedPoint& p) {
        return raster::SnappedPoint{pixelSize * column + unit * p.x, pixelSize * row + unit * p.y};
      };
      const int pixel = (row - scissor.row) * scissor.width + column - scissor.column;
      const std::int64_t block = device.shadingBlock;
      const raster::SnappedPoint shaded = block == 1
                                              ? inPixel(device.shadingSample)
                                              : raster::SnappedPoint{pixelSize * (column / block * 2 + 1) * block / 2,
                                                                     pixelSize * (row / block * 2 + 1) * block / 2};
      for (std::size_t s = 0; s < device.samples.size(); ++s) {
        const raster::SnappedPoint position = inPixel(device.samples[s]);
        const raster::Weights weights = weightsAt(triangle, position);
        Sample& sample = target[static_cast<std::size_t>(pixel) * device.samples.size() + s];
        if (!coversAt(device, triangle, position, weights, unit)) {
          if (device.countsQuads && coversQuad(device, triangle, column, row)) ++sample.id;
          continue;
        }
        const double depth = depthOn(device, triangle, weights, view) + bias;
        if (sample.depth && !passes(uploaded.list.depthTest, depth, *sample.depth, device.passes)) continue;
        if (auto id = shade(device, uploaded, triangle, facing, device.shadesSamples ? position : shaded)) {
          if (device.fade) id = device.fade(*id, 1 / coveredSample(triangle, weights).inverseDepth);
          sample = {depth, counts ? sample.id + 1 : device.store(sample.id, *id)};
        }
      }
    }
}

std::vector<SnappedTriangle> placeFace(const StagedDevice& device, const raster::DrawList& list,
                                       const raster::Face& view) {
  return placeBy(device.geometry.value_or(StagedGeometry{}), list, view);
}

bool isSameView(const raster::Face& a, const raster::Face& b) {
  return a.eye == b.eye && a.x == b.x && a.y == b.y && a.w == b.w && a.nearDistance == b.nearDistance &&
         a.resolution == b.resolution && a.viewport == b.viewport && a.sample == b.sample;
}

/// Whether the draws take the same triangles in the same order.
bool haveSameTriangles(const raster::DrawList& a, const raster::DrawList& b) {
  return a.indices == b.indices && a.positions == b.positions && a.clipZ == b.clipZ && a.texcoords == b.texcoords &&
         std::equal(
             a.draws.begin(), a.draws.end(), b.draws.begin(), b.draws.end(),
             [](const raster::Draw& x, const raster::Draw& y) { return x.first == y.first && x.count == y.count; });
}

/// The view of face `f` through the device's camera.
raster::Face viewOf(const StagedDevice& device, const std::vector<raster::Face>& faces, std::size_t f) {
  if (!device.camera) return faces[f];
  raster::Face view = device.camera(faces, f);
  view.resolution = faces[f].resolution;
  view.viewport = faces[f].viewport;
  view.sample = faces[f].sample;
  view.scissor = faces[f].scissor;
  return view;
}

/// The depths of samples that stay in the target, by column, row, and number in the pixel.
using KeptDepths = std::map<std::array<int, 3>, double>;

/// Draws the pixels of the view's scissor rectangle. `kept` is the memory of a device that keeps depths.
raster::ItemBuffer drawFace(const StagedDevice& device, const UploadedList& uploaded, const raster::Face& view,
                            const std::vector<SnappedTriangle>& triangles, KeptDepths& kept) {
  raster::ItemBuffer buffer;
  buffer.resize(view.scissor);
  const std::size_t perPixel = device.samples.size();
  std::vector<Sample> target(buffer.ids.size() * perPixel, {device.clearedDepth, raster::clearedValue(uploaded.list)});
  const auto placeOf = [&](std::size_t sample) {
    const glm::ivec2 pixel = pixelAt(view.scissor, sample / perPixel);
    return std::array{pixel.x, pixel.y, static_cast<int>(sample % perPixel)};
  };
  for (std::size_t s = 0; s < target.size() && !kept.empty(); ++s)
    if (const auto place = kept.find(placeOf(s)); place != kept.end()) target[s].depth = place->second;
  for (const SnappedTriangle& triangle : triangles) drawTriangle(device, uploaded, view, triangle, target);
  for (std::size_t s = 0; s < target.size() && device.keepsDepth; ++s)
    if (target[s].depth) kept[placeOf(s)] = *target[s].depth;
  std::vector<ItemId> ids(perPixel);
  for (std::size_t pixel = 0; pixel < buffer.ids.size(); ++pixel) {
    for (std::size_t s = 0; s < perPixel; ++s) ids[s] = target[pixel * perPixel + s].id;
    buffer.ids[pixel] = device.resolve(ids);
  }
  return buffer;
}

}  // namespace

StagedGeometry snappedTo(int bits, bool isNearest) {
  const double unit = std::ldexp(256.0, -bits);
  StagedGeometry geometry;
  geometry.snap = [=](double position) {
    return unit * (isNearest ? std::nearbyint(position / unit) : std::floor(position / unit));
  };
  return geometry;
}

glm::dvec3 weightedSum(const SnappedTriangle& triangle, const raster::Weights& edges, double (*weight)(double)) {
  glm::dvec3 sum(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const raster::ViewVertex& vertex = triangle.vertices[k];
    sum += static_cast<double>(edges[k]) * (weight(vertex.w) * glm::dvec3(vertex.u, vertex.v, 1));
  }
  return sum;
}

ItemId texelAt(const raster::IndexMap& map, const glm::dvec2& position) {
  const glm::dvec2 texel = glm::clamp(glm::floor(position), glm::dvec2(0.0), sizeOf(map) - 1.0);
  return map.ids[static_cast<std::size_t>(texel.y * map.width + texel.x)];
}

ItemId nearestTexel(const raster::IndexMap& map, const glm::dvec2& at) { return texelAt(map, at * sizeOf(map)); }

StagedDevice withReadBack(const ReadBack& readBack) {
  StagedDevice device;
  device.readBack = readBack;
  device.isDrawnByRules = true;
  return device;
}

PlacedVector placeVector(const TestVector& vector) {
  PlacedVector placed{vector.list, facesOf(vector), {}, {}, sourceOf(vector)};
  const StagedDevice device;
  const UploadedList uploaded{vector.list};
  KeptDepths kept;
  for (const VectorFace& face : vector.faces) {
    placed.triangles.push_back(placeFace(device, vector.list, face.face));
    placed.buffers.push_back(drawFace(device, uploaded, face.face, placed.triangles.back(), kept));
  }
  return placed;
}

std::optional<raster::DrawList> uploadedOn(const StagedDevice& device, const PlacedVector& placed) {
  if (!device.assemble && !device.upload) return {};
  std::optional<raster::DrawList> list = device.assemble ? device.assemble(placed.source) : placed.list;
  if (device.upload) device.upload(*list);
  return list;
}

void drawOn(const StagedDevice& device, const PlacedVector& placed,
            const std::function<bool(const raster::ItemBuffer&)>& wantsMore) {
  const std::optional<raster::DrawList> uploaded = uploadedOn(device, placed);
  drawOn(device, placed, uploaded ? *uploaded : placed.list, wantsMore);
}

void drawOn(const StagedDevice& device, const PlacedVector& placed, const raster::DrawList& list,
            const std::function<bool(const raster::ItemBuffer&)>& wantsMore) {
  constexpr int stripRows = 2;
  const UploadedList uploaded{list};
  const bool isSameMesh = !device.geometry && (&list == &placed.list || haveSameTriangles(list, placed.list));
  KeptDepths kept;
  for (std::size_t f = 0; f < placed.faces.size(); ++f) {
    raster::Face view = viewOf(device, placed.faces, f);
    const bool isPlaced = isSameMesh && isSameView(view, placed.faces[f]);
    const std::vector<SnappedTriangle> moved =
        isPlaced ? std::vector<SnappedTriangle>{} : placeFace(device, list, view);
    const std::vector<SnappedTriangle>& triangles = isPlaced ? placed.triangles[f] : moved;
    if (device.readBack) {
      raster::ItemBuffer buffer =
          device.isDrawnByRules ? placed.buffers[f] : drawFace(device, uploaded, view, triangles, kept);
      device.readBack(view, buffer);
      if (!wantsMore(buffer)) return;
      continue;
    }
    const int endRow = view.scissor.row + view.scissor.height;
    for (; view.scissor.row < endRow; view.scissor.row += stripRows) {
      view.scissor.height = std::min(stripRows, endRow - view.scissor.row);
      if (!wantsMore(drawFace(device, uploaded, view, triangles, kept))) return;
    }
  }
}

}  // namespace hemitex::reference
