// Regular meshing compared with textures: equal elements and areas, and item buffers that differ only at element
// borders. Solutions differ by no more than those pixels explain.
#include "radiosity/index_maps/meshed_draws.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numeric>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/texel_areas.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "reference/truth/closed_forms/surface_pieces.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using radiosity::Discretization;
using radiosity::Scene;

namespace {

Scene dataScene(const std::string& name) { return radiosity::loadScene(std::string(HEMITEX_DATA) + "/" + name); }

radiosity::IdLayout layoutOf(const Discretization& discretization) {
  return radiosity::layOut(discretization, {.format = "r32ui"});
}

/// A discretized scene that both methods draw.
struct World {
  Scene scene;
  Discretization discretization;
  radiosity::IdLayout layout;
  radiosity::MeshedDraws mesh;

  World(Scene s, const radiosity::DiscretizationSettings& settings)
      : scene(std::move(s)),
        discretization(radiosity::discretize(scene, settings)),
        layout(layoutOf(discretization)),
        mesh(radiosity::makeMeshedDraws(scene, discretization, layout)) {}

  /// The element of an item ID, or a reserved item ID, which is above all elements.
  std::uint32_t shownBy(raster::ItemId id) const {
    return radiosity::elementOf(discretization, layout, id).value_or(id);
  }
};

using Drawn = std::vector<raster::ItemBuffer>;

/// The views of a patch on the faces of its hemicube, by both methods. Hemicubes are rotated, so that borders along the
/// axes of the scene do not lie on samples.
struct Views {
  std::vector<raster::Face> faces;
  Drawn byTexture, byMesh;
};

Views viewsFrom(const World& world, std::uint32_t patch, int resolution) {
  const auto rendererBy = [&](radiosity::ElementsBy method) {
    return radiosity::sceneRenderer(world.scene, world.discretization, world.layout, method);
  };
  const auto textures = rendererBy(radiosity::ElementsBy::Texture), mesh = rendererBy(radiosity::ElementsBy::Mesh);
  radiosity::ProjectedFormFactors rows(world.scene, world.discretization, world.layout, *textures,
                                       {.resolution = resolution, .orientation = radiosity::Orientation::Turned});
  const radiosity::View view = rows.viewsOfPatch(world.discretization.patches.list[patch]).front();
  return {view.faces, render(*textures, view.faces, view.skipped), render(*mesh, view.faces, view.skipped)};
}

/// The depth of a segment in the square of half-width `reach` around a pixel's sample; 0 if it is outside. `a` and `b`
/// are in view coordinates.
double depthInSquare(const raster::Face& face, glm::dvec3 a, glm::dvec3 b, const glm::dvec2& sample, double reach) {
  // Clips the segment to the square. Its sides are planes through the eye, and the near plane is perpendicular to the
  // view.
  const double half = face.resolution / 2.0;
  const glm::dvec2 low = (sample - reach) / half - 1.0, high = (sample + reach) / half - 1.0;
  const std::array<glm::dvec4, 5> planes{glm::dvec4(0, 0, 1, -double(face.nearDistance)),
                                         {1, 0, -low.x, 0},
                                         {-1, 0, high.x, 0},
                                         {0, 1, -low.y, 0},
                                         {0, -1, high.y, 0}};
  for (const glm::dvec4& plane : planes) {
    const double fa = glm::dot(plane, glm::dvec4(a, 1)), fb = glm::dot(plane, glm::dvec4(b, 1));
    if (fa < 0 && fb < 0) return 0;
    const glm::dvec3 crossing = a + fa / (fa - fb) * (b - a);
    if (fa < 0) a = crossing;
    if (fb < 0) b = crossing;
  }
  return std::min(a.z, b.z);
}

/// The error of a border at a depth by either method, in pixels. Snapping moves corners, and all points between them,
/// by at most half a sub-pixel. Binary32 rounds the following:
/// - a position (2^-25 extents per axis, sqrt(3) of that along a row), the quad's plane (2^-24 extents, see
///   makeMeshedDraws) and its chart (2^-22 of its length);
/// - the vertex stage, whose four roundings per row are 2^-24 of sums below the extent. The sum is less than 11 units
///   of 2^-24 extents of x, y and w; x/w moves by (1 + |x/w|) of it over w.
double reachAt(const World& world, const raster::Face& face, double depth) {
  const double rounded = 11 * 0x1p-24 * world.scene.extent;
  return 1.0 / 512 + 2 * rounded / depth * face.resolution / 2;
}

/// Whether the exact border of an element is so near to a sample that rounding explains different results of two
/// methods.
bool isAtBorder(const World& world, const reference::SurfacePieces& pieces, const raster::Face& face,
                const glm::dvec2& sample) {
  const auto viewOf = [&](const glm::dvec3& inFrame) {
    const glm::dvec3 d = inFrame * world.scene.extent - glm::dvec3(face.eye);
    return glm::dvec3(glm::dot(glm::dvec3(face.x), d), glm::dot(glm::dvec3(face.y), d),
                      glm::dot(glm::dvec3(face.w), d));
  };
  for (const reference::SurfacePiece& piece : pieces.pieces)
    for (std::size_t i = 0; i < piece.corner.size(); ++i) {
      const glm::dvec3 a = viewOf(piece.corner[i]), b = viewOf(piece.corner[(i + 1) % piece.corner.size()]);
      // The square grows with the nearness of the border: first the largest possible square, then the one for the
      // border's depth.
      const double depth = depthInSquare(face, a, b, sample, reachAt(world, face, face.nearDistance));
      if (depth > 0 && depthInSquare(face, a, b, sample, reachAt(world, face, depth)) > 0) return true;
    }
  return false;
}

struct Agreement {
  std::size_t pixels = 0, differing = 0, unexplained = 0;
};

void compare(const World& world, const reference::SurfacePieces& pieces, const Views& views, Agreement& agreement) {
  for (std::size_t f = 0; f < views.faces.size(); ++f) {
    const raster::Scissor& scissor = views.faces[f].scissor;
    std::size_t pixel = 0;
    for (int row = scissor.row; row < scissor.row + scissor.height; ++row)
      for (int column = scissor.column; column < scissor.column + scissor.width; ++column, ++pixel) {
        ++agreement.pixels;
        if (world.shownBy(views.byTexture[f].ids[pixel]) == world.shownBy(views.byMesh[f].ids[pixel])) continue;
        ++agreement.differing;
        if (!isAtBorder(world, pieces, views.faces[f], {column + 0.5, row + 0.5})) ++agreement.unexplained;
      }
  }
}

/// The share of the light that two rows send to different places, counted at both.
double differenceOf(const radiosity::FormFactorRow& a, const radiosity::FormFactorRow& b) {
  std::map<std::uint32_t, double> difference;
  for (std::size_t i = 0; i < a.elements.size(); ++i) difference[a.elements[i]] += radiosity::formFactor(a.shares[i]);
  for (std::size_t i = 0; i < b.elements.size(); ++i) difference[b.elements[i]] -= radiosity::formFactor(b.shares[i]);
  double sum = 0;
  for (const auto& [element, value] : difference) sum += std::abs(value);
  return sum;
}

double doubledArea(const raster::DrawList& list, std::uint32_t first) {
  const auto corner = [&](std::uint32_t k) { return glm::dvec3(list.positions[list.indices[first + k]]); };
  return glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
}

double perimeter(const raster::DrawList& list, std::uint32_t first) {
  const auto corner = [&](std::uint32_t k) { return glm::dvec3(list.positions[list.indices[first + k % 3]]); };
  return glm::distance(corner(0), corner(1)) + glm::distance(corner(1), corner(2)) +
         glm::distance(corner(2), corner(3));
}

}  // namespace

