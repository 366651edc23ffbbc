#include "reference/conformance/vectors/candidate.h"

#include <fstream>

#include "raster/base/input_error.h"
#include "reference/conformance/vectors/array_file.h"

namespace hemitex::reference {
namespace {

namespace filesystem = std::filesystem;
using raster::InputError;

raster::ItemBuffer readIds(const filesystem::path& file, const raster::Scissor& scissor) {
  if (!filesystem::is_regular_file(file))
    throw InputError(file.string(), 0, "is missing or not a file", "a candidate holds one item ID file per face");
  const std::uintmax_t size = filesystem::file_size(file);
  raster::ItemBuffer buffer{scissor.width, scissor.height, {}};
  buffer.ids.resize(static_cast<std::size_t>(scissor.width) * static_cast<std::size_t>(scissor.height));
  const std::size_t bytes = buffer.ids.size() * sizeof(raster::ItemId);
  if (size != bytes)
    throw InputError(file.string(), 0, "holds " + std::to_string(size) + " bytes",
                     std::to_string(scissor.width) + " x " + std::to_string(scissor.height) + " item IDs are " +
                         std::to_string(bytes) + " bytes");
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(buffer.ids.data()), static_cast<std::streamsize>(bytes));
  if (!stream) throw InputError(file.string(), 0, "cannot be read to its end");
  return buffer;
}

}  // namespace

std::vector<raster::ItemBuffer> readCandidate(const filesystem::path& folder, const TestVector& vector) {
  std::vector<raster::ItemBuffer> buffers;
  for (const VectorFace& face : vector.faces) buffers.push_back(readIds(folder / face.ids, face.face.scissor));
  return buffers;
}

void writeCandidate(const filesystem::path& folder, const TestVector& vector,
                    std::span<const raster::ItemBuffer> buffers) {
  for (std::size_t f = 0; f < buffers.size(); ++f) writeArray(folder / vector.faces[f].ids, buffers[f].ids);
}

}  // namespace hemitex::reference
