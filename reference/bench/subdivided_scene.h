/// A scene cut into more triangles: the same surfaces, charts and materials, so the same elements, and nothing to see
/// but more corners. What a renderer pays for triangles shows where all else stays.
#pragma once

#include <cstddef>

#include "radiosity/scene/scene.h"

namespace hemitex::reference {

/// The scene with its longest edges cut in the middle, one after the other, until it has `triangles` of them or a few
/// more: an edge is cut in all triangles that have it, so that none gets a corner of a neighbour on a side of its own.
/// Halves stand where the whole one stood, so that triangles that follow each other are neighbours. A chart's new
/// corners are rounded to multiples of 2^-24, as Triangle::chart asks for. A scene of more triangles stays as it is.
radiosity::Scene finerScene(const radiosity::Scene& scene, std::size_t triangles);

}  // namespace hemitex::reference
