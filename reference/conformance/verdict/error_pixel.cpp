#include "reference/conformance/verdict/error_pixel.h"

#include <algorithm>

namespace hemitex::reference {
namespace {

bool showsBack(const raster::DrawList& list, const Fragment& fragment) {
  return fragment.facesAway && list.draws[fragment.draw].back;
}

ErrorKind kindOf(const raster::DrawList& list, const std::optional<Fragment>& visible, const IdOrigin& found) {
  if (found.kind == IdOrigin::Kind::Background) return ErrorKind::Missing;
  if (found.kind == IdOrigin::Kind::Unknown) return ErrorKind::ForeignId;
  if (!visible) return ErrorKind::Extra;
  if (found.draw != visible->draw) return ErrorKind::WrongSurface;
  const bool foundBack = found.kind == IdOrigin::Kind::Back;
  return foundBack == showsBack(list, *visible) ? ErrorKind::WrongElement : ErrorKind::WrongSide;
}

}  // namespace

std::string toText(const ErrorPixel& error) {
  std::string text = "pixel " + std::to_string(error.column) + "," + std::to_string(error.row) + ", " +
                     nameOf(errorKindNames, error.kind) + ": expected " + std::to_string(error.expected) + " (" +
                     toText(error.expectedOrigin) + "), found " + std::to_string(error.found) + " (" +
                     toText(error.foundOrigin) + ")";
  if (error.visible) text += "; triangle " + std::to_string(error.visible->triangle) + " is visible there";
  return text;
}

ErrorPixel errorAt(const raster::DrawList& list, const std::string& face,
                   std::span<const raster::ScreenTriangle> triangles, int column, int row, raster::ItemId expected,
                   raster::ItemId found) {
  const std::vector<Fragment> fragments = fragmentsAt(list, triangles, column, row);
  const std::optional<Fragment> visible = fragments.empty() ? std::nullopt : std::optional(fragments.front());
  const std::optional<std::uint32_t> draw = visible ? std::optional(visible->draw) : std::nullopt;
  const IdOrigin expectedOrigin = originOf(list, expected, draw), foundOrigin = originOf(list, found, draw);
  const ErrorKind kind = kindOf(list, visible, foundOrigin);
  return {face, column, row, kind, expected, found, expectedOrigin, foundOrigin, visible};
}

ErrorPixel errorAt(const raster::DrawList& list, const VectorFace& face, int column, int row, raster::ItemId found) {
  const std::vector<raster::ScreenTriangle> triangles = screenTriangles(list, face.face);
  const std::vector<Fragment> fragments = fragmentsAt(list, triangles, column, row);
  const raster::ItemId expected = fragments.empty() ? raster::backgroundId(list.format) : fragments.front().id;
  return errorAt(list, face.name, triangles, column, row, expected, found);
}

std::vector<ErrorPixel> firstErrors(const TestVector& vector, const Verdict& verdict, std::size_t count) {
  std::vector<ErrorPixel> errors;
  for (std::size_t f = 0; f < verdict.faces.size() && errors.size() < count; ++f) {
    const FaceVerdict& face = verdict.faces[f];
    if (std::find(face.pixels.begin(), face.pixels.end(), PixelVerdict::Error) == face.pixels.end()) continue;
    const std::vector<raster::ScreenTriangle> triangles = screenTriangles(vector.list, vector.faces[f].face);
    const auto width = static_cast<std::size_t>(face.scissor.width);
    for (std::size_t pixel = 0; pixel < face.pixels.size() && errors.size() < count; ++pixel) {
      if (face.pixels[pixel] != PixelVerdict::Error) continue;
      const int column = face.scissor.column + static_cast<int>(pixel % width);
      const int row = face.scissor.row + static_cast<int>(pixel / width);
      errors.push_back(
          errorAt(vector.list, face.name, triangles, column, row, face.expected.ids[pixel], face.found.ids[pixel]));
    }
  }
  return errors;
}

}  // namespace hemitex::reference
