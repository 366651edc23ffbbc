/// The scenes of data/: the committed files are those that the program writes, and the scenes have their stated
/// properties.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "data/generate/models.h"
#include "data/generate/random_room.h"
#include "data/generate/shapes.h"
#include "data/generate/tiled_room.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/scene.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex::data;

namespace {

constexpr double pi = 3.141592653589793;

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

Group groupNamed(const Model& model, const std::string& name) {
  for (const Group& group : model.groups) {
    if (group.name == name) return group;
  }
  throw std::out_of_range(name);
}

std::vector<Polygon> polygonsOf(const Model& model) {
  std::vector<Polygon> result;
  for (const Group& group : model.groups) result.insert(result.end(), group.polygons.begin(), group.polygons.end());
  return result;
}

/// The furniture of the gallery, which is open below, without the rooms.
bool isFurniture(const Group& group) {
  for (const std::string start : {"table-", "shelf-", "beam-", "gallery-bench-", "library-bench-"})
    if (group.name.rfind(start, 0) == 0) return true;
  return false;
}

/// The polygons of the model that form closed surfaces. Without objects that hang free (the paper's light) or stand on
/// something (the furniture of the gallery and of the furnished room). Openings get lids: the front of the Cornell box,
/// which faces in, and the undersides of its blocks, which face out.
std::vector<Polygon> closedPolygons(Model model) {
  if (model.name == "gallery") std::erase_if(model.groups, isFurniture);
  if (model.name == "furnished-room") model.groups.resize(6);
  if (model.name == "paper-room") model.groups.pop_back();
  std::vector<Polygon> polygons = polygonsOf(model);
  if (model.name == "cornell-box") {
    polygons.push_back({{{0, 0, 0}, {552.8, 0, 0}, {556, 548.8, 0}, {0, 548.8, 0}}});
    for (const std::string name : {"short-block", "tall-block"}) {
      polygons.push_back(reversed(atHeight(groupNamed(model, name).polygons.back(), 0)));
    }
  }
  return polygons;
}

using Edge = std::array<double, 6>;

Edge edge(const glm::dvec3& from, const glm::dvec3& to) { return {from.x, from.y, from.z, to.x, to.y, to.z}; }

/// The number of occurrences of each directed edge.
std::map<Edge, int> edgeCounts(const std::vector<Polygon>& polygons) {
  std::map<Edge, int> counts;
  for (const Polygon& polygon : polygons) {
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      ++counts[edge(polygon.corners[i], polygon.corners[(i + 1) % polygon.corners.size()])];
    }
  }
  return counts;
}

/// The solid angle of a triangle seen from the origin (van Oosterom and Strackee 1983), positive if its front is
/// visible, where it is counter-clockwise.
double solidAngle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double numerator = -glm::dot(a, glm::cross(b, c));
  const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2 * std::atan2(numerator, denominator);
}

double solidAngle(const std::vector<Polygon>& polygons, const glm::dvec3& eye) {
  double sum = 0;
  for (const Polygon& polygon : polygons) {
    for (std::size_t i = 2; i < polygon.corners.size(); ++i) {
      sum += solidAngle(polygon.corners[0] - eye, polygon.corners[i - 1] - eye, polygon.corners[i] - eye);
    }
  }
  return sum;
}

/// Twice the vector area: its direction is the normal.
glm::dvec3 twiceArea(const Polygon& polygon) {
  glm::dvec3 sum{0.0};
  for (std::size_t i = 2; i < polygon.corners.size(); ++i) {
    sum += glm::cross(polygon.corners[i - 1] - polygon.corners[0], polygon.corners[i] - polygon.corners[0]);
  }
  return sum;
}

/// The largest distance of a corner from the plane through the first three.
double warp(const Polygon& polygon) {
  const auto& corners = polygon.corners;
  const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  double largest = 0;
  for (const glm::dvec3& corner : corners) largest = std::max(largest, std::abs(glm::dot(normal, corner - corners[0])));
  return largest;
}

