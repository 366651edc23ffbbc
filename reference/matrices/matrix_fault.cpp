#include "reference/matrices/matrix_fault.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "raster/base/short_number.h"
#include "reference/matrices/facet_order.h"
#include "reference/truth/rays/ray_caster.h"

namespace hemitex::reference {
namespace {

using raster::shortNumber;

/// A fault is named if its prediction is nearer to the matrix than the truth by this factor.
constexpr double nearerBy = 3;

/// The mesh with all facets turned over, or one of them.
radiosity::Scene turnedOver(const radiosity::Scene& scene, std::optional<std::uint32_t> only = {}) {
  radiosity::Scene turned = scene;
  for (std::uint32_t s = 0; s < turned.surfaces.size(); ++s)
    if (!only || *only == s) radiosity::turnOver(turned.surfaces[s]);
  return turned;
}

class FaultSearch {
 public:
  FaultSearch(const JudgedMatrix& matrix, const JudgedRows& rows, const JudgeSettings& settings)
      : matrix_(matrix), rows_(rows), settings_(settings), area_(matrix.area) {
    all_ = distance(
        truth_, [](const JudgedRow&, std::uint32_t) { return 0.0; }, false);
    for (const bool columns : {false, true}) before_[columns] = distance(found_, truth_, columns);
  }

  std::optional<std::string> fault(bool isOutsideWrong) {
    considerChangedMatrices();
    considerChangedTruths();
    considerScale();
    considerFacets();
    if (!fault_) considerOrders();
    if (!fault_ && isOutsideWrong && before_[0] < settings_.tolerance * all_) fault_ = outsideFault();
    return fault_;
  }

 private:
  using Value = std::function<double(const JudgedRow&, std::uint32_t to)>;  ///< of a row, to a surface
  using Entry = std::function<double(std::uint32_t i, std::uint32_t j)>;    ///< of a matrix, from facet to facet

  /// The sum of the differences of two matrices in the measured rows, by area, of entries and of sums, as far as errors
  /// do not explain them. With `columns` also of what the facets receive.
  double distance(const Value& a, const Value& b, bool columns) const {
    double sum = 0, all = 0, squares = 0;
    for (const JudgedRow& row : columns ? std::span(rows_.all) : onlyRows()) {
      const double area = area_[row.surface], sumError = std::hypot(row.sumError, row.sums.stated);
      double apart = 0, difference = 0;
      for (std::uint32_t to = 0; to < row.to.size(); ++to) {
        if (row.to[to].isTied) continue;
        const double one = a(row, to) - b(row, to);
        apart += std::max(0.0, std::abs(one) - unclear * row.to[to].error);
        difference += one;
      }
      sum += area * (apart + std::max(0.0, std::abs(difference) - unclear * sumError));
      if (row.isColumn) continue;
      all += area * difference;
      squares += area * area * sumError * sumError;
    }
    return sum + std::max(0.0, std::abs(all) - unclear * std::sqrt(squares));
  }

