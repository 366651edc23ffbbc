// Invariants of whole scenes under changes that need no reference: rotation, another order of surfaces and polygons, an
// added occluder, another number of threads.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <numeric>
#include <random>
#include <sstream>
#include <tuple>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/base/parallel.h"
#include "reference/truth/closed_forms/point_to_polygon.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/hemicube_world.h"
#include "tests/support/outline_bound.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using World = hemitex::tests::HemicubeWorld;

namespace {

constexpr int resolution = 64;

struct NamedScene {
  std::string name;
  Scene scene;
};

std::vector<NamedScene> tableOfScenes() {
  std::vector<NamedScene> scenes{{"cube", tests::closedCube(glm::dvec3(0.5), glm::dvec3(1))},
                                 {"furnished room", tests::furnishedRoom()}};
  for (const std::string name : {"cornell-box", "paper-room", "pyramid-room", "curved-room"})
    scenes.push_back({name, loadScene(HEMITEX_DATA "/" + name + ".obj")});
  return scenes;
}

/// The scene with a linear map applied to all positions.
Scene mapped(Scene scene, const glm::dmat3& map) {
  for (Surface& surface : scene.surfaces)
    for (Triangle& triangle : surface.triangles)
      for (glm::dvec3& corner : triangle.position) corner = map * corner;
  return tests::finish(std::move(scene));
}

/// Stretches the axes by different factors that are no powers of two. This removes outlines at 45 degrees from a
/// centre, which pass through the samples of a hemicube.
Scene stretched(const Scene& scene) {
  return mapped(scene, glm::dmat3(glm::dvec3(1.137, 0, 0), glm::dvec3(0, 0.913, 0), glm::dvec3(0, 0, 1.291)));
}

glm::dmat3 anyRotation(std::mt19937& random) {
  std::normal_distribution<double> gauss;
  const auto direction = [&] {
    const double x = gauss(random), y = gauss(random), z = gauss(random);
    return glm::normalize(glm::dvec3(x, y, z));
  };
  const glm::dvec3 a = direction(), b = glm::normalize(glm::cross(a, direction()));
  return {a, b, glm::cross(a, b)};
}

/// About a dozen patches all over the scene.
std::vector<std::uint32_t> somePatches(const Discretization& discretization) {
  std::vector<std::uint32_t> patches;
  const auto count = static_cast<std::uint32_t>(discretization.patches.list.size());
  for (std::uint32_t p = 0; p < count; p += std::max(1u, count / 12)) patches.push_back(p);
  return patches;
}

/// The shares of all elements, then those of the background and of backs.
using Shares = std::vector<std::uint64_t>;

Shares sharesOf(const World& world, const FormFactorRow& row) {
  Shares shares(world.discretization.elements.size() + 2, 0);
  for (std::size_t i = 0; i < row.elements.size(); ++i) shares[row.elements[i]] = row.shares[i];
  shares[shares.size() - 2] = row.background;
  shares.back() = row.back;
  return shares;
}

/// The share that moved to other elements.
std::uint64_t moved(const Shares& a, const Shares& b) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] > b[i] ? a[i] - b[i] : 0;
  return sum;
}

/// The share of the samples of one line across a hemicube, through the middles of three faces, where it is largest.
///
/// That much may depend on the order of draws or on the rotation of the hemicube. An outline is snapped to 1/256 of a
/// pixel, and sometimes passes exactly through a line of samples. There the fill rule decides between neighbours. If a
/// front and a back share the outline, their depths are equal and the first drawn is visible.
std::uint64_t shareOfLine(int pixels) {
  const Projection projection = hemicube(pixels);
  std::uint64_t sum = 0;
  for (int j = 0; j < pixels; ++j) sum += shareOf(projection, 0, pixels / 2, j);
  for (int j = pixels / 2; j < pixels; ++j) sum += 2 * shareOf(projection, 1, pixels / 2, j);
  return sum;
}

