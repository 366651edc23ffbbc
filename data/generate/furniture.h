/// Furniture of the gallery: each piece consists of groups around its foot at the origin, with its front towards +z.
/// Pieces have no undersides, which would lie in the plane of the floor and are invisible.
#pragma once

#include <string>
#include <vector>

#include "data/generate/curves.h"
#include "data/generate/model.h"
#include "data/generate/walls.h"

namespace hemitex::data {

/// Moves groups to `foot` and rotates them counter-clockwise seen from above, by the angle with this cosine (x) and
/// sine (y). Adds `prefix` to their names.
std::vector<Group> placed(std::vector<Group> groups, const std::string& prefix, const glm::dvec3& foot,
                          const glm::dvec2& turn = {1, 0});

/// A chair of 0.44 m by 0.44 m with a bent back rest.
std::vector<Group> chair(const std::string& material);

/// A table of this length along x, 0.95 m deep and 0.75 m high, with a lamp in its middle.
std::vector<Group> tableWithLamp(double length, const std::string& material);

/// A bench of 1.6 m along x on two slabs.
std::vector<Group> bench(const std::string& seat, const std::string& slabs);

/// A square pedestal with a vase on it. The profile of the vase starts at its foot and counts from the pedestal's top.
std::vector<Group> vaseOnPedestal(double halfSide, double height, const std::vector<ProfilePoint>& vase,
                                  const std::string& pedestalMaterial, const std::string& vaseMaterial);

/// Profiles of vases of a given height: slender with a neck, round with a narrow mouth, and a wide bowl. They continue
/// inside.
std::vector<ProfilePoint> slenderVase(double height);
std::vector<ProfilePoint> roundVase(double height);
std::vector<ProfilePoint> bowl(double height);

/// Books side by side in a niche of a wall, from its left side on. Each touches the next and reaches to the back.
struct Book {
  double width = 0, height = 0;
  std::string material;
};
std::vector<Group> books(const Wall& wall, const Rectangle& niche, double front, double back,
                         const std::vector<Book>& row);

/// A framed painting of flat colours over a hole of the same size in the wall; the frame projects from the wall.
/// Patches have coordinates in [0, 1]^2 of the canvas.
struct ColourPatch {
  Rectangle place;
  std::string material;
};
std::vector<Group> painting(const Wall& wall, const Rectangle& hole, const std::string& frameMaterial,
                            const std::vector<ColourPatch>& canvas);

}  // namespace hemitex::data
