#include "cli/scene/material_options.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "cli/common/json.h"
#include "radiosity/scene/materials.h"
#include "radiosity/scene/mtl_file.h"
#include "radiosity/scene/scene_edits.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/json_text.h"

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
  command.addTexts(option, "NAME=R,G,B", help,
                   [&colors, option](const std::string& text) { colors.push_back(readColor(option, text)); });
}

/// Reads an irradiance; throws a usage error.
glm::dvec3 readIrradiance(const std::string& option, const std::string& text) {
  const std::optional<glm::dvec3> irradiance = parseVector(text);
  if (!irradiance) usageError(option, "`" + text + "` is not R,G,B with three finite numbers, such as 1,1,1");
  if (isNegative(*irradiance)) usageError(option, "`" + text + "` has a number below 0");
  return *irradiance;
}

/// The unit vector along a vector that is not 0, of any length.
glm::dvec3 unit(const glm::dvec3& vector) {
  const glm::dvec3 sizes = glm::abs(vector);
  return glm::normalize(vector / std::max({sizes.x, sizes.y, sizes.z}));
}

/// Reads `x,y,z=R,G,B`: a vector and light of at least 0.
std::pair<glm::dvec3, glm::dvec3> readPlacedLight(const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('=');
  const auto vector = parseVector(text.substr(0, equals));
  if (equals == std::string::npos || !vector) usageError(option, "`" + text + "` is not x,y,z=R,G,B");
  return {*vector, readIrradiance(option, text.substr(equals + 1))};
}

radiosity::Sun readSun(const std::string& text) {
  const auto [towards, irradiance] = readPlacedLight("--sun", text);
  if (towards == glm::dvec3(0)) usageError("--sun", "`" + text + "` has no direction");
  return {unit(towards), irradiance};
}

radiosity::Lamp readLamp(const std::string& text) {
  const auto [position, intensity] = readPlacedLight("--lamp", text);
  return {{}, position, intensity};
}

/// Throws InputError, with the name, for a value that is not a list of three numbers of at least 0.
NamedColor readLight(const std::string& name, const ordered_json& value, const std::string& file) {
  const std::optional<glm::dvec3> color = reference::vectorOf(value);
  if (!color || isNegative(*color))
    throw InputError(file, 0, "`" + raster::excerpt(name) + "` has the value " + raster::excerpt(value.dump()),
                     "write a list of three numbers of at least 0");
  return {name, *color, file};
}

/// Throws InputError for a value that is not {"towards": [x,y,z], "irradiance": [R,G,B]}.
radiosity::Sun readSun(const ordered_json& value, const std::string& file) {
  const auto member = [&](const char* name) {
    return value.is_object() && value.contains(name) ? value[name] : ordered_json();
  };
  const std::optional<glm::dvec3> towards = reference::vectorOf(member("towards"));
  if (!towards || *towards == glm::dvec3(0) || value.size() != 2)
    throw InputError(file, 0, "`sun` has the value " + raster::excerpt(value.dump()),
                     R"(write {"towards": [x,y,z], "irradiance": [R,G,B]}, or a list of these)");
  return {unit(*towards), readLight("sun", member("irradiance"), file).color};
}

/// Reads the file of `--lights`. The other options, which override it, are read before: options are read in the order
/// in which they are added.
void readLights(const std::filesystem::path& file, MaterialOptions& options) {
  std::vector<NamedColor> lights;
  radiosity::OutsideLight outside;
  const auto content =
      reference::parseJson<ordered_json>(raster::readFile(file, "give a JSON file of lights"), file.string());
  if (!content.is_object()) throw InputError(file.string(), 0, "is no JSON object", R"(write {"NAME": [R,G,B], ...})");
  for (const auto& [name, value] : content.items()) {
    if (name == "sky")
      outside.sky = readLight(name, value, file.string()).color;
    else if (name != "sun")
      lights.push_back(readLight(name, value, file.string()));
    else
      for (const ordered_json& sun : value.is_array() ? value : ordered_json::array({value}))
        outside.suns.push_back(readSun(sun, file.string()));
  }
  options.emissions.insert(options.emissions.begin(), lights.begin(), lights.end());
  if (!options.sky && outside.sky != glm::dvec3(0)) options.sky = outside.sky;
  if (options.suns.empty()) options.suns = outside.suns;
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
  command.addText("--sky", "R,G,B",
                  "light the scene from outside, equally from all directions; the unit is the irradiance of an open "
                  "plane in W/m^2",
                  [&options](const std::string& text) { options.sky = readIrradiance("--sky", text); });
  command.addTexts("--sun", "x,y,z=R,G,B",
                   "add parallel light from the direction x,y,z; R,G,B is the irradiance of a plane at right angles to "
                   "it, in W/m^2 (repeatable)",
                   [&options](const std::string& text) { options.suns.push_back(readSun(text)); });
  command.addTexts("--lamp", "x,y,z=R,G,B",
                   "add a lamp at the point x,y,z; R,G,B is its radiant intensity in W/sr, equal in all directions "
                   "(repeatable). `lamp-1`, `lamp-2`, ... are the names in edits.",
                   [&options](const std::string& text) { options.lamps.push_back(readLamp(text)); });
  command.addPath("--lights", "FILE.json",
                  R"(read emissions from a JSON object {"NAME": [R,G,B], ...}; see --emit. The names "sky" and "sun" )"
                  R"(mean --sky and --sun: {"sky": [R,G,B], "sun": {"towards": [x,y,z], "irradiance": [R,G,B]}})",
                  [&options](const std::string& text) { readLights(text, options); });
}

