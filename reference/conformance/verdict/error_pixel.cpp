#include "reference/conformance/verdict/error_pixel.h"

#include <algorithm>

#include "raster/plain/plain_renderer.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;

/// The first texel of an index map that holds `id`.
std::optional<Texel> findTexel(const raster::IndexMap& map, ItemId id) {
  const auto place = std::find(map.ids.begin(), map.ids.end(), id);
  if (place == map.ids.end()) return {};
  const auto texel = static_cast<int>(place - map.ids.begin());
  return Texel{texel % map.width, texel / map.width};
}

/// The texel that gives `id` with an offset if no channel clamps.
ItemId texelUnder(const raster::DrawList& list, ItemId offset, ItemId id) {
  return list.blend == raster::Blend::Replace ? id : (id - offset) & raster::backgroundId(list.format);
}

std::optional<IdOrigin> originIn(const raster::DrawList& list, std::uint32_t number, ItemId id) {
  const raster::Draw& draw = list.draws[number];
  if (draw.back == id) return IdOrigin{IdOrigin::Kind::Back, number, {}};
  if (list.value == raster::PixelValue::TriangleNumbers) {
    const std::uint32_t inDraw = id - draw.offset;
    if (id < draw.offset || inDraw >= draw.count / 3) return {};
    return IdOrigin{IdOrigin::Kind::Triangle, number, {}, draw.first / 3 + inDraw};
  }
  if (list.value == raster::PixelValue::VertexValues) {
    for (std::uint32_t t = draw.first / 3; t < (draw.first + draw.count) / 3; ++t)
      if (flatValue(list, draw, t) == id) return IdOrigin{IdOrigin::Kind::Triangle, number, {}, t};
    return {};
  }
  if (list.value == raster::PixelValue::PassedSamples) return {};
  if (!draw.indexMap && draw.offset == id) return IdOrigin{IdOrigin::Kind::Offset, number, {}};
  if (!draw.indexMap) return {};
  const ItemId behind = texelUnder(list, draw.offset, id);
  if (behind == raster::holeTexel || raster::blend(list.format, list.blend, draw.offset, behind) != id) return {};
  const std::optional<Texel> texel = findTexel(list.indexMaps[static_cast<std::size_t>(*draw.indexMap)], behind);
  if (!texel) return {};
  return IdOrigin{IdOrigin::Kind::Texel, number, *texel};
}

bool showsBack(const raster::DrawList& list, const Fragment& fragment) {
  return fragment.facesAway && list.draws[fragment.draw].back;
}

ErrorKind kindOf(const raster::DrawList& list, const std::optional<Fragment>& visible, const IdOrigin& found) {
  if (found.kind == IdOrigin::Kind::Background) return ErrorKind::Missing;
  if (found.kind == IdOrigin::Kind::Unknown) return ErrorKind::ForeignId;
  if (!visible) return ErrorKind::Extra;
  if (found.draw != visible->draw && found.kind != IdOrigin::Kind::Triangle) return ErrorKind::WrongSurface;
  const bool foundBack = found.kind == IdOrigin::Kind::Back;
  return foundBack == showsBack(list, *visible) ? ErrorKind::WrongElement : ErrorKind::WrongSide;
}

}  // namespace

IdOrigin originOf(const raster::DrawList& list, ItemId id, std::optional<std::uint32_t> likely) {
  if (id == raster::clearedValue(list)) return {IdOrigin::Kind::Background, 0, {}};
  if (likely)
    if (const auto origin = originIn(list, *likely, id)) return *origin;
  for (std::uint32_t draw = 0; draw < list.draws.size(); ++draw)
    if (const auto origin = originIn(list, draw, id)) return *origin;
  return {};
}

std::string toText(const IdOrigin& origin) {
  const std::string draw = "draw " + std::to_string(origin.draw);
  switch (origin.kind) {
    case IdOrigin::Kind::Background:
      return "background";
    case IdOrigin::Kind::Back:
      return "back of " + draw;
    case IdOrigin::Kind::Offset:
      return draw;
    case IdOrigin::Kind::Texel:
      return draw + " texel " + std::to_string(origin.texel.column) + "," + std::to_string(origin.texel.row);
    case IdOrigin::Kind::Triangle:
      return draw + " triangle " + std::to_string(origin.triangle);
    case IdOrigin::Kind::Unknown:
      break;
  }
  return "no draw";
}

std::string toText(const ErrorPixel& error) {
  std::string text = "pixel " + std::to_string(error.column) + "," + std::to_string(error.row) + ", " +
                     nameOf(errorKindNames, error.kind) + ": expected " + std::to_string(error.expected) + " (" +
                     toText(error.expectedOrigin) + "), found " + std::to_string(error.found) + " (" +
                     toText(error.foundOrigin) + ")";
  if (error.visible) text += "; triangle " + std::to_string(error.visible->triangle) + " is visible there";
  return text;
}

ErrorPixel errorAt(const raster::DrawList& list, const std::string& face,
                   std::span<const raster::SnappedTriangle> triangles, int column, int row, raster::ItemId expected,
                   raster::ItemId found) {
  const std::vector<Fragment> fragments = fragmentsAt(list, triangles, column, row);
  const std::optional<Fragment> visible = fragments.empty() ? std::nullopt : std::optional(fragments.front());
  const std::optional<std::uint32_t> draw = visible ? std::optional(visible->draw) : std::nullopt;
  const IdOrigin expectedOrigin = originOf(list, expected, draw), foundOrigin = originOf(list, found, draw);
  const ErrorKind kind = kindOf(list, visible, foundOrigin);
  return {face, column, row, kind, expected, found, expectedOrigin, foundOrigin, visible};
}

ErrorPixel errorAt(const raster::DrawList& list, const VectorFace& face, int column, int row, raster::ItemId found) {
  const std::vector<raster::SnappedTriangle> triangles = raster::snappedTriangles(list, face.face);
  const std::vector<Fragment> fragments = fragmentsAt(list, triangles, column, row);
  const raster::ItemId expected = fragments.empty() ? raster::clearedValue(list) : fragments.front().id;
  return errorAt(list, face.name, triangles, column, row, expected, found);
}

std::vector<ErrorPixel> firstErrors(const TestVector& vector, const Verdict& verdict, std::size_t count) {
  std::vector<ErrorPixel> errors;
  for (std::size_t f = 0; f < verdict.faces.size() && errors.size() < count; ++f) {
    const FaceVerdict& face = verdict.faces[f];
    if (std::find(face.pixels.begin(), face.pixels.end(), PixelVerdict::Error) == face.pixels.end()) continue;
    const std::vector<raster::SnappedTriangle> triangles = raster::snappedTriangles(vector.list, vector.faces[f].face);
    for (std::size_t pixel = 0; pixel < face.pixels.size() && errors.size() < count; ++pixel) {
      if (face.pixels[pixel] != PixelVerdict::Error) continue;
      const glm::ivec2 at = pixelAt(face.scissor, pixel);
      errors.push_back(
          errorAt(vector.list, face.name, triangles, at.x, at.y, face.expected.ids[pixel], face.found.ids[pixel]));
    }
  }
  return errors;
}

}  // namespace hemitex::reference
