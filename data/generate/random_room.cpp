#include "data/generate/random_room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>

#include "data/generate/boxes.h"
#include "data/generate/shapes.h"

namespace hemitex::data {
namespace {

/// Each coordinate as the nearest multiple of 1 / `steps`, so that adjacent parts meet exactly.
glm::dvec3 roundedPosition(const glm::dvec3& position, double steps) {
  return {std::nearbyint(position.x * steps) / steps, std::nearbyint(position.y * steps) / steps,
          std::nearbyint(position.z * steps) / steps};
}

constexpr std::size_t maxSurfaces = 40;
constexpr int maxAttempts = 200;

double toMillimetres(double length) { return std::nearbyint(length * 1e3) / 1e3; }

class Draws {
 public:
  explicit Draws(std::uint32_t seed) : random_(seed) {}

  /// In [0, 1).
  double fraction() { return static_cast<double>(random_()) * 0x1p-32; }
  /// In [low, high].
  double between(double low, double high) { return low + (high - low) * fraction(); }
  /// As between, in whole millimetres.
  double length(double low, double high) { return toMillimetres(between(low, high)); }
  /// In [0, count).
  int below(int count) { return static_cast<int>(fraction() * count); }
  bool coin() { return below(2) == 1; }

 private:
  std::mt19937 random_;
};

/// The cosine and the sine of an angle, from a rational point of the circle.
glm::dvec2 onCircle(double t) { return glm::dvec2(1 - t * t, 2 * t) / (1 + t * t); }

/// A rotation about y, and one about z that tilts towards -x or, for negative angles, +x.
glm::dmat3 aboutY(const glm::dvec2& turn) { return {{turn.x, 0, -turn.y}, {0, 1, 0}, {turn.y, 0, turn.x}}; }
glm::dmat3 aboutZ(const glm::dvec2& turn) { return {{turn.x, turn.y, 0}, {-turn.y, turn.x, 0}, {0, 0, 1}}; }

/// A box, rotated about the origin, then moved.
struct Solid {
  glm::dvec3 size{1.0};  ///< before rotation it reaches from -size/2 to size/2 in x and z, and from 0 to size.y
  glm::dmat3 rotation{1.0};
  glm::dvec3 foot{0.0};
  std::vector<Side> without = {};

