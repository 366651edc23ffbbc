#include "reference/rows/facet_form_factors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/projection/covered_share.h"
#include "reference/truth/closed_forms/quick_form_factor.h"

namespace hemitex::reference {
namespace {

using radiosity::formFactor;

/// A facet is visible as a whole if no more than this part of it is hidden, and no more than this number of pixels per
/// view: the covered pixels of this program and those of the renderer differ at edges.
constexpr double hiddenAtMost = 0.005, hiddenPixelsAtMost = 1;

/// A facet whose covered pixels have less light than this number of pixels at the pole has an uncertain visible part.
constexpr double fewestPixels = 4;

/// The error of the mean over both sets of points, per difference between them; measured on cities and rooms.
constexpr double errorPerDifference = 2;

/// The relative error of the closed form (quick_form_factor.h).
constexpr double closedFormError = 1e-4;

int resolutionFor(double maxError) { return maxError >= 0.005 ? 64 : 128; }

/// The points of a facet: two sets, each of the centroids of the n^2 equal parts of its triangles. Parts are divided
/// into four, whose middle one keeps the centroid. So each set grows without losing points.
struct Rule {
  std::array<int, 2> divisions;  ///< n of both sets
};
constexpr std::array rules{Rule{{2, 3}}, Rule{{4, 3}}, Rule{{4, 6}}, Rule{{8, 6}}, Rule{{8, 12}}, Rule{{16, 12}}};

/// The light through pixels of a facet, from both sets of points.
struct FacetSums {
  std::array<double, 2> seen{}, covered{};
  int views = 0;          ///< that `covered` counts
  double unblocked = -1;  ///< the closed form, once it is known
};

double visiblePart(double seen, double covered) { return covered > 0 ? std::min(seen / covered, 1.0) : 0; }

/// Calls visit(weights) with the barycentric weights of the corners 1 and 2 of the centroids of the n^2 equal parts of
/// a triangle, but for those that a division into n / 2 has.
template <typename Visit>
void forEachNewCentroid(int n, bool isFirst, const Visit& visit) {
  // Part (i, j) of the division into n, upright or turned over, is the middle one of a part of n / 2 if it is turned
  // over in an upright part, or upright in one that is turned over.
  const auto isOld = [&](int i, int j, bool isUpright) {
    return !isFirst && i % 2 == (isUpright ? 1 : 0) && j % 2 == (isUpright ? 1 : 0);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n - i; ++j) {
      if (!isOld(i, j, true)) visit(glm::dvec2((i + 1.0 / 3) / n, (j + 1.0 / 3) / n));
      if (j < n - i - 1 && !isOld(i, j, false)) visit(glm::dvec2((i + 2.0 / 3) / n, (j + 2.0 / 3) / n));
    }
}

/// The least error of the visible part of a facet that n points see through a number of pixels: the border of the
/// points that see it crosses about the root of n cells, each of which is off by up to 1 / n, and each pixel is seen or
/// not. The differences of both halves tell more, but may be small by chance.
double leastError(double part, double n, double pixels) {
  const double root = std::sqrt(n);
  return 0.3 * std::sqrt(part * (1 - part) * (1 / (n * root) + 1 / pixels)) + 1 / pixels;
}

/// The share of the light through a pixel at the pole, which is the largest: the area of the pixel over pi.
double poleShare(int resolution) {
  const double side = 2.0 / resolution;
  return side * side * std::numbers::inv_pi;
}

/// Draws the facets at all instances, whose item IDs are their numbers.
raster::DrawList drawsOfFacets(const radiosity::Scene& scene, const radiosity::IdLayout& layout) {
  raster::DrawList list;
  list.format = layout.format;
  for (const radiosity::Instance& instance : scene.instances)
    for (const radiosity::Surface& facet : scene.surfaces) {
      const auto number = static_cast<raster::ItemId>(list.draws.size());
      raster::Draw& draw = appendDraw(list, facet.triangles, instance, scene.origin);
      draw.offset = number;
      draw.back = raster::backId(layout.format);
    }
  return list;
}

/// Adds up the columns of the images of each of n facets; two more columns are kept.
SparseRow folded(const SparseRow& row, std::uint32_t facets, std::uint32_t images) {
  std::map<std::uint32_t, std::pair<double, double>> sums;
  for (std::size_t k = 0; k < row.column.size(); ++k) {
    const std::uint32_t column = row.column[k];
    auto& [value, error] = sums[column < images ? column % facets : column - images + facets];
    value += row.value[k];
    error += row.error[k];
  }
  SparseRow result;
  result.rowError = row.rowError;
  for (const auto& [column, sum] : sums) {
    result.column.push_back(column);
    result.value.push_back(sum.first);
    result.error.push_back(sum.second);
  }
  return result;
}

/// A view, the area of its triangle and the set of its point.
struct WeightedView {
  radiosity::View view;
  double weight;
  std::size_t set;
};

}  // namespace

/// What one thread needs to compute rows.
class FacetFormFactors::Worker {
 public:
  Worker(const radiosity::Scene& scene, const std::vector<ConvexPolygons>& polygons,
         const radiosity::Discretization& images, const radiosity::IdLayout& layout, const FacetRowSettings& settings)
      : scene_(scene),
        polygons_(polygons),
        settings_(settings),
        renderer_(radiosity::softwareRenderer(drawsOfFacets(scene, layout))),
        rows_(scene, images, layout, *renderer_, {.resolution = resolutionFor(settings.maxError)}),
        sums_(images.elements.size()),
        poleShare_(poleShare(resolutionFor(settings.maxError))) {}

