#include "reference/truth/matrices/matrix_judge.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "raster/base/parallel.h"
#include "raster/base/short_number.h"
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
/// A fault is named if its prediction is nearer to the matrix than the truth by this factor.
constexpr double nearerBy = 3;

double entry(const SparseMatrix& matrix, std::uint32_t row, std::uint32_t column) {
  const SparseRow entries = matrix.row(row);
  const auto place = std::lower_bound(entries.column.begin(), entries.column.end(), column);
  if (place == entries.column.end() || *place != column) return 0;
  return entries.value[static_cast<std::size_t>(place - entries.column.begin())];
}

glm::dvec3 middleOf(const radiosity::Surface& surface) {
  glm::dvec3 sum(0);
  for (const radiosity::Triangle& triangle : surface.triangles)
    sum += radiosity::area(triangle) * (triangle.position[0] + triangle.position[1] + triangle.position[2]) / 3.0;
  return sum / radiosity::area(surface);
}

/// A row by rays, one value per surface.
struct TrueRow {
  std::uint32_t surface = 0;
  std::vector<double> factor, error;
  double sum = 0;
};

TrueRow measuredRow(const FacetMesh& mesh, const RayFormFactors& rays, const Receivers& receivers,
                    std::uint32_t surface, int samples) {
  const std::vector<std::uint32_t> own = elementsOfSurface(mesh.discretization, surface);
  const MeasuredRow measured = rays.overHemisphere(areaRaySource(rays.pieces(), own), receivers, {.samples = samples});
  TrueRow row{surface, std::vector<double>(mesh.scene.surfaces.size()), std::vector<double>(mesh.scene.surfaces.size()),
              0};
  for (std::size_t e = 0; e < measured.receivers.size(); ++e) {
    const std::uint32_t to = mesh.discretization.elements[e].surface;
    row.factor[to] = measured.receivers[e].value;
    row.error[to] = measured.receivers[e].standardError;
    row.sum += measured.receivers[e].value;
  }
  return row;
}

std::vector<TrueRow> measuredRows(const FacetMesh& mesh, const JudgeSettings& settings) {
  const RayFormFactors rays(mesh.scene, mesh.discretization);
  const Receivers receivers = everyElement(mesh.discretization);
  const std::size_t surfaces = mesh.scene.surfaces.size();
  const std::size_t count = std::min<std::size_t>(static_cast<std::size_t>(settings.rows), surfaces);
  std::vector<TrueRow> rows;
  for (std::size_t n = 0; n < count; ++n)
    rows.push_back(measuredRow(mesh, rays, receivers, static_cast<std::uint32_t>((2 * n + 1) * surfaces / (2 * count)),
                               settings.samples));
  return rows;
}

/// The mesh with all facets turned over.
radiosity::Scene turnedOver(const radiosity::Scene& scene) {
  radiosity::Scene turned = scene;
  for (radiosity::Surface& surface : turned.surfaces) radiosity::turnOver(surface);
  return turned;
}

class Judge {
 public:
  Judge(const SparseMatrix& matrix, const FacetMesh& mesh, const JudgeSettings& settings)
      : matrix_(matrix), mesh_(mesh), settings_(settings) {
    for (const radiosity::Surface& surface : mesh.scene.surfaces) area_.push_back(radiosity::area(surface));
  }

  MatrixVerdict verdict() {
    if (!hasSize()) return verdict_;
    checkEntries();
    checkReciprocity();
    rows_ = measuredRows(mesh_, settings_);
    for (const TrueRow& row : rows_) {
      unblocked_.emplace_back(mesh_.scene.surfaces.size());
      std::vector<double>& closed = unblocked_.back();
      raster::parallelFor(closed.size(), [&](std::size_t s) {
        closed[s] = quickFormFactor(mesh_.scene.surfaces[row.surface], mesh_.scene.surfaces[s]);
      });
    }
    checkRows();
    if (!verdict_.problems.empty()) nameFault();
    return verdict_;
  }

 private:
  using Value = std::function<double(std::size_t row, std::uint32_t to)>;  ///< of a measured row to a surface