TEST_CASE("makeMeshedDraws and makeDrawList show different elements only where rounding moves a border over a sample",
          "[meshing]") {
  struct Case {
    std::string file;
    radiosity::DiscretizationSettings settings;
  };
  const std::vector<Case> cases{{"paper-room.obj", {.texels = 8}},
                                {"cornell-box.obj", {.texels = 10}},
                                {"pyramid-room.obj", {.texels = 13}},
                                {"curved-room.obj", {.texels = 16}}};
  Agreement all;
  for (const Case& c : cases) {
    const World world(dataScene(c.file), c.settings);
    const reference::SurfacePieces pieces = reference::surfacePieces(world.scene, world.discretization);
    Agreement agreement;
    const auto patches = static_cast<std::uint32_t>(world.discretization.patches.list.size());
    for (std::uint32_t view = 0; view < 4; ++view)
      compare(world, pieces, viewsFrom(world, (2 * view + 1) * patches / 8, 128), agreement);
    CAPTURE(c.file, agreement.pixels, agreement.differing);
    CHECK(agreement.unexplained == 0);
    all.pixels += agreement.pixels;
    all.differing += agreement.differing;
  }
  // The positions of borders are random. A hundred pixels contain five to ten borders, each with an error of about a
  // third of a sub-pixel. So a few in ten thousand samples differ.
  CAPTURE(all.differing, all.pixels);
  CHECK(all.differing > 0);
  CHECK(all.differing < all.pixels / 1000);
}

