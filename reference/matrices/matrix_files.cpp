#include "reference/matrices/matrix_files.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "raster/base/input_error.h"
#include "raster/base/lower_case.h"
#include "reference/matrices/npz_file.h"
#include "reference/matrices/text_matrices.h"

namespace hemitex::reference {
namespace {

/// A format, with functions to read it and to write it, if it is written.
struct Format {
  std::string_view ending;
  MatrixFile (*read)(const std::filesystem::path& file);
  std::unique_ptr<RowSink> (*sink)(const std::filesystem::path& file, const MatrixHeading& heading);
};

constexpr std::array formats{Format{".npz", readNpz, npzSink}, Format{".mtx", readMatrixMarket, matrixMarketSink},
                             Format{".csv", readCsvMatrix, csvSink}, Format{".vf", readView3dMatrix, nullptr},
                             Format{".txt", readTriples, nullptr}};

/// The format of a name; null if it is unknown.
const Format* formatOf(const std::filesystem::path& file) {
  const std::string ending = raster::endingOf(file);
  const auto found =
      std::find_if(formats.begin(), formats.end(), [&](const Format& format) { return format.ending == ending; });
  return found == formats.end() ? nullptr : &*found;
}

}  // namespace

MatrixFile readMatrix(const std::filesystem::path& file) {
  const Format* format = formatOf(file);
  if (format == nullptr)
    throw raster::InputError(file.string(), 0, "its name does not end as that of a matrix",
                             "matrices end in .npz, .mtx, .csv, .vf (View3D) or .txt (row, column, value)");
  MatrixFile result = format->read(file);
  const std::size_t rows = result.matrix.rows();
  if (rows == 0 || (result.matrix.columns != rows && result.matrix.columns != rows + 2))
    throw raster::InputError(
        file.string(), 0,
        "has " + std::to_string(rows) + " rows and " + std::to_string(result.matrix.columns) + " columns",
        "a matrix of form factors has as many columns as rows, or two more: surroundings and backs");
  return result;
}

bool isMatrixFile(const std::filesystem::path& file) {
  const Format* format = formatOf(file);
  return format != nullptr && format->sink != nullptr;
}

std::unique_ptr<RowSink> matrixSink(const std::filesystem::path& file, const MatrixHeading& heading) {
  if (!isMatrixFile(file))
    throw raster::InputError(file.string(), 0, "matrices are not written in this format",
                             "choose a name that ends in .npz, .mtx or .csv");
  if (heading.columns() >= maxColumns)
    throw raster::InputError(file.string(), 0, "the matrix has " + std::to_string(heading.columns()) + " columns",
                             "divide the mesh");
  return formatOf(file)->sink(file, heading);
}

}  // namespace hemitex::reference
