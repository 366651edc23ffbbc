#include "data/generate/furniture.h"

#include <cmath>

#include "data/generate/seams.h"
#include "data/generate/shapes.h"

namespace hemitex::data {
namespace {

Polygon squareAt(double x, double z, double halfSide, double y) {
  return rectangle(x - halfSide, x + halfSide, z - halfSide, z + halfSide, y);
}

/// A flat box whose upper face the caller adds.
void addSlab(std::vector<Group>& groups, const std::string& name, const std::string& material, const Polygon& top,
             double bottom) {
  groups.push_back({name + "-edge", material, band(top, bottom)});
  groups.push_back({name + "-underside", material, {reversed(atHeight(top, bottom))}});
}

void addLegs(std::vector<Group>& groups, const std::string& material, double x, double z, double halfSide, double top) {
  int number = 0;
  for (const double side : {-1.0, 1.0})
    for (const double depth : {-1.0, 1.0})
      groups.push_back(
          {"leg-" + std::to_string(++number), material, band(squareAt(side * x, depth * z, halfSide, top), 0)});
}

/// A lamp: a foot (a surface of revolution), a bulb on it, and a shade around the bulb that is open above and below.
void addLamp(std::vector<Group>& groups, const glm::dvec3& foot) {
  groups.push_back({"lamp-foot", "brass", revolved({{0.1, 0}, {0.085, 0.03}, {0.016, 0.07}, {0.016, 0.36}}, 8, foot)});
  groups.push_back({"lamp-bulb", "light-bulb",
                    revolved({{0.016, 0.36}, {0.05, 0.39}, {0.058, 0.43}, {0.042, 0.47}, {0, 0.485}}, 8, foot)});
  groups.push_back({"lamp-shade", "shade",
                    revolved({{0.21, 0.34}, {0.12, 0.55}, {0.114, 0.55}, {0.204, 0.34}, {0.21, 0.34}}, 12, foot)});
}

}  // namespace

std::vector<Group> placed(std::vector<Group> groups, const std::string& prefix, const glm::dvec3& foot,
                          const glm::dvec2& turn) {
  for (Group& group : groups) {
    group.name = prefix + '-' + group.name;
    for (Polygon& polygon : group.polygons)
      for (glm::dvec3& corner : polygon.corners)
        corner = roundedPosition(
            foot + glm::dvec3(turn.x * corner.x + turn.y * corner.z, corner.y, turn.x * corner.z - turn.y * corner.x),
            1e4);
  }
  return groups;
}

std::vector<Group> chair(const std::string& material) {
  std::vector<Group> groups;
  const Polygon seat = squareAt(0, 0, 0.22, 0.46);
  groups.push_back({"seat", material, {seat}});
  addSlab(groups, "seat", material, seat, 0.43);
  addLegs(groups, material, 0.195, 0.195, 0.018, 0.43);
  // The back rest is bent. Seen from above, its outline runs along the front from left to right and returns along the
  // back.
  const Polygon left{{{-0.21, 0.9, -0.18}, {-0.07, 0.9, -0.2}, {-0.07, 0.9, -0.23}, {-0.21, 0.9, -0.21}}};
  const Polygon middle{{{-0.07, 0.9, -0.2}, {0.07, 0.9, -0.2}, {0.07, 0.9, -0.23}, {-0.07, 0.9, -0.23}}};
  const Polygon right{{{0.07, 0.9, -0.2}, {0.21, 0.9, -0.18}, {0.21, 0.9, -0.21}, {0.07, 0.9, -0.23}}};
  const Polygon outline{{left.corners[0], left.corners[1], right.corners[0], right.corners[1], right.corners[2],
                         right.corners[3], left.corners[2], left.corners[3]}};
  groups.push_back({"back", material, band(outline, 0.64)});
  groups.push_back({"back-top", material, {left, middle, right}});
  groups.push_back({"back-underside", material,
                    reversed(std::vector{atHeight(left, 0.64), atHeight(middle, 0.64), atHeight(right, 0.64)})});
  for (const double side : {-1.0, 1.0})
    groups.push_back(
        {side < 0 ? "post-left" : "post-right", material, band(squareAt(side * 0.17, -0.205, 0.009, 0.64), 0.46)});
  return groups;
}

std::vector<Group> tableWithLamp(double length, const std::string& material) {
  const double x = length / 2, z = 0.475, top = 0.75, lampSide = 0.2;
  std::vector<Group> groups;
  const Polygon board = rectangle(-x, x, -z, z, top);
  Group upper{"top", material, squareWithHole({0, top, 0}, lampSide, 0.1, 8)};
  for (const Rectangle& cell : cutOut({-x, x, -z, z}, {{-lampSide, lampSide, -lampSide, lampSide}}))
    upper.polygons.push_back(rectangle(cell.left, cell.right, cell.bottom, cell.top, top));
  groups.push_back(upper);
  addSlab(groups, "top", material, board, 0.71);
  addLamp(groups, {0, top, 0});
  closeSeams(groups, 1e4);
  addLegs(groups, material, x - 0.08, z - 0.08, 0.035, 0.71);
  return groups;
}

std::vector<Group> bench(const std::string& seat, const std::string& slabs) {
  std::vector<Group> groups;
  const Polygon board = rectangle(-0.8, 0.8, -0.22, 0.22, 0.45);
  groups.push_back({"seat", seat, {board}});
  addSlab(groups, "seat", seat, board, 0.38);
  for (const double side : {-1.0, 1.0})
    groups.push_back({side < 0 ? "slab-left" : "slab-right", slabs,
                      band(rectangle(side * 0.6 - 0.05, side * 0.6 + 0.05, -0.18, 0.18, 0.38), 0)});
  return groups;
}

std::vector<Group> vaseOnPedestal(double halfSide, double height, const std::vector<ProfilePoint>& vase,
                                  const std::string& pedestalMaterial, const std::string& vaseMaterial) {
  return {{"pedestal", pedestalMaterial, band(squareAt(0, 0, halfSide, height), 0)},
          {"pedestal-top", pedestalMaterial, squareWithHole({0, height, 0}, halfSide, vase[0].radius, 16)},
          {"vase", vaseMaterial, revolved(vase, 16, {0, height, 0})}};
}

namespace {

std::vector<ProfilePoint> scaled(std::vector<ProfilePoint> profile, double height) {
  for (ProfilePoint& point : profile) {
    point.radius *= height;
    point.height *= height;
  }
  return profile;
}

}  // namespace

std::vector<ProfilePoint> slenderVase(double height) {
  return scaled({{0.14, 0},
                 {0.12, 0.05},
                 {0.23, 0.33},
                 {0.23, 0.52},
                 {0.1, 0.76},
                 {0.085, 0.88},
                 {0.14, 1},
                 {0.12, 1},
                 {0.065, 0.87},
                 {0, 0.7}},
                height);
}

std::vector<ProfilePoint> roundVase(double height) {
  return scaled({{0.22, 0},
                 {0.38, 0.16},
                 {0.5, 0.42},
                 {0.48, 0.64},
                 {0.3, 0.86},
                 {0.19, 0.93},
                 {0.22, 1},
                 {0.18, 1},
                 {0.15, 0.92},
                 {0, 0.8}},
                height);
}

std::vector<ProfilePoint> bowl(double height) {
  return scaled(
      {{0.4, 0}, {0.28, 0.15}, {0.3, 0.32}, {0.75, 0.48}, {1.0, 0.74}, {1.1, 1}, {1.03, 1}, {0.9, 0.72}, {0, 0.44}},
      height);
}

namespace {

/// A book as a net: the spine in the middle, the top folded up above it, and the visible parts of the covers on both
/// sides.
Group bookGroup(const Wall& wall, const std::string& name, const Book& book, const glm::dvec2& corner,
                double leftHeight, double rightHeight, double front, double back) {
  const double depth = back - front, width = book.width, height = book.height;
  // Covers are visible beside shorter neighbours.
  const double leftSide = leftHeight < height ? depth : 0, rightSide = rightHeight < height ? depth : 0;
  const glm::dvec2 netSize{leftSide + width + rightSide, height + depth};
  Group group{name, book.material, {}};
  // A point of a face by its position in the net, in metres from the foot of the spine's left edge.
  const auto addFace = [&](const std::vector<glm::dvec3>& points, const std::vector<glm::dvec2>& net) {
    Polygon face;
    for (std::size_t i = 0; i < points.size(); ++i) {
      face.corners.push_back(points[i]);
      const glm::dvec2 coordinate = (net[i] + glm::dvec2(leftSide, 0)) / netSize * 1e4;
      face.texcoords.push_back(glm::dvec2(std::nearbyint(coordinate.x), std::nearbyint(coordinate.y)) / 1e4);
    }
    group.polygons.push_back(face);
  };
  const auto point = [&](double s, double y, double d) { return wall.at(s, corner.y + y, d); };
  const double l = corner.x, r = corner.x + width;
  addFace({point(l, 0, front), point(r, 0, front), point(r, height, front), point(l, height, front)},
          {{0, 0}, {width, 0}, {width, height}, {0, height}});
  addFace({point(l, height, front), point(r, height, front), point(r, height, back), point(l, height, back)},
          {{0, height}, {width, height}, {width, netSize.y}, {0, netSize.y}});
  if (leftSide > 0)
    addFace({point(l, leftHeight, back), point(l, leftHeight, front), point(l, height, front), point(l, height, back)},
            {{-depth, leftHeight}, {0, leftHeight}, {0, height}, {-depth, height}});
  if (rightSide > 0)
    addFace(
        {point(r, rightHeight, front), point(r, rightHeight, back), point(r, height, back), point(r, height, front)},
        {{width, rightHeight}, {width + depth, rightHeight}, {width + depth, height}, {width, height}});
  return group;
}

}  // namespace

std::vector<Group> books(const Wall& wall, const Rectangle& niche, double front, double back,
                         const std::vector<Book>& row) {
  std::vector<Group> groups;
  double s = niche.left;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double left = i > 0 ? row[i - 1].height : niche.top - niche.bottom;
    const double right = i + 1 < row.size() ? row[i + 1].height : 0;
    groups.push_back(
        bookGroup(wall, "book-" + std::to_string(i + 1), row[i], {s, niche.bottom}, left, right, front, back));
    s += row[i].width;
  }
  closeSeams(groups, 1e4);
  return groups;
}