TEST_CASE("makeMeshedDraws gives the pieces of an element the area of its texels, buried or not", "[meshing]") {
  // A part inside a solid does not count in elements' areas, but it is drawn; no eye sees it.
  std::vector<Scene> scenes{dataScene("paper-room.obj"), dataScene("cornell-box.obj"), dataScene("pyramid-room.obj"),
                            dataScene("curved-room.obj"), tests::furnishedRoom()};
  for (const radiosity::Surface& surface : tests::tableOfSurfaces()) scenes.push_back(tests::sceneOf({surface}));
  for (const Scene& scene : scenes)
    for (const int texels : {1, 5, 16}) {
      const World world(scene, {.texels = texels});
      const raster::DrawList& list = world.mesh.list;
      std::vector<double> area(world.discretization.elements.size()), bound(area.size());
      // The error of a corner is at most binary32's rounding, the finer rounding that joins corners, and the bend of a
      // quad (see makeMeshedDraws), each along three axes. The area of a triangle changes by half its perimeter times
      // that.
      const double moved = (std::sqrt(3) * (0x1p-25 + 0x1p-31) + 0x1p-24) * scene.extent;
      for (const raster::Draw& draw : list.draws) {
        const std::uint32_t element = world.shownBy(draw.offset);
        for (std::uint32_t first = draw.first; first < draw.first + draw.count; first += 3) {
          area[element] += doubledArea(list, first) / 2;
          bound[element] += perimeter(list, first) / 2 * moved + moved * moved;
        }
      }
      std::vector<double> expected(area.size());
      for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
        const radiosity::Grid& grid = world.discretization.grids[s];
        const auto whole = radiosity::texelAreas(scene.surfaces[s], {grid.columns, grid.rows, {}}).area;
        for (std::size_t texel = 0; texel < whole.size(); ++texel) expected[grid.elementOfTexel[texel]] += whole[texel];
      }
      std::size_t wrong = 0;
      // Texels with almost no area have no pieces (coverageNoise), and areas are summed in double precision.
      for (std::size_t e = 0; e < area.size(); ++e)
        wrong += std::abs(area[e] - expected[e]) > bound[e] + 1e-12 * area[e];
      CAPTURE(scene.surfaces.front().name, texels, area.size());
      CHECK(wrong == 0);
    }
}

TEST_CASE(
    "makeMeshedDraws of a wall of N x N texels makes two triangles per texel, and 439 quads for the paper's scene",
    "[meshing]") {
  radiosity::DiscretizationSettings settings{.texels = 8, .surfaceTexels = {{"light", 1}}};
  for (const std::string side : {"bottom", "top", "front", "right", "back", "left"})
    settings.surfaceTexels["box-" + side] = 3;
  const World room(dataScene("paper-room.obj"), settings);
  CHECK(room.discretization.elements.size() == 439);
  CHECK(room.mesh.list.draws.size() == 439);
  CHECK(room.mesh.list.indices.size() == 3 * 2 * 439);

  // A quad is cut as one, for any direction of its diagonal.
  const World wall(tests::sceneOf({tests::parallelogram("wall", {0, 0, 0}, {3, 0, 1}, {0, 2, 0.5})}),
                   {.texelSize = 0.31});
  const radiosity::Grid& grid = wall.discretization.grids[0];
  REQUIRE(grid.columns != grid.rows);
  CHECK(wall.mesh.list.draws.size() == static_cast<std::size_t>(grid.columns * grid.rows));
  CHECK(wall.mesh.list.indices.size() == static_cast<std::size_t>(3 * 2 * grid.columns * grid.rows));
  CHECK(wall.mesh.list.positions.size() == static_cast<std::size_t>((grid.columns + 1) * (grid.rows + 1)));
  CHECK(wall.mesh.firstPiece == std::vector<std::uint32_t>{0, static_cast<std::uint32_t>(2 * grid.columns * grid.rows),
                                                           static_cast<std::uint32_t>(2 * grid.columns * grid.rows)});
}

TEST_CASE("makeMeshedDraws leaves no gap where surfaces meet with the same grid", "[meshing]") {
  // Each side of a triangle is also a side of another in reverse direction: the room is closed, and so is the box.
  World world(dataScene("paper-room.obj"), {.texels = 7, .surfaceTexels = {{"light", 1}}});
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  const std::vector<std::uint32_t>& indices = world.mesh.list.indices;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const std::uint32_t a = indices[i], b = indices[i % 3 == 2 ? i - 2 : i + 1];
    ++sides[{a, b}];
    --sides[{b, a}];
  }
  const auto open = std::count_if(sides.begin(), sides.end(), [](const auto& side) { return side.second != 0; });
  CHECK(open == 2 * 4);  // the light's outline
  for (std::uint32_t patch = 0; patch < world.discretization.patches.list.size(); patch += 5)
    for (const raster::ItemBuffer& buffer : viewsFrom(world, patch, 64).byMesh)
      CHECK(std::count(buffer.ids.begin(), buffer.ids.end(), raster::backgroundId(world.layout.format)) == 0);
}