bool isConvex(const Polygon& polygon) {
  const glm::dvec3 normal = twiceArea(polygon);
  const std::size_t count = polygon.corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 in = polygon.corners[(i + 1) % count] - polygon.corners[i];
    const glm::dvec3 out = polygon.corners[(i + 2) % count] - polygon.corners[(i + 1) % count];
    if (glm::dot(glm::cross(in, out), normal) <= 0) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("allModels gives the committed files, byte for byte", "[data]") {
  for (const Model& model : allModels()) {
    for (const File& file : files(model)) {
      INFO(file.name << " differs: run hemitex_data over data/");
      // Compared outside CHECK, which would print two whole files.
      const bool equal = contents(HEMITEX_DATA "/" + file.name) == file.text;
      CHECK(equal);
    }
  }
}

TEST_CASE("files begins each OBJ and MTL with a comment about its content", "[data]") {
  for (const Model& model : allModels()) {
    CHECK(files(model)[0].text.substr(0, 2) == "# ");
    CHECK(files(model)[1].text.substr(0, 2) == "# ");
  }
}

TEST_CASE("allModels give each group a material of its model, and groups different names", "[data]") {
  for (const Model& model : allModels()) {
    std::map<std::string, int> materials, groups;
    for (const Material& material : model.materials) ++materials[material.name];
    for (const Group& group : model.groups) {
      INFO(model.name << ' ' << group.name);
      CHECK(materials[group.material] == 1);
      CHECK(++groups[group.name] == 1);
    }
  }
}

TEST_CASE("allModels have reflectances from 0 to below 1, and only lights emit", "[data]") {
  for (const Model& model : allModels()) {
    for (const Material& material : model.materials) {
      INFO(model.name << ' ' << material.name);
      for (int c = 0; c < 3; ++c) {
        CHECK(material.reflectance[c] >= 0);
        CHECK(material.reflectance[c] < 1);
        CHECK((material.emission[c] > 0) == (material.name.rfind("light", 0) == 0));
      }
    }
  }
}

TEST_CASE("allModels have convex polygons, which are planar except the red wall of the Cornell box", "[data]") {
  for (const Model& model : allModels()) {
    for (const Group& group : model.groups) {
      for (const Polygon& polygon : group.polygons) {
        INFO(model.name << ' ' << group.name);
        CHECK(isConvex(polygon));
        // The corners of the red wall's floor edge are 552.8 and 549.6 from the green wall: 3.2 apart, times the cosine
        // of the wall's slope, 3.2 / 548.8.
        const bool isRedWall = group.name == "wall-red";
        CHECK(warp(polygon) == Approx(isRedWall ? 3.2 : 0.0).margin(isRedWall ? 1e-3 : 1e-12));
      }
    }
  }
}

// Without vertices inside edges, a rasterizer that covers shared edges exactly once leaves no hole.
TEST_CASE("allModels have closed rooms: each edge occurs once in each direction", "[data]") {
  for (const Model& model : allModels()) {
    const std::map<Edge, int> counts = edgeCounts(closedPolygons(model));
    int unmatched = 0;
    for (const auto& [e, count] : counts) {
      const auto back = counts.find({e[3], e[4], e[5], e[0], e[1], e[2]});
      if (count != 1 || back == counts.end() || back->second != 1) ++unmatched;
    }
    INFO(model.name);
    CHECK(unmatched == 0);
  }
}

// Seen from a point in the air, the fronts of a closed scene fill the sphere. From a point inside a solid the room
// still counts 4 pi, but the faces of the solid show their backs and count -4 pi. A face with the wrong winding breaks
// this.
TEST_CASE("allModels have faces that look into the air", "[data]") {
  struct Case {
    Model model;
    std::vector<glm::dvec3> air;
    std::vector<glm::dvec3> solid;
  };
  const std::vector<Case> cases{
      {paperRoom(), {{0, 1.5, 1.5}, {0.3, 0.1, -0.3}, {-1.9, 2.95, -1.9}}, {{0.3, 0.9, -0.3}}},
      {cornellBox(), {{278, 273, 20}, {278, 540, 280}, {20, 20, 540}}, {{185, 80, 170}, {370, 160, 350}}},
      {pyramidRoom(), {{0, 1.75, 0}, {2.4, 0.1, 2.4}}, {{0, 1.6, 0}, {0.2, 0.1, 0.3}}},
      {gallery(),
       {{0, 1.7, 6}, {-5, 1.5, 0}, {5, 4.6, -1.7}, {9.2, 2.8, -1.7}, {0, 1, -8}, {6.8, 1, -1.7}, {3.3, 3.5, 1.7}},
       {{3.3, 1.5, 0}, {-3.3, 4, 3.4}, {0, 0.2, -6}, {0, 0.9, -6.1}, {9.2, 0.5, -1.7}, {5.3, 1.4, -5.1}}},
      {plant(), {{2, 0.1, 1.9}, {0, 2.85, 0}, {1.1, 1.5, 1.2}}, {{-0.4, 0.2, -0.5}, {1.2, 0.1, 0.5}}},
      {curvedRoom(), {{-2.4, 0.1, 2.4}, {1.05, 0.3, 0}, {1.05, 2, 0}}, {{-0.5, 0.5, 0}, {1, 1.45, 0}}},
  };
  for (const Case& c : cases) {
    INFO(c.model.name);
    const std::vector<Polygon> polygons = closedPolygons(c.model);
    for (const glm::dvec3& point : c.air) CHECK(solidAngle(polygons, point) == Approx(4 * pi).margin(1e-9));
    for (const glm::dvec3& point : c.solid) CHECK(solidAngle(polygons, point) == Approx(0).margin(1e-9));
  }
}

TEST_CASE("paperRoom is 13 quads, each a surface, with a box above the floor", "[data]") {
  const Model model = paperRoom();
  CHECK(model.groups.size() == 13);
  for (const Group& group : model.groups) {
    CHECK(group.polygons.size() == 1);
    CHECK(group.polygons[0].corners.size() == 4);
  }
  const Polygon bottom = groupNamed(model, "box-bottom").polygons[0];
  for (const glm::dvec3& corner : bottom.corners) CHECK(corner.y == 0.4);
}

TEST_CASE("paperRoom has a light below the ceiling that faces down and hides no patch's centre", "[data]") {
  const Model model = paperRoom();
  const Polygon light = groupNamed(model, "light").polygons[0];
  const Polygon ceiling = groupNamed(model, "ceiling").polygons[0];
  for (const glm::dvec3& corner : light.corners) CHECK(corner.y < ceiling.corners[0].y);
  CHECK(twiceArea(light).y < 0);

  const glm::dvec3 origin = ceiling.corners[0];
  for (const int patches : {3, 4}) {
    for (int i = 0; i < patches * patches; ++i) {
      const double s = (i % patches + 0.5) / patches, t = (i / patches + 0.5) / patches;
      glm::dvec3 centre = origin + s * (ceiling.corners[1] - origin) + t * (ceiling.corners[3] - origin);
      centre.y = light.corners[0].y;
      // Inside the light, all triangles to its edges have the winding of the light.
      bool inside = true;
      for (std::size_t k = 0; k < 4; ++k) {
        const Polygon triangle{{centre, light.corners[k], light.corners[(k + 1) % 4]}};
        inside = inside && twiceArea(triangle).y < 0;
      }
      CHECK_FALSE(inside);
    }
  }
}

TEST_CASE("cornellBox has a light that fills the hole in its ceiling", "[data]") {
  const Model model = cornellBox();
  double area = 0;
  for (const Polygon& polygon : groupNamed(model, "ceiling").polygons) area += glm::length(twiceArea(polygon)) / 2;
  CHECK(area == Approx(556 * 559.2 - 130 * 105).epsilon(1e-14));
  CHECK(twiceArea(groupNamed(model, "light").polygons[0]).y == Approx(-2 * 130 * 105).epsilon(1e-14));
}

TEST_CASE("cornellBox has a camera with the measured film and focal length", "[data]") {
  CHECK(std::tan(cornellBox().view.fov / 2 * pi / 180) == Approx(0.0125 / 0.035).epsilon(1e-14));
}

TEST_CASE("pyramidRoom has a pyramid of four triangles that meet above the room's middle", "[data]") {
  const Group pyramid = groupNamed(pyramidRoom(), "pyramid");
  CHECK(pyramid.polygons.size() == 4);
  for (const Polygon& side : pyramid.polygons) {
    CHECK(side.corners.size() == 3);
    CHECK(side.corners[2] == glm::dvec3{0, 1.7, 0});
  }
}

// No two triangles of the chart overlap: each is half a cell of a 50 x 50 grid, and together they fill the unit square.
TEST_CASE("curvedRoom has a wave of 5000 triangles whose texture coordinates fill the unit square", "[data]") {
  const Group wave = groupNamed(curvedRoom(), "wave");
  CHECK(wave.polygons.size() == 5000);
  std::map<std::array<long, 3>, int> halfCells;
  for (const Polygon& triangle : wave.polygons) {
    REQUIRE(triangle.texcoords.size() == 3);
    const glm::dvec2 a = triangle.texcoords[0], b = triangle.texcoords[1], c = triangle.texcoords[2];
    const double twice = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    CHECK(twice == Approx(1.0 / 2500).epsilon(1e-12));
    const glm::dvec2 centroid = (a + b + c) / 3.0 * 50.0;
    const glm::dvec2 cell = glm::floor(centroid);
    ++halfCells[{std::lround(cell.x), std::lround(cell.y), centroid.y - cell.y > centroid.x - cell.x ? 1 : 0}];
    CHECK((cell.x >= 0 && cell.x < 50 && cell.y >= 0 && cell.y < 50));
  }
  CHECK(halfCells.size() == 5000);
}

TEST_CASE("curvedRoom has a wave that overhangs", "[data]") {
  int facingDown = 0;
  for (const Polygon& triangle : groupNamed(curvedRoom(), "wave").polygons) facingDown += twiceArea(triangle).y < 0;
  CHECK(facingDown > 0);
}

TEST_CASE("files writes numbers that read back to the same bits", "[data]") {
  Model model;
  model.name = "numbers";
  const std::vector<double> values{0.1, 1.0 / 3, 1e-7, 123456789.125, -0.25, 1e-300};
  for (const double value : values) model.groups.push_back({"g", "m", {{{{value, 0, -0.0}}}}});
  std::istringstream lines(files(model)[0].text);
  std::string statement, x, y, z;
  std::size_t found = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("v ", 0) != 0) continue;
    std::istringstream(line) >> statement >> x >> y >> z;
    CHECK(std::stod(x) == values[found++]);
    CHECK(x.find('e') == std::string::npos);
    CHECK(z == "0");
  }
  CHECK(found == values.size());
}

