/// The pipeline of Nielsen and Christensen (2002), for hardware without shaders.
///
/// An item ID is a colour of four bytes. An index map is a texture with such colours, and the offset of a draw is the
/// flat colour of its triangles. The texture environment adds the two per byte with clamping. The vertex stage runs on
/// the CPU for each view. It puts corners on the sub-pixels of the rules before the device snaps them. The depth is
/// n/w, whose steps are finest far away, where it changes least; greater is nearer.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <tuple>
#include <vector>

#include "raster/base/input_error.h"
#include "raster/plain/rules.h"
#include "reference/devices/opengl/pipeline.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;

/// Whether a clamped add per byte gives the item IDs of the list.
bool addsAsBytes(const raster::DrawList& list) {
  const std::vector<int>& bits = list.format.channelBits;
  const bool areBytes = std::all_of(bits.begin(), bits.end(), [](int width) { return width == 8; });
  if (list.blend == raster::Blend::Replace || (list.blend == raster::Blend::ClampedAdd && areBytes)) return true;
  // Item IDs without common bits need no carry, for any channels.
  return std::all_of(list.draws.begin(), list.draws.end(), [&list](const raster::Draw& draw) {
    if (!draw.indexMap) return true;
    const std::vector<ItemId>& ids = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)].ids;
    return std::all_of(ids.begin(), ids.end(), [&draw](ItemId id) { return (id & draw.offset) == 0; });
  });
}

/// A corner of a triangle as OpenGL interpolates it.
struct Corner {
  glm::vec3 position;
  glm::vec2 texel;  ///< texture coordinates in texels
  float clipZ = 0;  ///< in clip space
};
using Corners = std::array<Corner, 3>;

/// u N, rounded down to binary32, which changes no floor. Devices round it before the floor function.
float texelPosition(float u, int size) {
  constexpr float largest = std::numeric_limits<float>::max();
  const double exact = std::clamp<double>(static_cast<double>(u) * size, -largest, largest);
  const float nearest = static_cast<float>(exact);
  return static_cast<double>(nearest) > exact ? std::nextafter(nearest, -largest) : nearest;
}

/// The triangle whose indices begin at `first`, or one without area if a value is not finite; `map` is null if the draw
/// has none.
Corners cornersAt(const raster::DrawList& list, std::uint32_t first, const raster::IndexMap* map) {
  Corners corners;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t vertex = list.indices[first + k];
    const glm::vec3& position = list.positions[vertex];
    const glm::vec2& texcoord = list.texcoords[vertex];
    const float clipZ = list.clipZ.empty() ? 0 : list.clipZ[vertex];
    if (!raster::isFinite({position.x, position.y, position.z, texcoord.x, texcoord.y, clipZ})) return {};
    corners[k].position = position;
    corners[k].clipZ = clipZ;
    if (map) corners[k].texel = {texelPosition(texcoord.x, map->width), texelPosition(texcoord.y, map->height)};
  }
  return corners;
}

/// OpenGL guarantees equal depths only for equal corners in equal order. Coincident triangles must have equal depths,
/// so corners are sorted by position, as far as the winding does not matter.
void sortCorners(Corners& corners, bool isTwoSided) {
  const auto less = [](const Corner& a, const Corner& b) {
    return std::tie(a.position.x, a.position.y, a.position.z) < std::tie(b.position.x, b.position.y, b.position.z);
  };
  if (isTwoSided) {
    std::sort(corners.begin(), corners.end(), less);
  } else {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), less), corners.end());
  }
}

/// A sample on the border of two texels shows the upper one. Interpolation has errors of some units in the last place
/// unless the coordinate is constant. They must not move the sample below the border. So coordinates move up by 16 such
/// units, at most 2^-10 texel.
void liftTexels(Corners& corners) {
  for (int axis = 0; axis < 2; ++axis) {
    const auto [low, high] = std::minmax({corners[0].texel[axis], corners[1].texel[axis], corners[2].texel[axis]});
    if (low == high) continue;
    const float lift = std::min(0x1p-10f, 0x1p-20f * std::max(std::abs(low), std::abs(high)));
    for (Corner& corner : corners) corner.texel[axis] += lift;
  }
}

/// The triangles of all draws, adjusted so that the device interpolates them correctly.
std::vector<Corners> preparedTriangles(const raster::DrawList& list) {
  std::vector<Corners> triangles;
  for (const raster::Draw& draw : list.draws) {
    const raster::IndexMap* map = draw.indexMap ? &list.indexMaps[static_cast<std::size_t>(*draw.indexMap)] : nullptr;
    for (std::uint32_t first = draw.first; first < draw.first + draw.count; first += 3) {
      triangles.push_back(cornersAt(list, first, map));
      sortCorners(triangles.back(), !draw.back && draw.cull == raster::Cull::None);
      liftTexels(triangles.back());
    }
  }
  return triangles;
}

/// The lowest byte is red.
glm::vec4 colourOf(ItemId id) { return glm::vec4(id & 255, id >> 8 & 255, id >> 16 & 255, id >> 24) / 255.0f; }

/// Moves a corner in front of the near plane to the sub-pixel that the rules snap it to, along an axis with this number
/// of pixels of the face, and of the viewport.
double clipCoordinate(const raster::Face& face, double x, double w, int pixels, int viewport) {
  const double subPixels = 128.0 * pixels;  // in a unit of x/w
  const double snapped = w < face.nearDistance ? x : std::nearbyint(x / w * subPixels) / subPixels * w;
  const double moved = face.sample == raster::SamplePlace::Corner ? w / pixels : 0;
  return (snapped + moved) * pixels / viewport;
}

