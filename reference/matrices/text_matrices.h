/// Matrices in text: Matrix Market, CSV, triples, and what View3D writes. Numbers are written with the fewest digits
/// that read back to the same bits.
#pragma once

#include <filesystem>
#include <memory>

#include "reference/matrices/sparse_matrix.h"

namespace hemitex::reference {

/// Matrix Market, coordinate real general: a line `%%MatrixMarket matrix coordinate real general`, comments, a line
/// with rows, columns and entries, then `row column value`, counted from 1. Source: Boisvert, Pozo, Remington, The
/// Matrix Market exchange formats: initial design, NISTIR 5935, 1996.
MatrixFile readMatrixMarket(const std::filesystem::path& file);
/// Comments of the file say what the columns mean, and name the facets.
std::unique_ptr<RowSink> matrixMarketSink(const std::filesystem::path& file, const MatrixHeading& heading);

/// CSV of two kinds. With the line `from,to,form_factor`, lines hold numbers of facets, counted from 0, and a value;
/// `to` may be `surroundings` or `backs`. Without it, each line is a row of the dense matrix.
MatrixFile readCsvMatrix(const std::filesystem::path& file);
std::unique_ptr<RowSink> csvSink(const std::filesystem::path& file, const MatrixHeading& heading);

/// Lines `row column value`, behind lines that start with `#` or `%`. They count from 0 if a number is 0, otherwise
/// from 1. The largest number is that of the last row and column.
MatrixFile readTriples(const std::filesystem::path& file);

/// A matrix with areas, as View3D writes it (`.vf`): a line `View3D VERSION FORMAT ENCLOSURE EMITTANCES SURFACES`; then
/// the areas, the rows of the dense matrix, and the emittances. FORMAT is 0 for text, 1 for binary. The binary line has
/// 32 bytes, and its numbers are binary32, little endian. Source: View3D 3.3 (NIST), src/savevf.c.
MatrixFile readView3dMatrix(const std::filesystem::path& file);

// All readers throw InputError with the line for malformed and infinite numbers, numbers out of range, places that are
// there twice, and files that end too early.

}  // namespace hemitex::reference
