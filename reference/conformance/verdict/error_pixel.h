/// The error pixels of a verdict, each with the expected fragment and the origins of both item IDs: the draw and the
/// texel that produce them, which show what a wrong item ID names.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/conformance/trace/fragments.h"
#include "reference/conformance/vectors/enum_names.h"
#include "reference/conformance/verdict/verdict.h"

namespace hemitex::reference {

/// The origin of an item ID: the background, or a draw that may produce it. With aligned offsets the draw is the
/// surface and the texel the element.
struct IdOrigin {
  enum class Kind { Background, Back, Offset, Texel, Triangle, Unknown };
  Kind kind = Kind::Unknown;
  std::uint32_t draw = 0;      ///< of Back, Offset, Texel and Triangle
  Texel texel;                 ///< of Texel: the first one of the draw's index map that holds the index
  std::uint32_t triangle = 0;  ///< of Triangle: its number in DrawList::indices / 3
};

/// The origin of `id`: draw `likely` if it is given and produces the item ID, else the first draw that does. The origin
/// of a sum with a clamped channel is unknown.
IdOrigin originOf(const raster::DrawList& list, raster::ItemId id, std::optional<std::uint32_t> likely = {});
/// "background", "back of draw 3", "draw 3", "draw 3 texel 5,7", "draw 3 triangle 8", "no draw".
std::string toText(const IdOrigin& origin);

/// How the found item ID differs from the expected one.
enum class ErrorKind : std::uint8_t {
  Missing,       ///< the background in place of a triangle
  Extra,         ///< a triangle in place of the background
  WrongSurface,  ///< another draw
  WrongElement,  ///< the right draw, another texel; or the number of another triangle
  WrongSide,     ///< the right draw, its back instead of its front or the reverse
  ForeignId,     ///< an item ID that no draw produces
};

/// In the order of the enum.
constexpr std::array<Named<ErrorKind>, 6> errorKindNames{{{ErrorKind::Missing, "missing"},
                                                          {ErrorKind::Extra, "extra"},
                                                          {ErrorKind::WrongSurface, "wrong surface"},
                                                          {ErrorKind::WrongElement, "wrong element"},
                                                          {ErrorKind::WrongSide, "wrong side"},
                                                          {ErrorKind::ForeignId, "foreign item ID"}}};

/// An error pixel.
struct ErrorPixel {
  std::string face;
  int column, row;  ///< in the viewport
  ErrorKind kind;
  raster::ItemId expected, found;
  IdOrigin expectedOrigin, foundOrigin;
  std::optional<Fragment> visible;  ///< none where the rules give the background
};

/// One line, without the face's name.
std::string toText(const ErrorPixel& error);

/// The error at a pixel of the viewport of the face named `face`, where a device drew `found` instead of `expected`.
/// `triangles` are those of that face (raster::snappedTriangles).
ErrorPixel errorAt(const raster::DrawList& list, const std::string& face,
                   std::span<const raster::SnappedTriangle> triangles, int column, int row, raster::ItemId expected,
                   raster::ItemId found);

/// The same for a single pixel, with the expected item ID of the rules: sets up all triangles of the face.
ErrorPixel errorAt(const raster::DrawList& list, const VectorFace& face, int column, int row, raster::ItemId found);

/// The first errors, face by face and row by row, at most `count` of them.
std::vector<ErrorPixel> firstErrors(const TestVector& vector, const Verdict& verdict, std::size_t count = 10);

}  // namespace hemitex::reference