  SparseRow row(std::uint32_t facet) {
    views_.clear();
    background_ = backs_ = {};
    weights_ = {};
    std::array<int, 2> divisions{};
    SparseRow row;
    for (const Rule& rule : rules) {
      for (std::size_t set = 0; set < 2; ++set)
        if (rule.divisions[set] > divisions[set]) {
          addViews(facet, set, rule.divisions[set], divisions[set] == 0);
          divisions[set] = rule.divisions[set];
        }
      countCovered();
      row = rowOf(facet);
      if (*row.rowError <= settings_.maxError) break;
    }
    for (const std::uint32_t f : touched_) sums_[f] = {};
    touched_.clear();
    return folded(row, static_cast<std::uint32_t>(scene_.surfaces.size()), static_cast<std::uint32_t>(sums_.size()));
  }

 private:
  void addViews(std::uint32_t facet, std::size_t set, int divisions, bool isFirst) {
    const radiosity::Surface& surface = scene_.surfaces[facet];
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
      forEachNewCentroid(divisions, isFirst, [&](const glm::dvec2& weights) {
        addView(facet, radiosity::pointOn(surface, t, weights), radiosity::area(surface.triangles[t]), set);
      });
  }

  /// `weight` is the area of the point's triangle.
  void addView(std::uint32_t facet, const radiosity::SurfacePoint& point, double weight, std::size_t set) {
    const auto number = static_cast<int>(views_.size());
    const glm::dvec3 up = radiosity::upOf(radiosity::Orientation::Turned, point.normal, facet, number);
    views_.push_back({rows_.viewFrom({.surface = facet, .point = point, .up = up, .area = 1}), weight, set});
    const radiosity::FormFactorRow row = rows_.ofView(views_.back().view);
    for (std::size_t i = 0; i < row.elements.size(); ++i) {
      const std::uint32_t seen = row.elements[i];
      FacetSums& sums = sums_[seen];
      if (sums.seen[0] + sums.seen[1] == 0) touched_.push_back(seen);
      sums.seen[set] += weight * formFactor(row.shares[i]);
    }
    background_[set] += weight * formFactor(row.background);
    backs_[set] += weight * formFactor(row.back);
    weights_[set] += weight;
  }

  /// The polygons of a facet at an instance.
  ConvexPolygons polygonsOf(std::uint32_t number) const {
    const std::size_t facets = scene_.surfaces.size();
    return placed(scene_, polygons_[number % facets], scene_.instances[number / facets]);
  }

  /// A facet at an instance.
  radiosity::Surface imageOf(std::uint32_t number) const {
    const std::size_t facets = scene_.surfaces.size();
    return radiosity::placed(scene_.surfaces[number % facets], scene_.instances[number / facets]);
  }

  /// Adds what each seen facet covers in the views in which it was not counted yet, also where it is hidden.
  void countCovered() {
    for (const std::uint32_t number : touched_) {
      const radiosity::Surface facet = imageOf(number);
      FacetSums& sums = sums_[number];
      for (; sums.views < static_cast<int>(views_.size()); ++sums.views) {
        const auto& [view, weight, set] = views_[static_cast<std::size_t>(sums.views)];
        for (const radiosity::Triangle& triangle : facet.triangles) {
          std::array<glm::dvec3, 3> corners = triangle.position;
          for (glm::dvec3& corner : corners) corner -= scene_.origin;
          sums.covered[set] += weight * radiosity::coveredShare(*view.projection, view.faces, corners);
        }
      }
    }
  }

  /// The difference of the shares that both sets of points measure.
  double differenceOf(const std::array<double, 2>& sums) const {
    return std::abs(sums[0] / weights_[0] - sums[1] / weights_[1]);
  }