  Box box() const { return {{-size.x / 2, 0, -size.z / 2}, {size.x / 2, size.y, size.z / 2}}; }
  glm::dvec3 placed(const glm::dvec3& point) const { return rotation * point + foot; }
};

/// Without rotation, coordinates are rounded to the micrometre, so that contacts are exact; rounding would bend rotated
/// faces.
Group placed(Group group, const Solid& solid) {
  const bool isTurned = solid.rotation != glm::dmat3(1);
  for (Polygon& polygon : group.polygons)
    for (glm::dvec3& corner : polygon.corners)
      corner = isTurned ? solid.placed(corner) : roundedPosition(solid.placed(corner), 1e6);
  return group;
}

Box boundsOf(const Solid& solid) {
  Box bounds{solid.foot, solid.foot};
  bool isFirst = true;
  for (const Polygon& polygon : faces(solid.box()))
    for (const glm::dvec3& corner : polygon.corners) {
      const glm::dvec3 point = solid.placed(corner);
      bounds = isFirst ? Box{point, point} : Box{glm::min(bounds.low, point), glm::max(bounds.high, point)};
      isFirst = false;
    }
  return bounds;
}

bool overlap(const Box& a, const Box& b) {
  for (int i = 0; i < 3; ++i)
    if (a.high[i] <= b.low[i] || b.high[i] <= a.low[i]) return false;
  return true;
}

Box grown(const Box& box, double by) { return {box.low - by, box.high + by}; }

/// Boxes that are drawn and placed together.
using Piece = std::vector<Solid>;

/// The room reaches from -half to half in x and z, and from 0 to `height`.
struct Room {
  glm::dvec2 half{2.0};
  double height = 2.6;
};

glm::dvec3 sizeOf(Draws& draw, double low, double high) {
  return {2 * draw.length(low / 2, high / 2), draw.length(low, high), 2 * draw.length(low / 2, high / 2)};
}

std::vector<Side> perhapsWithout(Draws& draw, Side side) {
  return draw.coin() ? std::vector{side} : std::vector<Side>{};
}

/// A random place in the room at a height, with the solid's middle at least `distance` from the walls.
glm::dvec3 placeIn(Draws& draw, const Room& room, double distance, double y) {
  const double x = draw.length(-room.half.x + distance, room.half.x - distance);
  const double z = draw.length(-room.half.y + distance, room.half.y - distance);
  return {x, y, z};
}

glm::dmat3 someTurn(Draws& draw) {
  return draw.coin() ? glm::dmat3(1) : aboutY(onCircle(std::nearbyint(draw.between(-40, 40)) / 40));
}

Solid standing(Draws& draw, const Room& room, double y) {
  Solid solid{sizeOf(draw, 0.15, 0.9)};
  solid.rotation = someTurn(draw);
  solid.foot = placeIn(draw, room, 0.3, y);
  return solid;
}

Piece onFloor(Draws& draw, const Room& room) {
  Solid solid = standing(draw, room, 0);
  solid.without = perhapsWithout(draw, Side::Bottom);
  return {solid};
}

/// Touching one wall or, in a corner, two.
Piece alongWall(Draws& draw, const Room& room) {
  Solid solid{sizeOf(draw, 0.2, 1.1)};
  solid.foot = placeIn(draw, room, 0.6, 0);
  solid.foot.x = (draw.coin() ? 1 : -1) * (room.half.x - solid.size.x / 2);
  if (draw.coin()) solid.foot.z = -room.half.y + solid.size.z / 2;
  solid.without = perhapsWithout(draw, Side::Bottom);
  return {solid};
}

/// The upper box stands on the lower one, completely or partly.
Piece stack(Draws& draw, const Room& room) {
  Solid lower = standing(draw, room, 0);
  lower.without = perhapsWithout(draw, Side::Bottom);
  Solid upper{{0.8 * lower.size.x, draw.length(0.1, 0.5), 0.7 * lower.size.z}};
  const bool isWhole = draw.coin();
  const glm::dvec3 shift{(isWhole ? 0.1 : 0.35) * lower.size.x, lower.size.y, 0};
  upper.rotation = lower.rotation;
  upper.foot = lower.placed(shift);
  if (isWhole) upper.without = perhapsWithout(draw, Side::Bottom);
  return {lower, upper};
}

Piece fromCeiling(Draws& draw, const Room& room) {
  Solid solid{{draw.length(0.1, 0.5), draw.length(0.2, 0.7), draw.length(0.1, 0.5)}};
  solid.rotation = someTurn(draw);
  solid.foot = placeIn(draw, room, 0.4, room.height - solid.size.y);
  solid.without = perhapsWithout(draw, Side::Top);
  return {solid};
}

Piece onWall(Draws& draw, const Room& room) {
  Solid solid{{draw.length(0.2, 0.8), draw.length(0.2, 0.7), draw.length(0.02, 0.35)}};
  solid.foot = placeIn(draw, room, 0.6, draw.length(0.9, 1.5));
  solid.foot.z = -room.half.y + solid.size.z / 2;
  solid.without = perhapsWithout(draw, Side::Back);
  return {solid};
}

/// From 1 mm to 30 cm above the floor, with a higher density near it.
Piece hovering(Draws& draw, const Room& room) {
  const double share = draw.fraction();
  return {standing(draw, room, toMillimetres(0.001 + 0.299 * (share * share * share)))};
}

/// On one edge, which is sunk by up to 2 cm.
Piece tilted(Draws& draw, const Room& room) {
  Solid solid = standing(draw, room, 0);
  solid.rotation = solid.rotation * aboutZ(onCircle(draw.between(0.05, 0.35)));
  const double sunk = draw.coin() ? 0 : draw.length(0.001, 0.02);
  solid.foot.y -= boundsOf(solid).low.y + sunk;
  return {solid};
}

/// A board that leans against the right or the left wall, sunk into it and into the floor by up to 1 cm each.
Piece leaning(Draws& draw, const Room& room) {
  Solid solid{{draw.length(0.02, 0.1), draw.length(0.8, 1.6), draw.length(0.3, 1)}};
  const double side = draw.coin() ? 1 : -1;
  solid.rotation = aboutZ(onCircle(-side * draw.between(0.06, 0.2)));
  solid.foot = placeIn(draw, room, 0.6, 0);
  const Box bounds = boundsOf(solid);
  solid.foot.x += side > 0 ? room.half.x - bounds.high.x : -room.half.x - bounds.low.x;
  solid.foot.x += side * draw.length(0, 0.01);
  solid.foot.y -= bounds.low.y + draw.length(0, 0.01);
  return {solid};
}

/// A box that is sunk into the floor.
Piece sunk(Draws& draw, const Room& room) { return {standing(draw, room, -draw.length(0.005, 0.1))}; }

/// The second box passes through the first one from side to side, rotated.
Piece crossing(Draws& draw, const Room& room) {
  Solid first = standing(draw, room, 0);
  first.without = perhapsWithout(draw, Side::Bottom);
  Solid second{{1.5 * first.size.x, 0.5 * first.size.y, 0.4 * first.size.z}};
  second.rotation = first.rotation * aboutY(onCircle(draw.between(-0.3, 0.3)));
  second.foot = first.foot + glm::dvec3(0, 0.3 * first.size.y, 0);
  return {first, second};
}

Piece drawPiece(Draws& draw, const Room& room) {
  constexpr std::array kinds{onFloor, alongWall, stack, fromCeiling, onWall, hovering, tilted, leaning, sunk, crossing};
  return kinds[static_cast<std::size_t>(draw.below(kinds.size()))](draw, room);
}

/// A light is a thin box below the ceiling or on the back wall with one emitting face, or a hovering box that emits on
/// all faces.
struct Light {
  Solid solid;
  std::optional<Side> emits;
};

Light drawLight(Draws& draw, const Room& room) {
  const int kind = draw.below(3);
  Solid solid{{draw.length(0.3, 1), 0.04, draw.length(0.3, 1)}};
  solid.foot = placeIn(draw, room, 0.6, room.height - solid.size.y);
  if (kind == 0) return {solid, Side::Bottom};
  if (kind == 1) {
    solid.size = {draw.length(0.3, 1), draw.length(0.2, 0.5), 0.03};
    solid.foot = {solid.foot.x, draw.length(1.6, 1.9), -room.half.y + 0.015};
    return {solid, Side::Front};
  }
  solid.size = glm::dvec3(draw.length(0.1, 0.25));
  solid.foot.y = draw.length(1.7, 2);
  return {solid, std::nullopt};
}

/// Whether a box is in the room, except for sunk parts, and away from others.
bool fits(const Box& box, const Room& room, const std::vector<Box>& taken) {
  constexpr double maxSunk = 0.101;
  const Box inside{{-room.half.x - maxSunk, -maxSunk, -room.half.y - 1e-9},
                   {room.half.x + maxSunk, room.height + 1e-9, room.half.y + 1e-9}};
  const bool isInside = box.low == glm::max(box.low, inside.low) && box.high == glm::min(box.high, inside.high);
  return isInside && std::none_of(taken.begin(), taken.end(), [&](const Box& other) { return overlap(box, other); });
}

/// Whether the box leaves the room by at most the intended depth; only boards that lean on a wall do.
bool isSunkInWall(const Box& box, const Room& room) {
  const double out = std::max(box.high.x, -box.low.x) - room.half.x;
  return out > 1e-9 && out < 0.011;
}

bool fits(const Piece& piece, const Room& room, const std::vector<Box>& taken) {
  return std::all_of(piece.begin(), piece.end(), [&](const Solid& solid) {
    const Box bounds = boundsOf(solid);
    const bool isBetweenWalls = std::max(bounds.high.x, -bounds.low.x) <= room.half.x + 1e-9;
    return fits(bounds, room, taken) && (isBetweenWalls || isSunkInWall(bounds, room));
  });
}

Material drawMaterial(Draws& draw, const std::string& name) {
  const auto share = [&] { return std::nearbyint(draw.between(0.05, 0.9) * 100) / 100; };
  const double r = share(), g = share(), b = share();
  return {name, {r, g, b}};
}

class RoomBuilder {
 public:
  explicit RoomBuilder(std::uint32_t seed) : draw_(seed) {
    room_.half.x = draw_.length(1.5, 3);
    room_.half.y = draw_.length(1.5, 3);
    room_.height = draw_.length(2.4, 3.2);
    model_.name = "room-" + std::string(seed < 10 ? "0" : "") + std::to_string(seed);
    model_.about = {"A closed room of boxes, drawn at random from seed " + std::to_string(seed) + '.',
                    "Lengths are in metres. Written by hemitex_data."};
    model_.aboutMaterials = {"Materials drawn at random from seed " + std::to_string(seed) + '.',
                             "Kd is diffuse reflectance, Ke emitted radiosity, both linear sRGB."};
    model_.view = {{0, 1.5, room_.half.y + 3.2}, {0, room_.height / 2 - 0.1, 0}, {0, 1, 0}, 45};
  }

