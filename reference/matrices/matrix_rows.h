/// The rows of a matrix as those of a solution on facets, each a surface of one element.
#pragma once

#include <filesystem>

#include "radiosity/solver/progressive_solver.h"

namespace hemitex::reference {

/// Reads a matrix file (see readMatrix). What a row does not give to facets or to backs leaves the scene. Throws
/// InputError if the file cannot be read. The function throws it if the matrix has another size than the mesh, a
/// negative entry, or a row that sums to more than 1.001.
radiosity::OtherRows matrixRows(const std::filesystem::path& file);

}  // namespace hemitex::reference
