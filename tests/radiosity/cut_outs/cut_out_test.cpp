/// Cut-outs: a surface with holes is lit, shades and is seen as the polygon that the holes leave.
#include "radiosity/images/cut_out.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/images/hole_colours.h"
#include "radiosity/index_maps/meshed_draws.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/light/light.h"
#include "radiosity/pictures/visibility.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/ray_tree.h"
#include "radiosity/scene/scene_edits.h"
#include "radiosity/textures/lit_scene.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/truth/rays/embree_form_factors.h"
#include "reference/truth/rays/ray_caster.h"
#include "tests/support/base64.h"
#include "tests/support/glb.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

constexpr int side = 512;
using IsOpaque = std::function<bool(double u, double v)>;

bool isInRectangle(double u, double v) { return u > 0.25 && u < 0.75 && v > 0.375 && v < 0.875; }
bool isInTriangle(double u, double v) { return v < u; }

/// A leaf over a floor, below a lamp; all are opaque from both sides, the leaf looks up.
std::string objOf(const std::string& leaf) {
  return "mtllib m.mtl\nv -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nv -.5 -.5 3\nv .5 -.5 3\nv .5 .5 3\nv -.5 .5 3\n"
         "g floor\nusemtl paint\nf 1 2 3 4\ng lamp\nusemtl lamp\nf 8 7 6 5\n" +
         leaf;
}

const std::string materials = "newmtl paint\nKd .5\nnewmtl lamp\nKd 0\nKe 10\nnewmtl leaf\nKd .4\n";

/// `more` stands in the material of the leaf.
Scene load(const std::string& leaf, const IsOpaque& isOpaque = {}, const SceneSettings& settings = {},
           const std::string& more = {}) {
  const TemporaryFolder folder;
  raster::writeFile(folder.path / "a.obj", objOf(leaf));
  raster::writeFile(folder.path / "m.mtl", materials + (isOpaque ? "map_d leaf.png\n" : "") + more);
  CodedImage image{side, side, std::vector<std::uint8_t>(3 * side * side, 255)};
  for (int row = 0; isOpaque && row < side; ++row)
    for (int column = 0; column < side; ++column)
      image.isHole.push_back(!isOpaque((column + 0.5) / side, 1 - (row + 0.5) / side));
  for (std::size_t pixel = 0; pixel < image.isHole.size(); ++pixel)  // green where it is opaque, white elsewhere
    for (const std::size_t band : {0U, 2U}) image.codes[3 * pixel + band] = image.isHole[pixel] ? 255 : 0;
  const std::vector<unsigned char> png = encodePng(image, "leaf.png");
  raster::writeFile(folder.path / "leaf.png", {reinterpret_cast<const char*>(png.data()), png.size()});
  return loadScene(folder.path / "a.obj", settings);
}

/// The leaf covers [-1, 1]^2 at height 1; its image lies over it once.
Scene cutLeaf(const IsOpaque& isOpaque, const SceneSettings& settings = {}, const std::string& more = {}) {
  return load(
      "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
      "g leaf\nusemtl leaf\nf 9/1 10/2 11/3 12/4\n",
      isOpaque, settings, more);
}
Scene rectangleLeaf() {
  return load("v -.5 -.25 1\nv .5 -.25 1\nv .5 .75 1\nv -.5 .75 1\ng leaf\nusemtl leaf\nf 9 10 11 12\n");
}
Scene triangleLeaf() { return load("v -1 -1 1\nv 1 -1 1\nv 1 1 1\ng leaf\nusemtl leaf\nf 9 10 11\n"); }

double areaOf(const Discretization& discretization, std::uint32_t surface) {
  double sum = 0;
  for (const Element& element : discretization.elements) sum += element.surface == surface ? element.area : 0;
  return sum;
}

