/// Contacts: what a scene means where its faces lie in one place (docs/light.md, "Faces in one place").
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "radiosity/geometry/contact_parts.h"
#include "radiosity/scene/ray_tree.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// What a scene means where its faces touch.
struct Contacts {
  std::vector<std::vector<ContactPart>> parts;  ///< of each triangle; none without contact
  /// Of each triangle: where others are cut, on its edges or near them.
  std::map<std::uint32_t, std::vector<glm::dvec3>> cuts;
  std::vector<std::string> warnings;  ///< of faces that look the other way
};

/// Finds contacts, also with the images of a scene. Numbers the closed shells of the scene.
Contacts findContacts(Scene& scene);

/// The scene after its contacts. Triangles are cut where only a part of them is in contact with others (see
/// contact_parts.h), and where the cuts of others meet their edges. Parts without a visible back become `isBacked`.
/// Parts that later faces cover are removed, with a warning, so that surfaces may be left without triangles. The backs
/// of two-sided surfaces cover none of the file's faces, and of backs the first covers the others.
Scene resolved(Scene scene, const Contacts& contacts);

/// Removes surfaces without triangles.
void removeEmptySurfaces(Scene& scene);

/// The triangles of a convex part of a triangle; its corners are barycentric weights of the corners 1 and 2. Without
/// those that have no area.
std::vector<Triangle> trianglesOf(const Triangle& whole, std::span<const glm::dvec2> corners);

/// Finds again which triangles are backed, without cutting any: after faces have moved.
void findBacked(Scene& scene);

/// Whether a point lies inside a solid: the smallest closed shell around it is one, and no room. A ray from inside a
/// shell leaves it once more than it enters it, which is its winding number. Two of three rays decide, because one may
/// pass through an edge. `rays` are those of the scene.
bool isInsideSolid(const Scene& scene, const RayTree& rays, const glm::dvec3& point);

}  // namespace hemitex::radiosity
