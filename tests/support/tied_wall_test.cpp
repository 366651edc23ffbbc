// The walls whose drawing is timed.
#include "tests/support/tied_wall.h"

#include <catch2/catch.hpp>

#include "raster/software/software_renderer.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/draw_list_builder.h"

using namespace hemitex;
using namespace hemitex::reference;
using tests::tiedWall;

TEST_CASE("tiedWall is the vector borders-on-samples", "[bench]") {
  const std::vector<TestVector> vectors = texelVectors();
  const auto named = std::find_if(vectors.begin(), vectors.end(),
                                  [](const TestVector& vector) { return vector.name == "borders-on-samples"; });
  REQUIRE(named != vectors.end());
  const raster::DrawList wall = tiedWall(32, 0);
  CHECK(wall.positions == named->list.positions);
  CHECK(wall.texcoords == named->list.texcoords);
  CHECK(wall.indices == named->list.indices);
  CHECK(wall.indexMaps.at(0).ids == named->list.indexMaps.at(0).ids);
}

TEST_CASE("tiedWall moved by a third of a pixel shows the same texels, moved by one pixel", "[bench]") {
  // Sample i lies at i + 1/2 pixels, on the border of a texel. After the move to the right it shows the texel before.
  constexpr int resolution = 16;
  const raster::Face face = frontFace(resolution, 0.5f);
  const auto drawn = [&face](double moved) {
    return render(raster::SoftwareRenderer(tiedWall(resolution, moved)), {&face, 1}, {}).front();
  };
  const raster::ItemBuffer tied = drawn(0), moved = drawn(1.0 / 3);
  for (int row = 1; row < resolution; ++row)
    for (int column = 1; column < resolution; ++column) {
      const auto pixel = static_cast<std::size_t>(row * resolution + column);
      CHECK(tied.ids[pixel] == moved.ids[pixel] + resolution + 1);
    }
}
