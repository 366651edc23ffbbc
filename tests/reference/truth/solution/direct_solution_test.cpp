// solveDirectly compared with closed forms, and progressive refinement compared with solveDirectly.
#include "reference/truth/solution/direct_solution.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/software/software_renderer.h"
#include "reference/conformance/vectors/draw_list_builder.h"
#include "reference/truth/solution/form_factor_matrix.h"
#include "reference/truth/solution/radiosity_error.h"
#include "tests/support/box_scene.h"

using namespace hemitex;
using reference::FormFactorMatrix;
using reference::solveDirectly;

namespace {

/// A closed enclosure: areas, and form factors that satisfy reciprocity (A_i F_ij is symmetric) and whose rows sum to
/// 1.
struct Enclosure {
  std::vector<double> areas;
  FormFactorMatrix matrix;
};

/// Any symmetric exchange areas are valid; an element's area is the sum of its exchange areas.
Enclosure anyEnclosure(std::size_t size) {
  std::mt19937 random(7);
  Enclosure enclosure{std::vector<double>(size), {size, std::vector<double>(size * size)}};
  std::vector<double>& factors = enclosure.matrix.factors;
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = i; j < size; ++j)
      factors[i * size + j] = factors[j * size + i] = static_cast<double>(reference::uniform(random, 0, 1));
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) enclosure.areas[i] += factors[i * size + j];
    for (std::size_t j = 0; j < size; ++j) factors[i * size + j] /= enclosure.areas[i];
  }
  return enclosure;
}

/// The residual of the equations for elements of one reflectance over all flux, sums of absolute values; the worst
/// band.
double residualOf(const FormFactorMatrix& matrix, const std::vector<glm::dvec3>& emitted, const glm::dvec3& reflectance,
                  const std::vector<glm::dvec3>& flux) {
  glm::dvec3 missing(0), all(0);
  for (std::size_t to = 0; to < matrix.size; ++to) {
    glm::dvec3 arriving(0);
    for (std::size_t from = 0; from < matrix.size; ++from)
      arriving += matrix.factors[from * matrix.size + to] * flux[from];
    missing += glm::abs(emitted[to] + reflectance * arriving - flux[to]);
    all += glm::abs(flux[to]);
  }
  const glm::dvec3 share = missing / all;
  return std::max({share.x, share.y, share.z});
}

}  // namespace

TEST_CASE("solveDirectly of two elements that face each other equals the closed form", "[algebra]") {
  // flux_1 = e_1 + r_1 F_21 flux_2, and the same with 1 and 2 exchanged. So flux_1 = (e_1 + r_1 F_21 e_2) / (1 - r_1
  // r_2 F_12 F_21).
  const double f12 = 0.25, f21 = 0.125;
  const std::vector<glm::dvec3> emitted{{1, 0, 2}, {0, 3, 5}}, reflectance{{0.5, 0.25, 0}, {0.75, 0.5, 0.9999}};
  const std::vector<glm::dvec3> flux = solveDirectly({2, {0, f12, f21, 0}}, emitted, reflectance);
  for (int band = 0; band < 3; ++band) {
    const double e1 = emitted[0][band], e2 = emitted[1][band], r1 = reflectance[0][band], r2 = reflectance[1][band];
    const double loop = 1 - r1 * r2 * f12 * f21;
    CHECK(flux[0][band] == Approx((e1 + r1 * f21 * e2) / loop).epsilon(1e-14));
    CHECK(flux[1][band] == Approx((e2 + r2 * f12 * e1) / loop).epsilon(1e-14));
  }
}

