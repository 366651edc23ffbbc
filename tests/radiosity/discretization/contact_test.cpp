// Lamps that touch ceilings, walls and frames, as OBJ and glTF, in metres and millimetres, moved and turned: the
// emitted flux is that of the faces that stay visible, whatever the rounding of coordinates.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "data/generate/boxes.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/element_materials.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "tests/support/glb.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using data::Box;
using data::Side;

namespace {

/// All lengths are multiples of 1/256 m, so that binary32 represents them in millimetres and moved by 10 km, too.
constexpr double thick = 5 / 256.0, thin = 1 / 256.0, height = 2.75;
const glm::dvec3 roomSize(4, height, 3.5);
constexpr double strength = 8;

struct Panel {
  std::string name;
  std::vector<Box> lamps, others;
  double visible;                  ///< area of the lamps' faces that are visible, in m^2
  std::vector<Side> without = {};  ///< faces that the lamps lack
};

/// The four boxes around a lamp, from a height to the ceiling; they touch its sides and each other.
std::vector<Box> frame(const Box& lamp, double low) {
  constexpr double width = 1 / 16.0;
  const glm::dvec3 &a = lamp.low, &b = lamp.high;
  return {{{a.x - width, low, a.z - width}, {a.x, height, b.z + width}},
          {{b.x, low, a.z - width}, {b.x + width, height, b.z + width}},
          {{a.x, low, a.z - width}, {b.x, height, a.z}},
          {{a.x, low, b.z}, {b.x, height, b.z + width}}};
}

std::vector<Panel> panels() {
  const Box lamp{{1.25, height - thick, 0.75}, {2.5, height, 1.5}}, low{{1.25, 2, 0.75}, {2.5, 2 + thick, 1.5}};
  constexpr double bottom = 1.25 * 0.75, sides = 4 * thick;
  const Box atWall{{0, height - thick, 0.75}, {1.25, height, 1.5}},
      inCorner{{0, height - thick, 0}, {1.25, height, 0.75}};
  const Box right{{2.5, height - thick, 0.75}, {3.25, height, 1.5}};
  const Box recessed{lamp.low, {2.5, height + thick, 1.5}};
  const Box rod{{1.5, 2 + thick, 1}, {1.53125, height, 1.03125}}, pole{{1.5, 0, 1}, {1.53125, height - thick, 1.03125}};
  constexpr double rodArea = 0.03125 * 0.03125;
  const auto housing = [&](double margin) {
    return Box{{1.25 - margin, 2 + thick, 0.75 - margin}, {2.5 + margin, height, 1.5 + margin}};
  };
  return {{"under the ceiling", {lamp}, {}, bottom + sides},
          {"without its top", {lamp}, {}, bottom + sides, {Side::Top}},
          // Its top is outside the room, where nothing covers it.
          {"halfway in the ceiling", {recessed}, {}, 2 * bottom + sides},
          {"beside a wall", {atWall}, {}, bottom + sides - 0.75 * thick},
          {"in a corner", {inCorner}, {}, bottom + sides / 2},
          {"in a frame that is lower", {lamp}, frame(lamp, height - thick - thin), bottom},
          {"in a frame in its plane", {lamp}, frame(lamp, height - thick), bottom},
          {"in a frame that is higher", {lamp}, frame(lamp, height - thin), bottom + sides * 4 / 5},
          {"beside another lamp", {lamp, right}, {}, bottom + 0.75 * 0.75 + 5.5 * thick},
          {"on a rod", {low}, {rod}, 2 * bottom + sides - rodArea},
          {"on a pole", {lamp}, {pole}, bottom + sides - rodArea},
          {"under a housing of its size", {low}, {housing(0)}, bottom + sides},
          {"under a larger housing", {low}, {housing(0.125)}, bottom + sides},
          {"under a smaller housing", {low}, {housing(-0.125)}, 2 * bottom - 0.5 + sides}};
}

/// A closed room with a panel. The boxes are groups of one or of six faces.
data::Model roomWith(const Panel& panel, bool isOneGroup) {
  data::Model model;
  model.name = "room";
  model.materials = {{"grey", glm::dvec3(0.5), glm::dvec3(0)}, {"light", glm::dvec3(0.25), glm::dvec3(strength)}};
  for (const Side side : {Side::Front, Side::Right, Side::Back, Side::Left, Side::Top, Side::Bottom}) {
    data::Group wall = data::faceGroup("room", "grey", {glm::dvec3(0), roomSize}, side);
    for (data::Polygon& polygon : wall.polygons) std::reverse(polygon.corners.begin(), polygon.corners.end());
    model.groups.push_back(wall);
  }
  const auto add = [&](const std::string& name, const std::string& material, const Box& box,
                       const std::vector<Side>& without) {
    if (isOneGroup) return model.groups.push_back({name, material, data::faces(box, without)});
    for (const data::Group& face : data::faceGroups(name, material, box, without)) model.groups.push_back(face);
  };
  for (std::size_t i = 0; i < panel.lamps.size(); ++i)
    add("lamp" + std::to_string(i), "light", panel.lamps[i], panel.without);
  for (std::size_t i = 0; i < panel.others.size(); ++i) add("box" + std::to_string(i), "grey", panel.others[i], {});
  return model;
}

/// The model in binary glTF, with coordinates rounded to binary32.
tests::Glb glbOf(const data::Model& model) {
  nlohmann::json text{{"asset", {{"version", "2.0"}}}, {"extensionsUsed", {"KHR_materials_emissive_strength"}}};
  std::string bytes;
  std::map<std::string, std::size_t> numbers;
  for (const data::Material& of : model.materials) {
    numbers[of.name] = numbers.size();
    text["materials"].push_back(
        {{"name", of.name},
         {"pbrMetallicRoughness", {{"baseColorFactor", {of.reflectance.r, of.reflectance.g, of.reflectance.b, 1}}}},
         {"emissiveFactor", {1, 1, 1}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", of.emission.r}}}}}});
  }
  for (const data::Group& group : model.groups) {
    std::vector<glm::vec3> corners;
    for (const data::Polygon& polygon : group.polygons)
      for (std::size_t k = 2; k < polygon.corners.size(); ++k)
        for (const std::size_t c : {std::size_t{0}, k - 1, k}) corners.push_back(polygon.corners[c]);
    const std::size_t size = corners.size() * sizeof(glm::vec3), number = text["meshes"].size();
    text["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
    bytes.append(reinterpret_cast<const char*>(corners.data()), size);
    text["accessors"].push_back(
        {{"bufferView", number}, {"componentType", 5126}, {"count", corners.size()}, {"type", "VEC3"}});
    text["meshes"].push_back(
        {{"primitives", {{{"attributes", {{"POSITION", number}}}, {"material", numbers.at(group.material)}}}}});
    text["nodes"].push_back({{"mesh", number}, {"name", group.name}});
    text["scenes"][0]["nodes"].push_back(number);
  }
  text["buffers"].push_back({{"byteLength", bytes.size()}});
  return {text, bytes};
}

/// A way to write the same room, and its unit of length in metres.
struct Variant {
  std::string name;
  std::function<glm::dvec3(const glm::dvec3&)> move;
  double unit = 1;
};

std::vector<Variant> variants() {
  // By 37.3 degrees about an axis that is parallel to no plane of the room.
  const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, 1, 0.55));
  const double cosine = 0.79547, sine = std::sqrt(1 - cosine * cosine);
  const auto turned = [=](const glm::dvec3& p) {
    return cosine * p + sine * glm::cross(axis, p) + (1 - cosine) * glm::dot(axis, p) * axis;
  };
  return {{"in metres", [](const glm::dvec3& p) { return p; }},
          {"in millimetres", [](const glm::dvec3& p) { return 1000.0 * p; }, 0.001},
          {"moved by 10^4", [](const glm::dvec3& p) { return p + glm::dvec3(1e4, 0, 0); }},
          {"turned", turned},
          {"turned in millimetres", [=](const glm::dvec3& p) { return 1000.0 * turned(p); }, 0.001}};
}

Scene loaded(data::Model model, const Variant& variant, bool isGltf) {
  for (data::Group& group : model.groups)
    for (data::Polygon& polygon : group.polygons)
      for (glm::dvec3& corner : polygon.corners) corner = variant.move(corner);
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& bytes) {
    std::ofstream(folder.path / name, std::ios::binary) << bytes;
  };
  if (isGltf) {
    write("room.glb", tests::glbBytes(glbOf(model)));
    return loadScene(folder.path / "room.glb");
  }
  for (const data::File& file : data::files(model)) write(file.name, file.text);
  return loadScene(folder.path / "room.obj");
}

/// Calls check(scene, unit of length in metres) for all ways to write a room.
void forEachVariant(const data::Model& model, const std::function<void(const Scene&, double)>& check) {
  for (const Variant& variant : variants())
    for (const bool isGltf : {false, true}) {
      INFO(variant.name << (isGltf ? ", glTF" : ", OBJ"));
      check(loaded(model, variant, isGltf), variant.unit);
    }
}

}  // namespace

// Turned corners are rounded to 2^-24 of 4 m. That changes areas by less than 1e-6.
TEST_CASE("discretize lets a lamp emit from its visible faces in every file format, unit, place and direction",
          "[contact]") {
  const bool isOneGroup = GENERATE(false, true);
  for (const Panel& panel : panels()) {
    INFO(panel.name << (isOneGroup ? ", one group" : ""));
    forEachVariant(roomWith(panel, isOneGroup), [&](const Scene& scene, double unit) {
      for (const DiscretizationSettings& settings : {DiscretizationSettings{}, DiscretizationSettings{.texels = 5}})
        CHECK(emittedFlux(scene, discretize(scene, settings))[0] * unit * unit ==
              Approx(strength * panel.visible).epsilon(1e-6));
    });
  }
}

// Such a top sees nothing, like the top of a lamp under a ceiling.
TEST_CASE("discretize lets a sheet of two lights emit on both sides", "[contact]") {
  const glm::dvec3 a(0, 0, 0), b(1, 0, 0), c(1, 0, 1), d(0, 0, 1);
  const Box pole{{0.25, -1, 0.25}, {0.5, 0, 0.5}};
  data::Model model;
  model.name = "room";
  model.materials = {{"grey", glm::dvec3(0.5), glm::dvec3(0)}, {"light", glm::dvec3(0.25), glm::dvec3(strength)}};
  model.groups = {{"up", "light", {{{d, c, b, a}}}}, {"down", "light", {{{a, b, c, d}}}}};
  forEachVariant(model, [&](const Scene& scene, double unit) {
    CHECK(emittedFlux(scene, discretize(scene, {.texels = 4}))[0] * unit * unit == Approx(2 * strength).epsilon(1e-6));
  });
  model.groups.push_back(data::boxGroup("pole", "grey", pole));
  forEachVariant(model, [&](const Scene& scene, double unit) {
    CHECK(emittedFlux(scene, discretize(scene, {.texels = 4}))[0] * unit * unit ==
          Approx((2 - 0.0625) * strength).epsilon(1e-6));
  });
}

// The room is closed. So all light is absorbed that is neither unshot, at most a thousandth, nor lost. Rays through
// cracks between pixels lose less than another thousandth.
TEST_CASE("solve lets a room absorb the flux of a lamp in every file format, unit, place and direction", "[contact]") {
  for (const Panel& panel : panels()) {
    if (panel.name != "under the ceiling" && panel.name != "in a frame that is higher") continue;
    INFO(panel.name);
    forEachVariant(roomWith(panel, true), [&](const Scene& scene, double unit) {
      const Discretization discretization = discretize(scene, {.texels = 4});
      SceneFormFactors drawn(scene, discretization, layOut(discretization), {.resolution = 64});
      const Solution solution = solve({.scene = scene,
                                       .discretization = discretization,
                                       .patches = discretization.patches,
                                       .rowOf = drawn.rowOf()});
      CHECK(solution.energy.absorbed[0] * unit * unit == Approx(strength * panel.visible).epsilon(2e-3));
    });
  }
}

// Without this, binary32 coordinates far from the origin would open gaps: at 1000 m they are off by 3e-5 m.
TEST_CASE("contactTolerance follows the rounding of binary32 coordinates far from the origin", "[contact]") {
  const Variant far{"far",
                    [turned = variants()[3].move](const glm::dvec3& p) { return turned(p) + glm::dvec3(1000, 0, 0); }};
  for (const Panel& panel : panels()) {
    INFO(panel.name);
    const data::Model model = roomWith(panel, false);
    const Scene asObj = loaded(model, far, false), asGltf = loaded(model, far, true);
    CHECK(contactTolerance(asObj) == 0x1p-21 * asObj.extent);
    CHECK(contactTolerance(asGltf) == 8 * 0x1p-15);
    CHECK(emittedFlux(asObj, discretize(asObj, {}))[0] == Approx(strength * panel.visible).epsilon(1e-6));
    // Half a unit in the last place, along edges of the lamp's visible faces.
    CHECK(emittedFlux(asGltf, discretize(asGltf, {}))[0] == Approx(strength * panel.visible).epsilon(1e-3));
  }
}
