#include "tests/support/injected_faults.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "raster/plain/plain_renderer.h"
#include "tests/support/staged_drawing.h"

namespace hemitex::tests {

Buffers drawAll(const SimulatedDevice& device, const reference::TestVector& vector) {
  Buffers buffers;
  for (const reference::VectorFace& face : vector.faces) buffers.push_back(drawOn(device, vector.list, face.face));
  return buffers;
}

namespace {

using raster::ItemBuffer;
using raster::ItemId;
using reference::TestVector;

/// A fault in a stage of the device.
Injection onDevice(const std::string& fault, const std::string& vector,
                   const std::function<void(SimulatedDevice&)>& spoil) {
  return {fault, vector, [=](const TestVector& right, SimulatedDevice device) {
            spoil(device);
            return drawAll(device, right);
          }};
}

Injection under(const reference::DeviceProfile& profile, Injection injection) {
  injection.profile = profile;
  return injection;
}

/// A fault in the input.
Injection onInput(const std::string& fault, const std::string& vector, const std::function<void(TestVector&)>& spoil) {
  return {fault, vector, [=](const TestVector& right, const SimulatedDevice& device) {
            TestVector wrong = right;
            spoil(wrong);
            return drawAll(device, wrong);
          }};
}

/// A fault in the answer; `spoil` gets the item IDs of a face and its width.
Injection onIds(const std::string& fault, const std::string& vector,
                const std::function<void(std::vector<ItemId>&, std::size_t)>& spoil) {
  return {fault, vector, [=](const TestVector& right, const SimulatedDevice& device) {
            Buffers buffers = drawAll(device, right);
            for (ItemBuffer& buffer : buffers) spoil(buffer.ids, static_cast<std::size_t>(buffer.width));
            return buffers;
          }};
}

template <typename Change>
std::function<void(std::vector<ItemId>&, std::size_t)> everyId(const Change& change) {
  return [=](std::vector<ItemId>& ids, std::size_t) {
    for (ItemId& id : ids) id = change(id);
  };
}

ItemId bgra(ItemId rgba) { return (rgba & 0xff00ff00) | (rgba & 0xff) << 16 | (rgba >> 16 & 0xff); }

/// Applies a function to the single bytes of four item IDs or of two.
template <typename Byte>
ItemId bytewise(const Byte& byte) {
  return byte(0) | byte(8) << 8 | byte(16) << 16 | byte(24) << 24;
}

ItemId byteAt(ItemId id, ItemId shift) { return id >> shift & 255; }

// --- views and pictures ---

/// The viewport is the scissor rectangle: -1 and 1 are its borders.
Buffers scissorAsViewport(const TestVector& vector, SimulatedDevice device) {
  Buffers buffers;
  for (const reference::VectorFace& drawn : vector.faces) {
    const raster::Face& face = drawn.face;
    const auto placed = [&](double x, double w, int first, int size) {
      const double pixels = first * w + size * (x + w) / 2;  // times w
      return 2 * pixels / face.resolution - w;
    };
    device.vertex = [&](raster::ViewVertex& v) {
      v.x = placed(v.x, v.w, face.scissor.column, face.scissor.width);
      v.y = placed(v.y, v.w, face.scissor.row, face.scissor.height);
    };
    buffers.push_back(drawOn(device, vector.list, face));
  }
  return buffers;
}

/// Draws the scissor rectangles into targets of the size of their viewports, but reads the first pixels.
Buffers firstPixelsOfTargets(const TestVector& vector, const SimulatedDevice& device) {
  Buffers buffers = drawAll(device, vector);
  for (std::size_t f = 0; f < buffers.size(); ++f) {
    const raster::Scissor& scissor = vector.faces[f].face.scissor;
    const int resolution = vector.faces[f].face.resolution;
    std::vector<ItemId> target(static_cast<std::size_t>(resolution * resolution),
                               raster::backgroundId(vector.list.format));
    std::vector<ItemId>& ids = buffers[f].ids;
    const auto rowOf = [&](int column, int row) { return target.begin() + row * resolution + column; };
    for (int row = 0; row < scissor.height; ++row)
      std::copy_n(ids.begin() + row * scissor.width, scissor.width, rowOf(scissor.column, scissor.row + row));
    for (int row = 0; row < scissor.height; ++row)
      std::copy_n(rowOf(0, row), scissor.width, ids.begin() + row * scissor.width);
  }
  return buffers;
}

/// The viewport is `ratio` times as large, in a target as large as before.
Buffers zoomed(const TestVector& vector, SimulatedDevice device, double ratio) {
  device.vertex = [=](raster::ViewVertex& v) {
    v.x = ratio * (v.x + v.w) - v.w;
    v.y = ratio * (v.y + v.w) - v.w;
  };
  return drawAll(device, vector);
}

/// The target is twice as large, too, and so are the scissor rectangles; but the pixels are read as if it were not.
Buffers firstPixelsOfZoomed(const TestVector& vector, const SimulatedDevice& device) {
  TestVector twice = vector;
  for (reference::VectorFace& face : twice.faces) {
    face.face.resolution *= 2;
    face.face.scissor.column *= 2;
    face.face.scissor.row *= 2;
  }
  return drawAll(device, twice);
}

/// Faces from the second on are read before they are drawn.
void readTooEarly(TestVector& vector) {
  for (std::size_t f = vector.faces.size(); --f > 0;) {
    raster::Face& late = vector.faces[f].face;
    const raster::Scissor scissor = late.scissor;
    late = vector.faces[f - 1].face;
    late.scissor = scissor;
  }
}

/// Draws with a resolution that is `factor` times as large, and gives each pixel to `put(face, column, row, item ID)`.
template <typename Put>
void drawScaled(const TestVector& vector, const SimulatedDevice& device, double factor, const Put& put) {
  for (std::size_t f = 0; f < vector.faces.size(); ++f) {
    raster::Face face = vector.faces[f].face;
    for (int* length :
         {&face.resolution, &face.scissor.column, &face.scissor.row, &face.scissor.width, &face.scissor.height})
      *length = static_cast<int>(*length * factor);
    const ItemBuffer buffer = drawOn(device, vector.list, face);
    for (int pixel = 0; pixel < static_cast<int>(buffer.ids.size()); ++pixel)
      put(f, pixel % buffer.width, pixel / buffer.width, buffer.ids[static_cast<std::size_t>(pixel)]);
  }
}

Buffers enlarged(const TestVector& vector, const SimulatedDevice& device) {
  Buffers buffers = drawAll(device, vector);
  drawScaled(vector, device, 0.5, [&](std::size_t f, int column, int row, ItemId id) {
    for (const int y : {0, 1})
      for (const int x : {0, 1})
        buffers[f].ids[static_cast<std::size_t>((2 * row + y) * buffers[f].width + 2 * column + x)] = id;
  });
  return buffers;
}

/// Four pixels of twice the resolution are one; their bytes are averaged.
Buffers averaged(const TestVector& vector, const SimulatedDevice& device) {
  Buffers buffers = drawAll(device, vector);
  std::vector<std::vector<std::array<ItemId, 4>>> sums;
  for (const ItemBuffer& buffer : buffers) sums.emplace_back(buffer.ids.size());
  drawScaled(vector, device, 2, [&](std::size_t f, int column, int row, ItemId id) {
    for (ItemId k = 0; k < 4; ++k)
      sums[f][static_cast<std::size_t>(row / 2 * buffers[f].width + column / 2)][k] += byteAt(id, 8 * k);
  });
  for (std::size_t f = 0; f < buffers.size(); ++f)
    for (std::size_t p = 0; p < sums[f].size(); ++p)
      buffers[f].ids[p] = bytewise([&](ItemId shift) { return (sums[f][p][shift / 8] + 2) / 4; });
  return buffers;
}

/// The largest item ID around each pixel that is no background.
void dilate(std::vector<ItemId>& ids, std::size_t width) {
  const std::vector<ItemId> before = ids;
  for (std::size_t p = 0; p < ids.size(); ++p) {
    std::vector<ItemId> near;
    for (std::size_t q = 0; q < ids.size(); ++q) {
      const auto far = [](std::size_t a, std::size_t b) { return std::max(a, b) - std::min(a, b) > 1; };
      if (!far(p % width, q % width) && !far(p / width, q / width) && before[q] != 0xffffffff)
        near.push_back(before[q]);
    }
    if (!near.empty()) ids[p] = *std::max_element(near.begin(), near.end());
  }
}

std::vector<Injection> viewInjections() {
  const auto flippedRows = [](TestVector& vector) {
    for (reference::VectorFace& face : vector.faces) face.face.y = -face.face.y;
  };
  return {onDevice("y of the view flipped", "five-faces",
                   [](SimulatedDevice& device) { device.vertex = [](raster::ViewVertex& v) { v.y = -v.y; }; }),
          onInput("y of the view flipped", "scene-cornell-box-light", flippedRows),
          onDevice("x of the view flipped", "scissors",
                   [](SimulatedDevice& device) { device.vertex = [](raster::ViewVertex& v) { v.x = -v.x; }; }),
          onIds("picture upside down", "five-faces",
                [](std::vector<ItemId>& ids, std::size_t width) {
                  for (std::size_t p = 0; p < ids.size() / 2; ++p)
                    std::swap(ids[p], ids[(ids.size() / width - 1 - p / width) * width + p % width]);
                }),
          onIds("picture mirrored", "scissors",
                [](std::vector<ItemId>& ids, std::size_t width) {
                  for (std::size_t p = 0; p < ids.size(); ++p)
                    if (p % width < width / 2) std::swap(ids[p], ids[p / width * width + width - 1 - p % width]);
                }),
          onIds("picture transposed", "five-faces",
                [](std::vector<ItemId>& ids, std::size_t width) {
                  std::vector<ItemId> columns;
                  for (std::size_t column = 0; column < width; ++column)
                    for (std::size_t p = column; p < ids.size(); p += width) columns.push_back(ids[p]);
                  ids = columns;
                }),
          onInput("faces swapped", "five-faces",
                  [](TestVector& vector) {
                    if (vector.faces.size() > 3) std::swap(vector.faces[2].face, vector.faces[3].face);
                  }),
          onInput("faces turned", "five-faces",
                  [](TestVector& vector) {
                    raster::Face& top = vector.faces[0].face;
                    const glm::vec3 x = top.x;
                    top.x = -top.y;
                    top.y = x;
                  }),
          {"viewport scaled by a pixel ratio", "five-faces",
           [](const TestVector& vector, const SimulatedDevice& device) { return zoomed(vector, device, 1.5); }},
          {"viewport scaled by a pixel ratio", "scissors", firstPixelsOfZoomed},
          onInput("stale face", "five-faces", readTooEarly),
          {"enlarged picture", "five-faces", enlarged},
          onIds("dilation", "five-faces", dilate),
          {"viewport set to the scissor rectangle", "scissors", scissorAsViewport},
          {"viewport set to the scissor rectangle", "five-faces", scissorAsViewport},
          onInput("scissor rectangle read back from the wrong corner", "scissors",
                  [](TestVector& vector) {
                    for (reference::VectorFace& face : vector.faces)
                      face.face.scissor.column = face.face.scissor.row = 0;
                  }),
          {"scissor rectangle read back from the wrong corner", "scissors", firstPixelsOfTargets},
          onInput("a face's own eye ignored", "odd-faces", [](TestVector& vector) {
            for (reference::VectorFace& face : vector.faces) face.face.eye = vector.faces[0].face.eye;
          })};
}

// --- indices, transformation, clipping, snapping ---

/// Draws each face through a list whose positions are already clip coordinates.
Buffers throughMatrix(const TestVector& vector, const SimulatedDevice& device,
                      const std::function<glm::dmat4(const raster::Face&)>& matrixOf) {
  Buffers buffers;
  for (const reference::VectorFace& drawn : vector.faces) {
    const glm::dmat4 matrix = matrixOf(drawn.face);
    raster::DrawList list = vector.list;
    list.positions.clear();
    list.texcoords.clear();
    list.indices.clear();
    raster::Face plain = drawn.face;
    plain.eye = {0, 0, 0};
    plain.x = {1, 0, 0};
    plain.y = {0, 1, 0};
    plain.w = {0, 0, 1};
    plain.nearDistance = 1e-4f;
    if (raster::determinant(drawn.face) < 0) plain.x = -plain.x;
    struct Corner {
      glm::dvec3 position;
      glm::dvec2 texcoord;
      double at;
    };
    for (raster::Draw& draw : list.draws) {
      const std::uint32_t first = draw.first;
      draw.first = static_cast<std::uint32_t>(list.indices.size());
      for (std::uint32_t t = first; t < first + draw.count; t += 3) {
        std::vector<Corner> polygon;
        for (std::uint32_t k = 0; k < 3; ++k) {
          const std::uint32_t index = vector.list.indices[t + k];
          polygon.push_back({glm::dvec3(vector.list.positions[index]), glm::dvec2(vector.list.texcoords[index]), 0});
        }
        // z >= 0 and w - z >= 0, in object space.
        for (const bool isFar : {false, true}) {
          for (Corner& corner : polygon) {
            const glm::dvec4 p = matrix * glm::dvec4(corner.position, 1);
            corner.at = isFar ? p.w - p.z : p.z;
          }
          std::vector<Corner> inside;
          for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Corner &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
            if (a.at >= 0) inside.push_back(a);
            if ((a.at < 0) == (b.at < 0)) continue;
            const double part = a.at / (a.at - b.at);
            inside.push_back({glm::mix(a.position, b.position, part), glm::mix(a.texcoord, b.texcoord, part), 0});
          }
          polygon = inside;
        }
        for (std::size_t k = 2; k < polygon.size(); ++k)
          for (const std::size_t corner : {std::size_t{0}, k - 1, k}) {
            const glm::dvec4 p = matrix * glm::dvec4(polygon[corner].position, 1);
            list.indices.push_back(static_cast<std::uint32_t>(list.positions.size()));
            list.positions.push_back(glm::vec3(plain.x.x * p.x, p.y, p.w));
            list.texcoords.push_back(glm::vec2(polygon[corner].texcoord));
          }
      }
      draw.count = static_cast<std::uint32_t>(list.indices.size()) - draw.first;
    }
    buffers.push_back(drawOn(device, list, plain));
  }
  return buffers;
}

/// Rows for a column-major mat4, which the device then takes as columns.
glm::dmat4 rowsAsColumns(const raster::Face& face) {
  const auto row = [&](const glm::dvec3& axis) { return glm::dvec4(axis, -glm::dot(axis, glm::dvec3(face.eye))); };
  return {row(face.x), row(face.y), glm::dvec4(0, 0, 0, face.nearDistance), row(face.w)};
}

template <typename Unsigned>
void cutIndices(TestVector& vector) {
  for (std::uint32_t& index : vector.list.indices) index = static_cast<Unsigned>(index);
}

std::vector<Injection> geometryInjections() {
  reference::DeviceProfile clippedByRules;
  clippedByRules.looseClipping = false;
  const auto cutAtView = [](SimulatedDevice& device) { device.cutsAtView = true; };
  const auto snapTo4Bits = [](SimulatedDevice& device) { device.profile.subpixelBits = 4; };
  return {onInput("indices cut to fewer bits", "many-vertices", cutIndices<std::uint16_t>),
          onInput("indices cut to fewer bits", "fans-later-nearer", cutIndices<std::uint8_t>),
          onInput("matrix transposed", "five-faces-tilted",
                  [](TestVector& vector) {
                    for (reference::VectorFace& face : vector.faces) {
                      const glm::mat3 rows(face.face.x, face.face.y, face.face.w), columns = glm::transpose(rows);
                      face.face.x = columns[0];
                      face.face.y = columns[1];
                      face.face.w = columns[2];
                    }
                  }),
          {"matrix transposed", "rotated-view",
           [](const TestVector& vector, const SimulatedDevice& device) {
             return throughMatrix(vector, device, rowsAsColumns);
           }},
          under(clippedByRules, onDevice("clipping at other planes", "edges-beyond-the-view", cutAtView)),
          onInput("clipping at other planes", "near-plane-sheet",
                  [](TestVector& vector) {
                    for (reference::VectorFace& face : vector.faces) face.face.nearDistance /= 2;
                  }),
          onDevice("vertices snapped to fewer bits", "sub-pixel-sheet", snapTo4Bits),
          onDevice("vertices snapped to fewer bits", "perspective-sheet", snapTo4Bits)};
}

// --- coverage and depth ---

/// The background alone.
Buffers nothing(const TestVector& vector, const SimulatedDevice& device) {
  Buffers buffers = drawAll(device, vector);
  for (ItemBuffer& buffer : buffers)
    std::fill(buffer.ids.begin(), buffer.ids.end(), raster::backgroundId(vector.list.format));
  return buffers;
}

/// Coverage and depth at four samples, the colour once at the centre; bytes averaged.
Buffers multisampled(const TestVector& vector, SimulatedDevice device) {
  std::vector<Buffers> samples;
  for (const raster::SnappedPoint& sample : {raster::SnappedPoint{96, 32}, {224, 96}, {32, 160}, {160, 224}}) {
    device.sample = sample;
    samples.push_back(drawAll(device, vector));
  }
  Buffers resolved = samples[0];
  for (std::size_t f = 0; f < resolved.size(); ++f)
    for (std::size_t p = 0; p < resolved[f].ids.size(); ++p)
      resolved[f].ids[p] = bytewise([&](ItemId shift) {
        ItemId sum = 2;  // rounds a half up
        for (const Buffers& sample : samples) sum += byteAt(sample[f].ids[p], shift);
        return sum / 4;
      });
  return resolved;
}

/// The area that a polygon and a pixel share, in sub-pixels.
double sharedArea(std::vector<glm::dvec2> polygon, const glm::dvec2& pixel) {
  for (int side = 0; side < 4; ++side) {
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? 1 : -1, bound = pixel[axis] + (side % 2 == 0 ? 0 : 256);
    std::vector<glm::dvec2> inside;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const glm::dvec2 p = polygon[k], q = polygon[(k + 1) % polygon.size()];
      const double atP = sign * (p[axis] - bound), atQ = sign * (q[axis] - bound);
      if (atP >= 0) inside.push_back(p);
      if ((atP < 0) != (atQ < 0)) inside.push_back(p + atP / (atP - atQ) * (q - p));
    }
    polygon = inside;
  }
  double area = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const glm::dvec2 p = polygon[k - 1] - polygon[0], q = polygon[k] - polygon[0];
    area += p.x * q.y - p.y * q.x;
  }
  return std::abs(area) / 2;
}