TEST_CASE("plant is thousands of triangles in leaves of four, and loadScene reports no repairs", "[data]") {
  const hemitex::radiosity::Scene scene = hemitex::radiosity::loadScene(HEMITEX_DATA "/plant.obj");
  const auto isLeaf = [](const auto& surface) { return surface.name.find("-leaf-") != std::string::npos; };
  CHECK(std::count_if(scene.surfaces.begin(), scene.surfaces.end(), isLeaf) == 2000);
  CHECK(triangleCount(scene) > 4000);
  CHECK(triangleCount(scene) < 5000);
  CHECK(scene.warnings.empty());
}

TEST_CASE("gallery is 8088 triangles on hundreds of surfaces, and loadScene reports no repairs", "[data]") {
  const hemitex::radiosity::Scene scene = hemitex::radiosity::loadScene(HEMITEX_DATA "/gallery.obj");
  CHECK(triangleCount(scene) == 8088);
  CHECK(scene.surfaces.size() >= 300);
  CHECK(scene.surfaces.size() <= 1200);
  CHECK(scene.warnings.empty());
}

namespace {

/// Whether a point lies in a convex polygon's plane, and inside it or on its border, within a hundredth of the finest
/// step of the gallery's coordinates.
bool liesOn(const glm::dvec3& point, const Polygon& polygon) {
  constexpr double tolerance = 1e-6;
  const glm::dvec3 normal = glm::normalize(twiceArea(polygon));
  if (std::abs(glm::dot(normal, point - polygon.corners[0])) > tolerance) return false;
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const glm::dvec3 from = polygon.corners[i], to = polygon.corners[(i + 1) % polygon.corners.size()];
    if (glm::dot(glm::cross(normal, glm::normalize(to - from)), point - from) < -tolerance) return false;
  }
  return true;
}

}  // namespace

