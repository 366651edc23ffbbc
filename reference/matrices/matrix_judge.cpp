#include "reference/matrices/matrix_judge.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
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
    rows_ = measuredRows(mesh_, settings_);
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
    checkRows();
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
    double difference = 0, sum = 0, worst = 0;
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

  /// The sum of entries to the place of a surface; 0 if it is that of an earlier surface.
  double given(std::size_t row, std::uint32_t to) const {
    double sum = 0;
    for (const std::uint32_t f : facetsOf_[to]) sum += entry(matrix_, facet(rows_[row].surface), f);
    return sum;
  }

  /// The error that the matrix states for it; 0 if it states none.
  double stated(std::size_t row, std::uint32_t to) const {
    if (matrix_.error.empty()) return 0;
    double sum = 0;
    for (const std::uint32_t f : facetsOf_[to])
      if (const auto place = matrix_.placeOf(facet(rows_[row].surface), f)) sum += matrix_.error[*place];
    return sum;
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
      kind.text =
          shortNumber(found) + " from " + name(facet(rows_[r].surface)) + " to " + name(facet(to)) + ", where " + truth;
    };
    double difference = 0, sum = 0, noise = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const TrueRow& row = rows_[r];
      for (std::uint32_t to = 0; to < area_.size(); ++to) {
        const double found = given(r, to), truth = row.factor[to], closed = unblocked_[r][to];
        const double allowed = confidence * std::hypot(row.error[to], stated(r, to)) +
                               settings_.tolerance * std::max(found, truth) + smallestFactor;
        const double beyond = found - closed * (1 + std::max(settings_.tolerance, 2e-3));
        if (isTied(r, to) && beyond <= smallestFactor) continue;
        difference += area_[row.surface] * std::abs(found - truth);
        noise += area_[row.surface] * row.error[to];
        sum += area_[row.surface] * truth;
        if (closed == 0 && found > smallestFactor)
          count(impossible, r, to, found, found, "nothing can be seen");
        else if (beyond > smallestFactor)
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

  /// Whether the errors that the matrix states explain its differences from rays.
  void checkErrors() {
    if (matrix_.error.empty()) return;
    double difference = 0, expected = 0, all = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r)
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
    if (!verdict_.fault) considerOrders(consider, truth);
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
    JudgeSettings settings = settings_;
    settings.rows = static_cast<int>(area_.size());
    settings.samples = 1 << 14;
    for (const TrueRow& row : measuredRows(mesh_, settings))
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
    const radiosity::Scene turned = turnedOver(mesh_.scene);
    const FacetMesh other{turned, mesh_.discretization, mesh_.facetOf, mesh_.facets};
    const std::vector<TrueRow> rows = measuredRows(other, settings_);
    consider("all normals are turned over", matrix,
             [&](std::size_t r, std::uint32_t to) { return rows[r].factor[to]; });
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
    for (const TrueRow& row : rows_) {
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
  std::vector<TrueRow> rows_;
  std::vector<std::vector<double>> unblocked_;  ///< of the measured rows
  MatrixVerdict verdict_;
};

}  // namespace

MatrixVerdict judgeMatrix(const SparseMatrix& matrix, const FacetMesh& mesh, const JudgeSettings& settings) {
  return Judge(matrix, mesh, settings).verdict();
}

}  // namespace hemitex::reference
