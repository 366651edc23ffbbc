#include "cli/scene/lit_surfaces.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "reference/base/json_text.h"

namespace hemitex::cli {

std::vector<std::uint32_t> restoreSurfaces(radiosity::Scene& lit, const nlohmann::ordered_json& surfaces) {
  /// A triangle, and the surface that holds it. A face of the file is cut where others touch it.
  struct Part {
    const radiosity::Surface* surface;
    const radiosity::Triangle* triangle;
  };
  std::vector<Part> parts;
  for (const radiosity::Surface& surface : lit.surfaces)
    for (const radiosity::Triangle& triangle : surface.triangles) parts.push_back({&surface, &triangle});
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& a, const Part& b) { return a.triangle->polygon < b.triangle->polygon; });
  std::vector<radiosity::Surface> restored;
  std::vector<std::uint32_t> numbers;
  auto part = parts.cbegin();
  std::uint64_t end = 0;  // of the faces of a surface
  for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
    end += reference::valueAt<std::uint32_t>(surfaces[s], "triangles");
    radiosity::Surface surface;
    surface.name = surface.family = surfaces[s].at("name").get<std::string>();
    for (; part != parts.cend() && part->triangle->polygon < end; ++part) {
      surface.material = part->surface->material;
      surface.object = part->surface->object;
      surface.triangles.push_back(*part->triangle);
      surface.triangles.back().chart = part->triangle->texcoord;
    }
    if (surface.triangles.empty()) continue;
    restored.push_back(std::move(surface));
    numbers.push_back(s);
  }
  if (part != parts.cend() || restored.empty()) throw std::out_of_range("the scene has other faces");
  lit.surfaces = std::move(restored);
  return numbers;
}

}  // namespace hemitex::cli
