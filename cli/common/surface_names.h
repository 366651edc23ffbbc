/// Surfaces as the user names them: by the name of a surface or of its family, which means all its parts.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::cli {

/// The surfaces that a name means, ascending; at least one. Throws InputError, with the names that come nearest, where
/// there is none.
std::vector<std::uint32_t> surfacesNamed(const radiosity::Scene& scene, const std::string& name);

/// Where form factors start: whole surfaces, or one texel of a surface.
struct Source {
  std::vector<std::uint32_t> surfaces;
  std::optional<std::uint32_t> element = {};  ///< the element that the texel belongs to; none: the whole surfaces
};

/// `SURFACE` or `SURFACE:COL,ROW`. Throws InputError where there is no such surface or texel, where the texel has no
/// area on the surface, or where a texel of a surface of several parts is asked for.
Source sourceNamed(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                   const std::string& text);

/// The families of a scene, in the order of their first surfaces.
struct Families {
  std::vector<std::string> names;
  std::vector<std::vector<std::uint32_t>> surfaces;  ///< of each family, ascending
  std::vector<std::uint32_t> ofSurface;              ///< the family of each surface
};
Families familiesOf(const radiosity::Scene& scene);

}  // namespace hemitex::cli
