/// Finds surfaces by name. A name is that of a surface, or of a family, which stands for all its parts.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::cli {

/// The surfaces with a name, ascending, without images; at least one. Throws InputError with similar names if there is none.
std::vector<std::uint32_t> surfacesNamed(const radiosity::Scene& scene, const std::string& name);

/// The source of form factors: whole surfaces, or one texel of a surface.
struct Source {
  std::vector<std::uint32_t> surfaces;
  std::optional<std::uint32_t> element = {};  ///< the element of the texel; without it, the whole surfaces
};

/// Reads `SURFACE` or `SURFACE:COL,ROW`. Throws InputError if there is no such surface, or no such texel with area.
/// Also throws it for a texel of a name with several parts.
Source sourceNamed(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                   const std::string& text);

/// The families of a scene, in the order of their first surfaces. An image belongs to the family of its surface.
struct Families {
  std::vector<std::string> names;
  std::vector<std::vector<std::uint32_t>> surfaces;  ///< of each family, ascending; without images
  std::vector<std::uint32_t> ofSurface;              ///< the family of each surface
};
Families familiesOf(const radiosity::Scene& scene);
/// The families of a scene whose surfaces are facets: one per face of the file, in its order. Faces that were dropped
/// have no surface; their names are their numbers.
Families facetsOf(const radiosity::Scene& scene);

}  // namespace hemitex::cli
