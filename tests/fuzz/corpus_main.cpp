/// Gives all files of the named folders to a harness, in the order of their names: a test without libFuzzer.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "raster/base/file_io.h"
#include "tests/fuzz/fuzz_input.h"

int main(int argc, char** argv) {
  std::size_t inputs = 0;
  for (int a = 1; a < argc; ++a) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(argv[a])) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& file : files) {
      std::printf("%s\n", file.c_str());
      std::fflush(stdout);  // the last name is that of the input that ends the program
      const std::string bytes = hemitex::raster::readFile(file);
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    inputs += files.size();
  }
  return inputs == 0 ? 1 : 0;
}
