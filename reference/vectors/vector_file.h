/// Test vectors, version 1 (raster rules): a draw list and its faces in a folder that any language can read, and the
/// item buffers that the rules demand for them. The author of a backend draws the list and compares item IDs.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"

namespace hemitex::reference {

/// A face of a vector: `ids` names the file that holds its item buffer, `hash` is idsHash of it, empty before
/// the vector was rendered.
struct VectorFace {
  std::string name;
  raster::Face face;
  std::string ids;
  std::string hash;
};

struct TestVector {
  std::string name;
  std::string catches = {};  ///< one line: the faults that show in it; may be empty
  glm::dvec3 origin{0.0};    ///< what was subtracted from the scene
  raster::DrawList list;
  std::vector<VectorFace> faces;
};

/// Reads `folder/vector.json` and the arrays it names. Throws InputError, naming the file, where anything is missing,
/// short, oversized, of the wrong type or against the rules.
TestVector readVector(const std::filesystem::path& folder);

/// Writes the vector into `folder`, which exists. With one item buffer a face, their item IDs files are written and the
/// hashes filled in; with none, hashes are left empty. Throws InputError where a file cannot be written.
void writeVector(const std::filesystem::path& folder, const TestVector& vector,
                 std::span<const raster::ItemBuffer> buffers);

/// FNV-1a, 64 bits, over the little-endian bytes of the item IDs: 16 hexadecimal digits.
std::string idsHash(std::span<const raster::ItemId> ids);

}  // namespace hemitex::reference
