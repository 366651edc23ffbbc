/// Edits of a scene: objects move, are removed, restored and added; emissions and reflectances change. All that an edit
/// does not name keeps its bits, because origin and extent stay the same. So a solution can be updated only where the
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

// A name is that of a surface, or of a family, which means all its parts. A name that ends with `*` means all families
// with that prefix. In two-sided scenes surfaces move, go and come with their other sides. Where no surface has the
// name, Move and SetEmission mean lamps that are points.
struct Move {
  std::string name;
  glm::dvec3 by;  ///< in units of the file
};
struct Remove {
  std::string name;
};
/// Restores a removed surface at its old place.
struct Restore {
  std::string name;
};
/// Adds the objects of a file, with its lamps and suns. Names that exist get `~2`, `~3`, ...
struct Add {
  std::filesystem::path file;
  SceneSettings settings = {};
  glm::dvec3 by{0.0};  ///< in units of the file
};
/// Sets the emission or the reflectance of surfaces; a map of the material scales it as before. The colour replaces a
/// spectrum. The name may also be
/// that of a group with several materials, or of a material (with `*`: of several), if no surface has it. In two-sided
/// scenes the back of a surface has a name of its own.
struct SetEmission {
  std::string name;
  glm::dvec3 to;                ///< 0 or more per band; of a lamp the intensity in W/sr
  double radiosityPerUnit = 1;  ///< by which `to` becomes a radiosity in W/m^2, at most largestEmission (mtl_file.h)
};
struct SetReflectance {
  std::string name;
  glm::dvec3 to;  ///< per band, in [0, 1)
};
using Edit = std::variant<Move, Remove, Restore, Add, SetEmission, SetReflectance>;

/// The former number of a surface.
struct Origin {
  std::optional<std::uint32_t> former = {};  ///< its number in the former scene; none: it is new
  bool isMoved = false;
};

struct EditedScene {
  Scene scene;                   ///< kept surfaces in their order, then restored or added ones
  std::vector<Origin> origins;   ///< one per surface
  std::vector<Surface> removed;  ///< all removed surfaces, which can be restored
};

/// The largest distance of an edited vertex from the origin, in extents. Positions are binary32, and the margins for
/// their rounding (patch_view.h) are measured in extents.
inline constexpr double farthestEdit = 16;

/// Applies edits in their order; `removed` holds the surfaces that former edits removed. Throws InputError if a name
/// matches no surface (with spelling suggestions) or no removed one. Also throws it if a number is out of range, the
/// scene becomes empty, or a vertex exceeds farthestEdit.
EditedScene edited(Scene scene, std::vector<Surface> removed, std::span<const Edit> edits);

/// `next`, which is `former` read again from a changed file, as an edit. Materials, images and texture coordinates may
/// differ, and surfaces may have moved, each as a whole. Nothing if the surfaces or their shapes differ by more than
/// the rounding of a file (see contactTolerance), if charts differ, or if a vertex exceeds farthestEdit.
std::optional<EditedScene> readAgain(const Scene& former, Scene next);

}  // namespace hemitex::radiosity
