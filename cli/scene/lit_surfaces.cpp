#include "cli/scene/lit_surfaces.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "reference/base/json_text.h"

namespace hemitex::cli {

std::vector<std::uint32_t> restoreSurfaces(radiosity::Scene& lit, const nlohmann::ordered_json& surfaces) {
  /// A triangle of the file, and the surface that holds it.
  struct Face {
    const radiosity::Surface* surface = nullptr;
    const radiosity::Triangle* triangle = nullptr;
  };
  std::vector<Face> faces;
  for (const radiosity::Surface& surface : lit.surfaces)
    for (const radiosity::Triangle& triangle : surface.triangles) {
      if (triangle.polygon >= faces.size()) faces.resize(triangle.polygon + std::size_t{1});
      faces[triangle.polygon] = {&surface, &triangle};
    }
  std::vector<radiosity::Surface> restored;
  std::vector<std::uint32_t> numbers;
  std::size_t first = 0;
  for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
    const auto name = surfaces[s].at("name").get<std::string>();
    const std::size_t end = first + reference::valueAt<std::uint32_t>(surfaces[s], "triangles");
    radiosity::Surface surface;
    surface.name = surface.family = name;
    for (; first < std::min(end, faces.size()); ++first) {
      const Face& face = faces[first];
      if (!face.triangle) continue;
      surface.material = face.surface->material;
      surface.object = face.surface->object;
      surface.triangles.push_back(*face.triangle);
      surface.triangles.back().chart = face.triangle->texcoord;
    }
    first = end;
    if (surface.triangles.empty()) continue;
    restored.push_back(std::move(surface));
    numbers.push_back(s);
  }
  if (first < faces.size() || restored.empty()) throw std::out_of_range("the scene has other faces");
  lit.surfaces = std::move(restored);
  return numbers;
}

}  // namespace hemitex::cli