TEST_CASE("MeshedRenderer leaves out the pieces of a skipped triangle of the scene", "[meshing]") {
  // Two triangles of a warped quad do not lie in one plane, so that each is cut separately.
  const World world(tests::sceneOf({tests::quad("warped", {{{0, 0, 0}, {2, 0, 1}, {2, 3, -1}, {0, 1, 2}}})}),
                    {.texels = 6});
  REQUIRE(world.mesh.firstPiece.size() == 3);
  const std::uint32_t second = world.mesh.firstPiece[1], end = world.mesh.firstPiece[2];
  CHECK(second > 0);
  CHECK(end == world.mesh.list.indices.size() / 3);

  class Recorder final : public raster::ItemBufferRenderer {
   public:
    explicit Recorder(std::vector<std::uint32_t>& skipped) : skipped_(skipped) {}
    void draw(std::span<const raster::Face>, std::span<const std::uint32_t> skipped, std::vector<raster::ItemBuffer>&,
              const std::function<void(std::size_t)>&) override {
      skipped_.assign(skipped.begin(), skipped.end());
    }

   private:
    std::vector<std::uint32_t>& skipped_;
  };
  std::vector<std::uint32_t> skipped;
  radiosity::MeshedRenderer renderer(std::make_unique<Recorder>(skipped), world.mesh.firstPiece);
  const std::vector<std::uint32_t> lastTriangle{1};
  render(renderer, {}, lastTriangle);
  std::vector<std::uint32_t> expected(end - second);
  std::iota(expected.begin(), expected.end(), second);
  CHECK(skipped == expected);
}

TEST_CASE("solutions with makeMeshedDraws and makeDrawList differ by no more than their rows", "[meshing]") {
  for (const std::string file : {"cornell-box.obj", "paper-room.obj"}) {
    const Scene scene = dataScene(file);
    const Discretization unsplit = radiosity::discretize(scene, {.texels = 8});
    const double residual = 1e-5;
    std::vector<std::vector<radiosity::FormFactorRow>> rows;
    std::vector<radiosity::Solution> solutions;
    for (const auto method : {radiosity::ElementsBy::Texture, radiosity::ElementsBy::Mesh}) {
      radiosity::SceneFormFactors drawn(scene, unsplit, layoutOf(unsplit),
                                        {.resolution = 128, .split = 1, .elementsBy = method});
      std::vector<radiosity::FormFactorRow>& ofMethod = rows.emplace_back();
      for (const radiosity::Patch& patch : unsplit.patches.list) ofMethod.push_back(drawn.uncorrected().ofPatch(patch));
      const auto rowOf = [&](const radiosity::Patch& patch) { return ofMethod[patch.number]; };
      solutions.push_back(radiosity::solve({.scene = scene,
                                            .discretization = unsplit,
                                            .patches = unsplit.patches,
                                            .rowOf = rowOf,
                                            .settings = {.residual = residual}}));
    }

    double reflectance = 0, emitted = 0, flux = 0, apart = 0;
    std::vector<double> ofPatch(unsplit.patches.list.size());
    for (std::uint32_t e = 0; e < unsplit.elements.size(); ++e) {
      const auto fluxOf = [&](const glm::dvec3& radiosity) {
        return unsplit.elements[e].area * (radiosity.x + radiosity.y + radiosity.z);
      };
      const glm::dvec3 rho = radiosity::reflectance(scene, unsplit, e);
      reflectance = std::max({reflectance, rho.x, rho.y, rho.z});
      emitted += fluxOf(radiosity::emission(scene, unsplit, e));
      ofPatch[unsplit.patches.ofElement[e]] += fluxOf(solutions[0].radiosity[e]);
      flux += fluxOf(solutions[0].radiosity[e]);
      apart += fluxOf(glm::abs(solutions[0].radiosity[e] - solutions[1].radiosity[e]));
    }
    // Let F be the rows, R the reflectances and B the flux: B = E + R F B. Then |B - B'| <= r |(F - F') B| / (1 - r),
    // with r the largest reflectance. The unshot flux adds at most 1 / (1 - r) of itself in either solution.
    double elsewhere = 0;
    for (std::uint32_t patch = 0; patch < ofPatch.size(); ++patch)
      elsewhere += differenceOf(rows[0][patch], rows[1][patch]) * ofPatch[patch];
    const double bound = (reflectance * elsewhere + 2 * residual * emitted) / (1 - reflectance);
    CAPTURE(file, elsewhere / flux, apart / flux, bound / flux);
    CHECK(apart > 0);
    CHECK(apart <= bound);
    CHECK(bound < 0.01 * flux);
  }
}
