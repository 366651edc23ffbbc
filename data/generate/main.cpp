/// Writes scenes into a folder: random rooms, or a room of many surfaces.

#include <charconv>
#include <cstring>
#include <fstream>
#include <iostream>
#include <limits>

#include "data/generate/random_room.h"
#include "data/generate/tiled_room.h"
#include "raster/base/input_error.h"

namespace {

using namespace hemitex::data;

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw hemitex::raster::InputError(path, 0, "cannot be written", "name a folder that exists");
}

void write(const std::string& folder, const Model& model) {
  for (const File& file : files(model)) write(folder + '/' + file.name, file.text);
}

/// The number after `option` in the arguments; 0 if there is none in [least, most].
int numberAfter(const char* option, int argc, char** argv, int least, int most) {
  int number = 0;
  if (argc == 4 && std::strcmp(argv[2], option) == 0) std::from_chars(argv[3], argv[3] + std::strlen(argv[3]), number);
  return number >= least && number <= most ? number : 0;
}

}  // namespace

int main(int argc, char** argv) {
  const int rooms = numberAfter("--rooms", argc, argv, 1, std::numeric_limits<int>::max());
  const int tiles = numberAfter("--tiles", argc, argv, 2, maxTiles);
  if (rooms == 0 && tiles == 0) {
    std::cerr << "usage: hemitex_data DIR --rooms N  writes N rooms drawn at random, from the seeds 1 to N\n"
                 "       hemitex_data DIR --tiles N  writes a room of 16 N^2 surfaces, N from 2 to "
              << maxTiles << '\n';
    return 2;
  }
  try {
    if (tiles > 0) write(argv[1], tiledRoom(tiles));
    for (int seed = 1; seed <= rooms; ++seed) write(argv[1], randomRoom(static_cast<std::uint32_t>(seed)));
  } catch (const hemitex::raster::InputError& error) {
    std::cerr << "hemitex_data: " << error.what() << '\n';
    return 2;
  }
}
