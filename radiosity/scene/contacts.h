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

/// The closed solids and rooms of a scene.
class Solids {
 public:
  /// Keeps references to the scene and to its rays.
  Solids(const Scene& scene, const RayTree& rays) : scene_(scene), rays_(rays) {}

  /// Whether a point lies inside a solid: the smallest closed shell around it is one, and no room. A ray from inside a
  /// shell leaves it once more than it enters it, which is its winding number. Two of three rays decide, because one
  /// may pass through an edge.
  bool contain(const glm::dvec3& point) const;

 private:
  const Scene& scene_;
  const RayTree& rays_;
};

}  // namespace hemitex::radiosity