// An opening that does not lie on a face would show the inside of its object.
TEST_CASE("gallery and furnishedRoom have no opening that does not lie on a face", "[data]") {
  const Model model = GENERATE(gallery(), furnishedRoom());
  INFO(model.name);
  const std::vector<Polygon> polygons = polygonsOf(model);
  const std::map<Edge, int> counts = edgeCounts(polygons);
  std::vector<Polygon> flat;  // faces along two axes, on which objects stand or are fixed
  for (const Polygon& polygon : polygons) {
    const glm::dvec3 normal = glm::abs(glm::normalize(twiceArea(polygon)));
    if (std::max({normal.x, normal.y, normal.z}) > 1 - 1e-12) flat.push_back(polygon);
  }
  int open = 0, hanging = 0;
  for (const auto& [e, count] : counts) {
    const auto back = counts.find({e[3], e[4], e[5], e[0], e[1], e[2]});
    if (back != counts.end() && back->second == count) continue;
    ++open;
    const glm::dvec3 middle{(e[0] + e[3]) / 2, (e[1] + e[4]) / 2, (e[2] + e[5]) / 2};
    const auto carries = [&](const Polygon& face) {
      const auto has = [&](const glm::dvec3& end) {
        return std::find(face.corners.begin(), face.corners.end(), end) != face.corners.end();
      };
      const bool isItsOwn = has({e[0], e[1], e[2]}) && has({e[3], e[4], e[5]});
      return !isItsOwn && liesOn(middle, face);
    };
    if (std::none_of(flat.begin(), flat.end(), carries)) ++hanging;
  }
  CHECK(open > 50);
  CHECK(hanging == 0);
}

