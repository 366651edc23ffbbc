#include "python/bindings/pictures.h"

#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "python/bindings/arrays.h"
#include "python/bindings/light.h"
#include "python/bindings/scenes.h"
#include "python/bindings/settings.h"
#include "radiosity/gather/final_gather.h"
#include "radiosity/images/image.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/pictures/id_pictures.h"
#include "radiosity/pictures/picture_exposure.h"
#include "radiosity/pictures/pictures.h"
#include "radiosity/textures/lit_scene.h"
#include "radiosity/textures/radiosity_texture.h"
#include "raster/base/input_error.h"

namespace hemitex::python {
namespace {

using radiosity::Camera;
using radiosity::Image;
using raster::InputError;

struct Size {
  int width = 800, height = 600;
};

Size sizeOf(const Settings& settings) {
  Size size;
  assign(size.width, settings.integer("width", 1, 2048));
  assign(size.height, settings.integer("height", 1, 2048));
  return size;
}

/// The sRGB codes of a picture, (height, width, 3), the top row first.
py::object toPixels(const Image& image) {
  radiosity::CodedImage coded = radiosity::encodeSrgb(image);
  return toArray(std::move(coded.codes), {coded.height, coded.width, 3});
}

/// The display textures of a solution, whose texels gather their light.
radiosity::LitScene gatheredScene(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                                  const radiosity::Solution& solution, double exposure) {
  const radiosity::TextureLayout layout =
      radiosity::layOutTextures(scene, discretization, {{}, radiosity::maxGatheredTexels});
  const radiosity::GatheredLight light =
      *radiosity::gather(scene, discretization, radiosity::layOut(discretization), layout, solution);
  return radiosity::makeLitScene(
      scene, discretization, layout,
      radiosity::codedTextures(radiosity::radiosityTextures(scene, discretization, layout, light), exposure));
}

/// The picture that `hemitex solve` writes as render.png: display textures, in front of the sky.
py::tuple litPicture(const Solved& solved, const py::dict& seenFrom, const py::dict& given) {
  using radiosity::TextureFilter;
  const Settings settings(given);
  const SharedElements elements = solved.elements;
  const SharedSolution solution = solved.solution;
  const Camera camera = cameraOf(seenFrom);
  const Size size = sizeOf(settings);
  const auto exposed = settings.number("exposure", std::numeric_limits<double>::min(), 1e300);
  const std::optional<TextureFilter> filter =
      settings.choice<TextureFilter>("filter", {{"none", TextureFilter::OneToOne},
                                                {"triangle", TextureFilter::Triangle},
                                                {"bilinear", TextureFilter::Bilinear},
                                                {"bicubic", TextureFilter::Bicubic}});
  const bool gathers = settings.flag("gather").value_or(false);
  if (gathers && filter) throw InputError("gathered light is not filtered", "leave out `filter`");
  double exposure = 1;
  Image image;
  unlocked([&] {
    const radiosity::Scene& scene = *elements->scene;
    const radiosity::Discretization& discretization = elements->discretization;
    const std::vector<glm::dvec3> displayed = radiosity::displayRadiosity(scene, discretization, *solution);
    exposure = exposed ? *exposed
                       : radiosity::pictureExposure(scene, discretization, radiosity::valuesIn(displayed), camera,
                                                    size.width, size.height);
    const glm::dvec3 sky = radiosity::skyColour(scene.outside.sky, exposure);
    if (gathers) {
      const radiosity::LitScene lit = gatheredScene(scene, discretization, *solution, exposure);
      image = radiosity::unlitPicture(lit, camera, size.width, size.height, sky);
    } else if (filter == TextureFilter::OneToOne) {
      const auto colours = [&](std::uint32_t element) { return displayed[element] * exposure; };
      image = radiosity::elementPicture(scene, discretization, colours, camera, size.width, size.height, sky);
    } else {
      const radiosity::LitScene lit =
          radiosity::makeLitScene(scene, discretization, radiosity::layOutTextures(scene, discretization, {}),
                                  radiosity::displayValues(scene, discretization, *solution), exposure,
                                  filter.value_or(TextureFilter::Bicubic));
      image = radiosity::unlitPicture(lit, camera, size.width, size.height, sky);
    }
  });
  return py::make_tuple(toPixels(image), exposure);
}

/// The picture of linear colours of elements, without filtering.
py::object valuePicture(const SharedElements& elements, const py::object& values, const py::dict& seenFrom,
                        const py::dict& given) {
  const auto count = static_cast<py::ssize_t>(elements->discretization.elements.size());
  const std::vector<glm::dvec3> colours = vectorsOf(numbers(values, "values", {count, 3}));
  const Camera camera = cameraOf(seenFrom);
  const Size size = sizeOf(Settings(given));
  return toPixels(unlocked([&] {
    return radiosity::elementPicture(*elements->scene, elements->discretization, radiosity::valuesIn(colours), camera,
                                     size.width, size.height);
  }));
}

/// A picture of what is drawn: edges, item IDs, index maps or offsets.
py::object structurePicture(const SharedElements& elements, const py::object& show, const py::dict& seenFrom,
                            const py::dict& given) {
  enum class Show { Wireframe, Mesh, Ids, IndexMap, Offsets };
  py::dict named;
  named["show"] = show;
  const Show what = Settings(named)
                        .choice<Show>("show", {{"wireframe", Show::Wireframe},
                                               {"mesh", Show::Mesh},
                                               {"ids", Show::Ids},
                                               {"index-map", Show::IndexMap},
                                               {"offsets", Show::Offsets}})
                        .value_or(Show::Wireframe);
  const Camera camera = cameraOf(seenFrom);
  const auto [width, height] = sizeOf(Settings(given));
  const radiosity::Scene& scene = *elements->scene;
  const radiosity::Discretization& discretization = elements->discretization;
  return toPixels(unlocked([&, width = width, height = height]() -> Image {
    if (what == Show::Wireframe) return radiosity::wireframePicture(scene, camera, width, height);
    if (what == Show::Mesh) return radiosity::meshPicture(scene, discretization, camera, width, height);
    const radiosity::IdLayout layout = radiosity::layOut(discretization);
    const auto draw = what == Show::Ids        ? radiosity::idPicture
                      : what == Show::IndexMap ? radiosity::indexMapPicture
                                               : radiosity::offsetPicture;
    return draw(scene, discretization, layout, camera, width, height);
  }));
}

}  // namespace

void addPictures(py::module_& module) {
  module.def("lit_picture", &litPicture);
  module.def("value_picture", &valuePicture);
  module.def("structure_picture", &structurePicture);
}

}  // namespace hemitex::python
