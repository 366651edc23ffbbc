#include "radiosity/scene/mtl_file.h"

#define TINYOBJLOADER_IMPLEMENTATION
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/case_conv.hpp>

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

/// The text of a map with three numbers behind each option that has one to three, because tinyobjloader would take the
/// name of the image for a missing one.
std::string withAllNumbers(std::string_view rest) {
  std::string text;
  while (!rest.empty() && rest.front() == '-') {
    const std::string option(nextWord(rest).value_or(""));
    text += option + " ";
    const bool hasThree = option == "-s" || option == "-o" || option == "-t";
    std::string_view behind = rest;
    for (int n = 0; n < 3 && hasThree; ++n) {
      const auto word = nextWord(behind);
      if (word && numberOf(*word)) rest = behind;
      text += (word && numberOf(*word) ? std::string(*word) : option == "-s" ? "1" : "0") + " ";
    }
    for (behind = rest; !hasThree;) {
      const auto word = nextWord(behind);
      const bool isArgument = word && (numberOf(*word) || *word == "on" || *word == "off" || word->size() == 1);
      if (!isArgument) break;
      text += std::string(*word) + " ";
      rest = behind;
    }
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
  }
  return text + std::string(rest);
}

MapStatement readMap(const TextLine& line) {
  MapStatement map;
  tinyobj::texture_option_t options{};
  options.scale[0] = options.scale[1] = options.scale[2] = 1;
  tinyobj::ParseTextureNameAndOption(&map.image, &options, withAllNumbers(line.rest).c_str());
  map.sampler.place = {options.scale[0], 0, 0, options.scale[1], options.origin_offset[0], options.origin_offset[1]};
  if (options.clamp) map.sampler.wrap = {Wrap::Clamp, Wrap::Clamp};
  constexpr std::string_view harmless = " -s -o -clamp -blendu -blendv -texres -boost -bm ";
  std::string_view rest = line.rest.substr(0, line.rest.size() - std::min(line.rest.size(), map.image.size()));
  while (const auto word = nextWord(rest))
    if (word->front() == '-' && !numberOf(*word) && harmless.find(" " + std::string(*word) + " ") == harmless.npos)
      map.omitted += (map.omitted.empty() ? "" : " ") + std::string(*word);
  return map;
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
  const std::optional<std::string> joined = joinedLines(text);
  LineReader lines(joined ? *joined : text, file);
  while (const std::optional<TextLine> line = lines.next()) {
    const Place place{file, line->number};
    const std::string keyword = boost::to_lower_copy(std::string(line->keyword));
    if (keyword == "newmtl") materials.push_back({std::string(line->rest)});
    if (materials.empty()) continue;
    MaterialStatement& material = materials.back();
    if (keyword == "kd") {
      material.reflectanceSpectrum = readSpectrumStatement(*line, place);
      material.reflectance = material.reflectanceSpectrum ? std::nullopt : std::optional(readColor(*line, place));
    }
    if (keyword == "ke") {
      material.emissionSpectrum = readSpectrumStatement(*line, place);
      material.emission = material.emissionSpectrum ? std::nullopt : std::optional(readEmission(*line, place, unit));
    }
    if (keyword == "map_kd") material.reflectanceMap = readMap(*line);
    if (keyword == "map_ke" || keyword == "map_emissive") material.emissionMap = readMap(*line);
    if (keyword == "d") material.dissolve = tolerantNumber(*line);
    if (keyword == "tr") material.transparency = tolerantNumber(*line);
    if (keyword == "map_d" || keyword == "map_opacity") material.dissolveMap = readMap(*line);
    if (keyword == "decal") material.hasDecal = true;
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
