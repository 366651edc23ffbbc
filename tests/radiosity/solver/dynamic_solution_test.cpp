// Dynamic scenes: an updated solution equals a new one within the residual, for all kinds of edits.
#include "radiosity/solver/dynamic_solution.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/row_update.h"
#include "radiosity/light/light.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "raster/software/software_renderer.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

constexpr double residual = 0.002;

/// A closed room with a lamp under its ceiling and two boxes on its floor.
Scene lampRoom() {
  std::vector<Surface> surfaces = tests::box("room", {0, 0, 0}, {4, 3, 2}, true);
  for (const auto& [name, low, size] : {std::tuple{"cube", glm::dvec3(1, 1, 0), glm::dvec3(0.75, 0.75, 0.75)},
                                        std::tuple{"post", glm::dvec3(2.5, 2, 0), glm::dvec3(0.25, 0.25, 1.5)}}) {
    std::vector<Surface> box = tests::box(name, low, size, false);
    for (std::size_t face = 1; face < box.size(); ++face) {
      box[face].family = name;
      surfaces.push_back(box[face]);
    }
  }
  surfaces.push_back(tests::parallelogram("lamp", {1.5, 1.25, 1.875}, {0, 0.5, 0}, {0.75, 0, 0}));
  Scene scene;
  scene.materials = {tests::material("wall", {0.7, 0.6, 0.5}, glm::dvec3(0)),
                     tests::material("lamp", glm::dvec3(0.2), {9, 8, 7})};
  surfaces.back().material = 1;
  scene.surfaces = std::move(surfaces);
  return tests::finish(std::move(scene));
}

IdLayout layOutIds(const Discretization& discretization) { return layOut(discretization); }

DynamicSettings settings(double limit = residual) {
  return {{.texels = 6, .surfaceTexels = {{"lamp", 1}}, .isUnburied = true, .patch = 2},
          {.resolution = 48, .orientation = Orientation::Turned, .split = 0.2},
          {.residual = limit}};
}

DynamicSolution solved(const DynamicSettings& some, const RendererFactory& makeRenderer = softwareRenderer,
                       const Scene& scene = lampRoom()) {
  const LightHooks hooks{.layOut = layOutIds, .makeRenderer = makeRenderer};
  return editable(
      scene,
      light(scene, discretize(scene, some.discretization),
            {.drawing = some.drawing, .solver = some.solver, .elements = some.discretization, .isContinued = true},
            hooks),
      hooks);
}

std::unique_ptr<DynamicSolution> solved(double limit = residual) {
  return std::unique_ptr<DynamicSolution>(new DynamicSolution(solved(settings(limit))));
}

/// The current scene, solved from its emission on with the same patches.
ShotLight freshLight(const DynamicSolution& dynamic, const DrawingSettings& drawing, double limit = residual) {
  SceneFormFactors drawn(dynamic.scene(), dynamic.discretization(), dynamic.layout(), drawing);
  return solve({.scene = dynamic.scene(),
                .discretization = dynamic.discretization(),
                .patches = dynamic.discretization().patches,
                .rowOf = drawn.rowOf(),
                .settings = {.residual = limit},
                .outside = drawn.outsideFlux(),
                .isContinued = true})
      .continuation->light;
}

/// The difference of what elements absorb, bands summed.
double differenceOfAbsorbed(const DynamicSolution& dynamic, const ShotLight& light) {
  double sum = 0;
  for (std::uint32_t e = 0; e < light.received.size(); ++e) {
    const glm::dvec3 absorbs = 1.0 - reflectance(dynamic.scene(), dynamic.discretization(), e);
    for (std::size_t band = 0; band < 3; ++band)
      sum += absorbs[static_cast<int>(band)] * std::abs(dynamic.light().received[e][band] - light.received[e][band]);
  }
  return sum;
}

void checkAccount(const Energy& energy, double scale) {
  for (std::size_t band = 0; band < 3; ++band)
    CHECK(std::abs(energy.absorbed[band] + energy.unshot[band] + energy.lost[band] - energy.emitted[band]) <=
          1e-12 * scale);
}

/// Checks the error bound of dynamic_solution.h.
void checkIsFresh(const DynamicSolution& dynamic, const DrawingSettings& drawing = settings().drawing) {
  const double scale = dynamic.light().lastEmitted;
  CHECK(dynamic.solution().residual <= residual);
  checkAccount(dynamic.solution().energy, scale);
  CHECK(differenceOfAbsorbed(dynamic, freshLight(dynamic, drawing)) <= 2 * residual * scale);
}

