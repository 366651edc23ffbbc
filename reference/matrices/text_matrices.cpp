#include "reference/matrices/text_matrices.h"

#include <algorithm>
#include <array>
#include <fstream>

#include "radiosity/base/text_lines.h"
#include "radiosity/meshes/number_source.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/base/lower_case.h"
#include "raster/base/printable_text.h"
#include "raster/base/short_number.h"

namespace hemitex::reference {
namespace {

using radiosity::fail, radiosity::LineReader, radiosity::nextWord, radiosity::Place, radiosity::takeIndex;

constexpr const char* giveFile = "check the path, and that it is a file you may read";

/// Writes lines of text. Numbers become words before, because a stream may write them as the locale says.
class TextSink : public RowSink {
 public:
  void finish() override {
    stream_.close();
    check();
  }

 protected:
  explicit TextSink(const std::filesystem::path& file) : stream_(file, std::ios::binary), file_(file) { check(); }
  void check() const {
    if (!stream_) throw raster::InputError(file_.string(), 0, "cannot be written", "check the folder and the disk");
  }
  std::ofstream stream_;

 private:
  std::filesystem::path file_;
};

class MatrixMarketSink : public TextSink {
 public:
  MatrixMarketSink(const std::filesystem::path& file, const MatrixHeading& heading) : TextSink(file) {
    const std::uint64_t facets = heading.facets();
    stream_ << "%%MatrixMarket matrix coordinate real general\n"
               "% Entry i j is the share of the light of facet i that meets facet j.\n"
               "% Column " +
                   std::to_string(facets + 1) + " (surroundings) is the share that meets nothing, column " +
                   std::to_string(facets + 2) + " (backs) that which meets backs of facets.\n";
    for (std::size_t f = 0; f < heading.names.size(); ++f)
      stream_ << "% facet " + std::to_string(f + 1) + ' ' + raster::printable(heading.names[f]) + '\n';
    stream_ << std::to_string(facets) + ' ' + std::to_string(heading.columns()) + ' ';
    entriesAt_ = stream_.tellp();
    stream_ << std::string(digits, ' ') << '\n';
  }
  void finish() override {
    stream_.seekp(entriesAt_);
    stream_ << std::to_string(entries_);
    TextSink::finish();
  }

 private:
  static constexpr std::size_t digits = 20;  ///< of the largest number of entries

  void append(const SparseRow& row) override {
    const std::string start = std::to_string(++rows_) + ' ';
    for (std::size_t i = 0; i < row.value.size(); ++i)
      stream_ << start + std::to_string(std::uint64_t{row.column[i]} + 1) + ' ' + raster::toText(row.value[i]) + '\n';
    entries_ += row.value.size();
    check();
  }

  std::streampos entriesAt_;
  std::uint64_t rows_ = 0, entries_ = 0;
};

class CsvSink : public TextSink {
 public:
  CsvSink(const std::filesystem::path& file, const MatrixHeading& heading) : TextSink(file), facets_(heading.facets()) {
    stream_ << "from,to,form_factor\n";
  }

 private:
  void append(const SparseRow& row) override {
    const std::string start = std::to_string(rows_++) + ',';
    for (std::size_t i = 0; i < row.value.size(); ++i) {
      const std::uint32_t to = row.column[i];
      const std::string name = to < facets_ ? std::to_string(to) : to == facets_ ? "surroundings" : "backs";
      stream_ << start + name + ',' + raster::toText(row.value[i]) + '\n';
    }
    check();
  }

