/// Test vectors, versions 1 and 2 (raster rules): a draw list, its faces and their item buffers by the rules, in a
/// folder that any language can read. The author of a backend draws the list and compares item IDs.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"

namespace hemitex::reference {

/// A face of a vector. `ids` names the file of its item buffer. `hash` is the idsHash of the buffer, empty before
/// rendering.
struct VectorFace {
  std::string name;
  raster::Face face;
  std::string ids;
  std::string hash;
};

struct TestVector {
  std::string name;
  std::string catches = {};  ///< one line: the faults that it detects; may be empty
  glm::dvec3 origin{0.0};    ///< subtracted from the positions of the scene
  raster::DrawList list;     ///< assembled (assembly.h)
  std::vector<VectorFace> faces;
  std::optional<raster::DrawList> source = {};  ///< the list before assembly, if it is another one
};

/// The list that a device gets, which the file of a vector holds.
inline const raster::DrawList& sourceOf(const TestVector& vector) {
  return vector.source ? *vector.source : vector.list;
}

/// A vector, with the list assembled. Without `names`, its only face is named "front", and several faces are numbered.
TestVector makeVector(std::string name, std::string catches, raster::DrawList list, std::vector<raster::Face> faces,
                      const std::vector<std::string>& names = {});

/// The views of all faces of a vector.
std::vector<raster::Face> facesOf(const TestVector& vector);

/// The column and row in the viewport of entry `index` of an item buffer.
glm::ivec2 pixelAt(const raster::Scissor& scissor, std::size_t index);

/// The item buffers of a vector's faces, by the reference renderer, or by the plain one where pixels do not show the
/// nearest triangle.
std::vector<raster::ItemBuffer> render(const TestVector& vector);

/// The vector folders of a suite, in the order of their names. Any other folder stands for itself.
std::vector<std::filesystem::path> vectorFolders(const std::filesystem::path& suite);

/// Reads `folder/vector.json` and its arrays. Throws InputError with the name of the file if anything is missing, of
/// the wrong size or type, or against the rules.
TestVector readVector(const std::filesystem::path& folder);

/// Writes the vector into `folder`, which exists. `buffers` holds one item buffer per face, or none. It writes the item
/// ID files and hashes of given buffers; without buffers, hashes are empty. Throws InputError for a file that cannot be
/// written. A vector that uses nothing of version 2 is written in version 1.
void writeVector(const std::filesystem::path& folder, const TestVector& vector,
                 std::span<const raster::ItemBuffer> buffers);

/// Reads the item buffers of a device for a vector: a folder with one item ID file per face, in its order. Throws
/// InputError if an item ID file is missing, cannot be read, or does not hold exactly one item ID per pixel.
std::vector<raster::ItemBuffer> readCandidate(const std::filesystem::path& folder, const TestVector& vector);

/// Writes one item buffer per face of the vector, in its order, into `folder`, which exists. Throws InputError for a
/// file that cannot be written.
void writeCandidate(const std::filesystem::path& folder, const TestVector& vector,
                    std::span<const raster::ItemBuffer> buffers);

/// 64-bit FNV-1a over the little-endian bytes of the item IDs, as 16 hexadecimal digits.
std::string idsHash(std::span<const raster::ItemId> ids);

/// The hash of a face's file.
std::string faceHash(const TestVector& vector, const raster::ItemBuffer& buffer);

/// The same over the item IDs of all faces, in their order.
std::string idsHash(std::span<const raster::ItemBuffer> buffers);

}  // namespace hemitex::reference
