#include "data/generate/boxes.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "data/generate/shapes.h"

namespace hemitex::data {
namespace {

constexpr std::array<Side, 6> allSides{Side::Front, Side::Right, Side::Back, Side::Left, Side::Top, Side::Bottom};

const char* nameOf(Side side) {
  constexpr std::array<const char*, 6> names{"front", "right", "back", "left", "top", "bottom"};
  return names[static_cast<std::size_t>(side)];
}

bool contains(const std::vector<Side>& list, Side side) {
  return std::find(list.begin(), list.end(), side) != list.end();
}

}  // namespace

Polygon face(const Box& box, Side side) {
  const Polygon top = rectangle(box.low.x, box.high.x, box.low.z, box.high.z, box.high.y);
  if (side == Side::Top) return top;
  if (side == Side::Bottom) return reversed(atHeight(top, box.low.y));
  return sides(top, box.low.y)[static_cast<std::size_t>(side)];
}

std::vector<Polygon> faces(const Box& box, const std::vector<Side>& without) {
  std::vector<Polygon> result;
  for (const Side side : allSides)
    if (!contains(without, side)) result.push_back(face(box, side));
  return result;
}

std::vector<Polygon> charted(std::vector<Polygon> quads) {
  assert(quads.size() >= 4 && quads.size() <= 6);
  const double above = static_cast<double>(quads.size() - 4), middle = above > 0 ? 0.5 : 1;
  for (std::size_t i = 0; i < quads.size(); ++i) {
    assert(quads[i].corners.size() == 4);
    const bool isLower = i < 4;
    const double width = isLower ? 0.25 : 1 / above, left = width * static_cast<double>(isLower ? i : i - 4);
    const double bottom = isLower ? 0 : middle, top = isLower ? middle : 1;
    quads[i].texcoords = {{left, bottom}, {left + width, bottom}, {left + width, top}, {left, top}};
  }
  return quads;
}

Group boxGroup(const std::string& name, const std::string& material, const Box& box, const std::vector<Side>& without) {
  return {name, material, charted(faces(box, without))};
}

Group faceGroup(const std::string& name, const std::string& material, const Box& box, Side side) {
  return {name + '-' + nameOf(side), material, {face(box, side)}};
}

std::vector<Group> faceGroups(const std::string& name, const std::string& material, const Box& box,
                              const std::vector<Side>& without) {
  std::vector<Group> groups;
  for (const Side side : allSides)
    if (!contains(without, side)) groups.push_back(faceGroup(name, material, box, side));
  return groups;
}

}  // namespace hemitex::data
