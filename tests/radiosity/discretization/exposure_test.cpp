// The parts of surfaces that solids bury, compared with known areas and with rays.
#include "radiosity/discretization/exposure.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "data/generate/random_room.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/discretization/texel_areas.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/parallel.h"
#include "reference/truth/solution/ground_truth.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/temporary_folder.h"
#include "tests/truth/baked_radiosity.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using Surfaces = std::vector<Surface>;

namespace {

constexpr double pi = 3.14159265358979323846;
const glm::dvec3 closedRoomSize(4, 3, 2);
constexpr double floorArea = 12;
/// Slices lie an eye's lift above a surface, so that solids whose sides are not perpendicular are cut slightly too
/// narrow or too wide.
constexpr double leaningTolerance = 1e-5;
/// Chart coordinates are multiples of 2^-24. So texel borders and triangle edges may miss each other by that much;
/// slivers between them stay uncut.
constexpr double chartTolerance = 1e-7;

Surfaces joined(std::initializer_list<Surfaces> some) {
  Surfaces all;
  for (const Surfaces& surfaces : some) all.insert(all.end(), surfaces.begin(), surfaces.end());
  return all;
}

Surfaces room() { return tests::box("room", {0, 0, 0}, closedRoomSize, true); }

/// Faces are numbered as by tests::box: bottom, top, left, right, front, back.
Surfaces boxOf(const std::string& name, const glm::dvec3& low, const glm::dvec3& size, bool hasBottom = true) {
  Surfaces faces = tests::box(name, low, size, false);
  if (!hasBottom) faces.erase(faces.begin());
  return faces;
}

Surfaces transformed(Surfaces surfaces, const glm::dmat3& matrix, const glm::dvec3& about) {
  for (Surface& surface : surfaces)
    for (Triangle& triangle : surface.triangles)
      for (glm::dvec3& corner : triangle.position) corner = matrix * (corner - about) + about;
  return surfaces;
}

/// Rotations about an axis in z and one in y, by angles with rational cosines and sines.
glm::dmat3 aboutZ(double cosine, double sine) { return {{cosine, sine, 0}, {-sine, cosine, 0}, {0, 0, 1}}; }
glm::dmat3 aboutY(double cosine, double sine) { return {{cosine, 0, -sine}, {0, 1, 0}, {sine, 0, cosine}}; }

Surfaces reversed(Surfaces surfaces) {
  for (Surface& surface : surfaces) {
    surface.name += "-reversed";
    for (Triangle& triangle : surface.triangles) {
      std::swap(triangle.position[1], triangle.position[2]);
      std::swap(triangle.chart[1], triangle.chart[2]);
      std::swap(triangle.texcoord[1], triangle.texcoord[2]);
    }
  }
  return surfaces;
}

/// The floor of the room as columns x rows quads of one chart, with diagonals in either direction.
Surface tessellatedFloor(int columns, int rows, bool isOtherWay = false) {
  Surface floor = tests::surfaceOf("room0", {});
  const auto corner = [&](int i, int j) {
    const glm::dvec2 chart(double(i) / columns, double(j) / rows);
    return tests::Corner{{chart.x * closedRoomSize.x, chart.y * closedRoomSize.y, 0}, chart};
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const std::array<tests::Corner, 4> c{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
      const std::size_t first = isOtherWay ? 1 : 0;
      floor.triangles.push_back(tests::triangleOf(c[first], c[first + 1], c[first + 2]));
      floor.triangles.push_back(tests::triangleOf(c[first], c[first + 2], c[(first + 3) % 4]));
    }
  return floor;
}

Surfaces roomOn(const Surface& floor) {
  Surfaces surfaces = room();
  surfaces[0] = floor;
  return surfaces;
}

std::uint32_t numberOf(const Scene& scene, const std::string& name) {
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
    if (scene.surfaces[s].name == name) return s;
  throw std::out_of_range(name);
}

double exposedArea(const Discretization& discretization, std::uint32_t surface) {
  const Grid& grid = discretization.grids[surface];
  long double sum = 0;
  for (std::uint32_t e = 0; e < grid.elementCount; ++e) sum += discretization.elements[grid.firstElement + e].area;
  return static_cast<double>(sum);
}

bool isCut(const Discretization& discretization) {
  return std::any_of(discretization.grids.begin(), discretization.grids.end(),
                     [](const Grid& grid) { return !grid.cutTexels.empty(); });
}

/// Exposed areas by surface name.
using Areas = std::map<std::string, double>;

/// Checks the areas of some surfaces; all others must be completely exposed. An area of 0 is not checked, because a
/// completely buried surface keeps its elements.
void checkAreas(const Surfaces& surfaces, const Areas& areas, double tolerance = 1e-9) {
  const Scene scene = tests::sceneOf(surfaces);
  for (const int texels : {1, 4, 5, 16}) {
    const Discretization discretization = discretize(scene, {.texels = texels});
    for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
      const Surface& surface = scene.surfaces[s];
      INFO(surface.name << ", " << texels << " texels");
      const auto known = areas.find(surface.name);
      if (known != areas.end() && known->second == 0) continue;
      CHECK(exposedArea(discretization, s) ==
            Approx(known == areas.end() ? tests::totalArea(surface) : known->second).epsilon(tolerance));
    }
    for (const Element& element : discretization.elements) CHECK(element.area > 0);
  }
}

void checkNothingIsBuried(const Surfaces& surfaces) {
  const Scene scene = tests::sceneOf(surfaces);
  for (const int texels : {1, 4, 5, 16}) {
    INFO(texels << " texels");
    CHECK_FALSE(isCut(discretize(scene, {.texels = texels})));
  }
}

bool isIn(const Piece& piece, const glm::dvec2& weights) {
  for (std::size_t i = 0; i < piece.size; ++i) {
    const glm::dvec2 a = piece.corners[i].weight, b = piece.corners[(i + 1) % piece.size].weight - a;
    if (b.x * (weights.y - a.y) - b.y * (weights.x - a.x) < -1e-9) return false;
  }
  return piece.size > 2;
}

glm::dvec2 weightsOf(const Triangle& triangle, const glm::dvec3& point) {
  const glm::dvec3 e1 = triangle.position[1] - triangle.position[0], e2 = triangle.position[2] - triangle.position[0];
  const glm::dvec3 n = glm::cross(e1, e2), d = point - triangle.position[0];
  return glm::dvec2(glm::dot(glm::cross(d, e2), n), glm::dot(glm::cross(e1, d), n)) / glm::dot(n, n);
}

/// Whether a point lies on an exposed piece of its triangle, inside a rectangle of the chart.
bool isOnExposedPiece(const Surface& surface, const Grid& grid, const SurfacePoint& point) {
  const glm::dvec2 weights = weightsOf(surface.triangles[point.triangle], point.position);
  bool isFound = false;
  forEachExposedPiece(surface, texelGrid(grid), [&](std::size_t, std::uint32_t t, const Piece& piece) {
    isFound = isFound || (t == point.triangle && isIn(piece, weights));
  });
  return isFound;
}

void checkCentres(const Scene& scene, const Discretization& discretization) {
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
    const std::uint32_t s = discretization.elements[e].surface;
    if (discretization.grids[s].cutTexels.empty()) continue;
    INFO(scene.surfaces[s].name << ", element " << e);
    CHECK(isOnExposedPiece(scene.surfaces[s], discretization.grids[s], elementCentre(scene, discretization, e)));
  }
  for (const Patch& patch : discretization.patches.list) {
    const Grid& grid = discretization.grids[patch.surface];
    if (grid.cutTexels.empty()) continue;
    INFO(scene.surfaces[patch.surface].name << ", patch at " << patch.column << ", " << patch.row);
    CHECK(isOnExposedPiece(scene.surfaces[patch.surface], grid, patchCentre(scene, discretization, patch)));
  }
}

