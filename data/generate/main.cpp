/// Writes scenes into a folder: those of data/, or random rooms.

#include <charconv>
#include <cstring>
#include <fstream>
#include <iostream>

#include "data/generate/models.h"
#include "data/generate/random_room.h"
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

/// The number of random rooms in the arguments; 0 for the scenes of data/, negative for wrong arguments.
int roomsOf(int argc, char** argv) {
  if (argc == 2) return 0;
  int rooms = -1;
  if (argc == 4 && std::strcmp(argv[2], "--rooms") == 0)
    std::from_chars(argv[3], argv[3] + std::strlen(argv[3]), rooms);
  return rooms == 0 ? -1 : rooms;
}

}  // namespace

int main(int argc, char** argv) {
  const int rooms = roomsOf(argc, argv);
  if (rooms < 0) {
    std::cerr << "usage: hemitex_data DIR            writes the scenes of data/ into a folder\n"
                 "       hemitex_data DIR --rooms N  writes N rooms drawn at random, from the seeds 1 to N\n";
    return 2;
  }
  try {
    if (rooms == 0)
      for (const Model& model : allModels()) write(argv[1], model);
    for (int seed = 1; seed <= rooms; ++seed) write(argv[1], randomRoom(static_cast<std::uint32_t>(seed)));
  } catch (const hemitex::raster::InputError& error) {
    std::cerr << "hemitex_data: " << error.what() << '\n';
    return 2;
  }
}
