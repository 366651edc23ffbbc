#include "reference/conformance/scenes/scene_vectors.h"

#include <string>
#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/projection/patch_view.h"
#include "radiosity/projection/projection.h"
#include "radiosity/projection/projection_kinds.h"
#include "radiosity/scene/load_scene.h"
#include "reference/conformance/suite/vector_suite.h"

namespace hemitex::reference {
namespace {

/// An eye that looks along `normal`, and the item ID format of the scene.
struct View {
  std::string name;
  glm::dvec3 eye, normal, up;
  std::string format;
  raster::Blend blend;
  bool aligned;
};

TestVector hemicube(const radiosity::Scene& scene, const radiosity::Discretization& discretization, const View& view) {
  constexpr int resolution = 64;
  const double near =
      radiosity::nearDistance(scene, radiosity::triangleBoxes(scene), view.eye, {}, radiosity::hemicubeSquaredReach);
  TestVector vector =
      makeVector("scene-" + view.name,
                 "whatever goes wrong in a whole hemicube: " + view.format + (view.aligned ? "" : ", unaligned"),
                 radiosity::makeDrawList(scene, discretization,
                                         radiosity::layOut(discretization, {view.format, view.blend, view.aligned})),
                 radiosity::facesOver(radiosity::hemicubeFaces(resolution), view.eye - scene.origin,
                                      glm::normalize(view.normal), view.up, near),
                 {"top", "side-right", "side-up", "side-left", "side-down"});
  vector.origin = scene.origin;
  return vector;
}

}  // namespace

std::vector<TestVector> sceneVectors(const std::filesystem::path& data) {
  constexpr auto clamped = raster::Blend::ClampedAdd;
  constexpr auto integer = raster::Blend::IntegerAdd;
  std::vector<TestVector> vectors;

  const radiosity::Scene box = radiosity::loadScene(data / "cornell-box.obj");
  const radiosity::Discretization boxElements = radiosity::discretize(box, {.texels = 16});
  for (const View& view :
       {View{"cornell-box-light", {278, 548, 279}, {0, -1, 0}, {1, 0, 0}, "r8g8b8a8", clamped, true},
        View{"cornell-box-short-block", {185, 166, 169}, {0, 1, 0}, {3, 0, 1}, "r10g10b10a2", clamped, true},
        View{"cornell-box-tilted", {420, 90, 120}, {-2, 1, 3}, {0, 1, 0}, "r32ui", integer, false}})
    vectors.push_back(hemicube(box, boxElements, view));

  // The medium level of the paper's tables.
  const radiosity::Scene room = radiosity::loadScene(data / "paper-room.obj");
  radiosity::DiscretizationSettings medium{.texels = 12, .surfaceTexels = {{"light", 1}}};
  for (const char* side : {"top", "bottom", "front", "right", "back", "left"})
    medium.surfaceTexels["box-" + std::string(side)] = 4;
  const radiosity::Discretization roomElements = radiosity::discretize(room, medium);
  for (const View& view :
       {View{"paper-room-floor", {-1.6, 0.02, 1.3}, {0, 1, 0}, {0, 0, -1}, "r8g8b8", clamped, true},
        View{"paper-room-tilted", {0.2, 2.5, -0.9}, {-1, -3, 2}, {1, 2, 0}, "r8g8b8", integer, false},
        View{"paper-room-wall", {1.98, 1.7, -0.4}, {-1, 0, 0}, {0, 1, 0}, "r8g8b8a8", clamped, true}})
    vectors.push_back(hemicube(room, roomElements, view));
  return vectors;
}

std::vector<TestVector> wholeSuite(const std::filesystem::path& data) {
  std::vector<TestVector> suite = vectorSuite();
  for (TestVector& vector : sceneVectors(data)) suite.push_back(std::move(vector));
  return suite;
}

}  // namespace hemitex::reference
