/// A file of facets with values (`.vtu`), which a command writes beside its result.
#pragma once

#include <filesystem>
#include <set>
#include <span>

#include "cli/common/staging.h"
#include "radiosity/meshes/polygon_mesh.h"

namespace hemitex::cli {

class FacetFile {
 public:
  /// Throws InputError if the name does not end in `.vtu`, the folder cannot be written, or the file would replace one
  /// of `inputs`.
  FacetFile(const std::filesystem::path& file, const std::set<std::filesystem::path>& inputs);

  /// Writes the faces of a mesh file in their order, with one value or vector each (see writeVtu).
  void write(const std::filesystem::path& mesh, std::span<const radiosity::FaceArray> arrays);

 private:
  std::filesystem::path name_;
  Staging staging_;
};

}  // namespace hemitex::cli
