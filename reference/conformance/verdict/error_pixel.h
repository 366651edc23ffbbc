/// The error pixels of a verdict, each with the expected fragment and the origins of both item IDs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/conformance/vectors/enum_names.h"
#include "reference/conformance/verdict/id_origin.h"
#include "reference/conformance/verdict/verdict.h"

namespace hemitex::reference {

/// How the found item ID differs from the expected one.
enum class ErrorKind : std::uint8_t {
  Missing,       ///< the background in place of a triangle
  Extra,         ///< a triangle in place of the background
  WrongSurface,  ///< another draw
  WrongElement,  ///< the right draw, another texel
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
/// `triangles` are the screen triangles of that face (fragments.h).
ErrorPixel errorAt(const raster::DrawList& list, const std::string& face,
                   std::span<const raster::ScreenTriangle> triangles, int column, int row, raster::ItemId expected,
                   raster::ItemId found);

/// The same for a single pixel, with the expected item ID of the rules: sets up all triangles of the face.
ErrorPixel errorAt(const raster::DrawList& list, const VectorFace& face, int column, int row, raster::ItemId found);

/// The first errors, face by face and row by row, at most `count` of them.
std::vector<ErrorPixel> firstErrors(const TestVector& vector, const Verdict& verdict, std::size_t count = 10);

}  // namespace hemitex::reference