/// The values of a triangle's corners on the plane through them, at a position, and the plane's slope per sub-pixel.
struct Plane {
  double value;
  glm::dvec2 slope;
};

Plane planeThrough(const raster::SnappedTriangle& triangle, const glm::dvec2& position, const glm::dvec3& values) {
  const auto corner = [&](std::size_t k) { return glm::dvec2(triangle.corners[k].x, triangle.corners[k].y); };
  const glm::dvec2 p = corner(1) - corner(0), q = corner(2) - corner(0);
  const double area = p.x * q.y - p.y * q.x, along = values[1] - values[0], across = values[2] - values[0];
  const glm::dvec2 slope((along * q.y - across * p.y) / area, (across * p.x - along * q.x) / area);
  return {values[0] + glm::dot(slope, position - corner(0)), slope};
}

/// Draws with plane equations, one pixel after the other. With `touches`, triangles show in all pixels that they touch;
/// `bias` times the larger slope of the depth 1/w takes triangles away.
Buffers drawnByPlanes(const TestVector& vector, bool touches, double bias) {
  Buffers buffers = reference::render(vector);
  for (std::size_t f = 0; f < buffers.size(); ++f) {
    const raster::Face& face = vector.faces[f].face;
    const std::vector<raster::SnappedTriangle> triangles = raster::snappedTriangles(vector.list, face);
    for (std::size_t pixel = 0; pixel < buffers[f].ids.size(); ++pixel) {
      const glm::ivec2 at = reference::pixelAt(face.scissor, pixel);
      const glm::dvec2 centre = 256.0 * glm::dvec2(at) + 128.0;
      double nearest = 0;
      ItemId& id = buffers[f].ids[pixel] = raster::backgroundId(vector.list.format);
      for (const raster::SnappedTriangle& triangle : triangles) {
        std::vector<glm::dvec2> polygon;
        glm::dvec3 inverse, u, v;
        for (int k = 0; k < 3; ++k) {
          const auto corner = static_cast<std::size_t>(k);
          polygon.emplace_back(triangle.corners[corner].x, triangle.corners[corner].y);
          inverse[k] = 1 / triangle.vertices[corner].w;
          u[k] = triangle.vertices[corner].u * inverse[k];
          v[k] = triangle.vertices[corner].v * inverse[k];
        }
        const bool isShown = touches ? sharedArea(polygon, centre - 128.0) > 1e-6
                                     : covers(triangle, weightsAt(triangle, raster::sampleOf(at.x, at.y)));
        const Plane depth = planeThrough(triangle, centre, inverse);
        const double value = depth.value - bias * 256 * std::max(std::abs(depth.slope.x), std::abs(depth.slope.y));
        if (!isShown || (nearest != 0 && value <= nearest * (1 + 1e-12))) continue;
        nearest = value;
        const raster::Draw& draw = vector.list.draws[triangle.draw];
        id = draw.offset;
        if (draw.back && triangle.facesAway)
          id = *draw.back;
        else if (draw.indexMap) {
          const raster::IndexMap& map = vector.list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
          const glm::dvec2 coordinates =
              glm::dvec2(planeThrough(triangle, centre, u).value, planeThrough(triangle, centre, v).value) /
              depth.value;
          id = raster::blend(vector.list.format, vector.list.blend, draw.offset,
                             reference::nearestTexel(map, coordinates));
        }
      }
    }
  }
  return buffers;
}