namespace {

/// Polygons that close openings: each follows open edges backwards until it returns to its first corner.
std::vector<Polygon> lids(const std::vector<Polygon>& polygons) {
  std::map<std::array<double, 3>, std::vector<glm::dvec3>> open;  // the starts of open edges by their ends
  for (auto counts = edgeCounts(polygons); const auto& [e, count] : counts) {
    const auto back = counts.find({e[3], e[4], e[5], e[0], e[1], e[2]});
    const int unmatched = count - (back == counts.end() ? 0 : back->second);
    for (int i = 0; i < unmatched; ++i) open[{e[3], e[4], e[5]}].emplace_back(e[0], e[1], e[2]);
  }
  std::vector<Polygon> result;
  for (auto& [end, starts] : open)
    while (!starts.empty()) {
      std::array<double, 3> at = end;
      Polygon& lid = result.emplace_back();
      do {
        lid.corners.emplace_back(at[0], at[1], at[2]);
        const glm::dvec3 next = open.at(at).back();
        open.at(at).pop_back();
        at = {next.x, next.y, next.z};
      } while (at != end);
    }
  return result;
}

/// The winding number of a point: 1 in the air of a room, less 1 per solid around it.
class Winding {
 public:
  explicit Winding(const Model& model) : polygons_(polygonsOf(model)) {
    const std::vector<Polygon> more = lids(polygons_);
    polygons_.insert(polygons_.end(), more.begin(), more.end());
  }
  double at(const glm::dvec3& point) const { return solidAngle(polygons_, point) / (4 * pi); }