/// The flux that leaves each surface.
std::vector<double> fluxes(const Scene& scene, const IdSettings& ids = {}, ElementsBy by = ElementsBy::Texture) {
  LightSettings settings{.drawing = {.resolution = 256}, .solver = {.residual = 1e-4}};
  settings.drawing.elementsBy = by;
  const LightHooks hooks{.layOut = [ids](const Discretization& of) { return layOut(of, ids); }};
  const Light lit = light(scene, discretize(scene, {.texels = 8}), settings, hooks);
  std::vector<double> flux(scene.surfaces.size());
  for (std::uint32_t e = 0; e < lit.discretization.elements.size(); ++e)
    flux[lit.discretization.elements[e].surface] += lit.discretization.elements[e].area * lit.solution.radiosity[e].r;
  return flux;
}

}  // namespace

TEST_CASE("a cut-out has the area of what its holes leave, by elements as coarse as elsewhere", "[cutout]") {
  const Scene rectangle = cutLeaf(isInRectangle), triangle = cutLeaf(isInTriangle);
  for (const int texels : {1, 3, 8, 16}) {
    const Discretization discretization = discretize(rectangle, {.texels = texels});
    const double exact = (texels & (texels - 1)) == 0 ? 1e-12 : 0.005;
    CHECK(areaOf(discretization, 2) == Approx(1).epsilon(exact));
    for (const Element& element : discretization.elements) CHECK(element.area > 0);
    CHECK(discretization.grids[2].columns == texels);
    CHECK(discretization.grids[2].mask->columns % texels == 0);
  }
  CHECK(areaOf(discretize(triangle, {.texels = 8}), 2) == Approx(2).epsilon(0.005));
  CHECK(areaOf(discretize(rectangle, {.texels = 8}), 0) == Approx(16).epsilon(1e-12));
}

TEST_CASE("light and shadow of a cut-out are those of the polygon within 0.5 %", "[cutout]") {
  for (const auto& [cut, polygon] :
       {std::pair(cutLeaf(isInRectangle), rectangleLeaf()), std::pair(cutLeaf(isInTriangle), triangleLeaf())}) {
    const std::vector<double> truth = fluxes(polygon), open = fluxes(cutLeaf([](double, double) { return false; }));
    for (const IndexMaps maps : {IndexMaps::Shared, IndexMaps::Packed, IndexMaps::Unique}) {
      const std::vector<double> found = fluxes(cut, {.indexMaps = maps});
      CHECK(open[0] - found[0] == Approx(open[0] - truth[0]).epsilon(0.005));  // the shadow
      CHECK(found[2] == Approx(truth[2]).epsilon(0.005));
    }
    CHECK(open[2] == 0);
    CHECK(fluxes(cut, {}, ElementsBy::Mesh)[2] == Approx(truth[2]).epsilon(0.005));
  }
}

TEST_CASE("rays pass through the holes of a cut-out", "[cutout]") {
  const Scene cut = cutLeaf(isInRectangle), polygon = rectangleLeaf();
  const RayTree rays(cut), truth(polygon);
  const reference::RayCaster caster(cut), trueCaster(polygon);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  int leaves = 0;
  for (int k = 0; k < 5000; ++k) {
    const glm::dvec3 from(4 * place(random), 4 * place(random), 0.1 + 2.5 * (k % 2)),
        way(place(random), place(random), k % 2 == 0 ? 1 : -1);
    const auto hit = rays.firstHit(from, way), right = truth.firstHit(from, way);
    REQUIRE(hit.has_value() == right.has_value());
    if (hit) CHECK((hit->surface == right->surface && std::abs(hit->distance - right->distance) < 1e-12));
    if (hit && hit->surface == 2) ++leaves;
    CHECK(rays.isBlocked(from, way, 2) == truth.isBlocked(from, way, 2));
    const reference::Ray ray{(from - cut.origin) / cut.extent, glm::normalize(way), ~0U};
    const auto met = caster.firstHit(ray), rightMet = trueCaster.firstHit(ray);
    REQUIRE(met.has_value() == rightMet.has_value());
    if (met) CHECK(met->triangle / 2 == rightMet->triangle / 2);
  }
  CHECK(leaves > 300);
}