Buffers withoutEdges(const TestVector& vector, const SimulatedDevice& device) {
  reference::StagedDevice stages = stagedDeviceOf(device);
  stages.ownsSamples = [](const raster::SnappedPoint&) { return false; };
  return drawAll(stages, vector);
}

void turnTriangles(TestVector& vector) {
  std::vector<std::uint32_t>& indices = vector.list.indices;
  for (std::size_t i = 0; i < indices.size(); i += 3) std::swap(indices[i], indices[i + 1]);
}

/// The second face of the vector is mirrored, so that its triangles have the opposite winding.
Buffers turnedInMirror(const TestVector& vector, const SimulatedDevice& device) {
  TestVector turned = vector;
  turnTriangles(turned);
  Buffers buffers = drawAll(device, vector);
  if (vector.faces.size() > 1) buffers[1] = drawOn(device, turned.list, vector.faces[1].face);
  return buffers;
}

/// All faces are drawn into one target whose depths are cleared once.
Buffers withDepthsKept(const TestVector& vector, const SimulatedDevice& device) {
  reference::StagedDevice stages = stagedDeviceOf(device);
  stages.keepsDepth = true;
  return drawAll(stages, vector);
}

std::vector<Injection> sampleInjections() {
  reference::DeviceProfile strict;
  strict.strictDepth = true;
  strict.depthTolerance = 0.5;  // only rounding, which is the same for equal triangles
  const auto orEqual = [](SimulatedDevice& device) { device.passes = std::less_equal<double>(); };
  return {{"triangles missing", "rotated-view", nothing},
          onInput("front and back exchanged", "backs", turnTriangles),
          {"front and back exchanged", "backs", turnedInMirror},
          {"wrong fill rule", "borders-on-samples", withoutEdges},
          onDevice("wrong fill rule", "fans-later-nearer", [](SimulatedDevice& device) { device.bottomRight = true; }),
          {"conservative rasterization", "five-faces",
           [](const TestVector& vector, const SimulatedDevice&) { return drawnByPlanes(vector, true, 0); }},
          {"supersampling averaged", "five-faces", averaged},
          {"depth bias", "crossing",
           [](const TestVector& vector, const SimulatedDevice&) { return drawnByPlanes(vector, false, 2); }},
          onDevice("sample at the pixel corner", "five-faces",
                   [](SimulatedDevice& device) {
                     device.sample = device.shading = {0, 0};
                   }),
          {"multisampling", "five-faces", multisampled},
          onDevice("16-bit depth", "depth-range",
                   [](SimulatedDevice& device) {
                     device.profile.depthFormat = reference::DepthFormat::Unorm16;
                     device.profile.depthTolerance = 0.5;  // only rounding
                   }),
          onDevice("depth test off", "depth-stack",
                   [](SimulatedDevice& device) { device.passes = [](double, double) { return true; }; }),
          onDevice("depth test reversed", "depth-stack",
                   [](SimulatedDevice& device) { device.passes = std::greater<double>(); }),
          under(strict, onDevice("equal depths pass the depth test", "equal-depths", orEqual)),
          under(strict, onDevice("equal depths pass the depth test", "equal-depths-sloped", orEqual)),
          {"depth not cleared between faces", "five-faces", withDepthsKept},
          {"depth not cleared between faces", "five-faces-tilted", withDepthsKept}};
}

