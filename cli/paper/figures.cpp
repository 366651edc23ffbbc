#include "cli/paper/figures.h"

#include <algorithm>
#include <cassert>

#include "cli/scene/camera_options.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/index_maps/phantom_indices.h"
#include "radiosity/light/light.h"
#include "radiosity/pictures/id_pictures.h"
#include "radiosity/pictures/picture_exposure.h"
#include "radiosity/pictures/pictures.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/textures/radiosity_texture.h"
#include "reference/measurement/bench/scenes.h"
#include "reference/measurement/paper/tables.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;
using radiosity::Camera;
using radiosity::Discretization;
using radiosity::IdLayout;
using radiosity::Image;
using radiosity::Scene;

constexpr int width = 640, height = 480;

/// Writes pictures and lists them.
class Album {
 public:
  explicit Album(const std::filesystem::path& folder) : folder_(folder) {}

  /// Writes a panel of a figure of the paper, or with figure 0 a picture that the paper does not have.
  void add(int figure, const std::string& panel, const Image& image, const std::string& caption) {
    const std::string file = (figure == 0 ? panel : "figure-" + std::to_string(figure) + panel) + ".png";
    radiosity::writePng(folder_ / file, image);
    list_.push_back({{"figure", figure}, {"panel", panel}, {"file", file}, {"caption", caption}});
  }
  const ordered_json& list() const { return list_; }

 private:
  std::filesystem::path folder_;
  ordered_json list_ = ordered_json::array();
};

/// A scene of the scene folder with its camera.
struct Stage {
  Scene scene;
  Camera camera;
};

Stage stageOf(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path file = folder / (name + ".obj");
  Stage stage{radiosity::loadScene(file), {}};
  CameraOptions options;
  options.width = width;
  options.height = height;
  stage.camera = cameraOf(options, stage.scene, file);
  return stage;
}

/// A solution for display: one radiosity per element, exposed for a camera.
struct Shown {
  Discretization discretization;
  std::vector<glm::dvec3> values;
};

Shown solved(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
             const radiosity::SolverSettings& settings, const Camera& camera) {
  // As in the paper, no patch is split. The test for splits draws each patch once and would take most of the time.
  const radiosity::LightSettings unsplit{.drawing = {.resolution = 128, .split = 1}, .solver = settings};
  const radiosity::LightHooks hooks{.layOut = [&](const Discretization&) { return layout; }};
  const radiosity::Solution solution = radiosity::light(scene, discretization, unsplit, hooks).solution;
  Shown shown{discretization, radiosity::displayRadiosity(scene, discretization, solution)};
  const double exposure =
      radiosity::pictureExposure(scene, discretization, radiosity::valuesIn(shown.values), camera, width, height);
  for (glm::dvec3& value : shown.values) value *= exposure;
  return shown;
}

Image unfiltered(const Scene& scene, const Shown& shown, const Camera& camera) {
  return radiosity::elementPicture(scene, shown.discretization, radiosity::valuesIn(shown.values), camera, width,
                                   height);
}

const reference::PaperLevel& mediumOf(const reference::PaperScene& scene) {
  return *std::find_if(scene.levels.begin(), scene.levels.end(),
                       [](const reference::PaperLevel& level) { return level.name == "medium"; });
}

void addFigure2(Album& album, const Stage& stage) {
  constexpr int mapSide = 8;
  const auto& [scene, camera] = stage;
  // 439 elements, with one index map for all surfaces.
  const Discretization discretization = radiosity::discretize(scene, reference::roomElements(8, 3, 2));
  const IdLayout layout = radiosity::layOut(discretization, {.page = mapSide});
  album.add(2, "a", radiosity::indexMapPicture(scene, discretization, layout, camera, width, height),
            "Index maps on the surfaces. The grey level of a texel is its index.");
  album.add(2, "b", radiosity::offsetPicture(scene, discretization, layout, camera, width, height),
            "The offset of each surface, in one colour per surface.");
  album.add(
      2, "c", radiosity::idPicture(scene, discretization, layout, camera, width, height),
      "Item IDs, which the hemicube draws: the sums of index and offset, (a) + (b). Each element has its own item ID.");
  album.add(2, "d", radiosity::wireframePicture(scene, camera, width, height),
            "The polygons that are drawn: 13 quads for any number of elements.");
  album.add(
      2, "e", radiosity::meshPicture(scene, discretization, camera, width, height),
      "Regular meshing draws the same elements with " + std::to_string(discretization.elements.size()) + " quads.");
  album.add(2, "f", radiosity::indexMapImage(mapSide, mapSide, height / mapSide),
            "The index map of all surfaces, with 8 x 8 texels. A surface with fewer elements uses a part of it.");
}

