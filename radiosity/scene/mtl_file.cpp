#include "radiosity/scene/mtl_file.h"

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "radiosity/meshes/text_lines.h"

namespace hemitex::radiosity {
namespace {

glm::dvec3 readColor(const TextLine& line, const Place& place) {
  std::array<double, 3> n{};
  const std::size_t count = readNumbers(line.rest, n, place);
  const std::string keyword(line.keyword);
  if (count != 1 && count != 3) fail(place, keyword + " has 3 numbers, or 1 for a grey");
  const glm::dvec3 color = count == 3 ? glm::dvec3(n[0], n[1], n[2]) : glm::dvec3(n[0]);
  if (color.r < 0 || color.g < 0 || color.b < 0) fail(place, keyword + " is negative", "light cannot be less than 0");
  return color;
}

glm::dvec3 readEmission(const TextLine& line, const Place& place, EmissionUnit unit) {
  const glm::dvec3 emission = readColor(line, place);
  if (radiosityPerUnit(unit) * std::max({emission.r, emission.g, emission.b}) > largestEmission)
    fail(place, unit == EmissionUnit::Radiance ? "Ke is above 1e30 / pi" : "Ke is above 1e30", "scale the light down");
  return emission;
}

MapStatement readMap(const TextLine& line) {
  const std::string rest(line.rest);
  std::string image;
  tinyobj::texture_option_t ignored{};
  tinyobj::ParseTextureNameAndOption(&image, &ignored, rest.c_str());
  return {image, image != rest};
}

/// The first number of a statement that has no effect on light here; nothing if it has none.
std::optional<double> tolerantNumber(const TextLine& line) {
  const std::string text(line.rest);
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return end != text.c_str() ? std::optional(number) : std::nullopt;
}

}  // namespace

std::vector<MaterialStatement> parseMaterials(std::string_view text, const std::filesystem::path& file,
                                              EmissionUnit unit) {
  std::vector<MaterialStatement> materials;
  LineReader lines(text, file);
  while (const std::optional<TextLine> line = lines.next()) {
    const Place place{file, line->number};
    if (line->keyword == "newmtl") materials.push_back({std::string(line->rest)});
    if (materials.empty()) continue;
    MaterialStatement& material = materials.back();
    if (line->keyword == "Kd") material.reflectance = readColor(*line, place);
    if (line->keyword == "Ke") material.emission = readEmission(*line, place, unit);
    if (line->keyword == "map_Kd") material.reflectanceMap = readMap(*line);
    if (line->keyword == "map_Ke") material.emissionMap = readMap(*line);
    if (line->keyword == "d") material.dissolve = tolerantNumber(*line);
    if (line->keyword == "Tr") material.transparency = tolerantNumber(*line);
    if (line->keyword == "map_d") material.hasDissolveMap = true;
  }
  return materials;
}

}  // namespace hemitex::radiosity