/// The change of the delta form factors of a hemicube's top by a quarter turn about its normal: the last bit of their
/// sums.
std::uint64_t shareOfRounding(int pixels) {
  const Projection projection = hemicube(pixels);
  std::uint64_t sum = 0;
  for (int j = 0; j < pixels; ++j)
    for (int i = 0; i < pixels; ++i)
      sum += std::max(shareOf(projection, 0, i, j), shareOf(projection, 0, j, i)) - shareOf(projection, 0, j, i);
  return sum;
}

/// Counts equal rows, and rows changed by an outline through a line of samples.
struct RowComparison {
  std::uint64_t rounding;
  int same = 0, changed = 0;
  std::uint64_t most = 0;

  void add(const Shares& a, const Shares& b) {
    const std::uint64_t share = moved(a, b);
    (share <= rounding ? same : changed) += 1;
    most = std::max(most, share);
  }
  /// A sample is on an outline with a probability of 1 in 256. With a dozen upright outlines in a scene, that happens
  /// for one of 20 rows.
  void check() const {
    CHECK(changed * 20 <= same + changed);
    CHECK(most <= shareOfLine(resolution));
  }
};

/// The 24 rotations that map the axes to each other.
std::vector<glm::dmat3> quarterTurns() {
  const glm::dmat3 aboutX(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0));
  const glm::dmat3 aboutY(glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0));
  std::vector<glm::dmat3> turns{glm::dmat3(1)};
  for (std::size_t i = 0; i < turns.size(); ++i)
    for (const glm::dmat3& quarter : {aboutX, aboutY}) {
      const glm::dmat3 turn = quarter * turns[i];
      if (std::find(turns.begin(), turns.end(), turn) == turns.end()) turns.push_back(turn);
    }
  return turns;
}

/// A scene in another order, and the former places of its surfaces.
struct Permutation {
  Scene scene;
  std::vector<std::uint32_t> from;
};

/// Surfaces in another order, and the polygons of each; a polygon's triangles stay together.
Permutation permuted(const Scene& scene, std::mt19937& random) {
  Permutation result{scene, std::vector<std::uint32_t>(scene.surfaces.size())};
  std::iota(result.from.begin(), result.from.end(), 0u);
  std::shuffle(result.from.begin(), result.from.end(), random);
  for (std::size_t s = 0; s < result.from.size(); ++s) {
    Surface& surface = result.scene.surfaces[s] = scene.surfaces[result.from[s]];
    std::map<std::uint32_t, unsigned> place;
    for (const Triangle& triangle : surface.triangles) place.try_emplace(triangle.polygon, random());
    std::stable_sort(surface.triangles.begin(), surface.triangles.end(),
                     [&](const Triangle& a, const Triangle& b) { return place.at(a.polygon) < place.at(b.polygon); });
  }
  return result;
}

/// The number of an element or a patch in the permuted scene, from the first numbers of each surface.
template <typename First>
std::uint32_t numberIn(const World& permuted, const World& world, const std::vector<std::uint32_t>& from,
                       std::uint32_t surface, std::uint32_t number, const First& first) {
  const auto s = static_cast<std::size_t>(std::find(from.begin(), from.end(), surface) - from.begin());
  return permuted.discretization.grids[s].*first + number - world.discretization.grids[surface].*first;
}

/// Whether the hemicube is at the same place, over the same triangle. A centre where two polygons meet belongs to the
/// first of them, and the eye is moved into that polygon.
bool sameCentre(const World& a, std::uint32_t patchOfA, const World& b, std::uint32_t patchOfB) {
  const auto triangleUnder = [](const World& world, std::uint32_t patch) {
    const Patch& block = world.discretization.patches.list[patch];
    const SurfacePoint centre = patchCentre(world.scene, world.discretization, block);
    return world.scene.surfaces[block.surface].triangles[centre.triangle].position;
  };
  return triangleUnder(a, patchOfA) == triangleUnder(b, patchOfB);
}