// --- textures ---

ItemId texelOf(const raster::IndexMap& map, double column, double row) {
  const double i = std::clamp(std::floor(column), 0.0, map.width - 1.0);
  const double j = std::clamp(std::floor(row), 0.0, map.height - 1.0);
  return map.ids[static_cast<std::size_t>(j * map.width + i)];
}

/// The weighted mean of the four texels whose centres surround a position, for maps of numbers.
ItemId bilinear(const raster::IndexMap& map, const glm::dvec2& at) {
  double sum = 0;
  for (const double dx : {-0.5, 0.5})
    for (const double dy : {-0.5, 0.5}) {
      const glm::dvec2 centre = glm::floor(at + glm::dvec2(dx, dy)) + 0.5;
      const glm::dvec2 weight = 1.0 - glm::abs(at - centre);
      sum += weight.x * weight.y * texelOf(map, centre.x, centre.y);
    }
  return static_cast<ItemId>(std::lround(sum));
}

/// One texel per 8 x 8 texels of a counting map, with the mean of their numbers: the third level, where 7.5 texels make
/// a pixel.
ItemId thirdLevel(const raster::IndexMap& map, const glm::dvec2& at) {
  const glm::dvec2 first = 8.0 * glm::floor(glm::clamp(at / 8.0, glm::dvec2(0.0), glm::dvec2(14.0)));
  return static_cast<ItemId>(std::lround((first.y + 3.5) * map.width + first.x + 3.5));
}