  /// Takes a fault if what it makes of the matrix and what it predicts are nearer to each other than those of all
  /// faults before, by a factor.
  void consider(const std::string& fault, const Value& found, const Value& predicted, bool columns = false,
                double factor = 1) {
    const double apart = distance(found, predicted, columns);
    if (!(factor * apart < nearest_ * before_[columns]) || !(apart < 0.25 * all_)) return;
    nearest_ = apart / before_[columns];
    fault_ = fault;
  }
  /// A fault that is undone by a change of the matrix.
  void considerUndone(const std::string& fault, const Entry& at, bool columns = false) {
    consider(
        fault, [&](const JudgedRow& row, std::uint32_t to) { return gathered(matrix_, row, to, at); }, truth_, columns);
  }
  /// The same, for a factor by row and surface.
  void considerScaled(const std::string& fault, const Value& factor) {
    consider(
        fault, [&](const JudgedRow& row, std::uint32_t to) { return factor(row, to) * found_(row, to); }, truth_);
  }
  /// A fault that predicts another matrix than the true one.
  void considerPredicted(const std::string& fault, const Value& predicted, bool columns = false) {
    consider(fault, found_, predicted, columns);
  }
  /// A matrix whose facet f has the number other(f). Facets that no facet moves to are not compared.
  void considerMoved(const std::string& fault, const std::function<std::int64_t(std::uint32_t)>& other) {
    const auto isNumber = [&](std::int64_t f) { return f >= 0 && f < std::int64_t{matrix_.facets()}; };
    const Value moved = [&](const JudgedRow& row, std::uint32_t to) {
      const std::int64_t i = other(matrix_.facet(row.surface));
      double sum = 0;
      for (const std::uint32_t f : matrix_.facetsOf[to]) {
        const std::int64_t j = other(f);
        if (!isNumber(i) || !isNumber(j)) return truth_(row, to);
        sum += matrix_.entry(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
      }
      return sum;
    };
    consider(fault, moved, truth_);
  }

  std::span<const JudgedRow> onlyRows() const { return std::span(rows_.all).first(rows_.rows); }

  void considerChangedMatrices() {
    const std::uint32_t facets = matrix_.facets();
    consider(
        "the matrix is transposed",
        [&](const JudgedRow& row, std::uint32_t to) {
          return matrix_.entry(matrix_.facet(to), matrix_.facet(row.surface));
        },
        truth_);
    considerScaled("each row is multiplied by the area of its facet",
                   [&](const JudgedRow& row, std::uint32_t) { return 1 / area_[row.surface]; });
    considerScaled("each column is multiplied by the area of its facet",
                   [&](const JudgedRow&, std::uint32_t to) { return 1 / area_[to]; });
    considerScaled("entries are in percent", [](const JudgedRow&, std::uint32_t) { return 0.01; });
    considerScaled("entries are multiplied by pi",
                   [](const JudgedRow&, std::uint32_t) { return std::numbers::inv_pi; });
    considerScaled("entries are divided by pi", [](const JudgedRow&, std::uint32_t) { return std::numbers::pi; });
    considerMoved("facets are in reversed order",
                  [&](std::uint32_t f) { return std::int64_t{facets} - 1 - std::int64_t{f}; });
    considerMoved("facets are shifted by one, as if counted from 1 instead of 0",
                  [](std::uint32_t f) { return std::int64_t{f} + 1; });
    for (const std::uint32_t step : {facets - 1, facets + 1})
      considerUndone("rows are shifted by one, but not columns",
                     [&](std::uint32_t i, std::uint32_t j) { return matrix_.entry((i + step) % facets, j); });
    considerMoved("facets are shifted by one, as if counted from 0 instead of 1",
                  [](std::uint32_t f) { return std::int64_t{f} - 1; });
  }

  void considerChangedTruths() {
    considerPredicted("blockers are ignored",
                      [&](const JudgedRow& row, std::uint32_t to) { return row.to[to].closed; });
    considerPredicted("blockers count twice", [&](const JudgedRow& row, std::uint32_t to) {
      const double closed = row.to[to].closed, factor = row.to[to].truth;
      return closed > 0 ? factor * std::min(factor / closed, 1.0) : 0.0;
    });
    considerPredicted(
        "rows are normalized to 1, although light leaves the mesh",
        [&](const JudgedRow& row, std::uint32_t to) { return row.sum > 0 ? row.to[to].truth / row.sum : 0.0; });
    considerCovered();
    const std::vector<std::vector<bool>> sees = centresThatSee();
    considerPredicted("partly hidden pairs are decided by their centres", [&](const JudgedRow& row, std::uint32_t to) {
      return sees[row.surface][to] ? row.to[to].closed : 0.0;
    });
    considerScene("all normals are turned over", turnedOver(matrix_.mesh.scene));
    considerPredicted("entries are averaged with their opposites, without areas",
                      [&](const JudgedRow& row, std::uint32_t to) {
                        return row.to[to].truth * (1 + area_[row.surface] / area_[to]) / 2;
                      });
    // The smallest entry that the matrix has.
    double kept = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < matrix_.matrix.value.size(); ++k)
      if (matrix_.matrix.column[k] < matrix_.facets() && matrix_.matrix.value[k] > 0)
        kept = std::min(kept, matrix_.matrix.value[k]);
    considerPredicted(
        "entries below " + shortNumber(kept) + " are dropped",
        [&](const JudgedRow& row, std::uint32_t to) { return row.to[to].truth < kept ? 0.0 : row.to[to].truth; });
  }

  /// The measured rows of another scene with the same facets.
  void considerScene(const std::string& fault, const radiosity::Scene& scene) {
    std::vector<std::uint32_t> surfaces;
    for (const JudgedRow& row : onlyRows()) surfaces.push_back(row.surface);
    const FacetMesh mesh{scene, matrix_.mesh.discretization, matrix_.mesh.facetOf, matrix_.mesh.facets};
    std::vector<std::vector<double>> factor(area_.size());
    for (TrueRow& row : measuredRows(mesh, surfaces, settings_.samples)) factor[row.surface] = std::move(row.factor);
    considerPredicted(fault, [&](const JudgedRow& row, std::uint32_t to) { return factor[row.surface][to]; });
  }