class FixedFunction final : public OpenGlPipeline {
 public:
  explicit FixedFunction(const raster::DrawList& list);
  OpenGlPixels pixels() const override { return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_INT_8_8_8_8_REV}; }
  GLenum textureTarget() const override { return GL_TEXTURE_RECTANGLE; }
  /// In a scene the depth is n/w, unless it is stored as 1 - n/w.
  bool hasReversedDepths() const override { return isScene_ && !isStored_; }
  void clear(ItemId background) const override { glClearBufferfv(GL_COLOR, 0, &colourOf(background)[0]); }
  void setView(const raster::Face& face, const DeviceViewport& viewport) override;
  /// The offset is a colour, which is set per draw, and the fronts of a draw are drawn before its backs.
  bool joins(const raster::Draw&, const raster::Draw&) const override { return false; }
  void draw(const raster::Draw& draw, const VertexRuns& runs) override;

 private:
  /// GL_T4F_V4F: texture coordinates in texels, and clip coordinates.
  struct Vertex {
    glm::vec4 texel, position;
  };

  glm::vec4 clipPosition(const raster::Face& face, const DeviceViewport& viewport, const Corner& corner) const;

  bool isScene_, isStored_;
  std::vector<Corners> triangles_;
  std::vector<Vertex> vertices_;  ///< of the current view
};

FixedFunction::FixedFunction(const raster::DrawList& list)
    : isScene_(list.clipDepth == raster::ClipDepth::None),
      isStored_(list.depthPrecision != raster::DepthPrecision::Exact),
      triangles_(preparedTriangles(list)) {
  if (!addsAsBytes(list))
    throw raster::InputError("fixed-function hardware cannot add item IDs of these channels",
                             "use r8g8b8 or r8g8b8a8 with a clamped add, aligned offsets, or the shader path");
  if (list.value != raster::PixelValue::ItemIds)
    throw raster::InputError("fixed-function hardware draws item IDs alone", "use the shader path");
  if (std::any_of(list.indexMaps.begin(), list.indexMaps.end(), raster::hasHoles))
    throw raster::InputError("fixed-function hardware cannot discard the holes of index maps", "use the shader path");
  glDisable(GL_DITHER);
  glShadeModel(GL_FLAT);
  // The texture environment adds the texel to the colour, or replaces it.
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE);
  for (const GLenum channels : {GL_COMBINE_RGB, GL_COMBINE_ALPHA})
    glTexEnvi(GL_TEXTURE_ENV, channels, list.blend == raster::Blend::Replace ? GL_REPLACE : GL_ADD);
  glBindBuffer(GL_ARRAY_BUFFER, makeBuffer());
  glInterleavedArrays(GL_T4F_V4F, 0, nullptr);
}

glm::vec4 FixedFunction::clipPosition(const raster::Face& face, const DeviceViewport& viewport,
                                      const Corner& corner) const {
  const raster::ViewVertex view = raster::view(face, corner.position, corner.texel);
  const raster::Viewport size = raster::viewportOf(face);
  const double nearDistance = face.nearDistance;
  return glm::dvec4(clipCoordinate(face, view.x, view.w, size.columns, viewport.columns),
                    clipCoordinate(face, view.y, view.w, size.rows, viewport.rows),
                    !isScene_   ? static_cast<double>(corner.clipZ)
                    : isStored_ ? view.w - nearDistance
                                : nearDistance,
                    view.w);
}

void FixedFunction::setView(const raster::Face& face, const DeviceViewport& viewport) {
  vertices_.clear();
  for (const Corners& corners : triangles_) {
    std::array<glm::vec4, 3> positions;
    for (std::size_t k = 0; k < 3; ++k) positions[k] = clipPosition(face, viewport, corners[k]);
    const auto isFinite = [](const glm::vec4& p) { return !glm::any(glm::isnan(p)) && !glm::any(glm::isinf(p)); };
    if (!std::all_of(positions.begin(), positions.end(), isFinite)) positions.fill({0, 0, 0, 1});
    for (std::size_t k = 0; k < 3; ++k) vertices_.push_back({glm::vec4(corners[k].texel, 0, 1), positions[k]});
  }
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices_.size() * sizeof(Vertex)), vertices_.data(),
               GL_STREAM_DRAW);
}

void FixedFunction::draw(const raster::Draw& draw, const VertexRuns& runs) {
  const auto drawSide = [&runs](ItemId colour, bool isTextured, GLenum culled) {
    isTextured ? glEnable(GL_TEXTURE_RECTANGLE) : glDisable(GL_TEXTURE_RECTANGLE);
    culled == GL_NONE ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
    if (culled != GL_NONE) glCullFace(culled);
    glColor4fv(&colourOf(colour)[0]);
    drawRuns(runs);
  };
  using raster::Cull;
  const GLenum culled = draw.cull == Cull::Front ? GL_FRONT : draw.back || draw.cull == Cull::Back ? GL_BACK : GL_NONE;
  if (!draw.back || draw.cull != Cull::Front) drawSide(draw.offset, draw.indexMap.has_value(), culled);
  if (draw.back && draw.cull != Cull::Back) drawSide(*draw.back, false, GL_FRONT);
}

}  // namespace

std::unique_ptr<OpenGlPipeline> makeFixedFunction(const raster::DrawList& list) {
  return std::make_unique<FixedFunction>(list);
}

}  // namespace hemitex::reference
