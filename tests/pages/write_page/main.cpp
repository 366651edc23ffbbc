/// `write_page PAGE.md PROGRAMS`: runs the commands of a page, then writes their output and pictures into the page's
/// folder. The commands run in a temporary folder, where they find `data` and `docs`.
#include <filesystem>
#include <iostream>

#include "raster/base/file_io.h"
#include "tests/pages/page_commands.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;
using namespace hemitex::pages;
using hemitex::raster::readFile, hemitex::raster::writeFile;

int main(int count, char** arguments) {
  if (count != 3) {
    std::cerr << "usage: write_page PAGE.md PROGRAMS\n";
    return 2;
  }
  const fs::path page = fs::canonical(arguments[1]), docs = page.parent_path();
  const hemitex::TemporaryFolder folder;
  for (const char* name : {"data", "docs"}) fs::create_directory_symlink(docs.parent_path() / name, folder.path / name);
  const std::string old = readFile(page);
  const std::string text = withOutputs(old, folder.path, fs::canonical(arguments[2]));
  // Times change from run to run; the page keeps its times while all else is the same.
  if (withoutTimes(text) != withoutTimes(old)) writeFile(page, text);
  for (const std::string& picture : picturesOf(text)) {
    fs::create_directories((docs / picture).parent_path());
    fs::copy_file(folder.path / "out" / picture, docs / picture, fs::copy_options::overwrite_existing);
  }
}
