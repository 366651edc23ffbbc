/// Edits of a scene: objects move, come and go, lights are switched, reflectances change. What an edit does not name
/// stays what it was to the last bit, for the origin and the extent stay too: so a solution can be updated where the
/// edit changed it (dynamic_solution.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"

namespace hemitex::radiosity {

// Surfaces are named by their names or by their families, which means all parts; a name that ends with `*` means all
// families that begin so. In two-sided scenes both sides move, come and go as one.
struct Move {
  std::string name;
  glm::dvec3 by;  ///< in the file's units
};
struct Remove {
  std::string name;
};
/// Puts back what was removed, where it was.
struct Restore {
  std::string name;
};
/// Adds the objects of an OBJ file. Names that are taken get `~2`, `~3`, ...
struct Add {
  std::filesystem::path file;
  SceneSettings settings = {};
  glm::dvec3 by{0.0};  ///< in the file's units
};
/// Gives surfaces an emission or a reflectance of their own; a material's map scales it as before.
struct SetEmission {
  std::string name;
  glm::dvec3 to;  ///< radiosity, W/m^2 per band, 0 to largestEmission (mtl_file.h)
};
struct SetReflectance {
  std::string name;
  glm::dvec3 to;  ///< per band, in [0, 1)
};
using Edit = std::variant<Move, Remove, Restore, Add, SetEmission, SetReflectance>;

/// How a surface came about.
struct Origin {
  std::optional<std::uint32_t> former = {};  ///< the surface of the former scene that it was; none: it was not there
  bool isMoved = false;
};

struct EditedScene {
  Scene scene;                   ///< kept surfaces in their order, then what was put back or added
  std::vector<Origin> origins;   ///< one a surface
  std::vector<Surface> removed;  ///< all that was removed and can be put back
};

/// The farthest from the origin that an edit puts a vertex, in extents: positions are binary32, and what keeps rounding
/// out of a picture (patch_view.h) is measured in extents.
inline constexpr double farthestEdit = 16;

/// Applies edits in their order. `removed` holds what former edits removed. Throws InputError where a name means no
/// surface (with names that come near) or nothing that was removed, where a number is out of range, nothing is left of
/// the scene, or an object goes farther than farthestEdit.
EditedScene edited(Scene scene, std::vector<Surface> removed, std::span<const Edit> edits);

}  // namespace hemitex::radiosity