void checkElementOfTexel(const Scene& scene, const Discretization& discretization) {
  std::vector<double> areas(discretization.elements.size());
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const Grid& grid = discretization.grids[s];
    const TexelAreas texels = texelAreas(scene.surfaces[s], texelGrid(grid));
    REQUIRE(grid.elementOfTexel.size() == texels.area.size());
    for (std::size_t texel = 0; texel < texels.area.size(); ++texel) {
      REQUIRE(grid.elementOfTexel[texel] >= grid.firstElement);
      REQUIRE(grid.elementOfTexel[texel] < grid.firstElement + grid.elementCount);
      areas[grid.elementOfTexel[texel]] += texels.area[texel];
    }
  }
  for (std::size_t e = 0; e < areas.size(); ++e) {
    CHECK(discretization.elements[e].area > 0);
    CHECK(discretization.elements[e].area == areas[e]);
  }
}

Scene loaded(const data::Model& model) {
  const TemporaryFolder folder;
  for (const data::File& file : data::files(model))
    std::ofstream(folder.path / file.name, std::ios::binary) << file.text;
  return loadScene(folder.path / (model.name + ".obj"));
}

bool areEqual(const Discretization& a, const Discretization& b) {
  const auto isSame = [](const Element& one, const Element& other) {
    return one.area == other.area && one.surface == other.surface && one.texel == other.texel;
  };
  if (!std::equal(a.elements.begin(), a.elements.end(), b.elements.begin(), b.elements.end(), isSame)) return false;
  for (std::size_t s = 0; s < a.grids.size(); ++s) {
    const std::vector<CutTexel>&one = a.grids[s].cutTexels, &other = b.grids[s].cutTexels;
    const auto isSameCut = [](const CutTexel& x, const CutTexel& y) {
      const auto isSamePiece = [](const TexelPiece& p, const TexelPiece& q) {
        if (p.triangle != q.triangle || p.piece.size != q.piece.size) return false;
        for (std::size_t i = 0; i < p.piece.size; ++i)
          if (p.piece.corners[i].weight != q.piece.corners[i].weight) return false;
        return true;
      };
      return x.texel == y.texel &&
             std::equal(x.exposed.begin(), x.exposed.end(), y.exposed.begin(), y.exposed.end(), isSamePiece);
    };
    if (a.grids[s].elementOfTexel != b.grids[s].elementOfTexel) return false;
    if (!std::equal(one.begin(), one.end(), other.begin(), other.end(), isSameCut)) return false;
  }
  return a.patches.ofElement == b.patches.ofElement && a.triangleOf == b.triangleOf;
}

/// Whether a surface extends beyond the walls, the floor or the ceiling.
bool reachesOut(const Scene& scene, std::uint32_t surface) {
  glm::dvec3 low(1e9), high(-1e9);
  for (const char* wall : {"wall-left", "wall-right", "floor", "ceiling"})
    for (const Triangle& triangle : scene.surfaces[numberOf(scene, wall)].triangles)
      for (const glm::dvec3& corner : triangle.position) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
      }
  for (const Triangle& triangle : scene.surfaces[surface].triangles)
    for (const glm::dvec3& corner : triangle.position)
      if (corner != glm::clamp(corner, low - 1e-6, high + 1e-6)) return true;
  return false;
}

