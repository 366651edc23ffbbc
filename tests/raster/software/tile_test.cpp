// drawTile gives the same pixels with all instruction sets.
#include "raster/software/tile.h"

#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "raster/kernels/run_kernels.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::tests;

TEST_CASE("simdKernels has the kernels of each instruction set once", "[kernels]") {
  std::set<std::string> names;
  for (const raster::DepthKernels& kernels : raster::simdKernels<raster::DepthKernels>()) names.insert(kernels.name);
  CHECK(names.size() == raster::simdKernels<raster::DepthKernels>().size());
  CHECK(raster::simdKernels<raster::VertexKernels>().size() == names.size());
  CHECK(raster::simdKernels<raster::SmallTriangleKernels>().size() == names.size());
  CHECK(raster::simdKernels<raster::TexelKernels>().size() == names.size());
  CHECK(raster::simdKernels<raster::RunKernels>().size() == names.size());
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
    const std::vector<raster::ItemId> plain =
        ids({raster::scalarKernels<raster::VertexKernels>(), raster::scalarKernels<raster::SmallTriangleKernels>(),
             raster::scalarKernels<raster::DepthKernels>(), raster::scalarKernels<raster::TexelKernels>()});
    for (std::size_t k = 0; k < raster::simdKernels<raster::DepthKernels>().size(); ++k) {
      const raster::TileKernels kernels{
          raster::simdKernels<raster::VertexKernels>()[k], raster::simdKernels<raster::SmallTriangleKernels>()[k],
          raster::simdKernels<raster::DepthKernels>()[k], raster::simdKernels<raster::TexelKernels>()[k]};
      INFO(kernels.depth.name);
      for (const std::string& name : {kernels.vertices.name, kernels.smallTriangles.name, kernels.texels.name})
        CHECK(name == kernels.depth.name);
      CHECK(ids(kernels) == plain);
    }
  }
}
