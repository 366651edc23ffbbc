/// The item buffers of a device for a test vector: a folder with one item ID file per face.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::reference {

/// Reads one item buffer per face of the vector, in its order. Throws InputError if an item ID file is missing, cannot
/// be read, or does not hold exactly one item ID per pixel.
std::vector<raster::ItemBuffer> readCandidate(const std::filesystem::path& folder, const TestVector& vector);

/// Writes one item buffer per face of the vector, in its order, into `folder`, which exists. Throws InputError for a
/// file that cannot be written.
void writeCandidate(const std::filesystem::path& folder, const TestVector& vector,
                    std::span<const raster::ItemBuffer> buffers);

}  // namespace hemitex::reference
