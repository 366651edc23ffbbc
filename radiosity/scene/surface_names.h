/// Finds surfaces by name, and groups them by family. A name is that of a surface, or of a family, which stands for all
/// its parts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// Whether a surface or a family has this name.
bool isSurfaceName(const Scene& scene, const std::string& name);
/// The surfaces with a name, ascending, without images; at least one. Throws InputError with similar names if there is
/// none.
std::vector<std::uint32_t> surfacesNamed(const Scene& scene, const std::string& name);

/// Throws InputError if the name is that of an object without any surface, because all of it is covered.
void refuseHidden(const Scene& scene, const std::string& name);

/// The families of a scene, in the order of their first surfaces. An image belongs to the family of its surface.
struct Families {
  std::vector<std::string> names;
  std::vector<std::vector<std::uint32_t>> surfaces;  ///< of each family, ascending; without images
  std::vector<std::uint32_t> ofSurface;              ///< the family of each surface
};
Families familiesOf(const Scene& scene);
/// The families of a scene whose surfaces are facets: one per face of the file, in its order. Faces that were dropped
/// have no surface; their names are their numbers.
Families facetsOf(const Scene& scene);

}  // namespace hemitex::radiosity
