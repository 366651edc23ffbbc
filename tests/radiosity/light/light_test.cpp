/// light(): the rows and the bits of its solutions are those of all other ways to them.
#include "radiosity/light/light.h"

#include <catch2/catch.hpp>
#include <map>
#include <string>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/scene/load_scene.h"
#include "reference/rows/scene_rows.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// Scenes of data/ with their numbers of texels. In the furnished room small elements stand on large patches.
const std::map<std::string, int> scenes{
    {"cornell-box", 4}, {"pyramid-room", 4}, {"paper-room", 4}, {"furnished-room", 4}, {"curved-room", 4}};

Scene sceneNamed(const std::string& name) { return loadScene(HEMITEX_DATA "/" + name + ".obj"); }

/// One patch per surface, which is not split; rows are corrected.
constexpr DrawingSettings whole{.resolution = 64, .split = 0.999};

struct ShotRow {
  Patch patch;
  FormFactorRow row;
};

/// The rows that a solution shoots along from whole surfaces. Rows of faint patches, which have fewer pixels, are left
/// out.
std::vector<ShotRow> shotRows(const Scene& scene, const Discretization& discretization) {
  std::vector<ShotRow> shot;
  const LightHooks hooks{.rows = [&](PatchRows drawn, const Scene&, const Discretization&) {
    const RowSource rowOf = drawn.rowOf;
    drawn.rowOf = [&shot, &discretization, rowOf](const Patch& patch) {
      FormFactorRow row = rowOf(patch);
      if (patch.halvings == 0 && patch.points == 1 &&
          patch.elements.size() == discretization.grids[patch.surface].elementCount)
        shot.push_back({patch, row});
      return row;
    };
    return drawn;
  }};
  light(scene, discretization, {.drawing = whole, .solver = {.residual = 0.1}}, hooks);
  return shot;
}

void checkEqual(const FormFactorRow& a, const FormFactorRow& b) {
  CHECK(a.elements == b.elements);
  CHECK(a.shares == b.shares);
  CHECK(a.background == b.background);
  CHECK(a.back == b.back);
}

}  // namespace

TEST_CASE("light shoots along SceneFormFactors::row, whose values are those of drawnMethod", "[light]") {
  std::size_t rows = 0, corrected = 0;
  for (const auto& [name, texels] : scenes) {
    INFO(name);
    const Scene scene = sceneNamed(name);
    const Discretization discretization = discretize(scene, {.texels = texels, .patch = texels});
    SceneFormFactors drawn(scene, discretization, layOut(discretization), whole);
    const reference::RowReceivers receivers = reference::elementsAsReceivers(discretization);
    const reference::RowMethod method =
        reference::drawnMethod(scene, discretization, receivers, layOut(discretization), whole);
    for (const auto& [from, shot] : shotRows(scene, discretization)) {
      checkEqual(shot, drawn.row(from));
      ++rows;
      if (drawn.corrected(from, drawn.uncorrected().ofPatch(from))) ++corrected;
      reference::SparseRow found = method.row({{from.surface}});
      const reference::OutsideShares outside = found.takeOutside(receivers.area.size());
      REQUIRE(found.column == shot.elements);
      for (std::size_t k = 0; k < shot.shares.size(); ++k) CHECK(found.value[k] == formFactor(shot.shares[k]));
      CHECK(outside.surroundings == formFactor(shot.background));
      CHECK(outside.backs == formFactor(shot.back));
    }
  }
  CHECK(rows > 20);
  CHECK(corrected > 0);
}