std::vector<Group> painting(const Wall& wall, const Rectangle& hole, const std::string& frameMaterial,
                            const std::vector<ColourPatch>& canvas) {
  const auto inset = [&](double by) {
    return Rectangle{hole.left + by, hole.right - by, hole.bottom + by, hole.top - by};
  };
  Rows rows;
  const auto addRow = [&](double by, double depth) {
    std::vector<glm::dvec3>& row = rows.emplace_back();
    for (const glm::dvec2& point : outline(inset(by))) row.push_back(wall.at(point.x, point.y, depth));
    row.push_back(row.front());
  };
  addRow(0, 0);
  addRow(0.02, -0.05);
  addRow(0.07, -0.05);
  addRow(0.08, -0.02);
  std::vector<Group> groups{{"frame", frameMaterial, sheet(rows)}};
  const Rectangle inner = inset(0.08);
  const double width = inner.right - inner.left, height = inner.top - inner.bottom;
  for (const ColourPatch& patch : canvas) {
    const Rectangle place{inner.left + patch.place.left * width, inner.left + patch.place.right * width,
                          inner.bottom + patch.place.bottom * height, inner.bottom + patch.place.top * height};
    groups.push_back({"colour-" + std::to_string(groups.size()), patch.material, {panel(wall, place, -0.02)}});
  }
  closeSeams(groups, 1e4);
  return groups;
}

}  // namespace hemitex::data
