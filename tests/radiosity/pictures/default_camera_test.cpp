/// defaultCamera chooses a view that shows much of the scene, tested with rays.
#include "radiosity/pictures/default_camera.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "radiosity/pictures/camera.h"
#include "radiosity/pictures/visibility.h"
#include "radiosity/scene/load_scene.h"
#include "tests/support/picture_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

struct Hit {
  double distance = std::numeric_limits<double>::infinity();
  bool isFront = false;
  std::string surface = {};
};

/// The nearest triangle on a ray, front or back.
Hit castRay(const Scene& scene, const glm::dvec3& from, const glm::dvec3& direction) {
  Hit hit;
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles) {
      const auto& [a, b, c] = triangle.position;
      const glm::dvec3 p = glm::cross(direction, c - a);
      const double determinant = glm::dot(b - a, p);
      const double u = glm::dot(from - a, p) / determinant;
      const glm::dvec3 q = glm::cross(from - a, b - a);
      const double v = glm::dot(direction, q) / determinant, distance = glm::dot(c - a, q) / determinant;
      if (u >= 0 && v >= 0 && u + v <= 1 && distance > 0 && distance < hit.distance)
        hit = {distance, determinant > 0, surface.name};
    }
  return hit;
}

/// The hits of the rays of a 4 : 3 picture, row by row from the top; directions have unit length.
constexpr int columns = 32, rows = 24;
std::vector<Hit> castPicture(const Scene& scene, const Camera& camera) {
  const glm::dvec3 forward = glm::normalize(camera.lookAt - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const double pixel = 2 * std::tan(camera.fov * 3.14159265358979 / 360) / rows;
  std::vector<Hit> hits;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      hits.push_back(castRay(
          scene, camera.eye,
          glm::normalize(forward + pixel * ((column + 0.5 - columns / 2.0) * right + (rows / 2.0 - row - 0.5) * up))));
  return hits;
}

double shareOf(const std::vector<Hit>& hits, auto&& predicate) {
  return static_cast<double>(std::count_if(hits.begin(), hits.end(), predicate)) / static_cast<double>(hits.size());
}

double frontShare(const std::vector<Hit>& hits) {
  return shareOf(hits, [](const Hit& hit) { return hit.isFront; });
}

double nearestInMiddle(const std::vector<Hit>& hits) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int row = rows / 4; row < rows - rows / 4; ++row)
    for (int column = columns / 4; column < columns - columns / 4; ++column)
      nearest = std::min(nearest, hits[static_cast<std::size_t>(row * columns + column)].distance);
  return nearest;
}

void append(std::vector<Surface>& surfaces, const std::vector<Surface>& more) {
  surfaces.insert(surfaces.end(), more.begin(), more.end());
}

/// A box whose +y face is NAME5.
void addBox(std::vector<Surface>& surfaces, const std::string& name, const glm::dvec3& low, const glm::dvec3& size) {
  append(surfaces, box(name, low, size, false));
}

/// A table of height 0.75 with four legs.
void addTable(std::vector<Surface>& surfaces, const std::string& name, double x, double z, double width, double depth) {
  constexpr double leg = 0.06, underside = 0.7;
  addBox(surfaces, name + "-top", {x, underside, z}, {width, 0.05, depth});
  for (const double u : {x, x + width - leg})
    for (const double v : {z, z + depth - leg}) addBox(surfaces, name + "-leg", {u, 0, v}, {leg, underside, leg});
}

constexpr glm::dvec3 roomSize{5, 2.5, 4};
const double roomDiagonal = std::hypot(roomSize.x, roomSize.z);

std::vector<Surface> emptyRoom() { return box("room", {0, 0, 0}, roomSize, true); }

/// A room with a table in its middle, a desk, a shelf and two crates.
Scene furnishedRoomOfTables() {
  std::vector<Surface> surfaces = emptyRoom();
  addTable(surfaces, "table", 1.7, 1.5, 1.6, 0.9);
  addTable(surfaces, "desk", 0.1, 3.2, 1.4, 0.7);
  for (int board = 0; board < 5; ++board) addBox(surfaces, "shelf", {4.5, 0.1 + 0.45 * board, 0.5}, {0.45, 0.03, 1.7});
  addBox(surfaces, "side", {4.5, 0, 0.45}, {0.45, 2.1, 0.05});
  addBox(surfaces, "side", {4.5, 0, 2.2}, {0.45, 2.1, 0.05});
  addBox(surfaces, "crate", {3.9, 0, 3.1}, {0.6, 0.6, 0.6});
  addBox(surfaces, "crate", {4, 0.6, 3.2}, {0.4, 0.4, 0.4});
  return sceneOf(std::move(surfaces));
}