/// With a quad in the middle of the scene, well inside its bounds.
Scene withOccluder(Scene scene, std::mt19937& random) {
  std::uniform_real_distribution<double> within(-0.06, 0.06);
  const auto vector = [&] {
    const double x = within(random), y = within(random), z = within(random);
    return scene.extent * glm::dvec3(x, y, z);
  };
  const glm::dvec3 corner = scene.origin + vector(), u = vector(), v = vector();
  scene.surfaces.push_back(tests::parallelogram("occluder", corner, u, v));
  return tests::finish(std::move(scene));
}

using Estimator = reference::MeasuredRow (reference::RayFormFactors::*)(const reference::RaySource&,
                                                                        const reference::Receivers&,
                                                                        const reference::Sampling&) const;
constexpr Estimator bothEstimators[] = {&reference::RayFormFactors::overHemisphere, &reference::RayFormFactors::aimed};

/// The form factors from a surface to all others, measured by rays.
struct RayWorld {
  Scene scene;
  Discretization discretization;
  reference::RayFormFactors rays;

  explicit RayWorld(Scene s)
      : scene(std::move(s)), discretization(discretize(scene, {.texels = 1})), rays(scene, discretization) {}

  reference::MeasuredRow row(Estimator estimator, std::uint32_t surface, int samples) const {
    const reference::RaySource shooter =
        reference::areaRaySource(rays.pieces(), reference::elementsOfSurface(discretization, surface));
    return (rays.*estimator)(shooter, reference::everyElement(discretization), {samples});
  }
};

}  // namespace

TEST_CASE("ProjectedFormFactors of a scene rotated by quarter turns have the same rows", "[metamorphic]") {
  // Coordinates only change places and signs, exactly, and so do those of an axis-aligned hemicube. Another hemicube is
  // rounded to binary32 differently, by 6e-8, which rarely changes a sample.
  for (const NamedScene& named : tableOfScenes()) {
    INFO(named.name);
    World world(stretched(named.scene), 8, 4);
    ProjectedFormFactors rows = world.rows(resolution);
    RowComparison comparison{shareOfRounding(resolution)};
    std::vector<glm::dmat3> turns = quarterTurns();
    if (triangleCount(world.scene) > 1000) turns.resize(4);
    for (const glm::dmat3& turn : turns) {
      World turned(mapped(world.scene, turn), 8, 4);
      ProjectedFormFactors turnedRows = turned.rows(resolution);
      for (const std::uint32_t patch : somePatches(world.discretization))
        comparison.add(sharesOf(world, rows.ofPatch(world.discretization.patches.list[patch])),
                       sharesOf(turned, turnedRows.ofPatch(turned.discretization.patches.list[patch])));
    }
    INFO(comparison.changed << " of " << comparison.same + comparison.changed << " rows changed");
    comparison.check();
  }
}

TEST_CASE("ProjectedFormFactors of a scaled or moved scene have the same rows, to the bit where coordinates stay exact",
          "[metamorphic]") {
  // Multiples of 2^-10 are still exact 2^20 away, and powers of two scale all intermediate values exactly.
  const auto moved = [](Scene scene, double scale, double by) {
    for (Surface& surface : scene.surfaces)
      for (Triangle& triangle : surface.triangles)
        for (glm::dvec3& corner : triangle.position) corner = scale * (glm::round(corner * 0x1p10) * 0x1p-10 + by);
    return tests::finish(std::move(scene));
  };
  for (const NamedScene& named : tableOfScenes()) {
    INFO(named.name);
    World world(moved(named.scene, 1, 0), 8, 4);
    ProjectedFormFactors rows = world.rows(resolution);
    for (const auto& [scale, by] : {std::pair{0x1p-20, 0.0}, {0x1p20, 0.0}, {1.0, 0x1p20}, {0x1p-20, -0x1p20}}) {
      World other(moved(named.scene, scale, by), 8, 4);
      ProjectedFormFactors otherRows = other.rows(resolution);
      for (const std::uint32_t patch : somePatches(world.discretization))
        CHECK(sharesOf(other, otherRows.ofPatch(other.discretization.patches.list[patch])) ==
              sharesOf(world, rows.ofPatch(world.discretization.patches.list[patch])));
    }
  }
}

