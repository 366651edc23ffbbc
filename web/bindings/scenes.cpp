/// Scenes, and the settings of elements, drawings and item IDs, for JavaScript; web/page/core.ts has the types.
#include "web/bindings/scenes.h"

#include <emscripten/bind.h>

#include <filesystem>
#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/exposure.h"
#include "radiosity/meshes/length_unit.h"
#include "radiosity/pictures/default_camera.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/interface/item_id.h"
#include "web/bindings/folder.h"

namespace hemitex::web {
namespace {

using raster::InputError;

struct SceneHandle {
  std::shared_ptr<const radiosity::Scene> scene;
  Json camera;
};

Json toJson(const radiosity::Camera& camera) {
  return {{"eye", web::toJson(camera.eye)},
          {"look_at", web::toJson(camera.lookAt)},
          {"up", web::toJson(camera.up)},
          {"fov", camera.fov}};
}

/// A file SCENE.view.json beside SCENE.obj has the camera.
std::shared_ptr<SceneHandle> loadScene(const Value& files, const std::string& main) {
  return guarded([&] {
    const Folder folder(files);
    const std::filesystem::path file = folder.path() / main;
    radiosity::Scene loaded = radiosity::loadScene(file, {.sides = radiosity::Sides::TwoOfSheets});
    const double metres = radiosity::statedMetresPerUnit(file, loaded.warnings).value_or(1);
    loaded.squareMetres = metres * metres;
    const auto scene = std::make_shared<const radiosity::Scene>(radiosity::separatedAtWalls(std::move(loaded)));
    std::filesystem::path view = file;
    view.replace_extension(".view.json");
    const Json camera =
        std::filesystem::exists(view) ? Json::parse(raster::readFile(view)) : toJson(radiosity::defaultCamera(*scene));
    return std::make_shared<SceneHandle>(SceneHandle{scene, camera});
  });
}
Value sceneInfo(const SceneHandle& handle) {
  const radiosity::Scene& scene = *handle.scene;
  Json surfaces = Json::array();
  for (const radiosity::Surface& surface : scene.surfaces) surfaces.push_back(describe(scene, surface));
  return toValue({{"surfaces", surfaces},
                  {"camera", handle.camera},
                  {"extent", scene.extent},
                  {"square_metres", scene.squareMetres}});
}

std::shared_ptr<ElementsHandle> discretize(const SceneHandle& handle, const Value& given) {
  return guarded([&] {
    const Json settings = jsonOf(given);
    radiosity::DiscretizationSettings result;
    if (settings.contains("texels")) result.texels = settings["texels"].get<int>();
    if (settings.contains("texel_size")) result.texelSize = settings["texel_size"].get<double>();
    if (settings.contains("surface_texels"))
      for (const auto& [name, texels] : settings["surface_texels"].items())
        result.surfaceTexels[name] = texels.get<int>();
    result.patch = settings.value("patch", result.patch);
    result.isUnburied = settings.value("editable", false);
    return std::make_shared<ElementsHandle>(ElementsHandle{
        handle.scene, result,
        std::make_shared<const radiosity::Discretization>(radiosity::discretize(*handle.scene, result))});
  });
}

raster::IdFormat formatOf(const std::string& name) {
  const auto format = raster::formatNamed(name);
  if (!format) throw InputError("there is no format `" + raster::excerpt(name) + "`");
  return *format;
}

Value formats() {
  Json list = Json::array();
  for (const std::string& name : raster::formatNames())
    list.push_back({{"name", name}, {"channels", raster::formatNamed(name)->channelBits}});
  return toValue(list);
}

/// Index maps with offsets are added.
raster::Blend blendNamed(const std::string& name) {
  return valueNamed<raster::Blend>(
      name, "blend", {{"clamped-add", raster::Blend::ClampedAdd}, {"integer-add", raster::Blend::IntegerAdd}});
}

}  // namespace

Json describe(const radiosity::Scene& scene, const radiosity::Surface& surface) {
  const radiosity::Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
  return {{"name", surface.name},
          {"reflectance", web::toJson(material.reflectance)},
          {"emission", web::toJson(material.emission)}};
}

radiosity::DrawingSettings drawingSettings(const Json& settings) {
  using radiosity::ElementsBy;
  radiosity::DrawingSettings drawing;
  drawing.resolution = settings.value("resolution", drawing.resolution);
  if (drawing.resolution < 2 || drawing.resolution > 4096 || drawing.resolution % 2 != 0)
    throw InputError("the resolution is not an even number from 2 to 4096");
  if (!settings.value("rotated", true)) drawing.orientation = radiosity::Orientation::Aligned;
  drawing.split = settings.value("split", drawing.split);
  drawing.elementsBy = valueNamed<ElementsBy>(settings.value("elements", "texture"), "way to draw elements",
                                              {{"texture", ElementsBy::Texture}, {"mesh", ElementsBy::Mesh}});
  return drawing;
}

radiosity::IdSettings idSettings(const Json& settings) {
  radiosity::IdSettings ids;
  ids.format = settings.value("format", ids.format);
  ids.blend = blendNamed(settings.value("blend", "clamped-add"));
  ids.aligned = settings.value("aligned", ids.aligned);
  return ids;
}

EMSCRIPTEN_BINDINGS(scenes) {
  using namespace emscripten;
  class_<SceneHandle>("Scene")
      .smart_ptr<std::shared_ptr<SceneHandle>>("Scene")
      .function("info", &sceneInfo)
      .function("discretize", &discretize);
  function("loadScene", &loadScene);
  function("formats", &formats);
  function("maxSurfaces", optional_override([](const std::string& format, unsigned texels) {
             return guarded([&] { return static_cast<double>(radiosity::maxSurfaces(formatOf(format), texels)); });
           }));
  function("blend", optional_override([](const std::string& format, const std::string& operation, unsigned offset,
                                         unsigned texel) {
             return guarded([&] { return raster::blend(formatOf(format), blendNamed(operation), offset, texel); });
           }));
}

}  // namespace hemitex::web
