#include "reference/matrices/view3d_matrix.h"

#include <algorithm>

#include "radiosity/meshes/number_source.h"
#include "raster/base/file_io.h"

namespace hemitex::reference {

using radiosity::NumberEncoding, radiosity::NumberType, radiosity::takeIndex;

MatrixFile readView3dMatrix(const std::filesystem::path& file) {
  constexpr std::size_t binaryHeader = 32;
  const std::string bytes = raster::readFile(file, "check the path, and that it is a file you may read");
  const radiosity::Place first{file, 1};
  std::string_view line(bytes.data(), std::min(bytes.find('\n'), bytes.size()));
  const std::size_t textHeader = std::min(line.size() + 1, bytes.size());
  if (line.ends_with('\r')) line.remove_suffix(1);
  for (const char* what : {"the name of the program", "its version"})
    if (!radiosity::nextWord(line)) radiosity::fail(first, std::string("the line ends before ") + what);
  const bool isBinary = takeIndex(line, 1, first) == 1;
  for (int flag = 0; flag < 2; ++flag) takeIndex(line, 1, first);  // an enclosure; factors with emittances
  const std::uint64_t surfaces = takeIndex(line, maxColumns - 1, first);
  if (surfaces == 0) radiosity::fail(first, "there is no surface", "give a file with a matrix");

  const std::size_t header = isBinary ? std::min(binaryHeader, bytes.size()) : textHeader;
  radiosity::NumberSource numbers(std::string_view(bytes).substr(header),
                                  isBinary ? NumberEncoding::LittleEndian : NumberEncoding::Text,
                                  {file, isBinary ? 0 : 2});
  const auto next = [&numbers] { return numbers.next(NumberType::Float32); };
  MatrixFile result{.matrix = {.columns = surfaces}};
  for (std::uint64_t i = 0; i < surfaces; ++i) result.area.push_back(next());
  for (std::uint64_t i = 0; i < surfaces; ++i) {
    for (std::uint32_t j = 0; j < surfaces; ++j) {
      const double value = next();
      if (value == 0) continue;
      result.matrix.column.push_back(j);
      result.matrix.value.push_back(value);
    }
    result.matrix.rowStart.push_back(result.matrix.value.size());
  }
  for (std::uint64_t i = 0; i < surfaces; ++i) next();  // emittances
  if (numbers.rest().find_first_not_of(isBinary ? "" : " \t\r\n") != std::string_view::npos)
    radiosity::fail(numbers.place(), "the file goes on behind the last emittance", "give the file as View3D wrote it");
  return result;
}

}  // namespace hemitex::reference
