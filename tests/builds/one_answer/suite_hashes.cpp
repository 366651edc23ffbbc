/// Prints the hashes of the vector suite's item IDs, which tests/builds/one_answer.sh compares.
///
///     hemitex_suite_hashes THREADS [VECTOR...]
///
/// draws the vectors of vectorSuite() and those in the given folders, and prints suiteHashes.
#include "tests/support/suite_hashes.h"

#include <cstdio>
#include <cstdlib>
#include <string>

#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "reference/conformance/suite/vector_suite.h"

using namespace hemitex;

int main(int count, char** arguments) {
  if (count < 2) {
    std::fputs("usage: hemitex_suite_hashes THREADS [VECTOR...]\n", stderr);
    return 2;
  }
  try {
    const raster::ThreadLimit limit(std::atoi(arguments[1]));
    std::vector<reference::TestVector> suite = reference::vectorSuite();
    for (int k = 2; k < count; ++k) suite.push_back(reference::readVector(arguments[k]));
    std::fputs(tests::suiteHashes(suite).c_str(), stdout);
    return 0;
  } catch (const raster::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
