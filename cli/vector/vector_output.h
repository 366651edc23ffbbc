/// Options and output that several commands for test vectors share.
#pragma once

#include <filesystem>
#include <functional>

#include "cli/common/options.h"
#include "reference/conformance/vectors/vector_file.h"
#include "reference/devices/choice/renderers.h"

namespace hemitex::cli {

using reference::Device;

/// Prints the names, sizes and hashes of the faces.
void printFaces(const reference::TestVector& vector, const Context& context);

/// Writes vectors, one folder each, and prints their names and what they catch. `writer` is the command (see Output).
/// `withIds` also writes their item IDs and prints the hashes of these.
void writeVectors(const std::filesystem::path& folder, const std::string& writer, std::size_t count,
                  const std::function<reference::TestVector(std::size_t)>& vectorAt, bool withIds,
                  const Context& context);

/// The item buffers of a vector's faces on a device; the software draws them by the rules.
std::vector<raster::ItemBuffer> drawVector(const reference::TestVector& vector, Device device, const std::string& name);

/// Adds `--device` and `--device-name`.
void addDevice(Command command, Device& device, std::string& name);

/// Adds `--stages`.
void addStages(Command command, bool& stages);

}  // namespace hemitex::cli