/// The share of the light that the second row sends elsewhere.
std::uint64_t redirected(const FormFactorRow& before, const FormFactorRow& after) {
  std::map<std::uint32_t, std::uint64_t> shares;
  for (std::size_t i = 0; i < before.elements.size(); ++i) shares[before.elements[i]] = before.shares[i];
  const auto more = [](std::uint64_t had, std::uint64_t has) { return has > had ? has - had : 0; };
  std::uint64_t sum = more(before.background, after.background) + more(before.back, after.back);
  for (std::size_t i = 0; i < after.elements.size(); ++i) sum += more(shares[after.elements[i]], after.shares[i]);
  return sum;
}

/// Counts what is drawn.
struct Drawn {
  std::uint64_t faces = 0, pixels = 0;
};
class CountingRenderer final : public raster::ItemBufferRenderer {
 public:
  CountingRenderer(raster::DrawList list, Drawn& drawn) : renderer_(std::move(list)), drawn_(drawn) {}
  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override {
    renderer_.draw(faces, skipped, buffers, drawn);
    drawn_.faces += buffers.size();
    for (const raster::ItemBuffer& buffer : buffers) drawn_.pixels += buffer.ids.size();
  }

 private:
  raster::SoftwareRenderer renderer_;
  Drawn& drawn_;
};

/// Rows of a scene before and after its cube moves.
struct MovedCube {
  EditedScene edit;
  SceneFormFactors before, after;
  std::vector<bool> isCube;  ///< one per surface
  SceneChange change;

  MovedCube(const Scene& scene, const Discretization& discretization, int resolution)
      : edit(edited(scene, {}, {{Move{"cube", {0.5, 0.25, 0.125}}}})),
        before(scene, discretization, layOutIds(discretization), unsplit(resolution)),
        after(edit.scene, discretization, layOutIds(discretization), unsplit(resolution)),
        isCube(cubesOf(scene)),
        change{before.uncorrected(), after.uncorrected(), {scene, isCube}, {edit.scene, isCube}} {}

  static DrawingSettings unsplit(int resolution) {
    return {.resolution = resolution, .orientation = Orientation::Turned, .split = 1};
  }

  static std::vector<bool> cubesOf(const Scene& scene) {
    std::vector<bool> isCube;
    for (const Surface& surface : scene.surfaces) isCube.push_back(surface.family == "cube");
    return isCube;
  }
};

}  // namespace

TEST_CASE(
    "DynamicSolution::update equals a new solution of the edited scene within the residual, and its account closes",
    "[dynamic]") {
  const std::vector<std::vector<Edit>> frames = {
      {Move{"cube", {0.5, 0.25, 0}}},
      {Move{"cube", {0.5, 0, 0}}, Move{"post", {0, -0.5, 0.125}}},
      {Remove{"post"}},
      {SetReflectance{"room0", {0.1, 0.9, 0.5}}},
      {SetEmission{"lamp", glm::dvec3(0)}, SetEmission{"room5", {1, 2, 3}}},
      {Restore{"post"}, Remove{"cube"}},
      {SetEmission{"lamp", {9, 8, 7}}, SetEmission{"room5", glm::dvec3(0)}, SetReflectance{"lamp", glm::dvec3(0)}},
      {Restore{"cube"}, Move{"cube", {-1, -0.25, 0}}, SetReflectance{"cube", {0.9, 0.1, 0.1}}},
  };
  const auto dynamic = solved();
  checkIsFresh(*dynamic);
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    INFO("frame " << frame);
    dynamic->update(frames[frame]);
    checkIsFresh(*dynamic);
  }
}

TEST_CASE("A solution that edits go on from has the bits of one without edits", "[dynamic]") {
  // Small elements, on the post and the lamp, are near patches, so that rows are corrected.
  const DynamicSettings some = settings();
  const Scene scene = lampRoom();
  const Light alone = light(scene, discretize(scene, some.discretization),
                            {.drawing = some.drawing, .solver = some.solver, .elements = some.discretization});
  SceneFormFactors drawn(scene, alone.discretization, alone.layout, some.drawing);
  const std::vector<Patch>& patches = alone.discretization.patches.list;
  CHECK(std::any_of(patches.begin(), patches.end(), [&](const Patch& patch) {
    return drawn.corrected(patch, drawn.uncorrected().ofPatch(patch)).has_value();
  }));
  const auto dynamic = solved();
  CHECK(dynamic->solution().shots == alone.solution.shots);
  CHECK(dynamic->solution().radiosity == alone.solution.radiosity);
}

