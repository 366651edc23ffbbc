/// Faults of views and pictures. Flipping the view is not flipping the picture: the scissor rectangle of a side face
/// keeps one half of the viewport, and a flipped view shows the other half of the scene in it.
#include <algorithm>
#include <utility>

#include "reference/fault_themes.h"

namespace hemitex::reference {
namespace {

using raster::Face;

/// `change` applied to the view of face `which`, or of every face where `which` is negative.
template <typename Change>
StagedDevice withViews(int which, const Change& change) {
  StagedDevice device;
  device.camera = [=](std::span<const Face> faces, std::size_t f) {
    Face face = faces[f];
    if (which < 0 || f == static_cast<std::size_t>(which)) change(face);
    return face;
  };
  return device;
}

/// A flip of the view turns windings over: a backend may or may not have told its front face so.
template <typename Change>
std::vector<Variant> flippedViews(const Change& change) {
  const StagedDevice device = withViews(-1, change);
  StagedDevice turnedOver = device;
  turnedOver.facing = otherSide;
  return {{"", device}, {"and with it the winding of front faces", turnedOver}};
}

/// Face f drawn through the view of order[f].
Variant reordered(const std::string& name, const std::vector<std::size_t>& order) {
  StagedDevice device;
  device.camera = [=](std::span<const Face> faces, std::size_t f) { return faces[order[f]]; };
  return {name, device};
}

/// Every exchange of two faces, and every rotation of all and of all but the first, which are the sides of a hemicube.
std::vector<Variant> reorderings(const std::vector<VectorFace>& faces) {
  std::vector<std::size_t> order(faces.size());
  for (std::size_t f = 0; f < order.size(); ++f) order[f] = f;
  std::vector<Variant> variants;
  for (std::size_t a = 0; a < order.size(); ++a)
    for (std::size_t b = a + 1; b < order.size(); ++b) {
      std::vector<std::size_t> exchanged = order;
      std::swap(exchanged[a], exchanged[b]);
      variants.push_back(reordered(faces[a].name + " and " + faces[b].name, exchanged));
    }
  for (const std::size_t fixed : {0u, 1u})
    for (std::size_t steps = 1; fixed + steps < order.size(); ++steps) {
      std::vector<std::size_t> rotated = order;
      std::rotate(rotated.begin() + static_cast<std::ptrdiff_t>(fixed),
                  rotated.begin() + static_cast<std::ptrdiff_t>(fixed + steps), rotated.end());
      variants.push_back(reordered((fixed == 0 ? "all" : "the sides") + (" by " + std::to_string(steps)), rotated));
    }
  return variants;
}

/// Views turned about their axes by quarters: one face, or all of several.
std::vector<Variant> turns(const std::vector<VectorFace>& faces) {
  std::vector<Variant> variants;
  for (int which = faces.size() > 1 ? -1 : 0; which < static_cast<int>(faces.size()); ++which)
    for (int quarters = 1; quarters < 4; ++quarters) {
      const std::string name = which < 0 ? "all" : faces[static_cast<std::size_t>(which)].name;
      variants.push_back({name + " by " + std::to_string(90 * quarters) + " degrees", withViews(which, [=](Face& face) {
                            for (int k = 0; k < quarters; ++k)
                              face = {face.eye, face.y, -face.x, face.w, face.nearDistance, 0, {}};
                          })});
    }
  return variants;
}

/// Rows or columns of the words file in reverse.
StagedDevice withPicture(bool reversedRows) {
  StagedDevice device;
  device.readBack = [=](const Face&, raster::ItemBuffer& buffer) {
    std::vector<raster::Word>& words = buffer.words;
    // Reversing all words turns both; reversing each row then gives back the columns.
    if (reversedRows) std::reverse(words.begin(), words.end());
    for (auto row = words.begin(); row != words.end(); row += buffer.width) std::reverse(row, row + buffer.width);
  };
  return device;
}

}  // namespace

std::vector<Fault> viewFaults(const TestVector& vector) {
  return {{"y of the view flipped",
           "row 0 is at y/w = -1, as in OpenGL and Vulkan and not in Direct3D: look at the sign of y in the projection",
           flippedViews([](Face& face) { face.y = -face.y; })},
          {"x of the view flipped", "column 0 is at x/w = -1: look at the handedness of the view's rows",
           flippedViews([](Face& face) { face.x = -face.x; })},
          {"picture upside down",
           "write row 0 of the framebuffer first: look at how rows are read back",
           {{"", withPicture(true)}}},
          {"picture mirrored",
           "write column 0 first in every row: look at how rows are read back",
           {{"", withPicture(false)}}},
          {"faces swapped", "draw each face with its own rows X, Y, W and write it into its own words file",
           reorderings(vector.faces)},
          {"faces turned", "take X as right and Y as the direction of rows for each face: no face shares them",
           turns(vector.faces)}};
}

}  // namespace hemitex::reference