void addFigure3(Album& album, const std::filesystem::path& sceneFolder, const reference::PaperScene& simple,
                const Camera& camera) {
  const reference::PaperLevel& medium = mediumOf(simple);
  album.add(3, "a",
            unfiltered(simple.scene,
                       solved(simple.scene, medium.discretization, medium.layout, {.residual = 0.01}, camera), camera),
            "The scene of Figure 2 at the medium level: one texel per element, without filtering.");
  const auto addScene = [&](const std::string& panel, const std::string& name, int texels, const std::string& caption) {
    const Stage stage = stageOf(sceneFolder, name);
    const Discretization discretization = radiosity::discretize(stage.scene, {.texels = texels, .patch = 4});
    const Shown shown =
        solved(stage.scene, discretization, radiosity::layOut(discretization), {.residual = 0.01}, stage.camera);
    album.add(3, panel, unfiltered(stage.scene, shown, stage.camera), caption);
  };
  addScene("b", "pyramid-room", 16,
           "Surfaces that are not rectangles: the sides of a pyramid and the floor around it.");
  addScene("c", "curved-room", 24, "A curved surface of 5000 triangles is one surface with one index map.");
}

/// A page of the packed solution: the radiosity of the element of each texel, black for texels without element.
Image packedPage(const Shown& shown, const IdLayout& layout, std::size_t page) {
  const int columns = layout.pages[page].columns, rows = layout.pages[page].rows;
  Image image{columns, rows,
              std::vector<glm::dvec3>(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows))};
  for (std::size_t surface = 0; surface < layout.places.size(); ++surface) {
    const radiosity::RectanglePlace& place = layout.places[surface];
    const radiosity::Grid& grid = shown.discretization.grids[surface];
    if (place.page != static_cast<int>(page)) continue;
    for (int texel = 0; texel < grid.columns * grid.rows; ++texel) {
      if (!grid.covered[static_cast<std::size_t>(texel)]) continue;
      const int column = place.column + texel % grid.columns, row = place.row + texel / grid.columns;
      image.pixels[static_cast<std::size_t>((rows - 1 - row) * columns + column)] =
          shown.values[grid.elementOfTexel[static_cast<std::size_t>(texel)]];
    }
  }
  return image;
}

/// Arranges pictures in rows of four, with grey lines between them.
Image sheetOf(const std::vector<Image>& pages) {
  constexpr int inRow = 4, gap = 4;
  int largest = 0;
  for (const Image& page : pages) largest = std::max({largest, page.width, page.height});
  const int side = largest + gap, rows = (static_cast<int>(pages.size()) + inRow - 1) / inRow;
  Image sheet{inRow * side + gap, rows * side + gap, {}};
  sheet.pixels.assign(static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height), glm::dvec3(0.5));
  for (std::size_t page = 0; page < pages.size(); ++page) {
    const int left = gap + static_cast<int>(page) % inRow * side, top = gap + static_cast<int>(page) / inRow * side;
    for (int row = 0; row < pages[page].height; ++row)
      std::copy_n(pages[page].pixels.begin() + row * pages[page].width, pages[page].width,
                  sheet.pixels.begin() + (top + row) * sheet.width + left);
  }
  return sheet;
}

