/// Judges a drawing of the first test vector by the installed hemitex::vectors; returns 0 if the right item IDs pass
/// and wrong ones fail.
#include <iostream>

#include "raster/software/software_renderer.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/vector_file.h"
#include "reference/conformance/verdict/verdict.h"

int main() {
  using namespace hemitex;
  const reference::TestVector vector = reference::vectorSuite().front();
  raster::SoftwareRenderer renderer(vector.list);
  const std::vector<raster::ItemBuffer> expected = render(renderer, reference::facesOf(vector), {});
  std::vector<raster::ItemBuffer> wrong = expected;
  for (raster::ItemId& id : wrong.front().ids) id = raster::backgroundId(vector.list.format);

  const bool right = !hasErrors(judge(vector, expected, expected, {})) && hasErrors(judge(vector, expected, wrong, {}));
  std::cout << "hemitex::vectors " << (right ? "judges right\n" : "judges wrong\n");
  return right ? 0 : 1;
}
