/// Contacts: what a scene means where its faces lie in one place (docs/light.md, "Faces in one place").
#pragma once

#include "radiosity/scene/ray_tree.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// Numbers the closed solids, and warns of faces that look the other way. Cuts triangles where only a part of them is
/// in contact with others (see contact_parts.h). Parts without a visible back become `isBacked`. Parts that later faces
/// cover are removed, with a warning; a surface that is covered completely is removed, too. Images of a scene are not
/// in contact with it.
void resolveContacts(Scene& scene);

/// Finds again which triangles are backed, without cutting any: after faces have moved.
void findBacked(Scene& scene);

/// The closed solids of a scene.
class Solids {
 public:
  /// Keeps references to the scene and to its rays.
  Solids(const Scene& scene, const RayTree& rays);

  /// Whether a point lies inside a solid: the winding number of one is at least 1. A ray from inside a closed shell
  /// leaves it once more than it enters it; two of three rays decide, because one may pass through an edge.
  bool contain(const glm::dvec3& point) const;

 private:
  const Scene& scene_;
  const RayTree& rays_;
  bool hasSolid_;
};

}  // namespace hemitex::radiosity