 private:
  std::vector<Polygon> polygons_;
};

struct Bounds {
  glm::dvec3 low, high;
};

Bounds boundsOf(const std::vector<Polygon>& polygons) {
  Bounds bounds{polygons[0].corners[0], polygons[0].corners[0]};
  for (const Polygon& polygon : polygons)
    for (const glm::dvec3& corner : polygon.corners)
      bounds = {glm::min(bounds.low, corner), glm::max(bounds.high, corner)};
  return bounds;
}

double area(const Polygon& polygon) { return glm::length(twiceArea(polygon)) / 2; }

/// Whether two axis-parallel rectangles that face the same way overlap.
bool coincide(const Polygon& a, const Polygon& b) {
  if (glm::distance(glm::normalize(twiceArea(a)), glm::normalize(twiceArea(b))) > 1e-9) return false;
  const Bounds one = boundsOf({a}), other = boundsOf({b});
  const glm::dvec3 common = glm::min(one.high, other.high) - glm::max(one.low, other.low);
  const glm::dvec3 size = one.high - one.low;
  for (int i = 0; i < 3; ++i)
    if (size[i] < 1e-9 ? std::abs(common[i]) > 1e-9 || other.high[i] - other.low[i] > 1e-9 : common[i] < 1e-9)
      return false;
  return true;
}

bool isRectangle(const Polygon& polygon) {
  const Bounds bounds = boundsOf({polygon});
  const glm::dvec3 size = bounds.high - bounds.low;
  return std::abs(size.x * size.y + size.y * size.z + size.z * size.x - area(polygon)) < 1e-9;
}

hemitex::radiosity::Scene loaded(const Model& model) {
  const hemitex::TemporaryFolder folder;
  for (const File& file : files(model)) std::ofstream(folder.path / file.name, std::ios::binary) << file.text;
  return hemitex::radiosity::loadScene(folder.path / (model.name + ".obj"));
}

/// Emitted flux of all polygons, all bands.
double emittedFlux(const Model& model) {
  double sum = 0;
  for (const Group& group : model.groups)
    for (const Material& material : model.materials)
      if (material.name == group.material)
        for (const Polygon& polygon : group.polygons)
          sum += area(polygon) * (material.emission.r + material.emission.g + material.emission.b);
  return sum;
}

}  // namespace

TEST_CASE("furnishedRoom has faces that look into the air", "[data]") {
  const Winding winding(furnishedRoom());
  for (const glm::dvec3& air : {glm::dvec3(0.1, 1.5, 1.9), {0.6, 1.65, -1.9}, {0.4, 0.3, 0.1}, {-1, 1.2, -2.3}})
    CHECK(winding.at(air) == Approx(1).margin(1e-9));
  for (const glm::dvec3& solid : {glm::dvec3(0.4, 0.72, 0.1),
                                  {-0.05, 0.8, 0},
                                  {1.6, 0.3, -2.2},
                                  {1.6, 0.8, -2.2},
                                  {-1.64, 0.2, -2.4},
                                  {-1.57, 0.2, -2.4},
                                  {-1.3, 0.2, 1.1},
                                  {0.6, 0.8, -1.9},
                                  {0.6, 1.5, -1.9},
                                  {0.765, 1.5, -1.9},
                                  {0, 2.58, 0},
                                  {-1.98, 1.5, 0},
                                  {0, 0.005, 0}})
    CHECK(winding.at(solid) == Approx(0).margin(1e-9));
}

