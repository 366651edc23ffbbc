#include "radiosity/projection/projection.h"

#include <cassert>

#include "radiosity/geometry/tangent_along.h"

namespace hemitex::radiosity {

std::vector<Window> wholeFaces(const Projection& projection) {
  std::vector<Window> windows;
  for (std::size_t face = 0; face < projection.faces.size(); ++face)
    windows.push_back({face, projection.faces[face].scissor});
  return windows;
}

std::uint64_t shareOf(const Projection& projection, std::size_t face, int column, int row) {
  const ProjectionFace& of = projection.faces[face];
  const raster::Scissor& scissor = of.scissor;
  assert(column >= scissor.column && column < scissor.column + scissor.width);
  assert(row >= scissor.row && row < scissor.row + scissor.height);
  const auto place = static_cast<std::size_t>(row - scissor.row) * static_cast<std::size_t>(scissor.width) +
                     static_cast<std::size_t>(column - scissor.column);
  const std::vector<std::uint64_t>& before = projection.sharesBefore[of.shares];
  return before[place + 1] - before[place];
}

std::vector<double> deltaFormFactors(const Projection& projection, std::size_t face) {
  const raster::Scissor& scissor = projection.faces[face].scissor;
  std::vector<double> factors;
  for (int row = 0; row < scissor.height; ++row)
    for (int column = 0; column < scissor.width; ++column)
      factors.push_back(formFactor(shareOf(projection, face, scissor.column + column, scissor.row + row)));
  return factors;
}

std::vector<raster::Face> facesOver(std::span<const ProjectionFace> faces, const glm::dvec3& position,
                                    const glm::dvec3& normal, const glm::dvec3& up, double nearDistance) {
  const glm::dvec3 y = tangentAlong(normal, up);
  const glm::dvec3 x = glm::cross(y, normal);
  const auto turned = [&](const glm::dvec3& own) { return glm::vec3(own.x * x + own.y * y + own.z * normal); };
  std::vector<raster::Face> turnedFaces;
  for (const ProjectionFace& face : faces)
    turnedFaces.push_back({glm::vec3(position), turned(face.x), turned(face.y), turned(face.w),
                           static_cast<float>(nearDistance), face.resolution, face.scissor});
  return turnedFaces;
}

}  // namespace hemitex::radiosity
