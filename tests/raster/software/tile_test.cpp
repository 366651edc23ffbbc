// drawTile gives the pixels of the plain renderer with each instruction set.
#include "raster/software/tile.h"

#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "raster/kernels/kernels.h"
#include "raster/plain/plain_renderer.h"
#include "raster/software/software_renderer.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::tests;

TEST_CASE("allKernels has each instruction set once", "[kernels]") {
  std::set<std::string> names;
  for (const raster::Kernels& kernels : raster::allKernels()) names.insert(kernels.instructionSet);
  CHECK(!names.empty());
  CHECK(names.size() == raster::allKernels().size());
}

TEST_CASE("drawTile gives the item buffers of PlainRenderer with each instruction set", "[kernels]") {
  const std::vector<raster::Face> faces = facesAndParts();
  for (const raster::DrawList& list : {crossingTriangles(), smallTriangles(200)}) {
    const std::vector<raster::ItemBuffer> plain = render(raster::PlainRenderer(list), faces);
    for (const raster::Kernels& kernels : raster::allKernels()) {
      INFO(kernels.instructionSet);
      const std::vector<raster::ItemBuffer> found = render(raster::SoftwareRenderer(list, kernels), faces);
      for (std::size_t f = 0; f < faces.size(); ++f) CHECK(found[f].ids == plain[f].ids);
    }
  }
}