  std::uint32_t facet(std::uint32_t surface) const { return mesh_.facetOf[surface]; }
  std::string name(std::uint32_t facet) const { return "facet " + std::to_string(facet); }
  void add(const std::string& problem) { verdict_.problems.push_back(problem); }

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
    if (selves > 0) add(std::to_string(selves) + " planar facets see themselves");
  }

  void checkReciprocity() {
    double difference = 0, sum = 0, worst = 0;
    std::pair<std::uint32_t, std::uint32_t> place;
    std::vector<double> area(mesh_.facets, 0.0);  // of the facets
    for (std::uint32_t s = 0; s < area_.size(); ++s) area[facet(s)] = area_[s];
    for (std::uint32_t i = 0; i < matrix_.rows(); ++i) {
      const SparseRow row = matrix_.row(i);
      for (std::size_t k = 0; k < row.column.size() && row.column[k] < mesh_.facets; ++k) {
        const std::uint32_t j = row.column[k];
        const double there = area[i] * row.value[k], back = area[j] * entry(matrix_, j, i);
        sum += there;
        // A pair of which one entry is missing is met once.
        difference += (back == 0 ? 2 : 1) * std::abs(there - back) / 2;
        if (std::abs(there - back) > worst) {
          worst = std::abs(there - back);
          place = {i, j};
        }
      }
    }
    verdict_.reciprocity = sum > 0 ? difference / sum : 0;
    if (verdict_.reciprocity > std::max(0.2, 4 * settings_.tolerance))
      add("reciprocity is missed by " + shortNumber(100 * verdict_.reciprocity) +
          " % of all exchange; the worst pair is " + name(place.first) + " and " + name(place.second));
  }

  double given(std::size_t row, std::uint32_t to) const { return entry(matrix_, facet(rows_[row].surface), facet(to)); }

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
      kind.text =
          shortNumber(found) + " from " + name(facet(rows_[r].surface)) + " to " + name(facet(to)) + ", where " + truth;
    };
    double difference = 0, sum = 0, noise = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const TrueRow& row = rows_[r];
      for (std::uint32_t to = 0; to < area_.size(); ++to) {
        const double found = given(r, to), truth = row.factor[to], closed = unblocked_[r][to];
        const double allowed =
            confidence * row.error[to] + settings_.tolerance * std::max(found, truth) + smallestFactor;
        difference += area_[row.surface] * std::abs(found - truth);
        noise += area_[row.surface] * row.error[to];
        sum += area_[row.surface] * truth;
        if (closed == 0 && found > smallestFactor)
          count(impossible, r, to, found, found, "nothing can be seen");
        else if (found > closed * (1 + std::max(settings_.tolerance, 2e-3)) + smallestFactor)
          count(above, r, to, found - closed, found, "the closed form without blockers is " + shortNumber(closed));
        else if (found == 0 && truth > allowed)
          count(missing, r, to, truth, found, "rays measure " + shortNumber(truth));
        else if (std::abs(found - truth) > allowed)
          count(outside, r, to, std::abs(found - truth), found,
                "rays measure " + shortNumber(truth) + " +- " + shortNumber(confidence * row.error[to]));
      }
    }
    verdict_.measuredRows = rows_.size();
    verdict_.difference = sum > 0 ? difference / sum : difference;
    verdict_.noise = sum > 0 ? noise / sum : 0;
    if (verdict_.difference - 3 * verdict_.noise > settings_.tolerance)
      add("the measured rows differ from rays by " + shortNumber(100 * verdict_.difference) + " % of their light");
    const auto tell = [&](const Kind& kind, const std::string& what) {
      if (kind.count > 0)
        add(std::to_string(kind.count) + " entries of " + std::to_string(rows_.size()) + " measured rows " + what +
            "; the worst is " + kind.text);
    };
    tell(impossible, "are above 0 where nothing can be seen");
    tell(above, "are above the closed form without blockers");
    tell(missing, "are 0 where something is seen");
    tell(outside, "differ from rays");
  }

  /// The sum of the differences of two matrices in the measured rows, by area.
  double distance(const Value& a, const Value& b) const {
    double sum = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r)
      for (std::uint32_t to = 0; to < area_.size(); ++to)
        sum += area_[rows_[r].surface] * std::abs(a(r, to) - b(r, to));
    return sum;
  }

  /// Names the fault whose prediction is nearest to the matrix.
  void nameFault() {
    const Value matrix = [this](std::size_t r, std::uint32_t to) { return given(r, to); };
    const Value truth = [this](std::size_t r, std::uint32_t to) { return rows_[r].factor[to]; };
    const double all = distance(truth, [](std::size_t, std::uint32_t) { return 0.0; });
    double nearest = distance(matrix, truth) / nearerBy;
    const auto consider = [&](const std::string& fault, const Value& found, const Value& predicted, double scale = 1) {
      const double apart = scale * distance(found, predicted);
      if (!(apart < nearest) || !(apart < 0.25 * all)) return;
      nearest = apart;
      verdict_.fault = fault;
    };
    considerChangedMatrices(consider, truth);
    considerChangedTruths(consider, matrix);
  }

  /// Faults that are undone by a change of the matrix.
  template <typename Consider>
  void considerChangedMatrices(const Consider& consider, const Value& truth) const {
    // Facets that no facet moves to are not compared.
    const auto moved = [this, &truth](const auto& other) -> Value {
      return [this, &truth, other](std::size_t r, std::uint32_t to) {
        const std::int64_t count = static_cast<std::int64_t>(mesh_.facets);
        const std::int64_t i = other(facet(rows_[r].surface)), j = other(facet(to));
        if (i < 0 || j < 0 || i >= count || j >= count) return truth(r, to);
        return entry(matrix_, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
      };
    };
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
    consider("facets are in reversed order", moved([last](std::int64_t f) { return last - f; }), truth);
    consider("facets are shifted by one, as if counted from 1 instead of 0",
             moved([](std::int64_t f) { return f + 1; }), truth);
    consider("facets are shifted by one, as if counted from 0 instead of 1",
             moved([](std::int64_t f) { return f - 1; }), truth);
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
    const std::vector<std::vector<bool>> sees = centresThatSee();
    consider("partly hidden pairs are decided by their centres", matrix,
             [&](std::size_t r, std::uint32_t to) { return sees[r][to] ? unblocked_[r][to] : 0.0; });
    const radiosity::Scene turned = turnedOver(mesh_.scene);
    const FacetMesh other{turned, mesh_.discretization, mesh_.facetOf, mesh_.facets};
    const std::vector<TrueRow> rows = measuredRows(other, settings_);
    consider("all normals are turned over", matrix,
             [&](std::size_t r, std::uint32_t to) { return rows[r].factor[to]; });
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
    for (const TrueRow& row : rows_) {
      const glm::dvec3 start = middleOf(scene.surfaces[row.surface]);
      std::vector<bool> seen(scene.surfaces.size());
      for (std::uint32_t to = 0; to < seen.size(); ++to) {
        const glm::dvec3 way = middleOf(scene.surfaces[to]) - start;
        if (to == row.surface || glm::length(way) == 0) continue;
        const auto hit =
            caster.firstHit({(start - scene.origin) / scene.extent, glm::normalize(way), first[row.surface]});
        seen[to] = hit && surfaceOf[hit->triangle] == to;
      }
      sees.push_back(std::move(seen));
    }
    return sees;
  }

  const SparseMatrix& matrix_;
  const FacetMesh& mesh_;
  JudgeSettings settings_;
  std::vector<double> area_;  ///< of the surfaces
  std::vector<TrueRow> rows_;
  std::vector<std::vector<double>> unblocked_;  ///< of the measured rows
  MatrixVerdict verdict_;
};

}  // namespace

MatrixVerdict judgeMatrix(const SparseMatrix& matrix, const FacetMesh& mesh, const JudgeSettings& settings) {
  return Judge(matrix, mesh, settings).verdict();
}

}  // namespace hemitex::reference
