/// Tells why nearly all light leaves a scene.
#pragma once

#include <optional>
#include <string>

#include "radiosity/scene/scene.h"
#include "radiosity/solver/shooting_state.h"

namespace hemitex::radiosity {

/// A warning if more than 99 % of the emitted flux was lost, not counting what backs absorbed. It names a surface that
/// is far from all others: depths and positions are rounded relative to the extent of the scene, so that such a surface
/// can make the others vanish.
std::optional<std::string> lossWarning(const Scene& scene, const Energy& energy);

}  // namespace hemitex::radiosity
