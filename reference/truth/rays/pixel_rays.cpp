#include "reference/truth/rays/pixel_rays.h"

#include <algorithm>
#include <array>
#include <limits>

#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "reference/truth/rays/embree_scene.h"

namespace hemitex::reference {
namespace {

constexpr int side = 4;  ///< of the square of pixels in a packet
constexpr std::size_t pixelsPerPacket = side * side;
/// Rows of packets per task.
constexpr int rowsAtOnce = 4;

EmbreeScene treeOver(const raster::DrawList& list) {
  if (std::any_of(list.indexMaps.begin(), list.indexMaps.end(), raster::hasHoles))
    throw raster::InputError("rays through pixels see no holes of index maps", "make the materials opaque");
  const auto make = [&list](RTCDevice device) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), list.positions.size()));
    std::copy(list.positions.begin(), list.positions.end(), positions);
    auto* const indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), list.indices.size() / 3));
    std::copy(list.indices.begin(), list.indices.end(), indices);
    return geometry;
  };
  return embreeTree(make, RTC_SCENE_FLAG_NONE);
}

/// Constants of all packets of a face.
struct FacePacket {
  RTCRayHit16 rays{};
  std::array<float, pixelsPerPacket> right{},
      down{};  ///< from the first sample of a packet to each other one, on the picture plane
};

FacePacket packetOf(const raster::Face& face) {
  FacePacket packet;
  for (std::size_t i = 0; i < pixelsPerPacket; ++i) {
    RTCRay16& ray = packet.rays.ray;
    ray.org_x[i] = face.eye.x;
    ray.org_y[i] = face.eye.y;
    ray.org_z[i] = face.eye.z;
    ray.tnear[i] = face.nearDistance;
    ray.mask[i] = ~0U;
    packet.right[i] = 2 * static_cast<float>(i % side) / static_cast<float>(face.resolution);
    packet.down[i] = 2 * static_cast<float>(i / side) / static_cast<float>(face.resolution);
  }
  return packet;
}

void aim(FacePacket& packet, const raster::Face& face, int column, int row) {
  const float x0 = static_cast<float>(2 * column + 1) / static_cast<float>(face.resolution) - 1;
  const float y0 = static_cast<float>(2 * row + 1) / static_cast<float>(face.resolution) - 1;
  RTCRayHit16& rays = packet.rays;
  for (std::size_t i = 0; i < pixelsPerPacket; ++i) {
    const float x = x0 + packet.right[i], y = y0 + packet.down[i];
    rays.ray.dir_x[i] = face.w.x + x * face.x.x + y * face.y.x;
    rays.ray.dir_y[i] = face.w.y + x * face.x.y + y * face.y.y;
    rays.ray.dir_z[i] = face.w.z + x * face.x.z + y * face.y.z;
    rays.ray.tfar[i] = std::numeric_limits<float>::infinity();
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.primID[i] = noTriangle;
  }
}

/// Pixels of a face's scissor rectangle, relative to it.
struct Rows {
  std::size_t face;
  int first, end;
};

std::vector<Rows> rowsOf(std::span<const raster::Face> faces) {
  std::vector<Rows> rows;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int first = 0; first < faces[f].scissor.height; first += rowsAtOnce * side)
      rows.push_back({f, first, std::min(first + rowsAtOnce * side, faces[f].scissor.height)});
  return rows;
}

void castRows(RTCScene scene, const raster::Face& face, int firstRow, int endRow, raster::ItemBuffer& buffer) {
  FacePacket packet = packetOf(face);
  alignas(64) std::array<int, pixelsPerPacket> all;
  all.fill(-1);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (int row = firstRow; row < endRow; row += side)
    for (int column = 0; column < buffer.width; column += side) {
      aim(packet, face, face.scissor.column + column, face.scissor.row + row);
      rtcIntersect16(all.data(), scene, &context, &packet.rays);
      const auto width = static_cast<std::size_t>(std::min(side, buffer.width - column));
      for (int j = row; j < std::min(row + side, endRow); ++j)
        std::copy_n(packet.rays.hit.primID + static_cast<std::ptrdiff_t>(j - row) * side, width,
                    buffer.ids.data() + static_cast<std::ptrdiff_t>(j) * buffer.width + column);
    }
}

}  // namespace

PixelRays::PixelRays(const raster::DrawList& list) : tree_(std::make_shared<EmbreeScene>(treeOver(list))) {}

void PixelRays::cast(std::span<const raster::Face> faces, std::vector<raster::ItemBuffer>& buffers) const {
  buffers.resize(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) buffers[f].resize(faces[f].scissor);
  const std::vector<Rows> rows = rowsOf(faces);
  raster::parallelFor(rows.size(), [&](std::size_t i) {
    const Rows& part = rows[i];
    castRows(tree_->scene.get(), faces[part.face], part.first, part.end, buffers[part.face]);
  });
}

}  // namespace hemitex::reference
