/// Draws one triangle with the installed library, writes a picture and reads it again; returns 0 if both are right.
#include <filesystem>
#include <iostream>

#include "../one_triangle.h"
#include "radiosity/images/image.h"
#include "reference/conformance/vectors/vector_file.h"

int main() {
  using namespace hemitex;
  const raster::ItemBuffer buffer = drawTriangle();
  const bool right = isRight(buffer);
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