/// Tables, crates and wardrobes at random places; wardrobes are higher than the eye.
Scene randomRoom(unsigned seed) {
  std::mt19937 random(seed);
  const auto draw = [&](double low, double high) { return low + (high - low) * double(random()) / 4294967296.0; };
  std::vector<Surface> surfaces = emptyRoom();
  for (int i = 0; i < 3; ++i) {
    const double x = draw(0.1, 3.2), z = draw(0.1, 2.8);
    addTable(surfaces, "table", x, z, 1.6, 0.9);
  }
  for (int i = 0; i < 7; ++i) {
    const double x = draw(0, 4.4), z = draw(0, 3.4), height = draw(0.8, 2.4);
    addBox(surfaces, "crate", {x, 0, z}, {0.6, height, 0.6});
  }
  return sceneOf(std::move(surfaces));
}

/// Towers on a ground of 100 x 100.
std::vector<Surface> city() {
  std::vector<Surface> surfaces{parallelogram("ground", {-50, 0, 50}, {100, 0, 0}, {0, 0, -100})};
  for (int z = 0; z < 6; ++z)
    for (int x = 0; x < 6; ++x)
      addBox(surfaces, "tower", {-45 + 15 * x, 0, -45 + 15 * z}, {9, 5 + (7 * x + 11 * z) % 25, 9});
  return surfaces;
}

/// +y becomes +z.
Scene zUpwards(std::vector<Surface> surfaces) {
  for (Surface& surface : surfaces)
    for (Triangle& triangle : surface.triangles)
      for (glm::dvec3& p : triangle.position) p = {p.x, -p.z, p.y};
  return sceneOf(std::move(surfaces));
}

void checkStands(const Camera& camera, double low, double high) {
  CHECK(camera.up == glm::dvec3(0, 1, 0));
  CHECK(camera.eye.y > low + 0.3 * (high - low));
  CHECK(camera.eye.y < low + 0.75 * (high - low));
  const glm::dvec3 forward = glm::normalize(camera.lookAt - camera.eye);
  CHECK(forward.y < 0);
  CHECK(forward.y > -0.5);
}

}  // namespace

TEST_CASE("defaultCamera stands in a furnished room, upright, and sees over its tables", "[default_camera]") {
  const Scene room = furnishedRoomOfTables();
  const Camera camera = defaultCamera(room);
  checkStands(camera, 0, roomSize.y);
  const std::vector<Hit> hits = castPicture(room, camera);
  CHECK(frontShare(hits) > 0.99);
  CHECK(nearestInMiddle(hits) > 0.15 * roomDiagonal);
  CHECK(shareOf(hits, [](const Hit& hit) { return hit.surface == "table-top5"; }) > 0.02);
  CHECK(shareOf(hits, [](const Hit& hit) { return hit.surface.starts_with("shelf"); }) > 0.01);
}

TEST_CASE("defaultCamera is never inside furniture and rarely close to it", "[default_camera]") {
  int close = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const Scene room = randomRoom(seed);
    const Camera camera = defaultCamera(room);
    checkStands(camera, 0, roomSize.y);
    const std::vector<Hit> hits = castPicture(room, camera);
    CHECK(frontShare(hits) > 0.95);
    close += nearestInMiddle(hits) < 0.15 * roomDiagonal;
  }
  CHECK(close <= 1);
}

TEST_CASE("defaultCamera avoids posts right in front of the eye", "[default_camera]") {
  // Posts in front of all eye positions except one.
  std::vector<Surface> surfaces = emptyRoom();
  for (const double v : {0.1, 0.3, 0.5, 0.7, 0.9})
    for (const double u : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      const bool isBorder = std::min(std::min(u, 1 - u), std::min(v, 1 - v)) < 0.2;
      if (!isBorder || (u == 0.5 && v == 0.9)) continue;
      const glm::dvec3 eye(u * roomSize.x, 0, v * roomSize.z), middle(roomSize.x / 2, 0, roomSize.z / 2);
      const glm::dvec3 post = eye + 0.4 * glm::normalize(middle - eye);
      addBox(surfaces, "post", post - glm::dvec3(0.03, 0, 0.03), {0.06, 2, 0.06});
    }
  const Scene room = sceneOf(std::move(surfaces));
  CHECK(nearestInMiddle(castPicture(room, defaultCamera(room))) > 0.15 * roomDiagonal);
}

TEST_CASE("defaultCamera stands on the floor of a storey, below its ceiling", "[default_camera]") {
  std::vector<Surface> house = emptyRoom();
  append(house, box("upstairs", {0, 2.7, 0}, roomSize, true));
  checkStands(defaultCamera(sceneOf(std::move(house))), 0, roomSize.y);
}

TEST_CASE("defaultCamera sees a room from inside", "[default_camera]") {
  const Scene room = makeRoom();
  const Camera camera = defaultCamera(room);
  checkStands(camera, -1, 1);
  CHECK(std::max(std::fabs(camera.eye.x), std::fabs(camera.eye.z)) == Approx(0.8));
  for (const auto& sample : visibleSamples(room, camera, 16, 16)) CHECK(sample);
}