TEST_CASE("DynamicSolution::update lights the floor under an object that moved away as if it had never been there",
          "[dynamic]") {
  // Compared with a scene that starts without the object. A floor that stays buried would give its light to the
  // elements beside it, or to none.
  const auto dynamic = solved();
  dynamic->update({{Remove{"cube"}}});
  const EditedScene edit = edited(lampRoom(), {}, {{Remove{"cube"}}});
  const DynamicSolution fresh = solved(settings(), softwareRenderer, edit.scene);
  REQUIRE(fresh.scene().surfaces[0].name == dynamic->scene().surfaces[0].name);
  const Grid &grid = dynamic->discretization().grids[0], &freshGrid = fresh.discretization().grids[0];
  double different = 0, all = 0;
  for (std::size_t texel = 0; texel < grid.elementOfTexel.size(); ++texel) {
    const double expected = fresh.solution().radiosity[freshGrid.elementOfTexel[texel]].x;
    different += std::abs(dynamic->solution().radiosity[grid.elementOfTexel[texel]].x - expected);
    all += expected;
  }
  // Patches were split where the first solution was bright, and hemicubes of 48 pixels are coarse, so that both differ
  // by a few percent. If the four of 36 texels under the cube stayed dark, it would be a tenth.
  CHECK(different < 0.05 * all);
}

TEST_CASE("DynamicSolution::update gives a restored object the texels of the original scene", "[dynamic]") {
  // Their size is derived from the scene, not from the object.
  DynamicSettings following = settings(0.1);
  following.discretization = {.isUnburied = true};
  DynamicSolution dynamic = solved(following);
  const auto sizes = [&] {
    std::map<std::string, std::pair<int, int>> grids;
    for (std::size_t s = 0; s < dynamic.scene().surfaces.size(); ++s)
      grids[dynamic.scene().surfaces[s].name] = {dynamic.discretization().grids[s].columns,
                                                 dynamic.discretization().grids[s].rows};
    return grids;
  };
  const auto before = sizes();
  dynamic.update({{Remove{"post"}}});
  dynamic.update({{Restore{"post"}}});
  CHECK(sizes() == before);
}

TEST_CASE("DynamicSolution::update of a move and its reverse keeps the solution within the residual", "[dynamic]") {
  const auto dynamic = solved();
  const ShotLight before = dynamic->light();
  dynamic->update({{Move{"cube", {0.5, 0.5, 0}}}});
  CHECK(differenceOfAbsorbed(*dynamic, before) > 2 * residual * before.lastEmitted);
  dynamic->update({{Move{"cube", {-0.5, -0.5, 0}}}});
  CHECK(differenceOfAbsorbed(*dynamic, before) <= 2 * residual * before.lastEmitted);
}

TEST_CASE("DynamicSolution::update without an edit shoots and draws nothing", "[dynamic]") {
  const auto dynamic = solved();
  const std::vector<glm::dvec3> before = dynamic->solution().radiosity;
  const UpdateCost cost = dynamic->update({});
  CHECK(dynamic->solution().shots == 0);
  CHECK(cost.rowsInWindows + cost.rowsWhole + cost.rowsRetracted + cost.rowsLeft == 0);
  for (std::size_t e = 0; e < before.size(); ++e)
    for (int band = 0; band < 3; ++band)
      CHECK(dynamic->solution().radiosity[e][band] == Approx(before[e][band]).epsilon(1e-12));
}

TEST_CASE("DynamicSolution::update with the only light off gets dark within the residual of the former emission",
          "[dynamic]") {
  const auto dynamic = solved();
  dynamic->update({{SetEmission{"lamp", glm::dvec3(0)}}});
  CHECK(areZero(dynamic->solution().energy.emitted));
  CHECK(dynamic->solution().shots > 0);
  checkIsFresh(*dynamic);
}

