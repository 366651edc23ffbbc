/// `hemitex render`: draws pictures of a scene, solved or not. They show its light, item IDs, index maps or projections
/// (Figures 2 and 3 of Nielsen and Christensen 2002).
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/numbers.h"
#include "cli/common/staging.h"
#include "cli/render/solved_folder.h"
#include "cli/scene/camera_options.h"
#include "cli/scene/scene_options.h"
#include "cli/scene/sealed_folder.h"
#include "cli/scene/source_names.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/gather/gathered_picture.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/light/light.h"
#include "radiosity/meshes/length_unit.h"
#include "radiosity/pictures/id_pictures.h"
#include "radiosity/pictures/picture_exposure.h"
#include "radiosity/pictures/pictures.h"
#include "radiosity/projection/projection.h"
#include "radiosity/projection/projection_kinds.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/textures/radiosity_texture.h"
#include "raster/base/input_error.h"
#include "raster/base/lower_case.h"
#include "raster/software/software_renderer.h"

namespace hemitex::cli {
namespace {

using radiosity::Image;

struct RenderOptions;
/// The scene and the camera.
struct Subject {
  radiosity::Scene scene;
  std::optional<SolvedFolder> solved;
  radiosity::Camera camera;
};
/// A function that draws one kind of picture.
using View = Image (*)(const RenderOptions&, const Subject&, Console&);

struct RenderOptions {
  SceneOptions scene;
  radiosity::DiscretizationSettings discretization;
  bool gridsGiven = false;  ///< the user gave texels, which replace the grids of a solved folder
  radiosity::IdSettings id;
  CameraOptions camera;
  View show = nullptr;
  bool gather = false;  ///< the light of pixels is gathered
  bool mesh = false;
  std::string from;
  int resolution = 256;
  std::filesystem::path output;
};

Subject subjectOf(const RenderOptions& options, Console& console) {
  if (options.scene.file.filename() == "scene.obj") requireLitScene(options.scene.file.parent_path());
  radiosity::SceneSettings settings = options.scene.settings;
  settings.sides = radiosity::Sides::One;
  // A lit scene has its backs and its parts already.
  const bool isLit = std::filesystem::exists(options.scene.file.parent_path() / "solution.json");
  Subject subject{isLit ? radiosity::loadScene(options.scene.file, settings) : loadedScene(options.scene), {}, {}};
  subject.solved = SolvedFolder::around(options.scene.file, subject.scene);
  if (subject.solved && options.scene.materials.areGiven())
    throw raster::InputError(options.scene.file.string(), 0, "is a solved scene, whose light cannot change",
                             "solve the scene with --emit, --reflectance or --lights");
  if (!subject.solved) {  // a lit scene has reflectance 1 on purpose
    console.warnings(subject.scene.warnings);
    std::vector<std::string> warnings;
    const double metres = radiosity::statedMetresPerUnit(options.scene.file, warnings).value_or(1);
    subject.scene.squareMetres = metres * metres;
  }
  subject.camera = cameraOf(options.camera, subject.scene, options.scene.file);
  return subject;
}

/// The grids of the solved folder, unless the user gave others.
radiosity::Discretization shownDiscretization(const RenderOptions& options, const Subject& subject) {
  const bool asSolved = subject.solved && !options.gridsGiven;
  return discretizationOf(asSolved ? subject.solved->grids(subject.scene) : options.discretization, subject.scene);
}

double exposureOf(const RenderOptions& options, const SolvedFolder& solved) {
  return options.camera.exposure.value_or(solved.exposure());
}

/// The background of pictures of the light.
glm::dvec3 skyOf(const RenderOptions& options, const SolvedFolder& solved) {
  return radiosity::skyColour(solved.sky(), exposureOf(options, solved));
}

/// The light in display textures, with bilinear interpolation.
Image radiosityView(const RenderOptions& options, const Subject& subject, Console& console) {
  const int width = options.camera.width, height = options.camera.height;
  if (!subject.solved) console.message("the scene is not solved; the picture shows its reflectances");
  if (!subject.solved) return radiosity::unlitPicture(subject.scene, subject.camera, width, height);
  const glm::dvec3 sky = skyOf(options, *subject.solved);
  if (!options.camera.exposure) return radiosity::unlitPicture(subject.scene, subject.camera, width, height, sky);
  radiosity::Scene exposed = subject.scene;
  subject.solved->expose(exposed, *options.camera.exposure);
  return radiosity::unlitPicture(exposed, subject.camera, width, height, sky);
}

/// Solves a scene by default settings, as `hemitex solve` does.
radiosity::Light lightOf(const RenderOptions& options, const Subject& subject, Console& console) {
  requireLight(subject.scene, options.scene.file);
  radiosity::LightHooks hooks;
  hooks.layOut = [&](const radiosity::Discretization& elements) { return layoutOf(options.id, elements); };
  hooks.start = [&](const radiosity::SolverSettings& settings) {
    return radiosity::SolutionStart{{}, [&](const radiosity::Step& step) {
                                      console.progress(std::log(step.residual) / std::log(settings.residual),
                                                       "shot " + std::to_string(step.shots));
                                      return true;
                                    }};
  };
  radiosity::Light light = radiosity::light(subject.scene, discretizationOf(options.discretization, subject.scene),
                                            {.drawing = {.resolution = options.resolution},
                                             .isResidualDefault = true,
                                             .seen = surfacesSeen(options.camera, subject.scene, subject.camera)},
                                            hooks);
  console.endProgress();
  return light;
}

/// The light that pixels gather, from a solved folder or from a scene, which is solved first.
Image gatheredView(const RenderOptions& options, const Subject& subject, Console& console) {
  radiosity::Scene scene = subject.scene;
  radiosity::Light light;
  if (subject.solved) {
    if (options.gridsGiven)
      throw raster::InputError(options.scene.file.string(), 0, "is solved", "leave out the options for texels");
    scene = subject.solved->unlit(std::move(scene));
    light.discretization = discretizationOf(subject.solved->grids(scene), scene);
    light.layout = radiosity::layOut(light.discretization);
    light.solution.radiosity = subject.solved->radiosity(light.discretization);
  } else {
    light = lightOf(options, subject, console);
  }
  const int width = options.camera.width, height = options.camera.height;
  const auto displayed = [&](std::uint32_t element) {
    return radiosity::displayRadiosity(scene, light.discretization, light.solution, element);
  };
  const double exposure = subject.solved ? exposureOf(options, *subject.solved)
                                         : options.camera.exposure.value_or(radiosity::pictureExposure(
                                               scene, light.discretization, displayed, subject.camera, width, height));
  radiosity::GatheredPicture picture = radiosity::gatheredPicture(
      scene, light.discretization, light.layout, light.solution, subject.camera, width, height, exposure,
      scene.outside.sky * exposure, {},
      {.show = [&](double done) { console.progress(done, "gathering"); }, .isCancelled = nullptr});
  console.endProgress();
  console.message(std::to_string(picture.drawn) + " hemicubes gathered the light of " + std::to_string(picture.pixels) +
                  " pixels; between them the rms error is " + percentText(picture.error));
  return std::move(picture.image);
}

/// The light of each element, without filtering (Figure 3).
Image elementView(const RenderOptions& options, const Subject& subject, Console&) {
  if (!subject.solved || options.gridsGiven)
    throw raster::InputError(options.scene.file.string(), 0, "is not a solved scene",
                             "solve it first, then render scene.obj of its folder without options for texels");
  const radiosity::Discretization discretization = shownDiscretization(options, subject);
  const std::vector<glm::dvec3> radiosity = subject.solved->radiosity(discretization);
  const double exposure = exposureOf(options, *subject.solved);
  const auto colours = [&](std::uint32_t element) { return radiosity[element] * exposure; };
  return radiosity::elementPicture(subject.scene, discretization, colours, subject.camera, options.camera.width,
                                   options.camera.height, skyOf(options, *subject.solved));
}

/// Index maps, offsets, or item IDs, which are their sums (Figure 2 (a) to (c)).
template <auto picture>
Image idView(const RenderOptions& options, const Subject& subject, Console& console) {
  const radiosity::Discretization discretization = shownDiscretization(options, subject);
  return picture(subject.scene, discretization, shownLayoutOf(options.id, discretization, console), subject.camera,
                 options.camera.width, options.camera.height);
}

/// Marks pixels where the blend gives the item ID of a wrong element.
Image blendErrorView(const RenderOptions& options, const Subject& subject, Console& console) {
  const radiosity::Discretization discretization = shownDiscretization(options, subject);
  radiosity::BlendErrors errors =
      radiosity::blendErrorPicture(subject.scene, discretization, shownLayoutOf(options.id, discretization, console),
                                   subject.camera, options.camera.width, options.camera.height);
  if (errors.pixels > 0)
    console.warning(
        std::to_string(errors.pixels) +
        " pixels have the item ID of a wrong element, because the blend overflows; align the offsets or use --blend "
        "integer-add");
  return std::move(errors.picture);
}

/// The edges of polygons or of the mesh of elements (Figure 2 (d) and (e)).
Image wireframeView(const RenderOptions& options, const Subject& subject, Console&) {
  const int width = options.camera.width, height = options.camera.height;
  if (!options.mesh) return radiosity::wireframePicture(subject.scene, subject.camera, width, height);
  return radiosity::meshPicture(subject.scene, shownDiscretization(options, subject), subject.camera, width, height);
}

/// The largest index map of the scene, as large as fits the picture (Figure 2 (f)).
Image indexMapView(const RenderOptions& options, const Subject& subject, Console&) {
  const radiosity::Discretization discretization = shownDiscretization(options, subject);
  const auto& largest = *std::max_element(
      discretization.grids.begin(), discretization.grids.end(),
      [](const radiosity::Grid& a, const radiosity::Grid& b) { return a.columns * a.rows < b.columns * b.rows; });
  const int side = std::min(options.camera.width / largest.columns, options.camera.height / largest.rows);
  return radiosity::indexMapImage(largest.columns, largest.rows, std::max(side, 1));
}

/// The first surface with emission in its material, else the first surface.
std::uint32_t firstEmitter(const radiosity::Scene& scene) {
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
    if (emits(scene, s)) return s;
  return 0;
}

/// The projection over an element, or over the first patch of a surface.
template <radiosity::ProjectionKind kind>
Image projectionView(const RenderOptions& options, const Subject& subject, Console& console) {
  const radiosity::Scene& scene = subject.scene;
  const radiosity::Discretization discretization = shownDiscretization(options, subject);
  const radiosity::IdLayout layout = shownLayoutOf(options.id, discretization, console);
  const reference::Source source = options.from.empty() ? reference::Source{{firstEmitter(scene)}}
                                                        : sourceNamed(scene, discretization, options.from);
  const std::uint32_t surface = source.surfaces.front();
  const radiosity::Patch& patch = discretization.patches.list[discretization.grids[surface].firstPatch];
  const radiosity::SurfacePoint point = source.element
                                            ? radiosity::elementCentre(scene, discretization, *source.element)
                                            : radiosity::patchCentre(scene, discretization, patch);
  raster::SoftwareRenderer renderer(radiosity::makeDrawList(scene, discretization, layout));
  radiosity::ProjectedFormFactors rows(scene, discretization, layout, renderer,
                                       {.resolution = options.resolution, .projection = kind});
  const radiosity::View view = rows.viewFrom({.surface = surface, .point = point});
  const std::vector<raster::ItemBuffer> buffers = render(renderer, view.faces, view.skipped);
  return kind == radiosity::ProjectionKind::Hemicube
             ? radiosity::hemicubePicture(layout, view.faces, buffers)
             : radiosity::facesPicture(layout, *view.projection, view.faces, buffers);
}

void render(const RenderOptions& options, Context& context) {
  const Subject subject = subjectOf(options, context.console);
  Staging staging({Output::Kind::File, options.output, "render", context.inputs(subject.scene.files)});
  staging.requirePlaces({options.output.filename()});
  const Image image = options.show(options, subject, context.console);
  radiosity::writePng(staging.file(), image);
  staging.commit();
  if (context.json)
    std::cout << toText({{"width", image.width}, {"height", image.height}, {"warnings", context.console.given()}});
}

}  // namespace

void addRender(Command program, Context& context) {
  const auto options = std::make_shared<RenderOptions>();
  options->show = radiosityView;
  const Command command = program.addCommand("render", "Draw a picture of a scene, of its light or of its item IDs");
  const Command picture = command.under("Picture");
  picture.addOutputFile("-o,--output", options->output, "write the picture into this PNG file").required();
  addChoice<View>(
      picture, "--show", options->show,
      {{"radiosity", radiosityView},
       {"elements", elementView},
       {"ids", idView<radiosity::idPicture>},
       {"index-map", idView<radiosity::indexMapPicture>},
       {"offsets", idView<radiosity::offsetPicture>},
       {"blend-errors", blendErrorView},
       {"wireframe", wireframeView},
       {"hemicube", projectionView<radiosity::ProjectionKind::Hemicube>},
       {"single-plane", projectionView<radiosity::ProjectionKind::SinglePlane>},
       {"tetrahedron", projectionView<radiosity::ProjectionKind::CubicTetrahedron>},
       {"map", indexMapView}},
      "show the light of display textures (radiosity) or of elements; item IDs, their index map or their offsets; "
      "pixels "
      "where the blend overflows (blend-errors); the edges of polygons (wireframe); the faces of a projection; "
      "or the largest index map (map) (default radiosity)");
  addChoice<bool>(picture, "--discretize", options->mesh, {{"texture", false}, {"mesh", true}},
                  "with --show wireframe, draw the edges of polygons, or of the mesh of elements (default texture)");
  picture
      .addFlag("--gather", options->gather,
               "compute the light of each pixel from all that its point sees, as a path tracer does, without noise; a "
               "scene that is not solved is solved first")
      .excludes(picture.option("--show"));
  picture.addText("--from", "SURFACE[:COL,ROW]",
                  "surface or texel under the projection (default: the first surface with emission)", options->from);
  addResolution(picture, options->resolution);
  addCameraOptions(command, options->camera);
  addSceneOptions(command, options->scene);
  addDiscretizationOptions(command, options->discretization);
  addIdOptions(command, options->id);
  command.showFirst({"--output", "--show", "--gather", "--resolution", "--eye", "--look-at", "--fov", "--size",
                     "--exposure", "--texels"});
  command.addExamples(
      {"lit/scene.obj -o picture.png --gather", "data/cornell-box.obj -o hemicube.png --show hemicube --from light"});
  command.onRead([options, command, &context] {
    if (raster::endingOf(options->output) != ".png") usageError("--output", "the name of the picture must end in .png");
    if (options->gather) options->show = gatheredView;
    if (std::filesystem::is_directory(options->scene.file)) options->scene.file /= "scene.obj";
    for (const char* name : {"--texels", "--texel-size", "--surface"}) options->gridsGiven |= command.isGiven(name);
    context.command = [options, &context] { render(*options, context); };
  });
}

}  // namespace hemitex::cli
