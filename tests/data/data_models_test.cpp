/// The scenes of data/, and the rooms that hemitex_data writes.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "data/generate/random_room.h"
#include "data/generate/tiled_room.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/scene.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex::data;

namespace {

constexpr double pi = 3.141592653589793;

std::vector<Polygon> polygonsOf(const Model& model) {
  std::vector<Polygon> result;
  for (const Group& group : model.groups) result.insert(result.end(), group.polygons.begin(), group.polygons.end());
  return result;
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

double area(const Polygon& polygon) { return glm::length(twiceArea(polygon)) / 2; }

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

TEST_CASE("loadScene reports no repairs of the scenes of data/", "[data]") {
  const auto [name, surfaces] = GENERATE(table<std::string, std::size_t>({
      {"paper-room", 13},
      {"cornell-box", 16},
      {"pyramid-room", 11},
      {"curved-room", 8},
      {"gallery", 1000},
      {"plant", 2049},
      {"furnished-room", 87},
  }));
  INFO(name);
  const hemitex::radiosity::Scene scene = hemitex::radiosity::loadScene(HEMITEX_DATA "/" + name + ".obj");
  CHECK(scene.warnings.empty());
  CHECK(scene.surfaces.size() == surfaces);
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
