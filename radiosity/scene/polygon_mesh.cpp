#include "radiosity/scene/polygon_mesh.h"

namespace hemitex::radiosity {

std::string placeOf(const PolygonMesh& mesh, std::uint32_t polygon) {
  const int line = mesh.polygons[polygon].line;
  return line > 0 ? "line " + std::to_string(line) : "face " + std::to_string(polygon + 1);
}

}  // namespace hemitex::radiosity