float throughBinary16(float x) { return glm::unpackHalf1x16(glm::packHalf1x16(x)); }

std::vector<Injection> textureInjections() {
  reference::DeviceProfile exact;
  exact.texelPrecision = 0;
  const auto inHalfFloats = [](const raster::IndexMap& map, const glm::dvec2& at) {
    return texelOf(map, static_cast<double>(throughBinary16(static_cast<float>(at.x / map.width))) * map.width,
                   static_cast<double>(throughBinary16(static_cast<float>(at.y / map.height))) * map.height);
  };
  const auto justBelow = [](const raster::IndexMap& map, const glm::dvec2& at) {
    const auto below = [](double x) { return static_cast<double>(std::nextafter(static_cast<float>(x), -1.0f)); };
    return texelOf(map, below(at.x), below(at.y));
  };
  const auto fetching = [](const auto& fetch) { return [=](SimulatedDevice& device) { device.fetch = fetch; }; };
  const auto repeated = [](const raster::IndexMap& map, const glm::dvec2& at) {
    const auto wrapped = [](double texel, int size) { return texel - size * std::floor(texel / size); };
    return texelOf(map, wrapped(at.x, map.width), wrapped(at.y, map.height));
  };
  const auto truncated = [](const raster::IndexMap& map, const glm::dvec2& at) {
    const auto cut = [](double texel, int size) { return std::floor(texel / size * 256) / 256 * size; };
    return texelOf(map, cut(at.x, map.width), cut(at.y, map.height));
  };
  const auto cutAtHeight = [](const raster::IndexMap& map, const glm::dvec2& at) {
    const raster::IndexMap cut{map.height, map.width, map.ids};
    return texelOf(cut, at.x / map.width * cut.width, at.y / map.height * cut.height);
  };
  return {onDevice("affine instead of perspective interpolation", "perspective-twist",
                   [](SimulatedDevice& device) { device.affine = true; }),
          onDevice("linear filtering", "five-faces", fetching(bilinear)),
          onDevice("mipmapping", "minified", fetching(thirdLevel)),
          onDevice("repeat instead of clamp", "clamped-coordinates", fetching(repeated)),
          onDevice("texels at u (N - 1)", "five-faces", fetching([](const raster::IndexMap& map, const glm::dvec2& at) {
                     const auto last = [](double texel, int size) { return std::round(texel / size * (size - 1)); };
                     return texelOf(map, last(at.x, map.width), last(at.y, map.height));
                   })),
          under(exact, onDevice("u N rounded to binary32", "texels-1000",
                                fetching([](const raster::IndexMap& map, const glm::dvec2& at) {
                                  return texelOf(map, static_cast<float>(at.x), static_cast<float>(at.y));
                                }))),
          onDevice("half-texel shift", "five-faces", [](SimulatedDevice& device) { device.texelShift = 0.5; }),
          onDevice("truncated texture coordinates (16.8)", "perspective-clipped", fetching(truncated)),
          onInput("index map upside down", "five-faces",
                  [](TestVector& vector) {
                    for (raster::IndexMap& map : vector.list.indexMaps)
                      for (auto end = map.ids.end(); map.ids.end() - end < end - map.ids.begin(); end -= map.width)
                        std::swap_ranges(end - map.width, end, map.ids.begin() + (map.ids.end() - end));
                  }),
          onDevice("width and height of the index map exchanged", "rectangular-map", fetching(cutAtHeight)),
          onInput("texture coordinates in half floats", "fine-coordinates",
                  [](TestVector& vector) {
                    for (glm::vec2& t : vector.list.texcoords) t = {throughBinary16(t.x), throughBinary16(t.y)};
                  }),
          onDevice("texture coordinates in half floats", "fine-coordinates", fetching(inHalfFloats)),
          under(exact,
                onDevice("texture coordinates just below the exact ones", "constant-coordinates", fetching(justBelow))),
          onInput("index map transposed", "five-faces",
                  [](TestVector& vector) {
                    for (raster::IndexMap& map : vector.list.indexMaps) {
                      const std::vector<ItemId> rows = map.ids;
                      const auto width = static_cast<std::size_t>(map.width),
                                 height = static_cast<std::size_t>(map.height);
                      for (std::size_t k = 0; k < rows.size(); ++k) map.ids[k] = rows[k % height * width + k / height];
                    }
                  }),
          onDevice("index map transposed", "perspective-twist",
                   fetching([](const raster::IndexMap& map, const glm::dvec2& at) {
                     return texelOf(map, at.y / map.height * map.width, at.x / map.width * map.height);
                   })),
          onDevice("index map not sampled", "byte-pairs",
                   fetching([](const raster::IndexMap&, const glm::dvec2&) { return ItemId{0}; }))};
}