TEST_CASE("changeOf in windows is the exact difference of the rows before and after", "[dynamic]") {
  Scene scene = lampRoom();
  const Discretization discretization = discretize(scene, settings().discretization);
  MovedCube moved(scene, discretization, 64);
  auto& [edit, before, after, isCube, change] = moved;
  int windows = 0, whole = 0, nothing = 0;
  for (const Patch& patch : discretization.patches.list) {
    if (isCube[patch.surface]) continue;
    const FormFactorRow old = before.uncorrected().ofPatch(patch), now = after.uncorrected().ofPatch(patch);
    const RowChange difference = changeOf(change, patch, patch);
    const FormFactorRow updated = exchanged(old, difference.before, difference.after);
    CHECK(updated.elements == now.elements);
    CHECK(updated.shares == now.shares);
    CHECK(updated.background == now.background);
    CHECK(updated.back == now.back);
    ++(difference.isNothing() ? nothing : difference.isWhole ? whole : windows);
    // No more light is redirected than the bound allows.
    const SurfacePoint centre = patchCentre(scene, discretization, patch);
    const double pixel = pixelAngle(after.uncorrected().projection());
    const double bound =
        std::min(1.0, change.gone.largestShare(centre, pixel) + change.come.largestShare(centre, pixel));
    CHECK(formFactor(redirected(old, now)) <= bound);
  }
  CHECK(windows > 50);
  CHECK(nothing > 10);
  CHECK(whole < windows / 2);
}

TEST_CASE("changeOf the mean of several points' rows is the change of the mean, within rounding", "[dynamic]") {
  Scene scene = lampRoom();
  Discretization discretization = discretize(scene, settings().discretization);
  for (Patch& patch : discretization.patches.list) patch.points = 2;
  MovedCube moved(scene, discretization, 32);
  auto& [edit, before, after, isCube, change] = moved;
  const auto add = [](std::vector<double>& sums, const FormFactorRow& row, double sign) {
    for (std::size_t i = 0; i < row.elements.size(); ++i) sums[row.elements[i]] += sign * formFactor(row.shares[i]);
    sums.back() += sign * formFactor(row.background + row.back);
  };
  int changed = 0;
  for (const Patch& patch : discretization.patches.list) {
    if (isCube[patch.surface]) continue;
    const RowChange difference = changeOf(change, patch, patch);
    CHECK_FALSE(difference.isWhole);
    changed += difference.isRounded ? 1 : 0;
    std::vector<double> sums(discretization.elements.size() + 1);
    add(sums, before.uncorrected().ofPatch(patch), -1);
    add(sums, difference.before, 1);
    add(sums, difference.after, -1);
    add(sums, after.uncorrected().ofPatch(patch), 1);
    // Four sums of form factors up to 1 in double precision, and the units of 2^-60 that the largest share takes.
    for (const double sum : sums) CHECK(std::abs(sum) <= 4 * 0x1p-52);
  }
  CHECK(changed > 50);
}

TEST_CASE("DynamicSolution::update follows patches with fewer views than points", "[dynamic]") {
  // Half of the points of an element at the long side of a triangle have no area.
  Scene scene = lampRoom();
  Surface sail = tests::parallelogram("sail", {0.5, 0.5, 1.25}, {1.5, 0, 0.25}, {0, 1.5, 0.25});
  sail.triangles.resize(1);
  scene.surfaces.insert(scene.surfaces.begin(), sail);
  measureBounds(scene);
  DynamicSettings split = settings();
  split.drawing.split = 0.001;
  DynamicSolution dynamic = solved(split, softwareRenderer, scene);
  SceneFormFactors drawn(dynamic.scene(), dynamic.discretization(), dynamic.layout(), split.drawing);
  const std::vector<Patch>& patches = dynamic.discretization().patches.list;
  CHECK(std::any_of(patches.begin(), patches.end(), [&](const Patch& patch) {
    return drawn.uncorrected().pointsOfPatch(patch).size() < static_cast<std::size_t>(patch.points * patch.points);
  }));
  dynamic.update({{Move{"cube", {0.5, 0.25, 0}}}});
  checkIsFresh(dynamic, split.drawing);
  dynamic.update({{Move{"cube", {-0.5, 0, 0}}}});
  checkIsFresh(dynamic, split.drawing);
}

TEST_CASE("DynamicSolution::update along other rows updates light, and solves again where objects move", "[dynamic]") {
  // Rows that are not drawn, such as those of rays or of a matrix, have no windows.
  const DynamicSettings some = settings();
  const Scene scene = lampRoom();
  int made = 0;
  const LightHooks hooks{.layOut = layOutIds, .rows = [&made](PatchRows drawn, const Scene&, const Discretization&) {
                           ++made;
                           return drawn;
                         }};
  DynamicSolution dynamic = editable(
      scene,
      light(scene, discretize(scene, some.discretization),
            {.drawing = some.drawing, .solver = some.solver, .elements = some.discretization, .isContinued = true},
            hooks),
      hooks);
  CHECK_FALSE(dynamic.update({{SetEmission{"lamp", {4, 4, 4}}}}).startedOver);
  checkIsFresh(dynamic);
  CHECK(dynamic.update({{Move{"cube", {0.5, 0.25, 0}}}}).startedOver);
  checkIsFresh(dynamic);
  CHECK_FALSE(dynamic.update({{SetReflectance{"room0", {0.1, 0.9, 0.5}}}}).startedOver);
  checkIsFresh(dynamic);
  CHECK(made == 4);
}

