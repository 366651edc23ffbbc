#include "cli/scene/source_names.h"

#include <filesystem>
#include <optional>
#include <sstream>
#include <utility>

#include "cli/common/numbers.h"
#include "radiosity/scene/surface_names.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"

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
  std::istringstream lines(raster::readFile(text, form));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const auto point = parsePoint(line);
    if (point) points.push_back({line, *point});
    if (!point && number > 1 && !line.empty())
      throw raster::InputError(text, number, "`" + raster::excerpt(line) + "` is no point", form);
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