/// A ball of quads and triangles about a point, each a surface; its equator is a regular polygon of 12 corners.
Surfaces ball(const std::string& name, const glm::dvec3& centre, double radius) {
  constexpr int steps = 12, rings = 6;
  const auto at = [&](int step, int ring) {
    const double turn = 2 * pi * (step % steps) / steps, height = pi * (static_cast<double>(ring) / rings - 0.5);
    // The equator lies exactly at the height of the centre.
    const double z = 2 * ring == rings ? 0 : std::sin(height);
    const double r = ring == 0 || ring == rings ? 0 : std::sqrt(1 - z * z);
    return centre + radius * glm::dvec3(r * std::cos(turn), r * std::sin(turn), z);
  };
  Surfaces surfaces;
  for (int ring = 0; ring < rings; ++ring)
    for (int step = 0; step < steps; ++step) {
      const std::string facet = name + std::to_string(ring) + "-" + std::to_string(step);
      Surface surface =
          tests::quad(facet, {at(step, ring), at(step + 1, ring), at(step + 1, ring + 1), at(step, ring + 1)});
      std::erase_if(surface.triangles, [](const Triangle& t) { return area(t) < 1e-12; });
      surfaces.push_back(surface);
    }
  return surfaces;
}

double regularPolygonArea(double radius) { return 12 * 0.5 * radius * radius * std::sin(2 * pi / 12); }

/// A room in which all surfaces emit E and reflect r, so that all fronts have the radiosity E / (1 - r).
Scene furnace(const Surfaces& surfaces) {
  Scene scene = tests::sceneOf(surfaces);
  scene.materials = {tests::material("grey", glm::dvec3(0.5), glm::dvec3(1))};
  return scene;
}

}  // namespace

TEST_CASE("discretize takes the footprint of a box out of the floor's area", "[exposure]") {
  const bool hasBottom = GENERATE(true, false);
  // At any place; along texel borders of a grid of four; with one side along a border and the other not; a narrow box.
  const auto [low, size] = GENERATE(std::pair(glm::dvec3(1.03, 0.71, 0), glm::dvec3(1.1, 0.7, 0.9)),
                                    std::pair(glm::dvec3(1, 0.75, 0), glm::dvec3(1, 1.5, 1)),
                                    std::pair(glm::dvec3(1, 0.8, 0), glm::dvec3(0.31, 0.7, 1)),
                                    std::pair(glm::dvec3(0.6, 0.5, 0), glm::dvec3(0.01, 2, 1)));
  CAPTURE(hasBottom, low.x, low.y);
  checkAreas(joined({room(), boxOf("box", low, size, hasBottom)}),
             {{"room0", floorArea - size.x * size.y}, {"box0", 0}});
}

TEST_CASE("discretize takes the footprint of a box out of a floor of several triangles", "[exposure]") {
  const bool isOtherWay = GENERATE(false, true), hasBottom = GENERATE(true, false);
  const auto [columns, rows] = GENERATE(std::pair(4, 3), std::pair(1, 12), std::pair(20, 1), std::pair(16, 12));
  // Along edges of the floor's triangles and of texels; along some of them; along none.
  const auto [low, size] = GENERATE(std::pair(glm::dvec3(1, 1, 0), glm::dvec3(1, 1, 0.5)),
                                    std::pair(glm::dvec3(1, 0.9, 0), glm::dvec3(1.5, 0.7, 0.5)),
                                    std::pair(glm::dvec3(0.93, 0.61, 0), glm::dvec3(1.83, 1.7, 0.5)));
  CAPTURE(isOtherWay, hasBottom, columns, rows, low.x, low.y);
  checkAreas(joined({roomOn(tessellatedFloor(columns, rows, isOtherWay)), boxOf("box", low, size, hasBottom)}),
             {{"room0", floorArea - size.x * size.y}, {"box0", 0}}, chartTolerance);
}

TEST_CASE("discretize buries what a box covers along the diagonals of a floor's cells", "[exposure]") {
  const bool hasBottom = GENERATE(true, false);
  // A square whose corners are those of cells of 1 m, rotated by 45 degrees.
  const std::array<glm::dvec2, 4> corner{{{2, 0.5}, {3, 1.5}, {2, 2.5}, {1, 1.5}}};
  const auto at = [&](std::size_t i, double z) { return glm::dvec3(corner[i % 4], z); };
  Surfaces block;
  for (std::size_t i = 0; i < 4; ++i)
    block.push_back(tests::quad("side" + std::to_string(i), {at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 1)}));
  block.push_back(tests::quad("top", {at(0, 1), at(1, 1), at(2, 1), at(3, 1)}));
  if (hasBottom) block.push_back(tests::quad("bottom", {at(3, 0), at(2, 0), at(1, 0), at(0, 0)}));
  for (const bool isOtherWay : {false, true})
    for (const int cells : {1, 2, 6}) {
      CAPTURE(isOtherWay, cells);
      checkAreas(joined({roomOn(tessellatedFloor(4 * cells, 3 * cells, isOtherWay)), block}),
                 {{"room0", floorArea - 2}, {"bottom", 0}}, chartTolerance);
    }
}

TEST_CASE("discretize buries what a rotated box covers", "[exposure]") {
  const bool hasBottom = GENERATE(true, false);
  const auto [cosine, sine] = GENERATE(std::pair(0.6, 0.8), std::pair(12.0 / 13, -5.0 / 13));
  const Surfaces rotated =
      transformed(boxOf("box", {1.5, 1, 0}, {1.1, 0.7, 0.9}, hasBottom), aboutZ(cosine, sine), {2, 1.4, 0});
  checkAreas(joined({room(), rotated}), {{"room0", floorArea - 1.1 * 0.7}, {"box0", 0}});
  checkAreas(joined({roomOn(tessellatedFloor(7, 5)), rotated}), {{"room0", floorArea - 1.1 * 0.7}, {"box0", 0}},
             chartTolerance);
}

TEST_CASE("discretize takes the union of two boxes that cross out of the floor's area", "[exposure]") {
  const bool hasBottom = GENERATE(true, false);
  // A cross: the higher one sticks out of the lower one above, both stick out at their ends.
  const Surfaces along = boxOf("along", {0.7, 1.2, 0}, {2.3, 0.5, 0.8}, hasBottom);
  const Surfaces across = boxOf("across", {1.6, 0.5, 0}, {0.4, 2.1, 1.3}, hasBottom);
  checkAreas(joined({room(), along, across}), {{"room0", floorArea - (2.3 * 0.5 + 0.4 * 2.1 - 0.4 * 0.5)},
                                               {"along0", 0},
                                               {"across0", 0},
                                               {"along1", (2.3 - 0.4) * 0.5},
                                               {"along4", (2.3 - 0.4) * 0.8},
                                               {"along5", (2.3 - 0.4) * 0.8},
                                               {"across2", 2.1 * 1.3 - 0.5 * 0.8},
                                               {"across3", 2.1 * 1.3 - 0.5 * 0.8}});
}

