#include "reference/matrices/matrix_judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "raster/base/parallel.h"
#include "raster/base/short_number.h"
#include "reference/matrices/facet_order.h"
#include "reference/truth/closed_forms/quick_form_factor.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"

namespace hemitex::reference {
namespace {

using raster::shortNumber;

/// Normal deviations of a confidence of 1 - 1e-6.
constexpr double confidence = 4.9;
/// A single entry that differs by less is no fault; the sum of such differences may be one.
constexpr double smallestFactor = 5e-4;
/// Of sums and of closed forms.
constexpr double rounding = 1e-6;
/// Sums of entries average the errors of single ones: this part of the tolerance is left to them.
constexpr double toleranceOfSums = 0.25;
/// Backs are met from buried parts of facets above all, which programs divide in other ways: they may differ more.
constexpr double toleranceOfBacks = 4;
/// Differences within this number of standard errors say nothing of a fault.
constexpr double unclear = 3;
/// Of all facets, rough rows tell which are measured beside the others.
constexpr std::size_t suspects = 6;
/// A fault is named if its prediction is nearer to the matrix than the truth by this factor.
constexpr double nearerBy = 3;

double entry(const SparseMatrix& matrix, std::uint32_t row, std::uint32_t column) {
  const std::optional<std::size_t> place = matrix.placeOf(row, column);
  return place ? matrix.value[*place] : 0;
}

glm::dvec3 middleOf(const radiosity::Surface& surface) {
  glm::dvec3 sum(0);
  for (const radiosity::Triangle& triangle : surface.triangles)
    sum += radiosity::area(triangle) * (triangle.position[0] + triangle.position[1] + triangle.position[2]) / 3.0;
  return sum / radiosity::area(surface);
}

/// A row by rays, one value per surface. By reciprocity it is also what the surface receives, in units of its own
/// light.
struct TrueRow {
  std::uint32_t surface = 0;
  std::vector<double> factor, error;
  double sum = 0;
  std::array<Measurement, 2> outside{};  ///< surroundings, backs
  double sumError = 0;                   ///< of the sum, at most
  bool isColumn = false;                 ///< whether it is held against the column of the facet
};

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

/// `count` surfaces, evenly spread over their numbers.
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

/// The mesh with all facets turned over, or one of them.
radiosity::Scene turnedOver(const radiosity::Scene& scene, std::optional<std::uint32_t> only = {}) {
  radiosity::Scene turned = scene;
  for (std::uint32_t s = 0; s < turned.surfaces.size(); ++s)
    if (!only || *only == s) radiosity::turnOver(turned.surfaces[s]);
  return turned;
}

/// Two surfaces that a program may see through: `behind` lies behind `front`, or in the same place, and should not be
/// visible through it.
struct CoveredPair {
  std::uint32_t front = 0, behind = 0;
  bool isOnePlace = false;    ///< both face the same way and are in contact: either of them may receive the light
  bool isBackToBack = false;  ///< both face away from each other and are in contact
};

/// Whether the line through a point along the normal of a surface meets it.
bool isOver(const radiosity::Surface& surface, const glm::dvec3& normal, const glm::dvec3& point) {
  return std::any_of(surface.triangles.begin(), surface.triangles.end(), [&](const radiosity::Triangle& triangle) {
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 &a = triangle.position[k], &b = triangle.position[(k + 1) % 3];
      if (glm::dot(glm::cross(b - a, point - a), normal) < 0) return false;
    }
    return true;
  });
}

/// Whether one of two parallel surfaces covers the middle of the other, or a point near one of its corners.
bool areOver(const radiosity::Surface& a, const radiosity::Surface& b) {
  const auto covers = [](const radiosity::Surface& surface, const radiosity::Surface& other) {
    const glm::dvec3 normal = radiosity::normal(surface.triangles.front()), middle = middleOf(other);
    if (isOver(surface, normal, middle)) return true;
    for (const radiosity::Triangle& triangle : other.triangles)
      for (const glm::dvec3& corner : triangle.position)
        if (isOver(surface, normal, corner + 0.01 * (middle - corner))) return true;
    return false;
  };
  return covers(a, b) || covers(b, a);
}

/// The pairs of parallel surfaces one over the other, at a distance of at most a hundredth of the smaller one's size.
std::vector<CoveredPair> coveredPairs(const radiosity::Scene& scene) {
  const std::size_t count = scene.surfaces.size();
  std::vector<glm::dvec3> normal, middle;
  std::vector<double> size;
  for (const radiosity::Surface& surface : scene.surfaces) {
    normal.push_back(radiosity::normal(surface.triangles.front()));
    middle.push_back(middleOf(surface));
    size.push_back(std::sqrt(radiosity::area(surface)));
  }
  const double contact = radiosity::contactTolerance(scene);
  std::vector<CoveredPair> pairs;
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b) {
      const double cosine = glm::dot(normal[a], normal[b]);
      const double height = glm::dot(normal[a], middle[b] - middle[a]);
      if (std::abs(cosine) < 1 - 1e-6 || std::abs(height) > 0.01 * std::min(size[a], size[b])) continue;
      if (!areOver(scene.surfaces[a], scene.surfaces[b])) continue;
      const bool isInFront = height > 0;  // b before a
      if (cosine > 0 && std::abs(height) <= contact)
        pairs.push_back({.front = a, .behind = b, .isOnePlace = true});
      else if (cosine > 0)
        pairs.push_back({.front = isInFront ? b : a, .behind = isInFront ? a : b});
      else if (height <= contact)  // back to back: each hides the other
        for (const auto& [front, behind] : {std::pair(a, b), {b, a}})
          pairs.push_back({.front = front, .behind = behind, .isBackToBack = height >= -contact});
    }
  return pairs;
}

