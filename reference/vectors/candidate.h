/// The answer of a device to a test vector: a folder with the item IDs files, and nothing else is needed.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "reference/vectors/vector_file.h"

namespace hemitex::reference {

/// One item buffer a face of the vector, in its order. Throws InputError where a item IDs file is missing, cannot be
/// read, or does not hold exactly one item ID a pixel: a buffer of the wrong size never passes for a right one.
std::vector<raster::ItemBuffer> readCandidate(const std::filesystem::path& folder, const TestVector& vector);

/// Writes one item buffer a face of the vector, in its order, into `folder`, which exists. Throws InputError where a
/// file cannot be written.
void writeCandidate(const std::filesystem::path& folder, const TestVector& vector,
                    std::span<const raster::ItemBuffer> buffers);

}  // namespace hemitex::reference