radiosity::Scene withMaterials(radiosity::Scene scene, const MaterialOptions& options,
                               const radiosity::SceneSettings& settings) {
  for (radiosity::Lamp lamp : options.lamps) {
    lamp.name = "lamp-" + std::to_string(scene.lamps.size() + 1);
    scene.lamps.push_back(lamp);
  }
  const double unit = radiosity::radiosityPerUnit(settings.emission);
  for (const NamedColor& light : options.emissions)
    apply(scene, light, radiosity::SetEmission{light.name, light.color, unit});
  for (const NamedColor& paint : options.reflectances) {
    glm::dvec3 reflectance = paint.color;
    if (const auto warning = radiosity::lowerReflectance(reflectance, settings.maxReflectance))
      scene.warnings.push_back("`" + raster::excerpt(paint.name) + "`: " + *warning);
    apply(scene, paint, radiosity::SetReflectance{paint.name, reflectance});
  }
  scene.outside.sky = options.sky.value_or(glm::dvec3(0));
  scene.outside.suns.insert(scene.outside.suns.end(), options.suns.begin(), options.suns.end());
  if (radiosity::brightest(scene.outside) > radiosity::largestEmission)
    throw InputError("the light from outside is above 1e30 W/m^2", "scale it down");
  for (const radiosity::Lamp& lamp : scene.lamps)
    if (radiosity::largestBand(lamp.intensity) > radiosity::largestEmission)
      throw InputError("the lamp `" + raster::excerpt(lamp.name) + "` is above 1e30 W/sr", "scale it down");
  return scene;
}

ordered_json toJson(const MaterialOptions& options) {
  ordered_json changes = ordered_json::array();
  for (const NamedColor& light : options.emissions)
    changes.push_back({{"emission", light.name}, {"to", toJson(light.color)}});
  for (const NamedColor& paint : options.reflectances)
    changes.push_back({{"reflectance", paint.name}, {"to", toJson(paint.color)}});
  return changes;
}

ordered_json lightsJson(const radiosity::Scene& scene) {
  ordered_json text = ordered_json::object();
  if (scene.outside.sky != glm::dvec3(0)) text["sky"] = toJson(scene.outside.sky);
  for (const radiosity::Sun& sun : scene.outside.suns)
    text["sun"].push_back({{"towards", toJson(sun.towards)}, {"irradiance", toJson(sun.irradiance)}});
  for (const radiosity::Lamp& lamp : scene.lamps) {
    text["lamp"].push_back(
        {{"name", lamp.name}, {"position", toJson(lamp.position)}, {"intensity", toJson(lamp.intensity)}});
    if (lamp.cone)
      text["lamp"].back().update({{"axis", toJson(lamp.cone->axis)},
                                  {"inner_cosine", lamp.cone->innerCosine},
                                  {"outer_cosine", lamp.cone->outerCosine}});
  }
  return text;
}

void restoreLights(radiosity::Scene& scene, const ordered_json& settings) {
  using reference::vectorAt;
  scene.outside = {};
  scene.lamps.clear();
  if (settings.contains("sky")) scene.outside.sky = vectorAt(settings, "sky");
  for (const ordered_json& sun : settings.value("sun", ordered_json::array()))
    scene.outside.suns.push_back({vectorAt(sun, "towards"), vectorAt(sun, "irradiance")});
  for (const ordered_json& given : settings.value("lamp", ordered_json::array())) {
    radiosity::Lamp lamp{given.at("name").get<std::string>(), vectorAt(given, "position"),
                         vectorAt(given, "intensity")};
    if (given.contains("axis"))
      lamp.cone = {vectorAt(given, "axis"), given.at("inner_cosine").get<double>(),
                   given.at("outer_cosine").get<double>()};
    scene.lamps.push_back(std::move(lamp));
  }
}

}  // namespace hemitex::cli
