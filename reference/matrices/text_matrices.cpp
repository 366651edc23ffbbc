#include "reference/matrices/text_matrices.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fstream>

#include "raster/base/input_error.h"
#include "raster/base/printable_text.h"
#include "reference/matrices/word_reader.h"

namespace hemitex::reference {
namespace {

constexpr const char* csvColumns = "from,to,form_factor";

/// Writes lines of numbers and words to a file.
class TextFile {
 public:
  explicit TextFile(const std::filesystem::path& file) : file_(file), stream_(file, std::ios::binary) { check(); }
  TextFile& operator<<(std::string_view text) {
    stream_ << text;
    return *this;
  }
  TextFile& operator<<(double number) { return writeNumber(number); }
  TextFile& operator<<(std::uint64_t number) { return writeNumber(number); }
  /// Where the next byte goes, and going back to such a place.
  std::streampos place() { return stream_.tellp(); }
  void goTo(std::streampos place) { stream_.seekp(place); }
  void check() const {
    if (!stream_) throw raster::InputError(file_.string(), 0, "cannot be written", "check the folder and the disk");
  }
  void close() {
    stream_.close();
    check();
  }

 private:
  TextFile& writeNumber(auto number) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
    stream_.write(text.data(), end - text.data());
    return *this;
  }

  std::filesystem::path file_;
  std::ofstream stream_;
};

class MatrixMarketSink : public RowSink {
 public:
  MatrixMarketSink(const std::filesystem::path& file, const MatrixHeading& heading) : file_(file) {
    const std::uint64_t facets = heading.facets();
    file_ << "%%MatrixMarket matrix coordinate real general\n"
          << "% Entry i j is the share of the light of facet i that meets facet j.\n"
          << "% Column " << facets + 1 << " (surroundings) is the share that meets nothing, column " << facets + 2
          << " (backs) that which meets backs of facets.\n";
    for (std::uint64_t f = 0; f < heading.names.size(); ++f)
      file_ << "% facet " << f + 1 << " " << raster::printable(heading.names[f]) << "\n";
    file_ << facets << " " << heading.columns() << " ";
    entriesAt_ = file_.place();
    file_ << std::string(digits, ' ') << "\n";
  }
  void write(const SparseRow& row) override {
    ++rows_;
    for (std::size_t i = 0; i < row.value.size(); ++i)
      file_ << rows_ << " " << std::uint64_t{row.column[i]} + 1 << " " << row.value[i] << "\n";
    entries_ += row.value.size();
    file_.check();
  }
  void finish() override {
    file_.goTo(entriesAt_);
    file_ << entries_;
    file_.close();
  }

 private:
  static constexpr std::size_t digits = 20;  ///< of the largest number of entries

  TextFile file_;
  std::streampos entriesAt_;
  std::uint64_t rows_ = 0, entries_ = 0;
};

class CsvSink : public RowSink {
 public:
  CsvSink(const std::filesystem::path& file, const MatrixHeading& heading) : file_(file), facets_(heading.facets()) {
    file_ << csvColumns << "\n";
  }
  void write(const SparseRow& row) override {
    for (std::size_t i = 0; i < row.value.size(); ++i) {
      file_ << rows_ << ",";
      if (row.column[i] < facets_) file_ << std::uint64_t{row.column[i]};
      if (row.column[i] == facets_) file_ << "surroundings";
      if (row.column[i] == facets_ + 1) file_ << "backs";
      file_ << "," << row.value[i] << "\n";
    }
    ++rows_;
    file_.check();
  }
  void finish() override { file_.close(); }

