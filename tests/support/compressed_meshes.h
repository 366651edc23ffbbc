/// glTF files with compressed meshes.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hemitex::tests {

/// Compresses all primitives of a description with one buffer by KHR_draco_mesh_compression: attributes of floats, and
/// indices of 16 bits. The bytes of the buffer grow. In sequence, values and the order of triangles stay as they are;
/// otherwise the method is edgebreaker, with values of 12 bits.
void compressByDraco(nlohmann::json& description, std::string& buffer, bool inSequence);

enum class MeshoptMode { Exact, Rotated, Exponents };

/// Compresses all buffer views that accessors fill, as above, by EXT_meshopt_compression. Buffer 1 is a fallback
/// without bytes. Rotated: triangles may begin with another corner. Exponents: floats have 15 bits and an exponent.
void compressByMeshopt(nlohmann::json& description, std::string& buffer, MeshoptMode mode);

}  // namespace hemitex::tests