void addFigure4(Album& album, const reference::PaperScene& complex, const Camera& camera) {
  constexpr int shots = 1000;
  const reference::PaperLevel& medium = mediumOf(complex);
  const Shown shown = solved(complex.scene, medium.discretization, medium.layout, {.shots = shots}, camera);
  album.add(4, "a", unfiltered(complex.scene, shown, camera),
            "The complex scene of 8088 triangles at the medium level, without filtering: a vaulted hall between a "
            "library and a picture gallery.");
  album.add(4, "b", radiosity::idPicture(complex.scene, medium.discretization, medium.layout, camera, width, height),
            "Item IDs, which the hemicube draws. Surfaces of the same page have the same offset and colour.");
  const auto closeUp = [&](const std::string& panel, const glm::dvec3& eye, const glm::dvec3& lookAt, double fov,
                           const std::string& caption) {
    album.add(4, panel, unfiltered(complex.scene, shown, {.eye = eye, .lookAt = lookAt, .fov = fov}), caption);
  };
  closeUp("c", {1.7, 1.5, 4.5}, {-0.2, 0.75, 2.2}, 42, "A table with its lamp, and chairs.");
  closeUp("d", {-4.3, 1.7, 0.3}, {-6.6, 1.35, -2}, 45, "Shelves in which each book is a surface.");
  closeUp("e", {4.6, 1.7, 1.2}, {6.4, 1.5, -5.5}, 50, "The gallery, the portal to the round room, and a vase.");
  std::vector<Image> pages;
  for (std::size_t page = 0; page < medium.layout.pages.size(); ++page)
    pages.push_back(packedPage(shown, medium.layout, page));
  const std::string count = std::to_string(pages.size()), side = std::to_string(pages[0].width);
  album.add(4, "f", sheetOf(pages),
            "The radiosity of all surfaces in " + count + " radiosity textures of " + side + " x " + side +
                " texels. Black texels belong to no surface.");
  for (std::size_t page = 0; page < pages.size(); ++page)
    album.add(4, "f-" + std::to_string(page + 1), pages[page],
              "Texture " + std::to_string(page + 1) + " of " + count + ".");
}

/// Shows the errors of clamped adds for offsets without alignment. Maps of 12 x 12 texels have offsets whose sums with
/// an index exceed 255.
void addWrongAnswers(Album& album, const Stage& stage, const Discretization& discretization) {
  const IdLayout layout = radiosity::layOut(discretization, {.aligned = false});
  const radiosity::BlendErrors errors =
      radiosity::blendErrorPicture(stage.scene, discretization, layout, stage.camera, width, height);
  album.add(
      0, "wrong-answers", errors.picture,
      "Offsets without gaps, added per channel with clamping: " + std::to_string(errors.pixels) + " of " +
          std::to_string(width * height) +
          " pixels, shown in magenta, have the item ID of a wrong element. With aligned offsets or integer adds no "
          "pixel is wrong.");
}

void addPlant(Album& album, const std::filesystem::path& sceneFolder) {
  const Stage stage = stageOf(sceneFolder, "plant");
  const Discretization discretization = radiosity::discretize(stage.scene, {.texelSize = 0.25, .patch = 4});
  const Shown shown =
      solved(stage.scene, discretization, radiosity::layOut(discretization), {.shots = 200}, stage.camera);
  album.add(0, "plant", unfiltered(stage.scene, shown, stage.camera),
            "Plants of 1000 leaves, " + std::to_string(radiosity::triangleCount(stage.scene)) +
                " triangles. Each side of a leaf is a surface with one element, so meshing adds no polygons.");
}

const reference::PaperScene& sceneNamed(const std::vector<reference::PaperScene>& scenes, const std::string& name) {
  const auto found = std::find_if(scenes.begin(), scenes.end(), [&](const auto& scene) { return scene.name == name; });
  assert(found != scenes.end());
  return *found;
}

}  // namespace

ordered_json writePaperFigures(const std::filesystem::path& sceneFolder,
                               const std::vector<reference::PaperScene>& scenes, const std::filesystem::path& folder,
                               const PictureProgress& progress) {
  Album album(folder);
  const Stage room = stageOf(sceneFolder, "paper-room");
  progress("Figure 2");
  addFigure2(album, room);
  progress("Figure 3");
  addFigure3(album, sceneFolder, sceneNamed(scenes, reference::simpleScene), room.camera);
  progress("Figure 4");
  addFigure4(album, sceneNamed(scenes, reference::complexScene), stageOf(sceneFolder, "gallery").camera);
  progress("further pictures");
  addWrongAnswers(album, room, mediumOf(sceneNamed(scenes, reference::simpleScene)).discretization);
  addPlant(album, sceneFolder);
  return album.list();
}

ordered_json phantomsJson(const std::vector<reference::PaperScene>& scenes) {
  ordered_json result = ordered_json::array();
  for (const std::string& name : {reference::simpleScene, reference::complexScene}) {
    const Discretization& discretization = mediumOf(sceneNamed(scenes, name)).discretization;
    for (const radiosity::IndexMapUse& use : radiosity::compareIndexMaps(discretization))
      result.push_back({{"scene", name},
                        {"index_maps", use.name},
                        {"offsets", use.offsets},
                        {"words", use.ids},
                        {"spare_texels", use.phantoms.spareTexels},
                        {"alignment_gaps", use.phantoms.alignmentGaps}});
  }
  return result;
}

}  // namespace hemitex::cli
