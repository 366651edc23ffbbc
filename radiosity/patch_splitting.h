/// Splitting patches that are near to what they light.
///
/// A hemicube sees from one point, and shoots for the whole patch as if all of it were there. That is right where the
/// patch is small for its distance. Between two parallel squares a side apart it is 20 % too much, at half a side 33 %
/// (the cases of Baum, Rushmeier and Winget 1989). So a patch is quartered while it is too near.
///
/// How near it is, its own row says. With A the areas, F_ij A_i / A_j is by reciprocity F_ji, the share of what patch j
/// sends out that reaches i, so
///
///     sum_j F_ij min(1, F_ij A_i / A_j)
///
/// is the share of its light that would come straight back to patch i from white surroundings. It says how large the
/// patch is to those that it lights, weighted by how much each of them gets; and so does the error of shooting from one
/// point. One low hemicube is enough to find it.
///
/// Each part shoots the light of its own elements. One cannot be cut, so a patch of one shoots from several points
/// at once.
#pragma once

#include "radiosity/discretization.h"
#include "radiosity/form_factors.h"
#include "radiosity/scene.h"
#include "radiosity/word_layout.h"
#include "raster/item_buffer_renderer.h"

namespace hemitex::radiosity {

/// As much of its light as comes straight back to a patch unless something else is asked for. On the scenes of data/ an
/// error of 1 % takes no more, and further splits buy little.
inline constexpr double defaultMostReturning = 0.0125;
/// No side is halved more often than this.
inline constexpr int mostHalvings = 4;

/// The discretization with every patch quartered until no more than `mostReturning` of its light comes straight back;
/// 1 or more splits none. Elements stay what they are. `layout` is that of the discretization; the renderer draws its
/// draw list.
Discretization splitPatches(const Scene& scene, Discretization discretization, const WordLayout& layout,
                            raster::ItemBufferRenderer& renderer, double mostReturning);

}  // namespace hemitex::radiosity