class Judge {
 public:
  Judge(const SparseMatrix& matrix, const FacetMesh& mesh, const JudgeSettings& settings)
      : matrix_(matrix), mesh_(mesh), settings_(settings), pairs_(coveredPairs(mesh.scene)) {
    for (const radiosity::Surface& surface : mesh.scene.surfaces) area_.push_back(radiosity::area(surface));
    findPlaces();
  }

  MatrixVerdict verdict() {
    if (!hasSize()) return verdict_;
    checkEntries();
    checkReciprocity();
    rows_ = measuredRows(mesh_, chosenSurfaces(), settings_.samples);
    const std::vector<ConvexPolygons> polygons = convexPolygons(mesh_.scene);
    for (const TrueRow& row : rows_) {
      unblocked_.emplace_back(mesh_.scene.surfaces.size());
      std::vector<double>& closed = unblocked_.back();
      raster::parallelFor(closed.size(), [&](std::size_t s) {
        for (const radiosity::Instance& instance : mesh_.scene.instances)
          closed[s] += quickFormFactor(polygons[row.surface], placed(mesh_.scene, polygons[s], instance));
      });
    }
    joinPlaces();
    measured_ = rows_.size();
    addColumns();
    checkRows();
    checkSums();
    checkOutside();
    checkErrors();
    if (!verdict_.problems.empty()) nameFault();
    return verdict_;
  }

 private:
  using Value = std::function<double(std::size_t row, std::uint32_t to)>;  ///< of a measured row to a surface

  /// Whether light may go to the front of a surface or to the back of another one in the same place, as in a solid that
  /// touches both the surface and the one that sends the light.
  bool isTied(std::size_t row, std::uint32_t to) const { return touches_[rows_[row].surface] && touches_[to]; }

  /// The facets of each place: those of its first surface, of others in the same place, and of their repetitions.
  void findPlaces() {
    placeOf_.resize(area_.size());
    std::iota(placeOf_.begin(), placeOf_.end(), 0U);
    for (const CoveredPair& pair : pairs_)
      if (pair.isOnePlace) placeOf_[pair.behind] = placeOf_[pair.front];
    touches_.resize(area_.size());
    for (const CoveredPair& pair : pairs_)
      if (pair.isBackToBack) touches_[pair.front] = true;
    facetsOf_.resize(area_.size());
    areaOfPlace_.resize(area_.size());
    std::vector<std::uint32_t> surfaceOf(mesh_.facets);
    for (std::uint32_t s = 0; s < area_.size(); ++s) {
      surfaceOf[facet(s)] = s;
      facetsOf_[placeOf_[s]].push_back(facet(s));
      areaOfPlace_[placeOf_[s]] += area_[s];
    }
    for (const auto& [repetition, original] : mesh_.repeated) {
      const std::uint32_t place = placeOf_[surfaceOf[original]];
      facetsOf_[place].push_back(repetition);
      areaOfPlace_[place] += area_[surfaceOf[original]];
    }
  }

  /// Moves light to the first surface of each place.
  void joinPlaces() {
    for (std::size_t r = 0; r < rows_.size(); ++r)
      for (std::uint32_t s = 0; s < area_.size(); ++s) {
        const std::uint32_t place = placeOf_[s];
        if (place == s) continue;
        TrueRow& row = rows_[r];
        row.factor[place] += row.factor[s];
        row.error[place] = std::hypot(row.error[place], row.error[s]);
        unblocked_[r][place] = std::max(unblocked_[r][place], unblocked_[r][s]) +
                               (area_[place] == area_[s] ? 0 : std::min(unblocked_[r][place], unblocked_[r][s]));
        row.factor[s] = row.error[s] = unblocked_[r][s] = 0;
      }
  }

  std::uint32_t facet(std::uint32_t surface) const { return mesh_.facetOf[surface]; }
  std::string name(std::uint32_t facet) const { return "facet " + std::to_string(facet); }
  void add(const std::string& problem) { verdict_.problems.push_back(problem); }

  bool hasOutside() const { return matrix_.columns > mesh_.facets; }

  /// Surfaces that are spread over the mesh, and those whose rough rows differ the most from the given ones.
  std::vector<std::uint32_t> chosenSurfaces() const {
    const std::size_t surfaces = area_.size();
    std::vector<std::uint32_t> chosen = spreadSurfaces(surfaces, static_cast<std::size_t>(settings_.rows)), all;
    if (chosen.size() == surfaces) return chosen;
    all = spreadSurfaces(surfaces, surfaces);
    const auto samples = static_cast<int>(std::clamp<std::size_t>((std::size_t{1} << 20) / surfaces, 64, 1 << 12));
    const std::vector<TrueRow> rough = measuredRows(mesh_, all, samples);
    std::vector<double> apart(surfaces, 0.0);
    for (std::uint32_t s = 0; s < surfaces; ++s) {
      double given = 0;
      for (std::uint32_t to = 0; to < surfaces; ++to) {
        const double found = entry(matrix_, facet(s), facet(to)), back = entry(matrix_, facet(to), facet(s));
        apart[s] += std::abs(found - rough[s].factor[to]) + std::abs(found - back * area_[to] / area_[s]);
        given += found;
      }
      if (hasOutside())
        for (std::uint32_t k = 0; k < 2; ++k) given += entry(matrix_, facet(s), facetCount() + k);
      if (hasOutside()) apart[s] += 10 * std::abs(given - 1);
    }
    std::stable_sort(all.begin(), all.end(), [&](auto a, auto b) { return apart[a] > apart[b]; });
    for (const std::uint32_t s : std::span(all).first(std::min(suspects, surfaces)))
      if (std::find(chosen.begin(), chosen.end(), s) == chosen.end()) chosen.push_back(s);
    return chosen;
  }