TEST_CASE("solveDirectly of a closed enclosure of one emission and reflectance gives E over 1 minus r", "[algebra]") {
  // Each element sends E A / (1 - r). By reciprocity the sum over i of F_ij A_i is A_j, so the equations hold.
  const Enclosure enclosure = anyEnclosure(60);
  std::vector<glm::dvec3> emitted;
  for (const double area : enclosure.areas) emitted.push_back(area * glm::dvec3(2, 1, 0.5));
  const glm::dvec3 reflectance(0.5, 0.9, 0.9999);
  const std::vector<glm::dvec3> flux =
      solveDirectly(enclosure.matrix, emitted, std::vector<glm::dvec3>(emitted.size(), reflectance));
  CHECK(residualOf(enclosure.matrix, emitted, reflectance, flux) < 1e-12);
  for (std::size_t e = 0; e < emitted.size(); ++e)
    for (int band = 0; band < 3; ++band)
      // Rounding is amplified by up to 1/(1 - r).
      CHECK(flux[e][band] ==
            Approx(emitted[e][band] / (1 - reflectance[band])).epsilon(1e-14 / (1 - reflectance[band])));
}

TEST_CASE("solveDirectly of a sphere with an emitting cap lights all other elements equally", "[algebra]") {
  // Each element of a sphere sends the share A_j / A to element j. With a cap of area share f that emits E, all others
  // have the radiosity r H where H = f E + r H: r f E / (1 - r).
  const std::vector<double> share{0.05, 0.15, 0.3, 0.5};
  FormFactorMatrix matrix{4, {}};
  for (std::size_t i = 0; i < 4; ++i) matrix.factors.insert(matrix.factors.end(), share.begin(), share.end());
  const double reflectance = 0.8;
  const std::vector<glm::dvec3> emitted{glm::dvec3(0.05), {}, {}, {}};
  const std::vector<glm::dvec3> flux =
      solveDirectly(matrix, emitted, std::vector<glm::dvec3>(4, glm::dvec3(reflectance)));
  for (std::size_t e = 1; e < 4; ++e)
    CHECK(flux[e].x / share[e] == Approx(reflectance * 0.05 / (1 - reflectance)).epsilon(1e-13));
}

TEST_CASE("solve converges to solveDirectly with its own rows", "[algebra]") {
  radiosity::Scene scene = tests::closedCube({0.7, 0.5, 0.2}, glm::dvec3(0));
  scene.materials.push_back(tests::material("lamp", glm::dvec3(0.3), {5, 4, 3}));
  scene.surfaces.front().material = 1;
  const radiosity::Discretization discretization = discretize(scene, {.texels = 3, .patch = 1});
  const radiosity::IdLayout layout = layOut(discretization);
  raster::SoftwareRenderer renderer(makeDrawList(scene, discretization, layout));
  radiosity::ProjectedFormFactors rows(scene, discretization, layout, renderer, {.resolution = 32});

  const std::size_t size = discretization.elements.size();
  FormFactorMatrix matrix{size, std::vector<double>(size * size)};
  for (const radiosity::Patch& patch : discretization.patches.list) {
    const std::size_t from = patch.elements.front();
    const radiosity::FormFactorRow row = rows.ofPatch(patch);
    for (std::size_t i = 0; i < row.elements.size(); ++i)
      matrix.factors[from * size + row.elements[i]] = radiosity::formFactor(row.shares[i]);
  }
  const std::vector<glm::dvec3> truth = reference::algebraicRadiosity(scene, discretization, matrix);

  for (const double residual : {1e-2, 1e-4, 1e-8}) {
    const radiosity::Solution solution =
        radiosity::solve({.scene = scene,
                          .discretization = discretization,
                          .patches = discretization.patches,
                          .rowOf = [&](const radiosity::Patch& patch) { return rows.ofPatch(patch); },
                          .settings = {.residual = residual}});
    // Unshot light still arrives and is reflected, in total at most r/(1 - r) times. The sum of area times truth is at
    // least the emitted flux.
    const double error = reference::errorOf(discretization, solution.radiosity, truth).fluxWeighted;
    INFO(residual << " " << error);
    CHECK(error <= residual * 0.7 / (1 - 0.7) + 1e-13);
    CHECK(error >= residual / 100);
  }
}
