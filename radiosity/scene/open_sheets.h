/// Finds open sheets that are lit from both sides: curtains, leaves, paper, lamp shades, a wall of one face between two
/// rooms. Only they need a surface on their back.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The numbers of the surfaces whose backs light from other surfaces reaches, ascending. Light from outside does not
/// count, so that outer walls and the ground keep one side.
///
/// Triangles that share edges form a component. A component without border, such as a solid or a room, is closed, and
/// none of its surfaces is a sheet. From the backs of other surfaces start walks that fronts reflect. A walk is lit if
/// it meets an emitter or eight fronts, before it meets a back or leaves the scene: inside a solid nearly everything is
/// a back, and half is where some of its faces are missing. A surface is a sheet if 8 % of its walks are lit;
/// the charts of a curved part are one sheet. Emitters are no sheets, because a back would double their flux.
std::vector<std::uint32_t> sheetsLitFromBothSides(const Scene& scene);

}  // namespace hemitex::radiosity
