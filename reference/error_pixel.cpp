#include "reference/error_pixel.h"

namespace hemitex::reference {

std::string toText(const ErrorPixel& error) {
  std::string text = "pixel " + std::to_string(error.column) + "," + std::to_string(error.row) + ": expected " +
                     std::to_string(error.expected) + " (" + toText(error.expectedOrigin) + "), found " +
                     std::to_string(error.found) + " (" + toText(error.foundOrigin) + ")";
  if (error.visible) text += "; triangle " + std::to_string(error.visible->triangle) + " is visible there";
  return text;
}

std::vector<ErrorPixel> firstErrors(const TestVector& vector, const Verdict& verdict, std::size_t count) {
  std::vector<ErrorPixel> errors;
  for (std::size_t f = 0; f < verdict.faces.size(); ++f) {
    const FaceVerdict& face = verdict.faces[f];
    const auto width = static_cast<std::size_t>(face.scissor.width);
    for (std::size_t pixel = 0; pixel < face.pixels.size() && errors.size() < count; ++pixel) {
      if (face.pixels[pixel] != PixelVerdict::Error) continue;
      const int column = face.scissor.column + static_cast<int>(pixel % width);
      const int row = face.scissor.row + static_cast<int>(pixel / width);
      const raster::Word expected = face.expected.words[pixel], found = face.found.words[pixel];
      ErrorPixel error{
          face.name, column, row, expected, found, originOf(vector.list, expected), originOf(vector.list, found), {}};
      const std::vector<Fragment> fragments = fragmentsAt(vector.list, vector.faces[f].face, column, row);
      if (!fragments.empty()) error.visible = fragments.front();
      errors.push_back(error);
    }
  }
  return errors;
}

}  // namespace hemitex::reference
