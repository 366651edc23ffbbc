#include "radiosity/scene/mtl_file.h"

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>

#include "radiosity/base/text_lines.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"

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

/// The statement of a line such as `Kd spectral FILE.rfl FACTOR`; nothing for other lines. File names may have blanks.
std::optional<SpectrumStatement> readSpectrumStatement(const TextLine& line, const Place& place) {
  std::string_view rest = line.rest;
  if (nextWord(rest) != "spectral") return std::nullopt;
  std::vector<std::string_view> words;
  std::string_view left = rest;
  while (const auto word = nextWord(left)) words.push_back(*word);
  const std::string keyword(line.keyword);
  if (words.empty()) fail(place, keyword + " spectral names no file", "write " + keyword + " spectral FILE.rfl FACTOR");
  SpectrumStatement statement{{}, 1, place.line};
  const std::optional<double> factor = words.size() > 1 ? numberOf(words.back()) : std::nullopt;
  statement.factor = factor.value_or(1);
  if (!(statement.factor >= 0 && statement.factor <= largestEmission))
    fail(place, "the factor of " + keyword + " spectral is not between 0 and 1e30");
  const char* const first = words.front().data();
  const std::string_view& name = factor ? words[words.size() - 2] : words.back();
  statement.spectrum = std::string(first, name.data() + name.size());
  return statement;
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
  std::string_view rest = line.rest;
  return numberOf(nextWord(rest).value_or(std::string_view()));
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
    if (line->keyword == "Kd") {
      material.reflectanceSpectrum = readSpectrumStatement(*line, place);
      material.reflectance = material.reflectanceSpectrum ? std::nullopt : std::optional(readColor(*line, place));
    }
    if (line->keyword == "Ke") {
      material.emissionSpectrum = readSpectrumStatement(*line, place);
      material.emission = material.emissionSpectrum ? std::nullopt : std::optional(readEmission(*line, place, unit));
    }
    if (line->keyword == "map_Kd") material.reflectanceMap = readMap(*line);
    if (line->keyword == "map_Ke") material.emissionMap = readMap(*line);
    if (line->keyword == "d") material.dissolve = tolerantNumber(*line);
    if (line->keyword == "Tr") material.transparency = tolerantNumber(*line);
    if (line->keyword == "map_d") material.hasDissolveMap = true;
  }
  return materials;
}

Spectrum readSpectrum(const SpectrumStatement& statement, const std::filesystem::path& materialFile) {
  const std::filesystem::path file = materialFile.parent_path() / statement.spectrum;
  const std::optional<std::string> text = raster::tryReadFile(file);
  if (!text)
    fail({materialFile, statement.line}, "the spectrum " + raster::excerpt(file.string()) + " cannot be read",
         "put the file beside the material file, or give the three numbers of a colour");
  Spectrum spectrum = parseSpectrum(*text, file);
  for (double& value : spectrum.values) value *= statement.factor;
  return spectrum;
}

}  // namespace hemitex::radiosity