TEST_CASE("a row by rays through the holes of a cut-out is that of the polygon", "[cutout]") {
  // From the floor the leaf is a back. The same rays start in both scenes; few pass an edge where they differ.
  const auto rowOf = [](const Scene& scene) {
    const Discretization discretization = discretize(scene, {.texels = 1});
    reference::RayRows rows(scene, discretization, {.rays = 1 << 16, .start = reference::RayStart::Area});
    return rows.ofPatch(discretization.patches.list.front());
  };
  const FormFactorRow found = rowOf(cutLeaf(isInRectangle)), truth = rowOf(rectangleLeaf());
  CHECK(formFactor(truth.back) > 0.03);
  CHECK(formFactor(found.back) == Approx(formFactor(truth.back)).epsilon(0.005));
  CHECK(formFactor(found.background) == Approx(formFactor(truth.background)).epsilon(0.005));
}

TEST_CASE("a camera sees through the holes of a cut-out, also in the lit scene that is read again", "[cutout]") {
  const Scene cut = cutLeaf(isInRectangle), polygon = rectangleLeaf();
  const Camera camera{.eye = {0.3, -4, 4}, .lookAt = {0, 0, 0}, .up = {0, 0, 1}, .fov = 50};
  const auto shown = [&](const Scene& scene) {
    std::vector<std::uint32_t> surfaces;
    for (const auto& sample : visibleSamples(scene, camera, 120, 90)) surfaces.push_back(sample ? sample->surface : 9);
    return surfaces;
  };
  CHECK(shown(cut) == shown(polygon));

  const Discretization discretization = discretize(cut, {.texels = 8});
  const TextureLayout layout = layOutTextures(cut, discretization, {});
  const std::vector<glm::dvec3> grey(discretization.elements.size(), glm::dvec3(0.5));
  const LitScene lit = makeLitScene(cut, discretization, layout, grey, 1, TextureFilter::Bilinear);
  CHECK(shown(lit.scene) == shown(polygon));
  const TemporaryFolder folder;
  const std::vector<Image> linear(layout.textures.size(), Image{1, 1, {glm::dvec3(0)}});
  writeLitScene(folder.path, lit, {.camera = camera}, linear);
  CHECK(shown(loadScene(folder.path / "scene.obj")) == shown(polygon));
  const Scene glb = loadScene(folder.path / "scene.glb");
  CHECK(shown(glb) == shown(polygon));
  const auto json = tests::parseGlb(raster::readFile(folder.path / "scene.glb")).description;
  CHECK(json["materials"][2]["alphaMode"] == "MASK");
  CHECK(!json["materials"][0].contains("alphaMode"));
}

TEST_CASE("a leaf that is green where it is opaque and white in its holes is green", "[cutout]") {
  const auto isRound = [](double u, double v) { return std::hypot(u - 0.45, v - 0.52) < 0.37; };
  const Scene scene = cutLeaf(isRound, {}, "map_Kd leaf.png\nKe 1 1 1\nmap_Ke leaf.png\n");
  for (const int texels : {1, 3, 7, 16}) {
    const Discretization discretization = discretize(scene, {.texels = texels});
    const Grid& grid = discretization.grids[2];
    std::vector<glm::dvec3> shown(discretization.elements.size(), glm::dvec3(0.3));
    for (const std::uint32_t e : elementsOf(grid)) {
      CHECK(glm::distance(reflectance(scene, discretization, e), glm::dvec3(0, 0.4, 0)) < 1e-12);
      CHECK(glm::distance(emission(scene, discretization, e), glm::dvec3(0, 1, 0)) < 1e-12);
      shown[e] = {0, 0.3, 0};
    }
    const TextureLayout layout = layOutTextures(scene, discretization, {});
    const LitScene lit = makeLitScene(scene, discretization, layout, shown, 1, TextureFilter::Bilinear);
    const CodedImage& texture = lit.textures[static_cast<std::size_t>(layout.places[2].texture)];
    REQUIRE_FALSE(texture.isHole.empty());
    std::size_t others = 0;
    for (std::size_t pixel = 0; pixel < texture.isHole.size(); ++pixel)
      if (texture.codes[3 * pixel] != 0 || texture.codes[3 * pixel + 1] == 0) ++others;
    CHECK(others == 0);
  }
}

