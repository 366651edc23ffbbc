// texelsOf: normals of texels on curved surfaces. addDirectLight: the light of many lamps.
#include "radiosity/gather/lit_texels.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "radiosity/discretization/discretize.h"
#include "radiosity/scene/load_scene.h"
#include "tests/support/ball.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

// Interpolated normals of facets 7 degrees wide are within 0.1 degrees of the ball's, also where charts meet.
TEST_CASE("texelsOf gives the texels of a ball normals that agree where its charts meet", "[gather]") {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "ball.obj") << tests::objText(tests::icosphere(3));
  const Scene scene = loadScene(folder.path / "ball.obj");
  const Discretization discretization = discretize(scene, {.texels = 8});
  double least = 1;
  for (const LitTexels& texels : texelsOf(scene, discretization, Magnifications(scene.surfaces.size(), 4)))
    for (const std::optional<LitPlace>& place : texels.places)
      if (place) least = std::min(least, glm::dot(place->point.normal, glm::normalize(place->point.position)));
  CHECK(least > 0.999998);
}

namespace {

/// A floor of 6 x 4 under two rows of six lamps, with a post in the middle that shades it.
Scene hall(const std::filesystem::path& folder) {
  std::ofstream(folder / "hall.mtl") << "newmtl grey\nKd .5 .5 .5\nnewmtl lamp\nKe 10 10 10\n";
  std::ofstream obj(folder / "hall.obj");
  obj << "mtllib hall.mtl\nusemtl grey\ng floor\nv 0 0 0\nv 0 0 4\nv 6 0 4\nv 6 0 0\nf 1 2 3 4\ng post\n";
  const std::array<glm::dvec2, 4> foot{glm::dvec2(2.9, 1.8), {2.9, 2.1}, {3.1, 2.1}, {3.1, 1.8}};
  for (std::size_t k = 0; k < 4; ++k) {
    const glm::dvec2 a = foot[k], b = foot[(k + 1) % 4];
    obj << "v " << a.x << " 0 " << a.y << "\nv " << b.x << " 0 " << b.y << "\nv " << b.x << " 1.5 " << b.y << "\nv "
        << a.x << " 1.5 " << a.y << "\nf -4 -3 -2 -1\n";
  }
  obj << "usemtl lamp\n";
  for (int lamp = 0; lamp < 12; ++lamp) {
    const double x = 0.4 + lamp % 6, z = lamp < 6 ? 1 : 3;
    obj << "g lamp" << lamp << "\nv " << x << " 2 " << z << "\nv " << x + 0.2 << " 2 " << z << "\nv " << x + 0.2
        << " 2 " << z + 0.2 << "\nv " << x << " 2 " << z + 0.2 << "\nf -4 -3 -2 -1\n";
  }
  obj.close();
  return loadScene(folder / "hall.obj");
}

}  // namespace

// The twin casts all rays of each lamp. Lamps that are left to few rays raise the light by little. Errors of single
// texels are larger where only elements of a gather get the light, but their sum is as right.
TEST_CASE("addDirectLight of many lamps is the sum of their closed forms times visible shares by all rays",
          "[gather]") {
  const TemporaryFolder folder;
  const Scene scene = hall(folder.path);
  const Discretization discretization = discretize(scene, {.texels = 8});
  const DirectLight direct(scene, discretization);
  REQUIRE(direct.count() == 12);
  LitTexels texels = texelsOf(scene, discretization, smoothNormals(scene), 0, 8);
  std::vector<double> truth;
  for (const std::optional<LitPlace>& place : texels.places) {
    truth.push_back(0);
    for (std::size_t source = 0; place && source < direct.count(); ++source)
      if (const double factor = direct.factor(source, place->point); factor > 0)
        truth.back() += factor * direct.visibleShare(source, *place) * direct.light(source)[0];
  }
  for (const auto& [use, bound, ofSum] :
       {std::tuple(TexelUse::Shown, 0.004, 0.0005), std::tuple(TexelUse::Reflecting, 0.03, 0.002)}) {
    LitTexels lit = texels;
    addDirectLight(direct, lit, use, nullptr);
    double squares = 0, sum = 0, all = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (truth[i] == 0) continue;
      const double error = lit.direct[i][0] / truth[i] - 1;
      squares += error * error;
      sum += lit.direct[i][0];
      all += truth[i];
      ++count;
    }
    CAPTURE(static_cast<int>(use));
    CHECK(std::sqrt(squares / static_cast<double>(count)) < bound);
    CHECK(std::abs(sum / all - 1) < ofSum);
  }
}
