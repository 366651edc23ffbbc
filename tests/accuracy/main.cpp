/// `hemitex_accuracy FILE.md`: measures extreme scenes and writes docs/accuracy.md.
#include <fstream>
#include <iostream>

#include "tests/accuracy/page.h"

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: hemitex_accuracy FILE.md\n";
    return 2;
  }
  std::string page = hemitex::accuracy::introduction();
  for (const hemitex::accuracy::Section& section : hemitex::accuracy::sections()) {
    std::cerr << section.title << '\n';
    page += section.make();
  }
  std::ofstream(arguments[1]) << page;
}