TEST_CASE("discretize buries the part of a box that is sunk into the floor", "[exposure]") {
  const double depth = GENERATE(1e-3, 0.02, 0.45, 0.85);
  CAPTURE(depth);
  const double height = 0.9 - depth;
  checkAreas(joined({room(), boxOf("box", {1.03, 0.71, -depth}, {1.1, 0.7, 0.9})}), {{"room0", floorArea - 1.1 * 0.7},
                                                                                     {"box0", 0},
                                                                                     {"box2", 0.7 * height},
                                                                                     {"box3", 0.7 * height},
                                                                                     {"box4", 1.1 * height},
                                                                                     {"box5", 1.1 * height}});
}

TEST_CASE("discretize buries nothing under a box that hovers", "[exposure]") {
  checkNothingIsBuried(
      joined({room(), boxOf("box", {1.03, 0.71, 1e-3 * glm::length(closedRoomSize)}, {1.1, 0.7, 0.9})}));
  checkNothingIsBuried(joined({roomOn(tessellatedFloor(8, 6)), boxOf("box", {1, 1, 0.005}, {1, 1, 0.1})}));
}

TEST_CASE("discretize buries what thin boxes cover: a rug, and a picture on a wall", "[exposure]") {
  const bool hasBottom = GENERATE(true, false);
  const double thickness = GENERATE(1e-3, 0.01);
  CAPTURE(hasBottom, thickness);
  checkAreas(joined({room(), boxOf("rug", {1.2, 0.4, 0}, {1.7, 1.3, thickness}, hasBottom)}),
             {{"room0", floorArea - 1.7 * 1.3}, {"rug0", 0}});
  // On the wall y = 0, whose inside is room4; without and with the face that lies on it.
  Surfaces picture = boxOf("picture", {1.3, 0, 0.7}, {0.8, thickness, 0.6});
  if (!hasBottom) picture.erase(picture.begin() + 4);
  checkAreas(joined({room(), picture}), {{"room4", 4 * 2 - 0.8 * 0.6}, {"picture4", 0}});
}

TEST_CASE("discretize buries the common area of stacked boxes", "[exposure]") {
  const bool hasBottom = GENERATE(true, false);
  checkAreas(joined({room(), boxOf("lower", {1, 0.7, 0}, {1.1, 0.9, 0.5}, hasBottom),
                     boxOf("middle", {1.2, 0.8, 0.5}, {0.7, 0.6, 0.3}, hasBottom),
                     boxOf("upper", {1.2, 0.9, 0.8}, {0.5, 0.5, 0.4}, hasBottom)}),
             {{"room0", floorArea - 1.1 * 0.9},
              {"lower0", 0},
              {"lower1", 1.1 * 0.9 - 0.7 * 0.6},
              {"middle0", 0},
              {"middle1", 0.7 * 0.6 - 0.5 * 0.5},
              {"upper0", 0}});
  // The upper box sticks out, so that a part of its underside is exposed.
  checkAreas(joined({room(), boxOf("lower", {1, 0.7, 0}, {1, 1, 0.5}, hasBottom),
                     boxOf("upper", {1.7, 0.9, 0.5}, {0.8, 0.5, 0.4})}),
             {{"room0", floorArea - 1}, {"lower0", 0}, {"lower1", 1 - 0.3 * 0.5}, {"upper0", 0.5 * 0.5}});
}

TEST_CASE("discretize buries the common faces of books side by side", "[exposure]") {
  const bool hasBottom = GENERATE(true, false);
  checkAreas(joined({room(), boxOf("a", {1, 1, 0}, {0.05, 0.2, 0.3}, hasBottom),
                     boxOf("b", {1.05, 1, 0}, {0.04, 0.2, 0.25}, hasBottom),
                     boxOf("c", {1.09, 1.02, 0}, {0.06, 0.16, 0.28}, hasBottom)}),
             {{"room0", floorArea - (0.09 * 0.2 + 0.06 * 0.16)},
              {"a0", 0},
              {"b0", 0},
              {"c0", 0},
              {"a3", 0.2 * (0.3 - 0.25)},
              {"b2", 0},
              {"b3", 0.2 * 0.25 - 0.16 * 0.25},
              {"c2", 0.16 * (0.28 - 0.25)}});
}

TEST_CASE("discretize buries where a box touches two walls, and where one touches the ceiling", "[exposure]") {
  checkAreas(joined({room(), boxOf("box", {0, 0, 0}, {0.8, 0.6, 1.1})}), {{"room0", floorArea - 0.8 * 0.6},
                                                                          {"room2", 3 * 2 - 0.6 * 1.1},
                                                                          {"room4", 4 * 2 - 0.8 * 1.1},
                                                                          {"box0", 0},
                                                                          {"box2", 0},
                                                                          {"box4", 0}});
  Surfaces open = boxOf("box", {0, 0, 0}, {0.8, 0.6, 1.1});
  open = {open[1], open[3], open[5]};
  checkAreas(joined({room(), open}),
             {{"room0", floorArea - 0.8 * 0.6}, {"room2", 3 * 2 - 0.6 * 1.1}, {"room4", 4 * 2 - 0.8 * 1.1}});
  checkAreas(joined({room(), boxOf("box", {1.3, 0.9, 1.8}, {0.8, 0.6, 0.2})}),
             {{"room1", floorArea - 0.8 * 0.6}, {"box1", 0}});
}

