#include "cli/scene/source_names.h"

#include <optional>
#include <utility>

#include "cli/common/numbers.h"
#include "radiosity/scene/surface_names.h"
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

}  // namespace

reference::Source sourceNamed(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                              const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const auto texel = colon == std::string::npos ? std::nullopt : parseTexel(raster::excerpt(text.substr(colon + 1)));
  if (!texel || radiosity::isSurfaceName(scene, text)) return {radiosity::surfacesNamed(scene, text)};
  return reference::texelSource(scene, discretization, text.substr(0, colon), texel->first, texel->second);
}

}  // namespace hemitex::cli
