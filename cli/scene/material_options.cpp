#include "cli/scene/material_options.h"

#include <filesystem>
#include <optional>
#include <utility>

#include "cli/common/json.h"
#include "radiosity/scene/materials.h"
#include "radiosity/scene/scene_edits.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;
using raster::InputError;

bool isNegative(const glm::dvec3& color) { return color.r < 0 || color.g < 0 || color.b < 0; }

/// Reads `NAME=R,G,B`. A name may contain `=`.
NamedColor readColor(const std::string& option, const std::string& text) {
  const std::size_t equals = text.rfind('=');
  const auto color = equals == std::string::npos ? std::nullopt : parseVector(text.substr(equals + 1));
  if (!color || equals == 0) usageError(option, "`" + text + "` is not NAME=R,G,B with three finite numbers");
  if (isNegative(*color)) usageError(option, "`" + text + "` has a number below 0");
  return {text.substr(0, equals), *color, option};
}

void addColors(Command command, const std::string& option, std::vector<NamedColor>& colors, const std::string& help) {
  command.addTexts(option, "NAME=R,G,B", help, [&colors, option](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) colors.push_back(readColor(option, text));
  });
}

/// Throws InputError, with the name, for a value that is not a list of three numbers of at least 0.
NamedColor readLight(const std::string& name, const ordered_json& value, const std::string& file) {
  bool isColor = value.is_array() && value.size() == 3;
  for (const ordered_json& band : value) isColor = isColor && band.is_number() && band.get<double>() >= 0;
  if (!isColor)
    throw InputError(file, 0, "`" + name + "` has the value " + value.dump(),
                     "write a list of three numbers of at least 0");
  return {name, {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()}, file};
}

std::vector<NamedColor> readLights(const std::filesystem::path& file) {
  const std::string form = R"(write {"NAME": [R,G,B], ...})";
  std::vector<NamedColor> lights;
  try {
    const auto content = ordered_json::parse(raster::readFile(file, "give a JSON file of lights"));
    if (!content.is_object()) throw InputError(file.string(), 0, "is no JSON object", form);
    for (const auto& [name, value] : content.items()) lights.push_back(readLight(name, value, file.string()));
  } catch (const ordered_json::exception& error) {
    throw InputError(file.string(), 0, error.what(), form);
  }
  return lights;
}

void apply(radiosity::Scene& scene, const NamedColor& change, const radiosity::Edit& edit) {
  try {
    scene = radiosity::edited(std::move(scene), {}, {{edit}}).scene;
  } catch (const InputError& error) {
    throw InputError(change.source + ": " + error.what());
  }
}

}  // namespace

void addMaterialOptions(Command command, MaterialOptions& options) {
  command = command.under("Light and reflectance");
  addColors(command, "--emit", options.emissions,
            "set the emission of a surface, group or material, in the unit of Ke (repeatable). `*` at the end of NAME "
            "means any rest. Later options override earlier ones.");
  addColors(command, "--reflectance", options.reflectances,
            "set the reflectance of a surface, group or material (repeatable; see --emit)");
  command.addText("--lights", "FILE.json", R"(read emissions from a JSON object {"NAME": [R,G,B], ...}; see --emit)",
                  [&options](const std::string& text) { options.lights = readLights(text); });
}

radiosity::Scene withMaterials(radiosity::Scene scene, const MaterialOptions& options,
                               const radiosity::SceneSettings& settings) {
  const double unit = radiosity::radiosityPerUnit(settings.emission);
  for (const std::vector<NamedColor>* emissions : {&options.lights, &options.emissions})
    for (const NamedColor& light : *emissions)
      apply(scene, light, radiosity::SetEmission{light.name, unit * light.color});
  for (const NamedColor& paint : options.reflectances) {
    glm::dvec3 reflectance = paint.color;
    if (const auto warning = radiosity::lowerReflectance(reflectance, settings.maxReflectance))
      scene.warnings.push_back("`" + paint.name + "`: " + *warning);
    apply(scene, paint, radiosity::SetReflectance{paint.name, reflectance});
  }
  return scene;
}

ordered_json toJson(const MaterialOptions& options) {
  ordered_json changes = ordered_json::array();
  for (const std::vector<NamedColor>* emissions : {&options.lights, &options.emissions})
    for (const NamedColor& light : *emissions)
      changes.push_back({{"emission", light.name}, {"to", toJson(light.color)}});
  for (const NamedColor& paint : options.reflectances)
    changes.push_back({{"reflectance", paint.name}, {"to", toJson(paint.color)}});
  return changes;
}

}  // namespace hemitex::cli
