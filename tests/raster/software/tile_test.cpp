// drawTile gives the same pixels with all instruction sets.
#include "raster/software/tile.h"

#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "raster/kernels/run_kernels.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::tests;

TEST_CASE("simdDepthKernels and the other lists have the kernels of each instruction set once", "[kernels]") {
  std::set<std::string> names;
  for (const raster::DepthKernels& kernels : raster::simdDepthKernels()) names.insert(kernels.name);
  CHECK(names.size() == raster::simdDepthKernels().size());
  CHECK(raster::simdVertexKernels().size() == names.size());
  CHECK(raster::simdSmallTriangleKernels().size() == names.size());
  CHECK(raster::simdTexelKernels().size() == names.size());
  CHECK(raster::simdRunKernels().size() == names.size());
}

TEST_CASE("drawTile gives the same item buffers with each instruction set", "[kernels]") {
  const std::vector<raster::Face> faces = facesAndParts();
  for (const raster::DrawList& list : {crossingTriangles(), smallTriangles(200)}) {
    const auto ids = [&](const raster::TileKernels& kernels) {
      std::vector<raster::ItemId> all;
      for (const raster::ItemBuffer& buffer : render(raster::SoftwareRenderer(list, kernels), faces, {}))
        all.insert(all.end(), buffer.ids.begin(), buffer.ids.end());
      return all;
    };
    const std::vector<raster::ItemId> plain = ids({raster::plainVertexKernels(), raster::plainSmallTriangleKernels(),
                                                   raster::plainDepthKernels(), raster::plainTexelKernels()});
    for (std::size_t k = 0; k < raster::simdDepthKernels().size(); ++k) {
      const raster::TileKernels kernels{raster::simdVertexKernels()[k], raster::simdSmallTriangleKernels()[k],
                                        raster::simdDepthKernels()[k], raster::simdTexelKernels()[k]};
      INFO(kernels.depth.name);
      for (const std::string& name : {kernels.vertices.name, kernels.smallTriangles.name, kernels.texels.name})
        CHECK(name == kernels.depth.name);
      CHECK(ids(kernels) == plain);
    }
  }
}
