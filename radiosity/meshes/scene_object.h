/// The objects of a scene file, which form a tree.
#pragma once

#include <optional>
#include <string>

namespace hemitex::radiosity {

/// An object of the file: a group of an OBJ file, or a node of a glTF file.
struct SceneObject {
  std::string name;                ///< of the file; those of objects with surfaces are unique
  std::optional<int> parent = {};  ///< in Scene::objects
};

}  // namespace hemitex::radiosity
