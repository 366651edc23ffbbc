/// What a verdict says to people and to machines: counts, the first errors with the elements they confuse, JSON, JUnit
/// XML for build servers, and a picture.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/image.h"
#include "reference/fragments.h"
#include "reference/verdict.h"

namespace hemitex::reference {

/// What a word stands for: the background, or a draw that may give it. With aligned words the draw is the surface and
/// the texel the element.
struct WordOrigin {
  enum class Kind { Background, Back, Offset, Texel, Unknown };
  Kind kind = Kind::Unknown;
  std::uint32_t draw = 0;  ///< the first that gives the word; of Back, Offset and Texel
  Texel texel;             ///< of Texel: where the draw's index map first holds the index
};

/// Where `word` comes from. A sum that some channel clamped cannot be taken apart: unknown.
WordOrigin originOf(const raster::DrawList& list, raster::Word word);
/// "background", "back of draw 3", "draw 3", "draw 3 texel 5,7", "no draw".
std::string toText(const WordOrigin& origin);

/// An error, with what the rules show there.
struct ErrorPixel {
  std::string face;
  int column, row;  ///< in the viewport
  raster::Word expected, found;
  WordOrigin expectedOrigin, foundOrigin;
  std::optional<Fragment> visible;  ///< none where the rules show the background
};

/// One line, without the face's name.
std::string toText(const ErrorPixel& error);

/// The first errors, face by face and row by row, at most `count` of them.
std::vector<ErrorPixel> firstErrors(const TestVector& vector, const Verdict& verdict, std::size_t count = 10);

/// A JSON object: `vector`, `pass`, `pixels` (a count for each verdict's name), `faces` (the same with `name`, `width`
/// and `height`), and `errors` with `face`, `column`, `row`, `expected`, `found`, `expected_from`, `found_from`,
/// `triangle` and `texel` (null where there is none).
std::string toJson(const Verdict& verdict, const std::vector<ErrorPixel>& errors);

/// JUnit XML: the vector is a test suite, each face a test case that fails where it has errors.
std::string toJUnit(const Verdict& verdict, const std::vector<ErrorPixel>& errors);

/// A row a face: what was expected, what was found (a colour for each word, black for `background`), and the verdict:
/// grey where exact, blue for coverage, green for a texel, yellow for depth, violet for loose clipping, red for errors.
radiosity::Image toPicture(const Verdict& verdict, raster::Word background);

}  // namespace hemitex::reference