TEST_CASE("cards share their mask and their means, however they are divided and turned", "[cutout]") {
  const auto isRound = [](double u, double v) { return std::hypot(u - 0.45, v - 0.52) < 0.37; };
  const std::string card =
      "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt .4 .3\nv -.2 -.4 1\n"
      "g leaf\nusemtl leaf\nf 9/1 10/2 11/3 12/4\n";
  const std::string divided =
      "v .3 -.6 3\nv 1.5 -.6 3\nv 1.5 .6 3.2\nv .3 .6 3.2\nv .78 -.24 3.06\ng other\nusemtl leaf\n"
      "f 14/1 15/2 18/5\nf 15/2 16/3 18/5\nf 16/3 17/4 18/5\nf 17/4 14/1 18/5\n";
  const Scene scene = load(card + divided, isRound, {}, "map_Kd leaf.png\n");
  REQUIRE((scene.surfaces.size() == 4 && scene.surfaces[3].triangles.size() == 4));
  for (const int texels : {1, 3, 8}) {
    const Discretization discretization = discretize(scene, {.texels = texels});
    const Grid &whole = discretization.grids[2], &parts = discretization.grids[3];
    CHECK(whole.mask == parts.mask);
    REQUIRE(whole.elementCount == parts.elementCount);
    for (std::uint32_t i = 0; i < whole.elementCount; ++i)
      CHECK(reflectance(scene, discretization, whole.firstElement + i) ==
            reflectance(scene, discretization, parts.firstElement + i));
  }
}

TEST_CASE("fillHoles gives holes the colour beside them, also those of a finer and of a coarser cut-out", "[cutout]") {
  const glm::dvec3 red(1, 0, 0), green(0, 1, 0), white(1);
  Image image{4, 1, {white, red, green, white}};
  fillHoles(image, {4, 1, {true, false, false, true}});
  CHECK(image.pixels == std::vector<glm::dvec3>{red, red, green, green});
  image.pixels = {white, white, green, red};
  fillHoles(image, {2, 1, {true, false}});
  CHECK(image.pixels == std::vector<glm::dvec3>{green, green, green, red});
  image = {2, 1, {white, red}};
  fillHoles(image, {4, 2, {true, true, false, true, true, true, true, true}});
  CHECK(image.pixels == std::vector<glm::dvec3>{red, red});
  fillHoles(image, {2, 1, {true, true}});
  CHECK(image.pixels == std::vector<glm::dvec3>{red, red});
}

TEST_CASE("a map without a cut-out keeps the colours in the holes that another material cuts", "[cutout]") {
  const Scene scene = cutLeaf(isInRectangle, {}, "map_Kd leaf.png\nnewmtl paint2\nmap_Kd leaf.png\n");
  REQUIRE(scene.images.size() == 1);  // paint2 is not used
  const Scene both = load(
      "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
      "g leaf\nusemtl leaf\nf 9/1 10/2 11/3 12/4\nv 5 -1 1\nv 7 -1 1\nv 7 1 1\ng whole\nusemtl whole\n"
      "f 13/1 14/2 15/3\n",
      isInRectangle, {}, "map_Kd leaf.png\nnewmtl whole\nmap_Kd leaf.png\n");
  REQUIRE(both.images.size() == 2);
  for (const Surface& surface : both.surfaces) {
    const Material& material = both.materials[static_cast<std::size_t>(surface.material)];
    if (!material.reflectanceMap) continue;
    const Image& image = both.images[static_cast<std::size_t>(*material.reflectanceMap)];
    CHECK(image.pixels.front() == (material.cutOut ? glm::dvec3(0, 1, 0) : glm::dvec3(1)));
  }
}