  Model build() {
    addShell();
    const int lights = 1 + draw_.below(3), pieces = 4 + draw_.below(9);
    for (int i = 0; i < lights; ++i) addLight();
    for (int i = 0; i < pieces; ++i) addPiece(2 * static_cast<std::size_t>(pieces - i - 1));
    return model_;
  }

 private:
  std::string addMaterial(const std::string& name) {
    model_.materials.push_back(drawMaterial(draw_, name));
    return name;
  }

  void addShell() {
    const Polygon ceiling = rectangle(-room_.half.x, room_.half.x, -room_.half.y, room_.half.y, room_.height);
    const std::string first = addMaterial("wall-1"), second = addMaterial("wall-2");
    model_.groups = walls(ceiling, {first, second, first, second});
    model_.groups.push_back({"floor", addMaterial("floor"), {atHeight(ceiling, 0)}});
    model_.groups.push_back({"ceiling", addMaterial("ceiling"), {reversed(ceiling)}});
  }

  /// The space around a light stays free. If no place is found, there is one light less, but at least one.
  void addLight() {
    for (int attempt = 0; attempt < maxAttempts; ++attempt) {
      const Light light = drawLight(draw_, room_);
      if (!fits(Piece{light.solid}, room_, taken_)) continue;
      taken_.push_back(grown(boundsOf(light.solid), 0.15));
      const std::string name = "light-" + std::to_string(++lights_);
      Material material = drawMaterial(draw_, name);
      const double strength = std::nearbyint(draw_.between(5, 30));
      material.emission = {strength, std::nearbyint(0.9 * strength), std::nearbyint(0.75 * strength)};
      model_.materials.push_back(material);
      const Box box = light.solid.box();
      if (light.emits) {
        add(faceGroup(name, name, box, *light.emits), light.solid);
        add(boxGroup(name + "-case", "ceiling", box, {*light.emits}), light.solid);
      } else {
        add(boxGroup(name, name, box), light.solid);
      }
      return;
    }
  }

