/// A file of the facets of a mesh with values (`.vtu`), which a command writes beside its result.
#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>

#include "cli/common/staging.h"
#include "radiosity/meshes/polygon_mesh.h"
#include "radiosity/scene/scene_settings.h"

namespace hemitex::cli {

class FacetFile {
 public:
  /// `writer` and `inputs`: see Output. Throws InputError if the name does not end in `.vtu` or the file cannot be
  /// written.
  FacetFile(const std::filesystem::path& file, const std::string& writer,
            const std::set<std::filesystem::path>& inputs);

  /// Writes the facets of a mesh file in their order, with one value or vector each (see writeVtu).
  void write(const std::filesystem::path& mesh, radiosity::Sides sides, std::span<const radiosity::FaceArray> arrays);

 private:
  Staging staging_;
};

}  // namespace hemitex::cli