TEST_CASE("discretize buries what a leaning box cuts out of the floor, and its part below", "[exposure]") {
  // A box of 1 x 0.7 x 0.9, tilted about an edge in y that lies 0.2 below the floor.
  const glm::dvec3 foot(1.2, 0.9, -0.2);
  const double cosine = 0.8, sine = 0.6;
  const Surfaces leaning = transformed(boxOf("box", foot, {1, 0.7, 0.9}), aboutY(cosine, -sine), foot);
  // Cut by the floor at 0.2 / sine along the bottom, and at 0.2 / cosine along the left side.
  const double alongBottom = 0.2 / sine, alongSide = 0.2 / cosine;
  const double triangle = alongBottom * alongSide / 2;
  checkAreas(joined({room(), leaning}),
             {{"room0", floorArea - 0.7 * std::hypot(alongBottom, alongSide)},
              {"box0", 0.7 * (1 - alongBottom)},
              {"box2", 0.7 * (0.9 - alongSide)},
              {"box4", 0.9 - triangle},
              {"box5", 0.9 - triangle}},
             leaningTolerance);
}

TEST_CASE("discretize takes the polygon of intersection with a ball out of the floor's area", "[exposure]") {
  const bool isTessellated = GENERATE(false, true);
  const Surfaces around = isTessellated ? roomOn(tessellatedFloor(9, 7)) : room();
  const double radius = 0.6;
  // At its equator; and halfway between two rings, where facets are planes and the polygon has the mean radius.
  const double ring = std::sqrt(3.0) / 2;
  for (const auto& [height, polygonRadius] :
       {std::pair(0.0, radius), std::pair(-0.25 * radius, radius * (1 + ring) / 2)}) {
    CAPTURE(isTessellated, height);
    const Scene scene = tests::sceneOf(joined({around, ball("ball", {1.9, 1.4, height}, radius)}));
    for (const int texels : {1, 4, 5, 16}) {
      CAPTURE(texels);
      CHECK(exposedArea(discretize(scene, {.texels = texels}), numberOf(scene, "room0")) ==
            Approx(floorArea - regularPolygonArea(polygonRadius)).epsilon(leaningTolerance));
    }
  }
}

TEST_CASE("discretize buries nothing where surfaces without thickness lie on each other", "[exposure]") {
  const Surface rug = tests::parallelogram("rug", {1.2, 0.4, 0}, {1.7, 0, 0}, {0, 1.3, 0});
  checkNothingIsBuried(joined({room(), {rug}}));
  checkNothingIsBuried(joined({room(), reversed({rug})}));
  const Surface sheet = tests::parallelogram("sheet", {1.2, 0.4, 1}, {1.7, 0, 0}, {0, 1.3, 0});
  checkNothingIsBuried(joined({room(), {sheet}, reversed({sheet})}));
}

TEST_CASE("discretize buries nothing in two-sided scenes", "[exposure]") {
  Surfaces surfaces = joined({room(), boxOf("box", {1.03, 0.71, -0.1}, {1.1, 0.7, 0.9})});
  const std::size_t count = surfaces.size();
  surfaces = joined({surfaces, reversed(surfaces)});
  for (std::size_t s = 0; s < count; ++s) makeTwins(surfaces, s, s + count);
  checkNothingIsBuried(surfaces);
}

TEST_CASE("discretize buries nothing by sheets that are seen from one side", "[exposure]") {
  // The top of a table, without legs and underside.
  checkNothingIsBuried(joined({room(), {tests::parallelogram("table", {1, 1, 0.02}, {1.5, 0, 0}, {0, 1, 0})}}));
  // A partition that stands on the floor; one from wall to wall; and one from wall to wall close to a third.
  for (const bool isReversed : {false, true}) {
    const auto wall = [&](const glm::dvec3& corner, const glm::dvec3& along) {
      const Surfaces one{tests::parallelogram("wall", corner, along, {0, 0, 1.5})};
      return isReversed ? reversed(one) : one;
    };
    CAPTURE(isReversed);
    checkNothingIsBuried(joined({room(), wall({1, 1.1, 0}, {1.5, 0.3, 0})}));
    checkNothingIsBuried(joined({room(), wall({0, 1.1, 0}, {4, 0, 0})}));
    checkNothingIsBuried(joined({room(), wall({0, 0.1, 0}, {4, 0, 0})}));
  }
}

TEST_CASE("discretize keeps the light that comes from inside a solid, and no other", "[exposure]") {
  const Surfaces surfaces = joined({room(),
                                    boxOf("lamp", {1, 1, 1.8}, {0.6, 0.5, 0.4}),
                                    boxOf("box", {2.6, 0.9, 0}, {0.8, 0.6, 0.3}),
                                    {tests::parallelogram("panel", {3.95, 0.8, 0.6}, {0, 0, 0.5}, {0, 0.9, 0})},
                                    boxOf("on-panel", {3.75, 1.1, 0.8}, {0.2, 0.3, 0.2})});
  Scene scene = tests::sceneOf(surfaces);
  scene.materials = {tests::material("grey", glm::dvec3(0.5), glm::dvec3(0)),
                     tests::material("light", glm::dvec3(0), glm::dvec3(2))};
  for (Surface& surface : scene.surfaces)
    if (surface.name.rfind("lamp", 0) == 0 || surface.name == "panel") surface.material = 1;
  for (const int texels : {1, 4, 5, 16}) {
    CAPTURE(texels);
    const Discretization discretization = discretize(scene, {.texels = texels});
    const auto emitted = [&](const std::string& name) {
      const std::uint32_t s = numberOf(scene, name);
      const Grid& grid = discretization.grids[s];
      double flux = 0;
      for (const std::uint32_t e : elementsOf(grid))
        flux += emission(scene, discretization, e).r * discretization.elements[e].area;
      return flux;
    };
    // The lowest 0.2 m of the lamp are below the ceiling; the rest is inside it.
    CHECK(emitted("lamp0") == Approx(2 * 0.6 * 0.5).epsilon(1e-9));
    CHECK(emitted("lamp2") == Approx(2 * 0.5 * 0.2).epsilon(1e-9));
    CHECK(emitted("lamp5") == Approx(2 * 0.6 * 0.2).epsilon(1e-9));
    CHECK(emitted("panel") == Approx(2 * (0.9 * 0.5 - 0.3 * 0.2)).epsilon(1e-9));
    CHECK(exposedArea(discretization, numberOf(scene, "room1")) == Approx(floorArea - 0.3).epsilon(1e-9));
  }
}