TEST_CASE("loadScene of a file with scaled or moved vertices gives the same surfaces and elements", "[metamorphic]") {
  const TemporaryFolder folder;
  const auto loaded = [&](const std::string& name, double scale, double by) {
    std::ifstream file(HEMITEX_DATA "/" + name + ".obj");
    std::ofstream written(folder.path / "scene.obj");
    written.precision(17);
    for (std::string line; std::getline(file, line);) {
      std::istringstream fields(line);
      std::string keyword;
      glm::dvec3 p;
      if (fields >> keyword >> p.x >> p.y >> p.z && keyword == "v") {
        p = scale * p + by;
        written << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
      } else {
        written << line << '\n';
      }
    }
    written.close();
    return loadScene(folder.path / "scene.obj");
  };
  const auto namesOf = [](const Scene& scene) {
    std::vector<std::string> names;
    for (const Surface& surface : scene.surfaces) names.push_back(surface.name);
    return names;
  };
  for (const std::string name : {"cornell-box", "paper-room", "pyramid-room", "curved-room"}) {
    INFO(name);
    const Scene scene = loaded(name, 1, 0);
    const Discretization discretization = discretize(scene, {.texels = 8});
    for (const auto& [scale, by] : {std::pair{1e-6, 0.0}, {1e6, 0.0}, {1.0, 1e3}, {1.0, 1e6}, {1.0, 1e8}}) {
      INFO("scaled by " << scale << ", moved by " << by);
      const Scene other = loaded(name, scale, by);
      CHECK(namesOf(other) == namesOf(scene));
      CHECK(triangleCount(other) == triangleCount(scene));
      const Discretization changed = discretize(other, {.texels = 8});
      REQUIRE(changed.elements.size() == discretization.elements.size());
      // A coordinate has a relative rounding error of 2^-53, which at 1e8 is 1e-8 of lengths of 1.
      double worst = 0;
      for (std::size_t e = 0; e < changed.elements.size(); ++e)
        worst =
            std::max(worst, std::abs(changed.elements[e].area / (scale * scale) / discretization.elements[e].area - 1));
      CHECK(worst < 1e-5);
    }
  }
}

TEST_CASE("ProjectedFormFactors of a rotated room equal the closed form within the pixels along its outlines",
          "[metamorphic]") {
  std::mt19937 random(7);
  for (const Scene& room : {tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)),
                            tests::sceneOf(tests::box("flat", {0, 0, 0}, {4, 3, 0.5}, true))})
    for (int repeat = 0; repeat < 10; ++repeat) {
      World world(mapped(room, anyRotation(random)), 4, 2);
      ProjectedFormFactors rows = world.rows(resolution);
      for (const Patch& patch : world.discretization.patches.list) {
        const SurfacePoint centre = patchCentre(world.scene, world.discretization, patch);
        const FormFactorRow row = rows.from(patch.surface, centre);
        std::vector<double> factor(world.scene.surfaces.size());
        for (std::size_t i = 0; i < row.elements.size(); ++i)
          factor[world.discretization.elements[row.elements[i]].surface] += formFactor(row.shares[i]);
        for (std::uint32_t s = 0; s < world.scene.surfaces.size(); ++s) {
          if (s == patch.surface) continue;
          const auto& [first, second] =
              std::tie(world.scene.surfaces[s].triangles[0].position, world.scene.surfaces[s].triangles[1].position);
          const std::vector<glm::dvec3> polygon{first[0], first[1], first[2], second[2]};
          const double exact = reference::pointToPolygon(centre.position, centre.normal, polygon);
          CHECK(std::abs(factor[s] - exact) <= tests::outlineBound(centre, polygon, resolution));
        }
      }
    }
}