  std::uint32_t facetCount() const { return static_cast<std::uint32_t>(mesh_.facets); }

  /// Holds what each measured facet receives against its column, unless facets share their light.
  void addColumns() {
    for (std::uint32_t s = 0; s < area_.size(); ++s)
      if (placeOf_[s] != s || facetsOf_[s].size() > 1) return;
    for (std::size_t r = 0; r < measured_; ++r) {
      rows_.push_back(rows_[r]);
      rows_.back().isColumn = true;
      unblocked_.push_back(unblocked_[r]);
    }
  }

  bool hasSize() {
    if (matrix_.rows() == mesh_.facets && (matrix_.columns == mesh_.facets || matrix_.columns == mesh_.facets + 2))
      return true;
    add("the matrix has " + std::to_string(matrix_.rows()) + " rows and " + std::to_string(matrix_.columns) +
        " columns, and the mesh has " + std::to_string(mesh_.facets) + " facets");
    verdict_.fault = matrix_.rows() < mesh_.facets ? "rows are missing: the file is cut off, or belongs to another mesh"
                                                   : "the matrix belongs to another mesh";
    return false;
  }

  void checkEntries() {
    std::size_t outside = 0, selves = 0;
    double worst = 0;
    std::pair<std::uint32_t, std::uint32_t> place;
    std::uint32_t largest = 0;
    for (std::uint32_t r = 0; r < matrix_.rows(); ++r) {
      const SparseRow row = matrix_.row(r);
      double sum = 0;
      for (std::size_t k = 0; k < row.column.size(); ++k) {
        if (row.column[k] >= mesh_.facets) continue;
        const double value = row.value[k], excess = std::max(-value, value - 1);
        sum += value;
        if (row.column[k] == r && value > smallestFactor) ++selves;
        if (excess <= rounding) continue;
        ++outside;
        if (excess > worst) {
          worst = excess;
          place = {r, row.column[k]};
        }
      }
      if (sum > verdict_.largestRowSum) {
        verdict_.largestRowSum = sum;
        largest = r;
      }
    }
    if (outside > 0)
      add(std::to_string(outside) + " entries are outside [0, 1]; the worst is " +
          shortNumber(entry(matrix_, place.first, place.second)) + " from " + name(place.first) + " to " +
          name(place.second));
    if (verdict_.largestRowSum > 1 + 1e-3)
      add("the row of " + name(largest) + " sums to " + shortNumber(verdict_.largestRowSum) + ", above 1");
    // A facet may see its images.
    if (selves > 0 && mesh_.scene.instances.size() == 1) add(std::to_string(selves) + " planar facets see themselves");
  }

  void checkReciprocity() {
    double difference = 0, sum = 0, expected = 0, worst = 0;
    std::pair<std::uint32_t, std::uint32_t> place;
    std::vector<double> area(mesh_.facets, 0.0);  // of the facets
    for (std::uint32_t s = 0; s < area_.size(); ++s) area[facet(s)] = area_[s];
    for (const auto& [repetition, original] : mesh_.repeated) area[repetition] = area[original];
    for (std::uint32_t i = 0; i < matrix_.rows(); ++i) {
      const SparseRow row = matrix_.row(i);
      for (std::size_t k = 0; k < row.column.size() && row.column[k] < mesh_.facets; ++k) {
        const std::uint32_t j = row.column[k];
        const double there = area[i] * row.value[k], back = area[j] * entry(matrix_, j, i);
        sum += there;
        if (!matrix_.error.empty() && area[j] > 0)
          expected +=
              (area[i] * matrix_.error[matrix_.rowStart[i] + k] + area[j] * statedError(j, i, there / area[j])) / 2;
        // A pair of which one entry is missing is met once.
        difference += (back == 0 ? 2 : 1) * std::abs(there - back) / 2;
        if (std::abs(there - back) > worst) {
          worst = std::abs(there - back);
          place = {i, j};
        }
      }
    }
    verdict_.reciprocity = sum > 0 ? difference / sum : 0;
    if (difference - unclear * expected > std::max(0.2, 4 * settings_.tolerance) * sum)
      add("reciprocity is missed by " + shortNumber(100 * verdict_.reciprocity) +
          " % of all exchange; the worst pair is " + name(place.first) + " and " + name(place.second));
  }

  /// Entries of a measured row, or of what it receives, in a matrix whose entry from facet i to facet j is at(i, j):
  /// the sum of those to the place of a surface; 0 if it is that of an earlier surface.
  template <typename At>
  double gathered(std::size_t row, std::uint32_t to, const At& at) const {
    const std::uint32_t own = rows_[row].surface;
    if (rows_[row].isColumn) return area_[to] / area_[own] * at(facet(to), facet(own));
    double sum = 0;
    for (const std::uint32_t f : facetsOf_[to]) sum += at(facet(own), f);
    return sum;
  }

  double given(std::size_t row, std::uint32_t to) const {
    return gathered(row, to, [this](std::uint32_t i, std::uint32_t j) { return entry(matrix_, i, j); });
  }