TEST_CASE("discretize never buries a light in the open", "[exposure]") {
  // A light that sees the backs of others, the background, and the low wall that stands on it, but is not inside a
  // solid.
  Scene scene = tests::sceneOf({tests::parallelogram("light", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                tests::parallelogram("cover", {-1, -1, 0.1}, {3, 0, 0}, {0, 3, 0}),
                                tests::parallelogram("wall", {0.5, -1, 0}, {0, 1.5, 0}, {0, 0, 0.05}),
                                tests::parallelogram("other side", {0.5, -1, 0}, {0, 0, 0.05}, {0, 1.5, 0})});
  scene.materials = {tests::material("light", glm::dvec3(0), glm::dvec3(1))};
  for (const int texels : {1, 4, 5}) {
    const Discretization discretization = discretize(scene, {.texels = texels});
    CHECK(exposedArea(discretization, 0) == Approx(1).epsilon(1e-9));
  }
}

TEST_CASE("discretize buries only footprints in a room whose surfaces are all touched", "[exposure]") {
  const Surfaces surfaces =
      joined({room(), boxOf("a", {0.5, 0.4, 0}, {0.4, 0.4, 2}), boxOf("b", {0, 1.3, 0.7}, {4, 0.3, 0.3}),
              boxOf("c", {2.3, 0, 1.2}, {0.3, 3, 0.3})});
  checkAreas(surfaces, {{"room0", floorArea - 0.16},
                        {"room1", floorArea - 0.16},
                        {"room2", 6 - 0.09},
                        {"room3", 6 - 0.09},
                        {"room4", 8 - 0.09},
                        {"room5", 8 - 0.09},
                        {"a0", 0},
                        {"a1", 0},
                        {"b2", 0},
                        {"b3", 0},
                        {"c4", 0},
                        {"c5", 0}});
}

TEST_CASE("discretize buries footprints outdoors, where there are no walls", "[exposure]") {
  const bool hasBottom = GENERATE(true, false);
  Surfaces surfaces{tests::parallelogram("ground", {-10, -10, 0}, {20, 0, 0}, {0, 20, 0})};
  double footprints = 0;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const glm::dvec3 size(1.3 + 0.2 * i, 1.7 + 0.3 * j, 1 + i * j);
      surfaces = joined({surfaces, boxOf("tower" + std::to_string(4 * j + i) + "-", {-9 + 4.7 * i, -9 + 4.9 * j, 0},
                                         size, hasBottom)});
      footprints += size.x * size.y;
    }
  surfaces = joined({surfaces, boxOf("lamp", {0, 0, 15}, {1, 1, 0.2})});
  Areas areas{{"ground", 400 - footprints}};
  for (int i = 0; i < 16; ++i) areas["tower" + std::to_string(i) + "-0"] = 0;
  checkAreas(surfaces, areas);
}

TEST_CASE("discretize gives elements and patches centres that are exposed", "[exposure]") {
  // The box stands on the middle of the floor, and on the middle of many texels.
  const Scene scene = tests::sceneOf(joined({room(), boxOf("box", {1.4, 1, 0}, {1.2, 1, 0.9})}));
  for (const int texels : {1, 2, 3, 4, 7, 16}) {
    CAPTURE(texels);
    const Discretization discretization = discretize(scene, {.texels = texels});
    REQUIRE(isCut(discretization));
    checkCentres(scene, discretization);
    checkElementOfTexel(scene, discretization);
  }
  const Discretization coarse = discretize(scene, {.texels = 1});
  const glm::dvec3 centre = elementCentre(scene, coarse, 0).position;
  CHECK((std::abs(centre.x - 2) > 0.6 || std::abs(centre.y - 1.5) > 0.5));
}

TEST_CASE("patchCentre of a triangle that is one texel is its centroid", "[exposure]") {
  const std::array<glm::dvec2, 3> corner{glm::dvec2(0.25, 0.125), glm::dvec2(0.75, 0), glm::dvec2(0.375, 1)};
  const Scene scene = tests::sceneOf({tests::flat("triangle", {corner})});
  const Discretization discretization = discretize(scene, {.texels = 1});
  const glm::dvec2 centroid = (corner[0] + corner[1] + corner[2]) / 3.0;
  CHECK(glm::distance(patchCentre(scene, discretization, discretization.patches.list[0]).position,
                      glm::dvec3(centroid, 0)) < 1e-15);
}

// All fronts have the same radiosity, so that light into the dark inside of the box would be missing.
TEST_CASE("trueRadiosity of a furnace with a box on its floor is E over 1 minus r", "[exposure]") {
  const bool hasBottom = GENERATE(true, false);
  const Scene scene = furnace(joined({room(), boxOf("box", {1.03, 0.71, 0}, {1.1, 0.7, 0.9}, hasBottom)}));
  const Discretization discretization = discretize(scene, {.texels = 4});
  const reference::TrueRadiosity truth = reference::trueRadiosity(scene, discretization, {1 << 10});
  double flux = 0, area = 0;
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
    if (scene.surfaces[discretization.elements[e].surface].name == "box0") continue;
    flux += discretization.elements[e].area * truth.radiosity[e].r;
    area += discretization.elements[e].area;
  }
  CHECK(flux == Approx(2 * area).epsilon(1e-9));
}

