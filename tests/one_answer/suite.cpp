/// Writes the whole vector suite with its words, a folder a vector:
///   hemitex_suite DATA FOLDER
/// where DATA holds the scenes and FOLDER exists.
#include <cstdio>
#include <filesystem>

#include "raster/input_error.h"
#include "reference/scene_vectors.h"
#include "reference/vector_suite.h"

using namespace hemitex;

int main(int count, char** arguments) {
  if (count != 3) {
    std::fputs("usage: hemitex_suite DATA FOLDER\n", stderr);
    return 2;
  }
  try {
    for (const reference::TestVector& vector : reference::wholeSuite(arguments[1])) {
      const std::filesystem::path folder = std::filesystem::path(arguments[2]) / vector.name;
      std::filesystem::create_directories(folder);
      reference::writeVector(folder, vector, reference::render(vector));
    }
    return 0;
  } catch (const raster::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