  SparseRow rowOf(std::uint32_t facet) {
    const double weight = weights_[0] + weights_[1], count = static_cast<double>(views_.size());
    std::sort(touched_.begin(), touched_.end());
    const auto share = [&](const std::array<double, 2>& sums) { return (sums[0] + sums[1]) / weight; };
    const auto errorOf = [&](const std::array<double, 2>& sums) { return errorPerDifference * differenceOf(sums); };
    SparseRow row;
    const auto add = [&row](std::size_t column, double value, double error) {
      row.column.push_back(static_cast<std::uint32_t>(column));
      row.value.push_back(value);
      row.error.push_back(static_cast<double>(static_cast<float>(error)));
    };
    double rowError = errorPerDifference * poleShare_;
    for (const std::uint32_t f : touched_) {
      FacetSums& sums = sums_[f];
      const double seen = sums.seen[0] + sums.seen[1], covered = sums.covered[0] + sums.covered[1];
      double factor = seen / weight, error = errorOf(sums.seen), least = std::sqrt(factor * poleShare_ / count);
      if (covered > fewestPixels * poleShare_ * weight / count) {
        if (sums.unblocked < 0) sums.unblocked = quickFormFactor(polygons_[facet], polygonsOf(f));
        const double hidden = std::max(covered - seen, 0.0);
        if (hidden <= hiddenAtMost * covered && hidden <= hiddenPixelsAtMost * poleShare_ * weight) {
          factor = sums.unblocked;
          error = sums.unblocked * std::max(hidden / covered, closedFormError);
        } else {
          const double difference =
              std::abs(visiblePart(sums.seen[0], sums.covered[0]) - visiblePart(sums.seen[1], sums.covered[1]));
          const double part = visiblePart(seen, covered);
          factor = sums.unblocked * part;
          error = sums.unblocked * std::max(errorPerDifference * difference, closedFormError);
        }
        least = sums.unblocked * leastError(visiblePart(seen, covered), count, covered / weight / poleShare_ * count);
      }
      if (factor <= 0) continue;
      add(f, factor, std::max(error, least));
      rowError += error;
    }
    add(sums_.size(), share(background_), errorOf(background_));
    add(sums_.size() + 1, share(backs_), errorOf(backs_));
    row.rowError = rowError;
    close(row);
    return row;
  }

  /// Changes the shares so that all sum to 1: each in proportion to the square of its error, or all by one factor if a
  /// share would be negative.
  static void close(SparseRow& row) {
    double sum = 0, variance = 0;
    for (const double share : row.value) sum += share;
    for (const double error : row.error) variance += error * error;
    const double change = variance > 0 ? (1 - sum) / variance : 0;
    std::vector<double> changed = row.value;
    for (std::size_t k = 0; k < changed.size(); ++k) changed[k] += change * row.error[k] * row.error[k];
    const bool isPossible =
        variance > 0 && std::all_of(changed.begin(), changed.end(), [](double share) { return share >= 0; });
    if (isPossible)
      row.value = std::move(changed);
    else
      for (double& share : row.value) share /= sum;
  }

  const radiosity::Scene& scene_;
  const std::vector<ConvexPolygons>& polygons_;  ///< of each facet
  FacetRowSettings settings_;
  std::unique_ptr<raster::ItemBufferRenderer> renderer_;
  radiosity::ProjectedFormFactors rows_;
  std::vector<FacetSums> sums_;         ///< of each facet at each instance
  std::vector<std::uint32_t> touched_;  ///< those that the present row sees
  std::vector<WeightedView> views_;     ///< of the present row
  std::array<double, 2> weights_{};     ///< of the views of both sets
  std::array<double, 2> background_{}, backs_{};
  double poleShare_;
};

FacetFormFactors::FacetFormFactors(const radiosity::Scene& scene, const FacetRowSettings& settings)
    : scene_(scene), settings_(settings), polygons_(convexPolygons(scene)) {
  images_.elements.resize(scene.instances.size() * scene.surfaces.size());
  layout_.format = *raster::formatNamed("r32ui");
  layout_.indexMaps = radiosity::IndexMaps::Unique;
}

FacetFormFactors::~FacetFormFactors() = default;

SparseRow FacetFormFactors::row(std::uint32_t facet) {
  std::unique_ptr<Worker> worker;
  {
    const std::lock_guard guard(mutex_);
    if (!idle_.empty()) {
      worker = std::move(idle_.back());
      idle_.pop_back();
    }
  }
  if (!worker) worker = std::make_unique<Worker>(scene_, polygons_, images_, layout_, settings_);
  SparseRow row = worker->row(facet);
  const std::lock_guard guard(mutex_);
  idle_.push_back(std::move(worker));
  return row;
}

}  // namespace hemitex::reference
