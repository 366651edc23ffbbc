/// Matrices that View3D writes (`.vf`), as text and binary.
///
/// A line `View3D VERSION FORMAT ENCLOSURE EMITTANCES SURFACES`; then the areas, the rows of the dense matrix, and the
/// emittances. FORMAT is 0 for text, 1 for binary. The binary line has 32 bytes, and its numbers are binary32, little
/// endian. Source: View3D 3.3 (NIST), src/savevf.c.
#pragma once

#include <filesystem>

#include "reference/matrices/sparse_matrix.h"

namespace hemitex::reference {

/// Reads a matrix with areas. Throws InputError for other files, other formats, numbers that are not finite, and files
/// that end too early or too late.
MatrixFile readView3dMatrix(const std::filesystem::path& file);

}  // namespace hemitex::reference