  /// Each facet of a place receives as much as if it were alone there. The same for facets right behind another.
  void considerCovered() {
    std::optional<std::string> inOnePlace, behind;  // the first pair
    const auto pairOf = [](std::uint32_t a, std::uint32_t b) { return nameOfFacet(a) + " and " + std::to_string(b); };
    const auto& repeated = matrix_.mesh.repeated;
    if (!repeated.empty()) inOnePlace = pairOf(repeated.front().second, repeated.front().first);
    std::vector<std::vector<std::uint32_t>> fronts(area_.size());
    for (const CoveredPair& pair : matrix_.pairs) {
      std::optional<std::string>& first = pair.isOnePlace ? inOnePlace : behind;
      if (!first) first = pairOf(matrix_.facet(pair.front), matrix_.facet(pair.behind));
      if (!pair.isOnePlace) fronts[pair.behind].push_back(pair.front);
    }
    if (inOnePlace)
      considerPredicted(
          "facets in one place are all visible, such as " + *inOnePlace, [&](const JudgedRow& row, std::uint32_t to) {
            return matrix_.placeOf[to] == to ? matrix_.areaOfPlace[to] / area_[to] * row.to[to].truth : 0.0;
          });
    if (behind)
      considerPredicted("facets right behind others are visible, such as " + *behind,
                        [&](const JudgedRow& row, std::uint32_t to) {
                          double sum = row.to[to].truth;
                          for (const std::uint32_t front : fronts[to]) sum += row.to[front].truth;
                          return sum;
                        });
  }

  /// Whether the line between the centres of a measured facet and another is free.
  std::vector<std::vector<bool>> centresThatSee() const {
    const radiosity::Scene& scene = matrix_.mesh.scene;
    const RayCaster caster(scene);
    std::vector<std::uint32_t> surfaceOf, first;
    for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
      first.push_back(static_cast<std::uint32_t>(surfaceOf.size()));
      surfaceOf.insert(surfaceOf.end(), scene.surfaces[s].triangles.size(), s);
    }
    std::vector<std::vector<bool>> sees(scene.surfaces.size());
    for (const JudgedRow& row : onlyRows()) {
      const glm::dvec3 start = middleOf(scene.surfaces[row.surface]);
      std::vector<bool>& seen = sees[row.surface];
      seen.resize(scene.surfaces.size());
      for (std::uint32_t to = 0; to < seen.size(); ++to) {
        const glm::dvec3 way = middleOf(scene.surfaces[to]) - start;
        if (to == row.surface || glm::length(way) == 0) continue;
        const auto hit =
            caster.firstHit({(start - scene.origin) / scene.extent, glm::normalize(way), first[row.surface]});
        seen[to] = hit && hit->triangle < surfaceOf.size() && surfaceOf[hit->triangle] == to;
      }
    }
    return sees;
  }

  /// All entries by one factor. It is fitted, so a fault with a meaning comes first, unless it explains much less.
  void considerScale() {
    double found = 0, sum = 0;
    for (const JudgedRow& row : onlyRows()) {
      found += area_[row.surface] * row.sums.found;
      sum += area_[row.surface] * row.sums.truth;
    }
    if (!(found > 0 && sum > 0)) return;
    const double factor = found / sum;
    consider(
        "all entries are multiplied by " + shortNumber(factor),
        [&](const JudgedRow& row, std::uint32_t to) { return found_(row, to) / factor; }, truth_, false,
        fault_ ? nearerBy : 1);
  }

  /// The facets whose measured rows and columns differ the most, the worst first.
  std::vector<std::uint32_t> worstFacets() const {
    std::vector<std::uint32_t> worst;
    std::vector<double> apart(area_.size(), 0.0);
    for (const JudgedRow& row : rows_.all) {
      if (!row.isColumn) worst.push_back(row.surface);
      for (const JudgedEntry& entry : row.to)
        apart[row.surface] += std::max(0.0, std::abs(entry.found - entry.truth) - unclear * entry.error);
      apart[row.surface] += std::max(0.0, std::abs(row.sums.found - row.sums.truth) - unclear * row.sumError);
    }
    std::stable_sort(worst.begin(), worst.end(), [&](auto a, auto b) { return apart[a] > apart[b]; });
    worst.resize(std::min(worst.size(), suspects));
    return worst;
  }