  /// `reserved` is the number of surfaces to leave for later pieces.
  void addPiece(std::size_t reserved) {
    for (int attempt = 0; attempt < maxAttempts; ++attempt) {
      const Piece piece = drawPiece(draw_, room_);
      if (!fits(piece, room_, taken_)) continue;
      for (std::size_t i = 0; i < piece.size(); ++i) addSolid(piece[i], reserved + piece.size() - i - 1);
      for (const Solid& solid : piece) taken_.push_back(boundsOf(solid));
      return;
    }
  }

  /// Every other box has one group per face, as long as there are enough surfaces left.
  void addSolid(const Solid& solid, std::size_t reserved) {
    const std::string name = "box-" + std::to_string(++boxes_), material = addMaterial(name);
    const bool isInFaces = boxes_ % 2 == 0 && model_.groups.size() + 6 + reserved <= maxSurfaces;
    if (!isInFaces) return add(boxGroup(name, material, solid.box(), solid.without), solid);
    for (const Group& group : faceGroups(name, material, solid.box(), solid.without)) add(group, solid);
  }

  void add(const Group& group, const Solid& solid) { model_.groups.push_back(placed(group, solid)); }

  Draws draw_;
  Room room_;
  Model model_;
  std::vector<Box> taken_;
  int lights_ = 0, boxes_ = 0;
};

}  // namespace

Model randomRoom(std::uint32_t seed) { return RoomBuilder(seed).build(); }

}  // namespace hemitex::data
