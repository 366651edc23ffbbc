/// The errors of a verdict, each with what the rules show there and what the device's item ID stands for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/vectors/enum_names.h"
#include "reference/verdict/id_origin.h"
#include "reference/verdict/verdict.h"

namespace hemitex::reference {

/// What a device shows in place of what.
enum class ErrorKind : std::uint8_t {
  Missing,       ///< the background in place of a triangle
  Extra,         ///< a triangle in place of the background
  WrongSurface,  ///< another draw
  WrongElement,  ///< the right draw, another texel
  WrongSide,     ///< the right draw, its back for its front or the other way
  ForeignId,     ///< an item ID that no draw gives
};

/// In the order of the enum.
constexpr std::array<Named<ErrorKind>, 6> errorKindNames{{{ErrorKind::Missing, "missing"},
                                                          {ErrorKind::Extra, "extra"},
                                                          {ErrorKind::WrongSurface, "wrong surface"},
                                                          {ErrorKind::WrongElement, "wrong element"},
                                                          {ErrorKind::WrongSide, "wrong side"},
                                                          {ErrorKind::ForeignId, "foreign word"}}};

/// An error, with what the rules show there.
struct ErrorPixel {
  std::string face;
  int column, row;  ///< in the viewport
  ErrorKind kind;
  raster::ItemId expected, found;
  IdOrigin expectedOrigin, foundOrigin;
  std::optional<Fragment> visible;  ///< none where the rules show the background
};

/// One line, without the face's name.
std::string toText(const ErrorPixel& error);

/// The error at a pixel of the viewport of a face, given its name and its screen triangles (fragments.h), where the
/// device found another item ID than the rules.
ErrorPixel errorAt(const raster::DrawList& list, const std::string& face,
                   std::span<const raster::ScreenTriangle> triangles, int column, int row, raster::ItemId found);

/// The same for a single pixel: sets up all triangles of the face.
ErrorPixel errorAt(const raster::DrawList& list, const VectorFace& face, int column, int row, raster::ItemId found);

/// The first errors, face by face and row by row, at most `count` of them.
std::vector<ErrorPixel> firstErrors(const TestVector& vector, const Verdict& verdict, std::size_t count = 10);

}  // namespace hemitex::reference