TEST_CASE("ProjectedFormFactors with surfaces and polygons in another order have the same rows in another order",
          "[metamorphic]") {
  std::mt19937 random(11);
  for (const NamedScene& named : tableOfScenes()) {
    INFO(named.name);
    World world(named.scene, 8, 4);
    ProjectedFormFactors rows = world.rows(resolution);
    RowComparison comparison{0};
    for (int repeat = 0; repeat < 4; ++repeat) {
      const Permutation permutation = permuted(named.scene, random);
      World other(permutation.scene, 8, 4);
      ProjectedFormFactors otherRows = other.rows(resolution);
      for (const std::uint32_t patch : somePatches(world.discretization)) {
        const std::uint32_t there = numberIn(
            other, world, permutation.from, world.discretization.patches.list[patch].surface, patch, &Grid::firstPatch);
        if (!sameCentre(world, patch, other, there)) continue;
        const Shares found = sharesOf(other, otherRows.ofPatch(other.discretization.patches.list[there]));
        Shares back = found;
        for (std::uint32_t e = 0; e < world.discretization.elements.size(); ++e)
          back[e] = found[numberIn(other, world, permutation.from, world.discretization.elements[e].surface, e,
                                   &Grid::firstElement)];
        comparison.add(sharesOf(world, rows.ofPatch(world.discretization.patches.list[patch])), back);
      }
    }
    INFO(comparison.changed << " of " << comparison.same + comparison.changed << " rows changed");
    CHECK(comparison.same > 30);
    comparison.check();
  }
}

TEST_CASE("RayFormFactors with surfaces in another order have the same values, to the bit", "[metamorphic]") {
  std::mt19937 random(13);
  for (const NamedScene& named : tableOfScenes()) {
    INFO(named.name);
    const RayWorld world(named.scene);
    Permutation permutation{named.scene, std::vector<std::uint32_t>(named.scene.surfaces.size())};
    std::iota(permutation.from.begin(), permutation.from.end(), 0u);
    std::shuffle(permutation.from.begin(), permutation.from.end(), random);
    for (std::size_t s = 0; s < permutation.from.size(); ++s)
      permutation.scene.surfaces[s] = named.scene.surfaces[permutation.from[s]];
    const RayWorld other(permutation.scene);
    for (const Estimator estimator : bothEstimators) {
      const reference::MeasuredRow before = world.row(estimator, permutation.from[0], 64);
      const reference::MeasuredRow after = other.row(estimator, 0, 64);
      for (std::size_t s = 0; s < permutation.from.size(); ++s)
        CHECK(after.receivers[s].value == before.receivers[permutation.from[s]].value);
      // The backs of several surfaces are summed in another order.
      CHECK(std::abs(after.back.value - before.back.value) < 1e-14);
    }
  }
}

TEST_CASE("RayFormFactors of a rotated scene have the same values, within their errors", "[metamorphic]") {
  std::mt19937 random(17);
  for (const NamedScene& named : tableOfScenes()) {
    INFO(named.name);
    const RayWorld world(named.scene), turned(mapped(named.scene, anyRotation(random)));
    const auto surfaces = static_cast<std::uint32_t>(named.scene.surfaces.size());
    const reference::MeasuredRow before = world.row(bothEstimators[0], surfaces / 2, 1 << 13);
    const reference::MeasuredRow after = turned.row(bothEstimators[0], surfaces / 2, 1 << 13);
    // Directions are drawn in another frame, so that the two results are independent: four deviations of their
    // difference.
    for (std::uint32_t s = 0; s < surfaces; ++s) {
      const reference::Measurement &a = before.receivers[s], &b = after.receivers[s];
      CHECK(std::abs(a.value - b.value) <= 4 * std::hypot(a.standardError, b.standardError));
    }
  }
}

