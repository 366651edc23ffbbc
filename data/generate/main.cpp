/// Writes the scenes of data/ into a folder: `hemitex_data DIR`.

#include <fstream>
#include <iostream>

#include "data/generate/models.h"
#include "raster/input_error.h"

namespace {

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw hemitex::raster::InputError(path, 0, "cannot be written", "name a folder that exists");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: hemitex_data DIR   writes the scenes of data/ into a folder\n";
    return 2;
  }
  try {
    for (const hemitex::data::Model& model : hemitex::data::allModels()) {
      for (const hemitex::data::File& file : files(model)) write(argv[1] + ('/' + file.name), file.text);
    }
  } catch (const hemitex::raster::InputError& error) {
    std::cerr << "hemitex_data: " << error.what() << '\n';
    return 2;
  }
}