TEST_CASE("defaultCamera sees the rooms of data from inside, the open one through its opening", "[default_camera]") {
  for (const std::string name : {"curved-room", "gallery", "paper-room", "plant", "pyramid-room"}) {
    CAPTURE(name);
    const Scene scene = loadScene(HEMITEX_DATA "/" + name + ".obj");
    const Camera camera = defaultCamera(scene);
    CHECK(camera.up == glm::dvec3(0, 1, 0));
    CHECK(frontShare(castPicture(scene, camera)) > 0.8);  // leaves have backs
    for (const int axis : {0, 1, 2}) CHECK(std::fabs(camera.eye[axis] - scene.origin[axis]) < scene.extent / 2);
  }
  const Scene box = loadScene(HEMITEX_DATA "/cornell-box.obj");
  const Camera camera = defaultCamera(box);
  CHECK(camera.eye.x == Approx(box.origin.x));
  CHECK(camera.eye.y == Approx(box.origin.y));
  CHECK(camera.eye.z < 0);  // the front is open at z = 0
  const std::vector<Hit> hits = castPicture(box, camera);
  for (const std::string name : {"wall-red", "wall-green", "floor", "ceiling", "wall-back"}) {
    CAPTURE(name);
    CHECK(shareOf(hits, [&](const Hit& hit) { return hit.surface.starts_with(name); }) > 0.02);
  }
}

TEST_CASE("defaultCamera sees a city from above and all of it", "[default_camera]") {
  const Scene scene = sceneOf(city());
  const Camera camera = defaultCamera(scene);
  CHECK(camera.up == glm::dvec3(0, 1, 0));
  CHECK(camera.eye.y > 30);
  const std::vector<Hit> hits = castPicture(scene, camera);
  CHECK(frontShare(hits) > 0.15);
  CHECK(frontShare(hits) == shareOf(hits, [](const Hit& hit) { return !hit.surface.empty(); }));
  for (int i = 0; i < columns; ++i) {  // nothing is cut off
    CHECK(hits[static_cast<std::size_t>(i)].surface.empty());
    CHECK(hits[static_cast<std::size_t>(columns * (rows - 1) + i)].surface.empty());
  }
}

TEST_CASE("defaultCamera takes +z for up where a floor shows it", "[default_camera]") {
  const Camera camera = defaultCamera(zUpwards(city()));
  CHECK(camera.up == glm::dvec3(0, 0, 1));
  CHECK(camera.eye.z > 30);
}

TEST_CASE("upAxis is the given axis, else that of the file, else that of the floor", "[default_camera]") {
  Scene scene = zUpwards(city());
  CHECK(upAxis(scene) == 2);
  CHECK(upAxis(sceneOf(city())) == 1);
  CHECK(upAxis(sceneOf(city()), 2) == 2);
  scene.up = 1;
  CHECK(upAxis(scene) == 1);
  CHECK(upAxis(scene, 2) == 2);
  CHECK(defaultCamera(scene).up == glm::dvec3(0, 1, 0));
}

TEST_CASE("defaultCamera sees a single object from outside, from above if that shows a front", "[default_camera]") {
  const Scene quad = sceneOf({parallelogram("floor", {0, 0, 1}, {1, 0, 0}, {0, 0, -1})});
  CHECK(defaultCamera(quad).eye.y > 0);
  const Scene ceiling = sceneOf({parallelogram("ceiling", {0, 0, 0}, {1, 0, 0}, {0, 0, 1})});
  CHECK(defaultCamera(ceiling).eye.y < 0);
  const Scene wall = sceneOf({parallelogram("wall", {0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
  CHECK(defaultCamera(wall).eye.z > 0);
  const Scene cube = sceneOf(box("cube", {0, 0, 0}, {1, 1, 1}, false));
  const Camera camera = defaultCamera(cube);
  for (int axis = 0; axis < 3; ++axis) CHECK((camera.eye[axis] > 1 || camera.eye[axis] < 0));
  CHECK(camera.eye.y > 1);
}

TEST_CASE("defaultCamera does not follow a triangle that is far from all others", "[camera]") {
  Scene scene = loadScene(HEMITEX_DATA "/pyramid-room.obj");
  const Camera camera = defaultCamera(scene);
  Surface far = scene.surfaces.back();
  far.triangles.resize(1);
  for (glm::dvec3& corner : far.triangles[0].position) corner.x += 1e6;
  scene.surfaces.push_back(far);
  const Camera beside = defaultCamera(scene);
  CHECK(glm::distance(beside.eye, camera.eye) < 1e-9);
  CHECK(glm::distance(beside.lookAt, camera.lookAt) < 1e-9);
}