TEST_CASE("ProjectedFormFactors never grow if an occluder is added", "[metamorphic]") {
  // If it is the nearest object, the near distance shrinks, and triangles are clipped at other places. Their new
  // corners are snapped to 1/256 of a pixel. Such centres are left out.
  std::mt19937 random(19);
  for (const NamedScene& named : tableOfScenes()) {
    INFO(named.name);
    World world(named.scene, 8, 4);
    ProjectedFormFactors rows = world.rows(resolution);
    int rowsCompared = 0, lowered = 0;
    bool raised = false;
    for (int repeat = 0; repeat < 4; ++repeat) {
      World occluded(withOccluder(named.scene, random), 8, 4);
      REQUIRE(occluded.scene.extent == world.scene.extent);
      ProjectedFormFactors occludedRows = occluded.rows(resolution);
      for (const std::uint32_t patch : somePatches(world.discretization)) {
        const Patch& block = world.discretization.patches.list[patch];
        const SurfacePoint centre = patchCentre(world.scene, world.discretization, block);
        const auto nearest = [&](const World& w) {
          return nearDistance(w.scene, triangleBoxes(w.scene), centre.position,
                              skippedTriangles(w.scene, triangleBoxes(w.scene), block.surface, centre),
                              hemicubeSquaredReach);
        };
        if (nearest(occluded) != nearest(world)) continue;
        ++rowsCompared;
        const Shares before = sharesOf(world, rows.ofPatch(world.discretization.patches.list[patch]));
        Shares after = sharesOf(occluded, occludedRows.ofPatch(occluded.discretization.patches.list[patch]));
        // The occluder and its back are new; the other elements and the background are compared.
        const std::uint64_t background = after[after.size() - 2];
        after.resize(world.discretization.elements.size());
        after.push_back(background);
        for (std::size_t i = 0; i < after.size(); ++i) raised |= after[i] > before[i];
        lowered += !std::equal(after.begin(), after.end(), before.begin());
      }
    }
    CHECK_FALSE(raised);
    CHECK(rowsCompared > 20);
    CHECK(lowered > 10);
  }
}

TEST_CASE("RayFormFactors of the same rays never grow if an occluder is added", "[metamorphic]") {
  std::mt19937 random(23);
  for (const NamedScene& named : tableOfScenes()) {
    INFO(named.name);
    const RayWorld world(named.scene), occluded(withOccluder(named.scene, random));
    REQUIRE(occluded.scene.extent == world.scene.extent);
    bool raised = false, lowered = false;
    for (const std::uint32_t surface : {0u, 1u, 2u})
      for (const Estimator estimator : bothEstimators) {
        const reference::MeasuredRow before = world.row(estimator, surface, 64);
        const reference::MeasuredRow after = occluded.row(estimator, surface, 64);
        for (std::size_t s = 0; s < named.scene.surfaces.size(); ++s) {
          raised |= after.receivers[s].value > before.receivers[s].value;
          lowered |= after.receivers[s].value < before.receivers[s].value;
        }
      }
    CHECK_FALSE(raised);
    CHECK(lowered);
  }
}

TEST_CASE("solve and its rows and rays give the same bits for any number of threads in whole scenes", "[metamorphic]") {
  for (const NamedScene& named : tableOfScenes()) {
    INFO(named.name);
    const auto everything = [&](int threads) {
      const raster::ThreadLimit limit(threads);
      World world(named.scene, 8, 4);
      ProjectedFormFactors rows = world.rows(resolution);
      std::vector<Shares> shares;
      for (const std::uint32_t patch : somePatches(world.discretization))
        shares.push_back(sharesOf(world, rows.ofPatch(world.discretization.patches.list[patch])));
      const auto rowOf = [&](const Patch& patch) { return rows.ofPatch(patch); };
      const Solution solution = solve({.scene = world.scene,
                                       .discretization = world.discretization,
                                       .patches = world.discretization.patches,
                                       .rowOf = rowOf,
                                       .settings = {.shots = 20}});
      std::vector<double> measured;
      const RayWorld rays(named.scene);
      for (const Estimator estimator : bothEstimators)
        for (const reference::Measurement& m : rays.row(estimator, 0, 64).receivers) {
          measured.push_back(m.value);
          measured.push_back(m.standardError);
        }
      return std::tuple{shares, solution.radiosity, measured};
    };
    const auto alone = everything(1);
    for (const int threads : {2, 7}) CHECK(everything(threads) == alone);
  }
}
