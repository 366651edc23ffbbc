/// Contacts: what a scene means where its faces lie in one place (docs/light.md, "Faces in one place").
#pragma once

#include "radiosity/scene/ray_tree.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// Numbers the closed shells, and warns of faces that look the other way. Cuts triangles where only a part of them is
/// in contact with others (see contact_parts.h). Parts without a visible back become `isBacked`. Parts that later faces
/// cover are removed, with a warning; a surface that is covered completely is removed, too. Images of a scene are not
/// in contact with it.
void resolveContacts(Scene& scene);

/// Finds again which triangles are backed, without cutting any: after faces have moved.
void findBacked(Scene& scene);

/// Whether a point lies inside a solid: the smallest closed shell around it is one, and no room. A ray from inside a
/// shell leaves it once more than it enters it, which is its winding number. Two of three rays decide, because one may
/// pass through an edge. `rays` are those of the scene.
bool isInsideSolid(const Scene& scene, const RayTree& rays, const glm::dvec3& point);

}  // namespace hemitex::radiosity