 private:
  TextFile file_;
  std::uint64_t facets_, rows_ = 0;
};

/// The square matrix of entries. `extra` columns stand behind those of the facets.
MatrixFile squareMatrix(std::vector<MatrixEntry> entries, std::uint64_t facets, std::uint64_t extra,
                        const std::filesystem::path& file) {
  if (entries.empty()) throw raster::InputError(file.string(), 0, "has no entry", "give a file with a matrix");
  return {matrixOf(std::move(entries), facets, facets + extra, file.string())};
}

/// A sparse file without its size has at least one entry per row of a form-factor matrix: a number far above the number
/// of entries is a fault, which would ask for much memory.
void checkSize(WordReader& reader, std::uint64_t facets, std::size_t entries) {
  constexpr std::uint64_t slack = 1 << 20;
  if (facets > entries + slack)
    reader.fail("there are " + std::to_string(entries) + " entries for " + std::to_string(facets) + " facets",
                "give a file with an entry for each facet");
}

// Columns of CSV files until the number of facets is known.
constexpr std::uint32_t surroundings = maxColumns - 2, backs = maxColumns - 1;

/// The facet or share that a word of a CSV file names; nothing if it is none.
std::optional<std::uint32_t> receiverNamed(std::string_view word) {
  if (word == "surroundings") return surroundings;
  if (word == "backs") return backs;
  const auto number = wholeNumber(word);
  return number && *number < surroundings ? std::optional(static_cast<std::uint32_t>(*number)) : std::nullopt;
}

/// The lines behind `from,to,form_factor`.
MatrixFile readCsvTriples(WordReader& reader, const std::filesystem::path& file) {
  std::vector<MatrixEntry> entries;
  std::uint64_t facets = 0;
  bool hasShares = false;
  while (reader.nextLine()) {
    const auto from = reader.word();
    if (!from) continue;
    const auto row = receiverNamed(*from);
    if (!row || *row >= surroundings)
      reader.fail("'" + raster::excerpt(*from) + "' is not the number of a facet", "number facets from 0");
    const std::string_view to = reader.word("the facet that receives");
    const auto column = receiverNamed(to);
    if (!column)
      reader.fail("'" + raster::excerpt(to) + "' is not the number of a facet, `surroundings` or `backs`",
                  "number facets from 0");
    hasShares = hasShares || *column >= surroundings;
    facets = std::max(facets, std::uint64_t{*row} + 1);
    if (*column < surroundings) facets = std::max(facets, std::uint64_t{*column} + 1);
    entries.push_back({*row, *column, reader.number("a form factor")});
    reader.endLine();
  }
  checkSize(reader, facets, entries.size());
  for (MatrixEntry& entry : entries)
    if (entry.column >= surroundings) entry.column = static_cast<std::uint32_t>(facets) + (entry.column - surroundings);
  return squareMatrix(std::move(entries), facets, hasShares ? 2 : 0, file);
}

/// Rows of a dense matrix, from the line that the reader is in.
MatrixFile readDenseRows(WordReader& reader, const std::filesystem::path& file) {
  SparseMatrix matrix;
  do {
    std::uint32_t columns = 0;
    for (auto word = reader.word(); word; word = reader.word(), ++columns) {
      const auto value = finiteNumber(*word);
      if (!value) reader.fail("'" + raster::excerpt(*word) + "' is not a finite number");
      if (*value == 0) continue;
      matrix.column.push_back(columns);
      matrix.value.push_back(*value);
    }
    if (columns == 0) continue;
    if (matrix.rows() > 0 && columns != matrix.columns)
      reader.fail(
          "has " + std::to_string(columns) + " numbers, and the lines before have " + std::to_string(matrix.columns),
          "give each row of the matrix one line");
    matrix.columns = columns;
    matrix.rowStart.push_back(matrix.value.size());
  } while (reader.nextLine());
  if (matrix.rows() == 0) throw raster::InputError(file.string(), 0, "has no entry", "give a file with a matrix");
  if (matrix.columns != matrix.rows() && matrix.columns != matrix.rows() + 2)
    throw raster::InputError(file.string(), 0,
                             "has " + std::to_string(matrix.rows()) + " lines of " + std::to_string(matrix.columns) +
                                 " numbers; a dense matrix has as many of each",
                             "for triples, begin the file with the line from,to,form_factor");
  return {std::move(matrix)};
}

}  // namespace