TEST_CASE("glTF's MASK is a cut-out, whose alpha is that of the texture times the factor", "[cutout]") {
  const TemporaryFolder folder;
  const std::vector<unsigned char> png =
      encodePng({2, 1, {255, 255, 255, 255, 255, 255}, {}, {true, false}}, "leaf.png");
  raster::writeFile(folder.path / "leaf.png", {reinterpret_cast<const char*>(png.data()), png.size()});
  const std::vector<float> values{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 1, 1, 1, 1, 0, 0, 0};
  std::string bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  bytes += std::string("\0\1\2\0\2\3", 6);
  auto text = nlohmann::json::parse(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "images": [{"uri": "leaf.png"}], "textures": [{"source": 0}],
    "materials": [{"alphaMode": "MASK", "doubleSided": true,
                   "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 1, 1, 0.75]}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 32},
                    {"buffer": 0, "byteOffset": 80, "byteLength": 6}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
                  {"bufferView": 2, "componentType": 5121, "count": 6, "type": "SCALAR"}]})");
  text["buffers"] = {{{"byteLength", 86}, {"uri", "data:application/octet-stream;base64," + tests::base64(bytes)}}};
  for (const auto& [cutoff, opaque] : {std::pair(0.5, 0.5), std::pair(0.8, 0.0)}) {
    text["materials"][0]["alphaCutoff"] = cutoff;
    raster::writeFile(folder.path / "a.gltf", text.dump());
    const Scene scene = loadScene(folder.path / "a.gltf");
    REQUIRE(scene.surfaces.size() == 2);  // both sides
    CHECK(scene.surfaces[1].twin == 0);
    const RayTree rays(scene);
    CHECK(rays.firstHit({0.25, 0.4, 1}, {0, 0, -1}).has_value() == false);
    CHECK(rays.firstHit({0.75, 0.4, 1}, {0, 0, -1}).has_value() == (opaque > 0));
    CHECK(rays.firstHit({0.75, 0.4, -1}, {0, 0, 1}).has_value() == (opaque > 0));
    for (const std::uint32_t s : {0U, 1U})
      if (opaque > 0) CHECK(areaOf(discretize(scene, {.texels = 4}), s) == Approx(opaque));
  }
}

TEST_CASE("a surface that is all holes is not there, and a hole reaches to the edge of its pixels", "[cutout]") {
  const Scene clear = cutLeaf([](double, double) { return false; });
  const RayTree rays(clear);
  CHECK(rays.firstHit({0.2, 0.1, 2}, {0, 0, -1})->surface == 0);
  CHECK(discretize(clear, {.texels = 4}).grids[2].isDark);
  const CutOut cutOut{2, 2, {true, false, false, false}};
  CHECK(isHoleAt(cutOut, {0.499, 0.501}));
  CHECK_FALSE(isHoleAt(cutOut, {0.501, 0.501}));
  CHECK_FALSE(isHoleAt(cutOut, {0.499, 0.499}));
  CHECK(isHoleAt(cutOut, {1.2, -0.3}));  // it repeats
}

TEST_CASE("a cut-out is in contact with nothing, encloses nothing, and facets refuse it", "[cutout]") {
  CHECK_THROWS_WITH(cutLeaf(isInRectangle, {.facets = true}), Catch::Contains("facets have no holes"));
  CHECK(cutLeaf(isInRectangle, {.sides = Sides::Two}).surfaces[2].twin.has_value());
  const Scene onFloor = load(
      "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
      "g leaf\nusemtl leaf\nf 9/1 10/2 11/3 12/4\n",
      isInRectangle);
  CHECK(onFloor.covered.empty());
  CHECK(area(onFloor.surfaces[0]) == Approx(16));
  REQUIRE(onFloor.warnings.size() == 1);
  CHECK_THAT(onFloor.warnings[0], Catch::Contains("cut-out `leaf` lies in the place of `floor`"));
  const Scene one = cutLeaf(isInRectangle);
  CHECK(readAgain(one, cutLeaf(isInRectangle)));
  CHECK_FALSE(readAgain(one, cutLeaf(isInTriangle)));
}