  /// The error that the matrix states for an entry whose true value is known; 0 if it states none. Errors of counts
  /// grow with the root of the value, so that a true value above the given one has a larger error. An entry that the
  /// matrix lacks has the error of the smallest one of its row.
  double statedError(std::uint32_t i, std::uint32_t j, double truth) const {
    if (matrix_.error.empty()) return 0;
    std::optional<std::size_t> place = matrix_.placeOf(i, j);
    if (!place) {
      const auto begin = matrix_.value.begin() + static_cast<std::ptrdiff_t>(matrix_.rowStart[i]),
                 end = matrix_.value.begin() + static_cast<std::ptrdiff_t>(matrix_.rowStart[i + std::size_t{1}]);
      if (begin == end) return 0;
      place = static_cast<std::size_t>(std::min_element(begin, end) - matrix_.value.begin());
    }
    const double value = matrix_.value[*place];
    return matrix_.error[*place] * std::sqrt(value > 0 ? std::max(1.0, truth / value) : 1.0);
  }

  double stated(std::size_t row, std::uint32_t to) const {
    if (matrix_.error.empty()) return 0;
    const TrueRow& r = rows_[row];
    const double truth = r.isColumn ? r.factor[to] * area_[r.surface] / area_[to] : r.factor[to];
    return gathered(row, to, [&](std::uint32_t i, std::uint32_t j) { return statedError(i, j, truth); });
  }

  /// A difference of an entry that is no fault; entries of large facets weigh more in what a small one receives.
  double smallest(std::size_t row, std::uint32_t to) const {
    return smallestFactor * (rows_[row].isColumn ? std::max(1.0, area_[to] / area_[rows_[row].surface]) : 1.0);
  }

  /// Whether a value lies in its interval.
  bool isInside(double found, double truth, double error, double stated, double part) const {
    return std::abs(found - truth) <= confidence * std::hypot(error, stated) +
                                          part * settings_.tolerance * std::max(found, truth) + smallestFactor;
  }

  std::string lightOf(const TrueRow& row) const {
    return (row.isColumn ? "the light that " + name(facet(row.surface)) + " receives"
                         : "the row of " + name(facet(row.surface)));
  }

  /// The sums over what is judged of a measured row, and the error of that of the matrix. Stated errors are added, or,
  /// as those of rays, independent.
  struct RowSums {
    double found = 0, truth = 0, stated = 0;
  };
  RowSums sumsOf(std::size_t r) const {
    RowSums sums;
    double squares = 0, all = 0, amplified = 0;
    for (std::uint32_t to = 0; to < area_.size(); ++to) {
      if (isTied(r, to)) continue;
      const double larger = smallest(r, to) - smallestFactor;
      amplified += larger * larger;
      const double error = stated(r, to);
      sums.found += given(r, to);
      sums.truth += rows_[r].factor[to];
      squares += error * error;
      all += error;
    }
    sums.stated = std::max(std::sqrt(squares), all / confidence) + std::sqrt(amplified) / confidence;
    return sums;
  }