MatrixFile readMatrixMarket(const std::filesystem::path& file) {
  WordReader reader(file);
  if (!reader.nextLine() || reader.word() != "%%MatrixMarket")
    reader.fail("does not begin with %%MatrixMarket", "give a Matrix Market file");
  for (const auto& [what, wanted] :
       {std::pair("matrix", "matrix"), {"coordinate", "coordinate"}, {"real", "real"}, {"general", "general"}}) {
    std::string word(reader.word(what));
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool isNumber = word == "integer" || word == "double";
    if (word != wanted && !(isNumber && std::string_view(wanted) == "real"))
      reader.fail("`" + raster::excerpt(word) + "` is not read here: the file must be `" + wanted + "`",
                  "write the matrix as coordinate real general");
  }
  std::optional<std::string_view> first;
  while (!first || first->starts_with('%')) {
    if (!reader.nextLine()) reader.fail("ends before the size of the matrix", "give the whole file");
    first = reader.word();
  }
  const auto rows = wholeNumber(*first);
  if (!rows || *rows == 0 || *rows >= maxColumns)
    reader.fail("'" + raster::excerpt(*first) + "' is not a number of rows");
  const std::uint64_t columns = reader.index("a number of columns", maxColumns - 1);
  const std::uint64_t count = reader.index("a number of entries", *rows * columns);
  reader.endLine();
  std::vector<MatrixEntry> entries;
  while (reader.nextLine()) {
    const auto row = reader.word();
    if (!row) continue;
    const auto number = wholeNumber(*row);
    if (!number || *number == 0 || *number > *rows)
      reader.fail("'" + raster::excerpt(*row) + "' is not a row from 1 to " + std::to_string(*rows));
    const std::uint64_t column = reader.index("a column", columns);
    if (column == 0) reader.fail("columns count from 1");
    if (entries.size() == count) reader.fail("the file has more than " + std::to_string(count) + " entries");
    entries.push_back(
        {static_cast<std::uint32_t>(*number - 1), static_cast<std::uint32_t>(column - 1), reader.number("a value")});
    reader.endLine();
  }
  if (entries.size() < count)
    reader.fail("the file ends after " + std::to_string(entries.size()) + " of " + std::to_string(count) + " entries",
                "give the whole file");
  checkSize(reader, *rows, entries.size());
  return {matrixOf(std::move(entries), *rows, columns, file.string())};
}

MatrixFile readCsvMatrix(const std::filesystem::path& file) {
  WordReader heading(file);
  const bool isTriples = heading.nextLine() && heading.word() == "from" && heading.word() == "to" &&
                         heading.word() == "form_factor" && !heading.word();
  WordReader reader(file);
  if (!reader.nextLine()) reader.fail("is empty", "give a file with a matrix");
  return isTriples ? readCsvTriples(reader, file) : readDenseRows(reader, file);
}

MatrixFile readTriples(const std::filesystem::path& file) {
  WordReader reader(file);
  std::vector<MatrixEntry> entries;
  std::uint32_t smallest = 1, largest = 0;
  while (reader.nextLine()) {
    const auto first = reader.word();
    if (!first || first->starts_with('#') || first->starts_with('%')) continue;
    const auto row = wholeNumber(*first);
    if (!row || *row >= maxColumns - 1) reader.fail("'" + raster::excerpt(*first) + "' is not the number of a facet");
    const std::uint64_t column = reader.index("the number of a facet", maxColumns - 2);
    entries.push_back(
        {static_cast<std::uint32_t>(*row), static_cast<std::uint32_t>(column), reader.number("a form factor")});
    reader.endLine();
    smallest = std::min({smallest, entries.back().row, entries.back().column});
    largest = std::max({largest, entries.back().row, entries.back().column});
  }
  checkSize(reader, largest, entries.size());
  for (MatrixEntry& entry : entries) {
    entry.row -= smallest;
    entry.column -= smallest;
  }
  return squareMatrix(std::move(entries), largest - smallest + std::uint64_t{1}, 0, file);
}

std::unique_ptr<RowSink> matrixMarketSink(const std::filesystem::path& file, const MatrixHeading& heading) {
  return std::make_unique<MatrixMarketSink>(file, heading);
}

std::unique_ptr<RowSink> csvSink(const std::filesystem::path& file, const MatrixHeading& heading) {
  return std::make_unique<CsvSink>(file, heading);
}

}  // namespace hemitex::reference