  std::uint64_t facets_, rows_ = 0;
};

/// The text of a file, in which commas and semicolons separate words as blanks do.
std::string wordsOf(const std::filesystem::path& file) {
  std::string text = raster::readFile(file, giveFile);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
  return text;
}

/// The number that ends a line.
double valueIn(std::string_view rest, const Place& place) {
  std::array<double, 1> value{};
  if (radiosity::readNumbers(rest, value, place) == 0) fail(place, "the line ends before its value");
  return value[0];
}

/// The entry of a line `row column value`.
MatrixEntry entryIn(std::string_view rest, std::uint64_t rows, std::uint64_t columns, const Place& place) {
  const auto row = static_cast<std::uint32_t>(takeIndex(rest, rows, place));
  const auto column = static_cast<std::uint32_t>(takeIndex(rest, columns, place));
  return {row, column, valueIn(rest, place)};
}

/// The square matrix of entries. `extra` columns stand behind those of the facets.
MatrixFile squareMatrix(std::vector<MatrixEntry> entries, std::uint64_t facets, std::uint64_t extra,
                        const std::filesystem::path& file) {
  if (entries.empty()) throw raster::InputError(file.string(), 0, "has no entry", "give a file with a matrix");
  return {matrixOf(std::move(entries), facets, facets + extra, file.string())};
}

/// A sparse file without its size has at least one entry per row of a form-factor matrix: a number far above the number
/// of entries is a fault, which would ask for much memory.
void checkSize(const Place& place, std::uint64_t facets, std::size_t entries) {
  constexpr std::uint64_t slack = 1 << 20;
  if (facets > entries + slack)
    fail(place, "there are " + std::to_string(entries) + " entries for " + std::to_string(facets) + " facets",
         "give a file with an entry for each facet");
}

// Columns of CSV files until the number of facets is known.
constexpr std::uint32_t surroundings = maxColumns - 2, backs = maxColumns - 1;

/// The facet or share that the next word of a CSV file names.
std::uint32_t takeReceiver(std::string_view& rest, const Place& place) {
  std::string_view behind = rest;
  const auto word = nextWord(behind);
  const bool isBacks = word == "backs";
  if (!isBacks && word != "surroundings") return static_cast<std::uint32_t>(takeIndex(rest, surroundings - 1, place));
  rest = behind;
  return isBacks ? backs : surroundings;
}

/// The lines behind `from,to,form_factor`.
MatrixFile readCsvTriples(LineReader& lines, const std::filesystem::path& file) {
  std::vector<MatrixEntry> entries;
  std::uint64_t facets = 0;
  bool hasShares = false;
  while (const auto line = lines.next()) {
    std::string_view rest = line->text;
    const auto row = static_cast<std::uint32_t>(takeIndex(rest, surroundings - 1, lines.place()));
    const std::uint32_t column = takeReceiver(rest, lines.place());
    hasShares = hasShares || column >= surroundings;
    facets = std::max({facets, std::uint64_t{row} + 1, column < surroundings ? std::uint64_t{column} + 1 : 0});
    entries.push_back({row, column, valueIn(rest, lines.place())});
  }
  checkSize(lines.place(), facets, entries.size());
  for (MatrixEntry& entry : entries)
    if (entry.column >= surroundings) entry.column = static_cast<std::uint32_t>(facets) + (entry.column - surroundings);
  return squareMatrix(std::move(entries), facets, hasShares ? 2 : 0, file);
}

/// Rows of a dense matrix.
MatrixFile readDenseRows(LineReader& lines, const std::filesystem::path& file) {
  SparseMatrix matrix;
  std::vector<double> values;
  while (const auto line = lines.next()) {
    values.resize(line->text.size() / 2 + 1);
    const std::size_t columns = radiosity::readNumbers(line->text, values, lines.place());
    if (matrix.rows() > 0 && columns != matrix.columns)
      fail(lines.place(),
           "has " + std::to_string(columns) + " numbers, and the lines before have " + std::to_string(matrix.columns),
           "give each row of the matrix one line");
    matrix.columns = columns;
    for (std::uint32_t c = 0; c < columns; ++c) {
      if (values[c] == 0) continue;
      matrix.column.push_back(c);
      matrix.value.push_back(values[c]);
    }
    matrix.rowStart.push_back(matrix.value.size());
  }
  if (matrix.rows() == 0) fail(lines.place(), "is empty", "give a file with a matrix");
  if (matrix.columns != matrix.rows() && matrix.columns != matrix.rows() + 2)
    throw raster::InputError(file.string(), 0,
                             "has " + std::to_string(matrix.rows()) + " lines of " + std::to_string(matrix.columns) +
                                 " numbers; a dense matrix has as many of each",
                             "for triples, begin the file with the line from,to,form_factor");
  return {std::move(matrix)};
}

}  // namespace

MatrixFile readMatrixMarket(const std::filesystem::path& file) {
  const std::string text = wordsOf(file);
  LineReader lines(text, file);
  auto line = lines.next();
  if (!line || line->keyword != "%%MatrixMarket")
    fail(lines.place(), "does not begin with %%MatrixMarket", "give a Matrix Market file");
  for (const std::string_view wanted : {"matrix", "coordinate", "real", "general"}) {
    const std::string word = raster::lowerCase(std::string(nextWord(line->rest).value_or("")));
    const bool isNumber = word == "integer" || word == "double";
    if (word != wanted && !(isNumber && wanted == "real"))
      fail(lines.place(),
           "`" + raster::excerpt(word) + "` is not read here: the file must be `" + std::string(wanted) + "`",
           "write the matrix as coordinate real general");
  }
  do line = lines.next();
  while (line && line->text.starts_with('%'));
  if (!line) fail(lines.place(), "ends before the size of the matrix", "give the whole file");
  std::string_view rest = line->text;
  const std::uint64_t rows = takeIndex(rest, maxColumns - 1, lines.place());
  const std::uint64_t columns = takeIndex(rest, maxColumns - 1, lines.place());
  const std::uint64_t count = takeIndex(rest, rows * columns, lines.place());
  if (nextWord(rest)) fail(lines.place(), "the size of a matrix has three numbers");
  std::vector<MatrixEntry> entries;
  while ((line = lines.next())) {
    entries.push_back(entryIn(line->text, rows, columns, lines.place()));
    if (entries.back().row-- == 0 || entries.back().column-- == 0) fail(lines.place(), "rows and columns count from 1");
    if (entries.size() > count) fail(lines.place(), "the file has more than " + std::to_string(count) + " entries");
  }
  if (entries.size() < count)
    fail(lines.place(),
         "the file ends after " + std::to_string(entries.size()) + " of " + std::to_string(count) + " entries",
         "give the whole file");
  checkSize(lines.place(), rows, entries.size());
  return {matrixOf(std::move(entries), rows, columns, file.string())};
}

MatrixFile readCsvMatrix(const std::filesystem::path& file) {
  const std::string text = wordsOf(file);
  LineReader lines(text, file), behind = lines;
  const auto heading = behind.next();
  std::string_view names = heading ? heading->text : "";
  const bool isTriples =
      nextWord(names) == "from" && nextWord(names) == "to" && nextWord(names) == "form_factor" && !nextWord(names);
  return isTriples ? readCsvTriples(behind, file) : readDenseRows(lines, file);
}

MatrixFile readTriples(const std::filesystem::path& file) {
  const std::string text = wordsOf(file);
  LineReader lines(text, file);
  std::vector<MatrixEntry> entries;
  std::uint32_t smallest = 1, largest = 0;
  while (const auto line = lines.next()) {
    if (line->text.starts_with('%')) continue;
    entries.push_back(entryIn(line->text, maxColumns - 2, maxColumns - 2, lines.place()));
    smallest = std::min({smallest, entries.back().row, entries.back().column});
    largest = std::max({largest, entries.back().row, entries.back().column});
  }
  checkSize(lines.place(), largest, entries.size());
  for (MatrixEntry& entry : entries) {
    entry.row -= smallest;
    entry.column -= smallest;
  }
  return squareMatrix(std::move(entries), largest - smallest + std::uint64_t{1}, 0, file);
}

MatrixFile readView3dMatrix(const std::filesystem::path& file) {
  constexpr std::size_t binaryHeader = 32;
  const std::string bytes = raster::readFile(file, giveFile);
  const Place first{file, 1};
  std::string_view line(bytes.data(), std::min(bytes.find('\n'), bytes.size()));
  const std::size_t textHeader = std::min(line.size() + 1, bytes.size());
  if (line.ends_with('\r')) line.remove_suffix(1);
  for (const char* what : {"the name of the program", "its version"})
    if (!nextWord(line)) fail(first, std::string("the line ends before ") + what);
  const bool isBinary = takeIndex(line, 1, first) == 1;
  for (int flag = 0; flag < 2; ++flag) takeIndex(line, 1, first);  // an enclosure; factors with emittances
  const std::uint64_t surfaces = takeIndex(line, maxColumns - 1, first);
  if (surfaces == 0) fail(first, "there is no surface", "give a file with a matrix");

  const std::size_t header = isBinary ? std::min(binaryHeader, bytes.size()) : textHeader;
  radiosity::NumberSource numbers(std::string_view(bytes).substr(header),
                                  isBinary ? radiosity::NumberEncoding::LittleEndian : radiosity::NumberEncoding::Text,
                                  {file, isBinary ? 0 : 2});
  const auto next = [&numbers] { return numbers.next(radiosity::NumberType::Float32); };
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
    fail(numbers.place(), "the file goes on behind the last emittance", "give the file as View3D wrote it");
  return result;
}

std::unique_ptr<RowSink> matrixMarketSink(const std::filesystem::path& file, const MatrixHeading& heading) {
  return std::make_unique<MatrixMarketSink>(file, heading);
}

std::unique_ptr<RowSink> csvSink(const std::filesystem::path& file, const MatrixHeading& heading) {
  return std::make_unique<CsvSink>(file, heading);
}

}  // namespace hemitex::reference