TEST_CASE("DynamicSolution::update draws a small part of what a new solution draws", "[dynamic]") {
  // Counts, because times differ between machines. A small object with one patch per face, while the old rows are still
  // in the cache. The update draws the rows of its new place and windows around both places.
  Drawn drawn;
  const auto counting = [&](raster::DrawList list) {
    return std::make_unique<CountingRenderer>(std::move(list), drawn);
  };
  DynamicSettings unsplit = settings();
  unsplit.drawing.split = 1;
  unsplit.discretization.surfaceTexels["post"] = 1;
  DynamicSolution dynamic = solved(unsplit, counting);
  const Drawn fresh = std::exchange(drawn, {});
  const UpdateCost cost = dynamic.update({{Move{"post", {0.125, 0, 0}}}});
  const Drawn update = std::exchange(drawn, {});
  CHECK(cost.rowsInWindows > 50);
  CHECK(5 * update.pixels < fresh.pixels);
  CHECK(10 * update.pixels > fresh.pixels);
  checkIsFresh(dynamic, unsplit.drawing);
}

TEST_CASE("DynamicSolution::update after a move draws no view of patches with several points twice", "[dynamic]") {
  // Windows update the rows of views exactly, and means are computed from these. A dimmed lamp is shot along cached
  // rows. Exceptions are the few patches that had not shot before, kept stale rows or moved.
  Drawn drawn;
  const auto counting = [&](raster::DrawList list) {
    return std::make_unique<CountingRenderer>(std::move(list), drawn);
  };
  DynamicSettings split = settings();
  split.drawing.split = 0.005;
  DynamicSolution dynamic = solved(split, counting);
  const auto& patches = dynamic.discretization().patches.list;
  CHECK(std::count_if(patches.begin(), patches.end(), [](const Patch& patch) { return patch.points > 1; }) > 100);
  const Drawn fresh = std::exchange(drawn, {});
  dynamic.update({{Move{"post", {0.125, 0, 0}}}});
  drawn = {};
  dynamic.update({{SetEmission{"lamp", {4, 4, 4}}}});
  CHECK(dynamic.solution().shots > 100);
  CHECK(20 * drawn.pixels < fresh.pixels);
}

TEST_CASE("DynamicSolution::update gives the same bits for any number of threads and any row cache", "[dynamic]") {
  const auto solveWith = [](int threads, std::size_t cache) {
    const raster::ThreadLimit limit(threads);
    DynamicSettings some = settings(0.02);
    some.solver.rowCacheBytes = cache;
    DynamicSolution dynamic = solved(some);
    dynamic.update({{Move{"cube", {0.5, 0.25, 0}}, Remove{"post"}}});
    dynamic.update({{Restore{"post"}}});
    return std::pair{dynamic.solution().radiosity, dynamic.solution().shots};
  };
  const auto reference = solveWith(1, std::size_t{1} << 30);
  for (const auto& [threads, cache] :
       {std::pair{2, std::size_t{0}}, {7, std::size_t{20000}}, {2, std::size_t{1} << 30}})
    CHECK(solveWith(threads, cache) == reference);
}

TEST_CASE("DynamicSolution lets the light of the sky and the sun follow objects", "[dynamic]") {
  Scene open = lampRoom();
  open.surfaces.erase(open.surfaces.begin() + 1);
  open.outside = {{2, 3, 4}, {{glm::normalize(glm::dvec3(0.3, 0.2, 1)), {9, 8, 7}}}};
  DynamicSolution dynamic = solved(settings(), softwareRenderer, open);
  const Bands emitted = dynamic.solution().energy.emitted;
  checkIsFresh(dynamic);
  dynamic.update({{Edit(Move{"cube", {0.75, 0.5, 1.0}})}});
  checkIsFresh(dynamic);
  CHECK(dynamic.solution().energy.emitted != emitted);
  dynamic.update({{Edit(Remove{"post"}), Edit(SetReflectance{"room0", {0.1, 0.2, 0.3}})}});
  checkIsFresh(dynamic);
}
