/// Draws one triangle with the installed library, writes a picture and reads it again; returns 0 if both are right.
#include <filesystem>
#include <iostream>

#include "radiosity/images/image.h"
#include "raster/software/software_renderer.h"
#include "reference/vectors/vector_file.h"

int main() {
  using namespace hemitex;
  raster::DrawList list;
  list.format = *raster::formatNamed("r8g8b8");
  list.positions = {{-1, -1, 2}, {3, -1, 2}, {-1, 3, 2}};
  list.texcoords.resize(list.positions.size());
  list.indices = {0, 1, 2};
  list.draws = {{.first = 0, .count = 3, .offset = 7}};
  raster::Face face;
  face.x = {1, 0, 0};
  face.y = {0, 1, 0};
  face.w = {0, 0, 1};
  face.nearDistance = 0.5F;
  face.resolution = 4;
  face.scissor = {0, 0, 4, 4};

  raster::SoftwareRenderer renderer(list);
  const raster::ItemBuffer buffer = render(renderer, {&face, 1}, {}).front();
  // The triangle's vertices lie at (-1/2, -1/2), (3/2, -1/2) and (-1/2, 3/2) of the picture plane, so that it covers
  // the pixel at (1/4, 1/4) and not the one at (-3/4, -3/4).
  const bool right = buffer.ids[2 * 4 + 2] == 7 && buffer.ids[0] == raster::backgroundId(list.format);
  // The module for images is found without any help of ours.
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "hemitex-consumer.png";
  radiosity::writePng(file, {1, 1, {glm::dvec3(0, 1, 0)}});
  const radiosity::Image image = radiosity::readImage(file);
  std::filesystem::remove(file);
  const bool same = image.pixels == std::vector{glm::dvec3(0, 1, 0)};
  std::cout << (same ? "the picture is right\n" : "the picture is wrong\n");

  std::cout << "item buffer " << reference::idsHash(buffer.ids) << (right ? " is right\n" : " is wrong\n");
  return right && same ? 0 : 1;
}