TEST_CASE("trueRadiosity of a box on a floor is that of a floor cut by hand", "[exposure]") {
  // Along texel borders, and through the middle of texels; both scenes have elements of the same shapes.
  const double depth = GENERATE(0.75, 0.375);
  const Surfaces onFloor = boxOf("box", {1, 0.75, 0}, {1, depth, 0.9}, false);
  Surfaces around = room();
  Surfaces pieces;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const bool isUnder = i == 1 && j == 1;
      if (isUnder && depth == 0.75) continue;
      const double covered = isUnder ? depth : 0;
      pieces.push_back(tests::parallelogram("piece" + std::to_string(4 * j + i), {i, 0.75 * j + covered, 0}, {1, 0, 0},
                                            {0, 0.75 - covered, 0}));
    }
  Scene whole = tests::sceneOf(joined({around, onFloor}));
  around.erase(around.begin());
  Scene cut = tests::sceneOf(joined({pieces, around, onFloor}));
  for (Scene* scene : {&whole, &cut}) {
    scene->materials = {tests::material("grey", glm::dvec3(0.6), glm::dvec3(0)),
                        tests::material("light", glm::dvec3(0), glm::dvec3(1))};
    scene->surfaces[numberOf(*scene, "room1")].material = 1;
  }
  DiscretizationSettings inPieces{.texels = 4};
  for (const Surface& piece : pieces) inPieces.surfaceTexels[piece.name] = 1;
  const Discretization ofWhole = discretize(whole, {.texels = 4}), ofCut = discretizeUnburied(cut, inPieces);
  REQUIRE(ofWhole.elements.size() == ofCut.elements.size());
  const reference::Sampling sampling{1 << 13};
  const reference::TrueRadiosity one = reference::trueRadiosity(whole, ofWhole, sampling),
                                 other = reference::trueRadiosity(cut, ofCut, sampling);
  // The floor's elements come first in both.
  double wholeFlux = 0, cutFlux = 0, floor = 0, flux = 0;
  for (std::size_t e = 0; e < ofWhole.elements.size(); ++e) {
    CHECK(ofWhole.elements[e].area == Approx(ofCut.elements[e].area).epsilon(1e-12));
    flux += ofCut.elements[e].area * other.radiosity[e].g;
    if (e >= pieces.size()) continue;
    floor += ofCut.elements[e].area;
    wholeFlux += ofWhole.elements[e].area * one.radiosity[e].g;
    cutFlux += ofCut.elements[e].area * other.radiosity[e].g;
  }
  CHECK(floor == Approx(floorArea - depth).epsilon(1e-12));
  CHECK(std::abs(wholeFlux - cutFlux) < (one.error.fluxWeighted + other.error.fluxWeighted) * cutFlux);
  CHECK(cutFlux > 0.01 * flux);
}

TEST_CASE("discretize of random rooms exposes what bakedRadiosity finds exposed", "[exposure]") {
  constexpr int points = 256;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const Scene scene = loaded(data::randomRoom(seed));
    const DiscretizationSettings settings{.texels = 4};
    const Discretization unburied = discretizeUnburied(scene, settings), exposed = discretize(scene, settings);
    const tests::BakedRadiosity baked = tests::bakedRadiosity(scene, unburied, {.paths = 32, .points = points});
    double roomArea = 0;
    for (const Surface& surface : scene.surfaces) roomArea += tests::totalArea(surface);
    for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
      INFO("room " << seed << ", " << scene.surfaces[s].name);
      const tests::SurfaceFlux& of = baked.surfaces[s];
      // A completely buried surface keeps its elements, and so do faces outside the room, where it is dark.
      if (of.exposedArea == 0 || (scene.surfaces[s].triangles.size() > 2 && reachesOut(scene, s))) continue;
      // A narrow part may miss all points of a texel, so that each error counts at least as one point.
      double squares = 0;
      for (std::uint32_t e = 0; e < unburied.grids[s].elementCount; ++e) {
        const std::uint32_t element = unburied.grids[s].firstElement + e;
        const bool mayMiss = findCut(exposed.grids[s].cutTexels, unburied.elements[element].texel) != nullptr;
        const double least = mayMiss ? unburied.elements[element].area / points : 0;
        squares += std::pow(std::max(baked.exposedAreaError[element], least), 2);
      }
      CHECK(exposedArea(exposed, s) ==
            Approx(of.exposedArea).epsilon(0).margin(4 * std::sqrt(squares) + 1e-6 * roomArea));
    }
  }
}

TEST_CASE("discretize of random rooms gives exposed centres, and areas that include all texels", "[exposure]") {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    INFO("room " << seed);
    const Scene scene = loaded(data::randomRoom(seed));
    for (const DiscretizationSettings& settings :
         {DiscretizationSettings{.texels = 5}, DiscretizationSettings{.texelSize = 0.2}}) {
      const Discretization discretization = discretize(scene, settings);
      checkCentres(scene, discretization);
      checkElementOfTexel(scene, discretization);
    }
  }
}

TEST_CASE("discretize cuts texels the same for any number of threads", "[exposure]") {
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    const Scene scene = loaded(data::randomRoom(seed));
    const auto withThreads = [&](int threads) {
      const raster::ThreadLimit limit(threads);
      return discretize(scene, {.texels = 8});
    };
    const Discretization one = withThreads(1);
    CHECK(isCut(one));
    CHECK(areEqual(withThreads(3), one));
  }
}