  /// Sums of rows and of columns, of each and of all together.
  void checkSums() {
    std::size_t count = 0;
    double worst = 0, found = 0, truth = 0, squares = 0;
    std::string text;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const TrueRow& row = rows_[r];
      const RowSums sums = sumsOf(r);
      const double area = area_[row.surface];
      if (!row.isColumn) {
        found += area * sums.found;
        truth += area * sums.truth;
        squares += area * area * (row.sumError * row.sumError + sums.stated * sums.stated);
      }
      if (isInside(sums.found, sums.truth, row.sumError, sums.stated, toleranceOfSums)) continue;
      ++count;
      const double excess = std::abs(sums.found - sums.truth);
      if (excess <= worst) continue;
      worst = excess;
      text = lightOf(row) + ": " + shortNumber(sums.found) + ", where rays measure " + shortNumber(sums.truth) +
             " +- " + shortNumber(confidence * row.sumError);
    }
    if (count > 0) add(std::to_string(count) + " sums of rows or columns differ from rays; the worst is " + text);
    if (count == 0 &&
        std::abs(found - truth) > confidence * std::sqrt(squares) + toleranceOfSums * settings_.tolerance * truth)
      add("all entries of the measured rows together are " + shortNumber(found / truth) + " of what rays measure");
    if (!hasOutside()) return;
    std::size_t open = 0;
    worst = 0;
    for (std::uint32_t f = 0; f < mesh_.facets; ++f) {
      const SparseRow row = matrix_.row(f);
      const double sum = std::accumulate(row.value.begin(), row.value.end(), 0.0);
      if (sum == 0 || std::abs(sum - 1) <= toleranceOfSums * settings_.tolerance) continue;
      ++open;
      if (std::abs(sum - 1) <= worst) continue;
      worst = std::abs(sum - 1);
      text = name(f) + ": " + shortNumber(sum);
    }
    if (open > 0)
      add(std::to_string(open) + " rows with surroundings and backs do not sum to 1; the worst is that of " + text);
  }

  /// The share of a measured row that leaves the mesh (0), or meets backs (1).
  double outside(std::size_t r, std::uint32_t which) const {
    return entry(matrix_, facet(rows_[r].surface), facetCount() + which);
  }
  bool isOutsideJudged(std::size_t r, std::uint32_t which) const {
    return !rows_[r].isColumn && (which == 0 || !touches_[rows_[r].surface]);
  }

  void checkOutside() {
    if (!hasOutside()) return;
    for (std::uint32_t which = 0; which < 2; ++which) {
      std::size_t count = 0;
      double worst = 0;
      std::string text;
      for (std::size_t r = 0; r < measured_; ++r) {
        const Measurement& truth = rows_[r].outside[which];
        const double found = outside(r, which), apart = std::abs(found - truth.value);
        const double error = statedError(facet(rows_[r].surface), facetCount() + which, truth.value);
        if (!isOutsideJudged(r, which) ||
            isInside(found, truth.value, truth.standardError, error, which == 0 ? 1 : toleranceOfBacks))
          continue;
        isOutsideWrong_ = true;
        ++count;
        if (apart <= worst) continue;
        worst = apart;
        text = shortNumber(found) + " from " + name(facet(rows_[r].surface)) + ", where rays measure " +
               shortNumber(truth.value);
      }
      if (count > 0)
        add(std::to_string(count) + (which == 0 ? " shares of the surroundings" : " shares of backs") + " of " +
            std::to_string(measured_) + " measured rows differ from rays; the worst is " + text);
    }
  }

  /// Where the given rows leave their intervals.
  void checkRows() {
    struct Kind {
      std::size_t count = 0;
      double worst = 0;
      std::string text;
    };
    Kind impossible, above, outside, missing;
    const auto count = [&](Kind& kind, std::size_t r, std::uint32_t to, double excess, double found,
                           const std::string& truth) {
      ++kind.count;
      if (excess <= kind.worst) return;
      kind.worst = excess;
      const bool isColumn = rows_[r].isColumn;
      const std::uint32_t own = facet(rows_[r].surface), other = facet(to);
      kind.text = shortNumber(found) + " from " + name(isColumn ? other : own) + " to " + name(isColumn ? own : other) +
                  (isColumn ? ", in parts of what the latter sends" : "") + ", where " + truth;
    };
    double difference = 0, sum = 0, noise = 0, ofErrors = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const TrueRow& row = rows_[r];
      for (std::uint32_t to = 0; to < area_.size(); ++to) {
        const double found = given(r, to), truth = row.factor[to], closed = unblocked_[r][to];
        const double ofMatrix = stated(r, to), least = smallest(r, to);
        const double allowed =
            confidence * std::hypot(row.error[to], ofMatrix) + settings_.tolerance * std::max(found, truth) + least;
        const double beyond =
            found - closed * (1 + std::max(settings_.tolerance, 2e-3)) - (closed > 0 ? confidence * ofMatrix : 0);
        if (isTied(r, to) && beyond <= least) continue;
        if (!row.isColumn) {
          difference += area_[row.surface] * std::abs(found - truth);
          noise += area_[row.surface] * row.error[to];
          ofErrors += area_[row.surface] * std::hypot(row.error[to], ofMatrix);
          sum += area_[row.surface] * truth;
        }
        if (closed == 0 && found > least)
          count(impossible, r, to, found, found, "nothing can be seen");
        else if (beyond > least)
          count(above, r, to, found - closed, found, "the closed form without blockers is " + shortNumber(closed));
        else if (found == 0 && truth > allowed)
          count(missing, r, to, truth, found, "rays measure " + shortNumber(truth));
        else if (std::abs(found - truth) > allowed)
          count(outside, r, to, std::abs(found - truth), found,
                "rays measure " + shortNumber(truth) + " +- " + shortNumber(confidence * row.error[to]));
      }
    }
    verdict_.measuredRows = measured_;
    verdict_.difference = sum > 0 ? difference / sum : difference;
    verdict_.noise = sum > 0 ? noise / sum : 0;
    if (difference - unclear * ofErrors > settings_.tolerance * sum && verdict_.difference > rounding)
      add("the measured rows differ from rays by " + shortNumber(100 * verdict_.difference) + " % of their light");
    const auto tell = [&](const Kind& kind, const std::string& what) {
      if (kind.count > 0)
        add(std::to_string(kind.count) + " entries of " + std::to_string(measured_) + " measured rows " + what +
            "; the worst is " + kind.text);
    };
    tell(impossible, "are above 0 where nothing can be seen");
    tell(above, "are above the closed form without blockers");
    tell(missing, "are 0 where something is seen");
    tell(outside, "differ from rays");
  }

  /// Whether the errors that the matrix states explain its differences from rays.
  void checkErrors() {
    if (matrix_.error.empty()) return;
    double difference = 0, expected = 0, all = 0;
    for (std::size_t r = 0; r < measured_; ++r)
      for (std::uint32_t to = 0; to < area_.size(); ++to) {
        if (isTied(r, to)) continue;
        const double area = area_[rows_[r].surface];
        difference += area * std::abs(given(r, to) - rows_[r].factor[to]);
        expected += area * (stated(r, to) + rows_[r].error[to]);
        all += area * rows_[r].factor[to];
      }
    if (difference > 4 * expected + 0.01 * all)
      add("entries of the measured rows are off by " + shortNumber(difference / expected) +
          " times the errors that the matrix states");
  }

  /// The sum of the differences of two matrices in the measured rows, by area, of entries and of sums, as far as errors
  /// do not explain them. With `columns` also of what the facets receive.
  double distance(const Value& a, const Value& b, bool columns = false) const {
    double sum = 0, all = 0, squares = 0;
    for (std::size_t r = 0; r < (columns ? rows_.size() : measured_); ++r) {
      const double area = area_[rows_[r].surface], sumError = std::hypot(rows_[r].sumError, sumsStated_[r]);
      double apart = 0, difference = 0;
      for (std::uint32_t to = 0; to < area_.size(); ++to) {
        if (isTied(r, to)) continue;
        const double one = a(r, to) - b(r, to);
        apart += std::max(0.0, std::abs(one) - unclear * errors_[r][to]);
        difference += one;
      }
      sum += area * (apart + std::max(0.0, std::abs(difference) - unclear * sumError));
      if (rows_[r].isColumn) continue;
      all += area * difference;
      squares += area * area * sumError * sumError;
    }
    return sum + std::max(0.0, std::abs(all) - unclear * std::sqrt(squares));
  }

  /// Names the fault whose prediction is nearest to the matrix.
  void nameFault() {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      sumsStated_.push_back(sumsOf(r).stated);
      errors_.emplace_back(area_.size());
      for (std::uint32_t to = 0; to < area_.size(); ++to)
        errors_[r][to] = std::hypot(rows_[r].error[to], stated(r, to));
    }
    const Value matrix = [this](std::size_t r, std::uint32_t to) { return given(r, to); };
    const Value truth = [this](std::size_t r, std::uint32_t to) { return rows_[r].factor[to]; };
    const double all = distance(truth, [](std::size_t, std::uint32_t) { return 0.0; });
    const double before = distance(matrix, truth), beforeBoth = distance(matrix, truth, true);
    double nearest = 1 / nearerBy;
    const auto consider = [&](const std::string& fault, const Value& found, const Value& predicted, double scale = 1,
                              bool columns = false) {
      const double apart = scale * distance(found, predicted, columns), most = columns ? beforeBoth : before;
      if (!(apart < nearest * most) || !(apart < 0.25 * all)) return;
      nearest = apart / most;
      verdict_.fault = fault;
    };
    considerChangedMatrices(consider, truth);
    considerChangedTruths(consider, matrix);
    considerScale(consider, truth);
    considerFacets(consider, matrix, truth);
    if (!verdict_.fault) considerOrders(consider, truth);
    if (!verdict_.fault && isOutsideWrong_ && before < settings_.tolerance * all) verdict_.fault = outsideFault();
  }

  /// All entries by one factor, unless a factor with a meaning explains it.
  template <typename Consider>
  void considerScale(const Consider& consider, const Value& truth) const {
    if (verdict_.fault) return;
    double found = 0, sum = 0;
    for (std::size_t r = 0; r < measured_; ++r) {
      const RowSums sums = sumsOf(r);
      found += area_[rows_[r].surface] * sums.found;
      sum += area_[rows_[r].surface] * sums.truth;
    }
    if (!(found > 0 && sum > 0)) return;
    const double factor = found / sum;
    consider(
        "all entries are multiplied by " + shortNumber(factor),
        [this, factor](std::size_t r, std::uint32_t to) { return given(r, to) / factor; }, truth);
  }

  /// Faults of single facets: those whose measured rows or columns differ the most.
  template <typename Consider>
  void considerFacets(const Consider& consider, const Value& matrix, const Value& truth) const {
    std::vector<std::uint32_t> worst;
    std::vector<double> apart(area_.size(), 0.0);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const std::uint32_t own = rows_[r].surface;
      if (!rows_[r].isColumn) worst.push_back(own);
      for (std::uint32_t to = 0; to < area_.size(); ++to)
        apart[own] += std::max(0.0, std::abs(given(r, to) - rows_[r].factor[to]) - unclear * errors_[r][to]);
      const RowSums sums = sumsOf(r);
      apart[own] += std::max(0.0, std::abs(sums.found - sums.truth) - unclear * rows_[r].sumError);
    }
    std::stable_sort(worst.begin(), worst.end(), [&](auto a, auto b) { return apart[a] > apart[b]; });
    worst.resize(std::min(worst.size(), suspects));
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const std::uint32_t own = facet(rows_[r].surface);
      const RowSums sums = sumsOf(r);
      if (std::find(worst.begin(), worst.end(), rows_[r].surface) == worst.end() || sums.truth == 0) continue;
      const double factor = sums.found / sums.truth;
      const bool isColumn = rows_[r].isColumn;
      if (factor == 0 && !isColumn)
        consider(
            "the row of " + name(own) + " is empty", matrix,
            [this, r](std::size_t row, std::uint32_t to) {
              const std::uint32_t from = rows_[row].isColumn ? to : rows_[row].surface;
              return from == rows_[r].surface ? 0.0 : rows_[row].factor[to];
            },
            1, true);
      if (!(factor > 0)) continue;
      consider((isColumn ? "the column of " : "the row of ") + name(own) + " is multiplied by " + shortNumber(factor),
               changed([this, own, isColumn, factor](std::uint32_t i, std::uint32_t j) {
                 return entry(matrix_, i, j) / ((isColumn ? j : i) == own ? factor : 1);
               }),
               truth, 1, true);
    }
    for (std::size_t a = 0; a < worst.size(); ++a)
      for (std::size_t b = a + 1; b < worst.size(); ++b) {
        const std::uint32_t one = facet(worst[a]), two = facet(worst[b]);
        const auto other = [one, two](std::uint32_t f) { return f == one ? two : f == two ? one : f; };
        consider(
            "facets " + std::to_string(std::min(one, two)) + " and " + std::to_string(std::max(one, two)) +
                " are exchanged",
            changed([this, other](std::uint32_t i, std::uint32_t j) { return entry(matrix_, other(i), other(j)); }),
            truth, 1, true);
      }
    worst.resize(std::min<std::size_t>(worst.size(), 3));
    for (const std::uint32_t surface : worst) {
      if (verdict_.fault) return;
      const Value turned = truthOf(turnedOver(mesh_.scene, surface));
      consider("the normal of " + name(facet(surface)) + " is turned over", matrix, turned);
    }
  }

  /// The measured rows of another scene with the same facets.
  Value truthOf(const radiosity::Scene& scene) const {
    const FacetMesh other{scene, mesh_.discretization, mesh_.facetOf, mesh_.facets};
    std::vector<std::uint32_t> surfaces;
    for (std::size_t r = 0; r < measured_; ++r) surfaces.push_back(rows_[r].surface);
    return [rows = measuredRows(other, surfaces, settings_.samples)](std::size_t r, std::uint32_t to) {
      return rows[r].factor[to];
    };
  }

  /// What is wrong with surroundings and backs where nothing is known to be wrong with the form factors.
  std::string outsideFault() const {
    double found = 0, sum = 0, exchanged = 0, straight = 0;
    for (std::size_t r = 0; r < measured_; ++r) {
      found += outside(r, 0);
      sum += rows_[r].outside[0].value;
      for (std::uint32_t k = 0; k < 2; ++k) {
        straight += std::abs(outside(r, k) - rows_[r].outside[k].value);
        exchanged += std::abs(outside(r, k) - rows_[r].outside[1 - k].value);
      }
    }
    if (exchanged * nearerBy < straight) return "surroundings and backs are exchanged";
    const double factor = sum > 0 ? found / sum : 0;
    double scaled = 0;
    for (std::size_t r = 0; r < measured_; ++r)
      scaled += std::abs(outside(r, 0) - factor * rows_[r].outside[0].value) +
                std::abs(outside(r, 1) - rows_[r].outside[1].value);
    if (scaled * nearerBy < straight) return "surroundings are multiplied by " + shortNumber(factor);
    return "surroundings or backs are wrong, although form factors may be right";
  }

  /// The measured entries of a matrix whose entry from facet i to facet j is at(i, j).
  template <typename At>
  Value changed(const At& at) const {
    return [this, at](std::size_t r, std::uint32_t to) { return gathered(r, to, at); };
  }

  /// The entry of a measured row, to the place of a surface, in a matrix whose facet f has the number other(f). Facets
  /// that no facet moves to are not compared.
  template <typename Other>
  Value moved(const Value& truth, const Other& other) const {
    return [this, &truth, other](std::size_t r, std::uint32_t to) {
      const auto count = static_cast<std::int64_t>(mesh_.facets);
      const std::int64_t i = other(facet(rows_[r].surface));
      double sum = 0;
      for (const std::uint32_t f : facetsOf_[to]) {
        const std::int64_t j = other(f);
        if (i < 0 || j < 0 || i >= count || j >= count) return truth(r, to);
        sum += entry(matrix_, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
      }
      return sum;
    };
  }

  /// Facets in any other order, by rough rows of all facets.
  template <typename Consider>
  void considerOrders(const Consider& consider, const Value& truth) const {
    const std::size_t facets = mesh_.facets;
    if (facets > maxOrderedFacets) return;
    FormFactorMatrix given{facets, std::vector<double>(facets * facets)}, rough = given;
    for (std::uint32_t i = 0; i < facets; ++i)
      for (std::uint32_t j = 0; j < facets; ++j) given.factors[i * facets + j] = entry(matrix_, i, j);
    for (const TrueRow& row : measuredRows(mesh_, spreadSurfaces(area_.size(), area_.size()), 1 << 14))
      for (std::uint32_t to = 0; to < area_.size(); ++to)
        rough.factors[facet(row.surface) * facets + facet(to)] = row.factor[to];
    const auto order = facetOrder(given, rough);
    if (!order) return;
    std::size_t others = 0;
    std::string examples;
    for (std::uint32_t f = 0; f < facets; ++f) {
      if ((*order)[f] == f || area_.empty()) continue;
      if (++others <= 3)
        examples += (others == 1 ? ": " : ", ") + name(f) + " has the number " + std::to_string((*order)[f]);
    }
    consider("facets are in another order" + examples + (others > 3 ? ", ..." : ""),
             moved(truth, [&](std::uint32_t f) { return static_cast<std::int64_t>((*order)[f]); }), truth);
  }

  /// Faults that are undone by a change of the matrix.
  template <typename Consider>
  void considerChangedMatrices(const Consider& consider, const Value& truth) const {
    const auto scaled = [this](const auto& factor) -> Value {
      return [this, factor](std::size_t r, std::uint32_t to) { return factor(r, to) * given(r, to); };
    };
    consider(
        "the matrix is transposed",
        [this](std::size_t r, std::uint32_t to) { return entry(matrix_, facet(to), facet(rows_[r].surface)); }, truth);
    consider("each row is multiplied by the area of its facet",
             scaled([this](std::size_t r, std::uint32_t) { return 1 / area_[rows_[r].surface]; }), truth);
    consider("each column is multiplied by the area of its facet",
             scaled([this](std::size_t, std::uint32_t to) { return 1 / area_[to]; }), truth);
    consider("entries are in percent", scaled([](std::size_t, std::uint32_t) { return 0.01; }), truth);
    consider("entries are multiplied by pi", scaled([](std::size_t, std::uint32_t) { return std::numbers::inv_pi; }),
             truth);
    consider("entries are divided by pi", scaled([](std::size_t, std::uint32_t) { return std::numbers::pi; }), truth);
    const auto last = static_cast<std::int64_t>(mesh_.facets) - 1;
    consider("facets are in reversed order", moved(truth, [last](std::int64_t f) { return last - f; }), truth);
    consider("facets are shifted by one, as if counted from 1 instead of 0",
             moved(truth, [](std::int64_t f) { return f + 1; }), truth);
    for (const int step : {-1, 1})
      consider("rows are shifted by one, but not columns", changed([this, step](std::uint32_t i, std::uint32_t j) {
                 return entry(matrix_, (i + facetCount() + static_cast<std::uint32_t>(step)) % facetCount(), j);
               }),
               truth);
    consider("facets are shifted by one, as if counted from 0 instead of 1",
             moved(truth, [](std::int64_t f) { return f - 1; }), truth);
  }

  /// Faults that predict another matrix than the true one.
  template <typename Consider>
  void considerChangedTruths(const Consider& consider, const Value& matrix) const {
    consider("blockers are ignored", matrix, [this](std::size_t r, std::uint32_t to) { return unblocked_[r][to]; });
    consider("blockers count twice", matrix, [this](std::size_t r, std::uint32_t to) {
      const double closed = unblocked_[r][to], factor = rows_[r].factor[to];
      return closed > 0 ? factor * std::min(factor / closed, 1.0) : 0.0;
    });
    consider("rows are normalized to 1, although light leaves the mesh", matrix,
             [this](std::size_t r, std::uint32_t to) {
               return rows_[r].sum > 0 ? rows_[r].factor[to] / rows_[r].sum : 0.0;
             });
    considerCovered(consider, matrix);
    const std::vector<std::vector<bool>> sees = centresThatSee();
    consider("partly hidden pairs are decided by their centres", matrix,
             [&](std::size_t r, std::uint32_t to) { return sees[r][to] ? unblocked_[r][to] : 0.0; });
    consider("all normals are turned over", matrix, truthOf(turnedOver(mesh_.scene)));
    consider("entries are averaged with their opposites, without areas", matrix,
             [this](std::size_t r, std::uint32_t to) {
               return rows_[r].factor[to] * (1 + area_[rows_[r].surface] / area_[to]) / 2;
             });
    // The smallest entry that the matrix has.
    double kept = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < matrix_.value.size(); ++k)
      if (matrix_.column[k] < mesh_.facets && matrix_.value[k] > 0) kept = std::min(kept, matrix_.value[k]);
    consider("entries below " + shortNumber(kept) + " are dropped", matrix,
             [this, kept](std::size_t r, std::uint32_t to) {
               return rows_[r].factor[to] < kept ? 0.0 : rows_[r].factor[to];
             });
  }

  /// Each facet of a place receives as much as if it were alone there. The same for facets right behind another.
  template <typename Consider>
  void considerCovered(const Consider& consider, const Value& matrix) const {
    std::optional<std::string> inOnePlace, behind;  // the first pair
    const auto pairOf = [this](std::uint32_t a, std::uint32_t b) { return name(a) + " and " + std::to_string(b); };
    if (!mesh_.repeated.empty()) inOnePlace = pairOf(mesh_.repeated.front().second, mesh_.repeated.front().first);
    std::vector<std::vector<std::uint32_t>> fronts(area_.size());
    for (const CoveredPair& pair : pairs_) {
      std::optional<std::string>& first = pair.isOnePlace ? inOnePlace : behind;
      if (!first) first = pairOf(facet(pair.front), facet(pair.behind));
      if (!pair.isOnePlace) fronts[pair.behind].push_back(pair.front);
    }
    const Value seenTogether = [this](std::size_t r, std::uint32_t to) {
      return placeOf_[to] == to ? areaOfPlace_[to] / area_[to] * rows_[r].factor[to] : 0.0;
    };
    const Value seenBehind = [&](std::size_t r, std::uint32_t to) {
      double sum = rows_[r].factor[to];
      for (const std::uint32_t front : fronts[to]) sum += rows_[r].factor[front];
      return sum;
    };
    if (inOnePlace) consider("facets in one place are all visible, such as " + *inOnePlace, matrix, seenTogether);
    if (behind) consider("facets right behind others are visible, such as " + *behind, matrix, seenBehind);
  }

  /// Whether the line between the centres of a measured facet and another is free.
  std::vector<std::vector<bool>> centresThatSee() const {
    const RayCaster caster(mesh_.scene);
    const radiosity::Scene& scene = mesh_.scene;
    std::vector<std::uint32_t> surfaceOf, first;
    for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
      first.push_back(static_cast<std::uint32_t>(surfaceOf.size()));
      surfaceOf.insert(surfaceOf.end(), scene.surfaces[s].triangles.size(), s);
    }
    std::vector<std::vector<bool>> sees;
    for (const TrueRow& row : std::span(rows_).first(measured_)) {
      const glm::dvec3 start = middleOf(scene.surfaces[row.surface]);
      std::vector<bool> seen(scene.surfaces.size());
      for (std::uint32_t to = 0; to < seen.size(); ++to) {
        const glm::dvec3 way = middleOf(scene.surfaces[to]) - start;
        if (to == row.surface || glm::length(way) == 0) continue;
        const auto hit =
            caster.firstHit({(start - scene.origin) / scene.extent, glm::normalize(way), first[row.surface]});
        seen[to] = hit && hit->triangle < surfaceOf.size() && surfaceOf[hit->triangle] == to;
      }
      sees.push_back(std::move(seen));
    }
    return sees;
  }

  const SparseMatrix& matrix_;
  const FacetMesh& mesh_;
  JudgeSettings settings_;
  std::vector<double> area_;  ///< of the surfaces
  std::vector<CoveredPair> pairs_;
  std::vector<bool> touches_;                         ///< whether another surface touches the back of each
  std::vector<std::uint32_t> placeOf_;                ///< the first surface in the place of each
  std::vector<std::vector<std::uint32_t>> facetsOf_;  ///< of the place of each surface that is the first there
  std::vector<double> areaOfPlace_;                   ///< of these facets
  std::vector<TrueRow> rows_;                         ///< measured, then the same for what these facets receive
  std::size_t measured_ = 0;
  std::vector<std::vector<double>> errors_;  ///< of the entries of rows_, those that the matrix states included
  std::vector<double> sumsStated_;           ///< errors of the sums of rows_ that the matrix states
  bool isOutsideWrong_ = false;
  std::vector<std::vector<double>> unblocked_;  ///< of the measured rows
  MatrixVerdict verdict_;
};

}  // namespace

MatrixVerdict judgeMatrix(const SparseMatrix& matrix, const FacetMesh& mesh, const JudgeSettings& settings) {
  return Judge(matrix, mesh, settings).verdict();
}

}  // namespace hemitex::reference