  /// Faults of single facets.
  void considerFacets() {
    std::vector<std::uint32_t> worst = worstFacets();
    for (const JudgedRow& bad : rows_.all) {
      if (std::find(worst.begin(), worst.end(), bad.surface) == worst.end() || bad.sums.truth == 0) continue;
      const std::uint32_t facet = matrix_.facet(bad.surface);
      const double factor = bad.sums.found / bad.sums.truth;
      if (factor == 0 && !bad.isColumn)
        considerPredicted(
            "the row of " + nameOfFacet(facet) + " is empty",
            [&](const JudgedRow& row, std::uint32_t to) {
              const std::uint32_t from = row.isColumn ? to : row.surface;
              return from == bad.surface ? 0.0 : row.to[to].truth;
            },
            true);
      if (factor > 0)
        considerUndone((bad.isColumn ? "the column of " : "the row of ") + nameOfFacet(facet) + " is multiplied by " +
                           shortNumber(factor),
                       [&](std::uint32_t i, std::uint32_t j) {
                         return matrix_.entry(i, j) / ((bad.isColumn ? j : i) == facet ? factor : 1);
                       },
                       true);
    }
    for (std::size_t a = 0; a < worst.size(); ++a)
      for (std::size_t b = a + 1; b < worst.size(); ++b) {
        const std::uint32_t one = matrix_.facet(worst[a]), two = matrix_.facet(worst[b]);
        const auto other = [&](std::uint32_t f) { return f == one ? two : f == two ? one : f; };
        considerUndone(
            "facets " + std::to_string(std::min(one, two)) + " and " + std::to_string(std::max(one, two)) +
                " are exchanged",
            [&](std::uint32_t i, std::uint32_t j) { return matrix_.entry(other(i), other(j)); }, true);
      }
    worst.resize(std::min<std::size_t>(worst.size(), 3));
    for (const std::uint32_t surface : worst)
      if (!fault_)
        considerScene("the normal of " + nameOfFacet(matrix_.facet(surface)) + " is turned over",
                      turnedOver(matrix_.mesh.scene, surface));
  }

  /// Facets in any other order, by rough rows of all facets.
  void considerOrders() {
    const std::uint32_t facets = matrix_.facets();
    if (facets > maxOrderedFacets) return;
    FormFactorMatrix given{facets, std::vector<double>(std::size_t{facets} * facets)}, rough = given;
    for (std::uint32_t i = 0; i < facets; ++i)
      for (std::uint32_t j = 0; j < facets; ++j) given.factors[std::size_t{i} * facets + j] = matrix_.entry(i, j);
    for (const TrueRow& row : measuredRows(matrix_.mesh, spreadSurfaces(area_.size(), area_.size()), 1 << 14))
      for (std::uint32_t to = 0; to < area_.size(); ++to)
        rough.factors[std::size_t{matrix_.facet(row.surface)} * facets + matrix_.facet(to)] = row.factor[to];
    const auto order = facetOrder(given, rough);
    if (!order) return;
    std::size_t others = 0;
    std::string examples;
    for (std::uint32_t f = 0; f < facets; ++f)
      if ((*order)[f] != f && ++others <= 3)
        examples += (others == 1 ? ": " : ", ") + nameOfFacet(f) + " has the number " + std::to_string((*order)[f]);
    considerMoved("facets are in another order" + examples + (others > 3 ? ", ..." : ""),
                  [&](std::uint32_t f) { return std::int64_t{(*order)[f]}; });
  }

  /// What is wrong with surroundings and backs where nothing is known to be wrong with the form factors.
  std::string outsideFault() const {
    double found = 0, sum = 0, exchanged = 0, straight = 0, scaled = 0;
    const auto outside = [&](const JudgedRow& row, std::uint32_t k) {
      return matrix_.entry(matrix_.facet(row.surface), matrix_.facets() + k);
    };
    for (const JudgedRow& row : onlyRows()) {
      found += outside(row, 0);
      sum += row.outside[0].value;
    }
    const double factor = sum > 0 ? found / sum : 0;
    for (const JudgedRow& row : onlyRows())
      for (std::uint32_t k = 0; k < 2; ++k) {
        const double share = outside(row, k), truth = row.outside[k].value;
        straight += std::abs(share - truth);
        exchanged += std::abs(share - row.outside[1 - k].value);
        scaled += std::abs(share - (k == 0 ? factor : 1) * truth);
      }
    if (exchanged * nearerBy < straight) return "surroundings and backs are exchanged";
    if (scaled * nearerBy < straight) return "surroundings are multiplied by " + shortNumber(factor);
    return "surroundings or backs are wrong, although form factors may be right";
  }

  const JudgedMatrix& matrix_;
  const JudgedRows& rows_;
  JudgeSettings settings_;
  const std::vector<double>& area_;
  const Value found_ = [](const JudgedRow& row, std::uint32_t to) { return row.to[to].found; };
  const Value truth_ = [](const JudgedRow& row, std::uint32_t to) { return row.to[to].truth; };
  double all_ = 0;                    ///< the distance of the truth from nothing
  std::array<double, 2> before_{};    ///< that of the matrix from the truth, without and with columns
  double nearest_ = 1 / nearerBy;     ///< of all faults so far, over that of the matrix
  std::optional<std::string> fault_;  ///< with this distance
};

}  // namespace

std::optional<std::string> matrixFault(const JudgedMatrix& matrix, const JudgedRows& rows,
                                       const JudgeSettings& settings, bool isOutsideWrong) {
  return FaultSearch(matrix, rows, settings).fault(isOutsideWrong);
}

}  // namespace hemitex::reference
