// Edits of a scene: their changes, and all else unchanged.
#include "radiosity/scene/scene_edits.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <string>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/edited_discretization.h"
#include "radiosity/scene/contacts.h"
#include "raster/base/input_error.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

std::vector<std::string> namesOf(const std::vector<Surface>& surfaces) {
  std::vector<std::string> names;
  for (const Surface& surface : surfaces) names.push_back(surface.name);
  return names;
}

/// Four squares, two of one family.
Scene squareScene() {
  std::vector<Surface> surfaces;
  for (int s = 0; s < 4; ++s)
    surfaces.push_back(tests::parallelogram("square" + std::to_string(s), {2.0 * s, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  surfaces[1].family = surfaces[2].family = "pair";
  return tests::sceneOf(std::move(surfaces));
}

std::string messageOf(const std::vector<Edit>& edits) {
  try {
    edited(squareScene(), {}, edits);
  } catch (const raster::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("edited with Move shifts the corners of the named surfaces and nothing else", "[scene_edits]") {
  const Scene before = squareScene();
  for (const char* name : {"pair", "pai*"}) {
    const EditedScene edit = edited(before, {}, {{Move{name, {0.5, 0, 0.25}}}});
    CHECK(edit.scene.origin == before.origin);
    CHECK(edit.scene.extent == before.extent);
    for (std::uint32_t s = 0; s < 4; ++s) {
      const bool moves = s == 1 || s == 2;
      CHECK(edit.origins[s].former == s);
      CHECK(edit.origins[s].isMoved == moves);
      const glm::dvec3 shift = moves ? glm::dvec3(0.5, 0, 0.25) : glm::dvec3(0);
      CHECK(edit.scene.surfaces[s].triangles[1].position[2] == before.surfaces[s].triangles[1].position[2] + shift);
      CHECK(edit.scene.surfaces[s].triangles[1].chart == before.surfaces[s].triangles[1].chart);
    }
  }
}

TEST_CASE("edited with Restore appends removed surfaces, and removing them twice is an error", "[scene_edits]") {
  EditedScene edit = edited(squareScene(), {}, {{Remove{"pair"}}});
  CHECK(namesOf(edit.scene.surfaces) == std::vector<std::string>{"square0", "square3"});
  CHECK(edit.origins[1].former == 3U);
  CHECK(namesOf(edit.removed) == std::vector<std::string>{"square1", "square2"});
  CHECK_THROWS_AS(edited(edit.scene, edit.removed, {{Remove{"pair"}}}), raster::InputError);
  edit = edited(edit.scene, edit.removed, {{Restore{"square2"}}});
  CHECK(namesOf(edit.scene.surfaces) == std::vector<std::string>{"square0", "square3", "square2"});
  CHECK_FALSE(edit.origins[2].former);
  CHECK(edit.scene.surfaces[2].triangles[0].position == squareScene().surfaces[2].triangles[0].position);
  CHECK(namesOf(edit.removed) == std::vector<std::string>{"square1"});
}

TEST_CASE("edited removes and restores both sides of a surface, and updates the twin indices of both sides",
          "[scene_edits]") {
  Scene scene = squareScene();
  for (int s = 0; s < 4; ++s) {
    Surface back = scene.surfaces[static_cast<std::size_t>(s)];
    back.name += "/back";
    back.family += "/back";
    back.twin = s;
    scene.surfaces[static_cast<std::size_t>(s)].twin = 4 + s;
    scene.surfaces.push_back(back);
  }
  EditedScene edit = edited(scene, {}, {{Remove{"square0"}, Remove{"pair"}, Restore{"square1"}}});
  CHECK(namesOf(edit.scene.surfaces) == std::vector<std::string>{"square3", "square3/back", "square1", "square1/back"});
  for (const std::vector<Surface>* surfaces : {&edit.scene.surfaces, &edit.removed})
    for (std::size_t s = 0; s < surfaces->size(); ++s) {
      const Surface& twin = (*surfaces)[static_cast<std::size_t>(*(*surfaces)[s].twin)];
      CHECK(*twin.twin == static_cast<int>(s));
      CHECK((twin.name + "/back" == (*surfaces)[s].name || twin.name == (*surfaces)[s].name + "/back"));
    }
}

TEST_CASE("edited with SetEmission or SetReflectance gives a surface its own material", "[scene_edits]") {
  const EditedScene edit =
      edited(squareScene(), {}, {{SetEmission{"pair", {1, 2, 3}}, SetReflectance{"square1", {0.1, 0.2, 0.3}}}});
  const auto materialOf = [&](std::size_t s) {
    return edit.scene.materials[static_cast<std::size_t>(edit.scene.surfaces[s].material)];
  };
  CHECK(materialOf(0).emission == glm::dvec3(0));
  CHECK(materialOf(1).emission == glm::dvec3(1, 2, 3));
  CHECK(materialOf(1).reflectance == glm::dvec3(0.1, 0.2, 0.3));
  CHECK(materialOf(2).emission == glm::dvec3(1, 2, 3));
  CHECK(materialOf(2).reflectance == glm::dvec3(0.5));
  CHECK_FALSE(edit.origins[1].isMoved);
}

TEST_CASE("edited with SetReflectance finds surfaces, then groups and parts, then materials", "[scene_edits]") {
  // Two families of one group, the two parts of a family, and a surface whose name is that of a material.
  std::vector<Surface> surfaces;
  for (const char* name : {"room/oak", "room/pine", "chair#1", "chair#2", "pine", "roomy/oak"})
    surfaces.push_back(tests::parallelogram(name, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  surfaces[2].family = surfaces[3].family = "chair";
  for (const std::size_t s : {1U, 3U}) surfaces[s].material = 1;
  Scene scene = tests::sceneOf(std::move(surfaces));
  scene.materials = {{.name = "oak"}, {.name = "pine"}};
  const auto [name, expected] = GENERATE(table<std::string, std::string>({
      {"room", "110000"},   // the group, but not another with this beginning
      {"room*", "110001"},  // families
      {"room/oak", "100000"},
      {"chair", "001100"},
      {"chair#*", "001100"},  // parts
      {"pine", "000010"},     // the surface, not the material
      {"oak", "101011"},      // the material
      {"o*", "101011"},
      {"*", "111111"},
  }));
  const EditedScene edit = edited(scene, {}, {{SetReflectance{name, glm::dvec3(0.25)}}});
  std::string changed;
  for (const Surface& surface : edit.scene.surfaces)
    changed += edit.scene.materials[static_cast<std::size_t>(surface.material)].reflectance.x == 0.25 ? '1' : '0';
  CAPTURE(name);
  CHECK(changed == expected);
  // The changed copies keep their names, so that a later edit finds them.
  CHECK_NOTHROW(edited(edit.scene, {}, {{SetReflectance{name, glm::dvec3(0.5)}}}));
  CHECK_THROWS_WITH(edited(scene, {}, {{SetReflectance{"oat", glm::dvec3(0)}}}), Catch::Contains("`oak`"));
  CHECK_THROWS_AS(edited(scene, {}, {{Remove{"oak"}}}), raster::InputError);
}

TEST_CASE("edited with Add gives added objects names that are free", "[scene_edits]") {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "more.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\ng square0\nf 1 2 3\ng other\nf 3 2 1\n";
  const EditedScene edit = edited(squareScene(), {}, {{Add{folder.path / "more.obj", {}, {0, 0, 3}}}});
  CHECK(namesOf(edit.scene.surfaces) ==
        std::vector<std::string>{"square0", "square1", "square2", "square3", "square0~2", "other"});
  CHECK(edit.scene.surfaces[4].family == "square0~2");
  CHECK(edit.scene.surfaces[4].triangles[0].position[0].z == 3);
  CHECK_FALSE(edit.origins[4].former);
  CHECK(edit.scene.surfaces[4].material == 1);
}

TEST_CASE("edited throws InputError with advice for invalid edits", "[scene_edits]") {
  CHECK(messageOf({Move{"squar1", glm::dvec3(0)}}).find("`square0`") != std::string::npos);
  CHECK(messageOf({Restore{"square1"}}).find("nothing was removed") != std::string::npos);
  CHECK(messageOf({Move{"square0", glm::dvec3(1e6)}}).find("extents") != std::string::npos);
  CHECK(messageOf({SetReflectance{"square0", glm::dvec3(1)}}).find("below 1") != std::string::npos);
  CHECK(messageOf({SetEmission{"square0", {0, -1, 0}}}).find("below 0") != std::string::npos);
  CHECK(messageOf({SetEmission{"square0", {0, 0, 2e30}}}).find("above 1e30") != std::string::npos);
  CHECK(messageOf({SetEmission{"square0", {0, 0, 1e30}}}).empty());
  CHECK(messageOf({Remove{"square*"}, Remove{"pair"}}).find("nothing of the scene") != std::string::npos);
  CHECK(messageOf({Remove{"square*"}}).empty());
}

TEST_CASE("readAgain finds surfaces that moved as a whole, and takes the materials of the new reading",
          "[scene_edits]") {
  const Scene former = squareScene();
  Scene next = squareScene();
  next.materials = {{.name = "red", .reflectance = {0.8, 0.1, 0.1}}};
  for (Triangle& triangle : next.surfaces[2].triangles)
    for (glm::dvec3& corner : triangle.position) corner += glm::dvec3(0, 0.5, 1);
  next.surfaces[1].triangles[0].texcoord[0] = {0.25, 0.25};
  next.surfaces[3].triangles[0].position[0].x += 1e-9;  // below the rounding of a file
  next.origin = {1, 2, 3};
  const std::optional<EditedScene> edit = readAgain(former, next);
  REQUIRE(edit);
  CHECK(edit->scene.materials[0].name == "red");
  CHECK(edit->scene.origin == former.origin);
  CHECK(edit->scene.extent == former.extent);
  for (std::uint32_t s = 0; s < 4; ++s) {
    CHECK(edit->origins[s].former == s);
    CHECK(edit->origins[s].isMoved == (s == 2));
  }
  CHECK(edit->scene.surfaces[1].triangles[0].texcoord[0] == glm::dvec2(0.25, 0.25));
  CHECK(edit->scene.surfaces[2].triangles[1].position == next.surfaces[2].triangles[1].position);
  CHECK(edit->scene.surfaces[3].triangles[0].position == former.surfaces[3].triangles[0].position);
}

TEST_CASE("readAgain gives nothing for surfaces that came, went, changed their shape or went far", "[scene_edits]") {
  const auto isEdit = [](const auto& change) {
    Scene next = squareScene();
    change(next);
    return readAgain(squareScene(), std::move(next)).has_value();
  };
  CHECK(isEdit([](Scene&) {}));
  CHECK_FALSE(isEdit([](Scene& next) { next.surfaces.pop_back(); }));
  CHECK_FALSE(isEdit([](Scene& next) { next.surfaces[1].triangles.pop_back(); }));
  CHECK_FALSE(isEdit([](Scene& next) { next.surfaces[1].triangles[1].position[1].z += 0.1; }));
  CHECK_FALSE(isEdit([](Scene& next) { next.surfaces[1].triangles[1].chart[1].x += 0.1; }));
  CHECK_FALSE(isEdit([](Scene& next) { next.surfaces[1].name = "other"; }));
  CHECK_FALSE(isEdit([](Scene& next) { std::swap(next.surfaces[0], next.surfaces[1]); }));
  CHECK_FALSE(isEdit([](Scene& next) { next.surfaces[1].twin = 2; }));
  CHECK_FALSE(isEdit([](Scene& next) {
    for (Triangle& triangle : next.surfaces[1].triangles)
      for (glm::dvec3& corner : triangle.position) corner.z += 1000;
  }));
}

TEST_CASE("carried keeps elements, patches and rotations of kept surfaces, and discretizes new ones alone",
          "[scene_edits]") {
  const Scene before = squareScene();
  const DiscretizationSettings settings{.texels = 4, .surfaceTexels = {{"square0", 8}, {"square3", 2}}, .patch = 2};
  const Discretization whole = discretize(before, settings);
  const EditedScene edit = edited(before, {}, {{Remove{"square0"}, Remove{"square3"}, Restore{"square0"}}});
  const Discretization carriedOver = carried(whole, edit, settings);
  REQUIRE(carriedOver.grids.size() == 3);
  const std::vector<std::uint32_t> former = {1, 2, 0};
  for (std::uint32_t s = 0; s < 3; ++s) {
    const Grid& grid = carriedOver.grids[s];
    const Grid& old = whole.grids[former[s]];
    CHECK(grid.columns == old.columns);
    REQUIRE(grid.elementCount == old.elementCount);
    REQUIRE(grid.patchCount == old.patchCount);
    for (std::uint32_t e = 0; e < grid.elementCount; ++e) {
      const Element& element = carriedOver.elements[grid.firstElement + e];
      CHECK(element.surface == s);
      CHECK(element.area == whole.elements[old.firstElement + e].area);
      CHECK(carriedOver.patches.ofElement[grid.firstElement + e] - grid.firstPatch ==
            whole.patches.ofElement[old.firstElement + e] - old.firstPatch);
      CHECK(grid.elementOfTexel[element.texel] == grid.firstElement + e);
    }
    for (std::uint32_t p = 0; p < grid.patchCount; ++p) {
      const Patch& patch = carriedOver.patches.list[grid.firstPatch + p];
      CHECK(patch.surface == s);
      if (s < 2) CHECK(patch.turn == old.firstPatch + p);
      for (const std::uint32_t element : patch.elements)
        CHECK(carriedOver.patches.ofElement[element] == grid.firstPatch + p);
    }
  }
}

TEST_CASE("edited parts no surface from what it covers a part of", "[scene_edits]") {
  Scene scene = squareScene();
  const Surface wall = scene.surfaces[0];
  scene.surfaces[1] = tests::parallelogram("poster", {0.25, 0.25, 0}, {0.5, 0, 0}, {0, 0.5, 0});
  const Contacts contacts = findContacts(scene);
  scene = resolved(std::move(scene), contacts);
  REQUIRE(area(scene.surfaces[0]) == Approx(area(wall) - 0.25));
  for (const Edit& edit : {Edit{Move{"poster", {0, 0, 1}}}, Edit{Move{"square0", {0, 0, 1}}}, Edit{Remove{"poster"}}})
    CHECK_THROWS_WITH(edited(scene, {}, std::vector{edit}),
                      Catch::Contains("`poster` covers a part of `square0`, which would be a hole"));
  CHECK_NOTHROW(edited(scene, {}, std::vector<Edit>{Move{"*", {0, 0, 1}}, Remove{"square3"}}));
}

TEST_CASE("edited parts no added surface from what it covers a part of", "[scene_edits]") {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "more.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 0 0\nv .5 1 0\n"
                                             "g square0\nf 1 2 3 4\ng poster\nf 1 5 6 4\n";
  const Edit add = Add{folder.path / "more.obj", {}, {0, 0, 3}};
  CHECK_NOTHROW(edited(squareScene(), {}, std::vector<Edit>{add, Move{"square0", {0, 0, 1}}}));
  CHECK_THROWS_WITH(edited(squareScene(), {}, std::vector<Edit>{add, Move{"poster", {0, 0, 1}}}),
                    Catch::Contains("`poster` covers a part of `square0~2`"));
}