TEST_CASE("cutTexels subtracts many solids that stand on one texel", "[exposure]") {
  // So many pieces that a tree finds those that a slice cuts.
  constexpr int side = 12;
  Surfaces surfaces = room();
  double buried = 0;
  for (int i = 0; i < side * side; ++i) {
    const glm::dvec3 low(0.1 + 3.8 * (i % side) / side, 0.1 + 2.8 * (i / side) / side, 0);
    const glm::dvec3 size(0.05 + 0.001 * i, 0.15, 0.3);
    const Surfaces faces = boxOf("box" + std::to_string(i) + "-", low, size, false);
    surfaces.insert(surfaces.end(), faces.begin(), faces.end());
    buried += size.x * size.y;
  }
  const Scene scene = tests::sceneOf(std::move(surfaces));
  const Discretization discretization = discretize(scene, {.texels = 1, .patch = 1});
  CHECK(discretization.elements[0].area == Approx(floorArea - buried).epsilon(1e-9));
}

TEST_CASE("separatedAtWalls makes one surface per side of a wall that reaches from border to border", "[exposure]") {
  const bool isSheet = GENERATE(false, true);
  const double thickness = isSheet ? 0 : 0.08;
  Surfaces wall = boxOf("wall", {1.97, 0, 0}, {0.08, 3, 2});
  if (isSheet) wall = Surfaces(1, tests::parallelogram("wall", {1.97, 0, 0}, {0, 3, 0}, {0, 0, 2}));
  const Scene whole = tests::sceneOf(joined({room(), wall, boxOf("leg", {3, 1, 0}, {0.1, 0.1, 0.7})}));
  const Scene scene = separatedAtWalls(whole);
  CHECK(scene.surfaces.size() == whole.surfaces.size() + 4);
  const double left = 1.97, right = 4 - 1.97 - thickness;
  // The largest part comes first: the left side of a thick wall, the right side of a sheet at x = 1.97.
  const std::size_t leftPart = isSheet ? 2 : 1;
  const auto nameOf = [](const std::string& family, std::size_t part) { return family + "#" + std::to_string(part); };
  for (const int texels : {1, 3, 16}) {
    const Discretization discretization = discretize(scene, {.texels = texels});
    const auto areaOf = [&](const std::string& name) { return exposedArea(discretization, numberOf(scene, name)); };
    for (const auto& [family, side] : {std::pair("room0", 3.0), {"room1", 3.0}, {"room4", 2.0}, {"room5", 2.0}}) {
      INFO(family << ", " << texels << " texels");
      const double leg = family == std::string("room0") ? 0.01 : 0;
      CHECK(areaOf(nameOf(family, leftPart)) == Approx(side * left));
      CHECK(areaOf(nameOf(family, 3 - leftPart)) == Approx(side * right - leg));
    }
    CHECK(areaOf("room2") == Approx(6));
    for (const Element& element : discretization.elements) {
      const Surface& surface = scene.surfaces[element.surface];
      if (surface.name == nameOf(surface.family, leftPart))
        CHECK(
            elementCentre(scene, discretization, std::uint32_t(&element - discretization.elements.data())).position.x <
            left);
    }
  }
}

TEST_CASE("separatedAtWalls keeps surfaces that objects do not divide, and the area of those that they do",
          "[exposure]") {
  const auto areaOfAll = [](const Scene& scene) {
    double sum = 0;
    for (const Surface& surface : scene.surfaces) sum += tests::totalArea(surface);
    return sum;
  };
  // A wall with an end inside the room, one that ends below the ceiling, and a frame around a part of the floor.
  const Scene open = tests::sceneOf(joined({room(), boxOf("wall", {1.97, 0, 0}, {0.08, 2.9, 1.9})}));
  CHECK(separatedAtWalls(open).surfaces.size() == open.surfaces.size());
  const Scene low = tests::sceneOf(joined({room(), boxOf("wall", {1.97, 0, 0}, {0.08, 3, 1.9})}));
  CHECK(separatedAtWalls(low).surfaces.size() == low.surfaces.size() + 1);
  const Scene framed =
      tests::sceneOf(joined({room(), boxOf("a", {1, 1, 0}, {1, 0.1, 1}), boxOf("b", {1, 1.9, 0}, {1, 0.1, 1}),
                             boxOf("c", {1, 1.1, 0}, {0.1, 0.8, 1}), boxOf("d", {1.9, 1.1, 0}, {0.1, 0.8, 1})}));
  const Scene separated = separatedAtWalls(framed);
  CHECK(separated.surfaces.size() == framed.surfaces.size() + 1);
  CHECK(exposedArea(discretize(separated, {.texels = 5}), numberOf(separated, "room0#2")) == Approx(0.8 * 0.8));
  CHECK(areaOfAll(separated) == Approx(areaOfAll(framed)));
  const Scene rotated = tests::sceneOf(joined(
      {room(), transformed(boxOf("wall", {1.97, -3, 0}, {0.08, 9, 2}), aboutZ(12.0 / 13, -5.0 / 13), {2, 1.4, 0})}));
  CHECK(areaOfAll(separatedAtWalls(rotated)) == Approx(areaOfAll(rotated)));
  CHECK(separatedAtWalls(rotated).surfaces.size() == rotated.surfaces.size() + 4);
}

TEST_CASE("separatedAtWalls finds the sides of a wall among many objects, which it cuts in cells", "[exposure]") {
  Surfaces all = joined({room(), boxOf("wall", {1.97, 0, 0}, {0.08, 3, 2})});
  constexpr int rows = 18;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) {
      const Surfaces leg = boxOf("leg", {2.1 + 0.1 * i, 0.05 + 0.16 * j, 0}, {0.05, 0.07, 0.7});
      all.insert(all.end(), leg.begin(), leg.end());
    }
  const Scene whole = tests::sceneOf(all), scene = separatedAtWalls(whole);
  CHECK(scene.surfaces.size() == whole.surfaces.size() + 4);
  const Discretization discretization = discretize(scene, {.texels = 4});
  CHECK(exposedArea(discretization, numberOf(scene, "room0#1")) == Approx(3 * 1.97));
  CHECK(exposedArea(discretization, numberOf(scene, "room0#2")) == Approx(3 * 1.95 - rows * rows * 0.05 * 0.07));
}
