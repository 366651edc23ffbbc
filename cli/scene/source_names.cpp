#include "cli/scene/source_names.h"

#include <filesystem>
#include <optional>
#include <utility>

#include "cli/common/numbers.h"
#include "radiosity/base/text_lines.h"
#include "radiosity/scene/surface_names.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/base/short_number.h"

namespace hemitex::cli {
namespace {

/// Reads `COL,ROW`; nothing for any other text.
std::optional<std::pair<int, int>> parseTexel(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return std::nullopt;
  const std::optional<int> column = parseInteger(text.substr(0, comma));
  const std::optional<int> row = parseInteger(text.substr(comma + 1));
  if (!column || !row) return std::nullopt;
  return std::pair{*column, *row};
}

/// Reads `x,y,z,nx,ny,nz`; nothing for any other text.
std::optional<radiosity::SurfacePoint> parsePoint(const std::string& text) {
  std::size_t middle = 0;
  for (int comma = 0; comma < 3 && middle != std::string::npos; ++comma) middle = text.find(',', middle + 1);
  if (middle == std::string::npos) return std::nullopt;
  const auto position = parseVector(text.substr(0, middle)), normal = parseVector(text.substr(middle + 1));
  if (!position || !normal || *normal == glm::dvec3(0)) return std::nullopt;
  return radiosity::SurfacePoint{*position, glm::normalize(*normal / radiosity::largestBand(glm::abs(*normal)))};
}

}  // namespace

std::vector<NamedPoint> pointsNamed(const std::string& text) {
  if (const auto point = parsePoint(text)) return {{text, *point}};
  const std::string form = "give x,y,z,nx,ny,nz with a normal that is not 0, or a CSV file of such lines";
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(text, ignored))
    throw raster::InputError("--at: `" + raster::excerpt(text) + "` is no point and no file", form);
  std::vector<NamedPoint> points;
  const std::filesystem::path file = text;
  const std::string content = raster::readFile(file, form);
  radiosity::LineReader lines(content, file);
  for (bool isFirst = true; const auto line = lines.next(); isFirst = false) {
    const std::string name(line->text);
    const bool isHeading = isFirst && !raster::parseNumber(name.substr(0, name.find(',')));
    if (const auto point = parsePoint(name))
      points.push_back({name, *point});
    else if (!isHeading)
      radiosity::fail(lines.place(), "`" + raster::excerpt(name) + "` is no point", form);
  }
  if (points.empty()) throw raster::InputError(text, 0, "has no point", form);
  return points;
}

reference::Source sourceNamed(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                              const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const auto texel = colon == std::string::npos ? std::nullopt : parseTexel(raster::excerpt(text.substr(colon + 1)));
  if (!texel || radiosity::isSurfaceName(scene, text)) return {radiosity::surfacesNamed(scene, text)};
  return reference::texelSource(scene, discretization, text.substr(0, colon), texel->first, texel->second);
}

}  // namespace hemitex::cli