// --- item IDs ---

std::vector<Injection> blendInjections() {
  const auto blending = [](const auto& blend) { return [=](SimulatedDevice& device) { device.blend = blend; }; };
  const auto bytes = [](const auto& sum) {
    return [=](ItemId a, ItemId b) {
      return bytewise([=](ItemId shift) { return sum(byteAt(a, shift), byteAt(b, shift)); });
    };
  };
  const std::string layout = "layout-r8g8b8a8";
  const auto overTarget = [](ItemId target, ItemId fragment) {
    const double alpha = byteAt(fragment, 24) / 255.0;
    return bytewise([=](ItemId shift) {
      return static_cast<ItemId>(std::lround(alpha * byteAt(fragment, shift) + (1 - alpha) * byteAt(target, shift)));
    });
  };
  return {onDevice("modulate instead of add", layout,
                   blending(bytes([](ItemId a, ItemId b) { return (a * b + 127) / 255; }))),
          onDevice("wrap instead of clamp", layout, blending(bytes([](ItemId a, ItemId b) { return (a + b) & 255; }))),
          onDevice("carry across channels", layout, blending([](ItemId a, ItemId b) { return a + b; })),
          onDevice("clamp instead of integer add", "integer-add-32",
                   blending(bytes([](ItemId a, ItemId b) { return std::min(a + b, 255u); }))),
          onInput("offset not aligned", "many-maps",
                  [](TestVector& vector) {
                    ItemId next = 0;
                    for (raster::Draw& draw : vector.list.draws) {
                      const raster::IndexMap& map = vector.list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
                      draw.offset = next;
                      next += static_cast<ItemId>(map.width * map.height);
                    }
                  }),
          onInput("colour from the wrong provoking vertex", "shared-vertices",
                  [](TestVector& vector) {
                    // The last vertex of a triangle is the first of the second triangle after it; a strip's end has
                    // none.
                    const std::vector<raster::Draw> draws = vector.list.draws;
                    for (std::size_t t = 0; t < draws.size(); ++t)
                      vector.list.draws[t].offset = draws[std::min({t + 2, t / 15 * 15 + 14, draws.size() - 1})].offset;
                  }),
          onDevice("blending left on", layout, [=](SimulatedDevice& device) { device.store = overTarget; })};
}

