#include "reference/matrices/judged_rows.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "raster/base/parallel.h"
#include "reference/truth/closed_forms/quick_form_factor.h"

namespace hemitex::reference {
namespace {

TrueRow measuredRow(const FacetMesh& mesh, const RayFormFactors& rays, const Receivers& receivers,
                    std::uint32_t surface, int samples) {
  const std::vector<std::uint32_t> own = elementsOfSurface(mesh.discretization, surface);
  const MeasuredRow measured = rays.overHemisphere(areaRaySource(rays.pieces(), own), receivers, {.samples = samples});
  TrueRow row{surface, std::vector<double>(mesh.scene.surfaces.size()),
              std::vector<double>(mesh.scene.surfaces.size())};
  for (std::size_t e = 0; e < measured.receivers.size(); ++e) {
    const std::uint32_t to = mesh.discretization.elements[e].surface;
    row.factor[to] = measured.receivers[e].value;
    row.error[to] = measured.receivers[e].standardError;
    row.sum += measured.receivers[e].value;
  }
  row.outside = {measured.background, measured.back};
  const double least = 2.0 / samples;
  for (Measurement& share : row.outside) share.standardError = std::max(share.standardError, least);
  row.sumError = std::max(std::hypot(row.outside[0].standardError, row.outside[1].standardError), least);
  return row;
}

std::vector<std::uint32_t> chosenSurfaces(const JudgedMatrix& matrix, std::size_t count) {
  const std::size_t surfaces = matrix.area.size();
  std::vector<std::uint32_t> chosen = spreadSurfaces(surfaces, count);
  if (chosen.size() == surfaces) return chosen;
  std::vector<std::uint32_t> all = spreadSurfaces(surfaces, surfaces);
  const auto samples = static_cast<int>(std::clamp<std::size_t>((std::size_t{1} << 20) / surfaces, 64, 1 << 12));
  const std::vector<TrueRow> rough = measuredRows(matrix.mesh, all, samples);
  std::vector<double> apart(surfaces, 0.0);
  for (std::uint32_t s = 0; s < surfaces; ++s) {
    double given = 0;
    for (std::uint32_t to = 0; to < surfaces; ++to) {
      const double found = matrix.entry(matrix.facet(s), matrix.facet(to)),
                   back = matrix.entry(matrix.facet(to), matrix.facet(s));
      apart[s] += std::abs(found - rough[s].factor[to]) + std::abs(found - back * matrix.area[to] / matrix.area[s]);
      given += found;
    }
    if (!matrix.hasOutside()) continue;
    for (std::uint32_t k = 0; k < 2; ++k) given += matrix.entry(matrix.facet(s), matrix.facets() + k);
    apart[s] += 10 * std::abs(given - 1);
  }
  std::stable_sort(all.begin(), all.end(), [&](auto a, auto b) { return apart[a] > apart[b]; });
  for (const std::uint32_t s : std::span(all).first(std::min(suspects, surfaces)))
    if (std::find(chosen.begin(), chosen.end(), s) == chosen.end()) chosen.push_back(s);
  return chosen;
}

/// Moves light to the first surface of each place.
void joinPlaces(const JudgedMatrix& matrix, std::vector<JudgedEntry>& to) {
  for (std::uint32_t s = 0; s < to.size(); ++s) {
    if (matrix.placeOf[s] == s) continue;
    JudgedEntry &first = to[matrix.placeOf[s]], &other = to[s];
    first.truth += other.truth;
    first.measured = std::hypot(first.measured, other.measured);
    first.closed = std::max(first.closed, other.closed) +
                   (matrix.area[matrix.placeOf[s]] == matrix.area[s] ? 0 : std::min(first.closed, other.closed));
    other.truth = other.measured = other.closed = 0;
  }
}

/// What the rays measured and what closed forms allow.
JudgedRow trueRow(const JudgedMatrix& matrix, const TrueRow& measured, const std::vector<ConvexPolygons>& polygons) {
  const radiosity::Scene& scene = matrix.mesh.scene;
  JudgedRow row{measured};
  row.to.resize(scene.surfaces.size());
  raster::parallelFor(row.to.size(), [&](std::size_t s) {
    row.to[s].truth = measured.factor[s];
    row.to[s].measured = measured.error[s];
    for (const radiosity::Instance& instance : scene.instances)
      row.to[s].closed += quickFormFactor(polygons[row.surface], placed(scene, polygons[s], instance));
  });
  joinPlaces(matrix, row.to);
  return row;
}

/// Fills in what the matrix says.
void compare(const JudgedMatrix& matrix, JudgedRow& row) {
  double squares = 0, all = 0, amplified = 0;
  for (std::uint32_t s = 0; s < row.to.size(); ++s) {
    JudgedEntry& entry = row.to[s];
    const double larger = row.isColumn ? std::max(1.0, matrix.area[s] / matrix.area[row.surface]) : 1.0;
    const double truth = row.isColumn ? entry.truth * matrix.area[row.surface] / matrix.area[s] : entry.truth;
    entry.found = gathered(matrix, row, s, [&](std::uint32_t i, std::uint32_t j) { return matrix.entry(i, j); });
    if (!matrix.matrix.error.empty())
      entry.stated =
          gathered(matrix, row, s, [&](std::uint32_t i, std::uint32_t j) { return matrix.statedError(i, j, truth); });
    entry.error = std::hypot(entry.measured, entry.stated);
    entry.smallest = smallestFactor * larger;
    entry.isTied = matrix.touches[row.surface] && matrix.touches[s];
    if (entry.isTied) continue;
    row.sums.found += entry.found;
    row.sums.truth += entry.truth;
    squares += entry.stated * entry.stated;
    all += entry.stated;
    amplified += (entry.smallest - smallestFactor) * (entry.smallest - smallestFactor);
  }
  row.sums.stated = std::max(std::sqrt(squares), all / confidence) + std::sqrt(amplified) / confidence;
}

}  // namespace

JudgedMatrix::JudgedMatrix(const SparseMatrix& given, const FacetMesh& facets)
    : matrix(given), mesh(facets), pairs(coveredPairs(facets.scene)) {
  for (const radiosity::Surface& surface : mesh.scene.surfaces) area.push_back(radiosity::area(surface));
  placeOf.resize(area.size());
  std::iota(placeOf.begin(), placeOf.end(), 0U);
  touches.resize(area.size());
  for (const CoveredPair& pair : pairs) {
    if (pair.isOnePlace) placeOf[pair.behind] = placeOf[pair.front];
    if (pair.isBackToBack) touches[pair.front] = true;
  }
  facetsOf.resize(area.size());
  areaOfPlace.resize(area.size());
  std::vector<std::uint32_t> surfaceOf(mesh.facets);
  const auto add = [&](std::uint32_t surface, std::uint32_t number) {
    facetsOf[placeOf[surface]].push_back(number);
    areaOfPlace[placeOf[surface]] += area[surface];
  };
  for (std::uint32_t s = 0; s < area.size(); ++s) {
    surfaceOf[facet(s)] = s;
    add(s, facet(s));
  }
  for (const auto& [repetition, original] : mesh.repeated) add(surfaceOf[original], repetition);
}

double JudgedMatrix::entry(std::uint32_t row, std::uint32_t column) const {
  const std::optional<std::size_t> place = matrix.placeOf(row, column);
  return place ? matrix.value[*place] : 0;
}

double JudgedMatrix::statedError(std::uint32_t row, std::uint32_t column, double truth) const {
  if (matrix.error.empty()) return 0;
  std::optional<std::size_t> place = matrix.placeOf(row, column);
  if (!place) {
    const auto begin = matrix.value.begin() + static_cast<std::ptrdiff_t>(matrix.rowStart[row]),
               end = matrix.value.begin() + static_cast<std::ptrdiff_t>(matrix.rowStart[row + std::size_t{1}]);
    if (begin == end) return 0;
    place = static_cast<std::size_t>(std::min_element(begin, end) - matrix.value.begin());
  }
  const double value = matrix.value[*place];
  return matrix.error[*place] * std::sqrt(value > 0 ? std::max(1.0, truth / value) : 1.0);
}

std::vector<std::uint32_t> spreadSurfaces(std::size_t surfaces, std::size_t count) {
  count = std::min(count, surfaces);
  std::vector<std::uint32_t> chosen;
  for (std::size_t n = 0; n < count; ++n)
    chosen.push_back(static_cast<std::uint32_t>((2 * n + 1) * surfaces / (2 * count)));
  return chosen;
}

std::vector<TrueRow> measuredRows(const FacetMesh& mesh, const std::vector<std::uint32_t>& surfaces, int samples) {
  const RayFormFactors rays(mesh.scene, mesh.discretization);
  const Receivers receivers = everyElement(mesh.discretization);
  std::vector<TrueRow> rows;
  for (const std::uint32_t surface : surfaces) rows.push_back(measuredRow(mesh, rays, receivers, surface, samples));
  return rows;
}

JudgedRows judgedRows(const JudgedMatrix& matrix, const JudgeSettings& settings) {
  const std::vector<std::uint32_t> surfaces = chosenSurfaces(matrix, static_cast<std::size_t>(settings.rows));
  const std::vector<ConvexPolygons> polygons = convexPolygons(matrix.mesh.scene);
  JudgedRows rows{{}, surfaces.size()};
  for (const TrueRow& measured : measuredRows(matrix.mesh, surfaces, settings.samples))
    rows.all.push_back(trueRow(matrix, measured, polygons));
  bool isAlone = true;  // each facet in its place
  for (const std::vector<std::uint32_t>& facets : matrix.facetsOf) isAlone = isAlone && facets.size() == 1;
  for (std::size_t r = 0; r < rows.rows && isAlone; ++r) {
    rows.all.push_back(rows.all[r]);
    rows.all.back().isColumn = true;
  }
  for (JudgedRow& row : rows.all) compare(matrix, row);
  return rows;
}

}  // namespace hemitex::reference