TEST_CASE("furnishedRoom is 87 surfaces without coincident faces, and loadScene reports no repairs", "[data]") {
  const hemitex::radiosity::Scene scene = hemitex::radiosity::loadScene(HEMITEX_DATA "/furnished-room.obj");
  CHECK(scene.surfaces.size() == 87);
  CHECK(scene.warnings.empty());
  std::vector<Polygon> rectangles = polygonsOf(furnishedRoom());
  std::erase_if(rectangles, [](const Polygon& polygon) { return !isRectangle(polygon); });
  CHECK(rectangles.size() > 200);
  int found = 0;
  for (std::size_t i = 0; i < rectangles.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) found += coincide(rectangles[i], rectangles[j]);
  CHECK(found == 0);
}

TEST_CASE("randomRoom gives the same room for the same seed, and other rooms for other seeds", "[data]") {
  CHECK(files(randomRoom(7))[0].text == files(randomRoom(7))[0].text);
  CHECK(files(randomRoom(7))[0].text != files(randomRoom(8))[0].text);
}

TEST_CASE("randomRoom gives at most 40 surfaces that emit and need no repairs", "[data]") {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    const Model model = randomRoom(seed);
    INFO(model.name);
    const hemitex::radiosity::Scene scene = loaded(model);
    CHECK(scene.warnings.empty());
    CHECK(scene.surfaces.size() == model.groups.size());
    CHECK(scene.surfaces.size() >= 12);
    CHECK(scene.surfaces.size() <= 40);
    CHECK(emittedFlux(model) > 0.1);
    for (const Material& material : model.materials)
      for (int c = 0; c < 3; ++c) CHECK((material.reflectance[c] >= 0.05 && material.reflectance[c] <= 0.9));
  }
}

// In the air all fronts together fill the whole sphere; each solid subtracts one sphere.
TEST_CASE("randomRoom gives boxes that face outwards and lights that no box buries", "[data]") {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    const Model model = randomRoom(seed);
    INFO(model.name);
    const Winding winding(model);
    for (const Group& group : model.groups)
      for (const Polygon& polygon : group.polygons) {
        INFO(group.name);
        // Near the middle of a face, in front of it and behind it.
        const glm::dvec3 middle = (polygon.corners[0] + polygon.corners[2]) / 2.0;
        const glm::dvec3 step = 1e-4 * glm::normalize(twiceArea(polygon));
        const double front = winding.at(middle + step), behind = winding.at(middle - step);
        CHECK(front == Approx(std::nearbyint(front)).margin(1e-6));
        CHECK(front <= 1 + 1e-6);
        if (group.name.rfind("box", 0) == 0 && front > 0.5) CHECK(behind < 0.5);
        if (group.name.rfind("light", 0) == 0 && group.name.find("case") == std::string::npos)
          CHECK(front == Approx(1).margin(1e-6));
      }
  }
}

TEST_CASE("tiledRoom is closed, faces inwards, and has 16 * tiles^2 squares of one square metre", "[data]") {
  for (const int tiles : {2, 7}) {
    const Model room = tiledRoom(tiles);
    CHECK(room.groups.size() == static_cast<std::size_t>(16 * tiles * tiles));
    const std::vector<Polygon> polygons = polygonsOf(room);
    for (const Polygon& polygon : polygons) REQUIRE(glm::length(twiceArea(polygon)) == 2);
    const std::map<Edge, int> counts = edgeCounts(polygons);
    for (const auto& [side, count] : counts) {
      REQUIRE(count == 1);
      REQUIRE(counts.count({side[3], side[4], side[5], side[0], side[1], side[2]}) == 1);
    }
    CHECK(solidAngle(polygons, room.view.eye) == Approx(4 * pi).epsilon(1e-12));
    CHECK(std::count_if(room.groups.begin(), room.groups.end(),
                        [](const Group& group) { return group.material == "light"; }) == (tiles == 2 ? 1 : 4));
  }
}
