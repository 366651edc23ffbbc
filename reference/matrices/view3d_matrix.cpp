#include "reference/matrices/view3d_matrix.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/matrices/word_reader.h"

namespace hemitex::reference {
namespace {

static_assert(std::endian::native == std::endian::little, "binary files are read as they are in memory");

/// Reads numbers in the order of the file, which has lines for people only.
class TextNumbers {
 public:
  explicit TextNumbers(WordReader& reader) : reader_(reader) {}
  double next() {
    std::optional<std::string_view> word = reader_.word();
    for (; !word; word = reader_.word())
      if (!reader_.nextLine()) reader_.fail("the file ends too early", "give the whole file");
    const auto number = finiteNumber(*word);
    if (!number) reader_.fail("'" + raster::excerpt(*word) + "' is not a finite number");
    return *number;
  }
  void finish() {
    do reader_.endLine();
    while (reader_.nextLine());
  }

 private:
  WordReader& reader_;
};

class BinaryNumbers {
 public:
  explicit BinaryNumbers(const std::filesystem::path& file) : file_(file), stream_(raster::openFile(file)) {
    constexpr long headerBytes = 32;
    std::fseek(stream_.get(), headerBytes, SEEK_SET);
  }
  double next() {
    float value = 0;
    if (std::fread(&value, sizeof value, 1, stream_.get()) != 1) fail("ends too early");
    if (!std::isfinite(value)) fail("has a number that is not finite");
    return value;
  }
  void finish() {
    if (std::fgetc(stream_.get()) != EOF) fail("goes on behind the last emittance");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw raster::InputError(file_.string(), 0, what, "give the whole file, as View3D wrote it");
  }
  std::filesystem::path file_;
  raster::InputFile stream_;
};

MatrixFile readNumbers(auto& numbers, std::uint64_t surfaces) {
  MatrixFile result{.matrix = {.columns = surfaces}};
  for (std::uint64_t i = 0; i < surfaces; ++i) result.area.push_back(numbers.next());
  for (std::uint64_t i = 0; i < surfaces; ++i) {
    for (std::uint32_t j = 0; j < surfaces; ++j) {
      const double value = numbers.next();
      if (value == 0) continue;
      result.matrix.column.push_back(j);
      result.matrix.value.push_back(value);
    }
    result.matrix.rowStart.push_back(result.matrix.value.size());
  }
  for (std::uint64_t i = 0; i < surfaces; ++i) numbers.next();
  numbers.finish();
  return result;
}

}  // namespace

MatrixFile readView3dMatrix(const std::filesystem::path& file) {
  WordReader reader(file);
  if (!reader.nextLine()) reader.fail("is empty", "give a file that View3D wrote");
  reader.word("the name of the program");
  reader.word("its version");
  const std::uint64_t format = reader.index("the format, 0 or 1", 1);
  reader.index("whether the surfaces are an enclosure", 1);
  reader.index("whether emittances are in the factors", 1);
  const std::uint64_t surfaces = reader.index("the number of surfaces", maxColumns - 1);
  reader.endLine();
  if (surfaces == 0) reader.fail("there is no surface", "give a file with a matrix");
  if (format == 1) {
    BinaryNumbers numbers(file);
    return readNumbers(numbers, surfaces);
  }
  TextNumbers numbers(reader);
  return readNumbers(numbers, surfaces);
}

}  // namespace hemitex::reference