/// 8 bits of red and blue to 5 and of green to 6, dithered by the recursive matrix of 4 x 4 thresholds, and back.
void ditherTo565(std::vector<ItemId>& ids, std::size_t width) {
  constexpr std::array<int, 16> matrix{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
  for (std::size_t p = 0; p < ids.size(); ++p) {
    const double threshold = (matrix[p / width % 4 * 4 + p % width % 4] + 0.5) / 16;
    const auto reduced = [&](ItemId shift, double largest) {
      const double level = std::floor(byteAt(ids[p], shift) / 255.0 * largest + threshold);
      return static_cast<ItemId>(std::lround(level / largest * 255)) << shift;
    };
    ids[p] = reduced(0, 31) | reduced(8, 63) | reduced(16, 31) | (ids[p] & 0xff000000);
  }
}

ItemId encoded(ItemId id) {
  const auto channel = [=](ItemId shift) {
    const double linear = byteAt(id, shift) / 255.0;
    const double value = linear < 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return static_cast<ItemId>(std::lround(255 * value)) << shift;
  };
  return channel(0) | channel(8) | channel(16) | (id & 0xff000000);
}

/// 24 significant bits.
ItemId throughBinary32(ItemId id) {
  const double unit = std::ldexp(1.0, std::max(0, static_cast<int>(std::bit_width(id)) - 24));
  return static_cast<ItemId>(std::min(std::nearbyint(id / unit) * unit, 4294967295.0));
}

ItemId throughBinary16(ItemId id) {
  const float read = throughBinary16(static_cast<float>(id));
  return std::isinf(read) ? 0xffffffff : static_cast<ItemId>(read);
}

/// Bright colours fitted to the display.
ItemId compressed(ItemId id) {
  const auto channel = [=](ItemId shift) {
    const double value = byteAt(id, shift) / 255.0;
    return static_cast<ItemId>(std::lround(255 * (1 - std::exp(-value)))) << shift;
  };
  return channel(0) | channel(8) | channel(16) | (id & 0xff000000);
}

ItemId premultiplied(ItemId id) {
  const ItemId alpha = id >> 24;
  return bytewise([=](ItemId shift) { return shift == 24 ? alpha : (byteAt(id, shift) * alpha + 127) / 255; });
}

std::vector<Injection> memoryInjections() {
  const std::string layout = "layout-r8g8b8a8";
  const auto premultiplyMaps = [](TestVector& vector) {
    for (raster::IndexMap& map : vector.list.indexMaps)
      for (ItemId& id : map.ids) id = premultiplied(id);
  };
  return {
      onInput("premultiplied alpha", "byte-pairs", premultiplyMaps),
      onInput("premultiplied alpha", layout, premultiplyMaps),
      onIds("premultiplied alpha", layout, everyId(premultiplied)),
      onInput("item IDs cut to fewer bits", "unique-maps",
              [](TestVector& vector) {
                for (raster::IndexMap& map : vector.list.indexMaps)
                  for (ItemId& id : map.ids) id &= 0xffff;
              }),
      onInput("item IDs cut to fewer bits", "single-elements",
              [](TestVector& vector) {
                for (raster::Draw& draw : vector.list.draws) draw.offset &= 0xffff;
              }),
      onInput("channels swapped in the texture (BGRA)", layout,
              [](TestVector& vector) {
                for (raster::IndexMap& map : vector.list.indexMaps)
                  for (ItemId& id : map.ids) id = bgra(id);
              }),
      onInput("channels swapped in the offset (BGRA)", layout,
              [](TestVector& vector) {
                for (raster::Draw& draw : vector.list.draws) draw.offset = bgra(draw.offset);
              }),
      onIds("channels swapped in the target (BGRA)", layout, everyId(bgra)),
      onIds("byte order", layout,
            everyId([](ItemId w) { return w >> 24 | (w >> 8 & 0xff00) | (w << 8 & 0xff0000) | w << 24; })),
      onIds("item IDs through binary32", layout, everyId(throughBinary32)),
      onIds("item IDs through binary32", layout,
            everyId([](ItemId id) { return id >= 0xffffff80 ? 0 : throughBinary32(id); })),
      onIds("item IDs through half floats", "fine-coordinates", everyId([](ItemId id) { return throughBinary16(id); })),
      onIds("item ID interpolated", "five-faces",
            [](std::vector<ItemId>& ids, std::size_t) {
              for (std::size_t p = 0; p < ids.size(); ++p)
                if (p * 2654435761u >> 16 & 1 && ids[p] != 0 && ids[p] != 0xffffffff) --ids[p];
            }),
      onIds("tone mapping", layout, everyId(compressed)),
      onIds("alpha forced to opaque", layout, everyId([](ItemId w) { return w | 0xff000000; })),
      onIds("background not cleared", "five-faces", everyId([](ItemId w) { return w == 0xffffffff ? 0 : w; })),
      onIds("background not cleared", layout, everyId([](ItemId w) { return w == 0xffffffff ? 0xff000000 : w; })),
      onIds("padded rows", "rectangular-map",
            [](std::vector<ItemId>& ids, std::size_t width) {
              std::vector<ItemId> padded;  // to whole lines of 64 bytes
              for (std::size_t row = 0; row < ids.size() / width; ++row) {
                padded.insert(padded.end(), &ids[row * width], &ids[row * width] + width);
                padded.insert(padded.end(), (16 - width % 16) % 16, 0);
              }
              std::copy_n(padded.begin(), ids.size(), ids.begin());
            }),
      onIds("sRGB encoding", layout, everyId(encoded)),
      onIds("dithering", layout, ditherTo565)};
}

// --- draws and passes ---

/// A device whose fragments change with their distance.
Injection fading(const std::string& fault, const std::string& vector,
                 const std::function<ItemId(ItemId, double)>& fade) {
  return {fault, vector, [=](const TestVector& right, const SimulatedDevice& device) {
            reference::StagedDevice stages = stagedDeviceOf(device);
            stages.fade = fade;
            return drawAll(stages, right);
          }};
}

/// A byte in fog of which `part` is clear.
ItemId fogged(ItemId id, double part, double fog) {
  const auto byte = [=](ItemId shift) {
    return static_cast<ItemId>(std::lround(part * byteAt(id, shift) + (1 - part) * fog)) << shift;
  };
  return byte(0) | byte(8) | byte(16) | (id & 0xff000000);
}

/// Each pixel shows the texels at the corner that it shares with the three others of its block.
Buffers inBlocks(const TestVector& vector, SimulatedDevice device) {
  Buffers blocks = drawAll(device, vector);
  for (const int odd : {0, 1, 2, 3}) {
    device.shading = {odd % 2 == 0 ? 256 : 0, odd / 2 == 0 ? 256 : 0};
    const Buffers shifted = drawAll(device, vector);
    for (std::size_t f = 0; f < blocks.size(); ++f)
      for (std::size_t p = 0; p < blocks[f].ids.size(); ++p) {
        const glm::ivec2 at = reference::pixelAt(vector.faces[f].face.scissor, p);
        if (at.x % 2 + 2 * (at.y % 2) == odd) blocks[f].ids[p] = shifted[f].ids[p];
      }
  }
  return blocks;
}

/// Draws the edges of triangles from corner to corner, a pixel per step of the longer axis.
Buffers asLines(const TestVector& vector, const SimulatedDevice& device) {
  reference::StagedDevice stages = stagedDeviceOf(device);
  stages.drawsLines = true;
  return drawAll(stages, vector);
}

Buffers withoutSmallOnes(const TestVector& vector, const SimulatedDevice& device) {
  reference::StagedDevice stages = stagedDeviceOf(device);
  stages.keeps = [](const raster::SnappedTriangle& triangle) {
    return std::abs(static_cast<double>(triangle.area)) / 2 / 65536 >= 1;
  };
  return drawAll(stages, vector);
}

Buffers jittered(const TestVector& vector, SimulatedDevice device) {
  const double pixels = 2.0 / vector.faces[0].face.resolution;
  device.vertex = [=](raster::ViewVertex& v) {
    v.x += -0.25 * pixels * v.w;
    v.y += pixels / 6 * v.w;
  };
  return drawAll(device, vector);
}

/// The smallest power of two that is at least `size`.
int powerFrom(int size) { return static_cast<int>(std::bit_ceil(static_cast<unsigned>(size))); }

void scaleToPowers(TestVector& vector) {
  for (raster::IndexMap& map : vector.list.indexMaps) {
    raster::IndexMap scaled{powerFrom(map.width), powerFrom(map.height), {}};
    for (int row = 0; row < scaled.height; ++row)
      for (int column = 0; column < scaled.width; ++column)
        scaled.ids.push_back(
            map.ids[static_cast<std::size_t>((2 * row + 1) * map.height / (2 * scaled.height) * map.width +
                                             (2 * column + 1) * map.width / (2 * scaled.width))]);
    map = scaled;
  }
}

void moveRight(std::vector<ItemId>& ids, std::size_t width) {
  for (std::size_t p = ids.size(); p-- > 0;) ids[p] = p % width == 0 ? 0xffffffff : ids[p - 1];
}

/// Tiles of 8 x 8 pixels follow each other in memory.
void readTilesAsRows(std::vector<ItemId>& ids, std::size_t width) {
  std::vector<ItemId> tiled;
  for (std::size_t top = 0; top < ids.size() / width; top += 8)
    for (std::size_t left = 0; left < width; left += 8)
      for (std::size_t row = top; row < top + 8; ++row)
        for (std::size_t column = left; column < left + 8; ++column) tiled.push_back(ids[row * width + column]);
  ids = tiled;
}

std::vector<Injection> drawInjections() {
  const auto bordered = [](const raster::IndexMap& map, const glm::dvec2& at) {
    const bool isInside = at.x >= 0 && at.y >= 0 && at.x < map.width && at.y < map.height;
    return isInside ? texelOf(map, at.x, at.y) : ItemId{0};
  };
  return {
      fading("fog", "five-faces", [](ItemId id, double w) { return fogged(id, std::exp(-0.37 * w), 0); }),
      fading("fog", "five-faces-tilted",
             [](ItemId id, double w) { return fogged(id, std::clamp((7 - w) / 6.5, 0.0, 1.0), 127.5); }),
      fading("far plane", "perspective-floor", [](ItemId id, double w) { return w > 10 ? 0xffffffff : id; }),
      onInput("draws or triangles not drawn", "five-faces", [](TestVector& vector) { vector.list.draws.pop_back(); }),
      onInput("draws or triangles not drawn", "fans-later-nearer",
              [](TestVector& vector) {
                for (raster::Draw& draw : vector.list.draws) draw.count -= 3;
              }),
      {"small triangles not drawn", "sub-pixel-sheet", withoutSmallOnes},
      onInput("offset of another draw", "five-faces",
              [](TestVector& vector) {
                for (raster::Draw& draw : vector.list.draws) draw.offset = vector.list.draws.back().offset;
              }),
      onInput("index map of another draw", "many-maps",
              [](TestVector& vector) {
                for (raster::Draw& draw : vector.list.draws) draw.indexMap = vector.list.draws[0].indexMap;
              }),
      {"polygon mode of lines", "five-faces", asLines},
      {"coarse shading", "five-faces", inBlocks},
      onIds("item IDs one too large", "five-faces", everyId([](ItemId id) { return id + 1; })),
      onIds("item IDs one too large", "five-faces", everyId([](ItemId id) { return id == 0xffffffff ? id : id + 1; })),
      onIds("item ID 0 taken for nothing", "coplanar-light-first",
            everyId([](ItemId id) { return id == 0 ? 0xffffffff : id; })),
      onIds("item IDs through signed integers", "edge-offsets-r32ui",
            everyId([](ItemId id) { return std::min(id, 0x7fffffffu); })),
      onIds("tiled memory read as rows", "sample-grid-later-nearer", readTilesAsRows),
      onDevice("border colour beyond the map", "clamped-coordinates",
               [=](SimulatedDevice& device) { device.fetch = bordered; }),
      onInput("size of the index map a power of two", "perspective-twist", scaleToPowers),
      {"projection moved within a pixel", "five-faces", jittered},
      onIds("picture moved by a pixel", "five-faces", moveRight)};
}

}  // namespace

std::vector<Injection> injectedFaults() {
  std::vector<Injection> all;
  for (const auto& some : {viewInjections, geometryInjections, sampleInjections, textureInjections, blendInjections,
                           memoryInjections, drawInjections})
    for (Injection& injection : some()) all.push_back(std::move(injection));
  return all;
}

}  // namespace hemitex::tests
